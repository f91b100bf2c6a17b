# Fields of one mesh on another, and meshes that are moved to the shape of a reference mesh.

mesh=$tmp/demo/mesh.su2 basis=$tmp/demo/airfoil.basis
[ -e "$basis" ] || makes demo "$tmp/demo" --mesh "$meshes/naca0012.su2"
fine=$tmp/demo/fine.su2
# A linear field, and one that is smooth near the body.
fields_of() {   # MESH
    awk 'BEGIN { print "Linear,Smooth" } /^NPOIN/ { inside = 1; next } /^[A-Z]/ { inside = 0 }
        inside { printf "%.17g,%.17g\n", 2 + 3 * $1 - $2, cos(2 * $1) * sin(3 * $2) }' "$1"
}
fields_of "$mesh" >"$tmp/fields.csv"
runs "fields: to a finer mesh" 0 interpolate "$mesh" "$tmp/fields.csv" "$fine" --in-order -o "$tmp/fine.csv" --json
check "fields: no point is outside" test "$(number outside)" = 0
check "fields: linear ones are exact" awk -F, '
    NR > 1 { e = $4 - (2 + 3 * $2 - $3); scale = 1 + $2 * $2 + $3 * $3; if (e * e > 1e-26 * scale) exit 1 }' \
    "$tmp/fine.csv"
check "fields: smooth ones are near" awk -F, '
    NR > 1 && $2 * $2 + $3 * $3 < 1 { e = $5 - cos(2 * $2) * sin(3 * $3); if (e > .02 || e < -.02) exit 1 }' \
    "$tmp/fine.csv"
check "fields: one row for each point" test "$(wc -l <"$tmp/fine.csv")" = \
    "$((1 + $(sed -n 's/^NPOIN= *//p' "$fine")))"
runs "fields: a column" 0 interpolate "$mesh" "$tmp/fields.csv" "$fine" --in-order --field Smooth --threads 2 \
    -o "$tmp/one.csv"
check "fields: the column has the same bits with two threads" sh -c \
    'cut -d, -f1-3,5 "$1" | cmp - "$2"' sh "$tmp/fine.csv" "$tmp/one.csv"
runs "fields: to VTU" 0 interpolate "$mesh" "$tmp/fields.csv" "$fine" --in-order -o "$tmp/fine.vtu"
runs "fields: from VTU to the same points" 0 interpolate "$fine" "$tmp/fine.vtu" "$fine" -o "$tmp/again.csv"
check "fields: the same numbers" sh -c 'tail -n +2 "$1" >"$3"; tail -n +2 "$2" | cmp - "$3"' sh \
    "$tmp/fine.csv" "$tmp/again.csv" "$tmp/rows"

# Points outside get values of the boundary, and are counted.
makes morph "$mesh" "$basis" --move "$tmp/demo/moves.txt" -o "$tmp/design.su2"
runs "fields: points outside" 0 interpolate "$mesh" "$tmp/fields.csv" "$tmp/design.su2" --in-order -o "$tmp/out.csv"
check "fields: they are counted" says ' points outside '
refuses "fields: too far outside" 1 'points outside' interpolate "$mesh" "$tmp/fields.csv" "$tmp/design.su2" \
    --in-order --max-outside 1e-6 -o "$tmp/x"
refuses "fields: a column that is not there" 3 "there is no column 'Mach'" interpolate "$mesh" "$tmp/fields.csv" \
    "$fine" --in-order --field Mach -o "$tmp/x"
refuses "fields: rows of another mesh" 3 'but the mesh has' interpolate "$fine" "$tmp/fields.csv" "$mesh" --in-order \
    -o "$tmp/x"
head -3 "$tmp/fine.csv" >"$tmp/few.csv"
refuses "fields: too few rows" 3 '2 rows, but' interpolate "$fine" "$tmp/few.csv" "$mesh" -o "$tmp/x"
sed '3s/,.*/,nan/' "$tmp/fields.csv" >"$tmp/nan.csv"
refuses "fields: NaN" 3 'needs a finite number' interpolate "$mesh" "$tmp/nan.csv" "$fine" --in-order -o "$tmp/x"
printf 'PointID,x,y\n' >"$tmp/places.csv"
awk '/^NPOIN/ { inside = 1; next } /^[A-Z]/ { inside = 0 } inside { print n++ "," $1 "," $2 }' "$mesh" \
    >>"$tmp/places.csv"
refuses "fields: none" 3 'has no fields' interpolate "$mesh" "$tmp/places.csv" "$fine" -o "$tmp/x"

# The design goes back to the shape of the reference, and fields that moved with the design are those of the
# reference: the coordinates before the movement tell how far.
fields_of "$mesh" >"$tmp/of_design.csv"
tail -n +2 "$tmp/of_design.csv" >"$tmp/rows_of_design"
runs "align: a design to the reference" 0 align "$tmp/design.su2" --to "$mesh" --marker airfoil \
    --fields "$tmp/of_design.csv" --in-order --fields-out "$tmp/aligned.csv" -o "$tmp/aligned.su2" --json
check "align: the wall is that of the reference" awk -v d="$(number max_distance)" 'BEGIN { exit !(d < 1e-4) }'
sed '1s/,[^,]*$/,from_x/' "$tmp/of_design.csv" >"$tmp/from.csv"
refuses "align: a field with a name that is taken" 2 'a field cannot have the name from_x' align "$tmp/design.su2" \
    --to "$mesh" --marker airfoil --fields "$tmp/from.csv" --in-order --fields-out "$tmp/x"
runs "align: the aligned mesh" 0 check "$tmp/aligned.su2"
check "align: fields follow the points" awk -F, '
    NR > 1 && $2 * $2 + $3 * $3 < 1 { e = $4 - (2 + 3 * $2 - $3); if (e > .05 || e < -.05) exit 1 }' \
    "$tmp/aligned.csv"
check "align: the columns" grep -q '^point,x,y,Linear,Smooth,from_x,from_y$' "$tmp/aligned.csv"
runs "align: back to the points of the design" 0 interpolate "$mesh" "$tmp/aligned.csv" "$tmp/aligned.su2" \
    --field Linear -o "$tmp/back.csv"
check "align: the values of the design" sh -c 'tail -n +2 "$1" | paste -d, - "$2" | awk -F, "
    \$2 * \$2 + \$3 * \$3 < 1 { e = \$4 - \$5; if (e > .02 || e < -.02) exit 1 }"' sh \
    "$tmp/back.csv" "$tmp/rows_of_design"
refuses "align: no output" 2 '-o or --fields-out is required' align "$mesh" --to "$tmp/design.su2" --marker airfoil
refuses "align: fields without a place" 2 '--fields needs --fields-out' align "$mesh" --to "$tmp/design.su2" \
    --marker airfoil --fields "$tmp/fields.csv" -o "$tmp/x"
refuses "align: a marker that is not there" 2 "has no marker 'wing'" align "$mesh" --to "$tmp/design.su2" \
    --marker wing -o "$tmp/x"
