# Operators and their options.

for operator in laplace weighted conformal; do
    runs "solve --operator $operator" 0 solve "$box" $on_block --operator $operator -o "$tmp/$operator.basis"
done
runs "solve: conformal is the default" 0 solve "$box" $on_block -o "$tmp/default.basis"
check "solve: conformal is the default: equal files" cmp "$tmp/conformal.basis" "$tmp/default.basis"
runs "solve: 1.5 is its exponent" 0 solve "$box" $on_block --exponent 1.5 -o "$tmp/default.basis"
check "solve: 1.5 is its exponent: equal files" cmp "$tmp/conformal.basis" "$tmp/default.basis"
runs "solve --exponent 0" 0 solve "$box" $on_block --exponent 0 -o "$tmp/flat.basis"
check "solve --exponent 0: other functions" sh -c "! cmp -s '$tmp/conformal.basis' '$tmp/flat.basis'"
refuses "--operator unknown" 2 "'biharmonic'" solve "$box" $on_block --operator biharmonic -o "$tmp/x"
for exponent in -1 4.25 1.3 x '' nan inf 1e300; do
    refuses "--exponent '$exponent'" 2 '--exponent' solve "$box" $on_block --exponent "$exponent" -o "$tmp/x"
done
refuses "--exponent with laplace" 2 'weight' solve "$box" $on_block --operator laplace --exponent 1 -o "$tmp/x"
refuses "--offset-correction with laplace" 2 'offset' solve "$box" $on_block --operator laplace --offset-correction \
    -o "$tmp/x"
refuses "--free with conformal" 2 'slip' solve "$box" $on_block --free out -o "$tmp/x"
runs "--offset-correction" 0 solve "$box" $on_block --offset-correction -o "$tmp/offset.basis"

for operator in laplace weighted conformal flat offset; do
    runs "morph by a basis: $operator" 0 morph "$box" "$tmp/$operator.basis" --move "$no_moves" -o "$tmp/same.su2"
    check "morph by a basis: $operator: zero move, identical file" cmp "$box" "$tmp/same.su2"
done
runs "export of a real function" 0 export "$box" "$tmp/laplace.basis" --function 4 --csv "$tmp/f.csv" --svg "$tmp/f.svg"
check "export of a real function: columns" test "$(head -1 "$tmp/f.csv")" = point,x,y,value
refuses "export: a number that a real value does not have" 2 '--number' export "$box" "$tmp/laplace.basis" \
    --function 4 --number 2 --csv "$tmp/f.csv"
