# PLOT3D: names of boundaries, repeat counts, bad files, wakes. (A part of tests/program/formats.sh.)
cat >"$tmp/text-k.nmf" <<'END'
# a ring, one cell thick
1
1 25 7 2
# type       block face from to from to
symmetry_z   1 1  1 25  1 7
symmetry_z   1 2  1 25  1 7
lower_wall   1 5  1 2   1 13
upper_wall   1 5  1 2   13 25
farfield     1 6  1 2   1 25
one_to_one   1 3  1 7   1 2   1 4  1 7  1 2 false
END
check "plot3d: names of a .nmf file" "$harmorph" check "$tmp/text-k.p3d" --json
says "plot3d: names of a .nmf file: a side of two parts" \
    '"farfield", "faces": 24}, {"name": "lower_wall", "faces": 12}, {"name": "upper_wall", "faces": 12}'
morphs "plot3d: names of a .nmf file" "$tmp/text-k.p3d" lower_wall,upper_wall
check "plot3d: the names go with the morphed mesh" cmp "$tmp/text-k.nmf" "$tmp/moved-text-k.nmf"
check "plot3d: a sample" "$harmorph" sample "$tmp/text-k.p3d" "$tmp/basis" --count 2 --range=-.01,.01 --meshes \
    -o "$tmp/named-sample"
check "plot3d: the names go with each mesh of a sample" cmp "$tmp/text-k.nmf" "$tmp/named-sample/meshes/0000002.nmf"
if has_zlib; then
    gzip -c "$tmp/text-k.p3d" >"$tmp/text-k.p3d.gz"
    check "plot3d: names of a compressed mesh" "$harmorph" check "$tmp/text-k.p3d.gz" --json
    says "plot3d: names of a compressed mesh: a side of two parts" '{"name": "lower_wall", "faces": 12}'
    rm "$tmp/text-k.p3d.gz"
fi
rm "$tmp/moved-text-k.nmf"
sed -i.old 's/^1 25 7 2/1 25 8 2/' "$tmp/text-k.nmf"
refuses "plot3d: .nmf of other sizes" \
    "text-k.nmf:3: the file needs the size of the block between 7 and 7 here, but '8' follows" \
    "$harmorph" \
    check "$tmp/text-k.p3d"
