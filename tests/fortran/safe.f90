! Safe morphs, and the improvement of a mesh.
module safe_tests
    use, intrinsic :: iso_c_binding, only: c_float
    use body_mesh
    implicit none
    private
    public :: safe_strategies, safe_heights, safe_steps

contains

    ! The strategy depends on the size of the movement.
    subroutine safe_strategies()
        type(hm_plan) :: plan
        type(hm_curves) :: curves
        type(hm_basis) :: laplace, others(1)
        type(hm_safe_report) :: report
        type(hm_quality_report) :: quality
        real(dp), dimension(n_points) :: x_new, y_new, x_other, y_other
        real(dp) :: move(2, n_control), error
        real(dp), pointer, contiguous :: reached(:, :)
        type(hm_error) :: err
        integer :: stat
        call basis%curves(curves)
        call solve(mesh, laplace, options=hm_options(operator_kind=hm_laplace))
        call plan%morph_safe(laplace, some_move(), x_new, y_new, stat=stat)
        call check(stat == hm_bad_argument, "a plan that is empty")

        ! A small movement is a linear morph.
        call plan%analyse(mesh, curves, [hm_condition(body)], options=hm_options(operator_kind=hm_laplace))
        call plan%prepare()
        move = 0.02_dp * some_move()
        call plan%morph_safe(laplace, move, x_new, y_new, report=report)
        call laplace%morph_to(move, x, y, x_other, y_other)
        call check(report%strategy == hm_strategy_linear .and. report%other == -1 .and. report%steps == 1 .and. &
            report%inverted == 0, "a small movement in one step")
        call check(maxval(abs(x_new - x_other)) < 1e-15_dp .and. maxval(abs(y_new - y_other)) < 1e-15_dp, &
            "it is the morph")

        ! A large movement is too much for the functions at once, but not in several steps.
        move = turn(curves%control, 40._dp)
        call laplace%morph_to(move, x, y, x_other, y_other)
        call laplace%assess(mesh, x_other - x, y_other - y, quality=quality)
        call check(quality%inverted > 0, "Laplace's functions invert cells at 40 degrees")
        call plan%morph_safe(laplace, move, x_new, y_new, report=report)
        call laplace%assess(mesh, x_new - x, y_new - y, quality=quality)
        call check(quality%inverted == 0 .and. quality%self_crossing == 0 .and. &
            report%strategy >= hm_strategy_substeps .and. &
            report%step_fraction >= 1, "a safe morph inverts none")
        call check(abs(quality%min_quality - report%min_quality) < 1e-12_dp .and. report%min_quality_cell == &
            quality%min_quality_cell, "its report")
        call laplace%boundary_error(move, x, y, x_new, y_new, error)
        call check(error < 1e-12_dp, "its wall is the B-spline's")
        call solve(mesh, others(1))
        call plan%morph_safe(laplace, move, x_new, y_new, others=others, options=hm_safe_options(min_quality=-1._dp), &
            report=report)
        call others(1)%morph_to(move, x, y, x_other, y_other)
        call check(report%strategy == hm_strategy_other .and. report%other == 1 .and. &
            maxval(abs(x_new - x_other)) < 1e-14_dp, &
            "conformal functions do it at once")
        allocate(reached(2, size(move, 2)))
        call plan%morph_safe(laplace, move, x_new, y_new, options=hm_safe_options(max_resolves=-1, &
            skipped_strategies=2**hm_strategy_untangled, reached=reached), report=report, stat=stat, err=err)
        call check(stat == hm_short .and. report%step_fraction > 0 .and. report%step_fraction < 1, &
            "not all: " // err%text)
        call laplace%boundary_error(reached, x, y, x_new, y_new, error)
        call check(error < 1e-12_dp, "the wall is where the movement that was reached takes it")
        call plan%morph_safe(laplace, move, x_new, y_new, options=hm_safe_options(reached=reached(:, 2:)), stat=stat)
        call check(stat == hm_bad_argument, "reached is too short")
        deallocate(reached)
        call laplace%assess(mesh, x_new - x, y_new - y, quality=quality)
        call check(quality%inverted == 0 .and. report%cell >= 1 .and. report%resolves == 0, &
            "what was possible is valid")
    end subroutine

    ! A body that grows: conformal functions stretch the first layers, heights brings them back.
    subroutine safe_heights()
        type(hm_plan) :: plan
        type(hm_curves) :: curves
        type(hm_safe_report) :: report
        real(dp) :: x_new(n_points), y_new(n_points), ratio
        call basis%curves(curves)
        call plan%analyse(mesh, curves, [hm_condition(body)])
        call plan%prepare()
        call plan%morph_safe(basis, 0.3_dp * curves%control, x_new, y_new, report=report)
        ratio = report%mean_height_ratio
        call plan%morph_safe(basis, 0.3_dp * curves%control, x_new, y_new, options=hm_safe_options(heights=1._dp), &
            report=report)
        call check(report%heights > 0 .and. abs(report%mean_height_ratio - 1) < 0.8_dp * abs(ratio - 1), &
            "heights of first layers are brought back")
    end subroutine

    ! The derivative of several steps: on straight lines it times the movement is the movement. Then the same movement
    ! in other layouts, and what is refused.
    subroutine safe_steps()
        type(hm_plan) :: plan
        type(hm_curves) :: curves
        type(hm_basis) :: weighted, derivative
        type(hm_safe_report) :: report
        real(dp), dimension(n_points) :: x_new, y_new, x_other, y_other
        real(dp) :: move(2, n_control)
        type(hm_error) :: err
        integer :: stat
        call basis%curves(curves)
        call plan%analyse(mesh, curves, [hm_condition(body)], options=hm_options(operator_kind=hm_weighted))
        call plan%factor()
        call plan%solve(weighted)
        move = turn(curves%control, 50._dp)
        call plan%morph_safe(weighted, move, x_new, y_new, derivative=derivative, report=report)
        call check(report%strategy == hm_strategy_substeps .and. report%steps > 1 .and. report%resolves > 0, &
            "several steps")
        call derivative%displacement(move, x_other, y_other)
        call check(maxval(abs(x + x_other - x_new)) < 1e-12_dp .and. maxval(abs(y + y_other - y_new)) < 1e-12_dp, &
            "the derivative is the sum of the steps' functions")
        call plan%morph_safe(weighted, move, x_new, y_new, derivative=basis, stat=stat, err=err)
        call check(stat == hm_bad_basis, "a derivative of other functions: " // err%text)
        call safe_layouts(plan, weighted, move, x_new, y_new)
        call improvements(plan, x_new, y_new)
        call safe_refusals(plan, weighted, curves, move, x_new, y_new)
    end subroutine

    ! Every layout, in own memory, on the spot: the mesh is x_new, y_new.
    subroutine safe_layouts(plan, weighted, move, x_new, y_new)
        type(hm_plan), intent(inout) :: plan
        type(hm_basis), intent(in) :: weighted
        real(dp), intent(in) :: move(:, :), x_new(:), y_new(:)
        real(dp) :: x_other(n_points), y_other(n_points), block_x(around, rings), block_y(around, rings)
        real(c_float) :: x4(n_points), y4(n_points), block_x4(around, rings), block_y4(around, rings)
        real(dp), allocatable, target :: work(:)
        type(hm_safe_options) :: steps_alone
        integer :: stat
        steps_alone%skipped_strategies = 2**hm_strategy_other + 2**hm_strategy_untangled + 2**hm_strategy_improved
        allocate(work(plan%morph_safe_words()))
        block_x = 0
        block_y = 0
        call plan%morph_safe(weighted, move, block_x, block_y, options=steps_alone, work=work)
        call check(same(reshape(block_x, [n_points]), x_new) .and. same(reshape(block_y, [n_points]), y_new), "a block")
        call plan%morph_safe(weighted, move, x_other, y_other, work=work(2:), stat=stat)
        call check(stat == hm_block_too_small, "work 8 bytes too small")
        call plan%morph_safe(weighted, real(move, c_float), x4, y4, options=steps_alone)
        call check(maxval(abs(x4 - x_new)) < 1e-5_dp, "default reals")
        call plan%morph_safe(weighted, real(move, c_float), block_x4, block_y4, options=steps_alone)
        call check(all(abs(reshape(block_x4, shape(x4)) - x4) <= 0) .and. &
            all(abs(reshape(block_y4, shape(y4)) - y4) <= 0), "a block of default reals")
    end subroutine

    subroutine improvements(plan, x_new, y_new)
        type(hm_plan), intent(inout) :: plan
        real(dp), intent(in) :: x_new(:), y_new(:)
        type(hm_improve_report) :: improved
        type(hm_quality_report) :: quality
        real(dp) :: x_other(n_points), y_other(n_points), block_x(around, rings), block_y(around, rings)
        real(dp), allocatable, target :: work(:)
        integer :: stat
        x_other = x_new
        y_other = y_new
        call plan%improve(x_other, y_other, report=improved)
        call check(improved%movable > 0 .and. improved%mean_quality >= improved%mean_quality_before, "an improvement")
        call basis%assess(mesh, x_other - x, y_other - y, quality=quality)
        call check(abs(quality%min_quality - improved%min_quality) < 1e-12_dp .and. quality%inverted == 0, &
            "and its report")
        allocate(work(plan%improve_words()))
        block_x = reshape(x_new, [around, rings])
        block_y = reshape(y_new, [around, rings])
        call plan%improve(block_x, block_y, reshape(x, [around, rings]), reshape(y, [around, rings]), work=work)
        call check(same(reshape(block_x, [n_points]), x_other) .and. same(reshape(block_y, [n_points]), y_other), &
            "the mesh before the movement as reference, a block, own memory")
        call plan%improve(x_other, y_other, max_solutions=-1, stat=stat)
        call check(stat == hm_bad_argument, "fewer steps than none")
        call plan%improve(x_other(2:), y_other(2:), stat=stat)
        call check(stat == hm_bad_argument, "an improvement of a point too few")
    end subroutine

    subroutine safe_refusals(plan, weighted, curves, move, x_new, y_new)
        type(hm_plan), intent(inout) :: plan
        type(hm_basis), intent(in) :: weighted
        type(hm_curves), intent(in) :: curves
        real(dp), intent(in) :: move(:, :)
        real(dp), intent(inout) :: x_new(:), y_new(:)
        type(hm_safe_report) :: report
        real(dp) :: far(2, n_control), x_other(n_points), y_other(n_points)
        integer :: top
        type(hm_error) :: err
        integer :: stat
        call plan%morph_safe(weighted, move, x_new, y_new, options=hm_safe_options(min_quality=0.999_dp), &
            report=report, stat=stat, err=err)
        call check(stat == hm_poor .and. report%n_worst == 5 .and. report%worst(1)%cell == report%min_quality_cell &
            .and. err%item == report%worst(1)%cell .and. index(err%text, "(") > 0, &
            "poorer than asked for: " // err%text)
        call plan%morph_safe(weighted, move, x_new, y_new, options=hm_safe_options(min_quality=1.5_dp), stat=stat)
        call check(stat == hm_bad_argument, "a quality above 1")
        call plan%morph_safe(weighted, move(:, 2:), x_new, y_new, stat=stat)
        call check(stat == hm_bad_argument, "a movement too few")
        call plan%morph_safe(weighted, move, x_new(2:), y_new(2:), stat=stat)
        call check(stat == hm_bad_argument, "a point too few")
        far = 0
        top = maxloc(curves%control(2, :), 1)
        far(2, top) = -4 * curves%control(2, top)
        x_other = x_new
        call plan%morph_safe(weighted, far, x_new, y_new, report=report, stat=stat, err=err)
        call check(stat == hm_crossing .and. same(x_new, x_other) .and. report%crossing_points(4) >= 1, &
            "a boundary that crosses itself: " // err%text)
        call make_points(x_other, y_other)
        call check(same(x, x_other) .and. same(y, y_other), "the mesh is where it was")
    end subroutine
end module
