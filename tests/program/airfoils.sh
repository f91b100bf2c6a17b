#!/bin/sh
# Tests of moved shapes: a mesh morphed to another airfoil, rational curves and namelists out.
#   sh tests/program/airfoils.sh path/to/harmorph path/to/meshes folder/for/output
harmorph=$1 meshes=$2 tmp=$3 here=$(dirname "$0")
: "${FC:=gfortran}"
rm -rf "$tmp"
mkdir -p "$tmp" || exit 2
topic=airfoils log=$tmp/log
. "$(dirname "$0")/../count.sh"
refuses() { # refuses NAME TEXT ARGUMENTS...
    name=$1 text=$2; shift 2
    if "$harmorph" "$@" >"$tmp/message" 2>&1; then echo "accepted" >>"$tmp/message"; fi
    check "$name" grep -F -e "$text" "$tmp/message"
}
value() { sed -n "s/.*\"$1\": \([^,}]*\).*/\1/p" "$tmp/json"; }
at_most() { awk -v a="$1" -v b="$2" 'BEGIN { print a; exit !(a != "" && a + 0 <= b + 0) }'; }

# ---- To another airfoil ---------------------------------------------------------------------------------------------

naca=$meshes/naca0012.su2
check "fit" "$harmorph" fit "$naca" --marker airfoil -o "$tmp/airfoil.curve"
check "solve" "$harmorph" solve "$naca" --curve airfoil="$tmp/airfoil.curve" -o "$tmp/airfoil.basis"

# NACA 2412 with a closed trailing edge (I. H. Abbott, A. E. von Doenhoff, Theory of Wing Sections), as files are
# published: 61 points on each side, their distance cosine-spaced.
naca2412() { # naca2412 ORDER (selig, backwards, open, lednicer) SCALE DEGREES DX DY
    awk -v order="$1" -v scale="$2" -v degrees="$3" -v dx="$4" -v dy="$5" 'BEGIN {
        m = .02; p = .4; t = .12; n = 60; pi = atan2(0, -1); turn = degrees * pi / 180
        for (side = 1; side >= -1; side -= 2) for (k = 0; k <= n; k++) {
            x = .5 * (1 - cos(pi * k / n))
            half = 5 * t * (.2969 * sqrt(x) - .126 * x - .3516 * x ^ 2 + .2843 * x ^ 3 - .1036 * x ^ 4)
            if (k == n) half = 0
            front = x < p
            q = front ? p : 1 - p
            y = m / q ^ 2 * (front ? 2 * p * x - x ^ 2 : 1 - 2 * p + 2 * p * x - x ^ 2)
            angle = atan2(2 * m / q ^ 2 * (p - x), 1)
            px = x - side * half * sin(angle); py = y + side * half * cos(angle)
            X = scale * (px * cos(turn) - py * sin(turn)) + dx
            Y = scale * (px * sin(turn) + py * cos(turn)) + dy
            at[side, k] = sprintf("%.7f %.7f", X, Y)
        }
        print "NACA 2412"
        if (order == "lednicer") {
            print n + 1 ". " n + 1 ".\n"
            for (k = 0; k <= n; k++) print at[1, k]
            print ""
            for (k = 0; k <= n; k++) print at[-1, k]
        } else {
            s = order == "backwards" ? -1 : 1
            for (k = n; k >= 0; k--) print at[s, k]
            for (k = 1; k <= n - (order == "open"); k++) print at[-s, k]
        }
    }'
}
# The wall of the morphed mesh against the formula: each of its points is nearest to some point of the airfoil.
distance_from_2412() {
    awk '/^NPOIN/ { inside = 1; n = 0; next } /^MARKER_TAG/ { wall = /airfoil/ } /^[A-Z]/ { inside = 0; next }
        inside { x[n] = $1; y[n++] = $2; next } wall && $1 == 3 { on[$2] = 1 }
        function formula(x, side,    half, yc, front, q, angle) {
            half = .6 * (.2969 * sqrt(x) - .126 * x - .3516 * x ^ 2 + .2843 * x ^ 3 - .1036 * x ^ 4)
            front = x < .4; q = front ? .4 : .6
            yc = .02 / q ^ 2 * (front ? .8 * x - x ^ 2 : .2 + .8 * x - x ^ 2)
            angle = atan2(.04 / q ^ 2 * (.4 - x), 1)
            fx = x - side * half * sin(angle); fy = yc + side * half * cos(angle)
        }
        END {
            for (side = -1; side <= 1; side += 2) for (k = 0; k <= 4000; k++) {
                formula(.5 * (1 - cos(k * 3.141592653589793 / 4000)), side)
                sx[m] = fx; sy[m++] = fy
            }
            for (k in on) {
                least = 9
                for (i = 0; i < m; i++) { d = (x[k] - sx[i]) ^ 2 + (y[k] - sy[i]) ^ 2; if (d < least) least = d }
                if (least > worst) worst = least
                ++points
            }
            print points, sqrt(worst)
            exit !(points > 100 && sqrt(worst) < 2.5e-4)
        }' "$1"
}
for order in selig backwards open lednicer; do
    naca2412 $order 1 0 0 0 >"$tmp/$order.dat"
    check "to NACA 2412, $order" "$harmorph" morph "$naca" "$tmp/airfoil.basis" --to-airfoil "$tmp/$order.dat" \
        -o "$tmp/$order.su2" --moves-out "$tmp/$order.moves" --json
    cp "$tmp/log" "$tmp/json"
    check "to NACA 2412, $order: its points are near the curve" at_most "$(value airfoil_max_error)" 5e-5
    check "to NACA 2412, $order: the wall is near the section" at_most "$(value airfoil_wall_error)" 3e-4
    check "to NACA 2412, $order: on average" at_most "$(value airfoil_rms_error)" 1.5e-5
    check "to NACA 2412, $order: the wall is where the formula says" distance_from_2412 "$tmp/$order.su2"
    check "to NACA 2412, $order: the moves make the same mesh" "$harmorph" morph "$naca" "$tmp/airfoil.basis" \
        --move "$tmp/$order.moves" -o "$tmp/by-moves.su2"
    check "to NACA 2412, $order: bit for bit" cmp "$tmp/by-moves.su2" "$tmp/$order.su2"
