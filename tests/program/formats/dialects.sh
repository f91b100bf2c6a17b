# Files of other programs: what gmsh, meshio and VTK write is read, morphed, and read again by them; and small files as
# other programs write them. (A part of tests/program/formats.sh.)
python() { /usr/bin/python3 tests/program/formats/dialects.py "$@"; }

# ---- Gmsh ----
if python has gmsh 2>/dev/null; then
    for version in 2.2 4.1; do
        for binary in 0 1; do
            what="gmsh's mesh one cell thick, $version, binary $binary" mesh=$tmp/thick.msh
            check "$what: is written" python gmsh $version $binary thick "$mesh"
            "$harmorph" check "$mesh" --json >"$tmp/out" 2>&1
            says "$what: markers are surfaces, without the planes" '"markers": [{"name": "body"'
            morphs "$what" "$mesh" body
            what="gmsh's curves in several groups, $version, binary $binary" mesh=$tmp/groups.msh
            check "$what: is written" python gmsh $version $binary groups "$mesh"
            morphs "$what" "$mesh" body
            "$harmorph" check "$mesh" --json >"$tmp/out" 2>&1
            says "$what: a marker of each combination" '{"name": "body+all"'
            check "$what: by one of its names" "$harmorph" fit "$mesh" --marker upper --points 5 -o "$tmp/x.curve"
            check "$what: by a pattern" "$harmorph" fit "$mesh" --marker 'body*' --points 8 -o "$tmp/x.curve"
            what="gmsh's lines without groups, $version, binary $binary" mesh=$tmp/lines.msh
            check "$what: is written" python gmsh $version $binary lines "$mesh"
            "$harmorph" check "$mesh" >"$tmp/out" 2>&1
            says "$what: check lists loops" 'loop:1: 24 faces, x = -1 .. 1'
            morphs "$what" "$mesh" loop:1
            check "$what: the rest by the other loop" "$harmorph" solve "$mesh" --curve "loop:1=$tmp/curve" \
                --slip loop:2 -o "$tmp/x.basis"
        done
    done
    refuses_usage() { # refuses_usage NAME TEXT COMMAND...
        name=$1 text=$2; shift 2
        "$@" >"$tmp/out" 2>&1
        if [ $? -eq 2 ] && grep -F -e "$text" "$tmp/out" >/dev/null; then ok "$name"; else
            fail "$name: does not say '$text': $(head -n 1 "$tmp/out")"; fi
    }
    refuses_usage "gmsh: a loop that is none" 'has no loop:3, because the boundary has 2 loops' \
        "$harmorph" fit "$mesh" --marker loop:3 --points 8 -o "$tmp/x.curve"
    refuses_usage "gmsh: no marker: not all names are listed" "and 16 more; in a name, * matches any characters" \
        "$harmorph" fit "$mesh" --marker nothing -o "$tmp/x.curve"
    python gmsh 4.1 0 curves "$tmp/curves.msh" >"$tmp/out" 2>&1
    refuses "gmsh: curves only" 'and no triangles or quadrilaterals: mesh the surface and save its cells' "$harmorph" \
        check "$tmp/curves.msh"
    check "gmsh: curves only: nothing else" test "$(wc -l <"$tmp/out")" -eq 1
    python gmsh 1 0 lines "$tmp/old.msh" >"$tmp/out" 2>&1
    refuses "gmsh: version 1" \
        'this is version 1 of the format, which is not read; save the mesh in version 2.2 or 4.1' \
        "$harmorph" check "$tmp/old.msh"
    python gmsh 4.0 0 lines "$tmp/old.msh" >"$tmp/out" 2>&1
    refuses "gmsh: version 4.0" 'Mesh.MshFileVersion = 4.1' "$harmorph" check "$tmp/old.msh"
else
    echo "gmsh for Python is not installed: its dialects are not tested (Debian's python3-gmsh)"
fi

