# Many designs of a mesh: designs, limits, files, continuation, full disks.

: "${CC:=cc}"
set_of() { # set_of FOLDER ARGUMENTS...: control points of the ring, 25 designs, three shards
    folder=$1; shift
    "$harmorph" sample "$ring" "$basis" --range=-.05,.05 --count 25 --shard 10 --chord=-1,0,1,0 -o "$folder" "$@" \
        >"$tmp/out" 2>"$tmp/err"
}
check "sample: a reader of .npz is compiled" "$CC" -o "$tmp/read_npz" "$here/read_npz.c"
check "sample: control points" set_of "$tmp/set" --meshes --vtk --wall
check "sample: no progress bar in a file" test ! -s "$tmp/err"
for file in set.txt designs.csv index.html README.md vtk/series.pvd shards/00003.npz meshes/0000025.su2 \
    vtk/0000025.vtu; do
    check "sample: there is $file" test -s "$tmp/set/$file"
done
# The page of the designs has the style of the report, works without a network, and has a point for each design.
like_the_report() {
    runs "sample: a report to compare with" 0 morph "$ring" "$basis" --move "$tmp/small.txt" --report "$tmp/report.html"
    for page in set/index.html report.html; do
        sed -n '/^:root {/,/^}/p; /^article {/,/}/p' "$tmp/$page" >"$tmp/$(basename "$page").style"
    done
    cmp "$tmp/index.html.style" "$tmp/report.html.style" && grep -q -e --panel "$tmp/index.html.style" &&
        ! grep -E '(src|href)="?(https?:)?//' "$tmp/set/index.html" &&
        [ "$(grep -o '<figure>' "$tmp/set/index.html" | wc -l)" = 25 ] &&
        [ "$(tail -n 1 "$tmp/set/index.html")" = "</html>" ]
}
check "sample: the page of the designs is like the other pages" like_the_report
column() { awk -F, -v name="$2" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) c = i; next } { print $c }' "$1"; }
check "sample: a line for each design" test "$(column "$tmp/set/designs.csv" design | tr '\n' ' ')" = \
    "$(seq 1 25 | tr '\n' ' ')"
"$tmp/read_npz" "$tmp/set/shards/00001.npz" >"$tmp/shapes" 2>"$tmp/log"
for shape in "coordinates <f8 10 624 2" "variables <f8 10 12" "control_points <f8 10 12 2" "min_quality <f8 10" \
    "area <f8 10" "valid |u1 10" "split |u1 10" "design <i4 10" "cell_start <i4 625" "cell_points <i4 2400" \
    "face_points <i4 96 2" "wall_points <i4 48" "wall_start <i4 2" "wall_normals <f8 10 48 2" \
    "wall_arc_length <f8 10 48"; do
    check "sample: another reader finds $shape" grep -qx -e "$shape" "$tmp/shapes"
done
"$tmp/read_npz" "$tmp/set/shards/00003.npz" >"$tmp/shapes"
check "sample: the last shard has the rest" grep -qx -e "coordinates <f8 5 624 2" "$tmp/shapes"

# Design 13, the third one of the second shard, by `morph`: the same mesh, and the same numbers in the arrays.
awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i ~ /^[0-9]+y$/) name[i] = $i + 0 }
    $1 == 13 { for (i in name) print name[i], 0, $i }' "$tmp/set/designs.csv" >"$tmp/moves"
runs "sample: the moves of a design" 0 morph "$ring" "$basis" --move "$tmp/moves" -o "$tmp/design.su2" --json
check "sample: the same mesh" cmp "$tmp/design.su2" "$tmp/set/meshes/0000013.su2"
check "sample: the same quality" test "$(number min_quality | awk '{ printf "%.12g", $1 }')" = \
    "$(column "$tmp/set/designs.csv" min_quality | awk 'NR == 13 { printf "%.12g", $1 }')"
"$tmp/read_npz" "$tmp/set/shards/00002.npz" coordinates | awk 'NR == 3' | tr ' ' '\n' | sed 1d >"$tmp/numbers"
awk '/^NPOIN/ { inside = 1; next } /^[A-Z]/ { inside = 0 } inside { print $1; print $2 }' "$tmp/design.su2" |
    paste - "$tmp/numbers" | awk '{ d = $1 - $2; if (d > worst) worst = d; if (-d > worst) worst = -d }
        END { print NR, worst; exit !(NR == 1248 && worst < 1e-4) }' >"$tmp/log"
