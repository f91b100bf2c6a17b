# harmorph. POSIX make and any C++17 compiler; there is no configure step.
#
#   make                  library and program; harmorph.f90, harmorph77.f90 and harmorph_mpi.f90, each of one piece
#   make test             all tests; the last line counts them. ONLY=formats: those of one folder of tests (or of one
#                         script), with a count of their own; a name that does not exist is refused with all names
#   make unit             the C++ tests alone; UNITS='tests/safe/test_*.cpp': those of these files only
#   make fuzz             random problems, damaged bases, calls in any order and damaged files, under sanitizers;
#                         SECONDS=600; see tests/fuzz/run.sh
#   make coverage         branches of the library that the C++ tests take, by gcov; see tests/fuzz/coverage.sh
#   make mutate           small errors put into the library, and how many the tests find: MUTANTS=200 SEED=1
#                         LIMIT=3600; CARRY=LIST: those of a former run; see tests/fuzz/mutate.sh
#   make sanitize         memory read before it is written, races between threads; see tests/fuzz/sanitize.sh
#   make test-python      the Python package of c_api/python, by PYTHON=/usr/bin/python3; see tests/hosts/python.sh
#   make wheel            build/wheel/*.whl: the Python package in one file for every CPython from 3.9 on
#   make web              build/web/harmorph-VERSION.tgz, the library as WebAssembly in a package for npm (c_api/web)
#   make workbench        build/web/workbench.html, the whole program as a page for any browser
#   make test-web         this package in node, and in Chromium where Chromium is installed
#   make mpi              harmorph_mpi.c as a library of its own, by mpicc; the core never needs it
#   make test-petsc       harmorph_petsc.c on 1 to 4 processes, where petsc-dev is installed; MESHES=directory of SU2
#                         files, LARGE="NI:NJ:FIRST ..." of O-meshes, PARTITIONS=012345 SOLVERS=01: tests/hosts/petsc/main.c
#   make test-openfoam    the motion solver for OpenFOAM (c_api/openfoam) and its tutorials, where OpenFOAM is installed;
#                         FOAM_SRC=folder src of OpenFOAM's sources
#   make test-saturne     moving meshes of code_saturne (fortran/examples/code_saturne), where code_saturne is installed
#   make check-link       the library needs nothing but mem*: it links into C programs
#   make shared           build/shared/libharmorph.so.ABI, its symbols versioned, for other languages (ELF systems)
#   make abi              exported calls, structs and constants against tests/release/abi/interface.txt, and by abidiff against
#                         the last tagged release, RELEASE=tarball, or BASE=revision
#   make cross            other processors and systems under emulators, as far as Debian's cross compilers are there;
#                         TARGETS="s390x musl"; see tests/release/cross/run.sh
#   make compile-commands  BUILD/compile_commands.json, for editors and clang-tidy
#   make tidy             the checks of .clang-tidy on the core, by clang-tidy 14; FILES="src/ROOM/FILE.cpp ...": those alone
#   make compilers        all compilers that are installed, without a warning; LEVELS=-O2; see tests/release/compilers.sh
#   make amalgamation     the library in one source with its headers, in build/amalgamation
#   make test-systems     both commands of README.md in fresh systems, as the superuser: SYSTEMS="bookworm trixie", in the
#                         folder ROOTS; see tests/release/systems.sh
#   make bench            against CHOLMOD, MUMPS, PETSc with BoomerAMG (PARTS=iterative) and gmsh
#                         (PARTS=files), as far as they are there; see tests/measure/bench/run.sh
#   make bench-rows       measures what tests/measure/bench/README.md says about speed, and prints the rows of its tables
#   make deform           how far meshes follow large movements: tables and figures on a page; see tests/measure/deform/run.sh
#   make compare          harmorph, elasticity, radial basis functions, inverse distances on the same movements: quality,
#                         time, memory, on a page; MESHES="FILE:MARKER ..."; see tests/measure/compare/run.sh
#   make claims           measures the numbers that README and the pages state with a command beside them (hours of
#                         processor time); NAMES="deform compare": those commands only; see tests/measure/claims/claims.py
#   make bench-petsc      functions by PETSc on parts of the mesh: time, iterations, memory, beside harmorph_mpi
#   make bench-mpi        solve and morph on 1 and 2 processes
#   make demo             fits, solves and morphs the shipped airfoil mesh; leaves pictures and a page
#   make paper            the paper's cases: figures and a table of engines on a page; MESHES=directory: of its SU2 files, too
#   make manual           build/harmorph.1, the manual page of the program, and build/harmorph.bash, the completion of its
#                         commands and options for bash
#   make html             the browsable manual of all pages and headers in build/html; PYTHON needs Sphinx and MyST
#   make fpm              build/fpm, a package for the Fortran package manager
#   make test-packages    the Debian packages and the fpm package: built, checked and used, where Debian's tools are installed
#   make test-release     builds all that a release gives away, and uses each of them from its files alone, in fresh systems,
#                         too: hours; PARTS="wheel projects": some parts; see tests/release/release.sh
#   make dist             build/harmorph-VERSION.tar.gz, the same bytes wherever it is made
#   make install          headers, library, program, manual page, completion, Fortran source, harmorph.pc, CMake config
#   make install-library  headers, library, harmorph.pc and CMake config alone; the program is not built
#   make install-shared   the shared library and its symbolic link
#   make uninstall        takes the same files away
#   make clean
#
# BUILD is a name of letters, digits and _ . / + , @ -; PREFIX, DESTDIR and the folder of the sources may have any name
# (a dollar sign in a value is written $$, as always in make).
#
# `make CXX=clang++ CXXFLAGS="-O1 -g" BUILD=build-debug` and so on: the names below are yours to set. What the library
# cannot do without is added to CXXFLAGS.
.POSIX:
.SUFFIXES:
.PHONY: all checked rules meshes deform-seeded test-programs unit fuzzer fuzz test library-only tests-only coverage mutate sanitize test-petsc test-python mpi \
	check-link bench bench-rows bench-mpi \
	bench-petsc deform paper demo install uninstall clean \
	test-openfoam test-saturne test-systems \
	amalgamation compilers cross shared install-shared install-library abi manual html fpm test-packages compare claims dist \
	compile-commands tidy wheel test-release web-tools web-modules page-module web workbench test-web

