#!/bin/sh
# usage: compilers.sh BUILD   (called by `make compilers`)
# All compilers that are installed take the library without a warning, at each level of optimisation, and as C++20,
# which makes a difference before anything is optimised;
# the headers are C89 with long long, C99 and C11, also for small compilers; the Makefile and its scripts work with
# bmake and with busybox's shell and tools. LEVELS="-O2" and COMPILERS="g++-11 clang++-14" choose;
# LEVELS=-fsyntax-only is quick.
: "${LEVELS:=-O0 -O1 -O2 -O3}"
: "${COMPILERS:=g++-7 g++-8 g++-9 g++-10 g++-11 g++-12 g++-13 g++-14 clang++-13
    clang++-14 clang++-15 clang++-16 clang++-19 clang++-22}"
build=$(cd "$1" && pwd)
dir=$build/compilers
topic=compilers log=$dir/log
. "$(dirname "$0")/../count.sh"
silent() { said=$("$@" 2>&1) && [ -z "$said" ] && return; echo "$said"; return 1; }   # warns of nothing
missing() { skip "$1" "it is not installed"; }
rm -rf "$dir"
mkdir -p "$dir"
sh c_api/packaging/amalgamate.sh >"$dir/harmorph.cpp" && cp include/*.h "$dir/" || exit 1
for compiler in $COMPILERS; do
    command -v $compiler >/dev/null || { missing $compiler; continue; }
    for level in $LEVELS "-std=c++20 -fsyntax-only"; do
        check "$compiler $level" silent $compiler -std=c++17 $level -fno-exceptions -fno-rtti -fno-math-errno \
            -ffp-contract=off -Wall -Wextra -Wconversion -Werror -c -o "$dir/harmorph.o" "$dir/harmorph.cpp"
    done
done

for header in harmorph.h harmorph_pages.h harmorph_design.h; do
    printf '#include <%s>\n' $header >"$dir/header.c"
    for standard in "c89 -pedantic-errors -Wno-long-long" "c99 -pedantic-errors" "c11 -pedantic-errors"; do
        for compiler in gcc-11 gcc-12 clang-13 clang-14 clang-19; do
            command -v $compiler >/dev/null || continue
            # C89 has no keyword inline, which harmorph_pages.h needs.
            case "$standard $header" in c89*pages*) continue ;; esac
            check "$header, $compiler -std=$standard" silent $compiler -std=$standard -Wall -Wextra -Werror -Iinclude \
                -fsyntax-only "$dir/header.c"
        done
    done
    for compiler in tcc pcc; do
        command -v $compiler >/dev/null || { missing $compiler; continue; }
        check "$header, $compiler" silent $compiler -Iinclude -c -o "$dir/header.o" "$dir/header.c"
    done
done

# The rules of the Makefile, and the generators: what a minimal system has.
makes() { "$@" >"$dir/made" 2>&1 || cat "$dir/made"; }
same_rules() {   # up to the name of the folder, which also stands in names of objects
    make -s BUILD="$dir/gnu" rules && sed "s|compilers\([-/]\)$1|compilers\1gnu|g" "$dir/$1/rules.mk" |
        cmp - "$dir/gnu/rules.mk"
}
if command -v bmake >/dev/null; then
    check "bmake: rules" silent makes bmake -s BUILD="$dir/bmake" rules
    check "bmake: the same rules as make's" silent same_rules bmake
    check "bmake: the amalgamation" silent makes bmake -s BUILD="$dir/bmake" amalgamation
else
    missing bmake
fi
if command -v busybox >/dev/null; then
    mkdir -p "$dir/bin"
    for tool in $(busybox --list); do ln -sf "$(command -v busybox)" "$dir/bin/$tool"; done
    check "busybox: rules" silent makes env PATH="$dir/bin:$PATH" make -s SHELL="$dir/bin/sh" BUILD="$dir/busybox" rules
    check "busybox: the same rules" silent same_rules busybox
    check "busybox: the amalgamation" silent makes env PATH="$dir/bin:$PATH" make -s SHELL="$dir/bin/sh" \
        BUILD="$dir/busybox" amalgamation
    check "busybox: the same file" silent cmp "$dir/busybox/amalgamation/harmorph.cpp" "$dir/harmorph.cpp"
else
    missing busybox
fi
# flang 16 knows no components that are procedures.
for compiler in gfortran-11 gfortran-12 flang-new-19 flang-19 flang-22; do
    command -v $compiler >/dev/null || { missing $compiler; continue; }
    # flang warns of pointers to types without bind(c) from c_f_pointer, which Fortran 2018 allows.
    case $compiler in flang*) quiet=-w ;; *) quiet= ;; esac
    check "the Fortran module, $compiler" silent sh -c 'cd "$1" && $2 -c -o module.o "$3/harmorph.f90"' sh "$dir" \
        "$compiler $quiet" "$build"
done
finish "$dir"
