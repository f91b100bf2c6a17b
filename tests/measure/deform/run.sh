#!/bin/sh
# `make deform`: large movements of the shipped meshes, and of others (MESHES="FILE:MARKER ...") where they are given;
# SEEDS random movements of each of them, of a channel's floor and of a cascade (20 unless said). `make compare`
# compares harmorph with other methods.
: "${BUILD:=build}"
meshes="$BUILD/meshes/naca0012.su2:airfoil $MESHES"
sh tests/measure/python.sh "$BUILD" tests/measure/deform/deform.py "$BUILD/deform" $meshes || exit
exec "$BUILD/deform-seeded" "$BUILD/deform" "${SEEDS:-20}" $meshes
