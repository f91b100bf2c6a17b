#!/bin/sh
# usage: run.sh BUILD   Displacements given point by point on the shipped meshes, and on those of MESHES; given.py says
# what MESHES, SEEDS, GMSH and FIRST are.
build=${1:?usage: run.sh BUILD}
mkdir -p "$build/given"
exec sh tests/measure/python.sh "$build" tests/measure/given/given.py "$build/given" $MESHES
