#!/bin/sh
# usage: adjoint.sh FOLDER HARMORPH [STEPS]
# Shape optimisation: an airfoil at 3 degrees in a laminar flow, Reynolds number 1000, loses drag in STEPS design steps
# (10 by default) at constant lift and constant area of the section. In each step adjointOptimisationFoam computes the
# flow and two adjoint flows and writes the derivatives of drag and lift by the points of the wall; `harmorph adjoint`
# makes gradients by control points; `harmorph morph` writes the points of the next mesh beside the fields, so that the
# next flow starts from the last one. Prints a table; the last line says how much drag is left.
set -e
folder=$1 harmorph=$2 steps=${3:-10}
. "$(dirname "$0")/case.sh"
around=128 across=48 control=16
along="0.99862953475 0.05233595624 0" upwards="-0.05233595624 0.99862953475 0"   # of the flow

field() {   # field NAME CLASS DIMENSIONS VALUE AIRFOIL FAR
    dictionary "0/$1" "$2" <<DICTIONARY
dimensions [$3];
internalField uniform $4;
boundaryField { airfoil { $5 } far { $6 } "(front|back)" { type empty; } }
DICTIONARY
}
objective() {   # objective NAME DIRECTION: an adjoint flow for a coefficient of force
    cat <<DICTIONARY
$1
{
    active true; type incompressible; solver adjointSimple; useSolverNameForFields true;
    objectives
    {
        type incompressible;
        objectiveNames
        {
            $1 { weight 1; type force; patches (airfoil); direction ($2); Aref 0.1; rhoInf 1; UInf 1; }
        }
    }
    ATCModel { ATCModel standard; }
    solutionControls { nIters 2000; residualControl { "pa.*" 1e-6; "Ua.*" 1e-6; } }
}
DICTIONARY
}
airfoil_case() {
    rm -rf "$case"
    control adjointOptimisationFoam 1 1000000 "writeInterval 1000000;"
    dictionary system/fvSchemes <<'DICTIONARY'
ddtSchemes { default steadyState; }
gradSchemes { default Gauss linear; }
divSchemes
{
    default Gauss linear;
    div(phi,U) bounded Gauss linearUpwind convected;
    div(-phi,Ua) bounded Gauss linearUpwind convected;
}
laplacianSchemes { default Gauss linear corrected; }
interpolationSchemes { default linear; }
snGradSchemes { default corrected; }
DICTIONARY
    dictionary system/fvSolution <<'DICTIONARY'
SIMPLE { nNonOrthogonalCorrectors 0; }
solvers
{
    "p.*|m.*" { solver GAMG; smoother DICGaussSeidel; tolerance 1e-12; relTol 0.01; }
    "U.*" { solver PBiCGStab; preconditioner DILU; tolerance 1e-12; relTol 0.01; }
}
relaxationFactors { fields { "p.*" 0.3; } equations { "U.*" 0.7; } }
DICTIONARY
    dictionary system/optimisationDict <<DICTIONARY
optimisationManager singleRun;
primalSolvers
{
    flow
    {
        active true; type incompressible; solver simple;
        solutionControls { nIters 2000; residualControl { p 1e-7; "U.*" 1e-7; } }
    }
}
adjointManagers
{
    both { primalSolver flow; adjointSolvers { $(objective drag "$along") $(objective lift "$upwards") } }
}
optimisation
{
    sensitivities { type surfacePoints; patches (airfoil); includeSurfaceArea true; writeAllSurfaceFiles true; }
}
DICTIONARY
    echo "transportModel Newtonian; nu 1e-3;" | dictionary constant/transportProperties
    echo "simulationType laminar;" | dictionary constant/turbulenceProperties
    echo "adjointRASModel adjointLaminar; adjointTurbulence on; printCoeffs off;" |
        dictionary constant/adjointRASProperties
    stop="type fixedValue; value uniform (0 0 0);"
    field U volVectorField "0 1 -1 0 0 0 0" "($along)" "$stop" "type freestream; freestreamValue uniform ($along);"
    field p volScalarField "0 2 -2 0 0 0 0" 0 "type zeroGradient;" \
        "type outletInlet; outletValue uniform 0; value uniform 0;"
    for name in drag lift; do
        field Ua$name volVectorField "0 1 -1 0 0 0 0" "(0 0 0)" "type adjointWallVelocity; value uniform (0 0 0);" \
            "type adjointFarFieldVelocity; value uniform (0 0 0);"
        field pa$name volScalarField "0 2 -2 0 0 0 0" 0 "type zeroGradient;" \
            "type adjointFarFieldPressure; value uniform 0;"
    done
    awk -v ni=$around -v nj=$across -f "$tutorials/airfoil_mesh.awk" >"$case/mesh.msh"
    gmshToFoam -case "$case" "$case/mesh.msh" >"$case/log.mesh" 2>&1
    sed -i.old -e '/physicalType/d' -e '/airfoil/,/}/s/type .*/type wall;/' -e '/front/,/}/s/type .*/type empty;/' \
        -e '/back/,/}/s/type .*/type empty;/' "$case/constant/polyMesh/boundary"
}

