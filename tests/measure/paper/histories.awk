# Draws lines "iteration,cycle,work,residual" as an SVG with two panels: the residual against cycles and against work.
# Colours tell the iterations apart, dashes mark directional agglomeration.
BEGIN {
    FS = ","
    width = 430; height = 260; left = 60; top = 40; across = 340; up = 200
    split("#000000 #0072b2 #d55e00 #009e73 #cc79a7", colours, " ")
}
{
    if (!($1 in first)) { first[$1] = NR; names[++n] = $1 }
    last[$1] = NR
    cycle[NR] = $2; work[NR] = $3; residual[NR] = $4
    if ($1 != "single grid" && $2 > most_cycles) most_cycles = $2
    if ($3 > most_work) most_work = $3
}
function colour(name,   kind) {
    kind = name
    sub(/ (iso|direc)[a-z]*$/, "", kind)
    if (!(kind in colour_of)) { colour_of[kind] = colours[++kinds]; kind_names[kinds] = kind }
    return colour_of[kind]
}
function curve(name, by_work,   k, x, y, at, path) {
    for (k = first[name]; k <= last[name]; ++k) {
        at = by_work ? work[k] / most_work : cycle[k] / most_cycles
        if (at > 1) break
        x = at * across
        y = -log(residual[k]) / log(10) * up / 11
        if (y < 0) y = 0
        path = path sprintf("%s%.1f %.1f", path == "" ? "M" : "L", x, y)
    }
    printf "<path fill=\"none\" stroke=\"%s\"%s d=\"%s\"/>\n", colour(name),
        name ~ /directional/ ? " stroke-dasharray=\"5 3\"" : "", path
}
function panel(number, label, most, by_work,   k) {
    printf "<g transform=\"translate(%d %d)\">\n<path fill=\"none\" stroke=\"#999\" d=\"M0 0V%dH%d\"/>\n",
        number * width + left, top, up, across
    for (k = 0; k <= 10; k += 2)
        printf "<text fill=\"#555\" text-anchor=\"end\" x=\"-6\" y=\"%.1f\">%s</text>\n", k * up / 11 + 4, k ? "1e-" k : "1"
    for (k = 0; k <= 4; ++k)
        printf "<text fill=\"#555\" text-anchor=\"middle\" x=\"%.1f\" y=\"%d\">%d</text>\n", k * across / 4, up + 16,
            k * most / 4 + .5
    printf "<text text-anchor=\"middle\" x=\"%d\" y=\"%d\">%s</text>\n", across / 2, up + 34, label
    for (k = 1; k <= n; ++k) curve(names[k], by_work)
    print "</g>"
}
END {
    printf "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" font-family=\"sans-serif\" font-size=\"12\">\n",
        2 * width, height + 60
    printf "<title>Convergence histories on %s</title>\n<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n", title
    panel(0, "cycles", most_cycles, 0)
    panel(1, "work, in Runge-Kutta steps on the finest mesh", most_work, 1)
    for (k = 1; k <= kinds; ++k)
        printf "<text fill=\"%s\" x=\"%d\" y=\"20\">%s</text>\n", colours[k], left + (k - 1) * 150, kind_names[k]
    print "</svg>"
}
