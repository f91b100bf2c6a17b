#!/bin/sh
# usage: embed.sh >page_text.cpp
# Each page with its style sheets and scripts inside, as two C++ strings: what stands before and what stands after the
# line of data.js, where the program puts its own data; and head.html, which all pages begin with, as a third.
# Indentation and lines of comments stay behind. embed.cmake does the same.
cd "$(dirname "$0")" || exit 1

# literals FILE: its lines. A short literal for each: compilers limit them.
literals() {
    awk '
        function put(line) {
            sub(/^ +/, "", line)
            if (line != "" && line !~ /^\/\//) { print "R\"page(" line; print ")page\"" }
        }
        function put_file(name,    line, found) {
            while ((getline line <name) > 0) { put(line); found = 1 }
            close(name)
            if (!found) { print "embed.sh: " name " is missing" | "cat >&2"; exit 1 }
        }
        function between_quotes(line) { split(line, part, "\""); return part[2] }
        /^<script src="data.js">/ { print ","; next }
        /^<script src=/ { put("<script>"); put_file(between_quotes($0)); put("</script>"); next }
        /^<link href=/ { put("<style>"); put_file(between_quotes($0)); put("</style>"); next }
        { put($0) }' "$1"
}
printf '// Made by c_api/cli/page/embed.sh.\n#include "page/page_text.hpp"\n\nconst char cli::page_head[] =\n'
literals head.html || exit 1
echo ';'
for page in explore report; do
    printf '\nconst cli::PageText cli::%s_page = {\n' $page
    literals $page.html || exit 1
    echo '};'
done
