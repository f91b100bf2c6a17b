# A mesh that was morphed before: the curve is where the wall is, or what needs the curve is refused.

sum_of() { # sum_of FILE...: the points of the first curve file, and the movements "index dx dy" of the others added
    awk 'FNR == 1 { file++ }
        file == 1 && /^points/ { left = $2; next }
        file == 1 && left > 0 { x[++n] = $1; y[n] = $2; left-- }
        file > 1 && $1 + 0 > 0 { x[$1] += $2; y[$1] += $3 }
        END { for (k = 1; k <= n; k++) printf "%.17g %.17g\n", x[k], y[k] }' "$@"
}
same_points() { # same_points A B: lines x y, to 1e-12
    paste "$1" "$2" | awk 'function off(a, b) { return a - b > 1e-12 || b - a > 1e-12 }
        NF != 4 || off($1, $3) || off($2, $4) { exit 1 } END { exit NR < 4 }'
}
printf '1 .04 .03\n4 -.05 .02\n9 0 .06\n' >"$tmp/second.txt"
makes morph "$ring" "$basis" --move "$tmp/small.txt" -o "$tmp/once.su2"
runs "again: a mesh that was morphed" 0 morph "$tmp/once.su2" "$basis" --move "$tmp/second.txt" -o "$tmp/twice.su2" \
    --svg "$tmp/twice.svg" --boundary-svg "$tmp/twice-boundary.svg" --csv "$tmp/twice.csv" \
    --report "$tmp/twice.html" --json
check "again: it says that the mesh has moved" says 'mesh has moved since'
check "again: off the curve by rounding" test "$(number boundary_error | awk '{ print ($1 < 1e-13) }')" = 1
sum_of "$curve" "$tmp/small.txt" "$tmp/second.txt" >"$tmp/wanted"
sum_of "$tmp/twice.su2.curve" >"$tmp/found"
check "again: the curve has both movements" same_points "$tmp/wanted" "$tmp/found"
awk -F, '$1 == "control" { print $7, $8 }' "$tmp/twice.csv" >"$tmp/found"
check "again: so has the table" same_points "$tmp/wanted" "$tmp/found"
sum_of "$curve" "$tmp/small.txt" >"$tmp/wanted"
awk -F, '$1 == "control" { print $5, $6 }' "$tmp/twice.csv" >"$tmp/found"
check "again: and the movement before is where that begins" same_points "$tmp/wanted" "$tmp/found"
# A mesh whose wall has left the circle is moved to the circle: the wall comes back.
awk 'BEGIN { for (k = 0; k <= 60; k++) { t = 8 * atan2(1, 1) * k / 60; print cos(t), sin(t) } }' >"$tmp/circle.dat"
runs "again: --to-airfoil" 0 morph "$tmp/twice.su2" "$basis" --to-airfoil "$tmp/circle.dat" -o "$tmp/back.su2" --json
check "again: --to-airfoil: the wall is on it" awk '
    /^NPOIN/ { left = 48; next }
    left > 0 { r = sqrt($1 * $1 + $2 * $2); left--; seen++; if (r < .998 || r > 1.002) exit 1 }
    END { exit seen != 48 }' "$tmp/back.su2"
refuses "again: transfer" 1 'mesh has moved since' transfer "$tmp/once.su2" "$basis" "$ring" -o "$tmp/x"
runs "again: explore" 0 explore "$tmp/once.su2" "$basis" -o "$tmp/once.html"
runs "again: explore, as it was" 0 explore "$ring" "$basis" -o "$tmp/start.html"
control_of() { sed -n 's/.*"control": "\([^"]*\)".*/\1/p' "$1"; }
check "again: the page has the moved control points" \
    test "$(control_of "$tmp/once.html")" != "$(control_of "$tmp/start.html")"

# One point of the wall is elsewhere.
awk '/^NPOIN/ { left = 5 } { if (left-- == 1) { $1 += .01; $2 += .02 } print }' "$ring" >"$tmp/dented.su2"
for option in --svg --boundary-svg --csv --report --curve-out; do
    refuses "again: on no curve: $option" 1 'the wall is on no curve of this basis' morph "$tmp/dented.su2" "$basis" \
        --move "$tmp/small.txt" $option "$tmp/x"
done
refuses "again: on no curve: --to-airfoil" 1 'the wall is on no curve' morph "$tmp/dented.su2" "$basis" \
    --to-airfoil "$tmp/circle.dat" -o "$tmp/x"
refuses "again: on no curve: explore" 1 'the wall is on no curve' explore "$tmp/dented.su2" "$basis" -o "$tmp/x"
runs "again: on no curve: the mesh alone" 0 morph "$tmp/dented.su2" "$basis" --move "$tmp/small.txt" \
    -o "$tmp/dented-moved.su2"
check "again: on no curve: a warning" says 'are unknown and are not written'
check "again: on no curve: no file of it" test ! -e "$tmp/dented-moved.su2.curve"
