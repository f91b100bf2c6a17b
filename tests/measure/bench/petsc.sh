#!/bin/sh
# `make bench-petsc`: harmorph_petsc.c beside harmorph_mpi.c, and iterations and memory from 10 000 points on. SIZES
# (pairs NI:NJ), PROCESSES, FUNCTIONS, OPERATORS, FIRST (heights of the first layer): from outside. PETSc hears the
# environment variable PETSC_OPTIONS, as in PETSC_OPTIONS="-hm_pc_type gamg" make bench-petsc.
: "${BUILD:=build}" "${MPICC:=mpicc}" "${MPIRUN:=mpirun}" "${CFLAGS:=-O2}"
: "${SIZES:=201:50 634:158 1001:200 2001:500}" "${PROCESSES:=1 2}" \
    "${FUNCTIONS:=20}" "${OPERATORS:=1 0}" "${FIRST:=0 1e-5}"
if ! pkg-config --exists petsc; then
    echo "PETSc is not installed: Debian's petsc-dev"
    exit 1
fi
set -e
mkdir -p "$BUILD/bench"
$MPICC -std=c99 -D_XOPEN_SOURCE=700 $CFLAGS $(pkg-config --cflags petsc) -Iinclude -Ic_api -o "$BUILD/bench/petsc" \
    tests/measure/bench/petsc.c c_api/petsc/harmorph_petsc.c "$BUILD/libharmorph.a" $(pkg-config --libs petsc) -lm
$MPICC -std=c99 $CFLAGS -Iinclude -Ic_api -Itests/hosts -o "$BUILD/bench/mpi" tests/measure/bench/mpi.c \
    c_api/mpi/harmorph_mpi.c "$BUILD/libharmorph.a" -lm
processors=$(getconf _NPROCESSORS_ONLN 2>/dev/null || echo 1)
run() {   # processes, program... Processes that share a processor yield it while they wait.
    n=$1; shift
    if [ "$n" -gt "$processors" ]; then
        OMPI_MCA_mpi_yield_when_idle=1 $MPIRUN --allow-run-as-root --oversubscribe -np "$n" "$@"
    else
        OMPI_MCA_mpi_yield_when_idle=0 $MPIRUN --allow-run-as-root -np "$n" "$@"
    fi
}
table() { awk '{ for (k = 1; k <= NF; ++k) printf "%12s", $k; print "" }'; }
export OMP_NUM_THREADS=1
for operator in $OPERATORS; do
    for first in $FIRST; do
        echo "PETSc, operator $operator (0: conformal, 1: Laplace), first layer $first (0: cells as long as wide)"
        { echo "processes points create[s] solve[s] iterations morph[s] ours[MB] petsc[MB] peak[MB] error"
            for size in $SIZES; do
                for n in $PROCESSES; do
                    run "$n" "$BUILD/bench/petsc" "${size%:*}" "${size#*:}" "$FUNCTIONS" "$operator" "$first"
                done
            done; } | table
    done
    echo "harmorph_mpi, operator $operator"
    { echo "processes points functions factor[s] solve[s] exchange[s] morph[ms] adjoint[ms] bytes/point"
        for size in $SIZES; do
            for n in $PROCESSES; do run "$n" "$BUILD/bench/mpi" "${size%:*}" "${size#*:}" "$FUNCTIONS" "$operator"; done
        done; } | table
done
