#!/bin/sh
# usage: embed.sh >command_text.cpp
# Writes what commands take and what their help says (options/command_text.hpp) as C++ strings. Each line is a short
# literal, as compilers limit the length of literals.
cd "$(dirname "$0")" || exit 1
printf '// Made by c_api/cli/commands/embed.sh.\n#include "options/command_text.hpp"\n\n'
echo 'const cli::EmbeddedText cli::command_texts[] = {'
for text in *.txt; do
    awk -v name="${text%.txt}" '
        BEGIN { print "{\"" name "\"," }
        { print "R\"text(" $0; print ")text\"" }
        END { print "}," }' "$text" || exit 1
done
echo '{nullptr, nullptr}};'
