#!/bin/sh
# usage: amalgamation.sh BUILD   (MAKE, CXX, CC, CFLAGS from the environment)
# `make amalgamation`: two files that need nothing else, compiled without a warning and without -I; a C program that
# links with them runs; they export what the library exports.
: "${MAKE:=make}" "${CXX:=c++}" "${CC:=cc}" "${CFLAGS:=-O2}"
build=$(cd "$1" && pwd)
source=$(pwd)
dir=$build/amalgamation-test
topic=amalgamation log=$dir/log
. "$(dirname "$0")/count.sh"
exported() { nm -g --defined-only "$1" | awk 'NF == 3 && $3 ~ /^_?hm_/ { print $3 }' | sort -u; }
same_names() {
    exported "$build/libharmorph.a" >"$dir/names" && [ -s "$dir/names" ] && exported harmorph.o | diff "$dir/names" -
}
rm -rf "$dir"
mkdir -p "$dir"
check "make amalgamation" $MAKE -s BUILD="$build" amalgamation
expected=$( (echo harmorph.cpp; cat fortran/harmorph/headers) | sort)
check "one source and the headers" [ "$(ls "$build/amalgamation")" = "$expected" ]
cp "$build/amalgamation/"* "$dir/" && cd "$dir" || exit 1
# Without optimisation: what the compiler takes is not its speed.
check "compilation" $CXX -std=c++17 -O0 -Wall -Wextra -Wconversion -Werror -fno-exceptions -fno-rtti -ffp-contract=off \
    -c harmorph.cpp
check "the names that it exports" same_names
check "a C program" $CC -std=c99 -pedantic $CFLAGS -I. -o use "$source/tests/use.c" harmorph.o -lm
check "the C program runs" ./use
finish "$dir"
