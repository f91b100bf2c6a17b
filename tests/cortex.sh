#!/bin/sh
# The core and the C interface compile for a bare Cortex-M7, where int32_t is long and pointers have 32 bits: without
# a warning. ARM_CXX says by which compiler.
: "${ARM_CXX:=arm-none-eabi-g++}"
passed=0 failed=0
probe='#include <cstring>
#include <cstdint>'
if ! echo "$probe" | $ARM_CXX -x c++ -fsyntax-only - 2>/dev/null; then
    echo "skipped: bare Cortex-M7, as $ARM_CXX is not installed"
    echo "    (Debian: gcc-arm-none-eabi, libstdc++-arm-none-eabi-dev)"
    exit 0
fi
for source in src/*/*.cpp c_api/*.cpp; do
    if said=$($ARM_CXX -std=c++17 -mcpu=cortex-m7 -mthumb -fno-exceptions -fno-rtti -fno-threadsafe-statics \
        -fsyntax-only -Wall -Wextra -Wconversion -Wshadow -Werror -Iinclude -Isrc -Ic_api "$source" 2>&1); then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "$source does not compile for Cortex-M7:"
        echo "$said" | head -n 5
    fi
done
echo "$passed passed, $failed failed"
[ $failed = 0 ]
