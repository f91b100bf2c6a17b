#!/bin/sh
# Tests of the pictures of the program and of their tables:
# sh tests/program/pictures.sh path/to/harmorph path/to/meshes folder/for/output
harmorph=$1 meshes=$2 tmp=$3
rm -rf "$tmp"
mkdir -p "$tmp" || exit 2
topic=pictures log=$tmp/log
. "$(dirname "$0")/../count.sh"
refuses() { # refuses NAME TEXT ARGUMENTS...
    name=$1 text=$2; shift 2
    if "$harmorph" "$@" >"$tmp/message" 2>&1; then echo "accepted" >>"$tmp/message"; fi
    check "$name" grep -F -e "$text" "$tmp/message"
}
bodies=$meshes/two_bodies.su2
check "solve" "$harmorph" solve "$bodies" --curve left="$meshes/two_bodies_left.curve" \
    --curve right="$meshes/two_bodies_right.curve" --operator laplace --engine fas -o "$tmp/harmonic.basis"
check "solve" "$harmorph" solve "$bodies" --curve left="$meshes/two_bodies_left.curve" \
    --curve right="$meshes/two_bodies_right.curve" -o "$tmp/conformal.basis"
printf '1 .1 .02\n14 -.05 .1\n' >"$tmp/moves.txt"

