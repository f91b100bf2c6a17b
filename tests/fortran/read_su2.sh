#!/bin/sh
# usage: read_su2.sh BUILD   (FC, FFLAGS, CC, CFLAGS from the environment)
# The readers of SU2 files that are source for users, in Fortran and C: compiled without a warning, both find the same
# in the shipped meshes, and refuse in the same words what is wrong.
: "${FC:=gfortran}" "${FFLAGS:=-O2}" "${CC:=cc}" "${CFLAGS:=-O2}"
build=$(cd "${1:?usage: read_su2.sh BUILD}" && pwd)
dir=$build/read_su2
rm -rf "$dir"
mkdir -p "$dir"
topic="SU2 readers" log=$dir/log
. "$(dirname "$0")/../count.sh"
strict=-std=f2008
if $FC --version 2>/dev/null | grep -q '^GNU'; then
    strict="-std=f2008 -Wall -Wextra -Werror -fcheck=all,no-array-temps"
fi
both() {   # file: what both say is left in $dir/said
    "$dir/fortran" "$1" >"$dir/said" && "$dir/c" "$1" >"$dir/said_by_c" && diff "$dir/said" "$dir/said_by_c"
}
finds() {
    both "$1" && shift && { for words do grep -q "$words" "$dir/said" || { cat "$dir/said"; return 1; }; done; }
}
count() { sed -n "s/^$1= *\([0-9]*\).*/\1/p" "$2"; }

check "read_su2.f90 compiles" $FC $strict $FFLAGS -J"$dir" -c fortran/read_su2.f90 -o "$dir/read_su2.o"
check "its test compiles" $FC $strict $FFLAGS -I"$dir" -J"$dir" tests/fortran/read_su2.f90 "$dir/read_su2.o" \
    -o "$dir/fortran"
check "read_su2.c compiles" $CC -std=c99 -pedantic -Wall -Wextra -Werror $CFLAGS -Ic_api/examples \
    c_api/examples/read_su2.c tests/fortran/read_su2.c -o "$dir/c"
for mesh in "$build"/meshes/*.su2; do
    check "$mesh" finds $mesh "points $(count NPOIN $mesh) cells $(count NELEM $mesh) " \
        "faces $(sed -n 's/^MARKER_ELEMS= *//p' $mesh | awk '{ n += $1 } END { print n }')$"
    check "markers of $mesh" test "$(sed -n 's/^marker //p' "$dir/said")" = "$(sed -n 's/^MARKER_TAG= *//p' $mesh)"
done

# A square of two triangles and a quad beside it, with all that is left out.
cat >"$dir/mesh.su2" <<'END'
% a comment
NDIME= 2

NELEM= 3   % cells
5 0 1 4 0
5 0 4 3 1
9 1 2 5 4
NPOIN= 6 6
0 0 0
1.5 0 1
2 0 2
0 1 3
1 1e0 4
2 1.25 5
NMARK= 3
MARKER_TAG= airfoil
MARKER_ELEMS= 2
3 0 1
3 1 2 0
MARKER_TAG= SEND_RECEIVE
MARKER_ELEMS= 1
SEND_TO= 1
1 3 0
MARKER_TAG= far
MARKER_ELEMS= 4
3 2 5
3 5 4
3 4 3
3 3 0
FFD_NBOX= 0
END
check "a mesh with comments and halos" finds "$dir/mesh.su2" "points 6 cells 3 faces 6" "marker far" "airfoil is 1"
awk '{ printf "%s\r\n", $0 }' "$dir/mesh.su2" >"$dir/dos.su2"
check "ends of lines of other systems" finds "$dir/dos.su2" "points 6 cells 3 faces 6" "marker far"
refuses() {   # words, sed's command that spoils the mesh
    sed "$2" "$dir/mesh.su2" >"$dir/bad.su2"
    check "refused: $1" finds "$dir/bad.su2" "^refused: $1\$"
}
refuses "line 2: only two dimensions are read" 's/NDIME= 2/NDIME= 3/'
refuses "line 1: only files of one zone are read" '1s/.*/NZONE= 2/'
refuses "line 4: expected a number behind =" 's/NELEM= 3/NELEM= three/'
refuses "line 5: expected a triangle (5 and 3 points) or a quad (9 and 4 points)" '5s/.*/10 0 1 4 2/'
refuses "line 7: a cell has too few points" '7s/.*/9 1 2 5/'
refuses "line 11: expected the two coordinates of a point" '11s/.*/2/'
refuses "line 7: the file ends among the cells: 4 of 4" 's/NELEM= 3/NELEM= 4/; 8,$d'
refuses "line 12: the file ends among the points: 5 of 6" '13,$d'
refuses "line 18: the file ends among the faces of marker airfoil: 2 of 2" '19,$d'
refuses "line 16: the file ends among the markers" '17,$d'
refuses "line 17: expected MARKER_ELEMS= of marker airfoil" '17d'
refuses "line 18: expected a line (3 and 2 points) of marker airfoil" '18s/.*/5 0 1 2/'
refuses "line 18: a face has too few points" '18s/.*/3 0/'
refuses "the file has fewer markers than NMARK says" 's/NMARK= 3/NMARK= 4/'
refuses "the file has no points (NPOIN)" '8,14d'
refuses "the file has no cells (NELEM)" '4,7d'
refuses "a cell names a point that the file has not" '5s/.*/5 0 1 6/'
refuses "a face names a point that the file has not" '18s/.*/3 -1 1/'
nothing_there() {
    for program in fortran c; do "$dir/$program" "$dir/none.su2" | grep -q "^refused: " || return; done
}
check "a file that is not there" nothing_there

finish "$dir"
