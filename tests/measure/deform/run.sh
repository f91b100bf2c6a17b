#!/bin/sh
# `make deform`: the driver, which make has built, over the shipped meshes, and over others (MESHES="FILE:MARKER ...")
# where they are given; SEEDS random movements of each of them, of a channel's floor and of a cascade (20 unless said);
# and the comparison with other methods, which needs Eigen and is built here.
: "${BUILD:=build}" "${CXX:=c++}" "${CXXFLAGS:=-O3}"
meshes="tests/meshes/naca0012.su2:airfoil $MESHES"
"$BUILD/deform-driver" "$BUILD/deform" $meshes || exit
"$BUILD/deform-seeded" "$BUILD/deform" "${SEEDS:-20}" $meshes || exit
if ! echo '#include <Eigen/Sparse>' | $CXX -I/usr/include/eigen3 -x c++ -E - >/dev/null 2>&1; then
    echo "the comparison with other methods is skipped: it needs Eigen (Debian's libeigen3-dev)"
    exit 0
fi
objects=$(cat "$BUILD/objects/program.list")
$CXX -std=c++17 -Wall -Wextra $CXXFLAGS -pthread -Iinclude -Ic_api/cli -I/usr/include/eigen3 \
    -o "$BUILD/deform-compare" \
    tests/measure/deform/compare.cpp $objects "$BUILD/libharmorph.a" $LDFLAGS || exit
exec "$BUILD/deform-compare" "$BUILD/deform" $meshes
