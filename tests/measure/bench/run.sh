#!/bin/sh
# `make bench`: finds out which peers this machine has, builds what changed, runs. Everything may be set from outside:
#   make bench SIZES="10000 100000" KINDS=iso FUNCTIONS="20 60" THREADS="1 2" REPEATS=5 \
#       PARTS="solve threads iterative iterations memory displace safe morph files" GIBIBYTES=24
# BUILD_ONLY=1 only builds $BUILD/bench/bench.
: "${BUILD:=build}" "${CXX:=c++}" "${CXXFLAGS:=-O3}"
: "${PARTS:=solve morph}"
case $PARTS in
iterative) : "${FUNCTIONS:=20}" "${SIZES:=10000 100000}" ;; # a million points take minutes
iterations) : "${SIZES:=1000 10000 100000 1000000}" ;;
memory) : "${SIZES:=1000 10000 100000 1000000 4000000 16000000}" "${KINDS:=iso}" ;;
esac
: "${SIZES:=10000 100000 1000000}" "${KINDS:=iso viscous unstructured}"
: "${FUNCTIONS:=20 60}" "${THREADS:=1}"
set -e
case " $PARTS " in *" files "*)
    BUILD="$BUILD" sh tests/measure/bench/files.sh
    PARTS=$(echo " $PARTS " | sed 's/ files / /')
    [ "$PARTS" != " " ] || exit 0 ;;
esac
here=tests/measure/bench out=$BUILD/bench
mkdir -p "$out"
flags="-std=c++17 -Wall -Wextra -Wconversion -Wshadow -ffp-contract=fast -pthread"
paths="-Iinclude -Isrc -Ic_api -Ic_api/cli -Itests"
sources=$(ls $here/*.cpp | grep -v /peer_)

# A peer is there if a program that calls it can be built. OpenBLAS is the first one on the link line, so that CHOLMOD,
# which is linked with any BLAS, takes the fastest one.
defines= libraries= petsc=
blas="-Wl,--no-as-needed -lopenblas"
echo 'int main() {}' >"$out/probe.cpp"
if $CXX -o "$out/probe" "$out/probe.cpp" $blas 2>/dev/null; then libraries=$blas; fi
peer() {   # name, libraries, declaration and call
    printf '%s\nint main() { %s; }\n' "$3" "$4" >"$out/probe.cpp"
    $CXX -std=c++17 -o "$out/probe" "$out/probe.cpp" $2 2>/dev/null || return 0
    defines="$defines -DHAVE_$(echo "$1" | tr a-z A-Z)"
    libraries="$libraries $2"
    sources="$sources $here/peer_$1.cpp"
}
# PETSc and the sequential MUMPS have different MPI libraries: where engines that iterate are measured, it is PETSc.
case " $PARTS " in *" iterative "*)
    petsc=$(pkg-config --cflags petsc mpi 2>/dev/null | sed 's/-I/-isystem /g') || true ;;
esac
peer cholmod "-lcholmod" '#include <suitesparse/cholmod.h>' 'cholmod_common common; cholmod_start(&common)'
[ -n "$petsc" ] || peer mumps "-ldmumps_seq -lmumps_common_seq -lpord_seq -lmpiseq_seq" '#include <dmumps_c.h>' \
    'DMUMPS_STRUC_C mumps{}; mumps.job = -2; dmumps_c(&mumps)'

if [ -n "$petsc" ]; then
    sources="$sources $here/peer_petsc.cpp"
    libraries="$libraries $(pkg-config --libs petsc mpi)"
fi

# Objects are old when a source, any header or the command is newer.
command="$CXX $CXXFLAGS $flags $paths $defines"
echo "$command" >"$out/flags.new"
cmp -s "$out/flags.new" "$out/flags" || cp "$out/flags.new" "$out/flags"
objects=
for source in $sources; do
    object=$out/$(basename "$source" .cpp).o
    objects="$objects $object"
    needs="$source $here/*.hpp tests/fixtures/*.hpp include/*.h"
    if [ -f "$object" ] && [ -z "$(find $needs "$out/flags" -newer "$object")" ]; then continue; fi
    echo "$CXX $source"
    includes=
    case $source in */peer_petsc.cpp) includes=$petsc ;; esac
    $command $includes "-DBENCH_FLAGS=\"$CXXFLAGS\"" -c -o "$object" "$source"
done
$CXX $CXXFLAGS -pthread -o "$out/bench" $objects "$BUILD/libharmorph.a" $LDFLAGS $libraries
[ -z "$BUILD_ONLY" ] || exit 0

# One run for each number of threads: libraries take theirs from the start.
for threads in $THREADS; do
    "$out/bench" --sizes "$SIZES" --kinds "$KINDS" --parts "$PARTS" --functions "$FUNCTIONS" --threads "$threads" \
        --repeats "${REPEATS:-0}" --gibibytes "${GIBIBYTES:-0}"
done
