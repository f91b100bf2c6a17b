#!/bin/sh
# usage: wheel.sh BUILD   (PYTHON, CXX, CXXFLAGS, HARMORPH_MESHES from the environment; after `make all meshes`)
# Writes the wheel of the Python package into BUILD/wheel, linked with the library of BUILD, and prints its name. The
# run-time library of C++ is inside, so that the file needs the C library, zlib and Python alone; in a build without
# debugging symbols. The mesh of the demo is inside, too. The dates in the file are always the same.
set -e
: "${PYTHON:=/usr/bin/python3}"
build=$(cd "$1" && pwd)
rm -rf "$build/wheel"
mkdir -p "$build/wheel"
cd c_api/python
HARMORPH_BUILD=$build/wheel/build HARMORPH_LIBRARY=$build/libharmorph.a SOURCE_DATE_EPOCH=946684800
HARMORPH_MESH=${HARMORPH_MESHES:-$build/meshes}/naca0012.su2
LDFLAGS="-static-libstdc++ -static-libgcc -s $LDFLAGS"
export HARMORPH_BUILD HARMORPH_LIBRARY HARMORPH_MESH SOURCE_DATE_EPOCH LDFLAGS
$PYTHON setup.py -q bdist_wheel --dist-dir "$build/wheel" >"$build/wheel/log" 2>&1 ||
    { cat "$build/wheel/log" >&2; exit 1; }
rm -rf "$build/wheel/build"
ls "$build"/wheel/*.whl