# Every picture says what it shows, is whole, gives its scale along both axes, and holds its longest texts: a character
# is half as wide as high (DejaVu Sans, which is what many Linux systems have for sans-serif).
is_picture() { # is_picture FILE TITLE PANELS
    awk -v title="$2" -v panels="$3" '
        /<title>/ { titles += index($0, "<title>" title) > 0 }
        /<desc>..*<\/desc>/ { ++descriptions }
        { open += gsub(/<g[ >]/, "&"); closed += gsub(/<\/g>/, "&"); frames += gsub(/<clipPath/, "&") }
        /font-style="italic".*>x</ { ++x } /font-style="italic".*>y</ { ++y }
        /^<svg/ { match($0, /width="[0-9]*/); width = 0 + substr($0, RSTART + 7, RLENGTH - 7) }
        /^<text x="62"/ {
            match($0, /font-size="[0-9]*/); size = substr($0, RSTART + 11, RLENGTH - 11)
            text = $0; gsub(/<[^>]*>/, "", text)
            if (62 + 0.49 * size * length(text) > width) { print "too long: " text; long = 1 }
        }
        { last = $0 }
        END {
            print titles, descriptions, open, closed, frames, x, y, last
            if (long || !width) exit 1
            if (titles != 1 || descriptions != 1 || frames != panels) exit 1
            exit !(open == closed && x > 0 && y > 0 && last == "</svg>")
        }' "$1"
}
check "check: mesh" "$harmorph" check "$bodies" --svg "$tmp/mesh.svg"
check "the mesh is a picture" is_picture "$tmp/mesh.svg" "The mesh" 1
# Bodies are small in the mesh: the picture shows them, and the whole mesh in a corner. Without a body, with a large
# one, or with a window there is no corner.
insets() { grep -c 'class="inset"' "$1"; }
check "check: an airfoil" "$harmorph" check "$meshes/naca0012.su2" --svg "$tmp/airfoil.svg"
check "the airfoil fills the picture" test "$(insets "$tmp/airfoil.svg")" = 1
check "the airfoil: the scale is that of the airfoil" grep -q 'text-anchor="middle".*>0\.5</text>' "$tmp/airfoil.svg"
check "check: a window" "$harmorph" check "$meshes/naca0012.su2" --window=-9,-9,9,9 --svg "$tmp/far.svg"
check "a window has no corner" test "$(insets "$tmp/far.svg")" = 0
check "two bodies are not small in their mesh" test "$(insets "$tmp/mesh.svg")" = 0
check "the mesh: each marker is in the legend" \
    sh -c "grep -q '>left</text>' '$tmp/mesh.svg' && grep -q '>right</text>' '$tmp/mesh.svg'"
check "check: boundaries and curves" "$harmorph" check "$bodies" --boundaries --curve "$meshes/two_bodies_left.curve" \
    --curve "$meshes/two_bodies_right.curve" --svg "$tmp/boundaries.svg"
check "boundaries are a picture" is_picture "$tmp/boundaries.svg" "Boundaries of the mesh and its B-spline" 1
check "control points of all curves have their numbers" grep -q '>20</text>' "$tmp/boundaries.svg"
check "check: control volumes" "$harmorph" check "$bodies" --dual-volumes 700,701 --svg "$tmp/dual.svg"
check "control volumes are a picture" is_picture "$tmp/dual.svg" "Control volumes" 1
check "check: gradient volumes" "$harmorph" check "$bodies" --gradient-volumes 700 --svg "$tmp/gradient.svg"
check "gradient volumes are a picture" is_picture "$tmp/gradient.svg" "Volumes for the gradients" 1
n_points=$(sed -n 's/^NPOIN= //p' "$bodies")
refuses "a volume of no point" "--dual-volumes expects whole numbers between 0 and $((n_points - 1))" check "$bodies" \
    --dual-volumes "$n_points" --svg "$tmp/x"
check "export: one function" "$harmorph" export "$bodies" "$tmp/harmonic.basis" --function 12 --svg "$tmp/one.svg" \
    --csv "$tmp/values.csv" --contour-csv "$tmp/contours.csv" --window -1,-1,5,4
check "a function is a picture" is_picture "$tmp/one.svg" "Function of control point 12 (point 1 of curve 2)" 1
check "export: a complex function" "$harmorph" export "$bodies" "$tmp/conformal.basis" --function 12 \
    --svg "$tmp/complex.svg"
check "a complex function is a picture" is_picture "$tmp/complex.svg" "Function of control point 12" 1
check "export: four functions" "$harmorph" export "$bodies" "$tmp/harmonic.basis" --function 1,5,12,16 \
    --svg "$tmp/four.svg"
check "four functions are a picture of four panels" is_picture "$tmp/four.svg" "Functions of 4 control points" 4
check "panels are numbered by curve" grep -q '>Control point 16 (point 5 of curve 2): 0 to' "$tmp/four.svg"
check "export: two operators" "$harmorph" export "$bodies" "$tmp/harmonic.basis" --beside "$tmp/conformal.basis" \
    --function 12 --number 1,2 --svg "$tmp/beside.svg"
check "two operators are a picture of three panels" is_picture "$tmp/beside.svg" "Function of control point 12" 3
check "export: levels" "$harmorph" export "$bodies" "$tmp/harmonic.basis" --level 0,1,2,3 --svg "$tmp/levels.svg"
check "levels are a picture of four panels" is_picture "$tmp/levels.svg" "Levels of agglomeration" 4
check "known values have their volumes" test "$(grep -c '<path fill="#8d969e"' "$tmp/levels.svg")" -eq 4
check "morph" "$harmorph" morph "$bodies" "$tmp/harmonic.basis" --move "$tmp/moves.txt" -o "$tmp/moved.su2" \
    --svg "$tmp/morph.svg" --boundary-svg "$tmp/boundary.svg" --csv "$tmp/curves.csv"
check "a morph is a picture" is_picture "$tmp/morph.svg" "Mesh and B-spline" 1
check "a boundary is a picture" is_picture "$tmp/boundary.svg" "The boundary" 1
refuses "a list that is none" "--function expects whole numbers between 1 and 20" export "$bodies" \
    "$tmp/harmonic.basis" --function 1,,2 --svg "$tmp/x"
refuses "a table of several functions" "--csv and --vtu take exactly one function" \
    export "$bodies" "$tmp/harmonic.basis" \
    --function 1,2 --csv "$tmp/x"
refuses "an imaginary part of real functions" "--number" export "$bodies" "$tmp/harmonic.basis" --function 1 \
    --number 2 --svg "$tmp/x"
if [ -e "$tmp/x" ]; then fail "refused pictures leave a file"; fi

# Contour lines: each point lies on an edge of the mesh, where the function, linear along the edge, has the line's
# value, which is a multiple of the step; each line of each value is there: as many points as edges that it crosses.
contours_are_true() {
    awk -F '[ ,]' '
        FILENAME ~ /values/ { if (FNR > 1) { x[$1] = $2; y[$1] = $3; f[$1] = $4 } next }
        FILENAME ~ /su2$/ {
            if (/^NELEM/) inside = 1; else if (/^[A-Z]/) inside = 0; else if (inside) {
                n = $1 == 5 ? 3 : 4
                for (i = 0; i < n; i++) {
                    a = $(2 + i); b = $(2 + (i + 1) % n)
                    edge[a + 0 > b + 0 ? b " " a : a " " b] = 1
                }
            }
            next
        }
        FNR > 1 {
            ++points
            at[points] = $4 " " $5; value[points] = $2; levels[$2] = 1
            many[$2] += !seen[$2 " " $4 " " $5]++
        }
        END {
            size = 1e-9
            for (e in edge) {
                split(e, ends, " "); a = ends[1]; b = ends[2]
                for (v in levels) {
                    v += 0 # a number
                    if ((f[a] < v) == (f[b] < v)) continue
                    ++crossed[v]
                    t = (v - f[a]) / (f[b] - f[a])
                    expected[v, sprintf("%.7f %.7f", x[a] + t * (x[b] - x[a]), y[a] + t * (y[b] - y[a]))] = 1
                }
            }
            for (i = 1; i <= points; i++) {
                split(at[i], p, " ")
                if (!((value[i], sprintf("%.7f %.7f", p[1], p[2])) in expected)) {
                    ++lost
                    print "off:", value[i], at[i]
                }
                multiple = value[i] / .05; off = multiple - int(multiple + .5)
                if (off > 1e-9 || off < -1e-9) {
                    ++odd
                    print "not a multiple:", value[i]
                }
            }
            for (v in levels) if (many[v] != crossed[v]) {
                ++missing
                print "value", v, "crosses", crossed[v], "edges, and has", many[v], "points"
            }
            print points, lost + 0, odd + 0, missing + 0
            exit !(points > 100 && !lost && !odd && !missing)
        }' "$tmp/values.csv" "$bodies" "$tmp/contours.csv"
}
check "contour lines" contours_are_true

# The moved bodies cover the mesh before, and nothing else does.
check "morph: a picture" "$harmorph" morph "$bodies" "$tmp/conformal.basis" --move "$tmp/moves.txt" \
    --svg "$tmp/morph.svg"
check "morph: two bodies cover old lines" test "$(grep -c '<path fill="white" stroke="none"' "$tmp/morph.svg")" -eq 2

# Cells that are not convex are painted without overlaps: their triangles run the same way round.
awk -f "${0%/*}/../meshes/l_cells.awk" >"$tmp/l_cells.vtk"
check "solve on reflex cells" "$harmorph" solve "$tmp/l_cells.vtk" --rigid boundary2=.5,.5 --operator laplace \
    -o "$tmp/l_cells.basis"
check "picture of reflex cells" "$harmorph" export "$tmp/l_cells.vtk" "$tmp/l_cells.basis" --function 1 \
    --svg "$tmp/l_cells.svg"
check "reflex cells: one orientation" sh -c 'awk -f "$0" "$1" | grep -E "^0 [1-9][0-9]{2}"' "${0%/*}/orientations.awk" \
    "$tmp/l_cells.svg"

# The table of curves: control points move by moves.txt, points of the mesh to where they are in the morphed mesh.
curves_are_true() {
    awk -F '[ ,]' '
        function off(a, b) { return a > b ? a - b : b - a }
        FILENAME ~ /moves/ { dx[$1] = $2; dy[$1] = $3; next }
        FILENAME ~ /su2$/ {
            if (/^NPOIN/) { inside = 1; n = 0 }
            else if (/^[A-Z]/) inside = 0
            else if (inside) { x[n] = $1; y[n++] = $2 }
            next
        }
        $1 == "control" { ++controls; wrong += off($7 - $5, dx[$3]) > 1e-12 || off($8 - $6, dy[$3]) > 1e-12 }
        $1 == "mesh" { ++points; wrong += off($7, x[$3]) > 1e-9 || off($8, y[$3]) > 1e-9 }
        $1 == "curve" { ++samples; curves[$2] = 1; moved += $5 != $7 }
        END {
            for (c in curves) ++n_curves
            print controls, points, samples, n_curves, moved, wrong
            if (controls != 20 || points <= 100 || samples <= 200 || n_curves != 2) exit 1
            exit !(moved > 20 && moved < samples && wrong == 0)
        }' "$tmp/moves.txt" "$tmp/moved.su2" "$tmp/curves.csv"
}
check "curves in the table are those of the morph" curves_are_true

# Large meshes: thinned lines and pixels, small files. A square of 300 x 300 cells with a hole of 60 x 60 in its middle.
awk 'BEGIN {
    n = 300; lo = 120; hi = 180
    for (j = 0; j <= n; j++) for (i = 0; i <= n; i++) {
        if (i > lo && i < hi && j > lo && j < hi) continue
        number[i, j] = points + 0; at[points++] = i / n " " j / n
    }
    for (j = 0; j < n; j++) for (i = 0; i < n; i++) {
        if (i >= lo && i < hi && j >= lo && j < hi) continue
        cell[cells++] = "9 " number[i, j] " " number[i + 1, j] " " number[i + 1, j + 1] " " number[i, j + 1]
    }
    print "NDIME= 2\nNELEM= " cells; for (c = 0; c < cells; c++) print cell[c]
    print "NPOIN= " points; for (p = 0; p < points; p++) print at[p]
    print "NMARK= 2\nMARKER_TAG= body\nMARKER_ELEMS= " 4 * (hi - lo)
    for (k = lo; k < hi; k++) print "3 " number[k, lo] " " number[k + 1, lo] \
        "\n3 " number[k, hi] " " number[k + 1, hi] \
        "\n3 " number[lo, k] " " number[lo, k + 1] "\n3 " number[hi, k] " " number[hi, k + 1]
    print "MARKER_TAG= far\nMARKER_ELEMS= " 4 * n
    for (k = 0; k < n; k++) print "3 " number[k, 0] " " number[k + 1, 0] "\n3 " number[k, n] " " number[k + 1, n] \
        "\n3 " number[0, k] " " number[0, k + 1] "\n3 " number[n, k] " " number[n, k + 1]
}' >"$tmp/large.su2"
printf 'degree 1\nclosed tied\npoints 4\n.4 .4\n.6 .4\n.6 .6\n.4 .6\nknots 7\n0 0 1 2 3 4 4\n' >"$tmp/large.curve"
printf '1 -.01 -.005\n' >"$tmp/large.moves"
check "large: solve" "$harmorph" solve "$tmp/large.su2" --curve body="$tmp/large.curve" --operator laplace \
    -o "$tmp/large.basis"
check "large: mesh" "$harmorph" check "$tmp/large.su2" --window 0,0,1,1 --svg "$tmp/large-mesh.svg"
check "large: morph" "$harmorph" morph "$tmp/large.su2" "$tmp/large.basis" --move "$tmp/large.moves" \
    --svg "$tmp/large-morph.svg" --window 0,0,1,1
check "large: function" "$harmorph" export "$tmp/large.su2" "$tmp/large.basis" --function 1 \
    --svg "$tmp/large-function.svg" --window 0,0,1,1
# Lines that are close to each other are faint: the ink of an area is bounded, although the distances of lines differ.
ink() { # ink FILE: length of lines times width and opacity, by the area of the frame; paths are steps "dx dy"
    awk '/^<rect/ && /fill="none" stroke="#444"/ { match($0, / width="[0-9.]*/); w = substr($0, RSTART + 8, RLENGTH - 8)
            match($0, / height="[0-9.]*/); h = substr($0, RSTART + 9, RLENGTH - 9); if (w * h > area) area = w * h }
        /<path/ && /stroke="#5c6b78"/ {
            opacity = 1
            if (match($0, / opacity="[0-9.]*/)) opacity = substr($0, RSTART + 10, RLENGTH - 10)
            ++shades
            match($0, / d="[^"]*/); d = substr($0, RSTART + 4, RLENGTH - 4)
            gsub(/[lm]/, " &", d); gsub(/-/, " -", d); gsub(/[ML]/, " & ", d)
            n = split(d, part, /[ ,]+/); moving = 0; k = 1
            while (k <= n) {
                if (part[k] == "") { ++k; continue }
                if (part[k] == "M") { moving = 1; ++k; continue }
                if (part[k] ~ /^[a-z]/) sub(/^[a-z]/, "", part[k])
                if (moving) { moving = 0; k += 2; continue }
                total += .6 * opacity * sqrt(part[k] ^ 2 + part[k + 1] ^ 2); k += 2
            }
        }
        END { print shades, total / area }' "$1"
}
graded() { # graded COLUMNS ROWS RATIO: a square whose rows grow from the bottom to the top by this ratio of heights
    awk -v m="$1" -v n="$2" -v ratio="$3" 'BEGIN {
        print "NDIME= 2\nNELEM= " m * n
        for (j = 0; j < n; j++) for (i = 0; i < m; i++) {
            k = j * (m + 1) + i
            print 9, k, k + 1, k + m + 2, k + m + 1
        }
        print "NPOIN= " (m + 1) * (n + 1)
        for (j = 0; j <= n; j++) for (i = 0; i <= m; i++) print i / m, (exp(log(ratio) * j / n) - 1) / (ratio - 1)
        print "NMARK= 1\nMARKER_TAG= all\nMARKER_ELEMS= " 2 * (m + n)
        for (i = 0; i < m; i++) print 3, i, i + 1 "\n" 3, n * (m + 1) + i, n * (m + 1) + i + 1
        for (j = 0; j < n; j++)
            print 3, j * (m + 1), (j + 1) * (m + 1) "\n" 3, j * (m + 1) + m, (j + 1) * (m + 1) + m
    }'
}
for case in "190 190 200" "80 450 1000"; do
    graded $case >"$tmp/graded.su2"
    check "graded, $case: picture" "$harmorph" check "$tmp/graded.su2" --svg "$tmp/graded.svg"
    check "graded, $case: lines in at least three shades, and paper between them" sh -c '
        set -- $(cat "$1"); [ "$1" -ge 3 ] && awk -v ink="$2" "BEGIN { print ink; exit !(ink > .04 && ink < .3) }"' \
        sh "$(ink "$tmp/graded.svg" >"$tmp/ink"; cat "$tmp/ink" >>"$log"; echo "$tmp/ink")"
done
is_thinned() { # is_thinned FILE VISIBLE: says so, of so many edges
    sed -n 's/.*Thinned: \([0-9]*\) of \([0-9]*\) visible edges.*/\1 \2/p' "$1" |
        awk -v all="$2" '{ print; good = $1 > 20000 && $1 <= 80000 && (all == 0 || $2 == all) } END { exit !good }'
}
check "large: edges are thinned" is_thinned "$tmp/large-mesh.svg" $((2 * 300 * 301 - 2 * 60 * 59))
check "large: edges of a morph are thinned" is_thinned "$tmp/large-morph.svg" 0
# The rows of pixels cover as much of the frame as the mesh covers of the window.
covers() {
    awk '!width && /^<rect x=.*stroke="#444"/ { split($0, part, "\""); width = part[6]; height = part[8] }
        /shape-rendering="crispEdges"/ {
            sub(/.* d="/, "")
            n = split($0, run, "h")
            for (i = 2; i <= n; i += 2) area += run[i]
        }
        END {
            side = width < height ? width : height
            print area, side * side * .96
            exit !(area > .95 * side * side && area < .97 * side * side)
        }' "$1"
}
check "large: pixels cover the mesh, and not the hole" covers "$tmp/large-function.svg"
check "large: the picture says that it is drawn pixel by pixel" grep -q 'drawn pixel by pixel' "$tmp/large-function.svg"
for file in large-mesh large-morph large-function; do
    check "large: $file.svg is small" test "$(wc -c <"$tmp/$file.svg")" -lt 2000000
done
# Each picture is XML in the judgement of another program.
if command -v xmllint >/dev/null; then
    for file in "$tmp"/*.svg; do check "$(basename "$file") is XML" xmllint --noout "$file"; done
else
    skip "pictures read as XML" "xmllint is not installed (Debian's libxml2-utils)"
fi

finish
