# Tables of numbers at points, as people's programs spell the columns: the same rows in any order and spelling give the
# same bits, and rows that nothing assigns to points are refused.

tables=$tmp/tables
mkdir -p "$tables"
makes fit "$ring" --marker body --points 8 -o "$tables/curve"
makes solve "$ring" --curve "body=$tables/curve" -o "$tables/basis"
# table HEADING FORMAT SHIFT: the derivatives of the ring's points, where the rows begin with point SHIFT times another
# number, and columns are those of awk's FORMAT of n, x, y, dx, dy.
table() {
    awk -v heading="$1" -v format="$2" -v shift="$3" -v n=0 '/^NPOIN/ { inside = 1; next } /^[A-Z]/ { inside = 0 }
        inside { x[n] = $1; y[n++] = $2 }
        END {
            print heading
            for (i = 0; i < n; i++) {
                k = (i * 35 + shift) % n   # 35 and 624 have no common divisor
                scale = 1 + x[k] * x[k] + y[k] * y[k]
                row = format
                gsub(/N/, k, row); gsub(/X/, sprintf("%.17g", x[k]), row); gsub(/Y/, sprintf("%.17g", y[k]), row)
                gsub(/A/, sprintf("%.17g", sin(3 * k) / scale), row)
                gsub(/B/, sprintf("%.17g", cos(5 * k) / scale), row)
                print row
            }
        }' "$ring"
}
table '# point dx dy' 'N A B' 0 >"$tables/plain.txt"
makes adjoint "$ring" "$tables/basis" --sensitivity "$tables/plain.txt" -o "$tables/wanted"
gives_the_gradient() { # gives_the_gradient NAME FILE OPTION...
    name=$1 file=$2; shift 2
    runs "tables: $name" 0 adjoint "$ring" "$tables/basis" --sensitivity "$file" -o "$tables/found" "$@"
    grep -v '^#' "$tables/wanted" >"$tables/a"
    grep -v '^#' "$tables/found" >"$tables/b"
    check "tables: $name: the same bits" cmp "$tables/a" "$tables/b"
}
refused_gradient() { # refused_gradient NAME TEXT FILE OPTION...
    name=$1 text=$2 file=$3; shift 3
    refuses "tables: $name" 3 "$text" adjoint "$ring" "$tables/basis" --sensitivity "$file" -o "$tmp/x" "$@"
}

# Numbers alone.
shift_of=7
for number in PointID 'Point ID' '"Point ID"' point point_id 'Point Index' PointIds Global_Index GLOBAL_INDEX \
    GlobalPointIds vtkOriginalPointIds '"vtkOriginalPointIds"'; do
    table "jx,$number,jy" 'A,N,B' $shift_of >"$tables/one.csv"
    gives_the_gradient "the numbers $number" "$tables/one.csv" --x jx --y jy
    shift_of=$((shift_of + 31))
done
# Coordinates alone: each line has those of x and of y.
while read -r x y; do
    table "$x,$y,jx,jy" 'X,Y,A,B' $shift_of >"$tables/one.csv"
    gives_the_gradient "the coordinates $x $y" "$tables/one.csv" --x jx --y jy
    shift_of=$((shift_of + 31))
done <<END
x y
X Y
x_coord y_coord
"x_coord" "y_coord"
x-coordinate y-coordinate
X_Coordinate Y_Coordinate
CoordinateX CoordinateY
CoordsX CoordsY
Points_0 Points_1
"Points_0" "Points_1"
Points:0 Points:1
Points[0] Points[1]
coordinates_0 coordinates_1
Coords:0 Coords:1
Position_X Position_Y
X:0 X:1
X_0 X_1
END
for unit in '[m]' '[ m ]' '(m)' '[inch]'; do
    table "\"x $unit\",y $unit,jx,jy" 'X,Y,A,B' $shift_of >"$tables/one.csv"
    gives_the_gradient "the coordinates x $unit" "$tables/one.csv" --x jx --y jy
    shift_of=$((shift_of + 31))
