#!/bin/sh
# `make paper`: the paper's cases with this program, operator and figures as there. Pictures go to build/paper, with an
# index.html (see tests/figures.sh); numbers and the table of engines are printed; MESHES=directory adds a table for the SU2
# files there. Shapes are drawn after the paper's description, which gives no coordinates.
: "${BUILD:=build}"
harmorph=$BUILD/harmorph out=$BUILD/paper meshes=tests/meshes
mkdir -p "$out"
failed=0

fail() { echo "FAILED: $*"; failed=1; }
run() { "$harmorph" "$@" >"$out/log" 2>&1 || { fail "harmorph $*"; cat "$out/log"; }; }
number() {   # of a JSON object, short
    value=$(sed -n "s/.*\"$1\": \([^,}]*\).*/\1/p" "$out/json")
    case $value in '' | null) echo - ;; *.* | *e*) printf '%.3g\n' "$value" ;; *) echo "$value" ;; esac
}

# figure FILE CAPTION: for the page of figures
figure() { echo "figure $*"; }

# solve NAME MESH OPTIONS...: the functions, with the paper's operator unless another is named
solve() {
    name=$1 mesh=$meshes/$2.su2; shift 2
    case " $* " in *" --operator "*) ;; *) set -- "$@" --operator laplace ;; esac
    "$harmorph" solve "$mesh" "$@" -o "$out/$name.basis" --json >"$out/json" || fail "solving $name"
    echo "$name: $(number functions) functions on $(number points) points, residual $(number residual)," \
        "boundary error $(number boundary_error), values $(number min_value) to $(number max_value)"
}
# functions NAME WINDOW NUMBERS...: pictures of functions
functions() {
    name=$1 window=$2; shift 2
    for function in "$@"; do
        run export "$mesh" "$out/$name.basis" --function "$function" --window "$window" --svg "$out/$name-function-$function.svg"
        figure "$name-function-$function.svg" "$shape: the function of control point $function in the mesh, which on the" \
            "boundary is the B-spline basis function of this point."
    done
}
# morph NAME MOVES WINDOW: mesh before and after, and the boundary both ways
morph() {
    "$harmorph" morph "$mesh" "$out/$1.basis" --move "$2" --window "$3" -o "$out/$1-morphed.su2" --json \
        --svg "$out/$1-mesh.svg" --boundary-svg "$out/$1-boundary.svg" >"$out/json" 2>"$out/log" || { fail "morphing $1"; cat "$out/log"; }
    echo "  moved: $(number inverted) inverted cells, $(number admissible_step) times the movement is admissible," \
        "quality $(number min_quality) at least; boundary by functions against B-spline: $(number boundary_error)"
    figure "$1-mesh.svg" "$shape: the mesh before the movement in blue and after the movement in red, with the control" \
        "polygon of the moved B-spline. There are $(number inverted) inverted cells."
    figure "$1-boundary.svg" "$shape: the circles are points of the boundary as the functions move them, and the line is the" \
        "B-spline of the moved control points. The two differ by $(number boundary_error) at most."
}
# fit MESH MARKER DEGREE POINTS: how well the boundary's own points give the curve back
fit() {
    "$harmorph" fit "$meshes/$1.su2" --marker "$2" --degree "$3" --points "$4" --closed periodic -o "$out/fit.curve" --json \
        >"$out/json" || fail "fitting $2"
    echo "  a fit to the mesh points of $2, degree $3, $4 points: $(number max_error) off at most"
}
# Which control points (first to last) move by how much: lines "index dx dy"
equally() { awk -v a="$1" -v b="$2" -v dx="$3" -v dy="$4" 'BEGIN { for (i = a; i <= b; i++) print i, dx, dy }'; }

echo "== Case 1: a rectangle with two bodies, cubic, 11 and 9 control points"
case1="--curve left=$meshes/two_bodies_left.curve --curve right=$meshes/two_bodies_right.curve"
shape="Two bodies in a rectangle"
solve two-bodies two_bodies $case1
fit two_bodies left 3 11
fit two_bodies right 3 9
functions two-bodies -0.1,-0.1,4.1,2.5 3 9 12 16
cat >"$out/two-bodies.moves" <<END
1 0.10 -0.08
2 0.08 0.06
3 0.02 0.14
4 -0.06 0.12
5 -0.12 0.02
6 -0.10 -0.06
7 -0.04 -0.10
8 0.00 -0.14
9 0.00 -0.16
10 0.02 -0.12
11 0.06 -0.12
12 0.12 0.00
13 0.10 0.12
14 0.00 0.16
15 -0.06 0.10
16 0.10 0.00
17 0.10 0.04
18 -0.02 -0.08
19 0.02 -0.16
20 0.10 -0.08
END
morph two-bodies "$out/two-bodies.moves" -0.1,-0.1,4.1,2.5

