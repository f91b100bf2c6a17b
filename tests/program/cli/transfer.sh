# `harmorph transfer` carries functions from a coarse mesh to a fine one.

make_ring 110 31 >"$tmp/fine.su2"
makes solve "$ring" --curve body="$curve" -o "$tmp/narrow.basis" --storage single
runs "transfer" 0 transfer "$ring" "$basis" "$tmp/fine.su2" -o "$tmp/fine.basis" --json
has_keys "transfer: keys" points cells functions interpolated outside max_distance boundary_error wall_correction \
    analysis_seconds transfer_seconds
check "transfer: counts" says '"points": 3520, "cells": 3520, "functions": 12, "interpolated": 3300, "outside": 0'
runs "transfer: its basis morphs the fine mesh" 0 morph "$tmp/fine.su2" "$tmp/fine.basis" --move "$tmp/small.txt" --json
check "transfer: the wall moves as the B-spline" grep -E '"boundary_error": ([0-9.]*e-1[5-9]|0)' "$tmp/out"
runs "transfer: threads" 0 transfer "$ring" "$basis" "$tmp/fine.su2" -o "$tmp/fine2.basis" --threads 2
check "transfer: threads give the same bits" cmp "$tmp/fine.basis" "$tmp/fine2.basis"
check "transfer: says how many were interpolated" says '3300 of them interpolated'
runs "transfer: to single precision" 0 transfer "$ring" "$basis" "$tmp/fine.su2" -o "$tmp/fine3.basis" --storage single
check "transfer: to single precision: smaller" test "$(wc -c <"$tmp/fine3.basis")" -lt "$(wc -c <"$tmp/fine.basis")"
refuses "transfer: from single precision" 2 'single precision' transfer "$ring" "$tmp/narrow.basis" "$tmp/fine.su2" \
    -o "$tmp/x"
awk 'NF == 3 && index($0, ".") { $1 = 1.5 * $1; $2 = 1.5 * $2 } { print }' "$tmp/fine.su2" >"$tmp/larger.su2"
refuses "transfer: a larger domain" 3 "outside the coarse mesh; both meshes must cover the same domain" \
    transfer "$ring" "$basis" "$tmp/larger.su2" -o "$tmp/x"
sed 's/body/wing/' "$tmp/fine.su2" >"$tmp/renamed.su2"
refuses "transfer: a marker that is missing" 2 "'body'" transfer "$ring" "$basis" "$tmp/renamed.su2" -o "$tmp/x"
refuses "transfer: a basis of another mesh" 3 'another mesh' transfer "$tmp/fine.su2" "$basis" "$ring" -o "$tmp/x"
