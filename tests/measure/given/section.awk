# usage: awk -v seed=N -f section.awk </dev/null >section.geo
# For gmsh: triangles round a section of NACA's four digits in a rectangle, camber, thickness and sizes by chance; for even
# seeds with layers of thin quadrilaterals at the wall, marker "wing".
BEGIN {
    srand(seed)
    pi = atan2(0, -1)
    n = 40 + int(40 * rand())
    camber = .08 * rand()
    thickness = .06 + .16 * rand()
    size = .01 + .02 * rand()
    for (k = 0; k < 2 * n; ++k) {
        x = .5 * (1 + cos(pi * k / n))
        half = 5 * thickness * (.2969 * sqrt(x) - .126 * x - .3516 * x ^ 2 + .2843 * x ^ 3 - .1036 * x ^ 4)
        printf "Point(%d) = {%.15g, %.15g, 0, %g};\n", k + 1, x, (k <= n ? half : -half) + 4 * camber * x * (1 - x), size
    }
    far = 2 * n
    printf "Point(%d) = {-4, -4, 0, .8}; Point(%d) = {6, -4, 0, .8};\n", far + 1, far + 2
    printf "Point(%d) = {6, 4, 0, .8}; Point(%d) = {-4, 4, 0, .8};\n", far + 3, far + 4
    for (side = 0; side < 2; ++side) {
        printf "Spline(%d) = {", side + 1
        for (k = side * n; k <= (side + 1) * n; ++k) printf "%s%d", (k > side * n ? ", " : ""), k % (2 * n) + 1
        print "};"
    }
    for (k = 1; k <= 4; ++k) printf "Line(%d) = {%d, %d};\n", k + 2, far + k, far + k % 4 + 1
    print "Curve Loop(1) = {1, 2}; Curve Loop(2) = {3, 4, 5, 6}; Plane Surface(1) = {2, 1};"
    if (seed % 2 == 0) {
        print "Field[1] = BoundaryLayer; Field[1].CurvesList = {1, 2}; Field[1].Size = 1e-4; Field[1].Ratio = 1.25;"
        print "Field[1].Thickness = .03; Field[1].Quads = 1; Field[1].FanPointsList = {1}; BoundaryLayer Field = 1;"
    }
    print "Physical Curve(\"wing\") = {1, 2}; Physical Curve(\"far\") = {3, 4, 5, 6}; Physical Surface(\"air\") = {1};"
}
