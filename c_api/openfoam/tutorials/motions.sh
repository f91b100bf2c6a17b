#!/bin/sh
# usage: motions.sh FOLDER   (the library of the motion solver is found by LD_LIBRARY_PATH)
# Tests of the motion solver on small meshes of blockMesh: types of patches, restarts and processes with equal bits,
# and refusals. The last line counts the checks.
folder=$1
. "$(dirname "$0")/case.sh"
mkdir -p "$folder"
topic="the motion solver" log=$folder/log
. "$tutorials/../../../tests/count.sh"

# motion NAME MESH COEFFICIENTS END: a case; the standard input has pointDisplacement
motion() {
    case=$folder/$1
    rm -rf "$case"
    displacement
    awk -f "$tutorials/cylinder_mesh.awk" $2 | dictionary system/blockMeshDict
    control moveDynamicMesh 1 "$4" "writeInterval 5;"
    no_flow
    two_parts
    motion_solver harmorph "report 1; $3"
    blockMesh -case "$case" >"$case/log.blockMesh" 2>&1 || fail "$1: blockMesh" "$case/log.blockMesh"
    : >"$case/log"
}
# The coordinates of the points of a patch before and at a time, six numbers a line.
points_of() {   # points_of NAME PATCH TIME
    awk -v patch="$2" '
        FNR == 1 { ++file; depth = 0 }
        file == 1 && $1 == patch { inside = 1 }
        file == 1 && inside && /nFaces/ { n = $2 + 0 }
        file == 1 && inside && /startFace/ { first = $2 + 0; inside = 0 }
        file == 2 && /^[0-9]+\(/ {
            if (faces >= first && faces < first + n) {
                gsub(/[()]/, " "); for (k = 2; k <= NF; ++k) mine[$k] = 1
            }
            ++faces
        }
        file > 2 && /^\(.* .* .*\)$/ {
            gsub(/[()]/, " ")
            if (file == 3) before[count3++] = $0; else { if (count4 in mine) print before[count4], $0; ++count4 }
        }' "$folder/$1/constant/polyMesh/boundary" "$folder/$1/constant/polyMesh/faces" \
        "$folder/$1/constant/polyMesh/points" "$folder/$1/$3/polyMesh/points"
}
valid() {   # valid NAME: the last mesh
    check "$1: the run" run "$1" "${2:-10}" 1 moveDynamicMesh
    check "$1: the mesh is valid at the end" \
        sh -c "grep 'Mesh geometry OK\|mesh geometry checks' '$case/log' | tail -n 1 | grep OK"
}
on_line() {   # on_line NAME PATCH COLUMN: the points keep this coordinate, and some move
    check "$1: the points of $2 stay on their line, and slide" sh -c "test -s '$folder/list' && awk '
        { d = \$$3 - \$($3 + 3); if (d < -1e-12 || d > 1e-12) bad = 1
          for (k = 1; k < 4; ++k) if (\$k != \$(k + 3)) moves = 1 } END { exit bad || !moves }' '$folder/list'"
}
oscillating='type angularOscillatingDisplacement; axis (0 0 1); origin (0.1 0.1 0); angle0 0; amplitude 1.5;
    omega 0.15; value uniform (0 0 0);'
fixed='{ type fixedValue; value uniform (0 0 0); }'
shifted() {   # shifted VECTOR: a patch that has moved by this at the time 10
    echo "{ type uniformFixedValue; uniformValue table ((0 (0 0 0)) (10 ($1))); value uniform (0 0 0); }"
}

coordinates() { sed -n '/^(.* .* .*)$/p' "$folder/$1/10/polyMesh/points"; }
parallel() {   # parallel NAME: the case on two processes has the same bits as on one, which has run
    rm -rf "$folder/$1_two" && mkdir "$folder/$1_two"
    for part in 0 constant system; do cp -r "$folder/$1/$part" "$folder/$1_two/"; done
    check "$1 on two processes" run "$1_two" 10 2 moveDynamicMesh
    check "$1 on two processes: reconstructPar" reconstructPar -case "$folder/$1_two" -latestTime
    coordinates "$1" >"$folder/bits"
    coordinates "$1_two" >"$folder/bits.two"
    check "$1: the same bits on two processes" sh -c "test -s '$folder/bits' && cmp '$folder/bits' '$folder/bits.two'"
}

# Types of patches.
motion symmetry "" "patches (cylinder);" 10 <<CASE
cylinder $(shifted "0.6 0.9 0")
"(top|bottom)" { type symmetryPlane; }
"(inlet|outlet)" { type slip; }
frontAndBack { type empty; }
CASE
valid symmetry
points_of symmetry top 10 >"$folder/list"; on_line symmetry top 2
points_of symmetry inlet 10 >"$folder/list"; on_line symmetry inlet 1

motion cyclic "-v across=cyclic" "patches (cylinder); safe off; refactor 0;" 10 <<CASE
cylinder $(shifted "0.6 0.9 0")
"(top|bottom)" { type cyclic; }
"(inlet|outlet)" { type slip; }
frontAndBack { type empty; }
CASE
valid cyclic
parallel cyclic
displacements() { awk '{ printf "%.6f %.6f %.17g %.17g\n", $1, $3, $4 - $1, $5 - $2 }'; }
points_of cyclic top 10 | displacements >"$folder/top"
points_of cyclic bottom 10 | displacements >"$folder/bottom"
check "cyclic: both sides move alike" awk 'NR == FNR { a[$1, $2] = $3 " " $4; next } {
    split(a[$1, $2], b, " ")
    if ((b[1] - $3)^2 + (b[2] - $4)^2 > 1e-26) bad = 1
    if ($4 != 0) moves = 1 } END { exit bad || !moves || NR != 2 * FNR }' "$folder/top" "$folder/bottom"

