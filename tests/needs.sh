#!/bin/sh
# Prints the packages that `make test` needs, one a line, by their names in Debian 12 and 13 (README.md installs them).
# Without a package of the second part the tests run, and say which of them are skipped.
sed 's/#.*//; /^ *$/d; s/  *$//' <<'LIST' | tr ' ' '\n'
g++ gcc gfortran make doctest-dev   # library, program, and the tests in C++, C and Fortran
binutils                            # what the library needs from outside, and what it exports
openmpi-bin libopenmpi-dev          # harmorph_mpi: several processes
cmake pkg-config                    # installation, and programs that find the installed library

clang-format                        # includes: the layout of the sources, by version 14
clang-tidy                          # tidy: the checks of .clang-tidy, by version 14
petsc-dev                           # harmorph_petsc: functions on parts of the mesh
libcgns-dev cgns-convert            # formats: CGNS files
locales                             # faults: numbers where the decimal point is a comma
strace                              # faults: full disks, and kills at each system call
chromium                            # page: the page of `harmorph explore` in a browser
emscripten node-acorn               # the program in node, and the workbench
clang lld node-typescript           # pages and package for npm: the library as WebAssembly
python3-dev python3-numpy python3-cffi python3-setuptools python3-pytest    # Python: the package and its tests
python3-wheel python3-venv          # the same; README: the program in Python
python3-scipy                       # Python: constraints and optimisers; measurements
python3-build                       # Python: the source distribution
python3-sphinx python3-myst-parser  # manual: the browsable manual
LIST
# Package for npm. Where node and npm have come from elsewhere, Debian's npm may conflict with them.
if ! command -v npm >/dev/null; then printf '%s\n' nodejs npm; fi
