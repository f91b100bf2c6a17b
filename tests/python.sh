#!/bin/sh
# usage: python.sh BUILD   (PYTHON, MAKE, CXX from the environment; after `make`)
# The Python package: all its tests by pytest, on an extension that is linked with the library of BUILD; then a source
# distribution and a wheel that is built from it, offline, installed in a virtual environment in another folder, and the
# program of README run there. Sources of the extension and of the wheel are compiled without optimisation: what they
# compute is the same.
: "${PYTHON:=/usr/bin/python3}" "${CXX:=c++}"
build=$(cd "$1" && pwd)
source=$(pwd)
dir=$build/python-test
topic=Python log=$dir/log
. "$(dirname "$0")/count.sh"
rm -rf "$dir"
mkdir -p "$dir/work"
PYTHONDONTWRITEBYTECODE=1 HARMORPH_BUILD=$dir/build
export PYTHONDONTWRITEBYTECODE HARMORPH_BUILD CXX
package=$source/c_api/python

extension_alone() (
    cd "$package" && HARMORPH_LIBRARY=$build/libharmorph.a CXXFLAGS=-O0 \
        $PYTHON setup.py -q build --build-lib "$dir/lib"
)
check "the extension, linked with the library" extension_alone

# pytest's last line is "293 passed, 2 skipped in 13.09s"; tests that are skipped are named with their reasons.
(cd "$dir/work" && PYTHONPATH=$dir/lib HARMORPH_MESHES=$build/meshes \
    HARMORPH_PROGRAM=$build/harmorph MPLBACKEND=agg $PYTHON -m pytest -q -rs \
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

if $PYTHON -c 'import build.__main__, wheel, venv, ensurepip' 2>/dev/null; then
    # A copy, so that the sources of the wheel are those of the source distribution alone.
    distributions() {
        (cd "$package" && $PYTHON -m build --sdist --no-isolation --skip-dependency-check --outdir "$dir/dist" .) &&
            mkdir "$dir/unpacked" && tar xzf "$dir"/dist/harmorph-*.tar.gz -C "$dir/unpacked" &&
            (cd "$dir"/unpacked/harmorph-* && CXXFLAGS=-O0 $PYTHON -m build --wheel --no-isolation \
                --skip-dependency-check --outdir "$dir/dist" .)
    }
    check "a source distribution, and a wheel from it" distributions
    environment() { $PYTHON -m venv --system-site-packages "$dir/env"; }
    check "an environment" environment
    absent() { ! (cd "$dir/work" && "$dir/env/bin/python" -c 'import harmorph'); }
    check "harmorph is not in it before" absent
    installed() {
        "$dir/env/bin/pip" install -q --no-index --no-deps "$dir"/dist/harmorph-*.whl &&
            cp "$package/examples/morph.py" "$dir/work" && cd "$dir/work" &&
            "$dir/env/bin/python" -c "import harmorph, os
assert os.path.realpath(harmorph.__file__).startswith(os.path.realpath('$dir/env')), harmorph.__file__
assert os.path.isfile(os.path.join(os.path.dirname(harmorph.__file__), 'py.typed'))
mesh = harmorph.Mesh.read('$build/meshes/naca0012.su2')
assert mesh.report().inverted == 0" &&
            "$dir/env/bin/python" morph.py | grep "^0 inverted cells; the mesh could follow"
    }
    check "the wheel works in another folder" installed
    clean_sources() {
        ! ls -d "$package"/build "$package"/*.egg-info "$package"/dist "$package"/bundled 2>/dev/null | grep .
    }
    check "nothing was written into the sources" clean_sources
else
    skip "the wheel" "python3-build, python3-wheel or python3-venv is not installed"
fi
finish "$dir"