# ---- VTU ----
alike_points() { # alike_points WHAT PACKAGE FILE
    check "$1: $2 reads the morphed" python points $2 "$3"
    grep -E '^-?[0-9.e+-]+ -?[0-9.e+-]+$' "$tmp/out" | head -n 168 >"$tmp/points"
    check "$1: moves as all do" alike 1e-9 "$tmp/points-of-all" "$tmp/points"
}
if python has meshio 2>/dev/null; then
    for coding in ascii none zlib; do
        [ $coding = zlib ] && ! has_zlib && continue
        check "meshio's VTU, $coding: is written" python meshio $coding "$tmp/meshio.vtu"
        morphs "meshio's VTU, $coding" "$tmp/meshio.vtu" boundary1
        alike_points "meshio's VTU, $coding" meshio "$moved"
    done
    python meshio lzma "$tmp/lzma.vtu"
    refuses "meshio's VTU, lzma" "save the file with the compressor ZLib, or without compression" "$harmorph" \
        check "$tmp/lzma.vtu"
else
    echo "meshio is not installed: its dialects are not tested (Debian's python3-meshio)"
fi
if python has vtk 2>/dev/null; then
    for coding in ascii binary binary-zlib appended appended-zlib raw raw-64 raw-zlib second thick; do
        case $coding in *zlib | second) has_zlib || continue ;; esac
        check "VTK's VTU, $coding: is written" python vtk $coding "$tmp/vtk.vtu"
        morphs "VTK's VTU, $coding" "$tmp/vtk.vtu" boundary1
        alike_points "VTK's VTU, $coding" vtk "$moved"
    done
    for coding in second thick; do
        check "VTK's legacy file, $coding: is written" python vtk $coding "$tmp/legacy.vtk"
        morphs "VTK's legacy file, $coding" "$tmp/legacy.vtk" boundary1
        check "VTK's legacy file, $coding: VTK reads the morphed" python points vtk "$moved"
    done
    # VTK divides the ring into three pieces, with points in single precision.
    for coding in ascii binary raw raw-zlib appended appended-zlib; do
        case $coding in *zlib) has_zlib || continue ;; esac
        pvtu="VTK's PVTU, $coding" mesh=$tmp/three.pvtu moved=$tmp/moved-three.vtu
        check "$pvtu: is written" python vtk $coding "$mesh"
        check "$pvtu: check" "$harmorph" check "$mesh" --json
        says "$pvtu: the boundary" '[{"name": "boundary1", "faces": 24}, {"name": "boundary2", "faces": 24}]'
        check "$pvtu: fit" "$harmorph" fit "$mesh" --marker boundary1 --points 8 -o "$tmp/curve"
        check "$pvtu: solve" "$harmorph" solve "$mesh" --curve "boundary1=$tmp/curve" -o "$tmp/basis"
        check "$pvtu: morph" "$harmorph" morph "$mesh" "$tmp/basis" --move "$tmp/moves.txt" -o "$moved"
        check "$pvtu: VTK reads the morphed" python points vtk "$moved"
        grep -E '^-?[0-9.e+-]+ -?[0-9.e+-]+$' "$tmp/out" >"$tmp/points"
        awk 'NR == FNR { x[FNR] = $1; y[FNR] = $2; n = FNR; next }
            { found = 0
              for (k = 1; k <= n; k++) if (($1 - x[k]) ^ 2 + ($2 - y[k]) ^ 2 < 1e-10) found = seen[k] = 1
              if (!found) exit bad = 1 }
            END { for (k = 1; k <= n; k++) if (!seen[k]) bad = 1; exit bad || n != 168 || FNR < 168 }' \
            "$tmp/points-of-all" "$tmp/points" && ok "$pvtu: moves as all do" || fail "$pvtu: moves as all do"
    done
    check "VTK's PVTU with ghost cells: is written" python vtk ghosts "$tmp/three.pvtu"
    refuses "VTK's PVTU with ghost cells" 'the pieces have ghost cells' "$harmorph" check "$tmp/three.pvtu"
    python vtk lz4 "$tmp/lz4.vtu"
    refuses "VTK's VTU, lz4" "is compressed by 'vtkLZ4DataCompressor': save the file with the compressor ZLib" \
        "$harmorph" check "$tmp/lz4.vtu"
else
    echo "VTK for Python is not installed: its dialects are not tested (Debian's python3-vtk9)"
fi

