# Meshes one cell thick between inclined planes, and in wedges, in PLOT3D and UGRID. (A part of formats.sh.)
# turned FILE HOW: the text of a PLOT3D or UGRID file between planes, with other coordinates in space.
turned() {
    awk -v how=$2 -v ugrid=$(case $1 in *.ugrid) echo 1 ;; *) echo 0 ;; esac) '
    function put(x, y, z,    r, t) {   # z, or in UGRID y, is the direction across
        if (ugrid) { t = y; y = z; z = t }
        if (how == "wedge") {
            r = y + 6; t = (z > middle ? 1 : -1) * 2.5 * atan2(0, -1) / 180
            X = x; Y = r * cos(t); Z = r * sin(t)
        } else {
            X = (2 * x - 2 * y + z) / 3; Y = (x + 2 * y + 2 * z) / 3; Z = (-2 * x - y + 2 * z) / 3
        }
    }
    { for (k = 1; k <= NF; k++) word[n++] = $k }
    END {
        first = ugrid ? 7 : 4   # counts; blocks and their sizes
        points = ugrid ? word[0] : word[1] * word[2] * word[3]
        for (k = 0; k < points; k++) for (d = 0; d < 3; d++)
            a[d, k] = word[ugrid ? first + 3 * k + d : first + d * points + k]
        for (k = 0; k < points; k++) middle += a[ugrid ? 1 : 2, k] / points
        for (k = 0; k < first; k++) printf "%s ", word[k]
        print ""
        for (k = 0; k < points; k++) { put(a[0, k], a[1, k], a[2, k]); a[0, k] = X; a[1, k] = Y; a[2, k] = Z }
        for (k = 0; ugrid && k < points; k++) printf "%.17g %.17g %.17g\n", a[0, k], a[1, k], a[2, k]
        for (d = 0; d < 3 && !ugrid; d++) for (k = 0; k < points; k++) printf "%.17g\n", a[d, k]
        for (k = first + 3 * points; k < n; k++) print word[k]
    }' "$1"
}
# moves_as_plane WHAT MESH BODY: the mesh moves as the mesh of its plane does in a file of its own.
moves_as_plane() {
    what=$1 mesh=$2 marker=$3 slip=$4
    morphs "$what" "$mesh" "$marker" $slip
    check "$what: the plane before" "$harmorph" convert "$mesh" "$tmp/before.su2"
    check "$what: the plane after" "$harmorph" convert "$moved" "$tmp/after.su2"
    check "$what: solve the plane" "$harmorph" solve "$tmp/before.su2" --curve "$marker=$tmp/curve" $slip \
        -o "$tmp/basis"
    check "$what: morph the plane" "$harmorph" morph "$tmp/before.su2" "$tmp/basis" --move "$tmp/moves.txt" \
        -o "$tmp/plane.su2"
    check "$what: moves as its plane" alike 1e-12 "$tmp/after.su2" "$tmp/plane.su2"
}
for how in inclined wedge; do
    for file in text-k.p3d text.ugrid; do
        turned "$tmp/$file" $how >"$tmp/$how-$file"
        body=$(body_of "$tmp/$how-$file")
        moves_as_plane "$how $file" "$tmp/$how-$file" "$body"
        check "$how $file: the ring's markers" "$harmorph" check "$tmp/$how-$file" --json
        says "$how $file: the ring's markers: two circles" '"faces": 24}, {"name": '
    done
