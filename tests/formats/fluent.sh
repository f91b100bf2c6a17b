# Fluent: bad files. (A part of tests/formats.sh.)
"$harmorph" check "$tmp/fluent.msh" --json >"$tmp/out" 2>&1
says "fluent: zones are markers" '"body", "faces": 24}, {"name": "far", "faces": 24}]'
change() { sed "$1" "$tmp/fluent.msh" >"$tmp/bad.msh"; }
change 's/^(2 2)/(2 3)/'
refuses "fluent: three dimensions" "bad.msh:2: expected 2: meshes of two dimensions are read" \
    "$harmorph" check "$tmp/bad.msh"
change 's/^(10 (1 1 a8/(10 (1 1 a9/'
refuses "fluent: too few nodes" "expected a node's x, found the end of the numbers" "$harmorph" check "$tmp/bad.msh"
change 's/^(10 (1 1 a8/(10 (1 1 a7/'
refuses "fluent: too many nodes" 'the section has more numbers than x and y of 167 nodes' "$harmorph" \
    check "$tmp/bad.msh"
change 's/^(10 (1 1 a8/(10 (1 2 a9/'
refuses "fluent: a node is missing" 'bad.msh:8: expected node 1, found node 2' "$harmorph" check "$tmp/bad.msh"
change 's/^(10 (1 /(3010 (1 /'
refuses "fluent: a binary section without its end" "bad.msh:6: this binary section has no end 'End of Binary Section" \
    "$harmorph" check "$tmp/bad.msh"
change 's/^(64 /(58 /'
refuses "fluent: hanging nodes" 'the mesh has hanging nodes' "$harmorph" check "$tmp/bad.msh"
change 's/^2 2 1 1 0/2 2 9 1 0/'
refuses "fluent: a cell that is not closed" 'the faces of cell 1 (4 faces) do not form a polygon' \
    "$harmorph" check "$tmp/bad.msh"
change 's/^2 2 1 1 0/3 2 1 9 1 0/'
refuses "fluent: a face of three nodes" 'expected 2 nodes of a face between 2 and 2, found 3' "$harmorph" \
    check "$tmp/bad.msh"
change 's/^2 2 1 1 0/2 2 1 2 0/'
refuses "fluent: a cell whose faces are no polygon" 'do not form a polygon' "$harmorph" check "$tmp/bad.msh"
change 's/^2 2 1 1 0/2 1 2 1 0/'
check "fluent: a face the other way round" "$harmorph" check "$tmp/bad.msh"
head -c 5000 "$tmp/fluent.msh" >"$tmp/bad.msh"
refuses "fluent: cut off" 'bad.msh:6: this bracket is not closed before the end of the file' "$harmorph" \
    check "$tmp/bad.msh"
