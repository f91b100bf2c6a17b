# Free-form deformation of the same mesh, which the paper compares in words. Part of run.sh.
echo "== Free-form deformation (FFD) and harmonic functions, for the same movement of the wall"
echo "A box of Bernstein polynomials, half a chord larger than the airfoil on all sides, moves the mesh points inside;"
echo "its outermost nodes stay. The other nodes are fitted to the movement of the wall by least squares, with the"
echo "smallest penalty on their own movement, 1e-10 to 1e-2, that leaves the mesh valid. Lengths are in parts of the"
echo "largest movement of the wall."
echo
mesh=$meshes/diffuser_airfoil.su2
for operator in laplace conformal; do
    run solve "$mesh" $airfoil --operator $operator -o "$out/ffd-$operator.basis"
done
sh tests/measure/python.sh "$BUILD" "$here/ffd.py" "$out" "$mesh:airfoil" "$out/ffd-laplace.basis" \
    "$out/ffd-conformal.basis" || fail "the comparison with FFD"