BUILD = build
# PREFIX is /usr/local if it is not given; DESTDIR is empty. Both come from the environment of the recipes, where make
# puts what its command line says: no character in them can end a quotation.
INSTALLATION = "$${DESTDIR-}$${PREFIX-/usr/local}"
CXX = c++
# Levels of optimisation of the library, of its files with kernels for instruction sets, and of the program, which hardly
# computes. CXXFLAGS follow them, so CXXFLAGS="-O1 -g" replaces all levels.
CXXFLAGS =
LEVEL = -O2
KERNEL_LEVEL = $(LEVEL)
# src/dense/dense.cpp takes 3 % fewer instructions of a solution at -O3, for .1 MB: the same bits.
DENSE_LEVEL = -O3
PROGRAM_LEVEL = -O1
LEVELS =
CC = cc
CFLAGS = -O2
FC = gfortran
FFLAGS = -O2
LDFLAGS =
AR = ar
JOBS = 2
UNITS = tests/*/test_*.cpp
TARGETS =
# Folder of the systems that `make test-systems` makes.
ROOTS = /var/tmp/harmorph-systems
RELEASE =
SECONDS = 60
MPICC = mpicc
FOAM_SRC =
# Debian's, as another python3 may come first in the path.
PYTHON = /usr/bin/python3

WARNINGS = -Wall -Wextra -Wconversion -Wshadow
# No C++ runtime, no errno, so that only mem* stay undefined; no contraction, so that compilers agree on bits. Callers may
# trap floating-point exceptions: so -fno-trapping-math, which lets compilers divide where the program does not, is not here;
# what clang needs for that is in src/base/types.hpp.
FREESTANDING = -std=c++17 -fno-exceptions -fno-rtti -fno-math-errno -ffp-contract=off \
	-fno-threadsafe-statics -fno-stack-protector -fno-asynchronous-unwind-tables -U_FORTIFY_SOURCE \
	-fvisibility=hidden -Iinclude -Isrc -Ic_api
CORE = $(FREESTANDING) -fPIC $(WARNINGS)
# The library as WebAssembly (c_api/web): Debian's clang and lld suffice. Nothing is imported; a stack that is too small
# traps, as the stack comes first; what the library is given can be as large as 32 bits can address.
WASM_CXX = clang++
WASM = --target=wasm32 -flto -mbulk-memory -nostdlibinc -isystem c_api/web/freestanding $(FREESTANDING) -I$(BUILD)/web
WASM_LINK = --target=wasm32 -nostdlib -Wl,--no-entry,--gc-sections,--strip-all,-O2,--stack-first,-z,stack-size=262144 \
	-Wl,--max-memory=4294967296,--export=__heap_base,--export-table,--growable-table
# The program for node, where emscripten is installed (Debian's emscripten and node-acorn). Without zlib and threads; for
# the smallest size, as the library, which computes, has objects of its own.
EMXX = em++
NODE = -std=c++17 -fwasm-exceptions -fno-rtti -I. -Iinclude -Ic_api/cli
NODE_LINK = -O2 -fwasm-exceptions -sENVIRONMENT=node -sNODERAWFS=1 -sWASM_ASYNC_COMPILATION=0 -sALLOW_MEMORY_GROWTH=1 \
	-sMAXIMUM_MEMORY=4GB -sEXIT_RUNTIME=1 --pre-js c_api/web/program_before.js
# The same program for a worker of the workbench, which gives the program files in memory (c_api/web/workbench).
WORKBENCH_LINK = -O2 -fwasm-exceptions -sENVIRONMENT=worker,node -sMODULARIZE=1 -sEXPORT_NAME=make_program -sINVOKE_RUN=0 \
	-sFORCE_FILESYSTEM=1 -sALLOW_MEMORY_GROWTH=1 -sMAXIMUM_MEMORY=4GB -sEXIT_RUNTIME=1 \
	-sEXPORTED_RUNTIME_METHODS=FS,callMain
CLI = -std=c++17 -ffp-contract=off -pthread $(WARNINGS) $(CGNS:1=-DHARMORPH_CGNS) $(WITH_ZLIB) -I. -Iinclude -Ic_api/cli
# CGNS=1: the program reads and writes CGNS files; it needs libcgns (Debian's libcgns-dev), the library does not.
CGNS =
# The program reads and writes compressed files where zlib is installed (Debian's zlib1g-dev): c_api/packaging/rules.sh tries, and
# sets WITH_ZLIB. ZLIB=0: without; ZLIB=1: an error where zlib is missing.
ZLIB =
# Tests are compiled for one run: what more of optimisation would take is not given back, nor exceptions caught in each check.
UNIT = -std=c++17 -Og -DDOCTEST_CONFIG_SUPER_FAST_ASSERTS -ffp-contract=off $(WARNINGS) -Iinclude -Isrc -I. -Ic_api -Itests

LIBRARY = $(BUILD)/libharmorph.a
PROGRAM = $(BUILD)/harmorph
# Makes what follows by the generated rules: silently, as the rules say in few words what they do; $(BUILD)/flags holds
# the whole commands. With the jobs of `make -j8`, or with JOBS.
MAKE_BY_RULES = case " $$MAKEFLAGS" in *" -j"*) jobs= ;; *) jobs='-j $(JOBS)' ;; esac; \
	$(MAKE) -s $$jobs -f Makefile -f $(BUILD)/rules.mk -f $(BUILD)/depends.mk

# For scripts that call make: JOBS is what `make -j8` says, or JOBS, and make does not look for the jobs of its caller.
SCRIPT_JOBS = jobs=`printf ' %s' "$$MAKEFLAGS" | sed -n 's/.* -j\([0-9][0-9]*\).*/\1/p'`; JOBS=$${jobs:-$(JOBS)}; \
	MAKEFLAGS=`printf '%s' "$$MAKEFLAGS" | sed 's/ *-j[0-9]*//; s/ *--jobserver-[a-z]*=[^ ]*//g'`; export JOBS MAKEFLAGS

