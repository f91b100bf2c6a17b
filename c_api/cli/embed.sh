#!/bin/sh
# usage: embed.sh pages|commands   Writes C++ strings of texts beside the sources.
# pages: each page with its style sheets and scripts inside as two strings, the text before and the text after the line
# of data.js, where the program puts its data; and head.html, with which all pages begin, as a third string.
# Indentation and lines of comments are left out.
# commands: what commands take and what their help says (options/command_text.hpp).
# Each line is a short literal, as compilers limit the length of literals.
cd "$(dirname "$0")" || exit 1

of_page() {
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
        function between_quotes(line) { split(line, part, "\""); return "page/" part[2] }
        /^<script src="data.js">/ { print ","; next }
        /^<script src=/ { put("<script>"); put_file(between_quotes($0)); put("</script>"); next }
        /^<link href=/ { put("<style>"); put_file(between_quotes($0)); put("</style>"); next }
        { put($0) }' "page/$1.html"
}
pages() {
    printf '// Made by c_api/cli/embed.sh.\n#include "page/page_text.hpp"\n\nconst char cli::page_head[] =\n'
    of_page head || exit 1
    echo ';'
    for page in explore report; do
        printf '\nconst cli::PageText cli::%s_page = {\n' $page
        of_page $page || exit 1
        echo '};'
    done
}
commands() {
    printf '// Made by c_api/cli/embed.sh.\n#include "options/command_text.hpp"\n\n'
    echo 'const cli::EmbeddedText cli::command_texts[] = {'
    for text in commands/*.txt; do
        awk -v name="$(basename "$text" .txt)" '
            BEGIN { print "{\"" name "\"," }
            { print "R\"text(" $0; print ")text\"" }
            END { print "}," }' "$text" || exit 1
    done
    echo '{nullptr, nullptr}};'
}
case $1 in pages | commands) $1 ;; *) sed -n 2p "$0" >&2; exit 2 ;; esac
