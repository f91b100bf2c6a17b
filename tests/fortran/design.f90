! Finer curves, measures with derivatives, design variables, functions by table.
module design_tests
    use, intrinsic :: iso_c_binding, only: c_float
    use body_mesh
    implicit none
    private
    public :: design, moved_sections, refits, smooth_gradients, tables

contains

    ! The curve of an airfoil becomes the airfoil with heights of 110 %: the points of the latter are on the moved
    ! curve.
    subroutine refits()
        integer, parameter :: n = 120
        type(hm_curves) :: curves, moved
        type(hm_refit_report) :: report
        type(hm_error) :: err
        real(dp) :: px(n), py(n), u, distance, largest
        real(dp), allocatable :: movement(:, :)
        integer :: k, stat
        call fit_airfoil(curves, px, py)
        allocate(movement(2, size(curves%control, 2)))
        call curves%refit(1, px, 1.1_dp * py, .true., movement, report=report)
        call check(report%max_error < 1e-4_dp .and. report%closed == hm_tied, "a refit of the thicker airfoil")
        call check(report%max_error_point >= 1 .and. report%max_error_point <= n, "the point of the largest error")
        moved = curves
        moved%control = curves%control + movement
        largest = 0
        do k = 1, n
            call moved%project(1, px(k), 1.1_dp * py(k), u, distance)
            largest = max(largest, distance)
        end do
        call check(largest <= report%max_error + 1e-12_dp, "the points are on the moved curve")
        call curves%refit(1, real(2 * px, c_float), real(2.2_dp * py, c_float), .true., movement, on_chord=.true.)
        call check(maxval(abs(curves%control + movement - moved%control)) < 1e-4_dp, &
            "an airfoil of twice the size, on the chord of the curve")
        call curves%refit(2, px, py, .true., movement, stat=stat, err=err)
        call check(stat == hm_bad_argument .and. err%text == "curve 2 does not exist", "curve 2: " // err%text)
        call curves%refit(1, px, py, .true., movement(:, 2:), stat=stat)
        call check(stat == hm_bad_argument, "a movement with too few columns")
        call curves%refit(1, px(2:), py, .true., movement, stat=stat)
        call check(stat == hm_bad_argument, "x and y of different lengths")
    end subroutine

    ! The smoothed gradient: length 0 keeps the gradient; a positive length leaves a direction of descent.
    ! A curve through points of a NACA 0012.
    subroutine fit_airfoil(curves, px, py)
        type(hm_curves), intent(inout) :: curves
        real(dp), intent(out) :: px(:), py(:)
        real(dp) :: t
        integer :: k
        do k = 1, size(px)
            t = 6.283185307179586_dp * (k - 1) / size(px)
            px(k) = 0.5_dp * (1 + cos(t))
            py(k) = sign(0.594689181_dp * (0.298222773_dp * sqrt(px(k)) - 0.127125232_dp * px(k) - 0.357907906_dp * &
                px(k)**2 + 0.291984971_dp * px(k)**3 - 0.105174606_dp * px(k)**4), sin(t))
        end do
        call curves%fit(px, py, .true., n_control=24)
    end subroutine

    ! A flap, then a turn, by values; and the modes of two movements.
    subroutine moved_sections()
        type(hm_curves) :: curves
        real(dp), allocatable :: move(:, :), by(:, :, :), next(:, :), pair(:, :, :)
        real(dp) :: start(2), error(2), singular(2), px(120), py(120)
        integer :: n, stat
        type(hm_movement) :: movements(2)
        type(hm_fit_report) :: report
        call fit_airfoil(curves, px, py)
        call curves%fit(px, py, .true., n_control=60, details=hm_fit_details(tolerance=1e-3_dp), report=report)
        call check(size(curves%control, 2) < 24 .and. report%max_error <= 1e-3_dp, "a fit to a tolerance")
        call curves%fit(px, py, .true., details=hm_fit_details(weights=px(2:)), stat=stat)
        call check(stat == hm_bad_argument, "weights that are too few")
        n = size(curves%control, 2)
        allocate(move(2, n), by(2, n, 2), next(2, n), pair(2, n, 2))
        movements = [hm_movement(hm_flap, [0.7_dp, 0._dp]), hm_movement(hm_rotate, [0.25_dp, 0._dp])]
        call curves%move_section(movements, [-10._dp, 3._dp], move, by, start, error)
        call curves%move_section(movements, [-10._dp + 1e-5_dp, 3._dp], next)
        call check(maxval(abs(move)) > 0.015_dp .and. maxval(abs(start)) <= 0, "a section that values move")
        call check(error(1) > 0 .and. error(1) < error(2) .and. error(2) < 0.1_dp, "what control points do not follow")
        call curves%move_section(movements(2:), [3._dp], next, error=error)
        call check(maxval(abs(error)) <= 0, "a turn leaves no error")
        call curves%move_section(movements, [-10._dp + 1e-5_dp, 3._dp], next)
        call check(maxval(abs((next - move) / 1e-5_dp - by(:, :, 1))) < 1e-7_dp, "derivatives by the values")
        call curves%move_section(movements, [1._dp], move, stat=stat)
        call check(stat == hm_bad_argument, "values that are too few")
        pair(:, :, 1) = 2 * move
        pair(:, :, 2) = -move
        call curves%family_modes(pair, singular)
        call check(singular(1) > 0.001_dp .and. singular(2) < 1e-12_dp .and. all(abs(pair(:, :, 2)) <= 0), &
            "modes of a family")
        call curves%family_modes(pair, singular(:1), stat=stat)
        call check(stat == hm_bad_argument, "singular values that are too few")
    end subroutine

    subroutine smooth_gradients()
        type(hm_curves) :: curves
        real(dp), allocatable :: gradient(:, :), smoothed(:, :)
        integer :: k, stat
        call basis%curves(curves)
        allocate(gradient(2, size(curves%control, 2)), smoothed(2, size(curves%control, 2)))
        gradient(1, :) = 0
        gradient(2, :) = [((-1._dp)**k, k = 1, size(gradient, 2))]
        call curves%smooth_gradient(0._dp, gradient, smoothed)
        call check(maxval(abs(smoothed - gradient)) < 1e-12_dp, "a gradient that is smoothed over length 0")
        call curves%smooth_gradient(0.5_dp, gradient, smoothed)
        call check(sum(smoothed * gradient) > 0, "the smoothed gradient is a direction of descent")
        call check(norm2(smoothed) < 0.5_dp * norm2(gradient), "waves are damped")
        call curves%smooth_gradient(-1._dp, gradient, smoothed, stat=stat)
        call check(stat == hm_bad_argument, "a negative length")
        call curves%smooth_gradient(1._dp, gradient(:, 2:), smoothed, stat=stat)
        call check(stat == hm_bad_argument, "a gradient with too few columns")
    end subroutine

    ! More control points, measures with their gradients, variables that are not control points, and their functions.
    subroutine design()
        type(hm_curves) :: curves, finer, moved
        type(hm_basis) :: few, again
        type(hm_basis_info) :: info
        type(hm_quantity) :: wanted(3)
        type(hm_section) :: section
        real(dp), allocatable :: matrix(:, :), error(:, :)
        complex(dp), allocatable :: map(:, :)
        real(dp), allocatable :: v(:, :), move(:, :), gradients(:, :, :), of_few(:, :), of_all(:, :)
        real(dp) :: values(3), at(2, 3), up(3), down(3), xy_u(2, 0:0), same_u(2, 0:0), difference
        real(dp), dimension(n_points) :: dx, dy, basis_dx, basis_dy
        real(dp), parameter :: eps = 1e-5_dp
        type(hm_error) :: err
        integer :: stat
        call basis%curves(curves)
        call curves%refine(1, [0.3_dp, 0.6_dp], finer, matrix)
        call check(size(finer%control, 2) == size(curves%control, 2) + 2, "two knots are two control points more")
        call check(maxval(abs(matmul(curves%control, transpose(matrix)) - finer%control)) < 1e-14_dp, &
            "the matrix of refine")
        call curves%point(1, 0.45_dp, xy_u)
        call finer%point(1, 0.45_dp, same_u)
        call check(maxval(abs(xy_u - same_u)) < 1e-14_dp, "the same curve")
        call curves%refine(1, 4, finer, matrix)
        call finer%point(1, 0.45_dp, same_u)
        call check(finer%curve(1)%degree == 4 .and. maxval(abs(xy_u - same_u)) < 1e-14_dp, "degree 4, the same curve")
        call curves%refine(1, 5, finer, stat=stat)
        call check(stat == hm_bad_argument, "the degree rises by 1 at a time")
        call curves%refine(1, [7._dp], finer, stat=stat, err=err)
        call check(stat == hm_bad_argument .and. index(err%text, "knot 1") == 1, "a knot outside: " // err%text)

        section%leading = [minval(curves%control(1, :)), 0._dp]
        section%trailing = [maxval(curves%control(1, :)), 0._dp]
        wanted(1) = hm_quantity(hm_area)
        wanted(2) = hm_quantity(hm_thickness, 0.4_dp)
        wanted(3) = hm_quantity(hm_clearance, polygon=reshape([0.3_dp, 0._dp, 0.4_dp, 0.01_dp], [2, 2]))
        allocate(gradients(2, size(curves%control, 2), 3))
        call curves%measure(wanted, values, at, gradients, section)
        call check(values(1) > 0 .and. values(2) > 0, "area and thickness")
        moved = curves
        moved%control(2, 3) = curves%control(2, 3) + eps
        call moved%measure(wanted, up, section=section)
        moved%control(2, 3) = curves%control(2, 3) - eps
        call moved%measure(wanted, down, section=section)
        difference = maxval(abs((up - down) / (2 * eps) - gradients(2, 3, :)))
        call check(difference < 1e-6_dp, "derivatives of the measures")
        wanted(2)%station = 2
        call curves%measure(wanted, values, section=section, stat=stat, err=err)
        call check(stat == hm_bad_argument .and. err%item == 2, "a station outside: " // err%text)
        wanted(2) = hm_quantity(hm_thickness, 1e-9_dp)
        section%leading(1) = section%leading(1) - 1
        call curves%measure(wanted, values, section=section, stat=stat, err=err)
        call check(stat == hm_bad_curve .and. err%item == 2, "a station without section: " // err%text)
        section%leading(1) = section%leading(1) + 1

        call curves%map(hm_variables(hm_cst, n_upper=3, n_lower=2), map, error, section)
        call check(all(shape(map) == [size(curves%control, 2), 5]) .and. all(error(1, :) <= error(2, :)), "a map")
        call curves%map(hm_variables(hm_hicks_henne, n_upper=2, peaks=[0.3_dp]), map, stat=stat)
        call check(stat == hm_bad_argument, "one peak for two bumps")
        call curves%map(hm_variables(hm_cst, n_upper=3, n_lower=2), map, error, section)
        call basis%combine(map, few)
        call few%info(info)
        call check(info%combined == 5 .and. info%functions == 5, "functions of five variables")
        allocate(v(2, 5), move(2, size(map, 1)), of_few(2, 5), of_all(2, size(map, 1)))
        v = 0
        v(1, :) = [0.01_dp, -0.02_dp, 0.03_dp, 0.01_dp, -0.01_dp]
        move(1, :) = real(matmul(map, cmplx(v(1, :), v(2, :), dp)), dp)
        move(2, :) = aimag(matmul(map, cmplx(v(1, :), v(2, :), dp)))
        call few%displacement(v, dx, dy)
        call basis%displacement(move, basis_dx, basis_dy)
        call check(maxval(abs(dx - basis_dx)) < 1e-15_dp .and. maxval(abs(dy - basis_dy)) < 1e-15_dp, &
            "they move the mesh alike")
        call few%adjoint(dx, dy, of_few)
        call basis%adjoint(dx, dy, of_all)
        call check(abs(sum(of_few * v) - sum(of_all * move)) < 1e-13_dp * sum(abs(of_all * move)), &
            "and their gradients")
        call few%moved_curves(v, moved)
        call check(maxval(abs(moved%control - curves%control - move)) < 1e-15_dp, "moved curves")
        call basis%combine(real(map, dp), again, stat=stat, err=err)
        call check(stat == hm_bad_condition, "columns that are zero: " // err%text)
        call basis%combine(aimag(map), again)
        call again%info(info)
        call check(info%combined == 5, "a real matrix")
    end subroutine

    ! The wall as a table of modes in place of the curve.
    subroutine tables()
        type(hm_plan) :: plan
        type(hm_basis) :: none, two
        type(hm_basis_info) :: info
        complex(dp), allocatable :: modes(:, :)
        integer, allocatable :: points(:)
        real(dp), dimension(n_points) :: dx, dy
        integer :: k
        logical :: loop
        type(hm_error) :: err
        integer :: stat
        call plan%analyse(mesh, conditions=[hm_condition(body, hm_given)], stat=stat, err=err)
        call check(stat >= 0, "given displacements without curves: " // err%text)
        call plan%factor()
        call plan%boundary([body], points, loop)
        call none%init(plan)
        allocate(modes(size(points), 2))
        do k = 1, size(points)
            modes(k, :) = [cmplx(x(points(k)), 0, dp), cmplx(0.5_dp, y(points(k)), dp)]
        end do
        call plan%tabulate(none, modes, two, points, stat=stat, err=err)
        call check(stat >= 0, "functions by table: " // err%text)
        call two%info(info)
        call check(info%modes == 2 .and. info%functions == 2, "two modes")
        call two%displacement(reshape([0.1_dp, 0._dp, 0._dp, 0.2_dp], [2, 2]), dx, dy)
        call check(maxval(abs(dx(points) - 0.1_dp * x(points) + 0.2_dp * y(points))) < 1e-15_dp, "along x")
        call check(maxval(abs(dy(points) - 0.1_dp)) < 1e-15_dp, "along y")
        modes(:, 2) = 0
        call plan%tabulate(none, modes, two, points, stat=stat, err=err)
        call check(stat == hm_bad_condition .and. err%item == 2, "a mode that is zero: " // err%text)
    end subroutine
end module
