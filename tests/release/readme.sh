#!/bin/sh
# usage: readme.sh BUILD   (MAKE, CC, FC, ... from the environment)
# Every README.md of the sources. The programs of the first one are saved as it says, beside the checkout and an empty
# home, and its shell lines run, one block after the other; then the shell lines of the other pages, in the same folder.
# Lines of programs on all pages are those of the examples, or compile inside the programs readme_*. At the end, no
# block of a page that names a language may have been passed over, and no link may lead to what is not in git.
: "${MAKE:=make}" "${PYTHON:=/usr/bin/python3}" "${CC:=cc}" "${CFLAGS:=-O2}" "${FC:=gfortran}" "${FFLAGS:=-O2}"
: "${MPICC:=mpicc}" "${MPIFC:=mpifort}" "${MPIRUN:=mpirun}"
build=$(cd "$1" && pwd)
source=$(pwd)
dir=$build/readme
topic=README log=$dir/log
. "$(dirname "$0")/../count.sh"
rm -rf "$dir"
mkdir -p "$dir/home"
ln -s "$source" "$dir/harmorph"
git ls-files >"$dir/sources" 2>/dev/null && [ -s "$dir/sources" ] ||
    find . \( -name build -o -name .git \) -prune -o -type f -print | sed 's|^\./||' >"$dir/sources"
pages=$(grep -E '(^|/)README\.md$' "$dir/sources")
block() {   # page, language, heading [, number]: the first (or that) block of the language under this heading
    awk -v language="$2" -v heading="$3" -v wanted="${4:-1}" -v seen="$dir/looked_at" -f tests/release/block.awk "$1"
}
cp c_api/examples/morph.c "$dir/morph.c"
block README.md fortran "From Fortran" >"$dir/morph.f90"
block c_api/python/README.md python "harmorph in Python" >"$dir/morph.py"
# The commands make, cc and gfortran of the pages are those of the tests, in the build directory of the tests.
cat >"$dir/tools" <<'END'
HOME=$dir/home
make() { command $MAKE "$@" BUILD="$build" CXX="$CXX" CXXFLAGS="$CXXFLAGS" LDFLAGS="$LDFLAGS"; }
cc() { command $CC "$@"; }
python3() { command $PYTHON "$@"; }
# The package is linked with the library of the tests, and its own sources are not optimised.
HARMORPH_LIBRARY=$build/libharmorph.a HARMORPH_BUILD=$dir/python
export HARMORPH_LIBRARY HARMORPH_BUILD
# Debugging builds of solvers trap floating-point exceptions; the library must not raise any.
traps=; if $FC --version 2>/dev/null | grep -q '^GNU'; then traps=-ffpe-trap=invalid,zero,overflow; fi
gfortran() { command $FC $traps "$@"; }
set -e
cd "$dir"
END
export dir build MAKE CXX CXXFLAGS CC FC LDFLAGS PYTHON
path() {   # page, heading, words that the program prints
    { cat "$dir/tools"; block "$1" sh "$2"; } >"$dir/path.sh"
    sh "$dir/path.sh" >"$dir/out" 2>&1 && grep -q "$3" "$dir/out" || { cat "$dir/out"; return 1; }
}
short() { [ "$(wc -l <README.md)" -le 220 ]; }
check "README.md has at most 220 lines" short
check "the Fortran program is fortran/examples/morph.f90" cmp "$dir/morph.f90" fortran/examples/morph.f90
solver_lines() {   # as they stand in the example, up to indentation
    block fortran/examples/README.md fortran "Inverse design" | sed '/^$/d' | sort >"$dir/shown"
    sed -n 's/ *!hm$//p' fortran/examples/inverse.f90 | sed 's/^ *//' | sort | diff - "$dir/shown"
}
example_lines() {   # page, language, heading, example: lines between README and end, up to indentation
    block "$1" "$2" "$3" | sed '/^$/d' >"$dir/shown"
    awk '/[!*] README:/ { inside = 1; next } /[!*] end/ { inside = 0 } inside' "$4" | sed '/^$/d; s/^    //' |
        diff - "$dir/shown"
}
check "the kernel of c_api/examples/morph.c" example_lines README.md c "From C" c_api/examples/morph.c
space="space: meshes of three dimensions that are one cell thick"
check "the lines of c_api/examples/plane.c" example_lines src/space/README.md c "$space" c_api/examples/plane.c
check "the lines of plane.f90" example_lines src/space/README.md fortran "$space" fortran/examples/plane.f90
check "the solver's lines are those of fortran/examples/inverse.f90" solver_lines
check "the Python program is c_api/python/examples/morph.py" cmp "$dir/morph.py" c_api/python/examples/morph.py
two_programs() {
    path README.md "From Fortran" "^0 inverted cells; the mesh could follow" &&
        [ "$(grep -c "^0 inverted cells; the mesh could follow" "$dir/out")" = 2 ]
}
check "from nothing to a running morph in C and Fortran" two_programs
check "from the command line" path README.md "From the command line" "^inverted cells   0"
check "from the command line: morphed meshes are valid" sh -c \
    'for mesh in morphed far; do "$build/harmorph" check "$dir/case/$mesh.su2" || exit 1; done'