# ---- Small files ----
# Two pieces, each a half of the ring: what lies between them is no boundary.
awk 'BEGIN { pi = atan2(0, -1)
    print "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid>"
    for (part = 0; part < 2; part++) {
        print "<Piece NumberOfPoints=\"91\" NumberOfCells=\"72\"><Points>"
        print "<DataArray type=\"Float64\" NumberOfComponents=\"3\">"
        for (j = 0; j < 7; j++) for (i = 12 * part; i <= 12 * part + 12; i++) {
            r = 4 ^ (j / 6); t = 2 * pi * (i % 24) / 24
            printf "%.16g %.16g 0\n", r * cos(t), r * sin(t)
        }
        print "</DataArray></Points><Cells><DataArray type=\"Int32\" Name=\"connectivity\">"
        for (j = 0; j < 6; j++) for (i = 0; i < 12; i++) {
            k = 13 * j + i; print k, k + 1, k + 14, k + 13
        }
        print "</DataArray><DataArray type=\"Int32\" Name=\"offsets\">"
        for (k = 1; k <= 72; k++) print 4 * k
        print "</DataArray><DataArray type=\"UInt8\" Name=\"types\">"
        for (k = 1; k <= 72; k++) print 9
        print "</DataArray></Cells></Piece>"
    }
    print "</UnstructuredGrid></VTKFile>" }' >"$tmp/pieces.vtu"
morphs "VTU of two pieces" "$tmp/pieces.vtu" boundary1
"$harmorph" check "$tmp/pieces.vtu" --json >"$tmp/out" 2>&1
says "VTU of two pieces: the boundary" '[{"name": "boundary1", "faces": 24}, {"name": "boundary2", "faces": 24}]'
grep -v '<' "$moved" | awk 'NF == 3 { n[$1 " " $2]++ } END { for (p in n) if (n[p] == 2) k++; exit k != 14 }' &&
    ok "VTU of two pieces: they stay closed" || fail "VTU of two pieces: they stay closed"
# The halves are pieces of a structured grid, flat and one cell thick.
structured() { # structured LAST: the file with points 0 to LAST along k
    awk -v last="$1" 'BEGIN { pi = atan2(0, -1)
        print "<VTKFile type=\"StructuredGrid\"><StructuredGrid WholeExtent=\"0 24 0 6 0 " last "\">"
        for (part = 0; part < 2; part++) {
            print "<Piece Extent=\"" 12 * part, 12 * part + 12, 0, 6, 0, last "\"><Points>"
            print "<DataArray type=\"Float64\" NumberOfComponents=\"3\">"
            for (k = 0; k <= last; k++) for (j = 0; j < 7; j++) for (i = 12 * part; i <= 12 * part + 12; i++) {
                r = 4 ^ (j / 6); t = 2 * pi * (i % 24) / 24
                printf "%.16g %.16g %d\n", r * cos(t), r * sin(t), k
            }
            print "</DataArray></Points></Piece>"
        }
        print "</StructuredGrid></VTKFile>" }'
}
for last in 0 1; do
    structured $last >"$tmp/grid.vts"
    morphs "VTS, $last cells thick" "$tmp/grid.vts" boundary1
    "$harmorph" check "$tmp/grid.vts" --json >"$tmp/out" 2>&1
    says "VTS, $last cells thick: the boundary" \
        '[{"name": "boundary1", "faces": 24}, {"name": "boundary2", "faces": 24}]'
done
for extent in "" "0 12 0 6 0" "0 12 0 6 1 0" "-1 12 0 6 0 0" "0 2147483647 0 6 0 0" "0 99999 0 99999 0 0" \
    "0 x 0 6 0 0"; do
    structured 0 | sed "s/Extent=\"0 12 0 6 0 0\"/Extent=\"$extent\"/" >"$tmp/grid.vts"
    refuses "VTS: the extent '$extent'" 'the tag needs an Extent of six whole numbers' "$harmorph" check "$tmp/grid.vts"
