#!/bin/sh
# usage: run.sh BUILD   Processor time of hm_improve in multiples of a solution, and the quality of the result,
# on generated meshes (SIZES points of KINDS) and on the shipped mesh; MESHES: on these, too, words FILE:MARKER.
: "${SIZES:=5000 20000 60000}" "${KINDS:=iso viscous triangles hybrid}"
exec sh tests/measure/python.sh "${1:?usage: run.sh BUILD}" tests/measure/improve/improve.py "$SIZES" "$KINDS" \
    "$1/meshes/naca0012.su2:airfoil" $MESHES