all: rules
	+@$(MAKE_BY_RULES) $(LIBRARY) $(PROGRAM)

# Before anything is written to BUILD, or removed there. The value comes from the environment, as PREFIX does.
checked:
	@sh c_api/packaging/check_build.sh "$${BUILD-build}"
fuzz coverage mutate sanitize dist amalgamation clean: checked

# What is joined or generated from sources, and the rules of all objects and programs.
rules: checked
	@mkdir -p $(BUILD)/web $(BUILD)/meshes && (cd $(BUILD) && mkdir -p objects/core objects/cli objects/unit objects/fuzz \
	    objects/mesh objects/harmorph objects/harmorph_simd128 objects/node)
	@UNITS='$(UNITS)' CXX='$(CXX)' LDFLAGS='$(LDFLAGS)' ZLIB='$(ZLIB)' \
	    WASM_CXX='$(WASM_CXX)' \
	    FLAGS='$(CXX) $(LEVEL) $(KERNEL_LEVEL) $(DENSE_LEVEL) $(PROGRAM_LEVEL) $(CXXFLAGS) $(CORE) $(CLI) $(UNIT)' \
	    WASM_FLAGS='$(WASM_CXX) $(WASM) $(WASM_LINK)' NODE_FLAGS='$(EMXX) $(NODE) $(NODE_LINK) $(WORKBENCH_LINK)' \
	    sh c_api/packaging/rules.sh $(BUILD)

