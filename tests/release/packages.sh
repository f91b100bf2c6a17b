#!/bin/sh
# usage: packages.sh BUILD   (MAKE, FC from the environment)
# The packages of c_api/packaging: the folder for fpm, compiled by the commands that fpm runs; the Debian packages,
# built from the tarball, judged by lintian, unpacked and used as the tests of the packages do (debian/tests).
: "${MAKE:=make}" "${FC:=gfortran}"
mkdir -p "$1"
build=$(cd "$1" && pwd)
dir=$build/packages
topic=packages log=$build/packages.log
. "$(dirname "$0")/../count.sh"
source=$(pwd)
version=$(sed -n 's/^#define HM_VERSION "\(.*\)"/\1/p' include/harmorph.h)
rm -rf "$dir"
mkdir -p "$dir/root" "$dir/tmp"

# fpm compiles each source into a folder, joins the objects to one library, and links by the Fortran compiler. Where fpm
# is installed, fpm does this itself.
by_fpm() (
    cd "$build/fpm" || exit 1
    mkdir -p build
    sed -n 's/^    export FPM_CXXFLAGS="\(.*\)"$/\1/p' README.md >build/flags
    [ -s build/flags ] || exit 1
    g++ $(cat build/flags) -Iinclude -c src/harmorph.cpp -o build/harmorph.cpp.o &&
        $FC -O1 -Jbuild -Ibuild -c src/harmorph.f90 -o build/harmorph.f90.o &&
        $FC -O1 -Jbuild -Ibuild -c src/harmorph77.f90 -o build/harmorph77.f90.o &&
        $FC -O1 -Jbuild -Ibuild -c src/read_su2.f90 -o build/read_su2.f90.o &&
        ar rcs build/libharmorph.a build/*.o && compiled morph && compiled unstructured &&
        build/morph | grep '^0 inverted cells' && build/unstructured naca0012.su2 | grep ' 0 inverted cells;'
)
compiled() {   # example
    $FC -O1 -Ibuild -c "example/$1.f90" -o build/example.o && $FC build/example.o build/libharmorph.a -o "build/$1"
}
by_fpm_itself() (   # the lines of its page
    cp -r "$build/fpm" "$dir/fpm" && cd "$dir/fpm" && rm -rf build &&
        sed -n 's/^    \(export\|fpm\) /\1 /p' README.md >lines && sh -e lines >said 2>&1 ||
        { tail -n 20 said; return 1; }
    grep '^0 inverted cells' said && grep ' 0 inverted cells;' said
)
check "make fpm" $MAKE -s BUILD="$build" fpm
check "the package for fpm: compiled, linked without the run-time library of C++, run" by_fpm
if command -v fpm >/dev/null; then check "the same by fpm, as its page says" by_fpm_itself
else skip "the package by fpm itself" "fpm is not installed"; fi

if command -v dpkg-buildpackage >/dev/null && command -v lintian >/dev/null &&
    dpkg-checkbuilddeps c_api/packaging/debian/control >"$log" 2>&1; then
    check "the Debian packages are built" sh c_api/packaging/debian.sh "$build"
    changes=$(ls "$build"/debian/harmorph_"$version"-*.changes 2>/dev/null)
    check "lintian finds neither errors nor warnings" lintian --allow-root --fail-on error,warning "$changes"
    for package in "$build"/debian/*.deb; do
        case $package in *-dbgsym_*) continue ;; esac
        check "unpacking $(basename "$package")" dpkg-deb -x "$package" "$dir/root"
    done
    check "the packages, unpacked, in C, C++, Fortran, Python and as a program" \
        env HARMORPH_ROOT="$dir/root" AUTOPKGTEST_TMP="$dir/tmp" sh c_api/packaging/debian/tests/morph
else
    skip "the Debian packages" "dpkg-buildpackage, lintian or a package is not installed: $(cat "$log")"
fi
finish "$dir"
