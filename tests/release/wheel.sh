#!/bin/sh
# usage: wheel.sh WHEEL FOLDER   (PYTHON, HARMORPH_MESHES, HARMORPH_PROGRAM from the environment)
# A wheel file in a new environment, in FOLDER, which sees the numpy and cffi of the system: pip installs the wheel with
# an empty path of programs, so without a compiler, and without an index of packages; then the program of README and all
# tests of the package run on what was installed. Needs venv and pytest.
: "${PYTHON:=/usr/bin/python3}"
wheel=$1 source=$(pwd)
mkdir -p "$2"
dir=$(cd "$2" && pwd)/wheel-test
topic=wheel log=$dir/log
. "$(dirname "$0")/../count.sh"
rm -rf "$dir"
mkdir -p "$dir/work"
export PYTHONDONTWRITEBYTECODE=1
package=$source/c_api/python
python=$dir/env/bin/python

check "an environment" "$PYTHON" -m venv --system-site-packages "$dir/env"
absent() { ! (cd "$dir/work" && "$python" -c 'import harmorph'); }
check "harmorph is not in it before" absent
for_all_pythons() { case $wheel in *-cp39-abi3-*.whl) ;; *) echo "$wheel"; return 1 ;; esac; }
check "the name of the file is for every CPython from 3.9 on" for_all_pythons
small() { [ "$(wc -c <"$wheel")" -le 3000000 ] || { ls -l "$wheel"; return 1; }; }
check "at most 3 MB" small
check "pip installs it without index and compiler" env -i PATH="$dir/env/bin" "$python" -m pip install -q --no-index \
    --no-cache-dir "$wheel"
is_inside() {
    cd "$dir/work" && "$python" -c "import harmorph, os
assert os.path.realpath(harmorph.__file__).startswith(os.path.realpath('$dir/env')), harmorph.__file__
assert os.path.isfile(os.path.join(os.path.dirname(harmorph.__file__), 'py.typed'))"
}
check "Python finds it there" is_inside
# Names of a run-time library of C++ inside, if other extensions saw them, would join two versions of this library.
one_name() {
    names=$(nm -D --defined-only "$dir"/env/lib/python3*/site-packages/harmorph/_native*.so | awk '{ print $NF }')
    [ "$names" = PyInit__native ] || { echo "$names" | head; return 1; }
}
if command -v nm >/dev/null; then check "the extension exports its beginning alone" one_name; fi
cp "$package/examples/morph.py" "$dir/work"
program() { cd "$dir/work" && "$python" morph.py | grep "^0 inverted cells; the mesh could follow"; }
check "the program of README" program
first_morph() {   # of the mesh in the wheel, by the program of the page that the wheel contains
    cd "$dir/work" && "$python" -c "from importlib import metadata
print(metadata.metadata('harmorph').get_payload() or metadata.metadata('harmorph')['Description'])" >page &&
        awk '/^```/ { if (text ~ /naca0012/) exit; text = ""; inside = /python/; next } inside { text = text $0 "\n" }
            END { printf "%s", text }' page >first.py && "$python" first.py | grep '^0 inverted cells in morphed.su2'
}
check "the program of the wheel's page, on the mesh of the wheel" first_morph

# pytest's last line is "293 passed, 2 skipped in 13.09s"; tests that are skipped are named with their reasons.
(cd "$dir/work" && MPLBACKEND=agg "$python" -m pytest -q -rs \
    --tb=short -p no:cacheprovider -c "$package/pyproject.toml" --rootdir "$package" "$package/tests") >"$log" 2>&1
status=$?
last=$(tail -n 1 "$log")
number() { echo "$last" | sed -n "s/.*[^0-9]*\\b\\([0-9][0-9]*\\) $1.*/\\1/p" | grep . || echo 0; }
passed=$((passed + $(number passed)))
wrong=$(($(number failed) + $(number error)))
if [ $status != 0 ] || [ $wrong -gt 0 ]; then
    fail "pytest" "$log"
    failed=$((failed + wrong - (wrong > 0)))
fi
skipped=$((skipped + $(number skipped)))
sed -n 's/^SKIPPED \[[0-9]*\] [./]*/skipped: /p' "$log"
finish "$dir"
