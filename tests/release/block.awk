# usage: awk -v language=sh -v heading=TEXT [-v wanted=N] [-v seen=FILE] -f block.awk PAGE
# Prints the first (or Nth) block of the language under this heading of a page. `seen`: notes there the page, the
# language and the number of the block among all blocks of the language.
BEGIN { if (!wanted) wanted = 1 }
/^```/ && inside { inside = taken = 0; next }
/^```/ {
    inside = 1
    if ($0 == "```" language) {
        ++all
        if (under && ++n == wanted) {
            taken = found = 1
            if (seen) print FILENAME, language, all >>seen
        }
    }
    next
}
!inside && /^#+ / { under = substr($0, index($0, " ") + 1) == heading }
taken
END { if (!found) { print FILENAME " " language ": no block under " heading | "cat >&2"; exit 1 } }
