#!/bin/sh
# usage: check_build.sh BUILD [remove]   (called by make before anything is written to BUILD, or before it is removed)
# The rules of make name files below BUILD. A name in a rule cannot have blanks, quotes, dollar signs and the like, and
# a shell would divide them: `rm -rf parent/my build` removes two folders.
build=$1
odd=$(printf '%s' "$build" | LC_ALL=C tr -d 'A-Za-z0-9_./+,@\200-\377-')
case $build in
"") reason="has no name" ;;
-*) reason="begins with a hyphen" ;;
. | .. | ./ | ../ | include | src | c_api | fortran | tests | .ci | .git | \
    include/* | src/* | c_api/* | fortran/* | tests/* | .ci/* | .git/*)
    reason="is a folder of the sources" ;;
*)
    if [ -n "$odd" ]; then
        reason="has characters that make cannot have in rules: $odd"
    elif [ "$2" = remove ] && [ -n "$(ls -A "$build" 2>/dev/null)" ] && [ ! -f "$build/flags" ]; then
        # Only what make has made is removed: every build has this file.
        echo "The folder BUILD, \"$build\", has no file flags, so no build has made it: it is not removed" >&2
        exit 1
    else
        exit 0
    fi ;;
esac
printf '%s\n' "The folder BUILD, \"$build\", $reason" \
    "Choose a name of letters, digits and _ . / + , @ -; the folder of the sources may have any name." >&2
exit 1