from_python() {   # without optimisation: what the sources of the package compute is the same
    { cat "$dir/tools"; echo 'export CXXFLAGS="-O0 $CXXFLAGS"'
      block c_api/python/README.md sh "harmorph in Python"; } >"$dir/path.sh"
    sh "$dir/path.sh" >"$dir/out" 2>&1 && grep -q "^0 inverted cells; the mesh could follow" "$dir/out" ||
        { cat "$dir/out"; return 1; }
}
if $PYTHON -c 'import numpy, cffi, wheel, setuptools, venv, ensurepip' 2>/dev/null; then
    check "from nothing to a running morph in Python" from_python
    block c_api/python/README.md python "Other codes" >"$dir/warp.py"
    warped() { "$dir/env/bin/python" "$dir/warp.py" | grep -E '^The wall is (0.0|[0-9.]+e-1[5-9]) away'; }
    check "the grid of ADflow is warped" warped
    if $PYTHON -c 'import torch' 2>/dev/null; then
        check "a data set to the end" path c_api/python/examples/dataset/README.md "A data set to the end" \
            "^test: .* times less"
    else
        block c_api/python/examples/dataset/README.md sh "A data set to the end" >/dev/null
        skip "a data set to the end" "PyTorch is not installed for $PYTHON"
    fi
else
    block c_api/python/examples/dataset/README.md sh "A data set to the end" >/dev/null
    block c_api/python/README.md sh "harmorph in Python" >/dev/null
    block c_api/python/README.md python "Other codes" >/dev/null
    skip "the program in Python" "numpy, cffi, wheel, setuptools or venv is not installed for $PYTHON"
fi
block c_api/packaging/README.md sh "In another project" >/dev/null   # tests/release/amalgamation.sh runs it
block c_api/python/README.md sh "Installation of a wheel" >/dev/null       # tests/hosts/python.sh runs it
block c_api/python/README.md python "Installation of a wheel" >/dev/null   # tests/release/wheel.sh runs it
for language in js sh; do   # tests/hosts/web.sh runs them, where node is installed
    block c_api/web/README.md $language "harmorph in JavaScript" >/dev/null
done
check "the lines of C++" path c_api/cpp/README.md "harmorph in C++" "^0 inverted cells; the mesh could follow"
check "the lines of FORTRAN 77" path fortran/harmorph77/README.md "harmorph in FORTRAN 77" \
    "^ *[1-9][0-9]* passed, *0 failed"
check "design variables from the command line" path src/bspline/README.md "Design variables and measures" \
    "^inverted cells   0"
