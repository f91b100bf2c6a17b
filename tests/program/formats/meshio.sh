# meshio reads what is morphed. (A part of tests/program/formats.sh.)
if /usr/bin/python3 -c 'import meshio' 2>/dev/null; then # reads plain files of these formats
    echo 'import sys, meshio
for p in meshio.read(sys.argv[1]).points: print(repr(float(p[0])), repr(float(p[1])))' >"$tmp/read_points.py"
    "$harmorph" convert "$tmp/moved-plain.su2" "$tmp/meshio.msh" >"$tmp/out"
    for mesh in moved-plain.su2 meshio.msh; do
        check "meshio reads $mesh" timeout 60 /usr/bin/python3 "$tmp/read_points.py" "$tmp/$mesh"
        grep -E '^-?[0-9.e+-]+ -?[0-9.e+-]+$' "$tmp/out" >"$tmp/points"
        check "meshio reads $mesh: moved as all are" alike 1e-12 "$tmp/points-of-all" "$tmp/points"
    done
    # The morphed file has the cells of the given one; its points are finite, have moved, and no cell is of another
    # volume's sign: prisms and hexahedra by the tetrahedron of the first corner's edges.
    cat >"$tmp/compare.py" <<'END'
import sys, meshio, numpy
given, moved = (meshio.read(name) for name in sys.argv[1:])
assert numpy.isfinite(moved.points).all()
assert 0 < abs(moved.points - given.points).max() < 1
assert len(given.cells) == len(moved.cells)
edges = {"triangle": (1, 2), "quad": (1, 3), "wedge": (1, 2, 3), "hexahedron": (1, 3, 4)}
for before, after in zip(given.cells, moved.cells):
    assert before.type == after.type and (before.data == after.data).all()
    if before.type not in edges: continue
    sides = [numpy.array([m.points[before.data[:, k]] - m.points[before.data[:, 0]] for k in edges[before.type]])
             for m in (given, moved)]
    size = [numpy.linalg.det(numpy.moveaxis(s, 0, 1)) if len(s) == 3 else
            numpy.linalg.norm(numpy.cross(s[0], s[1]), axis=1) for s in sides]
    assert (size[0] * size[1] > 0).all()
    print(before.type, len(before.data))
END
    for mesh in text.ugrid hexahedra.b8.ugrid prisms.lb8.ugrid text.vtu appended-64.vtu; do
        body=$(body_of "$tmp/$mesh")
        morphs "meshio: $mesh" "$tmp/$mesh" "$body"
        check "meshio reads the morphed $mesh" timeout 60 /usr/bin/python3 "$tmp/compare.py" "$tmp/$mesh" \
            "$tmp/moved-$mesh"
    done
else
    echo "meshio is not installed: it does not look at the morphed meshes (Debian's python3-meshio)"
fi
