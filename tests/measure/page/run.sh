#!/bin/sh
# usage: tests/measure/page/run.sh path/to/harmorph folder/for/output [cells round the airfoil] [layers]
# Prints how many milliseconds a frame of the page of `harmorph explore` takes in headless Chromium, which draws in
# software, on an O-mesh of quadrilaterals round a Joukowski airfoil; 512 x 400 cells by default. The machine should do
# nothing else: uptime is printed first.
harmorph=$1 tmp=$2 around=${3:-512} layers=${4:-400}
here=$(dirname "$0")
mkdir -p "$tmp" || exit 2
tmp=$(cd "$tmp" && pwd)
uptime
awk -v around="$around" -v layers="$layers" -v first=2e-3 -f "$here/../compare/o_mesh.awk" >"$tmp/mesh.su2"
"$harmorph" fit "$tmp/mesh.su2" --marker airfoil -o "$tmp/airfoil.curve" >"$tmp/log" &&
    "$harmorph" solve "$tmp/mesh.su2" --curve "airfoil=$tmp/airfoil.curve" --operator laplace -o "$tmp/mesh.basis" \
        >>"$tmp/log" &&
    "$harmorph" explore "$tmp/mesh.su2" "$tmp/mesh.basis" --points 2000000 -o "$tmp/page.html" >>"$tmp/log" || {
    cat "$tmp/log"
    exit 1
}
. "$here/../../program/behind_page.sh"
behind_page "$here/frames.js" >>"$tmp/page.html"
timeout 600 "${CHROMIUM:-chromium}" --headless --no-sandbox --disable-quic --no-first-run \
    --disable-background-networking --disable-component-update --disable-sync --disable-dev-shm-usage \
    --user-data-dir="$tmp/profile" --use-angle=swiftshader --enable-unsafe-swiftshader --window-size=1280,800 \
    --dump-dom "file://$tmp/page.html" 2>"$tmp/browser.log" | sed -n '/^result begins/,/^result ends/p' | sed '1d;$d'
rm -rf "$tmp/profile"