# The first block, where it lies: packages are there, and the tests are those that run.
first_lines() {
    mkdir -p "$dir/bin" && printf '#!/bin/sh\n' >"$dir/bin/apt-get" && chmod +x "$dir/bin/apt-get" || return 1
    { echo 'PATH=$dir/bin:$PATH'
      echo 'make() {
          [ "$1" = test ] || command $MAKE "$@" BUILD="$build" CXX="$CXX" CXXFLAGS="$CXXFLAGS" LDFLAGS="$LDFLAGS"
      }'
      echo set -e
      awk '/^```/ { inside = !inside && $0 == "```" && !n++; next } inside' README.md; } >"$dir/first.sh"
    grep -q 'make demo' "$dir/first.sh" && sh "$dir/first.sh" && ls "$build/demo/morph.svg"
}
check "the first two commands" first_lines
openfoam_lines() {   # OpenFOAM's sources are not there: make prints its commands only
    { echo 'PATH=$dir/bin:$PATH'
      echo 'make() { command $MAKE -n "$@" LIBRARY="$build/libharmorph.a"; }'
      echo set -e
      block c_api/openfoam/README.md sh Build; } >"$dir/openfoam.sh"
    sh "$dir/openfoam.sh" >"$dir/out" 2>&1 && grep -q '[-]o [^ ]*/libharmorphMotionSolver.so' "$dir/out"
}
check "the lines that build the motion solver for OpenFOAM" openfoam_lines
openfoam_case() { block c_api/openfoam/README.md sh Use | sh -n; }   # c_api/openfoam/tutorials/run.sh runs the lines
check "the lines of the first case of OpenFOAM" openfoam_case
# fortran/examples/code_saturne/run.sh runs these lines.
code_saturne_case() { block fortran/examples/code_saturne/README.md sh "A first case" | sh -n; }
check "the lines of the first case of code_saturne" code_saturne_case

# tests/release/projects.sh builds the projects of this page.
for language in cmake ini meson; do block c_api/packaging/README.md $language "In another project" >/dev/null; done
block c_api/packaging/README.md cmake "In another project" 2 >/dev/null

# Lines that no example has, inside programs that declare what the lines name.
lines_of_c() {
    block c_api/README.md c "Displacements from elsewhere: FSI, CAD, modes" >"$dir/readme_given.inc"
    block c_api/README.md c "Memory and threads" >"$dir/readme_threads.inc"
    $CC -std=c99 -fopenmp -Wall -Werror -Iinclude -I"$dir" -c tests/release/readme_lines.c -o "$dir/readme_lines.o"
}
lines_of_fortran() {   # harmorph.mod is there from the program in Fortran
    block fortran/README.md fortran "The solver's own arrays" >"$dir/readme_nodes.inc"
    block src/bspline/README.md fortran "Design variables and measures" >"$dir/readme_variables.inc"
    cp tests/release/readme_lines.f90 "$dir" && (cd "$dir" && $FC $FFLAGS -O0 -c readme_lines.f90)
}
heads() {   # calls or subroutines, whether continued by & in column 6 or at the end: NAME and its number of arguments
    awk '/^     &/ { sub(/&/, ""); printf "%s", $0; next } { if (!joined && NR > 1) print ""
        joined = sub(/& *$/, ""); printf "%s", $0 } END { print "" }' | tr A-Z a-z |
        sed -nE 's/^ *(call|subroutine) *(hm[a-z0-9]*) *(\([^)]*\)).*/\2 \3/p' |
        awk '{ print $1, gsub(/,/, "") + 1 }' | sort -u
}
lines_of_fortran_77() {
    block fortran/harmorph77/README.md fortran "harmorph in FORTRAN 77" >"$dir/readme_77.inc"
    heads <"$build/harmorph77.f90" >"$dir/known"
    heads <"$dir/readme_77.inc" >"$dir/shown"
    [ "$(grep -c . "$dir/shown")" = "$(grep -c CALL "$dir/readme_77.inc")" ] &&
        ! grep -vxF -f "$dir/known" "$dir/shown"
}
lines_of_code_saturne() {   # as they stand in the user source, up to indentation
    page=fortran/examples/code_saturne/README.md
    sed 's/^ *//' fortran/examples/code_saturne/cs_user_boundary_conditions_ale.f90 >"$dir/known"
    block "$page" fortran "Moving meshes of code_saturne" >"$dir/shown"
    grep -q follow_wall "$dir/shown" && ! grep -vxF -f "$dir/known" "$dir/shown"
}
check "the lines of code_saturne are those of the user source" lines_of_code_saturne
check "lines of C on other pages compile" lines_of_c
check "lines of Fortran on other pages compile" lines_of_fortran
check "lines of FORTRAN 77 have the arguments of what they call" lines_of_fortran_77

