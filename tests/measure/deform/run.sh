#!/bin/sh
# `make deform`: the driver, which make has built, over the shipped meshes, and over others (MESHES="FILE:MARKER ...")
# where they are given; SEEDS random movements of each of them, of a channel's floor and of a cascade (20 unless said).
# Other methods stand beside harmorph in `make compare`.
: "${BUILD:=build}"
meshes="tests/meshes/naca0012.su2:airfoil $MESHES"
"$BUILD/deform-driver" "$BUILD/deform" $meshes || exit
exec "$BUILD/deform-seeded" "$BUILD/deform" "${SEEDS:-20}" $meshes
