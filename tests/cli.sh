#!/bin/sh
# Tests of the program: sh tests/cli.sh path/to/harmorph path/to/meshes folder/for/output
if [ $# -ne 3 ]; then
    echo "usage: sh tests/cli.sh HARMORPH MESHES OUTPUT" >&2
    exit 2
fi
harmorph=$1 meshes=$2 tmp=$3/cli-test
rm -rf "$tmp" # some checks look for files that must not be there
mkdir -p "$tmp" || exit 2
topic=program log=$tmp/log
. "$(dirname "$0")/count.sh"

says() { grep -F -e "$1" "$tmp/out" "$tmp/err" >/dev/null; }
runs() { # runs NAME EXIT-CODE ARGUMENTS...: the program ends with this code; its output is in out and err
    name=$1 wanted=$2; shift 2
    "$harmorph" "$@" >"$tmp/out" 2>"$tmp/err"
    code=$?
    if [ $code -eq "$wanted" ]; then ok "$name"; else
        fail "$name: exit code $code and not $wanted"
        sed 's/^/     | /' "$tmp/err" | head -5
    fi
}
refuses() { # refuses NAME EXIT-CODE TEXT ARGUMENTS...: and the message contains the text
    name=$1 wanted=$2 text=$3; shift 3
    runs "$name" "$wanted" "$@"
    if grep -F -e "$text" "$tmp/err" >/dev/null; then ok "$name: says '$text'"; else
        fail "$name: does not say '$text'"
        sed 's/^/     | /' "$tmp/err" | head -5
    fi
}
has_keys() { # has_keys NAME KEY...: out is one JSON object of exactly these keys (keys of nested objects: name, faces)
    name=$1; shift
    keys=$(sed 's/{"name": [^}]*}//g' "$tmp/out" | grep -o '"[a-z_]*":' | tr -d '":' | tr '\n' ' ')
    if [ "$keys" = "$* " ] && [ "$(wc -l <"$tmp/out")" -eq 1 ]; then ok "$name"; else fail "$name: keys are $keys"; fi
}
leaves_nothing() { # leaves_nothing NAME FILE: neither the file nor a temporary one
    if ls "$2"* >/dev/null 2>&1; then fail "$1"; else ok "$1"; fi
}

# ---- Inputs ------------------------------------------------------------------------------------------------------

# A ring of quads, some split into triangles, between a circle of radius 1 and one of radius 4.
make_ring() { # make_ring POINTS-ROUND CELLS-OUTWARDS
    awk -v n="$1" -v m="$2" 'BEGIN {
    pi = atan2(0, -1)
    print "% a ring\nNDIME= 2\nNELEM= " n * m + n
    for (j = 0; j < m; j++) for (i = 0; i < n; i++) {
        a = j * n + i; b = j * n + (i + 1) % n
        if (j == m - 1) printf "5 %d %d %d\n5 %d %d %d\n", a, a + n, b, b, a + n, b + n
        else printf "9 %d %d %d %d %d\n", a, a + n, b + n, b, a
    }
    print "NPOIN= " n * (m + 1)
    for (j = 0; j <= m; j++) for (i = 0; i < n; i++) {
        r = exp(log(4) * j / m); t = 2 * pi * i / n
        printf "%.15f\t%.15f %d\n", r * cos(t), r * sin(t), j * n + i
    }
    print "NMARK= 2\nMARKER_TAG= body\nMARKER_ELEMS= " n
    for (i = 0; i < n; i++) print "3 " i " " (i + 1) % n
    print "MARKER_TAG= far\nMARKER_ELEMS= " n
    for (i = 0; i < n; i++) print "3 " m * n + i " " m * n + (i + 1) % n
}'
}
make_ring 48 12 >"$tmp/ring.su2"
ring=$tmp/ring.su2 curve=$tmp/ring.curve basis=$tmp/ring.basis

# The same ring as other programs write it: carriage returns, points first, odd blanks, and things that are passed over.
{
    echo 'NZONE= 1'
    echo 'NDIME=2 % two'
    sed -n '/^NPOIN/,/^NMARK/p' "$ring" | sed '$d; s/^NPOIN= \(.*\)/NPOIN = \1 \1/'
    sed -n '/^NELEM/,/^NPOIN/p' "$ring" | sed '$d; s/^\(9 .*\) [0-9]*$/ \1/'
    echo 'NMARK= 4'
    sed -n '/^MARKER_TAG= body/,/^MARKER_TAG= far/p' "$ring" | sed '$d; s/body/the body/; s/^3 /3	/'
    printf 'MARKER_TAG= 17\nMARKER_ELEMS= 49\n1 3\n'
    sed -n '/^MARKER_TAG= far/,$p' "$ring" | sed '1,2d'
    printf 'MARKER_TAG= SEND_RECEIVE\nMARKER_ELEMS= 1\nSEND_RECV= 1\n1 0 1\n'
    printf 'MARKER_TAG= SEND_RECEIVE\nMARKER_ELEMS= 1\nSEND_RECV= -1\n1 0 1\n'
    printf 'FFD_NBOX= 1\nFFD_CORNER_POINTS= 2\n0 0\n1 1\n\n'
} | awk '{ printf "%s\r\n", $0 }' >"$tmp/odd.su2"

broken() { sed "$2" "$ring" >"$tmp/$1.su2"; } # broken NAME SED-SCRIPT: a mesh with one thing wrong
no_moves=$tmp/none.txt
echo '# nothing moves' >"$no_moves"
printf '1 .05 0 # to the right\n\n3 0 -.02\n' >"$tmp/small.txt"
awk 'BEGIN { for (i = 1; i <= 12; i++) print i, 9, 0 }' >"$tmp/large.txt"

# ---- Usage -------------------------------------------------------------------------------------------------------

runs "--help" 0 --help
check "--help names the commands" says 'harmorph COMMAND --help'
runs "--version" 0 --version
for command in fit solve morph displace export check transfer explore demo; do
    runs "$command --help" 0 $command --help
    check "$command --help has an example" says "  harmorph $command "
done
refuses "no command" 2 'command is missing'
refuses "unknown command" 2 "'frobnicate'" frobnicate
refuses "unknown option" 2 "'--colour'" check --colour "$ring"
refuses "missing operand" 2 'MESH is missing' check
refuses "operand too many" 2 'too many' check "$ring" "$ring"
refuses "option without its value" 2 '--marker' fit "$ring" -o "$curve" --marker
refuses "missing -o" 2 '-o is missing' fit "$ring" --marker body
refuses "a word for a number" 2 "'many'" fit "$ring" --marker body -o "$curve" --points many
refuses "degree out of range" 2 '--degree' fit "$ring" --marker body -o "$curve" --degree 6
refuses "unknown --closed" 2 '--closed' fit "$ring" --marker body -o "$curve" --closed maybe
refuses "more control points than points" 2 '--points' fit "$ring" --marker body -o "$curve" --points 49
refuses "unknown marker" 2 "'body', 'far'" fit "$ring" --marker wing -o "$curve"
refuses "two separate pieces of boundary" 2 'separate' fit "$ring" --marker body,far -o "$curve"
leaves_nothing "refused commands leave no file" "$curve"

# ---- The path ----------------------------------------------------------------------------------------------------

runs "check" 0 check "$ring" --json
has_keys "check: keys" points cells triangles quads polygons inverted min_area min_quality mean_quality markers
check "check: counts" says '"points": 624, "cells": 624, "triangles": 96, "quads": 528, "polygons": 0, "inverted": 0'
check "check: markers" says '"markers": [{"name": "body", "faces": 48}, {"name": "far", "faces": 48}]'
runs "fit" 0 fit "$ring" --marker=body --points 12 --closed periodic -o "$curve" --json
has_keys "fit: keys" points degree closed reason corners base_points backtracks max_error rms_error
check "fit: periodic file" grep -c 'closed periodic' "$curve"
runs "solve" 0 solve "$ring" --curve body="$curve" -o "$basis" --json --repeat 2
has_keys "solve: keys" points cells functions boundary_error partition_defect min_value max_value residual \
    iterations sweeps levels setup_seconds factor_seconds solve_seconds plan_bytes basis_bytes storage
check "solve: functions" says '"functions": 12'
for engine in multigrid fas; do
    runs "solve: $engine" 0 solve "$ring" --curve body="$curve" --operator laplace --engine $engine --levels 3 \
        --agglomeration directional --history "$tmp/$engine.csv" -o "$tmp/$engine.basis" --json
    check "solve: $engine: its levels" says '"levels": 3'
    check "solve: $engine: history from 1 to the tolerance" awk -F, 'NR == 1 { ok = $0 == "cycle,residual" }
        NR > 1 { ok = ok && $1 == NR - 2 && (NR > 2 || ($2 > .999 && $2 < 1.001)); last = $2 }
        END { exit !(ok && last <= 1e-10) }' \
        "$tmp/$engine.csv"
done
runs "export: a level" 0 export "$ring" "$tmp/fas.basis" --level 1 --svg "$tmp/level.svg"
check "export: a level: SVG is whole" grep -c '</svg>' "$tmp/level.svg"
refuses "export: a level that does not exist" 2 'no level' export "$ring" "$tmp/fas.basis" --level 19 \
    --svg "$tmp/none.svg"
refuses "an engine that does not go with the operator" 2 'goes with the direct engine only' solve "$ring" \
    --curve body="$curve" --engine multigrid -o "$tmp/none.basis"
refuses "unknown engine" 2 'direct, multigrid, fas' solve "$ring" --curve body="$curve" --engine fast \
    -o "$tmp/none.basis"
runs "solve: fas from zero" 0 solve "$ring" --curve body="$curve" --operator laplace --engine fas --start zero \
    -o "$tmp/fas.basis"
refuses "a start of an engine that has none" 2 '--start' solve "$ring" --curve body="$curve" --operator laplace \
    --engine multigrid --start zero -o "$tmp/none.basis"
refuses "levels without an engine that has them" 2 '--levels' solve "$ring" --curve body="$curve" --levels 3 \
    -o "$tmp/none.basis"
leaves_nothing "refused engines leave no file" "$tmp/none.basis"
runs "morph" 0 morph "$ring" "$basis" --move "$tmp/small.txt" -o "$tmp/small.su2" --vtu "$tmp/small.vtu" \
    --svg "$tmp/small.svg" --repeat 3 --json
has_keys "morph: keys" inverted admissible_step self_crossing boundary_error min_quality mean_quality morph_seconds \
    moved_curve
