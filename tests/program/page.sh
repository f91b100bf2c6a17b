#!/bin/sh
# Tests of the page of `harmorph explore`: sh tests/program/page.sh path/to/harmorph path/to/meshes folder/for/output
# Headless Chromium (CHROMIUM, or what is found) opens the page with page.js behind it and prints what became of
# it; `harmorph morph` with the moves that the page saved must put every point where the page has it. Prints, too, how
# long a frame of a drag takes.
harmorph=$1 meshes=$2 tmp=$3
rm -rf "$tmp"
mkdir -p "$tmp" || exit 2
tmp=$(cd "$tmp" && pwd)
topic=page
. "$(dirname "$0")/../count.sh"
. "$(dirname "$0")/behind_page.sh"

# ---- What needs no browser -------------------------------------------------------------------------------------------

# The page solves the functions itself, with this kernel.
solve() {
    "$harmorph" solve "$@" --kernel baseline --threads 1 >"$tmp/log" 2>&1 || { cat "$tmp/log"; fail "solve $*"; }
}
explore() { "$harmorph" explore "$@" >"$tmp/log" 2>&1; }
refuses() { # refuses NAME TEXT ARGUMENTS...
    name=$1 text=$2; shift 2
    if explore "$@"; then fail "$name: not refused"; elif grep -F -e "$text" "$tmp/log" >/dev/null; then ok; else
        fail "$name: $(cat "$tmp/log")"
    fi
}
naca=$meshes/naca0012.su2
"$harmorph" fit "$naca" --marker airfoil -o "$tmp/airfoil.curve" >/dev/null || fail "fit"
solve "$naca" --curve "airfoil=$tmp/airfoil.curve" -o "$tmp/conformal.basis"
solve "$naca" --curve "airfoil=$tmp/airfoil.curve" --operator laplace -o "$tmp/laplace.basis"
solve "$naca" --rigid airfoil=.25,0 -o "$tmp/rigid.basis"
solve "$meshes/block.su2" --rigid block --slip outer -o "$tmp/slip.basis"
awk -f "${0%/*}/../meshes/merge_cells.awk" "$naca" >"$tmp/merged.vtk"
solve "$tmp/merged.vtk" --curve "boundary1=$tmp/airfoil.curve" -o "$tmp/merged.basis"
if explore "$naca" "$tmp/conformal.basis" -o "$tmp/whole.html"; then ok; else fail "explore"; fi
if grep -E '(src|href)=|https?:' "$tmp/whole.html" | grep -v 'link.href = URL' >/dev/null; then
    fail "the page refers to something outside"
else ok; fi
refuses "a file that is no moves" "the file needs a control point" "$naca" "$tmp/conformal.basis" -o "$tmp/x.html" \
    --move "$naca"
refuses "a file that is no basis" "basis" "$naca" "$naca" -o "$tmp/x.html"
refuses "too few points" "--points" "$naca" "$tmp/conformal.basis" -o "$tmp/x.html" --points 3
if [ -e "$tmp/x.html" ]; then fail "a refused command leaves a page"; else ok; fi

# ---- In the browser --------------------------------------------------------------------------------------------------

chromium=$CHROMIUM
for name in chromium chromium-browser google-chrome; do
    [ -n "$chromium" ] || chromium=$(command -v $name)
done
if [ -z "$chromium" ]; then
    skip "the page in a browser" "no Chromium is found (Debian's package chromium, or CHROMIUM=path)"
    finish
    exit
fi