check "sample: the same coordinates in the arrays" test $? = 0
# Sums of the numbers in the range of each parameter: Sobol's points are even.
check "sample: of 16 designs, one in each sixteenth" awk -F, '
    NR == 1 { for (i = 1; i <= NF; i++) if ($i ~ /^[0-9]+y$/) name[i] = $i; next }
    NR <= 17 { for (i in name) if (seen[i, int(($i + .05) / .1 * 16)]++) bad++ }
    END { print bad + 0; exit bad > 0 }' "$tmp/set/designs.csv"
# The normals of the wall point into the ring, away from the centre, and the arcs grow.
"$tmp/read_npz" "$tmp/set/shards/00001.npz" wall_normals >"$tmp/normals"
"$tmp/read_npz" "$tmp/set/shards/00001.npz" wall_points | tr -d ' ' >"$tmp/wall"
"$tmp/read_npz" "$tmp/set/shards/00001.npz" wall_arc_length >"$tmp/arcs"
check "sample: normals of walls point into the mesh" awk -v file="$tmp/wall" 'BEGIN {
        while ((getline p <file) > 0) place[n++] = p
        pi = atan2(0, -1) }
    { for (k = 0; k < n; k++) { a = 2 * pi * place[k] / 48
        if ($(2 * k + 1) * cos(a) + $(2 * k + 2) * sin(a) < .8) bad++
        d = $(2 * k + 1) ^ 2 + $(2 * k + 2) ^ 2 - 1; if (d > 1e-12 || d < -1e-12) bad++ } }
    END { print n, bad; exit !(n == 48 && NR == 10 && !bad) }' "$tmp/normals"
check "sample: arc lengths grow" awk '{ if ($1 != 0) bad++; for (k = 2; k <= NF; k++) if ($k <= $(k - 1)) bad++
        if ($NF < 5.5 || $NF > 7) bad++ } END { exit !(NR == 10 && !bad) }' "$tmp/arcs"
# Distances to the walls: 0 there, and of the outer circle near 3, the distance without a movement.
check "sample: distances to walls" set_of "$tmp/distances" --wall-distance
"$tmp/read_npz" "$tmp/distances/shards/00003.distance.npz" wall_distance >"$tmp/numbers"
check "sample: distances to walls: values" awk '{ for (k = 1; k <= 48; k++) bad += $k != 0
        for (k = 577; k <= 624; k++) bad += $k < 2.9 || $k > 3.1 }
    END { print NR, NF, bad; exit !(NR == 5 && NF == 624 && !bad) }' "$tmp/numbers"
python=python3
if [ -x /usr/bin/python3 ]; then python=/usr/bin/python3; fi
if $python -c 'import numpy' >/dev/null 2>&1; then
    check "sample: numpy reads the arrays" $python -c '
import csv, sys, numpy
rows = list(csv.DictReader(open(sys.argv[1] + "/designs.csv")))
for shard in (1, 2, 3):
    arrays = numpy.load(sys.argv[1] + "/shards/%05d.npz" % shard)
    assert all(numpy.isfinite(arrays[name]).all() for name in ("coordinates", "variables", "area"))
    assert len(numpy.unique(arrays["cell_points"])) == 624 == arrays["coordinates"].shape[1]
    for k, design in enumerate(arrays["design"]):
        row = rows[design - 1]
        assert int(row["shard"]) == shard and int(row["row"]) == k
        assert float(row["area"]) == arrays["area"][k] and float(row["5y"]) == arrays["variables"][k][4]
' "$tmp/set"
else
    skip "arrays read by numpy" "python3-numpy is not installed"
fi

# The same bits for any number of threads, with designs that need the safe morph, and in another order of work.
same_set() { (cd "$1" && find . -type f ! -name '*.part*' | sort | xargs cksum) >"$tmp/sums"
    (cd "$2" && find . -type f ! -name '*.part*' | sort | xargs cksum) | cmp - "$tmp/sums"; }
check "sample: large movements" "$harmorph" sample "$ring" "$basis" --range=-1.5,1.5 --count 12 --shard 5 --sequence \
    latin \
    --seed 3 -o "$tmp/large" --threads 1 --min-quality .01 --json