done
# A curve that is off the wall of the mesh moves the wall by as much beside the section: the distance of the wall says
# so, that of the curve does not.
for part in .9 .93; do
    awk -v part=$part '/^points/ { n = $2; print; next }
        n > 0 { printf "%s %.17g\n", $1, part * $2; n--; next } { print }' \
        "$tmp/airfoil.curve" >"$tmp/thin.curve"
    check "a curve off the wall, $part: solve" "$harmorph" solve "$naca" --curve airfoil="$tmp/thin.curve" \
        -o "$tmp/thin.basis"
    check "a curve off the wall, $part" "$harmorph" morph "$naca" "$tmp/thin.basis" --to-airfoil "$tmp/selig.dat" --json
    cp "$tmp/log" "$tmp/json"
    check "a curve off the wall, $part: the curve is near" at_most "$(value airfoil_max_error)" 1e-4
    check "a curve off the wall, $part: the wall is not" at_most .003 "$(value airfoil_wall_error)"
    check "a curve off the wall, $part: by what the curve was off" at_most "$(value airfoil_wall_error)" \
        "$(echo $part | awk '{ print .0601 * (1 - $1) + 3e-4 }')"
done
# Another chord and place, with and without bringing the edges to where those of the mesh are. The point of NACA 2412
# that is farthest from the trailing edge is not quite at the beginning of the camber line,
# so the result is turned a little.
naca2412 selig 2.5 20 3 -1 >"$tmp/placed.dat"
check "another chord, turned and moved" "$harmorph" morph "$naca" "$tmp/airfoil.basis" --to-airfoil "$tmp/placed.dat" \
    --on-chord -o "$tmp/placed.su2"
edges_meet() {
    awk '/^NPOIN/ { inside = 1; n = 0; next } /^[A-Z]/ { inside = 0 }
        inside && n++ < 132 {
            d = ($1 - 1) ^ 2 + $2 ^ 2
            if (d > far) { far = d; x = $1; y = $2 }
        }
        END { print x, y; exit !(x ^ 2 + y ^ 2 < 1e-6) }' "$1"
}
check "another chord, turned and moved: the edges are where they were" edges_meet "$tmp/placed.su2"
# In per cent of the chord, and in a unit that is a thirtieth of the mesh's.
for scale in 100 30; do
    naca2412 selig $scale 0 0 0 >"$tmp/unit.dat"
    for way in "" --safe; do
        refuses "a file in another unit, $scale $way" "times as long as that of the mesh: --on-chord" morph "$naca" \
            "$tmp/airfoil.basis" --to-airfoil "$tmp/unit.dat" $way -o "$tmp/x.su2"
    done
    check "a file in another unit, $scale: no safe morph is offered" sh -c '! grep "safe goes" "$1"' sh "$tmp/message"
    check "a file in another unit, $scale: --on-chord" "$harmorph" morph "$naca" "$tmp/airfoil.basis" \
        --to-airfoil "$tmp/unit.dat" --on-chord
