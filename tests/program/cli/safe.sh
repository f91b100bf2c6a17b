# Movements that are too large for one step: `harmorph morph --safe` and its options.

turn 3 4.5 >"$tmp/away.txt"
refuses "a large turn" 1 'admissible' morph "$box" "$tmp/conformal.basis" --move "$tmp/turn150.txt" -o "$tmp/turned.su2"
runs "--safe: a large turn" 0 morph "$box" "$tmp/conformal.basis" --move "$tmp/turn150.txt" --safe \
    -o "$tmp/turned.su2" --json
has_keys "--safe: keys" inverted self_crossing boundary_error min_quality mean_quality morph_seconds step_fraction \
    steps resolves strategy last_step_admissible heights reached_moves $safe_keys moved_curve
check "--safe: the whole way" says '"step_fraction": 1,'
check "--safe: nothing inverted" says '"inverted": 0'
check "--safe: not by the linear morph" sh -c "! grep -q '\"strategy\": \"linear\"' '$tmp/out'"
check "--safe: in a stack of 64 KiB" sh -c "ulimit -s 64 && exec '$harmorph' morph '$box' '$tmp/conformal.basis' \
    --move '$tmp/turn150.txt' --safe -o '$tmp/small_stack.su2'"
check "--safe: in a stack of 64 KiB: the same mesh" cmp "$tmp/turned.su2" "$tmp/small_stack.su2"
runs "--safe: check of the result" 0 check "$tmp/turned.su2"
check "--safe: the block is where it should be" near $(place 8 6 "$tmp/turned.su2") \
    $(awk 'BEGIN { a = atan2(0, -1) * 5 / 6; printf "%.17g %.17g", 6 + 2 * cos(a), 6 + 2 * sin(a) }')
quality() { sed -n 's/.*"mean_quality": \([0-9.e-]*\).*/\1/p' "$tmp/out"; }
poorer=$(runs "--safe: before --improve" 0 morph "$box" "$tmp/conformal.basis" --move "$tmp/turn60.txt" --safe \
    --skip improved --json >/dev/null; quality)
runs "--improve" 0 morph "$box" "$tmp/conformal.basis" --move "$tmp/turn60.txt" --safe --improve -o "$tmp/better.su2" \
    --json
better=$(quality)
check "--improve: better on average" awk "BEGIN { exit !($better > $poorer) }"
check "--improve: nothing inverted" says '"inverted": 0'
runs "--improve: check of the result" 0 check "$tmp/better.su2"
runs "--improve of a mesh that does not move" 0 morph "$box" "$tmp/conformal.basis" --move "$no_moves" --improve \
    -o "$tmp/same.su2"
check "--improve of a mesh that does not move: the same file" cmp "$box" "$tmp/same.su2"
runs "--safe: a small move" 0 morph "$box" "$tmp/conformal.basis" --move "$tmp/turn3.txt" --safe --json
check "--safe: a small move: linear" says '"strategy": "linear"'
check "--safe: a small move: worst cells with their places" grep -E \
    '"worst_cells": \[\{"cell": [0-9]+, "quality": [^,]*, "start_quality": 1, "x": ' "$tmp/out"
runs "--min-quality: missed, with a warning" 0 morph "$box" "$tmp/conformal.basis" --move "$tmp/turn150.txt" --safe \
    --min-quality 0.99 -o "$tmp/poor.su2"
check "--min-quality: the warning names a cell and its place" grep -E 'smallest quality is .*: cell [0-9]+ at \(' \
    "$tmp/err"
refuses "--strict" 1 "less than was asked for: cell" morph "$box" "$tmp/conformal.basis" --move "$tmp/turn150.txt" \
    --safe --min-quality 0.99 --strict -o "$tmp/strict.su2"
leaves_nothing "--strict: nothing written" "$tmp/strict.su2"
# The program judges the mesh that it writes.
for asked in .1 .3 .5 .6 .7 .8 .9; do
    "$harmorph" morph "$box" "$tmp/conformal.basis" --move "$tmp/turn150.txt" --safe --improve --json --strict \
        --min-quality $asked >"$tmp/out" 2>"$tmp/err"
    code=$?
    check "--improve --strict --min-quality $asked: exit code $code and the final quality agree" awk \
        -v found="$(number min_quality)" -v start="$(number start_quality | head -n 1)" -v asked=$asked -v code=$code \
        'BEGIN { exit (found < asked * start) != code }'
