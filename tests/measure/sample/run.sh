#!/bin/sh
# usage: sh tests/measure/sample/run.sh build/harmorph folder [DESIGNS]
# Designs a second that `harmorph sample` makes on one thread of the shipped NACA 0012, in seconds of processor time
# (user and system) and of wall time, the least of five runs: with coordinates, measures and quality, and what arrays
# on request cost beside that; then designs whose control points are fitted to sections. Then the time in which dd
# writes as many bytes to the same disk, with and without waiting for the disk itself.
harmorph=$1 to=$2 count=${3:-1000}
rm -rf "$to"
mkdir -p "$to" || exit 1
mesh=$(dirname "$harmorph")/meshes/naca0012.su2
"$harmorph" fit $mesh --marker airfoil -o "$to/curve" >"$to/log" &&
    "$harmorph" solve $mesh --curve "airfoil=$to/curve" -o "$to/basis" >>"$to/log" || exit 1
least() { # least COMMAND...: seconds of processor time and of wall time; each is the least of five runs
    for run in 1 2 3 4 5; do
        rm -rf "$to/set"
        # bash: not every sh has `time`.
        bash -c 'TIMEFORMAT="%U %S %R"; time "$@" >>"$0" 2>&1' "$to/log" "$@" 2>&1 | awk '{ print $1 + $2, $3 }'
    done | awk 'NR == 1 || $1 < s { s = $1 } NR == 1 || $2 < r { r = $2 } END { print s, r }'
}
sample() { # sample NAME ARGUMENTS...
    name=$1; shift
    set -- $(least "$harmorph" sample $mesh "$to/basis" --count "$count" -o "$to/set" "$@")
    bytes=$(cat "$to"/set/shards/* | wc -c)
    echo "$name $1 $2 $bytes $count" | awk '{
        printf "%-22s %8.0f %12.0f %14.0f %10.0f\n", $1, $5 / $2, $5 / $3, 1e6 * $2 / $5, $4 / $5 }'
}
points=$(awk '/^NPOIN/ { print $2 }' $mesh)
echo "$count designs of $points points"
printf '%-22s %8s %12s %14s %10s\n' arrays "a CPU s" "a wall s" "CPU us a mesh" "bytes"
sample coordinates --range=-.002,.002
sample and_admissible_step --range=-.002,.002 --step
sample and_walls --range=-.002,.002 --wall
sample and_distances --range=-.002,.002 --wall-distance
sample naca --naca
sample cst --cst 5,5
blocks=$((bytes / 1000000))
rm -rf "$to/set"
for how in "" conv=fsync; do
    set -- $(least dd if=/dev/zero "of=$to/dd" bs=1000000 count=$blocks $how)
    echo "$blocks $1 $2 $how" | awk '{ printf "dd %-19s %8.0f MB/s of processor time, %.0f MB/s of wall time\n",
        $4, $1 / $2, $1 / $3 }'
done
rm -rf "$to"
