# Measures and design variables, of the demo's curve; functions by table.

airfoil=$tmp/demo/airfoil.curve mesh=$tmp/demo/mesh.su2
[ -e "$airfoil" ] || makes demo "$tmp/demo" --mesh "$meshes/naca0012.su2"
close_to() { awk -v a="$1" -v b="$2" -v e="$3" 'BEGIN { d = a - b; exit !(d < e && d > -e) }'; }
runs "measures" 0 curve "$airfoil" --stations 0.3 --box 0.3,0 --json
check "measures: the area of a NACA 0012" close_to "$(number area)" 0.0817 1e-4
check "measures: its thickness" close_to "$(number max_thickness)" 0.12 1e-4
check "measures: its thickness at its largest" close_to "$(number thickness_0.3)" 0.12 1e-4
check "measures: the clearance of a point on the chord" close_to "$(number clearance)" 0.06 1e-3
area=$(number area)
runs "halved and elevated" 0 curve "$airfoil" --elevate --halve --insert 0.111 -o "$tmp/finer.curve" --json
check "halved and elevated: more points" test "$(number points)" -gt 40
runs "halved and elevated: measured" 0 curve "$tmp/finer.curve" --json
check "halved and elevated: the same area" close_to "$(number area)" "$area" 1e-14
runs "functions of the finer curve" 0 solve "$mesh" --curve airfoil="$tmp/finer.curve" \
    -o "$tmp/finer.basis"
refuses "a knot outside" 2 'not inside' curve "$airfoil" --insert 7
refuses "no number" 2 'expects numbers' curve "$airfoil" --insert x
refuses "three numbers for a chord" 2 'four numbers' curve "$airfoil" --chord 0,0,1
refuses "a station outside" 2 'a station must lie between 0 and 1' curve "$airfoil" --stations 1.5
refuses "two stations of one name" 2 'two stations have the name 0.1234' curve "$airfoil" --stations 0.12341,0.12344
refuses "a station outside: no curve file" 2 'a station must lie between 0 and 1' curve "$airfoil" --stations 0 \
    -o "$tmp/x"
for kind in "--cst 6,6" "--ffd 3,1" "--hicks-henne 2,2" "--naca 0.4"; do
    runs "variables $kind" 0 variables "$airfoil" $kind -o "$tmp/map" --json
    check "variables $kind: errors" test "$(grep -o rms_error "$tmp/out" | wc -l)" -ge 2
    echo '2 0.01' >"$tmp/values"
    runs "morph by $kind" 0 morph "$mesh" "$tmp/demo/airfoil.basis" --variables "$tmp/map" \
        --move "$tmp/values" -o "$tmp/by.su2" --json
    check "morph by $kind: on the B-spline" close_to "$(number boundary_error)" 0 1e-15
done
runs "thicker by NACA's mode" 0 curve "$tmp/by.su2.curve" --json
check "thicker by NACA's mode: by 1 %" close_to "$(number max_thickness)" 0.13 1e-4
refuses "two kinds of variables" 2 'one of --ffd' variables "$airfoil" --cst 6,6 --ffd 1,1
refuses "a box beside the airfoil" 2 'moves no control point' variables "$airfoil" --ffd 1,1 --box 5,5,6,6
refuses "variables of another curve" 3 'control points' morph "$mesh" "$tmp/finer.basis" \
    --variables "$tmp/map" --move "$tmp/values"
makes fit "$mesh" --marker airfoil --degree 4 -o "$tmp/smoother.curve"
makes variables "$tmp/smoother.curve" --cst 6,6 -o "$tmp/other.map"
refuses "variables of a curve with other knots" 3 'for a curve with other knots' morph "$mesh" \
    "$tmp/demo/airfoil.basis" --variables "$tmp/other.map" --move "$tmp/values" -o "$tmp/x"
echo '7 1' >"$tmp/values"
refuses "a variable that is none" 3 'between 1 and 2' morph "$mesh" "$tmp/demo/airfoil.basis" \
    --variables "$tmp/map" --move "$tmp/values"

# Functions by table: a mode moves the mesh as the same displacement does.
awk '/^MARKER_TAG/ { on = $0 ~ /airfoil/ } on && $1 == 3 { seen[$2]; seen[$3] } END { for (p in seen) print p, 0, 1 }' \
    "$mesh" >"$tmp/plunge"
