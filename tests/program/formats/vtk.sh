# VTK legacy and XML: bad files, and what convert writes. (A part of tests/program/formats.sh.)
sed 's/^9 /12 /' "$tmp/text.vtk" | sed '/^CELL_TYPES/,$s/ 9 / 12 /' >"$tmp/bad.vtk"
refuses "vtk: three dimensions in earnest" \
    'is of type 12 with 4 points, which is not read: save polygons, or triangles, quadrilaterals, wedges' \
    "$harmorph" check "$tmp/bad.vtk"
check "vtk: convert" "$harmorph" convert "$tmp/ring.su2" "$tmp/ring.vtk"
check "vtk: what convert writes" "$harmorph" check "$tmp/ring.vtk" --json
says "vtk: what convert writes: the same mesh" '"boundary1", "faces": 24}, {"name": "boundary2", "faces": 24}'

# VTK XML
change() { sed "$1" "$tmp/text.vtu" >"$tmp/bad.vtu"; }
change 's/9 9 9/12 9 9/'
refuses "vtu: three dimensions in earnest" 'cell 0 is of type 12 with 4 points' \
    "$harmorph" check "$tmp/bad.vtu"
change 's/type="UnstructuredGrid"/type="PolyData"/'
refuses "vtu: another kind of data" \
    "bad.vtu:3: the type of the file must be UnstructuredGrid or StructuredGrid (ParaView's" \
    "$harmorph" check "$tmp/bad.vtu"
change 's/NumberOfPoints="168"/NumberOfPoints="169"/'
refuses "vtu: too few points" "the file needs a coordinate of a point here, but the end of the numbers follows" \
    "$harmorph" check "$tmp/bad.vtu"
change 's/NumberOfPoints="168"/NumberOfPoints="167"/'
refuses "vtu: too many points" 'the array Points has more numbers than 167 points' \
    "$harmorph" check "$tmp/bad.vtu"
change 's/NumberOfCells="144"/NumberOfCells="143"/'
refuses "vtu: too many cells" 'the array offsets has 144 numbers for 143 cells' \
    "$harmorph" check "$tmp/bad.vtu"
change 's/format="ascii"/format="binarie"/'
refuses "vtu: an unknown format" "the array has the format 'binarie'" "$harmorph" check "$tmp/bad.vtu"
change 's/Name="offsets"/Name="starts"/'
refuses "vtu: an array is missing" 'the file has no array offsets' "$harmorph" check "$tmp/bad.vtu"
change '/Name="offsets"/s/ 8 / -9223372036854775808 /; /Name="offsets"/s/Int32/Int64/'
refuses "vtu: an offset that no difference of two numbers fits" 'the offsets of cell 1 are out of range' \
    "$harmorph" check "$tmp/bad.vtu"
head -c 5000 "$tmp/appended-64.vtu" >"$tmp/bad.vtu"
refuses "vtu: cut off before an array" "not '8832'" "$harmorph" check "$tmp/bad.vtu"
head -c 10000 "$tmp/appended-64.vtu" >"$tmp/bad.vtu"
refuses "vtu: cut off in an array" 'the array offsets has 1152 bytes, but only' \
    "$harmorph" check "$tmp/bad.vtu"
sed 's/header_type="UInt64"/& compressor="vtkLZ4DataCompressor"/' "$tmp/appended-64.vtu" >"$tmp/bad.vtu"
refuses "vtu: compressed" 'save the file with the compressor ZLib, or without compression' \
    "$harmorph" check "$tmp/bad.vtu"
check "vtu: convert" "$harmorph" convert "$tmp/ring.su2" "$tmp/ring.vtu"
check "vtu: what convert writes" "$harmorph" check "$tmp/ring.vtu" --json
says "vtu: what convert writes: the same mesh" '"boundary1", "faces": 24}, {"name": "boundary2", "faces": 24}'
check "vtu: what convert writes: the same points" "$harmorph" convert "$tmp/ring.vtu" "$tmp/again.su2"
sed -n '/^NPOIN/,/^NMARK/p' "$tmp/ring.su2" | awk '{ print $1, $2 }' >"$tmp/points-before"
sed -n '/^NPOIN/,/^NMARK/p' "$tmp/again.su2" | awk '{ print $1, $2 }' >"$tmp/points-after"
check "vtu: what convert writes: the same coordinates" alike 0 "$tmp/points-before" "$tmp/points-after"

# Lagrange cells of first and second order are the cells that VTK had before: the same mesh, and the same movement.
vtu_cells() { "${PYTHON:-/usr/bin/python3}" tests/program/formats/vtu_cells.py "$@"; }
if vtu_cells cells 9 4 "$tmp/old.vtu" 2>/dev/null; then
    for pair in '5 69 3' '22 69 6' '34 69 7' '9 70 4' '23 70 8' '28 70 9'; do
        set -- $pair
        name="vtu: type $2 with $3 points"
        vtu_cells cells $1 $3 "$tmp/old.vtu"
        vtu_cells cells $2 $3 "$tmp/lagrange.vtu"
        morphs "$name: the older type $1" "$tmp/old.vtu" boundary1
        morphs "$name" "$tmp/lagrange.vtu" boundary1
        sed "/\"types\"/s/ $2\\>/ $1/g; /\"types\"/s/>$2\\>/>$1/" "$tmp/moved-lagrange.vtu" >"$tmp/as-old.vtu"
        check "$name: moves like type $1" cmp "$tmp/moved-old.vtu" "$tmp/as-old.vtu"
    done
    for wrong in '69 4' '70 7' '69 5' '70 3'; do
        set -- $wrong
        vtu_cells cells 9 4 "$tmp/old.vtu"
        sed "/\"types\"/s/\\<9\\>/$1/g" "$tmp/old.vtu" | sed "/\"offsets\"/s/>4 /> $2 /" >"$tmp/bad.vtu"
        refuses "vtu: type $1 with $2 points" "cell 0 is of type $1 with $2 points" "$harmorph" check "$tmp/bad.vtu"
    done
    # Compressed arrays that unpack to more than the points and cells need are refused before they are unpacked: the
    # memory that the program may take does not hold the last ones.
    if has_zlib; then
        vtu_cells packed none 0 "$tmp/packed-cells.vtu"
        check "vtu: packed arrays" "$harmorph" check "$tmp/packed-cells.vtu"
        for array in Points connectivity offsets types; do
            for extra in 1 8 70000; do
                vtu_cells packed $array $extra "$tmp/bad.vtu"
                refuses "vtu: $array unpack to $extra bytes too many" "the array $array unpacks to " \
                    "$harmorph" check "$tmp/bad.vtu"
            done
        done
        vtu_cells packed field 16 "$tmp/bad.vtu"
        refuses "vtu: a field unpacks to too much" 'the array field unpacks to ' "$harmorph" interpolate \
            "$tmp/packed-cells.vtu" "$tmp/bad.vtu" "$tmp/packed-cells.vtu" -o "$tmp/x.csv"
        check "vtu: another field unpacks to too much: the mesh is read" "$harmorph" check "$tmp/bad.vtu"
        if (ulimit -v 262144 && "$harmorph" --version) >/dev/null 2>&1; then
            for array in Points connectivity; do
                vtu_cells packed $array 400000000 "$tmp/bad.vtu"
                refuses "vtu: $array of 400 MB in 1 MB" "the array $array unpacks to 4e+08 bytes" \
                    sh -c 'ulimit -v 262144; exec "$0" check "$1"' "$harmorph" "$tmp/bad.vtu"
            done
        fi
    fi
else skip "cells of VTU files" "python3 is not installed"; fi
