#!/bin/sh
# usage: embed.sh >page_text.cpp
# page.html with its style sheet and scripts inside, as two C++ strings: what stands before and what stands after the line of
# data.js, where the program puts its own data. embed.cmake does the same.
cd "$(dirname "$0")" || exit 1
awk '
    function put(line) { print "R\"page(" line; print ")page\"" }   # a short literal for each line: compilers limit them
    function put_file(name,    line, found) {
        while ((getline line <name) > 0) { put(line); found = 1 }
        close(name)
        if (!found) { print "embed.sh: " name " is missing" | "cat >&2"; exit 1 }
    }
    function between_quotes(line) { split(line, part, "\""); return part[2] }
    BEGIN {
        print "// Made by c_api/cli/page/embed.sh."
        print "#include \"cli/page_text.hpp\"\n"
        print "const char* const cli::page_before_data ="
    }
    /^<script src="data.js">/ { print ";\n\nconst char* const cli::page_after_data ="; next }
    /^<script src=/ { put("<script>"); put_file(between_quotes($0)); put("</script>"); next }
    /^<link href=/ { put("<style>"); put_file(between_quotes($0)); put("</style>"); next }
    { put($0) }
    END { print ";" }' page.html
