#!/bin/sh
# Tests of figures.sh, and of the first part of `make deform`: sh tests/measure/figures_test.sh FOLDER BUILD
tmp=${1:?folder for output} build=$2
rm -rf "$tmp"
mkdir -p "$tmp" || exit 2
topic=figures log=$tmp/log
. "$(dirname "$0")/../count.sh"
count() { grep -c -e "$1" "$tmp/index.html"; }

cat >"$tmp/command" <<'END'
echo "== One & two"
echo "A remark: 1 < 2"
echo "in two lines"
echo "table Rows & columns"
echo "  name  first   second value"
echo "  a b   1.5     -"
echo "  a note about a b"
echo ""
echo "another remark"
echo "figure a.svg The first figure has a < b."
echo "== Three"
echo "figure b.svg Figure 7b | The second figure. More of it."
exit $1
END
echo '<svg/>' >"$tmp/a.svg"
echo '<svg/>' >"$tmp/b.svg"
sh tests/measure/figures.sh "$tmp" "A title" sh "$tmp/command" 3 >"$tmp/out"
check "exit status of the command" test $? -eq 3
check "remarks are shown" grep -q '^A remark: 1 < 2' "$tmp/out"
check "tables are shown" grep -q '^  name  first   second value' "$tmp/out"
check "captions of tables are shown" grep -q '^Rows & columns' "$tmp/out"
check "captions are not shown" sh -c "! grep -q 'The first figure' '$tmp/out'"
check "one section each" test "$(count '<section>')" -eq 2
check "each section ends" test "$(count '</section>')" -eq 2
check "headings are escaped" grep -q '<h2>One &amp; two</h2>' "$tmp/index.html"
check "remarks are escaped" grep -q '<p>A remark: 1 &lt; 2' "$tmp/index.html"
check "lines of a remark are one paragraph" test "$(count '<p>')" -eq 2
check "captions of tables are escaped" grep -q '<caption>Rows &amp; columns</caption>' "$tmp/index.html"
check "headings have their cells" \
    grep -q '<th scope="col">name</th><th scope="col">first</th><th scope="col">second value</th>' "$tmp/index.html"
check "rows have their cells" grep -q '<td>a b</td><td class="number">1.5</td><td class="number">-</td>' \
    "$tmp/index.html"
check "a row of one cell runs over all columns" grep -q '<td class="remark" colspan="3">a note about a b</td>' \
    "$tmp/index.html"
check "an empty line ends a table" grep -q '<p>another remark' "$tmp/index.html"
check "one table" test "$(count '</table>')" -eq 1
check "pictures have a text" grep -q 'src="b.svg" alt="The second figure"' "$tmp/index.html"
check "a figure may have its own name" grep -q '<b>Figure 7b.</b> The second figure. More' "$tmp/index.html"
check "captions belong to figures" grep -q '<b>Figure 1.</b> The first figure has a &lt; b.' "$tmp/index.html"
check "links are relative" grep -q '<a href="a.svg"><img src="a.svg"' "$tmp/index.html"
check "no other address" sh -c "! grep -q '://' '$tmp/index.html'"
check "light and dark" grep -q 'prefers-color-scheme: dark' "$tmp/index.html"
check "the figure of the second section" awk '/Three/ { after = 1 } /b.svg/ { exit !after }' "$tmp/index.html"
rm "$tmp/b.svg"
sh tests/measure/figures.sh "$tmp" "A title" sh "$tmp/command" 0 >"$tmp/out"
check "a missing figure is a failure" test $? -eq 1
check "the missing figure is named" grep -q 'no figure .*b.svg' "$tmp/out"

# The smallest case of `make deform`: the block in a square, whose safe morphs reach their targets.
ln -s "$(cd "$build" && pwd)/meshes" "$tmp/meshes"
sh tests/measure/figures.sh "$tmp/deform" "Large movements" sh tests/measure/python.sh "$build" \
    tests/measure/deform/deform.py "$tmp/deform" >"$tmp/out" 2>&1
status=$?
if grep -q '^skipped' "$tmp/out"; then
    skip "the table of large movements" "$(sed -n 's/^skipped: //p' "$tmp/out")"
else
    check "deform: exit status" test $status -eq 0
    check "deform: no target is missed" grep -q '^0 targets of the safe morph missed' "$tmp/out"
    check "deform: a row for each exponent" \
        test "$(grep -c '<td>conformal [0-9.]*</td><td class="number">100.0 %</td>' "$tmp/deform/index.html")" -eq 5
    check "deform: no raw output of other commands" sh -c "! grep -q '{' '$tmp/out'"
fi

finish
