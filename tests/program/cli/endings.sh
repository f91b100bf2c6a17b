# The ending of an output decides its format.

echo "3 0.02 0.04" >"$tmp/moves"
makes morph "$ring" "$tmp/ring.basis" --move "$tmp/moves" -o "$tmp/kept.su2"
for name in kept.mesh kept.001 kept; do
    makes morph "$ring" "$tmp/ring.basis" --move "$tmp/moves" -o "$tmp/$name"
    check "endings: without a known one the format is kept: $name" cmp "$tmp/kept.su2" "$tmp/$name"
done
# The same coordinates in each format; those of the SU2 file have the digits of the file.
coordinates_of() { awk '/^NPOIN/ { inside = 1; next } /^[A-Z]/ { inside = 0 } inside { print $1, $2 }' "$1"; }
coordinates_of "$tmp/kept.su2" >"$tmp/kept.xy"
for ending in msh vtu vtk; do
    runs "endings: morph to .$ending" 0 morph "$ring" "$tmp/ring.basis" --move "$tmp/moves" -o "$tmp/other.$ending"
    makes convert "$tmp/other.$ending" "$tmp/back.su2"
    coordinates_of "$tmp/back.su2" | paste -d' ' - "$tmp/kept.xy" >"$tmp/both"
    check "endings: the coordinates in .$ending" awk '{ for (k = 1; k < 3; k++) { d = $k - $(k + 2)
        if (d > 1e-5 || d < -1e-5) bad++ } } END { exit !(NR == 624 && !bad) }' "$tmp/both"
    # What convert makes of the mesh that did not move has the same lines but for the coordinates.
    makes convert "$ring" "$tmp/still.$ending"
    check "endings: as many lines as of convert, .$ending" test "$(wc -l <"$tmp/still.$ending")" = \
        "$(wc -l <"$tmp/other.$ending")"
done
check "endings: other.msh is Gmsh's" grep -q MeshFormat "$tmp/other.msh"
makes convert "$ring" "$tmp/start.msh"
makes fit "$tmp/start.msh" --marker body --points 12 --closed periodic -o "$tmp/start.curve"
makes solve "$tmp/start.msh" --curve body="$tmp/start.curve" -o "$tmp/start.basis"
runs "endings: Gmsh to SU2" 0 morph "$tmp/start.msh" "$tmp/start.basis" --move "$tmp/moves" -o "$tmp/changed.su2"
check "endings: an SU2 file" grep -q '^NDIME' "$tmp/changed.su2"
awk '/^NPOIN/ { inside = 1; next } /^[A-Z]/ { inside = 0 } inside && n++ < 48 { print n - 1, 0, .01 }' "$ring" \
    >"$tmp/given"
runs "endings: displace to .vtu" 0 displace "$ring" --given body --wall "$tmp/given" -o "$tmp/displaced.vtu"
check "endings: a VTK file" grep -q '<VTKFile' "$tmp/displaced.vtu"
for ending in p3d ugrid cgns; do
    refuses "endings: .$ending is not written" 2 'new files are gmsh' morph "$ring" "$tmp/ring.basis" \
        --move "$tmp/moves" -o "$tmp/x.$ending"
    leaves_nothing "endings: nothing in .$ending" "$tmp/x.$ending"
done
for words in "--svg x.png .svg" "--vtu x.vtk .vtu" "--csv x.txt .csv" "--report x.pdf .html" \
    "--boundary-svg x.jpg .svg"; do
    set -- $words
    refuses "endings: $1 $2" 2 "must end in $3" morph "$ring" "$tmp/ring.basis" --move "$tmp/moves" $1 "$tmp/$2"
    leaves_nothing "endings: no $2" "$tmp/$2"
done
