#!/bin/sh
# Tests of mesh files: sh tests/formats.sh path/to/harmorph folder/for/output
if [ $# -ne 2 ]; then
    echo "usage: sh tests/formats.sh HARMORPH OUTPUT" >&2
    exit 2
fi
harmorph=$1 tmp=$2/formats-test
: "${CXX:=c++}"
rm -rf "$tmp"
mkdir -p "$tmp" || exit 2
topic="mesh files" log=$tmp/out
. "$(dirname "$0")/count.sh"

says() { # says NAME TEXT: the last command checked, on either output
    if grep -F -e "$2" "$tmp/out" >/dev/null; then ok "$1"; else fail "$1: does not say '$2'"; fi
}
refuses() { # refuses NAME TEXT COMMAND...: exit code 3, and the message contains the text
    name=$1 text=$2; shift 2
    "$@" >"$tmp/out" 2>&1
    code=$?
    if [ $code -eq 3 ] && grep -F -e "$text" "$tmp/out" >/dev/null; then ok "$name"; else
        fail "$name: exit code $code, does not say '$text'"
        sed 's/^/     | /' "$tmp/out" | head -5
    fi
}
alike() { # alike TOLERANCE A B: all numbers of two files are the same to this tolerance, all else is the same
    awk -v eps="$1" 'NR == FNR { line[FNR] = $0; n = FNR; next }
        { m = split(line[FNR], a); if (m != NF) exit 1
          for (k = 1; k <= NF; k++) {
              d = a[k] - $k
              is_text = a[k] + 0 == 0 && a[k] !~ /^[-+.0-9e]*$/
              if (d > eps || -d > eps || (is_text && a[k] "" != $k "")) { bad = 1; exit } } }
        END { exit bad || FNR != n }' "$2" "$3"
}
body_of() { # the markers of the ring's inner circle, with commas
    "$harmorph" check "$@" --json 2>/dev/null | grep -o '"name": "[^"]*"' | sed 's/.*: "//; s/"//' |
        grep -E '^(body|zone:16|1|boundary1|[0-9]:[jk]min)$' | paste -s -d , -
}

check "make_mesh is compiled" $CXX -std=c++17 -O0 -o "$tmp/make_mesh" tests/formats/make_mesh.cpp
make_mesh=$tmp/make_mesh
awk 'BEGIN { for (i = 1; i <= 8; i++) print i, .3, .1 }' >"$tmp/moves.txt"
echo "# nothing moves" >"$tmp/none.txt"

# ---- Every kind: check, fit, solve, morph --------------------------------------------------------------------------

# What is read, written again by make_mesh, is the file; what is morphed is make_mesh's file of the new coordinates.
"$make_mesh" plain.su2 "$tmp/ring.su2"
for kind in plain.su2 $("$make_mesh" list | grep -v plain.su2); do
    mesh=$tmp/$kind moved=$tmp/moved-$kind zone= close=1e-9
    case $kind in zones.su2) zone="--zone 2" ;; text*.vtk | fixed.su2 | leading-zero.su2) close=1e-7 ;; *single*) close=1e-5 ;; esac
    "$make_mesh" $kind "$mesh"
    check "$kind: check" "$harmorph" check "$mesh" $zone
    before=$tmp/before.su2 after=$tmp/after.su2
    check "$kind: convert" "$harmorph" convert "$mesh" "$before" $zone
    body=$(body_of "$mesh" $zone)
    check "$kind: fit" "$harmorph" fit "$mesh" --marker "$body" --points 8 -o "$tmp/curve" $zone
    check "$kind: solve" "$harmorph" solve "$mesh" --curve "$body=$tmp/curve" -o "$tmp/basis" $zone
    check "$kind: zero move" "$harmorph" morph "$mesh" "$tmp/basis" --move "$tmp/none.txt" -o "$moved" $zone
    check "$kind: zero move: the same file" cmp "$mesh" "$moved"
    check "$kind: morph" "$harmorph" morph "$mesh" "$tmp/basis" --move "$tmp/moves.txt" -o "$moved" $zone
    check "$kind: morph: the mesh moved" sh -c "! cmp -s '$mesh' '$moved'"
    [ $kind = zones.su2 ] || check "$kind: the format is forced" "$harmorph" check "$mesh" --format \
        "$(case $kind in *.su2) echo su2 ;; fluent*) echo fluent ;; *.msh) echo gmsh ;; *.ugrid) echo ugrid ;; *.vtk) echo vtk ;; *.vtu) echo vtu ;; *) echo plot3d ;; esac)"
    check "$kind: convert the morphed" "$harmorph" convert "$moved" "$after" $zone
    # Points of two blocks have another order.
    case $kind in two-*)
        for file in "$before" "$after"; do
            mv "$file" "$tmp/two-points.su2"
            "$make_mesh" plain.su2 "$file" "$tmp/two-points.su2"
        done ;;
    esac
    if [ $kind = quadratic.msh ]; then
        "$make_mesh" $kind "$tmp/expected" "$after"
        check "$kind: middles of edges move along with them" alike 1e-12 "$tmp/expected" "$moved"
    else
        "$make_mesh" $kind "$tmp/expected" "$before"
        check "$kind: read as it is" cmp "$tmp/expected" "$mesh"
        "$make_mesh" $kind "$tmp/expected" "$after"
        check "$kind: morph: only coordinates differ" cmp "$tmp/expected" "$moved"
    fi
    sed '1,/^NPOIN/d; /^NMARK/,$d' "$after" | awk '{ print $1, $2 }' >"$tmp/points"
    [ $kind = plain.su2 ] && cp "$tmp/points" "$tmp/points-of-all"
    [ $kind = prisms.lb8.ugrid ] || check "$kind: moves as all do" alike $close "$tmp/points-of-all" "$tmp/points"
