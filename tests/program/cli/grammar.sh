# One grammar of markers for options, files of moves and outputs: quotes, pieces, and names with blanks, quotes and `=`.

# W x H squares with two holes of 2 x 2, whose faces have the marker NAME.
two_holes() { # two_holes W H NAME
    awk -v w="$1" -v h="$2" -v name="$3" 'BEGIN {
        y0 = int(h / 2) - 1; first = 2; second = w - 4
        for (j = 0; j < h; ++j) for (i = 0; i < w; ++i) {
            in_hole = j >= y0 && j < y0 + 2 && ((i >= first && i < first + 2) || (i >= second && i < second + 2))
            if (!in_hole) cells[n_cells++] = sprintf("9 %d %d %d %d", j * (w + 1) + i, j * (w + 1) + i + 1,
                (j + 1) * (w + 1) + i + 1, (j + 1) * (w + 1) + i)
        }
        print "NDIME= 2\nNELEM= " n_cells
        for (k = 0; k < n_cells; ++k) print cells[k]
        print "NPOIN= " (w + 1) * (h + 1)
        for (j = 0; j <= h; ++j) for (i = 0; i <= w; ++i) print i, j
        print "NMARK= 2\nMARKER_TAG= " name "\nMARKER_ELEMS= 16"
        for (x0 = first; ; x0 = second) {
            split("0 0 1 0 2 0 2 1 2 2 1 2 0 2 0 1 0 0", at, " ")
            for (k = 1; k < 17; k += 2)
                print 3, (y0 + at[k + 1]) * (w + 1) + x0 + at[k], (y0 + at[k + 3]) * (w + 1) + x0 + at[k + 2]
            if (x0 == second) break
        }
        print "MARKER_TAG= far\nMARKER_ELEMS= " 2 * (w + h)
        for (i = 0; i < w; ++i) print 3, i, i + 1 "\n3", h * (w + 1) + i, h * (w + 1) + i + 1
        for (j = 0; j < h; ++j) print 3, j * (w + 1), (j + 1) * (w + 1) "\n3", j * (w + 1) + w, (j + 1) * (w + 1) + w
    }'
}
grammar=$tmp/grammar
mkdir "$grammar"
mesh=$grammar/mesh.su2
square_curve() { # square_curve X Y: round the hole whose corners are (X, Y) and (X + 2, Y + 2)
    printf 'degree 1\nclosed tied\npoints 4\n'
    printf '%d %d\n' $1 $2 $(($1 + 2)) $2 $(($1 + 2)) $(($2 + 2)) $1 $(($2 + 2))
    printf 'knots 7\n0 0 2 4 6 8 8\n'
}
# The name as the mesh has it, and as options and lines have it.
bodies() { # bodies W H NAME WORD
    what="bodies of marker $3" word=$4 far_x=$(($1 - 3)).2 y=$(($2 / 2)).1
    two_holes $1 $2 "$3" >"$mesh"
    runs "$what: solve" 0 solve "$mesh" --rigid "$word@3:$y" --rigid "$word@$far_x:$y=$far_x,$y" -o "$grammar/b.basis"
    runs "$what: morph one" 0 morph "$mesh" "$grammar/b.basis" --by "rigid $word@$far_x:$y .1 0 5 # the second" \
        -o "$grammar/one.su2" --json
    check "$what: one moves" sh -c "! cmp -s '$mesh' '$grammar/one.su2'"
    runs "$what: the place may be another one" 0 morph "$mesh" "$grammar/b.basis" \
        --by "rigid $word@$(($1 - 1)):1 .1 0 5" -o "$grammar/other.su2"
    check "$what: the place may be another one: same mesh" cmp "$grammar/one.su2" "$grammar/other.su2"
    refuses "$what: the name alone is both" 2 'a piece MARKER@X:Y' morph "$mesh" "$grammar/b.basis" \
        --by "rigid $word .1 0 5" -o "$tmp/x"
    runs "$what: what is written" 0 morph "$mesh" "$grammar/b.basis" --by "rigid $word@$far_x:$y .1 0 5" --safe \
        --reached "$grammar/reached.txt" -o "$grammar/safe.su2"
    runs "$what: what is written is read" 0 morph "$mesh" "$grammar/b.basis" --move "$grammar/reached.txt" --safe \
        -o "$grammar/again.su2"
    check "$what: what is written is read: same mesh" cmp "$grammar/safe.su2" "$grammar/again.su2"
    runs "$what: a moved mesh" 0 morph "$grammar/one.su2" "$grammar/b.basis" --move "$grammar/reached.txt" \
        -o "$grammar/twice.su2"
    { echo "PointID,x,y,Sensitivity_x,Sensitivity_y"; awk -v w=$1 -v h=$2 'BEGIN {
        for (j = 0; j <= h; ++j) for (i = 0; i <= w; ++i) print n++ "," i "," j "," i - j ",1" }'; } >"$grammar/s.csv"
    runs "$what: adjoint" 0 adjoint "$mesh" "$grammar/b.basis" --sensitivity "$grammar/s.csv" -o "$grammar/gradient"
    awk '$1 == "rigid"' "$grammar/gradient" >"$grammar/lines"
    check "$what: adjoint: two bodies" [ "$(wc -l <"$grammar/lines")" -eq 2 ]
    # A step of 1e-4 along the gradient, the scale of which is a derivative and no factor.
    awk '{ for (k = NF - 3; k < NF; ++k) $k *= 1e-4; $NF = 1; print }' "$grammar/lines" >"$grammar/step.txt"
    runs "$what: adjoint: its lines are read" 0 morph "$mesh" "$grammar/b.basis" --move "$grammar/step.txt" \
        -o "$grammar/step.su2"
    for body in 2 $(($1 - 4)); do square_curve $body $(($2 / 2 - 1)) >"$grammar/$body.curve"; done
    runs "$what: curves" 0 solve "$mesh" --curve "$word@3:$y=$grammar/2.curve" \
        --curve "$word@$far_x:$y=$grammar/$(($1 - 4)).curve" -o "$grammar/c.basis"
    runs "$what: curves: turn one" 0 morph "$mesh" "$grammar/c.basis" --by "turn $word@$far_x:$y 5 $far_x,$y" \
        -o "$grammar/c.su2"
    check "$what: curves: the other one stays" near \
        "$(awk -v n=$(($2 / 2 * ($1 + 1) + 2)) '/^NPOIN/ { on = NR } on && NR == on + 1 + n { print $1, $2 }' \
            "$grammar/c.su2")" "2 $(($2 / 2))"
    awk -v w=$1 -v y=$(($2 / 2 - 1)) 'BEGIN { for (j = y; j < y + 3; ++j) for (i = 2; i < 5; ++i)
        if (i != 3 || j != y + 1) print j * (w + 1) + i, .05, 0 }' >"$grammar/wall.txt"
    runs "$what: displace" 0 displace "$mesh" --given "$word@3:$y" --wall "$grammar/wall.txt" \
        --rigid "$word@$far_x:$y" --by "rigid $word@$(($1 - 3)):1 0 .05 5" -o "$grammar/d.su2" --json
    check "$what: displace: exactly" awk -v e="$(number boundary_error)" 'BEGIN { exit !(e != "" && e < 1e-12) }'
}
bodies 12 8 wall wall
bodies 14 10 "my wall" '"my wall"'
bodies 12 8 "my wall" "'my wall'"
bodies 12 8 'a"b=c' 'a"b=c'
bodies 12 8 '"q" #1, x' '"\"q\" #1, x"'
bodies 12 8 'wall@3:4.1' '"wall@3:4.1"'
refuses "quotes: no such marker" 2 "has no marker 'nosuch'" solve "$mesh" --rigid '"nosuch"' -o "$tmp/x"
refuses "quotes: a pattern in quotes is a name" 2 "has no marker 'wa*'" solve "$mesh" --rigid '"wa*"' -o "$tmp/x"
rm -rf "$grammar"
