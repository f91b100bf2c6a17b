#!/bin/sh
# usage: html.sh BUILD   (MAKE, PYTHON from the environment)
# The browsable manual: built without a warning, every header, call and page is in the manual and in the search, links
# lead to pages that are there, and nothing is loaded from elsewhere.
: "${MAKE:=make}" "${PYTHON:=/usr/bin/python3}"
build=$(cd "$1" && pwd)
dir=$build/html-test
topic="browsable manual" log=$dir.log
. "$(dirname "$0")/../count.sh"
mkdir -p "$dir"
check "make html" $MAKE -s BUILD="$build" PYTHON="$PYTHON" html
missing_calls() {
    for header in include/*.h; do
        page=$build/html/$header.page.html
        [ -f "$page" ] || echo "$header"
        sed -n 's/^HM_API .* \**\(hm_[a-z0-9_]*\)(.*/\1/p' "$header" | while read -r call; do
            grep -q "<h[23]>.*$call.*</h[23]>" "$page" || echo "$call"
        done
    done
}
missing_pages() {
    git ls-files '*README.md' | while read -r page; do [ -f "$build/html/${page%.md}.html" ] || echo "$page"; done
}
not_found() {   # words that the search must know: a call, a constant (its stem, as the search has stems), a header
    for word in hm_move_safe hm_conform harmorph_design.h; do
        grep -q "$word" "$build/html/searchindex.js" || echo "$word"
    done
}
from_elsewhere() {
    grep -rhoE '<(script|img|link|iframe)[^>]*(src|href)="https?:[^"]*"' "$build/html" --include=*.html
    grep -rhoE '(@import|url\()[^;)]*https?:[^;)]*' "$build/html/_static" --include=*.css
}
dead_links() {
    $PYTHON - "$build/html" <<'END'
import sys
from html.parser import HTMLParser
from pathlib import Path


class Page(HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.links, self.places = [], {""}
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.places.add(attributes.get("id"))
        if tag == "a" and ":" not in attributes.get("href", ":"):
            self.links.append(attributes["href"])


top = Path(sys.argv[1]).resolve()
pages = {path: Page(path) for path in top.rglob("*.html")}
for path, page in pages.items():
    for link in page.links:
        file, _, place = link.partition("#")
        target = (path.parent / file).resolve() if file else path
        if not target.exists() or target in pages and place not in pages[target].places:
            print(f"{path.relative_to(top)}: {link}")
END
}
is_empty "headers and calls without a heading" "$(missing_calls | head -20)"
is_empty "pages that are missing" "$(missing_pages | head -20)"
is_empty "words that the search does not know" "$(not_found)"
is_empty "files from another host" "$(from_elsewhere | head -5)"
is_empty "links that lead nowhere" "$(dead_links | sort -u | head -20)"
finish "$dir"
