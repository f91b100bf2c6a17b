# Convergence histories of the iterations of the paper, against cycles and against work. Part of run.sh.
echo "== How the residual falls, cycle by cycle"
echo "The residual is the largest relative one of all functions (compact scheme). The work of a cycle is the same for"
echo "all cycles of an iteration; the start from the coarsest level (FMG) is work before the first cycle."
# history NAME OPTIONS...: lines "NAME cycle work residual" of one solution
history() {
    name=$1; shift
    "$harmorph" solve "$mesh" $conditions --operator laplace --tol 1e-10 --engine fas "$@" --json --force \
        --history "$out/history.csv" -o "$out/history.basis" >"$out/json" 2>"$out/log" ||
        fail "$name: $(cat "$out/log")"
    awk -F, -v name="$name" -v work="$(number work)" -v cycles="$(number iterations)" -v per_cycle="$per_cycle" '
        BEGIN { if (per_cycle == "") per_cycle = work / cycles; start = work - cycles * per_cycle }
        NR > 1 { printf "%s,%s,%.6g,%s\n", name, $1, $1 == 0 ? 0 : start + $1 * per_cycle, $2 }' "$out/history.csv" \
        >>"$out/histories.csv"
}
# histories LETTER TITLE MESH CONDITIONS
histories() {
    letter=$1 title=$2 mesh=$meshes/$3.su2 conditions=$4
    rm -f "$out/histories.csv"
    per_cycle= history "single grid" --levels 1
    for agglomeration in isotropic directional; do
        for cycle in paper improved; do
            prefix= choice="--agglomeration $agglomeration --cycle $cycle"
            if [ $cycle = improved ]; then prefix="improved "; fi
            per_cycle= history "${prefix}FAS $agglomeration" $choice --start zero
            # The cycles of FMG-FAS cost the same as those of FAS; the rest of the work is the start.
            per_cycle=$(awk -v work="$(number work)" -v cycles="$(number iterations)" 'BEGIN { print work / cycles }') \
                history "${prefix}FMG-FAS $agglomeration" $choice
        done
    done
    awk -f "$here/histories.awk" -v title="$title" "$out/histories.csv" >"$out/histories-$letter.svg"
    figure "histories-$letter.svg" "Figure $letter | The residual against cycles and against work on $title. Dashed" \
        "lines belong to directional agglomeration. The single grid goes on beyond the right edge of the left panel."
}
histories L "case 1" two_bodies "$two_bodies"
histories M "case 2" diffuser_airfoil "$airfoil"
histories N "the diffuser" axisymmetric_diffuser "$diffuser"
rm -f "$out"/history.* "$out/histories.csv"