done
naca2412 selig 1 5 .1 -.05 >"$tmp/turned.dat"
check "turned and moved" "$harmorph" morph "$naca" "$tmp/airfoil.basis" --to-airfoil "$tmp/turned.dat" --json
cp "$tmp/log" "$tmp/json"
check "turned and moved: its points are near the curve" at_most "$(value airfoil_max_error)" 5e-5

# A section that is the mesh's own curve with moved control points: it is met, and the moves come back but for a slide
# of control points along the curve that leaves its shape.
printf '3 .01 .02\n7 0 -.01\n12 .002 .004\n16 -.01 .03\n' >"$tmp/known.moves"
check "known moves" "$harmorph" morph "$naca" "$tmp/airfoil.basis" --move "$tmp/known.moves" \
    --curve-out "$tmp/known.dat"
check "known moves: back" "$harmorph" morph "$naca" "$tmp/airfoil.basis" --to-airfoil "$tmp/known.dat" \
    --moves-out "$tmp/back.moves" --json
cp "$tmp/log" "$tmp/json"
check "known moves: the curve is met" at_most "$(value airfoil_max_error)" 4e-6
moves_agree() {
    awk '/^#/ { next } FILENAME ~ /known/ { x[$1] = $2; y[$1] = $3; next }
        { d = sqrt(($2 - x[$1]) ^ 2 + ($3 - y[$1]) ^ 2); if (d > worst) worst = d }
        END { print worst; exit !(NR > 20 && worst < 1e-2) }' "$1" "$2"
}
check "known moves: control points" moves_agree "$tmp/known.moves" "$tmp/back.moves"

# Periodic curves, and blunt trailing edges.
check "periodic: fit" "$harmorph" fit "$naca" --marker airfoil --closed periodic --points 24 -o "$tmp/round.curve"
check "periodic: solve" "$harmorph" solve "$naca" --curve airfoil="$tmp/round.curve" -o "$tmp/round.basis"
check "periodic: to NACA 2412" "$harmorph" morph "$naca" "$tmp/round.basis" --to-airfoil "$tmp/selig.dat" --safe --json
cp "$tmp/log" "$tmp/json"
check "periodic: near the curve but for the corner" at_most "$(value airfoil_rms_error)" 1e-3
awk 'NR == 1 { print; next } { print $1, $2 + (NR <= 62 ? 1 : -1) * .003 * $1 }' "$tmp/selig.dat" >"$tmp/blunt.dat"
check "a blunt section for a sharp edge" "$harmorph" morph "$naca" "$tmp/airfoil.basis" --to-airfoil "$tmp/blunt.dat"
cp "$tmp/log" "$tmp/message"
check "a blunt section for a sharp edge: warns" grep 'blunt base, 0.006 wide, becomes one point' "$tmp/message"

refuses "no airfoil" "No such file" morph "$naca" "$tmp/airfoil.basis" --to-airfoil "$tmp/none.dat"
printf 'name\n1 0\n0.5 abc\n' >"$tmp/bad.dat"
refuses "a bad number" "bad.dat:3" morph "$naca" "$tmp/airfoil.basis" --to-airfoil "$tmp/bad.dat"
refuses "two goals" "name one of them" morph "$naca" "$tmp/airfoil.basis" --to-airfoil "$tmp/selig.dat" \
    --move "$tmp/known.moves"
refuses "on what chord" "--on-chord needs --to-airfoil" morph "$naca" "$tmp/airfoil.basis" \
    --move "$tmp/known.moves" --on-chord
refuses "a curve that is not there" "--airfoil-curve" morph "$naca" "$tmp/airfoil.basis" --to-airfoil "$tmp/selig.dat" \
    --airfoil-curve 2

# ---- Rational curves ------------------------------------------------------------------------------------------------

