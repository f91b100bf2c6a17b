# Sides that move alike: `--periodic`, of translates and of sides that are turned.

runs "--periodic, with a colon in a tag" 0 solve "$box" $on_block --periodic in:let:out -o "$tmp/pair.basis"
runs "--periodic by patterns, with a colon in a tag" 0 solve "$box" $on_block --periodic 'in:*:ou?' \
    -o "$tmp/named.basis"
check "--periodic by patterns: the same basis" cmp "$tmp/pair.basis" "$tmp/named.basis"
refuses "--periodic by a pattern of two markers" 2 "each of which stands for one marker, not 'in:let:*o*'" \
    solve "$box" $on_block --periodic 'in:let:*o*' -o "$tmp/x"
runs "--periodic: morph" 0 morph "$box" "$tmp/pair.basis" --move "$tmp/turn40.txt" -o "$tmp/pair.su2"
set -- $(place 0 7 "$tmp/pair.su2")
check "--periodic: both sides move alike" near $(place 12 7 "$tmp/pair.su2") "$(echo "$1" | awk '{
    printf "%.17g", $1 + 12 }')" "$2"
check "--periodic: and do move" sh -c "! echo '$2' | grep -q '^7$'"
refuses "--periodic without a partner" 2 '--periodic' solve "$box" $on_block --periodic low -o "$tmp/x"
refuses "--periodic with an unknown partner" 2 "'low:nowhere'" solve "$box" $on_block --periodic low:nowhere -o "$tmp/x"
refuses "--periodic: no translates" 2 'periodic' solve "$tmp/bent.su2" $on_block --periodic low:high -o "$tmp/x"

# A passage of an annulus: the box bent round a centre; its right side is its left one, turned by 36 degrees.
bend() { # bend CENTRE_X CENTRE_Y
    awk -v cx="$1" -v cy="$2" '/^NPOIN/ { points = 1; print; next } /^[A-Z]/ { points = 0 }
        points { a = atan2(0, -1) / 5 * $1 / 12; r = 30 - $2; printf "%.17g %.17g\n", cx + r * cos(a),
        cy + r * sin(a); next }
        { print }' "$box"
}
# misfit FILE CENTRE_X CENTRE_Y: how far the moved right side is from the left one, turned; is anything moved?
misfit() {
    set -- "$1" "$2" "$3" $(place 0 7 "$1") $(place 12 7 "$1")
    awk -v cx="$2" -v cy="$3" -v x="$4" -v y="$5" -v u="$6" -v v="$7" 'BEGIN {
        a = atan2(0, -1) / 5; x -= cx; y -= cy; u -= cx; v -= cy
        dx = x * cos(a) - y * sin(a) - u; dy = x * sin(a) + y * cos(a) - v; moved = sqrt((x - 23) ^ 2 + y ^ 2)
        exit !(dx ^ 2 + dy ^ 2 < 1e-24 && moved > 1e-3) }'
}
printf 'rigid block .3 .2 25\n' >"$tmp/passage.txt"
for centre in '0 0' '5 -7'; do
    bend $centre >"$tmp/passage.su2"
    for operator in conformal laplace; do
        runs "--periodic: a passage about $centre, $operator" 0 solve "$tmp/passage.su2" --rigid block \
            --periodic in:let:out --operator $operator -o "$tmp/passage.basis"
        check "--periodic: says how the sides are turned" says "'in:let' to 'out' turned by 36 degrees about ($(echo \
            $centre | sed 's/ /, /'))"
        runs "--periodic: morph of a passage" 0 morph "$tmp/passage.su2" "$tmp/passage.basis" \
            --move "$tmp/passage.txt" -o "$tmp/passage-moved.su2"
        check "--periodic: the sides of the passage stay images" misfit "$tmp/passage-moved.su2" $centre
        runs "--periodic: safe morph of a passage" 0 morph "$tmp/passage.su2" "$tmp/passage.basis" \
            --move "$tmp/passage.txt" --safe -o "$tmp/passage-safe.su2"
        check "--periodic: the sides stay images in a safe morph" misfit "$tmp/passage-safe.su2" $centre
    done
done
runs "--periodic: transfer of a passage" 0 transfer "$tmp/passage.su2" "$tmp/passage.basis" "$tmp/passage.su2" \
    -o "$tmp/passage-fine.basis"
runs "--periodic: morph by the functions that were transferred" 0 morph "$tmp/passage.su2" "$tmp/passage-fine.basis" \
    --move "$tmp/passage.txt" -o "$tmp/passage-moved.su2"
check "--periodic: the sides of the passage stay images with them" misfit "$tmp/passage-moved.su2" 5 -7
runs "--periodic: page of a passage" 0 explore "$tmp/passage.su2" "$tmp/passage.basis" -o "$tmp/passage.html"
refuses "--periodic: a passage with multigrid" 2 'HM_ROTATION_PAIR needs the direct engine' \
    solve "$tmp/passage.su2" --rigid block --periodic in:let:out --operator laplace --engine multigrid -o "$tmp/x"
refuses "--periodic: a passage with sliding sides" 2 'HM_ROTATION_PAIR cannot be combined with slip' solve \
    "$tmp/passage.su2" --rigid block --periodic in:let:out --slip low -o "$tmp/x"
