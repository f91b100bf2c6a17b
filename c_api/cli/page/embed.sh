#!/bin/sh
# usage: embed.sh >page_text.cpp
# Writes each page with its style sheets and scripts inside as two C++ strings, the text before and the text after the
# line of data.js, where the program puts its data; and head.html, with which all pages begin, as a third string. The
# line of package.js stands for the scripts of the package for npm. Indentation and lines of comments are left out.
cd "$(dirname "$0")" || exit 1
package=
for name in errors layout memory library numbers conditions mesh curves morph quality bound; do
    package="$package ../../web/package/$name.js"
done

# literals FILE: writes each line as a short literal, as compilers limit the length of literals.
literals() {
    awk -v package="$package" '
        function put(line) {
            sub(/^ +/, "", line)
            if (line != "" && line !~ /^(\/\/|\/\*\*.*\*\/$)/) { print "R\"page(" line; print ")page\"" }
        }
        function put_file(name,    line, found) {
            while ((getline line <name) > 0) { put(line); found = 1 }
            close(name)
            if (!found) { print "embed.sh: " name " is missing" | "cat >&2"; exit 1 }
        }
        function between_quotes(line) { split(line, part, "\""); return part[2] }
        /^<script src="data.js">/ { print ","; next }
        /^<script src="package.js">/ {
            put("<script>")
            command = "awk -f ../../web/join.awk " package
            while ((command | getline line) > 0) put(line)
            close(command)
            put("</script>")
            next
        }
        /^<script src=/ { put("<script>"); put_file(between_quotes($0)); put("</script>"); next }
        /^<link href=/ { put("<style>"); put_file(between_quotes($0)); put("</style>"); next }
        { put($0) }' "$1"
}
printf '// Made by c_api/cli/page/embed.sh.\n#include "page/page_text.hpp"\n\nconst char cli::page_head[] =\n'
literals head.html || exit 1
echo ';'
for page in explore report sample; do
    printf '\nconst cli::PageText cli::%s_page = {\n' $page
    literals $page.html || exit 1
    echo '};'
done
