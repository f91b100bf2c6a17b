! Displacements of wall points that are given.
module given_tests
    use, intrinsic :: iso_c_binding, only: c_float
    use body_mesh
    implicit none
    private
    public :: given_displacements, safe_together

contains

    subroutine given_displacements()
        type(hm_curves) :: curves
        type(hm_plan) :: by_curve, plan
        type(hm_basis) :: functions, none
        type(hm_solve_report) :: report
        type(hm_step_report) :: step
        type(hm_quality_report) :: quality
        real(dp), target :: dx(n_points), dy(n_points), found_x(n_points), found_y(n_points), x2(n_points), y2(n_points)
        real(dp), target :: gx(n_points), gy(n_points)
        real(dp) :: move(2, n_control), wall(2, around), gradient(2, around), size_of_sum
        real(c_float), target :: x4(n_points), y4(n_points)
        type(hm_basis) :: safe
        type(hm_safe_report) :: safe_report
        real(dp), allocatable, target :: walls(:, :, :), fields_x(:, :), fields_y(:, :), gradients(:, :, :)
        integer, allocatable :: points(:), list(:)
        integer :: k
        type(hm_error) :: err
        integer :: stat
        call curves%fit(x(:around), y(:around), .true., n_control=n_control)
        call by_curve%analyse(mesh, curves, [hm_condition(body)])
        call by_curve%factor()
        call by_curve%solve(functions)
        move = reshape([(0.002_dp * sin(1.7_dp * k), k = 1, 2 * n_control)], [2, n_control])
        call functions%displacement(move, dx, dy)
        call by_curve%displacement(wall, found_x, found_y, stat=stat, err=err)
        call check(stat == hm_bad_condition, "no marker with hm_given: " // err%text)

        call plan%displacement(wall, found_x, found_y, stat=stat)
        call check(stat == hm_bad_argument, "displacements without a plan")
        call plan%analyse(mesh, conditions=[hm_condition(body, hm_given)])
        call plan%factor()
        call plan%given_points(points)
        call check(size(points) == around .and. minval(points) == 1 .and. maxval(points) == around, "the given points")
        wall(1, :) = dx(points)
        wall(2, :) = dy(points)
        call plan%displacement(wall, found_x, found_y, report=report)
        call check(maxval(abs(found_x - dx)) + maxval(abs(found_y - dy)) < 1e-12_dp, "displacements as of the curve")
        call check(report%functions == 1 .and. report%residual_function == 1 .and. report%residual < 1e-12_dp, &
            "report of a displacement")
        call check(same(found_x(points), wall(1, :)) .and. same(found_y(points), wall(2, :)), &
            "wall points move by the given bits")
        x2 = x
        y2 = y
        list = [(around + 1 - k, k = 1, around)]
        wall(1, :) = dx(list)
        wall(2, :) = dy(list)
        call plan%displace(wall, x2, y2, list)
        call check(same(x2, x + found_x) .and. same(y2, y + found_y), "in place, by a list")

        x4 = signaling()
        y4 = signaling()
        call plan%displacement(real(wall, c_float), x4, y4, list)
        call check(maxval(abs(x4 - found_x)) + maxval(abs(y4 - found_y)) < 1e-6_dp, "in default reals")
        gx = [(sin(3._dp * k), k = 1, n_points)]
        gy = [(cos(2._dp * k), k = 1, n_points)]
        call plan%displace_adjoint(gx, gy, gradient, list)
        size_of_sum = sum(abs(gx * found_x)) + sum(abs(gy * found_y))
        call check(abs(sum(gx * found_x + gy * found_y) - sum(gradient * wall)) < 1e-13_dp * size_of_sum, &
            "the same work on mesh and wall")
        allocate(walls(2, around, 3), fields_x(n_points, 3), fields_y(n_points, 3), gradients(2, around, 3))
        do k = 1, 3
            walls(:, :, k) = k * wall
        end do
        call plan%displacements(walls, fields_x, fields_y, list)
        call check(maxval(abs(fields_x(:, 3) - 3 * found_x)) < 1e-13_dp, "several fields")
        call plan%displace_adjoints(fields_x, fields_y, gradients, list)
        call check(abs(sum(fields_x(:, 2)**2 + fields_y(:, 2)**2) - sum(gradients(:, :, 2) * walls(:, :, 2))) < &
            1e-12_dp * sum(fields_x(:, 2)**2 + fields_y(:, 2)**2), "several transposes")

        call none%init(plan)
        call none%assess(mesh, found_x, found_y, step, quality)
        call check(step%admissible > 1 .and. quality%inverted == 0, "assessment by a basis without functions")
        call plan%displace_safe(safe, wall, x2, y2, points=list, options=hm_safe_options(min_quality=-1._dp), &
            report=safe_report)
        call check(safe_report%strategy == hm_strategy_linear .and. safe_report%other == -1, "a small one, safely")
        call check(maxval(abs(x2 - x - found_x)) + maxval(abs(y2 - y - found_y)) < 1e-13_dp, "the same mesh, safely")
        wall(1, :) = -0.3_dp * x(list) - 0.8_dp * y(list)
        wall(2, :) = 0.8_dp * x(list) - 0.3_dp * y(list)
        call plan%displace_safe(safe, wall, x2, y2, points=list, options=hm_safe_options(min_quality=-1._dp), &
            report=safe_report, stat=stat, err=err)
        call check(stat == hm_ok .and. safe_report%inverted == 0, "a large one, safely: " // err%text)
        call check(same(x2(list), x(list) + wall(1, :)) .and. same(y2(list), y(list) + wall(2, :)), &
            "a large one, by the given bits")
        x4 = real(x, c_float)
        y4 = real(y, c_float)
        call plan%displace_safe(safe, real(0.01_dp * wall, c_float), x4, y4, points=list)
        call check(maxval(abs(x4(list) - x(list) - 0.01_dp * wall(1, :))) < 1e-6_dp, "safely, in default reals")
        wall(1, 3) = 1e4_dp
        call plan%displace_safe(safe, wall, x2, y2, points=list, stat=stat)
        call check(stat == hm_crossing, "a wall that crosses itself, safely")
        call plan%displace_safe(safe, wall, x2(2:), y2(2:), points=list, stat=stat)
        call check(stat == hm_bad_argument, "fewer mesh points, safely")
        call plan%displace_safe(safe, wall, x2, y2, move, list, stat=stat)
        call check(stat == hm_bad_argument, "a movement of functions that are not there, safely")

        call plan%displacement(wall(:, 2:), found_x, found_y, stat=stat, err=err)
        call check(stat == hm_bad_argument, "a point less: " // err%text)
        call plan%displacement(wall, found_x(2:), found_y(2:), stat=stat)
        call check(stat == hm_bad_argument, "fewer mesh points")
        wall = 0
        wall(1, 3) = huge(1._dp)
        call plan%displacement(wall, found_x, found_y, list, stat=stat, err=err)
        call check(stat == hm_bad_argument .and. err%item == list(3) .and. index(err%text, "field 1") > 0, &
            "beyond the range: " // err%text)
    end subroutine

    ! The body on its curve, the outer boundary given: both move in one call.
    subroutine safe_together()
        type(hm_curves) :: curves
        type(hm_plan) :: plan
        type(hm_basis) :: basis
        type(hm_safe_report) :: report
        real(dp), target :: x2(n_points), y2(n_points), moved_x(n_points), moved_y(n_points)
        real(dp) :: move(2, n_control)
        real(dp), allocatable :: wall(:, :)
        integer, allocatable :: points(:)
        call curves%fit(x(:around), y(:around), .true., n_control=n_control)
        call plan%analyse(mesh, curves, [hm_condition(body), hm_condition(far_field, hm_given)])
        call plan%factor()
        call plan%solve(basis)
        call plan%given_points(points)
        allocate(wall(2, size(points)))
        wall(1, :) = 0.05_dp * x(points)
        wall(2, :) = 0.1_dp
        move = 0.01_dp
        x2 = x
        y2 = y
        call plan%displace_safe(basis, wall, x2, y2, move, points, report=report)
        call check(report%step_fraction >= 1 .and. same(x2(points), x(points) + wall(1, :)), &
            "the outer boundary as given")
        call basis%morph_to(move, x, y, moved_x, moved_y)
        call check(maxval(abs(x2(:around) - moved_x(:around))) < 1e-14_dp, "and the curve in the same call")
    end subroutine
end module
