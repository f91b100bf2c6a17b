#!/bin/sh
# usage: tests/measure/web/run.sh BUILD   (after `make all web`)
# Milliseconds of the native library, with one thread and the baseline kernel, and of WebAssembly in node and in
# Chromium, and their ratios; the shortest of ROUNDS rounds, in which the three take turns. SIZES are NI,NJ,CONTROL of
# the meshes; "together" is from the mesh to the basis.
: "${CC:=cc}" "${SIZES:=513,193,20 101,50,20}" "${KERNEL:=simd128}" "${ROUNDS:=3}" "${CHROMIUM:=chromium}"
build=$(cd "$1" && pwd)
here=$(dirname "$0")
dir=$build/web-speed
rm -rf "$dir" && mkdir -p "$dir" || exit 1
$CC -O2 -Iinclude -o "$dir/speed" "$here/speed.c" "$build/libharmorph.a" -lm || exit 1
ln -s "$build/web/package" "$dir/package" && cp "$here/speed.mjs" "$dir/" || exit 1
uptime
for size in $SIZES; do
    sizes=$(echo $size | tr , ' ')
    : >"$dir/times"
    for round in $(seq $ROUNDS); do
        "$dir/speed" $sizes | sed 's/^/native /' >>"$dir/times" || exit 1
        node "$dir/speed.mjs" "$dir/package/index.js" $KERNEL $sizes | sed 's/^/node /' >>"$dir/times" || exit 1
        if command -v "$CHROMIUM" >/dev/null; then
            node "$here/../../hosts/web/browser.mjs" "$CHROMIUM" "$dir" speed.mjs $KERNEL $sizes |
                sed 's/^/chromium /' >>"$dir/times" || exit 1
        fi
    done
    awk -v size="$size" '
        !(($1, $2) in best) || $3 < best[$1, $2] { best[$1, $2] = $3 }
        $1 == "native" && !($2 in seen) { seen[$2] = 1; part[++n] = $2 }
        END {
            print "size " size ": part, native [ms], node [ms], ratio, Chromium [ms], ratio"
            for (k = 1; k <= n; ++k) {
                native = best["native", part[k]]
                printf "%-12s %10.3f", part[k], native
                for (w = 1; w <= 2; ++w) {
                    there = w == 1 ? "node" : "chromium"
                    if ((there, part[k]) in best)
                        printf " %10.3f %6.2f", best[there, part[k]], best[there, part[k]] / native
                }
                print ""
            }
        }' "$dir/times"
done
rm -rf "$dir"
