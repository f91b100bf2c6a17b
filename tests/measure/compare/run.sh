#!/bin/sh
# `make compare`: methods that deform meshes, on the shipped meshes, on a generated one, and on others where these are
# given (MESHES="FILE:MARKER ..."): quality, validity, time for the set-up and for one movement, memory. It needs Eigen.
# Where OpenFOAM is installed, its solvers for moving meshes turn the airfoil of its tutorial.
: "${BUILD:=build}" "${CXX:=c++}" "${CXXFLAGS:=-O3}"
if ! echo '#include <Eigen/Sparse>' | $CXX -I/usr/include/eigen3 -x c++ -E - >/dev/null 2>&1; then
    echo "the comparison with other methods is skipped: it needs Eigen (Debian's libeigen3-dev)"
    exit 0
fi
folder=$BUILD/compare
mkdir -p "$folder"
awk -f tests/measure/compare/o_mesh.awk >"$folder/joukowski.su2" || exit
objects=$(cat "$BUILD/objects/program.list")
$CXX -std=c++17 -Wall -Wextra $CXXFLAGS -pthread -Iinclude -Ic_api/cli -I/usr/include/eigen3 -o "$folder/methods" \
    tests/measure/compare/compare.cpp $objects "$BUILD/libharmorph.a" $LDFLAGS || exit
"$folder/methods" "$folder" tests/meshes/naca0012.su2:airfoil "$folder/joukowski.su2:airfoil" $MESHES || exit

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