done

# ---- What is particular ----------------------------------------------------------------------------------------------

refuses "several zones: which" "zones.su2:1: the file has 3 zones: choose one with --zone" "$harmorph" check "$tmp/zones.su2"
"$harmorph" check "$tmp/zones.su2" --zone 4 >"$tmp/out" 2>&1
says "several zones: one that does not exist" 'between 1 and 3'
sed 's/^IZONE= 3/IZONE= 4/' "$tmp/zones.su2" >"$tmp/bad.su2"
refuses "several zones: out of order" 'expected IZONE= 3' "$harmorph" check "$tmp/bad.su2" --zone 2
sed '/^IZONE= 3/,$d' "$tmp/zones.su2" >"$tmp/bad.su2"
refuses "several zones: one is missing" 'bad.su2:1: NZONE= announces 3 zones' "$harmorph" check "$tmp/bad.su2" --zone 2
sed 's/MARKER_TAG= far/MARKERTAG= far/' "$tmp/ring.su2" >"$tmp/bad.su2"
line=$(grep -n MARKERTAG "$tmp/bad.su2" | cut -d: -f1)
refuses "MARKERTAG" "bad.su2:$line: expected MARKER_TAG=" "$harmorph" check "$tmp/bad.su2"
"$harmorph" check "$tmp/odd.su2" >"$tmp/out" 2>&1
says "faces between cells are ignored, and said" "24 faces of marker 'inside line' between two cells"
echo 'hello world' >"$tmp/bad.mesh"
refuses "no mesh at all" "bad.mesh:1: no mesh file that is known begins with 'hello world'" "$harmorph" check "$tmp/bad.mesh"
: >"$tmp/bad.mesh"
refuses "an empty file" 'the file is empty' "$harmorph" check "$tmp/bad.mesh"
"$harmorph" check "$tmp/ring.su2" --format cgnz >"$tmp/out" 2>&1
says "an unknown format" "unknown format 'cgnz'"

# Gmsh
sed 's/^2.2 /2.9 /' "$tmp/text-2.msh" >"$tmp/bad.msh"
refuses "gmsh: another version" 'bad.msh:2: expected version 2.2 or 4.1' "$harmorph" check "$tmp/bad.msh"
sed '50s/ 0$/ 1/' "$tmp/text-2.msh" >"$tmp/bad.msh"
refuses "gmsh: three dimensions" 'bad.msh:50: expected points in one plane' "$harmorph" check "$tmp/bad.msh"
sed 's/^100 3 2 3 7 \(.*\)/100 5 2 3 7 \1 \1/' "$tmp/text-2.msh" >"$tmp/bad.msh"
refuses "gmsh: hexahedra" 'element type 5: a mesh of three dimensions' "$harmorph" check "$tmp/bad.msh"
sed '/^\$EndNodes/,$d' "$tmp/text-4.msh" >"$tmp/bad.msh"
refuses "gmsh: cut off" 'found the end of the file' "$harmorph" check "$tmp/bad.msh"
sed '/^[0-9]* 1 2 2 7/d; s/^192$/168/' "$tmp/text-2.msh" >"$tmp/open.msh"
check "gmsh: boundary without lines" "$harmorph" check "$tmp/open.msh" --json
says "gmsh: boundary without lines: gets a name" '"boundary1", "faces": 24'

