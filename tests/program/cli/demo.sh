# The demo on the shipped mesh.

mkdir -p "$tmp/a b's"
runs "demo" 0 demo "$tmp/a b's/../demo" --mesh "$meshes/naca0012.su2"
line=$(sed -n 's/^\$ harmorph \(fit .*\)/\1/p' "$tmp/out")
repeats_the_command() { test -n "$line" && eval "\"$harmorph\" $line"; }
check "demo: a printed command can be repeated, also with blanks in names" repeats_the_command
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
mkdir -p "$tmp/project"
echo mine >"$tmp/project/mesh.su2"
refuses "demo in a folder with files of others" 2 'is not empty and has no demo.txt' demo "$tmp/project" \
    --mesh "$meshes/naca0012.su2"
check "demo: the files of others stay" test "$(cat "$tmp/project/mesh.su2")" = mine
