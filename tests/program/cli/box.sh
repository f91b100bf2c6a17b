# Sourced by run.sh. A square of 12 x 12 cells round a block of 4 x 2, which is a curve or a rigid body: meshes,
# functions, movements, and where points are.

awk 'BEGIN {
    n = 12
    for (j = 0; j <= n; j++) for (i = 0; i <= n; i++) if (!(i > 4 && i < 8 && j > 5 && j < 7)) id[i, j] = points++
    for (j = 0; j < n; j++) for (i = 0; i < n; i++) if (!(i >= 4 && i < 8 && j >= 5 && j < 7))
        cell[cells++] = "9 " id[i, j] " " id[i + 1, j] " " id[i + 1, j + 1] " " id[i, j + 1]
    print "NDIME= 2\nNELEM= " cells
    for (k = 0; k < cells; k++) print cell[k]
    print "NPOIN= " points
    for (j = 0; j <= n; j++) for (i = 0; i <= n; i++) if ((i, j) in id) print i, j
    print "NMARK= 5\nMARKER_TAG= low\nMARKER_ELEMS= 12"
    for (k = 0; k < n; k++) print 3, id[k, 0], id[k + 1, 0]
    print "MARKER_TAG= high\nMARKER_ELEMS= 12"
    for (k = 0; k < n; k++) print 3, id[k, n], id[k + 1, n]
    print "MARKER_TAG= in:let\nMARKER_ELEMS= 12"
    for (k = 0; k < n; k++) print 3, id[0, k], id[0, k + 1]
    print "MARKER_TAG= out\nMARKER_ELEMS= 12"
    for (k = 0; k < n; k++) print 3, id[n, k], id[n, k + 1]
    print "MARKER_TAG= block\nMARKER_ELEMS= 12"
    for (i = 4; i < 8; i++) print 3 " " id[i, 5] " " id[i + 1, 5] "\n" 3 " " id[i, 7] " " id[i + 1, 7]
    for (j = 5; j < 7; j++) print 3 " " id[4, j] " " id[4, j + 1] "\n" 3 " " id[8, j] " " id[8, j + 1]
}' >"$tmp/box.su2"
box=$tmp/box.su2 on_block="--curve block=$tmp/block.curve"
printf 'degree 1\nclosed tied\npoints 4\n4 5\n8 5\n8 7\n4 7\nknots 7\n0 0 1 2 3 4 4\n' >"$tmp/block.curve"
# place X Y FILE: where the mesh in FILE has the point that box.su2 has at X, Y
place() {
    awk -v x="$1" -v y="$2" '/^NPOIN/ { left = $2; if (++file == 1) at = -1; k = 0; next }
        left > 0 { if (file == 1 && $1 == x && $2 == y) at = k; if (file == 2 && k == at) print $1, $2; k++;
        left-- }' "$box" "$3"
}
near() { # near X Y WANTED_X WANTED_Y: to 1e-12; a * is any
    echo "$@" | awk 'function off(a, b) { return b != "*" && (a - b > 1e-12 || b - a > 1e-12) } { exit off($1, $3) ||
        off($2, $4) || NF != 4 }'
}
turn() { # turn DEGREES [SHIFT]: moves of the block's corners about its middle, and to the right
    awk -v a="$1" -v d="${2:-0}" 'BEGIN {
        a *= atan2(0, -1) / 180; split("4 8 8 4", x); split("5 5 7 7", y)
        for (k = 1; k <= 4; k++) { u = x[k] - 6; v = y[k] - 6
            printf "%d %.17g %.17g\n", k, u * cos(a) - v * sin(a) - u + d, u * sin(a) + v * cos(a) - v } }'
}

turn 40 >"$tmp/turn40.txt"
turn 3 >"$tmp/turn3.txt"
turn 60 >"$tmp/turn60.txt"
turn 150 >"$tmp/turn150.txt"
printf '# a body\nrigid block .5 -.25 90 1.25\n' >"$tmp/rigid.txt"
sed 's/^5 0$/5 -.01/' "$box" >"$tmp/bent.su2" # its lower side is bent
for operator in laplace conformal; do makes solve "$box" $on_block --operator $operator -o "$tmp/$operator.basis"; done
makes solve "$box" --rigid block -o "$tmp/rigid.basis"
