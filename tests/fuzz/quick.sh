#!/bin/sh
# usage: quick.sh BUILD   after `make fuzzer`
# What was found once (corpus/), and a few thousand random cases of each target, always the
# same; `make fuzz` runs for as long as one likes.
build=$1
failed=0
for cases in tests/fuzz/corpus/*; do
    "$build/fuzzer" "$(basename "$cases")" "$cases"/* || failed=1
done
for run in "problem 6000" "polygons 2000" "basis 3000" "sequence 2000" "files 4000" "shape 1500" "given 2000" \
    "parts 1000" "plane 2000" "transfer 1000" "commands 1500" "model 1500" "fields 1500" \
    "quality 2000" "sections 400" "tables 6000"; do
    "$build/fuzzer" $run 1 || failed=1
done
exit $failed
