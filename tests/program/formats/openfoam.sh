# OpenFOAM: a folder of files, of which one has the coordinates; checkMesh, and a case of its tutorials. (A part of
# tests/program/formats.sh.)
for storage in text binary-32 binary-64 binary-single; do
    for plane in z y inclined wedge; do
        what="openfoam $storage $plane" case=$tmp/foam moved=$tmp/foam-moved expected=$tmp/foam-expected
        rm -rf "$case" "$moved" "$expected"
        "$tmp/make_foam" "$case" $storage $plane
        cp -r "$case" "$moved"
        points=constant/polyMesh/points
        check "$what: check" "$harmorph" check "$case"
        check "$what: convert" "$harmorph" convert "$case" "$tmp/before.su2"
        check "$what: fit" "$harmorph" fit "$case" --marker body --points 8 -o "$tmp/curve"
        check "$what: solve" "$harmorph" solve "$case" --curve "body=$tmp/curve" -o "$tmp/basis"
        check "$what: zero move" "$harmorph" morph "$case" "$tmp/basis" --move "$tmp/none.txt" -o "$moved/$points"
        check "$what: zero move: the same file" cmp "$case/$points" "$moved/$points"
        check "$what: morph" "$harmorph" morph "$case" "$tmp/basis" --move "$tmp/moves.txt" -o "$moved"
        check "$what: convert the morphed" "$harmorph" convert "$moved" "$tmp/after.su2"
        # In coordinate planes the numbers are those of the plane; elsewhere they are computed, and agree to rounding.
        "$tmp/make_foam" "$expected" $storage $plane "$tmp/after.su2"
        if [ $plane = z ] || [ $plane = y ]; then
            check "$what: only coordinates differ" cmp "$expected/$points" "$moved/$points"
        elif [ $storage = text ]; then
            check "$what: the points in space" \
                sh -c "tr '()' '  ' <'$expected/$points' >'$tmp/a' && tr '()' '  ' <'$moved/$points' >'$tmp/b'"
            check "$what: the points in space moved with their plane" alike 1e-12 "$tmp/a" "$tmp/b"
        else
            "$tmp/make_foam" "$expected" $storage $plane "$tmp/before.su2"
            "$harmorph" convert "$expected" "$tmp/again.su2" >"$tmp/out" 2>&1
            check "$what: the plane's coordinates" alike 1e-5 "$tmp/before.su2" "$tmp/again.su2"
        fi
    done
done
for storage in text binary-64; do
    what="openfoam polygons $storage" case=$tmp/foam moved=$tmp/foam-moved
    rm -rf "$case" "$moved"
    "$tmp/make_foam" "$case" $storage polygons
    cp -r "$case" "$moved"
    check "$what: check" "$harmorph" check "$case" --json
    says "$what: cells of six corners" '"cells": 132, "triangles": 0, "quads": 120, "polygons": 12, "inverted": 0'
    check "$what: fit" "$harmorph" fit "$case" --marker body --points 8 -o "$tmp/curve"
    check "$what: solve" "$harmorph" solve "$case" --curve "body=$tmp/curve" -o "$tmp/basis"
    check "$what: zero move" "$harmorph" morph "$case" "$tmp/basis" --move "$tmp/none.txt" \
        -o "$moved/constant/polyMesh/points"
    check "$what: zero move: the same file" cmp "$case/constant/polyMesh/points" "$moved/constant/polyMesh/points"
    check "$what: morph" "$harmorph" morph "$case" "$tmp/basis" --move "$tmp/moves.txt" --safe -o "$moved" \
        --svg "$tmp/picture.svg"
    check "$what: check the morphed" "$harmorph" check "$moved"
    for new in vtk vtu; do
        check "$what: convert to $new" "$harmorph" convert "$moved" "$tmp/foam.$new"
        check "$what: $new is read" "$harmorph" check "$tmp/foam.$new" --json
        says "$what: $new has the polygons" '"quads": 120, "polygons": 12, "inverted": 0'
    done
    check "$what: no SU2 file of polygons" \
        sh -c "'$harmorph' convert '$moved' '$tmp/none.su2' 2>'$tmp/why'; test \$? -eq 2"
    check "$what: no SU2 file of polygons: why" \
        grep -q 'cells of more than four corners (the first is cell 0), but SU2 takes triangles and' "$tmp/why"
done
what="openfoam interface" case=$tmp/foam moved=$tmp/foam-moved
rm -rf "$case" "$moved"
"$tmp/make_foam" "$case" text interface
cp -r "$case" "$moved"
check "$what: check" "$harmorph" check "$case"
says "$what: check names both sides" 'interface     AMI1 and AMI2 slide along each other'
check "$what: solve" "$harmorph" solve "$case" --rigid body,AMI1=0,0 -o "$tmp/basis"
echo "rigid body 0 0 40" >"$tmp/turn.txt"
check "$what: a rotor that turns" "$harmorph" morph "$case" "$tmp/basis" --move "$tmp/turn.txt" -o "$moved"
check "$what: a rotor that turns safely" "$harmorph" morph "$case" "$tmp/basis" --move "$tmp/turn.txt" --safe \
    -o "$moved"