# The page compiles harmorph_mpi.c by mpicc and harmorph_mpi.f90 by mpifort; see tests/hosts/mpi.sh.
. "$(dirname "$0")/../hosts/processes.sh"
block c_api/mpi/README.md fortran "On several processes (MPI)" >"$dir/readme_mpi.inc"
several_processes() {
    parts=$dir/parts
    rm -rf "$parts"
    mkdir "$parts" || return 1
    cp "$build/harmorph.f90" "$build/harmorph_mpi.f90" "$build/harmorph_mpi.c" "$build/libharmorph.a" \
        include/*.h "$dir/readme_mpi.inc" "$parts" || return 1
    cat tests/fortran/o_mesh.f90 tests/release/readme_mpi.f90 >"$parts/parts.f90"
    block c_api/mpi/README.md sh "On several processes (MPI)" |
        sed "s/^mpicc/$MPICC $CFLAGS -I./; s/^mpifort/$MPIFC $FFLAGS -O0/" \
        >"$parts/lines.sh"   # optimised, the modules take most of the time
    (cd "$parts" && sh -e lines.sh) || return 1
    start 2 "$parts/parts" >"$dir/out" 2>&1
    cat "$dir/out"
    grep -q "agree on processes: 2" "$dir/out"
}
partitioned_lines() {
    sed -n 's/ *!hm$//p' fortran/examples/partitioned.f90 | sed 's/^ *//' >"$dir/known"
    block c_api/petsc/README.md fortran "Meshes that no process has as a whole (PETSc)" >"$dir/shown"
    grep -vxF -f "$dir/known" "$dir/shown" && return 1
    grep -q system%solve "$dir/shown"
}
check "the lines of fortran/examples/partitioned.f90" partitioned_lines
if command -v $MPIFC >/dev/null; then check "the lines for several processes" several_processes; fi

# Blocks with a language are programs. Commands stand in blocks that are run: neither in blocks without a language, but
# for the first two commands, nor in indented lines, but for `make unit` with a name to fill in.
not_looked_at() {
    for page in $pages; do
        awk -v page="$page" '/^```/ {
                inside = !inside; blocks += inside; here = inside && $0 != "```"
                if (here) print page, substr($0, 4), ++n[$0]
                next
            }
            here || (page == "README.md" && inside && blocks == 1) || /^ *make unit / { next }
            (inside || /^    /) && /^ *(harmorph|make|cc|gfortran|mpicc) / { print page ": " $0 }' "$page"
    done | grep -vxF -f "$dir/looked_at"
}
is_empty "blocks and commands that no test looks at" "$(not_looked_at)"
# Links are relative to their page; a folder is what files in git lie in, and a place on a page is a heading there.
wrong_links() {
    for page in $pages; do
        folder=$(dirname "$page")
        awk '/^```/ { inside = !inside } !inside { gsub(/`[^`]*`/, ""); print }' "$page" |
            grep -o '\]([^)]*)' | sed 's/^](//; s/)$//' |
            while IFS= read -r link; do
                case $link in http*) continue ;; esac
                file=${link%%#*} place=
                case $link in *'#'*) place=${link#*#} ;; esac
                if [ -n "$file" ]; then
                    path=$(echo "$folder/$file" | sed 's|/$||; s|^\./||; :up
                        s|[^/.][^/]*/\.\./||; t up')
                else
                    path=$page
                fi
                awk -v path="$path" '$0 == path || index($0, path "/") == 1 { found = 1 } END { exit !found }' \
                    "$dir/sources" || { echo "$page: $link"; continue; }
                [ -z "$place" ] || sed -n 's/^##* //p' "$path" | tr 'A-Z ' 'a-z-' | sed 's/[^a-z0-9_-]//g' |
                    grep -qxF -e "$place" || echo "$page: $link"
            done
    done
}
is_empty "links that lead nowhere" "$(wrong_links)"
# Measured numbers beside a command have a claim, and texts of claims stand on their pages.
if command -v "$PYTHON" >/dev/null; then
    check "numbers beside commands" "$PYTHON" tests/measure/claims/claims.py --pages
else
    skip "numbers beside commands" "Python is not installed"
fi

finish "$dir"
