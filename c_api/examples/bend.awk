# Displacements for coupling.c, as a coupling library might hand them over: the tail of the marker "airfoil" of an SU2 mesh
# swings in 40 steps. A line with the number of points, a line for each with its number, then dx dy of all, step by step.
/^NPOIN=/ { points = $2; next }
points > 0 { x[n++] = $1; points--; next }
/^MARKER_TAG=/ { inside = $2 == "airfoil"; next }
inside && NF >= 3 && $1 == 3 { if (!($2 in seen)) wall[m++] = $2; seen[$2] = 1; if (!($3 in seen)) wall[m++] = $3; seen[$3] = 1 }
END {
    print m
    for (k = 0; k < m; k++) print wall[k]
    for (step = 1; step <= 40; step++)
        for (k = 0; k < m; k++) {
            tail = x[wall[k]] > 0.5 ? 2 * (x[wall[k]] - 0.5) : 0
            printf "%.17g %.17g\n", 0, 0.1 * sin(0.3 * step) * tail * tail
        }
}
