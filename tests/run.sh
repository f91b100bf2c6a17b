#!/bin/sh
# All tests (called by `make test`, which says with what compilers and where). Each step prints one or several lines
# "N passed, M failed", or is the doctest program; the sum is the last line.
: "${MAKE:=make}" "${BUILD:=build}" "${CXX:=c++}" "${CXXFLAGS=}" "${CC:=cc}" "${CFLAGS:=-O2}" "${FC:=gfortran}"
export MAKE BUILD CXX CXXFLAGS CC CFLAGS FC FFLAGS AR LDFLAGS
passed=0 failed=0
log=$BUILD/test.log

missing=0
need() {   # what is needed, Debian's package, how to see that it is there
    what=$1 package=$2; shift 2
    "$@" >/dev/null 2>&1 && return
    echo "$what not found: install Debian's $package"
    missing=$((missing + 1))
}
has_doctest() { echo '#include <doctest/doctest.h>' | $CXX -x c++ -E -; }
need "the C compiler $CC" gcc $CC --version
need "the Fortran compiler $FC" gfortran $FC --version
need doctest/doctest.h doctest-dev has_doctest
need ld,\ nm,\ objdump binutils objdump --version
need "mpicc, mpifort and mpirun" "openmpi-bin and libopenmpi-dev" command -v mpifort
need pkg-config pkg-config pkg-config --version
need cmake cmake cmake --version
if [ $missing -gt 0 ]; then echo "0 passed, $missing failed"; exit 1; fi

# The counts are added up; a step that fails without counting a failure, or counts nothing, is a failure.
step() {   # name, command...
    echo "== $1"; shift
    { "$@" </dev/null 2>&1; echo $? >"$log.status"; } | tee "$log"
    counts=$(sed -n -e 's/^\([0-9][0-9]*\) passed, \([0-9][0-9]*\) failed$/\1 \2/p' \
        -e 's/^.*test cases: *[0-9]* | *\([0-9]*\) passed | *\([0-9]*\) failed.*/\1 \2/p' "$log" |
        awk '{ p += $1; f += $2 } END { print p + 0, f + 0 }')
    p=${counts% *} f=${counts#* }
    if [ "$f" = 0 ] && { [ "$(cat "$log.status")" != 0 ] || [ "$p" = 0 ]; }; then
        echo "this step failed"
        f=1
    fi
    passed=$((passed + p)) failed=$((failed + f))
}
compile_and_run() {   # program, compiler with flags...
    program=$1; shift
    "$@" -o "$program" && "$program"
}
make_and_test_figures() {
    $MAKE -s BUILD="$BUILD" CXX="$CXX" CXXFLAGS="$CXXFLAGS" LDFLAGS="$LDFLAGS" deform-driver &&
        sh tests/figures_test.sh "$BUILD/figures-test" "$BUILD/deform-driver"
}
# The header's way to begin a struct, {sizeof it}, leaves fields to be 0 by the language.
strict="-pedantic -Wall -Wextra -Werror -Wno-missing-field-initializers -Ic_api"

step "C++ tests" $MAKE -s BUILD="$BUILD" CXX="$CXX" CXXFLAGS="$CXXFLAGS" LDFLAGS="$LDFLAGS" unit
step "sentences of refusals" sh tests/refusals.sh
step "random problems" sh tests/fuzz/quick.sh "$BUILD"
stands_alone() { sh tests/check_link.sh "$BUILD" && sh tests/cortex.sh "$BUILD"; }
step "the library stands alone" stands_alone
step "one file" sh tests/amalgamation.sh "$BUILD"
step "binary interface" sh tests/abi/run.sh "$BUILD" quick
step "distribution" sh tests/dist.sh "$BUILD"
step "header in C" compile_and_run "$BUILD/c_header" $CC -std=c99 $strict tests/c_header.c
step "header in C++" compile_and_run "$BUILD/c_header" $CXX -std=c++17 $strict -x c++ tests/c_header.c
step "used from C" compile_and_run "$BUILD/use" $CC -std=c99 $strict $CFLAGS tests/use.c tests/traps.c "$BUILD/libharmorph.a" -lm
step "Fortran" sh tests/fortran.sh "$BUILD"
step "readers of SU2 files" sh tests/read_su2.sh "$BUILD"
step "MPI" sh tests/mpi.sh "$BUILD"
if pkg-config --exists petsc; then
    step "PETSc" sh tests/petsc.sh "$BUILD"
else
    echo "== PETSc: not installed (Debian's petsc-dev), its tests are SKIPPED"
fi
step "program" sh tests/cli.sh "$BUILD/harmorph" tests/meshes "$BUILD/cli"
step "faults of files" sh tests/faults.sh "$BUILD/harmorph" tests/meshes "$BUILD/faults"
step "given displacements on meshes" env CXX="$CXX" CXXFLAGS="$CXXFLAGS" MESHES="$MESHES" sh tests/given/run.sh "$BUILD"
step "mesh files" env CXX="$CXX" sh tests/formats.sh "$BUILD/harmorph" "$BUILD/formats"
step "moved shapes" sh tests/airfoils.sh "$BUILD/harmorph" tests/meshes "$BUILD/airfoils-test"
step "pictures of the program" sh tests/pictures.sh "$BUILD/harmorph" tests/meshes "$BUILD/pictures-test"
step "page of the program" sh tests/page.sh "$BUILD/harmorph" tests/meshes "$BUILD/page-test"
step "page of figures" make_and_test_figures
step "includes point downwards" sh tests/includes.sh
step "installation" sh tests/install.sh "$BUILD"
step "examples" sh tests/examples.sh "$BUILD"
step "README" sh tests/readme.sh "$BUILD"

rm -f "$log" "$log.status"
echo "$passed passed, $failed failed"
[ $failed = 0 ]