done
structured 0 | sed 's/Extent="0 12 0 6 0 0"/Extent="0 90 0 0 0 0"/' >"$tmp/grid.vts"
refuses "VTS: a line of points" 'the grid has no cells' "$harmorph" check "$tmp/grid.vts"
structured 0 | sed 's/Extent="0 12 0 6 0 0"/Extent="0 12 0 7 0 0"/' >"$tmp/grid.vts"
refuses "VTS: more points than there are" 'a coordinate of a point' "$harmorph" check "$tmp/grid.vts"
# A file .pvtu names the pieces, which are in files of their own.
piece_file() { # piece_file N: the text of the N-th piece as a file
    awk -v n=$1 '/<Piece/ { k++ } k == 0 || k == n || /<.Unstr/ || /<.VTKFile/' "$tmp/pieces.vtu" |
        sed 's|</Piece></Piece>|</Piece>|'
}
mkdir -p "$tmp/parallel"
for piece in 1 2; do piece_file $piece >"$tmp/parallel/half-$piece.vtu"; done
parallel() { # parallel LEVEL SOURCE...
    echo "<VTKFile type=\"PUnstructuredGrid\"><PUnstructuredGrid GhostLevel=\"$1\">"
    shift
    for source in "$@"; do echo "<Piece Source=\"$source\"/>"; done
    echo "</PUnstructuredGrid></VTKFile>"
}
parallel 0 parallel/half-1.vtu parallel/half-2.vtu >"$tmp/halves.pvtu"
"$harmorph" check "$tmp/halves.pvtu" --json >"$tmp/out" 2>&1
says "PVTU: the boundary" '[{"name": "boundary1", "faces": 24}, {"name": "boundary2", "faces": 24}]'
says "PVTU: the body, which the cut divides, is one piece" '"faces": 24, "loop": 1, "closed": true, "body": true'
says "PVTU: the outer boundary is one piece" '"faces": 24, "loop": 2, "closed": true, "body": false'
check "PVTU: the body is loop 1" "$harmorph" solve "$tmp/halves.pvtu" --rigid loop:1 -o "$tmp/basis"
echo 'rigid boundary1@0:1 .1 0 5 1' >"$tmp/turn.txt"
check "PVTU: a piece is the whole body" "$harmorph" morph "$tmp/halves.pvtu" "$tmp/basis" --move "$tmp/turn.txt" \
    -o "$tmp/turned.vtu"
check "PVTU: fit" "$harmorph" fit "$tmp/halves.pvtu" --marker boundary1 --points 8 -o "$tmp/curve"
check "PVTU: solve" "$harmorph" solve "$tmp/halves.pvtu" --curve "boundary1=$tmp/curve" -o "$tmp/basis"
check "PVTU: morph" "$harmorph" morph "$tmp/halves.pvtu" "$tmp/basis" --move "$tmp/moves.txt" -o "$tmp/joined.vtu"
check "PVTU: one file of the pieces: morph" "$harmorph" morph "$tmp/pieces.vtu" "$tmp/basis" \
    --move "$tmp/moves.txt" -o "$tmp/moved.vtu"
for file in joined moved; do
    tr -s ' \n' '\n' <"$tmp/$file.vtu" | sed 's/<[^>]*>//g' | grep . >"$tmp/$file.numbers"
done
check "PVTU: moves as one file of the pieces" cmp "$tmp/joined.numbers" "$tmp/moved.numbers"
for output in -o --svg; do
    other=$([ $output = -o ] || echo "-o $tmp/other.vtu")
    "$harmorph" morph "$tmp/halves.pvtu" "$tmp/basis" --move "$tmp/moves.txt" $other $output \
        "$tmp/parallel/half-2.vtu" >"$tmp/out" 2>&1
    says "PVTU: $output does not replace a piece" 'an output must not replace an input'
done
"$harmorph" morph "$tmp/halves.pvtu" "$tmp/basis" --move "$tmp/moves.txt" -o "$tmp/joined.pvtu" >"$tmp/out" 2>&1
[ $? -eq 2 ] && ok "PVTU: not under a name .pvtu" || fail "PVTU: not under a name .pvtu"
says "PVTU: not under a name .pvtu: says why" 'must end in .vtu'
parallel 1 parallel/half-1.vtu parallel/half-2.vtu >"$tmp/bad.pvtu"
refuses "PVTU: ghost cells" 'save the grid without ghost cells' "$harmorph" check "$tmp/bad.pvtu"
parallel 0 parallel/half-1.vtu ./parallel//half-1.vtu >"$tmp/bad.pvtu"
refuses "PVTU: a file twice" "bad.pvtu:3: the file './parallel//half-1.vtu' is named a second time" "$harmorph" \
    check "$tmp/bad.pvtu"
parallel 0 parallel/half-3.vtu >"$tmp/bad.pvtu"
refuses "PVTU: a file that is not there" "the file 'parallel/half-3.vtu' of this piece does not exist" "$harmorph" \
    check "$tmp/bad.pvtu"
