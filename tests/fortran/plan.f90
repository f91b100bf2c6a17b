! Analysis, plan, solution, and what a basis knows of them.
module plan_tests
    use, intrinsic :: iso_c_binding, only: c_double, c_float
    use body_mesh
    implicit none
    private
    public :: analysis_alone, solution, rational_curves, other_coordinates, pieces, given_parameters, fluxes
    integer :: phases_seen = 0, cancel_in = -1

contains

    subroutine analysis_alone()
        type(hm_plan) :: plan
        type(hm_mesh_report) :: report
        integer, allocatable :: wall(:)
        logical :: loop
        type(hm_error) :: err
        integer :: stat
        call plan%analyse(mesh)
        call plan%report(report)
        call check(report%points == n_points .and. report%quads == n_cells .and. report%inverted == 0, &
            "report of the mesh")
        call plan%boundary([body], wall, loop, piece=1)
        call check(size(wall) == around .and. loop .and. minval(wall) == 1 .and. maxval(wall) == around, "its boundary")
        call plan%boundary([body], wall, piece=2, stat=stat)
        call check(stat == hm_bad_condition .and. .not. allocated(wall), "the body has one piece")
        call plan%factor(stat=stat, err=err)
        call check(stat == hm_bad_argument, "nothing to factor without curves: " // err%text)
    end subroutine

    subroutine solution()
        type(hm_plan) :: plan
        type(hm_curves) :: curves
        type(hm_solve_report) :: solved
        type(hm_options) :: options
        type(hm_basis) :: own
        integer :: stat
        call basis%curves(curves)
        options%progress => watch
        options%tolerance = 1e-9_dp
        phases_seen = 0
        cancel_in = hm_phase_solve
        call plan%analyse(mesh, curves, [hm_condition(body), hm_condition(far_field, hm_fixed)], options=options)
        call check(plan%plan_words() > 0, "size of the plan")
        call check(plan%basis_words() > 0, "size of the basis")
        call plan%prepare()
        call plan%factor()
        call plan%solve(own, stat=stat)
        call check(stat == hm_cancelled, "the callback cancels the solution")
        cancel_in = -1
        call plan%solve(own, solved)
        call check(phases_seen == 127, "all seven phases are reported")
        call check(solved%residual < 1e-12_dp .and. solved%functions == n_control, "the solution")
        call check(solved%residual_function >= 1 .and. solved%residual_function <= n_control, "its worst function")
        call what_a_basis_knows(own, curves)
    end subroutine

    subroutine watch(phase, fraction, cancel)
        integer, intent(in) :: phase
        real(c_double), intent(in) :: fraction
        logical, intent(inout) :: cancel
        phases_seen = ibset(phases_seen, phase)
        if (fraction < 0 .or. fraction > 1) phases_seen = ibset(phases_seen, 20)
        cancel = phase == cancel_in
    end subroutine

    subroutine what_a_basis_knows(own, curves)
        type(hm_basis), intent(in) :: own
        type(hm_curves), intent(in) :: curves
        type(hm_basis_info) :: info
        type(hm_curves) :: same_curves
        real(dp) :: total(n_points), u, distance
        integer :: k
        call own%info(info)
        call check(info%solved .and. info%points == n_points .and. info%index_base == 1, "info of the basis")
        call check(all(sort(info%curve_point) == [(k, k = 1, around)]) .and. all(info%point_curve == 1), &
            "its curve points")
        call check(info%bytes == own%bytes(), "its length")
        call own%curves(same_curves)
        call check(all(same_curves%curve(1)%indices == curves%curve(1)%indices), "its curves")
        call same_curves%project(1, x(info%curve_point(1)), y(info%curve_point(1)), u, distance)
        call check(abs(u - info%point_u(1)) < 1e-9_dp, "its parameters")
        total = 0
        do k = 1, n_control
            total = total + values_of(own, k)
        end do
        call check(maxval(abs(total(:around) - 1)) < 1e-12_dp .and. maxval(abs(total(n_points - around + 1:))) <= 0, &
            "the functions' sum on the boundaries")
    end subroutine

    function values_of(own, number) result(values)
        type(hm_basis), intent(in) :: own
        integer, intent(in) :: number
        real(dp) :: values(n_points)
        call own%values(number, values)
    end function

    function sort(numbers) result(sorted)
        integer, intent(in) :: numbers(:)
        integer :: sorted(size(numbers)), k, least
        sorted = numbers
        do k = 1, size(sorted) - 1
            least = k - 1 + minloc(sorted(k:), 1)
            sorted([k, least]) = sorted([least, k])
        end do
    end function

    subroutine rational_curves()
        type(hm_plan) :: plan
        type(hm_curves) :: curves, same_curves
        type(hm_basis) :: own
        integer :: k
        call basis%curves(curves)
        allocate(curves%weights(n_control), source=1 + 0.1_dp * [(modulo(k, 3), k = 1, n_control)])
        call plan%analyse(mesh, curves, [hm_condition(body)])
        call plan%factor()
        call own%init(plan)
        call own%curves(same_curves)
        call check(maxval(abs(same_curves%weights - curves%weights)) <= 0, "weights of a rational basis")
    end subroutine

    ! A plan without its analysis factors for other coordinates of the same mesh.
    subroutine other_coordinates()
        type(hm_plan) :: plan
        type(hm_curves) :: curves
        type(hm_mesh_report) :: report
        type(hm_basis) :: own, another
        real(dp) :: first(n_points)
        real(dp), target :: x_moved(n_points), y_moved(n_points)
        type(hm_error) :: err
        integer :: stat
        call basis%curves(curves)
        call plan%analyse(mesh, curves, [hm_condition(body)])
        call plan%factor()
        call plan%solve(own)
        call plan%drop_analysis()
        call plan%report(report, stat)
        call check(stat == hm_bad_argument, "no report without an analysis")
        x_moved = 2 * x
        y_moved = 2 * y
        call plan%factor(x_moved, y_moved)
        call plan%solve(own)
        first = values_of(own, 1)
        call plan%factor(real(x_moved, c_float), real(y_moved, c_float))
        call plan%solve(own)
        call check(maxval(abs(first - values_of(own, 1))) < 1e-4_dp, "default reals: nearly the same functions")
        call plan%factor(reshape(real(x, c_float), [around, rings]), reshape(real(y, c_float), [around, rings]))
        call plan%solve(own)
        call check(maxval(abs(first - values_of(own, 1))) < 1e-4_dp, "default reals in rank 2")
        call plan%factor(x_moved(2:), y_moved(2:), stat)
        call check(stat == hm_bad_argument, "a point too few")
        call plan%solve(another, stat=stat, err=err)
        call check(stat == hm_bad_argument, "a basis needs the analysis: " // err%text)
    end subroutine

    ! A piece of a marker: here all of it, of two conditions on it one is left without a piece.
    subroutine pieces()
        type(hm_plan) :: plan
        type(hm_curves) :: curves
        type(hm_basis) :: own
        type(hm_error) :: err
        integer :: stat
        call basis%curves(curves)
        call plan%analyse(mesh, curves, [hm_condition(body, piece=1, near_x=1._dp, near_y=0._dp)])
        call plan%factor()
        call plan%solve(own)
        call check(maxval(abs(values_of(basis, 1) - values_of(own, 1))) < 1e-4_dp, "a piece of a marker")
        call plan%analyse(mesh, curves, [hm_condition(body, piece=1, near_x=1._dp), hm_condition(body)], stat=stat, &
            err=err)
        call check(stat == hm_bad_condition, "no piece is left: " // err%text)
    end subroutine

    ! Points of a curve are used if they are given.
    subroutine given_parameters()
        type(hm_plan) :: plan
        type(hm_curves) :: curves
        type(hm_basis) :: own, in_work
        type(hm_basis_info) :: info
        real(dp), allocatable, target :: work(:)
        type(hm_error) :: err
        integer :: stat
        call basis%curves(curves)
        call basis%info(info)
        call plan%analyse(mesh, curves, [hm_condition(body)])
        call plan%factor()
        call plan%solve(own)
        call plan%analyse(mesh, curves, [hm_condition(body), hm_condition(far_field, hm_fixed)], &
            known_points=info%curve_point, known_curves=info%point_curve, known_u=info%point_u)
        call plan%factor()
        call plan%solve(own, stat=stat, err=err)
        call check(stat == hm_ok, "a basis of another analysis is made anew: " // err%text)
        allocate(work(plan%basis_words()))
        call in_work%init(plan, work)
        call plan%analyse(mesh, curves, [hm_condition(body)])
        call plan%factor()
        call plan%solve(in_work, stat=stat, err=err)
        call check(stat == hm_bad_basis, "but not in the caller's memory: " // err%text)
        call plan%analyse(mesh, curves, [hm_condition(body)], known_points=[1], known_curves=[2], known_u=[0._dp], &
            stat=stat)
        call check(stat < 0, "a given curve that does not exist")
        call plan%analyse(mesh, curves, [hm_condition(body)], known_points=[1, 2], &
            known_curves=[1], known_u=[0._dp], stat=stat)
        call check(stat == hm_bad_argument, "given points of other lengths")
        call plan%analyse(mesh, curves, [hm_condition(body)], known_points=[1], stat=stat)
        call check(stat == hm_bad_argument, "given points without parameters")
    end subroutine

    ! 1 + x + 2 y on a square, by its values on the lower side and its normal derivatives on the others.
    subroutine fluxes()
        integer, parameter :: n = 5
        type(hm_mesh) :: square
        type(hm_plan) :: plan
        type(hm_curves) :: line
        type(hm_basis) :: own
        type(hm_options) :: options
        type(hm_error) :: err
        real(dp), target :: x(n, n), y(n, n)
        real(dp) :: dx(n, n), dy(n, n), flux(2, 3 * (n - 1)), weight(2)
        integer :: faces(2, 3 * (n - 1)), i, j, k, stat
        do j = 1, n
            do i = 1, n
                x(i, j) = (i - 1) / (n - 1._dp)
                y(i, j) = (j - 1) / (n - 1._dp)
            end do
        end do
        call square%points(x, y)
        call square%line(1, 1, n, 1, 1)
        call square%line(2, 1, n, n, n)
        call square%line(2, 1, 1, 1, n)
        call square%line(2, n, n, 1, n)
        call line%fit(x(:, 1), y(:, 1), .false., n_control=2, degree=1)
        weight = [1, 2] / 5._dp                     ! the amounts 1 and 2 times these numbers have the sum 1
        do k = 1, n - 1
            faces(:, 3 * k - 2) = n * (n - 1) + [k, k + 1]
            faces(:, 3 * k - 1) = n * [k, k - 1] + 1
            faces(:, 3 * k) = n * [k, k + 1]
            flux(:, 3 * k - 2) = 2 * weight         ! d/dy on the upper side, -d/dx and d/dx on the others
            flux(:, 3 * k - 1) = -weight
            flux(:, 3 * k) = weight
        end do
        options%operator_kind = hm_laplace
        call plan%analyse(square, line, [hm_condition(1), hm_condition(2, hm_free)], flux_points=faces, fluxes=flux, &
            options=options)
        call plan%factor()
        call plan%solve(own)
        call own%displacement(reshape([1._dp, 0._dp, 2._dp, 0._dp], [2, 2]), dx, dy)
        call check(maxval(abs(dx - (1 + x + 2 * y))) < 1e-13_dp, "fluxes of a linear field")
        call plan%analyse(square, line, [hm_condition(1), hm_condition(2, hm_free)], flux_points=faces, &
            options=options, stat=stat)
        call check(stat == hm_bad_argument, "flux_points without fluxes")
        call plan%analyse(square, line, [hm_condition(1), hm_condition(2, hm_free)], flux_points=faces, &
            fluxes=flux(:1, :), options=options, stat=stat)
        call check(stat == hm_bad_argument, "fluxes of one control point only")
        faces(:, 1) = [1, 2]
        call plan%analyse(square, line, [hm_condition(1), hm_condition(2, hm_free)], flux_points=faces, fluxes=flux, &
            options=options, stat=stat, err=err)
        call check(stat == hm_bad_condition, "a flux through the wall: " // err%text)
    end subroutine
end module