check "morph: the mesh is valid" says '"inverted": 0'
check "morph: the mesh moved" sh -c "! cmp -s '$ring' '$tmp/small.su2'"
check "morph: VTU is whole" grep -c '</VTKFile>' "$tmp/small.vtu"
check "morph: SVG is whole" grep -c '</svg>' "$tmp/small.svg"
runs "morph without files, for people" 0 morph "$ring" "$basis" --move "$tmp/small.txt"
runs "check of the morphed mesh" 0 check "$tmp/small.su2"
runs "zero move" 0 morph "$ring" "$basis" --move "$no_moves" -o "$tmp/same.su2" --json
check "zero move: the identical file" cmp "$ring" "$tmp/same.su2"
check "zero move: unlimited step is null" says '"admissible_step": null'
runs "a moved mesh only warns" 0 morph "$tmp/small.su2" "$basis" --move "$no_moves"
check "a moved mesh only warns: says so" says 'warning'
for kept in 5 100 4000; do
    head -c $kept "$basis" >"$tmp/short.basis"
    refuses "a basis file cut off after $kept bytes" \
        3 "short.basis: the file is cut off: it has $kept bytes, at least" \
        morph "$ring" "$tmp/short.basis" --move "$no_moves"
done
: >"$tmp/short.basis"
refuses "an empty basis file" 3 'short.basis: this is not a harmorph basis' morph "$ring" "$tmp/short.basis" \
    --move "$no_moves"
refuses "a mesh for a basis" 3 'this is not a harmorph basis' morph "$ring" "$ring" --move "$no_moves"
runs "export" 0 export "$ring" "$basis" --function 12 --csv "$tmp/f.csv" --vtu "$tmp/f.vtu" --svg "$tmp/f.svg"
check "export: CSV columns" sh -c "head -1 '$tmp/f.csv' | grep -Eqx 'point,x,y,(value,imaginary|xx,xy,yx,yy)'"
check "export: CSV lines" test "$(wc -l <"$tmp/f.csv")" -eq 625
refuses "export: function out of range" 2 '--function' export "$ring" "$basis" --function 13 --csv "$tmp/f.csv"
refuses "export: nothing to write" 2 'nothing to write' export "$ring" "$basis" --function 1
runs "solve with a free boundary" 0 solve "$ring" --curve body="$curve" --free far --operator laplace \
    -o "$tmp/free.basis"
runs "solve, bounded" 0 solve "$ring" --curve body="$curve" --operator laplace --scheme bounded \
    -o "$tmp/bounded.basis" --json
check "solve, bounded: no value below 0" says '"min_value": 0,'
runs "solve, nodal gradients" 0 solve "$ring" --curve body="$curve" --operator laplace --scheme nodal-gradient \
    -o "$tmp/nodal.basis"
runs "solve, nodal gradients by the paper's iteration" 0 solve "$ring" --curve body="$curve" --operator laplace \
    --scheme nodal-gradient --engine fas -o "$tmp/nodal.basis"
refuses "nodal gradients without correction go with fas" 2 'go with the engine fas only' solve "$ring" \
    --curve body="$curve" --operator laplace --scheme nodal-gradient-plain -o "$tmp/x"
refuses "the bounded scheme has no conformal operator" 2 'goes with the compact scheme only' solve "$ring" \
    --curve body="$curve" --scheme bounded -o "$tmp/x"
runs "solve twice" 0 solve "$ring" --curve body="$curve" -o "$tmp/again.basis"
check "solve twice: equal files" cmp "$basis" "$tmp/again.basis"
refuses "a marker with two conditions" 2 'two conditions' solve "$ring" --curve body="$curve" --free body -o "$tmp/x"
runs "solve: two curve files" 0 fit "$ring" --marker far --points 8 -o "$tmp/far.curve"
runs "solve: two curve files" 0 solve "$ring" --curve body="$curve" --curve far="$tmp/far.curve" -o "$tmp/two.basis" \
    --json
check "solve: numbers go on" says '"functions": 20'
runs "--storage single" 0 solve "$ring" --curve body="$curve" -o "$tmp/single.basis" --storage single --json
check "--storage single: says so" says '"storage": "single"'
check "--storage single: a smaller file" test "$(wc -c <"$tmp/single.basis")" -lt "$(($(wc -c <"$basis") * 2 / 3))"
runs "--storage single: morph" 0 morph "$ring" "$tmp/single.basis" --move "$tmp/small.txt" -o "$tmp/single.su2" --json
check "--storage single: the wall moves as the B-spline" grep -E '"boundary_error": ([0-9.]*e-1[5-9]|0)' "$tmp/out"
runs "--storage single: zero move" 0 morph "$ring" "$tmp/single.basis" --move "$no_moves" -o "$tmp/same.su2"
check "--storage single: zero move: the same file" cmp "$ring" "$tmp/same.su2"
runs "--storage single: export" 0 export "$ring" "$tmp/single.basis" --function 2 --csv "$tmp/single.csv"
refuses "--storage single: not with --safe" 2 'single precision' morph "$ring" "$tmp/single.basis" \
    --move "$tmp/small.txt" --safe
refuses "--storage: what there is" 2 'double, single' solve "$ring" --curve body="$curve" -o "$tmp/x" --storage half

# ---- Not usable: exit code 1 -------------------------------------------------------------------------------------

refuses "morph that inverts cells" 1 'admissible' morph "$ring" "$basis" --move "$tmp/large.txt" -o "$tmp/large.su2" \
    --json
leaves_nothing "morph that inverts cells: nothing written" "$tmp/large.su2"
has_keys "morph that inverts cells: JSON all the same" \
    inverted admissible_step self_crossing boundary_error min_quality mean_quality morph_seconds moved_curve
runs "morph that inverts cells, --force" 1 morph "$ring" "$basis" --move "$tmp/large.txt" -o "$tmp/large.su2" --force
check "--force writes" test -s "$tmp/large.su2"
refuses "check counts inverted cells" 1 'inverted' check "$tmp/large.su2"
refuses "solve refuses inverted cells" 3 "$tmp/large.su2:" solve "$tmp/large.su2" --curve body="$curve" -o "$tmp/x"
refuses "not converged" 1 'not converged' solve "$ring" --curve body="$curve" -o "$tmp/loose.basis" --tol 1e-30
leaves_nothing "not converged: nothing written" "$tmp/loose.basis"
runs "not converged, --force" 1 solve "$ring" --curve body="$curve" -o "$tmp/loose.basis" --tol 1e-30 --force
check "not converged, --force writes" test -s "$tmp/loose.basis"

# ---- SU2 as other programs write it ------------------------------------------------------------------------------

runs "odd file: check" 0 check "$tmp/odd.su2" --json
check "odd file: markers" says '[{"name": "17", "faces": 48}, {"name": "the body", "faces": 48}]'
check "odd file: says that FFD boxes stay" says 'FFD'
check "odd file: says that periodic blocks are ignored" says 'SEND_RECEIVE'
runs "odd file: fit" 0 fit "$tmp/odd.su2" --marker 'the body' --points 12 -o "$tmp/odd.curve"
runs "odd file: solve" 0 solve "$tmp/odd.su2" --curve "the body=$tmp/odd.curve" -o "$tmp/odd.basis"
runs "odd file: zero move" 0 morph "$tmp/odd.su2" "$tmp/odd.basis" --move "$no_moves" -o "$tmp/same.su2"
check "odd file: zero move gives the identical file" cmp "$tmp/odd.su2" "$tmp/same.su2"

# ---- Bad mesh files: exit code 3, file and line ------------------------------------------------------------------

bad_mesh() { # bad_mesh NAME LINE TEXT SED-SCRIPT
    broken bad "$4"
    refuses "$1" 3 "$tmp/bad.su2:$2: " check "$tmp/bad.su2"
    check "$1: says '$3'" says "$3"
}
points=628 # the line of NPOIN= in the ring's file
refuses "no such mesh" 3 'nowhere.su2' check "$tmp/nowhere.su2"
refuses "a folder for a mesh" 3 "$tmp" check "$tmp"
bad_mesh "three dimensions" 2 'NDIME= 2' 's/NDIME= 2/NDIME= 3/'
bad_mesh "several zones" 2 'zone' '2i\
NZONE= 2'
bad_mesh "element of another type" 4 'element type' '4s/^9/12/'
bad_mesh "element with too few points" 4 '4 points' '4s/.*/9 0 1 2/'
bad_mesh "index out of range" 4 'between 0 and 623' '4s/ 48 / 4800 /'
bad_mesh "negative index" 4 'between 0 and 623' '4s/ 48 / -48 /'
bad_mesh "word for an index" 4 "'x'" '4s/ 48 / x /'
bad_mesh "word for a coordinate" $((points + 3)) "'1.O'" "$((points + 3))s/^[^	]*/1.O/"
bad_mesh "infinite coordinate" $((points + 3)) "'inf'" "$((points + 3))s/^[^	]*/inf/"
bad_mesh "fewer elements than said" $points 'element 625 of 625' 's/NELEM= 624/NELEM= 625/'
bad_mesh "more elements than said" 627 'heading' 's/NELEM= 624/NELEM= 623/'
bad_mesh "count that is none" $points 'a count' 's/NPOIN= .*/NPOIN= many/'
bad_mesh "truncated in the points" 700 'point 72 of 624' '700,$d'
bad_mesh "truncated in the markers" 1304 'NMARK' '/MARKER_TAG= far/,$d'
bad_mesh "triangle in a marker" 1256 'element type 3' '1256s/.*/5 0 1 2/'
bad_mesh "two points in one cell" 4 '' '4s/.*/9 0 0 49 1/'
broken bad '/MARKER_TAG= far/,/MARKER_ELEMS/d; s/MARKER_ELEMS= 48/MARKER_ELEMS= 47/; s/NMARK= 2/NMARK= 1/; 1255d'
refuses "boundary edge on no marker" 3 "$tmp/bad.su2" check "$tmp/bad.su2"
head -c 3000 "$harmorph" >"$tmp/bad.su2"
refuses "a program for a mesh" 3 "$tmp/bad.su2:1: " check "$tmp/bad.su2"

# ---- Pictures ----------------------------------------------------------------------------------------------------

runs "morph: pictures" 0 morph "$ring" "$basis" --move "$tmp/small.txt" --svg "$tmp/whole.svg" --window -4,-4,4,4 \
    --boundary-svg "$tmp/boundary.svg"
check "morph: the window shows the far field" test "$(wc -c <"$tmp/whole.svg")" -gt "$(wc -c <"$tmp/small.svg")"
check "morph: the boundary picture has a circle for each point" test "$(grep -c '<circle.*r="3.2"' \
    "$tmp/boundary.svg")" -gt 47
