# usage: awk -f read_curves.awk FILE
# A small reader of B-spline curves, written after the formats' descriptions and not after the program: entity 126 of IGES,
# B_SPLINE_CURVE_WITH_KNOTS of STEP, and the program's own text. What it finds, one number on a line, to be compared: of each
# curve its degree, knots, and x, y, weight of the control points it uses in turn.
function number(text) { gsub(/[Dd]/, "E", text); return sprintf("%.17g", text + 0) }
function show(label, value) { print label, number(value) }

# IGES: columns 1-64 of the lines whose 73rd is P; parameters between commas, a record ends with a semicolon.
function read_iges(text,    record, n_records, r, p, k, degree, m, at) {
    n_records = split(text, record, ";")
    for (r = 1; r < n_records; r++) {
        gsub(/[ \t\n]/, "", record[r])
        split(record[r], p, ",")
        if (p[1] != 126) { print "an entity of another kind: " p[1]; continue }
        k = p[2]; degree = p[3]; at = 8
        show("degree", degree)
        for (m = 0; m <= k + degree + 1; m++) show("knot", p[at++])
        for (m = 0; m <= k; m++) weight[m] = p[at++]
        for (m = 0; m <= k; m++) { show("x", p[at]); show("y", p[at + 1]); show("weight", weight[m]); at += 3 }
        if (number(p[at]) != number(p[8 + degree]) || number(p[at + 1]) != number(p[8 + k + 1])) print "range"
    }
}

# STEP: records #n=KEYWORD(...); lists in parentheses.
function list(text, key,    from, depth, i, c) { # the arguments of the first KEY(...)
    from = index(text, key "(")
    if (!from) return ""
    from += length(key) + 1
    depth = 1
    for (i = from; depth > 0 && i <= length(text); i++) {
        c = substr(text, i, 1)
        depth += (c == "(") - (c == ")")
    }
    return substr(text, from, i - from - 1)
}
function brackets(text, which,    i, c, depth, begin, n) { # the which-th list inside, without its parentheses
    depth = 0
    for (i = 1; i <= length(text); i++) {
        c = substr(text, i, 1)
        if (c == "(" && ++depth == 1) begin = i + 1
        if (c == ")" && --depth == 0 && ++n == which) return substr(text, begin, i - begin)
    }
    return ""
}
function read_step(text,    record, n_records, r, name, body, points, n, i, part, head, spans, w, nw, times, value, m) {
    gsub(/[ \t\n]/, "", text)
    n_records = split(text, record, ";")
    for (r = 1; r <= n_records; r++) {
        if (record[r] !~ /^#/) continue
        name = substr(record[r], 1, index(record[r], "=") - 1)
        body = substr(record[r], index(record[r], "=") + 1)
        if (body ~ /^CARTESIAN_POINT/) place[name] = brackets(list(body, "CARTESIAN_POINT"), 1)
        if (body !~ /B_SPLINE_CURVE/) continue
        nw = 0
        if (body ~ /RATIONAL_B_SPLINE_CURVE/) {
            head = list(body, ")B_SPLINE_CURVE"); spans = list(body, "B_SPLINE_CURVE_WITH_KNOTS")
            nw = split(brackets(list(body, "RATIONAL_B_SPLINE_CURVE"), 1), w, ",")
            degree = head
        } else {
            head = list(body, "B_SPLINE_CURVE_WITH_KNOTS")
            degree = substr(head, index(head, ",") + 1)
            spans = substr(head, index(head, ")") + 1)
        }
        sub(/,.*/, "", degree)
        show("degree", degree)
        split(brackets(spans, 1), times, ",")
        n = split(brackets(spans, 2), value, ",")
        for (i = 1; i <= n; i++) for (m = 0; m < times[i]; m++) show("knot", value[i])
        n = split(brackets(head, 1), points, ",")
        for (i = 1; i <= n; i++) {
            split(place[points[i]], part, ",")
            show("x", part[1]); show("y", part[2]); show("weight", nw ? w[i] : 1)
        }
    }
}

# The program's text: words in order.
function finish(    n, i) {
    if (degree == "") return
    n = n_indices
    if (!n) {
        n = n_points + (closed == "tied" ? 1 : closed == "periodic" ? degree : 0)
        for (i = 1; i <= n; i++) used[i] = (i - 1) % n_points + 1
    }
    show("degree", degree)
    for (i = 1; i <= n_knots; i++) show("knot", knot[i])
    for (i = 1; i <= n; i++) { show("x", px[used[i]]); show("y", py[used[i]]); show("weight", n_weights ? pw[used[i]] : 1) }
    n_indices = 0
}
function read_text(text,    word, n, i, k) {
    gsub(/#[^\n]*/, "", text)
    n = split(text, word, /[ \t\n]+/)
    for (i = 1; i <= n; i++) {
        if (word[i] == "degree") degree = word[++i]
        else if (word[i] == "closed") closed = word[++i]
        else if (word[i] == "curve") finish()
        else if (word[i] == "points") { n_points = word[++i]; for (k = 1; k <= n_points; k++) { px[k] = word[++i]; py[k] = word[++i] } }
        else if (word[i] == "weights") { n_weights = word[++i]; for (k = 1; k <= n_weights; k++) pw[k] = word[++i] }
        else if (word[i] == "indices") { n_indices = word[++i]; for (k = 1; k <= n_indices; k++) used[k] = word[++i] }
        else if (word[i] == "knots") { n_knots = word[++i]; for (k = 1; k <= n_knots; k++) knot[k] = word[++i] }
    }
    finish()
}

{ all = all $0 "\n"; if (length($0) == 80 && substr($0, 73, 1) == "P") iges = iges substr($0, 1, 64) }
END {
    if (iges != "") read_iges(iges)
    else if (all ~ /^ISO-10303-21;/) read_step(all)
    else read_text(all)
}
