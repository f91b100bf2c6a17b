#!/bin/sh
# usage: fpm.sh BUILD
# Writes BUILD/fpm, a package for the Fortran package manager: the library as one C++ source, the Fortran modules, the
# C headers, the reader of SU2 files, and as examples the program of the README and one for the mesh of the demo, which
# is beside. `make amalgamation`, `make meshes` and the Fortran sources come first.
set -e
version=$(sed -n 's/^#define HM_VERSION "\(.*\)"/\1/p' include/harmorph.h)
to=$1/fpm
rm -rf "$to"
mkdir -p "$to/src" "$to/include" "$to/example"
cp "$1/amalgamation/harmorph.cpp" "$1/harmorph.f90" "$1/harmorph77.f90" fortran/read_su2.f90 "$to/src/"
cp "$1/amalgamation/"*.h "$to/include/"
cp fortran/examples/morph.f90 fortran/examples/unstructured.f90 "$to/example/"
cp LICENSE "$1/meshes/naca0012.su2" "$to/"
cat >"$to/fpm.toml" <<END
name = "harmorph"
version = "$version"
license = "MIT"
description = "Morphs an airfoil and its CFD mesh together"

[build]
auto-examples = true

[library]
source-dir = "src"
include-dir = "include"
END
cat >"$to/README.md" <<'END'
# harmorph for fpm

The library has one source in C++17, which needs no run-time library of C++, and modules in Fortran 2008. fpm takes the
flags of C++ from the environment:

    export FPM_CXXFLAGS="-std=c++17 -O2 -fno-exceptions -fno-rtti -fno-math-errno -ffp-contract=off"
    export FPM_FFLAGS="-O2"
    fpm run --example unstructured -- naca0012.su2
    fpm run --example morph

The first example reads the mesh of the demo by the module `read_su2`, fits a curve to the airfoil and gives the section
5 % of camber; the second one makes its mesh itself. The programs are in the folder `example`.

Another project names this folder as a dependency: `harmorph = { path = "../harmorph/build/fpm" }`.
END
echo "$to"
