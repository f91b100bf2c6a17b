#!/bin/sh
# `make deform`: the driver, which make has built, over the shipped meshes, and over others (MESHES="FILE:MARKER ...") where
# they are given.
: "${BUILD:=build}"
meshes="tests/meshes/naca0012.su2:airfoil $MESHES"
exec "$BUILD/deform-driver" "$BUILD/deform" $meshes
