# Sections that turn, shift, scale and deflect as a whole, in files of moves and as design variables; variables that are
# not linear; modes of a family.

mesh=$tmp/demo/mesh.su2 basis=$tmp/demo/airfoil.basis airfoil=$tmp/demo/airfoil.curve
[ -e "$basis" ] || makes demo "$tmp/demo" --mesh "$meshes/naca0012.su2"
[ -e "$tmp/sens.txt" ] || awk '/^NPOIN/ { inside = 1; next } /^[A-Z]/ { inside = 0 }
    inside { r = 1 + $1 * $1 + $2 * $2; printf "%d %.15g %.15g\n", n, sin(3 * n) / r, cos(5 * n) / r; n++ }' \
    "$mesh" >"$tmp/sens.txt"

# The moved curve: each control point, as the map says.
control_points() { # control_points CURVE: lines x y
    awk 'NF == 2 && $1 ~ /^[-0-9.]/ && $2 ~ /^[-0-9.]/' "$1"
}
printf 'turn airfoil 90 0.25,0\nshift airfoil 0.1 -0.05\nscale airfoil 1.5 0,0\n3 0.001 0.002\n' >"$tmp/turn.moves"
runs "movements: turn, shift, scale" 0 morph "$mesh" "$basis" --move "$tmp/turn.moves" --safe \
    -o "$tmp/turned.su2" --json
check "movements: the wall is on the B-spline" awk -v e="$(number boundary_error)" 'BEGIN { exit !(e < 1e-13) }'
control_points "$airfoil" >"$tmp/before"; control_points "$tmp/turned.su2.curve" >"$tmp/after"
compare() { # compare NAME WORST PROGRAM: PROGRAM computes x, y of `after` from $1, $2 of `before`, and `skip`
    paste -d ' ' "$tmp/before" "$tmp/after" >"$tmp/pairs"
    check "$1" awk -v limit="$2" "{ x = \$1; y = \$2; skip = 0; $3
        d = (x - \$3) ^ 2 + (y - \$4) ^ 2; if (!skip && d > worst) worst = d }
        END { print NR, worst; exit !(NR == 20 && worst < limit ^ 2) }" "$tmp/pairs"
}
compare "movements: the control points of the curve are mapped" 1e-14 'x = 1.5 * (.25 - $2 + .1)
    y = 1.5 * ($1 - .25 - .05); if (NR == 3) { x += .001; y += .002 }'
runs "movements: the same lines as options" 0 morph "$mesh" "$basis" --by 'turn airfoil 90 0.25,0' \
    --by 'shift airfoil 0.1 -0.05' --by 'scale airfoil 1.5 0,0' --by '3 0.001 0.002' --safe -o "$tmp/by.su2"
check "movements: options: the same mesh" cmp "$tmp/turned.su2" "$tmp/by.su2"
runs "movements: about the quarter chord" 0 morph "$mesh" "$basis" --by 'turn airfoil 5' -o "$tmp/quarter.su2"
runs "movements: about the point itself" 0 morph "$mesh" "$basis" --by 'turn airfoil 5 0.25,0' -o "$tmp/point.su2"
control_points "$tmp/quarter.su2.curve" >"$tmp/before"; control_points "$tmp/point.su2.curve" >"$tmp/after"
compare "movements: the quarter chord of the airfoil is at .25" 1e-4 ''
control_points "$airfoil" >"$tmp/before"
runs "movements: a flap" 0 morph "$mesh" "$basis" --by 'flap airfoil 0.7,0 -8 0.1' -o "$tmp/flap.su2"
control_points "$tmp/flap.su2.curve" >"$tmp/after"
compare "movements: a flap: what is ahead stays, what is behind turns" 1e-14 'a = -8 * atan2(0, -1) / 180
    skip = $1 >= .7 && $1 < .801
    if ($1 > .8) { x = .7 + cos(a) * ($1 - .7) - sin(a) * $2; y = sin(a) * ($1 - .7) + cos(a) * $2 }'
awk '/^MARKER_TAG/ { on = /farfield/ } on && $1 == 3 { seen[$2]; seen[$3] } END { for (p in seen) print p, 0, 0 }' \
    "$mesh" >"$tmp/still"
runs "movements: displace" 0 displace "$mesh" --curve airfoil="$airfoil" --given farfield --wall "$tmp/still" \
    --by 'flap airfoil 0.7,0 -8 0.1' -o "$tmp/displaced.su2"
