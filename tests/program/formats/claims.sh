# Files that claim to hold more than they do: memory and time of every reader are at most linear in the size of the
# file. (A part of tests/program/formats.sh.) Each file is small and claims about 2^31 of something.
if (ulimit -v 262144 && "$harmorph" --version) >/dev/null 2>&1; then
    claim plain.su2 "s/^NELEM *=.*/NELEM= $big/"
    claim plain.su2 "s/^NPOIN *=.*/NPOIN= $big/"
    claim plain.su2 "s/^MARKER_ELEMS *=.*/MARKER_ELEMS= $big/"
    claim text-2.msh "s/^168\$/$big/"
    claim text-2.msh "s/^192\$/$big/"
    claim text-2.msh "s/^3\$/$big/"
    claim text-4.msh "s/^2 168 /$big 168 /"
    claim text-4.msh "s/^0 2 1 0\$/$big $big $big $big/"
    claim text-4.msh "s/^1 4 1 24\$/1 4 1 $big/"
    claim text.p3d "1s/.*/$big 1/"
    claim text.p3d "1s/.*/46340 46340/"
    claim two-text-iblank.p3d "1s/.*/1048576/"
    claim text.ugrid "1s/^ *[0-9]*/$big/"
    claim text.ugrid "1s/.*/$big $big $big $big $big $big $big/"
    claim fluent.msh "s/^(10 (1 1 a8/(10 (1 1 7fffffff/"
    claim fluent.msh "s/^(13 (3 1 /(13 (3 1 7fffffff 2 2)(/"
    claim fluent.msh "s/^2 2 1 1 0/2 2 1 7fffffff 0/"
    claim fluent-solid.msh "s/^(10 (1 1 150/(10 (1 1 7fffffff/"
    claim fluent-solid.msh "s/^(13 (3 1 /(13 (3 1 7fffffff 2 4)(/"
    "$make_mesh" fluent-polygons.msh "$tmp/fluent-polygons.msh"
    claim fluent-polygons.msh "s/^(13 (3 1 [^(]*( 4/(13 (3 1 7fffffff 2 5)( 7fffffff/"
    claim text.vtk "s/^POINTS 168/POINTS $big/"
    claim text.vtk "s/^CELLS .*/CELLS $big $big/"
    claim text.vtk "s/^CELL_TYPES .*/CELL_TYPES $big/"
    claim text-5.vtk "s/^CELLS .*/CELLS $big $big/"
    claim text.vtu "s/NumberOfPoints=\"168\"/NumberOfPoints=\"$big\"/"
    claim text.vtu "s/NumberOfCells=\"144\"/NumberOfCells=\"$big\"/"
    echo "1 1 $big*0" >"$tmp/claim/short.p3d"
    claims "PLOT3D: a repeat count" "$tmp/claim/short.p3d"
    echo "1 46340 46340 1 $big*0 $big*1 $big*2 $big*1 " >"$tmp/claim/long.p3d"
    claims "PLOT3D: several repeat counts" "$tmp/claim/long.p3d"
    # Heads of compressed and of base64 arrays.
    for head in //////////8= /////w== AAAAQAAAAEAAAABAAAAAQAA=; do
        sed "s|Format=\"binary\">|&$head|" "$tmp/in-place.vtu" >"$tmp/claim/head.vtu"
        claims "VTU: the head $head" "$tmp/claim/head.vtu"
        sed "s|Format=\"binary\">|&$head|" "$tmp/packed-in-place.vtu" >"$tmp/claim/head.vtu"
        claims "VTU: compressed: the head $head" "$tmp/claim/head.vtu"
    done
    # Pieces that share one array.
    awk '/<Piece/ { piece = $0; on = 1; body = ""; next } /<\/Piece/ { on = 0
            for (k = 0; k < 3000; k++) print piece body "</Piece>"; next }
        on { body = body "\n" $0; next } { print }' "$tmp/text.vtu" | tr -d '\r' | head -c 200000 >"$tmp/claim/many.vtu"
    claims "VTU: many pieces" "$tmp/claim/many.vtu"
    # A file that names many pieces, and a piece that is no regular file.
    { echo '<VTKFile type="PUnstructuredGrid"><PUnstructuredGrid>'
        for name in a b c d e f g h; do for k in 0 1 2 3 4 5 6 7 8 9; do echo "<Piece Source=\"$name$k.vtu\"/>"
            ln -f "$tmp/text.vtu" "$tmp/claim/$name$k.vtu"; done; done
        echo '</PUnstructuredGrid></VTKFile>'; } >"$tmp/claim/many.pvtu"
    claims "PVTU: many pieces" "$tmp/claim/many.pvtu"
    sed '3,$ { /Piece/d; }; s|Source=".*"/>|Source="/dev/zero"/>|' "$tmp/claim/many.pvtu" >"$tmp/claim/device.pvtu"
    claims "PVTU: a device as a piece" "$tmp/claim/device.pvtu"
    # OpenFOAM: lists of one value.
    rm -rf "$tmp/claim/foam"
    "$tmp/make_foam" "$tmp/claim/foam" text z
    for file in owner faces points; do
        rm -rf "$tmp/claim/foam-bad"
        cp -r "$tmp/claim/foam" "$tmp/claim/foam-bad"
        sed -n '/FoamFile/,/^}/p' "$tmp/claim/foam/constant/polyMesh/$file" |
            sed 's/class .*/class faceCompactList;/' >"$tmp/claim/foam-bad/constant/polyMesh/$file"
        echo "$big{0} $big{0}" >>"$tmp/claim/foam-bad/constant/polyMesh/$file"
        claims "OpenFOAM: $file of one value" "$tmp/claim/foam-bad"
    done
    sed "s/nFaces .*/nFaces $big;/; s/startFace .*/startFace 0;/" "$tmp/claim/foam/constant/polyMesh/boundary" \
        >"$tmp/claim/boundary"
    cp "$tmp/claim/foam/constant/polyMesh/owner" "$tmp/claim/foam-bad/constant/polyMesh/owner"
    cp "$tmp/claim/foam/constant/polyMesh/faces" "$tmp/claim/foam-bad/constant/polyMesh/faces"
    cp "$tmp/claim/foam/constant/polyMesh/points" "$tmp/claim/foam-bad/constant/polyMesh/points"
    cp "$tmp/claim/boundary" "$tmp/claim/foam-bad/constant/polyMesh/boundary"
    claims "OpenFOAM: patches of all faces" "$tmp/claim/foam-bad"