done
# Both, with other columns between, and the components of vectors as ParaView names them. Rows of a part of the mesh
# have numbers of the part and of the whole mesh: those of the whole mesh count.
table '"Point ID","Points_0","Points_1","Points_2","Sensitivity_0","Sensitivity_1","Sensitivity_2","Points_Magnitude"' \
    'N,X,Y,0,A,B,0,1' 5 >"$tables/paraview.csv"
gives_the_gradient "ParaView's columns" "$tables/paraview.csv" --x Sensitivity_0 --y Sensitivity_1
gives_the_gradient "ParaView's vector" "$tables/paraview.csv" --vector Sensitivity
gives_the_gradient "ParaView's vector, in no order" "$tables/paraview.csv" --in-order
table 'Point ID,dJ:0,dJ:1,vtkOriginalPointIds,X:0,X:1' '3,A,B,N,X,Y' 11 >"$tables/part.csv"
gives_the_gradient "the numbers of a part" "$tables/part.csv" --vector dJ

# Numbers that programs count from 1 are not taken: the coordinates say where the rows are.
table 'nodenumber,x-coordinate,y-coordinate,jx,jy' '1N,X,Y,A,B' 3 >"$tables/fluent.csv"
gives_the_gradient "numbers from 1 beside coordinates" "$tables/fluent.csv" --x jx --y jy
table 'nodenumber,jx,jy' 'N,A,B' 3 >"$tables/fluent.csv"
refused_gradient "numbers from 1 alone" "'nodenumber', 'jx', 'jy'" "$tables/fluent.csv" --x jx --y jy

# Rows without numbers and coordinates are taken in their order only where this is asked for.
for heading in 'jx,jy' 'a_0,jx,jy' 'Points_1,jx,jy' 'x0,y0,jx,jy'; do
    n=$(echo "$heading" | tr -cd , | wc -c)
    table "$heading" "$(case $n in 1) echo A,B ;; 2) echo 1,A,B ;; *) echo 1,2,A,B ;; esac)" 0 >"$tables/shuffled.csv"
    listed=$(echo "'$heading'" | sed "s/,/', '/g")
    refused_gradient "no place: $heading" "the columns are $listed" "$tables/shuffled.csv" --x jx --y jy
    check "tables: no place: $heading: says what to do" says 'give --in-order'
done
{ head -n 1 "$tables/paraview.csv"; tail -n +2 "$tables/paraview.csv" | sort -t, -k 1n; } | cut -d, -f 5,6 \
    >"$tables/ordered.csv"
gives_the_gradient "in order" "$tables/ordered.csv" --vector Sensitivity --in-order
refused_gradient "in order, not asked for" 'give --in-order' "$tables/ordered.csv" --vector Sensitivity
sed 9d "$tables/ordered.csv" >"$tables/short.csv"
refused_gradient "in order, a row is missing" 'but the mesh has' "$tables/short.csv" --vector Sensitivity --in-order

# Coordinates are compared with the mesh in every spelling, also beside numbers and with --in-order.
for heading in 'Points:0,Points:1,Point ID,jx,jy' 'X,Y,other,jx,jy' 'x [m],y [m],Global_Index,jx,jy'; do
    table "$heading" 'X,Y,N,A,B' 13 | sed '17s/^[^,]*/4.25/' >"$tables/moved.csv"
    for order in '' --in-order; do
        refused_gradient "a place of another mesh: $heading $order" \
            "moved.csv:17: the values are those of another mesh" "$tables/moved.csv" --x jx --y jy $order
    done
done
table 'Points:0,Points:1,Point ID,jx,jy' 'X,Y,N,A,B' 13 | awk -F, -v OFS=, '
    NR == 3 { $3 = $3 == 1 ? 2 : 1 } { print }' >"$tables/renumbered.csv"
refused_gradient "a number of another mesh" "if the numbers 'Point ID' are not those of this mesh" \
    "$tables/renumbered.csv" --x jx --y jy

