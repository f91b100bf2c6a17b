#!/bin/sh
# usage: rules.sh BUILD   (called by `make rules`, with UNITS and FLAGS in the environment)
# Writes the files that are joined from several sources, and BUILD/rules.mk, the rules of all objects and programs:
# POSIX make has no rules that lead from one directory to another, and a new source needs no edit. BUILD/depends.mk
# holds what the compiler has said of the headers that each object includes. All objects depend on BUILD/flags, which
# changes when the compiler or its flags do; those of the modules for WebAssembly on BUILD/web/flags.
#
# Each file of the library is an object of its own, so that a program links what it calls. Files of the program and of
# the tests are compiled in groups: headers that they share are read once a group.
# BUILD/objects/program.list and tests.list, for scripts that link objects to something else, have those of the program
# without main, with -lz where the program uses zlib, and those of the tests.
set -e
build=$1
in_program=15 in_tests=6   # files a group

# Where nothing has changed since the last time, nothing is to be done.
given="$FLAGS $WASM_FLAGS $LDFLAGS $ZLIB $UNITS"
if [ -e "$build/rules.stamp" ] && [ "$(cat "$build/rules.stamp")" = "$given" ] &&
    [ -z "$( { find Makefile include src c_api fortran tests -newer "$build/rules.stamp"
        find "$build/objects" -type f -newer "$build/rules.stamp"; } | head -n 1)" ]; then exit; fi
echo "$given" >"$build/rules.stamp.$$"

# put FILE COMMAND...: what it writes takes its place in BUILD at once, if it is another text: several makes may run
# beside each other.
put() (
    file=$build/$1; shift
    ("$@") >"$file.$$" || { rm -f "$file.$$"; exit 1; }
    cmp -s "$file.$$" "$file" || mv -f "$file.$$" "$file"
    rm -f "$file.$$"
)
for module in harmorph harmorph77 harmorph_mpi harmorph_petsc; do
    put $module.f90 sh fortran/join.sh $module
done
for part in mpi petsc; do put harmorph_$part.c sh c_api/packaging/join.sh $part; done
put page_text.cpp sh c_api/cli/page/embed.sh
put command_text.cpp sh c_api/cli/commands/embed.sh

# The module of pages, where clang and lld make one: otherwise the program has no pages, and says why.
makes_modules() {
    sh c_api/web/pack.sh tools && echo 'extern "C" int one() { return 1; }' |
        $WASM_CXX --target=wasm32 -msimd128 -mbulk-memory -nostdlib -Wl,--no-entry,--export=one -x c++ - \
            -o "$build/module.$$"
}
module=$build/web/page.wasm without_module=
if ! makes_modules >"$build/module.$$.log" 2>&1; then
    module= without_module="clang and lld (Debian's packages clang and lld)"
fi
rm -f "$build/module.$$"*
put page_reason echo "$without_module"

# Programs without zlib refuse compressed files, and say why: nobody needs to know of zlib before.
with_zlib= zlib=
if [ "$ZLIB" != 0 ]; then
    if echo '#include <zlib.h>
        int main() { return *zlibVersion() == 0; }' |
        $CXX -x c++ - -o "$build/zlib.$$" $LDFLAGS -lz >"$build/zlib.$$.log" 2>&1; then
        with_zlib=-DHARMORPH_ZLIB zlib=-lz
    elif [ "$ZLIB" = 1 ]; then
        echo "zlib is not installed (Debian's zlib1g-dev), but ZLIB=1 asks for it" >&2
        rm -f "$build/zlib.$$"*
        exit 1
    fi
    rm -f "$build/zlib.$$"*
fi
put flags echo "$FLAGS $with_zlib"
put web/node_flags echo "$NODE_FLAGS"
put web/flags echo "$WASM_FLAGS $(sed -n '/^module/,/^}/p' "$0")"

