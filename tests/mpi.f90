! On any number of processes: the Fortran module's shares, rows, morph and adjoint have the bits of one process.
program partitions
    use, intrinsic :: iso_c_binding, only: c_associated
    use, intrinsic :: iso_fortran_env, only: dp => real64, int64, output_unit
    use mpi_f08
    use harmorph
    use harmorph_mpi
    use o_mesh
    implicit none
    integer, parameter :: ni = 49, nj = 17, wall = 1, far = 2, m = 10
    real(dp), target :: x(ni, nj), y(ni, nj)
    type(hm_mesh) :: mesh
    type(hm_curves) :: curves
    type(hm_plan) :: plan
    type(hm_basis) :: whole, mine, older
    type(hm_solve_report) :: report
    type(hm_error) :: err
    integer, allocatable :: points(:), no_points(:)
    integer :: rank, n_processes, passed = 0, failed = 0, counts(2), stat

    call mpi_init()
    call mpi_comm_rank(mpi_comm_world, rank)
    call mpi_comm_size(mpi_comm_world, n_processes)
    call make_problem()
    points = own_points()

    call plan%analyse(mesh, curves, [hm_condition(wall)])
    call plan%factor()
    call plan%solve(whole)
    call hm_mpi_solve(plan, points, mine, mpi_comm_world, report)
    call check(report%functions == m * (rank + 1) / n_processes - m * rank / n_processes, "each its share")
    call hm_mpi_solve(plan, points, older, mpi_comm_world%mpi_val)   ! a communicator of `use mpi`
    call plan%free()
    call check_products(mine)
    call check_products(older)

    ! What one process has wrong is refused by all.
    allocate(no_points(0))
    if (rank == 0) points = [points, ni * nj + 1]
    call plan%analyse(mesh, curves, [hm_condition(wall)])
    call plan%factor()
    call hm_mpi_solve(plan, points, mine, mpi_comm_world, stat=stat, err=err)
    call check(stat == hm_bad_argument, "a point that the mesh has not")
    call check(.not. c_associated(mine%address()), "nothing stays of a basis that failed")
    call hm_mpi_solve(plan, no_points, mine, mpi_comm_world, stat=stat)
    call check(stat == hm_ok, "processes without points")

    counts = [passed, failed]
    call mpi_allreduce(mpi_in_place, counts, 2, mpi_integer, mpi_sum, mpi_comm_world)
    if (rank == 0) print "(i0, a, i0, a)", counts(1), " passed, ", counts(2), " failed"
    call mpi_finalize()
    if (failed > 0) error stop

contains
    subroutine make_problem()
        call make_o_mesh(x, y, mesh, wall, far)
        call curves%fit(x(:ni - 1, 1), y(:ni - 1, 1), loop=.true., n_control=m)
    end subroutine

    ! Dealt out like cards, from the last one to the first.
    function own_points() result(list)
        integer, allocatable :: list(:)
        integer :: k
        list = [(k, k = ni * nj - rank, 1, -n_processes)]
    end function

    subroutine check_products(rows)
        type(hm_basis), intent(in) :: rows
        real(dp) :: all_x(ni * nj), all_y(ni * nj), gx(ni * nj), gy(ni * nj), move(2, m), expected(2, m), found(2, m)
        real(dp) :: own_x(size(points)), own_y(size(points))
        integer :: k
        all_x = reshape(x, [ni * nj])
        all_y = reshape(y, [ni * nj])
        own_x = all_x(points)
        own_y = all_y(points)
        move = reshape([(0.01_dp * cos(3._dp * k), k = 1, 2 * m)], [2, m])
        call whole%morph(move, all_x, all_y)
        call rows%morph(move, own_x, own_y)
        call check(same(own_x, all_x(points)) .and. same(own_y, all_y(points)), "points move as on one process")
        gx = [(sin(1.7_dp * k) * 10._dp**(-modulo(k, 12)), k = 1, ni * nj)]
        gy = cos(gx)
        call whole%adjoint(gx, gy, expected)
        call hm_mpi_adjoint(rows, gx(points), gy(points), found, mpi_comm_world)
        call check(same([found], [expected]), "the gradient is that of one process")
        call hm_mpi_adjoint(rows, gx(points), gy(points), found, mpi_comm_world%mpi_val)
        call check(same([found], [expected]), "and with a communicator of older interfaces")
        call hm_mpi_adjoint(rows, gx(points), gy(points(2:)), found, mpi_comm_world, stat, err)
        call check(stat == hm_bad_argument, "arrays of the wrong length are refused")
    end subroutine

    pure logical function same(a, b)
        real(dp), intent(in) :: a(:), b(:)
        same = all(transfer(a, [0_int64]) == transfer(b, [0_int64]))
    end function

    subroutine check(holds, what)
        logical, intent(in) :: holds
        character(len=*), intent(in) :: what
        if (holds) then
            passed = passed + 1
        else
            failed = failed + 1
            write(output_unit, "(a, i0, 3a)") "mpi.f90, process ", rank, ": ", what, " " // trim(err%text)
        end if
    end subroutine
end program