awk '{ print $1, 1, 0.5 }' "$tmp/plunge" | sort >"$tmp/surge"
sed 's/ 0 1$/ 0.004 0.022/' "$tmp/plunge" >"$tmp/field"
runs "functions by table" 0 solve "$mesh" --given airfoil --mode "$tmp/plunge" --mode "$tmp/surge" \
    -o "$tmp/modes.basis"
printf 'mode 1 0.02\nmode 2 0.004\n' >"$tmp/values"
runs "moved by modes" 0 morph "$mesh" "$tmp/modes.basis" --move "$tmp/values" -o "$tmp/by-modes.su2"
runs "displaced" 0 displace "$mesh" --given airfoil --wall "$tmp/field" -o "$tmp/displaced.su2"
same_points() { paste -d ' ' "$1" "$2" | awk 'NF % 2 == 0 { for (i = 1; i <= NF / 2; i++) { d = $i - $(i + NF / 2)
    if (d > 1e-12 || d < -1e-12) bad = 1 } ++n } END { exit bad || n < 1000 }'; }
check "moved by modes: as displaced" same_points "$tmp/by-modes.su2" "$tmp/displaced.su2"
runs "the movement that is reached" 0 morph "$mesh" "$tmp/modes.basis" --move "$tmp/values" --safe \
    -o "$tmp/by-modes.su2" --reached "$tmp/reached"
check "the movement that is reached: modes" awk '
    $1 == "mode" { sum += $2 * $3 } END { exit !(sum == .028) }' "$tmp/reached"
refuses "a mode of a basis without modes" 2 'the basis has no modes' morph "$mesh" "$tmp/demo/airfoil.basis" \
    --by 'mode 1 3' -o "$tmp/x"
refuses "modes without --given" 2 '--given' solve "$mesh" --mode "$tmp/plunge" -o "$tmp/x"
sed 1d "$tmp/plunge" >"$tmp/fewer"
refuses "a mode of fewer points" 3 'does not have the points' solve "$mesh" --given airfoil \
    --mode "$tmp/plunge" --mode "$tmp/fewer" -o "$tmp/x"
sed 's/ 0 1$/ 0 0/' "$tmp/plunge" >"$tmp/zero"
refuses "a mode that is zero" 2 'mode 0 is zero' solve "$mesh" --given airfoil \
    --mode "$tmp/zero" -o "$tmp/x"
echo 'mode 3 1' >"$tmp/values"
refuses "a mode that is none" 3 'between 1 and 2' morph "$mesh" "$tmp/modes.basis" --move "$tmp/values"

# Further wishes for a fit.
runs "fit to a tolerance" 0 fit "$mesh" --marker airfoil --tolerance 1e-4 -o "$tmp/near.curve" --json
check "fit to a tolerance: reached" awk -v e="$(number max_error)" 'BEGIN { exit !(e > 0 && e <= 1e-4) }'
few=$(number points)
runs "fit to a smaller tolerance" 0 fit "$mesh" --marker airfoil --tolerance 1e-5 -o "$tmp/near.curve" --json
check "fit to a smaller tolerance: more points" test "$(number points)" -gt "$few"
refuses "fit: a tolerance that is not reached" 1 'do not reach the tolerance' fit "$mesh" --marker airfoil \
    --tolerance 1e-9 --points 8 -o "$tmp/x"
printf '10 100 # heavy\n11 0\n' >"$tmp/weights"
runs "fit: weights, smooth, tangents" 0 fit "$mesh" --marker airfoil --weights "$tmp/weights" --smooth 0.001 \
    --begin=-1,0.1 --end 1,0.1 -o "$tmp/wished.curve" --json
printf '10 100\n10 50\n' >"$tmp/weights"
refuses "fit: a weight twice" 3 'weights:2: point 10 has a weight already' fit "$mesh" --marker airfoil \
    --weights "$tmp/weights" -o "$tmp/x"
echo '10 1e300' >"$tmp/weights"
refuses "fit: a weight that is too large" 3 'weights:1: the file needs a point and a weight between 0 and 1e30' \
    fit "$mesh" --marker airfoil --weights "$tmp/weights" -o "$tmp/x"
echo '99999 1' >"$tmp/weights"
refuses "fit: a weight of no point" 3 'weights:1: the file needs a point of the boundary' fit "$mesh" --marker airfoil \
    --weights "$tmp/weights" -o "$tmp/x"
refuses "fit: a tangent that is none" 2 'expects a direction' fit "$mesh" --marker airfoil --begin 0,0 -o "$tmp/x"
