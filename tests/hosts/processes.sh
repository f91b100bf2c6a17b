# Sourced by the tests that run on several processes of this machine; MPIRUN, CC and FC are set before, the latter being
# the compilers behind mpicc and mpifort.
#     start N PROGRAM [ARGUMENT]...
export OMPI_CC="$CC" OMPI_FC="$FC" MPICH_CC="$CC" MPICH_FC="$FC" OMP_NUM_THREADS=1
is_open= local=
case $($MPIRUN --version 2>&1) in *Open*) is_open=1 local="--allow-run-as-root --timeout 900" ;; esac
processors=$(getconf _NPROCESSORS_ONLN 2>/dev/null || echo 1)
# Processes that share a processor yield it while they wait; with one for each, beside other work, yielding would cost a
# turn of everything else for each message.
start() {
    if [ "$1" -gt "$processors" ] && [ "$is_open" ]; then
        OMPI_MCA_mpi_yield_when_idle=1 $MPIRUN $local --oversubscribe -np "$@"
    else
        OMPI_MCA_mpi_yield_when_idle=0 $MPIRUN $local -np "$@"
    fi
}
