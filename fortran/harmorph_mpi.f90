! harmorph for Fortran codes with MPI: see harmorph_mpi.h. Compile after harmorph.f90, with mpifort, and link
! harmorph_mpi.c (compiled with mpicc) and libharmorph.a.
!
!     call plan%analyse(mesh, curves, conditions)     on every process, of the whole mesh
!     call plan%factor()
!     call hm_mpi_solve(plan, points, basis, comm)    each its share of the functions; then its own points' rows
!     call plan%free()                                the whole mesh is not needed any more
!     call basis%morph(move, x, y)                    the process's points, in the order of the list; no messages
!     call hm_mpi_adjoint(basis, dj_dx, dj_dy, gradient, comm)
!
! Displacements given at wall points; only the process `root` (rank, 0 without) has the mesh and a factored plan, the plans
! of the others are empty:
!
!     call hm_mpi_displacement(plan, wall_points, wall, points, dx, dy, comm)        wall(2,:) of the process's wall points
!     call hm_mpi_displace(plan, wall_points, wall, points, x, y, comm)              its points, in place
!     call hm_mpi_displace_adjoint(plan, wall_points, dj_dx, dj_dy, points, gradient, comm)   gradient(2,:)
!
! Several fields at once, as the modes of a structure, are hardly dearer than one: wall(2,:,m), dx(:,m), dy(:,m), and for
! the adjoint dj_dx(:,m), dj_dy(:,m), gradient(2,:,m).
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

    interface hm_mpi_solve
        procedure :: solve, solve_i
    end interface
    interface hm_mpi_exchange
        procedure :: exchange, exchange_i
    end interface
    interface hm_mpi_adjoint
        procedure :: adjoint, adjoint_i
    end interface

    interface hm_mpi_displacement
        procedure :: displacement, displacement_i, displacements, displacements_i
    end interface
    interface hm_mpi_displace
        procedure :: displace, displace_i
    end interface
    interface hm_mpi_displace_adjoint
        procedure :: displace_adjoint, displace_adjoint_i, displace_adjoints, displace_adjoints_i
    end interface

    interface
        function c_exchange(rows, share, n, points, comm, err) result(status) bind(c, name="hm_mpi_exchange_f")
            import :: c_int, c_int32_t, c_ptr, hm_c_error
            implicit none
            type(c_ptr), value, intent(in) :: rows, share
            integer(c_int32_t), value, intent(in) :: n
            integer(c_int32_t), intent(in) :: points(*)
            integer(c_int), value, intent(in) :: comm
            type(hm_c_error), intent(inout) :: err
            integer(c_int32_t) :: status
        end function
        function c_adjoint(rows, dj, gradient, executor, comm, err) result(status) bind(c, name="hm_mpi_adjoint_f")
            import :: c_int, c_int32_t, c_ptr, hm_c_error, hm_c_points
            implicit none
            type(c_ptr), value, intent(in) :: rows, gradient, executor
            type(hm_c_points), intent(in) :: dj
            integer(c_int), value, intent(in) :: comm
            type(hm_c_error), intent(inout) :: err
            integer(c_int32_t) :: status
        end function
        function c_displace(plan, n_wall, wall_points, n_fields, wall, n, points, from, to, root, comm, err) &
            result(status) bind(c, name="hm_mpi_displace_f")
            import :: c_int, c_int32_t, c_ptr, hm_c_error, hm_c_points
            implicit none
            type(c_ptr), value, intent(in) :: plan, from                    ! from: null for displacements
            integer(c_int32_t), value, intent(in) :: n_wall, n_fields, n, root
            integer(c_int32_t), intent(in) :: wall_points(*), points(*)
            type(hm_c_points), intent(in) :: wall(*), to(*)                 ! [n_fields]
            integer(c_int), value, intent(in) :: comm
            type(hm_c_error), intent(inout) :: err
            integer(c_int32_t) :: status
        end function
        function c_displace_adjoint(plan, n_wall, wall_points, n_fields, dj, n, points, gradient, root, comm, err) &
            result(status) bind(c, name="hm_mpi_displace_adjoint_f")
            import :: c_int, c_int32_t, c_ptr, hm_c_error, hm_c_points
            implicit none
            type(c_ptr), value, intent(in) :: plan
            integer(c_int32_t), value, intent(in) :: n_wall, n_fields, n, root
            integer(c_int32_t), intent(in) :: wall_points(*), points(*)
            type(hm_c_points), intent(in) :: dj(*), gradient(*)             ! [n_fields]
            integer(c_int), value, intent(in) :: comm
            type(hm_c_error), intent(inout) :: err
            integer(c_int32_t) :: status
        end function
    end interface

