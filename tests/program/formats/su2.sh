# SU2, and what is no mesh at all. (A part of tests/program/formats.sh.)
refuses "several zones: which" "zones.su2:1: the file has 3 zones; choose one with --zone" "$harmorph" \
    check "$tmp/zones.su2"
"$harmorph" check "$tmp/zones.su2" --zone 4 >"$tmp/out" 2>&1
says "several zones: one that does not exist" 'between 1 and 3'
sed 's/^IZONE= 3/IZONE= 4/' "$tmp/zones.su2" >"$tmp/bad.su2"
refuses "several zones: out of order" 'the file needs IZONE= 3' "$harmorph" check "$tmp/bad.su2" --zone 2
sed '/^IZONE= 3/,$d' "$tmp/zones.su2" >"$tmp/bad.su2"
refuses "several zones: one is missing" 'bad.su2:1: NZONE= announces 3 zones' "$harmorph" check "$tmp/bad.su2" --zone 2
sed 's/MARKER_TAG= far/MARKERTAG= far/' "$tmp/ring.su2" >"$tmp/bad.su2"
"$harmorph" check "$tmp/ring.su2" >"$tmp/wanted" 2>&1
"$harmorph" check "$tmp/bad.su2" >"$tmp/found" 2>&1
check "MARKERTAG" cmp "$tmp/found" "$tmp/wanted"
{ echo 'NDIME= 2'; cat "$tmp/zones.su2"; } >"$tmp/dimension.su2"
for zone in 1 2 3; do
    "$harmorph" check "$tmp/zones.su2" --zone $zone >"$tmp/wanted" 2>&1
    "$harmorph" check "$tmp/dimension.su2" --zone $zone >"$tmp/found" 2>&1
    check "NDIME= before NZONE=, and in zone $zone" cmp "$tmp/found" "$tmp/wanted"
done
sed '2,$ { /NDIME/d; }' "$tmp/dimension.su2" >"$tmp/dimension-once.su2"
check "NDIME= before NZONE= alone" "$harmorph" check "$tmp/dimension-once.su2" --zone 2
sed '/IZONE= 2/,$ s/NDIME= 2/NDIME= 2\nNDIME= 2/' "$tmp/dimension.su2" >"$tmp/bad.su2"
refuses "NDIME= twice in a zone" 'NDIME= appears here for the second time' "$harmorph" check "$tmp/bad.su2" --zone 2
# Without the markers of the outer edges, as files with halo layers are.
awk '/MARKER_TAG= far/ { print "MARKER_TAG= SEND_RECEIVE\nMARKER_ELEMS= 1\nSEND_RECV= 1\n1 0 1"; exit } { print }' \
    "$tmp/ring.su2" >"$tmp/halo.su2"
refuses "halo layers" 'the file has SEND_RECEIVE blocks' "$harmorph" solve "$tmp/halo.su2" --curve "body=$tmp/curve" \
    -o "$tmp/x"
"$harmorph" check "$tmp/odd.su2" >"$tmp/out" 2>&1
says "faces between cells are ignored, and said" "24 faces of marker 'inside line' between two cells"
echo 'hello world' >"$tmp/bad.mesh"
refuses "no mesh at all" "bad.mesh:1: no known mesh file begins with 'hello world'" "$harmorph" \
    check "$tmp/bad.mesh"
: >"$tmp/bad.mesh"
refuses "an empty file" 'the file is empty' "$harmorph" check "$tmp/bad.mesh"
mkdir "$tmp/no-mesh"
refuses "a folder without a mesh" 'the folder has no mesh of OpenFOAM: neither constant/polyMesh/points' "$harmorph" \
    check "$tmp/no-mesh"
"$harmorph" check "$tmp/ring.su2" --format cgnz >"$tmp/out" 2>&1
says "an unknown format" "the format 'cgnz' is unknown"
# The program tells how far a file has been read only at a terminal.
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
