#!/bin/sh
# usage: petsc.sh BUILD   (FC, FFLAGS, CC, CFLAGS, MPICC, MPIFC, MPIRUN as in mpi.sh; MESHES: a directory of SU2 files
# to solve on as well; LARGE: O-meshes NI:NJ:FIRST; PARTITIONS, SOLVERS, OPERATORS: see petsc/main.c)
# harmorph_petsc.c and harmorph_petsc.f90, compiled without a warning, on 1 to 4 processes of this machine; where
# Debian's PETSc with complex scalars is installed, with it, too.
: "${CC:=cc}" "${CFLAGS:=-O2}" "${FC:=gfortran}" "${FFLAGS:=-O2}"
: "${MPICC:=mpicc}" "${MPIFC:=mpifort}" "${MPIRUN:=mpirun}"
build=$(cd "$1" && pwd)
dir=$build/petsc
rm -rf "$dir"
mkdir -p "$dir/complex"
if ! pkg-config --exists petsc; then
    echo "PETSc is not installed (Debian's petsc-dev): its tests are SKIPPED"
    echo "0 passed, 0 failed"
    exit 0
fi
. "$(dirname "$0")/processes.sh"
topic=PETSc log=$dir/log
. "$(dirname "$0")/../count.sh"
c() {
    $MPICC -std=c99 -D_XOPEN_SOURCE=700 -pedantic -Wall -Wextra -Werror -Wno-missing-field-initializers \
        -Wno-unused-function $CFLAGS $petsc_flags "$@" -Iinclude -Ic_api -Ic_api/examples
}
compile_tests() {   # directory, what pkg-config knows PETSc by
    # PETSc's headers as those of the system: their warnings are not ours.
    petsc_flags=$(pkg-config --cflags "$2" | sed 's/-I/-isystem /g') petsc_libs=$(pkg-config --libs "$2")
    check "harmorph_petsc.c" c -c c_api/petsc/harmorph_petsc.c -o "$1/harmorph_petsc.o"
    check "harmorph_petsc.c, as it is installed" c -c "$build/harmorph_petsc.c" -o "$1/harmorph_petsc.o"
    check "harmorph_mpi.c" c -c c_api/mpi/harmorph_mpi.c -o "$1/harmorph_mpi.o"
    check "read_su2.c" $CC $CFLAGS -c c_api/examples/read_su2.c -o "$1/read_su2.o"
    check "link of the tests" c -o "$1/petsc" tests/hosts/petsc/*.c "$1/read_su2.o" "$1/harmorph_petsc.o" \
        "$1/harmorph_mpi.o" "$build/libharmorph.a" $petsc_libs -lm
}
run() {   # directory, processes, arguments: the program prints its counts
    program=$1/petsc n=$2; shift 2
    start "$n" "$program" "$@" 2>&1 || fail "$program on $n processes $*"
}

# A module that was compiled with the headers of another version refuses this library.
of_another_version() {
    mkdir -p "$dir/other" && cp include/*.h "$dir/other/" &&
        sed 's/^#define HM_VERSION ".*/#define HM_VERSION "0.9.9"/' include/harmorph.h >"$dir/other/harmorph.h" &&
        c -I"$dir/other" -o "$dir/version" tests/hosts/petsc_version.c c_api/petsc/harmorph_petsc.c \
            "$build/libharmorph.a" $petsc_libs -lm
}

compile_tests "$dir" petsc
check "a module of another version" of_another_version
start 2 "$dir/version" 2>&1 || fail "a module of another version on 2 processes"
# The module is not optimised, which would take most of the time.
check "harmorph.f90" $MPIFC -std=f2018 $FFLAGS -O0 -J"$dir" -c "$build/harmorph.f90" -o "$dir/harmorph_f.o"
for source in "$build/harmorph_mpi.f90" "$build/harmorph_petsc.f90" fortran/read_su2.f90 fortran/examples/bfgs.f90 \
    fortran/examples/stream_function.f90 fortran/examples/partitioned_flow.f90 \
    fortran/examples/partitioned.f90; do
    name=$(basename "$source" .f90)
    check "$name.f90" $MPIFC -std=f2018 $FFLAGS -J"$dir" -I"$dir" -c "$source" -o "$dir/${name}_f.o"
done
check "link of partitioned.f90" $MPIFC $FFLAGS -o "$dir/partitioned" "$dir"/*_f.o "$dir/harmorph_petsc.o" \
    "$dir/harmorph_mpi.o" "$build/libharmorph.a" $petsc_libs -lm
for n in 1 2; do
    check "partitioned.f90 on $n processes" start $n "$dir/partitioned" "$build/meshes/naca0012.su2"
done
check "petsc_refusals.f90" $MPIFC -std=f2018 $FFLAGS -J"$dir" -I"$dir" -c tests/hosts/petsc_refusals.f90 \
    -o "$dir/refusals.o"
rm -f "$dir/partitioned_f.o"
check "link of petsc_refusals.f90" $MPIFC $FFLAGS -o "$dir/refusals" "$dir/refusals.o" "$dir"/*_f.o \
    "$dir/harmorph_petsc.o" "$dir/harmorph_mpi.o" "$build/libharmorph.a" $petsc_libs -lm
check "petsc_refusals.f90 on 2 processes" start 2 "$dir/refusals" "$build/meshes/naca0012.su2"
for n in 1 2 3 4; do run "$dir" $n; done
for what in ${MESHES:+"$MESHES"/*.su2} $LARGE; do
    for n in 1 2 3 4; do run "$dir" $n "$what"; done
done

# Both operators by PETSc and by harmorph_mpi: the last column of PETSc is the estimated error.
measured() {
    BUILD=$build MPICC=$MPICC MPIRUN=$MPIRUN SIZES=41:10 FUNCTIONS=4 FIRST=0 PROCESSES="1 2" \
        sh tests/measure/bench/petsc.sh >"$dir/bench" 2>&1
    cat "$dir/bench"
    grep 'warning: ' "$dir/bench" && return 1
    awk '$1 == "PETSc," { of_petsc = 1 } $1 == "harmorph_mpi," { of_petsc = 0 }
        $2 == 410 && (!of_petsc || ($7 > 0 && $NF < 1e-8)) { ++n } END { exit n != 8 }' "$dir/bench"
}
check "make bench-petsc" measured

for complex in /usr/lib/petscdir/petsc3*/*-complex/lib/pkgconfig/petsc.pc; do
    if [ ! -f "$complex" ]; then
        skip "PETSc with complex scalars" "Debian's libpetsc-complex-dev is not installed"
        break
    fi
    compile_tests "$dir/complex" "$complex"
    for n in 1 2; do run "$dir/complex" $n; done
done

finish "$dir"
