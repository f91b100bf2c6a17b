# Curves out and in: files of curves, sections of airfoils.

shape() { awk -f "$here/../read_curves.awk" "$1"; } # FILE: its curves in numbers, by a reader of its own
same_shape() { shape "$1" >"$tmp/shape.1" && shape "$2" >"$tmp/shape.2" && test -s "$tmp/shape.1" &&
    cmp "$tmp/shape.1" "$tmp/shape.2"; }
for ending in curve igs step; do
    runs "curve out: $ending" 0 fit "$ring" --marker body --points 12 -o "$tmp/out.$ending"
    check "curve out: $ending: re-read" same_shape "$tmp/out.$ending" "$tmp/out.curve"
    runs "moved curve: $ending" 0 morph "$box" "$tmp/conformal.basis" --move "$tmp/turn40.txt" \
        --curve-out "$tmp/moved.$ending"
    check "moved curve: $ending: re-read" same_shape "$tmp/moved.$ending" "$tmp/moved.curve"
done
check "moved curve: control points and their moves" sh -c "awk '
    FILENAME ~ /turn40/ { x[\$1] = \$2; y[\$1] = \$3; next }
    /^points/ { n = \$2; k = 0; next }
    k < n { k++; wx = (k == 1 || k == 4 ? 4 : 8) + x[k]; wy = (k < 3 ? 5 : 7) + y[k]
        bad += (\$1 - wx) ^ 2 + (\$2 - wy) ^ 2 > 1e-24 }
    END { exit bad || n != 4 }' '$tmp/turn40.txt' '$tmp/moved.curve'"
runs "moved curve: beside the mesh" 0 morph "$box" "$tmp/conformal.basis" --move "$tmp/turn40.txt" -o "$tmp/with.su2" \
    --json
check "moved curve: beside the mesh: says where" says "\"moved_curve\": \"$tmp/with.su2.curve\""
check "moved curve: beside the mesh: the same" cmp "$tmp/with.su2.curve" "$tmp/moved.curve"
runs "moved curve: solved on the moved mesh" 0 solve "$tmp/with.su2" --curve block="$tmp/with.su2.curve" \
    -o "$tmp/with.basis" --json
check "moved curve: the moved mesh is on it" grep -E '"boundary_error": ([0-9.]*e-1[5-9]|0),' "$tmp/out"
runs "bodies alone have no curve" 0 morph "$box" "$tmp/rigid.basis" --move "$no_moves" -o "$tmp/alone.su2" --json
check "bodies alone have no curve: says so" says '"moved_curve": ""'

runs "Selig out" 0 fit "$meshes/naca0012.su2" --marker airfoil -o "$tmp/foil.dat"
check "Selig out: counter-clockwise from and to the trailing edge" awk 'NR == 1 { next } NR == 2 { ok = $1 == 1 &&
    $2 == 0; x = $1; y = $2; next }
    { area += x * $2 - $1 * y; x = $1; y = $2 } END { exit !(ok && x == 1 && y == 0 && area > 0) }' "$tmp/foil.dat"
runs "Selig in" 0 fit "$tmp/foil.dat" -o "$tmp/foil.curve" --json
check "Selig in: a sharp trailing edge" says '"closed": "tied", "corners": 1'
check "Selig in: the curve again" awk '{ match($0, /"max_error": [^,]*/);
    exit !(substr($0, RSTART + 13, RLENGTH - 13) + 0 < 2e-5) }' "$tmp/out"
runs "a curve in, for other control points" 0 fit "$tmp/out.curve" --points 9 -o "$tmp/nine.curve"
check "a curve in: nine points" grep -x 'points 9' "$tmp/nine.curve"
awk 'NR == 1 { next } { x[++n] = $1; y[n] = $2 } END { half = 1; for (k = 1; k <= n; k++) if (x[k] < x[half]) half = k
    print "LEDNICER\n " half ". " n - half + 1 ".\n"; for (k = half; k >= 1; k--) print x[k], y[k]; print ""
    for (k = half; k <= n; k++) print x[k], y[k] }' "$tmp/foil.dat" >"$tmp/lednicer.dat"
runs "Lednicer in" 0 fit "$tmp/lednicer.dat" -o "$tmp/lednicer.curve"
check "Lednicer in: as Selig" cmp "$tmp/lednicer.curve" "$tmp/foil.curve"
refuses "--marker with a section" 2 '--marker' fit "$tmp/foil.dat" --marker airfoil -o "$tmp/x"
bad_section() { # bad_section NAME LINE CONTENT
    printf "$3" >"$tmp/bad.dat"
    refuses "$1" 3 "$tmp/bad.dat:$2: " fit "$tmp/bad.dat" --points 4 -o "$tmp/x"
}
bad_section "section: a word for a number" 3 'name\n1 0\n.5 o\n'
bad_section "section: a lower side that ends early" 2 'name\n3. 3.\n0 0\n.5 .1\n1 0\n0 0\n.5 -.1\n'
bad_section "section: two points" 3 'name\n1 0\n0 0\n'
printf 'name\n' >"$tmp/bad.dat"
refuses "section: a name alone" 3 "$tmp/bad.dat" fit "$tmp/bad.dat" -o "$tmp/x"

# A square: with as many points for 16 control points of degree 5 the curve runs back at a corner.
awk 'BEGIN { print "square"; for (k = 0; k < 20; k++) { s = int(k / 5); t = (k % 5) / 5
    print s == 0 ? t : s == 1 ? 1 : s == 2 ? 1 - t : 0, s == 0 ? 0 : s == 1 ? t : s == 2 ? 1 : 1 - t }
    }' >"$tmp/square.dat"
runs "fit that runs back" 0 fit "$tmp/square.dat" --degree 5 --points 16 -o "$tmp/square.curve" --json
check "fit that runs back: is said" says '"backtracks": true'
check "fit that runs back: and where" says 'the curve runs against the order of the points'
runs "fit that does not" 0 fit "$tmp/square.dat" --points 12 -o "$tmp/square.curve" --json
check "fit that does not: is not said" says '"backtracks": false'

# The notation of the literature writes the first points, as many as the degree, again at the end of a periodic curve.
for degree in 2 3 5; do
    makes fit "$ring" --marker body --points 11 --degree $degree --closed periodic -o "$tmp/usual.curve"
    awk -v degree=$degree '/^points/ { print $1, $2 + degree; n = $2; next }
        n > 0 { point[++k] = $0; print
            if (k == n) { for (i = 1; i <= degree; i++) print point[i]; n = 0 }
            next }
        { print }' "$tmp/usual.curve" >"$tmp/repeated.curve"
    makes solve "$ring" --curve body="$tmp/usual.curve" -o "$tmp/usual.basis"
    makes solve "$ring" --curve body="$tmp/repeated.curve" -o "$tmp/repeated.basis"
    check "degree $degree: points of a periodic curve that are written twice" \
        cmp "$tmp/usual.basis" "$tmp/repeated.basis"
    sed 's/^closed periodic/closed open/' "$tmp/repeated.curve" >"$tmp/open.curve"
    refuses "degree $degree: an open curve that repeats its points" 3 \
        "the last $degree points repeat the first $degree" \
        solve "$ring" --curve body="$tmp/open.curve" -o "$tmp/x"
    { cat "$tmp/usual.curve"; sed -n '/^indices/,$p' "$tmp/err"; } >"$tmp/lines.curve"
    makes solve "$ring" --curve body="$tmp/lines.curve" -o "$tmp/lines.basis"
    check "degree $degree: the lines that the message proposes" cmp "$tmp/usual.basis" "$tmp/lines.basis"
done
