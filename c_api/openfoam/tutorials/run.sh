#!/bin/sh
# usage: run.sh BUILD   (called by `make test-openfoam`, with FOAM_SRC in the environment)
# Builds the motion solver, tests it on small meshes, and runs the tutorials. Skipped, with the reason, where OpenFOAM,
# its headers or its tutorials are missing. STEP, END: degrees of the pitching airfoil, 2 and 180 by default.
here=$(dirname "$0") dir=$1/openfoam
topic=OpenFOAM log=$dir/log
. "$here/../../../tests/count.sh"
say() { echo "OpenFOAM is not tested, as $1"; exit 0; }
command -v moveDynamicMesh >/dev/null 2>&1 || say "the program moveDynamicMesh is not installed (Debian's openfoam)"
test -d "${FOAM_SRC:-}/OpenFOAM" || say "FOAM_SRC names no folder of OpenFOAM's sources (apt-get source openfoam)"
mkdir -p "$dir" || exit 2
dir=$(cd "$dir" && pwd)
log=$dir/log
${MAKE:-make} -C "$here/.." BUILD="$dir/library" LIBRARY="$(dirname "$dir")/libharmorph.a" \
    FOAM_SRC="$FOAM_SRC" >"$dir/log.build" 2>&1
passes "the library of the motion solver" $? "$dir/log.build"
LD_LIBRARY_PATH=$dir/library${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}; export LD_LIBRARY_PATH

sh "$here/motions.sh" "$dir/motions" >"$dir/motions.out" 2>&1
passes "motions on small meshes" $? "$dir/motions.out"
tail -n 1 "$dir/motions.out"

# The second program of the page, in an empty folder.
first_case() (
    rm -rf "$dir/first" && mkdir "$dir/first" &&
        awk '/^```/ { inside = 0 } inside { print } /^```sh/ { inside = ++n == 2 }' "$here/../README.md" \
            >"$dir/first.sh" && cd "$dir/first" && sh -e "$dir/first.sh" && test -s case/20/polyMesh/points
)
if [ -d /usr/share/doc/openfoam-examples/examples ]; then check "the first case of the page" first_case; fi

if [ -d "${FOAM_TUTORIALS:-/usr/share/doc/openfoam-examples/examples}/incompressible/simpleFoam/airFoil2D" ]; then
    sh "$here/pitching.sh" "$dir/pitching" "${STEP:-2}" "${END:-180}" harmorph harmorph-one static \
        laplacian-inverseDistance laplacian-quadratic SBRStress-inverseDistance SBRStress-quadratic \
        >"$dir/pitching.out" 2>&1
    passes "the pitching airfoil" $? "$dir/pitching.out"
    cat "$dir/pitching.out"
    # One factorisation must go farther than OpenFOAM's own solvers, and the defaults to the end.
    check "the pitching airfoil: how far each solver goes" awk -v end="${END:-180}" '
        /^[^ ]/ { far[$1] = $2 ~ /^[0-9]/ ? $2 : 0 }   # indented lines are the ends of logs
        END {
            for (name in far) if (name ~ /^(laplacian|SBRStress)-/ && far[name] >= far["harmorph-one"]) exit 1
            exit far["harmorph"] != end
        }' "$dir/pitching.out"
else
    skip "the pitching airfoil" "OpenFOAM's tutorials are not installed (Debian's openfoam-examples)"
fi
sh "$here/cylinder.sh" "$dir/cylinder" 2 >"$dir/cylinder.out" 2>&1
passes "the free cylinder" $? "$dir/cylinder.out"
cat "$dir/cylinder.out"

if command -v adjointOptimisationFoam >/dev/null 2>&1; then
    sh "$here/adjoint.sh" "$dir/adjoint" "$(dirname "$dir")/harmorph" >"$dir/adjoint.out" 2>&1
    passes "shape optimisation" $? "$dir/adjoint.out"
    cat "$dir/adjoint.out"
    check "shape optimisation: less drag at constant lift and area" awk '
        { line = $0 } END { gsub(/[,a-z]/, " ", line); split(line, left)
            exit !(left[1] < 0.99 && (left[2] - 1)^2 < 1e-6 && (left[3] - 1)^2 < 1e-8) }' "$dir/adjoint.out"
else
    skip "shape optimisation" "the program adjointOptimisationFoam is not installed"
fi
finish