# A circle as a rational B-spline of degree 2 (The NURBS Book, example 7.2) and a mesh round it. Control points are
# scaled to an ellipse of half axes 1.2 and .8: so is the circle, and all that leaves the program must be on the
# ellipse.
awk 'BEGIN {
    n = 48; m = 12; pi = atan2(0, -1)
    print "NDIME= 2\nNELEM= " n * m
    for (j = 0; j < m; j++) for (i = 0; i < n; i++) {
        a = j * n + i; b = j * n + (i + 1) % n
        print 9, a, a + n, b + n, b
    }
    print "NPOIN= " n * (m + 1)
    for (j = 0; j <= m; j++) for (i = 0; i < n; i++) {
        radius = 4 ^ (j / m); angle = 2 * pi * i / n
        printf "%.17g %.17g\n", radius * cos(angle), radius * sin(angle)
    }
    print "NMARK= 2\nMARKER_TAG= body\nMARKER_ELEMS= " n; for (i = 0; i < n; i++) print 3, i, (i + 1) % n
    print "MARKER_TAG= far\nMARKER_ELEMS= " n; for (i = 0; i < n; i++) print 3, m * n + i, m * n + (i + 1) % n
}' >"$tmp/ring.su2"
awk 'BEGIN { print "degree 2\nclosed tied\npoints 8\n1 0\n1 1\n0 1\n-1 1\n-1 0\n-1 -1\n0 -1\n1 -1\nweights 8"
    for (i = 0; i < 8; i++) printf "%.17g\n", i % 2 ? sqrt(.5) : 1
    print "knots 12\n0 0 0 1 1 2 2 3 3 4 4 4" }' >"$tmp/circle.curve"
awk 'BEGIN { split("1 1 0 -1 -1 -1 0 1", x); split("0 1 1 1 0 -1 -1 -1", y);
    for (i = 1; i <= 8; i++) print i, .2 * x[i], -.2 * y[i] }' >"$tmp/ellipse.moves"
check "rational: solve" "$harmorph" solve "$tmp/ring.su2" --curve body="$tmp/circle.curve" -o "$tmp/circle.basis"
for ending in curve igs step nml; do
    check "rational: morph, $ending" "$harmorph" morph "$tmp/ring.su2" "$tmp/circle.basis" --move "$tmp/ellipse.moves" \
        -o "$tmp/ellipse.su2" --curve-out "$tmp/ellipse.$ending"
done
on_ellipse() {
    awk '/^NPOIN/ { inside = 1; next } /^[A-Z]/ { inside = 0 }
        inside && n++ < 48 {
            d = ($1 / 1.2) ^ 2 + ($2 / .8) ^ 2 - 1
            if (d < 0) d = -d
            if (d > worst) worst = d
        }
        END { print n, worst; exit !(n > 48 && worst < 1e-14) }' "$1"
}
check "rational: the wall is on the ellipse" on_ellipse "$tmp/ellipse.su2"
# Evaluates the curves that an independent reader found by de Boor's algorithm in homogeneous coordinates.
curve_is_ellipse() {
    awk 'BEGIN { n = nt = 0 }
        $1 == "degree" { p = $2 } $1 == "knot" { t[nt++] = $2 }
        $1 == "x" { x[n] = $2 } $1 == "y" { y[n] = $2 }
        $1 == "weight" { w[n] = $2; ++n; rational += $2 < .9 }
        END {
            for (s = 0; s <= 200; s++) {
                u = t[p] + (t[n] - t[p]) * s / 200
                for (k = p; k < n - 1 && u >= t[k + 1]; k++) { }
                for (j = 0; j <= p; j++) { i = k - p + j; X[j] = x[i] * w[i]; Y[j] = y[i] * w[i]; W[j] = w[i] }
                for (r = 1; r <= p; r++) for (j = p; j >= r; j--) {
                    i = k - p + j; a = (u - t[i]) / (t[i + p - r + 1] - t[i])
                    X[j] = (1 - a) * X[j - 1] + a * X[j]
                    Y[j] = (1 - a) * Y[j - 1] + a * Y[j]
                    W[j] = (1 - a) * W[j - 1] + a * W[j]
                }
                d = (X[p] / W[p] / 1.2) ^ 2 + (Y[p] / W[p] / .8) ^ 2 - 1; if (d < 0) d = -d
                if (d > worst) worst = d
            }
            print n, nt, rational, worst
            exit !(n == 9 && nt == 12 && rational == 4 && worst < 1e-13)
        }' "$1"
}
for ending in curve igs step; do
    awk -f "$here/read_curves.awk" "$tmp/ellipse.$ending" >"$tmp/$ending.numbers"
    check "rational: $ending: re-read by another reader, it is the ellipse" curve_is_ellipse "$tmp/$ending.numbers"
    check "rational: $ending: the same numbers" cmp "$tmp/$ending.numbers" "$tmp/curve.numbers"