for window in 1,2,3 1,2,3,4,5 1,1,1,2 2,0,1,1 a,b,c,d ,,,; do
    refuses "a window $window" 2 '--window expects' export "$ring" "$basis" --function 1 --svg "$tmp/x" --window $window
done

# ---- Given displacements ---------------------------------------------------------------------------------------------

# The displacements of the wall that a morph has made, given point by point, make the same mesh: wall points bit by bit.
wall_field() { # wall_field MESH MOVED: lines "point dx dy" of the first 48 points, which are on the wall
    awk 'FNR == 1 { file++ } /NPOIN=/ { n = 48; k = 0; next } n-- > 0 {
        if (file == 1) { x[k] = $1; y[k] = $2 } else printf "%d %.17g %.17g\n", k, $1 - x[k], $2 - y[k]
        k++ }' "$1" "$2"
}
for operator in conformal laplace weighted; do
    runs "displace: $operator: functions" 0 solve "$ring" --curve "body=$curve" --operator $operator -o "$tmp/by.basis"
    runs "displace: $operator: morph" 0 morph "$ring" "$tmp/by.basis" --move "$tmp/small.txt" -o "$tmp/by_curve.su2"
    wall_field "$ring" "$tmp/by_curve.su2" >"$tmp/wall.txt"
    runs "displace: $operator" 0 displace "$ring" --given body --wall "$tmp/wall.txt" --operator $operator \
        -o "$tmp/displaced.su2" --json
    has_keys "displace: $operator: keys" inverted admissible_step self_crossing min_quality mean_quality \
        factor_seconds displace_seconds
    check "displace: $operator: the mesh of the morph" awk 'NF == 3 && index($0, ".") { getline other <FILE2
        split(other, b); d = $1 - b[1]; e = $2 - b[2]; if (d * d + e * e > 1e-18) wrong++; n++; next }
        { getline other <FILE2 } END { exit wrong > 0 || n < 600 }' FILE2="$tmp/by_curve.su2" "$tmp/displaced.su2"
done
runs "displace: for people" 0 displace "$ring" --given body --wall "$tmp/wall.txt" --repeat 3 --vtu "$tmp/displaced.vtu"
check "displace: says seconds" says 'for the displacement'
check "displace: ParaView's file" grep -q displacement "$tmp/displaced.vtu"
sed '$d' "$tmp/wall.txt" >"$tmp/short.txt"
refuses "displace: a point is missing" 2 'point 47 is on a marker of given displacements, but is not in the list' \
    displace "$ring" --given body --wall "$tmp/short.txt" -o "$tmp/x"
{ cat "$tmp/wall.txt"; echo 60 0 0; } >"$tmp/foreign.txt"
refuses "displace: a point of no such marker" 2 'point 60 is on no marker whose displacements are given' \
    displace "$ring" --given body --wall "$tmp/foreign.txt" -o "$tmp/x"
{ cat "$tmp/wall.txt"; echo 3 1 1; } >"$tmp/twice.txt"
refuses "displace: two displacements" 2 'point 3 has two displacements' \
    displace "$ring" --given body --wall "$tmp/twice.txt" -o "$tmp/x"
echo '3 nan 0' >"$tmp/nan.txt"
refuses "displace: not a number" 3 "$tmp/nan.txt:1: expected a finite number, found 'nan'" \
    displace "$ring" --given body --wall "$tmp/nan.txt" -o "$tmp/x"
echo '624 0 0' >"$tmp/nan.txt"
refuses "displace: no such point" 3 'between 0 and 623' displace "$ring" --given body --wall "$tmp/nan.txt" -o "$tmp/x"
refuses "displace: no marker" 2 '--given is missing' displace "$ring" --wall "$tmp/wall.txt"
refuses "displace: a marker both given and slipping" 2 'two conditions' \
    displace "$ring" --given body --slip body --wall "$tmp/wall.txt"
awk '{ t = 2 * atan2(0, -1) * $1 / 48; print $1, cos(t + 2) - cos(t), sin(t + 2) - sin(t) }' "$tmp/wall.txt" \
    >"$tmp/turn.txt"
refuses "displace: inverted cells" 1 'of this displacement is admissible' \
    displace "$ring" --given body --wall "$tmp/turn.txt" --operator laplace -o "$tmp/x"
leaves_nothing "displace: inverted cells: no file" "$tmp/x"
runs "displace: inverted cells: by force" 1 displace "$ring" --given body --wall "$tmp/turn.txt" --operator laplace \
    -o "$tmp/forced.su2" --force
check "displace: inverted cells: the file by force" test -f "$tmp/forced.su2"
awk '{ $2 = $1 == 0 ? -9 : 0; $3 = 0; print }' "$tmp/wall.txt" >"$tmp/through.txt"
refuses "displace: a wall that crosses itself" 1 'the moved boundary crosses itself' \
    displace "$ring" --given body --wall "$tmp/through.txt" -o "$tmp/x"

# Safely, all of the way; beside a rigid body; and what does not go together.
worst_cell="cell quality start_quality x y"
safe_keys="turned_offset start_quality warning worst_cells $worst_cell $worst_cell $worst_cell $worst_cell $worst_cell"
runs "displace --safe" 0 displace "$ring" --given body --wall "$tmp/turn.txt" --operator laplace --safe \
    -o "$tmp/safe.su2" --json
has_keys "displace --safe: keys" inverted self_crossing min_quality mean_quality factor_seconds displace_seconds \
    step_fraction steps resolves strategy last_step_admissible $safe_keys
check "displace --safe: all of the way" says '"step_fraction": 1,'
check "displace --safe: no inverted cell" says '"inverted": 0,'
wall_field "$ring" "$tmp/safe.su2" >"$tmp/reached.txt"
check "displace --safe: the wall is where it shall be" awk '{ getline other <WALL; split(other, b)
    d = $2 - b[2]; e = $3 - b[3]; if (d * d + e * e > 1e-18) wrong++; n++ } END { exit wrong > 0 || n != 48 }' \
    WALL="$tmp/turn.txt" "$tmp/reached.txt"
runs "displace --safe: for people" 0 displace "$ring" --given body --wall "$tmp/turn.txt" --safe
check "displace --safe: says how" says '100 % of the way'
refuses "displace --safe: a wall that crosses itself" 1 'the moved boundary crosses itself' \
    displace "$ring" --given body --wall "$tmp/through.txt" --safe -o "$tmp/x"
runs "displace --safe --strict: poor cells" 1 displace "$ring" --given body --wall "$tmp/turn.txt" --safe \
    --min-quality 1 --strict -o "$tmp/x"
leaves_nothing "displace --safe --strict: no file" "$tmp/x"
refuses "displace --min-quality alone" 2 '--min-quality goes with --safe' \
    displace "$ring" --given body --wall "$tmp/wall.txt" --min-quality .5
refuses "displace --move without what moves" 2 '--move goes with --curve or --rigid' \
    displace "$ring" --given body --wall "$tmp/wall.txt" --move "$tmp/small.txt"
marker_points() { # marker_points MESH MARKER: their numbers and coordinates
    awk -v marker="$2" '/NPOIN=/ { n = $2; k = 0; next } n > 0 { x[k] = $1; y[k++] = $2; n--; next }
        /MARKER_TAG=/ { on = $2 == marker; next } on && $1 == 3 { for (i = 2; i <= 3; i++) if (!($i in seen)) {
            seen[$i] = 1; print $i, x[$i], y[$i] } }' "$1"
}
bodies=$meshes/two_bodies.su2
marker_points "$bodies" left | awk '{ printf "%d .03 %.17g\n", $1, .1 * ($2 - 1.2) }' >"$tmp/left.txt"
echo "rigid right 0.02 0 10" >"$tmp/right.txt"
for way in "" --safe; do
    runs "displace beside a rigid body $way" 0 displace "$bodies" --given left --wall "$tmp/left.txt" --rigid right \
        --move "$tmp/right.txt" $way -o "$tmp/both.su2"
    for body in left right; do
        marker_points "$bodies" $body >"$tmp/$body.before"
        marker_points "$tmp/both.su2" $body >"$tmp/$body.after"
    done
    check "displace beside a rigid body $way: the given wall" awk '{ getline b <BEFORE; split(b, p)
        if (($2 - p[2] - .03) ^ 2 + ($3 - p[3] - .1 * (p[2] - 1.2)) ^ 2 > 1e-16) wrong++; n++ }
        END { exit wrong > 0 || n < 50 }' \
        BEFORE="$tmp/left.before" "$tmp/left.after"
    check "displace beside a rigid body $way: the body turned by 10 degrees" awk 'NR == 1 { x = $2; y = $3;
        getline b <BEFORE
        split(b, p); u = p[2]; v = p[3]; next } { getline b <BEFORE; split(b, p); c = cos(.17453292519943295);
        s = sin(.17453292519943295)
        d = $2 - x - c * (p[2] - u) + s * (p[3] - v); e = $3 - y - s * (p[2] - u) - c * (p[3] - v)
        if (d * d + e * e > 1e-16) wrong++; n++ } END { exit wrong > 0 || n < 50 }' BEFORE="$tmp/right.before" \
            "$tmp/right.after"
done
# One body goes farther than the gap, and the other one, half as large, away from it: nothing crosses where everything
# has moved.
marker_points "$bodies" left | awk '{ print $1, .85, 0 }' >"$tmp/left.txt"
refuses "displace: one body into the other" 1 'the moved boundary crosses itself' \
    displace "$bodies" --given left --wall "$tmp/left.txt" -o "$tmp/x"
echo "rigid right .5 0 0 .5" >"$tmp/right.txt"
for way in "" --safe; do
    runs "displace: farther than the gap $way" 0 displace "$bodies" --given left --wall "$tmp/left.txt" --rigid right \
        --move "$tmp/right.txt" $way -o "$tmp/both.su2"
done
echo "rigid right -.5 0 0" >"$tmp/right.txt"
refuses "displace: a body into the given one" 1 'the moved boundary crosses itself' \
    displace "$bodies" --given left --wall "$tmp/left.txt" --rigid right --move "$tmp/right.txt" -o "$tmp/x"
marker_points "$bodies" left | awk '{ printf "%d .03 %.17g\n", $1, .1 * ($2 - 1.2) }' >"$tmp/left.txt"
runs "displace beside a curve" 0 displace "$bodies" --given left --wall "$tmp/left.txt" \
    --curve "right=$meshes/two_bodies_right.curve" --safe -o "$tmp/both.su2"

# ---- Coarse to fine ----------------------------------------------------------------------------------------------

make_ring 110 31 >"$tmp/fine.su2"
runs "transfer" 0 transfer "$ring" "$basis" "$tmp/fine.su2" -o "$tmp/fine.basis" --json
has_keys "transfer: keys" points cells functions interpolated outside max_distance boundary_error wall_correction \
    analysis_seconds transfer_seconds
