! Refused calls, and the numbers in their errors.
module refusals_tests
    use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t
    use body_mesh
    implicit none
    private
    public :: numbers_in_errors, refusals, shared_points

contains

    ! Numbers in texts and items count from 1, whatever C says.
    subroutine numbers_in_errors()
        type(hm_curves) :: curves, copy
        real(dp) :: move(2, n_control), bad_x(around), bad_y(around), all_x(n_points), nan
        type(hm_error) :: err
        integer :: stat
        nan = transfer(9221120237041090560_c_int64_t, nan)
        bad_x = x(:around)
        bad_y = y(:around)
        bad_x(1) = nan
        call curves%fit(bad_x, bad_y, .true., stat=stat, err=err)
        call check(err%item == 1, "the first point of a fit")
        call check(err%text == "point 1 has a coordinate that is not finite", "in words: " // err%text)
        bad_x = x(:around)
        bad_x(11) = bad_x(10)
        bad_y(11) = bad_y(10)
        call curves%fit(bad_x, bad_y, .true., stat=stat, err=err)
        call check(err%text == "the consecutive points 10 and 11 are equal", "two points of a fit: " // err%text)
        call check(err%item == 10, "the first of them")
        call curves%set(reshape([0, 0, 1, 0, 2, 1, 3, 0] * 1._dp, [2, 4]))
        call curves%add(1, [0, 0, 1, 1] * 1._dp, [1_c_int32_t, 2_c_int32_t])
        call curves%add(2, [0, 0, 0, 2, 1, 1, 1] * 1._dp)
        call curves%check(stat, err)
        call check(err%text == "knot 5 of curve 2 is smaller than the knot before it", "a knot: " // err%text)
        call check(err%item == 5, "its number")
        copy = curves
        copy%curve(2)%knots = [0, 0, 0, 1, 2, 2, 2] * 1._dp
        copy%control(1, 2) = nan
        call copy%check(stat, err)
        call check(err%text == "control point 2 of curve 1 has a coordinate that is not finite", &
                   "a control point: " // err%text)
        call check(err%item == 2, "control points count from 1 in C, too")
        copy = curves
        copy%curve(2)%degree = 0
        copy%curve(2)%knots = [0, 0, 1, 1, 1] * 1._dp
        call copy%check(stat, err)
        call check(err%text == "curve 2 has degree 0, but the degree must be 1 to 5", "a degree: " // err%text)
        call check(err%item == 2, "of the second curve")
        move = 0
        move(2, n_control) = nan
        call basis%displacement(move, x, y, stat=stat, err=err)
        call check(index(err%text, "movement of function 14 ") > 0, "a movement: " // err%text)
        call check(err%item == n_control, "of the last function")
        all_x = x
        all_x(5) = x(5) + 10
        call basis%recover(all_x, y, move, stat=stat, err=err)
        call check(stat == hm_bad_mesh .and. err%item_kind == hm_item_point .and. err%item == 5 .and. &
            err%item_base == 1, "a point of the wall far away: " // err%text)
        call check(same([err%x, err%y], [all_x(5), y(5)]), "the place of this point")
        call check(err%value > 5 .and. err%value <= 10, "the distance of this point")
        call check(err%other_kind == hm_item_none .and. err%other == -1, "nothing else is named")
    end subroutine

    ! The wall of a ring has two markers, whose bodies touch at two points.
    subroutine shared_points()
        integer, parameter :: ni = 25, nj = 6
        type(hm_mesh) :: ring
        type(hm_plan) :: plan
        type(hm_basis) :: bodies
        type(hm_basis_info) :: info
        type(hm_error) :: err
        real(dp), target :: x(ni, nj), y(ni, nj)
        real(dp) :: a(ni, nj), b(ni, nj), move(2, 4), error
        integer :: i, j, stat
        do j = 1, nj
            do i = 1, ni
                x(i, j) = j * cos(8 * atan(1._dp) * modulo(i - 1, ni - 1) / (ni - 1))
                y(i, j) = j * sin(8 * atan(1._dp) * modulo(i - 1, ni - 1) / (ni - 1))
            end do
        end do
        call ring%points(x, y)
        call ring%line(1, 1, 13, 1, 1)
        call ring%line(2, 13, ni, 1, 1)
        call ring%line(3, 1, ni, nj, nj)
        call plan%analyse(ring, conditions=[hm_condition(1, hm_rigid), hm_condition(2, hm_rigid, body=2)], &
            stat=stat, err=err)
        call check(stat == hm_torn .and. err%item_kind == hm_item_point, "bodies that touch: " // err%text)
        call plan%factor()
        call plan%solve(bodies)
        call bodies%info(info)
        call check(size(info%shared_point) == 2 .and. all(info%shared_condition(1, :) == 1) .and. &
            all(info%shared_condition(2, :) == 2), "both touch at two points")
        call check(any(info%shared_point == 1) .and. any(info%shared_point == 13), "at these")
        move = 0
        move(1, 1) = 0.1_dp
        call bodies%morph_to(move, x, y, a, b)
        call bodies%boundary_error(move, x, y, a, b, error, stat=stat, err=err)
        call check(stat == hm_torn .and. abs(error - 0.1_dp) < 1e-12_dp .and. abs(err%value - 0.1_dp) < 1e-12_dp, &
            "one body moves: " // err%text)
        move(1, 3) = 0.1_dp
        call bodies%morph_to(move, x, y, a, b)
        call bodies%boundary_error(move, x, y, a, b, error, stat=stat)
        call check(stat == 0 .and. error < 1e-12_dp, "both bodies move")
    end subroutine

    subroutine refusals()
        type(hm_basis) :: empty
        type(hm_plan) :: plan
        real(dp) :: move(2, n_control), a(n_points), b(n_points), gradient(2, n_control), error
        type(hm_quality_report) :: quality
        type(hm_mesh) :: bad
        type(hm_curves) :: curves
        integer(c_int32_t), target :: five(5, 2)
        type(hm_solve_report) :: report
        type(hm_options) :: options
        type(hm_error) :: err
        integer :: stat
        move = 0
        five = 1
        call empty%morph(move, a, b, stat=stat, err=err)
        call check(stat == hm_bad_argument .and. err%code == stat, "an empty basis: " // err%text)
        call basis%morph(move(:, 2:), x, y, stat=stat, err=err)
        call check(stat == hm_bad_argument, "a control point too few: " // err%text)
        call basis%morph(move, x(2:), y(2:), stat=stat, err=err)
        call check(stat == hm_bad_argument, "a mesh point too few: " // err%text)
        move(1, 1) = transfer(9218868437227405312_c_int64_t, move(1, 1))        ! infinite
        a = x
        b = y
        call basis%morph(move, a, b, stat=stat, err=err)
        call check(stat == hm_bad_argument .and. same(a, x), "a movement that is not finite: " // err%text)
        call basis%adjoint(a, b(2:), gradient, stat=stat, err=err)
        call check(stat == hm_bad_argument .and. &
            err%text == "x and y have different shapes, or one of them is not allocated", "a gradient: " // err%text)
        call basis%boundary_error(some_move(), x, y, a(2:), b(2:), error, stat=stat)
        call check(stat == hm_bad_argument, "another length")
        call basis%assess(mesh, quality, x(2:), y(2:), stat=stat)
        call check(stat == hm_bad_argument, "a reference of another length")
        call basis%values(0, a, stat=stat)
        call check(stat == hm_bad_argument, "there is no function 0")
        call basis%values(1, a(2:), stat=stat)
        call check(stat == hm_bad_argument, "too little room for values")
        call plan%solve(empty, report, stat)
        call check(stat == hm_bad_argument, "an empty plan")
        call bad%cells(cells, stat, err)
        call check(stat == hm_bad_argument, "cells before points: " // err%text)
        call bad%line(1, 1, 2, 1, 1, stat=stat, err=err)
        call check(stat == hm_bad_argument, "a line before points: " // err%text)
        call bad%points(x, y)
        call bad%cells(five, stat)
        call check(stat == hm_bad_argument, "cells of five points")
        call bad%faces(faces, markers(2:), stat)
        call check(stat == hm_bad_argument, "faces and markers do not fit")
        call bad%lists(faces(:, 1), markers(:2), markers(:2), stat)
        call check(stat == hm_bad_argument, "lists and markers do not fit")
        call bad%points(x(:0), y(:0), stat=stat)
        call check(stat == hm_bad_argument, "no points")
        call bad%free()
        call plan%analyse(bad, stat=stat, err=err)
        call check(stat == hm_bad_argument .or. stat == hm_bad_mesh, "an empty mesh: " // err%text)
        call basis%curves(curves)
        call plan%analyse(mesh, curves, [hm_condition(1234)], stat=stat, err=err)
        call check(stat == hm_bad_condition, "a marker that no face has: " // err%text)
        call check(index(err%text, "condition 1 ") > 0, "it is of the first condition: " // err%text)
        call check(err%item == 1234, "the item is the marker")
        call plan%analyse(mesh, curves, [hm_condition(far_field, hm_fixed), hm_condition(body, first_curve=2)], &
            stat=stat, err=err)
        call check(stat == hm_bad_condition, "a curve that does not exist: " // err%text)
        call check(index(err%text, "condition 2 ") > 0, "the text counts conditions from 1: " // err%text)
        call check(err%item == 2, "and so does the item")
        call plan%analyse(mesh, curves, [hm_condition(body), hm_condition(far_field, hm_fixed, body=2)], &
            stat=stat, err=err)
        call check(stat == hm_bad_condition .and. index(err%text, "body") > 0, "of another kind: " // err%text)
        call plan%analyse(mesh, curves, [hm_condition(body), hm_condition(far_field, hm_fixed, first_curve=2)], &
            stat=stat)
        call check(stat == hm_bad_condition, "a fixed marker on a curve")
        call plan%analyse(mesh, curves, stat=stat)
        call check(stat == hm_bad_condition, "no condition")
        options%engine = 77
        call plan%analyse(mesh, curves, [hm_condition(body)], options=options, stat=stat)
        call check(stat == hm_unsupported, "an engine to come")
        deallocate(curves%curve(1)%knots)
        call plan%analyse(mesh, curves, [hm_condition(body)], stat=stat)
        call check(stat == hm_bad_argument, "a curve without knots")
    end subroutine
end module
