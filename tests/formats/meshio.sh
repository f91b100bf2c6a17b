# meshio reads what is morphed. (A part of tests/formats.sh.)
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