done
makes morph "$box" "$tmp/conformal.basis" --move "$tmp/turn150.txt" --safe --improve --json
alone=$(number min_quality)
runs "--heights --improve" 0 morph "$box" "$tmp/conformal.basis" --move "$tmp/turn150.txt" --safe \
    --improve --heights --json
check "--heights --improve: not below --improve alone" awk "BEGIN { exit !($(number min_quality) >= $alone) }"
runs "--safe --operator auto" 0 morph "$box" "$tmp/conformal.basis" --move "$tmp/turn150.txt" --safe \
    --operator auto --json
check "--safe --operator auto: both are reported" says '"operators": [{"operator": '
# The automatic choice is not worse than either operator, for movements of one control point, along and across the wall,
# and of many.
automatic() {   # MESH MARKER, movements in files
    mesh=$1 marker=$2
    shift 2
    makes fit "$mesh" --marker "$marker" --points 14 -o "$tmp/auto.curve"
    for operator in laplace conformal; do
        makes solve "$mesh" --curve "$marker=$tmp/auto.curve" --operator $operator -o "$tmp/auto_$operator.basis"
    done
    for move; do
        for operator in laplace conformal auto; do
            makes morph "$mesh" "$tmp/auto_${operator#auto}$([ $operator = auto ] && echo conformal).basis" \
                --move "$move" --safe $([ $operator = auto ] && echo --operator auto) --json
            eval "$operator=$(grep -o '"min_quality": [^,]*' "$tmp/out" | head -n 1 | sed 's/.*: //')"
        done
        check "--safe --operator auto: $(basename "$mesh"), ${move##*/}: not worse than laplace or conformal" \
            awk "BEGIN { exit !($auto >= $laplace && $auto >= $conformal) }"
    done
}
echo '4 .08 0' >"$tmp/along"
echo '4 0 -.1' >"$tmp/across"
echo '9 .03 .06' >"$tmp/oblique"
awk 'BEGIN { for (k = 2; k < 14; ++k) print k, 0, .02 * sin(k) }' >"$tmp/wavy"
automatic "$meshes/naca0012.su2" airfoil "$tmp/along" "$tmp/across" "$tmp/oblique" "$tmp/wavy"
automatic "$meshes/cascade.su2" blade "$tmp/along" "$tmp/across" "$tmp/oblique" "$tmp/wavy"
refuses "--operator without --safe" 2 '--operator needs --safe' morph "$box" "$tmp/conformal.basis" \
    --move "$no_moves" --operator auto
refuses "morph --operator laplace" 2 '--operator of this command must be auto' morph "$box" "$tmp/conformal.basis" \
    --move "$no_moves" --safe --operator laplace
refuses "solve --operator auto" 2 'only for displace' solve "$box" --rigid block --operator auto -o "$tmp/x"
# A basis of Laplace functions that stops short of the target: conformal functions are tried, too.
makes fit "$meshes/cascade.su2" --marker blade --points 20 -o "$tmp/blade.curve"
makes solve "$meshes/cascade.su2" --curve blade="$tmp/blade.curve" --periodic lower:upper --operator laplace \
    -o "$tmp/stuck.basis"
awk '/^points/ { n = $2; next } n-- > 0 { printf "%d 0 %.17g\n", ++k, -.5 * 4 * $1 * (1 - $1) }' "$tmp/blade.curve" \
    >"$tmp/camber.txt"
runs "--safe by Laplace functions that are stuck" 0 morph "$meshes/cascade.su2" "$tmp/stuck.basis" \
    --move "$tmp/camber.txt" --safe -o "$tmp/cambered.su2"
check "--safe by Laplace functions: all of the way" says '100 % of the way in'
check "--safe by Laplace functions: by conformal ones" grep -E '^operator  *conformal: 100 %' "$tmp/out"
check "--safe by Laplace functions: how far those came" grep -E '^not  *laplace: ' "$tmp/out"
runs "--safe by Laplace functions: check of the result" 0 check "$tmp/cambered.su2"
for bad in 1.5 -0.1 nan good; do
    refuses "--min-quality $bad" 2 '--min-quality' morph "$box" "$tmp/conformal.basis" --move "$no_moves" --safe \
        --min-quality=$bad
done
refuses "--max-height-change 1" 2 '--max-height-change' morph "$box" "$tmp/conformal.basis" --move "$no_moves" --safe \
    --max-height-change 1