check "$what: convert" "$harmorph" convert "$case" "$tmp/rotor.su2"
check "$what: solve without the file's word" "$harmorph" solve "$tmp/rotor.su2" --rigid body,AMI1=0,0 -o "$tmp/basis"
check "$what: no movement" "$harmorph" morph "$tmp/rotor.su2" "$tmp/basis" --move "$tmp/none.txt" -o "$tmp/after.su2"
"$harmorph" morph "$tmp/rotor.su2" "$tmp/basis" --move "$tmp/turn.txt" -o "$tmp/after.su2" >"$tmp/out" 2>"$tmp/why"
check "$what: a rotor that turns, undeclared, is refused" test $? -eq 1
check "$what: a rotor that turns, undeclared: why" grep -q 'boundary crosses itself' "$tmp/why"
check "$what: solve --interface" "$harmorph" solve "$tmp/rotor.su2" --rigid body,AMI1=0,0 --interface AMI2:AMI1 \
    -o "$tmp/basis"
check "$what: a rotor that turns, declared" \
    "$harmorph" morph "$tmp/rotor.su2" "$tmp/basis" --move "$tmp/turn.txt" -o "$tmp/after.su2"
awk 'BEGIN { for (k = 0; k < 24; k++) print k, .01, 0; for (k = 72; k < 96; k++) print k, 0, .01 }' >"$tmp/field.txt"
check "$what: displace" "$harmorph" displace "$case" --given body,AMI1 --wall "$tmp/field.txt" -o "$moved"
"$tmp/make_foam" "$tmp/foam" text z
broken() { # broken FILE SED: the case with one file changed
    rm -rf "$tmp/foam-bad"
    cp -r "$tmp/foam" "$tmp/foam-bad"
    sed "$2" "$tmp/foam/constant/polyMesh/$1" >"$tmp/foam-bad/constant/polyMesh/$1"
}
broken points '188s/^([^ ]*/(2/'
refuses "openfoam: a point without a partner" \
    'points:188: the mesh has three dimensions and is not one cell thick: the projection of point 173 is' \
    "$harmorph" check "$tmp/foam-bad"
broken boundary 's/ empty;/ patch;/'
refuses "openfoam: three dimensions" 'no patch has the type empty or wedge: the mesh has three dimensions' "$harmorph" \
    check "$tmp/foam-bad"
broken boundary 's/nFaces          288/nFaces          140/'
refuses "openfoam: planes without some faces" 'has 140 faces, but the mesh has 144 cells' "$harmorph" \
    check "$tmp/foam-bad"
broken boundary 's/nFaces          24;/nFaces          2400;/'
refuses "openfoam: a patch that is too long" "boundary:15: the patch 'body' ends after face" "$harmorph" \
    check "$tmp/foam-bad"
broken boundary '/body/,/}/s/type .*;/type processor;/'
refuses "openfoam: a part of a decomposed case" "boundary:15: the patch 'body' has the type processor" "$harmorph" \
    check "$tmp/foam-bad"
broken faces 's/^4(0 /4(999 /'
refuses "openfoam: a face of points that do not exist" 'has point 999, but there are 336 points' "$harmorph" \
    check "$tmp/foam-bad"
broken faces '$d'
refuses "openfoam: cut off" "the file needs ')' here, but the end of the file follows" "$harmorph" check "$tmp/foam-bad"
broken owner '17s/^0$/x/'
refuses "openfoam: owners" "owner:17: the file needs a label here, but 'x' follows" "$harmorph" check "$tmp/foam-bad"
rm "$tmp/foam-bad/constant/polyMesh/owner"
refuses "openfoam: a file is missing" 'owner does not exist' "$harmorph" check "$tmp/foam-bad"
"$tmp/make_foam" "$tmp/foam" binary-64 z
broken points 's/label=64/label=32/; s/scalar=64/scalar=32/'
refuses "openfoam: another size of numbers than the header says" 'or its header states another size of numbers' \
    "$harmorph" check "$tmp/foam-bad"

if command -v checkMesh >/dev/null 2>&1; then
    # Debian's package leaves to the caller where its settings are.
    WM_PROJECT_DIR=${WM_PROJECT_DIR:-/usr/share/openfoam} && export WM_PROJECT_DIR
    for plane in z wedge polygons; do
        for storage in text binary-32; do
            rm -rf "$tmp/foam" "$tmp/foam-moved"
            "$tmp/make_foam" "$tmp/foam" $storage $plane
            cp -r "$tmp/foam" "$tmp/foam-moved"
            "$harmorph" fit "$tmp/foam" --marker body --points 8 -o "$tmp/curve" >"$tmp/out" 2>&1
            "$harmorph" solve "$tmp/foam" --curve "body=$tmp/curve" -o "$tmp/basis" >"$tmp/out" 2>&1
            check "checkMesh $storage $plane: morph" "$harmorph" morph "$tmp/foam" "$tmp/basis" \
                --move "$tmp/moves.txt" -o "$tmp/foam-moved"
            check "checkMesh $storage $plane" checkMesh -case "$tmp/foam-moved" -constant
            says "checkMesh $storage $plane: finds nothing wrong" 'Mesh OK.'
        done
    done
else
    echo "OpenFOAM is not installed: checkMesh does not look at the morphed meshes (Debian's openfoam)"
fi
sh tests/hosts/openfoam.sh "$harmorph" "${tmp%/*}" || fail "a case of OpenFOAM" # which counts its own checks
