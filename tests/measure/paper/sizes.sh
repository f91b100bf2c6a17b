# Meshes of 10 000 and 100 000 points, where multigrid pays, and how both cycles depend on the number of points. Part of
# run.sh. SINGLE=100000: the single grid on the largest mesh, too, which takes an hour.
: "${SINGLE:=11000}"
echo "== Large problems: five levels (compact scheme, four functions of an ellipse)"
echo "O-meshes with cells that are nearly as long as high. Gain: the work of Runge-Kutta on a single grid, divided by"
echo "the work of the row. The single grid is left out on the largest mesh, unless SINGLE=100000."
size_columns='%-10s  %-18s  %7s  %7s  %9s  %6s  %9s\n'
echo "table Meshes of several sizes, five levels: cycles that hardly depend on the number of points, and the gain"
printf "$size_columns" points engine levels cycles work gain residual
for size in "64 17" "128 33" "192 53" "320 104" "640 157"; do
    set -- $size
    awk -v n="$1" -v rows="$2" -f "$here/ellipse.awk" >"$out/size.su2"
    run fit "$out/size.su2" --marker body --degree 3 --points 4 --closed periodic -o "$out/size.curve"
    points=$(awk '/^NPOIN/ { print $2 }' "$out/size.su2") single=-
    for engine in "single grid" FMG-FAS "improved FMG-FAS"; do
        case $engine in
        single*) if [ "$points" -gt "$SINGLE" ]; then continue; fi; choice="--levels 1" ;;
        FMG*) choice="--levels 5 --cycle paper" ;;
        *) choice="--levels 5 --cycle improved" ;;
        esac
        "$harmorph" solve "$out/size.su2" --curve body="$out/size.curve" --operator laplace --engine fas --tol 1e-10 \
            $choice --json --force -o "$out/size.basis" >"$out/json" 2>"$out/log" || fail "$engine, $points points"
        work=$(number work) gain=-
        if [ "$engine" = "single grid" ]; then single=$work; fi
        if [ "$single" != - ]; then gain=$(awk -v a="$single" -v b="$work" 'BEGIN { printf "%.1f", a / b }'); fi
        printf "$size_columns" "$points" "$engine" "$(number levels)" "$(number iterations)" "$work" "$gain" \
            "$(number residual)"
        echo "$engine $(number iterations)" >>"$out/size.cycles"
    done
done
echo
awk '/^improved/ { n = $NF; if (!least || n < least) least = n; if (n > most) most = n }
    END { print "The improved cycle takes " least " to " most " cycles from the smallest mesh to the largest one."
        exit !(most <= 3 * least) }' "$out/size.cycles" || fail "the cycles must hardly depend on the number of points"
rm -f "$out"/size.*
