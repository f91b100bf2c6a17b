#!/bin/sh
# usage: sh tests/measure/sections/run.sh path/to/harmorph path/to/meshes folder/for/output [COUNT]
# Morphs the shipped mesh to COUNT sections of nine families (1600 without a number) by `harmorph sample --sections`,
# and prints a row for each family: how many are reached, how many in one linear step, the distances of the points from
# the curve in chords, and the smallest quality. Tests call this with few sections.
harmorph=$1 meshes=$2 tmp=$3 count=${4:-1600} here=$(dirname "$0")
: "${CXX:=c++}"
rm -rf "$tmp" && mkdir -p "$tmp/sections" || exit 2
"$CXX" -std=c++17 -O1 -I"$here/../.." -I"$here/../../../include" -o "$tmp/make_sections" "$here/make_sections.cpp" &&
    "$tmp/make_sections" "$tmp/sections" "$count" || exit 2
mesh=$meshes/naca0012.su2
"$harmorph" fit "$mesh" --marker airfoil -o "$tmp/airfoil.curve" >/dev/null &&
    "$harmorph" solve "$mesh" --curve airfoil="$tmp/airfoil.curve" -o "$tmp/airfoil.basis" >/dev/null || exit 2
"$harmorph" sample "$mesh" "$tmp/airfoil.basis" --sections "$tmp/sections/list" --on-chord -o "$tmp/set" || exit 1
awk -F, '
    NR == 1 { for (i = 1; i <= NF; i++) column[$i] = i; next }
    {
        name = $column["section"]; gsub(/.*\/|"/, "", name); sub(/-.*/, "", name)
        if (!(name in n)) order[++families] = name
        ++n[name]
        if (!$2) next
        ++reached[name]; linear[name] += $column["way"] == "linear"
        d = $column["fit_error"]; q = $column["min_quality"]
        sum[name] += d; if (d > worst[name]) worst[name] = d
        if (!(name in least) || q < least[name]) least[name] = q
    }
    END {
        print "| family | sections | reached | in one step | mean distance | largest distance | smallest quality |"
        print "|---|---|---|---|---|---|---|"
        for (k = 1; k <= families; k++) {
            f = order[k]
            printf "| %s | %d | %d | %d | %.1e | %.1e | %.3f |\n", f, n[f], reached[f], linear[f],
                reached[f] ? sum[f] / reached[f] : 0, worst[f], least[f]
        }
    }' "$tmp/set/designs.csv"
