# Why plain averages of nodal gradients fail: spectra of the paper's schemes. Part of run.sh.
echo "== Why plain averages fail: the spectra of the schemes"
echo "The paper's text takes the flux through a dual face from the mean of the gradients at both ends of an edge (equation 10)."
echo "On squares that mean does not see waves which alternate from point to point: their eigenvalue is 0, so no iteration"
echo "removes them, and coarser levels cannot carry them. On case 2 the modes that alternate most have the least eigenvalues,"
echo "some below 0: explicit steps diverge. With the difference of the two values in place of the component along the edge the"
echo "order is right: the more a mode alternates, the larger is its eigenvalue. Gradients over edge-dual volumes (the cells on"
echo "both sides of an edge; figure 7 of the paper shows volumes of this kind) see all waves on triangles, but not the"
echo "checkerboard on squares. So the paper's functions can have come from corrected averages or from edge-dual volumes; they"
echo "cannot have come from plain averages on case 2. The pictures here are made with the compact scheme. Eigenvalues are those of"
echo "the matrix with each row divided by the compact scheme's diagonal; steps are those of Runge-Kutta on one grid to 1e-10, as"
echo "they follow from the spectrum."
if echo '#include <eigen3/Eigen/Eigenvalues>' | ${CXX:-c++} -x c++ -E - >/dev/null 2>&1; then
    { ${CC:-cc} -O2 -Ic_api/examples -c -o "$out/read_su2.o" c_api/examples/read_su2.c &&
        ${CXX:-c++} -std=c++17 -O2 -Ic_api/examples -o "$out/schemes" tests/paper/schemes.cpp "$out/read_su2.o"; } ||
        fail "compiling tests/paper/schemes.cpp"
    "$out/schemes" "$out" "Case 2, the airfoil of the diffuser=$meshes/diffuser_airfoil.su2" || fail "spectra of the schemes"
    echo
    figure spectrum.svg "Eigenvalues and modes of the four schemes on case 2 | Each point is a mode of the second case: across, its" \
        "eigenvalue; up, how much it alternates from point to point. Plain averages turn the order round, and five modes that" \
        "alternate grow (orange)."
    rm -f "$out/read_su2.o" "$out/schemes"
else
    echo "Skipped: Eigen is not installed (libeigen3-dev)."
fi
