# Fluent: polygons one cell thick, and bad files. (A part of tests/formats.sh.)
"$harmorph" check "$tmp/fluent.msh" --json >"$tmp/out" 2>&1
says "fluent: zones are markers" '"body", "faces": 24}, {"name": "far", "faces": 24}]'
change() { sed "$1" "$tmp/fluent.msh" >"$tmp/bad.msh"; }
change 's/^(2 2)/(2 1)/'
refuses "fluent: one dimension" "bad.msh:2: the file needs the dimension, 2 or 3 here, but '1' follows" \
    "$harmorph" check "$tmp/bad.msh"
change 's/^(10 (1 1 a8/(10 (1 1 a9/'
refuses "fluent: too few nodes" "the file needs a node's x here, but the end of the numbers follows" \
    "$harmorph" check "$tmp/bad.msh"
change 's/^(10 (1 1 a8/(10 (1 1 a7/'
refuses "fluent: too many nodes" 'the section has more numbers than those of 167 nodes' "$harmorph" \
    check "$tmp/bad.msh"
change 's/^(10 (1 1 a8/(10 (1 2 a9/'
refuses "fluent: a node is missing" 'bad.msh:8: the file needs node 1 here, but node 2 follows' \
    "$harmorph" check "$tmp/bad.msh"
change 's/^(10 (1 /(3010 (1 /'
refuses "fluent: a binary section without its end" "bad.msh:6: this binary section has no end 'End of Binary Section" \
    "$harmorph" check "$tmp/bad.msh"
change 's/^(64 /(58 /'
refuses "fluent: hanging nodes" 'the mesh has hanging nodes' "$harmorph" check "$tmp/bad.msh"
change 's/^2 2 1 1 0/2 2 9 1 0/'
refuses "fluent: a cell that is not closed" 'the faces of cell 1 (4 faces) do not form a polygon' \
    "$harmorph" check "$tmp/bad.msh"
change 's/^2 2 1 1 0/3 2 1 9 1 0/'
refuses "fluent: a face of three nodes" 'the file needs 2 nodes of a face between 2 and 2 here, but 3 follows' \
    "$harmorph" \
    check "$tmp/bad.msh"
change 's/^2 2 1 1 0/2 2 1 2 0/'
refuses "fluent: a cell whose faces are no polygon" 'do not form a polygon' "$harmorph" check "$tmp/bad.msh"
change 's/^2 2 1 1 0/2 1 2 1 0/'
check "fluent: a face the other way round" "$harmorph" check "$tmp/bad.msh"
head -c 5000 "$tmp/fluent.msh" >"$tmp/bad.msh"
refuses "fluent: cut off" 'bad.msh:6: this bracket is not closed before the end of the file' "$harmorph" \
    check "$tmp/bad.msh"

# Three dimensions: prisms between polygons.
"$make_mesh" fluent-polygons.msh "$tmp/fluent-polygons.msh"
"$harmorph" check "$tmp/fluent-polygons.msh" --json >"$tmp/out" 2>&1
says "fluent: prisms of polygons: cells" '"cells": 72'
says "fluent: prisms of polygons: the planes are no markers" \
    '[{"name": "body", "faces": 24}, {"name": "far", "faces": 24}]'
morphs "fluent: prisms of polygons" "$tmp/fluent-polygons.msh" body
sed 1,2d "$moved" | awk 'NF == 1 { v[n++] = $1 } END {   # both planes move alike
        for (k = 0; k < 504; k++) if (k % 3 < 2 && v[k] != v[k + 504]) exit 1
        exit n < 1008 }'
passes "fluent: prisms of polygons: both planes move alike" $?
solid() { sed "$1" "$tmp/fluent-solid.msh" >"$tmp/bad.msh"; }
solid 's/^(13 (14 1 1 7 4)/(13 (14 1 1 7 2)/; s/^(13 (3 \([0-9a-f]*\) \([0-9a-f]*\) 2 4)/(13 (3 \1 \2 2 2)/'
refuses "fluent: three dimensions: faces of two nodes" 'faces of the type 2, but a face of three dimensions has' \
    "$harmorph" check "$tmp/bad.msh"
solid 's/^(13 (10 \([0-9a-f]*\) \([0-9a-f]*\) 3 0)( 4 1 2/(13 (10 \1 \2 3 0)( 4 1 3/'
refuses "fluent: three dimensions: a cell that is not closed" 'not one cell thick' "$harmorph" check "$tmp/bad.msh"
solid 's/^(13 (10 \([0-9a-f]*\) \([0-9a-f]*\) 3 0)( 4 1 2/(13 (10 \1 \2 3 0)( 4 1 fff/'
refuses "fluent: three dimensions: no such node" 'a face names node 4095, but there are 336 nodes' "$harmorph" \
    check "$tmp/bad.msh"
