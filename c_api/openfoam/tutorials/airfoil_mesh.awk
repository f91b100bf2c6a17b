# Writes an O-mesh around a symmetric airfoil, one cell thick, in Gmsh's format 2.2. The map of Karman and Trefftz makes
# the airfoil, 15 % thick, and the mesh from circles, so that the lines of the mesh are orthogonal. The chord is 1.
#   awk -v ni=128 -v nj=48 -f airfoil_mesh.awk
# ni, nj: cells around and across. The points of the airfoil have the numbers 1 to ni in the first plane.
function point(i, j, z) { return 1 + i % ni + ni * (j + (nj + 1) * z) }
function quad(group, a, b, c, d) { print ++n, 3, 2, group, group, a, b, c, d }
function side(group, i, j) { quad(group, point(i, j, 0), point(i + 1, j, 0), point(i + 1, j, 1), point(i, j, 1)) }
# image(r, a) sets x, y: the image of the point of the circles at the radius r and the angle a.
function image(r, a,    u, v, d, p, q, m, t) {
    u = r * cos(a) - shift; v = r * sin(a)
    d = (u + 1) ^ 2 + v ^ 2                       # w = ((u + iv - 1) / (u + iv + 1)) ^ power
    p = (u ^ 2 + v ^ 2 - 1) / d; q = 2 * v / d
    m = exp(power / 2 * log(p ^ 2 + q ^ 2 + 1e-300)); t = power * atan2(q, p)
    p = m * cos(t); q = m * sin(t)
    d = (1 - p) ^ 2 + q ^ 2                       # power (1 + w) / (1 - w)
    x = power * (1 - p ^ 2 - q ^ 2) / d; y = 2 * power * q / d
}
BEGIN {
    pi = atan2(0, -1); power = 2 - 14 / 180; shift = 0.09; radius = 1 + shift
    image(radius, pi); nose = x
    image(radius, 0); chord = x - nose
    first = 0.004; far = 20                       # chords; bisection finds the growth of the layers between them
    growth = 1.001; high = 2
    while (high - growth > 1e-12) {
        middle = (growth + high) / 2
        if (first * (middle ^ nj - 1) / (middle - 1) < far) growth = middle; else high = middle
    }
    print "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes"
    print 2 * ni * (nj + 1)
    for (z = 0; z < 2; ++z) for (j = 0; j <= nj; ++j) for (i = 0; i < ni; ++i) {
        image(radius + first * chord * (growth ^ j - 1) / (growth - 1), 2 * pi * i / ni)
        printf "%d %.15g %.15g %.15g\n", point(i, j, z), (x - nose) / chord, y / chord, 0.1 * z
    }
    print "$EndNodes\n$PhysicalNames\n5\n2 1 \"airfoil\"\n2 2 \"far\"\n2 3 \"front\"\n2 4 \"back\"\n3 5 \"fluid\""
    print "$EndPhysicalNames\n$Elements"
    print ni * nj * 3 + 2 * ni
    for (i = 0; i < ni; ++i) {
        side(1, i, 0); side(2, i, nj)
        for (j = 0; j < nj; ++j) {
            for (z = 0; z < 2; ++z)
                quad(3 + z, point(i, j, z), point(i + 1, j, z), point(i + 1, j + 1, z), point(i, j + 1, z))
            print ++n, 5, 2, 5, 5, point(i + 1, j, 0), point(i, j, 0), point(i, j + 1, 0), point(i + 1, j + 1, 0),
                point(i + 1, j, 1), point(i, j, 1), point(i, j + 1, 1), point(i + 1, j + 1, 1)
        }
    }
    print "$EndElements"
}
