#!/bin/sh
# usage: install.sh BUILD   (MAKE, CC, CXX, ... from the environment)
# `make install` into an empty place, and CMake's own build and installation: the same files, and a C program that finds
# them by pkg-config and by find_package. Then the installation is moved, found again, and taken away.
: "${MAKE:=make}" "${CXX:=c++}" "${CC:=cc}" "${CFLAGS:=-O2}"
build=$(cd "$1" && pwd)
source=$(pwd)
dir=$build/install
topic=installation log=$dir/log
. "$(dirname "$0")/../count.sh"
rm -rf "$dir"
mkdir -p "$dir/project" "$dir/later"
make_in() { $MAKE BUILD="$1" CXX="$CXX" CXXFLAGS="$CXXFLAGS" LDFLAGS="$LDFLAGS" "$2" DESTDIR="$3" PREFIX="$4"; }
# CMake's own makefiles must hear nothing of the make that runs the tests, nor of its flags.
cmake() { (unset MAKE MAKEFLAGS MFLAGS MAKELEVEL CXXFLAGS CFLAGS LDFLAGS; command cmake "$@"); }
listing() { (cd "$1" && find . -type f | sort); }

cat >"$dir/expected" <<END
./bin/harmorph
./include/harmorph.h
./include/harmorph_bases.h
./include/harmorph_design.h
./include/harmorph_fields.h
./include/harmorph_mpi.h
./include/harmorph_openmp.h
./include/harmorph_pages.h
./include/harmorph_petsc.h
./include/harmorph_pthreads.h
./include/harmorph_quality.h
./include/harmorph_space.h
./include/harmorph_study.h
./lib/cmake/harmorph/harmorphConfig.cmake
./lib/cmake/harmorph/harmorphConfigVersion.cmake
./lib/libharmorph.a
./lib/pkgconfig/harmorph.pc
END
for file in fortran/*.f90 harmorph.f90 harmorph77.f90 harmorph_mpi.f90 harmorph_petsc.f90 harmorph_mpi.c \
    harmorph_petsc.c read_su2.c read_su2.h naca0012.su2; do
    echo "./share/harmorph/$(basename "$file")"
done >"$dir/shared"
echo ./share/bash-completion/completions/harmorph >>"$dir/expected"
{
    cat "$dir/shared"
    for file in c_api/openfoam/*.[ch]pp c_api/openfoam/Makefile; do echo "./share/harmorph/openfoam/${file##*/}"; done
    for file in fortran/examples/code_saturne/*.[fpa]*; do echo "./share/harmorph/code_saturne/${file##*/}"; done
} | sort >>"$dir/expected"
rm "$dir/shared"
echo ./share/man/man1/harmorph.1 >>"$dir/expected"

cat >"$dir/project/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.16)
project(user C)
find_package(harmorph $(sed -n 's/^#define HM_VERSION "\(.*\)"/\1/p' include/harmorph.h) REQUIRED)
add_executable(use $source/tests/c_api/use.c)
target_link_libraries(use harmorph::harmorph)
END
by_pkg_config() {   # prefix
    flags=$(PKG_CONFIG_PATH=$1/lib/pkgconfig pkg-config --cflags --libs harmorph) &&
        $CC -std=c99 $CFLAGS -o "$dir/use" "$source/tests/c_api/use.c" $flags && "$dir/use"
}
by_find_package() {
    rm -rf "$dir/user" &&
        cmake -S "$dir/project" -B "$dir/user" -DCMAKE_PREFIX_PATH="$1" -DCMAKE_C_COMPILER="${CC%% *}" \
            -DCMAKE_C_FLAGS="$CFLAGS" &&
        cmake --build "$dir/user" && "$dir/user/use"
}
version_refused() {
    sed 's/(harmorph [^ ]*/(harmorph 99.0/' "$dir/project/CMakeLists.txt" >"$dir/later/CMakeLists.txt"
    ! cmake -S "$dir/later" -B "$dir/user" -DCMAKE_PREFIX_PATH="$1" -DCMAKE_C_COMPILER="${CC%% *}"
}
same_files() { listing "$1" | diff "$dir/expected" -; }
# Everybody may run the program, read the other files and enter the folders.
open_to_all() {
    (cd "$1" && find . -type d ! -perm 755 -o -type f ! -name harmorph ! -name '*.so.*' ! -perm 644 \
        -o -path ./bin/harmorph ! -perm 755) >"$dir/closed"
    cat "$dir/closed"
    test ! -s "$dir/closed"
}
nothing_left() { test -z "$(listing "$1")"; }
no_such_text() { ! grep -r "$1" "$2"; }