# The random movements of `make deform`; `make test` compiles them, too.
deform-seeded: all
	+@$(MAKE_BY_RULES) $(BUILD)/deform-seeded

# The meshes of the demo, of the tests and of the paper's cases, which a program of tests/meshes makes, this one last.
MESH = $(BUILD)/meshes/naca0012.su2
meshes: rules
	+@$(MAKE_BY_RULES) $(MESH)

compile-commands: rules
	@for source in src/*/*.cpp c_api/*.cpp; do echo "$$source|$(CORE)"; done >$(BUILD)/sources.txt
	@for source in c_api/cli/*.cpp c_api/cli/*/*.cpp; do echo "$$source|$(CLI)"; done >>$(BUILD)/sources.txt
	@for source in tests/main.cpp $(UNITS); do echo "$$source|$(UNIT)"; done >>$(BUILD)/sources.txt
	@awk -F '|' -v folder="$$PWD" -v compiler='$(CXX)' 'BEGIN { print "[" } { \
	    printf "%s{\"directory\": \"%s\", \"file\": \"%s\",\n \"command\": \"%s %s -c %s\"}", \
	        (NR > 1 ? ",\n" : ""), folder, $$1, compiler, $$2, $$1 } END { print "\n]" }' \
	    $(BUILD)/sources.txt >$(BUILD)/compile_commands.json

tidy:
	@sh tests/tidy.sh $(FILES)

library-only: rules
	+@$(MAKE_BY_RULES) $(LIBRARY)

tests-only: rules
	+@$(MAKE_BY_RULES) $(BUILD)/tests

unit: all meshes
	@echo '#include <doctest/doctest.h>' | $(CXX) -x c++ -E - >/dev/null 2>&1 || \
	    { echo "doctest/doctest.h not found: install Debian's doctest-dev"; exit 1; }
	+@$(MAKE_BY_RULES) $(BUILD)/tests
	$(BUILD)/tests

