# Names of markers with all bytes: pictures are XML, data of pages are JSON, and a terminal gets UTF-8 without control
# characters.

names=$tmp/names
mkdir "$names"
python=python3
if [ -x /usr/bin/python3 ]; then python=/usr/bin/python3; fi
if $python -c 'import xml.etree.ElementTree' 2>/dev/null; then
    shows() { check "names: $1: $(basename "$2")" $python "$here/names.py" "$1" "$list" "$2"; }
    for number in $($python "$here/names.py" meshes "$ring" "$names"); do
        mesh=$names/mesh$number.su2 list=$names/mesh$number.names
        runs "names: check" 0 check "$mesh" --svg "$names/mesh.svg"
        shows text "$tmp/out"
        shows picture "$names/mesh.svg"
        runs "names: check --boundaries" 0 check "$mesh" --boundaries --svg "$names/boundaries.svg"
        shows picture "$names/boundaries.svg"
        runs "names: check --json" 0 check "$mesh" --json
        shows json "$tmp/out"
        refuses "names: the list of markers in a refusal" 2 "no marker" fit "$mesh" --marker wing -o "$tmp/x"
        shows text "$tmp/err"
        runs "names: convert" 0 convert "$mesh" "$names/mesh.msh"
        shows text "$tmp/err"
        # All markers are bodies, so that the page has all names.
        set --
        while IFS= read -r name || [ -n "$name" ]; do set -- "$@" --rigid "$name=5,5"; done <"$list"
        runs "names: solve" 0 solve "$mesh" "$@" -o "$names/rigid.basis"
        shows text "$tmp/out"
        runs "names: explore" 0 explore "$mesh" "$names/rigid.basis" -o "$names/page.html"
        shows page "$names/page.html"
        runs "names: morph" 0 morph "$mesh" "$names/rigid.basis" --move "$no_moves" --svg "$names/morph.svg" \
            --report "$names/report.html"
        shows text "$tmp/out"
        shows page "$names/report.html"
        check "names: the picture of the morph is XML" $python -c \
            'import sys, xml.etree.ElementTree as e; e.parse(sys.argv[1])' "$names/morph.svg"
    done
    printf 'no mesh \033[31m \351 \302\233 end\n' >"$names/first.su2"
    list=/dev/null
    "$harmorph" check "$names/first.su2" 2>"$tmp/err"
    shows text "$tmp/err"
    "$harmorph" check "$names/$(printf 'path\033[1m\351.su2')" 2>"$tmp/err"
    shows text "$tmp/err"
    "$harmorph" "$(printf 'command\033[1m\351')" 2>"$tmp/err"
    shows text "$tmp/err"
else
    skip "names with all bytes" "python3 with xml.etree is not installed"
fi
rm -rf "$names"