# A packager's way: staged under DESTDIR, of which no trace may stay.
check "make install with DESTDIR" make_in "$build" install "$dir/stage" /opt/harmorph
check "the list of files" same_files "$dir/stage/opt/harmorph"
check "modes of folders and files" open_to_all "$dir/stage/opt/harmorph"
check "no path of the staging place inside" no_such_text "$dir/stage" "$dir/stage/opt/harmorph/lib/pkgconfig"
check "make uninstall" make_in "$build" uninstall "$dir/stage" /opt/harmorph
check "nothing left after it" nothing_left "$dir/stage"

# A user's way, with a umask that lets nobody else read, then moved elsewhere.
with_umask() (umask "$1"; shift; "$@")
check "make install" with_umask 077 make_in "$build" install "" "$dir/first"
check "modes of folders and files, umask 077" open_to_all "$dir/first"
check "use by pkg-config" by_pkg_config "$dir/first"
mv "$dir/first" "$dir/moved"
check "use by pkg-config, moved" by_pkg_config "$dir/moved"
check "use by find_package, moved" by_find_package "$dir/moved"
check "a version to come is refused" version_refused "$dir/moved"

# The library alone, without program and Fortran sources.
check "make install-library" with_umask 027 make_in "$build" install-library "" "$dir/library"
check "modes of the library's folders and files" open_to_all "$dir/library"
check "use of the library alone by pkg-config" by_pkg_config "$dir/library"
check "use of the library alone by find_package" by_find_package "$dir/library"
check "neither program nor share" sh -c '[ "$(ls "$0" | tr "\n" " ")" = "include lib " ]' "$dir/library"

# CMake by itself, without optimisation and debugging information, to be quick. The module of pages, which CMake has
# from the Makefile, is linked of the objects of BUILD.
clang=$(command -v clang++)
if [ -n "$clang" ]; then
    mkdir -p "$dir/tools"
    # Without this folder in the path: a compiler cache that is called clang++ looks for clang++ there.
    printf '#!/bin/sh\nPATH=${PATH#"%s:"}\nexec sh "%s" "%s" "%s" "$@"\n' "$dir/tools" \
        "$source/tests/release/copy_objects.sh" "$build" "$clang" >"$dir/tools/clang++"
    chmod +x "$dir/tools/clang++"
fi
check "cmake configures" cmake -S . -B "$dir/cmake" -DBUILD_TESTING=OFF -DCMAKE_BUILD_TYPE=None \
    -DCMAKE_CXX_COMPILER="${CXX%% *}" -DCMAKE_C_COMPILER="${CC%% *}" -DCMAKE_INSTALL_LIBDIR=lib
with_tools() (PATH=$dir/tools:$PATH; "$@")
check "cmake builds" with_tools cmake --build "$dir/cmake" -j "${JOBS:-2}"
check "cmake installs" with_umask 077 cmake --install "$dir/cmake" --prefix "$dir/second"
check "modes of folders and files by cmake" open_to_all "$dir/second"
check "the list of files by cmake" same_files "$dir/second"
check "the same harmorph.f90 by cmake" cmp "$dir/moved/share/harmorph/harmorph.f90" \
    "$dir/second/share/harmorph/harmorph.f90"
check "use by pkg-config, by cmake" by_pkg_config "$dir/second"
check "use by find_package, by cmake" by_find_package "$dir/second"

# What no build has made is not removed.
mkdir -p "$dir/sources/room" "$dir/empty"
echo mine >"$dir/sources/room/file"
clean_refused() { ! $MAKE BUILD="$1" clean && test -s "$1/room/file"; }
check "make clean of a folder that is no build" clean_refused "$dir/sources"
for folder in . src src/ tests/fixtures; do
    check "make with BUILD=$folder" sh -c '! "$1" BUILD="$2" rules && test ! -e "$2/flags"' sh "$MAKE" "$folder"
done
check "make clean of an empty folder" $MAKE BUILD="$dir/empty" clean
check "make clean of no folder" $MAKE BUILD="$dir/empty" clean

finish "$dir"