# All programs that the tests run.
test-programs: rules
	+@$(MAKE_BY_RULES) $(LIBRARY) $(PROGRAM) $(BUILD)/tests $(BUILD)/fuzzer $(BUILD)/deform-seeded $(MESH)

fuzzer: rules
	+@$(MAKE_BY_RULES) $(BUILD)/fuzzer

fuzz:
	@$(SCRIPT_JOBS); MAKE='$(MAKE)' BUILD='$(BUILD)' FUZZ_SECONDS='$(SECONDS)' sh tests/fuzz/run.sh

coverage:
	@$(SCRIPT_JOBS); MAKE='$(MAKE)' BUILD='$(BUILD)' CXX='$(CXX)' sh tests/fuzz/coverage.sh

mutate:
	@$(SCRIPT_JOBS); MAKE='$(MAKE)' BUILD='$(BUILD)' CXX='$(CXX)' MUTANTS='$(MUTANTS)' SEED='$(SEED)' FILES='$(FILES)' \
	    LIMIT='$(LIMIT)' CARRY='$(CARRY)' REACH='$(REACH)' sh tests/fuzz/mutate.sh

sanitize:
	@$(SCRIPT_JOBS); MAKE='$(MAKE)' BUILD='$(BUILD)' CXX='$(CXX)' sh tests/fuzz/sanitize.sh

# The library as WebAssembly, and the package for npm.
WEB = $(BUILD)/web/harmorph.wasm $(BUILD)/web/harmorph_simd128.wasm
web-tools: checked
	@WASM_CXX='$(WASM_CXX)' sh c_api/web/pack.sh tools
web-modules: web-tools rules
	+@program=; if command -v $(EMXX) >/dev/null; then program='$(BUILD)/web/program.js $(WORKBENCH)'; \
	else echo "left out: the program of the package, and $(WORKBENCH):"; $(WORKBENCH_TOOLS) || :; fi; \
	$(MAKE_BY_RULES) $(WEB) $$program
# The whole program as one page.
WORKBENCH = $(BUILD)/web/workbench.html
WORKBENCH_TOOLS = WASM_CXX='$(WASM_CXX)' EMXX='$(EMXX)' sh c_api/web/pack.sh workbench 2>&1
workbench: checked rules
	+@$(WORKBENCH_TOOLS) && $(MAKE_BY_RULES) $(WORKBENCH)
# What the program has of pages, for CMake.
page-module: rules
	+@$(MAKE_BY_RULES) $(BUILD)/page_module.cpp
web: web-modules meshes
	@VERSION=$(VERSION) EMXX='$(EMXX)' sh c_api/web/pack.sh pack $(BUILD)

test-web: all web
	@CC='$(CC)' EMXX='$(EMXX)' sh tests/hosts/web.sh $(BUILD)

mpi: all
	$(MPICC) $(CFLAGS) -Wall -Wextra -Wno-missing-field-initializers -fPIC -Iinclude -Ic_api -c -o $(BUILD)/objects/harmorph_mpi.o c_api/mpi/harmorph_mpi.c
	rm -f $(BUILD)/libharmorph_mpi.a
	$(AR) rcs $(BUILD)/libharmorph_mpi.a $(BUILD)/objects/harmorph_mpi.o

# The soname changes with HM_ABI only; symbols have the version HARMORPH_ABI.
ABI = `sed -n 's/^\#define HM_ABI \([0-9]*\).*/\1/p' include/harmorph.h`
VERSION = `sed -n 's/^\#define HM_VERSION "\(.*\)"/\1/p' include/harmorph.h`
shared: all
	@mkdir -p $(BUILD)/shared
	@printf 'HARMORPH_%s { global: hm_*; local: *; };\n' $(ABI) >$(BUILD)/shared/symbols.map
	@$(CC) -shared -o $(BUILD)/shared/libharmorph.so.$(ABI) -Wl,-soname,libharmorph.so.$(ABI) -Wl,-z,defs \
	    -Wl,--version-script=$(BUILD)/shared/symbols.map -Wl,--whole-archive $(LIBRARY) -Wl,--no-whole-archive $(LDFLAGS)
	@ln -sf libharmorph.so.$(ABI) $(BUILD)/shared/libharmorph.so

