# Writes an O-mesh around an ellipse, one cell thick, in Gmsh's format 2.2: awk -v ni=64 -v nj=32 -f mesh.awk.
# Groups: 1 the wall, 2 the outer boundary, 3 the two planes, 4 the fluid.
BEGIN {
    pi = atan2(0, -1)
    print "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes"
    print 2 * ni * (nj + 1)
    for (z = 0; z < 2; ++z) for (j = 0; j <= nj; ++j) for (i = 0; i < ni; ++i) {
        r = exp(3 * j / nj); a = 2 * pi * i / ni
        printf "%d %.15g %.15g %.15g\n", point(i, j, z), (r + 0.6 / r) * cos(a), (r - 0.6 / r) * sin(a), 0.1 * z
    }
    print "$EndNodes\n$Elements"
    print ni * nj * 3 + 2 * ni
    for (i = 0; i < ni; ++i) {
        side(1, i, 0); side(2, i, nj)
        for (j = 0; j < nj; ++j) {
            for (z = 0; z < 2; ++z)
                print ++n, 3, 2, 3, 3, point(i, j, z), point(i + 1, j, z), point(i + 1, j + 1, z), point(i, j + 1, z)
            print ++n, 5, 2, 4, 4, point(i + 1, j, 0), point(i, j, 0), point(i, j + 1, 0), point(i + 1, j + 1, 0),
                point(i + 1, j, 1), point(i, j, 1), point(i, j + 1, 1), point(i + 1, j + 1, 1)
        }
    }
    print "$EndElements"
}
function point(i, j, z) { return 1 + i % ni + ni * (j + (nj + 1) * z) }
function side(group, i, j) {
    print ++n, 3, 2, group, group, point(i, j, 0), point(i + 1, j, 0), point(i + 1, j, 1), point(i, j, 1)
}