cp "$tmp/log" "$tmp/out"
check "sample: some need a safe morph" sh -c "grep -q ',substeps,\|,untangled,\|,improved,' '$tmp/large/designs.csv'"
check "sample: large movements on three threads" "$harmorph" sample "$ring" "$basis" --range=-1.5,1.5 --count 12 \
    --shard 5 \
    --sequence latin --seed 3 -o "$tmp/threads" --threads 3 --min-quality .01
check "sample: the same bits" same_set "$tmp/large" "$tmp/threads"
check "sample: rejected designs have a reason" awk -F, '
    NR > 1 && ($2 == 0) != ($NF != "") { bad++ } END { exit bad > 0 || NR != 13 }' "$tmp/large/designs.csv"
check "sample: of 12 designs of a hypercube, one in each twelfth" awk -F, '
    NR == 1 { for (i = 1; i <= NF; i++) if ($i ~ /^[0-9]+y$/) name[i] = $i; next }
    { for (i in name) if (seen[i, int(($i + 1.5) / 3 * 12)]++) bad++ } END { exit bad > 0 }' "$tmp/large/designs.csv"

# A killed program: half-written files go, complete shards stay, and the set becomes the same.
cp -R "$tmp/set" "$tmp/killed"
rm "$tmp/killed/shards/00003.npz" "$tmp/killed/designs.csv" "$tmp/killed/index.html" "$tmp/killed/README.md"
echo half >"$tmp/killed/shards/00003.npz.part1a2b"
before=$(ls -i "$tmp/killed/shards/00002.npz")
check "sample: continued" set_of "$tmp/killed" --meshes --vtk --wall
check "sample: continued behind the second shard" says "continued at design 21 of 25"
check "sample: a complete shard stays" test "$before" = "$(ls -i "$tmp/killed/shards/00002.npz")"
check "sample: no half-written file is left" test ! -e "$tmp/killed/shards/00003.npz.part1a2b"
check "sample: the same set as without the kill" same_set "$tmp/set" "$tmp/killed"
"$harmorph" sample "$ring" "$basis" --range=-.05,.05 --count 100000 --shard 50 -o "$tmp/long" >/dev/null 2>&1 &
running=$!
for second in 1 2 3 4 5 6 7 8 9 10; do
    if [ -e "$tmp/long/shards/00002.npz" ]; then break; fi
    sleep 1
done
kill -TERM $running
wait $running 2>/dev/null
check "sample: ended by a signal: no temporary file" test -z "$(ls "$tmp/long" "$tmp/long/shards" | grep part)"
check "sample: ended by a signal: complete shards" "$tmp/read_npz" "$tmp/long/shards/00001.npz"
rm -rf "$tmp/long"
refuses "sample: another set in the folder" 2 'other options or files' sample "$ring" "$basis" --range=-.04,.05 \
    --count 25 -o "$tmp/set"
(trap '' XFSZ; ulimit -c 0; ulimit -f 100; set_of "$tmp/full")
check "sample: a full disk: exit code 3" test $? = 3
check "sample: a full disk: says so" says 'cannot be written'
check "sample: a full disk: no half-written file" test -z "$(ls "$tmp/full" "$tmp/full/shards" | grep part)"
check "sample: a full disk: continued with more room" set_of "$tmp/full"
check "sample: a full disk: the same arrays" "$tmp/read_npz" "$tmp/full/shards/00003.npz"

# Limits, splits, tables, variables.
check "sample: limits" set_of "$tmp/limited" --min area=3.13 --max min_quality=2 --inside 1y=-.02,.05 --test .5
check "sample: limits: by the area" awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "area") c = i; next }
    $2 != ($c >= 3.13) { bad++ } !$2 && $NF !~ /area .* is below 3.13/ { bad++ } { n[$2]++ }
    END { print n[0], n[1], bad; exit !(n[0] > 2 && n[1] > 2 && !bad) }' "$tmp/limited/designs.csv"
check "sample: splits" awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "1y") c = i; next }
    $2 { bad += ($3 == "out") != ($c < -.02); ++n[$3] } !$2 { bad += $3 != "" }
    END { print n["out"], n["test"], n["train"]; exit !(!bad && n["out"] && n["test"] && n["train"]) }' \
    "$tmp/limited/designs.csv"