# PLOT3D
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
sed -i.old 's/^1 25 7 2/1 25 8 2/' "$tmp/text-k.nmf"
refuses "plot3d: .nmf of other sizes" "text-k.nmf:3: expected the block's size between 7 and 7, found '8'" "$harmorph" check "$tmp/text-k.p3d"
rm "$tmp/text-k.nmf"
# Runs of equal numbers in a line as n*number, and the sizes, too: the same mesh.
tr '\n' ' ' <"$tmp/text-k.p3d" | awk '{ line = ""; for (k = 1; k <= NF; k += n) {
    for (n = 1; k + n <= NF && $(k + n) == $k; n++); line = line " " (n > 1 ? n "*" $k : $k) } print line }' >"$tmp/repeats.p3d"
check "plot3d: repeat counts: there are some" grep -q '175\*' "$tmp/repeats.p3d"
check "plot3d: repeat counts" "$harmorph" convert "$tmp/repeats.p3d" "$tmp/a.su2"
check "plot3d: repeat counts: the mesh with all numbers" "$harmorph" convert "$tmp/text-k.p3d" "$tmp/b.su2"
check "plot3d: repeat counts: the same mesh" cmp "$tmp/a.su2" "$tmp/b.su2"
check "plot3d: repeat counts: fit" "$harmorph" fit "$tmp/repeats.p3d" --marker 1:jmin --points 8 -o "$tmp/curve"
check "plot3d: repeat counts: solve" "$harmorph" solve "$tmp/repeats.p3d" --curve "1:jmin=$tmp/curve" -o "$tmp/basis"
check "plot3d: repeat counts: morph" "$harmorph" morph "$tmp/repeats.p3d" "$tmp/basis" --move "$tmp/moves.txt" -o "$tmp/a.p3d"
check "plot3d: repeat counts: morph with all numbers" "$harmorph" morph "$tmp/text-k.p3d" "$tmp/basis" --move "$tmp/moves.txt" -o "$tmp/b.p3d"
check "plot3d: repeat counts: the same numbers" sh -c "tr -s ' \n' '\n\n' <'$tmp/a.p3d' >'$tmp/a'; tr -s ' \n' '\n\n' <'$tmp/b.p3d' >'$tmp/b'; cmp '$tmp/a' '$tmp/b'"
head -c 2000 "$tmp/fortran-swapped.p3d" >"$tmp/bad.p3d"
refuses "plot3d: cut off records" 'byte 16: the record of block 1 (1 block 25 x 7) has 3500 bytes, but the file ends after 1980' \
    "$harmorph" check "$tmp/bad.p3d"
sed '$d' "$tmp/text.p3d" >"$tmp/bad.p3d"
refuses "plot3d: cut off text" 'the file would have 352 numbers, but it has' "$harmorph" check "$tmp/bad.p3d"
awk 'BEGIN { print "3 3 3"; for (d = 0; d < 3; d++) for (k = 0; k < 3; k++) for (j = 0; j < 3; j++) for (i = 0; i < 3; i++) {
    print d == 0 ? i : d == 1 ? j : k } }' >"$tmp/cube.p3d"
refuses "plot3d: three dimensions in earnest" 'the mesh has three dimensions and is not one cell thick' "$harmorph" check "$tmp/cube.p3d"
awk 'BEGIN { print "4 3 2"; for (d = 0; d < 3; d++) for (k = 0; k < 2; k++) for (j = 0; j < 3; j++) for (i = 0; i < 4; i++) {
    print d == 0 ? i + .1 * (k == 1 && i == 2) : d == 1 ? j : k } }' >"$tmp/skew.p3d"
refuses "plot3d: a point without a partner" 'is not opposite point 3 of the file (2, 0, 0)' "$harmorph" check "$tmp/skew.p3d"
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

