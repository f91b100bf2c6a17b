#!/bin/sh
# usage: module.sh REASON [MODULE] >page_module.cpp
# Writes the module for WebAssembly as text for pages: compressed, in base 64. Without a module, writes why the program
# has none, which the file REASON says.
reason=$1 module=$2
quoted() { sed 's/["\\]/\\&/g; s/.*/    "&"/'; }
printf '// Made by c_api/cli/page/module.sh.\n#include "page/page_text.hpp"\n\nconst char cli::page_module[] =\n'
if [ -n "$module" ]; then gzip -9 -n -c "$module" | base64 | fold -w 100 | quoted; else echo '    ""'; fi
printf ';\nconst char cli::no_page_module[] =\n'
quoted <"$reason"
echo ';'