echo "== Case 2: the airfoil of a wind turbine's diffuser, quadratic, 14 control points, all moved alike"
case2="--curve airfoil=$meshes/diffuser_airfoil.curve"
shape="Airfoil of a wind turbine's diffuser"
solve airfoil diffuser_airfoil $case2
fit diffuser_airfoil airfoil 2 14
functions airfoil -0.7,-0.6,1.7,1.1 1 4 7 8 10 13
equally 1 14 0.16 0.13 >"$out/airfoil.moves"
morph airfoil "$out/airfoil.moves" -0.6,-0.5,1.6,1
echo "  (more inverts cells at the trailing edge, the paper's open problem; the conformal functions go five times as far)"
shape="Airfoil of a wind turbine's diffuser, conformal functions"
solve airfoil-conformal diffuser_airfoil $case2 --operator conformal
equally 1 14 0.8 0.65 >"$out/airfoil.moves"
morph airfoil-conformal "$out/airfoil.moves" -1,-1,2.6,1.8

echo "== Figure 1: an axisymmetric diffuser, cubic, 11 control points; its axis fixed as in the paper, and slipping"
figure1="--curve diffuser=$meshes/axisymmetric_diffuser.curve"
fit axisymmetric_diffuser diffuser 3 11
equally 1 11 0.22 -0.08 >"$out/diffuser.moves"
window=-1.85,-0.05,3.25,2.65
shape="Axisymmetric diffuser, points of the axis fixed"
solve diffuser-fixed axisymmetric_diffuser $figure1
functions diffuser-fixed "$window" 2 8
morph diffuser-fixed "$out/diffuser.moves" "$window"
shape="Axisymmetric diffuser, points of the axis slipping"
solve diffuser-slip axisymmetric_diffuser $figure1 --slip axis
functions diffuser-slip "$window" 8
morph diffuser-slip "$out/diffuser.moves" "$window"

echo "== Harmonic coordinates: degree 1 on a cage, positions instead of displacements"
shape="Figure inside a cage of straight lines"
solve cage cage --curve cage=$meshes/cage.curve
functions cage -1.7,-1.6,1.7,1.5 4 8
cat >"$out/cage.moves" <<END
1 -0.25 0.1
2 -0.05 0.05
4 0.1 0.7
5 -0.2 0.75
6 0.0 0.1
7 0.2 0.1
8 0.15 0.15
10 0.1 -0.55
11 0.2 -0.5
END
morph cage "$out/cage.moves" -1.8,-1.6,2,1.7
# sum F_i P_i against the points themselves, from the tables of all functions
rm -f "$out"/cage-*.csv
awk '/^points/ { n = $2; next } n && k < n { ++k; print k, $1, $2 }' $meshes/cage.curve >"$out/cage.control"
while read -r function x y; do
    run export "$mesh" "$out/cage.basis" --function "$function" --csv "$out/cage-$function.csv"
done <"$out/cage.control"
awk -F '[ ,]' 'FNR == 1 { ++file; if (file > 1) next }
    file == 1 { px[$1] = $2; py[$1] = $3; next }
    { split(FILENAME, part, /cage-|[.]csv/); i = part[2]; x[$1] = $2; y[$1] = $3; sx[$1] += $4 * px[i]; sy[$1] += $4 * py[i] }
    END { for (k in x) { d = (sx[k] - x[k]) ^ 2 + (sy[k] - y[k]) ^ 2; if (d > worst) worst = d }
          printf "  largest |sum F_i P_i - x| over the mesh: %.2g (its file has ten digits)\n", sqrt(worst) }' "$out/cage.control" "$out"/cage-*.csv
rm -f "$out"/cage-*.csv