printf '3y, 5x\n.01, -.02\n0, .03\n' >"$tmp/table"
runs "sample: a table" 0 sample "$ring" "$basis" --designs "$tmp/table" -o "$tmp/tabled" --meshes --json
check "sample: a table: two designs" test "$(number accepted)" = 2
printf '3 0 .01\n5 -.02 0\n' >"$tmp/moves"
runs "sample: a table: the moves" 0 morph "$ring" "$basis" --move "$tmp/moves" -o "$tmp/design.su2"
check "sample: a table: the same mesh" cmp "$tmp/design.su2" "$tmp/tabled/meshes/0000001.su2"
printf '3 -.01 .01\n' >"$tmp/range"
makes variables "$curve" --naca .4 --chord=-1,0,1,0 -o "$tmp/map"
printf '1 0 .1\n2 -.1 0\n' >"$tmp/range"
runs "sample: design variables" 0 sample "$ring" "$basis" --variables "$tmp/map" --ranges "$tmp/range" --count 4 \
    -o "$tmp/varied" --json
check "sample: design variables: their columns" test \
    "$(head -1 "$tmp/varied/designs.csv" | grep -c ',1,2,section,reason')" = 1

# Sections: formulas and files.
airfoil=$tmp/demo/airfoil.basis mesh=$tmp/demo/mesh.su2
[ -e "$airfoil" ] || makes demo "$tmp/demo" --mesh "$meshes/naca0012.su2"
printf 'camber 0 0\nposition .4 .4\nthickness .12 .12001\n' >"$tmp/range"
runs "sample: NACA sections" 0 sample "$mesh" "$airfoil" --naca --ranges "$tmp/range" --count 1 -o "$tmp/naca" --json
check "sample: NACA 0012: its thickness" awk -F, \
    'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "max_thickness") c = i; next }
    { exit !($c > .1199 && $c < .1201) }' "$tmp/naca/designs.csv"
# Cambers between which another point of the section becomes the farthest from the trailing edge.
printf 'camber,position,thickness\n.0538377582989,.4,.12\n.0538377582995,.4,.12\n' >"$tmp/near.csv"
runs "sample: two sections that are nearly one" 0 sample "$mesh" "$airfoil" --naca --designs "$tmp/near.csv" \
    -o "$tmp/near"
"$tmp/read_npz" "$tmp/near/shards/00001.npz" coordinates >"$tmp/numbers"
check "sample: two sections that are nearly one have nearly one mesh" awk '
    NR == 1 { n = split($0, first); next }
    { for (k = 1; k <= NF; k++) { d = $k - first[k]; if (d * d > worst) worst = d * d } }
    END { exit !(NR == 2 && n > 1000 && worst < 1e-10) }' "$tmp/numbers"
runs "sample: sections of class-shape transformation" 0 sample "$mesh" "$airfoil" --cst 4,4 --count 3 -o "$tmp/cst" \
    --json
check "sample: class-shape transformation: accepted" test "$(number accepted)" = 3
makes fit "$mesh" --marker airfoil -o "$tmp/own.dat"
printf '# a comment\nown.dat\nnone.dat\n' >"$tmp/list"
runs "sample: a list of sections" 0 sample "$mesh" "$airfoil" --sections "$tmp/list" -o "$tmp/listed" --json
check "sample: a list: one is accepted" test "$(number accepted)" = 1
check "sample: a list: the reason of the other one" grep -q 'none.dat.*No such file' "$tmp/listed/designs.csv"

refuses "sample: no number" 2 '--count is missing' sample "$ring" "$basis" --range=-1,1 -o "$tmp/x"
refuses "sample: no ranges" 2 'no parameter varies' sample "$ring" "$basis" --count 3 -o "$tmp/x"
refuses "sample: no folder" 2 '-o is missing' sample "$ring" "$basis" --range=-1,1 --count 3
refuses "sample: two kinds" 2 'only one of' sample "$ring" "$basis" --naca --cst 3,3 --count 3 -o "$tmp/x"
refuses "sample: a limit without a number" 2 'NAME=NUMBER' sample "$ring" "$basis" --range=-1,1 --count 3 --min area \
    -o "$tmp/x"
refuses "sample: a limit of another name" 2 'is none of' sample "$ring" "$basis" --range=-1,1 --count 3 --min aera=1 \
    -o "$tmp/x"
printf '99y 0 1\n' >"$tmp/range"
refuses "sample: a parameter that is none" 3 "'99y'" sample "$ring" "$basis" --ranges "$tmp/range" --count 3 \
    -o "$tmp/x"