cat >"$tmp/same_wall.awk" <<'AWK'
/^NPOIN/ { inside = 1; n = 0; next }
/^[A-Z]/ { inside = 0 }
inside && FNR == NR && n < 132 { x[n] = $1; y[n++] = $2; next }
inside && n < 132 { d = (x[n] - $1) ^ 2 + (y[n] - $2) ^ 2; n++; if (d > worst) worst = d; compared++ }
END { print worst; exit compared != 132 || worst > 1e-28 }
AWK
check "movements: displace: the wall is that of morph" awk -f "$tmp/same_wall.awk" "$tmp/flap.su2" "$tmp/displaced.su2"

refuses "movements: a marker without a curve" 2 'a marker on a curve' morph "$mesh" "$basis" \
    --by 'turn farfield 3' -o "$tmp/x"
refuses "movements: no number" 2 "--by 'turn airfoil x': the option needs a finite number" morph "$mesh" "$basis" \
    --by 'shift airfoil 0 0' --by 'turn airfoil x' -o "$tmp/x"
refuses "movements: too few words" 2 'flap MARKER X,Y degrees' morph "$mesh" "$basis" --by 'flap airfoil 3' -o "$tmp/x"
refuses "movements: a factor of 0" 2 'a factor above 0' morph "$mesh" "$basis" --by 'scale airfoil 0' -o "$tmp/x"
refuses "movements: too many degrees" 2 'out of range' morph "$mesh" "$basis" --by 'turn airfoil 400' -o "$tmp/x"
refuses "movements: --by and --variables" 2 'exclude each other' morph "$mesh" "$basis" --by 'turn airfoil 4' \
    --variables "$airfoil" --move "$airfoil" -o "$tmp/x"

# As design variables: the same mesh; the gradient agrees with differences of central order.
runs "movements: variables" 0 variables "$airfoil" --flap 0.7,0,0.1 --turn 0.25,0 -o "$tmp/flap.map" --json
check "movements: variables: two values" test "$(grep -o '"start"' "$tmp/out" | wc -l)" -eq 2
printf '1 -8\n' >"$tmp/values"
runs "movements: morph by variables" 0 morph "$mesh" "$basis" --variables "$tmp/flap.map" --move "$tmp/values" \
    -o "$tmp/by-map.su2"
check "movements: morph by variables: the same mesh" cmp "$tmp/flap.su2" "$tmp/by-map.su2"
# dJ of an objective with the derivatives sens.txt by the mesh points, which is linear: J = sens . (x - x0).
objective() { # objective MESH
    awk 'FILENAME == ARGV[1] { if (!/^#/) { a[$1] = $2; b[$1] = $3 } next }
        /^NPOIN/ { inside = 1; n = 0; next } /^[A-Z]/ { inside = 0 }
        inside { sum += a[n] * $1 + b[n] * $2; n++ } END { printf "%.17g\n", sum }' "$tmp/sens.txt" "$1"
}
# At values that are not 0, the adjoint agrees with differences.
gradient() { # gradient NAME STEP VALUES OPTION...
    title=$1 step=$2 n=$3; shift 3
    runs "movements: $title" 0 variables "$airfoil" "$@" -o "$tmp/one.map"
    awk -v n="$n" -v h="$step" 'BEGIN { for (j = 1; j <= n; j++) print j, h * (j % 3 + 1) }' >"$tmp/at"
    runs "movements: $title: adjoint" 0 adjoint "$mesh" "$basis" --sensitivity "$tmp/sens.txt" \
        --variables "$tmp/one.map" --at "$tmp/at" -o "$tmp/by-values"
    for sign in -1 1; do
        awk -v s="$sign" -v h="$step" '$1 == 1 { $2 += s * h * .01 } { print }' "$tmp/at" >"$tmp/beside"
        makes morph "$mesh" "$basis" --variables "$tmp/one.map" --move "$tmp/beside" \
            -o "$tmp/beside$sign.su2" --force
    done
    check "movements: $title: adjoint and differences" awk -v a="$(objective "$tmp/beside-1.su2")" \
        -v b="$(objective "$tmp/beside1.su2")" -v h="$step" '
        $1 == 1 { d = (b - a) / (.02 * h); e = d - $2; print d, $2; if (e < 0) e = -e
            if (d < 0) d = -d; ok = e < 2e-4 * d + 1e-6 } END { exit !ok }' "$tmp/by-values"
}
# Without --at, the derivatives are those of the next morph of a mesh that has moved.
makes variables "$airfoil" --turn 0.3,0.1 --scale 0,0 -o "$tmp/next.map"
makes morph "$mesh" "$basis" --by 'turn airfoil 7' --by '6 0.01 -0.02' -o "$tmp/next.su2"
runs "movements: the next morph: adjoint" 0 adjoint "$tmp/next.su2" "$basis" --sensitivity "$tmp/sens.txt" \
    --variables "$tmp/next.map" -o "$tmp/next.gradient"
