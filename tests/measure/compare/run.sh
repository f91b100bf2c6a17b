#!/bin/sh
# `make compare`: methods that deform meshes, on the shipped meshes, on a generated one, and on others where these are
# given (MESHES="FILE:MARKER ..."): quality, validity, time for the set-up and for one movement, memory. It needs Eigen.
# The moving-mesh solvers of OpenFOAM stand beside harmorph's in `make test-openfoam`.
: "${BUILD:=build}" "${CXX:=c++}" "${CXXFLAGS:=-O3}"
if ! echo '#include <Eigen/Sparse>' | $CXX -I/usr/include/eigen3 -x c++ -E - >/dev/null 2>&1; then
    echo "the comparison with other methods is skipped: it needs Eigen (Debian's libeigen3-dev)"
    exit 0
fi
folder=$BUILD/compare
mkdir -p "$folder"
awk -f tests/measure/compare/o_mesh.awk >"$folder/joukowski.su2" || exit
objects=$(cat "$BUILD/objects/program.list")
$CXX -std=c++17 -Wall -Wextra $CXXFLAGS -pthread -Iinclude -Ic_api/cli -I/usr/include/eigen3 -o "$folder/methods" \
    tests/measure/compare/compare.cpp $objects "$BUILD/libharmorph.a" $LDFLAGS || exit
exec "$folder/methods" "$folder" tests/meshes/naca0012.su2:airfoil "$folder/joukowski.su2:airfoil" $MESHES
