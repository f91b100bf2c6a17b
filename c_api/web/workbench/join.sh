#!/bin/sh
# usage: join.sh BUILD >workbench.html
# Writes the workbench as one file: the program, its worker and the example mesh are compressed, in base 64. Indentation
# and lines of comments are left out.
build=$(cd "$1" && pwd) && cd "$(dirname "$0")" || exit 1
packed() { gzip -9 -n -c | base64 | tr -d '\n'; }
text() { printf '<script type="text/plain" id="%s">' "$1"; packed; echo '</script>'; }
inside() {   # element, file
    echo "<$1>"
    sed 's/^ *//; /^\/\/ /d; /^$/d' "$2" || exit 1
    echo "</$1>"
}
while IFS= read -r line; do
    name=${line#*=\"} name=${name%%\"*}
    case $line in
    '<script src="program.txt">'*)
        text program_wasm <"$build/web/workbench_program.wasm"
        cat "$build/web/workbench_program.js" command.js worker.js | text program_script ;;
    '<script src="example.txt">'*) text example_mesh <"$build/meshes/naca0012.su2" ;;
    '<script src='*) inside script "$name" ;;
    '<link href='*) inside style "$name" ;;
    *) printf '%s\n' "$line" ;;
    esac
done <workbench.html
