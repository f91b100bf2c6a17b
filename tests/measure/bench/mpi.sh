#!/bin/sh
# `make bench-mpi`: one problem on 1 and 2 processes, and the ratios. NI, NJ, FUNCTIONS, OPERATORS: from outside.
: "${BUILD:=build}" "${MPICC:=mpicc}" "${MPIRUN:=mpirun}" "${CFLAGS:=-O2}"
: "${NI:=1001}" "${NJ:=200}" "${FUNCTIONS:=20}" "${OPERATORS:=0 1}"
set -e
mkdir -p "$BUILD/bench"
$MPICC -std=c99 $CFLAGS -Iinclude -Ic_api -Itests/hosts -o "$BUILD/bench/mpi" tests/measure/bench/mpi.c \
    c_api/mpi/harmorph_mpi.c "$BUILD/libharmorph.a" -lm
run() { $MPIRUN --allow-run-as-root --oversubscribe -np "$1" "$BUILD/bench/mpi" "$NI" "$NJ" "$FUNCTIONS" "$2"; }
for operator in $OPERATORS; do
    echo "operator $operator (0: conformal, 1: Laplace)"
    { echo "processes points functions factor[s] solve[s] exchange[s] morph[ms] adjoint[ms] bytes/point"
        run 1 "$operator"; run 2 "$operator"; } |
        awk 'NR == 1 { print; next } { print; for (k = 1; k <= NF; ++k) was[NR, k] = $k }
            END { printf "ratio - -"; for (k = 4; k <= 9; ++k) printf " %.2f", was[2, k] / was[3, k]; print "" }' |
        awk '{ for (k = 1; k <= NF; ++k) printf "%12s", $k; print "" }'
done