abi: all
	@MAKE='$(MAKE)' CXX='$(CXX)' CC='$(CC)' RELEASE='$(RELEASE)' BASE='$(BASE)' sh tests/release/abi/run.sh $(BUILD)

manual: all
	@new=$(BUILD)/harmorph.1.$$$$; sh c_api/cli/manual.sh $(PROGRAM) $(VERSION) $$new && mv -f $$new $(BUILD)/harmorph.1
	@sh c_api/cli/completion.sh >$(BUILD)/harmorph.bash

html: checked
	@PYTHON='$(PYTHON)' sh c_api/packaging/html.sh $(BUILD)

fpm: amalgamation meshes
	@sh c_api/packaging/fpm.sh $(BUILD)

test-packages: checked
	@$(SCRIPT_JOBS); MAKE='$(MAKE)' FC='$(FC)' sh tests/release/packages.sh $(BUILD)

test-release: all meshes
	@$(SCRIPT_JOBS); MAKE='$(MAKE)' PYTHON='$(PYTHON)' CC='$(CC)' FC='$(FC)' PARTS='$(PARTS)' SYSTEMS='$(SYSTEMS)' \
	    MIRROR='$(MIRROR)' sh tests/release/release.sh $(BUILD) '$(ROOTS)'

dist:
	@mkdir -p $(BUILD)
	@sh c_api/packaging/dist.sh harmorph-$(VERSION) >$(BUILD)/harmorph-$(VERSION).tar.gz
	@echo $(BUILD)/harmorph-$(VERSION).tar.gz

cross: all meshes
	@$(SCRIPT_JOBS); CC='$(CC)' TARGETS='$(TARGETS)' PARTS='$(PARTS)' sh tests/release/cross/run.sh $(BUILD)

compilers: all
	@LEVELS='$(LEVELS)' COMPILERS='$(COMPILERS)' sh tests/release/compilers.sh $(BUILD)

amalgamation:
	@rm -rf $(BUILD)/amalgamation
	@mkdir -p $(BUILD)/amalgamation
	@sh c_api/packaging/amalgamate.sh >$(BUILD)/amalgamation/harmorph.cpp
	@for header in `cat fortran/harmorph/headers`; do cp include/$$header $(BUILD)/amalgamation/; done

check-link: all
	@CC='$(CC)' CFLAGS='$(CFLAGS)' sh tests/release/check_link.sh $(BUILD)

test: checked
	@$(SCRIPT_JOBS); MAKE='$(MAKE)' BUILD='$(BUILD)' CXX='$(CXX)' CXXFLAGS='$(CXXFLAGS)' CC='$(CC)' CFLAGS='$(CFLAGS)' FC='$(FC)' \
	    FFLAGS='$(FFLAGS)' AR='$(AR)' LDFLAGS='$(LDFLAGS)' PYTHON='$(PYTHON)' ONLY='$(ONLY)' sh tests/run.sh

test-python: all meshes
	@CXX='$(CXX)' PYTHON='$(PYTHON)' sh tests/hosts/python.sh $(BUILD)

wheel: all meshes
	@CXX='$(CXX)' CXXFLAGS='$(CXXFLAGS)' LDFLAGS='$(LDFLAGS)' PYTHON='$(PYTHON)' sh c_api/packaging/wheel.sh $(BUILD)

