#!/bin/sh
# usage: points.sh HARMORPH MESH MARKER FOLDER   Admissible steps of conformal functions divided by those of Laplace
# functions, for 20 control points moved one at a time along the chord (x) and across it (y), both ways.
harmorph=${1:?usage: points.sh HARMORPH MESH MARKER FOLDER} mesh=$2 marker=$3 folder=$4
mkdir -p "$folder" || exit
"$harmorph" fit "$mesh" --marker "$marker" --points 20 -o "$folder/a.curve" >"$folder/log" || exit
for operator in laplace conformal; do
    "$harmorph" solve "$mesh" --curve "$marker=$folder/a.curve" --operator $operator -o "$folder/$operator.basis" \
        >"$folder/log" || exit
done
step() {   # the admissible step of the movement with functions of this operator
    "$harmorph" morph "$mesh" "$folder/$1.basis" --move "$folder/move" --json |
        sed 's/.*"admissible_step": \([^,]*\),.*/\1/'
}
for way in 'x .001 0' 'x -.001 0' 'y 0 .001' 'y 0 -.001'; do
    for point in 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19; do
        echo "$point ${way#? }" >"$folder/move"
        echo "${way%% *} $(step laplace) $(step conformal)"
    done
done | awk '{ print $1, $3 / $2 }' | LC_ALL=C sort -k1,1 -k2,2g | awk '
    { ratio[$1, ++n[$1]] = $2; below[$1] += $2 < 1 }
    END {
        for (way in n)
            printf "along %s: median %.2f, smallest %.2f, largest %.1f, below 1: %d of %d\n", way,
                (ratio[way, int(n[way] / 2)] + ratio[way, int(n[way] / 2) + 1]) / 2, ratio[way, 1],
                ratio[way, n[way]], below[way], n[way]
    }' | sort