# CGNS: read and written by a program that is made with libcgns
if echo '#include <cgnslib.h>' | $CXX -x c++ -E - >/dev/null 2>&1 && command -v cgnsdiff >/dev/null 2>&1; then
    # What `make CGNS=1` makes: the same objects but for one, which is compiled with libcgns.
    with_cgns=$tmp/harmorph-cgns build=`dirname "$harmorph"`
    objects=`ls "$build"/objects/cli/c_api-cli-*.o "$build"/objects/cli/*page_text.o | grep -v formats-cgns`
    check "a program with CGNS is made" $CXX -std=c++17 -O1 -pthread -DHARMORPH_CGNS -Ic_api -Ic_api/cli -o "$with_cgns" \
        c_api/cli/formats/cgns.cpp $objects "$build/libharmorph.a" -lcgns
    check "make_cgns is compiled" ${CC:-cc} -O0 -o "$tmp/make_cgns" tests/formats/make_cgns.c -lcgns -lm
    for kind in plane planes block cells polygons solid; do
        for real in double single; do
            what="cgns $kind $real" mesh=$tmp/$kind.cgns moved=$tmp/moved.cgns
            rm -f "$mesh" "$moved"
            check "$what: is written by libcgns" "$tmp/make_cgns" "$mesh" $kind $real
            check "$what: check" "$with_cgns" check "$mesh" --json
            says "$what: markers" '"markers": [{"name": "body", "faces": 24}, {"name": "far", "faces": 24}]'
            check "$what: fit" "$with_cgns" fit "$mesh" --marker body --points 8 -o "$tmp/curve"
            check "$what: solve" "$with_cgns" solve "$mesh" --curve "body=$tmp/curve" -o "$tmp/basis"
            check "$what: zero move" "$with_cgns" morph "$mesh" "$tmp/basis" --move "$tmp/none.txt" -o "$moved"
            check "$what: zero move: nothing differs" sh -c "cgnsdiff -d '$mesh' '$moved' >'$tmp/a' && ! test -s '$tmp/a'"
            check "$what: morph" "$with_cgns" morph "$mesh" "$tmp/basis" --move "$tmp/moves.txt" -o "$moved"
            check "$what: check the morphed" "$with_cgns" check "$moved"
            check "$what: cgnscheck reads the morphed" cgnscheck "$moved"
            check "$what: cgnscheck finds no error" sh -c "! grep -qi error '$tmp/out'"
            check "$what: only coordinates differ" sh -c "cgnsdiff -d '$mesh' '$moved' | grep -v -e 'Coordinate[XY]' | grep -q . && exit 1 || exit 0"
            test $kind = polygons && continue
            # The same mesh in text moves alike.
            "$with_cgns" convert "$mesh" "$tmp/a.su2" >"$tmp/out" 2>&1
            "$with_cgns" convert "$moved" "$tmp/b.su2" >"$tmp/out" 2>&1
            "$harmorph" solve "$tmp/a.su2" --curve "body=$tmp/curve" -o "$tmp/basis" >"$tmp/out" 2>&1
            check "$what: as text: morph" "$harmorph" morph "$tmp/a.su2" "$tmp/basis" --move "$tmp/moves.txt" -o "$tmp/c.su2"
            tolerance=1e-12
            test $real = single && tolerance=1e-6
            check "$what: moves as all do" alike $tolerance "$tmp/b.su2" "$tmp/c.su2"
        done
    done
    "$tmp/make_cgns" "$tmp/cube.cgns" cube double
    refuses "cgns: three dimensions in earnest" 'the mesh has three dimensions and is not one cell thick' "$with_cgns" check "$tmp/cube.cgns"
    head -c 3000 "$tmp/plane.cgns" >"$tmp/bad.cgns"
    check "cgns: cut off" sh -c "'$with_cgns' check '$tmp/bad.cgns' >'$tmp/err' 2>&1; test \$? -eq 3"
    refuses "cgns: a program without it says so" 'CGNS files are read by programs made with' "$harmorph" check "$tmp/plane.cgns"
else
    echo "libcgns is not installed: CGNS files are not tested (Debian's libcgns-dev and cgns-convert)"
fi

# UGRID
printf '4\n1 4000 body\n2 5000 outer rim\n3 6662 sym1\n4 6662 sym2\n' >"$tmp/prisms.mapbc"
check "ugrid: names of a .mapbc file" "$harmorph" check "$tmp/prisms.lb8.ugrid" --json
says "ugrid: names of a .mapbc file: those that are not in the planes" '"body", "faces": 24}, {"name": "outer", "faces": 24}]'
echo 'body 5' >>"$tmp/prisms.mapbc"
refuses "ugrid: a bad .mapbc file" 'prisms.mapbc:6: expected' "$harmorph" check "$tmp/prisms.lb8.ugrid"
rm "$tmp/prisms.mapbc"
head -c 9000 "$tmp/prisms.lb8.ugrid" >"$tmp/bad.lb8.ugrid"
refuses "ugrid: cut off" 'little-endian byte order the file would have' "$harmorph" check "$tmp/bad.lb8.ugrid"
cp "$tmp/bad.lb8.ugrid" "$tmp/bad.b8.ugrid"
refuses "ugrid: cut off, and of the other byte order than its name says" 'bad.b8.ugrid' "$harmorph" check "$tmp/bad.b8.ugrid"
printf '4 0 0 1 0 0 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 2 3 4\n' >"$tmp/bad.ugrid"
refuses "ugrid: three dimensions in earnest" 'bad.ugrid:1: the mesh has tetrahedra' "$harmorph" check "$tmp/bad.ugrid"
sed '20s/^[^ ]*/7/' "$tmp/text.ugrid" >"$tmp/bad.ugrid"
refuses "ugrid: a point without a partner" 'point 19 of the file (7, 1, 0.6593) is not opposite point 20' "$harmorph" check "$tmp/bad.ugrid"

