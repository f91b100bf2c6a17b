# Airfoil files of all layouts: each gives the curve of the plain file, bit for bit, and says its layout; outlines
# that are no section are refused with both places.

# points N THICKNESS CHORD BASE: lines "x y" from the upper trailing edge round to the lower one; a base if BASE > 0
points() {
    awk -v n="$1" -v t="$2" -v chord="$3" -v base="$4" 'BEGIN {
        pi = atan2(0, -1)
        for (k = n; k >= -n; k--) {
            x = .5 * (1 - cos(pi * k / n)); side = k < 0 ? -1 : 1
            y = 5 * t * (.2969 * sqrt(x) - .126 * x - .3516 * x ^ 2 + .2843 * x ^ 3 - .1036 * x ^ 4)
            if (k == n || k == -n) y = 0
            y = side * y + .01 * x * (1 - x) + side * base / 2 * x
            printf "%.7f %.7f\n", chord * x, chord * y
        }
    }'
}
sides() { # sides SEPARATOR: both sides from the leading edge, of the lines of standard input
    awk -v between="$1" '{ line[++n] = $0 } END { half = (n + 1) / 2
        for (k = half; k >= 1; k--) print line[k]
        if (between != "none") print between
        for (k = half; k <= n; k++) print line[k] }'
}
same_curve() { # same_curve NAME WORDS: bad.dat has the curve of plain.dat, and the report says WORDS
    runs "section: $1" 0 fit "$tmp/bad.dat" --points 16 -o "$tmp/layout.curve"
    check "section: $1: the curve" cmp "$tmp/layout.curve" "$tmp/plain.curve"
    check "section: $1: the layout is said" grep "^layout .*$2" "$tmp/out"
}
for variation in "24 .12 1 0" "31 .09 100 0" "27 .18 1 .02"; do
    points $variation >"$tmp/plain.points"
    count=$(wc -l <"$tmp/plain.points") half=$((($(wc -l <"$tmp/plain.points") + 1) / 2))
    at=$((count / 4))
    { echo plain; cat "$tmp/plain.points"; } >"$tmp/plain.dat"
    runs "section: plain" 0 fit "$tmp/plain.dat" --points 16 -o "$tmp/plain.curve"
    layout() { cat >"$tmp/bad.dat"; same_curve "$1 ($variation)" "$2"; }
    layout "no title" "one run" <"$tmp/plain.points"
    { echo one; echo two; cat "$tmp/plain.points"; } | layout "two titles" "one run"
    { echo "63 412"; cat "$tmp/plain.points"; } | layout "a title of two numbers" "title of two numbers"
    { echo "NACA"; echo "23 015"; cat "$tmp/plain.points"; } | layout "a second title of two numbers" "title of two"
    { echo "2412"; cat "$tmp/plain.points"; } | layout "a title of one number" "one number"
    { echo name; echo "$count"; cat "$tmp/plain.points"; } | layout "a count" "one number"
    { cat "$tmp/plain.dat"; printf '\nown note: drawn in 2001, 9,5 %% thick\n'; } | layout "a note after" "notes"
    { cat "$tmp/plain.dat"; printf 'the end\n'; } | layout "a note right after" "notes"
    awk -v at=$at '{ print } NR == at { print "here begins the upper side" }' "$tmp/plain.dat" |
        layout "a note between" "notes"
    awk -v at=$at '{ print } NR == at { print "" }' "$tmp/plain.dat" | layout "a blank line between" "one run"
    awk -v at=$at '{ print } NR == at || NR == 3 { print }' "$tmp/plain.dat" |
        layout "repeated points" "one run"
    awk 'NR > 1 { printf "%.17g %s\n", $1 + ($1 < 1e-9 ? 1e-17 : 0), $2 } NR > 1' "$tmp/plain.dat" |
        layout "points repeated up to rounding" "one run"
    { echo Led; echo " $half. $half."; echo; sides "" <"$tmp/plain.points"; } | layout "Lednicer" "Lednicer"
    { echo Led; echo "$half $half"; sides none <"$tmp/plain.points"; } | layout "Lednicer without blanks" "Lednicer"
    { echo sides; sides "" <"$tmp/plain.points"; } | layout "sides without counts" "without counts"
    { echo sides; sides none <"$tmp/plain.points"; } | layout "sides without counts and blank" "without counts"
    { head -n $half "$tmp/plain.points"; echo
        sed "1,$((half - 1))d" "$tmp/plain.points" | awk '{ l[NR] = $0 } END { for (k = NR; k; k--) print l[k] }'; } |
        layout "sides from the trailing edge" "without counts"
    { echo sides; sides 'ZONE T="lower"' <"$tmp/plain.points"; } | layout "sides in two zones" "without counts.*Tecplot"
    { echo mses; echo "-2.0 3.0 -2.5 3.5"; cat "$tmp/plain.points"; } | layout "MSES" "MSES"
    { cat "$tmp/plain.dat"; echo "999.0 999.0"; } | layout "a separator at the end" "999"
    { printf 'TITLE = "own"\nVARIABLES = "X" "Y"\nZONE T="own", I=%s, F=POINT\n' "$count"; cat "$tmp/plain.points"; } |
        layout "Tecplot" "Tecplot"
    { echo 'ZONE="OWN"'; tr ' ' '\t' <"$tmp/plain.points"; } | layout "a zone alone" "Tecplot"
    { printf 'VARIABLES = "S","Y","X"\nZONE\n'; awk '{ print NR * .1, $2, $1 }' "$tmp/plain.points"; } |
        layout "Tecplot with more variables" "Tecplot"
    { echo x,y; tr ' ' , <"$tmp/plain.points"; } | layout "CSV with a header" "commas, named columns"
    tr ' ' , <"$tmp/plain.points" | layout "CSV without a header" "commas"
    sed 's/ /, /' "$tmp/plain.points" | layout "commas and blanks" "commas"
    { echo '"cp","x/c","y/c"'; awk '{ print NR % 3 ",", $1 "," $2 }' "$tmp/plain.points"; } |
        layout "CSV with more columns" "named columns"
    { echo name; tr '. ' ',;' <"$tmp/plain.points"; } | layout "semicolons and decimal commas" "semicolons"
    { echo name; tr ' ' ';' <"$tmp/plain.points"; } | layout "semicolons" "semicolons"
    { echo name; tr '.' ',' <"$tmp/plain.points"; } | layout "decimal commas" "decimal commas"
    awk '{ print $0, "0.0" }' "$tmp/plain.points" | layout "x y z" "constant column"
    awk '{ print $1, "0", $2 }' "$tmp/plain.points" | layout "x z y" "constant column"
    awk '{ print NR, $0 }' "$tmp/plain.points" | layout "numbered points" "numbered"
    awk '{ print NR - 1, $0, 0 }' "$tmp/plain.points" | layout "numbered points with z" "numbered"
    chord=$(echo "$variation" | cut -d' ' -f3)
    { echo "$((count + 1)) NumCoords ! with the reference point"
        printf '! x-y\n! reference\n!\n%s 0\n! airfoil\n! x y\n' \
        "$(echo "$chord" | awk '{ print .25 * $1 }')"; cat "$tmp/plain.points"; } | \
        layout "OpenFAST" "OpenFAST.*reference"
    awk '{ printf "%s\r\n", $0 }' "$tmp/plain.dat" | layout "DOS lines" "one run"
    awk '{ print "  +" $1 "D0\t" $2 "d+00" }' "$tmp/plain.points" | sed 's/+-/-/' | \
        layout "Fortran's exponents" "one run"
    # The content decides, whatever the ending.
    for ending in txt af csv none; do
        cp "$tmp/plain.dat" "$tmp/plain.$ending"
        runs "section: ending $ending" 0 fit "$tmp/plain.$ending" --points 16 -o "$tmp/layout.curve"
        check "section: ending $ending: the curve" cmp "$tmp/layout.curve" "$tmp/plain.curve"
    done

    # Several elements: one by its number, or a curve for each.
    awk -v c="$chord" '{ print $1 + 1.3 * c, $2 - .1 * c }' "$tmp/plain.points" >"$tmp/second.points"
    { echo second; cat "$tmp/second.points"; } >"$tmp/bad.dat"
    runs "section: a second element alone" 0 fit "$tmp/bad.dat" --points 16 -o "$tmp/second.curve"
    for between in "999.0 999.0" "" 'ZONE T="flap"'; do
        { cat "$tmp/plain.dat"; echo "$between"; cat "$tmp/second.points"; } >"$tmp/two.dat"
        runs "section: two elements, '$between', 1" 0 fit "$tmp/two.dat" --element 1 --points 16 -o "$tmp/layout.curve"
        check "section: two elements, '$between', 1: the curve" cmp "$tmp/layout.curve" "$tmp/plain.curve"
        runs "section: two elements, '$between', 2" 0 fit "$tmp/two.dat" --element 2 --points 16 -o "$tmp/layout.curve"
        check "section: two elements, '$between', 2: the curve" cmp "$tmp/layout.curve" "$tmp/second.curve"
        runs "section: two elements, '$between', both" 0 fit "$tmp/two.dat" --points 16 -o "$tmp/both.curve"
        check "section: two elements, '$between': two curves" grep -x 'points 32' "$tmp/both.curve"
        refuses "section: two elements, '$between', 3" 3 '2 elements' fit "$tmp/two.dat" --element 3 -o "$tmp/x"
    done
    refuses "section: two elements for a movement" 3 '--element' morph "$box" "$tmp/conformal.basis" \
        --to-airfoil "$tmp/two.dat"

    # Outlines that are no section: what is wrong, and both places.
    no_section() { # NAME WORDS
        cat >"$tmp/bad.dat"
        refuses "section: $1 ($variation)" 3 "$2" fit "$tmp/bad.dat" --points 16 -o "$tmp/x"
        check "section: $1: two places" sh -c "grep -o 'in line [0-9]' '$tmp/err' | wc -l | grep -v '^ *[01]$'"
    }
    for stray in "0 0" "1000 1000" "1e6 1e6" "-3000 7"; do
        { cat "$tmp/plain.dat"; echo "$stray"; } | no_section "a stray last point $stray" "the outline jumps"
    done
    { echo name; echo "$chord" | awk '{ print .25 * $1, .001 }'; cat "$tmp/plain.points"; } |
        no_section "a reference point" "the outline jumps"
    { echo name; head -n "$half" "$tmp/plain.points"; } | no_section "one side" "the outline jumps"
    awk -v at=$((count / 3)) 'NR == at { keep = $0; next } { print } NR == at + 9 { print keep }' "$tmp/plain.dat" |
        no_section "points in another order" "crosses itself"
done
awk 'BEGIN { print "wedge"; print "1 .1\n0 0\n1 -.1\n1.02 0" }' >"$tmp/bad.dat"
runs "section: long straight sides" 0 fit "$tmp/bad.dat" --points 4 --degree 1 -o "$tmp/layout.curve"
check "section: long straight sides: a warning" says 'straight segment'
printf 'name\n1 0\n.5 .1\nx .1 .2\n0 0\n.5 -.1\n' >"$tmp/bad.dat"
runs "section: a line of words between points" 0 fit "$tmp/bad.dat" --points 4 -o "$tmp/layout.curve"
printf '1 2 3\n4 9 6\n8 8 9\n1 7 2\n' >"$tmp/bad.dat"
refuses "section: three columns" 3 'which of these are x and y' fit "$tmp/bad.dat" --points 4 -o "$tmp/x"
