! harmorph for Fortran codes with MPI: see harmorph_mpi.h. Compile after harmorph.f90, with mpifort, and link
! harmorph_mpi.c (compiled with mpicc) and libharmorph.a. Joined of the parts in fortran/harmorph_mpi.
!
!     call plan%analyse(mesh, curves, conditions)     on every process, of the whole mesh
!     call plan%factor()
!     call hm_mpi_solve(plan, points, basis, comm)    each its share of the functions; then its own points' rows
!     call plan%free()                                the whole mesh is not needed any more
!     call basis%morph(move, x, y)                    the process's points, in the order of the list; no messages
!     call hm_mpi_adjoint(basis, dj_dx, dj_dy, gradient, comm)
!
! Displacements given at wall points; only the process `root` (rank, 0 without) has the mesh and a factored plan, the
! plans of the others are empty:
!
!     call hm_mpi_displacement(plan, wall_points, wall, points, dx, dy, comm)    wall(2,:) of the process's wall points
!     call hm_mpi_displace(plan, wall_points, wall, points, x, y, comm)          its points, in place
!     call hm_mpi_displace_adjoint(plan, wall_points, dj_dx, dj_dy, points, gradient, comm)   gradient(2,:)
!
! Several fields at once, as the modes of a structure, are hardly dearer than one: wall(2,:,m), dx(:,m), dy(:,m), and
! for the adjoint dj_dx(:,m), dj_dy(:,m), gradient(2,:,m).
!
! All calls with comm are collective; comm is a type(MPI_Comm), or an integer of `use mpi` and mpif.h. points counts
! from 1, in the whole mesh; ghosts are allowed, and have dj_dx = dj_dy = 0. The bits are those of one process.
module harmorph_mpi
    use, intrinsic :: iso_c_binding, only: c_double, c_int, c_int32_t, c_int64_t, c_loc, c_null_ptr, c_ptr
    use, intrinsic :: iso_fortran_env, only: error_unit
    use mpi_f08, only: mpi_comm, mpi_comm_rank, mpi_comm_size
    use harmorph
    implicit none
    private
    public :: hm_mpi_solve, hm_mpi_exchange, hm_mpi_adjoint, hm_mpi_displacement, hm_mpi_displace, &
        hm_mpi_displace_adjoint
