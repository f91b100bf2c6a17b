# Given displacements of wall points: `harmorph displace`, in one step and safely.

# The displacements of the wall that a morph has made, given point by point, make the same mesh: wall points bit by bit.
wall_field() { # wall_field MESH MOVED: lines "point dx dy" of the first 48 points, which are on the wall
    awk 'FNR == 1 { file++ } /NPOIN=/ { n = 48; k = 0; next } n-- > 0 {
        if (file == 1) { x[k] = $1; y[k] = $2 } else printf "%d %.17g %.17g\n", k, $1 - x[k], $2 - y[k]
        k++ }' "$1" "$2"
}
for operator in conformal laplace weighted; do
    runs "displace: $operator: functions" 0 solve "$ring" --curve "body=$curve" --operator $operator -o "$tmp/by.basis"
    runs "displace: $operator: morph" 0 morph "$ring" "$tmp/by.basis" --move "$tmp/small.txt" -o "$tmp/by_curve.su2"
    wall_field "$ring" "$tmp/by_curve.su2" >"$tmp/wall.txt"
    runs "displace: $operator" 0 displace "$ring" --given body --wall "$tmp/wall.txt" --operator $operator \
        -o "$tmp/displaced.su2" --json
    has_keys "displace: $operator: keys" inverted admissible_step self_crossing boundary_error min_quality \
        mean_quality engine factor_seconds displace_seconds
    check "displace: $operator: the mesh of the morph" awk 'NF == 3 && index($0, ".") { getline other <FILE2
        split(other, b); d = $1 - b[1]; e = $2 - b[2]; if (d * d + e * e > 1e-18) wrong++; n++; next }
        { getline other <FILE2 } END { exit wrong > 0 || n < 600 }' FILE2="$tmp/by_curve.su2" "$tmp/displaced.su2"
done
runs "displace: for people" 0 displace "$ring" --given body --wall "$tmp/wall.txt" --repeat 3 --vtu "$tmp/displaced.vtu"
check "displace: says seconds" says 'for the displacement'
check "displace: ParaView's file" grep -q displacement "$tmp/displaced.vtu"
sed '$d' "$tmp/wall.txt" >"$tmp/short.txt"
refuses "displace: a point is missing" 2 'point 47 is on a marker with given displacements, but not in the list' \
    displace "$ring" --given body --wall "$tmp/short.txt" -o "$tmp/x"
{ cat "$tmp/wall.txt"; echo 60 0 0; } >"$tmp/foreign.txt"
refuses "displace: a point of no such marker" 2 'point 60 is in the list, but on no marker with given displacements' \
    displace "$ring" --given body --wall "$tmp/foreign.txt" -o "$tmp/x"
{ cat "$tmp/wall.txt"; echo 3 1 1; } >"$tmp/twice.txt"
refuses "displace: two displacements" 2 'point 3 has two different displacements' \
    displace "$ring" --given body --wall "$tmp/twice.txt" -o "$tmp/x"
echo '3 nan 0' >"$tmp/nan.txt"
refuses "displace: not a number" 3 "$tmp/nan.txt:1: the file needs a finite number here, but 'nan' follows" \
    displace "$ring" --given body --wall "$tmp/nan.txt" -o "$tmp/x"
echo '624 0 0' >"$tmp/nan.txt"
refuses "displace: no such point" 3 'and no point 624' displace "$ring" --given body --wall "$tmp/nan.txt" -o "$tmp/x"
refuses "displace: no marker" 2 '--given is missing' displace "$ring" --wall "$tmp/wall.txt"
refuses "displace: a marker both given and slipping" 2 'two conditions' \
    displace "$ring" --given body --slip body --wall "$tmp/wall.txt"
awk '{ t = 2 * atan2(0, -1) * $1 / 48; print $1, cos(t + 2) - cos(t), sin(t + 2) - sin(t) }' "$tmp/wall.txt" \
    >"$tmp/turn.txt"
refuses "displace: inverted cells" 1 'of this displacement is admissible' \
    displace "$ring" --given body --wall "$tmp/turn.txt" --operator laplace -o "$tmp/x"
leaves_nothing "displace: inverted cells: no file" "$tmp/x"
runs "displace: inverted cells: by force" 1 displace "$ring" --given body --wall "$tmp/turn.txt" --operator laplace \
    -o "$tmp/forced.su2" --force