# The engines: rows of $name on $mesh with $conditions. least, farthest: the worst of all rows.
columns='%-12s %-16s %-12s %6s %10s %8s %8s %10s %9s %11s %s\n'
single= least= farthest=0
row() {   # NAME OPTIONS...
    what=$1; shift
    "$harmorph" solve "$mesh" $conditions --operator laplace --tol 1e-10 "$@" --json --force -o "$out/table.basis" \
        >"$out/json" 2>"$out/log"
    remark=
    case $? in
    0) ;;
    1) remark="not converged" ;;
    *) fail "$what ($*): $(cat "$out/log")"; return ;;
    esac
    sweeps=$(number sweeps) levels=$(number levels) iterations=$(number iterations) fewer=- asked=
    case $what in
    direct) levels=- iterations=- sweeps=- ;;
    single*) single=$sweeps ;;
    *)
        if [ -n "$single" ]; then
            fewer=$(awk -v a="$single" -v b="$sweeps" 'BEGIN { printf "%.1f", a / b }')
            least=$(smaller "${least:-$fewer}" "$fewer")
        fi
        ;;
    esac
    case $* in *--levels*) asked=${*#*--levels } asked=${asked%% *} ;; esac
    if [ -n "$asked" ] && [ "$asked" != "$levels" ]; then levels="$levels of $asked"; fi
    from_direct
    [ -n "$remark" ] || farthest=$(larger "$farthest" "$off")
    printf "$columns" "$name" "$what" "$agglomeration" "$levels" "$iterations" "$sweeps" "$fewer" "$(number residual)" \
        "$(number solve_seconds)" "$off" "$remark"
}
smaller() { printf '%s\n' "$@" | sort -g | sed q; }
larger() { printf '%s\n' "$@" | sort -gr | sed q; }
# off: the largest difference between the last row's functions and the direct engine's, whose tables are kept for a mesh.
from_direct() {
    off=0
    for function in $(seq "$(number functions)"); do
        run export "$mesh" "$out/table.basis" --function "$function" --csv "$out/table.csv"
        if [ "$what" = direct ]; then cp "$out/table.csv" "$out/direct-$function.csv"; fi
        off=$(paste -d, "$out/table.csv" "$out/direct-$function.csv" | awk -F, -v worst="$off" 'NR > 1 {
            d = $4 - $8; if (d < 0) d = -d; if (d > worst) worst = d } END { printf "%.2g", worst }')
    done
}
table() {   # NAME MESH CONDITIONS
    name=$1 mesh=$meshes/$2.su2 conditions=$3 agglomeration=- single=
    row "direct"
    row "single-grid RK4" --engine fas --levels 1
    for agglomeration in isotropic directional; do
        for levels in 2 3 4 5 6; do
            choice="--levels $levels --agglomeration $agglomeration"
            row "FAS V-cycle" --engine fas $choice --start zero
            row "FMG-FAS" --engine fas $choice
            row "multigrid-CG" --engine multigrid $choice
        done
    done
}
header() {
    printf "$columns" case engine agglomeration levels iterations sweeps fewer residual seconds "from direct"
}
echo "== Engines, to 1e-10. The operator is Laplace's, the scheme compact; each row solves all functions of a case."
echo "   levels       from 2 to 6; agglomeration ends at 48 cells: \"4 of 6\" is 4 where 6 were asked for"
echo "   iterations   steps of Runge-Kutta alone, cycles of FAS, steps of conjugate gradients: the most of any function"
echo "   sweeps       over the finest mesh in these: four-stage Runge-Kutta steps, or symmetric Gauss-Seidel"
echo "   fewer        how many times fewer these are than Runge-Kutta's on a single grid"
echo "   from direct  the largest difference from the direct engine's functions"
header
table two-bodies two_bodies "$case1"
table airfoil diffuser_airfoil "$case2"
table diffuser axisymmetric_diffuser "$figure1"
echo "  multigrid takes $least times fewer sweeps than Runge-Kutta alone, or more; no function is farther than" \
    "$farthest from the direct engine's"
awk -v least="$least" 'BEGIN { exit !(least >= 10) }' || fail "multigrid must save nine sweeps of ten"
awk -v off="$farthest" 'BEGIN { exit !(off <= 1e-8) }' || fail "engines must agree to 1e-8"

# Meshes from elsewhere: every SU2 file in the directory MESHES, with a curve through the first marker that is an airfoil's.
if [ -n "$MESHES" ]; then
    echo "== Engines on the meshes in $MESHES"
    header
    single=
    for mesh in "$MESHES"/*.su2; do
        name=$(basename "$mesh" .su2 | cut -c 1-12) agglomeration=-
        marker=$(sed -n 's/^MARKER_TAG *= *\([^ \r]*\).*/\1/p' "$mesh" | grep -i airfoil | sed q)
        [ -n "$marker" ] || { echo "$mesh: no marker has airfoil in its name: left out"; continue; }
        run fit "$mesh" --marker "$marker" --degree 3 --points 20 -o "$out/fit.curve"
        conditions="--curve $marker=$out/fit.curve"
        row "direct"
        for agglomeration in auto directional; do
            for engine in multigrid fas; do row "$engine" --engine $engine --agglomeration $agglomeration; done
        done
    done
fi

rm -f "$out/json" "$out/log" "$out/table.basis" "$out/table.csv" "$out"/direct-*.csv "$out/fit.curve" "$out/cage.control"
exit $failed
