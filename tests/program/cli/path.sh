# The path from a mesh to a morphed one: check, fit, solve, morph, export; with engines, schemes, pictures, and in
# single precision.

runs "check" 0 check "$ring" --json
has_keys "check: keys" points cells triangles quads polygons inverted min_area min_quality mean_quality markers pieces
check "check: counts" says '"points": 624, "cells": 624, "triangles": 96, "quads": 528, "polygons": 0, "inverted": 0'
check "check: markers" says '"markers": [{"name": "body", "faces": 48}, {"name": "far", "faces": 48}]'
runs "fit" 0 fit "$ring" --marker=body --points 12 --closed periodic -o "$curve" --json
has_keys "fit: keys" points degree closed corners base_points backtracks max_error rms_error max_departure elements \
    layout
check "fit: periodic file" grep -c 'closed periodic' "$curve"
runs "solve" 0 solve "$ring" --curve body="$curve" -o "$basis" --json --repeat 2
has_keys "solve: keys" points cells functions boundary_error partition_defect min_value max_value residual \
    iterations work levels engine setup_seconds factor_seconds solve_seconds plan_bytes basis_bytes storage
check "solve: functions" says '"functions": 12'
for engine in "multigrid" "fas --agglomeration directional"; do
    options=$engine engine=${engine%% *}
    runs "solve: $engine" 0 solve "$ring" --curve body="$curve" --operator laplace --engine $options --levels 3 \
        --history "$tmp/$engine.csv" -o "$tmp/$engine.basis" --json
    check "solve: $engine: its levels" says '"levels": 3'
    check "solve: $engine: history from 1 to the tolerance" awk -F, 'NR == 1 { ok = $0 == "cycle,residual" }
        NR > 1 { ok = ok && $1 == NR - 2 && (NR > 2 || ($2 > .999 && $2 < 1.001)); last = $2 }
        END { exit !(ok && last <= 1e-10) }' \
        "$tmp/$engine.csv"
done
runs "export: a level" 0 export "$ring" "$tmp/fas.basis" --level 1 --svg "$tmp/level.svg"
check "export: a level: SVG is whole" grep -c '</svg>' "$tmp/level.svg"
refuses "export: a level that does not exist" 2 'no level' export "$ring" "$tmp/fas.basis" --level 19 \
    --svg "$tmp/none.svg"
refuses "an engine that does not go with the operator" 2 'the conformal operator needs the direct engine' \
    solve "$ring" --curve body="$curve" --engine fas -o "$tmp/none.basis"
refuses "unknown engine" 2 'direct, multigrid, fas' solve "$ring" --curve body="$curve" --engine fast \
    -o "$tmp/none.basis"
runs "solve: fas from zero" 0 solve "$ring" --curve body="$curve" --operator laplace --engine fas --start zero \
    -o "$tmp/fas.basis"
refuses "a start of an engine that has none" 2 '--start' solve "$ring" --curve body="$curve" --operator laplace \
    --engine multigrid --start zero -o "$tmp/none.basis"
refuses "agglomeration without an engine that merges cells" 2 '--agglomeration needs --engine fas' \
    solve "$ring" --curve body="$curve" --operator laplace --engine multigrid --agglomeration isotropic \
    -o "$tmp/none.basis"
refuses "levels without an engine that has them" 2 '--levels' solve "$ring" --curve body="$curve" --levels 3 \
    -o "$tmp/none.basis"
leaves_nothing "refused engines leave no file" "$tmp/none.basis"
runs "morph" 0 morph "$ring" "$basis" --move "$tmp/small.txt" -o "$tmp/small.su2" --vtu "$tmp/small.vtu" \
    --svg "$tmp/small.svg" --repeat 3 --json
has_keys "morph: keys" inverted admissible_step boundary_step self_crossing boundary_error min_quality mean_quality \
    morph_seconds moved_curve
check "morph: the mesh is valid" says '"inverted": 0'
check "morph: the mesh moved" sh -c "! cmp -s '$ring' '$tmp/small.su2'"
check "morph: VTU is whole" grep -c '</VTKFile>' "$tmp/small.vtu"
check "morph: SVG is whole" grep -c '</svg>' "$tmp/small.svg"
runs "morph without files, for people" 0 morph "$ring" "$basis" --move "$tmp/small.txt"
runs "check of the morphed mesh" 0 check "$tmp/small.su2"
runs "zero move" 0 morph "$ring" "$basis" --move "$no_moves" -o "$tmp/same.su2" --json
check "zero move: the identical file" cmp "$ring" "$tmp/same.su2"
check "zero move: unlimited step is null" says '"admissible_step": null'
runs "a moved mesh only warns" 0 morph "$tmp/small.su2" "$basis" --move "$no_moves"
check "a moved mesh only warns: says so" says 'warning'
for kept in 5 100 4000; do
    head -c $kept "$basis" >"$tmp/short.basis"
    refuses "a basis file cut off after $kept bytes" \
        3 "short.basis: the file is cut off: it has $kept bytes, but at least" \
        morph "$ring" "$tmp/short.basis" --move "$no_moves"
