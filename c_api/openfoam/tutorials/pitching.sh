#!/bin/sh
# usage: pitching.sh FOLDER STEP END SOLVER...   (the library of the motion solver is found by LD_LIBRARY_PATH)
# The airfoil of OpenFOAM's tutorial airFoil2D turns about its quarter chord, by STEP degrees in each step until END.
# For each SOLVER prints a line: the last angle before OpenFOAM's check of the mesh first fails, and the processor time
# of a step. Where a run ends early, the end of its output follows.
#
#   harmorph             with safe steps, the default
#   harmorph-one         with one factorisation: safe off; refactor 0;
#   static               nothing moves: the time of OpenFOAM's check alone
#   laplacian-DIFFUSIVITY, SBRStress-DIFFUSIVITY   OpenFOAM's own, for instance laplacian-inverseDistance
set -e
folder=$1 step=$2 end=$3; shift 3
. "$(dirname "$0")/case.sh"

pitching_case() {
    rm -rf "$case"
    mkdir -p "$case/constant"
    cp -r "$examples/incompressible/simpleFoam/airFoil2D/constant/polyMesh" "$case/constant/"
    control moveDynamicMesh "$step" "$end" "writeInterval 30;"
    no_flow
    displacement <<DICTIONARY
walls
{
    type solidBodyMotionDisplacement;
    solidBodyMotionFunction rotatingMotion;
    rotatingMotionCoeffs { origin (8.75 0 0); axis (0 0 -1); omega constant 0.017453292519943295; }
    value uniform (0 0 0);
}
inlet { type fixedValue; value uniform (0 0 0); }
outlet { type fixedValue; value uniform (0 0 0); }
frontAndBack { type empty; }
DICTIONARY
    case $1 in
    harmorph) motion_solver harmorph "patches (walls); report 1;" ;;
    harmorph-one) motion_solver harmorph "patches (walls); safe off; refactor 0; report 1;" ;;
    static) echo "dynamicFvMesh staticFvMesh;" | dictionary constant/dynamicMeshDict ;;
    laplacian-*) motion_solver displacementLaplacian "diffusivity ${1#*-} ${2:-};" ;;
    SBRStress-*) motion_solver displacementSBRStress "diffusivity ${1#*-} ${2:-};" ;;
    esac
}

for solver; do
    case=$folder/$solver
    case $solver in
    *-quadratic) pitching_case "$solver" "inverseDistance (walls)" ;;
    *-inverse*Distance) pitching_case "$solver" "(walls)" ;;
    *) pitching_case "$solver" ;;
    esac
    status=0
    ( command time -p moveDynamicMesh -case "$case" -noFunctionObjects >"$case/log" 2>"$case/time" ) ||
        status=$?
    seconds=$(awk '/^user/ { print $2 }' "$case/time")
    # moveDynamicMesh checks the mesh after each step; the tutorial's own mesh has an error of topology, the order of
    # its faces, so errors of geometry count.
    awk -v solver="$solver" -v seconds="$seconds" -v end="$end" '
        /^Time = / { angle = $3; ++steps }
        /Failed [0-9]+ mesh geometry checks/ && first == "" { first = angle }
        /Mesh geometry OK/ && first == "" { last = angle }
        END {
            if (!steps) { printf "%-34s does not begin\n", solver; exit }
            what = first != "" ? "first error at " first : angle < end ? "the run ends at " angle : "no error at all"
            printf "%-34s %6s degrees without an error, %s; %.1f ms a step\n",
                solver, last, what, 1000 * seconds / steps
        }' "$case/log"
    [ $status = 0 ] || { tail -n 2 "$case/log"; grep -A 2 'FOAM FATAL' "$case/time"; } | sed 's/^/    /'
done
