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
objects=$(cat "$BUILD/objects/program.list")
if ${CXX:-c++} -std=c++17 -Wall -Wextra -Wconversion -Wshadow ${CXXFLAGS:--O3} -pthread -Iinclude -Ic_api/cli \
    -o "$out/ffd" "$here/ffd.cpp" $objects "$BUILD/libharmorph.a" $LDFLAGS; then
    "$out/ffd" "$out" "$mesh" "$out/ffd-laplace.basis" "$out/ffd-conformal.basis" || fail "the comparison with FFD"
else
    fail "ffd.cpp does not compile"
fi
rm -f "$out/ffd"
