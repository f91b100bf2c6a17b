# Every kind of file that make_mesh writes: check, fit, solve, morph. (A part of tests/program/formats.sh.)
# What is read, written again by make_mesh, is the file; what is morphed is make_mesh's file of the new coordinates.
has_zlib || echo "the program is made without zlib: compressed files are not tested (Debian's zlib1g-dev)"
for kind in $("$make_mesh" list); do
    case $kind in packed*) has_zlib || continue ;; esac
    mesh=$tmp/$kind moved=$tmp/moved-$kind zone= close=1e-9
    case $kind in
    zones.su2) zone="--zone 2" ;;
    text*.vtk | fixed.su2 | leading-zero.su2) close=1e-7 ;;
    *single*) close=1e-5 ;;
    esac
    check "$kind: check" "$harmorph" check "$mesh" $zone
    before=$tmp/before.su2 after=$tmp/after.su2
    check "$kind: convert" "$harmorph" convert "$mesh" "$before" $zone
    body=$(body_of "$mesh" $zone)
    check "$kind: fit" "$harmorph" fit "$mesh" --marker "$body" --points 8 -o "$tmp/curve" $zone
    check "$kind: solve" "$harmorph" solve "$mesh" --curve "$body=$tmp/curve" -o "$tmp/basis" $zone
    check "$kind: zero move" "$harmorph" morph "$mesh" "$tmp/basis" --move "$tmp/none.txt" -o "$moved" $zone
    check "$kind: zero move: the same file" cmp "$mesh" "$moved"
    check "$kind: morph" "$harmorph" morph "$mesh" "$tmp/basis" --move "$tmp/moves.txt" -o "$moved" $zone
    check "$kind: morph: the mesh moved" sh -c "! cmp -s '$mesh' '$moved'"
    format=$("$make_mesh" format $kind)
    [ $kind = zones.su2 ] || check "$kind: the format is forced" "$harmorph" check "$mesh" --format $format
    check "$kind: convert the morphed" "$harmorph" convert "$moved" "$after" $zone
    # Points of two blocks have another order.
    case $kind in two-*)
        for file in "$before" "$after"; do
            mv "$file" "$tmp/two-points.su2"
            "$make_mesh" plain.su2 "$file" "$tmp/two-points.su2"
        done ;;
    esac
    if [ $kind = quadratic.msh ]; then
        "$make_mesh" $kind "$tmp/expected" "$after"
        check "$kind: middles of edges move along with them" alike 1e-12 "$tmp/expected" "$moved"
    else
        "$make_mesh" $kind "$tmp/expected" "$before"
        check "$kind: read as it is" cmp "$tmp/expected" "$mesh"
        "$make_mesh" $kind "$tmp/expected" "$after"
        # The generator stores what zlib compresses.
        case $kind in packed*) ;; *)
            check "$kind: morph: only coordinates differ" cmp "$tmp/expected" "$moved" ;;
        esac
    fi
    points_of "$after" >"$tmp/points"
    [ $kind = prisms.lb8.ugrid ] || check "$kind: moves as all do" alike $close "$tmp/points-of-all" "$tmp/points"
done