rm "$tmp/text-k.nmf"
# Points of several blocks have the numbers of the file, also those that blocks have in common.
two=$tmp/two-text-iblank.p3d
body=$(body_of "$two")
check "plot3d: two blocks: fit" "$harmorph" fit "$two" --marker "$body" --points 8 -o "$tmp/curve"
check "plot3d: two blocks: solve" "$harmorph" solve "$two" --curve "$body=$tmp/curve" -o "$tmp/basis"
check "plot3d: two blocks: export" "$harmorph" export "$two" "$tmp/basis" --function 1 --csv "$tmp/two.csv"
points_of_blocks() { tr -s ' \n' '\n' <"$two" | awk 'NF { v[n++] = $1 }
    END { at = 1 + 2 * v[0]
        for (b = 0; b < v[0]; b++) {
            m = v[1 + 2 * b] * v[2 + 2 * b]
            for (k = 0; k < m; k++) print point++, v[at + k], v[at + m + k]
            at += 3 * m
        } }'; }
points_of_blocks >"$tmp/in-file"
are_those_of_the_file() { tail -n +2 "$tmp/two.csv" | tr , ' ' | awk '
    FILENAME != "-" { x[$1] = $2; y[$1] = $3; next }
    { d = (x[$1] - $2) ^ 2 + (y[$1] - $3) ^ 2; if (!($1 in x) || d > 1e-20) bad = 1; n++ }
    END { exit bad || n == 0 }' "$tmp/in-file" -; }
check "plot3d: two blocks: points have the numbers of the file" are_those_of_the_file
# A row for each point of the file: derivatives at common points are added.
awk '{ print $1, sin($1), cos($1) }' "$tmp/in-file" >"$tmp/by-number.txt"
awk 'BEGIN { print "x,y,Sensitivity_x,Sensitivity_y" } { print $2 "," $3 "," sin($1) "," cos($1) }' "$tmp/in-file" \
    >"$tmp/by-place.csv"
for table in by-number.txt by-place.csv; do
    check "plot3d: two blocks: adjoint, $table" "$harmorph" adjoint "$two" "$tmp/basis" --sensitivity "$tmp/$table" \
        -o "$tmp/gradient.txt"
    grep -v '^#' "$tmp/gradient.txt" >"$tmp/rows-$table"
done
check "plot3d: two blocks: the same gradient by numbers and by places" alike 1e-12 "$tmp/rows-by-number.txt" \
    "$tmp/rows-by-place.csv"
{ echo "x,y,dx,dy"; awk '{ print $2 "," $3 "," .01 * $2 "," .02 * $3 }' "$tmp/in-file"; } >"$tmp/all.csv"
check "plot3d: two blocks: displacements of all points of the file" "$harmorph" displace "$two" --given "$body" \
    --wall "$tmp/all.csv" -o "$tmp/displaced.p3d"

# Runs of equal numbers in a line as n*number, and the sizes, too: the same mesh.
tr '\n' ' ' <"$tmp/text-k.p3d" | awk '{
    line = ""
    for (k = 1; k <= NF; k += n) {
        for (n = 1; k + n <= NF && $(k + n) == $k; n++);
        line = line " " (n > 1 ? n "*" $k : $k)
    }
    print line
}' >"$tmp/repeats.p3d"
check "plot3d: repeat counts: there are some" grep -q '175\*' "$tmp/repeats.p3d"
check "plot3d: repeat counts" "$harmorph" convert "$tmp/repeats.p3d" "$tmp/a.su2"
check "plot3d: repeat counts: the mesh with all numbers" "$harmorph" convert "$tmp/text-k.p3d" "$tmp/b.su2"
check "plot3d: repeat counts: the same mesh" cmp "$tmp/a.su2" "$tmp/b.su2"
check "plot3d: repeat counts: fit" "$harmorph" fit "$tmp/repeats.p3d" --marker 1:jmin --points 8 -o "$tmp/curve"
check "plot3d: repeat counts: solve" "$harmorph" solve "$tmp/repeats.p3d" --curve "1:jmin=$tmp/curve" -o "$tmp/basis"
check "plot3d: repeat counts: morph" "$harmorph" morph "$tmp/repeats.p3d" "$tmp/basis" --move "$tmp/moves.txt" \
    -o "$tmp/a.p3d"
check "plot3d: repeat counts: morph with all numbers" "$harmorph" morph "$tmp/text-k.p3d" "$tmp/basis" \
    --move "$tmp/moves.txt" -o "$tmp/b.p3d"
check "plot3d: repeat counts: the same numbers" \
    sh -c "tr -s ' \n' '\n\n' <'$tmp/a.p3d' >'$tmp/a'; tr -s ' \n' '\n\n' <'$tmp/b.p3d' >'$tmp/b'
        cmp '$tmp/a' '$tmp/b'"
head -c 2000 "$tmp/fortran-swapped.p3d" >"$tmp/bad.p3d"
refuses "plot3d: cut off records" \
    'byte 16: the record of block 1 (1 block 25 x 7) has 3500 bytes, but the file ends after 1980' \
    "$harmorph" check "$tmp/bad.p3d"
sed '$d' "$tmp/text.p3d" >"$tmp/bad.p3d"
refuses "plot3d: cut off text" 'the file would have 352 numbers, but it has' "$harmorph" check "$tmp/bad.p3d"
awk 'BEGIN {
    print "3 3 3"
    for (d = 0; d < 3; d++) for (k = 0; k < 3; k++) for (j = 0; j < 3; j++) for (i = 0; i < 3; i++) {
        print d == 0 ? i : d == 1 ? j : k
    }
}' >"$tmp/cube.p3d"
refuses "plot3d: three dimensions in earnest" 'the mesh has three dimensions and is not one cell thick' "$harmorph" \
    check "$tmp/cube.p3d"
awk 'BEGIN {
    print "4 3 2"
    for (d = 0; d < 3; d++) for (k = 0; k < 2; k++) for (j = 0; j < 3; j++) for (i = 0; i < 4; i++) {
        print d == 0 ? i + .1 * (k == 1 && i == 2) : d == 1 ? j : k
    }
}' >"$tmp/skew.p3d"
refuses "plot3d: a point without a partner" 'the projection of point 14 is 1.00000e-1 away from the nearest point' \
    "$harmorph" check "$tmp/skew.p3d"
# A C-mesh round a plate: both sides of the wake have the same coordinates; the corner i = 1 is a pole.
awk 'BEGIN { pi = atan2(0, -1); ni = 41; nj = 7; print ni, nj
    for (d = 0; d < 2; d++) for (j = 0; j < nj; j++) for (i = 0; i < ni; i++) {
        s = (i - 20) / 20; wake = s < 0 ? -s : s
        side = s < 0 ? -1 : 1
        if (wake > .5) { x = fx = 1 + 8 * (wake - .5); y = 0; fy = 2 * side } else {
            t = 2 * pi * wake; x = (1 - cos(t)) / 2; y = .1 * side * sin(t)
            t = pi - pi * wake; fx = 1 + 2 * cos(t); fy = 2 * side * sin(t) }
        r = j / (nj - 1); r = r * r
        print d == 0 ? x + r * (fx - x) : y + r * (fy - y) } }' >"$tmp/wake.p3d"
check "plot3d: a wake is a cut" "$harmorph" check "$tmp/wake.p3d" --json
says "plot3d: a wake is a cut: what is left is the airfoil" '"1:jmin", "faces": 20}'
says "plot3d: a wake is a cut: and no points are double" '"points": 276'
