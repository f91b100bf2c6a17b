# Spectra of the schemes that the text of the paper may mean. Part of run.sh.
echo "== The spectra of the schemes: which waves an iteration cannot remove"
# triangles_of MESH: the SU2 file with each quadrilateral divided along the diagonal from its first corner
triangles_of() {
    awk '/^NELEM=/ { elements = 1; cells = 0; next }
        elements && $1 == 9 { cell[cells++] = $2 " " $3 " " $4; cell[cells++] = $2 " " $4 " " $5; next }
        elements && $1 == 5 { cell[cells++] = $2 " " $3 " " $4; next }
        elements { print_cells() }
        { print }
        function print_cells(   k) {
            print "NELEM= " cells
            for (k = 0; k < cells; ++k) print 5, cell[k], k
            elements = 0
        }
        END { if (elements) print_cells() }' "$1"
}
triangles_of "$meshes/diffuser_airfoil.su2" >"$out/airfoil-triangles.su2"
echo "The text of the paper takes the flux through a dual face from the mean of the gradients at both ends of an"
echo "edge (equation 10): plain averages. On squares this mean does not see waves that alternate from point to"
echo "point: their eigenvalue is 0, so no iteration removes these waves, and coarser levels cannot represent them."
echo "On the mesh of case 2 that has quadrilaterals at the airfoil, some of the modes that alternate most have"
echo "eigenvalues below 0: explicit steps diverge. On the same points with triangles only, and on the mesh of the"
echo "diffuser, which has triangles only, no eigenvalue is below 0, and the scheme converges. If the difference of"
echo "the two values replaces the component of the gradient along the edge (corrected averages), eigenvalues grow"
echo "with the alternation of their modes. Gradients over edge-dual volumes (the cells on both sides of an edge)"
echo "see all waves on triangles, but not the checkerboard on squares. Eigenvalues are those of the matrix with"
echo "each row divided by the diagonal of the compact scheme; the table gives the steps of Runge-Kutta on one grid"
echo "to 1e-10 that follow from the spectrum."
sh tests/measure/python.sh "$BUILD" "$here/schemes.py" "$out" \
    "The diffuser, triangles=$meshes/axisymmetric_diffuser.su2" \
    "Case 2, triangles only=$out/airfoil-triangles.su2" \
    "Case 2, quadrilaterals at the airfoil=$meshes/diffuser_airfoil.su2" || fail "spectra of the schemes"
echo
figure spectrum.svg "Figure K | Eigenvalues and modes of the four schemes on the mesh of case 2 with" \
    "quadrilaterals at the airfoil. Each point is a mode. The horizontal axis is the eigenvalue of the mode," \
    "the vertical axis how much the mode alternates from point to point. Plain averages reverse the order, and" \
    "the modes with negative eigenvalues, which are orange, grow."
