# Points that slide along their marker: `--slip`.

runs "--slip" 0 solve "$box" $on_block --slip low,high --slip in:let -o "$tmp/slip.basis"
runs "export of a function with slip" 0 export "$box" "$tmp/slip.basis" --function 4 --number 4 --csv "$tmp/f.csv" \
    --svg "$tmp/f.svg"
check "export of a function with slip: columns" test "$(head -1 "$tmp/f.csv")" = point,x,y,xx,xy,yx,yy
runs "--slip: morph" 0 morph "$box" "$tmp/slip.basis" --move "$tmp/turn40.txt" -o "$tmp/slip.su2"
check "--slip: points below slide on their line" near $(place 5 0 "$tmp/slip.su2") '*' 0
check "--slip: and do slide" sh -c "! echo $(place 5 0 "$tmp/slip.su2") | grep -q '^5 '"
check "--slip: at the left, too" near $(place 0 7 "$tmp/slip.su2") 0 '*'
check "--slip: corners stay" near $(place 0 0 "$tmp/slip.su2") 0 0
check "--slip: what is fixed stays" near $(place 12 7 "$tmp/slip.su2") 12 7
refuses "--slip on a marker with a curve" 2 'two conditions' solve "$box" $on_block --slip block -o "$tmp/x"
refuses "--slip on an unknown marker" 2 "'high'" solve "$box" $on_block --slip top -o "$tmp/x"
runs "--slip on a bent line: a curve" 0 solve "$tmp/bent.su2" $on_block --slip low -o "$tmp/bent.basis"
runs "--slip on a bent line: morph" 0 morph "$tmp/bent.su2" "$tmp/bent.basis" --move "$tmp/turn40.txt" \
    -o "$tmp/bent-moved.su2"
below() { awk '/^NPOIN/ { points = 1; next } /^[A-Z]/ { points = 0 } points && $2 < .02 && $1 > 4 && $1 < 6 {
    print $2 }' "$1"; }
check "--slip on a bent line: points stay near it" \
    sh -c "echo '$(below "$tmp/bent-moved.su2")' |
        awk '\$1 > 1e-9 || \$1 < -.0101 { bad = 1 } END { exit bad || NR < 2 }'"

# A circle of radius 4 in quarters, rational, and a ring whose sides of 30 degrees are far off the circle between
# points.
awk 'BEGIN {
    print "degree 2\nclosed tied\npoints 8"
    for (i = 0; i < 8; i++) { t = i * atan2(0, -1) / 4; r = i % 2 ? 4 * sqrt(2) : 4;
    printf "%.17g %.17g\n", r * cos(t), r * sin(t) }
    print "weights 8"
    for (i = 0; i < 8; i++) printf "%.17g\n", i % 2 ? sqrt(.5) : 1
    print "knots 12\n0 0 0 1 1 2 2 3 3 4 4 4"
}' >"$tmp/circle.curve"
make_ring 12 6 >"$tmp/coarse.su2"
make_ring 24 12 >"$tmp/less-coarse.su2"
echo 'rigid body 0 0 40' >"$tmp/body40.txt"
off_circle() { # of the outer points: the largest distance from the circle
    awk '/^NPOIN/ { points = 1; next } /^[A-Z]/ { points = 0 }
        points { r = sqrt($1 * $1 + $2 * $2) - 4; r = r < 0 ? -r : r; if (r < .2 && r > most) most = r }
        END { print most + 0 }' "$1"
}
is_on_circle() { off_circle "$1" | awk '{ exit !($1 < 1e-10) }'; }
for points in 12 fine; do
    if [ $points = fine ]; then
        runs "--slip along a curve: transfer" 0 transfer "$tmp/coarse.su2" "$tmp/circle.basis" "$tmp/less-coarse.su2" \
            -o "$tmp/finer.basis"
        cp "$tmp/less-coarse.su2" "$tmp/coarse.su2"
        cp "$tmp/finer.basis" "$tmp/circle.basis"
    else
        runs "--slip along a curve" 0 solve "$tmp/coarse.su2" --rigid body=0,0 --slip far="$tmp/circle.curve" \
            -o "$tmp/circle.basis"
        mv "$tmp/circle.curve" "$tmp/circle.curve.kept" # BASIS keeps it
    fi
    for way in "" --safe --improve; do
        runs "--slip along a curve: morph $points $way" 0 morph "$tmp/coarse.su2" "$tmp/circle.basis" \
            --move "$tmp/body40.txt" $way -o "$tmp/on-circle.su2"
        check "--slip along a curve: points are on the circle: $points $way" is_on_circle "$tmp/on-circle.su2"
        check "--slip along a curve: and have moved: $points $way" \
            sh -c "! tail -n 200 '$tmp/on-circle.su2' | grep -q '^4 0'"
    done
done
mv "$tmp/circle.curve.kept" "$tmp/circle.curve"
make_ring 12 6 >"$tmp/coarse.su2"
runs "--slip along the curve through the points" 0 solve "$tmp/coarse.su2" --rigid body=0,0 --slip far \
    -o "$tmp/through.basis"
runs "--slip along the curve through the points: morph" 0 morph "$tmp/coarse.su2" "$tmp/through.basis" \
    --move "$tmp/body40.txt" -o "$tmp/on-circle.su2"
check "--slip along the curve through the points: is another curve" sh -c "! $(off_circle "$tmp/on-circle.su2" |
    awk '{ print $1 < 1e-8 ? "true" : "false" }')"
refuses "--slip along a curve: another one's" 2 "away from the curve along which it slips" \
    solve "$tmp/coarse.su2" --rigid body=0,0 --slip far="$curve" -o "$tmp/x"
refuses "--slip along a curve: no file" 3 'none.curve' solve "$tmp/coarse.su2" --rigid body=0,0 \
    --slip far="$tmp/none.curve" -o "$tmp/x"
awk '/^NPOIN/ { points = 1; next } /^[A-Z]/ { points = 0 } points && k < 12 {
    print k++, -.2 * $1 - .6 * $2, .6 * $1 - .2 * $2 }' \
    "$tmp/coarse.su2" >"$tmp/turned-wall.txt"
runs "--slip along a curve: displace" 0 displace "$tmp/coarse.su2" --given body --slip far="$tmp/circle.curve" \
    --wall "$tmp/turned-wall.txt" -o "$tmp/on-circle.su2"
check "--slip along a curve: displace: points are on the circle" is_on_circle "$tmp/on-circle.su2"
runs "--slip along a curve: the basis again" 0 solve "$tmp/coarse.su2" --rigid body=0,0 --slip far="$tmp/circle.curve" \
    -o "$tmp/circle.basis"
for lines in 1 5 30; do
    LC_ALL=C sed '$d' "$tmp/circle.basis" | LC_ALL=C awk -v n=$lines '{ line[NR] = $0 }
        END { for (k = 1; k <= NR - n; k++) print line[k] }' >"$tmp/cut.basis"
    refuses "--slip along a curve: cut off by $lines" 3 'cut' morph "$tmp/coarse.su2" "$tmp/cut.basis" \
        --move "$tmp/body40.txt"
done
