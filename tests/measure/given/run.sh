#!/bin/sh
# usage: run.sh BUILD   Displacements given point by point on the shipped meshes; MESHES: on those too, words
# FILE:MARKER, or a folder: each SU2 file there, by its first marker that the program can fit a curve to. SEEDS random
# fields of each kind. GMSH new meshes of random sections, where gmsh is installed; FIRST: the seed of the first one.
build=${1:?usage: run.sh BUILD}
: "${CXX:=c++}" "${CXXFLAGS:=-O2}" "${SEEDS:=2}" "${GMSH:=2}" "${FIRST:=1}"
dir=$build/given
mkdir -p "$dir"
words="tests/meshes/naca0012.su2:airfoil tests/meshes/two_bodies.su2:left"
for word in $MESHES; do
    if [ ! -d "$word" ]; then words="$words $word"; continue; fi
    for file in "$word"/*.su2; do
        for marker in $(tr -d '\r' <"$file" | sed -n 's/^MARKER_TAG= *\([^ ]*\).*/\1/p'); do
            "$build/harmorph" fit "$file" --marker "$marker" -o "$dir/trial.curve" >/dev/null 2>&1 || continue
            case $marker in *[Ff]ar*|*[Ii]nlet*|*[Oo]utlet*|*[Ss]ym*) continue ;; esac
            words="$words $file:$marker"
            break
        done
    done
done
k=0
while [ $k -lt "$GMSH" ]; do
    command -v gmsh >/dev/null || { echo "skipped: meshes of random sections, as gmsh is not installed"; break; }
    section=$dir/section-$((FIRST + k))
    awk -v seed=$((FIRST + k)) -f tests/measure/given/section.awk </dev/null >"$section.geo"
    gmsh -2 -v 1 "$section.geo" -format su2 -o "$section.su2" >/dev/null 2>&1 ||
        { echo "gmsh failed: $section.geo"; exit 1; }
    words="$words $section.su2:wing"
    k=$((k + 1))
done
for word in $words; do
    name=$(basename "${word%:*}")
    "$build/harmorph" fit "${word%:*}" --marker "${word##*:}" -o "$dir/${name%.*}.${word##*:}.curve" >/dev/null || exit
done
objects=$(cat "$build/objects/program.list")
$CXX -std=c++17 -Wall -Wextra $CXXFLAGS -pthread -Iinclude -Ic_api/cli -o "$dir/fields" \
    tests/measure/given/fields.cpp $objects \
    "$build/libharmorph.a" $LDFLAGS || { echo "0 passed, 1 failed"; exit 1; }
exec "$dir/fields" "$dir" "$SEEDS" $words
