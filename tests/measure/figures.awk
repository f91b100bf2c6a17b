# From the output of a command to a page of its figures and tables; the form of the output is described in figures.sh.
function escaped(text) {
    gsub(/&/, "\\&amp;", text); gsub(/</, "\\&lt;", text); gsub(/>/, "\\&gt;", text); gsub(/"/, "\\&quot;", text)
    return text
}
function first_sentence(text) { return match(text, /[.:;] /) ? substr(text, 1, RSTART - 1) : text }
function end_remark() {
    if (in_remark) print "</p>"
    in_remark = 0
}
function end_table() {
    if (in_table) print "</tbody></table></div>"
    in_table = headed = 0
}
function row(line, kind,    cell, n, i) {
    sub(/^ +/, "", line); sub(/ +$/, "", line)
    n = split(line, cell, /   *| *\| */)
    if (kind == "th") columns = n
    printf "<tr>"
    if (kind == "td" && n == 1 && columns > 1) printf "<td class=\"remark\" colspan=\"%d\">%s</td>", columns, escaped(cell[1])
    else for (i = 1; i <= n; i++) {
        if (kind == "th") printf "<th scope=\"col\">%s</th>", escaped(cell[i])
        else printf "<td%s>%s</td>", cell[i] ~ /^[-+.0-9]/ ? " class=\"number\"" : "", escaped(cell[i])
    }
    print "</tr>"
}
function end_section(    i) {
    end_table()
    end_remark()
    if (figures > 0) print "<div class=\"figures\">"
    for (i = 1; i <= figures; i++) {
        if (label[i] == "") label[i] = "Figure " ++number
        printf "<figure><a href=\"%s\"><img src=\"%s\" alt=\"%s\" loading=\"lazy\"></a>\n", file[i], file[i], \
            first_sentence(caption[i])
        printf "<figcaption><b>%s.</b> %s</figcaption></figure>\n", label[i], caption[i]
    }
    if (figures > 0) print "</div>"
    if (in_section) print "</section>"
    figures = in_section = 0
}
BEGIN {
    title = escaped(title)
    print "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">"
    print "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" title "</title>\n<style>"
    print ":root { color-scheme: light dark; --paper: #fff; --ink: #1d1d1f; --faint: #5c5c62; --line: #d4d4d8; --soft: #f5f5f7 }"
    print "@media (prefers-color-scheme: dark) {"
    print "    :root { --paper: #17181b; --ink: #e8e8ea; --faint: #a9a9b2; --line: #3a3b40; --soft: #222328 } }"
    print "body { margin: 2rem auto; max-width: 88rem; padding: 0 1.5rem; background: var(--paper); color: var(--ink);"
    print "    font: 17px/1.5 Helvetica, Arial, sans-serif }"
    print "h1 { font-size: 1.9rem; letter-spacing: -.01em } p { max-width: 60rem; margin: .4rem 0 }"
    print "h2 { margin-top: 3rem; border-top: 1px solid var(--line); padding-top: 1rem; font-size: 1.3rem }"
    print ".table { overflow-x: auto; margin: 1.2rem 0 } table { border-collapse: collapse; font-size: .88rem }"
    print "caption { text-align: left; font-weight: bold; padding-bottom: .4rem; max-width: 60rem }"
    print "th, td { padding: .25rem .9rem .25rem 0; border-bottom: 1px solid var(--line); text-align: left; white-space: nowrap }"
    print "th { border-bottom: 2px solid var(--line); vertical-align: bottom } tbody tr:hover { background: var(--soft) }"
    print ".number { font-variant-numeric: tabular-nums } .remark { white-space: normal; color: var(--faint) }"
    print ".figures { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 36rem), 1fr));"
    print "    gap: 2rem 1.5rem; margin-top: 1.5rem; align-items: start }"
    print "figure { margin: 0 } figcaption { color: var(--faint); font-size: .95rem; margin-top: .4rem }"
    print "figcaption b { color: var(--ink) }"
    print "img { display: block; width: 100%; height: auto; background: #fff; border: 1px solid var(--line); border-radius: 6px }"
    print "@media print { section { break-inside: avoid-page } }"
    print "</style>\n</head>\n<body>\n<h1>" title "</h1>"
}
/^== / {
    end_section()
    print "<section>\n<h2>" escaped(substr($0, 4)) "</h2>"
    in_section = 1
    next
}
/^figure / {
    end_remark()
    file[++figures] = escaped($2)
    text = $0
    sub(/^figure [^ ]* /, "", text)
    at = index(text, " | ")
    label[figures] = at ? escaped(substr(text, 1, at - 1)) : ""
    caption[figures] = escaped(at ? substr(text, at + 3) : text)
    next
}
/^table / {
    end_table()
    end_remark()
    print "<div class=\"table\"><table><caption>" escaped(substr($0, 7)) "</caption>"
    in_table = 1
    next
}
/^ *$/ { end_table(); end_remark(); next }
in_table && !headed { print "<thead>"; row($0, "th"); print "</thead><tbody>"; headed = 1; next }
in_table { row($0, "td"); next }
/^ / || !in_remark { end_remark(); printf "<p>"; in_remark = 1 }
{ sub(/^ +/, ""); print escaped($0) }
END { end_section(); print "</body>\n</html>" }
