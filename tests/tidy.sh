#!/bin/sh
# usage: tidy.sh [FILE...]
# clang-tidy 14 finds nothing in the core and the C interface, by the checks of .clang-tidy. All sources of a folder are
# one translation unit, so headers are read once: half a minute of processor time. Given FILEs are checked alone.
topic=tidy
. "$(dirname "$0")/count.sh"
case $(clang-tidy --version 2>/dev/null) in
*"version 14."*) ;;
*)
    skip "the checks of .clang-tidy" "clang-tidy of version 14 (Debian 12) is not installed"
    finish
    exit ;;
esac
unit=$(mktemp -d)
trap 'rm -rf "$unit"' EXIT
found() {   # what clang-tidy says of the files of the standard input, which include each other's headers
    sed "s|.*|#include \"$PWD/&\"|" >"$unit/all.cpp"
    tidied "$unit/all.cpp"
}
tidied() {
    clang-tidy --quiet --config-file=.clang-tidy --header-filter='/(src|c_api)/[^.]*\.[ch]pp' "$1" -- \
        -std=c++17 -fno-exceptions -fno-rtti -Wno-everything -Iinclude -Isrc -Ic_api 2>/dev/null |
        grep -E ': (warning|error): ' | sed "s|^$PWD/||"
}
if [ $# -gt 0 ]; then
    is_empty "$*" "$(printf '%s\n' "$@" | found)"
else
    is_empty src "$(ls src/*/*.cpp | found)"
    is_empty c_api "$(ls c_api/*.cpp | found)"
    # Where the checks were off, the above would pass, too.
    printf 'typedef int Number;\n' >"$unit/old.cpp"
    is_empty "a typedef" "$(tidied "$unit/old.cpp" | grep -q modernize-use-using || echo "is not found")"
fi
finish
