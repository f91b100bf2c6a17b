# All cases by all schemes and engines, and what the number of levels does. Part of run.sh.

# The functions of one row: solved as asked for, then compared with the direct engine's of the same and of the compact
# scheme, whose tables are kept for a case. Sets status (0 solved, 1 not converged), off_scheme and off_compact.
solve_row() {   # SCHEME OPTIONS...
    scheme=$1; shift
    "$harmorph" solve "$mesh" $conditions --operator laplace --scheme $scheme --tol 1e-10 "$@" --json --force \
        -o "$out/table.basis" >"$out/json" 2>"$out/log"
    status=$? off_scheme=- off_compact=-
    if [ $status -gt 1 ]; then return; fi
    for function in $(seq "$(number functions)"); do
        run export "$mesh" "$out/table.basis" --function "$function" --csv "$out/table-$function.csv"
    done
    case " $* " in *" direct "*)
        for file in "$out"/table-*.csv; do cp "$file" "$out/direct-$scheme-${file##*-}"; done ;;
    esac
    if [ -f "$out/direct-$scheme-1.csv" ]; then off_scheme=$(largest_difference $scheme); fi
    off_compact=$(largest_difference compact)
}
largest_difference() {   # from the direct engine's functions by this scheme
    for function in $(seq "$(number functions)"); do
        paste -d, "$out/table-$function.csv" "$out/direct-$1-$function.csv"
    done |
        awk -F, '/^[0-9]/ { d = $4 - $8; if (d < 0) d = -d; if (!(d <= worst)) worst = d } END { printf "%.2g", worst }'
}
smaller() { printf '%s\n' "$@" | sort -g | sed q; }
larger() { printf '%s\n' "$@" | sort -gr | sed q; }
farthest=0 least=
remember() { if [ "$off_scheme" != - ] && [ $status = 0 ]; then farthest=$(larger "$farthest" "$off_scheme"); fi; }

echo "== All cases by all schemes and engines, to a relative residual of 1e-10"
echo "Each row solves all functions of a case with harmonic functions. Cycles: cycles of FAS, or steps of Runge-Kutta"
echo "and of conjugate gradients, the most of any function. Sweeps are those over the finest mesh in these: Runge-Kutta"
echo "steps of four stages, or symmetric Gauss-Seidel. An engine whose row is missing for a scheme does not take that"
echo "scheme."
columns='%-10s  %-22s  %-16s  %7s  %7s  %9s  %9s  %21s  %22s  %s\n'
row() {   # SCHEME NAME OPTIONS...
    scheme=$1 engine=$2; shift 2
    solve_row $scheme "$@"
    if [ $status -gt 1 ]; then fail "$case, $scheme, $engine: $(cat "$out/log")"; return; fi
    remember
    remark=converged
    if [ $status = 1 ]; then remark="not converged"; fi
    cycles=$(number iterations) sweeps=$(number sweeps)
    if [ "$engine" = direct ]; then cycles=- sweeps=-; fi
    printf "$columns" "$case" "$scheme" "$engine" "$cycles" "$sweeps" "$(number residual)" "$(number solve_seconds)" \
        "$off_scheme" "$off_compact" "$remark"
}
all_engines() {   # NAME MESH CONDITIONS
    case=$1 mesh=$meshes/$2.su2 conditions=$3
    rm -f "$out"/direct-*.csv
    for scheme in compact bounded nodal-gradient nodal-gradient-plain; do
        if [ $scheme != nodal-gradient-plain ]; then row $scheme direct --engine direct; fi
        if [ $scheme = bounded ]; then continue; fi
        if [ $scheme = compact ]; then row $scheme "multigrid-CG" --engine multigrid; fi
        row $scheme "single-grid RK4" --engine fas --levels 1
        row $scheme "FAS" --engine fas --start zero
        row $scheme "FMG-FAS" --engine fas
    done
}
echo "table Three cases, four schemes, five engines: largest differences from the direct engine's functions by the" \
    "same and by the compact scheme"
printf "$columns" case scheme engine cycles sweeps residual seconds "from direct, same" "from direct, compact" result
all_engines two-bodies two_bodies "$two_bodies"
all_engines airfoil diffuser_airfoil "$airfoil"
all_engines diffuser axisymmetric_diffuser "$diffuser"
echo
awk -v off="$farthest" 'BEGIN { exit !(off <= 1e-8) }' ||
    fail "engines must agree to 1e-8 on one scheme, and differ by $farthest"