motion interface "-v ring=1" "patches (cylinder); slip (inner outer);" 10 <<CASE
cylinder { $oscillating }
"(top|bottom)" { type symmetryPlane; }
"(inlet|outlet)" $fixed
"(inner|outer)" { type cyclicAMI; }
frontAndBack { type empty; }
CASE
valid interface
parallel interface
for side in inner outer; do points_of interface $side 10; done >"$folder/list"
check "interface: the points stay on their circle" awk '{ r = sqrt($4^2 + $5^2); if (r < 1.4995 || r > 1.5005) bad = 1
    if ($1 != $4) moves = 1 } END { exit bad || !moves }' "$folder/list"

motion wedge "-v wedge=1" "patches (wall);" 10 <<CASE
wall $(shifted "0 0.5 0")
"(inlet|outlet)" { type slip; }
"(front|back)" { type wedge; }
CASE
valid wedge
parallel wedge
points_of wedge inlet 10 >"$folder/list"; on_line wedge inlet 1
check "wedge: points keep their angle, those of the axis their place" awk '
    { a = $3 * $5 - $2 * $6; if (a < -1e-12 || a > 1e-12 || ($2 == 0 && ($5 != 0 || $6 != 0))) bad = 1 }
    END { exit bad }' "$folder/list"

# Equal bits: on one process and on two, without and with an interruption, where the matrix is factored on the way.
for name in one again two two_again; do
    motion $name "" "patches (cylinder); refactor 40; improve 0.3;" 10 <<CASE
cylinder { $oscillating }
"(top|bottom)" { type symmetryPlane; }
"(inlet|outlet)" { type slip; }
frontAndBack { type empty; }
CASE
done
valid one
check "one: the matrix is factored on the way before and after the interruption" \
    awk '/^Time = 6$/ { after = 1 } /factored/ { ++n[after + 0] } END { exit !(n[0] && n[1]) }' "$folder/one/log"
check "again: to the middle" run again 5 1 moveDynamicMesh
check "again: to the end" run again 10 1 moveDynamicMesh
check "two: the run" run two 10 2 moveDynamicMesh
check "two_again: to the middle" run two_again 5 2 moveDynamicMesh
check "two_again: to the end" run two_again 10 2 moveDynamicMesh
for name in two two_again; do
    check "$name: reconstructPar" reconstructPar -case "$folder/$name" -latestTime
done
coordinates one >"$folder/bits"
check "one: there are points" test -s "$folder/bits"
for name in again two two_again; do
    coordinates $name >"$folder/bits.$name"
    check "$name: the same bits as in one run on one process" cmp "$folder/bits" "$folder/bits.$name"
done

# Refusals: the run ends, and says why.
refused() {   # refused NAME TEXT
    if run "$1" 10 1 moveDynamicMesh; then fail "$1: the run is not refused"; else ok; fi
    tr '\n' ' ' <"$case/log" >"$folder/text"
    check "$1: the reason" grep -q "$2" "$folder/text"
}
simple() {   # simple NAME COEFFICIENTS CYLINDER [INLET]
    motion "$1" "" "$2" 10 <<CASE
cylinder $3
"(top|bottom)" { type symmetryPlane; }
inlet ${4:-$fixed}
outlet $fixed
frontAndBack { type empty; }
CASE
}
simple no_patch "patches (wing);" "$fixed"
refused no_patch "No patch has the name wing of the coefficient patches"
simple forgotten "patches (inlet);" "{ type fixedValue; value uniform (0.1 0 0); }"
refused forgotten "The patch cylinder has a displacement, (0.1[0-9]* 0 0), but is not among"
simple no_value "patches (top);" "$fixed"
refused no_value "The patch top shall move, but pointDisplacement has the type symmetryPlane there"
simple across "patches (cylinder);" "{ type fixedValue; value uniform (0 0 0.1); }"
refused across "Both must move alike and stay in their planes"
simple crossing "patches (cylinder); safe off;" "{ type fixedValue; value uniform (9 0 0); }"
refused crossing "harmorph cannot move the mesh: .*HM_"
simple free "patches (cylinder); safe off;" "{ type fixedValue; value uniform (0.1 0 0); }" "{ type zeroGradient; }"
refused free "harmorph cannot analyse the mesh: .*HM_UNSUPPORTED"
simple unknown "patches (cylinder); reports 1;" "$fixed"
refused unknown "The coefficient reports is unknown. The coefficients are"
simple exponent "patches (cylinder); exponent 0.375;" "$fixed"
refused exponent "The exponent 0.375 is not a multiple of 0.25"
# A layer of cells at the outlet is thicker than it may be, so OpenFOAM adds a layer.
simple topology "patches (cylinder);" "$fixed"
sed -i.old -e 's/dynamicMotionSolverFvMesh/dynamicMotionSolverTopoFvMesh/' \
    -e '1adynamicFvMeshLibs ("libtopoChangerFvMesh.so");' "$case/constant/dynamicMeshDict"
dictionary system/topoSetDict <<'CASE'
actions
(
    { name outlet; type faceSet; action new; source patchToFace; patch outlet; }
    { name outside; type cellSet; action new; source labelToCell; value (); }
    { name outlet; type faceZoneSet; action new; source setsToFaceZone; faceSet outlet; cellSet outside; }
);
CASE
check "topology: topoSet" topoSet -case "$case"
dictionary constant/polyMesh/meshModifiers polyTopoChanger <<'CASE'
1
(
    layers
    {
        type layerAdditionRemoval;
        faceZoneName outlet;
        minLayerThickness 0.001;
        maxLayerThickness 0.01;
        oldLayerThickness 0.001;
        active on;
    }
)
CASE
refused topology "cannot follow changes of the topology"
finish
