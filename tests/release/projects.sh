#!/bin/sh
# usage: projects.sh BUILD   (MAKE, CC, FC from the environment; after `make`)
# Projects of others that build harmorph from the tarball of `make dist`, by the lines of c_api/packaging/README.md:
# CMake with FetchContent, Meson with a subproject; and CMake with find_package from an installation. Each has one
# program in C and one in Fortran, those of README.
: "${MAKE:=make}" "${CC:=cc}" "${FC:=gfortran}"
build=$(cd "$1" && pwd)
source=$(pwd)
dir=$build/projects-test
topic=projects log=$dir/log
. "$(dirname "$0")/../count.sh"
rm -rf "$dir"
mkdir -p "$dir"
version=$(sed -n 's/^#define HM_VERSION "\(.*\)"/\1/p' include/harmorph.h)
block() {   # language, number: a fenced block of the page
    awk -v begin="\`\`\`$1" -v wanted="$2" '/^```/ && inside { inside = 0; next }
        $0 == begin { inside = 1; ++n; next } inside && n == wanted' "$source/c_api/packaging/README.md"
}
project() {   # name: a folder with the two programs
    mkdir -p "$dir/$1" && cp c_api/examples/morph.c fortran/examples/morph.f90 "$dir/$1"
}
both_run() {
    for program in morph_c morph_f; do
        "$1/$program" | grep "^0 inverted cells; the mesh could follow" || return 1
    done
}
in_cmake() {   # name, options
    name=$1; shift
    (unset MAKE MAKEFLAGS MFLAGS MAKELEVEL CXXFLAGS CFLAGS FFLAGS LDFLAGS
        cmake -S "$dir/$name" -B "$dir/$name/build" -DCMAKE_C_COMPILER="${CC%% *}" \
            -DCMAKE_Fortran_COMPILER="${FC%% *}" "$@" && cmake --build "$dir/$name/build" -j "${JOBS:-2}") &&
        both_run "$dir/$name/build"
}
check "make dist" $MAKE -s BUILD="$dir" dist
tarball=$dir/harmorph-$version.tar.gz

project fetched
cp "$tarball" "$dir/fetched/"
block cmake 1 | sed "s|VERSION.tar.gz|$version.tar.gz|" >"$dir/fetched/CMakeLists.txt"   # only this is to fill in
check "CMake, FetchContent" in_cmake fetched -DCMAKE_BUILD_TYPE=None
no_program() { ! find "$dir/fetched/build" -name harmorph -type f | grep .; }
check "CMake, FetchContent: the program of harmorph is not built" no_program

check "make install" $MAKE -s BUILD="$build" install PREFIX="$dir/prefix" DESTDIR=
project found
block cmake 2 >"$dir/found/CMakeLists.txt"
check "CMake, find_package" in_cmake found -DCMAKE_PREFIX_PATH="$dir/prefix"

if command -v meson >/dev/null && command -v ninja >/dev/null; then
    project wrapped
    mkdir -p "$dir/wrapped/subprojects/packagefiles"
    cp "$tarball" "$dir/wrapped/subprojects/packagefiles/"
    block meson 1 >"$dir/wrapped/meson.build"
    block ini 1 | sed "s|VERSION|$version|" >"$dir/wrapped/subprojects/harmorph.wrap"
    by_meson() (
        unset CXXFLAGS CFLAGS FFLAGS LDFLAGS
        cd "$dir/wrapped" && meson setup build -Dbuildtype=plain -Dharmorph:buildtype=plain &&
            ninja -C build -j "${JOBS:-2}" && both_run build
    )
    check "Meson, subproject" by_meson
    short() { [ "$(wc -l <c_api/packaging/meson.build)" -le 40 ]; }
    check "the file for Meson has at most 40 lines" short
else
    skip "Meson" "meson or ninja is not installed"
fi
finish "$dir"
