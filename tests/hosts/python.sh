#!/bin/sh
# usage: python.sh BUILD   (PYTHON, CXX from the environment; after `make`)
# The Python package: `make wheel`, linked with the library of BUILD, and all tests on the installed wheel (wheel.sh);
# then a source distribution and a wheel that is built from it, offline. Sources of the package are compiled without
# optimisation: what they compute is the same.
: "${PYTHON:=/usr/bin/python3}" "${CXX:=c++}"
build=$(cd "$1" && pwd)
source=$(pwd)
dir=$build/python-test
wheel_failed=
topic=Python log=$dir/log
. "$(dirname "$0")/../count.sh"
rm -rf "$dir"
mkdir -p "$dir/work"
PYTHONDONTWRITEBYTECODE=1 HARMORPH_PROGRAM=$build/harmorph HARMORPH_MESHES=$build/meshes
export PYTHONDONTWRITEBYTECODE HARMORPH_PROGRAM HARMORPH_MESHES CXX PYTHON
package=$source/c_api/python

cp "$build/libharmorph.a" "$dir/"
quick_wheel() { CXXFLAGS=-O0 sh c_api/packaging/wheel.sh "$dir"; }
check "a wheel, linked with the library" quick_wheel
page_lines() (   # of the package's page, that install a wheel
    mkdir "$dir/page" && cp "$dir"/wheel/*.whl "$package/examples/morph.py" "$dir/page" || exit 1
    { echo 'python3() { command $PYTHON "$@"; }'
      awk -v language=sh -v heading="Installation of a wheel" -f tests/release/block.awk "$package/README.md"
    } >"$dir/page/run.sh"
    cd "$dir/page" && sh -e run.sh | grep '^0 inverted cells; the mesh could follow'
)
check "the lines that install a wheel" page_lines
for wheel in "$dir"/wheel/*.whl; do
    sh tests/release/wheel.sh "$wheel" "$dir" || wheel_failed=1   # which the line of counts that it prints says
done

if $PYTHON -c 'import build.__main__' 2>/dev/null; then
    # A copy, so that the sources of the wheel are those of the source distribution alone.
    distributions() {
        (cd "$package" && HARMORPH_BUILD=$dir/build $PYTHON -m build --sdist --no-isolation --skip-dependency-check \
            --outdir "$dir/dist" .) &&
            mkdir "$dir/unpacked" && tar xzf "$dir"/dist/harmorph-*.tar.gz -C "$dir/unpacked" &&
            (cd "$dir"/unpacked/harmorph-* && CXXFLAGS=-O0 $PYTHON -m build --wheel --no-isolation \
                --skip-dependency-check --outdir "$dir/dist" .)
    }
    check "a source distribution, and a wheel from it" distributions
    environment() { $PYTHON -m venv --system-site-packages "$dir/env"; }
    check "an environment" environment
    installed() {
        "$dir/env/bin/pip" install -q --no-index "$dir"/dist/harmorph-*.whl && cd "$dir/work" &&
            "$dir/env/bin/python" "$package/examples/morph.py" | grep "^0 inverted cells; the mesh could follow" &&
            "$dir/env/bin/python" -c "import harmorph
assert harmorph.Mesh.read('$HARMORPH_MESHES/naca0012.su2').report().inverted == 0"
    }
    check "this wheel works, too" installed
else
    skip "the source distribution" "python3-build is not installed"
fi
clean_sources() {
    ! ls -d "$package"/build "$package"/*.egg-info "$package"/dist "$package"/bundled 2>/dev/null | grep .
}
check "nothing was written into the sources" clean_sources
finish "$dir" && [ -z "$wheel_failed" ]
