#!/bin/sh
# Tests of figures.sh: sh tests/figures_test.sh FOLDER
tmp=${1:?folder for output}
rm -rf "$tmp"
mkdir -p "$tmp" || exit 2
passed=0 failed=0
check() { # check NAME COMMAND...: the command succeeds
    name=$1; shift
    if "$@" >/dev/null 2>&1; then echo "ok   $name"; passed=$((passed + 1)); else echo "FAIL $name"; failed=$((failed + 1)); fi
}
count() { grep -c -e "$1" "$tmp/index.html"; }

cat >"$tmp/command" <<'END'
echo "== One & two"
echo "rows    1 < 2"
echo "figure a.svg The first figure has a < b."
echo "== Three"
echo "figure b.svg The second figure."
exit $1
END
echo '<svg/>' >"$tmp/a.svg"
echo '<svg/>' >"$tmp/b.svg"
sh tests/figures.sh "$tmp" "A title" sh "$tmp/command" 3 >"$tmp/out"
check "exit status of the command" test $? -eq 3
check "tables are shown" grep -q 'rows    1 < 2' "$tmp/out"
check "captions are not shown" sh -c "! grep -q 'The first figure' '$tmp/out'"
check "one section each" test "$(count '<section>')" -eq 2
check "each section ends" test "$(count '</section>')" -eq 2
check "headings are escaped" grep -q '<h2>One &amp; two</h2>' "$tmp/index.html"
check "tables are escaped" grep -q 'rows    1 &lt; 2' "$tmp/index.html"
check "captions belong to figures" grep -q '<b>Figure 1.</b> The first figure has a &lt; b.' "$tmp/index.html"
check "links are relative" grep -q '<a href="a.svg"><img src="a.svg"' "$tmp/index.html"
check "no other address" sh -c "! grep -q '://' '$tmp/index.html'"
check "light and dark" grep -q 'prefers-color-scheme: dark' "$tmp/index.html"
check "the figure of the second section" awk '/Three/ { after = 1 } /b.svg/ { exit !after }' "$tmp/index.html"
rm "$tmp/b.svg"
sh tests/figures.sh "$tmp" "A title" sh "$tmp/command" 0 >"$tmp/out"
check "a missing figure is a failure" test $? -eq 1
check "the missing figure is named" grep -q 'no figure .*b.svg' "$tmp/out"

echo "$passed passed, $failed failed"
[ $failed = 0 ]
