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

    ! An error of one process is refused by all processes.
    allocate(no_points(0))
    if (rank == 0) points = [points, ni * nj + 1]
    call plan%analyse(mesh, curves, [hm_condition(wall)])
    call plan%factor()
    call hm_mpi_solve(plan, points, mine, mpi_comm_world, stat=stat, err=err)
    call check(stat == hm_bad_argument, "a point that the mesh has not")
    call check(.not. c_associated(mine%address()), "nothing stays of a basis that failed")
    call hm_mpi_solve(plan, no_points, mine, mpi_comm_world, stat=stat)
    call check(stat == hm_ok, "processes without points")

    call check_displacements()

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

    ! Only the last process has a plan.
    subroutine check_displacements()
        type(hm_plan) :: plan, whole
        integer, allocatable :: all_wall(:), own_wall(:), own(:)
        real(dp), allocatable :: wall(:, :), own_field(:, :), dx(:), dy(:), own_dx(:), own_dy(:)
        real(dp), allocatable :: gradient(:, :), own_gradient(:, :)
        real(dp), allocatable, target :: all_x(:), all_y(:)
        real(dp), allocatable :: fields(:, :, :), fields_x(:, :), fields_y(:, :)
        real(dp) :: sums
        integer :: root, k
        root = n_processes - 1
        call whole%analyse(mesh, conditions=[hm_condition(1, hm_given)])
        call whole%factor()
        if (rank == root) then
            call plan%analyse(mesh, conditions=[hm_condition(1, hm_given)])
            call plan%factor()
        end if
        call whole%given_points(all_wall)
        own = own_points()
        own_wall = pack(own, own < ni)
        wall = field_at(all_wall)
        own_field = field_at(own_wall)
        allocate(dx(ni * nj), dy(ni * nj), own_dx(size(own)), own_dy(size(own)))
        call whole%displacement(wall, dx, dy)
        call hm_mpi_displacement(plan, own_wall, own_field, own, own_dx, own_dy, mpi_comm_world, root)
        call check(same(own_dx, dx(own)) .and. same(own_dy, dy(own)), "displacements as on one process")
        call hm_mpi_displacement(plan, own_wall, own_field, own, own_dx, own_dy, mpi_comm_world%mpi_val, root)
        call check(same(own_dx, dx(own)), "and with a communicator of older interfaces")
        all_x = reshape(x, [ni * nj])
        all_y = reshape(y, [ni * nj])
        own_dx = all_x(own)
        own_dy = all_y(own)
        call whole%displace(wall, all_x, all_y)
        call hm_mpi_displace(plan, own_wall, own_field, own, own_dx, own_dy, mpi_comm_world, root)
        call check(same(own_dx, all_x(own)) .and. same(own_dy, all_y(own)), "in place as on one process")
        dx = [(sin(2._dp * k), k = 1, ni * nj)]
        dy = cos(dx)
        gradient = wall
        own_gradient = own_field
        call whole%displace_adjoint(dx, dy, gradient)
        call hm_mpi_displace_adjoint(plan, own_wall, dx(own), dy(own), own, own_gradient, mpi_comm_world, root)
        sums = sum(own_gradient * own_field)
        call mpi_allreduce(mpi_in_place, sums, 1, mpi_double_precision, mpi_sum, mpi_comm_world)
        call check(abs(sums - sum(gradient * wall)) < 1e-13_dp * sum(abs(gradient * wall)), &
            "the same work on all processes")
        ! Two fields at once: each as alone.
        allocate(fields_x(size(own), 2), fields_y(size(own), 2))
        fields = reshape([own_field, -2 * own_field], [2, size(own_wall), 2])
        call hm_mpi_displacement(plan, own_wall, own_field, own, own_dx, own_dy, mpi_comm_world, root)
        call hm_mpi_displacement(plan, own_wall, fields, own, fields_x, fields_y, mpi_comm_world, root)
        call check(same(fields_x(:, 1), own_dx), "the first of two fields, x")
        call check(same(fields_y(:, 1), own_dy), "the first of two fields, y")
        call check(maxval(abs(fields_x(:, 2) + 2 * own_dx)) < 1e-15_dp, "the second of two fields, x")
        call check(maxval(abs(fields_y(:, 2) + 2 * own_dy)) < 1e-15_dp, "the second of two fields, y")
        fields_x(:, 1) = dx(own)
        fields_y(:, 1) = dy(own)
        fields_x(:, 2) = dy(own)
        fields_y(:, 2) = dx(own)
        call hm_mpi_displace_adjoint(plan, own_wall, fields_x, fields_y, own, fields, mpi_comm_world%mpi_val, root)
        call check(same(fields(1, :, 1), own_gradient(1, :)), "adjoints of two fields, the first, x")
        call check(same(fields(2, :, 1), own_gradient(2, :)), "adjoints of two fields, the first, y")
        call hm_mpi_displace_adjoint(plan, own_wall, dy(own), dx(own), own, own_gradient, mpi_comm_world, root)
        call check(same(fields(1, :, 2), own_gradient(1, :)), "adjoints of two fields, the second")
        call hm_mpi_displacement(plan, own_wall, fields, own, fields_x(:, :1), fields_y, mpi_comm_world, root, stat)
        call check(stat == hm_bad_argument, "two fields into one are refused")
        call hm_mpi_displacement(plan, own_wall, own_field(:, 2:), own, own_dx, own_dy, mpi_comm_world, root, stat)
        call check(stat == hm_bad_argument, "fields of the wrong length are refused")
        call hm_mpi_displacement(whole, own_wall, own_field, own, own_dx, own_dy, mpi_comm_world, root, stat)
        call check(stat == merge(hm_ok, hm_bad_argument, n_processes == 1), "plans on all processes are refused")
    end subroutine

    function field_at(list) result(field)
        integer, intent(in) :: list(:)
        real(dp) :: field(2, size(list)), all_x(ni * nj), all_y(ni * nj)
        all_x = reshape(x, [ni * nj])
        all_y = reshape(y, [ni * nj])
        field(1, :) = 0.01_dp * sin(all_x(list))
        field(2, :) = 0.02_dp * cos(2 * all_y(list))
    end function

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