# object PART SOURCE: its rule; adds the object, src-mesh-mesh.o of src/mesh/mesh.cpp, to $list. $own: its level, and
# the flags of the user. The headers that the source includes stand in depends.mk once the object has been made.
object() {
    name=${2%.cpp} name=${name#$build/} name=${name#objects/$1/}
    name=$build/objects/$1/$(IFS=/; set -- $name; IFS=-; echo "$*").o
    printf '%s: %s %s\n\techo %s %s\n\t%s %s %s -MMD -MP -c -o $@ %s\n' \
        "$name" "$2" "$stamp" "$compiler" "$2" "$compiler" "$own" "$flags" "$2"
    list="$list $name"
}
objects() { part=$1; shift; for source do object $part $source; done; }

# groups PART SIZE HOW SOURCE...: one object for each SIZE sources, joined by HOW.
groups() {
    part=$1 size=$2 how=$3; shift 3
    while [ $# -gt 0 ]; do
        members= number=0 first=$(basename $1 .cpp) folder=$(basename $(dirname $1))
        while [ $# -gt 0 ] && [ $number -lt $size ]; do members="$members $1" number=$((number + 1)); shift; done
        group=${first}_and_$((number - 1))
        # Files of different folders may have the same name.
        case "$list " in *"/$group.o "*) group=${folder}_$group ;; esac
        put objects/$part/$group.cpp $how $members
        object $part $build/objects/$part/$group.cpp
    done
}
in_turn() { for file do echo "#include \"$file\""; done; }
# Tests use the same names for different things: each file is included in a namespace of its own, behind the headers of
# all files of the group. Macros are in no namespace: files that define some are compiled alone.
apart() {
    grep -h '^#include' "$@" | sort -u
    for file do printf 'namespace %s {\n#include "%s"\n}\n' $(echo ${file%.cpp} | tr / _) $file; done
}

program() {
    printf '%s/%s:%s %s/libharmorph.a %s/rules.mk\n\techo $(CXX) $@\n' $build $1 "$list" $build $build
    printf '\t$(CXX) $(CXXFLAGS) -pthread -o $@%s %s/libharmorph.a $(LDFLAGS) $(CGNS:1=-lcgns) %s\n' \
        "$list" $build $zlib
}

# The library as WebAssembly, in the folder web: NAME, flags. A page loads the module, so the module is compiled for
# size but for the kernels and the search for crossings, in which most of the time is spent; rooms that are used once,
# or not by most callers, are compiled for the smallest size. The module without simd128 is for old engines, and small.
kernels=$(grep -l '^#define HARMORPH_KERNELS' src/*/*.cpp)
others=$(grep -L '^#define HARMORPH_KERNELS' src/*/*.cpp c_api/*.cpp)
module() {
    flags="\$(WASM) $2" list= own=-Oz
    rare='^c_api/|^src/(basis|boundary|bspline|fields|multigrid|parts|plan|safe|space)/'
    rare="$rare|^src/mesh/(boundary|delaunay|division|locate|median_dual|orientation|pieces)"
    rare="$rare|^src/(base|morph/(adjoint|displacement|slip_projection)|ordering/(cut_coordinates|subtrees))"
    fast=$(echo "$kernels" | grep -vE "$rare"; ls src/morph/crossing.cpp)
    objects $1 $(printf '%s\n' $kernels $others | grep -E "$rare") c_api/web/module.cpp
    if [ -n "$2" ]; then own=-O2; fi
    objects $1 $fast
    if [ -n "$2" ]; then own=-Os; fi
    objects $1 $(printf '%s\n' $kernels $others | grep -vE "$rare" | grep -vxF "$fast")
    linked $1 exports
}
# linked NAME EXPORTS: the module NAME of the objects in $list.
linked() {
    printf '%s/web/%s.wasm:%s %s/web/%s %s/rules.mk\n\techo $(WASM_CXX) $@\n' $build $1 "$list" $build $2 $build
    printf '\t$(WASM_CXX) $(WASM_LINK) @%s/web/%s -o $@%s\n' $build $2 "$list"
}
# The module of pages: that with simd128, but with what pages call alone; and the text that the program has of it.
page_module() {
    linked page page_exports
    script=c_api/cli/page/module.sh reason=$build/page_reason
    printf '%s/page_module.cpp: %s %s %s\n' $build "$module" $script $reason
    printf '\tsh %s %s %s >$@.new\n\tmv -f $@.new $@\n' $script $reason "$module"
}
# The program for node, by emscripten, with the library of the module with simd128.
node_program() {
    library=$(echo "$list" | tr ' ' '\n' | grep -v web-module)
    compiler='$(EMXX)' own=-Oz flags='$(NODE)' list= stamp=$build/web/node_flags
    objects node $build/page_text.cpp $build/page_module.cpp $build/command_text.cpp c_api/cli/formats/cgns*.cpp
    objects node c_api/cli/main.cpp
    groups node $in_program in_turn $(ls c_api/cli/*/*.cpp | grep -v /cgns)
    printf '%s/web/program.js:%s %s c_api/web/program_before.js\n\techo $(EMXX) $@\n' $build "$list" "$(echo $library)"
    printf '\tNODE_PATH="$${NODE_PATH:-/usr/share/nodejs}" $(EMXX) $(NODE_LINK) -o $@%s %s\n' "$list" "$(echo $library)"
    printf '%s/web/workbench_program.js:%s %s\n\techo $(EMXX) $@\n' $build "$list" "$(echo $library)"
    printf '\tNODE_PATH="$${NODE_PATH:-/usr/share/nodejs}" $(EMXX) $(WORKBENCH_LINK) -o $@%s %s\n' \
        "$list" "$(echo $library)"
    parts=$(echo c_api/web/workbench/*)
    printf '%s/web/workbench.html: %s/web/workbench_program.js %s/meshes/naca0012.su2 %s\n' \
        $build $build $build "$parts"
    printf '\tsh c_api/web/workbench/join.sh %s >$@.new\n\tmv -f $@.new $@\n' $build
}
# What the scripts of the package, or of pages, call; other words, such as names of structs, are not there to be
# exported. A page calls a part of what the package has: page_calls names it.
exported() { grep -o 'hm_[a-z_]*' | sort -u | sed 's/^/-Wl,--export-if-defined=/'; }
exports() { cat c_api/web/package/*.js | exported; }
page_exports() { cat c_api/web/page_calls c_api/cli/page/*.js | exported; }
layout() {
    awk -f c_api/packaging/table.awk $(sed 's|^|include/|' fortran/harmorph/headers) | awk -f c_api/web/layout.awk
}
put web/layout.inc layout
put web/headers.inc sed 's/.*/#include "&"/' fortran/harmorph/headers
put web/exports exports
put web/page_exports page_exports

all_rules() {
    echo "WITH_ZLIB = $with_zlib"
    compiler='$(WASM_CXX)' stamp=$build/web/flags
    module harmorph ''
    module harmorph_simd128 -msimd128
    (page_module)
    node_program

    compiler='$(CXX)' stamp=$build/flags flags='$(CORE)' list=
    own='$(KERNEL_LEVEL) $(CXXFLAGS)'
    objects core $(echo "$kernels" | grep -vxF src/dense/dense.cpp)
    own='$(DENSE_LEVEL) $(CXXFLAGS)'
    objects core src/dense/dense.cpp
    own='$(LEVEL) $(CXXFLAGS)'
    objects core $others
    printf '%s/libharmorph.a:%s\n\techo $(AR) $@\n\trm -f $@\n\t$(AR) rcs $@%s\n' $build "$list" "$list"

    flags='$(UNIT)' own='$(CXXFLAGS)' list=
    objects unit tests/main.cpp $(grep -l '^#define' $UNITS)
    groups unit $in_tests apart $(grep -L '^#define' $UNITS)
    program tests
    put objects/tests.list echo $list

    list=
    flags='$(CLI)' own='$(PROGRAM_LEVEL) $(CXXFLAGS)'
    objects cli $build/page_text.cpp $build/page_module.cpp $build/command_text.cpp c_api/cli/formats/cgns*.cpp
    groups cli $in_program in_turn $(ls c_api/cli/*/*.cpp | grep -v /cgns)
    parts=$list
    put objects/program.list echo $parts $zlib
    objects cli c_api/cli/main.cpp
    program harmorph
    list=$parts
    objects cli tests/measure/deform/seeded.cpp
    program deform-seeded

    flags='$(UNIT) -Ic_api/cli' own='$(CXXFLAGS)' list=$parts
    objects fuzz tests/fuzz/*.cpp
    program fuzzer

    # The meshes of the demo, of the tests and of the paper's cases: a program makes all.
    flags='$(UNIT)' list=
    objects mesh tests/meshes/make_meshes.cpp
    printf '%s/make_meshes:%s\n\techo $(CXX) $@\n\t$(CXX) $(CXXFLAGS) -o $@%s $(LDFLAGS)\n' $build "$list" "$list"
    printf '%s/meshes/naca0012.su2: %s/make_meshes %s\n' $build $build "$(echo tests/meshes/*.curve)"
    printf '\tcp tests/meshes/*.curve %s/meshes/ && %s/make_meshes %s/meshes\n' $build $build $build
}
put rules.mk all_rules
put depends.mk find $build/objects -name '*.d' -exec cat {} +
mv -f "$build/rules.stamp.$$" "$build/rules.stamp"