check "transfer: counts" says '"points": 3520, "cells": 3520, "functions": 12, "interpolated": 3300, "outside": 0'
runs "transfer: its basis morphs the fine mesh" 0 morph "$tmp/fine.su2" "$tmp/fine.basis" --move "$tmp/small.txt" --json
check "transfer: the wall moves as the B-spline" grep -E '"boundary_error": ([0-9.]*e-1[5-9]|0)' "$tmp/out"
runs "transfer: threads" 0 transfer "$ring" "$basis" "$tmp/fine.su2" -o "$tmp/fine2.basis" --threads 2
check "transfer: threads give the same bits" cmp "$tmp/fine.basis" "$tmp/fine2.basis"
check "transfer: says how many were interpolated" says '3300 of them interpolated'
runs "transfer: to single precision" 0 transfer "$ring" "$basis" "$tmp/fine.su2" -o "$tmp/fine3.basis" --storage single
check "transfer: to single precision: smaller" test "$(wc -c <"$tmp/fine3.basis")" -lt "$(wc -c <"$tmp/fine.basis")"
refuses "transfer: from single precision" 2 'single precision' transfer "$ring" "$tmp/single.basis" "$tmp/fine.su2" \
    -o "$tmp/x"
awk 'NF == 3 && index($0, ".") { $1 = 1.5 * $1; $2 = 1.5 * $2 } { print }' "$tmp/fine.su2" >"$tmp/larger.su2"
refuses "transfer: a larger domain" 3 'outside the coarse mesh' transfer "$ring" "$basis" "$tmp/larger.su2" -o "$tmp/x"
sed 's/body/wing/' "$tmp/fine.su2" >"$tmp/renamed.su2"
refuses "transfer: a marker that is missing" 2 "'body'" transfer "$ring" "$basis" "$tmp/renamed.su2" -o "$tmp/x"
refuses "transfer: a basis of another mesh" 3 'another mesh' transfer "$tmp/fine.su2" "$basis" "$ring" -o "$tmp/x"

# ---- The shipped meshes of the paper's cases lie on their curves, to the digits of the files ---------------------

on_curve() { # on_curve MESH SOLVE-OPTIONS...
    mesh=$1; shift
    runs "$mesh: solve" 0 solve "$meshes/$mesh.su2" "$@" --operator laplace -o "$tmp/paper.basis"
    check "$mesh: on its curve" grep -E 'mesh from curve +[0-9.]+e-(09|1[0-9]) at most' "$tmp/out"
}
on_curve two_bodies --curve left="$meshes/two_bodies_left.curve" --curve right="$meshes/two_bodies_right.curve"
on_curve diffuser_airfoil --curve airfoil="$meshes/diffuser_airfoil.curve"
on_curve axisymmetric_diffuser --curve diffuser="$meshes/axisymmetric_diffuser.curve" --slip axis
on_curve cage --curve cage="$meshes/cage.curve"

# ---- Bad curve, moves and basis files ----------------------------------------------------------------------------

bad_curve() { # bad_curve NAME LINE TEXT CONTENT
    printf "$4" >"$tmp/bad.curve"
    refuses "$1" 3 "$tmp/bad.curve:$2: " solve "$ring" --curve body="$tmp/bad.curve" -o "$tmp/x"
    check "$1: says '$3'" says "$3"
}
square='points 4\n1 1\n-1 1\n-1 -1\n1 -1\n' # lines 3 to 7
bad_curve "curve: unknown word" 1 'degree' 'grade 3\n'
bad_curve "curve: degree 9" 1 'between 1 and 5' 'degree 9\n'
bad_curve "curve: closed maybe" 2 'periodic' 'degree 1\nclosed maybe\n'
bad_curve "curve: a point of one number" 5 'point 2 of 4' 'degree 1\nclosed tied\npoints 4\n1 1\n2\n'
bad_curve "curve: not a number" 4 "'nan'" 'degree 1\nclosed tied\npoints 4\n1 nan\n2 2\n'
bad_curve "curve: too few knots" 8 'knots 7' "degree 1\nclosed tied\n${square}knots 6\n0 0 1 2 3 4\n"
bad_curve "curve: file ends in the knots" 10 'knot 5 of 7' "degree 1\nclosed tied\n${square}knots 7\n0 0 1 2\n"
line='knots 4\n0 0 1 1\n'
bad_curve "curve: index out of range" 8 'between 1 and 4' "degree 1\nclosed open\n${square}indices 2\n1 5\n$line"
bad_curve "curve: indices that do not close" 8 'closed tied' "degree 1\nclosed tied\n${square}indices 2\n1 2\n$line"
printf "degree 1\nclosed tied\n${square}knots 7\n0 0 1 3 2 4 4\n" >"$tmp/bad.curve"
refuses "curve: decreasing knots" 3 "$tmp/bad.curve" solve "$ring" --curve body="$tmp/bad.curve" -o "$tmp/x"

bad_moves() { # bad_moves NAME LINE CONTENT
    printf "$3" >"$tmp/bad.txt"
    refuses "$1" 3 "$tmp/bad.txt:$2: " morph "$ring" "$basis" --move "$tmp/bad.txt" -o "$tmp/x"
}
bad_moves "moves: two numbers" 2 '# index dx dy\n1 2\n'
bad_moves "moves: control point 0" 1 '0 1 1\n'
bad_moves "moves: control point 13 of 12" 1 '13 1 1\n'
bad_moves "moves: not a number" 2 '1 0 0\n2 nan 0\n'
bad_moves "moves: a point twice" 2 '1 0 0\n1 1 0\n'

bad_basis() { refuses "$1" 3 "$tmp/bad.basis" morph "$ring" "$tmp/bad.basis" --move "$no_moves" -o "$tmp/x"; }
head -c 1000 "$basis" >"$tmp/bad.basis";                          bad_basis "basis: truncated"
: >"$tmp/bad.basis";                                              bad_basis "basis: empty"
cp "$ring" "$tmp/bad.basis";                                      bad_basis "basis: another kind of file"
{ head -c 9000 "$basis"; echo oops; tail -c +9006 "$basis"; } >"$tmp/bad.basis";  bad_basis "basis: damaged"
refuses "basis: of another mesh" 3 "$basis" morph "$meshes/naca0012.su2" "$basis" --move "$no_moves"
leaves_nothing "refused commands leave no file" "$tmp/x"

# ---- Output that cannot be written -------------------------------------------------------------------------------

refuses "no such folder" 3 'no/such/folder' morph "$ring" "$basis" --move "$no_moves" -o "$tmp/no/such/folder/mesh.su2"
if [ -c /dev/full ]; then
    refuses "a full disk" 3 '/dev/full' morph "$ring" "$basis" --move "$no_moves" -o /dev/full
    refuses "all files or none" 3 '/dev/full' morph "$ring" "$basis" --move "$no_moves" -o "$tmp/x" --vtu /dev/full
    leaves_nothing "all files or none: none" "$tmp/x"
    "$harmorph" check "$ring" >/dev/full 2>/dev/null
    check "standard output on a full disk" test $? -eq 3
fi

# ---- Operators, conditions, safe morphs --------------------------------------------------------------------------

# A square of 12 x 12 cells round a block of 4 x 2.
awk 'BEGIN {
    n = 12
    for (j = 0; j <= n; j++) for (i = 0; i <= n; i++) if (!(i > 4 && i < 8 && j > 5 && j < 7)) id[i, j] = points++
    for (j = 0; j < n; j++) for (i = 0; i < n; i++) if (!(i >= 4 && i < 8 && j >= 5 && j < 7))
        cell[cells++] = "9 " id[i, j] " " id[i + 1, j] " " id[i + 1, j + 1] " " id[i, j + 1]
    print "NDIME= 2\nNELEM= " cells
    for (k = 0; k < cells; k++) print cell[k]
    print "NPOIN= " points
    for (j = 0; j <= n; j++) for (i = 0; i <= n; i++) if ((i, j) in id) print i, j
    print "NMARK= 5\nMARKER_TAG= low\nMARKER_ELEMS= 12"
    for (k = 0; k < n; k++) print 3, id[k, 0], id[k + 1, 0]
    print "MARKER_TAG= high\nMARKER_ELEMS= 12"
    for (k = 0; k < n; k++) print 3, id[k, n], id[k + 1, n]
    print "MARKER_TAG= in:let\nMARKER_ELEMS= 12"
    for (k = 0; k < n; k++) print 3, id[0, k], id[0, k + 1]
    print "MARKER_TAG= out\nMARKER_ELEMS= 12"
    for (k = 0; k < n; k++) print 3, id[n, k], id[n, k + 1]
    print "MARKER_TAG= block\nMARKER_ELEMS= 12"
    for (i = 4; i < 8; i++) print 3 " " id[i, 5] " " id[i + 1, 5] "\n" 3 " " id[i, 7] " " id[i + 1, 7]
    for (j = 5; j < 7; j++) print 3 " " id[4, j] " " id[4, j + 1] "\n" 3 " " id[8, j] " " id[8, j + 1]
}' >"$tmp/box.su2"
box=$tmp/box.su2 on_block="--curve block=$tmp/block.curve"
printf 'degree 1\nclosed tied\npoints 4\n4 5\n8 5\n8 7\n4 7\nknots 7\n0 0 1 2 3 4 4\n' >"$tmp/block.curve"
# place X Y FILE: where the mesh in FILE has the point that box.su2 has at X, Y
place() {
    awk -v x="$1" -v y="$2" '/^NPOIN/ { left = $2; if (++file == 1) at = -1; k = 0; next }
        left > 0 { if (file == 1 && $1 == x && $2 == y) at = k; if (file == 2 && k == at) print $1, $2; k++;
        left-- }' "$box" "$3"
}
near() { # near X Y WANTED_X WANTED_Y: to 1e-12; a * is any
    echo "$@" | awk 'function off(a, b) { return b != "*" && (a - b > 1e-12 || b - a > 1e-12) } { exit off($1, $3) ||
        off($2, $4) || NF != 4 }'
}
turn() { # turn DEGREES [SHIFT]: moves of the block's corners about its middle, and to the right
    awk -v a="$1" -v d="${2:-0}" 'BEGIN {
        a *= atan2(0, -1) / 180; split("4 8 8 4", x); split("5 5 7 7", y)
        for (k = 1; k <= 4; k++) { u = x[k] - 6; v = y[k] - 6
            printf "%d %.17g %.17g\n", k, u * cos(a) - v * sin(a) - u + d, u * sin(a) + v * cos(a) - v } }'
}