browse() { # browse PAGE OPTIONS...: the page's elements as text, once it is loaded
    page=$1; shift
    timeout 300 "$chromium" --headless --no-sandbox --disable-quic --no-first-run --disable-background-networking \
        --disable-component-update --disable-sync --disable-dev-shm-usage --user-data-dir="$tmp/profile" \
        --use-angle=swiftshader \
        --enable-unsafe-swiftshader --window-size=1280,800 "$@" --dump-dom "file://$page" 2>"$tmp/browser.log"
    rm -rf "$tmp/profile"
}
value() { sed -n "s/^value $1 //p" "$tmp/$case.result"; }
of_program() { sed -n "s/.*\"$1\": \([^,}]*\).*/\1/p" "$tmp/$case.json"; }
near() { # near NAME ALLOWED: page and program agree, relative to the larger of both
    if awk -v a="$(value $1)" -v b="$(of_program $1)" -v allowed="$2" 'BEGIN {
        if (a == "Infinity" && b == "null") exit 0
        size = (a * a > b * b ? a : b); difference = a - b
        exit !(a != "" && b != "" && difference * difference <= allowed * allowed * size * size) }'; then ok; else
        fail "$case: $1 is $(value $1) on the page, $(of_program $1) by the program"
    fi
}
same_points() { # of $case.moved, which the program has written, and $case.result
    # SU2 or VTK. The page shows each point exactly where the program puts it: the same number, whatever its text.
    awk '/^(NPOIN=|POINTS )/ { inside = 1; n = 0; next } /^[A-Z]/ { inside = 0 } inside { print "at", n++, $1, $2 }' \
        "$tmp/$case.moved" |
        cat - "$tmp/$case.result" | awk -v allowed="${exact:-0}" '
        function off(a, b) { return a > b ? a - b : b - a }
        $1 == "at" { x[$2] = $3; y[$2] = $4; next }
        $1 != "point" { next }
        { ++n; d = off($3 + 0, x[$2] + 0) + off($4 + 0, y[$2] + 0); if (d > most) most = d }
        d > allowed { if (++wrong == 1) print "point", $2, "is off by", d }
        END {
            print n, "points,", wrong + 0, "off by more than", allowed + 0, "and at most", most + 0
            exit !(n > 0 && wrong == 0)
        }' >"$tmp/log"
    if [ $? -eq 0 ]; then ok; else fail "$case: $(cat "$tmp/log")"; fi
}
page() { # page CASE MESH BASIS PIXELS OPTIONS...: drag a point down by so many pixels, and compare
    case=$1 mesh=$2 basis=$3 pixels=$4; shift 4
    explore "$mesh" "$basis" -o "$tmp/$case.html" "$@" || fail "$case: explore"
    { echo "<script>const wanted = { down: $pixels };</script>"; behind_page tests/program/page.js; } \
        >>"$tmp/$case.html"
    browse "$tmp/$case.html" | sed -n '/^result begins/,/^result ends/p' >"$tmp/$case.result"
    if ! grep -q '^result ends' "$tmp/$case.result"; then
        fail "$case: the page has not come to its end"
        tail -n 3 "$tmp/browser.log"
        return
    fi
    passed=$((passed + $(grep -c '^check .* ok *$' "$tmp/$case.result")))
    grep '^check .*FAILED' "$tmp/$case.result" >"$tmp/log"
    while read -r line; do fail "$case: $line"; done <"$tmp/log"
    sed -n '/^moves$/,/^end$/p' "$tmp/$case.result" | sed '1d;$d' >"$tmp/$case.moves"
    "$harmorph" morph "$mesh" "$basis" --move "$tmp/$case.moves" -o "$tmp/$case.moved" --force \
        --json >"$tmp/$case.json" 2>/dev/null
    same_points
    frame=$(value frame_milliseconds)
    frame=${frame:+"; median frame of a drag $frame ms: morph $(value morph_milliseconds), \
judge $(value judge_milliseconds), draw $(value draw_milliseconds), \
the rest fields and pixels, without a graphics processor"}
    echo "$case: $(tail -n 1 "$tmp/log")$frame"
}
scripted() { # scripted CASE PAGE SCRIPT OPTIONS...: the checks of a script on a page
    case=$1 of=$2 script=$3; shift 3
    cp "$tmp/$of.html" "$tmp/$case.html"
    if [ -f "$axe" ] && [ "$script" = tests/program/page_use.js ]; then
        { echo "<script>"; cat "$axe"; echo "</script>"; } >>"$tmp/$case.html"
    fi
    behind_page "$script" >>"$tmp/$case.html"
    browse "$tmp/$case.html" "$@" |
        sed -n '/^result begins/,/^result ends/p' >"$tmp/$case.result"
    if ! grep -q '^result ends' "$tmp/$case.result"; then fail "$case: the page has not come to its end"; fi
    passed=$((passed + $(grep -c '^check .* ok *$' "$tmp/$case.result")))
    grep '^check .*FAILED' "$tmp/$case.result" >"$tmp/log"
    while read -r line; do fail "$case: $line"; done <"$tmp/log"
}
judged_alike() { # judged_alike: the page says of the mesh what the program says, but for the last digits
    for name in inverted self_crossing; do
        if [ "$(value $name)" = "$(of_program $name)" ]; then ok; else
            fail "$case: $name is $(value $name) on the page, $(of_program $name) by the program"
        fi
    done
    for name in admissible_step min_quality mean_quality; do near $name 1e-14; done
}

