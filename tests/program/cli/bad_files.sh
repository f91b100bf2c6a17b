# Files of curves, movements and functions with something wrong: exit code 3, and the line.

bad_curve() { # bad_curve NAME LINE TEXT CONTENT
    printf "$4" >"$tmp/bad.curve"
    refuses "$1" 3 "$tmp/bad.curve:$2: " solve "$ring" --curve body="$tmp/bad.curve" -o "$tmp/x"
    check "$1: says '$3'" says "$3"
}
square='points 4\n1 1\n-1 1\n-1 -1\n1 -1\n' # lines 3 to 7
bad_curve "curve: unknown word" 1 'degree' 'grade 3\n'
bad_curve "curve: degree 9" 1 'between 1 and 5' 'degree 9\n'
bad_curve "curve: closed maybe" 2 'periodic' 'degree 1\nclosed maybe\n'
bad_curve "curve: a point of one number" 5 'point 2 of 4' 'degree 1\nclosed tied\npoints 4\n1 1\n2\n'
bad_curve "curve: not a number" 4 "'nan'" 'degree 1\nclosed tied\npoints 4\n1 nan\n2 2\n'
bad_curve "curve: too few knots" 8 'the curve needs 7 knots' "degree 1\nclosed tied\n${square}knots 6\n0 0 1 2 3 4\n"
bad_curve "curve: file ends in the knots" 10 'knot 5 of 7' "degree 1\nclosed tied\n${square}knots 7\n0 0 1 2\n"
line='knots 4\n0 0 1 1\n'
bad_curve "curve: index out of range" 8 'between 1 and 4' "degree 1\nclosed open\n${square}indices 2\n1 5\n$line"
bad_curve "curve: indices that do not close" 8 'closed tied' "degree 1\nclosed tied\n${square}indices 2\n1 2\n$line"
printf "degree 1\nclosed tied\n${square}knots 7\n0 0 1 3 2 4 4\n" >"$tmp/bad.curve"
refuses "curve: decreasing knots" 3 "$tmp/bad.curve" solve "$ring" --curve body="$tmp/bad.curve" -o "$tmp/x"
check "curve: decreasing knots: counted from 1" says 'knot 5 of curve 1 is smaller than the knot before it'

bad_moves() { # bad_moves NAME LINE CONTENT
    printf "$3" >"$tmp/bad.txt"
    refuses "$1" 3 "$tmp/bad.txt:$2: " morph "$ring" "$basis" --move "$tmp/bad.txt" -o "$tmp/x"
}
bad_moves "moves: two numbers" 2 '# index dx dy\n1 2\n'
bad_moves "moves: control point 0" 1 '0 1 1\n'
bad_moves "moves: control point 13 of 12" 1 '13 1 1\n'
bad_moves "moves: not a number" 2 '1 0 0\n2 nan 0\n'
bad_moves "moves: a point twice" 2 '1 0 0\n1 1 0\n'

bad_basis() { refuses "$1" 3 "$tmp/bad.basis" morph "$ring" "$tmp/bad.basis" --move "$no_moves" -o "$tmp/x"; }
head -c 1000 "$basis" >"$tmp/bad.basis";                          bad_basis "basis: truncated"
: >"$tmp/bad.basis";                                              bad_basis "basis: empty"
cp "$ring" "$tmp/bad.basis";                                      bad_basis "basis: another kind of file"
{ head -c 9000 "$basis"; echo oops; tail -c +9006 "$basis"; } >"$tmp/bad.basis";  bad_basis "basis: damaged"
refuses "basis: in the place of the mesh" 3 "$basis: the file is a basis" morph "$basis" "$ring" --move "$no_moves"
refuses "basis: in the place of the curve" 3 "$basis: the file is a basis" solve "$ring" \
    --curve body="$basis" -o "$tmp/x"
refuses "basis: of another mesh" 3 "$basis" morph "$meshes/naca0012.su2" "$basis" --move "$no_moves"

# Meshes without points or cells, in all formats that have counts: each command refuses the file by its name.
head='# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\n'
no_mesh() { # no_mesh FILE CONTENT
    file=$tmp/empty-$1
    printf "$2" >"$file"
    refuses "no mesh: $1: check" 3 "$file" check "$file"
    refuses "no mesh: $1: fit" 3 "$file" fit "$file" --marker body -o "$tmp/x"
    refuses "no mesh: $1: convert" 3 "$file" convert "$file" "$tmp/x.su2"
    refuses "no mesh: $1: displace" 3 "$file" displace "$file" --given body --wall "$no_moves" -o "$tmp/x"
    for rows in '' '0,0,0,1\n' '0,0,0,1\n1,1,0,2\n'; do
        printf "point,x,y,f\n$rows" >"$tmp/empty.csv"
        refuses "no mesh: $1: fields" 3 "$file" interpolate "$file" "$tmp/empty.csv" "$ring" -o "$tmp/x"
    done
    refuses "no mesh: $1: as another mesh" 3 "$file" align "$ring" --to "$file" --marker body -o "$tmp/x"
}
no_mesh none.su2 'NDIME= 2\nNELEM= 0\nNPOIN= 0\nNMARK= 0\n'
no_mesh points.su2 'NDIME= 2\nNELEM= 0\nNPOIN= 3\n0 0\n1 0\n0 1\nNMARK= 1\nMARKER_TAG= body\nMARKER_ELEMS= 0\n'
no_mesh none.msh '$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n0\n$EndNodes\n$Elements\n0\n$EndElements\n'
no_mesh fluent.msh '(2 2)\n(10 (0 1 0 0 2))\n(13 (0 1 0 0))\n'
no_mesh faces.msh '(2 2)\n(10 (1 1 2 1 2)(0 0 1 0))\n(13 (3 1 1 3 2)(1 2 0 0))\n'
no_mesh none.vtk "${head}POINTS 0 double\n\nCELLS 0 0\nCELL_TYPES 0\n"
no_mesh points.vtk "${head}POINTS 1 double\n0 0 0\nCELLS 0 0\nCELL_TYPES 0\n"
no_mesh none.vtu '<VTKFile type="UnstructuredGrid"><Piece NumberOfPoints="0" NumberOfCells="0"/></VTKFile>'
no_mesh none.ugrid '0 0 0 0 0 0 0\n'
no_mesh none.p3d '1\n0 0\n'