# VTK
sed 's/^9 /12 /' "$tmp/text.vtk" | sed '/^CELL_TYPES/,$s/ 9 / 12 /' >"$tmp/bad.vtk"
refuses "vtk: three dimensions in earnest" 'is of type 12 with 4 points: triangles, quadrilaterals and polygons are read; the mesh has three' \
    "$harmorph" check "$tmp/bad.vtk"
check "vtk: convert" "$harmorph" convert "$tmp/ring.su2" "$tmp/ring.vtk"
check "vtk: what convert writes" "$harmorph" check "$tmp/ring.vtk" --json
says "vtk: what convert writes: the same mesh" '"boundary1", "faces": 24}, {"name": "boundary2", "faces": 24}'

# VTK XML
change() { sed "$1" "$tmp/text.vtu" >"$tmp/bad.vtu"; }
change 's/9 9 9/12 9 9/'
refuses "vtu: three dimensions in earnest" 'cell 0 is of type 12 with 4 points' "$harmorph" check "$tmp/bad.vtu"
change 's/type="UnstructuredGrid"/type="PolyData"/'
refuses "vtu: another kind of data" "bad.vtu:3: expected a file of type UnstructuredGrid, found 'PolyData'" \
    "$harmorph" check "$tmp/bad.vtu"
change 's/NumberOfPoints="168"/NumberOfPoints="169"/'
refuses "vtu: too few points" "expected a point's x, found the end of the numbers" "$harmorph" check "$tmp/bad.vtu"
change 's/NumberOfPoints="168"/NumberOfPoints="167"/'
refuses "vtu: too many points" 'the array Points has more numbers than 167 points' "$harmorph" check "$tmp/bad.vtu"
change 's/NumberOfCells="144"/NumberOfCells="143"/'
refuses "vtu: too many cells" 'the array offsets has 144 numbers for 143 cells' "$harmorph" check "$tmp/bad.vtu"
change 's/format="ascii"/format="binary"/'
refuses "vtu: base64" "this one has 'binary'" "$harmorph" check "$tmp/bad.vtu"
change 's/Name="offsets"/Name="starts"/'
refuses "vtu: an array is missing" 'the file has no array offsets' "$harmorph" check "$tmp/bad.vtu"
head -c 5000 "$tmp/appended-64.vtu" >"$tmp/bad.vtu"
refuses "vtu: cut off before an array" "found '8832'" "$harmorph" check "$tmp/bad.vtu"
head -c 10000 "$tmp/appended-64.vtu" >"$tmp/bad.vtu"
refuses "vtu: cut off in an array" 'the array offsets has 1152 bytes, 8 for each number, but only' \
    "$harmorph" check "$tmp/bad.vtu"
sed 's/header_type="UInt64"/& compressor="vtkLZ4DataCompressor"/' "$tmp/appended-64.vtu" >"$tmp/bad.vtu"
refuses "vtu: compressed" 'the array is compressed: save the file without compression' "$harmorph" check "$tmp/bad.vtu"
check "vtu: convert" "$harmorph" convert "$tmp/ring.su2" "$tmp/ring.vtu"
check "vtu: what convert writes" "$harmorph" check "$tmp/ring.vtu" --json
says "vtu: what convert writes: the same mesh" '"boundary1", "faces": 24}, {"name": "boundary2", "faces": 24}'
check "vtu: what convert writes: the same points" "$harmorph" convert "$tmp/ring.vtu" "$tmp/again.su2"
sed -n '/^NPOIN/,/^NMARK/p' "$tmp/ring.su2" | awk '{ print $1, $2 }' >"$tmp/points-before"
sed -n '/^NPOIN/,/^NMARK/p' "$tmp/again.su2" | awk '{ print $1, $2 }' >"$tmp/points-after"
check "vtu: what convert writes: the same coordinates" alike 0 "$tmp/points-before" "$tmp/points-after"

# Fluent
"$harmorph" check "$tmp/fluent.msh" --json >"$tmp/out" 2>&1
says "fluent: zones are markers" '"body", "faces": 24}, {"name": "far", "faces": 24}]'
change() { sed "$1" "$tmp/fluent.msh" >"$tmp/bad.msh"; }
change 's/^(2 2)/(2 3)/'
refuses "fluent: three dimensions" "bad.msh:2: expected 2: meshes of two dimensions are read, found '3'" \
    "$harmorph" check "$tmp/bad.msh"
