# Writes an SU2 mesh of n x m quadrilaterals around a circle: awk -v n=1000 -v m=1000 -f large_mesh.awk
BEGIN {
    pi = atan2(0, -1)
    print "NDIME= 2\nNELEM= " n * m
    for (j = 0; j < m; j++) for (i = 0; i < n; i++) {
        a = j * n + i; b = j * n + (i + 1) % n
        print 9, a, a + n, b + n, b, a
    }
    print "NPOIN= " n * (m + 1)
    for (j = 0; j <= m; j++) for (i = 0; i < n; i++) {
        r = exp(log(20) * j / m); t = 2 * pi * i / n
        printf "%.16e\t%.16e\t%d\n", r * cos(t), r * sin(t), j * n + i
    }
    print "NMARK= 2\nMARKER_TAG= body\nMARKER_ELEMS= " n
    for (i = 0; i < n; i++) print 3, i, (i + 1) % n
    print "MARKER_TAG= far\nMARKER_ELEMS= " n
    for (i = 0; i < n; i++) print 3, m * n + i, m * n + (i + 1) % n
}
