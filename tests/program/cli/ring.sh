# Sourced by run.sh. A ring of cells round a circle: its mesh, the curve of the circle, functions, and movements.

# A ring of quads, some split into triangles, between a circle of radius 1 and one of radius 4.
make_ring() { # make_ring POINTS-ROUND CELLS-OUTWARDS
    awk -v n="$1" -v m="$2" 'BEGIN {
    pi = atan2(0, -1)
    print "% a ring\nNDIME= 2\nNELEM= " n * m + n
    for (j = 0; j < m; j++) for (i = 0; i < n; i++) {
        a = j * n + i; b = j * n + (i + 1) % n
        if (j == m - 1) printf "5 %d %d %d\n5 %d %d %d\n", a, a + n, b, b, a + n, b + n
        else printf "9 %d %d %d %d %d\n", a, a + n, b + n, b, a
    }
    print "NPOIN= " n * (m + 1)
    for (j = 0; j <= m; j++) for (i = 0; i < n; i++) {
        r = exp(log(4) * j / m); t = 2 * pi * i / n
        printf "%.15f\t%.15f %d\n", r * cos(t), r * sin(t), j * n + i
    }
    print "NMARK= 2\nMARKER_TAG= body\nMARKER_ELEMS= " n
    for (i = 0; i < n; i++) print "3 " i " " (i + 1) % n
    print "MARKER_TAG= far\nMARKER_ELEMS= " n
    for (i = 0; i < n; i++) print "3 " m * n + i " " m * n + (i + 1) % n
}'
}
make_ring 48 12 >"$tmp/ring.su2"
ring=$tmp/ring.su2 curve=$tmp/ring.curve basis=$tmp/ring.basis
no_moves=$tmp/none.txt
echo '# nothing moves' >"$no_moves"
printf '1 .05 0 # to the right\n\n3 0 -.02\n' >"$tmp/small.txt"
awk 'BEGIN { for (i = 1; i <= 12; i++) print i, 9, 0 }' >"$tmp/large.txt"
makes fit "$ring" --marker body --points 12 --closed periodic -o "$curve"
makes solve "$ring" --curve body="$curve" -o "$basis"
