#!/bin/sh
# usage: mpi.sh BUILD   (FC, FFLAGS, CC, CFLAGS from the environment; MPICC, MPIFC, MPIRUN: openmpi's)
# harmorph_mpi.c and harmorph_mpi.f90, compiled without a warning, on 1 to 4 processes of this machine.
: "${CC:=cc}" "${CFLAGS:=-O2}" "${FC:=gfortran}" "${FFLAGS:=-O2}"
: "${MPICC:=mpicc}" "${MPIFC:=mpifort}" "${MPIRUN:=mpirun}"
build=$(cd "$1" && pwd)
dir=$build/mpi
rm -rf "$dir"
mkdir -p "$dir"
for tool in $MPICC $MPIFC $MPIRUN; do
    command -v "$tool" >/dev/null && continue
    echo "$tool not found: install Debian's openmpi-bin and libopenmpi-dev"
    echo "0 passed, 1 failed"
    exit 1
done
. "$(dirname "$0")/processes.sh"
strict=-std=f2018 checks=
if $FC --version 2>/dev/null | grep -q '^GNU'; then
    strict="-std=f2018 -Wall -Wextra -Werror -Wno-compare-reals" checks=-fcheck=all,no-array-temps
fi

topic=MPI log=$dir/log
. "$(dirname "$0")/../count.sh"
# Not optimised, which would take most of the time.
fortran() { $MPIFC $strict $FFLAGS -O0 $checks -J"$dir" -I"$dir" -c "$1" -o "$dir/$(basename "$1" .f90)_f.o"; }
c() {
    $MPICC -std=c99 -D_XOPEN_SOURCE=700 -pedantic -Wall -Wextra -Werror -Wno-missing-field-initializers $CFLAGS "$@"
}

check "harmorph_mpi.c" c -Iinclude -Ic_api -c c_api/mpi/harmorph_mpi.c -o "$dir/harmorph_mpi.o"
check "harmorph_mpi.c, as it is installed" c -Iinclude -Ic_api -c "$build/harmorph_mpi.c" -o "$dir/harmorph_mpi.o"
for program in mpi mpi_faults; do
    check "$program.c" c -pthread -Iinclude -Ic_api -o "$dir/${program}_c" tests/hosts/$program.c \
        "$dir/harmorph_mpi.o" "$build/libharmorph.a" -lm
done
for source in "$build/harmorph.f90" "$build/harmorph_mpi.f90" tests/fortran/o_mesh.f90 tests/hosts/mpi.f90; do
    check "$(basename "$source")" fortran "$source"
done
check "link of mpi.f90" $MPIFC $FFLAGS -o "$dir/mpi_f" "$dir/mpi_f.o" "$dir/o_mesh_f.o" "$dir/harmorph_mpi_f.o" \
    "$dir/harmorph_f.o" "$dir/harmorph_mpi.o" "$build/libharmorph.a"
# A module that was compiled with the headers of another version refuses this library.
of_another_version() {
    mkdir -p "$dir/other" && cp include/*.h "$dir/other/" &&
        sed 's/^#define HM_VERSION ".*/#define HM_VERSION "0.9.9"/' include/harmorph.h >"$dir/other/harmorph.h" &&
        c -I"$dir/other" -Ic_api -o "$dir/version_c" tests/hosts/mpi_version.c c_api/mpi/harmorph_mpi.c \
            "$build/libharmorph.a" -lm
}
check "a module of another version" of_another_version
start 2 "$dir/version_c" 2>&1 || fail "a module of another version on 2 processes"
for n in 1 2 3 4; do
    for program in mpi_c mpi_faults_c mpi_f; do start $n "$dir/$program" 2>&1 || fail "$program on $n processes"; done
done
# Both operators on one process and on two; each row of ratios ends with that of the bytes.
measured() {
    BUILD=$build MPICC=$MPICC MPIRUN=$MPIRUN NI=65 NJ=17 FUNCTIONS=4 sh tests/measure/bench/mpi.sh >"$dir/bench" 2>&1
    cat "$dir/bench"
    awk '$1 == "ratio" && $NF > 0 { ++n } END { exit n != 2 }' "$dir/bench"
}
check "make bench-mpi" measured

finish "$dir"
