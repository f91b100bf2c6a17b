# Sensitivities of flow solvers, turned into gradients by control points, variables and bodies.

mesh=$tmp/demo/mesh.su2 basis=$tmp/demo/airfoil.basis
[ -e "$basis" ] || makes demo "$tmp/demo" --mesh "$meshes/naca0012.su2"
# Derivatives of a function of all mesh points, as tables in several layouts.
awk -v out="$tmp/sens" -v n=0 '/^NPOIN/ { inside = 1; next } /^[A-Z]/ { inside = 0 }
    inside {
        dx = sin(3 * n) / (1 + $1 * $1 + $2 * $2); dy = cos(5 * n) / (1 + $1 * $1 + $2 * $2)
        x[n] = $1; y[n] = $2; a[n] = sprintf("%.15g", dx); b[n++] = sprintf("%.15g", dy)
    }
    END {
        print "# point dJ/dx dJ/dy" >out ".txt"
        print "\"PointID\",\"x\",\"y\",\"Pressure\",\"Sensitivity_x\",\"Sensitivity_y\"" >out ".csv"
        print "x,y,jx,jy" >out "-placed.csv"
        print "Sensitivity_x,Sensitivity_y" >out "-ordered.csv"
        for (k = n - 1; k >= 0; k--) {
            print k, a[k], b[k] >out ".txt"
            printf "%d, %.9e, %.9e, 1.5, %s, %s\n", k, x[k], y[k], a[k], b[k] >out ".csv"
            printf "%.8e,%.8e,%s,%s\n", x[k], y[k], a[k], b[k] >out "-placed.csv"
        }
        for (k = 0; k < n; k++) printf "%s,%s\n", a[k], b[k] >out "-ordered.csv"
    }' "$mesh"
runs "adjoint: a table" 0 adjoint "$mesh" "$basis" --sensitivity "$tmp/sens.txt" -o "$tmp/gradient" --json
check "adjoint: all points have a row" test "$(number points)" -gt 1000
check "adjoint: a limit of the descent" awk -v s="$(number admissible_descent)" 'BEGIN { exit !(s > 0) }'
lines() { grep -v '^#' "$1"; }
same_lines() { lines "$1" >"$tmp/a" && lines "$2" >"$tmp/b" && cmp "$tmp/a" "$tmp/b"; }
# 17 digits distinguish all numbers: the same text means the same bits.
: "${CC:=cc}"
library=$(dirname "$harmorph")/libharmorph.a
check "adjoint: a program in C is compiled" $CC -std=c99 ${CFLAGS-} -Iinclude -o "$tmp/adjoint_bits" \
    "$here/adjoint_bits.c" "$library" -lm
