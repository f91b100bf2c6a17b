# Rigid bodies, their movements, and pieces of markers.

runs "--rigid" 0 solve "$box" --rigid block -o "$tmp/rigid.basis" --json
check "--rigid: functions" says '"functions": 2'
runs "--rigid: for people" 0 solve "$box" --rigid block -o "$tmp/rigid.basis"
check "--rigid: for people: nothing about control points" sh -c "! grep -E 'values|mesh from curve|point -1' '$tmp/out'"
check "--rigid: for people: how exact" says 'boundary error'
runs "--curve: for people" 0 solve "$box" $on_block -o "$tmp/x.people"
check "--curve: for people: values" says 'values  '
check "--curve: for people: distance" says 'mesh from curve'
rm -f "$tmp/x.people"
printf '# a body\nrigid block .5 -.25 90 1.25\n' >"$tmp/rigid.txt"
runs "--rigid: morph" 0 morph "$box" "$tmp/rigid.basis" --move "$tmp/rigid.txt" -o "$tmp/rigid.su2" --safe \
    --svg "$tmp/rigid.svg" --boundary-svg "$tmp/rigid-boundary.svg"
runs "--rigid: export" 0 export "$box" "$tmp/rigid.basis" --function 2 --svg "$tmp/rigid-turn.svg"
check "--rigid: pictures without a curve have a size" sh -c "! grep -E 'nan|inf' '$tmp'/rigid*.svg"
check "--rigid: turned and scaled about its middle, and moved" near $(place 4 5 "$tmp/rigid.su2") 7.75 3.25
printf 'rigid bl*k .5 -.25 90 1.25\n' >"$tmp/pattern.txt"
printf 'rigid loop:2 .5 -.25 90 1.25\n' >"$tmp/loop.txt"
for how in pattern loop; do
    runs "--rigid: morph by a $how" 0 morph "$box" "$tmp/rigid.basis" --move "$tmp/$how.txt" -o "$tmp/$how.su2" \
        --safe
    check "--rigid: morph by a $how: the same mesh" cmp "$tmp/rigid.su2" "$tmp/$how.su2"
done
runs "--rigid: a whole loop" 0 solve "$box" --rigid loop:2 -o "$tmp/loop.basis"
check "--rigid: a whole loop: the same basis" cmp "$tmp/rigid.basis" "$tmp/loop.basis"
runs "--rigid with a centre" 0 solve "$box" --rigid block=4,5 -o "$tmp/hinge.basis"
printf 'rigid block 0 0 20\n' >"$tmp/hinge.txt"
runs "--rigid with a centre: morph" 0 morph "$box" "$tmp/hinge.basis" --move "$tmp/hinge.txt" -o "$tmp/hinge.su2"
check "--rigid with a centre: it stays" near $(place 4 5 "$tmp/hinge.su2") 4 5
check "--rigid with a centre: the angle is in degrees" near $(place 8 5 "$tmp/hinge.su2") \
    "$(awk 'BEGIN { printf "%.17g", 4 + 4 * cos(atan2(0, -1) / 9) }')" '*'
# A mesh that was moved before: a body goes on from its place, and back to the mesh as it was.
printf 'rigid block .5 -.25 20 1.1\n' >"$tmp/there.txt"
makes morph "$box" "$tmp/rigid.basis" --move "$tmp/there.txt" -o "$tmp/there.su2"
back=$(awk 'BEGIN { printf "rigid block -.5 .25 -20 %.17g", 1 / 1.1 }')
runs "--rigid: back again" 0 morph "$tmp/there.su2" "$tmp/rigid.basis" --by "$back" -o "$tmp/back.su2"
points_of() { awk '/^NPOIN/ { on = 1; next } /^[A-Z]/ { on = 0 } on { print $1, $2 }' "$1"; }
same_places() { # same_places A B: the points of two meshes, to 1e-12
    points_of "$1" >"$tmp/a" && points_of "$2" | paste - "$tmp/a" | awk '
        function off(a, b) { return a - b > 1e-12 || b - a > 1e-12 }
        NF != 4 || off($1, $3) || off($2, $4) { exit 1 } END { exit NR < 100 }'
}
check "--rigid: back again: the mesh as it was" same_places "$tmp/back.su2" "$box"
runs "--rigid: a file and a line after it" 0 morph "$box" "$tmp/rigid.basis" --move "$tmp/there.txt" --by "$back" \
    -o "$tmp/none.su2"
check "--rigid: a file and a line after it: the mesh as it was" same_places "$tmp/none.su2" "$box"
refuses "--rigid: safely from a mesh that has moved" 1 'the mesh has moved since the basis was solved' \
    morph "$tmp/there.su2" "$tmp/rigid.basis" --by "$back" --safe -o "$tmp/x"
refuses "--rigid: a page of a mesh that has moved" 1 'rigid bodies have moved since the basis was solved' \
    explore "$tmp/there.su2" "$tmp/rigid.basis" -o "$tmp/x"
for centre in 4 4, ,5 4,5,6 x,y nan,0; do
    refuses "--rigid block=$centre" 2 '--rigid' solve "$box" --rigid block=$centre -o "$tmp/x"
done
bad_body() { # bad_body NAME LINE CONTENT
    printf "$3" >"$tmp/bad.txt"
    refuses "$1" 3 "$tmp/bad.txt:$2: " morph "$box" "$tmp/rigid.basis" --move "$tmp/bad.txt" -o "$tmp/x"
}
bad_body "moves: a body without an angle" 1 'rigid block 1 2\n'
bad_body "moves: a pattern without a marker" 2 '\nrigid x* 1 2 3\n'
bad_body "moves: a marker of no body" 2 '\nrigid low 1 2 3\n'
bad_body "moves: a body twice" 2 'rigid block 1 0 0\nrigid block 1 0 0\n'
bad_body "moves: an angle that is none" 1 'rigid block 1 0 right\n'
bad_body "moves: control points where there are none" 1 '1 0 0\n'
bad_body "moves: a body of scale 0" 1 'rigid block 1 0 0 0\n'
bad_body "moves: a body of a negative scale" 1 'rigid block 1 0 0 -1\n'

# Pieces: the lower and the upper side are one marker; only the one near (6, 9) slides.
sed -e 's/^MARKER_TAG= *high$/MARKER_TAG= low/' "$box" >"$tmp/sides.su2"
runs "a piece of a marker" 0 solve "$tmp/sides.su2" $on_block --slip low@6:9 -o "$tmp/piece.basis"
runs "a piece of a marker: morph" 0 morph "$tmp/sides.su2" "$tmp/piece.basis" --move "$tmp/turn40.txt" \
    -o "$tmp/piece.su2"
check "a piece of a marker: below is fixed" near $(place 5 0 "$tmp/piece.su2") 5 0
refuses "a piece of a marker, twice" 2 'have another condition' solve "$tmp/sides.su2" $on_block \
    --slip low@6:9,low@6:12 -o "$tmp/x"
refuses "a piece of an unknown marker" 2 "'top'" solve "$box" $on_block --slip top@6:9 -o "$tmp/x"
runs "--rigid, a piece" 0 solve "$box" --rigid block@6:4 -o "$tmp/piece.basis"