check "displace: inverted cells: the file by force" test -f "$tmp/forced.su2"
awk '{ $2 = $1 == 0 ? -9 : 0; $3 = 0; print }' "$tmp/wall.txt" >"$tmp/through.txt"
refuses "displace: a wall that crosses itself" 1 'the moved boundary crosses itself' \
    displace "$ring" --given body --wall "$tmp/through.txt" -o "$tmp/x"

# The better one of two operators is taken, and both are reported; better cells without --safe.
for way in "" --safe "--safe --improve --heights"; do
    for operator in laplace conformal auto; do
        runs "displace $way --operator $operator" 0 displace "$ring" --given body --wall "$tmp/wall.txt" $way \
            --operator $operator --json
        eval "$operator=$(grep -o '"min_quality": [^,]*' "$tmp/out" | head -n 1 | sed "s/.*: //")"
    done
    check "displace $way --operator auto: names both" grep -q '"operators": \[{"operator": ".*{"operator": "' "$tmp/out"
    check "displace $way --operator auto: as good as both" \
        awk "BEGIN { exit !($auto >= $laplace && $auto >= $conformal) }"
done
runs "displace --improve" 0 displace "$ring" --given body --wall "$tmp/wall.txt" --operator laplace --json
plain=$(number mean_quality)
runs "displace --improve" 0 displace "$ring" --given body --wall "$tmp/wall.txt" --operator laplace --improve --json
check "displace --improve: better on average" awk "BEGIN { exit !($(number mean_quality) > $plain) }"
runs "displace --operator auto: for people" 0 displace "$ring" --given body --wall "$tmp/wall.txt" --operator auto
check "displace --operator auto: says what both cost" grep -E '^not  *(laplace|conformal): .* seconds$' "$tmp/out"
runs "displace --operator auto: where conformal is refused" 0 displace "$ring" --given body --free far \
    --wall "$tmp/wall.txt" --operator auto
check "displace --operator auto: says why" grep -E '^not  *conformal: ' "$tmp/out"

# Safely, all of the way; beside a rigid body; and what does not go together.
runs "displace --safe" 0 displace "$ring" --given body --wall "$tmp/turn.txt" --operator laplace --safe \
    -o "$tmp/safe.su2" --json
has_keys "displace --safe: keys" inverted self_crossing boundary_error min_quality mean_quality engine \
    factor_seconds displace_seconds step_fraction steps resolves strategy last_step_admissible heights $safe_keys
check "displace --safe: all of the way" says '"step_fraction": 1,'
check "displace --safe: no inverted cell" says '"inverted": 0,'
wall_field "$ring" "$tmp/safe.su2" >"$tmp/reached.txt"
check "displace --safe: the wall is where it shall be" awk '{ getline other <WALL; split(other, b)
    d = $2 - b[2]; e = $3 - b[3]; if (d * d + e * e > 1e-18) wrong++; n++ } END { exit wrong > 0 || n != 48 }' \
    WALL="$tmp/turn.txt" "$tmp/reached.txt"
runs "displace --safe: for people" 0 displace "$ring" --given body --wall "$tmp/turn.txt" --safe
check "displace --safe: says how" says '100 % of the way'
refuses "displace --safe: a wall that crosses itself" 1 'the moved boundary crosses itself' \
    displace "$ring" --given body --wall "$tmp/through.txt" --safe -o "$tmp/x"
runs "displace --safe --strict: poor cells" 1 displace "$ring" --given body --wall "$tmp/turn.txt" --safe \
    --min-quality 1 --strict -o "$tmp/x"
leaves_nothing "displace --safe --strict: no file" "$tmp/x"
refuses "displace --min-quality alone" 2 '--min-quality needs --safe' \
    displace "$ring" --given body --wall "$tmp/wall.txt" --min-quality .5
refuses "displace --move without what moves" 2 '--move needs --curve or --rigid' \
    displace "$ring" --given body --wall "$tmp/wall.txt" --move "$tmp/small.txt"
