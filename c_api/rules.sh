#!/bin/sh
# usage: rules.sh BUILD   (called by `make rules`, with LEVEL, LOOPS, CALLS, UNITS, FLAGS and so on in the environment)
# Writes what is joined from sources, and BUILD/rules.mk, the rules of all objects and programs: POSIX make has no rules
# that lead from one directory to another, and new files shall need no edit. Objects depend on all headers of their
# part, and on a file that changes when compiler or flags do.
#
# Each file of the library is an object of its own, so that a program links what it calls. Files of the program and of
# the tests are compiled in groups: the headers that they share, which take most of the time, are read once a group.
# BUILD/objects/program.list and tests.list, for scripts that link objects to something else, have those of the program
# without main, and those of the tests.
set -e
build=$1
in_program=100 in_tests=6   # files a group

# put FILE COMMAND...: what it writes takes its place in BUILD at once, if it is another text: several makes may run
# beside each other.
put() (
    file=$build/$1; shift
    ("$@") >"$file.$$" || { rm -f "$file.$$"; exit 1; }
    cmp -s "$file.$$" "$file" || mv -f "$file.$$" "$file"
    rm -f "$file.$$"
)
for module in harmorph harmorph77 harmorph_mpi; do put $module.f90 sh fortran/join.sh $module; done
for part in mpi petsc; do put harmorph_$part.c sh c_api/join.sh $part; done
put page_text.cpp sh c_api/cli/page/embed.sh
put flags echo "$LEVEL $LEVEL_OF_LOOPS $LOOPS $LEVEL_OF_CALLS $CALLS $FLAGS"

some() { echo $(ls "$@" 2>/dev/null); }

loops=" $(echo $LOOPS) " calls=" $(echo $CALLS) "   # the files that these patterns name

# object PART DEPENDENCIES SOURCE: its rule; adds the object, src-mesh-edges.o of src/mesh/edges.cpp, to $list.
object() {
    level=$LEVEL
    case $loops in *" $3 "*) level=$LEVEL_OF_LOOPS ;; esac
    case $calls in *" $3 "*) level=$LEVEL_OF_CALLS ;; esac
    case $3 in $build/objects/cli/*) level=$LEVEL_OF_CALLS ;; esac
    name=${3%.cpp} name=${name#$build/} name=${name#objects/$1/}
    name=$build/objects/$1/$(IFS=/; set -- $name; IFS=-; echo "$*").o
    printf '%s: %s %s %s/flags\n\techo $(CXX) %s\n\t$(CXX) %s $(CXXFLAGS) %s -c -o $@ %s\n' \
        "$name" "$3" "$2" "$build" "$3" "$level" "$flags" "$3"
    list="$list $name"
}
objects() { part=$1 needs=$2; shift 2; for source do object $part "$needs" $source; done; }

# groups PART DEPENDENCIES SIZE HOW SOURCE...: one object for each SIZE sources, joined by HOW.
groups() {
    part=$1 needs=$2 size=$3 how=$4; shift 4
    while [ $# -gt 0 ]; do
        members= number=0 first=$(basename $1 .cpp)
        while [ $# -gt 0 ] && [ $number -lt $size ]; do members="$members $1" number=$((number + 1)); shift; done
        put objects/$part/${first}_and_$((number - 1)).cpp $how $members
        object $part "$needs$members" $build/objects/$part/${first}_and_$((number - 1)).cpp
    done
}
in_turn() { for file do echo "#include \"$file\""; done; }
# Each in a namespace of its own, as tests use the same names for different things; what they include stands before.
# Macros know no namespaces: files that define some are compiled alone.
apart() {
    grep -h '^#include' "$@" | sort -u
    for file do printf 'namespace %s {\n#include "%s"\n}\n' $(echo ${file%.cpp} | tr / _) $file; done
}

program() {
    printf '%s/%s:%s %s/libharmorph.a %s/rules.mk\n\techo $(CXX) $@\n' $build $1 "$list" $build $build
    printf '\t$(CXX) $(CXXFLAGS) -pthread -o $@%s %s/libharmorph.a $(LDFLAGS) $(CGNS:1=-lcgns)\n' "$list" $build
}

core=$(some include/harmorph/*/*.hpp src/*/*.hpp c_api/*.h c_api/*.hpp)
cli=$(some c_api/*.h c_api/cli/*.hpp c_api/cli/*/*.hpp)
unit="$core $(some tests/*.hpp tests/fixtures/*.hpp tests/deform/*.hpp)"
all_rules() {
    flags='$(CORE)' list=
    objects core "$core" src/*/*.cpp c_api/*.cpp
    printf '%s/libharmorph.a:%s\n\techo $(AR) $@\n\trm -f $@\n\t$(AR) rcs $@%s\n' $build "$list" "$list"

    flags='$(UNIT)' list=
    objects unit "$unit" tests/main.cpp $(grep -l '^#define' $UNITS)
    groups unit "$unit" $in_tests apart $(grep -L '^#define' $UNITS)
    program tests
    put objects/tests.list echo $list

    flags='$(CLI)' list=
    objects cli "$cli" $build/page_text.cpp
    groups cli "$cli" $in_program in_turn $(ls c_api/cli/*.cpp | grep -v /main.cpp)
    objects cli "$cli" c_api/cli/formats/cgns*.cpp
    groups cli "$cli" $in_program in_turn $(ls c_api/cli/formats/*.cpp c_api/cli/pictures/*.cpp | grep -v /cgns)
    parts=$list
    put objects/program.list echo $parts
    objects cli "$cli" c_api/cli/main.cpp
    program harmorph
    list=$parts
    objects cli "$cli $(some tests/deform/*.hpp)" tests/deform/deform.cpp
    program deform-driver
    list=$parts
    objects cli "$cli $(some tests/deform/*.hpp)" tests/deform/seeded.cpp
    program deform-seeded

    flags='$(UNIT) -Ic_api/cli' list=$parts
    objects fuzz "$core $cli $(some tests/fuzz/*.hpp)" tests/fuzz/*.cpp
    program fuzzer
}
put rules.mk all_rules
