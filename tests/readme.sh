#!/bin/sh
# usage: readme.sh BUILD   (MAKE, CC, FC, ... from the environment)
# The programs in README.md, saved as it says, beside the checkout and an empty home; then its shell lines, one block
# after the other. The programs are also those of the examples.
# The lines for several processes run inside readme_mpi.f90.
: "${MAKE:=make}" "${CC:=cc}" "${CFLAGS:=-O2}" "${FC:=gfortran}" "${FFLAGS:=-O2}"
: "${MPICC:=mpicc}" "${MPIFC:=mpifort}" "${MPIRUN:=mpirun}"
build=$(cd "$1" && pwd)
source=$(pwd)
dir=$build/readme
topic=README log=$dir/log
. "$(dirname "$0")/count.sh"
block() {   # language, number: the fenced block
    awk -v begin="\`\`\`$1" -v wanted="$2" '/^```/ && inside { inside = 0; next }
        $0 == begin { inside = 1; ++n; next } inside && n == wanted' README.md
}
rm -rf "$dir"
mkdir -p "$dir/home"
ln -s "$source" "$dir/harmorph"
block c 1 >"$dir/morph.c"
block fortran 1 >"$dir/morph.f90"
# What README calls make, cc and gfortran is what the tests are run with, in the tests' build directory.
cat >"$dir/tools" <<'END'
HOME=$dir/home
make() { command $MAKE "$@" BUILD="$build" CXX="$CXX" CXXFLAGS="$CXXFLAGS" LDFLAGS="$LDFLAGS"; }
cc() { command $CC "$@"; }
# As debugging builds of solvers do: what traps these must not die in the library.
traps=; if $FC --version 2>/dev/null | grep -q '^GNU'; then traps=-ffpe-trap=invalid,zero,overflow; fi
gfortran() { command $FC $traps "$@"; }
set -e
cd "$dir"
END
export dir build MAKE CXX CXXFLAGS CC FC LDFLAGS
path() {   # number, words that the program prints
    { cat "$dir/tools"; block sh "$1"; } >"$dir/path.sh"
    sh "$dir/path.sh" >"$dir/out" 2>&1 && grep -q "$2" "$dir/out" || { cat "$dir/out"; return 1; }
}
check "the C program is c_api/examples/morph.c" cmp "$dir/morph.c" c_api/examples/morph.c
check "the Fortran program is fortran/examples/morph.f90" cmp "$dir/morph.f90" fortran/examples/morph.f90
solver_lines() {   # as they stand in the example, up to indentation
    block fortran 2 | sed '/^$/d' | sort >"$dir/shown"
    sed -n 's/ *!hm$//p' fortran/examples/inverse.f90 | sed 's/^ *//' | sort | diff - "$dir/shown"
}
example_lines() {   # language, number of the block, example: lines between README and end, up to indentation
    block "$1" "$2" >"$dir/shown"
    awk '/[!*] README:/ { inside = 1; next } /[!*] end/ { inside = 0 } inside' "$3" | sed '/^$/d; s/^    //' |
        diff - "$dir/shown"
}
check "the lines of c_api/examples/plane.c" example_lines c 3 c_api/examples/plane.c
check "the lines of fortran/examples/plane.f90" example_lines fortran 3 fortran/examples/plane.f90
check "the solver's lines are those of fortran/examples/inverse.f90" solver_lines
check "from nothing to a running morph in C" path 1 "^0 inverted cells; the mesh could follow"
check "from nothing to a running morph in Fortran" path 2 "^0 inverted cells; the mesh could follow"
check "from the command line" path 3 "^inverted cells   0"
check "from the command line: morphed meshes are valid" sh -c \
    'for mesh in morphed far fine_morphed; do "$build/harmorph" check "$dir/case/$mesh.su2" || exit 1; done'
from_python() {
    command $MAKE -s BUILD="$build" CXX="$CXX" CXXFLAGS="$CXXFLAGS" LDFLAGS="$LDFLAGS" shared &&
        block python 1 >"$dir/morph.py" &&
        (cd "$dir/case" && LD_LIBRARY_PATH=$build/shared python3 "$dir/morph.py") >"$dir/out" && cat "$dir/out" &&
        [ "$(grep -c . "$dir/morph.py")" = 15 ] && awk '/^largest displacement/ { d = $3 }
            END { exit !(d > 0.001 && d <= 0.01) }' "$dir/out"
}
if command -v python3 >/dev/null && [ "$(uname -s)" = Linux ]; then
    check "from Python" from_python
else
    skip "the call from Python" "it is not installed"
fi
check "design variables from the command line" path 4 "^inverted cells   0"
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
# No other block holds commands: those of the program stand in blocks that are run.
no_other_commands() {
    ! awk '/^```/ { fenced = !fenced; here = fenced && $0 != "```sh"; next }
        here && /^(harmorph|make|cc|gfortran|mpicc) /' README.md | grep .
}
check "commands stand in blocks that are run" no_other_commands

# As README says it: harmorph_mpi.c by mpicc, harmorph_mpi.f90 by mpifort; see tests/mpi.sh.
. "$(dirname "$0")/processes.sh"
several_processes() {
    block fortran 4 >"$dir/readme_mpi.inc" && cp tests/readme_mpi.f90 "$dir" || return 1
    (cd "$dir" && $MPICC $CFLAGS -I"$source/c_api" -c "$source/c_api/harmorph_mpi.c" -o harmorph_mpi_c.o &&
        for file in "$build/harmorph.f90" "$build/harmorph_mpi.f90" "$source/tests/o_mesh.f90" readme_mpi.f90; do
            $MPIFC $FFLAGS -O0 -c "$file" || exit 1   # optimised, the modules take most of the time
        done &&
        $MPIFC $FFLAGS -o readme_mpi readme_mpi.o o_mesh.o harmorph_mpi.o harmorph.o harmorph_mpi_c.o \
            "$build/libharmorph.a") || return 1
    start 2 "$dir/readme_mpi" >"$dir/out" 2>&1
    cat "$dir/out"
    grep -q "agree on processes: 2" "$dir/out"
}
partitioned_lines() {
    sed -n 's/ *!hm$//p' fortran/examples/partitioned.f90 | sed 's/^ *//' >"$dir/known"
    block fortran 5 | grep -vxF -f "$dir/known" | grep . && return 1
    block fortran 5 | grep -q system%solve
}
check "the lines of fortran/examples/partitioned.f90" partitioned_lines
if command -v $MPIFC >/dev/null; then check "the lines for several processes" several_processes; fi

finish "$dir"
