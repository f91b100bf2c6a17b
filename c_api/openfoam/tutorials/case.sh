# Sourced by the tutorials: writes the dictionaries of small cases. $case is the folder of the case.
examples=${FOAM_TUTORIALS:-/usr/share/doc/openfoam-examples/examples}
tutorials=$(cd "$(dirname "$0")" && pwd)
WM_PROJECT_DIR=${WM_PROJECT_DIR:-/usr/share/openfoam}; export WM_PROJECT_DIR

dictionary() {   # dictionary FOLDER/NAME [CLASS]: a file of OpenFOAM whose body is the standard input
    mkdir -p "$case/${1%/*}"
    {
        echo "FoamFile { version 2.0; format ascii; class ${2:-dictionary}; object ${1##*/}; }"
        cat
    } >"$case/$1"
}

# control APPLICATION DELTA_T END [MORE]: numbers are written with all digits, so that a restart reads the same bits.
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
writeFormat ascii;
writePrecision 17;
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
solvers { "cellDisplacement.*" { solver PCG; preconditioner DIC; tolerance 1e-16; relTol 0; minIter 200; } }
PIMPLE { nOuterCorrectors 1; nCorrectors 1; }
DICTIONARY
}

# motion_solver NAME COEFFICIENTS: constant/dynamicMeshDict
motion_solver() {
    dictionary constant/dynamicMeshDict <<DICTIONARY
dynamicFvMesh dynamicMotionSolverFvMesh;
motionSolverLibs ("libfvMotionSolvers.so" "libsixDoFRigidBodyMotion.so" "libharmorphMotionSolver.so");
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

two_parts() {   # for decomposePar
    dictionary system/decomposeParDict <<'DICTIONARY'
numberOfSubdomains 2;
method simple;
simpleCoeffs { n (2 1 1); delta 0.001; }
DICTIONARY
}

# run CASE END PROCESSES [APPLICATION]: runs $folder/CASE, or continues, until END; returns the status of the
# application
run() {
    case=$folder/$1
    sed "s/^endTime .*/endTime $2;/" "$case/system/controlDict" >"$case/system/controlDict.new"
    mv "$case/system/controlDict.new" "$case/system/controlDict"
    if [ "$3" = 1 ]; then
        ${4:-pimpleFoam} -case "$case" >>"$case/log" 2>&1
    else
        test -d "$case/processor0" || decomposePar -case "$case" >"$case/log.decompose" 2>&1
        mpirun --oversubscribe --allow-run-as-root -np "$3" ${4:-pimpleFoam} -parallel -case "$case" >>"$case/log" 2>&1
    fi
}