marker_points() { # marker_points MESH MARKER: their numbers and coordinates
    awk -v marker="$2" '/NPOIN=/ { n = $2; k = 0; next } n > 0 { x[k] = $1; y[k++] = $2; n--; next }
        /MARKER_TAG=/ { on = $2 == marker; next } on && $1 == 3 { for (i = 2; i <= 3; i++) if (!($i in seen)) {
            seen[$i] = 1; print $i, x[$i], y[$i] } }' "$1"
}
bodies=$meshes/two_bodies.su2
marker_points "$bodies" left | awk '{ printf "%d .03 %.17g\n", $1, .1 * ($2 - 1.2) }' >"$tmp/left.txt"
echo "rigid right 0.02 0 10" >"$tmp/right.txt"
for way in "" --safe; do
    runs "displace beside a rigid body $way" 0 displace "$bodies" --given left --wall "$tmp/left.txt" --rigid right \
        --move "$tmp/right.txt" $way -o "$tmp/both.su2"
    for body in left right; do
        marker_points "$bodies" $body >"$tmp/$body.before"
        marker_points "$tmp/both.su2" $body >"$tmp/$body.after"
    done
    check "displace beside a rigid body $way: the given wall" awk '{ getline b <BEFORE; split(b, p)
        if (($2 - p[2] - .03) ^ 2 + ($3 - p[3] - .1 * (p[2] - 1.2)) ^ 2 > 1e-16) wrong++; n++ }
        END { exit wrong > 0 || n < 50 }' \
        BEFORE="$tmp/left.before" "$tmp/left.after"
    check "displace beside a rigid body $way: the body turned by 10 degrees" awk 'NR == 1 { x = $2; y = $3;
        getline b <BEFORE
        split(b, p); u = p[2]; v = p[3]; next } { getline b <BEFORE; split(b, p); c = cos(.17453292519943295);
        s = sin(.17453292519943295)
        d = $2 - x - c * (p[2] - u) + s * (p[3] - v); e = $3 - y - s * (p[2] - u) - c * (p[3] - v)
        if (d * d + e * e > 1e-16) wrong++; n++ } END { exit wrong > 0 || n < 50 }' BEFORE="$tmp/right.before" \
            "$tmp/right.after"
done
# One body goes farther than the gap, and the other one, half as large, away from it: nothing crosses where everything
# has moved.
marker_points "$bodies" left | awk '{ print $1, .85, 0 }' >"$tmp/left.txt"
refuses "displace: one body into the other" 1 'the moved boundary crosses itself' \
    displace "$bodies" --given left --wall "$tmp/left.txt" -o "$tmp/x"
echo "rigid right .5 0 0 .5" >"$tmp/right.txt"
for way in "" --safe; do
    runs "displace: farther than the gap $way" 0 displace "$bodies" --given left --wall "$tmp/left.txt" --rigid right \
        --move "$tmp/right.txt" $way -o "$tmp/both.su2"
done
echo "rigid right -.5 0 0" >"$tmp/right.txt"
refuses "displace: a body into the given one" 1 'the moved boundary crosses itself' \
    displace "$bodies" --given left --wall "$tmp/left.txt" --rigid right --move "$tmp/right.txt" -o "$tmp/x"
marker_points "$bodies" left | awk '{ print $1, 0, 0 }' >"$tmp/left.txt"
for place in "-1.77 .1 0 .01" "-1.7 .12 40 .02"; do
    echo "rigid right $place" >"$tmp/right.txt"
    refuses "displace: a small body inside the other one, $place" 1 "marker 'right' would be inside another body" \
        displace "$bodies" --given left --wall "$tmp/left.txt" --rigid right --move "$tmp/right.txt" -o "$tmp/x"
done
for place in "40 0 0" "0 -60 20"; do
    echo "rigid right $place" >"$tmp/right.txt"
    refuses "displace: a body outside the domain, $place" 1 "marker 'right' would be outside the domain" \
        displace "$bodies" --given left --wall "$tmp/left.txt" --rigid right --move "$tmp/right.txt" -o "$tmp/x"
done
marker_points "$bodies" left | awk '{ printf "%d .03 %.17g\n", $1, .1 * ($2 - 1.2) }' >"$tmp/left.txt"
runs "displace beside a curve" 0 displace "$bodies" --given left --wall "$tmp/left.txt" \
    --curve "right=$meshes/two_bodies_right.curve" --safe -o "$tmp/both.su2"

# The report: given walls are walls that move, and their distance from the targets is 0 but for the digits of the file.
runs "displace: report" 0 displace "$ring" --given body --wall "$tmp/wall.txt" --report "$tmp/displaced.html"
check "displace: report: data of the page" grep -q '"boundary_error_note": "largest distance of given points' \
    "$tmp/displaced.html"
check "displace: report: the whole page" grep -q '</html>' "$tmp/displaced.html"
