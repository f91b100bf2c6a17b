#!/bin/sh
# usage: run.sh BUILD [quick]   (MAKE, CC, CXX from the environment; RELEASE: a tarball of `make dist`; BASE: a
# revision) The interface that programs are compiled against: calls, structs, constants as interface.txt
# has them; the shared library exports these calls, all of the version HARMORPH_ABI, and a C program runs with it.
# Without `quick` also abidiff against the last release: RELEASE, or BASE, or the last tag v*, of which the tarball is
# made from git's history.
: "${MAKE:=make}" "${CC:=cc}" "${CXX:=c++}" "${CFLAGS:=-O2}" "${RELEASE=}" "${BASE=}"
build=$(cd "$1" && pwd)
dir=$build/abi
topic="binary interface" log=$dir/log
. "$(dirname "$0")/../../count.sh"
rm -rf "$dir"
mkdir -p "$dir"
abi=$(sed -n 's/^#define HM_ABI \([0-9]*\).*/\1/p' include/harmorph.h)

same_interface() {
    sh tests/release/abi/describe.sh "$build/libharmorph.a" "$dir" >"$dir/interface.txt" &&
        diff tests/release/abi/interface.txt "$dir/interface.txt" && return
    echo "If this change is meant: where a program compiled with the old header would break, raise HM_ABI; then"
    echo "    sh tests/release/abi/describe.sh build/libharmorph.a build >tests/release/abi/interface.txt"
    return 1
}
# The calls for the modules of MPI and PETSc, which refuse a library of another version: here a change is free.
same_private() {
    sh tests/release/abi/describe.sh "$build/libharmorph.a" "$dir" private >"$dir/private.txt" &&
        diff tests/release/abi/private.txt "$dir/private.txt" && return
    echo "If this change is meant: sh tests/release/abi/describe.sh build/libharmorph.a build private" \
        ">tests/release/abi/private.txt"
    return 1
}
# What the compiler adds at the end of a struct has no value: a field that comes to stand there later would read that.
ends_with_a_field() {
    awk '/^struct / { name = $2; size = $3 }
        /^    [a-z_]+: / { if (name != "") end[name] = ($2 + 0) + $3 }
        /^struct / { size_of[name] = size }
        END {
            for (name in end) if (end[name] != size_of[name]) { print name " has a gap at its end"; bad = 1 }
            exit bad
        }' tests/release/abi/interface.txt
}
# Sizes and places are those of 64-bit pointers.
if [ "$(getconf LONG_BIT)" = 64 ]; then
    check "calls, structs and constants" same_interface
    check "calls for modules" same_private
fi
check "structs without a gap at their end" ends_with_a_field

shared=$build/shared/libharmorph.so.$abi
exports() { objdump -T "$shared" | awk '$NF ~ /^_?hm_/ { print $(NF - 1), $NF }' | sort; }
all_versioned() {
    sed -n "s/^symbol /HARMORPH_$abi /p" tests/release/abi/interface.txt tests/release/abi/private.txt |
        sort >"$dir/wanted"
    exports | diff "$dir/wanted" -
}
only_libc() { ! objdump -p "$shared" | awk '$1 == "NEEDED" { print $2 }' | grep -v '^libc\.'; }
runs_with_it() {
    $CC -std=c99 $CFLAGS -Iinclude -o "$dir/use" tests/c_api/use.c -L"$build/shared" -lharmorph &&
        objdump -p "$dir/use" | grep "NEEDED.*libharmorph.so.$abi" && LD_LIBRARY_PATH=$build/shared "$dir/use"
}
case $(uname -s) in
Linux)
    check "make shared" $MAKE -s BUILD="$build" CXX="$CXX" CXXFLAGS="$CXXFLAGS" CC="$CC" shared
    check "the shared library's name" sh -c 'objdump -p "$0" | grep -q "SONAME *libharmorph.so.$1\$"' "$shared" "$abi"
    check "exported calls and their version" all_versioned
    check "no library but C's is needed" only_libc
    check "a C program with the shared library" runs_with_it ;;
*) skip "the shared library" "it is for ELF systems" ;;
esac

# From the amalgamation with debugging information, of which abidiff reads the types.
describe() {   # where, which
    (cd "$1" && $MAKE -s BUILD="$dir/$2" amalgamation) &&
        $CXX -std=c++17 -O0 -g -fPIC -fvisibility=hidden -fno-exceptions -fno-rtti -shared -o "$dir/$2.so" \
            "$dir/$2/amalgamation/harmorph.cpp"
}
unpack() { mkdir -p "$dir/release" && tar xzf "$1" -C "$dir/release" --strip-components=1; }
if [ "${2-}" != quick ]; then
    if [ -z "$RELEASE" ]; then
        : "${BASE:=$(git tag --list 'v[0-9]*' --sort=-version:refname 2>/dev/null | head -n 1)}"
        if [ -n "$BASE" ] && git archive --format=tar.gz --prefix=release/ -o "$dir/release.tar.gz" "$BASE"; then
            RELEASE=$dir/release.tar.gz
        fi
    fi
    if [ -z "$RELEASE" ]; then
        skip abidiff "git has no tag v* here, and RELEASE= names no tarball"
    elif ! command -v abidiff >/dev/null; then
        skip abidiff "it is not installed (Debian: abigail-tools)"
    else
        check "unpacking $RELEASE" unpack "$RELEASE"
        check "the release" describe "$dir/release" old
        check "these sources" describe . new
        old=$(sed -n 's/^#define HM_ABI \([0-9]*\).*/\1/p' "$dir/release/include/harmorph.h")
        if [ "$old" = "$abi" ]; then
            # Bit 4 (value 8) of abidiff's exit code: changes that break programs. Added calls are none.
            check "abidiff: nothing that breaks programs" sh -c '"$@"; [ $(($? & 8)) = 0 ]' sh \
                abidiff "$dir/old.so" "$dir/new.so"
        else
            echo "HM_ABI is $old in the release and $abi here: the interface may change. What has changed:"
            abidiff "$dir/old.so" "$dir/new.so" | sed -n '1,3p'
            ok
        fi
    fi
fi
finish "$dir"
