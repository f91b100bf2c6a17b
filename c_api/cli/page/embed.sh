#!/bin/sh
# usage: embed.sh >page_text.cpp
# Each page behind head.html, which all pages share, with its style sheets and scripts inside, as two C++ strings: what
# stands before and what stands after the line of data.js, where the program puts its own data. embed.cmake does
# the same.
cd "$(dirname "$0")" || exit 1
printf '// Made by c_api/cli/page/embed.sh.\n#include "cli/page_text.hpp"\n'
for page in explore report; do
    printf '\nconst cli::PageText cli::%s_page = {\n' $page
    # A short literal for each line: compilers limit them.
    awk '
        function put(line) { print "R\"page(" line; print ")page\"" }
        function put_file(name,    line, found) {
            while ((getline line <name) > 0) { put(line); found = 1 }
            close(name)
            if (!found) { print "embed.sh: " name " is missing" | "cat >&2"; exit 1 }
        }
        function between_quotes(line) { split(line, part, "\""); return part[2] }
        /^<script src="data.js">/ { print ","; next }
        /^<script src=/ { put("<script>"); put_file(between_quotes($0)); put("</script>"); next }
        /^<link href=/ { put("<style>"); put_file(between_quotes($0)); put("</style>"); next }
        { put($0) }
        END { print "};" }' head.html $page.html || exit 1
done
