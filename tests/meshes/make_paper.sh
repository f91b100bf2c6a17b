#!/bin/sh
# The meshes of the paper's cases, of harmonic coordinates, of a three-element airfoil and of a cascade from their .geo
# files, by gmsh; coordinates are rounded to ten digits, so that its versions differ less.
# Usage: sh tests/meshes/make_paper.sh
cd "$(dirname "$0")" || exit 1
for name in two_bodies diffuser_airfoil axisymmetric_diffuser cage three_element cascade; do
    gmsh -2 -v 2 -format su2 -o $name.tmp.su2 $name.geo || exit 1
    awk '/^[A-Z]/ { inside = $1; print; next }
        inside == "NELEM=" { $NF = ""; sub(/ $/, ""); print; next }   # without its own number
        inside == "NPOIN=" { printf "%.10g %.10g\n", $1, $2; next }
        { $1 = $1; print }' $name.tmp.su2 >$name.su2
    rm $name.tmp.su2
done
