# usage: awk -v n=192 -v rows=65 -f ellipse.awk   An O-mesh of n x rows points round an ellipse, as an SU2 file.
BEGIN {
    pi = atan2(0, -1)
    print "NDIME= 2\nNELEM= " n * (rows - 1)
    for (j = 0; j < rows - 1; j++) for (i = 0; i < n; i++) {
        next_i = (i + 1) % n
        print 9, j * n + i, j * n + next_i, (j + 1) * n + next_i, (j + 1) * n + i
    }
    print "NPOIN= " n * rows
    for (j = 0; j < rows; j++) {
        r = exp(2 * pi * j / n)   # the ratio of two rings is that of a square cell
        for (i = 0; i < n; i++) {
            angle = 2 * pi * i / n
            printf "%.15g %.15g\n", (r + .6 / r) * cos(angle), (r - .6 / r) * sin(angle)
        }
    }
    print "NMARK= 2"
    for (k = 0; k < 2; k++) {
        print "MARKER_TAG= " (k ? "far" : "body") "\nMARKER_ELEMS= " n
        row = k ? (rows - 1) * n : 0
        for (i = 0; i < n; i++) print 3, row + i, row + (i + 1) % n
    }
}