for operator in laplace weighted conformal; do
    runs "solve --operator $operator" 0 solve "$box" $on_block --operator $operator -o "$tmp/$operator.basis"
done
runs "solve: conformal is the default" 0 solve "$box" $on_block -o "$tmp/default.basis"
check "solve: conformal is the default: equal files" cmp "$tmp/conformal.basis" "$tmp/default.basis"
runs "solve: 1.5 is its exponent" 0 solve "$box" $on_block --exponent 1.5 -o "$tmp/default.basis"
check "solve: 1.5 is its exponent: equal files" cmp "$tmp/conformal.basis" "$tmp/default.basis"
runs "solve --exponent 0" 0 solve "$box" $on_block --exponent 0 -o "$tmp/flat.basis"
check "solve --exponent 0: other functions" sh -c "! cmp -s '$tmp/conformal.basis' '$tmp/flat.basis'"
refuses "--operator unknown" 2 "'biharmonic'" solve "$box" $on_block --operator biharmonic -o "$tmp/x"
for exponent in -1 4.25 1.3 x '' nan inf 1e300; do
    refuses "--exponent '$exponent'" 2 '--exponent' solve "$box" $on_block --exponent "$exponent" -o "$tmp/x"
done
refuses "--exponent with laplace" 2 'weight' solve "$box" $on_block --operator laplace --exponent 1 -o "$tmp/x"
refuses "--offset-correction with laplace" 2 'offset' solve "$box" $on_block --operator laplace --offset-correction \
    -o "$tmp/x"
refuses "--free with conformal" 2 'slip' solve "$box" $on_block --free out -o "$tmp/x"
runs "--offset-correction" 0 solve "$box" $on_block --offset-correction -o "$tmp/offset.basis"

turn 40 >"$tmp/turn40.txt"
for operator in laplace weighted conformal flat offset; do
    runs "morph by a basis: $operator" 0 morph "$box" "$tmp/$operator.basis" --move "$no_moves" -o "$tmp/same.su2"
    check "morph by a basis: $operator: zero move, identical file" cmp "$box" "$tmp/same.su2"
done
runs "export of a real function" 0 export "$box" "$tmp/laplace.basis" --function 4 --csv "$tmp/f.csv" --svg "$tmp/f.svg"
check "export of a real function: columns" test "$(head -1 "$tmp/f.csv")" = point,x,y,value
refuses "export: a number that a real value does not have" 2 '--number' export "$box" "$tmp/laplace.basis" \
    --function 4 --number 2 --csv "$tmp/f.csv"

runs "--slip" 0 solve "$box" $on_block --slip low,high --slip in:let -o "$tmp/slip.basis"
runs "export of a function with slip" 0 export "$box" "$tmp/slip.basis" --function 4 --number 4 --csv "$tmp/f.csv" \
    --svg "$tmp/f.svg"
check "export of a function with slip: columns" test "$(head -1 "$tmp/f.csv")" = point,x,y,xx,xy,yx,yy
runs "--slip: morph" 0 morph "$box" "$tmp/slip.basis" --move "$tmp/turn40.txt" -o "$tmp/slip.su2"
check "--slip: points below slide on their line" near $(place 5 0 "$tmp/slip.su2") '*' 0
check "--slip: and do slide" sh -c "! echo $(place 5 0 "$tmp/slip.su2") | grep -q '^5 '"
check "--slip: at the left, too" near $(place 0 7 "$tmp/slip.su2") 0 '*'
check "--slip: corners stay" near $(place 0 0 "$tmp/slip.su2") 0 0
check "--slip: what is fixed stays" near $(place 12 7 "$tmp/slip.su2") 12 7
refuses "--slip on a marker with a curve" 2 'two conditions' solve "$box" $on_block --slip block -o "$tmp/x"
refuses "--slip on an unknown marker" 2 "'high'" solve "$box" $on_block --slip top -o "$tmp/x"
sed 's/^5 0$/5 -.01/' "$box" >"$tmp/bent.su2"
runs "--slip on a bent line: a curve" 0 solve "$tmp/bent.su2" $on_block --slip low -o "$tmp/bent.basis"
runs "--slip on a bent line: morph" 0 morph "$tmp/bent.su2" "$tmp/bent.basis" --move "$tmp/turn40.txt" \
    -o "$tmp/bent-moved.su2"
below() { awk '/^NPOIN/ { points = 1; next } /^[A-Z]/ { points = 0 } points && $2 < .02 && $1 > 4 && $1 < 6 {
    print $2 }' "$1"; }
check "--slip on a bent line: points stay near it" \
    sh -c "echo '$(below "$tmp/bent-moved.su2")' |
        awk '\$1 > 1e-9 || \$1 < -.0101 { bad = 1 } END { exit bad || NR < 2 }'"

# A circle of radius 4 in quarters, rational, and a ring whose sides of 30 degrees are far off the circle between
# points.
awk 'BEGIN {
    print "degree 2\nclosed tied\npoints 8"
    for (i = 0; i < 8; i++) { t = i * atan2(0, -1) / 4; r = i % 2 ? 4 * sqrt(2) : 4;
    printf "%.17g %.17g\n", r * cos(t), r * sin(t) }
    print "weights 8"
    for (i = 0; i < 8; i++) printf "%.17g\n", i % 2 ? sqrt(.5) : 1
    print "knots 12\n0 0 0 1 1 2 2 3 3 4 4 4"
}' >"$tmp/circle.curve"
make_ring 12 6 >"$tmp/coarse.su2"
make_ring 24 12 >"$tmp/less-coarse.su2"
echo 'rigid body 0 0 40' >"$tmp/body40.txt"
off_circle() { # of the outer points: the largest distance from the circle
    awk '/^NPOIN/ { points = 1; next } /^[A-Z]/ { points = 0 }
        points { r = sqrt($1 * $1 + $2 * $2) - 4; r = r < 0 ? -r : r; if (r < .2 && r > most) most = r }
        END { print most + 0 }' "$1"
}
is_on_circle() { off_circle "$1" | awk '{ exit !($1 < 1e-10) }'; }
for points in 12 fine; do
    if [ $points = fine ]; then
        runs "--slip along a curve: transfer" 0 transfer "$tmp/coarse.su2" "$tmp/circle.basis" "$tmp/less-coarse.su2" \
            -o "$tmp/finer.basis"
        cp "$tmp/less-coarse.su2" "$tmp/coarse.su2"
        cp "$tmp/finer.basis" "$tmp/circle.basis"
    else
        runs "--slip along a curve" 0 solve "$tmp/coarse.su2" --rigid body=0,0 --slip far="$tmp/circle.curve" \
            -o "$tmp/circle.basis"
        mv "$tmp/circle.curve" "$tmp/circle.curve.kept" # BASIS keeps it
    fi
    for way in "" --safe --improve; do
        runs "--slip along a curve: morph $points $way" 0 morph "$tmp/coarse.su2" "$tmp/circle.basis" \
            --move "$tmp/body40.txt" $way -o "$tmp/on-circle.su2"
        check "--slip along a curve: points are on the circle: $points $way" is_on_circle "$tmp/on-circle.su2"
        check "--slip along a curve: and have moved: $points $way" \
            sh -c "! tail -n 200 '$tmp/on-circle.su2' | grep -q '^4 0'"
    done
done
mv "$tmp/circle.curve.kept" "$tmp/circle.curve"
make_ring 12 6 >"$tmp/coarse.su2"
runs "--slip along the curve through the points" 0 solve "$tmp/coarse.su2" --rigid body=0,0 --slip far \
    -o "$tmp/through.basis"
runs "--slip along the curve through the points: morph" 0 morph "$tmp/coarse.su2" "$tmp/through.basis" \
    --move "$tmp/body40.txt" -o "$tmp/on-circle.su2"
check "--slip along the curve through the points: is another curve" sh -c "! $(off_circle "$tmp/on-circle.su2" |
    awk '{ print $1 < 1e-8 ? "true" : "false" }')"
refuses "--slip along a curve: another one's" 2 "from the curve that it should slide along" \
    solve "$tmp/coarse.su2" --rigid body=0,0 --slip far="$curve" -o "$tmp/x"
refuses "--slip along a curve: no file" 3 'none.curve' solve "$tmp/coarse.su2" --rigid body=0,0 \
    --slip far="$tmp/none.curve" -o "$tmp/x"
awk '/^NPOIN/ { points = 1; next } /^[A-Z]/ { points = 0 } points && k < 12 {
    print k++, -.2 * $1 - .6 * $2, .6 * $1 - .2 * $2 }' \
    "$tmp/coarse.su2" >"$tmp/turned-wall.txt"
runs "--slip along a curve: displace" 0 displace "$tmp/coarse.su2" --given body --slip far="$tmp/circle.curve" \
    --wall "$tmp/turned-wall.txt" -o "$tmp/on-circle.su2"
check "--slip along a curve: displace: points are on the circle" is_on_circle "$tmp/on-circle.su2"
runs "--slip along a curve: the basis again" 0 solve "$tmp/coarse.su2" --rigid body=0,0 --slip far="$tmp/circle.curve" \
    -o "$tmp/circle.basis"
for lines in 1 5 30; do
    LC_ALL=C sed '$d' "$tmp/circle.basis" | LC_ALL=C awk -v n=$lines '{ line[NR] = $0 }
        END { for (k = 1; k <= NR - n; k++) print line[k] }' >"$tmp/cut.basis"
    refuses "--slip along a curve: cut off by $lines" 3 'cut' morph "$tmp/coarse.su2" "$tmp/cut.basis" \
        --move "$tmp/body40.txt"
done

runs "--periodic, with a colon in a tag" 0 solve "$box" $on_block --periodic in:let:out -o "$tmp/pair.basis"
runs "--periodic: morph" 0 morph "$box" "$tmp/pair.basis" --move "$tmp/turn40.txt" -o "$tmp/pair.su2"
set -- $(place 0 7 "$tmp/pair.su2")
check "--periodic: both sides move alike" near $(place 12 7 "$tmp/pair.su2") "$(echo "$1" | awk '{
    printf "%.17g", $1 + 12 }')" "$2"
check "--periodic: and do move" sh -c "! echo '$2' | grep -q '^7$'"
refuses "--periodic without a partner" 2 '--periodic' solve "$box" $on_block --periodic low -o "$tmp/x"
refuses "--periodic with an unknown partner" 2 "'low:nowhere'" solve "$box" $on_block --periodic low:nowhere -o "$tmp/x"
refuses "--periodic: no translates" 2 'periodic' solve "$tmp/bent.su2" $on_block --periodic low:high -o "$tmp/x"

