#!/bin/sh
# usage: check_build.sh BUILD   (called by make before anything is written to BUILD or removed there)
# The rules of make name files below BUILD. A name in a rule cannot have blanks, quotes, dollar signs and the like, and
# a shell would divide them: `rm -rf parent/my build` removes two folders.
build=$1
odd=$(printf '%s' "$build" | LC_ALL=C tr -d 'A-Za-z0-9_./+,@\200-\377-')
case $build in
"") reason="has no name" ;;
-*) reason="begins with a hyphen" ;;
*)
    [ -n "$odd" ] || exit 0
    reason="has characters that make cannot have in rules: $odd" ;;
esac
printf '%s\n' "The folder BUILD, \"$build\", $reason" \
    "Choose a name of letters, digits and _ . / + , @ -; the folder of the sources may have any name." >&2
exit 1
