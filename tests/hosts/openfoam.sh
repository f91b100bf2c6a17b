#!/bin/sh
# OpenFOAM's own tutorial case airFoil2D on a morphed mesh: checkMesh judges the mesh as it judged the given one, and
# simpleFoam runs on it (sh tests/hosts/openfoam.sh PROGRAM DIRECTORY). Skipped where OpenFOAM or its examples are
# missing.
harmorph=$1 tmp=$2/openfoam-test
topic=OpenFOAM log=$tmp/out
. "$(dirname "$0")/../count.sh"
tutorial=
for place in "${FOAM_TUTORIALS:-}" /usr/share/doc/openfoam-examples/examples; do
    case=$place/incompressible/simpleFoam/airFoil2D
    test -d "$case/constant" && tutorial=$case
done
if ! command -v simpleFoam >/dev/null 2>&1 || [ -z "$tutorial" ]; then
    echo "OpenFOAM or its tutorials are not installed: no case is run on a morphed mesh" \
        "(Debian's openfoam, openfoam-examples)"
    exit 0
fi
# Debian's package leaves to the caller where its settings are.
WM_PROJECT_DIR=${WM_PROJECT_DIR:-/usr/share/openfoam} && export WM_PROJECT_DIR
rm -rf "$tmp"
mkdir -p "$tmp" || exit 2
cp -r "$tutorial" "$tmp/given"
find "$tmp/given" -name '*.gz' -exec gunzip {} +
test -d "$tmp/given/0" || cp -r "$tmp/given/0.orig" "$tmp/given/0"
sed -i.old -e 's/^endTime .*/endTime         100;/' -e 's/^writeInterval .*/writeInterval   100;/' \
    "$tmp/given/system/controlDict"
cp -r "$tmp/given" "$tmp/moved"
check "airFoil2D: check" "$harmorph" check "$tmp/given"
check "airFoil2D: fit" "$harmorph" fit "$tmp/given" --marker walls -o "$tmp/curve"
check "airFoil2D: solve" "$harmorph" solve "$tmp/given" --curve "walls=$tmp/curve" -o "$tmp/basis"
for k in 4 5 6 7 8 9 10 11 12 13 14 15 16 17; do echo "$k 0 .02"; done >"$tmp/moves.txt" # camber
check "airFoil2D: morph" "$harmorph" morph "$tmp/given" "$tmp/basis" --move "$tmp/moves.txt" -o "$tmp/moved"
check "airFoil2D: morph to a time" "$harmorph" morph "$tmp/given" "$tmp/basis" --move "$tmp/moves.txt" -o "$tmp/given/1"
check "airFoil2D: the time has the moved points" \
    cmp "$tmp/given/1/polyMesh/points" "$tmp/moved/constant/polyMesh/points"
check "airFoil2D: the mesh of the time is read" "$harmorph" check "$tmp/given/1"
checkMesh -case "$tmp/given" -time 1 >"$tmp/time.check" 2>&1
check "airFoil2D: checkMesh finds the mesh of the time" grep -q 'Time = 1' "$tmp/time.check"
check "airFoil2D: checkMesh: the geometry of the time" grep -q 'Mesh non-orthogonality.*Max' "$tmp/time.check"
rm -rf "$tmp/given/1"
check "airFoil2D: the points have moved" \
    sh -c "! cmp -s '$tmp/given/constant/polyMesh/points' '$tmp/moved/constant/polyMesh/points'"
for case in given moved; do
    checkMesh -case "$tmp/$case" -constant >"$tmp/$case.check" 2>&1
    grep -E 'Mesh OK|Failed [0-9]+ mesh checks' "$tmp/$case.check" >"$tmp/$case.verdict"
    check "airFoil2D $case: simpleFoam" simpleFoam -case "$tmp/$case"
    cp "$tmp/out" "$tmp/$case.log"
    check "airFoil2D $case: simpleFoam: 100 iterations" grep -q '^Time = 100$' "$tmp/$case.log"
    check "airFoil2D $case: simpleFoam: its end" grep -q '^End' "$tmp/$case.log"
done
check "airFoil2D: checkMesh: the same verdict" cmp "$tmp/given.verdict" "$tmp/moved.verdict"
check "airFoil2D: checkMesh: a verdict" test -s "$tmp/moved.verdict"
# The residuals of the pressure are those of a run that converges, and not those of the given mesh.
residual() {
    awk '/Solving for p,/ { sub(/.*Initial residual = /, ""); sub(/,.*/, ""); r = $0 } END { print r }' "$tmp/$1.log"
}
check "airFoil2D: the residual falls" awk -v r="`residual moved`" 'BEGIN { exit !(r > 0 && r < .2) }'
check "airFoil2D: another flow" test "`residual given`" != "`residual moved`"
finish
