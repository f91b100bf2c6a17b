# The paper's figures 1 to 11, and what belongs to its cases besides. Part of run.sh.

# solve NAME MESH OPTIONS...: the functions, with the paper's operator unless another is named
solve() {
    name=$1 mesh=$meshes/$2.su2; shift 2
    case " $* " in *" --operator "*) ;; *) set -- "$@" --operator laplace ;; esac
    "$harmorph" solve "$mesh" "$@" -o "$out/$name.basis" --json >"$out/json" || fail "solving $name"
    echo "$name: $(number functions) functions on $(number points) points, residual $(number residual)," \
        "boundary error $(number boundary_error), values $(number min_value) to $(number max_value)"
}
# functions NAME WINDOW NUMBERS LABEL: a panel for each function; $text: the caption
functions() {
    run export "$mesh" "$out/$1.basis" --function "$3" --window "$2" --svg "$out/$1-functions.svg"
    figure "$1-functions.svg" "${4:+$4 | }$text"
}
# morph NAME MOVES WINDOW: mesh before and after, and the boundary both ways. Figures follow by mesh_figure,
# boundary_figure.
morph() {
    "$harmorph" morph "$mesh" "$out/$1.basis" --move "$2" --window "$3" -o "$out/$1-morphed.su2" --json \
        --svg "$out/$1-mesh.svg" --boundary-svg "$out/$1-boundary.svg" >"$out/json" 2>"$out/log" ||
        { fail "morphing $1"; cat "$out/log"; }
    echo "  moved: $(number inverted) inverted cells, $(number admissible_step) times the movement is admissible," \
        "quality $(number min_quality) at least; boundary by functions against B-spline: $(number boundary_error)"
}
mesh_figure() {   # NAME LABEL
    figure "$1-mesh.svg" "${2:+$2 | }$text The mesh before the movement is blue and the mesh after it is red, with" \
        "the control polygon of the moved B-spline. There are $(number inverted) inverted cells."
}
boundary_figure() {   # NAME LABEL
    figure "$1-boundary.svg" "${2:+$2 | }$text Circles are points of the boundary as the functions move them, the" \
        "line is the B-spline of the moved control points; the two differ by $(number boundary_error) at most."
}
# fit MESH MARKER DEGREE POINTS: how well the boundary's own points give the curve back
fit() {
    "$harmorph" fit "$meshes/$1.su2" --marker "$2" --degree "$3" --points "$4" --closed periodic -o "$out/fit.curve" \
        --json >"$out/json" || fail "fitting $2"
    echo "  a fit to the mesh points of $2, degree $3, $4 points: $(number max_error) off at most"
}
# Writes lines "index dx dy": the control points (first to last) and their movement.
equally() { awk -v a="$1" -v b="$2" -v dx="$3" -v dy="$4" 'BEGIN { for (i = a; i <= b; i++) print i, dx, dy }'; }

echo "Figures 1 to 11 are numbered as in the paper; further figures have letters. Captions are our own words, and"
echo "shapes are drawn after the paper's description. All pictures are made with the compact scheme and the direct"
echo "engine."

echo "== The method, on an axisymmetric diffuser: cubic, 11 control points (figures 1 to 5)"
window=-1.85,-0.05,3.25,2.65 near=-0.6,0.3,1.7,1.5
solve diffuser axisymmetric_diffuser $diffuser
fit axisymmetric_diffuser diffuser 3 11
run check "$mesh" --boundaries --curve "$meshes/axisymmetric_diffuser.curve" --svg "$out/diffuser-boundaries.svg"
figure diffuser-boundaries.svg "Figure 1 | Half plane above the axis of a diffuser. The diffuser's section is a" \
    "closed cubic B-spline; 11 control points, of which the first three are used again at its end, close it smoothly."
run check "$mesh" --svg "$out/diffuser-mesh-alone.svg"
figure diffuser-mesh-alone.svg "Figure 2 | The mesh alone. Triangles fill the domain; the points on the section lie" \
    "on the B-spline."
text="The function of the fourth control point, N_3,3 in the paper. On the section it is the cubic basis function, on \
all other boundaries it is 0, and in between it is harmonic."
functions diffuser "$near" 4 "Figure 3"
printf '3 .08 .25\n4 .05 .3\n5 .0 .25\n' >"$out/three.moves"
morph diffuser "$out/three.moves" "$near"
text="Three neighbouring control points of the upper side move, and the section with them."
boundary_figure diffuser "Figure 4"
text="The mesh follows the three control points."
mesh_figure diffuser "Figure 5"

echo "== The scheme: control volumes round points (figures 6 and 7, A and B)"
hybrid=$meshes/naca0012.su2
dual_volume() {   # LETTER MESH POINT KIND
    run check "$meshes/$2.su2" --dual-volumes "$3" --svg "$out/dual-volume-$1.svg"
    figure "dual-volume-$1.svg" "Figure 6 ($1) | A control volume of the median dual among $4, over which the flux of" \
        "each function is balanced (equation 8). The boundary of the volume joins the middles of edges with the" \
        "barycentres of the cells."
}
dual_volume a two_bodies 1200 triangles
dual_volume b block 299 quadrilaterals
dual_volume c naca0012 2067 "quadrilaterals and triangles"
run check "$hybrid" --gradient-volumes 2067 --svg "$out/gradient-volume.svg"
figure gradient-volume.svg "Figure 7 | The cells round a point, over which the gradient at the point is formed" \
    "(equation 10)."