else
    echo "the program does not start with 256 MiB, or ulimit has no -v: claims of files are not tested"
fi
# Files whose reading takes quadratic time where each item is compared with all others. They take a second of the
# processor at most; the bound of 60 s is for slow machines, and ends what would run for hours.
if (ulimit -t 60) 2>/dev/null; then
    slow() { # slow NAME FILE
        (ulimit -t 60 && exec "$harmorph" check "$2") >"$tmp/out" 2>&1
        code=$?
        if [ $code -lt 128 ]; then ok "linear: $1"; else fail "linear: $1: it takes more than 60 s"; fi
    }
    awk 'BEGIN { n = 100000   # as many markers as edges
        print "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n" n + 1
        print n + 1, 0, 0, 0
        for (i = 1; i <= n; i++) { t = 8 * atan2(1, 1) * i / n; printf "%d %.9f %.9f 0\n", i, cos(t), sin(t) }
        print "$EndNodes\n$Elements\n" 2 * n
        for (i = 1; i <= n; i++) print i, 1, 2, 0, i, i, i % n + 1
        for (i = 1; i <= n; i++) print n + i, 2, 2, 1, 1, n + 1, i, i % n + 1
        print "$EndElements" }' >"$tmp/claim/markers.msh"
    awk 'BEGIN { n = 100000   # one cell, its faces in reverse order
        printf "(2 2)\n(10 (1 1 %x 1 2)(\n", n
        for (i = 0; i < n; i++) { t = 8 * atan2(1, 1) * i / n; printf "%.9f %.9f\n", cos(t), sin(t) }
        printf "))\n(13 (3 1 %x 3 2)(\n", n
        for (i = n; i > 0; i--) printf "%x %x 1 0\n", i, i % n + 1
        print "))" }' >"$tmp/claim/polygon.msh"
    slow "Fluent: a polygon of many faces" "$tmp/claim/polygon.msh"
    awk 'BEGIN { n = 100000   # one cell between two polygons, the polygons behind the other faces
        printf "(2 3)\n(10 (1 1 %x 1 3)(\n", 2 * n
        for (k = 0; k < 2; k++) for (i = 0; i < n; i++) { t = 8 * atan2(1, 1) * i / n; print cos(t), sin(t), k }
        printf "))\n(13 (3 1 %x 3 4)(\n", n
        for (i = n; i > 0; i--) printf "%x %x %x %x 1 0\n", i, i % n + 1, n + i % n + 1, n + i
        printf "))\n(13 (4 %x %x 7 5)(\n", n + 1, n + 2
        for (k = 0; k < 2; k++) { printf "%x", n; for (i = 1; i <= n; i++) printf " %x", k * n + i; print " 1 0" }
        print "))" }' >"$tmp/claim/prism.msh"
    slow "Fluent: a prism of many faces" "$tmp/claim/prism.msh"
    slow "Gmsh: a marker for each edge" "$tmp/claim/markers.msh"
    awk 'BEGIN { n = 60000   # all cells have one point
        print 2 * n + 2, 0, 0, 0, 0, n, 0
        print "0 0 0\n0 0 1"
        for (i = 1; i <= n; i++) { t = 6 * i / n; for (k = 0; k < 2; k++) printf "%.9f %.9f %d\n", cos(t), sin(t), k }
        for (i = 1; i < n; i++) print 1, 2 * i + 1, 2 * i + 3, 2, 2 * i + 2, 2 * i + 4
        print 1, 2 * n + 1, 3, 2, 2 * n + 2, 4 }' >"$tmp/claim/fan.ugrid"
    slow "UGRID: a fan of prisms" "$tmp/claim/fan.ugrid"
    awk 'BEGIN { n = 30000   # hexahedra that have no point in common
        print 8 * n, 0, 0, 0, 0, 0, n
        for (i = 0; i < n; i++) for (k = 0; k < 2; k++) { print 2 * i, 0, k; print 2 * i + 1, 0, k
            print 2 * i + 1, 1, k; print 2 * i, 1, k }
        for (i = 8; i <= 8 * n; i += 8) print i - 7, i - 6, i - 5, i - 4, i - 3, i - 2, i - 1, i }' \
        >"$tmp/claim/apart.ugrid"
    slow "UGRID: cells that are not connected" "$tmp/claim/apart.ugrid"
fi
