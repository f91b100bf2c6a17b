#!/bin/sh
# usage: cortex.sh BUILD   (CC from the environment: the compiler of this machine)
# A bare Cortex-M7, where int32_t is long and pointers have 32 bits: the library compiles without a warning, and a
# program in 256 KiB of RAM attaches a basis that was solved here, morphs, takes the admissible step and the adjoint,
# with the same bits as here. ARM_CXX and ARM_EMULATOR say by which compiler and emulator.
: "${ARM_CXX:=arm-none-eabi-g++}" "${ARM_EMULATOR:=qemu-system-arm}" "${CC:=cc}"
build=$(cd "$1" && pwd)
dir=$build/cortex
topic=Cortex-M7 log=$dir/log
. "$(dirname "$0")/../count.sh"
strict="-std=c99 -pedantic -Wall -Wextra -Werror -ffp-contract=off -Iinclude"
rm -rf "$dir"
mkdir -p "$dir"
# Everywhere, as most machines have none of the compilers and emulators that use this program.
check "a basis solved here" $CC $strict -O2 -o "$dir/here" tests/release/cross/morphs.c "$build/libharmorph.a" -lm
check "saved" "$dir/here" save "$dir/basis"
check "attached here" "$dir/here" attach "$dir/basis"
cp "$dir/log" "$dir/expected"
probe='#include <cstring>
#include <cstdint>'
if ! echo "$probe" | $ARM_CXX -x c++ -fsyntax-only - 2>/dev/null; then
    skip "the bare processor" "$ARM_CXX is not installed"
    echo "    (Debian: gcc-arm-none-eabi, libstdc++-arm-none-eabi-dev, libnewlib-arm-none-eabi, qemu-system-arm)"
    finish "$dir"
    exit
fi
processor="-mcpu=cortex-m7 -mthumb -mfpu=fpv5-d16 -mfloat-abi=hard -ffreestanding -Os -ffp-contract=off
    -ffunction-sections -fdata-sections"
sh c_api/packaging/amalgamate.sh >"$dir/harmorph.cpp" && cp include/*.h "$dir/" || exit 1
check "the library" $ARM_CXX $processor -std=c++17 -fno-exceptions -fno-rtti -fno-threadsafe-statics -fno-math-errno \
    -Wall -Wextra -Wconversion -Werror -c -o "$dir/harmorph.o" "$dir/harmorph.cpp"
# A processor without atomic instructions, for which compilers would call a library: what shares out work among threads.
for file in src/direct/multifrontal.cpp src/ordering/nested_dissection.cpp; do
    check "$file for a Cortex-M0" $ARM_CXX -mcpu=cortex-m0 -mthumb -ffreestanding -O2 -ffp-contract=off -std=c++17 \
        -fno-exceptions -fno-rtti -fno-threadsafe-statics -fno-math-errno -Wall -Wextra -Wconversion -Werror \
        -Iinclude -Isrc -c \
        -o "$dir/m0.o" $file
    check "$file without calls for atomic operations" sh -c '! ${0%g++}nm -u "$1" | grep -e atomic -e sync' "$ARM_CXX" \
        "$dir/m0.o"
done
printf '.section .basis, "a"\n.balign 64\n.global basis_begin, basis_end\nbasis_begin: .incbin "%s"\nbasis_end:\n' \
    "$dir/basis" >"$dir/basis.S"
check "the program" $ARM_CXX $processor -x c -std=gnu99 -Wall -Wextra -Werror -Wno-missing-field-initializers \
    -Iinclude \
    -c -o "$dir/cortex.o" tests/release/cross/cortex.c
check "link" $ARM_CXX $processor -nostdlib -nostartfiles -T tests/release/cross/cortex.ld -Wl,--gc-sections \
    -o "$dir/cortex" "$dir/cortex.o" "$dir/basis.S" "$dir/harmorph.o" -lc -lgcc
if command -v "${ARM_EMULATOR%% *}" >/dev/null; then
    check "the program runs" timeout 120 $ARM_EMULATOR -M mps2-an500 -display none -monitor none -serial none \
        -semihosting-config enable=on,target=native -kernel "$dir/cortex"
    cp "$dir/log" "$dir/said"
    check "the same bits as here" sh -c 'head -n 1 "$0/said" | cmp - "$0/expected"' "$dir"
    sed -n 2p "$dir/said"
else
    skip "running" "${ARM_EMULATOR%% *} is not installed (Debian: qemu-system-arm)"
fi
size=${ARM_CXX%g++}size
if command -v $size >/dev/null; then
    $size -A "$dir/cortex" | awk '
        $1 == ".text" { print $2 " bytes of code and constants" }
        $1 == ".basis" { print $2 " bytes of basis" }'
fi
finish "$dir"
