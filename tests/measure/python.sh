#!/bin/sh
# usage: python.sh BUILD SCRIPT ARGUMENTS...   Runs a measurement in Python (PYTHON, /usr/bin/python3 unless set) with
# the Python package, which is linked with the library of BUILD and left in BUILD/measure. The word "skipped" in the
# output says that a Python package is missing.
build=$(cd "$1" && pwd) && script=$2 && shift 2 || exit 2
: "${PYTHON:=/usr/bin/python3}"
imports=$(sed -nE 's/^(from|import) (scipy|matplotlib).*/\2/p; s/^(from|import) (shared|reference).*/scipy/p' "$script" | sort -u)
for package in numpy cffi setuptools $imports; do
    $PYTHON -c "import $package" 2>/dev/null || { echo "skipped: $PYTHON has no $package"; exit 0; }
done
# The package is made anew after a change of the library or of the package.
made=$build/measure/lib
if [ ! -d "$made" ] || [ -n "$(find "$build/libharmorph.a" c_api/python -newer "$made")" ]; then
    rm -rf "$build/measure" && mkdir "$build/measure" || exit 2
    (cd c_api/python && HARMORPH_BUILD=$build/measure/build HARMORPH_LIBRARY=$build/libharmorph.a \
        $PYTHON setup.py -q build --build-lib "$made") >"$build/measure/log" 2>&1 ||
        { cat "$build/measure/log"; exit 2; }
    touch "$made"
fi
PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=$made:tests/measure:tests/measure/improve:$PYTHONPATH MPLBACKEND=svg \
    exec $PYTHON -W ignore::UserWarning "$script" "$@"
