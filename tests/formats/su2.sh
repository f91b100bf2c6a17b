# SU2, and what is no mesh at all. (A part of tests/formats.sh.)
refuses "several zones: which" "zones.su2:1: the file has 3 zones: choose one with --zone" "$harmorph" \
    check "$tmp/zones.su2"
"$harmorph" check "$tmp/zones.su2" --zone 4 >"$tmp/out" 2>&1
says "several zones: one that does not exist" 'between 1 and 3'
sed 's/^IZONE= 3/IZONE= 4/' "$tmp/zones.su2" >"$tmp/bad.su2"
refuses "several zones: out of order" 'expected IZONE= 3' "$harmorph" check "$tmp/bad.su2" --zone 2
sed '/^IZONE= 3/,$d' "$tmp/zones.su2" >"$tmp/bad.su2"
refuses "several zones: one is missing" 'bad.su2:1: NZONE= announces 3 zones' "$harmorph" check "$tmp/bad.su2" --zone 2
sed 's/MARKER_TAG= far/MARKERTAG= far/' "$tmp/ring.su2" >"$tmp/bad.su2"
line=$(grep -n MARKERTAG "$tmp/bad.su2" | cut -d: -f1)
refuses "MARKERTAG" "bad.su2:$line: expected MARKER_TAG=" "$harmorph" check "$tmp/bad.su2"
"$harmorph" check "$tmp/odd.su2" >"$tmp/out" 2>&1
says "faces between cells are ignored, and said" "24 faces of marker 'inside line' between two cells"
echo 'hello world' >"$tmp/bad.mesh"
refuses "no mesh at all" "bad.mesh:1: no mesh file that is known begins with 'hello world'" "$harmorph" \
    check "$tmp/bad.mesh"
: >"$tmp/bad.mesh"
refuses "an empty file" 'the file is empty' "$harmorph" check "$tmp/bad.mesh"
"$harmorph" check "$tmp/ring.su2" --format cgnz >"$tmp/out" 2>&1
says "an unknown format" "unknown format 'cgnz'"
# How far a file has been read is for people at a terminal.
if command -v script >/dev/null 2>&1 && script -qec true /dev/null </dev/null >/dev/null 2>&1; then
    script -qec "'$harmorph' check '$tmp/ring.su2'" /dev/null </dev/null >"$tmp/out" 2>&1
    says "a terminal shows how far the file has been read" 'reading       ['
    script -qec "'$harmorph' check '$tmp/bad.mesh'" /dev/null </dev/null >"$tmp/out" 2>&1
    says "a terminal shows what is wrong with a file" 'the file is empty'
else
    skip "the bar on a terminal" "there is no program script (Debian's bsdutils)"
fi
check "no terminal: check" "$harmorph" check "$tmp/ring.su2"
check "no terminal: no bar" sh -c "! grep reading '$tmp/out'"