done
# A nozzle that reaches to the axis: cells there have an edge, or a corner, in common with both planes.
nozzle() {
    awk -v ugrid=$1 'function at(i, j, k) { return j == 0 ? i + 1 : ni * (1 + 2 * (j - 1) + k) + i + 1 }
    function put(i, j, k,    x, r, t) {
        x = .25 * i; r = j / (nj - 1) * (1 + .2 * exp(-4 * (x - 1.5) ^ 2)); t = (2 * k - 1) * 2.5 * atan2(0, -1) / 180
        p[0] = x; p[1] = r * cos(t); p[2] = r * sin(t)
    }
    BEGIN {
        ni = 13; nj = 5
        if (!ugrid) {
            print ni, nj, 2
            for (d = 0; d < 3; d++) for (k = 0; k < 2; k++) for (j = 0; j < nj; j++) for (i = 0; i < ni; i++) {
                put(i, j, k)
                printf "%.17g\n", p[d]
            }
            exit
        }
        n = ni - 1
        # Nodes, triangles, quadrilaterals, tetrahedra, pyramids, prisms, hexahedra.
        print ni * (2 * nj - 1), 4 * n + 2, 2 * n * (nj - 2) + n + 2 * (nj - 2), n, n, 0, n * (nj - 2)
        for (i = 0; i < ni; i++) { put(i, 0, 0); printf "%.17g 0 0\n", p[0] }
        for (j = 1; j < nj; j++) for (k = 0; k < 2; k++) for (i = 0; i < ni; i++) {
            put(i, j, k)
            printf "%.17g %.17g %.17g\n", p[0], p[1], p[2]
        }
        for (k = 0; k < 2; k++) for (i = 0; i < n; i++) {
            print at(i, 0), at(i + 1, 0), at(i, 1, k)
            print at(i + 1, 0), at(i + 1, 1, k), at(i, 1, k)
            tag[t++] = k + 1; tag[t++] = k + 1
        }
        print at(0, 0), at(0, 1, 0), at(0, 1, 1); tag[t++] = 4
        print at(n, 0), at(n, 1, 0), at(n, 1, 1); tag[t++] = 5
        for (k = 0; k < 2; k++) for (j = 1; j < nj - 1; j++) for (i = 0; i < n; i++) {
            print at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k); tag[t++] = k + 1
        }
        j = nj - 1
        for (i = 0; i < n; i++) { print at(i, j, 0), at(i + 1, j, 0), at(i + 1, j, 1), at(i, j, 1); tag[t++] = 3 }
        for (i = 0; i <= n; i += n) for (j = 1; j < nj - 1; j++) {
            print at(i, j, 0), at(i, j + 1, 0), at(i, j + 1, 1), at(i, j, 1); tag[t++] = i ? 5 : 4
        }
        for (i = 0; i < t; i++) print tag[i]
        for (i = 0; i < n; i++) print at(i, 0), at(i + 1, 0), at(i, 1, 0), at(i, 1, 1)
        for (i = 0; i < n; i++) print at(i + 1, 1, 0), at(i + 1, 1, 1), at(i + 1, 0), at(i, 1, 0), at(i, 1, 1)
        for (j = 1; j < nj - 1; j++) for (i = 0; i < n; i++)
            print at(i, j, 0), at(i + 1, j, 0), at(i + 1, j + 1, 0), at(i, j + 1, 0), \
                at(i, j, 1), at(i + 1, j, 1), at(i + 1, j + 1, 1), at(i, j + 1, 1)
    }'
}
awk 'BEGIN { for (i = 3; i <= 6; i++) print i, 0, .05 }' >"$tmp/moves.txt"
nozzle 0 >"$tmp/nozzle.p3d"
nozzle 1 >"$tmp/nozzle.ugrid"
moves_as_plane "nozzle.p3d" "$tmp/nozzle.p3d" 1:jmax "--slip axis,1:imin,1:imax"
check "nozzle.p3d: the axis" "$harmorph" check "$tmp/nozzle.p3d" --json
says "nozzle.p3d: the axis is a marker" '{"name": "axis", "faces": 12}'
says "nozzle.p3d: cells at the axis are whole" '"cells": 48, "triangles": 0, "quads": 48'
moves_as_plane "nozzle.ugrid" "$tmp/nozzle.ugrid" 3 "--slip axis,4,5"
check "nozzle.ugrid: the axis" "$harmorph" check "$tmp/nozzle.ugrid" --json
says "nozzle.ugrid: triangles at the axis" '"cells": 60, "triangles": 24, "quads": 36'
awk 'BEGIN { for (i = 1; i <= 8; i++) print i, .3, .1 }' >"$tmp/moves.txt"
# One plane in three dimensions.
{ echo 25 7 1; sed 1d "$tmp/text.p3d"; awk 'BEGIN { for (i = 0; i < 175; i++) print 2.5 }'; } >"$tmp/one-plane.p3d"
moves_as_plane "plot3d: one plane" "$tmp/one-plane.p3d" 1:jmin
awk 'BEGIN { print "3 3 1"
    for (d = 0; d < 3; d++) for (j = 0; j < 3; j++) for (i = 0; i < 3; i++)
        print d == 0 ? i : d == 1 ? j : .1 * i * j }' \
    >"$tmp/bent.p3d"
refuses "plot3d: one plane that is none" 'the points must lie in a plane x, y or z = constant' "$harmorph" \
    check "$tmp/bent.p3d"