refuses "--strict without --safe" 2 '--strict' morph "$box" "$tmp/conformal.basis" --move "$no_moves" --strict
: >"$tmp/empty.txt"
refuses "an empty file of moves" 3 'empty.txt:1: the file of moves is empty' morph "$box" "$tmp/conformal.basis" \
    --move "$tmp/empty.txt"
runs "--safe for people" 0 morph "$box" "$tmp/conformal.basis" --move "$tmp/turn150.txt" --safe
check "--safe for people: strategy" says 'strategy:'
runs "--other" 0 morph "$box" "$tmp/laplace.basis" --move "$tmp/turn60.txt" --safe --other "$tmp/conformal.basis" \
    --skip improved --json
check "--other: helps" says '"strategy": "other"'
refuses "--other of other conditions" 3 'other bases' morph "$box" "$tmp/conformal.basis" --move "$tmp/turn40.txt" \
    --safe --other "$tmp/rigid.basis"
refuses "--other of another mesh" 3 "$basis" morph "$box" "$tmp/conformal.basis" --move "$tmp/turn40.txt" --safe \
    --other "$basis"
runs "--safe --reached" 0 morph "$box" "$tmp/rigid.basis" --move "$tmp/rigid.txt" --safe --reached "$tmp/rigid.reached"
check "--safe --reached: a body's movement" awk '$1 == "rigid" { n++; ok = $2 == "block" &&
    ($3 - .5) ^ 2 + ($4 + .25) ^ 2 < 1e-24 &&
    ($5 - 90) ^ 2 < 1e-20 && ($6 - 1.25) ^ 2 < 1e-24 } END { exit !(ok && n == 1) }' "$tmp/rigid.reached"
refuses "--reached without --safe" 2 '--reached' morph "$box" "$tmp/conformal.basis" --move "$no_moves" \
    --reached "$tmp/x"
refuses "--safe: a boundary that crosses itself" 1 'crosses itself' morph "$box" "$tmp/conformal.basis" \
    --move "$tmp/away.txt" --safe -o "$tmp/away.su2"
leaves_nothing "--safe: a boundary that crosses itself: nothing written" "$tmp/away.su2"
runs "--safe: a boundary that crosses itself, --json" 1 morph "$box" "$tmp/conformal.basis" --move "$tmp/away.txt" \
    --safe --json
check "--safe: a boundary that crosses itself: nothing moved, nothing is off" says '"boundary_error": 0,'
turn 0 30 >"$tmp/outside.txt" # through the side and out of the square
refuses "--safe: out of the domain" 1 'outside the boundary' morph "$box" "$tmp/conformal.basis" \
    --move "$tmp/outside.txt" --safe
turn 150 3.767949192 >"$tmp/outside.txt" # but for 4e-10 at the side: no step of several, nor untangling, gets there
refuses "--safe: short of the target" 1 'farther on have a smaller quality than was asked for' morph "$box" \
    "$tmp/conformal.basis" --move "$tmp/outside.txt" --safe -o "$tmp/outside.su2" --json
has_keys "--safe: short of the target: JSON all the same" inverted self_crossing boundary_error min_quality \
    mean_quality \
    morph_seconds step_fraction steps resolves strategy last_step_admissible heights reached_moves \
    $safe_keys moved_curve
leaves_nothing "--safe: short of the target: nothing written" "$tmp/outside.su2"
runs "--safe: short of the target, --force" 1 morph "$box" "$tmp/conformal.basis" --move "$tmp/outside.txt" --safe \
    --force -o "$tmp/outside.su2" --json
check "--safe: short of the target: only part of the way" grep -E '"step_fraction": 0\.[0-9]*[1-9]' "$tmp/out"
check "--safe: short of the target: the boundary is the B-spline's, as far as it went" \
    grep -E '"boundary_error": ([0-9.]*e-1[5-9]|0),' "$tmp/out"
check "--safe: short of the target, --force: the moves that it has" \
    says "\"reached_moves\": \"$tmp/outside.su2.reached\""
runs "--safe: the reached moves are read by morph" 0 morph "$box" "$tmp/conformal.basis" \
    --move "$tmp/outside.su2.reached" --safe -o "$tmp/reached.su2"
for corner in "4 5" "8 5" "8 7" "4 7"; do
    check "--safe: the reached moves put the block where the mesh has it ($corner)" \
        near $(place $corner "$tmp/reached.su2") $(place $corner "$tmp/outside.su2")
done
runs "--safe: short of the target, --force: the last valid mesh" 0 check "$tmp/outside.su2"
check "--safe: short of the target, --force: which moved" sh -c "! cmp -s '$box' '$tmp/outside.su2'"
