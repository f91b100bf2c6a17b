! Operators, weights, engines, schemes and precisions.
module operators_tests
    use body_mesh
    implicit none
    private
    public :: operators

contains

    ! Operators, weights, engines and precisions: what they are is seen in the functions.
    subroutine operators()
        type(hm_options) :: options
        type(hm_basis) :: conformal, other
        type(hm_basis_info) :: info
        type(hm_curves) :: curves
        type(hm_plan) :: plan
        type(hm_solve_report) :: report
        real(dp), target :: history(40)
        real(dp), dimension(n_points) :: laplace, a, b
        real(dp) :: error
        integer, allocatable :: merged(:)
        integer :: n_merged
        type(hm_error) :: err
        integer :: stat
        call solve(mesh, conformal)
        call conformal%info(info)
        call check(info%operator_kind == hm_conformal .and. info%exponent == 1.5_dp .and. &
            info%numbers_per_value == 2 .and. .not. info%offset_correction .and. info%bodies == 0, &
            "the default operator")
        call conformal%values(3, a, number=2)
        call check(maxval(abs(a(:around))) <= 0 .and. maxval(abs(a)) > 1e-3_dp, "imaginary parts: 0 on the wall alone")
        call conformal%values(3, a, number=3, stat=stat)
        call check(stat == hm_bad_argument, "complex values have two numbers")

        options%operator_kind = hm_laplace
        call solve(mesh, other, options=options)
        call other%info(info)
        call check(info%operator_kind == hm_laplace .and. info%numbers_per_value == 1, "Laplace: real values")
        call other%values(3, laplace)
        call check(minval(laplace) > -1e-3_dp .and. maxval(laplace) < 1, "the paper's functions")

        options%operator_kind = hm_conformal
        options%exponent = -1
        call solve(mesh, other, options=options)
        call other%values(3, a)
        call other%values(3, b, number=2)
        call check(maxval(abs(a - laplace)) < 1e-12_dp .and. maxval(abs(b)) < 1e-12_dp, "conformal, no weight: Laplace")

        options = hm_options(operator_kind=hm_weighted, exponent=2._dp)
        call solve(mesh, other, options=options)
        call other%values(3, a)
        call check(maxval(abs(a - laplace)) > 1e-2_dp, "weights matter")

        call conformal%curves(curves)
        options = hm_options(operator_kind=hm_laplace, engine=hm_multigrid, levels=3, block_width=4)
        history = -1
        options%history => history
        call plan%analyse(mesh, curves, [hm_condition(body)], options=options)
        call plan%factor()
        call other%free()
        call plan%solve(other, report)
        call other%values(3, a)
        call check(maxval(abs(a - laplace)) < 1e-8_dp, "multigrid: the same functions")
        call check(report%levels == 3 .and. report%iterations > 2 .and. report%iterations < 40, "its report")
        call check(all(history(:report%iterations) > 1e-10_dp) .and. history(report%iterations + 1) > 0 .and. &
            history(report%iterations + 1) <= 1e-10_dp, "its history")
        call plan%level(2, merged, stat=stat)
        call check(stat == hm_bad_argument .and. .not. allocated(merged), "no merged cells")
        options%engine = hm_fas
        options%agglomeration = hm_agglomerate_isotropic
        call plan%analyse(mesh, curves, [hm_condition(body)], options=options)
        call plan%factor()
        call plan%level(2, merged, n_merged)
        call check(n_merged > 0 .and. 2 * n_merged < n_points .and. maxval(merged) == n_merged .and. &
            all(merged(:around) == 0) .and. count(merged == 0) == 2 * around, "its second level")
        call plan%level(4, merged, stat=stat)
        call check(stat == hm_bad_argument .and. .not. allocated(merged), "there is no fourth one")
        call other%free()
        call plan%solve(other, report)
        call other%values(3, a)
        call check(maxval(abs(a - laplace)) < 1e-7_dp .and. report%iterations > 5, &
            "the paper's iteration: the same again")
        options%engine = hm_multigrid
        options%agglomeration = hm_agglomerate_auto
        options%max_iterations = 1
        call plan%analyse(mesh, curves, [hm_condition(body)], options=options)
        call plan%factor()
        call other%free()
        call plan%solve(other, stat=stat)
        call check(stat == hm_not_converged, "one iteration is too few")
        options%block_width = 7
        call plan%analyse(mesh, curves, [hm_condition(body)], options=options, stat=stat)
        call check(stat == hm_bad_argument, "a block of seven")
        options%block_width = 8
        options%engine = hm_fas
        options%agglomeration = 99
        call plan%analyse(mesh, curves, [hm_condition(body)], options=options, stat=stat)
        call check(stat == hm_bad_argument, "an agglomeration to come")

        ! With the offset correction a rigid motion of the control points moves the wall rigidly; without the correction
        ! the offset of the wall stays.
        options = hm_options(offset_correction=.true.)
        call solve(mesh, other, options=options)
        call other%info(info)
        call check(info%offset_correction, "offset correction")
        call turn_wall(other, 5._dp, error)
        call check(error < 1e-12_dp, "the wall turns rigidly")
        call turn_wall(conformal, 5._dp, error)
        call check(error > 1e-6_dp, "without the correction its offset from the curve stays")
        options = hm_options(scheme=hm_bounded)
        call plan%analyse(mesh, curves, [hm_condition(body)], options=options, stat=stat, err=err)
        call check(stat == hm_unsupported, "conformal and bounded do not go together: " // err%text)
        options%operator_kind = hm_laplace
        call solve(mesh, other, options=options)
        call other%values(3, a)
        call check(maxval(abs(a - laplace)) < 1e-2_dp .and. maxval(abs(a - laplace)) > 0, "the bounded scheme")
        options%scheme = hm_nodal_gradient
        call solve(mesh, other, options=options)
        call other%values(3, a)
        call check(maxval(abs(a - laplace)) < 1e-2_dp, "the scheme of nodal gradients")
        options%scheme = hm_nodal_gradient_plain
        call plan%analyse(mesh, curves, [hm_condition(body)], options=options, stat=stat, err=err)
        call check(stat == hm_unsupported, "without correction, and the direct engine: " // err%text)
    end subroutine

    ! Computes how far the wall is from the wall that is turned about the origin.
    subroutine turn_wall(turned, degrees, error)
        type(hm_basis), intent(in) :: turned
        real(dp), intent(in) :: degrees
        real(dp), intent(out) :: error
        type(hm_curves) :: curves
        real(dp) :: dx(n_points), dy(n_points), wanted(2, around)
        call turned%curves(curves)
        call turned%displacement(turn(curves%control, degrees), dx, dy)
        wanted = turn(xy(:, :around), degrees)
        error = maxval(hypot(dx(:around) - wanted(1, :), dy(:around) - wanted(2, :)))
    end subroutine
end module