done
echo '# nothing moves' >"$tmp/no.moves"
# OpenCASCADE opens the files: points of its curves are those of the B-spline, evaluated by its definition.
python=python3
if [ -x /usr/bin/python3 ]; then python=/usr/bin/python3; fi
if $python -c 'import gmsh; gmsh.initialize(); gmsh.model.occ' >/dev/null 2>&1; then
    for ending in curve igs step; do
        for degree in 1 2 3 4 5; do for closed in periodic tied; do
            check "CAD kernel: fit, $ending" "$harmorph" fit "$meshes/naca0012.su2" --marker airfoil --degree $degree \
                --closed $closed -o "$tmp/cad_$degree$closed.$ending"
        done; done
        check "CAD kernel: fit, open, $ending" "$harmorph" fit "$meshes/two_bodies.su2" --marker left --points 12 \
            -o "$tmp/cad_left.$ending"
        check "CAD kernel: solve" "$harmorph" solve "$meshes/two_bodies.su2" \
            --curve left="$meshes/two_bodies_left.curve" --curve right="$meshes/two_bodies_right.curve" \
            -o "$tmp/cad.basis"
        check "CAD kernel: two curves, $ending" "$harmorph" morph "$meshes/two_bodies.su2" "$tmp/cad.basis" \
            --move "$tmp/no.moves" --curve-out "$tmp/cad_two.$ending"
    done
    for name in ellipse cad_left cad_two cad_1periodic cad_1tied cad_2periodic cad_2tied cad_3periodic cad_3tied \
        cad_4periodic cad_4tied cad_5periodic cad_5tied; do
        for ending in igs step; do
            check "CAD kernel: $name.$ending" $python "$here/cad_kernel.py" "$tmp/$name.curve" "$tmp/$name.$ending"
        done
    done
else
    skip "IGES and STEP files opened by OpenCASCADE" "python3-gmsh is not installed"
fi
if $FC --version >/dev/null 2>&1; then
    check "namelist: the reader is compiled" $FC -J "$tmp" -o "$tmp/read_namelist" "$here/read_namelist.f90"
    check "namelist: a Fortran program reads it" sh -c "'$tmp/read_namelist' <'$tmp/ellipse.nml' >'$tmp/nml.numbers'"
    check "namelist: it is the ellipse" curve_is_ellipse "$tmp/nml.numbers"
    # Two curves, one of them a base, of many control points.
    check "namelist: two bodies" sh -c \
        "'$harmorph' solve '$meshes/two_bodies.su2' --curve left='$meshes/two_bodies_left.curve' \
        --curve right='$meshes/two_bodies_right.curve' -o '$tmp/two.basis' &&
        printf '1 .1 0\n15 0 .1\n' >'$tmp/two.moves' &&
        for ending in nml curve; do
            '$harmorph' morph '$meshes/two_bodies.su2' '$tmp/two.basis' --move '$tmp/two.moves' \
                --curve-out '$tmp/two'.\$ending || exit 1
        done"
    "$tmp/read_namelist" <"$tmp/two.nml" >"$tmp/two.numbers" 2>"$tmp/log"
    awk -f "$here/read_curves.awk" "$tmp/two.curve" >"$tmp/two.wanted"
    check "namelist: two bodies: the same numbers" awk '
        FILENAME ~ /wanted/ { name[FNR] = $1; value[FNR] = $2; n = FNR; next }
        { d = $2 - value[FNR]; bad += $1 != name[FNR] || d > 1e-15 || d < -1e-15; ++m }
        END { print n, m, bad; exit !(n == m && n > 60 && !bad) }' \
        "$tmp/two.wanted" "$tmp/two.numbers"
else
    skip namelists "there is no Fortran compiler"
fi
finish
