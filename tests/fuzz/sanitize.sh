#!/bin/sh
# Called by `make sanitize`. Memory that is used before it is written: random problems, whose blocks valgrind is told to
# hold no values yet, and tests/c_api/use.c with clang's memory sanitizer. Races: the program with four threads, all
# operators and engines, and tests/c_api/openmp.c with threads of OpenMP, under the thread sanitizer. (`make fuzz` has
# the address and undefined-behaviour sanitizers.)
# PARTS="memcheck memory threads openmp": some of these. The last line counts.
: "${MAKE:=make}" "${BUILD:=build}" "${JOBS:=2}" "${CXX:=c++}" "${CLANG:=clang}"
: "${PARTS:=memcheck memory threads openmp}"
topic=sanitizers
. "$(dirname "$0")/../count.sh"
wanted() { case " $PARTS " in *" $1 "*) return 0 ;; esac; return 1; }
mkdir -p "$BUILD"

if wanted memcheck && echo '#include <valgrind/memcheck.h>' | $CXX -x c++ -E - >/dev/null 2>&1; then
    $MAKE -s BUILD="$BUILD" JOBS="$JOBS" fuzzer || exit 1
    for run in "problem 150" "basis 60" "sequence 30" "files 60" "commands 20"; do
        HARMORPH_UNDEFINED=1 valgrind -q --error-exitcode=9 --track-origins=no "$BUILD/fuzzer" $run 1 \
            >"$BUILD/memcheck.log" 2>&1
        passes "valgrind: fuzzer $run 1" $? "$BUILD/memcheck.log"
    done
elif wanted memcheck; then
    skip valgrind "it is not installed"
fi

if wanted memory && echo 'int main(void) { return 0; }' >"$BUILD/probe.c" &&
    $CLANG -fsanitize=memory "$BUILD/probe.c" -o "$BUILD/probe" 2>/dev/null; then
    dir=$BUILD/memory
    $MAKE -s BUILD="$dir" JOBS="$JOBS" CXX="$CLANG++" CXXFLAGS="-O1 -g1 -fsanitize=memory" library-only || exit 1
    $CLANG -std=c99 -O1 -g1 -fsanitize=memory -Iinclude tests/c_api/use.c "$dir/libharmorph.a" -lm -o "$dir/use" &&
        "$dir/use" >"$dir/log" 2>&1
    passes "memory sanitizer: tests/c_api/use.c" $? "$dir/log"
elif wanted memory; then
    skip "the memory sanitizer" "$CLANG has none"
fi

if wanted threads; then
    dir=$BUILD/threads
    $MAKE -s BUILD="$dir" JOBS="$JOBS" WASM_CXX=none CXX="$CXX" CXXFLAGS="-O1 -g1 -fsanitize=thread" \
        LDFLAGS=-fsanitize=thread all meshes || exit 1
    "$dir/harmorph" fit "$dir/meshes/naca0012.su2" --marker airfoil -o "$dir/a.curve" >"$dir/log" 2>&1
    echo "3 0.05 0.1" >"$dir/moves.txt"
    for options in "--operator laplace" "--operator weighted" "--operator conformal" \
        "--operator laplace --engine multigrid" "--operator laplace --engine fas" \
        "--operator laplace --scheme bounded" "--operator conformal"; do
        "$dir/harmorph" solve "$dir/meshes/naca0012.su2" --curve airfoil="$dir/a.curve" $options --threads 4 \
            -o "$dir/a.basis" >"$dir/log" 2>&1 &&
            "$dir/harmorph" morph "$dir/meshes/naca0012.su2" "$dir/a.basis" --move "$dir/moves.txt" --threads 4 \
                -o "$dir/m.su2" >>"$dir/log" 2>&1
        passes "thread sanitizer: solve $options, morph" $? "$dir/log"
    done
    "$dir/harmorph" demo "$dir/demo" --mesh "$dir/meshes/naca0012.su2" >"$dir/log" 2>&1 &&
        "$dir/harmorph" morph "$dir/demo/mesh.su2" "$dir/demo/airfoil.basis" --move "$dir/demo/far.txt" --safe \
            --threads 4 -o "$dir/m.su2" >>"$dir/log" 2>&1
    passes "thread sanitizer: morph --safe" $? "$dir/log"
fi

# libarcher tells the thread sanitizer how threads of LLVM's OpenMP wait for each other. That library itself is not
# instrumented.
archer=$($CLANG -print-resource-dir 2>/dev/null)/../../libarcher.so
if wanted openmp && [ -f "$archer" ]; then
    dir=$BUILD/openmp
    $MAKE -s BUILD="$dir" JOBS="$JOBS" CXX="$CLANG++" CXXFLAGS="-O1 -g1 -fsanitize=thread" library-only || exit 1
    $CLANG -std=c99 -O1 -g1 -fsanitize=thread -fopenmp -Iinclude tests/c_api/openmp.c "$dir/libharmorph.a" -lm \
        -o "$dir/use" && OMP_TOOL_LIBRARIES=$archer TSAN_OPTIONS="ignore_noninstrumented_modules=1:halt_on_error=1" \
        "$dir/use" >"$dir/log" 2>&1
    passes "thread sanitizer: tests/c_api/openmp.c" $? "$dir/log"
elif wanted openmp; then
    skip "the thread sanitizer with OpenMP" "libarcher is not installed (Debian: libomp-dev)"
fi
finish