page conformal "$naca" "$tmp/conformal.basis" 30
judged_alike
# A mesh that has moved since its functions were solved: the page stores these.
cp "$tmp/conformal.moved" "$tmp/again.su2"
page again "$tmp/again.su2" "$tmp/conformal.basis" 20
judged_alike
# A curve without ends, on which the library needs a chord.
"$harmorph" fit "$naca" --marker airfoil --closed periodic --points 12 -o "$tmp/periodic.curve" >/dev/null || fail "fit"
solve "$naca" --curve "airfoil=$tmp/periodic.curve" --operator weighted -o "$tmp/periodic.basis"
page periodic "$naca" "$tmp/periodic.basis" 20
judged_alike
page crossing "$naca" "$tmp/conformal.basis" -150
judged_alike
if [ "$(value self_crossing)" = true ]; then ok; else fail "no wall crosses another"; fi
page inverted "$naca" "$tmp/laplace.basis" -250
judged_alike
if [ "$(value inverted)" -gt 0 ]; then ok; else fail "a large movement inverts no cell"; fi
page rigid "$naca" "$tmp/rigid.basis" 0
judged_alike
page slip "$meshes/block.su2" "$tmp/slip.basis" 0
judged_alike
page polygons "$tmp/merged.vtk" "$tmp/merged.basis" 30
judged_alike
page polygons-inverted "$tmp/merged.vtk" "$tmp/merged.basis" -2000
judged_alike
if [ "$(value inverted)" -gt 0 ]; then ok; else fail "a large movement inverts no polygon"; fi
# Reports: the same qualities, first layers and sections as the program says, and their pictures.
report() { # report CASE MESH BASIS DRAGGED OPTIONS...: of the movement of the page DRAGGED
case=$1 mesh=$2 basis=$3 moves=$tmp/$4.moves; shift 4
"$harmorph" morph "$mesh" "$basis" --move "$moves" --report "$tmp/$case.html" --json "$@" >"$tmp/$case.json" 2>/dev/null
cat >>"$tmp/$case.html" <<'END'
<script>
const table = (id) => {
    const [, text] = document.querySelector(`#${id} a`).href.split(",");
    return decodeURIComponent(text).trim().split("\n").slice(1).map((row) => row.split(","));
};
const sum = (values) => values.reduce((total, value) => total + Number(value), 0);
const { data } = report, qualities = table("quality_histogram"),
    layer = table("angle_chart"),
    [angles, heights] = [4, 5].map((column) => layer.map((row) => Number(row[column])));
const lines = Object.entries({
    percent_before: sum(qualities.map((row) => row[2])).toFixed(9),
    percent_after: sum(qualities.map((row) => row[3])).toFixed(9),
    min_quality: Math.min(...data.quality_after),
    mean_quality: sum(data.quality_after) / data.cells,
    max_angle_change: Math.max(...angles),
    mean_angle_change: sum(angles) / angles.length,
    min_height_ratio: Math.min(...heights),
    max_height_ratio: Math.max(...heights),
    area: data.sections.map((section) => section.area_now)[0],
    thickness: data.sections.map((section) => section.thickness_now)[0],
    close_ups: document.querySelectorAll("#worst canvas").length,
    charts: document.querySelectorAll("article svg").length,
}).map(([name, value]) => `value ${name} ${value}`);
document.body.innerHTML = `<pre>\n\nresult begins\n${lines.join("\n")}\nresult ends\n</pre>`;
</script>
END
browse "$tmp/$case.html" | sed -n '/^result begins/,/^result ends/p' >"$tmp/$case.result"
for name in min_quality mean_quality; do near $name 1e-12; done
if [ "$(value close_ups) $(value charts)" = "10 3" ]; then ok; else
    fail "$case: $(value close_ups) worst cells, $(value charts) charts"
fi
if [ "$(value percent_before) $(value percent_after)" = "100.000000000 100.000000000" ]; then ok; else
    fail "$case: the table of qualities has $(value percent_before) and $(value percent_after) % of the cells"
fi
}
layers_alike() { # layers_alike: of a safe morph, whose report has the extremes
    for name in max_angle_change mean_angle_change min_height_ratio max_height_ratio; do near $name 1e-12; done
}
report report "$naca" "$tmp/laplace.basis" inverted
report polygons-report "$tmp/merged.vtk" "$tmp/merged.basis" polygons-inverted
report safe "$naca" "$tmp/conformal.basis" conformal --safe
if grep -q '"safe": true' "$tmp/safe.html"; then ok; else fail "--safe --report"; fi
layers_alike
report polygons-safe "$tmp/merged.vtk" "$tmp/merged.basis" polygons --safe
layers_alike
# The section of the report consists of the wall points, which lie on the curve.
report section "$naca" "$tmp/conformal.basis" conformal --curve-out "$tmp/moved.curve"
"$harmorph" curve "$tmp/moved.curve" --json >"$tmp/$case.json"
near area 1e-3
thickness=$(awk -v t="$(of_program max_thickness)" -v chord="$(of_program chord)" 'BEGIN { print t / chord }')
if awk -v a="$(value thickness)" -v b="$thickness" \
    'BEGIN { exit !(b > .05 && (a - b) ^ 2 <= 1e-6 * b * b) }'; then ok; else
    fail "the thickness of the section is $(value thickness) in the report, $thickness by the program"