test-petsc: all meshes
	@CC='$(CC)' CFLAGS='$(CFLAGS)' FC='$(FC)' FFLAGS='$(FFLAGS)' MPICC='$(MPICC)' MESHES='$(MESHES)' sh tests/hosts/petsc.sh $(BUILD)

test-openfoam: all
	@MAKE='$(MAKE)' FOAM_SRC='$(FOAM_SRC)' sh c_api/openfoam/tutorials/run.sh $(BUILD)

test-saturne: all
	@MAKE='$(MAKE)' FC='$(FC)' sh fortran/examples/code_saturne/run.sh $(BUILD)

test-systems: checked
	@SYSTEMS='$(SYSTEMS)' MIRROR='$(MIRROR)' sh tests/release/systems.sh '$(ROOTS)'

bench-petsc: all
	@BUILD='$(BUILD)' MPICC='$(MPICC)' CFLAGS='$(CFLAGS)' sh tests/measure/bench/petsc.sh

bench: all meshes
	@BUILD='$(BUILD)' CXX='$(CXX)' CXXFLAGS='$(CXXFLAGS)' LDFLAGS='$(LDFLAGS)' SIZES='$(SIZES)' KINDS='$(KINDS)' \
	    PARTS='$(PARTS)' FUNCTIONS='$(FUNCTIONS)' THREADS='$(THREADS)' REPEATS='$(REPEATS)' \
	    sh tests/measure/bench/run.sh

bench-rows: all
	@BUILD='$(BUILD)' CXX='$(CXX)' CXXFLAGS='$(CXXFLAGS)' LDFLAGS='$(LDFLAGS)' FILE='$(FILE)' sh tests/measure/bench/rows.sh

deform: deform-seeded meshes
	@BUILD='$(BUILD)' PYTHON='$(PYTHON)' MESHES='$(MESHES)' SEEDS='$(SEEDS)' sh tests/measure/figures.sh '$(BUILD)/deform' \
	    'Large movements of meshes' \
	    sh tests/measure/deform/run.sh

compare: all meshes
	@BUILD='$(BUILD)' PYTHON='$(PYTHON)' MESHES='$(MESHES)' sh tests/measure/figures.sh '$(BUILD)/compare' \
	    'Methods that deform meshes' sh tests/measure/compare/run.sh

claims: all meshes
	@$(SCRIPT_JOBS); $(PYTHON) tests/measure/claims/claims.py $(BUILD) $(NAMES)

paper: all meshes
	@BUILD='$(BUILD)' PYTHON='$(PYTHON)' MESHES='$(MESHES)' sh tests/measure/figures.sh '$(BUILD)/paper' 'The cases of the paper' sh tests/measure/paper/run.sh

bench-mpi: all
	@BUILD='$(BUILD)' MPICC='$(MPICC)' CFLAGS='$(CFLAGS)' sh tests/measure/bench/mpi.sh

