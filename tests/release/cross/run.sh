#!/bin/sh
# usage: run.sh BUILD   (called by `make cross`; CC, JOBS from the environment)
# Other processors and systems by Debian's cross compilers and emulators. The library is the amalgamation.
#   checksums  bit by bit those of fits, bases, morphs and safe morphs here, with the baseline kernel; a basis of this
#              machine is attached there, or refused by name where the order of bytes is another
#   tests      the C tests and a part of the unit tests
#   demo       the program: `harmorph demo`, and `harmorph check` of the mesh that it leaves
# PARTS="checksums tests" and TARGETS="s390x musl" choose. What is not installed is skipped aloud.
: "${CC:=cc}" "${JOBS:=2}" "${TARGETS:=aarch64 armhf riscv64 s390x i386 mingw-w64 musl}"
: "${PARTS:=checksums tests demo}"
build=$(cd "$1" && pwd)
dir=$build/cross
topic=cross log=$dir/log
. "$(dirname "$0")/../../count.sh"
units="tests/base/test_arena.cpp tests/base/test_elementary.cpp tests/base/test_fixed_sum.cpp
    tests/base/test_predicates.cpp tests/base/test_sort.cpp tests/simd/test_registers.cpp tests/basis/test_basis.cpp
    tests/basis/test_refused_bases.cpp tests/basis/test_single_precision.cpp
    tests/morph/test_adjoint.cpp tests/c_api/test_struct_size.cpp"
core="-std=c++17 -fno-exceptions -fno-rtti -fno-math-errno -fno-threadsafe-statics -fno-stack-protector
    -ffp-contract=off"
strict="-std=c99 -pedantic -Wall -Wextra -Werror -O2 -ffp-contract=off -Iinclude"
mkdir -p "$dir/include"
missing() { skip "$topic" "$1 is not installed (Debian: $2)"; }
same_sums() { "$@" | tr -d '\r' | diff "$dir/sums" -; }
refused_by_name() {
    "$@" >"$dir/said"
    cat "$dir/said"
    grep -q 'HM_BAD_BASIS: the basis was written on a machine with another byte order' "$dir/said"
}
same_use() { "$@" attach here.basis | tr -d '\r' | diff "$dir/use" -; }
c_tests() {   # where, emulator or nothing, compiler...
    where=$1 by=$2; shift 2
    for test in c_header use; do
        check "$test.c: compilation" "$@" $strict -o "$where/$test$suffix" tests/c_api/$test.c "$archive" -lm
        check "$test.c" $by "$where/$test$suffix"
    done
}

for folder in /usr/include /usr/local/include; do
    if [ -e "$folder/doctest/doctest.h" ]; then ln -sfn "$folder/doctest" "$dir/include/doctest"; fi