awk 'BEGIN { print "4 3 3"
    for (d = 0; d < 3; d++) for (k = 0; k < 3; k++) for (j = 0; j < 3; j++) for (i = 0; i < 4; i++)
        print d == 0 ? i : d == 1 ? j : k }' >"$tmp/two-cells.p3d"
refuses "plot3d: two cells thick" 'not one cell thick: block 1 (4 x 3 x 3) has no direction of two points' "$harmorph" \
    check "$tmp/two-cells.p3d"
# Hexahedra in two layers: planes that have cells on both sides.
awk 'function at(i, j, k) { return 1 + i + 3 * (j + 3 * k) } BEGIN {
    print 27, 0, 24, 0, 0, 0, 8
    for (k = 0; k < 3; k++) for (j = 0; j < 3; j++) for (i = 0; i < 3; i++) print i, j, k
    for (k = 0; k < 3; k += 2) for (j = 0; j < 2; j++) for (i = 0; i < 2; i++) {
        print at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k)
        print at(i, k, j), at(i + 1, k, j), at(i + 1, k, j + 1), at(i, k, j + 1)
        print at(k, i, j), at(k, i + 1, j), at(k, i + 1, j + 1), at(k, i, j + 1) }
    for (f = 0; f < 24; f++) print 1
    for (k = 0; k < 2; k++) for (j = 0; j < 2; j++) for (i = 0; i < 2; i++)
        print at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k), \
            at(i, j, k + 1), at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1), at(i, j + 1, k + 1) }' >"$tmp/cube.ugrid"
refuses "ugrid: three dimensions in earnest" \
    'there are no two planes in which each cell has a face; cell 1 begins at (0, 0, 0)' \
    "$harmorph" check "$tmp/cube.ugrid"
sed '169s/.*/1 2 30 50/' "$tmp/nozzle.ugrid" >"$tmp/bad.ugrid"
refuses "ugrid: a face that no cell has" \
    'bad.ugrid:169: no cell has this face of the boundary, which begins at (0, 0, 0)' \
    "$harmorph" check "$tmp/bad.ugrid"
echo "2 2 2 8*0 8*0 8*0" >"$tmp/one-point.p3d"
refuses "plot3d: a cell that is one point" 'not one cell thick: there are no two planes' "$harmorph" \
    check "$tmp/one-point.p3d"
# Points in tables have the numbers that they have in the file, also where the file does not begin with one plane.
mesh=$tmp/text.ugrid body=$(body_of "$tmp/text.ugrid")
numbered() { # numbered CSV: column 1 of each row is the point of the file with the coordinates in columns 2 and 3
    awk -F '[, ]+' 'FNR == NR { for (k = 1; k <= NF; k++) if ($k != "") word[n++] = $k; next }
        FNR > 1 { at = 7 + 3 * $1; d = word[at] - $2; e = word[at + 2] - $3; seen++
            if (d * d + e * e > 1e-12) exit 1 } END { exit seen < 24 }' "$mesh" "$1"
}
check "numbers: solve" "$harmorph" solve "$mesh" --curve "$body=$tmp/curve" -o "$tmp/basis"
check "numbers: export" "$harmorph" export "$mesh" "$tmp/basis" --function 1 --csv "$tmp/values.csv"
check "numbers: export: those of the file" numbered "$tmp/values.csv"
check "numbers: morph" "$harmorph" morph "$mesh" "$tmp/basis" --by '1 .01 .02' -o "$tmp/x.ugrid" --csv "$tmp/wall.csv"
awk -F, '$1 == "mesh" { print $3, .01, .02 * $5 }' "$tmp/wall.csv" >"$tmp/by-number.txt"
awk -F, 'BEGIN { print "x,y,dx,dy" } $1 == "mesh" { print $5 "," $6 "," .01 "," .02 * $5 }' "$tmp/wall.csv" \
    >"$tmp/by-place.csv"
for table in by-number.txt by-place.csv; do
    check "numbers: displace: $table" "$harmorph" displace "$mesh" --given "$body" --wall "$tmp/$table" \
        -o "$tmp/$table.ugrid"
done
check "numbers: displace: the same mesh" cmp "$tmp/by-number.txt.ugrid" "$tmp/by-place.csv.ugrid"
echo '999999 0 0' >"$tmp/behind.txt"
refuses "numbers: a number behind the last point" 'and no point 999999' "$harmorph" displace "$mesh" \
    --given "$body" --wall "$tmp/behind.txt" -o "$tmp/x"
