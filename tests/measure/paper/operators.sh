# Moves control points by harmonic and by conformal functions. This is a part of run.sh.
echo "== Harmonic and conformal functions of the same control point (NACA 0012, quadrilaterals inside triangles)"
mesh=$meshes/naca0012.su2
run fit "$mesh" --marker airfoil -o "$out/naca.curve"
for operator in laplace conformal; do
    "$harmorph" solve "$mesh" --curve airfoil="$out/naca.curve" --operator $operator -o "$out/naca-$operator.basis" \
        --json >"$out/$operator.json" || fail "solving $operator"
done
run export "$mesh" "$out/naca-laplace.basis" --beside "$out/naca-conformal.basis" --function 16 --number 1,2 \
    --window -0.6,-0.7,1.3,0.9 --svg "$out/operators.svg"
figure operators.svg "Figure J | The function of one control point by either operator, in one scale." \
    "The harmonic one is between 0 and 1 and falls off at once; the conformal one is complex, reaches farther," \
    "changes its sign, and turns cells with the wall."
"$harmorph" export "$mesh" "$out/naca-laplace.basis" --function 16 --csv "$out/laplace.csv"
"$harmorph" export "$mesh" "$out/naca-conformal.basis" --function 16 --csv "$out/conformal.csv"
# Farthest point from the airfoil's middle at which the function is still above .1 in size, and the share of the points.
reach() {
    awk -F, 'NR > 1 && sqrt($4 ^ 2 + $5 ^ 2) > .1 { d = sqrt(($2 - .5) ^ 2 + $3 ^ 2); if (d > far) far = d }
        END { printf "%.2f", far }' "$1"
}
# limit MOVES: how much of a movement is admissible
limit() {
    "$harmorph" morph "$mesh" "$out/naca-$operator.basis" --move "$1" --json >"$out/json" 2>/dev/null
    number admissible_step
}
awk '/^points/ { n = $2; next } n && k < n { print ++k, 0, 4 * $1 * (1 - $1) }' "$out/naca.curve" >"$out/camber.moves"
printf '16 0 1\n' >"$out/one.moves"
echo "table Harmonic against conformal functions: least and largest value of any function, how far from mid-chord" \
    "function 16 is above .1 in size, admissible movements of one control point and of the camber line"
printf '%-12s  %10s  %10s  %14s  %22s  %22s\n' functions least largest "reach [chords]" "control point 16, up" \
    "camber [chords]"
for operator in laplace conformal; do
    least=$(sed -n 's/.*"min_value": \([^,}]*\).*/\1/p' "$out/$operator.json")
    most=$(sed -n 's/.*"max_value": \([^,}]*\).*/\1/p' "$out/$operator.json")
    printf '%-12s  %10.3g  %10.3g  %14s  %22s  %22s\n' $operator "$least" "$most" "$(reach "$out/$operator.csv")" \
        "$(limit "$out/one.moves")" "$(limit "$out/camber.moves")"
done
echo