change 's/^(10 (1 1 a8/(10 (1 1 a9/'
refuses "fluent: too few nodes" "expected a node's x, found the end of the numbers" "$harmorph" check "$tmp/bad.msh"
change 's/^(10 (1 1 a8/(10 (1 1 a7/'
refuses "fluent: too many nodes" 'the section has more numbers than x and y of 167 nodes' "$harmorph" check "$tmp/bad.msh"
change 's/^(10 (1 1 a8/(10 (1 2 a9/'
refuses "fluent: a node is missing" 'bad.msh:8: expected node 1, found node 2' "$harmorph" check "$tmp/bad.msh"
change 's/^(10 (1 /(3010 (1 /'
refuses "fluent: binary" 'bad.msh:6: the section 3010 is binary' "$harmorph" check "$tmp/bad.msh"
change 's/^(64 /(58 /'
refuses "fluent: hanging nodes" 'the mesh has hanging nodes' "$harmorph" check "$tmp/bad.msh"
change 's/^2 2 1 1 0/2 2 9 1 0/'
refuses "fluent: a cell that is not closed" 'the faces of cell 1 (4 faces) do not form a polygon' \
    "$harmorph" check "$tmp/bad.msh"
change 's/^2 2 1 1 0/3 2 1 9 1 0/'
refuses "fluent: a face of three nodes" 'expected 2 nodes of a face between 2 and 2, found 3' "$harmorph" check "$tmp/bad.msh"
change 's/^2 2 1 1 0/2 2 1 2 0/'
refuses "fluent: a cell whose faces are no polygon" 'do not form a polygon' "$harmorph" check "$tmp/bad.msh"
change 's/^2 2 1 1 0/2 1 2 1 0/'
check "fluent: a face the other way round" "$harmorph" check "$tmp/bad.msh"
head -c 5000 "$tmp/fluent.msh" >"$tmp/bad.msh"
refuses "fluent: cut off" 'bad.msh:6: this bracket is not closed before the end of the file' "$harmorph" check "$tmp/bad.msh"

# OpenFOAM: a folder of files, of which one has the coordinates
check "make_foam is compiled" $CXX -std=c++17 -O0 -o "$tmp/make_foam" tests/formats/make_foam.cpp
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
            check "$what: the points in space" sh -c "tr '()' '  ' <'$expected/$points' >'$tmp/a' && tr '()' '  ' <'$moved/$points' >'$tmp/b'"
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
    check "$what: zero move" "$harmorph" morph "$case" "$tmp/basis" --move "$tmp/none.txt" -o "$moved/constant/polyMesh/points"
    check "$what: zero move: the same file" cmp "$case/constant/polyMesh/points" "$moved/constant/polyMesh/points"
    check "$what: morph" "$harmorph" morph "$case" "$tmp/basis" --move "$tmp/moves.txt" --safe -o "$moved" --svg "$tmp/picture.svg"
    check "$what: check the morphed" "$harmorph" check "$moved"
    for new in vtk vtu; do
        check "$what: convert to $new" "$harmorph" convert "$moved" "$tmp/foam.$new"
        check "$what: $new is read" "$harmorph" check "$tmp/foam.$new" --json
        says "$what: $new has the polygons" '"quads": 120, "polygons": 12, "inverted": 0'
    done
    check "$what: no SU2 file of polygons" sh -c "'$harmorph' convert '$moved' '$tmp/none.su2' 2>'$tmp/why'; test \$? -eq 2"
    check "$what: no SU2 file of polygons: why" grep -q 'cells of more than four corners (the first is cell 0): SU2 takes triangles and' "$tmp/why"
done
"$tmp/make_foam" "$tmp/foam" text z
broken() { # broken FILE SED: the case with one file changed
    rm -rf "$tmp/foam-bad"
    cp -r "$tmp/foam" "$tmp/foam-bad"
    sed "$2" "$tmp/foam/constant/polyMesh/$1" >"$tmp/foam-bad/constant/polyMesh/$1"
}
broken points '188s/^([^ ]*/(2/'
refuses "openfoam: a point without a partner" 'points:188: the mesh has three dimensions and is not one cell thick: point 173 is 3.54184e-1 away' \
    "$harmorph" check "$tmp/foam-bad"
