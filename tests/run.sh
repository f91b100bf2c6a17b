#!/bin/sh
# All tests (called by `make test`, which says with what compilers and where). Each step prints one or several lines
# "N passed, M failed", or is the doctest program; the sum is the last line. ONLY=NAME: the steps of one folder of
# tests, or of one script; a name that no step has is refused with the names that there are.
: "${MAKE:=make}" "${BUILD:=build}" "${CXX:=c++}" "${CXXFLAGS=}" "${CC:=cc}" "${CFLAGS:=-O2}" "${FC:=gfortran}" \
    "${JOBS:=2}" "${PYTHON:=/usr/bin/python3}" "${ONLY=}"
export MAKE BUILD CXX CXXFLAGS CC CFLAGS FC FFLAGS AR LDFLAGS PYTHON
passed=0 failed=0
logs=$BUILD/test-logs${ONLY:+-$ONLY} durations=$BUILD/test-durations${ONLY:+-$ONLY}

# Steps run in two lanes beside each other, which take about as long; those that call make in $BUILD are all in the
# first one. $durations tells how long each step took. The list of steps is gone through three times: each lane runs its
# own; the third time tells, in the order of the list, what they said, and adds up the counts. A step that fails without
# counting a failure, or counts nothing, is a failure. Before that it is gone through for the names that ONLY may have.
names_of() {   # command...: the folder of its script or source, and what the script is called, one a line
    for word; do
        case $word in tests/*) break ;; esac
    done
    echo "${word#tests/}" | sed 's|/run\.sh$||; s|\.sh$||; s|/[^/]*\.[a-z]*$||' | tr / '\n'
}
folders_of_units() { ls tests/*/test_*.cpp | cut -d/ -f2 | uniq; }
chosen() { [ -z "$ONLY" ] || names_of "$@" | grep -qxF -e "$ONLY"; }
step() {   # lane, name, command...
    lane=$1 name=$2 log=$logs/$(echo "$2" | tr ' ' -); shift 2
    if [ $doing != listing ] && ! chosen "$@"; then return; fi
    case $doing in
    listing) names_of "$@" ;;
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
absent() {   # name, what is missing, script: a step that cannot run here
    case $doing in
    listing) names_of "$3" ;;
    telling) if chosen "$3"; then echo "== $1: its tests are SKIPPED, as $2"; fi ;;
    esac
}
compile_and_run() {   # program, compiler with flags...
    program=$1; shift
    "$@" -o "$program" && "$program"
}
strict="-pedantic -Wall -Wextra -Werror -Iinclude"

