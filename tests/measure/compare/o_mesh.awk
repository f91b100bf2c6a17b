# Writes an SU2 mesh around a Joukowski section with a rounded trailing edge: an O-mesh of quadrilaterals that is the
# image of a ring, with thin layers at the wall. The chord is 1, from x = 0 to 1. The circle of the ring has the centre
# (shift, 0); with shift 0 the section is an ellipse.
#   awk [-v around=POINTS] [-v layers=LAYERS] [-v first=HEIGHT] [-v shift=X] [-v circle=RADIUS] -f o_mesh.awk
function image(r, angle,    zx, zy, square) {   # the map z + 1 / z of a circle around (shift, 0) with radius r
    zx = shift + r * cos(angle)
    zy = r * sin(angle)
    square = zx * zx + zy * zy
    x = zx + zx / square
    y = zy - zy / square
}
BEGIN {
    if (!around) around = 192
    if (!layers) layers = 56
    if (!first) first = 2e-4
    far = 40
    if (shift == "") shift = -.09
    if (!circle) circle = 1.1
    image(circle, 0); right = x
    image(circle, atan2(0, -1)); left = x
    growth = 1.25     # the ratio of layer heights for which the layers end at `far`
    for (k = 0; k < 60; ++k) {
        sum = first * (growth ^ layers - 1) / (growth - 1)
        growth *= (far / sum) ^ (1 / layers)
    }
    print "NDIME= 2\nNELEM= " around * layers
    for (j = 0; j < layers; ++j)
        for (i = 0; i < around; ++i) {
            next_one = (i + 1) % around
            print 9, j * around + i, j * around + next_one, (j + 1) * around + next_one, (j + 1) * around + i
        }
    print "NPOIN= " around * (layers + 1)
    for (j = 0; j <= layers; ++j)
        for (i = 0; i < around; ++i) {
            image(circle + first * (growth ^ j - 1) / (growth - 1), 8 * atan2(1, 1) * i / around)
            printf "%.17g %.17g\n", (x - left) / (right - left), y / (right - left)
        }
    print "NMARK= 2\nMARKER_TAG= airfoil\nMARKER_ELEMS= " around
    for (i = 0; i < around; ++i) print 3, i, (i + 1) % around
    print "MARKER_TAG= far\nMARKER_ELEMS= " around
    for (i = 0; i < around; ++i) print 3, layers * around + i, layers * around + (i + 1) % around
}
