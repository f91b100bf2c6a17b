# awk -f named.awk page: what a page names in backticks, one a line, with what it must be: "file NAME" (a path, or the
# beginning of the paths of a header and its source), or "word NAME" (a name in the sources).
{
    while (match($0, /`[^`]+`/)) {
        name = substr($0, RSTART + 1, RLENGTH - 2)
        $0 = substr($0, RSTART + RLENGTH)
        if (name ~ /[A-Z*<>$ ]*[*<>$ ]/ || name ~ /^[A-Z]+$/) continue  # patterns, commands
        if (name ~ /\// || name ~ /\.(c|h|cpp|hpp|sh|js|md|txt|f90|f90\.in)$/) { print "file", name; continue }
        sub(/\(.*/, "", name)
        sub(/.*::/, "", name)
        sub(/.*\./, "", name)
        if (name ~ /^[A-Za-z_][A-Za-z_0-9]*$/) print "word", name
    }
}
