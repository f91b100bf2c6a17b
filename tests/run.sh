#!/bin/sh
# All tests (called by `make test`, which says with what compilers and where). Each step prints one or several lines
# "N passed, M failed", or is the doctest program; the sum is the last line.
: "${MAKE:=make}" "${BUILD:=build}" "${CXX:=c++}" "${CXXFLAGS=}" "${CC:=cc}" "${CFLAGS:=-O2}" "${FC:=gfortran}" \
    "${JOBS:=2}" "${PYTHON:=/usr/bin/python3}"
export MAKE BUILD CXX CXXFLAGS CC CFLAGS FC FFLAGS AR LDFLAGS PYTHON
passed=0 failed=0
logs=$BUILD/test-logs durations=$BUILD/test-durations

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

# Steps run in two lanes beside each other, which take about as long; those that call make in $BUILD are all in the
# first one. $durations tells how long each step took. The list of steps is gone through three times: each lane runs its
# own; the third time tells, in the order of the list, what they said, and adds up the counts. A step that fails without
# counting a failure, or counts nothing, is a failure.
step() {   # lane, name, command...
    lane=$1 name=$2 log=$logs/$(echo "$2" | tr ' ' -); shift 2
    case $doing in
    "$lane")
        begun=$(date +%s)
        "$@" </dev/null >"$log" 2>&1
        echo $? >"$log.new" && mv "$log.new" "$log.status"
        echo "lane $lane, $(($(date +%s) - begun)) s: $name" >>"$durations" ;;
    telling)
        echo "== $name"
        while [ ! -e "$log.status" ] && [ ! -e "$logs/lane-$lane.ended" ]; do sleep 1; done
        cat "$log"
        counts=$(sed -n -e 's/^\([0-9][0-9]*\) passed, \([0-9][0-9]*\) failed$/\1 \2/p' \
            -e 's/^.*test cases: *[0-9]* | *\([0-9]*\) passed | *\([0-9]*\) failed.*/\1 \2/p' "$log" |
            awk '{ p += $1; f += $2 } END { print p + 0, f + 0 }')
        p=${counts% *} f=${counts#* }
        if [ "$f" = 0 ] && { [ "$(cat "$log.status")" != 0 ] || [ "$p" = 0 ]; }; then
            echo "this step failed"
            f=1
        fi
        passed=$((passed + p)) failed=$((failed + f)) ;;
    esac
}
compile_and_run() {   # program, compiler with flags...
    program=$1; shift
    "$@" -o "$program" && "$program"
}
strict="-pedantic -Wall -Wextra -Werror -Iinclude"

stands_alone() { sh tests/check_link.sh "$BUILD" && sh tests/cortex.sh "$BUILD"; }
steps() {
    step 2 "C++ tests" "$BUILD/tests"
    step 2 "sentences of refusals" sh tests/refusals.sh
    step 2 "random problems" sh tests/fuzz/quick.sh "$BUILD"
    step 2 "the library stands alone" stands_alone
    step 2 "headers in C and C++" sh tests/headers.sh "$BUILD"
    step 2 "used from C" compile_and_run "$BUILD/use" $CC -std=c99 $strict $CFLAGS tests/use.c tests/traps.c \
        "$BUILD/libharmorph.a" -lm
    step 1 "one file" sh tests/amalgamation.sh "$BUILD"
    step 1 "binary interface" sh tests/abi/run.sh "$BUILD" quick
    step 1 "distribution" sh tests/dist.sh "$BUILD"
    step 1 "installation" sh tests/install.sh "$BUILD"
    step 1 "folders with odd names" sh tests/odd_paths.sh "$BUILD"
    step 1 "examples" sh tests/examples.sh "$BUILD"
    step 1 "README" sh tests/readme.sh "$BUILD"
    step 2 "Fortran" sh tests/fortran.sh "$BUILD"
    step 1 "readers of SU2 files" sh tests/read_su2.sh "$BUILD"
    step 1 "MPI" sh tests/mpi.sh "$BUILD"
    if pkg-config --exists petsc; then step 1 "PETSc" sh tests/petsc.sh "$BUILD"
    elif [ $doing = telling ]; then echo "== PETSc: not installed (Debian's petsc-dev), its tests are SKIPPED"; fi
    if $PYTHON -c 'import numpy, cffi, pytest, setuptools, wheel, venv, ensurepip' 2>/dev/null; then
        step 2 "Python" sh tests/python.sh "$BUILD"
        step 2 "given displacements on meshes" env MESHES="$MESHES" sh tests/measure/given/run.sh "$BUILD"
    elif [ $doing = telling ]; then
        echo "== Python: $PYTHON lacks numpy, cffi, pytest, setuptools, wheel or venv: its tests are SKIPPED"
    fi
    if $PYTHON -c 'import sphinx, myst_parser' 2>/dev/null; then step 2 "browsable manual" sh tests/html.sh "$BUILD"
    elif [ $doing = telling ]; then
        echo "== browsable manual: python3-sphinx or python3-myst-parser is not installed, its tests are SKIPPED"
    fi
    without=
    for tool in clang++ wasm-ld node npm; do command -v $tool >/dev/null || without="$without $tool"; done
    if [ -z "$without" ]; then step 1 "package for npm" sh tests/web.sh "$BUILD"
    elif [ $doing = telling ]; then
        echo "== package for npm: not installed:$without (Debian's clang, lld, nodejs, npm), its tests are SKIPPED"
    fi
    step 2 "program" sh tests/cli/run.sh "$BUILD/harmorph" "$BUILD/meshes" "$BUILD/cli"
    step 2 "faults of files" sh tests/faults.sh "$BUILD/harmorph" "$BUILD/meshes" "$BUILD/faults"
    step 1 "mesh files" env CXX="$CXX" sh tests/formats.sh "$BUILD/harmorph" "$BUILD/formats"
    step 2 "moved shapes" sh tests/airfoils.sh "$BUILD/harmorph" "$BUILD/meshes" "$BUILD/airfoils-test"
    step 2 "pictures of the program" sh tests/pictures.sh "$BUILD/harmorph" "$BUILD/meshes" "$BUILD/pictures-test"
    step 1 "page of the program" sh tests/page.sh "$BUILD/harmorph" "$BUILD/meshes" "$BUILD/page-test"
    step 1 "workbench" sh tests/workbench.sh "$BUILD/harmorph" "$BUILD/meshes" "$BUILD/workbench-test" "$BUILD"
    step 2 "page of figures" sh tests/figures_test.sh "$BUILD/figures-test" "$BUILD"
    step 2 "includes point downwards" sh tests/includes.sh
    step 1 "benchmarks compile" sh tests/benchmarks.sh "$BUILD"
    step 2 "checks of clang-tidy" sh tests/tidy.sh
}

# Programs first, by all jobs.
$MAKE -s JOBS="$JOBS" BUILD="$BUILD" CXX="$CXX" CXXFLAGS="$CXXFLAGS" LDFLAGS="$LDFLAGS" test-programs || {
    echo "0 passed, 1 failed"
    exit 1
}
rm -rf "$logs" "$durations" && mkdir -p "$logs" || exit 1
trap 'kill 0' INT
for lane in 1 2; do
    { (doing=$lane; steps); : >"$logs/lane-$lane.ended"; } &
    if [ "$JOBS" = 1 ]; then wait; fi
done
doing=telling
steps
rm -rf "$logs"
echo "$passed passed, $failed failed"
[ $failed = 0 ]
