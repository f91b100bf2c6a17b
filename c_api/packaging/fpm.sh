#!/bin/sh
# usage: fpm.sh BUILD
# Writes BUILD/fpm, a package for the Fortran package manager: the library as one C++ source, the Fortran modules, the
# C headers, and the program of the README as an example. `make amalgamation` and the Fortran sources come first.
set -e
version=$(sed -n 's/^#define HM_VERSION "\(.*\)"/\1/p' include/harmorph.h)
to=$1/fpm
rm -rf "$to"
mkdir -p "$to/src" "$to/include" "$to/example"
cp "$1/amalgamation/harmorph.cpp" "$1/harmorph.f90" "$1/harmorph77.f90" "$to/src/"
cp "$1/amalgamation/"*.h "$to/include/"
cp fortran/examples/morph.f90 "$to/example/"
cp LICENSE "$to/"
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
    fpm run --example morph

Another project names this folder as a dependency: `harmorph = { path = "../harmorph/build/fpm" }`.
END
echo "$to"