for variable in 1 2; do
    for sign in -1 1; do
        echo "$variable ${sign}e-4" >"$tmp/beside"
        makes morph "$tmp/next.su2" "$basis" --variables "$tmp/next.map" --move "$tmp/beside" -o "$tmp/beside$sign.su2"
    done
    check "movements: the next morph: adjoint and differences of $variable" awk -v k="$variable" \
        -v a="$(objective "$tmp/beside-1.su2")" -v b="$(objective "$tmp/beside1.su2")" '
        $1 == k { d = (b - a) / 2e-4; e = d - $2; exit !(e * e < 1e-12 * (1 + d * d)) }' "$tmp/next.gradient"
done
awk '!/^#/ { $2 *= 1e-9 } 1' "$tmp/next.gradient" >"$tmp/values"
runs "movements: the next morph goes along the gradient, as adjoint has written its lines" 0 morph "$tmp/next.su2" \
    "$basis" --variables "$tmp/next.map" --move "$tmp/values" -o "$tmp/along.su2"
echo '1 5' >"$tmp/at"
refuses "movements: values that are not those of the mesh" 2 'do not move the curve to where the mesh is' adjoint \
    "$tmp/next.su2" "$basis" --sensitivity "$tmp/sens.txt" --variables "$tmp/next.map" --at "$tmp/at" -o "$tmp/x"
gradient "flap, scale, turn, shift" 1 5 --flap 0.7,0 --scale 0.5,0 --turn 0.25,0 --shift
gradient "camber and thickness" 0.01 5 --camber-thickness 3,2
gradient "PARSEC" 0.001 11 --parsec
gradient "blade" 1 3 --blade 0.3,0

# Modes of a family: its members are combinations of them.
family=
for thickness in 8 10 15 20; do
    awk -v t="$thickness" '
        function half(x) { return t / 20 * (.2969 * sqrt(x) + x * (-.126 + x * (-.3516 + x * (.2843 - .1036 * x)))) }
        BEGIN { print "NACA"; pi = atan2(0, -1); for (k = 60; k >= -60; k--) { x = (1 - cos(pi * k / 60)) / 2
            printf "%.12f %.12f\n", x, k < 0 ? -half(x) : half(x) } }' >"$tmp/naca$thickness.dat"
    family="$family --family $tmp/naca$thickness.dat"
done
runs "movements: modes of a family" 0 variables "$airfoil" $family -o "$tmp/family.map" --json
share=$(grep -o '"share": [0-9.e-]*' "$tmp/out" | sed 's/.*: //;q')
check "movements: modes of a family: the first one is the thickness" awk -v s="$share" \
    'BEGIN { exit !(s > .95) }'
echo '1 0.005' >"$tmp/values"
runs "movements: morph by a mode" 0 morph "$mesh" "$basis" --variables "$tmp/family.map" --move "$tmp/values" \
    -o "$tmp/mode.su2"
refuses "movements: too many modes" 2 'has only' variables "$airfoil" --family "$tmp/naca8.dat" --modes 2 -o "$tmp/x"
refuses "movements: two kinds" 2 'exclude each other' variables "$airfoil" --parsec --cst 3,3 -o "$tmp/x"
refuses "movements: two shapes" 2 'exclude each other' variables "$airfoil" --parsec --blade 0,0 -o "$tmp/x"
refuses "movements: a place that is none" 2 'expects X,Y' variables "$airfoil" --flap 3 -o "$tmp/x"
refuses "movements: --at without variables" 2 '--at needs --variables' adjoint "$mesh" "$basis" \
    --sensitivity "$tmp/sens.txt" --at "$tmp/values" -o "$tmp/x"
printf 'movements 1\npoints 20\nturn 3\n' >"$tmp/bad.map"
refuses "movements: a map without a centre" 3 'bad.map:3: the file needs 2 numbers after turn' morph "$mesh" "$basis" \
    --variables "$tmp/bad.map" --move "$tmp/values" -o "$tmp/x"
printf 'movements 2\npoints 20\nturn 3 0\n' >"$tmp/bad.map"
refuses "movements: a map that is short" 3 'announces 2 movements' morph "$mesh" "$basis" \
    --variables "$tmp/bad.map" --move "$tmp/values" -o "$tmp/x"