fi
# Tests what a user does and sees, and with axe-core (npm install axe-core; AXE=path of axe.min.js) what axe-core finds.
axe=${AXE:-$(npm root -g 2>/dev/null)/axe-core/axe.min.js}
[ -f "$axe" ] || echo "axe-core is not installed: names and roles are checked without it"
scripted use whole tests/program/page_use.js
"$harmorph" curve "$tmp/airfoil.curve" --json >"$tmp/section.json"
of_curve() { sed -n "s/.*\"$1\": \([^,}]*\).*/\1/p" "$tmp/section.json"; }
for name in leading_edge_radius trailing_edge_angle; do
    if awk -v a="$(value $name)" -v b="$(of_curve $name)" \
        'BEGIN { exit !(a != "" && b > 0 && (a - b) ^ 2 <= 1e-6 * b * b) }'; then ok; else
        fail "$name: $(value $name) on the page, $(of_curve $name) by the program"
    fi
done
sed -n '/^section$/,/^end$/p' "$tmp/use.result" | sed '1d;$d' >"$tmp/saved.dat"
if "$harmorph" fit "$tmp/saved.dat" -o "$tmp/saved.curve" >"$tmp/log" 2>&1; then ok; else fail "the saved section"; fi
# What one sum of functions does not reach: the page puts each point where the program does.
farther() { # farther CASE COMMAND...: the words of the program, in which @ stands for the file of the page
    case=$1; shift
    {
        cat "$tmp/whole.html"
        echo "<script>const wanted = { what: \"$case\", text: \`$(cat "$tmp/naca2412.dat")\` };</script>"
        behind_page tests/program/page_farther.js
    } >"$tmp/$case.html"
    browse "$tmp/$case.html" | sed -n '/^result begins/,/^result ends/p' >"$tmp/$case.result"
    if ! grep -q '^result ends' "$tmp/$case.result"; then fail "$case: the page has not come to its end"; fi
    passed=$((passed + $(grep -c '^check .* ok *$' "$tmp/$case.result")))
    grep '^check .*FAILED' "$tmp/$case.result" >"$tmp/log"
    while read -r line; do fail "$case: $line"; done <"$tmp/log"
    sed -n '/^moves$/,/^end$/p' "$tmp/$case.result" | sed '1d;$d' >"$tmp/$case.dat"
    words=$(printf '%s\n' "$@" | sed "s|@|$tmp/$case.dat|")
    "$harmorph" $words --kernel baseline --threads 1 -o "$tmp/$case.moved" --force >"$tmp/log" 2>&1
    same_points
    echo "$case: $(tail -n 1 "$tmp/log")"
}
# NACA 2412 in Selig's order.
awk 'function side(k, sign,    x, t, y, slope, a) {
        x = (1 - cos(3.14159265358979 * k / 60)) / 2
        t = .6 * (.2969 * sqrt(x) - .126 * x - .3516 * x ^ 2 + .2843 * x ^ 3 - .1036 * x ^ 4)
        y = x < .4 ? .125 * (.8 * x - x * x) : .02 / .36 * (.2 + .8 * x - x * x)
        slope = x < .4 ? .125 * (.8 - 2 * x) : .02 / .36 * (.8 - 2 * x)
        a = atan2(slope, 1)
        printf "%.9f %.9f\n", x - sign * t * sin(a), y + sign * t * cos(a)
    }
    BEGIN { print "NACA 2412"; for (k = 60; k >= 0; --k) side(k, 1); for (k = 1; k <= 60; ++k) side(k, -1) }' \
    >"$tmp/naca2412.dat"
farther safe morph "$naca" "$tmp/conformal.basis" --move @ --safe
farther airfoil morph "$naca" "$tmp/conformal.basis" --to-airfoil @ --on-chord
farther displace displace "$naca" --given airfoil --wall @
scripted design whole tests/program/page_design.js --window-size=1280,800
explore "$meshes/block.su2" "$tmp/slip.basis" -o "$tmp/block.html" || fail "explore"
scripted bodies block tests/program/page_use.js
for size in 500,844 844,390 1280,800 3840,2160; do
    scripted "window $size" whole tests/program/page_look.js --window-size=$size
done
scripted "own colours" whole tests/program/page_look.js --force-high-contrast
if [ "$(value forced)" = true ]; then ok; else skip "the reader's own colours" "this browser does not force colours"; fi

# The functions of the fine mesh are interpolated, so that the page stores them.
"$harmorph" demo "$tmp/demo" >"$tmp/log" 2>&1 || fail "demo: $(tail -n 1 "$tmp/log")"
if [ "$(wc -c <"$tmp/demo/page.html")" -le 2200000 ]; then ok; else fail "the page of the demo is too large"; fi
page fine "$tmp/demo/fine.su2" "$tmp/demo/fine.basis" 30
finish