refuses "sample: parameters of files" 2 'have no parameters' sample "$mesh" "$airfoil" --sections "$tmp/list" \
    --range=-1,1 -o "$tmp/x"
mkdir "$tmp/inputs" && cp "$tmp/table" "$tmp/inputs/designs.csv"
refuses "sample: an output over an input" 2 'are the same file' sample "$ring" "$basis" --designs \
    "$tmp/inputs/designs.csv" \
    -o "$tmp/inputs"

# A few sections of each of nine families, in all orders of points: all are reached.
check "sample: sections of nine families" sh "$here/../../measure/sections/run.sh" "$harmorph" "$meshes" \
    "$tmp/families" 54
awk -F'|' '$2 ~ /^ [a-z]/ && $2 !~ /family/ { ++n; sections += $3; bad += $3 != $4 || $8 < .2
        bad += $7 > ($2 ~ /blunt|modified/ ? 6e-3 : 1.5e-3) }
    END { print n, sections, bad; exit !(n == 9 && sections == 54 && !bad) }' "$tmp/log" >"$tmp/counts"
check "sample: sections of nine families: reached, near the points, with good cells" test $? = 0

# Folders of others: refused, and every file stays; of a set, only its own files are removed.
mkdir -p "$tmp/others/shards" "$tmp/others/vtk"
for file in README.md designs.csv index.html backup.part1 shards/notes.part2f shards/00001.npz vtk/keep.part0; do
    echo mine >"$tmp/others/$file"
done
cp -R "$tmp/others" "$tmp/others.before"
refuses "sample: a folder with files of others" 2 'is not empty and has no set.txt' sample "$ring" "$basis" \
    --range=-.05,.05 --count 2 -o "$tmp/others"
check "sample: files of others stay" diff -r "$tmp/others" "$tmp/others.before"
mkdir "$tmp/others/deeper"
refuses "sample: the same folder, spelled otherwise" 2 'is not empty and has no set.txt' sample "$ring" "$basis" \
    --range=-.05,.05 --count 2 -o "$tmp/others/deeper/.."
rmdir "$tmp/others/deeper"
check "sample: files of others stay there, too" diff -r "$tmp/others" "$tmp/others.before"
mkdir -p "$tmp/empty"
check "sample: an empty folder" set_of "$tmp/empty"
check "sample: an empty folder: the lock is gone" test ! -e "$tmp/empty/set.txt.lock"
for file in backup.part1 mine.part2f shards/notes.part2f shards/1.npz.part3 shards/00001.npz.bak.partz; do
    echo mine >"$tmp/empty/$file"
done
echo half >"$tmp/empty/designs.csv.part7a"
echo half >"$tmp/empty/shards/00002.csv.part12"
check "sample: continued beside files of others" set_of "$tmp/empty"
for file in backup.part1 mine.part2f shards/notes.part2f shards/1.npz.part3 shards/00001.npz.bak.partz; do
    check "sample: a set beside $file, which stays" test -s "$tmp/empty/$file"
done
for file in designs.csv.part7a shards/00002.csv.part12; do
    check "sample: a set with $file, which goes" test ! -e "$tmp/empty/$file"
done
# Two runs at once: the second is refused; a run that was killed does not block the next one.
"$harmorph" sample "$ring" "$basis" --range=-.05,.05 --count 100000 --shard 50 -o "$tmp/busy" >/dev/null 2>&1 &
running=$!
for tenth in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20; do
    if [ -e "$tmp/busy/set.txt" ]; then break; fi
    sleep .5
done
"$harmorph" sample "$ring" "$basis" --range=-.05,.05 --count 100000 --shard 50 -o "$tmp/busy" >"$tmp/out" 2>"$tmp/err"
code=$?
kill -KILL $running
wait $running 2>/dev/null
check "sample: a second run in the folder: exit code 2" test $code = 2
check "sample: a second run in the folder: says so" grep -q 'is being filled by another run' "$tmp/err"
"$harmorph" sample "$ring" "$basis" --range=-.05,.05 --count 100000 --shard 50 -o "$tmp/busy" >"$tmp/out" 2>&1 &
running=$!
sleep 1
check "sample: a killed run does not block the next one" kill -TERM $running
wait $running 2>/dev/null
rm -rf "$tmp/busy"