demo: all meshes
	$(PROGRAM) demo $(BUILD)/demo --mesh $(MESH)
	+@if missing=`$(WORKBENCH_TOOLS)`; then $(MAKE_BY_RULES) $(WORKBENCH) && cp $(WORKBENCH) $(BUILD)/demo/; \
	else echo "left out: $(BUILD)/demo/workbench.html, as $$missing"; fi
	@ls $(BUILD)/demo/*.svg $(BUILD)/demo/*.html

# What lies where after an installation; uninstall takes the same list away.
INSTALLED = bin/harmorph share/man/man1/harmorph.1 share/bash-completion/completions/harmorph lib/libharmorph.so* include/harmorph.h include/harmorph_design.h \
	include/harmorph_space.h include/harmorph_study.h include/harmorph_openmp.h \
	include/harmorph_quality.h include/harmorph_bases.h \
	include/harmorph_pthreads.h include/harmorph_mpi.h include/harmorph_petsc.h include/harmorph_pages.h \
	include/harmorph_fields.h \
	lib/libharmorph.a lib/pkgconfig/harmorph.pc \
	lib/cmake/harmorph/harmorphConfig.cmake lib/cmake/harmorph/harmorphConfigVersion.cmake share/harmorph/*.f90 \
	share/harmorph/harmorph_mpi.c share/harmorph/harmorph_petsc.c share/harmorph/read_su2.c share/harmorph/read_su2.h \
	share/harmorph/naca0012.su2 share/harmorph/openfoam/* share/harmorph/code_saturne/*

# Everybody may read what is installed, whatever the umask is: new folders get their modes from this umask, files from
# OPEN_FILES, which sets the modes of all files of this list that are there.
OPEN_FILES = for file in $(INSTALLED); do \
	    for name in "$$to"/$$file; do \
	        if [ -f "$$name" ] && [ ! -h "$$name" ]; then chmod 644 "$$name"; fi; \
	    done; \
	done; \
	if [ -f "$$to/bin/harmorph" ]; then chmod 755 "$$to/bin/harmorph"; fi

# Copies headers, library, harmorph.pc and the CMake files into the folder $$to.
INSTALL_LIBRARY = to=$(INSTALLATION); set -e; umask 022; \
	mkdir -p "$$to/include" "$$to/lib/pkgconfig" "$$to/lib/cmake/harmorph"; \
	cp include/*.h "$$to/include/"; \
	cp $(LIBRARY) "$$to/lib/"; \
	version=`sed -n 's/^\#define HM_VERSION "\(.*\)"/\1/p' include/harmorph.h`; \
	sed "s|@UP@|../..|; s|@VERSION@|$$version|" c_api/packaging/harmorph.pc.in >"$$to/lib/pkgconfig/harmorph.pc"; \
	cp c_api/packaging/harmorphConfig.cmake c_api/packaging/harmorphConfigVersion.cmake "$$to/lib/cmake/harmorph/"

install: manual meshes
	@$(INSTALL_LIBRARY); \
	mkdir -p "$$to/bin" "$$to/share/man/man1" "$$to/share/bash-completion/completions" \
	    "$$to/share/harmorph/openfoam" "$$to/share/harmorph/code_saturne"; \
	cp $(PROGRAM) "$$to/bin/"; \
	cp $(BUILD)/harmorph.1 "$$to/share/man/man1/"; \
	cp $(BUILD)/harmorph.bash "$$to/share/bash-completion/completions/harmorph"; \
	cp $(BUILD)/harmorph*.f90 $(BUILD)/harmorph_mpi.c $(BUILD)/harmorph_petsc.c fortran/*.f90 \
	    c_api/examples/read_su2.c c_api/examples/read_su2.h $(MESH) "$$to/share/harmorph/"; \
	cp c_api/openfoam/*.cpp c_api/openfoam/*.hpp c_api/openfoam/Makefile "$$to/share/harmorph/openfoam/"; \
	cp fortran/examples/code_saturne/*.f90 fortran/examples/code_saturne/mesh.awk \
	    fortran/examples/code_saturne/cs_user_scripts.py "$$to/share/harmorph/code_saturne/"; \
	$(OPEN_FILES); \
	echo "harmorph $$version is in $$to"

install-library: library-only
	@$(INSTALL_LIBRARY); \
	$(OPEN_FILES); \
	echo "the library of harmorph $$version is in $$to"

install-shared: shared
	@to=$(INSTALLATION); set -e; umask 022; \
	mkdir -p "$$to/lib"; \
	cp -P $(BUILD)/shared/libharmorph.so* "$$to/lib/"; \
	$(OPEN_FILES)

uninstall:
	@to=$(INSTALLATION); \
	for file in $(INSTALLED); do rm -f "$$to"/$$file; done; \
	rmdir "$$to/lib/cmake/harmorph" "$$to"/share/harmorph/* "$$to/share/harmorph" 2>/dev/null || :

clean:
	@sh c_api/packaging/check_build.sh "$${BUILD-build}" remove
	rm -rf $(BUILD)
