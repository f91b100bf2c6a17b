# Meshes one cell thick with elements of second order: they are read and morphed, and their nodes move by the law that
# second_order.py states. (A part of tests/program/formats.sh.)
order2() { "${PYTHON:-/usr/bin/python3}" tests/program/formats/second_order.py "$@"; }
# moves_by_law WHAT PACKAGE KIND MESH BODY
moves_by_law() {
    what=$1 package=$2 kind=$3 before=$4
    morphs "$what" "$before" "$5"
    check "$what: nodes move by the law" order2 law $package $kind "$before" "$moved"
}
if order2 text 25 "$tmp/order2.vtk" 2>/dev/null; then
    for type in 25 26; do
        check "VTK's type $type: is written" order2 text $type "$tmp/order2.vtk"
        moves_by_law "VTK's type $type" text planes "$tmp/order2.vtk" boundary1
    done
else skip "second order one cell thick" "python3 is not installed"; fi
if /usr/bin/python3 -c 'import vtk' 2>/dev/null; then
    for type in 25 26 29 32; do
        for ending in vtk vtu; do
            check "VTK writes type $type, $ending" order2 vtk $type "$tmp/order2.$ending"
            moves_by_law "VTK's own type $type, $ending" vtk planes "$tmp/order2.$ending" boundary1
        done
    done
else skip "files of second order by VTK" "python3-vtk9 is not installed"; fi
if /usr/bin/python3 -c 'import gmsh' 2>/dev/null; then
    for how in "prisms complete planes" "hexahedra incomplete planes" "hexahedra complete wedge"; do
        set -- $how
        for version in 2.2 4.1; do
            for binary in 0 1; do
                check "gmsh writes $how, $version, $binary" order2 gmsh $version $binary $how "$tmp/order2.msh"
                moves_by_law "gmsh's $how, $version, $binary" gmsh $3 "$tmp/order2.msh" body
            done
        done
    done
else skip "files of second order by gmsh" "python3-gmsh is not installed"; fi