broken boundary 's/ empty;/ patch;/'
refuses "openfoam: three dimensions" 'no patch has the type empty or wedge: the mesh has three dimensions' "$harmorph" check "$tmp/foam-bad"
broken boundary 's/nFaces          288/nFaces          140/'
refuses "openfoam: planes without some faces" 'has 140 faces, but the mesh has 144 cells' "$harmorph" check "$tmp/foam-bad"
broken boundary 's/nFaces          24;/nFaces          2400;/'
refuses "openfoam: a patch that is too long" "boundary:15: the patch 'body' ends behind face" "$harmorph" check "$tmp/foam-bad"
broken faces 's/^4(0 /4(999 /'
refuses "openfoam: a face of points that do not exist" 'has point 999, but there are 336 points' "$harmorph" check "$tmp/foam-bad"
broken faces '$d'
refuses "openfoam: cut off" "expected ')', found the end of the file" "$harmorph" check "$tmp/foam-bad"
broken owner '17s/^0$/x/'
refuses "openfoam: owners" "owner:17: expected a label, found 'x'" "$harmorph" check "$tmp/foam-bad"
rm "$tmp/foam-bad/constant/polyMesh/owner"
refuses "openfoam: a file is missing" 'owner does not exist' "$harmorph" check "$tmp/foam-bad"
"$tmp/make_foam" "$tmp/foam" binary-64 z
broken points 's/label=64/label=32/; s/scalar=64/scalar=32/'
refuses "openfoam: another size of numbers than the header says" 'or its header says another size of numbers' \
    "$harmorph" check "$tmp/foam-bad"

# ---- Other programs ---------------------------------------------------------------------------------------------------

if command -v gmsh >/dev/null 2>&1; then
    cat >"$tmp/two.geo" <<'END'
Point(1) = {0, 0, 0, .3}; Point(2) = {1, 0, 0, .3}; Point(3) = {-1, 0, 0, .3};
Circle(1) = {2, 1, 3}; Circle(2) = {3, 1, 2};
Point(4) = {-4, -4, 0, 2}; Point(5) = {4, -4, 0, 2}; Point(6) = {4, 4, 0, 2}; Point(7) = {-4, 4, 0, 2};
Line(3) = {4, 5}; Line(4) = {5, 6}; Line(5) = {6, 7}; Line(6) = {7, 4};
Curve Loop(1) = {3, 4, 5, 6}; Curve Loop(2) = {1, 2}; Plane Surface(1) = {1, 2};
Physical Curve("body") = {1, 2}; Physical Curve("far") = {3, 4, 5, 6}; Physical Surface("air") = {1};
END
    for variant in "msh22 0 1" "msh22 1 2" "msh41 0 2" "msh41 1 1"; do
        set -- $variant
        mesh=$tmp/gmsh-$1-$2-$3.msh
        check "gmsh: writes $variant" gmsh -2 "$tmp/two.geo" -format $1 -setnumber Mesh.Binary $2 -order $3 -o "$mesh"
        check "gmsh $variant: fit" "$harmorph" fit "$mesh" --marker body --points 8 -o "$tmp/curve"
        check "gmsh $variant: solve" "$harmorph" solve "$mesh" --curve "body=$tmp/curve" -o "$tmp/basis"
        check "gmsh $variant: zero move" "$harmorph" morph "$mesh" "$tmp/basis" --move "$tmp/none.txt" -o "$mesh.same.msh"
        check "gmsh $variant: zero move: the same file" cmp "$mesh" "$mesh.same.msh"
        check "gmsh $variant: morph" "$harmorph" morph "$mesh" "$tmp/basis" --move "$tmp/moves.txt" -o "$mesh.moved.msh"
        gmsh -check "$mesh.moved.msh" >"$tmp/gmsh" 2>&1
        check "gmsh $variant: gmsh finds nothing wrong" sh -c "! grep -E 'Error|Warning' '$tmp/gmsh'"
    done
    check "gmsh: convert" "$harmorph" convert "$tmp/ring.su2" "$tmp/ring.msh"
    check "gmsh: reads what convert writes" gmsh -check "$tmp/ring.msh"
    check "gmsh: writes SU2 of it" gmsh -2 "$tmp/ring.msh" -save -o "$tmp/again.su2"
    check "gmsh: its SU2 file" "$harmorph" check "$tmp/again.su2" --json
    says "gmsh: its SU2 file: the same cells" '"points": 168, "cells": 144'
    says "gmsh: its SU2 file: the same markers" '"body", "faces": 24}, {"name": "far", "faces": 24'
else
    echo "gmsh is not installed: its own files are not tested (Debian's gmsh)"
fi

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
            check "checkMesh $storage $plane: morph" "$harmorph" morph "$tmp/foam" "$tmp/basis" --move "$tmp/moves.txt" -o "$tmp/foam-moved"
            check "checkMesh $storage $plane" checkMesh -case "$tmp/foam-moved" -constant
            says "checkMesh $storage $plane: finds nothing wrong" 'Mesh OK.'
        done
    done
else
    echo "OpenFOAM is not installed: checkMesh does not look at the morphed meshes (Debian's openfoam)"
fi

if /usr/bin/python3 -c 'import vtk' 2>/dev/null; then
    cat >"$tmp/grid.py" <<'END'