# A passage of an annulus: the box bent round a centre; its right side is its left one, turned by 36 degrees.
bend() { # bend CENTRE_X CENTRE_Y
    awk -v cx="$1" -v cy="$2" '/^NPOIN/ { points = 1; print; next } /^[A-Z]/ { points = 0 }
        points { a = atan2(0, -1) / 5 * $1 / 12; r = 30 - $2; printf "%.17g %.17g\n", cx + r * cos(a),
        cy + r * sin(a); next }
        { print }' "$box"
}
# misfit FILE CENTRE_X CENTRE_Y: how far the moved right side is from the left one, turned; is anything moved?
misfit() {
    set -- "$1" "$2" "$3" $(place 0 7 "$1") $(place 12 7 "$1")
    awk -v cx="$2" -v cy="$3" -v x="$4" -v y="$5" -v u="$6" -v v="$7" 'BEGIN {
        a = atan2(0, -1) / 5; x -= cx; y -= cy; u -= cx; v -= cy
        dx = x * cos(a) - y * sin(a) - u; dy = x * sin(a) + y * cos(a) - v; moved = sqrt((x - 23) ^ 2 + y ^ 2)
        exit !(dx ^ 2 + dy ^ 2 < 1e-24 && moved > 1e-3) }'
}
printf 'rigid block .3 .2 25\n' >"$tmp/passage.txt"
for centre in '0 0' '5 -7'; do
    bend $centre >"$tmp/passage.su2"
    for operator in conformal laplace; do
        runs "--periodic: a passage about $centre, $operator" 0 solve "$tmp/passage.su2" --rigid block \
            --periodic in:let:out --operator $operator -o "$tmp/passage.basis"
        check "--periodic: says how the sides are turned" says "'in:let' to 'out' turned by 36 degrees about ($(echo \
            $centre | sed 's/ /, /'))"
        runs "--periodic: morph of a passage" 0 morph "$tmp/passage.su2" "$tmp/passage.basis" \
            --move "$tmp/passage.txt" -o "$tmp/passage-moved.su2"
        check "--periodic: the sides of the passage stay images" misfit "$tmp/passage-moved.su2" $centre
        runs "--periodic: safe morph of a passage" 0 morph "$tmp/passage.su2" "$tmp/passage.basis" \
            --move "$tmp/passage.txt" --safe -o "$tmp/passage-safe.su2"
        check "--periodic: the sides stay images in a safe morph" misfit "$tmp/passage-safe.su2" $centre
    done
done
runs "--periodic: transfer of a passage" 0 transfer "$tmp/passage.su2" "$tmp/passage.basis" "$tmp/passage.su2" \
    -o "$tmp/passage-fine.basis"
runs "--periodic: morph by the functions that were transferred" 0 morph "$tmp/passage.su2" "$tmp/passage-fine.basis" \
    --move "$tmp/passage.txt" -o "$tmp/passage-moved.su2"
check "--periodic: the sides of the passage stay images with them" misfit "$tmp/passage-moved.su2" 5 -7
runs "--periodic: page of a passage" 0 explore "$tmp/passage.su2" "$tmp/passage.basis" -o "$tmp/passage.html"
refuses "--periodic: a passage with multigrid" 2 'rotation pairs go with the direct engine only' \
    solve "$tmp/passage.su2" --rigid block --periodic in:let:out --operator laplace --engine multigrid -o "$tmp/x"
refuses "--periodic: a passage with sliding sides" 2 'rotation pairs do not go with slipping boundaries' solve \
    "$tmp/passage.su2" --rigid block --periodic in:let:out --slip low -o "$tmp/x"

# Pieces: the lower and the upper side are one marker; only the one near (6, 9) slides.
sed -e 's/^MARKER_TAG= *high$/MARKER_TAG= low/' "$box" >"$tmp/sides.su2"
runs "a piece of a marker" 0 solve "$tmp/sides.su2" $on_block --slip low@6:9 -o "$tmp/piece.basis"
runs "a piece of a marker: morph" 0 morph "$tmp/sides.su2" "$tmp/piece.basis" --move "$tmp/turn40.txt" \
    -o "$tmp/piece.su2"
check "a piece of a marker: below is fixed" near $(place 5 0 "$tmp/piece.su2") 5 0
refuses "a piece of a marker, twice" 2 'choose all of' solve "$tmp/sides.su2" $on_block --slip low@6:9,low@6:12 \
    -o "$tmp/x"
refuses "a piece of an unknown marker" 2 "'top'" solve "$box" $on_block --slip top@6:9 -o "$tmp/x"
runs "--rigid, a piece" 0 solve "$box" --rigid block@6:4 -o "$tmp/piece.basis"

runs "--rigid" 0 solve "$box" --rigid block -o "$tmp/rigid.basis" --json
check "--rigid: functions" says '"functions": 2'
printf '# a body\nrigid block .5 -.25 90 1.25\n' >"$tmp/rigid.txt"
runs "--rigid: morph" 0 morph "$box" "$tmp/rigid.basis" --move "$tmp/rigid.txt" -o "$tmp/rigid.su2" --safe \
    --svg "$tmp/rigid.svg" --boundary-svg "$tmp/rigid-boundary.svg"
runs "--rigid: export" 0 export "$box" "$tmp/rigid.basis" --function 2 --svg "$tmp/rigid-turn.svg"
check "--rigid: pictures without a curve have a size" sh -c "! grep -E 'nan|inf' '$tmp'/rigid*.svg"
check "--rigid: turned and scaled about its middle, and moved" near $(place 4 5 "$tmp/rigid.su2") 7.75 3.25
runs "--rigid with a centre" 0 solve "$box" --rigid block=4,5 -o "$tmp/hinge.basis"
printf 'rigid block 0 0 20\n' >"$tmp/hinge.txt"
runs "--rigid with a centre: morph" 0 morph "$box" "$tmp/hinge.basis" --move "$tmp/hinge.txt" -o "$tmp/hinge.su2"
check "--rigid with a centre: it stays" near $(place 4 5 "$tmp/hinge.su2") 4 5
check "--rigid with a centre: the angle is in degrees" near $(place 8 5 "$tmp/hinge.su2") \
    "$(awk 'BEGIN { printf "%.17g", 4 + 4 * cos(atan2(0, -1) / 9) }')" '*'
for centre in 4 4, ,5 4,5,6 x,y nan,0; do
    refuses "--rigid block=$centre" 2 '--rigid' solve "$box" --rigid block=$centre -o "$tmp/x"
done
bad_body() { # bad_body NAME LINE CONTENT
    printf "$3" >"$tmp/bad.txt"
    refuses "$1" 3 "$tmp/bad.txt:$2: " morph "$box" "$tmp/rigid.basis" --move "$tmp/bad.txt" -o "$tmp/x"
}
bad_body "moves: a body without an angle" 1 'rigid block 1 2\n'
bad_body "moves: a marker of no body" 2 '\nrigid low 1 2 3\n'
bad_body "moves: a body twice" 2 'rigid block 1 0 0\nrigid block 1 0 0\n'
bad_body "moves: an angle that is none" 1 'rigid block 1 0 right\n'
bad_body "moves: control points where there are none" 1 '1 0 0\n'

turn 150 >"$tmp/turn150.txt"
turn 3 4.5 >"$tmp/away.txt"
turn 60 >"$tmp/turn60.txt"
refuses "a large turn" 1 'admissible' morph "$box" "$tmp/conformal.basis" --move "$tmp/turn150.txt" -o "$tmp/turned.su2"
runs "--safe: a large turn" 0 morph "$box" "$tmp/conformal.basis" --move "$tmp/turn150.txt" --safe \
    -o "$tmp/turned.su2" --json
has_keys "--safe: keys" inverted self_crossing boundary_error min_quality mean_quality morph_seconds step_fraction \
    steps resolves strategy last_step_admissible reached_moves $safe_keys moved_curve
check "--safe: the whole way" says '"step_fraction": 1,'
check "--safe: nothing inverted" says '"inverted": 0'
check "--safe: not by the linear morph" sh -c "! grep -q '\"strategy\": \"linear\"' '$tmp/out'"
runs "--safe: check of the result" 0 check "$tmp/turned.su2"
check "--safe: the block is where it should be" near $(place 8 6 "$tmp/turned.su2") \
    $(awk 'BEGIN { a = atan2(0, -1) * 5 / 6; printf "%.17g %.17g", 6 + 2 * cos(a), 6 + 2 * sin(a) }')
quality() { sed -n 's/.*"mean_quality": \([0-9.e-]*\).*/\1/p' "$tmp/out"; }
poorer=$(runs "--safe: before --improve" 0 morph "$box" "$tmp/conformal.basis" --move "$tmp/turn60.txt" --safe \
    --json >/dev/null; quality)
runs "--improve" 0 morph "$box" "$tmp/conformal.basis" --move "$tmp/turn60.txt" --safe --improve -o "$tmp/better.su2" \
    --json
better=$(quality)
check "--improve: better on average" awk "BEGIN { exit !($better > $poorer) }"
check "--improve: nothing inverted" says '"inverted": 0'
runs "--improve: check of the result" 0 check "$tmp/better.su2"
runs "--improve of a mesh that does not move" 0 morph "$box" "$tmp/conformal.basis" --move "$no_moves" --improve \
    -o "$tmp/same.su2"
check "--improve of a mesh that does not move: the same file" cmp "$box" "$tmp/same.su2"
runs "--safe: a small move" 0 morph "$box" "$tmp/conformal.basis" --move "$tmp/turn40.txt" --safe --json
check "--safe: a small move: linear" says '"strategy": "linear"'
check "--safe: a small move: worst cells with their places" grep -E \
    '"worst_cells": \[\{"cell": [0-9]+, "quality": [^,]*, "start_quality": 1, "x": ' "$tmp/out"
runs "--min-quality: missed, with a warning" 0 morph "$box" "$tmp/conformal.basis" --move "$tmp/turn150.txt" --safe \
    --min-quality 0.99 -o "$tmp/poor.su2"
check "--min-quality: the warning names a cell and its place" grep -E 'smallest quality is .*: cell [0-9]+ at \(' \
    "$tmp/err"
refuses "--strict" 1 'smallest quality' morph "$box" "$tmp/conformal.basis" --move "$tmp/turn150.txt" --safe \
    --min-quality 0.99 --strict -o "$tmp/strict.su2"
leaves_nothing "--strict: nothing written" "$tmp/strict.su2"
for bad in 1.5 -0.1 nan good; do
    refuses "--min-quality $bad" 2 '--min-quality' morph "$box" "$tmp/conformal.basis" --move "$no_moves" --safe \
        --min-quality=$bad