# The other commands read the same tables. A linear field shows the points of the rows: its values say which they are.
table 'Point ID,Points:0,Points:1,f' 'N,X,Y,N' 17 >"$tables/field.csv"
table 'f,vtkOriginalPointIds' 'N,N' 19 >"$tables/numbers.csv"
table 'f,x [m],y [m]' 'N,X,Y' 23 >"$tables/places.csv"
for field in field numbers places; do
    runs "tables: interpolate: $field" 0 interpolate "$ring" "$tables/$field.csv" "$ring" -o "$tables/out.csv"
    check "tables: interpolate: $field: the points" awk -F, '
        NR == 1 { if ($0 != "point,x,y,f") exit 1 } NR > 1 { e = $1 - $4; if (e * e > 1e-18) exit 1 }' "$tables/out.csv"
    runs "tables: align: $field" 0 align "$ring" --to "$ring" --marker body --points 8 --fields "$tables/$field.csv" \
        --fields-out "$tables/out.csv"
    check "tables: align: $field: the columns" grep -q '^point,x,y,f,from_x,from_y$' "$tables/out.csv"
done
sed 's/,[^,]*$/,1/; 1s/,1$/,g/' "$tables/numbers.csv" >"$tables/nowhere.csv"
refuses "tables: interpolate: no place" 3 "the columns are 'f', 'g'" interpolate "$ring" "$tables/nowhere.csv" "$ring" \
    -o "$tmp/x"
refuses "tables: align: no place" 3 "the columns are 'f', 'g'" align "$ring" --to "$ring" --marker body \
    --fields "$tables/nowhere.csv" --fields-out "$tmp/x"

# Displacements of a wall: lines, tables of the wall in any order, and tables of all points.
awk '/^NPOIN/ { inside = 1; n = 0; next } /^[A-Z]/ { inside = 0 }
    inside && n < 48 { printf "%d %.17g %.17g\n", n, .01 * $1, -.02 * $2 } inside { n++ }' "$ring" >"$tables/wall.txt"
makes displace "$ring" --given body --wall "$tables/wall.txt" -o "$tables/wanted.su2"
{ echo 'dy,Point ID,dx'; sort -t ' ' -k 2 "$tables/wall.txt" | awk '{ print $3 "," $1 "," $2 }'; } >"$tables/wall-a.csv"
{ echo 'Point ID,displacement_0,displacement_1,displacement_2'
  awk '{ print $1 "," $2 "," $3 ",0" } END { for (k = NR; k < 624; k++) print k ",7,8,9" }' "$tables/wall.txt" |
      sort -r; } >"$tables/wall-b.csv"
{ echo 'dx,dy'; awk '{ print $2 "," $3 } END { for (k = NR; k < 624; k++) print "7,8" }' "$tables/wall.txt"
} >"$tables/wall-c.csv"
for wall in a b 'c --in-order'; do
    runs "tables: displace: $wall" 0 displace "$ring" --given body --wall "$tables/wall-${wall%% *}.csv" \
        $(echo "$wall" | cut -s -d ' ' -f 2) -o "$tables/found.su2"
    check "tables: displace: $wall: the same bits" cmp "$tables/wanted.su2" "$tables/found.su2"
done
refuses "tables: displace: no place" 3 "the columns are 'dx', 'dy'" displace "$ring" --given body \
    --wall "$tables/wall-c.csv" -o "$tmp/x"
refuses "tables: displace: no displacement" 3 "no column 'displacement_x'" displace "$ring" --given body \
    --wall "$tables/field.csv" -o "$tmp/x"
makes solve "$ring" --given body --mode "$tables/wall.txt" -o "$tables/mode-a"
makes solve "$ring" --given body --mode "$tables/wall-b.csv" -o "$tables/mode-b"
check "tables: solve --mode: the same bits" cmp "$tables/mode-a" "$tables/mode-b"

