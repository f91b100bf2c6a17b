# Tables that are read and written in pieces, by several threads. (A part of tests/program/formats.sh.)
check "numbers.cpp is compiled" $CXX -std=c++17 -O1 -Ic_api/cli -o "$tmp/numbers" tests/program/formats/numbers.cpp \
    c_api/cli/basics/numbers.cpp
check "numbers are written as printf and std::to_chars write them" "$tmp/numbers"
# A locale with a decimal comma, made for this test alone. In the Python package the caller chooses the locale.
if localedef -i de_DE -f UTF-8 "$tmp/de_DE.UTF-8" >/dev/null 2>&1; then
    check "numbers of all 617 exponents in a locale with a decimal comma" env LOCPATH="$tmp" "$tmp/numbers" de_DE.UTF-8
else
    skip "numbers in a locale with a decimal comma" "localedef cannot make one (Debian's locales)"
fi
awk -v n=200 -v m=150 -f tests/program/formats/large_mesh.awk >"$tmp/large.su2"
for ending in su2 msh vtk vtu; do
    "$harmorph" convert "$tmp/large.su2" "$tmp/one.$ending" >/dev/null
    check "large: .$ending by three threads" "$harmorph" convert "$tmp/large.su2" "$tmp/three.$ending" --threads 3
    check "large: .$ending by three threads has the same bytes" cmp "$tmp/one.$ending" "$tmp/three.$ending"
done
"$harmorph" convert "$tmp/one.msh" "$tmp/again.su2" >/dev/null
check "large: SU2 through Gmsh" cmp "$tmp/one.su2" "$tmp/again.su2"
# Rows that are not plain among rows that are: comments, empty lines, other notations, all in the same table.
awk '$1 == 9 && NR % 7000 == 0 { print "% a comment\n"; print " " $0 "  % another"; next }
     NF == 3 && $1 ~ /e/ && NR % 5001 == 0 { sub(/e/, "D"); print "\t" $0 "\r"; next }
     { print }' "$tmp/large.su2" >"$tmp/odd-rows.su2"
for threads in 1 3; do
    check "large: rows that are not plain, $threads" "$harmorph" convert "$tmp/odd-rows.su2" "$tmp/again.su2" \
        --threads $threads
    check "large: rows that are not plain are read alike, $threads" cmp "$tmp/one.su2" "$tmp/again.su2"
    for line in 3 20000 30002 30004 45000 60153; do
        sed "${line}s/[0-9]/x/" "$tmp/large.su2" >"$tmp/bad.su2"
        refuses "large: a wrong number in line $line, $threads" "bad.su2:$line: " "$harmorph" convert \
            "$tmp/bad.su2" "$tmp/x.su2" --threads $threads
    done
done
"$harmorph" fit "$tmp/large.su2" --marker body --points 8 -o "$tmp/large.curve" >/dev/null
check "large: solve" "$harmorph" solve "$tmp/large.su2" --curve "body=$tmp/large.curve" -o "$tmp/large.basis"
for threads in 1 3; do
    check "large: morph, $threads" "$harmorph" morph "$tmp/large.su2" "$tmp/large.basis" --move "$tmp/moves.txt" \
        -o "$tmp/moved-$threads.su2" --threads $threads
done
check "large: morph by three threads has the same bytes" cmp "$tmp/moved-1.su2" "$tmp/moved-3.su2"
"$harmorph" morph "$tmp/odd-rows.su2" "$tmp/large.basis" --move "$tmp/moves.txt" -o "$tmp/moved-odd.su2" >/dev/null
points_of "$tmp/moved-1.su2" >"$tmp/wanted"
points_of "$tmp/moved-odd.su2" | sed 's/[Dd]/e/g' >"$tmp/found"
check "large: morphs of both files are the same" cmp "$tmp/found" "$tmp/wanted"
