# Markers by name.

# Three meshes are the first mesh with the markers in another order, with other names, and with the faces of two sides
# exchanged.
markers_of() { awk -v tag="$1" '/^MARKER_TAG=/ { on = $2 == tag } on' "$box"; }
{ sed '/^MARKER_TAG/,$d' "$box"; for tag in out block high in:let low; do markers_of $tag; done; } >"$tmp/shuffled.su2"
sed 's/MARKER_TAG= block/MARKER_TAG= brick/' "$box" >"$tmp/renamed.su2"
sed 's/MARKER_TAG= low/MARKER_TAG= swap/; s/MARKER_TAG= high/MARKER_TAG= low/; s/MARKER_TAG= swap/MARKER_TAG= high/' \
    "$box" >"$tmp/exchanged.su2"
check "markers in another order: another file" sh -c "! cmp -s '$box' '$tmp/shuffled.su2'"
runs "markers in another order: solve" 0 solve "$tmp/shuffled.su2" $on_block --slip low -o "$tmp/shuffled.basis"
runs "markers in another order: the basis serves both" 0 morph "$box" "$tmp/shuffled.basis" --move "$tmp/turn40.txt" \
    -o "$tmp/shuffled-turned.su2"
check "markers in another order: what slips slides" near $(place 5 0 "$tmp/shuffled-turned.su2") '*' 0
check "markers in another order: what is fixed stays" near $(place 5 12 "$tmp/shuffled-turned.su2") 5 12
runs "markers in another order: the body that is named moves" 0 morph "$tmp/shuffled.su2" "$tmp/rigid.basis" \
    --move "$tmp/rigid.txt" --safe -o "$tmp/shuffled-moved.su2"
check "markers in another order: where it is to be" near $(place 4 5 "$tmp/shuffled-moved.su2") 7.75 3.25
refuses "a marker of another name" \
    3 "its markers are 'block', 'high', 'in:let', 'low', 'out'; those of $tmp/renamed.su2 are 'brick'" \
    morph "$tmp/renamed.su2" "$tmp/rigid.basis" --move "$no_moves"
refuses "the same names on other points" 3 'the markers contain other points' morph "$tmp/exchanged.su2" \
    "$tmp/rigid.basis" --move "$no_moves"
sed '/^harmorph markers/,$d' "$tmp/rigid.basis" >"$tmp/unnamed.basis"
refuses "a basis without names" 3 'the file has no names of markers; solve the basis again' morph "$box" \
    "$tmp/unnamed.basis" --move "$no_moves"
{ cat "$tmp/unnamed.basis"; printf 'harmorph markers 5\nblock\nhigh\nin:l'; } >"$tmp/cut.basis"
refuses "a basis with its names cut off" 3 'it has 2 names of markers, but must have 5' morph "$box" "$tmp/cut.basis" \
    --move "$no_moves"
refuses "messages name markers: periodic" 2 \
    "must not have a condition of its own (marker 0 is 'block', marker 3 is 'low')" \
    solve "$box" --rigid block --periodic low:block -o "$tmp/x"
refuses "messages name markers: one piece" 2 "must form one connected line that is not closed (marker 0 is 'block')" \
    solve "$box" --rigid high \
    --periodic block:low -o "$tmp/x"
