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
larger() { printf '%s\n' "$@" | sort -gr | sed q; }
farthest=0
remember() { if [ "$off_scheme" != - ] && [ $status = 0 ]; then farthest=$(larger "$farthest" "$off_scheme"); fi; }

echo "== All cases by all schemes and engines, to a relative residual of 1e-10"
echo "Each row solves all functions of a case with harmonic functions. FAS and FMG-FAS are the iteration as the paper"
echo "describes it: V-cycles of the full approximation scheme with four-stage Runge-Kutta steps and local time steps,"
echo "from 0 or from the coarsest level. The improved iterations make W-cycles, smooth each correction and choose the"
echo "length of the correction; the paper has none of these. Cycles are those of FAS, or steps of Runge-Kutta and of"
echo "conjugate gradients: the largest number of any function. Work counts the products of the matrix and a vector on"
echo "all levels, in units of a Runge-Kutta step of four stages on the finest mesh. An engine that has no row for a"
echo "scheme cannot solve the equations of that scheme."
columns='%-18s  %-20s  %-16s  %7s  %7s  %9s  %9s  %21s  %22s  %s\n'
row() {   # SCHEME NAME OPTIONS...
    scheme=$1 engine=$2; shift 2
    solve_row $scheme "$@"
    if [ $status -gt 1 ]; then fail "$case, $scheme, $engine: $(cat "$out/log")"; return; fi
    remember
    remark=converged
    if [ $status = 1 ]; then remark="not converged"; fi
    cycles=$(number iterations) work=$(number work)
    if [ "$engine" = direct ]; then cycles=- work=-; fi
    printf "$columns" "$case" "$scheme" "$engine" "$cycles" "$work" "$(number residual)" "$(number solve_seconds)" \
        "$off_scheme" "$off_compact" "$remark"
}
all_engines() {   # NAME MESH CONDITIONS
    case=$1 mesh=$2 conditions=$3
    rm -f "$out"/direct-*.csv
    for scheme in compact bounded nodal-gradient nodal-gradient-plain; do
        if [ $scheme != nodal-gradient-plain ]; then row $scheme direct --engine direct; fi
        if [ $scheme = bounded ]; then continue; fi
        if [ $scheme = compact ]; then row $scheme "multigrid-CG" --engine multigrid; fi
        row $scheme "single-grid RK4" --engine fas --levels 1
        row $scheme "FAS" --engine fas --start zero
        row $scheme "FMG-FAS" --engine fas
        row $scheme "improved FAS" --engine fas --start zero --cycle improved
        row $scheme "improved FMG-FAS" --engine fas --cycle improved
    done
}
echo "table All cases, four schemes, seven engines: largest differences from the direct engine's functions by the" \
    "same and by the compact scheme"
printf "$columns" case scheme engine cycles work residual seconds "from direct, same" "from direct, compact" result
all_engines "case 1" $meshes/two_bodies.su2 "$two_bodies"
all_engines "case 2" $meshes/diffuser_airfoil.su2 "$airfoil"
all_engines "case 2, triangles" "$out/airfoil-triangles.su2" "$airfoil"
all_engines diffuser $meshes/axisymmetric_diffuser.su2 "$diffuser"
echo
awk -v off="$farthest" 'BEGIN { exit !(off <= 1e-8) }' ||
    fail "engines must agree to 1e-8 on one scheme, and differ by $farthest"
echo "No engine that converged is farther than $farthest from the direct engine's functions by the same scheme."

echo "== What the number of levels and the kind of agglomeration do (compact scheme)"
echo "Agglomeration ends at 48 volumes: \"4 of 6\" is 4 where 6 levels were asked for. Gain: the work of Runge-Kutta on"
echo "a single grid divided by the work of this row, which includes all levels."
level_columns='%-10s  %-16s  %-12s  %8s  %7s  %7s  %6s  %9s  %9s\n'
level_row() {   # ENGINE AGGLOMERATION LEVELS OPTIONS...
    engine=$1 agglomeration=$2 asked=$3; shift 3
    solve_row compact --levels "$asked" "$@"
    if [ $status -gt 1 ]; then fail "$case, $engine, $asked levels: $(cat "$out/log")"; return; fi
    remember
    work=$(number work) levels=$(number levels) gain=-
    if [ "$asked" = 1 ]; then single=$work; else
        gain=$(awk -v a="$single" -v b="$work" 'BEGIN { printf "%.1f", a / b }')
        echo "$engine $gain" >>"$out/gains"
    fi
    if [ "$asked" != "$levels" ]; then levels="$levels of $asked"; fi
    printf "$level_columns" "$case" "$engine" "$agglomeration" "$levels" "$(number iterations)" "$work" "$gain" \
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
            level_row "improved FMG-FAS" $agglomeration $asked --engine fas --cycle improved $choice
        done
    done
    for asked in 2 3 4 5 6; do level_row multigrid-CG - $asked --engine multigrid; done
}
echo "table Two to six levels, merged in all directions alike and along the strongest couplings"
printf "$level_columns" case engine agglomeration levels cycles work gain residual seconds
rm -f "$out/gains"
all_levels "case 1" two_bodies "$two_bodies"
all_levels "case 2" diffuser_airfoil "$airfoil"
all_levels diffuser axisymmetric_diffuser "$diffuser"
echo
# gains ENGINE AT_LEAST: the smallest and the largest gain of an engine on all cases with all numbers of levels
gains() {
    sed -n "s/^$1 \([0-9]\)/\1/p" "$out/gains" | sort -g >"$out/sorted"
    echo "The gain of $1 is between $(sed q "$out/sorted") and $(sed -n '$p' "$out/sorted")."
    awk -v least="$(sed q "$out/sorted")" -v bound="$2" 'BEGIN { exit !(least >= bound) }' ||
        fail "the gain of $1 must be at least $2"
}
gains FMG-FAS 2
gains "improved FMG-FAS" 6
gains multigrid-CG 6
echo "No function is farther than $farthest from the functions of the direct engine."
rm -f "$out/gains" "$out/sorted"
awk -v off="$farthest" 'BEGIN { exit !(off <= 1e-8) }' || fail "engines must agree to 1e-8"

# Meshes from elsewhere: every SU2 file in the directory MESHES,
# with a curve through the first marker that is an airfoil's.
if [ -n "$MESHES" ]; then
    echo "== Engines on the meshes in $MESHES (compact scheme)"
    echo "table As above, with 20 control points"
    printf "$columns" case scheme engine cycles work residual seconds "from direct, same" "from direct, compact" \
        result
    for mesh in "$MESHES"/*.su2; do
        case=$(basename "$mesh" .su2 | cut -c 1-12)
        marker=$(sed -n 's/^MARKER_TAG *= *\([^ \r]*\).*/\1/p' "$mesh" | grep -i airfoil | sed q)
        [ -n "$marker" ] || { echo "$mesh: no marker has airfoil in its name: left out"; continue; }
        run fit "$mesh" --marker "$marker" --degree 3 --points 20 -o "$out/fit.curve"
        conditions="--curve $marker=$out/fit.curve"
        rm -f "$out"/direct-*.csv "$out"/table-*.csv
        row compact direct --engine direct
        row compact multigrid --engine multigrid
        for agglomeration in auto directional; do
            row compact "fas, $agglomeration" --engine fas --agglomeration $agglomeration
        done
    done
    echo
fi
rm -f "$out"/table-*.csv "$out"/direct-*.csv