lines "$tmp/sens.txt" >"$tmp/rows"
check "adjoint: hm_adjoint, called from C" sh -c "'$tmp/adjoint_bits' '$basis' '$tmp/rows' >'$tmp/from-c'"
check "adjoint: hm_adjoint, called from C: the same bits" same_lines "$tmp/gradient" "$tmp/from-c"
for layout in .csv "-ordered.csv --in-order"; do
    order=${layout#* } layout=${layout% *}
    [ "$order" = "$layout" ] && order=
    runs "adjoint: sens$layout" 0 adjoint "$mesh" "$basis" --sensitivity "$tmp/sens$layout" $order -o "$tmp/other"
    check "adjoint: sens$layout: the same bits" same_lines "$tmp/gradient" "$tmp/other"
done
runs "adjoint: by coordinates, other columns" 0 adjoint "$mesh" "$basis" --sensitivity "$tmp/sens-placed.csv" \
    --x jx --y jy --threads 2 -o "$tmp/other"
check "adjoint: by coordinates: the same bits" same_lines "$tmp/gradient" "$tmp/other"
if command -v perl >/dev/null; then
    perl -e 'binmode STDOUT; open my $f, "<", $ARGV[0]; <$f>; my @r = map { [split /,/] } <$f>;
        print pack("i<5", 535532, 3, scalar @r, 0, 0);
        print map { pack "a33", $_ } "Pressure", "Sensitivity_x", "Sensitivity_y";
        print pack("d<3", 1, @$_) for @r' "$tmp/sens-ordered.csv" >"$tmp/restart.dat"
    runs "adjoint: SU2's restart" 0 adjoint "$mesh" "$basis" --sensitivity "$tmp/restart.dat" --in-order \
        -o "$tmp/other"
    check "adjoint: SU2's restart: the same bits" same_lines "$tmp/gradient" "$tmp/other"
    head -c 3000 "$tmp/restart.dat" >"$tmp/short.dat"
    refuses "adjoint: a short restart" 3 'but is shorter' adjoint "$mesh" "$basis" \
        --sensitivity "$tmp/short.dat" -o "$tmp/x"
fi

# The transpose: the derivatives by the mesh points times the movement of these, and the gradient times the movement of
# the control points, are one number.
printf '3 .01 .02\n9 -.02 .01\n14 .005 -.01\n' >"$tmp/three.moves"
runs "adjoint: a movement" 0 morph "$mesh" "$basis" --move "$tmp/three.moves" -o "$tmp/moved.su2" --csv "$tmp/where.csv"
cat >"$tmp/pairing.awk" <<'END'
FILENAME == ARGV[1] && !/^#/ { gx[$1] = $2; gy[$1] = $3; next }
FILENAME == ARGV[2] { by += gx[$1] * $2 + gy[$1] * $3; next }
FILENAME == ARGV[3] && !/^#/ { sx[$1] = $2; sy[$1] = $3; next }
/^NPOIN/ { inside = 1; n = 0; next }
/^[A-Z]/ { inside = 0 }
inside && FILENAME == ARGV[4] { x[n] = $1; y[n++] = $2; next }
inside { on += sx[n] * ($1 - x[n]) + sy[n] * ($2 - y[n]); n++ }
END { print by, on; exit !(by != 0 && (by - on) ^ 2 < 1e-26) }
END
check "adjoint: the dot product" awk -f "$tmp/pairing.awk" "$tmp/gradient" "$tmp/three.moves" "$tmp/sens.txt" \
    "$mesh" "$tmp/moved.su2"

# Variables: the transpose of the map.
makes variables "$tmp/demo/airfoil.curve" --cst 4,4 -o "$tmp/cst.map"
runs "adjoint: by variables" 0 adjoint "$mesh" "$basis" --sensitivity "$tmp/sens.txt" --variables "$tmp/cst.map" \
    -o "$tmp/by-variables"
check "adjoint: by variables: the transpose of the map" awk '
    FILENAME == ARGV[1] && !/^#/ { gx[$1] = $2; gy[$1] = $3; next }
    FILENAME == ARGV[2] { if (NF == 4 && !/^#/) v[$2] += gx[$1] * $3 + gy[$1] * $4; next }
    !/^#/ { n++; d = $2 - v[$1]; if (d < 0) d = -d; if (d > worst) worst = d }
    END { print n, worst; exit !(n == 8 && worst < 1e-12) }' "$tmp/gradient" "$tmp/cst.map" "$tmp/by-variables"

# Derivatives along normals, by the length of the wall: those of the area of the polygon. A shift has none, and a scale
# about the origin twice the area.
awk '/^MARKER_TAG/ { here = /airfoil/ } /^[A-Z]/ { if (!/^MARKER_ELEMS/) next; next }
    here && $1 == 3 { on[$2]; on[$3] } END { print "PointID,one"; for (k in on) print k ",1" }' "$mesh" >"$tmp/one.csv"
runs "adjoint: along normals" 0 adjoint "$mesh" "$basis" --sensitivity "$tmp/one.csv" --normal one --into fluid \
    --per-length -o "$tmp/area"
check "adjoint: along normals: the area" awk '
    FILENAME == ARGV[1] && /^[0-9]/ && NF == 3 { gx[$1] = $2; gy[$1] = $3; x += $2; y += $3; next }
    FILENAME == ARGV[2] && /^control/ { split($0, c, ","); by += gx[c[3]] * c[5] + gy[c[3]] * c[6] }
    END { print x, y, by / 2; exit !(x * x + y * y < 1e-20 && by / 2 > .081 && by / 2 < .0825) }' \
    "$tmp/area" "$tmp/where.csv"
runs "adjoint: into the body" 0 adjoint "$mesh" "$basis" --sensitivity "$tmp/one.csv" --normal one --into body \
    --per-length -o "$tmp/other"
check "adjoint: into the body: the opposite" \
    awk '/^#/ { next } NR == FNR { x[$1] = $2; next } x[$1] + $2 != 0 { exit 1 }' \
    "$tmp/area" "$tmp/other"

# Bodies and modes: each derivative agrees with central differences of the objective, which is linear in the points.
from=$mesh
objective() { # objective BASIS MOVE: the sum of derivatives times coordinates after the movement of the mesh in $from
    "$harmorph" morph "$from" "$1" --by "$2" -o "$tmp/moved.su2" >/dev/null 2>&1
    awk 'NR == FNR { if (!/^#/) { sx[$1] = $2; sy[$1] = $3 } next }
        /^NPOIN/ { inside = 1; n = 0; next } /^[A-Z]/ { inside = 0 }
        inside { sum += sx[n] * $1 + sy[n] * $2; n++ } END { printf "%.17g", sum }' "$tmp/sens.txt" "$tmp/moved.su2"
}
sum() { awk -v a="$1" -v b="$2" 'BEGIN { print a + b }'; }
agrees() { # agrees BASIS BEFORE REST STEP AFTER DERIVATIVE: the moved number lies between BEFORE and AFTER in the move
    awk -v high="$(objective "$1" "$2 $(sum "$3" "$4") $5")" -v low="$(objective "$1" "$2 $(sum "$3" "-$4") $5")" \
        -v h="$4" -v g="$6" 'BEGIN { d = (high - low) / (2 * h) - g; exit !(g != 0 && d * d < 1e-14 * (1 + g * g)) }'
}
makes solve "$mesh" --rigid airfoil=0.25,0 -o "$tmp/body.basis"
runs "adjoint: a body" 0 adjoint "$mesh" "$tmp/body.basis" --sensitivity "$tmp/sens.txt" -o "$tmp/body.gradient"
set -- $(grep '^rigid' "$tmp/body.gradient")
check "adjoint: a body: dx" agrees "$tmp/body.basis" "$1 $2" 0 .001 "0 0" "$3"
check "adjoint: a body: dy" agrees "$tmp/body.basis" "$1 $2 0" 0 .001 0 "$4"
check "adjoint: a body: degrees" agrees "$tmp/body.basis" "$1 $2 0 0" 0 .01 "" "$5"
check "adjoint: a body: scale" agrees "$tmp/body.basis" "$1 $2 0 0 0" 1 .001 "" "$6"
# A body that has turned already is turned on, and about its centre, which has moved.
from=$tmp/turned.su2
makes morph "$mesh" "$tmp/body.basis" --by "rigid airfoil .02 .01 40 1.1" -o "$from"
runs "adjoint: a body that has turned" 0 adjoint "$from" "$tmp/body.basis" --sensitivity "$tmp/sens.txt" \
    -o "$tmp/turned.gradient"
set -- $(grep '^rigid' "$tmp/turned.gradient")
check "adjoint: a body that has turned: dx" agrees "$tmp/body.basis" "$1 $2" 0 .001 "0 0" "$3"
check "adjoint: a body that has turned: degrees" agrees "$tmp/body.basis" "$1 $2 0 0" 0 .01 "" "$5"
check "adjoint: a body that has turned: scale" agrees "$tmp/body.basis" "$1 $2 0 0 0" 1 .001 "" "$6"
from=$mesh
awk '/^MARKER_TAG/ { on = /airfoil/ } on && $1 == 3 { seen[$2]; seen[$3] } END { for (p in seen) print p, 0, sin(p) }' \
    "$mesh" >"$tmp/waves"
makes solve "$mesh" --given airfoil --mode "$tmp/waves" -o "$tmp/waves.basis"
runs "adjoint: a mode" 0 adjoint "$mesh" "$tmp/waves.basis" --sensitivity "$tmp/sens.txt" -o "$tmp/waves.gradient"
set -- $(grep '^mode 1' "$tmp/waves.gradient")
check "adjoint: a mode: amplitude" agrees "$tmp/waves.basis" "$1 $2" 0 1e-4 "" "$3"

# Points that slip along a curve are put onto the curve after each morph, which so is no longer linear.
bodies=$meshes/two_bodies.su2 from=$tmp/slipped.su2
makes fit "$bodies" --marker left --points 12 -o "$tmp/left.curve"
makes solve "$bodies" --curve "left=$tmp/left.curve" --slip right -o "$tmp/slip.basis"
for k in 1 2 3 4 5 6 7 8 9 10 11 12; do echo "$k .15 .01"; done >"$tmp/right.txt"
makes morph "$bodies" "$tmp/slip.basis" --move "$tmp/right.txt" -o "$from"
awk '$1 < 1982' "$tmp/sens.txt" >"$tmp/sens-few.txt" # the bodies have so many points
runs "adjoint: slip along a curve" 0 adjoint "$from" "$tmp/slip.basis" --sensitivity "$tmp/sens-few.txt" \
    -o "$tmp/slip.gradient"
for k in 1 4 8; do
    set -- $(grep "^$k " "$tmp/slip.gradient")
    check "adjoint: slip along a curve: dx of $k" agrees "$tmp/slip.basis" "$k" 0 1e-5 0 "$2"
    check "adjoint: slip along a curve: dy of $k" agrees "$tmp/slip.basis" "$k 0" 0 1e-5 "" "$3"
done
from=$mesh

sed '1s/"Sensitivity_y"/"Sensitivity_x"/' "$tmp/sens.csv" >"$tmp/twice.csv"
refuses "adjoint: a column twice" 3 "two columns have the name 'Sensitivity_x'" adjoint "$mesh" "$basis" \
    --sensitivity "$tmp/twice.csv" -o "$tmp/x"

# Smoothed: still a direction of descent.
runs "adjoint: smooth" 0 adjoint "$mesh" "$basis" --sensitivity "$tmp/sens.txt" --smooth 0.2 -o "$tmp/smooth"
check "adjoint: smooth: positive" awk '/^#/ { next } NR == FNR { x[$1] = $2; y[$1] = $3; next }
    { both += x[$1] * $2 + y[$1] * $3; changed = changed || x[$1] != $2 } END { exit !(both > 0 && changed) }' \
    "$tmp/gradient" "$tmp/smooth"
runs "adjoint: two objectives as CSV" 0 adjoint "$mesh" "$basis" --sensitivity "$tmp/sens.txt" \
    --sensitivity "$tmp/sens.csv" -o "$tmp/both.csv"
check "adjoint: two objectives: twice 20 rows" test "$(grep -c ',point,' "$tmp/both.csv")" -eq 40

# Wrong files are refused with file and line.
adjoint() { # adjoint NAME TEXT FILE OPTION...
    name=$1 text=$2 file=$3; shift 3
    refuses "adjoint: $name" 3 "$text" adjoint "$mesh" "$basis" --sensitivity "$file" -o "$tmp/x" "$@"
}
sed '5s/^[^,]*,\([^,]*,[^,]*,[^,]*\),[^,]*/0,\1,nan/' "$tmp/sens.csv" >"$tmp/bad.csv"
adjoint "NaN" 'bad.csv:5' "$tmp/bad.csv"
sed '7s/, *\([-0-9.e+]*\)/, 77/' "$tmp/sens.csv" >"$tmp/bad.csv"
adjoint "another mesh" 'those of another mesh' "$tmp/bad.csv"
adjoint "a column that is not there" "no column 'Sens'" "$tmp/sens.csv" --x Sens
sed '3s/^[^,]*/77/' "$tmp/sens-placed.csv" >"$tmp/bad.csv"
adjoint "a place without a point" 'no point at' "$tmp/bad.csv" --x jx --y jy
sed '9s/,[^,]*$//' "$tmp/sens.csv" >"$tmp/bad.csv"
adjoint "a row without a column" 'bad.csv:9' "$tmp/bad.csv"
sed '$d' "$tmp/sens-ordered.csv" >"$tmp/bad.csv"
adjoint "a row that is missing" 'but the mesh has' "$tmp/bad.csv" --in-order
{ cat "$tmp/sens.txt"; echo '4 1 1'; } >"$tmp/bad.txt"
adjoint "a point twice" 'has values already' "$tmp/bad.txt"
echo '999999 1 1' >"$tmp/bad.txt"
adjoint "a point that is not there" 'no point 999999' "$tmp/bad.txt"
: >"$tmp/bad.txt"
adjoint "an empty file" 'has no numbers' "$tmp/bad.txt"
refuses "adjoint: normals without a side" 2 '--into fluid or --into body' adjoint "$mesh" "$basis" \
    --sensitivity "$tmp/one.csv" --normal one

# The same derivatives as vectors in files of VTK, by points of the mesh.
sorted() { sort -n "$tmp/sens.txt" | grep -v '^#'; }
makes convert "$mesh" "$tmp/plain.vtk"
makes convert "$mesh" "$tmp/plain.vtu"
{ cat "$tmp/plain.vtk"; echo "POINT_DATA $(sorted | wc -l)"; echo "SCALARS p double 1"; echo "LOOKUP_TABLE default"
  sorted | awk '{ print 1.5 }'; echo "VECTORS dJ double"; sorted | awk '{ print $2, $3, 0 }'; } >"$tmp/sens.vtk"
runs "adjoint: VTK" 0 adjoint "$mesh" "$basis" --sensitivity "$tmp/sens.vtk" --vector dJ -o "$tmp/other"
check "adjoint: VTK: the same bits" same_lines "$tmp/gradient" "$tmp/other"
{ sed '/<Cells>/,$d' "$tmp/plain.vtu"; echo '<PointData><DataArray type="Float64" Name="Sensitivity" ' \
    'NumberOfComponents="3" format="ascii">'; sorted | awk '{ print $2, $3, 0 }'
  echo '</DataArray></PointData>'; sed -n '/<Cells>/,$p' "$tmp/plain.vtu"; } >"$tmp/sens.vtu"
runs "adjoint: VTU" 0 adjoint "$mesh" "$basis" --sensitivity "$tmp/sens.vtu" -o "$tmp/other"
check "adjoint: VTU: the same bits" same_lines "$tmp/gradient" "$tmp/other"
echo '<VTKFile type="PUnstructuredGrid"><PUnstructuredGrid GhostLevel="0"><Piece Source="sens.vtu"/></PUnstructuredGrid>
    </VTKFile>' >"$tmp/sens.pvtu"
adjoint "PVTU" 'join the pieces' "$tmp/sens.pvtu"
adjoint "a vector that is not there" "no column 'dI_x'" "$tmp/sens.vtk" --vector dI
sed 's/^POINT_DATA .*/POINT_DATA 7/' "$tmp/sens.vtk" >"$tmp/bad.vtk"
adjoint "VTK: a wrong count" 'the number of points' "$tmp/bad.vtk" --vector dJ
sed '$d' "$tmp/sens.vtk" >"$tmp/bad.vtk"
adjoint "VTK: a row that is missing" 'bad.vtk' "$tmp/bad.vtk" --vector dJ
for n in 0 -1 5 x; do
    sed "s/^SCALARS p double 1/SCALARS p double $n/" "$tmp/sens.vtk" >"$tmp/bad.vtk"
    adjoint "VTK: $n components" "the array p must have 1 to 4 components, not '$n'" "$tmp/bad.vtk" --vector dJ
done
{ printf '# vtk DataFile Version 3.0\nx\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 1 double\n'; head -c 24 /dev/zero
  printf '\nPOINT_DATA 1\nVECTORS dJ double'; } >"$tmp/bad.vtk"
adjoint "VTK: cut off before binary numbers" 'but the end of the file follows' "$tmp/bad.vtk" --vector dJ
refuses "adjoint: --vector and --x" 2 'exclude each other' adjoint "$mesh" "$basis" --sensitivity "$tmp/sens.vtk" \
    --vector dJ --x a

# A mesh in the plane y = 0: the derivatives by z are those of the vector, or refused where there are none.
awk '/^POINTS/ { n = $2; print; for (k = 0; k < n; k++) { getline; print $1, 0, $2 } next } { print }' \
    "$tmp/plain.vtk" >"$tmp/upright.vtk"
runs "adjoint: upright: functions" 0 solve "$tmp/upright.vtk" --curve boundary1="$tmp/demo/airfoil.curve" \
    -o "$tmp/upright.basis"
runs "adjoint: upright: a table" 0 adjoint "$tmp/upright.vtk" "$tmp/upright.basis" --sensitivity "$tmp/sens.txt" \
    -o "$tmp/flat"
{ cat "$tmp/upright.vtk"; echo "POINT_DATA $(sorted | wc -l)"; echo "VECTORS Sensitivity double"
  sorted | awk '{ print $2, 7, $3 }'; for name in a b; do echo "SCALARS $name double 1"; sorted | awk '{ print $2 }'
  done; } >"$tmp/upright_sens.vtk"
runs "adjoint: upright: vectors" 0 adjoint "$tmp/upright.vtk" "$tmp/upright.basis" \
    --sensitivity "$tmp/upright_sens.vtk" -o "$tmp/other"
check "adjoint: upright: vectors: the same bits" same_lines "$tmp/flat" "$tmp/other"
refuses "adjoint: upright: no derivatives by z" 3 "no column 'a_z'; the columns are" adjoint "$tmp/upright.vtk" \
    "$tmp/upright.basis" --sensitivity "$tmp/upright_sens.vtk" --x a --y b -o "$tmp/x"

# One cell thick: the derivatives by both planes are added, of a field of OpenFOAM, too.
awk '/^POINTS/ { print "# vtk DataFile Version 3.0\nthick\nASCII\nDATASET UNSTRUCTURED_GRID"; n = $2
        print "POINTS", 2 * n, "double"; for (k = 0; k < n; k++) { getline; p[k] = $1 " " $2; print p[k], 0 }
        for (k = 0; k < n; k++) print p[k], 1; next }
    /^CELLS/ { m = $2; size = $3 - m; print "CELLS", m, m + 2 * size; for (k = 0; k < m; k++) { getline
        type[k] = $1 == 3 ? 13 : 12; line = 2 * $1; for (i = 2; i <= NF; i++) line = line " " $i
        for (i = 2; i <= NF; i++) line = line " " $i + n; print line }; print "CELL_TYPES", m
        for (k = 0; k < m; k++) print type[k]; exit }' "$tmp/plain.vtk" >"$tmp/thick.vtk"
runs "adjoint: thick: functions" 0 solve "$tmp/thick.vtk" --curve boundary1="$tmp/demo/airfoil.curve" \
    -o "$tmp/thick.basis"
for share in .25 .75; do
    sorted | awk -v s=$share '{ printf "%.17g %.17g 7\n", s * $2, s * $3 }'
done >"$tmp/planes"
{ cat "$tmp/thick.vtk"; echo "POINT_DATA $(wc -l <"$tmp/planes")"; echo "VECTORS Sensitivity double"
  cat "$tmp/planes"; } >"$tmp/thick_sens.vtk"
{ echo 'FoamFile { version 2.0; format ascii; class pointVectorField; object dJ; }'
  echo 'dimensions [0 0 0 0 0 0 0];'; echo "internalField nonuniform List<vector> $(wc -l <"$tmp/planes") ("
  sed 's/.*/(&)/' "$tmp/planes"; echo ');'; } >"$tmp/dJ"
runs "adjoint: thick: by places in the plane" 0 adjoint "$tmp/thick.vtk" "$tmp/thick.basis" \
    --sensitivity "$tmp/sens-placed.csv" --x jx --y jy -o "$tmp/flat"
for file in thick_sens.vtk dJ; do
    runs "adjoint: thick: $file" 0 adjoint "$tmp/thick.vtk" "$tmp/thick.basis" --sensitivity "$tmp/$file" \
        -o "$tmp/other"
    check "adjoint: thick: $file: the sum of both planes" awk '
        /^#/ { next } NR == FNR { x[$1] = $2; y[$1] = $3; next }
        { d = (x[$1] - $2) ^ 2 + (y[$1] - $3) ^ 2; if (d > 1e-24) bad = 1; ++n } END { exit bad || n != 20 }' \
        "$tmp/flat" "$tmp/other"
    refuses "interpolate: thick: $file" 3 'values at all points of the mesh file' interpolate "$tmp/thick.vtk" \
        "$tmp/$file" "$tmp/plain.vtk" -o "$tmp/x"
done
runs "interpolate: thick: values at one plane" 0 interpolate "$tmp/thick.vtk" "$tmp/sens-placed.csv" "$tmp/plain.vtk" \
    --field jx -o "$tmp/jx.csv"
sed 's/^VECTORS Sensitivity/VECTORS displacement/' "$tmp/thick_sens.vtk" >"$tmp/bad"
refuses "displace: thick" 3 'such as in a CSV table with the columns x and y' displace "$tmp/thick.vtk" \
    --given boundary1 --wall "$tmp/bad" -o "$tmp/x"
sed '20s/([^ ]*/(nan/' "$tmp/dJ" >"$tmp/bad"
refuses "adjoint: OpenFOAM: NaN" 3 'bad:' adjoint "$tmp/thick.vtk" "$tmp/thick.basis" \
    --sensitivity "$tmp/bad" -o "$tmp/x"
sed 's/pointVectorField/volVectorField/' "$tmp/dJ" >"$tmp/bad"
refuses "adjoint: OpenFOAM: a field of cells" 3 'pointVectorField' adjoint "$tmp/thick.vtk" "$tmp/thick.basis" \
    --sensitivity "$tmp/bad" -o "$tmp/x"