echo "No engine that converged is farther than $farthest from the direct engine's functions by the same scheme."

echo "== What the number of levels and the kind of agglomeration do (compact scheme)"
echo "Agglomeration ends at 48 volumes: \"4 of 6\" is 4 where 6 levels were asked for. Fewer: how many times fewer"
echo "sweeps than Runge-Kutta's on a single grid."
level_columns='%-10s  %-14s  %-12s  %8s  %7s  %7s  %6s  %9s  %9s\n'
level_row() {   # ENGINE AGGLOMERATION LEVELS OPTIONS...
    engine=$1 agglomeration=$2 asked=$3; shift 3
    solve_row compact --levels "$asked" "$@"
    if [ $status -gt 1 ]; then fail "$case, $engine, $asked levels: $(cat "$out/log")"; return; fi
    remember
    sweeps=$(number sweeps) levels=$(number levels) fewer=-
    if [ "$asked" = 1 ]; then single=$sweeps; else
        fewer=$(awk -v a="$single" -v b="$sweeps" 'BEGIN { printf "%.1f", a / b }')
        least=$(smaller "${least:-$fewer}" "$fewer")
    fi
    if [ "$asked" != "$levels" ]; then levels="$levels of $asked"; fi
    printf "$level_columns" "$case" "$engine" "$agglomeration" "$levels" "$(number iterations)" "$sweeps" "$fewer" \
        "$(number residual)" "$(number solve_seconds)"
}
all_levels() {   # NAME MESH CONDITIONS
    case=$1 mesh=$meshes/$2.su2 conditions=$3
    rm -f "$out"/direct-*.csv
    solve_row compact --engine direct
    level_row "Runge-Kutta" - 1 --engine fas
    for agglomeration in isotropic directional; do
        for asked in 2 3 4 5 6; do
            choice="--agglomeration $agglomeration"
            level_row FAS $agglomeration $asked --engine fas $choice --start zero
            level_row FMG-FAS $agglomeration $asked --engine fas $choice
            level_row multigrid-CG $agglomeration $asked --engine multigrid $choice
        done
    done
}
echo "table Two to six levels, merged in all directions alike and along the strongest couplings"
printf "$level_columns" case engine agglomeration levels cycles sweeps fewer residual seconds
all_levels two-bodies two_bodies "$two_bodies"
all_levels airfoil diffuser_airfoil "$airfoil"
all_levels diffuser axisymmetric_diffuser "$diffuser"
echo
echo "Multigrid takes $least times fewer sweeps than Runge-Kutta alone, or more; no function is farther than" \
    "$farthest from the direct engine's."
awk -v least="$least" 'BEGIN { exit !(least >= 10) }' || fail "multigrid must save nine sweeps of ten"
awk -v off="$farthest" 'BEGIN { exit !(off <= 1e-8) }' || fail "engines must agree to 1e-8"

# Meshes from elsewhere: every SU2 file in the directory MESHES,
# with a curve through the first marker that is an airfoil's.
if [ -n "$MESHES" ]; then
    echo "== Engines on the meshes in $MESHES (compact scheme)"
    echo "table As above, with 20 control points"
    printf "$columns" case scheme engine cycles sweeps residual seconds "from direct, same" "from direct, compact" \
        result
    for mesh in "$MESHES"/*.su2; do
        case=$(basename "$mesh" .su2 | cut -c 1-12)
        marker=$(sed -n 's/^MARKER_TAG *= *\([^ \r]*\).*/\1/p' "$mesh" | grep -i airfoil | sed q)
        [ -n "$marker" ] || { echo "$mesh: no marker has airfoil in its name: left out"; continue; }
        run fit "$mesh" --marker "$marker" --degree 3 --points 20 -o "$out/fit.curve"
        conditions="--curve $marker=$out/fit.curve"
        rm -f "$out"/direct-*.csv "$out"/table-*.csv
        row compact direct --engine direct
        for agglomeration in auto directional; do
            for engine in multigrid fas; do
                row compact "$engine, $agglomeration" --engine $engine --agglomeration $agglomeration
            done
        done
    done
    echo
fi
rm -f "$out"/table-*.csv "$out"/direct-*.csv