# CSV files as RFC 4180 says: what the program writes it reads back as the same names and numbers.
names_of() { # the header of fields, in XML, and in CSV
    cat <<'END'
a,b|"a,b"
say &quot;hi&quot;|"say ""hi"""
&quot;|""""
&lt;p&gt; &amp; &#39;q&apos;|<p> & 'q'
two&#10;lines|"two
lines"
&#228;&#x20AC;&#x1F600;|ä€😀
 blank |" blank "
#hash|"#hash"
&amp;amp;&nbsp;&|&amp;&nbsp;&
,|","
plain|plain
END
}
makes convert "$ring" "$tables/ring.vtu"
{
    sed '/<Points>/,$d' "$tables/ring.vtu"
    echo '<PointData>'
    names_of | grep '|' | cut -d '|' -f 1 | while IFS= read -r name; do
        k=$((${k-0} + 1))
        echo "<DataArray type=\"Float64\" Name=\"$name\" format=\"ascii\">"
        awk -v k=$k 'BEGIN { for (i = 0; i < 624; i++) print i + k / 16 }'
        echo '</DataArray>'
    done
    echo '</PointData>'
    sed -n '/<Points>/,$p' "$tables/ring.vtu"
} >"$tables/names.vtu"
runs "tables: names" 0 interpolate "$tables/ring.vtu" "$tables/names.vtu" "$tables/ring.vtu" -o "$tables/names.csv"
names_of | sed 's/^[^|]*|//' | paste -s -d , | sed 's/^/point,x,y,/; s/two,lines/two\
lines/' >"$tables/header"
check "tables: names: as RFC 4180 quotes them" sh -c 'head -n 2 "$1" | cmp - "$2"' sh "$tables/names.csv" \
    "$tables/header"
runs "tables: names: CSV again" 0 interpolate "$tables/ring.vtu" "$tables/names.csv" "$tables/ring.vtu" \
    -o "$tables/again.csv"
check "tables: names: CSV again: the same bytes" cmp "$tables/names.csv" "$tables/again.csv"
runs "tables: names: to VTU" 0 interpolate "$tables/ring.vtu" "$tables/again.csv" "$tables/ring.vtu" \
    -o "$tables/again.vtu"
runs "tables: names: from VTU" 0 interpolate "$tables/ring.vtu" "$tables/again.vtu" "$tables/ring.vtu" \
    -o "$tables/last.csv"
check "tables: names: from VTU: the same bytes" cmp "$tables/names.csv" "$tables/last.csv"
for column in 'a,b' 'say "hi"' ','; do
    runs "tables: the column $column" 0 interpolate "$tables/ring.vtu" "$tables/names.csv" "$tables/ring.vtu" \
        --field "$column" -o "$tables/one.csv"
done
if command -v python3 >/dev/null; then
    check "tables: names: Python reads the same names" python3 - "$tables/names.csv" "$tables/again.vtu" <<'END'
import csv, sys, xml.etree.ElementTree as tree
rows = list(csv.reader(open(sys.argv[1], newline="", encoding="utf-8")))
assert len(rows) == 625 and {len(row) for row in rows} == {14}, len(rows)
arrays = tree.parse(sys.argv[2]).getroot().findall(".//PointData/DataArray")
assert [array.get("Name") for array in arrays] == rows[0][3:], rows[0]
END
fi
# Line ends, blanks outside of quotation marks, and a mark of the byte order are no part of a cell.
for ends in '\r\n' '\r' '\n\n'; do
    { printf '\357\273\277'; sed 's/,/ , /g' "$tables/paraview.csv" | awk -v ORS="$ends" 1; } >"$tables/ends.csv"
    gives_the_gradient "line ends $ends" "$tables/ends.csv" --vector Sensitivity
done
sed '1s/"Points_1"/"Points_1" one/' "$tables/paraview.csv" >"$tables/bad.csv"
refused_gradient "text behind a quotation" 'bad.csv:1: a comma or the end of the line must follow' "$tables/bad.csv"
sed '5s/^/"/' "$tables/paraview.csv" >"$tables/bad.csv"
refused_gradient "a quotation without an end" 'bad.csv:5: this quotation mark is not closed' "$tables/bad.csv"
sed '7s/,[^,]*$//' "$tables/paraview.csv" >"$tables/bad.csv"
refused_gradient "a cell too few" 'bad.csv:7: the file needs 8 columns as in the first line here' "$tables/bad.csv"

# Edges far shorter than the extent of the mesh, as at a wall: 1e-5 of a mesh of 100 chords. The field is 1e5 times y.
fine=$tables/fine.su2
awk 'BEGIN {
    split("0 1 100", x); split("0 1e-5 2e-5 1 100", y)
    print "NDIME= 2\nNELEM= 8"
    for (i = 0; i < 2; i++) for (j = 0; j < 4; j++) print 9, 5*i + j, 5*i + 5 + j, 5*i + 6 + j, 5*i + 1 + j
    print "NPOIN= 15"
    for (i = 1; i <= 3; i++) for (j = 1; j <= 5; j++) print x[i], y[j]
    print "NMARK= 1\nMARKER_TAG= box\nMARKER_ELEMS= 12"
    for (i = 0; i < 2; i++) print 3, 5*i, 5*i + 5 "\n" 3, 5*i + 9, 5*i + 4
    for (j = 0; j < 4; j++) print 3, j + 1, j "\n" 3, 10 + j, 11 + j
}' >"$fine"
# fine_table FORMAT ROWS...: a table of the rows NUMBER:POINT, with x and y in printf's format.
fine_table() {
    format=$1; shift
    awk -v format="$format" -v rows="$*" '/^NPOIN/ { inside = 1; next } /^[A-Z]/ { inside = 0 }
        inside { x[n] = $1; y[n++] = $2 }
        END { m = split(rows, row)
            print "PointID,x,y,f"
            for (k = 1; k <= m; k++) {
                split(row[k], numbers, ":")   # the number that the row says, and the point
                printf "%d," format "," format ",%.17g\n", numbers[1], x[numbers[2]], y[numbers[2]], 1e5 * y[numbers[2]]
            } }' n=0 "$fine"
}
field_is_right() { tail -n +2 "$tables/out.csv" | awk -F, '$4 != 1e5 * $3 { bad = 1 } END { exit bad || NR != 15 }'; }
in_order="0:0 1:1 2:2 3:3 4:4 5:5 6:6 7:7 8:8 9:9 10:10 11:11 12:12 13:13 14:14"
swapped="0:1 1:0 2:2 3:3 4:4 5:6 6:7 7:5 8:8 9:9 10:10 11:11 12:12 13:13 14:14"
moved="1:1 2:2 3:3 4:4 5:5 6:6 7:7 8:8 9:9 10:10 11:11 12:12 13:13 14:14 0:0"
for format in %.17g %.9g %.6g %.6f; do
    for rows in "$in_order" "$swapped" "$moved"; do
        fine_table $format $rows | sed 's/^PointID/n/' >"$tables/fine.csv"
        runs "tables: short edges, $format: $rows" 0 interpolate "$fine" "$tables/fine.csv" "$fine" \
            --field f -o "$tables/out.csv"
        check "tables: short edges, $format: $rows: values of their points" field_is_right
    done
    fine_table $format $moved >"$tables/fine.csv"
    runs "tables: short edges, $format: numbers" 0 interpolate "$fine" "$tables/fine.csv" "$fine" -o "$tables/out.csv"
    check "tables: short edges, $format: numbers: values of their points" field_is_right
    fine_table $format $swapped >"$tables/fine.csv"
    refuses "tables: short edges, $format: numbers of other points" 3 'point 0 of this mesh is at (0, 0), not at (0, ' \
        interpolate "$fine" "$tables/fine.csv" "$fine" -o "$tmp/x"
done
# Digits that do not tell neighbours apart: rows in the order of the mesh belong to the points of their places.
fine_table %.4f $in_order | sed 's/^PointID/n/' >"$tables/four.csv"
runs "tables: equal digits in the order of the mesh" 0 interpolate "$fine" "$tables/four.csv" "$fine" --field f \
    -o "$tables/out.csv"
check "tables: equal digits in the order of the mesh: values of their points" field_is_right
