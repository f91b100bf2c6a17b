# Mesh files: as other programs write them; with something wrong, which is exit code 3, by file and line; and those
# that are shipped.

# The ring is written as other programs write it: carriage returns, points first, odd blanks, and things that are passed
# over.
{
    echo 'NZONE= 1'
    echo 'NDIME=2 % two'
    sed -n '/^NPOIN/,/^NMARK/p' "$ring" | sed '$d; s/^NPOIN= \(.*\)/NPOIN = \1 \1/'
    sed -n '/^NELEM/,/^NPOIN/p' "$ring" | sed '$d; s/^\(9 .*\) [0-9]*$/ \1/'
    echo 'NMARK= 4'
    sed -n '/^MARKER_TAG= body/,/^MARKER_TAG= far/p' "$ring" | sed '$d; s/body/the body/; s/^3 /3	/'
    printf 'MARKER_TAG= 17\nMARKER_ELEMS= 49\n1 3\n'
    sed -n '/^MARKER_TAG= far/,$p' "$ring" | sed '1,2d'
    printf 'MARKER_TAG= SEND_RECEIVE\nMARKER_ELEMS= 1\nSEND_RECV= 1\n1 0 1\n'
    printf 'MARKER_TAG= SEND_RECEIVE\nMARKER_ELEMS= 1\nSEND_RECV= -1\n1 0 1\n'
    printf 'FFD_NBOX= 1\nFFD_CORNER_POINTS= 2\n0 0\n1 1\n\n'
} | awk '{ printf "%s\r\n", $0 }' >"$tmp/odd.su2"

# A format without markers loses them, and the program says so.
runs "convert to VTK" 0 convert "$tmp/odd.su2" "$tmp/odd.vtu"
check "convert to VTK: says what is not in the file" says 'without the 2 markers'
runs "convert to Gmsh" 0 convert "$tmp/odd.su2" "$tmp/odd.msh"
check "convert to Gmsh: the markers are in the file" says ', 2 markers'

broken() { sed "$2" "$ring" >"$tmp/$1.su2"; } # broken NAME SED-SCRIPT: a mesh with one thing wrong

# SU2 as other programs write it.
runs "odd file: check" 0 check "$tmp/odd.su2" --json
check "odd file: markers" says '[{"name": "17", "faces": 48}, {"name": "the body", "faces": 48}]'
check "odd file: says that FFD boxes stay" says 'FFD'
check "odd file: says that periodic blocks are ignored" says 'SEND_RECEIVE'
runs "odd file: fit" 0 fit "$tmp/odd.su2" --marker 'the body' --points 12 -o "$tmp/odd.curve"
runs "odd file: solve" 0 solve "$tmp/odd.su2" --curve "the body=$tmp/odd.curve" -o "$tmp/odd.basis"
runs "odd file: zero move" 0 morph "$tmp/odd.su2" "$tmp/odd.basis" --move "$no_moves" -o "$tmp/same.su2"
check "odd file: zero move gives the identical file" cmp "$tmp/odd.su2" "$tmp/same.su2"

# Bad mesh files: exit code 3, file and line.
bad_mesh() { # bad_mesh NAME LINE TEXT SED-SCRIPT
    broken bad "$4"
    refuses "$1" 3 "$tmp/bad.su2:$2: " check "$tmp/bad.su2"
    check "$1: says '$3'" says "$3"
}
points=628 # the line of NPOIN= in the ring's file
refuses "no such mesh" 3 'nowhere.su2' check "$tmp/nowhere.su2"
refuses "a folder for a mesh" 3 "$tmp" check "$tmp"
bad_mesh "three dimensions" 2 'NDIME= 2' 's/NDIME= 2/NDIME= 3/'
bad_mesh "several zones" 2 'zone' '2i\
NZONE= 2'
refuses "a zone of a file without zones" 2 '--zone 2: the file has one zone only' check "$ring" --zone 2
runs "the first zone of a file without zones" 0 check "$ring" --zone 1
bad_mesh "element of another type" 4 'element type' '4s/^9/12/'
bad_mesh "element with too few points" 4 '4 points' '4s/.*/9 0 1 2/'
bad_mesh "index out of range" 4 'between 0 and 623' '4s/ 48 / 4800 /'
bad_mesh "negative index" 4 'between 0 and 623' '4s/ 48 / -48 /'
bad_mesh "word for an index" 4 "'x'" '4s/ 48 / x /'
bad_mesh "word for a coordinate" $((points + 3)) "'1.O'" "$((points + 3))s/^[^	]*/1.O/"
bad_mesh "infinite coordinate" $((points + 3)) "'inf'" "$((points + 3))s/^[^	]*/inf/"
bad_mesh "fewer elements than said" $points 'element 625 of 625' 's/NELEM= 624/NELEM= 625/'
bad_mesh "more elements than said" 627 'heading' 's/NELEM= 624/NELEM= 623/'
bad_mesh "count that is none" $points 'a count' 's/NPOIN= .*/NPOIN= many/'
bad_mesh "truncated in the points" 700 'point 72 of 624' '700,$d'
bad_mesh "truncated in the markers" 1304 'NMARK' '/MARKER_TAG= far/,$d'
bad_mesh "triangle in a marker" 1256 'element type 3' '1256s/.*/5 0 1 2/'
bad_mesh "two points in one cell" 4 '' '4s/.*/9 0 0 49 1/'
broken bad '/MARKER_TAG= far/,/MARKER_ELEMS/d; s/MARKER_ELEMS= 48/MARKER_ELEMS= 47/; s/NMARK= 2/NMARK= 1/; 1255d'
refuses "boundary edge on no marker" 3 "$tmp/bad.su2" check "$tmp/bad.su2"
# Far from the origin, cells are too thin for their coordinates: solve and check say the same.
awk 'NF == 3 && index($0, ".") { $1 = sprintf("%.6f", $1 + 1e13); $2 = sprintf("%.6f", $2 + 1e13) }
    { print }' "$ring" >"$tmp/afar.su2"
refuses "cells too thin for their coordinates: solve" 3 "which its coordinates do not resolve" \
    solve "$tmp/afar.su2" --rigid body -o "$tmp/x"
sed 's/.*afar.su2/afar.su2/' "$tmp/err" >"$tmp/wanted"
refuses "cells too thin for their coordinates: check" 3 "$tmp/afar.su2:" check "$tmp/afar.su2"
sed 's/.*afar.su2/afar.su2/' "$tmp/err" >"$tmp/found"
check "cells too thin for their coordinates: the same sentence" cmp "$tmp/wanted" "$tmp/found"
head -c 3000 "$harmorph" >"$tmp/bad.su2"
refuses "a program for a mesh" 3 "$tmp/bad.su2:1: " check "$tmp/bad.su2"

# The shipped meshes of the paper's cases lie on their curves, to the digits of the files.
on_curve() { # on_curve MESH SOLVE-OPTIONS...
    mesh=$1; shift
    runs "$mesh: solve" 0 solve "$meshes/$mesh.su2" "$@" --operator laplace -o "$tmp/paper.basis"
    check "$mesh: on its curve" grep -E 'mesh from curve +[0-9.]+e-(09|1[0-9]) at most' "$tmp/out"
}
on_curve two_bodies --curve left="$meshes/two_bodies_left.curve" --curve right="$meshes/two_bodies_right.curve"
on_curve diffuser_airfoil --curve airfoil="$meshes/diffuser_airfoil.curve"
on_curve axisymmetric_diffuser --curve diffuser="$meshes/axisymmetric_diffuser.curve" --slip axis
on_curve cage --curve cage="$meshes/cage.curve"
