#!/bin/sh
# usage: quick.sh BUILD   after `make fuzzer`
# What was found once (corpus/), and a few thousand random cases of each target, always the
# same; `make fuzz` runs for as long as one likes.
build=$1
failed=0
for cases in tests/fuzz/corpus/*; do
    "$build/fuzzer" "$(basename "$cases")" "$cases"/* || failed=1
done
for run in "problem 3000" "polygons 1000" "basis 1500" "sequence 1000" "files 2000" "shape 800" "given 1000" \
    "parts 500" "plane 1000" "transfer 500" "commands 800" "model 800" "fields 800" \
    "quality 1000" "sections 300" "tables 3000"; do
    "$build/fuzzer" $run 1 || failed=1
done
exit $failed
