! Curves: by hand, as fits, points of them, projections.
module curves_tests
    use, intrinsic :: iso_c_binding, only: c_float, c_int32_t, c_int64_t
    use body_mesh
    implicit none
    private
    public :: curves_by_hand, fits

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
end module
