# Why plain averages of nodal gradients fail: spectra of the paper's schemes. Part of run.sh.
echo "== Why plain averages fail: the spectra of the schemes"
echo "The paper's text takes the flux through a dual face from the mean of the gradients at both ends of an edge"
echo "(equation 10). On squares that mean does not see waves which alternate from point to point: their eigenvalue is"
echo "0, so no iteration removes them, and coarser levels cannot carry them. On case 2 the modes that alternate most"
echo "have the least eigenvalues, some below 0: explicit steps diverge. With the difference of the two values in place"
echo "of the component along the edge the order is right: the more a mode alternates, the larger is its eigenvalue."
echo "Gradients over edge-dual volumes (the cells on both sides of an edge; figure 7 of the paper shows volumes of this"
echo "kind) see all waves on triangles, but not the checkerboard on squares. So the paper's functions can have come"
echo "from corrected averages or from edge-dual volumes; they cannot have come from plain averages on case 2. The"
echo "pictures here are made with the compact scheme. Eigenvalues are those of the matrix with each row divided by the"
echo "compact scheme's diagonal; steps are those of Runge-Kutta on one grid to 1e-10, as they follow from the spectrum."
if echo '#include <eigen3/Eigen/Eigenvalues>' | ${CXX:-c++} -x c++ -E - >/dev/null 2>&1; then
    { ${CC:-cc} -O2 -Ic_api/examples -c -o "$out/read_su2.o" c_api/examples/read_su2.c &&
        ${CXX:-c++} -std=c++17 -O2 -Ic_api/examples -o "$out/schemes" tests/measure/paper/schemes.cpp \
            "$out/read_su2.o"; } ||
        fail "compiling tests/measure/paper/schemes.cpp"
    "$out/schemes" "$out" "Case 2, the airfoil of the diffuser=$meshes/diffuser_airfoil.su2" ||
        fail "spectra of the schemes"
    echo
    figure spectrum.svg "Eigenvalues and modes of the four schemes on case 2 | Each point is a mode of the second" \
        "case: across, its eigenvalue; up, how much it alternates from point to point. Plain averages turn the order" \
        "round, and five modes that alternate grow (orange)."
    rm -f "$out/read_su2.o" "$out/schemes"
else
    echo "Skipped: Eigen is not installed (libeigen3-dev)."
fi
