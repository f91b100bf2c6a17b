# Points that belong to two moving conditions; curves that are far from the wall; movements that the control points of a
# curve do not follow.

# An O-mesh of N columns round a section of thickness T with a sharp trailing edge at (1, 0): the upper half of the wall
# has marker upper, the lower half marker lower.
section_mesh() { # section_mesh N T [CAMBER]
    awk -v n="$1" -v t="$2" -v camber="${3:-0}" 'BEGIN {
        pi = atan2(0, -1); rows = 9
        print "NDIME= 2\nNELEM= " n * (rows - 1)
        for (j = 0; j < rows - 1; ++j) for (k = 0; k < n; ++k) {
            next_k = (k + 1) % n
            print 9, j * n + k, (j + 1) * n + k, (j + 1) * n + next_k, j * n + next_k
        }
        print "NPOIN= " n * rows
        for (j = 0; j < rows; ++j) for (k = 0; k < n; ++k) {
            a = 2 * pi * k / n; s = (j / (rows - 1)) ^ 2
            x = (1 + cos(a)) / 2; y = t * sin(a) * sin(a / 2) + camber * 4 * x * (1 - x)
            printf "%.17g %.17g %d\n", (1 - s) * x + s * (.5 + 4 * cos(a)), (1 - s) * y + s * 4 * sin(a), j * n + k
        }
        print "NMARK= 3\nMARKER_TAG= upper\nMARKER_ELEMS= " n / 2
        for (k = 0; k < n / 2; ++k) print 3, k, k + 1
        print "MARKER_TAG= lower\nMARKER_ELEMS= " n / 2
        for (k = n / 2; k < n; ++k) print 3, k, (k + 1) % n
        print "MARKER_TAG= far\nMARKER_ELEMS= " n
        for (k = 0; k < n; ++k) print 3, (rows - 1) * n + k, (rows - 1) * n + (k + 1) % n
    }'
}
at_most() { awk -v a="$1" -v b="$2" 'BEGIN { exit !(a != "" && a <= b) }'; }

shared=$tmp/shared
mkdir "$shared"
for variation in "24 .06 0" "48 .15 .03"; do
    mesh=$shared/mesh.su2 what="two sides ($variation)"
    section_mesh $variation >"$mesh"
    for side in upper lower; do makes fit "$mesh" --marker $side --points 6 -o "$shared/$side.curve"; done
    both="--curve upper=$shared/upper.curve --curve lower=$shared/lower.curve"
    runs "$what: solve" 0 solve "$mesh" $both --far-from-curve -o "$shared/two.basis"
    check "$what: a warning names the point and both markers" says "warning: point 0 (1, "
    check "$what: the warning names both markers" says "belongs to 'upper' and to 'lower'"
    refuses "$what: one curve turns" 1 'the movement tears the wall apart: point 0 ' morph "$mesh" "$shared/two.basis" \
        --by "turn upper 3 0.25,0" -o "$tmp/x"
    check "$what: the remedy" says "fit one curve through both markers (--marker A,B), or give the curves a common"
    runs "$what: one curve turns, --json" 1 morph "$mesh" "$shared/two.basis" --by "turn upper 3 0.25,0" --json
    check "$what: the error is that of the other curve" at_most .039 "$(number boundary_error)"
    refuses "$what: one curve turns, --safe" 1 'the movement tears the wall apart: point 0 ' morph "$mesh" \
        "$shared/two.basis" --by "turn upper 3 0.25,0" --safe -o "$tmp/x"
    runs "$what: one curve turns, --force" 1 morph "$mesh" "$shared/two.basis" --by "turn upper 3 0.25,0" --force \
        -o "$shared/forced.su2"
    runs "$what: both curves turn" 0 morph "$mesh" "$shared/two.basis" --by "turn upper 3 0.25,0" \
        --by "turn lower 3 0.25,0" -o "$shared/turned.su2" --json
    check "$what: both curves turn: exactly" at_most "$(number boundary_error)" 1e-12
    runs "$what: one curve through both" 0 fit "$mesh" --marker upper,lower --points 12 -o "$shared/one.curve"
    runs "$what: one curve through both: solve" 0 solve "$mesh" --curve upper,lower="$shared/one.curve" \
        --far-from-curve -o "$shared/one.basis"
    check "$what: one curve through both: no warning of the point" sh -c "! grep belongs '$tmp/err'"
    runs "$what: one curve through both: morph" 0 morph "$mesh" "$shared/one.basis" --by "turn upper 3 0.25,0" \
        -o "$shared/whole.su2" --json
    check "$what: one curve through both: exactly" at_most "$(number boundary_error)" 1e-12
    runs "$what: a body beside a curve" 0 solve "$mesh" --rigid upper=.5,0 --curve lower="$shared/lower.curve" \
        --far-from-curve -o "$shared/body.basis"
    check "$what: a body beside a curve: warning" says "belongs to 'lower' and to 'upper'"
    refuses "$what: the body moves" 1 'tears the wall apart' morph "$mesh" "$shared/body.basis" \
        --by "rigid upper 0 .01 0" -o "$tmp/x"
    runs "$what: both move" 0 morph "$mesh" "$shared/body.basis" --by "rigid upper 0 .01 0" --by "shift lower 0 .01" \
        -o "$shared/both.su2"
    runs "$what: two bodies that touch" 0 solve "$mesh" --rigid upper=.5,0 --rigid lower=.5,0 -o "$shared/bodies.basis"
    check "$what: two bodies that touch: the remedy" says "make both markers one body"
    refuses "$what: one of two bodies moves" 1 'tears the wall apart' morph "$mesh" "$shared/bodies.basis" \
        --by "rigid lower 0 0 2" -o "$tmp/x"
    runs "$what: both bodies turn" 0 morph "$mesh" "$shared/bodies.basis" --by "rigid lower 0 0 2" \
        --by "rigid upper 0 0 2" -o "$shared/both.su2"
    # The table gives all points of the upper side, which are the points 0 to n/2.
    n=${variation%% *}
    for dy in .01 .02; do
        awk -v n=$n -v dy=$dy 'BEGIN { for (k = 0; k <= n / 2; ++k) print k, 0, dy }' >"$shared/$dy.txt"
    done
    for how in "" --safe; do
        runs "$what: displace with the curve $how" 0 displace "$mesh" --given upper --wall "$shared/.01.txt" \
            --curve lower="$shared/lower.curve" --far-from-curve --by "shift lower 0 .01" $how -o "$shared/d.su2" --json
        check "$what: displace with the curve $how: exactly" at_most "$(number boundary_error)" 1e-12
        refuses "$what: displace away from the curve $how" 1 "belongs to 'lower' and to 'upper'" displace "$mesh" \
            --given upper --wall "$shared/.02.txt" --curve lower="$shared/lower.curve" --far-from-curve \
            --by "shift lower 0 .01" $how -o "$tmp/x"
    done
