#!/bin/sh
# usage: petsc.sh BUILD   (FC, FFLAGS, CC, CFLAGS, MPICC, MPIFC, MPIRUN as in mpi.sh; MESHES: a directory of SU2 files
# to solve on as well)
# harmorph_petsc.c and harmorph_petsc.f90, compiled without a warning, on 1 to 4 processes of this machine.
: "${CC:=cc}" "${CFLAGS:=-O2}" "${FC:=gfortran}" "${FFLAGS:=-O2}"
: "${MPICC:=mpicc}" "${MPIFC:=mpifort}" "${MPIRUN:=mpirun}"
build=$(cd "$1" && pwd)
dir=$build/petsc
rm -rf "$dir"
mkdir -p "$dir"
if ! pkg-config --exists petsc; then
    echo "PETSc is not installed (Debian's petsc-dev): its tests are SKIPPED"
    echo "0 passed, 0 failed"
    exit 0
fi
# PETSc's headers as those of the system: their warnings are not ours.
petsc_flags=$(pkg-config --cflags petsc | sed 's/-I/-isystem /g') petsc_libs=$(pkg-config --libs petsc)
export OMPI_CC="$CC" OMPI_FC="$FC" MPICH_CC="$CC" MPICH_FC="$FC" OMPI_MCA_mpi_yield_when_idle=1 OMP_NUM_THREADS=1
case $($MPIRUN --version 2>&1) in *Open*) local="--allow-run-as-root --oversubscribe --timeout 900" ;; *) local= ;; esac

topic=PETSc log=$dir/log
. "$(dirname "$0")/count.sh"
c() {
    $MPICC -std=c99 -D_XOPEN_SOURCE=700 -pedantic -Wall -Wextra -Werror -Wno-missing-field-initializers $CFLAGS \
        $petsc_flags -Ic_api -Ic_api/examples -Itests "$@"
}

check "harmorph_petsc.c" c -c c_api/harmorph_petsc.c -o "$dir/harmorph_petsc.o"
check "harmorph_mpi.c" c -c c_api/harmorph_mpi.c -o "$dir/harmorph_mpi.o"
check "read_su2.c" $CC $CFLAGS -c c_api/examples/read_su2.c -o "$dir/read_su2.o"
check "petsc.c" c -Wno-unused-function -o "$dir/petsc" tests/petsc.c "$dir/read_su2.o" "$dir/harmorph_petsc.o" \
    "$dir/harmorph_mpi.o" "$build/libharmorph.a" $petsc_libs -lm
for source in "$build/harmorph.f90" fortran/harmorph_mpi.f90 fortran/harmorph_petsc.f90 fortran/read_su2.f90 \
    fortran/examples/partitioned.f90; do
    name=$(basename "$source" .f90)
    check "$name.f90" $MPIFC -std=f2018 $FFLAGS -J"$dir" -I"$dir" -c "$source" -o "$dir/${name}_f.o"
done
check "link of partitioned.f90" $MPIFC $FFLAGS -o "$dir/partitioned" "$dir"/*_f.o "$dir/harmorph_petsc.o" \
    "$dir/harmorph_mpi.o" "$build/libharmorph.a" $petsc_libs -lm
for n in 1 2; do
    check "partitioned.f90 on $n processes" $MPIRUN $local -np $n "$dir/partitioned" tests/meshes/naca0012.su2
done
for n in 1 2 3 4; do $MPIRUN $local -np $n "$dir/petsc" 2>&1 || fail "$n processes"; done
for mesh in ${MESHES:+"$MESHES"/*.su2}; do
    for n in 1 2 3 4; do $MPIRUN $local -np $n "$dir/petsc" "$mesh" 2>&1 || fail "$mesh on $n processes"; done
done

finish "$dir"