done
: >"$tmp/short.basis"
refuses "an empty basis file" 3 'short.basis: the data are not a harmorph basis' morph "$ring" "$tmp/short.basis" \
    --move "$no_moves"
refuses "a mesh for a basis" 3 'the data are not a harmorph basis' morph "$ring" "$ring" --move "$no_moves"
runs "export" 0 export "$ring" "$basis" --function 12 --csv "$tmp/f.csv" --vtu "$tmp/f.vtu" --svg "$tmp/f.svg"
check "export: CSV columns" sh -c "head -1 '$tmp/f.csv' | grep -Eqx 'point,x,y,(value,imaginary|xx,xy,yx,yy)'"
check "export: CSV lines" test "$(wc -l <"$tmp/f.csv")" -eq 625
refuses "export: function out of range" 2 '--function' export "$ring" "$basis" --function 13 --csv "$tmp/f.csv"
refuses "export: nothing to write" 2 'nothing to write' export "$ring" "$basis" --function 1
runs "solve with a free boundary" 0 solve "$ring" --curve body="$curve" --free far --operator laplace \
    -o "$tmp/free.basis"
runs "solve, bounded" 0 solve "$ring" --curve body="$curve" --operator laplace --scheme bounded \
    -o "$tmp/bounded.basis" --json
check "solve, bounded: no value below 0" says '"min_value": 0,'
runs "solve, nodal gradients" 0 solve "$ring" --curve body="$curve" --operator laplace --scheme nodal-gradient \
    -o "$tmp/nodal.basis"
runs "solve, nodal gradients by the paper's iteration" 0 solve "$ring" --curve body="$curve" --operator laplace \
    --scheme nodal-gradient --engine fas -o "$tmp/nodal.basis"
refuses "nodal gradients without correction go with fas" 2 'needs the engine fas' solve "$ring" \
    --curve body="$curve" --operator laplace --scheme nodal-gradient-plain -o "$tmp/x"
refuses "the bounded scheme has no conformal operator" 2 'the conformal operator needs the compact scheme' \
    solve "$ring" --curve body="$curve" --scheme bounded -o "$tmp/x"
runs "solve twice" 0 solve "$ring" --curve body="$curve" -o "$tmp/again.basis"
check "solve twice: equal files" cmp "$basis" "$tmp/again.basis"
refuses "a marker with two conditions" 2 'two conditions' solve "$ring" --curve body="$curve" --free body -o "$tmp/x"
runs "solve: two curve files" 0 fit "$ring" --marker far --points 8 -o "$tmp/far.curve"
runs "solve: two curve files" 0 solve "$ring" --curve body="$curve" --curve far="$tmp/far.curve" -o "$tmp/two.basis" \
    --json
check "solve: numbers go on" says '"functions": 20'
runs "--storage single" 0 solve "$ring" --curve body="$curve" -o "$tmp/single.basis" --storage single --json
check "--storage single: says so" says '"storage": "single"'
check "--storage single: a smaller file" test "$(wc -c <"$tmp/single.basis")" -lt "$(($(wc -c <"$basis") * 2 / 3))"
runs "--storage single: morph" 0 morph "$ring" "$tmp/single.basis" --move "$tmp/small.txt" -o "$tmp/single.su2" --json
check "--storage single: the wall moves as the B-spline" grep -E '"boundary_error": ([0-9.]*e-1[5-9]|0)' "$tmp/out"
runs "--storage single: zero move" 0 morph "$ring" "$tmp/single.basis" --move "$no_moves" -o "$tmp/same.su2"
check "--storage single: zero move: the same file" cmp "$ring" "$tmp/same.su2"
runs "--storage single: export" 0 export "$ring" "$tmp/single.basis" --function 2 --csv "$tmp/single.csv"
refuses "--storage single: not with --safe" 2 'single precision' morph "$ring" "$tmp/single.basis" \
    --move "$tmp/small.txt" --safe
refuses "--storage: what there is" 2 'double, single' solve "$ring" --curve body="$curve" -o "$tmp/x" --storage half

# Pictures.
runs "morph: pictures" 0 morph "$ring" "$basis" --move "$tmp/small.txt" --svg "$tmp/whole.svg" --window -4,-4,4,4 \
    --boundary-svg "$tmp/boundary.svg"
check "morph: the window shows the far field" test "$(wc -c <"$tmp/whole.svg")" -gt "$(wc -c <"$tmp/small.svg")"
check "morph: the boundary picture has a circle for each point" test "$(grep -c '<circle.*r="3.2"' \
    "$tmp/boundary.svg")" -gt 47
for window in 1,2,3 1,2,3,4,5 1,1,1,2 2,0,1,1 a,b,c,d ,,,; do
    refuses "a window $window" 2 '--window expects' export "$ring" "$basis" --function 1 --svg "$tmp/x" --window $window
done
