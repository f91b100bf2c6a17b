#!/bin/sh
# usage: headers.sh BUILD   (CC, CXX, LDFLAGS from the environment)
# Each standard of C and C++ compiles the headers and HM_INIT of every struct without a warning, and the program finds
# the structs as other languages rely on them. c_header.c has every struct of these headers that begins with a size.
: "${CC:=cc}" "${CXX:=c++}" "${LDFLAGS=}"
build=$(cd "$1" && pwd)
dir=$build/headers
topic=headers log=$dir/log
. "$(dirname "$0")/../count.sh"
rm -rf "$dir"
mkdir -p "$dir"
strict="-pedantic -Wall -Wextra -Werror -Iinclude"
for standard in c89 c99 c11; do
    check "$standard" $CC -std=$standard $strict -o "$dir/$standard" tests/c_api/c_header.c "$build/libharmorph.a" \
        -lm $LDFLAGS
    check "$standard, structs" "$dir/$standard"
done
for standard in c++11 c++14 c++17 c++20; do
    check "$standard" $CXX -std=$standard $strict -o "$dir/$standard" -x c++ tests/c_api/c_header.c -x none \
        "$build/libharmorph.a" -lm $LDFLAGS
    check "$standard, structs" "$dir/$standard"
done
# The shortest use, as the head page of harmorph.h has it.
awk '/^ \* THE SHORTEST USE/ { page = 1 } /^ \* ORDER/ { exit } page && sub(/^ \*     /, "    ")' include/harmorph.h \
    >"$dir/head_page.inc"
lines=$(wc -l <"$dir/head_page.inc")
check "the head page has the shortest use in 12 lines" test "$lines" -ge 5 -a "$lines" -le 12
check "the shortest use" $CC -std=c99 $strict -Wno-missing-field-initializers -I"$dir" -o "$dir/head_page" \
    tests/c_api/head_page.c "$build/libharmorph.a" -lm $LDFLAGS
check "the shortest use runs" "$dir/head_page"
headers=$(sed 's|^|include/|' fortran/harmorph/headers)
awk '/^typedef struct [a-z_]* \{/ { name = $3 } /^    uint64_t struct_size;/ { print name }' $headers |
    sort >"$dir/declared"
sed -n 's/^    BEGINS(\(hm_[a-z_]*\));$/\1/p' tests/c_api/c_header.c | sort >"$dir/begun"
check "every struct with a size is begun" sh -c '[ -s "$0/declared" ] && diff "$0/declared" "$0/begun"' "$dir"

finish "$dir"
