# Fluent: polygons one cell thick, and bad files. (A part of tests/program/formats.sh.)
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
# Cells that no face names: the first ones, or all between the first and the last.
for gap in 1 2 3; do
    awk -v cell=$((gap + 1)) 'BEGIN {
        printf "(2 2)\n(10 (0 1 4 0 2))\n(12 (0 1 %x 0))\n(13 (0 1 4 0))\n(10 (1 1 4 1 2)(", cell
        printf "\n0 0\n1 0\n1 1\n0 1\n))\n(13 (3 1 4 3 2)(\n"
        for (i = 1; i <= 4; i++) printf "%x %x %x 0\n", i, i % 4 + 1, cell
        print "))" }' >"$tmp/bad.msh"
    refuses "fluent: $gap cells without faces" 'the faces of cell 1 (0 faces) do not form a polygon' \
        "$harmorph" check "$tmp/bad.msh"
done
tr -d '\r' <"$tmp/fluent.msh" | awk 'NF >= 4 { for (k = NF - 1; k <= NF; k++) if ($k == "90") $k = "a0" } { print }' \
    >"$tmp/bad.msh"
refuses "fluent: cells without faces between others" 'the faces of cell 144 (0 faces) do not form a polygon' \
    "$harmorph" check "$tmp/bad.msh"
# Sections whose first word is no number are settings in Scheme: brackets in their texts and characters do not count,
# and the mesh is that of the file without them.
n=0
while IFS= read -r section; do
    n=$((n + 1))
    case $n in
    1 | 3 | 5) { printf '%s\n' "$section"; cat "$tmp/fluent.msh"; } >"$tmp/settings.msh" ;;
    *) sed '$d' "$tmp/fluent.msh" >"$tmp/settings.msh"
       { printf '%s\n' "$section"; tail -n 1 "$tmp/fluent.msh"; } >>"$tmp/settings.msh" ;;
    esac
    "$harmorph" check "$tmp/fluent.msh" --json >"$tmp/wanted.json" 2>&1
    "$harmorph" check "$tmp/settings.msh" --json >"$tmp/settings.json" 2>&1
    check "fluent: settings $n: the same mesh" cmp "$tmp/wanted.json" "$tmp/settings.json"
done <<'END'
(cad/options ((recursive? #f) (pattern "^(Color|Layer[0-9]:).*\\") (file "a\(b\\\"c)") (empty "")))
(cad/options (file "a (old) \"(((\" ") (n 1e-3))
(rp-vars ((one #t) (two "))))") (three #\() (four #\))))
(%settings () ((())))
(3d-view "unbalanced ( \\" (1 2 3))
(2d? #t)
(-5 (a list))
( cad "C:\")
END
morphs "fluent: settings in Scheme" "$tmp/settings.msh" body
echo '(cad "without a mesh")' >"$tmp/bad.msh"
refuses "fluent: settings alone" "no known mesh file begins with" "$harmorph" check "$tmp/bad.msh"
refuses "fluent: settings alone, as Fluent" "the file needs a section (10 ...) with nodes" "$harmorph" \
    check "$tmp/bad.msh" --format fluent
{ echo '(cad (never "closed"'; cat "$tmp/fluent.msh"; } >"$tmp/bad.msh"
refuses "fluent: settings that are not closed" 'bad.msh:1: this bracket is not closed before the end of the file' \
    "$harmorph" check "$tmp/bad.msh" --format fluent
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