done
sh c_api/packaging/amalgamate.sh >"$dir/harmorph.cpp" && cp include/*.h "$dir/" || exit 1
archive=$build/libharmorph.a suffix= topic=here
$CC $strict -o "$dir/morphs" tests/release/cross/morphs.c "$archive" -lm && "$dir/morphs" >"$dir/sums" &&
    "$dir/morphs" save "$dir/here.basis" && "$dir/morphs" attach "$dir/here.basis" >"$dir/use" || exit 1
echo "$(wc -l <"$dir/sums") checksums, $(wc -c <"$dir/here.basis") bytes of basis"

on() {   # target, Debian's name of it, emulator, where that is found, flags
    topic=$1 triplet=$2 emulator=$3 package=$4 flags=$5 suffix=
    c=$triplet-gcc cxx=$triplet-g++
    case $topic in mingw-w64) c=$triplet-gcc-posix cxx=$triplet-g++-posix suffix=.exe ;; esac
    command -v $cxx >/dev/null || { missing $cxx "$package"; return; }
    command -v ${emulator%% *} >/dev/null || { missing "${emulator%% *}" "$package"; return; }
    here=$dir/$topic archive=$dir/$topic/libharmorph.a
    mkdir -p "$here" && cp "$dir/here.basis" "$here/" || exit 1
    before=$failed
    check "library" $cxx $flags $core -O2 -c -o "$here/harmorph.o" "$dir/harmorph.cpp"
    check "archive" $triplet-ar rcs "$archive" "$here/harmorph.o"
    if [ $failed != $before ]; then return; fi
    if wanted checksums; then checksums_there; fi
    if wanted tests; then tests_there; fi
    if wanted demo; then demo_there; fi
}
wanted() { case " $PARTS " in *" $1 "*) true ;; *) false ;; esac; }
compile() {   # flags; sources on standard input. Without optimisation: the library has it
    rm -rf "$here/objects" && mkdir -p "$here/objects" &&
        xargs -P "$JOBS" -I FILE sh -c 'to=$1 file=$2; shift 2; "$@" -c -o "$to/$(echo "$file" | tr / -).o" "$file"' \
            sh "$here/objects" FILE $cxx $flags -std=c++17 -O0 -ffp-contract=off "$@"
}
checksums_there() {
    check "checksums: compilation" $c $flags -static $strict -o "$here/morphs$suffix" \
        tests/release/cross/morphs.c "$archive" -lm
    check "checksums of fits, bases and morphs" same_sums $emulator "$here/morphs$suffix"
    cd "$here" || exit 1
    if [ $topic = s390x ]; then
        check "a basis of this machine is refused there" refused_by_name $emulator ./morphs attach here.basis
        check "a basis of that machine is written" $emulator ./morphs save there.basis
        check "a basis of that machine is refused here" refused_by_name "$dir/morphs" attach there.basis
    else
        check "a basis of this machine" same_use $emulator "./morphs$suffix"
    fi
    cd "$source" || exit 1
}
tests_there() {
    c_tests "$here" "$emulator" $c $flags -static
    ls $units tests/main.cpp >"$here/sources"   # no pipe: check would count in a shell of its own
    check "unit tests: compilation" compile -isystem "$dir/include" -Iinclude -Isrc -Ic_api -Itests <"$here/sources"
    check "unit tests: link" $cxx $flags -static -o "$here/tests$suffix" "$here"/objects/*.o "$archive"
    check "unit tests" $emulator "$here/tests$suffix"
}
program_sources() {   # in the groups of `make`
    ls c_api/cli/main.cpp c_api/cli/formats/cgns*.cpp "$build/page_text.cpp" \
        "$build/page_module.cpp" "$build/command_text.cpp"
    for object in $(cat "$build/objects/program.list"); do ls "${object%.o}.cpp" 2>/dev/null; done | grep _and_
}
demo_there() {
    program_sources >"$here/sources"
    set -- -pthread -I. -Iinclude -Ic_api/cli
    check "program: compilation" compile "$@" <"$here/sources"
    check "program: link" $cxx $flags -static -pthread -o "$here/harmorph$suffix" "$here"/objects/*.o "$archive"
    check "demo" $emulator "$here/harmorph$suffix" demo "$here/demo" --mesh "$build/meshes/naca0012.su2"
    check "the demo's mesh" $emulator "$here/harmorph$suffix" check "$here/demo/morphed.su2"
}
with_musl() {
    topic=musl
    command -v musl-gcc >/dev/null || { missing musl-gcc musl-tools; return; }
    mkdir -p "$dir/musl"
    c_tests "$dir/musl" "" musl-gcc -static
    check "checksums: compilation" musl-gcc -static $strict -o "$dir/musl/morphs" \
        tests/release/cross/morphs.c "$archive"
    check "checksums of fits, bases and morphs" same_sums "$dir/musl/morphs"
}
source=$(pwd)
export WINEDEBUG=-all WINEPREFIX="$dir/wine"
for name in $TARGETS; do
    case $name in
    aarch64) on $name aarch64-linux-gnu qemu-aarch64 "g++-aarch64-linux-gnu qemu-user" "" ;;
    armhf) on $name arm-linux-gnueabihf qemu-arm "g++-arm-linux-gnueabihf qemu-user" "-Wno-psabi" ;;
    riscv64) on $name riscv64-linux-gnu qemu-riscv64 "g++-riscv64-linux-gnu qemu-user" "" ;;
    s390x) on $name s390x-linux-gnu qemu-s390x "g++-s390x-linux-gnu qemu-user" "" ;;
    # Registers of the 8087 round to 64 bits or twice: the library refuses to be compiled for them.
    i386) on $name i686-linux-gnu qemu-i386 "g++-i686-linux-gnu qemu-user" "-msse2 -mfpmath=sse" ;;
    mingw-w64) on $name x86_64-w64-mingw32 wine "g++-mingw-w64-x86-64-posix wine wine64" "" ;;
    musl) archive=$build/libharmorph.a suffix=; with_musl ;;
    *) fail "there is no target $name" ;;
    esac
done
finish