parallel 0 parallel >"$tmp/bad.pvtu"
refuses "PVTU: a folder" "the file 'parallel' of this piece does not exist" "$harmorph" check "$tmp/bad.pvtu"
parallel 0 bad.pvtu >"$tmp/bad.pvtu"
refuses "PVTU: itself" "the type of a piece must be UnstructuredGrid, not 'PUnstructuredGrid'" "$harmorph" \
    check "$tmp/bad.pvtu"
parallel 0 >"$tmp/bad.pvtu"
refuses "PVTU: no piece" 'the file needs <Piece here' "$harmorph" check "$tmp/bad.pvtu"
sed '4s/.*/nonsense/' "$tmp/parallel/half-2.vtu" >"$tmp/parallel/bad.vtu"
parallel 0 parallel/half-1.vtu parallel/bad.vtu >"$tmp/bad.pvtu"
refuses "PVTU: a bad number: the file and the line of the piece" 'parallel/bad.vtu:4: the file needs a coordinate' \
    "$harmorph" check "$tmp/bad.pvtu"
sed 's|</Piece>||' "$tmp/parallel/half-2.vtu" >"$tmp/parallel/bad.vtu"
refuses "PVTU: a piece without its end" 'the piece has no end </Piece>' "$harmorph" check "$tmp/bad.pvtu"
sed '1s/VTKFile /VTKFile header_type="UInt64" /' "$tmp/parallel/half-2.vtu" >"$tmp/parallel/bad.vtu"
refuses "PVTU: pieces that store numbers in different ways" 'save all pieces with the same settings' "$harmorph" \
    check "$tmp/bad.pvtu"
# A structured grid whose first and last lines meet: exactly, and after one turn, where they differ by rounding.
for case in "1 0" "2 0" "1 24"; do
    layers=${case% *}
    awk -v layers=$layers -v last=${case#* } 'BEGIN { pi = atan2(0, -1)
        print "# vtk DataFile Version 3.0\nring\nASCII\nDATASET STRUCTURED_GRID\nDIMENSIONS 25 7", layers
        print "POINTS", 175 * layers, "double"
        for (k = 0; k < layers; k++) for (j = 0; j < 7; j++) for (i = 0; i < 25; i++) {
            t = 2 * pi * ((i < 24 ? i : last) + .25) / 24; r = 4 ^ (j / 6)
            printf "%.17g %.17g %g\n", r * cos(t), r * sin(t), .5 * k }
        }' >"$tmp/structured-$layers.vtk"
    # Both sides of the cut are ends of the curve.
    "$harmorph" check "$tmp/structured-$layers.vtk" --json >"$tmp/out" 2>&1
    says "VTK's structured grid of $layers layers: the boundary" \
        '[{"name": "boundary1", "faces": 24}, {"name": "boundary2", "faces": 24}]'
    check "VTK's structured grid of $layers layers: solve" "$harmorph" solve "$tmp/structured-$layers.vtk" \
        --rigid boundary1 -o "$tmp/basis"
    echo "rigid boundary1 .1 .1 0 1" >"$tmp/rigid.txt"
    check "VTK's structured grid of $layers layers: morph" "$harmorph" morph "$tmp/structured-$layers.vtk" \
        "$tmp/basis" --move "$tmp/rigid.txt" -o "$tmp/moved.vtk"
    check "VTK's structured grid of $layers layers: check the morphed" "$harmorph" check "$tmp/moved.vtk" --json
    says "VTK's structured grid of $layers layers: the cut stays closed" '{"name": "boundary2", "faces": 24}]'
done
# An edge in two groups of version 2 stands in the file twice.
sed 's/^192$/216/; /^24 1 2 1/r /dev/stdin' "$tmp/text-2.msh" >"$tmp/twice.msh" <<END
$(sed -n 's/^\([0-9]*\) 1 2 1 7 /10\1 1 2 9 7 /p' "$tmp/text-2.msh")
END
morphs "gmsh: edges in two groups" "$tmp/twice.msh" body
morphs "gmsh: edges in two groups: by the other name" "$tmp/twice.msh" 9
"$harmorph" check "$tmp/twice.msh" --json >"$tmp/out" 2>&1
says "gmsh: edges in two groups: one marker" '[{"name": "body+9", "faces": 24}, {"name": "far", "faces": 24}]'
# A grid called .dat is no airfoil.
cp "$tmp/text.p3d" "$tmp/grid.dat"
check "plot3d: grid.dat: fit" "$harmorph" fit "$tmp/grid.dat" --marker 1:jmin --points 8 -o "$tmp/curve"
check "plot3d: grid.dat: fit with --format" "$harmorph" fit "$tmp/grid.dat" --format plot3d --marker 1:jmin --points 8 \
    -o "$tmp/curve"