"$harmorph" solve "$meshes/two_bodies.su2" $two_bodies --operator laplace --engine fas -o "$out/levels.basis" \
    >"$out/log" 2>&1 || fail "levels"
for kind in isotropic directional; do
    run export "$meshes/two_bodies.su2" "$out/levels.basis" --agglomeration $kind --level 0,1,2,3 \
        --svg "$out/levels-$kind.svg"
done
figure levels-isotropic.svg "Figure A | Control volumes are merged from level to level for the multigrid method, in" \
    "all directions alike, in the order of a front that advances from the boundaries. Points with known values, in" \
    "grey, are not merged."
figure levels-directional.svg "Figure B | Control volumes are merged along the strongest couplings."

echo "== Case 1: a rectangle with two bodies, cubic, 11 and 9 control points (figures 8 and 9)"
shape="Two bodies in a rectangle:"
solve two-bodies two_bodies $two_bodies
fit two_bodies left 3 11
fit two_bodies right 3 9
text="$shape the functions of control points 1 and 5 of each curve. Each is 0 on the other body and on the rectangle."
functions two-bodies -0.1,-0.1,4.1,2.5 1,5,12,16 "Figure 8"
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
text="$shape all control points move."
mesh_figure two-bodies "Figure 9"
boundary_figure two-bodies "Figure C"

echo "== Case 2: the airfoil of a wind turbine's diffuser, quadratic, 14 control points (figures 10 and 11)"
shape="Airfoil of a wind turbine's diffuser:"
solve airfoil diffuser_airfoil $airfoil
fit diffuser_airfoil airfoil 2 14
text="$shape the functions of six of its control points."
functions airfoil -0.7,-0.6,1.7,1.1 1,4,7,9,12,14 "Figure 10"
equally 1 14 0.16 0.13 >"$out/airfoil.moves"
morph airfoil "$out/airfoil.moves" -0.6,-0.5,1.6,1
text="$shape all control points move by (.16, .13)."
mesh_figure airfoil "Figure 11"
boundary_figure airfoil "Figure D"
reach=$(awk -v step="$(number admissible_step)" 'BEGIN { print .16 * step }')
solve airfoil-conformal diffuser_airfoil $airfoil --operator conformal
equally 1 14 0.8 0.65 >"$out/airfoil.moves"
morph airfoil-conformal "$out/airfoil.moves" -1,-1,2.6,1.8
awk -v laplace="$reach" -v step="$(number admissible_step)" 'BEGIN {
    print "  (cells at the trailing edge invert at a movement of " laplace ", the open problem of the paper;"
    printf "  the conformal functions go %.0f times as far)\n", .8 * step / laplace }'
text="$shape conformal functions, all control points move by (.8, .65)."
mesh_figure airfoil-conformal "Figure E"

echo "== The diffuser as a whole, its axis fixed as in the paper, and slipping"
equally 1 11 0.22 -0.08 >"$out/diffuser.moves"
for axis in fixed slip; do
    letter=F
    if [ $axis = slip ]; then slip="--slip axis" how=slip letter=G; else slip= how="are fixed"; fi
    solve diffuser-$axis axisymmetric_diffuser $diffuser $slip
    morph diffuser-$axis "$out/diffuser.moves" "$window"
    text="All control points of the diffuser move by (.22, -.08), and points of the axis $how."
    mesh_figure diffuser-$axis "Figure $letter"
done

echo "== Harmonic coordinates: degree 1 on a cage, positions instead of displacements"
solve cage cage --curve cage=$meshes/cage.curve
text="A cage of straight lines: the functions of two of its corners are its harmonic coordinates."
functions cage -1.7,-1.6,1.7,1.5 4,8 "Figure H"
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
text="Corners of the cage move, and what is inside follows."
mesh_figure cage "Figure I"
# sum F_i P_i against the points themselves, from the tables of all functions
rm -f "$out"/cage-*.csv
awk '/^points/ { n = $2; next } n && k < n { ++k; print k, $1, $2 }' $meshes/cage.curve >"$out/cage.control"
while read -r function x y; do
    run export "$mesh" "$out/cage.basis" --function "$function" --csv "$out/cage-$function.csv"
done <"$out/cage.control"
awk -F '[ ,]' 'FNR == 1 { ++file; if (file > 1) next }
    file == 1 { px[$1] = $2; py[$1] = $3; next }
    {
        split(FILENAME, part, /cage-|[.]csv/); i = part[2]
        x[$1] = $2; y[$1] = $3
        sx[$1] += $4 * px[i]; sy[$1] += $4 * py[i]
    }
    END {
        for (k in x) { d = (sx[k] - x[k]) ^ 2 + (sy[k] - y[k]) ^ 2; if (d > worst) worst = d }
        printf "  largest |sum F_i P_i - x| over the mesh: %.2g (its file has ten digits)\n", sqrt(worst)
    }' "$out/cage.control" "$out"/cage-*.csv
rm -f "$out"/cage-*.csv "$out/cage.control"
