#!/bin/sh
# usage: workbench.sh path/to/harmorph path/to/meshes folder/for/output BUILD   (MAKE, EMXX from the environment)
# The workbench in headless Chromium: a mesh is dropped, fitted, solved, dragged by the mouse, morphed and saved; files
# have the bytes of the program. Hostile files, in node and in the browser: no script runs, no hang, a sentence.
: "${MAKE:=make}" "${EMXX:=em++}"
harmorph=$1 meshes=$2 tmp=$3 build=$4
topic=workbench
. "$(dirname "$0")/../count.sh"
rm -rf "$tmp" && mkdir -p "$tmp" || exit 2
harmorph=$(cd "$(dirname "$harmorph")" && pwd)/$(basename "$harmorph")
tmp=$(cd "$tmp" && pwd) meshes=$(cd "$meshes" && pwd)
log=$tmp/log

missing=
for tool in clang++ wasm-ld node $EMXX; do command -v $tool >/dev/null || missing="$missing $tool"; done
if [ -n "$missing" ]; then
    skip "the workbench" "these are not found:$missing (Debian's packages clang, lld, nodejs, emscripten, node-acorn)"
    names_it() { ! $MAKE -s BUILD="$build" EMXX="$EMXX" workbench >"$log.make" && grep 'install Debian' "$log.make"; }
    check "make workbench names what is missing" names_it
    finish
    exit
fi
check "make workbench" $MAKE -s BUILD="$build" EMXX="$EMXX" workbench
page=$(cd "$build/web" && pwd)/workbench.html
small() { [ "$(wc -c <"$page")" -le 3000000 ]; }
check "the workbench has at most 3 MB" small
alone() { ! grep -E '(src|href)=|https?:' "$page"; }
check "the workbench refers to nothing outside" alone

# Scripts count for themselves.
counted() {   # what, command...
    what=$1; shift
    "$@" >"$log" 2>&1 || fail "$what" "$log"
    passed=$((passed + $(sed -n 's/^\([0-9][0-9]*\) passed, .*/\1/p' "$log" | tail -n 1 | grep . || echo 0)))
}
counted "hostile files in node" timeout 900 node tests/program/workbench/hostile.mjs "$build/web" "$meshes" 200

# What the tests drop.
naca=$meshes/naca0012.su2
cp "$naca" "$tmp/naca0012.su2" && gzip -c "$naca" >"$tmp/packed.su2.gz"
native() (
    cd "$tmp" && mkdir native && cd native &&
        "$harmorph" fit "$naca" --marker airfoil --points 20 -o airfoil.curve &&
        "$harmorph" solve "$naca" --curve airfoil=airfoil.curve --threads 1 --kernel baseline -o mesh.basis &&
        "$harmorph" morph "$naca" mesh.basis --by 'turn airfoil 4' -o turned.su2 --curve-out ../other.dat
)
check "the program on the same mesh" native
awk '/^MARKER_TAG/ { inside = /airfoil/; next } inside && NF >= 3 { print $2; print $3 }' "$naca" | sort -nu |
    sed 's/$/ 0 0.01/' >"$tmp/wall.txt"

chromium=$CHROMIUM
for name in chromium chromium-browser google-chrome; do
    [ -n "$chromium" ] || chromium=$(command -v $name)
done
same() { cmp "$tmp/saved/$1" "$tmp/native/$2"; }
moved() (
    cd "$tmp/native" &&
        "$harmorph" morph "$naca" mesh.basis --move ../saved/moves.txt --threads 1 --kernel baseline -o moved.su2 &&
        "$harmorph" morph "$naca" mesh.basis --to-airfoil ../other.dat --on-chord --threads 1 --kernel baseline \
            -o other.su2 &&
        "$harmorph" solve "$naca" --rigid airfoil --threads 1 --kernel baseline -o rigid.basis &&
        echo 'rigid airfoil 0.01 0.02 3' >rigid.txt &&
        "$harmorph" morph "$naca" rigid.basis --move rigid.txt --threads 1 --kernel baseline -o rigid.su2 &&
        for end in igs step dat; do "$harmorph" curve moved.su2.curve -o moved.$end; done
)
if [ -n "$chromium" ]; then
    counted "the workbench in use" timeout 900 node tests/program/workbench/use.mjs "$chromium" "$page" "$tmp"
    check "the program with the saved moves.txt" moved
    check "the saved curve has the bytes of harmorph fit" same airfoil.curve airfoil.curve
    check "the saved basis has the bytes of harmorph solve" same mesh.basis mesh.basis
    check "the saved mesh has the bytes of harmorph morph" same moved.su2 moved.su2
    check "and so has the one of another airfoil" same other.su2 other.su2
    check "and that of a rigid body" same packed-morphed.su2 rigid.su2
    check "the moved curve, too" same naca0012-morphed.su2.curve moved.su2.curve
    for end in igs step dat; do check "the curve as .$end" same naca0012-morphed.su2.$end moved.$end; done
    counted "hostile files in the browser" timeout 900 node tests/program/workbench/names.mjs \
        "$chromium" "$page" "$naca" "$tmp"
else
    skip "the workbench in a browser" "no Chromium is found (Debian's package chromium, or CHROMIUM=path)"
fi
firefox=$(command -v firefox || command -v firefox-esr)
if [ -z "$firefox" ]; then skip "the workbench in Firefox" "Firefox is not installed"; fi
if [ $failed = 0 ]; then finish "$tmp"; else finish; fi