import sys, vtk
def grid(path):
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()
if sys.argv[1] == 'write':
    writer = vtk.vtkXMLUnstructuredGridWriter()
    writer.SetInputData(grid(sys.argv[2]))
    if sys.argv[3] == '0': writer.SetDataModeToAscii()
    else:
        writer.SetDataModeToAppended()
        writer.EncodeAppendedDataOff()
        writer.SetCompressorTypeToNone()
    if sys.argv[3] == '64': writer.SetHeaderTypeToUInt64()
    writer.SetFileName(sys.argv[4])
    writer.Write()
else:
    read = grid(sys.argv[2])
    for i in range(read.GetNumberOfPoints()): print(*map(repr, read.GetPoint(i)[:2]))
END
    for variant in 0 32 64; do # text; raw with headers of that many bits
        mesh=$tmp/vtk-$variant.vtu
        check "VTK: writes $variant" /usr/bin/python3 "$tmp/grid.py" write "$tmp/ring.vtu" $variant "$mesh"
        check "VTK $variant: fit" "$harmorph" fit "$mesh" --marker boundary1 --points 8 -o "$tmp/curve"
        check "VTK $variant: solve" "$harmorph" solve "$mesh" --curve "boundary1=$tmp/curve" -o "$tmp/basis"
        check "VTK $variant: zero move" "$harmorph" morph "$mesh" "$tmp/basis" --move "$tmp/none.txt" -o "$tmp/same.vtu"
        check "VTK $variant: zero move: the same file" cmp "$mesh" "$tmp/same.vtu"
        check "VTK $variant: morph" "$harmorph" morph "$mesh" "$tmp/basis" --move "$tmp/moves.txt" -o "$tmp/vtk-moved.vtu"
        check "VTK $variant: reads the morphed" /usr/bin/python3 "$tmp/grid.py" read "$tmp/vtk-moved.vtu"
        cp "$tmp/out" "$tmp/points"
        check "VTK $variant: moves as all do" alike 1e-9 "$tmp/points-of-all" "$tmp/points"
    done
else
    echo "VTK for Python is not installed: its own files are not tested (Debian's python3-vtk9)"
fi

if /usr/bin/python3 -c 'import meshio' 2>/dev/null; then # reads plain files of these formats
    echo 'import sys, meshio
for p in meshio.read(sys.argv[1]).points: print(repr(float(p[0])), repr(float(p[1])))' >"$tmp/read_points.py"
    "$harmorph" convert "$tmp/moved-plain.su2" "$tmp/meshio.msh" >"$tmp/out"
    for mesh in moved-plain.su2 meshio.msh; do
        check "meshio reads $mesh" timeout 60 /usr/bin/python3 "$tmp/read_points.py" "$tmp/$mesh"
        grep -E '^-?[0-9.e+-]+ -?[0-9.e+-]+$' "$tmp/out" >"$tmp/points"
        check "meshio reads $mesh: moved as all are" alike 1e-12 "$tmp/points-of-all" "$tmp/points"
    done
else
    echo "meshio is not installed: it does not look at the morphed meshes (Debian's python3-meshio)"
fi

# ---- Broken files -----------------------------------------------------------------------------------------------------

program="c_api/cli/formats/*.cpp c_api/cli/text_file.cpp c_api/cli/numbers.cpp c_api/cli/mesh.cpp c_api/cli/one_cell_thick.cpp \
    c_api/cli/space_mesh.cpp c_api/cli/vtu.cpp"
library=$(dirname "$harmorph")/libharmorph.a
sanitize="-fsanitize=address,undefined -fno-sanitize-recover=all"
if echo 'int main() {}' | $CXX $sanitize -x c++ - -o "$tmp/empty" 2>/dev/null && "$tmp/empty" 2>/dev/null; then :; else
    echo "the compiler has no sanitizers: broken files are read without"
    sanitize=
fi
check "mutate is compiled" $CXX -std=c++17 -O0 $sanitize -Ic_api -Ic_api/cli -o "$tmp/mutate" tests/formats/mutate.cpp $program "$library"
for storage in text binary-64; do "$tmp/make_foam" "$tmp/broken-$storage" $storage wedge; done
check "broken files are refused, or read: never more" sh -c "cd '$tmp' && ./mutate broken 120 \
    $(cd "$tmp" && "./make_mesh" list | tr '\n' ' ') $(cd "$tmp" && ls broken-*/constant/polyMesh/[pfob]* | tr '\n' ' ')"
cat "$tmp/out"
sh tests/openfoam.sh "$harmorph" "${tmp%/*}" || fail "a case of OpenFOAM" # which counts its own checks

finish
