# usage: awk -f signatures.awk PARTS   (by join.sh)
# Writes comment lines with the arguments of every public call of the module, optional ones in brackets, with the ranks
# of arrays. Forms of one call that have the same arguments are one line; (..) stands for the ranks of several forms.
function trim(text) { gsub(/^[ \t]+|[ \t]+$/, "", text); return text }
function statement(    line, more) {   # the next statement without comment, its continuations joined
    line = $0
    sub(/[ \t]*!.*/, "", line)
    while (line ~ /&[ \t]*$/ && (getline more) > 0) {
        sub(/[ \t]*!.*/, "", more)
        sub(/&[ \t]*$/, "", line)
        line = line trim(more)
    }
    return trim(line)
}
function plural(named) { sub(/[)]$/, "s)", named); return named }
function bind(name, list,    one, k, n) {
    n = split(list, one, ",")
    for (k = 1; k <= n; ++k) bound[++bounds] = type SUBSEP name SUBSEP trim(one[k])
}
function declare(line,    attributes, names, depth, k, c, name, shape) {   # ranks, and which arguments are optional
    attributes = substr(line, 1, index(line, "::") - 1)
    names = substr(line, index(line, "::") + 2) ","
    for (k = 1; k <= length(names); ++k) {
        c = substr(names, k, 1)
        if (c == "(") ++depth
        if (c == ")") --depth
        if (c == "," && !depth) {
            name = trim(name)
            shape = ""
            if (match(name, /[(@].*/)) { shape = substr(name, RSTART); name = substr(name, 1, RSTART - 1) }
            if (match(attributes, /dimension\([^)]*\)/)) shape = substr(attributes, RSTART + 9, RLENGTH - 9)
            sub(/@SHAPE@/, "(..)", shape)
            rank[routine, name] = shape
            optional[routine, name] = attributes ~ /optional/
            if (match(attributes, /type\(hm_[a-z_]*\)/)) of_type[routine, name] = substr(attributes, RSTART, RLENGTH)
            name = ""
        } else name = name c
    }
}
FNR == 1 { type = ""; routine = "" }
{ line = statement() }
line ~ /^type(, *public)? *::/ {
    type = line; sub(/.*:: */, "", type)
    if (line ~ /public/ && type ~ /^hm_/) shown[type] = ++types
}
line ~ /^end type/ { type = "" }
type && line ~ /^(procedure|generic)[^:]*:: *[a-z_]+ *=>/ && line !~ /private/ {
    name = line; sub(/.*:: */, "", name); sub(/ *=>.*/, "", name)
    sub(/.*=> */, "", line)
    bind(name, line)
    next
}
line ~ /^interface hm_[a-z_]+$/ { called = line; sub(/.* /, "", called); next }
line ~ /^end interface/ { called = "" }
called && line ~ /^procedure *:: / { list = line; sub(/.*:: */, "", list); type = ""; bind(called, list); next }
type && line ~ /^procedure *:: *[a-z_]+ *$/ { sub(/.*:: */, "", line); bind(line, line); next }
line ~ /^(pure |elemental |recursive )*(subroutine|([a-z0-9_]*(\([a-z0-9_, ]*\))? )?function) / {
    is_function = line !~ /^[a-z ]*subroutine /
    routine = line
    if (is_function) sub(/^[a-z0-9_(), ]*function +/, "", routine)
    else sub(/^[a-z ]*subroutine +/, "", routine)
    arguments = routine
    sub(/\(.*/, "", routine)
    routine = trim(routine)
    sub(/^[^(]*\(/, "", arguments); sub(/\).*/, "", arguments)
    dummy[routine] = arguments
    function_of[routine] = is_function
    next
}
line ~ /^end (subroutine|function)/ { routine = "" }
routine && line ~ /::/ { declare(line) }
END {
    for (k = 1; k <= bounds; ++k) {
        split(bound[k], part, SUBSEP)
        if (part[1] && !(part[1] in shown) || part[2] == "assignment(=)" || !(part[3] in dummy)) continue
        if (part[2] ~ /address$|^room$|^take$/) continue   # for other modules of harmorph
        object = part[1] ? part[1] "%" : ""; sub(/^hm_/, "", object)
        text = (function_of[part[3]] ? "n = " : "call ") object part[2] "("
        n = split(dummy[part[3]], argument, ","); more = ""; closing = ""; notes = ""
        for (i = 1; i <= n; ++i) {
            a = trim(argument[i])
            if (a == "self" || a == "stat" || a == "err") continue
            word = a rank[part[3], a]
            named = of_type[part[3], a]
            if (named && "type(hm_" a ")" != named && "type(hm_" a ")" != plural(named)) notes = notes (notes ? "; " : "") named " :: " a
            if (optional[part[3], a] && !closing) { more = more (more ? " [, " : "[") word; closing = "]" }
            else more = more (more && more != "[" ? ", " : "") word
            if (!optional[part[3], a] && closing) { closing = ""; sub(/ \[, /, ", ", more) }
        }
        text = text more closing ")"
        if (!seen[text]++) { order[++lines] = text; note[lines] = notes }
    }
    for (k = 1; k <= lines; ++k) {
        text = order[k]; head = "!     "
        while (length(head text) > 118) {
            for (i = 118 - length(head); i > 0 && substr(text, i, 2) != ", "; --i) { }
            if (i <= 0) break
            print head substr(text, 1, i)
            text = substr(text, i + 2); head = "!         "
        }
        if (note[k] && length(head text note[k]) < 112) text = text "    " note[k]
        print head text
        if (note[k] && index(text, note[k]) == 0) {
            n = split(note[k], one, "; ")
            for (i = 1; i <= n; ++i) print "!         " one[i]
        }
    }
}
