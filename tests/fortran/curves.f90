! Curves: by hand, as fits, points of them, projections.
module curves_tests
    use, intrinsic :: iso_c_binding, only: c_float, c_int32_t, c_int64_t
    use body_mesh
    implicit none
    private
    public :: curves_by_hand, fits, fits_of_walls

contains

    ! A half circle as a rational curve of degree 2, and two straight lines that share its ends.
    subroutine curves_by_hand()
        type(hm_curves) :: curves, copy
        real(dp) :: xy_u(2, 0:1), values(3, 0:2), u, distance
        real(dp), parameter :: s = sqrt(0.5_dp)
        integer, allocatable :: control(:)
        type(hm_error) :: err
        integer :: stat
        call curves%set(reshape([1, 0, 1, 1, 0, 1, -1, 1, -1, 0] * 1._dp, [2, 5]), [1._dp, s, 1._dp, s, 1._dp])
        call curves%add(2, [0, 0, 0, 1, 1, 2, 2, 2] * 1._dp)
        call curves%add(1, [0, 0, 1, 1] * 1._dp, [5_c_int32_t, 1_c_int32_t])
        call curves%add(1, [0, 0, 1, 1] * 1._dp, [5_c_int64_t, 3_c_int64_t])
        call curves%check(stat, err)
        call check(stat == hm_ok .and. size(curves%curve) == 3, "curves by hand: " // err%text)
        call curves%point(1, 0.5_dp, xy_u)
        call check(all(abs(xy_u(:, 0) - s) < 1e-15_dp), "half of a quarter of a circle")
        call check(abs(dot_product(xy_u(:, 0), xy_u(:, 1))) < 1e-14_dp, "its tangent")
        call curves%basis(1, 0.5_dp, control, values)
        call check(all(control == [1, 2, 3]), "control points of the first segment")
        call check(abs(sum(values(:, 0)) - 1) < 1e-15_dp .and. abs(sum(values(:, 1))) < 1e-14_dp, "partition of unity")
        call curves%basis(3, 0.25_dp, control, values)
        call check(all(control == [5, 3]) .and. abs(values(2, 0) - 0.25_dp) < 1e-15_dp, "a straight line by indices")
        call curves%project(1, 0._dp, 3._dp, u, distance)
        call check(abs(u - 1) < 1e-9_dp .and. abs(distance - 2) < 1e-14_dp, "projection")

        copy = curves
        copy%curve(1)%knots(4) = 3
        call copy%check(stat, err)
        call check(stat == hm_bad_curve, "knots that decrease: " // err%text)
        call curves%check(stat)
        call check(stat == hm_ok, "curves are plain data: a copy is another one")
        call curves%point(4, 0._dp, xy_u, stat)
        call check(stat == hm_bad_argument, "there is no fourth curve")
        call curves%point(1, 9._dp, xy_u, stat)
        call check(stat == hm_bad_argument, "a parameter outside")
        call curves%basis(1, 0.5_dp, control, values(:2, :), stat)
        call check(stat == hm_bad_argument, "values for two functions only")
        call curves%point(1, 0.5_dp, values, stat)
        call check(stat == hm_bad_argument, "points of three coordinates")
        copy = curves
        deallocate(copy%curve(2)%indices)
        call copy%check(stat)
        call check(stat == hm_bad_curve, "knots for fewer control points")
        copy = curves
        deallocate(copy%weights)
        call copy%check(stat)
        call check(stat == hm_ok, "the same, not rational")
        copy%weights = [1._dp]
        call copy%check(stat)
        call check(stat == hm_bad_argument, "one weight for five points")
        copy = hm_curves()
        call copy%check(stat)
        call check(stat == hm_bad_argument, "no curves at all")
    end subroutine

    subroutine fits()
        type(hm_curves) :: curves, again
        type(hm_fit_report) :: report
        real(dp), allocatable, target :: work(:)
        integer(c_int64_t) :: words
        type(hm_error) :: err
        integer :: stat
        call curves%fit(x(:around), y(:around), .true., degree=3, n_control=n_control, report=report)
        call check(report%closed == hm_periodic .and. report%max_error < 2e-3_dp, "the fit of a smooth body")
        call check(report%max_error_point >= 1 .and. report%max_error_point <= around, "where it is worst")
        call check(report%first_point >= 1 .and. report%base_points == 0, "where it begins")
        call check(size(curves%control, 2) == n_control, "number of control points")
        call check(minval(curves%curve(1)%indices) == 1 .and. maxval(curves%curve(1)%indices) == n_control, &
            "indices count from 1")
        call hm_fit_words(around, words, n_control=n_control)
        allocate(work(words))
        call again%fit(x(:around), y(:around), .true., n_control=n_control, closed=hm_periodic, work=work)
        call check(all(curves%control <= again%control .and. curves%control >= again%control), "the same in own memory")
        call again%fit(x(:around), y(:around), .true., n_control=n_control, work=work(2:), stat=stat, err=err)
        call check(stat == hm_block_too_small .and. err%value > 0, "8 bytes less are refused")
        call again%fit(real(x(:around), c_float), real(y(:around), c_float), .true., n_control=n_control)
        call check(maxval(abs(again%control - curves%control)) < 1e-4_dp, "fit of default reals")
        call again%fit(x(:around), y(2:around), .true., stat=stat)
        call check(stat == hm_bad_argument, "x and y of different lengths")
        call hm_fit_words(3, words, degree=3, stat=stat)
        call check(stat < 0, "a fit of three points")
    end subroutine

    ! Walls of the mesh: the curves through the points that plan%boundary gives, of one marker and of two.
    subroutine fits_of_walls()
        type(hm_curves) :: curves, by_points, outer
        type(hm_fit_report) :: report, of_wall, of_outer
        type(hm_mesh) :: from_0
        type(hm_plan) :: plan
        integer, allocatable :: wall(:)
        logical :: loop
        type(hm_error) :: err
        integer :: stat
        call plan%analyse(mesh)
        call plan%boundary([far_field], wall, loop)
        call outer%fit(x(wall), y(wall), loop, degree=4, n_control=n_control, closed=hm_periodic, report=of_outer)
        call plan%boundary([body], wall, loop)
        call by_points%fit(x(wall), y(wall), loop, degree=4, n_control=n_control, closed=hm_periodic, report=of_wall)
        call curves%fit(mesh, body, degree=4, n_control=n_control, closed=hm_periodic, report=report)
        call check(size(curves%curve) == 1 .and. curves%curve(1)%degree == 4, "the fit of a marker is one curve")
        call check(same([curves%control], [by_points%control]) .and. &
            same(curves%curve(1)%knots, by_points%curve(1)%knots), "the curve is that of the points in order")
        call check(all(curves%curve(1)%indices == by_points%curve(1)%indices), "and so are the indices")
        call check(same([report%max_error, report%rms_error], [of_wall%max_error, of_wall%rms_error]) .and. &
            report%pieces == 1, "and so is the report")
        call check(report%max_error_point == wall(of_wall%max_error_point) .and. &
            report%first_point == wall(of_wall%first_point), "which names points of the mesh")

        call curves%fit(mesh, [body, far_field], degree=4, n_control=n_control, closed=hm_periodic, report=report)
        call check(size(curves%curve) == 2 .and. size(curves%control, 2) == 2 * n_control .and. report%pieces == 2, &
            "two markers are two curves")
        call check(same([curves%control(:, :n_control)], [by_points%control]) .and. &
            same([curves%control(:, n_control + 1:)], [outer%control]), "each through its own points")
        call check(all(curves%curve(2)%indices == n_control + outer%curve(1)%indices), "with its own control points")
        call check(report%max_error >= max(of_wall%max_error, of_outer%max_error), &
            "the report is that of the worst one")

        call from_0%points(x, y, first=0)
        call from_0%cells(cells - 1_c_int32_t)
        call from_0%faces(faces - 1_c_int32_t, markers)
        call curves%fit(from_0, body, degree=4, n_control=n_control, closed=hm_periodic, report=report)
        call check(same([curves%control], [by_points%control]), "a mesh that counts from 0 has the same curve")
        call check(report%max_error_point == wall(of_wall%max_error_point) - 1, "and a report that counts from 0")

        call curves%fit(mesh, [body, 1234], stat=stat, err=err)
        call check(stat == hm_bad_condition .and. err%item_kind == hm_item_marker .and. err%item == 1234, &
            "a marker that no face has: " // err%text)
        call check(same([curves%control], [by_points%control]), "a refused call leaves the curves as they were")
        call curves%fit(mesh, wall(:0), stat=stat)
        call check(stat == hm_bad_argument, "no marker")
        call curves%fit(mesh, body, degree=7, stat=stat)
        call check(stat < 0, "a degree of 7")
        call from_0%free()
        call curves%fit(from_0, body, stat=stat)
        call check(stat < 0, "a mesh without points")
    end subroutine
end module
