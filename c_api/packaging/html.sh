#!/bin/sh
# usage: html.sh BUILD   (PYTHON from the environment)
# Writes the browsable manual to BUILD/html: static pages with a search, which need no network. A warning of Sphinx is
# an error. Needs Sphinx and the MyST parser (Debian's python3-sphinx and python3-myst-parser).
: "${PYTHON:=/usr/bin/python3}"
$PYTHON -c 'import sphinx, myst_parser' 2>/dev/null || {
    echo "make html needs Sphinx and the MyST parser for $PYTHON:"
    echo "install Debian's python3-sphinx and python3-myst-parser"
    exit 1
}
HARMORPH_VERSION=$(sed -n 's/^#define HM_VERSION "\(.*\)"/\1/p' include/harmorph.h)
export HARMORPH_VERSION
here=$(dirname "$0")
rm -rf "$1/html" "$1/html-pages"
mkdir -p "$1/html-pages" && cp "$here/html/conf.py" "$here/html/captions.css" "$1/html-pages/" &&
    PYTHONDONTWRITEBYTECODE=1 $PYTHON "$here/html/pages.py" . "$1/html-pages" &&
    $PYTHON -m sphinx -q -W --keep-going -E -b html -d "$1/html-pages/.doctrees" "$1/html-pages" "$1/html" &&
    rm -rf "$1/html-pages" "$1/html/.buildinfo" && echo "$1/html/index.html"
