# awk -f merge_cells.awk mesh.su2 >mesh.vtk: the mesh with every cell merged with a neighbour, where one is left, into a
# polygon of four to six corners: convex, with hanging nodes, and reflex. (VTK legacy format, text.)
/^NELEM=/ { left = $2; n = $2; kind = "cell"; cell = 0; next }
/^NPOIN=/ { left = $2; points = $2; kind = "point"; at = 0; next }
/^[A-Z]/ { kind = "" }
kind == "cell" && left-- > 0 {
    size[cell] = $1 == 9 ? 4 : 3
    for (k = 0; k < size[cell]; k++) corner[cell, k] = $(k + 2)
    for (k = 0; k < size[cell]; k++) side[corner[cell, k], corner[cell, (k + 1) % size[cell]]] = cell
    cell++
}
kind == "point" && left-- > 0 { x[at] = $1; y[at] = $2; at++ }
# The cell's points from its side k on, all of them: begins with the end of the side, ends with its beginning.
function from_side(cell, k,    i, text) {
    for (i = 1; i <= size[cell]; i++) text = text " " corner[cell, (k + i) % size[cell]]
    return text
}
END {
    m = 0
    for (c = 0; c < n; c++) {
        if (merged[c]) continue
        merged[c] = 1
        row[m] = from_side(c, 0); count[m] = size[c]
        for (k = 0; k < size[c]; k++) {
            a = corner[c, k]; b = corner[c, (k + 1) % size[c]]
            if (!((b, a) in side) || merged[side[b, a]]) continue
            d = side[b, a]
            merged[d] = 1
            for (i = 0; corner[d, i] != b; i++) continue
            # b ... a of this cell, then what the other has between a and b.
            rest = from_side(d, i)
            sub(/^ [0-9]+/, "", rest); sub(/ [0-9]+$/, "", rest)
            row[m] = from_side(c, k) rest
            count[m] = size[c] + size[d] - 2
            break
        }
        entries += count[m++] + 1
    }
    print "# vtk DataFile Version 3.0\nmerged cells\nASCII\nDATASET UNSTRUCTURED_GRID"
    print "POINTS " points " double"
    for (k = 0; k < points; k++) print x[k], y[k], 0
    print "CELLS " m " " entries
    for (c = 0; c < m; c++) print count[c] row[c]
    print "CELL_TYPES " m
    for (c = 0; c < m; c++) print 7
}