# wall MOVED: the derivatives of the section's area by the points of the wall, lines "point dA/dx dA/dy"; the first line
# has the area.
wall() {
    sed -n '/^(.* .* .*)$/{s/[()]//g;p;}' "$1" | awk -v n=$around '
        NR <= n { x[NR - 1] = $1; y[NR - 1] = $2 }
        END {
            for (i = 0; i < n; ++i) {
                after = (i + 1) % n; before = (i + n - 1) % n
                area += (x[i] * y[after] - x[after] * y[i]) / 2
                line[i] = sprintf("%d %.15g %.15g", i, (y[after] - y[before]) / 2, (x[before] - x[after]) / 2)
            }
            printf "# %.15g\n", area
            for (i = 0; i < n; ++i) print line[i]
        }'
}
# design STEP LIFT_OFF AREA_OFF: reads the gradients and the smoothed gradients of drag, lift and area (files gradients
# and smooth) and the movements so far (moves), and writes the next movements. To first order, the direction -(s_drag -
# a s_lift - b s_area) of smoothed gradients s changes neither lift nor area. A second movement corrects the errors of
# lift and area. The largest movement of a control point along the direction becomes smaller from step to step.
design() {
    awk -v step="$1" -v lift_off="$2" -v area_off="$3" -v n=$control '
        FNR == 1 { ++file; objective = 0 }
        /^# objective/ { ++objective; next }
        /^#/ { next }
        # The trailing edge, which the first and the last control point make, stays.
        file == 1 { if ($1 > 1 && $1 < n) g[objective, $1] = $3; next }
        file == 2 { if ($1 > 1 && $1 < n) s[objective, $1] = $3; next }
        { moved[$1] = $3 }
        function dot(a, b,    k, sum) { for (k = 2; k < n; ++k) sum += g[a, k] * s[b, k]; return sum }
        # solve(p, q): a, b with which lift and area change by p and q along a s_lift + b s_area
        function solve(p, q,    det) {
            det = dot(2, 2) * dot(3, 3) - dot(2, 3) * dot(3, 2)
            a = (p * dot(3, 3) - q * dot(2, 3)) / det; b = (q * dot(2, 2) - p * dot(3, 2)) / det
        }
        END {
            solve(dot(2, 1), dot(3, 1))
            for (k = 2; k < n; ++k) {
                d[k] = a * s[2, k] + b * s[3, k] - s[1, k]
                size = d[k] > size ? d[k] : -d[k] > size ? -d[k] : size
            }
            solve(-lift_off, -area_off)
            for (k = 2; k < n; ++k)
                printf "%d 0 %.15g\n", k, moved[k] + 0.012 * 0.75 ^ step / size * d[k] + a * s[2, k] + b * s[3, k]
        }' "$folder/gradients" "$folder/smooth" "$folder/moves"
}
difference() { awk -v a="$1" -v b="$2" 'BEGIN { printf "%.15g", a - b }'; }
last_value() { tail -n 1 "$case/optimisation/objective/$1" | awk '{ print $2 }'; }

case=$folder/airfoil
airfoil_case
"$harmorph" fit "$case" --marker airfoil --points $control -o "$folder/curve" >"$folder/log.harmorph"
"$harmorph" solve "$case" --curve "airfoil=$folder/curve" -o "$folder/basis" >>"$folder/log.harmorph"
: >"$folder/moves"
mesh=$case points=$case/constant/polyMesh/points time=0
echo "step    drag       lift       area       smallest quality"
k=0
while :; do
    adjointOptimisationFoam -case "$case" >"$case/log" 2>&1
    drag=$(last_value $time/dragInstantdrag) lift=$(last_value $time/liftInstantlift)
    wall "$points" >"$folder/area"
    area=$(sed -n 's/# //p' "$folder/area")
    quality=$("$harmorph" check "$mesh" | sed -n 's/^skew quality *\([^ ]*\).*/\1/p')
    printf '%4d    %.6f   %.6f   %.6f   %s\n' $k "$drag" "$lift" "$area" "$quality"
    if [ $k = 0 ]; then drag0=$drag lift0=$lift area0=$area; fi
    [ $k -lt "$steps" ] || break
    time=$(ls "$case" | grep '^[0-9]*$' | sort -n | tail -n 1)
    sensitivities="--sensitivity $case/$time/pointSensVecdragESI --sensitivity $case/$time/pointSensVecliftESI
        --sensitivity $folder/area"
    "$harmorph" adjoint "$case" "$folder/basis" $sensitivities -o "$folder/gradients" >>"$folder/log.harmorph"
    "$harmorph" adjoint "$case" "$folder/basis" $sensitivities --smooth 0.3 -o "$folder/smooth" \
        >>"$folder/log.harmorph"
    design $k "$(difference "$lift" "$lift0")" "$(difference "$area" "$area0")" >"$folder/moves.new"
    mv "$folder/moves.new" "$folder/moves"
    "$harmorph" morph "$case" "$folder/basis" --move "$folder/moves" -o "$case/$time" --svg "$folder/adjoint.svg" \
        >>"$folder/log.harmorph"
    mesh=$case/$time points=$case/$time/polyMesh/points
    k=$((k + 1))
done
echo "$drag $drag0 $lift $lift0 $area $area0" | awk '{
    printf "drag %.4f, lift %.4f, area %.4f of the first airfoil\n", $1 / $2, $3 / $4, $5 / $6 }'
