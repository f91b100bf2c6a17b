# UGRID: names of boundaries, bad files. (A part of tests/program/formats.sh.)
printf '4\n1 4000 body\n2 5000 outer rim\n3 6662 sym1\n4 6662 sym2\n' >"$tmp/prisms.mapbc"
check "ugrid: names of a .mapbc file" "$harmorph" check "$tmp/prisms.lb8.ugrid" --json
says "ugrid: names of a .mapbc file: those that are not in the planes" \
    '"body", "faces": 24}, {"name": "outer", "faces": 24}]'
mkdir "$tmp/named"
cp "$tmp/prisms.lb8.ugrid" "$tmp/named/prisms.lb8.ugrid"
cp "$tmp/prisms.mapbc" "$tmp/named/prisms.mapbc"
morphs "ugrid: names of a .mapbc file" "$tmp/named/prisms.lb8.ugrid" body
check "ugrid: the names go with the morphed mesh" cmp "$tmp/prisms.mapbc" "$tmp/named/moved-prisms.mapbc"
check "ugrid: the basis fits the morphed mesh, which has the names" "$harmorph" morph "$moved" "$tmp/basis" \
    --move "$tmp/moves.txt" -o "$tmp/named/again.lb8.ugrid"
sed 's/body/wing/' "$tmp/prisms.mapbc" >"$tmp/named/again.mapbc"
check "ugrid: other names at the place of the morphed mesh" "$harmorph" morph "$moved" "$tmp/basis" \
    --move "$tmp/moves.txt" -o "$tmp/named/again.lb8.ugrid"
says "ugrid: other names at the place of the morphed mesh: they are named" \
    'again.mapbc, which was there before and differs from'
check "ugrid: other names at the place of the morphed mesh: they stay" grep wing "$tmp/named/again.mapbc"
mkdir "$tmp/stale"
cp "$tmp/prisms.lb8.ugrid" "$tmp/stale/unnamed.lb8.ugrid"
cp "$tmp/prisms.mapbc" "$tmp/stale/moved-unnamed.mapbc"
check "ugrid: no names: fit" "$harmorph" fit "$tmp/stale/unnamed.lb8.ugrid" --marker 1 --points 8 -o "$tmp/curve"
check "ugrid: no names: solve" "$harmorph" solve "$tmp/stale/unnamed.lb8.ugrid" --curve "1=$tmp/curve" \
    -o "$tmp/stale/basis"
check "ugrid: names at the place of the morphed mesh of a mesh without names" "$harmorph" morph \
    "$tmp/stale/unnamed.lb8.ugrid" "$tmp/stale/basis" --move "$tmp/moves.txt" -o "$tmp/stale/moved-unnamed.lb8.ugrid"
says "ugrid: names at the place of the morphed mesh of a mesh without names: they are named" \
    'moved-unnamed.mapbc, which was there before;'
"$harmorph" morph "$tmp/named/prisms.lb8.ugrid" "$tmp/basis" --move "$tmp/moves.txt" -o "$tmp/stale/x.lb8.ugrid" \
    --vtu "$tmp/stale/x.mapbc" >"$tmp/out" 2>&1
code=$?
says "ugrid: another output in the place of the names: refused by name" 'x.mapbc: two outputs need two files'
check "ugrid: another output in the place of the names: refused" test $code = 2
check "ugrid: another output in the place of the names: nothing is written" test ! -e "$tmp/stale/x.lb8.ugrid"
check "ugrid: in place, the names stay" "$harmorph" morph "$moved" "$tmp/basis" --move "$tmp/moves.txt" -o "$moved"
check "ugrid: in place, the names stay: the same" cmp "$tmp/prisms.mapbc" "$tmp/named/moved-prisms.mapbc"
echo 'body 5' >>"$tmp/prisms.mapbc"
refuses "ugrid: a bad .mapbc file" 'prisms.mapbc:6: the file needs' "$harmorph" check "$tmp/prisms.lb8.ugrid"
rm "$tmp/prisms.mapbc"
head -c 9000 "$tmp/prisms.lb8.ugrid" >"$tmp/bad.lb8.ugrid"
refuses "ugrid: cut off" 'little-endian byte order the file would have' "$harmorph" check "$tmp/bad.lb8.ugrid"
cp "$tmp/bad.lb8.ugrid" "$tmp/bad.b8.ugrid"
refuses "ugrid: cut off, and of the other byte order than its name says" 'bad.b8.ugrid' "$harmorph" \
    check "$tmp/bad.b8.ugrid"
printf '4 0 0 1 0 0 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 2 3 4\n' >"$tmp/bad.ugrid"
refuses "ugrid: three dimensions in earnest" 'bad.ugrid:1: the mesh has no prisms and no hexahedra' "$harmorph" \
    check "$tmp/bad.ugrid"
sed '20s/^[^ ]*/7/' "$tmp/text.ugrid" >"$tmp/bad.ugrid"
refuses "ugrid: a point without a partner" \
    'bad.ugrid:20: the mesh has three dimensions and is not one cell thick: the projection of point 18 is' \
    "$harmorph" check "$tmp/bad.ugrid"
