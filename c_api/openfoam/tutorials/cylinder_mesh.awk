# Writes the blockMeshDict of a cylinder of radius 0.5 in a square, one cell thick: awk -f cylinder_mesh.awk.
#   -v across=TYPE    of the patches bottom and top: symmetryPlane (default), patch, or cyclic
#   -v ring=1         the circle of radius 1.5 is a sliding interface: the patches inner and outer, cyclicAMI
#   -v wedge=1        no cylinder: a pipe, a wedge about the axis x, with the patches inlet, outlet, wall
function square(s, r) { return sprintf("%.15g %.15g", (s == 0 || s == 3) ? -r : r, s < 2 ? -r : r) }
function vertices(r,    z, s) {   # four corners in each plane
    for (z = 0; z < 2; ++z) for (s = 0; s < 4; ++s) printf "(%s %.15g)\n", square(s, r), 0.1 * z
    return n_vertices += 8
}
function corner(set, s, z) { return 8 * set + s % 4 + 4 * z }
function blocks(inside, outside, cells, grading,    s) {
    for (s = 0; s < 4; ++s)
        printf "hex (%d %d %d %d %d %d %d %d) (16 %d 1) simpleGrading (1 %s 1)\n",
            corner(inside, s + 1, 0), corner(inside, s, 0), corner(outside, s, 0), corner(outside, s + 1, 0),
            corner(inside, s + 1, 1), corner(inside, s, 1), corner(outside, s, 1), corner(outside, s + 1, 1), cells, grading
}
function arcs(set, r,    s, z, middle) {
    split("0 -1 1 0 0 1 -1 0", middle, " ")
    for (z = 0; z < 2; ++z) for (s = 0; s < 4; ++s)
        printf "arc %d %d (%s %s %s)\n", corner(set, s, z), corner(set, s + 1, z), r * middle[2 * s + 1],
            r * middle[2 * s + 2], 0.1 * z
}
function face(set, s) {
    return sprintf("(%d %d %d %d)", corner(set, s, 0), corner(set, s + 1, 0), corner(set, s + 1, 1), corner(set, s, 1))
}
function circle(set) { return face(set, 0) face(set, 1) face(set, 2) face(set, 3) }
function planes(inside, outside,    s, z, all) {
    for (z = 0; z < 2; ++z) for (s = 0; s < 4; ++s)
        all = all sprintf("(%d %d %d %d)", corner(inside, s, z), corner(inside, s + 1, z), corner(outside, s + 1, z),
            corner(outside, s, z))
    return all
}
BEGIN {
    print "convertToMeters 1;\nvertices ("
    if (wedge) {
        c = cos(2.5 * atan2(0, -1) / 180); s = sin(2.5 * atan2(0, -1) / 180)
        printf "(0 0 0)\n(2 0 0)\n(2 %.15g %.15g)\n(0 %.15g %.15g)\n(2 %.15g %.15g)\n(0 %.15g %.15g)\n", c, -s, c, -s, c, s, c, s
        print "); blocks (hex (0 1 2 3 0 1 4 5) (20 10 1) simpleGrading (1 0.5 1)); edges (); boundary ("
        print "inlet { type patch; faces ((0 3 5 0)); } outlet { type patch; faces ((1 2 4 1)); }"
        print "wall { type wall; faces ((3 2 4 5)); }"
        print "front { type wedge; faces ((0 1 2 3)); } back { type wedge; faces ((0 1 4 5)); } );"
        exit
    }
    vertices(0.5 / sqrt(2))
    if (ring) { vertices(1.5 / sqrt(2)); vertices(1.5 / sqrt(2)) }
    vertices(3)
    outside = ring ? 3 : 1
    print ");\nblocks ("
    if (ring) { blocks(0, 1, 12, 4); blocks(2, 3, 8, 2) } else blocks(0, 1, 20, 8)
    print ");\nedges ("
    arcs(0, 0.5)
    if (ring) { arcs(1, 1.5); arcs(2, 1.5) }
    print ");\nboundary ("
    if (across == "") across = "symmetryPlane"
    for (s = 0; s < 4; ++s) {
        name = substr("bottomoutlettop   inlet ", 6 * s + 1, 6); sub(/ +/, "", name)
        type = s % 2 ? "patch" : across
        if (type == "cyclic") type = "cyclic; neighbourPatch " (s ? "bottom" : "top")
        printf "%s { type %s; faces (%s); }\n", name, type, face(outside, s)
    }
    printf "cylinder { type wall; faces (%s); }\n", circle(0)
    if (ring) {
        printf "inner { type cyclicAMI; neighbourPatch outer; faces (%s); }\n", circle(1)
        printf "outer { type cyclicAMI; neighbourPatch inner; faces (%s); }\n", circle(2)
    }
    printf "frontAndBack { type empty; faces (%s); } );\n", planes(0, 1) (ring ? planes(2, 3) : "")
}