done
refuses "--max-height-change 1" 2 '--max-height-change' morph "$box" "$tmp/conformal.basis" --move "$no_moves" --safe \
    --max-height-change 1
refuses "--strict without --safe" 2 '--strict' morph "$box" "$tmp/conformal.basis" --move "$no_moves" --strict
: >"$tmp/empty.txt"
refuses "an empty file of moves" 3 'empty.txt:1: the file is empty' morph "$box" "$tmp/conformal.basis" \
    --move "$tmp/empty.txt"
bad_body "moves: a body of scale 0" 1 'rigid block 1 0 0 0\n'
bad_body "moves: a body of a negative scale" 1 'rigid block 1 0 0 -1\n'
runs "--safe for people" 0 morph "$box" "$tmp/conformal.basis" --move "$tmp/turn150.txt" --safe
check "--safe for people: strategy" says 'strategy:'
runs "--other" 0 morph "$box" "$tmp/laplace.basis" --move "$tmp/turn60.txt" --safe --other "$tmp/conformal.basis" --json
check "--other: helps" says '"strategy": "other"'
refuses "--other of other conditions" 3 'other bases' morph "$box" "$tmp/conformal.basis" --move "$tmp/turn40.txt" \
    --safe --other "$tmp/rigid.basis"
refuses "--other of another mesh" 3 "$basis" morph "$box" "$tmp/conformal.basis" --move "$tmp/turn40.txt" --safe \
    --other "$basis"
runs "--safe --reached" 0 morph "$box" "$tmp/rigid.basis" --move "$tmp/rigid.txt" --safe --reached "$tmp/rigid.reached"
check "--safe --reached: a body's movement" awk '$1 == "rigid" { n++; ok = $2 == "block" &&
    ($3 - .5) ^ 2 + ($4 + .25) ^ 2 < 1e-24 &&
    ($5 - 90) ^ 2 < 1e-20 && ($6 - 1.25) ^ 2 < 1e-24 } END { exit !(ok && n == 1) }' "$tmp/rigid.reached"
refuses "--reached without --safe" 2 '--reached' morph "$box" "$tmp/conformal.basis" --move "$no_moves" \
    --reached "$tmp/x"
refuses "--safe: a boundary that crosses itself" 1 'crosses itself' morph "$box" "$tmp/conformal.basis" \
    --move "$tmp/away.txt" --safe -o "$tmp/away.su2"
leaves_nothing "--safe: a boundary that crosses itself: nothing written" "$tmp/away.su2"
runs "--safe: a boundary that crosses itself, --json" 1 morph "$box" "$tmp/conformal.basis" --move "$tmp/away.txt" \
    --safe --json
check "--safe: a boundary that crosses itself: nothing moved, nothing is off" says '"boundary_error": 0,'
turn 0 30 >"$tmp/outside.txt" # through the side and out of the square
refuses "--safe: out of the domain" 1 'outside the boundary' morph "$box" "$tmp/conformal.basis" \
    --move "$tmp/outside.txt" --safe
turn 150 3.767949192 >"$tmp/outside.txt" # but for 4e-10 at the side: no step of several, nor untangling, gets there
refuses "--safe: short of the target" 1 'stands in the way' morph "$box" "$tmp/conformal.basis" \
    --move "$tmp/outside.txt" --safe -o "$tmp/outside.su2" --json
has_keys "--safe: short of the target: JSON all the same" inverted self_crossing boundary_error min_quality \
    mean_quality \
    morph_seconds step_fraction steps resolves strategy last_step_admissible reached_moves $safe_keys moved_curve
leaves_nothing "--safe: short of the target: nothing written" "$tmp/outside.su2"
runs "--safe: short of the target, --force" 1 morph "$box" "$tmp/conformal.basis" --move "$tmp/outside.txt" --safe \
    --force -o "$tmp/outside.su2" --json
check "--safe: short of the target: only part of the way" grep -E '"step_fraction": 0\.[0-9]*[1-9]' "$tmp/out"
check "--safe: short of the target: the boundary is the B-spline's, as far as it went" \
    grep -E '"boundary_error": ([0-9.]*e-1[5-9]|0),' "$tmp/out"
check "--safe: short of the target, --force: the moves that it has" \
    says "\"reached_moves\": \"$tmp/outside.su2.reached\""
runs "--safe: the reached moves are read by morph" 0 morph "$box" "$tmp/conformal.basis" \
    --move "$tmp/outside.su2.reached" --safe -o "$tmp/reached.su2"
for corner in "4 5" "8 5" "8 7" "4 7"; do
    check "--safe: the reached moves put the block where the mesh has it ($corner)" \
        near $(place $corner "$tmp/reached.su2") $(place $corner "$tmp/outside.su2")
done
runs "--safe: short of the target, --force: the last valid mesh" 0 check "$tmp/outside.su2"
check "--safe: short of the target, --force: which moved" sh -c "! cmp -s '$box' '$tmp/outside.su2'"
leaves_nothing "refused commands leave no file" "$tmp/x"

# ---- Markers by name ------------------------------------------------------------------------------------------------

# The same mesh with its markers in another order, with other names, and with two sides' faces exchanged.
markers_of() { awk -v tag="$1" '/^MARKER_TAG=/ { on = $2 == tag } on' "$box"; }
{ sed '/^MARKER_TAG/,$d' "$box"; for tag in out block high in:let low; do markers_of $tag; done; } >"$tmp/shuffled.su2"
sed 's/MARKER_TAG= block/MARKER_TAG= brick/' "$box" >"$tmp/renamed.su2"
sed 's/MARKER_TAG= low/MARKER_TAG= swap/; s/MARKER_TAG= high/MARKER_TAG= low/; s/MARKER_TAG= swap/MARKER_TAG= high/' \
    "$box" >"$tmp/exchanged.su2"
check "markers in another order: another file" sh -c "! cmp -s '$box' '$tmp/shuffled.su2'"
runs "markers in another order: solve" 0 solve "$tmp/shuffled.su2" $on_block --slip low -o "$tmp/shuffled.basis"
runs "markers in another order: the basis serves both" 0 morph "$box" "$tmp/shuffled.basis" --move "$tmp/turn40.txt" \
    -o "$tmp/shuffled-turned.su2"
check "markers in another order: what slips slides" near $(place 5 0 "$tmp/shuffled-turned.su2") '*' 0
check "markers in another order: what is fixed stays" near $(place 5 12 "$tmp/shuffled-turned.su2") 5 12
runs "markers in another order: the body that is named moves" 0 morph "$tmp/shuffled.su2" "$tmp/rigid.basis" \
    --move "$tmp/rigid.txt" --safe -o "$tmp/shuffled-moved.su2"
check "markers in another order: where it is to be" near $(place 4 5 "$tmp/shuffled-moved.su2") 7.75 3.25
refuses "a marker of another name" \
    3 "its markers are 'block', 'high', 'in:let', 'low', 'out'; those of $tmp/renamed.su2 are 'brick'" \
    morph "$tmp/renamed.su2" "$tmp/rigid.basis" --move "$no_moves"
refuses "the same names on other points" 3 'other points are on its markers' morph "$tmp/exchanged.su2" \
    "$tmp/rigid.basis" --move "$no_moves"
sed '/^harmorph markers/,$d' "$tmp/rigid.basis" >"$tmp/unnamed.basis"
refuses "a basis without names" 3 'without the names of its' morph "$box" "$tmp/unnamed.basis" --move "$no_moves"
{ cat "$tmp/unnamed.basis"; printf 'harmorph markers 5\nblock\nhigh\nin:l'; } >"$tmp/cut.basis"
refuses "a basis with its names cut off" 3 'it has 2 names of markers, expected are 5' morph "$box" "$tmp/cut.basis" \
    --move "$no_moves"
refuses "messages name markers: periodic" 2 "marker 'block', the periodic partner of 'low', has a condition" \
    solve "$box" --rigid block --periodic low:block -o "$tmp/x"
refuses "messages name markers: one piece" 2 "periodic marker 'block' is not one open piece" solve "$box" --rigid high \
    --periodic block:low -o "$tmp/x"

# ---- Curves out and in -----------------------------------------------------------------------------------------------

shape() { awk -f "$(dirname "$0")/read_curves.awk" "$1"; } # FILE: its curves in numbers, by a reader of its own
same_shape() { shape "$1" >"$tmp/shape.1" && shape "$2" >"$tmp/shape.2" && test -s "$tmp/shape.1" &&
    cmp "$tmp/shape.1" "$tmp/shape.2"; }
for ending in curve igs step; do
    runs "curve out: $ending" 0 fit "$ring" --marker body --points 12 -o "$tmp/out.$ending"
    check "curve out: $ending: re-read" same_shape "$tmp/out.$ending" "$tmp/out.curve"
    runs "moved curve: $ending" 0 morph "$box" "$tmp/conformal.basis" --move "$tmp/turn40.txt" \
        --curve-out "$tmp/moved.$ending"
    check "moved curve: $ending: re-read" same_shape "$tmp/moved.$ending" "$tmp/moved.curve"
done
check "moved curve: control points and their moves" sh -c "awk '
    FILENAME ~ /turn40/ { x[\$1] = \$2; y[\$1] = \$3; next }
    /^points/ { n = \$2; k = 0; next }
    k < n { k++; wx = (k == 1 || k == 4 ? 4 : 8) + x[k]; wy = (k < 3 ? 5 : 7) + y[k]
        bad += (\$1 - wx) ^ 2 + (\$2 - wy) ^ 2 > 1e-24 }
    END { exit bad || n != 4 }' '$tmp/turn40.txt' '$tmp/moved.curve'"
runs "moved curve: beside the mesh" 0 morph "$box" "$tmp/conformal.basis" --move "$tmp/turn40.txt" -o "$tmp/with.su2" \
    --json
check "moved curve: beside the mesh: says where" says "\"moved_curve\": \"$tmp/with.su2.curve\""
check "moved curve: beside the mesh: the same" cmp "$tmp/with.su2.curve" "$tmp/moved.curve"
runs "moved curve: solved on the moved mesh" 0 solve "$tmp/with.su2" --curve block="$tmp/with.su2.curve" \
    -o "$tmp/with.basis" --json
check "moved curve: the moved mesh is on it" grep -E '"boundary_error": ([0-9.]*e-1[5-9]|0),' "$tmp/out"
runs "bodies alone have no curve" 0 morph "$box" "$tmp/rigid.basis" --move "$no_moves" -o "$tmp/alone.su2" --json
check "bodies alone have no curve: says so" says '"moved_curve": ""'

