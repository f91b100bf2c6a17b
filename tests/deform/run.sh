#!/bin/sh
# `make deform`: builds the driver with the program's own objects and runs it over the shipped meshes, and over others
# (MESHES="FILE:MARKER ...") where they are given.
: "${BUILD:=build}" "${CXX:=c++}" "${CXXFLAGS:=-O3}"
set -e
out=$BUILD/deform
mkdir -p "$out"
objects=$(ls "$BUILD"/objects/cli/*.o | grep -v cli-main.o)
$CXX -std=c++17 -Wall -Wextra -Wconversion -Wshadow $CXXFLAGS -pthread -Ic_api -Ic_api/cli -o "$out/deform" tests/deform/deform.cpp \
    $objects "$BUILD/libharmorph.a" $LDFLAGS
meshes="tests/meshes/naca0012.su2:airfoil $MESHES"
"$out/deform" "$out" $meshes
