#!/bin/sh
# usage: run.sh BUILD   Processor time of hm_improve in multiples of a solution, and the quality of the result,
# on generated meshes (SIZES points of KINDS) and on the shipped mesh; MESHES: on these, too, words FILE:MARKER.
build=${1:?usage: run.sh BUILD}
: "${CXX:=c++}" "${CXXFLAGS:=-O2}" "${SIZES:=5000 20000 60000}" "${KINDS:=iso viscous unstructured hybrid}"
objects=$(cat "$build/objects/program.list")
$CXX -std=c++17 -Wall -Wextra $CXXFLAGS -pthread -Iinclude -Ic_api -Ic_api/cli -Itests -o "$build/improve" \
    tests/measure/improve/improve.cpp tests/measure/bench/cases.cpp $objects "$build/libharmorph.a" $LDFLAGS || exit
exec "$build/improve" "$SIZES" "$KINDS" tests/meshes/naca0012.su2:airfoil $MESHES
