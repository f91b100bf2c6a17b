#!/bin/sh
# usage: check_link.sh BUILD   (CC, CFLAGS from the environment)
# The library stands alone: merged into one object, it needs only mem* from outside, keeps no writable data, shows
# only hm_*; a small program links a small part; and the C compiler, which knows no C++ runtime,
# links a program with it.
build=$1
: "${CC:=cc}" "${CFLAGS:=-O2}"
topic=check-link
. "$(dirname "$0")/../count.sh"
for tool in ld nm objdump size; do
    command -v $tool >/dev/null || { echo "$tool not found: install Debian's binutils"; exit 1; }
done
command -v "${CC%% *}" >/dev/null || { echo "$CC not found: install Debian's gcc"; exit 1; }

merged=$build/merged.o
ld -r -o "$merged" --whole-archive "$build/libharmorph.a" || exit 1   # merged, only foreign symbols stay undefined
is_empty "symbols needed from outside" \
    "$(nm -u "$merged" | awk '{ print $NF }' | grep -vE '^(memcpy|memmove|memset|memcmp|_GLOBAL_OFFSET_TABLE_)$')"
# Constant tables of pointers lie in .data.rel.ro, which the loader makes read-only: they are no writable data.
objdump -t "$merged" >"$build/symbols"
is_empty "writable data" \
    "$(grep -E '[ 	](\.t?(data|bss)|\*COM\*)[. 	]' "$build/symbols" | grep -vE '\.data\.rel\.ro| d[ 	]' |
        awk '{ print $NF }')"
# Whatever fills .data, also what no symbol names, such as the image of a struct that a function copies.
is_empty "bytes in .data" "$(size -A "$merged" | awk '$1 == ".data" && $2 > 0 { print $2 }')"
is_empty "sections that run code before main" \
    "$(size -A "$merged" | awk '$1 ~ /^\.(init_array|ctors)/ && $2 > 0 { print $1 }')"
is_empty "visible names without hm_" \
    "$(grep -E '^[0-9a-f]+ [gu]' "$build/symbols" | grep -v '\.hidden' | awk '{ print $NF }' | grep -v '^hm_')"
if $CC -std=c99 -pedantic $CFLAGS -Iinclude -o "$build/use" tests/c_api/use.c "$build/libharmorph.a"; then
    ok
else
    fail "tests/c_api/use.c does not link with $CC"
fi
# A program that attaches a basis, morphs and takes the adjoint links this much of the library; engines stay outside.
# g++ 12 makes 78 000 bytes at -O2; later compilers copy more functions into their callers.
most=86016
$CC -std=c99 $CFLAGS -Iinclude -c -o "$build/small.o" tests/c_api/small.c && ld -r -o "$build/small_linked.o" \
    "$build/small.o" \
    "$build/libharmorph.a" || exit 1
bytes=$(size "$build/small_linked.o" | awk 'NR == 2 { print $1 + $2 + $3 }')
is_empty "bytes in a program that morphs, of at most $most" "$([ "$bytes" -le $most ] || echo "$bytes")"
finish
