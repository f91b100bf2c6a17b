#!/bin/sh
# usage: cylinder.sh FOLDER [END]   (the library of the motion solver is found by LD_LIBRARY_PATH)
# A free cylinder in a channel: blockMesh makes the mesh, pimpleFoam computes the flow, and the body of
# sixDoFRigidBodyDisplacement moves across the channel on a spring until END, a multiple of 0.2, 1 by default. Prints
# the last report of the mesh. A run that is interrupted at half the time must end with the same bits of the points and
# of the body.
set -e
folder=$1 end=${2:-1}
. "$(dirname "$0")/case.sh"

cylinder_case() {
    case=$folder/$1
    rm -rf "$case"
    awk -f "$tutorials/cylinder_mesh.awk" | dictionary system/blockMeshDict
    control pimpleFoam 0.01 "$end" "writeInterval 10;"
    two_parts
    dictionary system/fvSchemes <<'DICTIONARY'
ddtSchemes { default Euler; }
gradSchemes { default Gauss linear; }
divSchemes { default none; div(phi,U) Gauss linearUpwind grad(U); div((nuEff*dev2(T(grad(U))))) Gauss linear; }
laplacianSchemes { default Gauss linear corrected; }
interpolationSchemes { default linear; }
snGradSchemes { default corrected; }
DICTIONARY
    dictionary system/fvSolution <<'DICTIONARY'
solvers
{
    "(p|pcorr).*" { solver PCG; preconditioner DIC; tolerance 1e-7; relTol 0; }
    "U.*" { solver PBiCGStab; preconditioner DILU; tolerance 1e-8; relTol 0; }
}
PIMPLE { nOuterCorrectors 2; nCorrectors 2; correctPhi no; moveMeshOuterCorrectors yes; }
DICTIONARY
    dictionary constant/transportProperties <<'DICTIONARY'
transportModel Newtonian;
nu 0.01;
DICTIONARY
    dictionary constant/turbulenceProperties <<'DICTIONARY'
simulationType laminar;
DICTIONARY
    motion_solver harmorph "patches (cylinder); operator conformal; safe on; refactor 2; improve 0.1; report 10;"
    displacement <<'DICTIONARY'
cylinder
{
    type sixDoFRigidBodyDisplacement;
    mass 0.2;
    centreOfMass (0 0 0.05);
    momentOfInertia (0.02 0.02 0.02);
    velocity (0 1 0);
    accelerationRelaxation 1;
    solver { type Newmark; }
    rho rhoInf;
    rhoInf 1;
    constraints
    {
        across { sixDoFRigidBodyMotionConstraint line; direction (0 1 0); }
        upright { sixDoFRigidBodyMotionConstraint orientation; }
    }
    restraints
    {
        spring
        {
            sixDoFRigidBodyMotionRestraint linearSpring;
            anchor (0 0 0.05); refAttachmentPt (0 0 0.05); stiffness 2; damping 0; restLength 0;
        }
    }
    value uniform (0 0 0);
}
"(top|bottom)" { type symmetryPlane; }
"(inlet|outlet)" { type fixedValue; value uniform (0 0 0); }
frontAndBack { type empty; }
DICTIONARY
    dictionary 0/U volVectorField <<'DICTIONARY'
dimensions [0 1 -1 0 0 0 0];
internalField uniform (1 0 0);
boundaryField
{
    cylinder { type movingWallVelocity; value uniform (0 0 0); }
    inlet { type fixedValue; value uniform (1 0 0); }
    outlet { type zeroGradient; }
    "(top|bottom)" { type symmetryPlane; }
    frontAndBack { type empty; }
}
DICTIONARY
    dictionary 0/p volScalarField <<'DICTIONARY'
dimensions [0 2 -2 0 0 0 0];
internalField uniform 0;
boundaryField
{
    cylinder { type zeroGradient; }
    inlet { type zeroGradient; }
    outlet { type fixedValue; value uniform 0; }
    "(top|bottom)" { type symmetryPlane; }
    frontAndBack { type empty; }
}
DICTIONARY
    blockMesh -case "$case" >"$case/log.blockMesh" 2>&1
}

cylinder_case one
run one "$end" 1
cylinder_case again
run again "$(awk -v end="$end" 'BEGIN { print end / 2 }')" 1
run again "$end" 1
for file in polyMesh/points pointDisplacement; do
    sed '/^ *location/d' "$folder/one/$end/$file" >"$folder/bits.one"
    sed '/^ *location/d' "$folder/again/$end/$file" >"$folder/bits.again"
    cmp "$folder/bits.one" "$folder/bits.again" || { echo "$file differs after a restart"; exit 1; }
done
awk '/^harmorph: smallest quality/ { print; ++n } END { exit n == 0 }' "$folder/one/log" | tail -n 1
grep 'Centre of mass' "$folder/one/log" | tail -n 1
