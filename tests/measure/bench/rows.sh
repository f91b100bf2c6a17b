#!/bin/sh
# `make bench-rows`: rows of the tables in tests/measure/bench/README.md, some of which README.md repeats: measures (a
# quarter of an hour on a calm machine) and leaves the whole output in $BUILD/bench/rows.txt. FILE=output only prints
# the rows of a saved output.
: "${BUILD:=build}" "${FILE:=}"
set -e
if [ -z "$FILE" ]; then
    FILE=$BUILD/bench/rows.txt
    mkdir -p "$BUILD/bench"
    PARTS="solve morph" KINDS=iso SIZES="10000 100000 1000000" FUNCTIONS="20 60" THREADS=1 \
        BUILD="$BUILD" sh tests/measure/bench/run.sh >"$FILE"
fi
# Numbers stand behind names of one or more words: rows are read from their ends. iso 1.0M are two words.
awk '
BEGIN {
    print "Rows of tests/measure/bench/README.md; those with 20 functions also stand in README.md, What a call takes."
}
function row(    k, text) { text = "|"; for (k = 1; k <= n; ++k) text = text " " cell[k] " |"; print text }
function cells(a, b, c, d, e, f, g, h, i) {
    n = split(a "\t" b "\t" c "\t" d "\t" e "\t" f "\t" g "\t" h "\t" i, cell, "\t")
    while (n > 0 && cell[n] == "") --n
    row()
}
function head(text) { print ""; print text; print ""; section = text }
function rule(    k, text) { text = "|"; for (k = 1; k <= n; ++k) text = text "---|"; print text }
/^(machine|date|compiler):/ { print }
/^reading 1280 MiB/ { print "reading: " $(NF - 1) " " $NF }
/^Ordering, symbolic pass/ {
    head("Ordering, symbolic pass, factorisation, solution [s]:")
    cells("mesh", "functions", "harmorph", "peer", "its time", "ratio", "bytes a point", "of the peer"); rule(); next
}
/^Our phases/ {
    head("Structure and assembly beside them:")
    cells("mesh", "functions", "% of the whole"); rule(); next
}
/^Morph and adjoint/ {
    head("Morph and adjoint [ms]:")
    cells("", "mesh", "operator", "functions", "pages", "time", "% of reading"); rule(); next
}
/^Functions in single precision/ { head("Double against single precision [ms]:")
    cells("", "mesh", "functions", "double", "single", "ratio", "% of reading"); rule(); next }
/^Admissible step and quality/ { head("hm_assess: admissible step, quality, both [ms]:")
    cells("mesh", "morph", "step", "quality", "both", "ns/cell", "both / morph"); rule(); next }
$1 == "what" || $1 == "mesh" { next }
/^  / { next }   # notes below a table
/^[A-Z]/ || /^\.\.\./ { section = "" }
section ~ /^Ordering/ && NF >= 14 {
    peer = $5; for (k = 6; k <= NF - 9; ++k) peer = peer " " $k
    cells($1 " " $2, $3, $4, peer, $(NF - 5), $(NF - 4), $(NF - 3), $(NF - 2))
}
section ~ /^Structure/ && NF == 15 { cells($1 " " $2, $4, $(NF - 3)) }
section ~ /^Morph/ && NF == 12 { cells($1, $2 " " $3, $4, $5, $6 " " $7, $8, $12) }
section ~ /^Double/ && NF == 10 { cells($1, $2 " " $3, $4, $5, $6, $7, $10) }
section ~ /^hm_adm/ && NF == 9 { cells($1 " " $2, $4, $5, $6, $7, $8, $9) }' "$FILE"