done

# The curve of another section: of camber .004, and of thickness .09.
section_mesh 48 .06 >"$shared/flat.su2"
makes fit "$shared/flat.su2" --marker upper,lower --points 16 -o "$shared/flat.curve"
on_flat="--curve upper,lower=$shared/flat.curve"
runs "the curve of the section" 0 solve "$shared/flat.su2" $on_flat -o "$shared/far.basis"
check "the curve of the section: no warning" sh -c "! grep 'away from its curve' '$tmp/err'"
section_mesh 48 .06 .004 >"$shared/near.su2"
runs "a curve nearby" 0 solve "$shared/near.su2" $on_flat -o "$shared/far.basis"
check "a curve nearby: warning" says 'warning: point'
check "a curve nearby: of the distance" says 'at least 0.001 of the diagonal'
section_mesh 48 .09 >"$shared/another.su2"
refuses "the curve of another section" 2 '--far-from-curve' solve "$shared/another.su2" $on_flat -o "$tmp/x"
runs "the curve of another section, --far-from-curve" 0 solve "$shared/another.su2" $on_flat --far-from-curve \
    -o "$shared/far.basis"
check "the curve of another section, --far-from-curve: warning" says 'away from its curve'
runs "the curve of another section: --safe" 0 morph "$shared/another.su2" "$shared/far.basis" --by "turn upper 3" \
    --safe -o "$shared/safe.su2"

# A flap of few control points is off by the error that the program prints; one of many is not.
for points in 12 24; do
    makes fit "$shared/flat.su2" --marker upper,lower --points $points -o "$shared/few.curve"
    makes solve "$shared/flat.su2" --curve upper,lower="$shared/few.curve" --far-from-curve -o "$shared/few.basis"
    runs "a flap of $points control points" 0 morph "$shared/flat.su2" "$shared/few.basis" --by "flap upper .7,0 10" \
        -o "$shared/flap.su2"
    check "a flap of $points control points: its error" says 'movement error   '
    check "a flap of $points control points: warning" says "warning: the control points do not follow 'flap upper"
    check "a flap of $points control points: the remedy" says 'curve --halve'
    runs "a flap of $points control points, --json" 0 morph "$shared/flat.su2" "$shared/few.basis" \
        --by "flap upper .7,0 10" --json
    error=$(number movement_error)
    check "a flap of $points control points: its size" at_most .001 "$error"
    cp "$shared/few.curve" "$shared/fine.curve"
    for k in 1 2 3 4; do
        makes curve "$shared/fine.curve" --halve -o "$shared/finer.curve"
        mv "$shared/finer.curve" "$shared/fine.curve"
    done
    makes solve "$shared/flat.su2" --curve upper,lower="$shared/fine.curve" --far-from-curve -o "$shared/fine.basis"
    runs "a flap of $points control points, halved" 0 morph "$shared/flat.su2" "$shared/fine.basis" \
        --by "flap upper .7,0 10" --json
    check "a flap of $points control points, halved: smaller" at_most "$(number movement_error)" \
        "$(awk -v e="$error" 'BEGIN { print e / 4 }')"
done
runs "a turn has no error" 0 morph "$shared/flat.su2" "$shared/few.basis" --by "turn upper 10" -o "$shared/flap.su2"
check "a turn has no error: nothing is printed" sh -c "! grep -E 'movement error|do not follow' '$tmp/out' '$tmp/err'"
rm -rf "$shared"
