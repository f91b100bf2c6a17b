#!/bin/sh
# usage: fortran.sh BUILD   (FC, FFLAGS, CC, CFLAGS from the environment)
# The Fortran module and the legacy calls: compiled without a warning and with all run-time checks, then with default
# integers and reals of 8 bytes, and with OpenMP; each time all tests run.
: "${FC:=gfortran}" "${FFLAGS:=-O2}" "${CC:=cc}" "${CFLAGS:=-O2}"
build=$(cd "${1:?usage: fortran.sh BUILD}" && pwd)
dir=$build/fortran
rm -rf "$dir"
mkdir -p "$dir"
passed=0 failed=0
strict=-std=f2018 loose= legacy= checks= long= openmp=
if $FC --version 2>/dev/null | grep -q '^GNU'; then
    strict="-std=f2018 -Wall -Wextra -Werror" legacy="-std=legacy -Wall -Wextra -Werror"
    loose=-Wno-conversion checks=-fcheck=all long="-fdefault-integer-8 -fdefault-real-8" openmp=-fopenmp
fi
check() {   # what, command...
    what=$1; shift
    if "$@" >"$dir/log" 2>&1; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "Fortran: $what failed:"
        sed 's/^/    /' "$dir/log"
    fi
}
quietly() { "$@" 2>&1 | tee "$dir/warnings"; test ! -s "$dir/warnings"; }
build_and_run() {   # where, flags...: its own modules and objects in each place
    place=$dir/$1; shift
    mkdir -p "$place"
    check "module with $*" quietly $FC $strict $FFLAGS "$@" -J"$place" -c "$build/harmorph.f90" -o "$place/harmorph.o"
    check "use.f90 with $*" quietly $FC $strict $loose $FFLAGS "$@" -J"$place" -c tests/use.f90 -o "$place/use.o"
    check "link with $*" $FC $FFLAGS "$@" "$place/use.o" "$place/harmorph.o" "$build/libharmorph.a" -o "$place/use"
    (cd "$place" && ./use) || failed=$((failed + 1))
}
stops() { ! "$dir/checked/use" "$1" >"$dir/out" 2>&1 && grep -q "$2" "$dir/out"; }

build_and_run checked $checks -g
for words in "refused the basis is empty: there is nothing to save" "assign_mesh a mesh cannot be assigned" \
    "assign_plan a plan cannot be assigned" \
    "assign_basis a basis cannot be assigned"; do
    check "stop: $words" stops "${words%% *}" "${words#* }"
done
if [ -n "$long" ]; then build_and_run long $long; fi
if [ -n "$openmp" ]; then build_and_run openmp $openmp; fi

check "layout.c" $CC -std=c99 -pedantic -Wall -Wextra -Werror -Ic_api $CFLAGS -c tests/layout.c -o "$dir/layout_c.o"
check "layout.f90" quietly $FC $strict $FFLAGS $checks -I"$dir/checked" -J"$dir" -c tests/layout.f90 -o "$dir/layout.o"
check "link of layout" $FC $FFLAGS "$dir/layout.o" "$dir/layout_c.o" "$dir/checked/harmorph.o" "$build/libharmorph.a" \
    -o "$dir/layout"
"$dir/layout" || failed=$((failed + 1))

# What the header has and the module has not: functions, then constants.
missing() {
    for name in $(sed -n 's/^HM_API .*[ *]\(hm_[a-z_]*\)(.*/\1/p' c_api/harmorph.h); do
        grep -q "name=\"$name\"" "$build/harmorph.f90" || echo "$name"
    done
    for name in $(sed -n '/^enum/,/};/p' c_api/harmorph.h | grep -o 'HM_[A-Z0-9_]* =' | tr A-Z a-z | cut -d ' ' -f 1); do
        grep -q "\b$name = " "$build/harmorph.f90" && grep -qi "PUT($name)" tests/layout.c || echo "$name"
    done
}
nothing_missing() { missing | tee "$dir/missing"; test ! -s "$dir/missing"; }
check "all of the header is in the module" nothing_missing

check "harmorph77.f90" quietly $FC $strict $FFLAGS $checks -I"$dir/checked" -J"$dir" -c fortran/harmorph77.f90 \
    -o "$dir/harmorph77.o"
check "legacy.f" $FC $legacy $FFLAGS $checks -c tests/legacy.f -o "$dir/legacy.o"
check "link of legacy" $FC $FFLAGS "$dir/legacy.o" "$dir/harmorph77.o" "$dir/checked/harmorph.o" "$build/libharmorph.a" \
    -o "$dir/legacy"
"$dir/legacy" || failed=$((failed + 1))

echo "$passed passed, $failed failed"
if [ $failed = 0 ]; then rm -rf "$dir"; fi
[ $failed = 0 ]
