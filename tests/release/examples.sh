#!/bin/sh
# usage: examples.sh BUILD   (MAKE, CC, FC, ... from the environment)
# Each folder of examples, copied elsewhere: built and run against an installed harmorph, by its own Makefile with
# pkg-config and by CMake with find_package.
: "${MAKE:=make}" "${CXX:=c++}" "${CXXFLAGS=}" "${CC:=cc}" "${CFLAGS:=-O2}" "${FC:=gfortran}" "${FFLAGS:=-O2}"
build=$(cd "$1" && pwd)
dir=$build/examples
topic=examples log=$dir/log
. "$(dirname "$0")/../count.sh"
rm -rf "$dir"
mkdir -p "$dir"
# CMake's own makefiles must hear nothing of the make that runs the tests, nor of its flags.
cmake() { (unset MAKE MAKEFLAGS MFLAGS MAKELEVEL CXXFLAGS CFLAGS FFLAGS LDFLAGS; command cmake "$@"); }
by_make() {   # folder
    (cd "$dir/$1" && export PKG_CONFIG_PATH="$dir/prefix/lib/pkgconfig" &&
        $MAKE CC="$CC" CFLAGS="$CFLAGS" FC="$FC" FFLAGS="$FFLAGS" run)
}
by_cmake() {   # folder, target: for debugging, as what is optimised has run already
    cmake -S "$dir/$1" -B "$dir/$1-cmake" -DCMAKE_PREFIX_PATH="$dir/prefix" -DCMAKE_C_COMPILER="${CC%% *}" \
        -DCMAKE_Fortran_COMPILER="${FC%% *}" -DCMAKE_BUILD_TYPE=Debug && cmake --build "$dir/$1-cmake" --target "$2"
}
says() { grep -q "$1" "$log.kept"; }

check "make install" $MAKE BUILD="$build" CXX="$CXX" CXXFLAGS="$CXXFLAGS" LDFLAGS="$LDFLAGS" install DESTDIR= \
    PREFIX="$dir/prefix"
cp -r c_api/examples "$dir/c"
cp -r fortran/examples "$dir/fortran"
check "C, make run" by_make c
cp "$log" "$log.kept"
check "C: an area by adjoint steps" says "^0 inverted cells on the way"
check "C: a thousand steps of pitching" says "first mesh bit by bit, 3 of 3 times"
check "C: triangles in no order" says "^unstructured: sharp trailing edge, 0 inverted cells, smallest quality 0[.][3-9]"
check "C: a mesh one cell thick" says "^one cell thick: 0 inverted cells, 0 points"
check "C: a mesh from an SU2 file" says "^airfoil: [0-9]* points, 20 functions, 0 inverted cells"
check "C: a wall that moves as a file says" \
    says "^coupling: 40 steps, 132 points of the wall, quality of at least 0[.][1-9]"
check "Fortran, make run" by_make fortran
cp "$log" "$log.kept"
check "Fortran: a mesh from an SU2 file" \
    says "^unstructured: 1 curve(s) fit the airfoil to [0-9.]*E-05, 0 inverted cells"
check "Fortran: a mesh one cell thick" says "^one cell thick: 0 inverted cells, 0 points"
check "Fortran: gradients" says "gradient by mesh points: relative difference to finite differences *[0-9.]*E-0[6-9]"
check "Fortran: the target is found" says "pressure error: divided by [1-9][0-9][0-9]"
check "Fortran: an optimum with constraints" says "pressure error: divided by 3[.]8"
with_and_without() {   # two programs: with the mesh constraint, and without it
    [ "$(grep -c '^pressure error: divided by 1[.][2-9].*, margins' "$log.kept")" = 2 ] &&
        [ "$(grep -A 1 '^without the mesh constraint' "$log.kept" | grep -c '^the morph is refused')" = 2 ]
}
check "Fortran and C: a design loop with the mesh as a constraint; without it the morph is refused" with_and_without
check "Fortran: fluid-structure interaction, the same work on mesh, wall and in modes" \
    says "work on mesh, on the wall and in modes: largest relative difference *[0-9.]*E-1[2-6]"
check "Fortran: a valid mesh in each step" says "^valid in 200 steps"
check "Fortran: a picture" grep -q "</svg>" "$dir/fortran/inverse.svg"
lines=$(grep -c '!hm$' fortran/examples/inverse.f90)
check "Fortran: $lines lines touch harmorph, 30 at most" test "$lines" -le 30
lines=$(grep -c '!hm$' fortran/examples/design.f90)
check "Fortran: $lines lines of the design loop touch harmorph, 80 at most" test "$lines" -le 80
touches='hm_|HM_|error\)|(mesh|problem|values\[k\]|limit|gradients\[k\])[.]|curves->'
lines=$(grep -cE "$touches" fortran/examples/design_c.c)
check "C: $lines lines of the design loop touch harmorph, 80 at most" test "$lines" -le 80
check "C, CMake" by_cmake c run
check "Fortran, CMake" by_cmake fortran all
check "Fortran: a program that CMake has built" "$dir/fortran-cmake/morph"

finish "$dir"
