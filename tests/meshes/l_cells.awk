# awk -f l_cells.awk >mesh.vtk: the unit square with a hole, of cells of the shape of an L, each with one reflex corner and two
# flat ones. (VTK legacy format, text.)
BEGIN {
    print "# vtk DataFile Version 3.0\ncells of the shape of an L round a hole\nASCII\nDATASET UNSTRUCTURED_GRID"
    for (j = 0; j <= 12; j++) for (i = 0; i <= 12; i++) {
        if (i == 5 && (j == 4 || j == 5)) continue     # inside the hole
        number[i, j] = points++
        place = place i / 12 " " j / 12 " 0\n"
    }
    first = "2 0  2 1  1 1  1 2  0 2  0 1  0 0  1 0"
    second = "0 2  1 2  1 1  2 1  2 2  2 3  1 3  0 3"
    for (j = 0; j < 12; j += 3) for (i = 0; i < 12; i += 2) {
        if (i == 4 && j == 3) continue
        for (which = 0; which < 2; which++) {
            split(which ? second : first, at)
            cell = cell "8"
            for (k = 1; k < 16; k += 2) cell = cell " " number[i + at[k], j + at[k + 1]]
            cell = cell "\n"
            type = type "7\n"
            ++cells
        }
    }
    printf "POINTS %d double\n%sCELLS %d %d\n%sCELL_TYPES %d\n%s", points, place, cells, 9 * cells, cell, cells, type
}
