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
# The code in comments of the headers: lines that are indented by five spaces or more, one of which ends with ";".
# Each block goes to a file of its own, whose name is that of the header and the number of the first line.
blocks_of() {   # folder, headers...
    where=$1; shift
    awk -v where="$where" '
        FNR == 1 || !/^ \*     / { write() }
        /^ \*     / {
            if (text == "") name = FILENAME ":" FNR
            is_last = /\*\/ *$/
            line = $0
            sub(/^ \*     /, "", line)
            sub(/ *\*\/ *$/, "", line)
            if (line ~ /;$/) is_code = 1
            text = text (line == "..." ? "" : line) "\n"
            if (is_last) write()
        }
        function write() {
            gsub(/.*\//, "", name)
            if (is_code) printf "%s", text > where "/" name ".inc"
            text = ""
            is_code = 0
        }
        END { write() }' "$@"
}
mkdir -p "$dir/blocks"
blocks_of "$dir/blocks" include/*.h
compiles() {
    $CC -std=c99 $strict -Wno-unused -Wno-unknown-pragmas -DBLOCK="\"$1\"" -fsyntax-only tests/c_api/header_blocks.c
}
check "headers have code in comments" test "$(ls "$dir/blocks" | wc -l)" -ge 7
for block in "$dir"/blocks/*.inc; do check "the code at $(basename "$block" .inc)" compiles "$block"; done
old_call() {   # an example that is older than the call is found
    printf '/* As in:\n *\n *     hm_basis_init(&basis, block, bytes, analysis, &error);\n */\n' >"$dir/old.h"
    blocks_of "$dir" "$dir/old.h" && [ -s "$dir/old.h:3.inc" ] && ! compiles "$dir/old.h:3.inc"
}
check "code that does not compile is found" old_call
# The shortest use and what to ask before the mesh moves, as the head page of harmorph.h has them.
set -- $(ls "$dir"/blocks/harmorph.h:*.inc | sort -t : -k 2 -n)
cp "$1" "$dir/head_page.inc"
cp "$2" "$dir/head_page_before.inc"
check "the head page has the shortest use in 14 lines" sh -c '[ "$(wc -l <"$0")" -le 14 ]' "$1"
check "the head page" $CC -std=c99 $strict -I"$dir" -o "$dir/head_page" tests/c_api/head_page.c "$build/libharmorph.a" \
    -lm $LDFLAGS
check "the head page runs" "$dir/head_page"
# As the head page says, the library needs no other library.
cat >"$dir/alone.c" <<'END'
#include <harmorph.h>
int main(void) { return hm_setup_solve(NULL, NULL, NULL, NULL) < 0 ? 0 : 1; }
END
check "a program with the library alone" $CC -Iinclude -o "$dir/alone" "$dir/alone.c" "$build/libharmorph.a" $LDFLAGS
check "which runs" "$dir/alone"
headers=$(sed 's|^|include/|' fortran/harmorph/headers)
awk '/^typedef struct [a-z_]* \{/ { name = $3 } /^    uint64_t struct_size;/ { print name }' $headers |
    sort >"$dir/declared"
sed -n 's/^    BEGINS(\(hm_[a-z_]*\));$/\1/p' tests/c_api/c_header.c | sort >"$dir/begun"
check "every struct with a size is begun" sh -c '[ -s "$0/declared" ] && diff "$0/declared" "$0/begun"' "$dir"

finish "$dir"