stands_alone() { sh tests/release/check_link.sh "$BUILD" && sh tests/release/cortex.sh "$BUILD"; }
unit_tests() { "$BUILD/tests" ${ONLY:+"-sf=*tests/$ONLY/*"}; }
steps() {
    for folder in ${ONLY:-all}; do
        if [ $folder = all ] || folders_of_units | grep -qxF -e "$folder"; then
            step 2 "C++ tests" unit_tests "tests/$folder/test.cpp"
        fi
    done
    step 2 "sentences of refusals" sh tests/c_api/refusals.sh
    step 2 "random problems" sh tests/fuzz/quick.sh "$BUILD"
    step 2 "the library stands alone" stands_alone tests/release/check_link.sh
    step 2 "headers in C and C++" sh tests/c_api/headers.sh "$BUILD"
    step 2 "used from C" compile_and_run "$BUILD/use" $CC -std=c99 $strict $CFLAGS tests/c_api/use.c \
        tests/c_api/traps.c "$BUILD/libharmorph.a" -lm
    # Before any step makes something that the program contains: the other lane runs the program.
    step 1 "exit status of the tests" sh tests/only.sh "$BUILD"
    step 1 "one file" sh tests/release/amalgamation.sh "$BUILD"
    step 1 "binary interface" sh tests/release/abi/run.sh "$BUILD" quick
    step 1 "distribution" sh tests/release/dist.sh "$BUILD"
    step 1 "installation" sh tests/release/install.sh "$BUILD"
    step 1 "folders with odd names" sh tests/release/odd_paths.sh "$BUILD"
    step 1 "examples" sh tests/release/examples.sh "$BUILD"
    step 1 "README" sh tests/release/readme.sh "$BUILD"
    step 2 "Fortran" sh tests/fortran/run.sh "$BUILD"
    step 1 "readers of SU2 files" sh tests/fortran/read_su2.sh "$BUILD"
    step 1 "MPI" sh tests/hosts/mpi.sh "$BUILD"
    if pkg-config --exists petsc; then step 1 "PETSc" sh tests/hosts/petsc.sh "$BUILD"
    else absent PETSc "Debian's petsc-dev is not installed" tests/hosts/petsc.sh; fi
    if $PYTHON -c 'import numpy, cffi, pytest, setuptools, wheel, venv, ensurepip' 2>/dev/null; then
        step 2 "Python" sh tests/hosts/python.sh "$BUILD"
        step 2 "given displacements on meshes" env MESHES="$MESHES" SEEDS="${SEEDS:-1}" \
            sh tests/measure/given/run.sh "$BUILD"
    else
        lacks="$PYTHON lacks numpy, cffi, pytest, setuptools, wheel or venv"
        absent Python "$lacks" tests/hosts/python.sh
        absent "given displacements on meshes" "$lacks" tests/measure/given/run.sh
    fi
    if $PYTHON -c 'import sphinx, myst_parser' 2>/dev/null; then
        step 2 "browsable manual" sh tests/release/html.sh "$BUILD"
    else
        absent "browsable manual" "python3-sphinx or python3-myst-parser is not installed" tests/release/html.sh
    fi
    without=
    for tool in clang++ wasm-ld node npm; do command -v $tool >/dev/null || without="$without${without:+, }$tool"; done
    if [ -z "$without" ]; then step 1 "package for npm" sh tests/hosts/web.sh "$BUILD"
    else
        absent "package for npm" "$without (Debian's clang, lld, nodejs, npm) are not installed" tests/hosts/web.sh
    fi
    step 2 "program" sh tests/program/cli/run.sh "$BUILD/harmorph" "$BUILD/meshes" "$BUILD/cli"
    step 2 "faults of files" sh tests/program/faults.sh "$BUILD/harmorph" "$BUILD/meshes" "$BUILD/faults"
    step 1 "mesh files" env CXX="$CXX" sh tests/program/formats.sh "$BUILD/harmorph" "$BUILD/formats"
    step 2 "moved shapes" sh tests/program/airfoils.sh "$BUILD/harmorph" "$BUILD/meshes" "$BUILD/airfoils-test"
    step 2 "pictures of the program" sh tests/program/pictures.sh "$BUILD/harmorph" "$BUILD/meshes" \
        "$BUILD/pictures-test"
    step 2 "page of the program" sh tests/program/page.sh "$BUILD/harmorph" "$BUILD/meshes" "$BUILD/page-test"
    step 1 "workbench" sh tests/program/workbench.sh "$BUILD/harmorph" "$BUILD/meshes" "$BUILD/workbench-test" "$BUILD"
    step 2 "page of figures" sh tests/measure/figures_test.sh "$BUILD/figures-test" "$BUILD"
    step 2 "includes point downwards" sh tests/includes.sh
    step 1 "benchmarks compile" sh tests/measure/benchmarks.sh "$BUILD"
    case $(clang-tidy --version 2>/dev/null) in
    *"version 14."*) step 2 "checks of clang-tidy" sh tests/tidy.sh ;;
    *) absent "checks of clang-tidy" "clang-tidy of version 14 (Debian 12) is not installed" tests/tidy.sh ;;
    esac
}

programs=test-programs
if [ -n "$ONLY" ]; then
    names=$( (doing=listing; steps; folders_of_units) | sort -u)
    if ! echo "$names" | grep -qxF -e "$ONLY"; then
        echo "ONLY=$ONLY: there is no such folder or script of tests; there are: $(echo $names)"
        echo "0 passed, 1 failed"
        exit 1
    fi
    programs="all meshes fuzzer deform-seeded"
    if folders_of_units | grep -qxF -e "$ONLY"; then programs="$programs tests-only"; fi
fi
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

# Programs first, by all jobs.
$MAKE -s JOBS="$JOBS" BUILD="$BUILD" CXX="$CXX" CXXFLAGS="$CXXFLAGS" LDFLAGS="$LDFLAGS" $programs || {
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
wait   # a lane notes its end in $logs
rm -rf "$logs"
echo "$passed passed, $failed failed"
[ $failed = 0 ]