contains
    ! The plan has a factor. basis receives the rows of points, with all functions.
    subroutine solve(plan, points, basis, comm, report, stat, err)
        type(hm_plan), intent(inout) :: plan
        integer(c_int32_t), intent(in), contiguous :: points(:)
        type(hm_basis), intent(inout) :: basis
        type(mpi_comm), intent(in) :: comm
        type(hm_solve_report), intent(out), optional :: report
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_basis) :: share
        type(hm_error) :: reason
        integer :: rank, n_processes, first, n, solved, done
        call mpi_comm_rank(comm, rank)
        call mpi_comm_size(comm, n_processes)
        ! What fails on one process leaves an empty basis there, which all then refuse together.
        call plan%share_of(rank + 1, n_processes, first, n, solved, reason)
        if (solved >= 0) call share%init_share(plan, first, n, stat=solved, err=reason)
        if (solved >= 0) call plan%solve(share, report, solved, reason)
        if (solved < 0) call share%free()
        call basis%free()
        if (solved >= 0) call share%extract(points, basis, stat=done, err=reason)
        if (solved >= 0 .and. done < 0) solved = done
        if (solved >= 0) then
            call exchange(basis, share, points, comm, done, reason)
        else
            call exchange(basis, share, points, comm, done)   ! keeps the first reason
        end if
        if (done >= 0) done = solved
        if (done < 0) call basis%free()
        if (present(err)) err = reason
        if (present(stat)) then
            stat = done
        else if (done < 0) then
            write(error_unit, "(4a)") "harmorph: hm_mpi_solve: ", hm_status_name(done), ": ", trim(reason%text)
            error stop "harmorph: refused"
        end if
    end subroutine

    ! rows: made of this process's share by share%extract(points, rows).
    subroutine exchange(rows, share, points, comm, stat, err)
        type(hm_basis), intent(inout) :: rows
        type(hm_basis), intent(in) :: share
        integer(c_int32_t), intent(in), contiguous :: points(:)
        type(mpi_comm), intent(in) :: comm
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        integer(c_int32_t) :: status
        status = c_exchange(rows%address(), share%address(), int(size(points), c_int32_t), points, &
            int(comm%mpi_val, c_int), e)
        call hm_finish("hm_mpi_exchange", status, e, stat, err)
    end subroutine

    ! gradient(2, functions): the same on all processes.
    subroutine adjoint(basis, dj_dx, dj_dy, gradient, comm, stat, err)
        type(hm_basis), intent(in) :: basis
        real(c_double), intent(in), contiguous, target :: dj_dx(:), dj_dy(:)
        real(c_double), intent(inout), contiguous, target :: gradient(:, :)
        type(mpi_comm), intent(in) :: comm
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_basis_info) :: info
        type(hm_c_error) :: e
        type(hm_c_points) :: dj
        type(c_ptr) :: room
        integer(c_int32_t) :: status
        integer :: known
        ! A NULL of one process is refused by all together.
        room = c_null_ptr
        call basis%info(info, known)
        if (known >= 0) then
            if (size(dj_dx) == info%points .and. size(dj_dy) == info%points .and. size(gradient, 1) == 2 .and. &
                size(gradient, 2) == info%functions) room = c_loc(gradient)
        end if
        if (size(dj_dx) > 0 .and. size(dj_dy) > 0) dj = hm_c_points(c_loc(dj_dx), c_loc(dj_dy), 1_c_int64_t)
        status = c_adjoint(basis%address(), dj, room, c_null_ptr, int(comm%mpi_val, c_int), e)
        call hm_finish("hm_mpi_adjoint", status, e, stat, err)
    end subroutine

    ! Displacements, or velocities, dx, dy of the process's points.
    subroutine displacement(plan, wall_points, wall, points, dx, dy, comm, root, stat, err)
        type(hm_plan), intent(in) :: plan
        integer(c_int32_t), intent(in), contiguous :: wall_points(:), points(:)
        real(c_double), intent(in), contiguous, target :: wall(:, :)
        real(c_double), intent(inout), contiguous, target :: dx(:), dy(:)
        type(mpi_comm), intent(in) :: comm
        integer, intent(in), optional :: root
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call move(plan, wall_points, [pairs(wall)], size(wall) == 2 * size(wall_points), points, &
            [points_of(dx, dy, size(points))], c_null_ptr, comm, root, "hm_mpi_displacement", stat, err)
    end subroutine

    ! Of several fields.
    subroutine displacements(plan, wall_points, wall, points, dx, dy, comm, root, stat, err)
        type(hm_plan), intent(in) :: plan
        integer(c_int32_t), intent(in), contiguous :: wall_points(:), points(:)
        real(c_double), intent(in), contiguous, target :: wall(:, :, :)
        real(c_double), intent(inout), contiguous, target :: dx(:, :), dy(:, :)
        type(mpi_comm), intent(in) :: comm
        integer, intent(in), optional :: root
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        integer :: k, m
        logical :: fits
        m = size(wall, 3)
        fits = all(shape(wall) == [2, size(wall_points), m]) .and. size(dx, 2) == m .and. size(dy, 2) == m
        if (.not. fits) m = 0
        call move(plan, wall_points, [(pairs(wall(:, :, k)), k = 1, m)], fits, points, &
            [(points_of(dx(:, k), dy(:, k), size(points)), k = 1, m)], c_null_ptr, comm, root, "hm_mpi_displacement", stat, &
            err)
    end subroutine

    ! Moves x, y in place.
    subroutine displace(plan, wall_points, wall, points, x, y, comm, root, stat, err)
        type(hm_plan), intent(in) :: plan
        integer(c_int32_t), intent(in), contiguous :: wall_points(:), points(:)
        real(c_double), intent(in), contiguous, target :: wall(:, :)
        real(c_double), intent(inout), contiguous, target :: x(:), y(:)
        type(mpi_comm), intent(in) :: comm
        integer, intent(in), optional :: root
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_points), target :: all
        all = points_of(x, y, size(points))
        call move(plan, wall_points, [pairs(wall)], size(wall) == 2 * size(wall_points), points, [all], c_loc(all), comm, &
            root, "hm_mpi_displace", stat, err)
    end subroutine

    ! What one process has wrong, its wrong lengths too, is refused by all: then n_wall is -1. One field more than there
    ! are, as C looks at the first one in any case.
    subroutine move(plan, wall_points, wall, fits, points, to, from, comm, root, name, stat, err)
        type(hm_plan), intent(in) :: plan
        integer(c_int32_t), intent(in), contiguous :: wall_points(:), points(:)
        type(hm_c_points), intent(in) :: wall(:), to(:)                     ! of each field
        logical, intent(in) :: fits                                         ! have the arrays of wall their shape?
        type(c_ptr), intent(in) :: from
        type(mpi_comm), intent(in) :: comm
        integer, intent(in), optional :: root
        character(len=*), intent(in) :: name
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        integer(c_int32_t) :: status, n_wall
        n_wall = int(size(wall_points), c_int32_t)
        if (.not. fits .or. any(to%stride < 0) .or. size(wall) == 0) n_wall = -1
        status = c_displace(plan%address(), n_wall, wall_points, int(max(size(wall), 1), c_int32_t), [wall, hm_c_points()], &
            int(size(points), c_int32_t), points, from, [to, hm_c_points()], rank_of(root), int(comm%mpi_val, c_int), e)
        call hm_finish(name, status, e, stat, err)
    end subroutine

    subroutine displace_adjoint(plan, wall_points, dj_dx, dj_dy, points, gradient, comm, root, stat, err)
        type(hm_plan), intent(in) :: plan
        integer(c_int32_t), intent(in), contiguous :: wall_points(:), points(:)
        real(c_double), intent(in), contiguous, target :: dj_dx(:), dj_dy(:)
        real(c_double), intent(inout), contiguous, target :: gradient(:, :)
        type(mpi_comm), intent(in) :: comm
        integer, intent(in), optional :: root
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call gather(plan, wall_points, [points_of(dj_dx, dj_dy, size(points))], points, [pairs(gradient)], &
            size(gradient) == 2 * size(wall_points), comm, root, stat, err)
    end subroutine

    ! Of several fields.
    subroutine displace_adjoints(plan, wall_points, dj_dx, dj_dy, points, gradient, comm, root, stat, err)
        type(hm_plan), intent(in) :: plan
        integer(c_int32_t), intent(in), contiguous :: wall_points(:), points(:)
        real(c_double), intent(in), contiguous, target :: dj_dx(:, :), dj_dy(:, :)
        real(c_double), intent(inout), contiguous, target :: gradient(:, :, :)
        type(mpi_comm), intent(in) :: comm
        integer, intent(in), optional :: root
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        integer :: k, m
        logical :: fits
        m = size(gradient, 3)
        fits = all(shape(gradient) == [2, size(wall_points), m]) .and. size(dj_dx, 2) == m .and. size(dj_dy, 2) == m
        if (.not. fits) m = 0
        call gather(plan, wall_points, [(points_of(dj_dx(:, k), dj_dy(:, k), size(points)), k = 1, m)], points, &
            [(pairs(gradient(:, :, k)), k = 1, m)], fits, comm, root, stat, err)
    end subroutine

    subroutine gather(plan, wall_points, dj, points, gradient, fits, comm, root, stat, err)
        type(hm_plan), intent(in) :: plan
        integer(c_int32_t), intent(in), contiguous :: wall_points(:), points(:)
        type(hm_c_points), intent(in) :: dj(:), gradient(:)                 ! of each field
        logical, intent(in) :: fits                                         ! have the arrays of gradient their shape?
        type(mpi_comm), intent(in) :: comm
        integer, intent(in), optional :: root
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        integer(c_int32_t) :: status, n_wall
        n_wall = int(size(wall_points), c_int32_t)
        if (.not. fits .or. any(dj%stride < 0) .or. size(dj) == 0) n_wall = -1
        status = c_displace_adjoint(plan%address(), n_wall, wall_points, int(max(size(dj), 1), c_int32_t), &
            [dj, hm_c_points()], int(size(points), c_int32_t), points, [gradient, hm_c_points()], rank_of(root), &
            int(comm%mpi_val, c_int), e)
        call hm_finish("hm_mpi_displace_adjoint", status, e, stat, err)
    end subroutine

    ! Two arrays of n numbers; a stride below 0 if their lengths are others.
    type(hm_c_points) function points_of(x, y, n)
        real(c_double), intent(in), contiguous, target :: x(:), y(:)
        integer, intent(in) :: n
        points_of = hm_c_points(c_null_ptr, c_null_ptr, 1_c_int64_t)
        if (size(x) /= n .or. size(y) /= n) points_of%stride = -1
        if (size(x) > 0 .and. size(y) > 0) points_of = hm_c_points(c_loc(x), c_loc(y), points_of%stride)
    end function

    type(hm_c_points) function pairs(of)
        real(c_double), intent(in), contiguous, target :: of(:, :)
        pairs = hm_c_points(c_null_ptr, c_null_ptr, 2_c_int64_t)
        if (size(of, 1) < 2 .or. size(of, 2) < 1) return
        pairs%x = c_loc(of(1, 1))
        pairs%y = c_loc(of(2, 1))
    end function

    integer(c_int32_t) function rank_of(root)
        integer, intent(in), optional :: root
        rank_of = 0
        if (present(root)) rank_of = int(root, c_int32_t)
    end function

    ! ---- The same with the integers of older interfaces

    subroutine solve_i(plan, points, basis, comm, report, stat, err)
        type(hm_plan), intent(inout) :: plan
        integer(c_int32_t), intent(in), contiguous :: points(:)
        type(hm_basis), intent(inout) :: basis
        integer, intent(in) :: comm
        type(hm_solve_report), intent(out), optional :: report
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call solve(plan, points, basis, mpi_comm(comm), report, stat, err)
    end subroutine

    subroutine exchange_i(rows, share, points, comm, stat, err)
        type(hm_basis), intent(inout) :: rows
        type(hm_basis), intent(in) :: share
        integer(c_int32_t), intent(in), contiguous :: points(:)
        integer, intent(in) :: comm
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call exchange(rows, share, points, mpi_comm(comm), stat, err)
    end subroutine

    subroutine adjoint_i(basis, dj_dx, dj_dy, gradient, comm, stat, err)
        type(hm_basis), intent(in) :: basis
        real(c_double), intent(in), contiguous :: dj_dx(:), dj_dy(:)
        real(c_double), intent(inout), contiguous, target :: gradient(:, :)
        integer, intent(in) :: comm
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call adjoint(basis, dj_dx, dj_dy, gradient, mpi_comm(comm), stat, err)
    end subroutine

    subroutine displacement_i(plan, wall_points, wall, points, dx, dy, comm, root, stat, err)
        type(hm_plan), intent(in) :: plan
        integer(c_int32_t), intent(in), contiguous :: wall_points(:), points(:)
        real(c_double), intent(in), contiguous, target :: wall(:, :)
        real(c_double), intent(inout), contiguous, target :: dx(:), dy(:)
        integer, intent(in) :: comm
        integer, intent(in), optional :: root
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call displacement(plan, wall_points, wall, points, dx, dy, mpi_comm(comm), root, stat, err)
    end subroutine

    subroutine displacements_i(plan, wall_points, wall, points, dx, dy, comm, root, stat, err)
        type(hm_plan), intent(in) :: plan
        integer(c_int32_t), intent(in), contiguous :: wall_points(:), points(:)
        real(c_double), intent(in), contiguous, target :: wall(:, :, :)
        real(c_double), intent(inout), contiguous, target :: dx(:, :), dy(:, :)
        integer, intent(in) :: comm
        integer, intent(in), optional :: root
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call displacements(plan, wall_points, wall, points, dx, dy, mpi_comm(comm), root, stat, err)
    end subroutine

    subroutine displace_i(plan, wall_points, wall, points, x, y, comm, root, stat, err)
        type(hm_plan), intent(in) :: plan
        integer(c_int32_t), intent(in), contiguous :: wall_points(:), points(:)
        real(c_double), intent(in), contiguous, target :: wall(:, :)
        real(c_double), intent(inout), contiguous, target :: x(:), y(:)
        integer, intent(in) :: comm
        integer, intent(in), optional :: root
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call displace(plan, wall_points, wall, points, x, y, mpi_comm(comm), root, stat, err)
    end subroutine

    subroutine displace_adjoint_i(plan, wall_points, dj_dx, dj_dy, points, gradient, comm, root, stat, err)
        type(hm_plan), intent(in) :: plan
        integer(c_int32_t), intent(in), contiguous :: wall_points(:), points(:)
        real(c_double), intent(in), contiguous, target :: dj_dx(:), dj_dy(:)
        real(c_double), intent(inout), contiguous, target :: gradient(:, :)
        integer, intent(in) :: comm
        integer, intent(in), optional :: root
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call displace_adjoint(plan, wall_points, dj_dx, dj_dy, points, gradient, mpi_comm(comm), root, stat, err)
    end subroutine

    subroutine displace_adjoints_i(plan, wall_points, dj_dx, dj_dy, points, gradient, comm, root, stat, err)
        type(hm_plan), intent(in) :: plan
        integer(c_int32_t), intent(in), contiguous :: wall_points(:), points(:)
        real(c_double), intent(in), contiguous, target :: dj_dx(:, :), dj_dy(:, :)
        real(c_double), intent(inout), contiguous, target :: gradient(:, :, :)
        integer, intent(in) :: comm
        integer, intent(in), optional :: root
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call displace_adjoints(plan, wall_points, dj_dx, dj_dy, points, gradient, mpi_comm(comm), root, stat, err)
    end subroutine
end module