# Compressed files.
if has_zlib && command -v gzip >/dev/null 2>&1; then
    for file in plain.su2 binary-4.msh in-place.vtu; do
        gzip -c "$tmp/$file" >"$tmp/$file.gz"
        mkdir -p "$tmp/gz"
        cp "$tmp/$file.gz" "$tmp/gz/$file.gz"
        case $file in *.vtu) body=boundary1 ;; *) body=body ;; esac
        morphs "$file compressed" "$tmp/gz/$file.gz" $body
        check "$file compressed: gunzip" sh -c "gzip -dc '$moved' >'$tmp/gz/$file'"
        check "$file compressed: morphed as it is" "$harmorph" morph "$tmp/$file" "$tmp/basis" --move "$tmp/moves.txt" \
            -o "$tmp/gz/other"
        "$harmorph" morph "$tmp/gz/$file.gz" "$tmp/basis" --move "$tmp/moves.txt" -o "$tmp/gz/other" >"$tmp/out" 2>&1
        check "$file compressed: not under a name without .gz" test $? -eq 2
        check "$file compressed: the same" cmp "$tmp/gz/$file" "$tmp/gz/other"
    done
    rm -rf "$tmp/foam" "$tmp/foam-gz" "$tmp/foam-moved"
    "$tmp/make_foam" "$tmp/foam" text z
    cp -r "$tmp/foam" "$tmp/foam-gz"
    gzip "$tmp/foam-gz/constant/polyMesh/"*
    cp -r "$tmp/foam-gz" "$tmp/foam-moved"
    check "openfoam compressed: fit" "$harmorph" fit "$tmp/foam-gz" --marker body --points 8 -o "$tmp/curve"
    check "openfoam compressed: solve" "$harmorph" solve "$tmp/foam-gz" --curve "body=$tmp/curve" -o "$tmp/basis"
    check "openfoam compressed: morph" "$harmorph" morph "$tmp/foam-gz" "$tmp/basis" --move "$tmp/moves.txt" \
        -o "$tmp/foam-moved"
    check "openfoam compressed: morph the other" "$harmorph" morph "$tmp/foam" "$tmp/basis" --move "$tmp/moves.txt" \
        -o "$tmp/foam/constant/polyMesh/moved"
    check "openfoam compressed: the same points" sh -c "gzip -dc '$tmp/foam-moved/constant/polyMesh/points.gz' |
        cmp - '$tmp/foam/constant/polyMesh/moved'"
    head -c 300 "$tmp/gz/plain.su2.gz" >"$tmp/gz/cut.su2.gz"
    refuses "compressed: cut off" 'the file is compressed by gzip, and damaged or cut off' "$harmorph" \
        check "$tmp/gz/cut.su2.gz"
    # A damaged block of an array.
    awk '{ gsub(/eAEB/, "eAED"); print }' "$tmp/packed-in-place.vtu" >"$tmp/bad.vtu"
    "$harmorph" check "$tmp/bad.vtu" >"$tmp/out" 2>&1
    check "VTU: a damaged block" test $? -eq 3
fi
# Names that SU2 cannot hold.
sed 's/= body/= b%dy/' "$tmp/plain.su2" >"$tmp/x.su2"
sed 's/"body"/"b%dy"/' "$tmp/text-2.msh" >"$tmp/percent.msh"
check "convert: a name with %: to SU2" "$harmorph" convert "$tmp/percent.msh" "$tmp/percent.su2"
says "convert: a name with %: says so" "the marker 'b%dy' is written as 'b_dy'"
check "convert: a name with %: is read" "$harmorph" check "$tmp/percent.su2" --json
says "convert: a name with %: the marker" '{"name": "b_dy", "faces": 24}'
