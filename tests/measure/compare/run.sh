#!/bin/sh
# `make compare`: methods that deform meshes, on the shipped meshes, on a generated one, and on others where these are
# given (MESHES="FILE:MARKER ..."): quality, validity, time for the set-up and for one movement, memory.
# Where OpenFOAM is installed, its solvers for moving meshes turn the airfoil of its tutorial.
: "${BUILD:=build}"
folder=$BUILD/compare
mkdir -p "$folder"
awk -f tests/measure/compare/o_mesh.awk >"$folder/joukowski.su2" &&
    sh tests/measure/python.sh "$BUILD" tests/measure/compare/compare.py "$folder" \
        "$BUILD/meshes/naca0012.su2:airfoil" "$folder/joukowski.su2:airfoil" $MESHES || exit
sh tests/measure/python.sh "$BUILD" tests/measure/compare/peers.py "$BUILD" || exit

# OpenFOAM's own solvers for moving meshes, and harmorph's where `make test-openfoam` has built it.
library=$BUILD/openfoam/library
cases=${FOAM_TUTORIALS:-/usr/share/doc/openfoam-examples/examples}/incompressible/simpleFoam/airFoil2D
if command -v moveDynamicMesh >/dev/null && [ -d "$cases" ]; then
    solvers="laplacian-inverseDistance laplacian-quadratic SBRStress-inverseDistance SBRStress-quadratic"
    if [ -f "$library/libharmorphMotionSolver.so" ]; then
        solvers="$solvers harmorph-one harmorph"
        LD_LIBRARY_PATH=$(cd "$library" && pwd)${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
        export LD_LIBRARY_PATH
    fi
    printf '\n== In OpenFOAM: the airfoil of its tutorial airFoil2D turns by 2 degrees a step, to 90 degrees\n\n'
    sh c_api/openfoam/tutorials/pitching.sh "$folder/openfoam" 2 90 $solvers |
        sed -n 's/^.* degrees without/ &/p'
else
    printf '\nOpenFOAM is not compared: it or its tutorials are not installed (Debian: openfoam, openfoam-examples)\n'
fi
