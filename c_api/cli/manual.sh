#!/bin/sh
# usage: manual.sh PROGRAM VERSION FILE   Writes the page harmorph(1), made of what the program says with --help.
program=$1
exec >"$3" || exit 1
page() {   # how to set the sections of a help text
    awk -v level="$1" '
    function safe(text) {
        gsub(/\\/, "\\e", text)
        gsub(/-/, "\\-", text)
        sub(/^[.'"'"']/, "\\\\\\&&", text)
        return text
    }
    function close_example() { if (verbatim) print ".fi"; verbatim = 0 }
    NR == 1 && level == "SS" { sub(/^Usage: /, ""); print ".PP\n.B " safe($0); next }
    /^[A-Z][A-Za-z ]*:$/ {
        close_example()
        sub(/:$/, "")
        print (level == "SS" ? ".PP\n.I " $0 : ".SH " toupper($0))
        verbatim = /Examples|Usage/
        if (verbatim) print ".nf"
        next
    }
    /^Usage: / { close_example(); sub(/^Usage: /, ""); print ".SH SYNOPSIS\n.B " safe($0); next }
    /^  [a-z]+ [A-Z]/ && level == "SH" { print ".TP\n.B " $1; sub(/^  [a-z]+ /, ""); print safe($0); next }
    verbatim && NF { print safe($0); next }
    /^  [^ ]/ && match(substr($0, 3), /  +/) {
        print ".TP\n.B " safe(substr($0, 3, RSTART - 1))
        print safe(substr($0, 2 + RSTART + RLENGTH))
        next
    }
    /^  [^ ]/ { print ".TP\n.B " safe(substr($0, 3)); next }
    /^ / { sub(/^ +/, ""); print safe($0); next }
    !NF { close_example(); print ".PP"; next }
    { print safe($0) }
    END { close_example() }'
}
printf '.TH HARMORPH 1 "" "harmorph %s" "User Commands"\n.SH NAME\n' "$2"
printf 'harmorph \\- morphs an airfoil and its CFD mesh together\n.SH DESCRIPTION\n'
"$program" --help | page SH
echo '.SH COMMANDS IN DETAIL'
"$program" --help | sed -n '/^Commands:/,/^$/s/^  \([a-z]*\) .*/\1/p' | while read -r command; do
    echo ".SS harmorph $command"
    "$program" "$command" --help | page SS
done
