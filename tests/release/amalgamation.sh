#!/bin/sh
# usage: amalgamation.sh BUILD   (MAKE, CXX, CC, CFLAGS, LEVEL, WARNINGS from the environment)
# `make amalgamation`: one source and its headers, which need nothing else, compiled without a warning, without -I and
# with the level of optimisation LEVEL as the only flag beside that of the standard; a C program that links with it and
# -lm alone runs; it exports what the library exports.
: "${MAKE:=make}" "${CXX:=c++}" "${CC:=cc}" "${CFLAGS:=-O2}" "${LEVEL:=-O0}" \
    "${WARNINGS=-Wall -Wextra -Wconversion}"
build=$(cd "$1" && pwd)
source=$(pwd)
dir=$build/amalgamation-test
topic=amalgamation log=$dir/log
. "$(dirname "$0")/../count.sh"
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
# Warnings do not change the code. In `make test` without optimisation: what the compiler takes is not its speed.
check "compilation" $CXX -std=c++17 $LEVEL $WARNINGS -Werror -c harmorph.cpp
check "the names that it exports" same_names
check "a C program" $CC -std=c99 -pedantic $CFLAGS -I. -o use "$source/tests/c_api/use.c" harmorph.o -lm
check "the C program runs" ./use
# The lines of the page, with this object and these compilers.
page_lines() {
    { echo 'cc() { command $CC $CFLAGS "$@"; }'
      awk '/^\*\*One source/ { here = 1 } here && /^```/ { if (inside) exit; inside = 1; next } inside' \
        "$source/c_api/packaging/README.md" | sed '1,/^g++ -std=c++17 -O2 -c harmorph.cpp$/d
            s|^examples=.*|examples="$source/c_api/examples"|; s|-I$examples|-I"$examples"|
            s| $examples/\([a-z0-9_]*.c\)| "$examples/\1"|g; s|\.\./meshes|"$build/meshes"|'
    } >page.sh
    grep -q '^./su2 ' page.sh && . ./page.sh | grep '^airfoil: .* 0 inverted cells$'
}
if [ -e "$build/meshes/naca0012.su2" ]; then check "the lines of the page, on the mesh of the demo" page_lines; fi
finish "$dir"
