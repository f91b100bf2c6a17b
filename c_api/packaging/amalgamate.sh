#!/bin/sh
# usage: amalgamate.sh   (in the top directory)
# The library as one source file, on standard output, which includes its installed headers and needs nothing else.
# Headers stand where they are first included; files without `#pragma once` (kernels, of which each instruction set has
# its own) stand wherever they are included.
ls src/*/*.cpp c_api/*.cpp | awk '
function found(path,    line) {
    if ((getline line <path) < 0) return 0
    close(path)
    return 1
}
function folder(path) { sub("/[^/]*$", "", path); return path }
function path_of(name, from) {
    if (found(folder(from) "/" name)) return folder(from) "/" name
    if (found("include/" name)) return "include/" name
    if (found("src/" name)) return "src/" name
    if (found("c_api/" name)) return "c_api/" name
    print "amalgamate.sh: " from " includes " name ", which is not there" >"/dev/stderr"
    failed = 1
    exit 1
}
function include(name, from,    path) {
    if (name ~ /^harmorph(_[a-z]*)?\.h$/) return
    path = path_of(name, from)
    if (!(path in once)) put(path)
}
function put(path,    line, name) {
    print "\n// ---- " path " ----"
    while ((getline line <path) > 0) {
        if (line ~ /^#pragma once/) { once[path] = 1; continue }
        if (line ~ /^#define HARMORPH_KERNELS /) { kernels = line; gsub(/^[^"]*"|"[^"]*$/, "", kernels) }
        if (line ~ /^#include <harmorph[_a-z]*\.h>/) continue
        if (line ~ /^#include "/) {
            name = line
            gsub(/^[^"]*"|"[^"]*$/, "", name)
            include(name, path)
        } else if (line ~ /^#include HARMORPH_KERNELS/) {
            include(kernels, path)
        } else print line
    }
    close(path)
}
BEGIN {
    while ((getline line <"include/harmorph.h") > 0) if (line ~ /^#define HM_VERSION "/) version = line
    gsub(/^[^"]*"|"[^"]*$/, "", version)
    print "// harmorph " version ", the library in one file: C++17, needs only harmorph.h beside this file. " \
        "See harmorph.h."
    print "// Made by `make amalgamation`. MIT licence. Compile with -std=c++17 -O2, and better with"
    print "// -fno-math-errno -fno-exceptions -fno-rtti: then a C program needs no -lm either."
    while ((getline header <"fortran/harmorph/headers") > 0) print "#include \"" header "\""
    print "#if defined(__clang__)"
    print "#pragma clang fp contract(off)  // compilers agree on bits"
    print "#pragma clang diagnostic ignored \"-Wshadow\""
    print "#elif defined(__GNUC__)"
    print "#pragma GCC optimize (\"fp-contract=off\")"
    print "#pragma GCC diagnostic ignored \"-Wshadow\"  // names of files that know nothing of each other"
    print "#endif"
    # With exceptions, compilers end functions that are noexcept by calls of the run-time library of C++. The library
    # throws nothing, so that a program without this library lacks nothing.
    print "#if defined(__cpp_exceptions) && defined(__ELF__)"
    print "__asm__(\".weak __gxx_personality_v0, __cxa_begin_catch, _ZSt9terminatev\");"
    print "#endif"
}
{ put($0) }
END { exit failed }'
