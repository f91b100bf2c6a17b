#!/bin/sh
# usage: sh tests/measure/sections/fits.sh path/to/harmorph folder/for/output [COUNT [SEED]]
# Fits curves of 20 control points to COUNT sections (500 without a number) of 25 to 200 points with cosine and uniform
# spacing: NACA, CST, and CST with a base of up to half the chord. Prints how many fits warn, and the largest distances:
# of the points from the curve, and of the curve from the polygon of the points. Fails if a curve is farther than .005
# chord from the polygon without a warning, if more than 5 % of the fits warn, or if a section is refused.
harmorph=$1 tmp=$2 count=${3:-500} seed=${4:-1} here=$(dirname "$0")
: "${CXX:=c++}"
rm -rf "$tmp" && mkdir -p "$tmp/sections" || exit 2
"$CXX" -std=c++17 -O1 -I"$here/../.." -I"$here/../../../include" -o "$tmp/make_family" "$here/make_family.cpp" &&
    "$tmp/make_family" "$tmp/sections" "$count" "$seed" || exit 2
while read -r name; do
    "$harmorph" fit "$tmp/sections/$name" -o "$tmp/one.curve" --json >"$tmp/out" 2>"$tmp/err" || echo "refused $name"
    echo "$name $(grep -c 'off the lines' "$tmp/err") \
        $(sed 's/.*"max_error": \([^,]*\).*"max_departure": \([^,]*\).*/\1 \2/' \
        "$tmp/out")"
done <"$tmp/sections/list" >"$tmp/rows"
awk '
    $1 == "refused" { ++refused; next }
    { ++n; warn += $2; if ($3 > error) error = $3; if ($4 > far) far = $4; silent += $4 > .005 && !$2 }
    END {
        print "fits " n + 0 ", refused " refused + 0 ", with a warning " warn + 0 ", far without a warning " silent + 0
        print "largest error " error ", largest departure from the polygon " far
        exit !(n > 0 && !refused && !silent && warn <= .05 * n)
    }' "$tmp/rows"
