# From the output of a command to a page of its figures and tables; the form of the output is described in figures.sh.
function escaped(text) { gsub(/&/, "\\&amp;", text); gsub(/</, "\\&lt;", text); gsub(/>/, "\\&gt;", text); return text }
function end_text() { if (in_text) print "</pre>"; in_text = 0 }
function end_section(    i) {
    end_text()
    if (figures > 0) print "<div class=\"figures\">"
    for (i = 1; i <= figures; i++) {
        printf "<figure id=\"figure-%d\"><a href=\"%s\"><img src=\"%s\" alt=\"%s\" loading=\"lazy\"></a>\n", ++number, file[i], file[i], title
        printf "<figcaption><b>Figure %d.</b> %s</figcaption></figure>\n", number, caption[i]
    }
    if (figures > 0) print "</div>"
    if (in_section) print "</section>"
    figures = in_section = 0
}
BEGIN {
    title = escaped(title)
    print "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">"
    print "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>" title "</title>\n<style>"
    print ":root { color-scheme: light dark; --paper: #fff; --ink: #1d1d1f; --faint: #5c5c62; --line: #d4d4d8; --table: #f5f5f7 }"
    print "@media (prefers-color-scheme: dark) {"
    print "    :root { --paper: #17181b; --ink: #e8e8ea; --faint: #a4a4ac; --line: #3a3b40; --table: #212226 } }"
    print "body { margin: 2rem auto; max-width: 84rem; padding: 0 1.5rem; background: var(--paper); color: var(--ink);"
    print "    font: 16px/1.5 Helvetica, Arial, sans-serif }"
    print "h2 { margin-top: 2.5rem; border-top: 1px solid var(--line); padding-top: 1rem; font-size: 1.2rem }"
    print "pre { overflow-x: auto; padding: .8rem 1rem; background: var(--table); border-radius: 6px; font-size: 13px; line-height: 1.45 }"
    print ".figures { display: grid; grid-template-columns: repeat(auto-fill, minmax(min(100%, 34rem), 1fr)); gap: 1.5rem }"
    print "figure { margin: 0 } figcaption { color: var(--faint); font-size: .9rem; margin-top: .3rem }"
    print "img { width: 100%; height: auto; background: #fff; border: 1px solid var(--line); border-radius: 6px }" # as drawn: on white
    print "</style>\n</head>\n<body>\n<h1>" title "</h1>"
}
/^== / {
    end_section()
    print "<section>\n<h2>" escaped(substr($0, 4)) "</h2>"
    in_section = 1
    next
}
/^figure / {
    file[++figures] = escaped($2)
    text = $0
    sub(/^figure [^ ]* /, "", text)
    caption[figures] = escaped(text)
    next
}
!in_text && /^ *$/ { next }
!in_text { print "<pre>"; in_text = 1 }
{ print escaped($0) }
END { end_section(); print "</body>\n</html>" }
