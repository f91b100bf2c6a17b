# Convergence histories of the iterations of the paper, against cycles and against work. Part of run.sh.
echo "== How the residual falls, cycle by cycle"
echo "The residual is the largest relative one of all functions (compact scheme). The work of a cycle is the same for"
echo "all cycles of an iteration; the start from the coarsest level (FMG) is work before the first cycle."
histories() {   # LETTER TITLE MESH CONDITIONS
    sh tests/measure/python.sh "$BUILD" "$here/histories.py" "$harmorph" "$out" "$1" "$2" "$meshes/$3.su2" $4 ||
        fail "histories of $2"
}
histories L "case 1" two_bodies "$two_bodies"
histories M "case 2" diffuser_airfoil "$airfoil"
histories N "the diffuser" axisymmetric_diffuser "$diffuser"
rm -f "$out"/history.*
