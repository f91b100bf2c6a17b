# Functions of a coarse mesh, interpolated to a finer one, as the paper proposes. Part of run.sh.
echo "== Functions of a coarse mesh, interpolated to a finer mesh"
echo "The paper proposes to solve on a coarse mesh and to interpolate the functions to a fine one. Meshes are O-meshes"
echo "of quadrilaterals round an ellipse; the ellipse is a periodic cubic B-spline with 12 control points. The error is"
echo "the largest difference from the functions that were solved on the fine mesh. It falls with the coarse mesh size,"
echo "and the wall follows the B-spline exactly on each mesh. Gain: seconds to solve on the fine mesh divided by"
echo "seconds to solve on the coarse mesh and to interpolate (analysis of the fine mesh included in both)."
o_mesh() {   # POINTS_AROUND LAYERS: an SU2 file; the first layer is finer by the number of layers
    awk -v around="$1" -v layers="$2" -v first="$(awk -v n="$2" 'BEGIN { print 4 / n }')" -v shift=0 -v circle=1.5 \
        -f "$here/../compare/o_mesh.awk"
}
difference() {   # BASIS OTHER: largest difference of four functions on the fine mesh
    for function in 1 2 5 10; do
        run export "$out/fine.su2" "$1" --function $function --csv "$out/one.csv"
        run export "$out/fine.su2" "$2" --function $function --csv "$out/other.csv"
        paste -d, "$out/one.csv" "$out/other.csv"
    done | awk -F, '/^[0-9]/ { d = $4 - $8; if (d < 0) d = -d; if (d > worst) worst = d } END { printf "%.2g", worst }'
}
solve_on() {   # NAME
    run solve "$out/$1.su2" --curve airfoil="$out/wall.curve" --operator laplace -o "$out/$1.basis" --json
    cp "$out/log" "$out/json"
}
seconds() {   # NAMES...: their sum
    for name in "$@"; do sed -n "s/.*\"$name\": \([^,}]*\).*/\1/p" "$out/json"; done |
        awk '{ sum += $1 } END { print sum }'
}
o_mesh 512 128 >"$out/fine.su2"
run fit "$out/fine.su2" --marker airfoil --closed periodic --points 12 -o "$out/wall.curve"
solve_on fine
fine=$(seconds setup_seconds factor_seconds solve_seconds)
echo "table Functions on 512 x 128 cells, interpolated from coarser meshes"
printf '%-12s  %10s  %10s  %8s\n' "coarse cells" error "ratio" gain
last=
for n in 64 128 256; do
    o_mesh $n $((n / 4)) >"$out/coarse.su2"
    solve_on coarse
    coarse=$(seconds setup_seconds factor_seconds solve_seconds)
    run transfer "$out/coarse.su2" "$out/coarse.basis" "$out/fine.su2" -o "$out/transferred.basis" --json
    cp "$out/log" "$out/json"
    error=$(difference "$out/fine.basis" "$out/transferred.basis")
    printf '%-12s  %10s  %10s  %8s\n' "$n x $((n / 4))" "$error" \
        "$(awk -v a="${last:-0}" -v b="$error" 'BEGIN { if (a) printf "%.1f", a / b; else print "-" }')" \
        "$(awk -v a="$fine" -v b="$coarse" -v c="$(seconds analysis_seconds transfer_seconds)" \
            'BEGIN { printf "%.1f", a / (b + c) }')"
    awk -v a="${last:-1}" -v b="$error" 'BEGIN { exit !(b < a / 2) }' || fail "the error must fall with the mesh size"
    last=$error
done
echo
rm -f "$out/fine.su2" "$out/coarse.su2" "$out"/*.csv