runs "Selig out" 0 fit "$meshes/naca0012.su2" --marker airfoil -o "$tmp/foil.dat"
check "Selig out: counter-clockwise from and to the trailing edge" awk 'NR == 1 { next } NR == 2 { ok = $1 == 1 &&
    $2 == 0; x = $1; y = $2; next }
    { area += x * $2 - $1 * y; x = $1; y = $2 } END { exit !(ok && x == 1 && y == 0 && area > 0) }' "$tmp/foil.dat"
runs "Selig in" 0 fit "$tmp/foil.dat" -o "$tmp/foil.curve" --json
check "Selig in: a sharp trailing edge" says '"closed": "tied", "reason": "corner"'
check "Selig in: the curve again" awk '{ match($0, /"max_error": [^,]*/);
    exit !(substr($0, RSTART + 13, RLENGTH - 13) + 0 < 2e-5) }' "$tmp/out"
runs "a curve in, for other control points" 0 fit "$tmp/out.curve" --points 9 -o "$tmp/nine.curve"
check "a curve in: nine points" grep -x 'points 9' "$tmp/nine.curve"
awk 'NR == 1 { next } { x[++n] = $1; y[n] = $2 } END { half = 1; for (k = 1; k <= n; k++) if (x[k] < x[half]) half = k
    print "LEDNICER\n " half ". " n - half + 1 ".\n"; for (k = half; k >= 1; k--) print x[k], y[k]; print ""
    for (k = half; k <= n; k++) print x[k], y[k] }' "$tmp/foil.dat" >"$tmp/lednicer.dat"
runs "Lednicer in" 0 fit "$tmp/lednicer.dat" -o "$tmp/lednicer.curve"
check "Lednicer in: as Selig" cmp "$tmp/lednicer.curve" "$tmp/foil.curve"
refuses "--marker with a section" 2 '--marker' fit "$tmp/foil.dat" --marker airfoil -o "$tmp/x"
bad_section() { # bad_section NAME LINE CONTENT
    printf "$3" >"$tmp/bad.dat"
    refuses "$1" 3 "$tmp/bad.dat:$2: " fit "$tmp/bad.dat" --points 4 -o "$tmp/x"
}
bad_section "section: a word for a number" 3 'name\n1 0\n.5 o\n'
bad_section "section: a lower side that ends early" 8 'name\n3. 3.\n0 0\n.5 .1\n1 0\n0 0\n.5 -.1\n'
bad_section "section: two points" 4 'name\n1 0\n0 0\n'
printf 'name\n' >"$tmp/bad.dat"
refuses "section: a name alone" 3 "$tmp/bad.dat" fit "$tmp/bad.dat" -o "$tmp/x"

# A square: with as many points for 16 control points of degree 5 the curve runs back at a corner.
awk 'BEGIN { print "square"; for (k = 0; k < 20; k++) { s = int(k / 5); t = (k % 5) / 5
    print s == 0 ? t : s == 1 ? 1 : s == 2 ? 1 - t : 0, s == 0 ? 0 : s == 1 ? t : s == 2 ? 1 : 1 - t }
    }' >"$tmp/square.dat"
runs "fit that runs back" 0 fit "$tmp/square.dat" --degree 5 --points 16 -o "$tmp/square.curve" --json
check "fit that runs back: is said" says '"backtracks": true'
check "fit that runs back: and where" says 'the curve runs back'
runs "fit that does not" 0 fit "$tmp/square.dat" --points 12 -o "$tmp/square.curve" --json
check "fit that does not: is not said" says '"backtracks": false'
leaves_nothing "refused commands leave no file" "$tmp/x"

# ---- The demo on the shipped mesh --------------------------------------------------------------------------------

runs "demo" 0 demo "$tmp/demo" --mesh "$meshes/naca0012.su2"
for file in mesh.su2 airfoil.curve airfoil.basis moves.txt morphed.su2 morphed.su2.curve morphed.vtu morph.svg \
    function.svg far.txt far.su2 fine.su2 fine.basis report.html page.html; do
    check "demo leaves $file" test -s "$tmp/demo/$file"
done
check "demo: the mesh as it is shipped" cmp "$tmp/demo/mesh.su2" "$meshes/naca0012.su2"
runs "demo: far.txt is too far for one step" 1 morph "$tmp/demo/mesh.su2" "$tmp/demo/airfoil.basis" \
    --move "$tmp/demo/far.txt"
runs "demo: check of the fine mesh" 0 check "$tmp/demo/fine.su2" --json
check "demo: the fine mesh has four times the cells" \
    says "\"cells\": $((4 * $(sed -n 's/^NELEM= *//p' "$tmp/demo/mesh.su2" | tr -d '\r')))"
runs "demo: the fine basis moves the fine mesh" 0 morph "$tmp/demo/fine.su2" "$tmp/demo/fine.basis" \
    --move "$tmp/demo/moves.txt"
refuses "demo without its mesh" 3 '--mesh' demo "$tmp/demo" --mesh "$tmp/nowhere.su2"

# ---- Measures and design variables, of the demo's curve ------------------------------------------------------------

airfoil=$tmp/demo/airfoil.curve
number() { sed -n "s/.*\"$1\": \([^,}]*\).*/\1/p" "$tmp/out"; } # of the JSON object in out
near() { awk -v a="$1" -v b="$2" -v e="$3" 'BEGIN { d = a - b; exit !(d < e && d > -e) }'; }
runs "measures" 0 curve "$airfoil" --stations 0.3 --box 0.3,0 --json
check "measures: the area of a NACA 0012" near "$(number area)" 0.0817 1e-4
check "measures: its thickness" near "$(number max_thickness)" 0.12 1e-4
check "measures: its thickness at its largest" near "$(number thickness_0.3)" 0.12 1e-4
check "measures: the clearance of a point on the chord" near "$(number clearance)" 0.06 1e-3
area=$(number area)
runs "halved and elevated" 0 curve "$airfoil" --elevate --halve --insert 0.111 -o "$tmp/finer.curve" --json
check "halved and elevated: more points" test "$(number points)" -gt 40
runs "halved and elevated: measured" 0 curve "$tmp/finer.curve" --json
check "halved and elevated: the same area" near "$(number area)" "$area" 1e-14
runs "functions of the finer curve" 0 solve "$tmp/demo/mesh.su2" --curve airfoil="$tmp/finer.curve" \
    -o "$tmp/finer.basis"
refuses "a knot outside" 2 'not inside' curve "$airfoil" --insert 7
refuses "no number" 2 'expects numbers' curve "$airfoil" --insert x
refuses "three numbers for a chord" 2 'four numbers' curve "$airfoil" --chord 0,0,1
refuses "a station outside" 2 'not between 0 and 1' curve "$airfoil" --stations 1.5
for kind in "--cst 6,6" "--ffd 3,1" "--hicks-henne 2,2" "--naca 0.4"; do
    runs "variables $kind" 0 variables "$airfoil" $kind -o "$tmp/map" --json
    check "variables $kind: errors" test "$(grep -o rms_error "$tmp/out" | wc -l)" -ge 2
    echo '2 0.01' >"$tmp/values"
    runs "morph by $kind" 0 morph "$tmp/demo/mesh.su2" "$tmp/demo/airfoil.basis" --variables "$tmp/map" \
        --move "$tmp/values" -o "$tmp/by.su2" --json
    check "morph by $kind: on the B-spline" near "$(number boundary_error)" 0 1e-15
done
runs "thicker by NACA's mode" 0 curve "$tmp/by.su2.curve" --json
check "thicker by NACA's mode: by 1 %" near "$(number max_thickness)" 0.13 1e-4
refuses "two kinds of variables" 2 'one of --ffd' variables "$airfoil" --cst 6,6 --ffd 1,1
refuses "a box beside the airfoil" 2 'moves no control point' variables "$airfoil" --ffd 1,1 --box 5,5,6,6
refuses "variables of another curve" 3 'control points' morph "$tmp/demo/mesh.su2" "$tmp/finer.basis" \
    --variables "$tmp/map" --move "$tmp/values"
echo '7 1' >"$tmp/values"
refuses "a variable that is none" 3 'between 1 and 2' morph "$tmp/demo/mesh.su2" "$tmp/demo/airfoil.basis" \
    --variables "$tmp/map" --move "$tmp/values"

# Functions by table: a mode moves the mesh as the same displacement does.
awk '/^MARKER_TAG/ { on = $0 ~ /airfoil/ } on && $1 == 3 { seen[$2]; seen[$3] } END { for (p in seen) print p, 0, 1 }' \
    "$tmp/demo/mesh.su2" >"$tmp/plunge"
awk '{ print $1, 1, 0.5 }' "$tmp/plunge" | sort >"$tmp/surge"
sed 's/ 0 1$/ 0.004 0.022/' "$tmp/plunge" >"$tmp/field"
runs "functions by table" 0 solve "$tmp/demo/mesh.su2" --given airfoil --mode "$tmp/plunge" --mode "$tmp/surge" \
    -o "$tmp/modes.basis"
printf 'mode 1 0.02\nmode 2 0.004\n' >"$tmp/values"
runs "moved by modes" 0 morph "$tmp/demo/mesh.su2" "$tmp/modes.basis" --move "$tmp/values" -o "$tmp/by-modes.su2"
runs "displaced" 0 displace "$tmp/demo/mesh.su2" --given airfoil --wall "$tmp/field" -o "$tmp/displaced.su2"
same_points() { paste -d ' ' "$1" "$2" | awk 'NF % 2 == 0 { for (i = 1; i <= NF / 2; i++) { d = $i - $(i + NF / 2)
    if (d > 1e-12 || d < -1e-12) bad = 1 } ++n } END { exit bad || n < 1000 }'; }
check "moved by modes: as displaced" same_points "$tmp/by-modes.su2" "$tmp/displaced.su2"
refuses "modes without --given" 2 '--given' solve "$tmp/demo/mesh.su2" --mode "$tmp/plunge" -o "$tmp/x"
sed 1d "$tmp/plunge" >"$tmp/fewer"
refuses "a mode of fewer points" 3 'has not the points' solve "$tmp/demo/mesh.su2" --given airfoil \
    --mode "$tmp/plunge" --mode "$tmp/fewer" -o "$tmp/x"
sed 's/ 0 1$/ 0 0/' "$tmp/plunge" >"$tmp/zero"
refuses "a mode that is zero" 2 'mode 0 (from 0) is zero' solve "$tmp/demo/mesh.su2" --given airfoil \
    --mode "$tmp/zero" -o "$tmp/x"
echo 'mode 3 1' >"$tmp/values"
refuses "a mode that is none" 3 'between 1 and 2' morph "$tmp/demo/mesh.su2" "$tmp/modes.basis" --move "$tmp/values"

finish
