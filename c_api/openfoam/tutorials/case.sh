# Sourced by the tutorials: writes the dictionaries of small cases. $case is the folder of the case.
examples=${FOAM_TUTORIALS:-/usr/share/doc/openfoam-examples/examples}
WM_PROJECT_DIR=${WM_PROJECT_DIR:-/usr/share/openfoam}; export WM_PROJECT_DIR

dictionary() {   # dictionary FOLDER/NAME [CLASS]: a file of OpenFOAM whose body is the standard input
    mkdir -p "$case/${1%/*}"
    {
        echo "FoamFile { version 2.0; format ascii; class ${2:-dictionary}; object ${1##*/}; }"
        cat
    } >"$case/$1"
}

# control APPLICATION DELTA_T END [MORE]: binary files, so that a restart reads what was written.
control() {
    dictionary system/controlDict <<DICTIONARY
application $1;
startFrom latestTime;
startTime 0;
stopAt endTime;
deltaT $2;
endTime $3;
writeControl timeStep;
writeInterval 1;
writeFormat binary;
timePrecision 8;
${4:-}
DICTIONARY
}

# no_flow: schemes and solvers for moveDynamicMesh and OpenFOAM's own motion solvers.
no_flow() {
    dictionary system/fvSchemes <<'DICTIONARY'
ddtSchemes { default Euler; }
gradSchemes { default Gauss linear; }
divSchemes { default Gauss linear; }
laplacianSchemes { default Gauss linear corrected; }
interpolationSchemes { default linear; }
snGradSchemes { default corrected; }
DICTIONARY
    dictionary system/fvSolution <<'DICTIONARY'
solvers { "cellDisplacement.*" { solver PCG; preconditioner DIC; tolerance 1e-8; relTol 0; } }
PIMPLE { nOuterCorrectors 1; nCorrectors 1; }
DICTIONARY
}

# motion_solver NAME COEFFICIENTS: constant/dynamicMeshDict
motion_solver() {
    dictionary constant/dynamicMeshDict <<DICTIONARY
dynamicFvMesh dynamicMotionSolverFvMesh;
motionSolverLibs ("libfvMotionSolvers.so" "libharmorphMotionSolver.so");
motionSolver $1;
${1}Coeffs
{
$2
}
DICTIONARY
}

# displacement PATCHES: 0/pointDisplacement; the standard input has the boundary conditions.
displacement() {
    {
        echo "dimensions [0 1 0 0 0 0 0];"
        echo "internalField uniform (0 0 0);"
        echo "boundaryField {"
        cat
        echo "}"
    } | dictionary 0/pointDisplacement pointVectorField
}
