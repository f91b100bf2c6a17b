#!/bin/sh
# `make paper`: the paper's cases with this program, operator and figures as there. Pictures go to build/paper, with an
# index.html (see tests/measure/figures.sh); numbers and tables are printed; MESHES=directory adds a table for the SU2
# files there. Shapes are drawn after the paper's description, which gives no coordinates.
: "${BUILD:=build}"
harmorph=$BUILD/harmorph out=$BUILD/paper meshes=$BUILD/meshes here=$(dirname "$0")
mkdir -p "$out"
failed=0

fail() { echo "FAILED: $*"; failed=1; }
run() { "$harmorph" "$@" >"$out/log" 2>&1 || { fail "harmorph $*"; cat "$out/log"; }; }
number() {   # of a JSON object, short
    value=$(sed -n "s/.*\"$1\": \([^,}]*\).*/\1/p" "$out/json")
    case $value in '' | null) echo - ;; *.* | *e*) printf '%.3g\n' "$value" ;; *) echo "$value" ;; esac
}
figure() { echo "figure $*"; }   # figure FILE [LABEL |] CAPTION: for the page of figures

# The three cases, as options of `harmorph solve`.
two_bodies="--curve left=$meshes/two_bodies_left.curve --curve right=$meshes/two_bodies_right.curve"
airfoil="--curve airfoil=$meshes/diffuser_airfoil.curve"
diffuser="--curve diffuser=$meshes/axisymmetric_diffuser.curve"

. "$here/figures.sh"
. "$here/operators.sh"
. "$here/schemes.sh"
. "$here/engines.sh"
. "$here/histories.sh"
. "$here/sizes.sh"
. "$here/coarse.sh"

rm -f "$out"/json "$out"/log "$out"/*.basis "$out"/*.csv "$out"/*.su2 "$out"/*.curve "$out"/*.moves
exit $failed
