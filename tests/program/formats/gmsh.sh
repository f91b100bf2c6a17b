# Gmsh: bad files, and the files of gmsh itself. (A part of tests/program/formats.sh.)
sed 's/^2.2 /2.9 /' "$tmp/text-2.msh" >"$tmp/bad.msh"
refuses "gmsh: another version" 'bad.msh:2: the file needs version 2.2 or 4.1' "$harmorph" check "$tmp/bad.msh"
sed 's/^\([0-9]* 1 2\) 2 7/\1 -9223372036854775808 7/' "$tmp/text-2.msh" >"$tmp/bad.msh"
refuses "gmsh: a physical group that is too large" 'the file needs a physical group between -2147483647 and' \
    "$harmorph" check "$tmp/bad.msh"
sed '50s/ 0$/ 1/' "$tmp/text-2.msh" >"$tmp/bad.msh"
refuses "gmsh: three dimensions" 'bad.msh:50: the points must lie in a plane x, y or z = constant' \
    "$harmorph" check "$tmp/bad.msh"
sed 's/^100 3 2 3 7 \(.*\)/100 5 2 3 7 \1 \1/' "$tmp/text-2.msh" >"$tmp/bad.msh"
refuses "gmsh: hexahedra" 'bad.msh:282: the mesh has three dimensions and is not one cell thick' \
    "$harmorph" check "$tmp/bad.msh"
sed '/^\$EndNodes/,$d' "$tmp/text-4.msh" >"$tmp/bad.msh"
refuses "gmsh: cut off" 'but the end of the file follows' "$harmorph" check "$tmp/bad.msh"
sed '/^[0-9]* 1 2 2 7/d; s/^192$/168/' "$tmp/text-2.msh" >"$tmp/open.msh"
check "gmsh: boundary without lines" "$harmorph" check "$tmp/open.msh" --json
says "gmsh: boundary without lines: gets a name" '"boundary1", "faces": 24'

# A group whose name is empty is called by its number, and what convert writes can be read.
for name in body far; do
    sed "s/\"$name\"/\"\"/" "$tmp/text-2.msh" >"$tmp/nameless.msh"
    number=$(sed -n "s/^1 \([0-9]*\) \"$name\".*/\1/p" "$tmp/text-2.msh")
    check "gmsh: $name without a name" "$harmorph" check "$tmp/nameless.msh" --json
    says "gmsh: $name without a name: the number" "\"name\": \"$number\""
    for ending in su2 msh; do
        check "gmsh: $name without a name: convert to $ending" "$harmorph" convert "$tmp/nameless.msh" \
            "$tmp/named.$ending"
        check "gmsh: $name without a name: $ending is read" "$harmorph" check "$tmp/named.$ending" --json
        says "gmsh: $name without a name: $ending: the number" "\"name\": \"$number\""
    done
done

if command -v gmsh >/dev/null 2>&1; then
    cat >"$tmp/two.geo" <<'END'
Point(1) = {0, 0, 0, .3}; Point(2) = {1, 0, 0, .3}; Point(3) = {-1, 0, 0, .3};
Circle(1) = {2, 1, 3}; Circle(2) = {3, 1, 2};
Point(4) = {-4, -4, 0, 2}; Point(5) = {4, -4, 0, 2}; Point(6) = {4, 4, 0, 2}; Point(7) = {-4, 4, 0, 2};
Line(3) = {4, 5}; Line(4) = {5, 6}; Line(5) = {6, 7}; Line(6) = {7, 4};
Curve Loop(1) = {3, 4, 5, 6}; Curve Loop(2) = {1, 2}; Plane Surface(1) = {1, 2};
Physical Curve("body") = {1, 2}; Physical Curve("far") = {3, 4, 5, 6}; Physical Surface("air") = {1};
END
    for variant in "msh22 0 1" "msh22 1 2" "msh41 0 2" "msh41 1 1"; do
        set -- $variant
        mesh=$tmp/gmsh-$1-$2-$3.msh
        check "gmsh: writes $variant" gmsh -2 "$tmp/two.geo" -format $1 -setnumber Mesh.Binary $2 -order $3 -o "$mesh"
        morphs "gmsh $variant" "$mesh" body
        gmsh -check "$moved" >"$tmp/gmsh" 2>&1
        check "gmsh $variant: gmsh finds nothing wrong" sh -c "! grep -E 'Error|Warning' '$tmp/gmsh'"
    done
    # PLOT3D, of which gmsh reads text: all points of the morphed file, where the file has them.
    mesh=$tmp/text-k.p3d
    morphs "gmsh plot3d" "$mesh" 1:jmin
    check "gmsh plot3d: is read" gmsh -0 -v 2 "$moved" -save -format msh22 -o "$tmp/of-gmsh.msh"
    check "gmsh plot3d: no error" sh -c "! grep -E 'Error|Warning' '$tmp/out'"
    sed '1,/^\$Nodes/d; /^\$EndNodes/,$d' "$tmp/of-gmsh.msh" | awk 'NF == 4 { print $2, $3, $4 }' | sort >"$tmp/a"
    awk '{ for (k = 1; k <= NF; k++) word[n++] = $k }
        END {
            for (k = 0; k < 350; k++) print word[4 + k] + 0, word[354 + k] + 0, word[704 + k] + 0
        }' "$moved" | sort >"$tmp/b"
    check "gmsh plot3d: 350 points" sh -c "test \$(wc -l <'$tmp/a') -eq 350"
    awk '{ x += $1; y += $2; z += $3 } END { print x, y, z }' "$tmp/a" >"$tmp/sum-a"
    awk '{ x += $1; y += $2; z += $3 } END { print x, y, z }' "$tmp/b" >"$tmp/sum-b"
    check "gmsh plot3d: the same places" alike 1e-3 "$tmp/sum-a" "$tmp/sum-b"
    check "gmsh: convert" "$harmorph" convert "$tmp/ring.su2" "$tmp/ring.msh"
    check "gmsh: reads what convert writes" gmsh -check "$tmp/ring.msh"
    check "gmsh: writes SU2 of it" gmsh -2 "$tmp/ring.msh" -save -o "$tmp/again.su2"
    check "gmsh: its SU2 file" "$harmorph" check "$tmp/again.su2" --json
    says "gmsh: its SU2 file: the same cells" '"points": 168, "cells": 144'
    says "gmsh: its SU2 file: the same markers" '"body", "faces": 24}, {"name": "far", "faces": 24'
else
    echo "gmsh is not installed: its own files are not tested (Debian's gmsh)"
fi
# A row of a table at a node that is no corner.
mesh=$tmp/quadratic.msh
body=$(body_of "$mesh")
check "gmsh: second order: fit" "$harmorph" fit "$mesh" --marker "$body" --points 8 -o "$tmp/curve"
check "gmsh: second order: solve" "$harmorph" solve "$mesh" --curve "$body=$tmp/curve" -o "$tmp/basis"
last=$(($(sed -n '/^\$Nodes/{n;p;}' "$mesh") - 1))
echo "$last 1 0" >"$tmp/middle.txt"
refuses "gmsh: second order: a value at the middle of an edge" "point $last of the mesh file is no corner of a cell" \
    "$harmorph" adjoint "$mesh" "$tmp/basis" --sensitivity "$tmp/middle.txt" -o "$tmp/gradient.txt"
refuses "gmsh: second order: a displacement at the middle of an edge" \
    "point $last of the mesh file is no corner of a cell" \
    "$harmorph" displace "$mesh" --given "$body" --wall "$tmp/middle.txt" -o "$tmp/displaced.msh"
