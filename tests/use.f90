! Every procedure of the Fortran module, with assertions. With an argument: does what must stop the program (see
! fortran.sh): refused, assign_mesh, assign_plan, assign_basis.
program use
    use, intrinsic :: iso_c_binding, only: c_double, c_float, c_int32_t, c_int64_t
    use harmorph
    use use_meshes
    implicit none
    real(dp), target :: x(n_points), y(n_points), xy(2, n_points), by_column(n_points, 2)
    integer(c_int32_t), target :: cells(4, n_cells), faces(2, 2 * around), markers(2 * around)
    type(hm_mesh), target :: mesh
    type(hm_basis), target :: basis
    type(hm_error) :: err
    integer :: stat
    character(len=32) :: mode

    call make_points(x, y)
    call make_cells(cells, faces, markers)
    xy(1, :) = x
    xy(2, :) = y
    by_column(:, 1) = x
    by_column(:, 2) = y
    call mesh%points(x, y)
    call mesh%cells(cells)
    call mesh%faces(faces, markers)
    call get_command_argument(1, mode)
    if (mode /= "") call stop_by(trim(mode))

    call versions()
    call curves_by_hand()
    call fits()
    call analysis_and_plan()
    call morphs()
    call layouts()
    call structured_blocks()
    call several_blocks()
    call polygons()
    call default_reals()
    call long_integers()
    call files()
    call own_memory()
    call threads()
    call operators()
    call conditions()
    call assessments()
    call safe_morphs()
    call given_displacements()
    call transfers()
    call meshes_in_parts()
    call single_precision()
    call design()
    call numbers_in_errors()
    call refusals()

    print "(i0, a, i0, a)", passed, " passed, ", failed, " failed"
    if (failed > 0) error stop

contains

    subroutine versions()
        call check(hm_abi_version() == hm_abi, "module and library fit")
        call check(hm_version() == hm_header_version, "version")
        call check(hm_status_name(hm_moved) == "HM_MOVED", "name of a status")
        call check(hm_status_name(99) == "unknown status", "name of an unknown status")
    end subroutine

    ! A half circle as a rational curve of degree 2, and two straight lines that share its ends.
    subroutine curves_by_hand()
        type(hm_curves) :: curves, copy
        real(dp) :: xy_u(2, 0:1), values(3, 0:2), u, distance
        real(dp), parameter :: s = sqrt(0.5_dp)
        integer, allocatable :: control(:)
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

    subroutine analysis_and_plan()
        type(hm_plan) :: plan
        type(hm_curves) :: curves, same
        type(hm_mesh_report) :: report
        type(hm_solve_report) :: solved
        type(hm_basis_info) :: info
        type(hm_options) :: options
        type(hm_basis) :: moved
        integer, allocatable :: wall(:)
        integer :: k
        real(dp) :: one(n_points), total(n_points), u, distance
        real(dp), target :: x_moved(n_points), y_moved(n_points)
        real(dp), allocatable, target :: work(:)
        logical :: loop

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
        call plan%boundary([body], wall, loop)
        call curves%fit(x(wall), y(wall), loop, n_control=n_control)

        options%progress => watch
        options%tolerance = 1e-9_dp
        phases_seen = 0
        cancel_in = hm_phase_solve
        call plan%analyse(mesh, curves, [hm_condition(body), hm_condition(far_field, hm_fixed)], options=options)
        call check(plan%plan_words() > 0, "size of the plan")
        call check(plan%basis_words() > 0, "size of the basis")
        call plan%prepare()
        call plan%factor()
        call basis%free()
        call plan%solve(basis, stat=stat)
        call check(stat == hm_cancelled, "the callback cancels the solution")
        cancel_in = -1
        call plan%solve(basis, solved)
        call check(phases_seen == 127, "all seven phases are reported")
        call check(solved%residual < 1e-12_dp .and. solved%functions == n_control, "the solution")
        call check(solved%residual_function >= 1 .and. solved%residual_function <= n_control, "its worst function")
        allocate(curves%weights(n_control), source=1 + 0.1_dp * [(modulo(k, 3), k = 1, n_control)])
        call plan%analyse(mesh, curves, [hm_condition(body)])
        call plan%factor()
        call moved%init(plan)
        call moved%curves(same)
        call check(maxval(abs(same%weights - curves%weights)) <= 0, "weights of a rational basis")
        call moved%free()
        deallocate(curves%weights)
        call plan%analyse(mesh, curves, [hm_condition(body)])
        call basis%info(info)
        call check(info%solved .and. info%points == n_points .and. info%index_base == 1, "info of the basis")
        call check(all(sort(info%curve_point) == [(k, k = 1, around)]) .and. all(info%point_curve == 1), &
            "its curve points")
        call check(info%bytes == basis%bytes(), "its length")
        call basis%curves(same)
        call check(all(same%curve(1)%indices == curves%curve(1)%indices), "its curves")
        call same%project(1, x(info%curve_point(1)), y(info%curve_point(1)), u, distance)
        call check(abs(u - info%point_u(1)) < 1e-9_dp, "its parameters")
        total = 0
        do k = 1, n_control
            call basis%values(k, one)
            total = total + one
        end do
        call check(maxval(abs(total(:around) - 1)) < 1e-12_dp .and. maxval(abs(total(n_points - around + 1:))) <= 0, &
            "the functions' sum on the boundaries")

        call plan%factor()
        call basis%free()
        call plan%solve(basis)
        call plan%drop_analysis()
        call plan%report(report, stat)
        call check(stat == hm_bad_argument, "no report without an analysis")
        x_moved = 2 * x
        y_moved = 2 * y
        call plan%factor(x_moved, y_moved)
        call plan%solve(basis)
        call basis%values(1, total)
        call plan%factor(real(x_moved, c_float), real(y_moved, c_float))
        call plan%solve(basis)
        call check(maxval(abs(total - values_of(1))) < 1e-4_dp, "default reals: nearly the same functions")
        call plan%factor(reshape(real(x, c_float), [around, rings]), reshape(real(y, c_float), [around, rings]))
        call plan%solve(basis)
        call check(maxval(abs(total - values_of(1))) < 1e-4_dp, "default reals in rank 2")
        call plan%factor(x_moved(2:), y_moved(2:), stat)
        call check(stat == hm_bad_argument, "a point too few")
        call plan%solve(moved, stat=stat, err=err)
        call check(stat == hm_bad_argument, "a basis needs the analysis: " // err%text)
        call plan%free()

        ! A piece of a marker: here all of it, of two conditions on it one is left without a piece.
        call plan%analyse(mesh, curves, [hm_condition(body, piece=1, near_x=1._dp, near_y=0._dp)])
        call plan%factor()
        call plan%solve(basis)
        call check(maxval(abs(total - values_of(1))) < 1e-4_dp, "a piece of a marker")
        call plan%analyse(mesh, curves, [hm_condition(body, piece=1, near_x=1._dp), hm_condition(body)], stat=stat, err=err)
        call check(stat == hm_bad_condition, "no piece is left: " // err%text)

        ! Where the points of a curve are given, they are used.
        call plan%analyse(mesh, curves, [hm_condition(body), hm_condition(far_field, hm_fixed)], &
            given_points=info%curve_point, given_curves=info%point_curve, given_u=info%point_u)
        call plan%factor()
        call plan%solve(basis, stat=stat, err=err)
        call check(stat == hm_ok, "a basis of another analysis is made anew: " // err%text)
        allocate(work(plan%basis_words()))
        call moved%init(plan, work)
        call plan%analyse(mesh, curves, [hm_condition(body)])
        call plan%factor()
        call plan%solve(moved, stat=stat, err=err)
        call check(stat == hm_bad_basis, "but not in the caller's memory: " // err%text)
        call plan%analyse(mesh, curves, [hm_condition(body)], given_points=[1], given_curves=[2], given_u=[0._dp], &
            stat=stat)
        call check(stat < 0, "a given curve that does not exist")
        call plan%analyse(mesh, curves, [hm_condition(body)], given_points=[1, 2], &
            given_curves=[1], given_u=[0._dp], stat=stat)
        call check(stat == hm_bad_argument, "given points of other lengths")
        call plan%analyse(mesh, curves, [hm_condition(body)], given_points=[1], stat=stat)
        call check(stat == hm_bad_argument, "given points without parameters")
    end subroutine

    function values_of(number) result(values)
        integer, intent(in) :: number
        real(dp) :: values(n_points)
        call basis%values(number, values)
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

    subroutine morphs()
        real(dp) :: move(2, n_control), gradient(2, n_control), error, here, there
        real(dp), dimension(n_points) :: x_new, y_new, dx, dy, gx, gy
        type(hm_step_report) :: step
        type(hm_quality_report) :: quality
        type(hm_curves) :: curves, moved
        integer :: point, k
        move = 0
        call basis%morph_to(move, x, y, x_new, y_new)
        call check(same(x, x_new) .and. same(y, y_new), "a movement of nothing keeps all bits")
        move = some_move()
        call basis%displacement(move, dx, dy)
        call basis%admissible_step(mesh, dx, dy, step)
        call check(step%admissible > 0 .and. step%cell >= 1 .and. step%cell <= n_cells .and. step%point >= 1, &
            "somewhere a cell sets the limit")
        move = min(1._dp, 0.5_dp * step%admissible) * move
        call basis%morph_to(move, x, y, x_new, y_new)
        call basis%curves(curves)
        call basis%moved_curves(move, moved)
        call check(maxval(abs(moved%control - curves%control - move)) < 1e-15_dp, "control points of the moved curves")
        call check(all(moved%curve(1)%indices == curves%curve(1)%indices), "the rest of them as before")
        call basis%moved_curves(move(:, 2:), moved, stat, err)
        call check(stat == hm_bad_argument, "a movement of one control point too few")
        call basis%boundary_error(move, x, y, x_new, y_new, error, point)
        call check(error < 1e-12_dp .and. point >= 1 .and. point <= n_points, "the wall moves as the B-spline does")
        call basis%quality(mesh, x_new, y_new, quality, x, y)
        call check(quality%inverted == 0 .and. quality%min_area > 0 .and. quality%self_crossing == 0, "quality")
        call basis%quality(mesh, x_new, y_new, quality)
        call check(quality%min_quality > 0 .and. quality%min_quality <= quality%mean_quality, &
            "quality without reference")
        dx = x
        dy = y
        call basis%morph(move, dx, dy)
        call check(same(dx, x_new) .and. same(dy, y_new), "in place: the same")
        call basis%velocity(move, dx, dy)
        call check(maxval(abs(x + dx - x_new)) < 1e-15_dp, "velocities are the same product")
        do k = 1, n_points
            gx(k) = sin(real(k, dp))
            gy(k) = cos(3 * real(k, dp))
        end do
        call basis%adjoint(gx, gy, gradient)
        here = sum(gx * dx + gy * dy)
        there = sum(gradient * move)
        call check(abs(here - there) < 1e-12_dp, "the adjoint is the transpose")
    end subroutine

    logical function same(a, b)
        real(dp), intent(in) :: a(:), b(:)
        same = all(a >= b .and. a <= b)
    end function

    ! The same morph from every layout that needs no copy.
    subroutine layouts()
        real(dp) :: move(2, n_control), gradient(2, n_control), expected(2, n_control)
        real(dp), dimension(n_points) :: x_new, y_new, dx, dy
        real(dp), target, save :: state(4, n_points)
        integer(c_int32_t), target, save :: triangles(3, 2 * n_cells), rows(4 * n_cells), start(n_cells + 1)
        integer(c_int32_t), target :: shifted(4, n_cells)
        integer(c_int32_t), target :: list(2 * around + 2), list_start(3), list_markers(2)
        type(hm_mesh) :: other
        type(hm_basis) :: its
        type(hm_step_report) :: step, its_step
        integer :: k
        move = some_move()
        call solve(mesh, basis)
        call basis%morph_to(move, x, y, x_new, y_new)
        call basis%displacement(move, dx, dy)
        call basis%adjoint(dx, dy, expected)
        call basis%admissible_step(mesh, dx, dy, step)

        state = -1
        state(2, :) = x
        state(3, :) = y
        call basis%morph(move, state(2, :), state(3, :))
        call check(same(state(2, :), x_new) .and. same(state(3, :), y_new), "q(2,:), q(3,:) in place")
        call check(all(abs(state([1, 4], :) + 1) <= 0), "what lies between stays")
        call basis%morph_to(move, by_column(:, 1), by_column(:, 2), state(1, :), state(2, :))
        call check(same(state(1, :), x_new) .and. same(state(2, :), y_new), "xy(:,1), xy(:,2) to another array")
        call basis%displacement(move, state(1, :), state(2, :))
        call basis%adjoint(state(1, :), state(2, :), gradient)
        call check(maxval(abs(gradient - expected)) <= 0, "adjoint of xy(1,:), xy(2,:)")
        state(1, n_points:1:-1) = x
        state(2, n_points:1:-1) = y
        call basis%morph(move, state(1, n_points:1:-1), state(2, n_points:1:-1))
        call check(same(state(1, n_points:1:-1), x_new) .and. same(state(2, n_points:1:-1), y_new), &
            "arrays that run backwards")

        ! Meshes of interleaved points; of triangles; of rows; of lists; from 0.
        call other%points(xy(1, :), xy(2, :))
        call other%cells(cells)
        call other%faces(faces, markers)
        call solve(other, its)
        call its%displacement(move, x_new, y_new)
        call check(same(x_new, dx) .and. same(y_new, dy), "a mesh of xy(2,:)")
        call its%admissible_step(other, x_new, y_new, its_step)
        call check(same([its_step%admissible], [step%admissible]) .and. its_step%cell == step%cell, "its step")

        start = 1 + 4 * [(k, k = 0, n_cells)]
        rows = reshape(cells, shape(rows))
        list = [[(k, k = 1, around), 1], [(k, k = n_points - around + 1, n_points), n_points - around + 1]]
        list_start = [1, around + 2, 2 * around + 3]
        list_markers = [body, far_field]
        call other%free()
        call other%points(by_column(:, 1), by_column(:, 2))
        call other%cells(rows, start)
        call other%lists(list, list_start, list_markers)
        call solve(other, its)
        call its%displacement(move, x_new, y_new)
        call check(same(x_new, dx) .and. same(y_new, dy), "a mesh of rows and lists")

        call other%free()
        call other%points(x, y, first=0)
        shifted = cells - 1
        call other%cells(shifted)
        list = list - 1
        list_start = list_start - 1
        call other%lists(list, list_start, list_markers)
        call solve(other, its, first=0)
        call its%displacement(move, x_new, y_new)
        call check(same(x_new, dx) .and. same(y_new, dy), "a mesh counted from 0")
        call its%admissible_step(other, x_new, y_new, its_step)
        call check(its_step%cell == step%cell - 1, "and reports as well")

        do k = 1, n_cells
            triangles(:, 2 * k - 1) = cells([1, 2, 3], k)
            triangles(:, 2 * k) = cells([1, 3, 4], k)
        end do
        call other%free()
        call other%points(x, y)
        call other%cells(triangles)
        call other%faces(faces, markers)
        call solve(other, its)
        call its%displacement(move, x_new, y_new)
        call check(maxval(abs(x_new - dx)) < 1e-2_dp .and. maxval(abs(x_new - dx)) > 0, "a mesh of triangles")
    end subroutine

    ! An O-mesh as a block: the first and the last column are the same points.
    ! The mesh in three blocks, one after the other: the functions are those of the mesh in one.
    subroutine several_blocks()
        integer, parameter :: third = around / 3, ni = third + 1, nj = rings
        real(dp), target :: bx(3 * ni * nj), by(3 * ni * nj)
        real(dp) :: qx(n_points), qy(n_points), move(2, n_control)
        integer :: sizes(2, 3), sides(4, 3), i, j, b, k, own(3 * ni * nj)
        type(hm_mesh) :: blocks
        type(hm_curves) :: curves
        type(hm_plan) :: plan
        type(hm_basis) :: in_blocks, in_one
        k = 0
        do b = 0, 2
            do j = 0, nj - 1
                do i = 0, ni - 1
                    k = k + 1
                    own(k) = 1 + modulo(b * third + i, around) + around * j
                end do
            end do
            sizes(:, b + 1) = [ni, nj]
            sides(:, b + 1) = [integer :: hm_no_marker, hm_no_marker, body, hm_no_marker]
        end do
        bx = x(own)
        by = y(own)
        call blocks%points(bx, by)
        call blocks%blocks(sizes, sides(:, 2:), stat=stat)
        call check(stat == hm_bad_argument, "sides of another number of blocks")
        call blocks%blocks(sizes, sides)
        call blocks%blocks(sizes, stat=stat)
        call check(stat == hm_bad_argument, "blocks twice")
        call blocks%cells(cells, stat=stat)
        call check(stat == hm_bad_argument, "blocks and cells")
        call blocks%line(far_field, 1, ni, nj, nj, block=4, stat=stat)
        call check(stat == hm_bad_argument, "a line of a block that does not exist")
        do b = 1, 3
            call blocks%line(far_field, 1, ni, nj, nj, block=b)
        end do
        call curves%fit(x(:around), y(:around), .true., n_control=n_control)
        call plan%analyse(blocks, curves, [hm_condition(body)])
        call plan%factor()
        call plan%solve(in_blocks)
        call plan%analyse(mesh, curves, [hm_condition(body)])
        call plan%factor()
        call plan%solve(in_one)
        move = some_move()
        qx = x
        qy = y
        call in_one%morph(move, qx, qy)
        call in_blocks%morph(move, bx, by)
        call check(maxval(abs(bx - qx(own))) + maxval(abs(by - qy(own))) < 1e-11_dp, "blocks move as the mesh in one")
        call blocks_apart(own, sides(3, 1), move, in_blocks, bx, by)
    end subroutine

    ! The same blocks in arrays of their own, the second inside ghost layers.
    subroutine blocks_apart(own, wall, move, one_after_the_other, moved_x, moved_y)
        integer, parameter :: ni = around / 3 + 1, nj = rings, n = ni * nj
        integer, intent(in) :: own(:), wall
        real(dp), intent(in) :: move(:, :), moved_x(:), moved_y(:)
        type(hm_basis), intent(in) :: one_after_the_other
        real(dp), target :: ax(ni, nj), ay(ni, nj), bx(0:ni + 1, 0:nj + 1), by(0:ni + 1, 0:nj + 1)
        real(c_float), target :: cx(ni, nj), cy(ni, nj)
        real(dp), target :: px(ni, nj), py(ni, nj)
        real(dp) :: dx(3 * n), dy(3 * n), ex(3 * n), ey(3 * n)
        integer :: sides(4), k
        type(hm_mesh) :: blocks
        type(hm_curves) :: curves
        type(hm_plan) :: plan
        type(hm_basis) :: basis
        sides = [integer :: hm_no_marker, hm_no_marker, wall, far_field]
        bx = 7
        by = 8
        ax = reshape(x(own(:n)), [ni, nj])
        ay = reshape(y(own(:n)), [ni, nj])
        bx(1:ni, 1:nj) = reshape(x(own(n + 1:2 * n)), [ni, nj])
        by(1:ni, 1:nj) = reshape(y(own(n + 1:2 * n)), [ni, nj])
        call blocks%gather(1, ax, ay, dx, dy, stat=stat)
        call check(stat == hm_bad_argument, "gather without blocks")
        call blocks%add_block(ax, ay, sides(:3), stat=stat)
        call check(stat == hm_bad_argument, "a block of three sides")
        call blocks%add_block(ax, ay, sides)
        call blocks%points(ax, ay)
        call blocks%add_block(ax, ay, sides, stat=stat)
        call check(stat == hm_bad_argument, "add_block after points")
        call blocks%free()
        call blocks%add_block(ax, ay, sides)
        call blocks%add_block(bx(1:ni, 1:nj), by(1:ni, 1:nj), sides)
        px = reshape(x(own(2 * n + 1:)), [ni, nj])
        py = reshape(y(own(2 * n + 1:)), [ni, nj])
        call blocks%add_block(ax, ay, sides, stat=stat)         ! the first block twice is no mesh
        call plan%analyse(blocks, stat=stat)
        call check(stat == hm_bad_mesh, "a block that is there twice")
        call blocks%free()
        call blocks%add_block(ax, ay, sides)
        call blocks%add_block(bx(1:ni, 1:nj), by(1:ni, 1:nj), sides)
        call blocks%add_block(px, py, sides)
        call curves%fit(x(:around), y(:around), .true., n_control=n_control)
        call plan%analyse(blocks, curves, [hm_condition(body)])
        call plan%factor()
        call plan%solve(basis)
        call basis%displacement(move, dx, dy)
        call one_after_the_other%displacement(move, ex, ey)
        call check(all(dx == ex), "the functions of the blocks one after the other: x")
        call check(all(dy == ey), "the functions of the blocks one after the other: y")
        call basis%morph_mesh(move, blocks)
        call check(all(reshape(ax, [n]) == moved_x(:n)), "the first block moves in place")
        call check(all(reshape(by(1:ni, 1:nj), [n]) == moved_y(n + 1:2 * n)), "the second one inside ghost layers")
        call check(all(reshape(px, [n]) == moved_x(2 * n + 1:)), "the third one")
        call check(all(bx(0, :) == 7) .and. all(by(:, nj + 1) == 8), "ghost points stay")
        call blocks%scatter(2, dx, dy, px, py)
        call check(all(reshape(px, [n]) == dx(n + 1:2 * n)), "displacements of the second block")
        ex = 0
        call blocks%gather(2, px, py, ex, ey)
        call check(all(ex == [(0._dp, k = 1, n), dx(n + 1:2 * n), (0._dp, k = 1, n)]), "back among all points")
        call blocks%scatter(4, dx, dy, px, py, stat=stat)
        call check(stat == hm_bad_argument, "a block that does not exist")
        call blocks%scatter(1, dx(2:), dy, px, py, stat=stat)
        call check(stat == hm_bad_argument, "displacements of other points")
        call blocks%scatter(1, dx, dy, bx, by, stat=stat)
        call check(stat == hm_bad_argument, "a block of another shape")
        cx = real(ax, c_float)
        cy = real(ay, c_float)
        call blocks%free()
        call blocks%add_block(cx, cy, sides)
        call basis%morph_mesh(move, blocks, stat=stat)
        call check(stat == hm_bad_argument, "morph of a mesh of other points")
    end subroutine

    ! Two cells of the mesh become one of six corners, two of which are flat: rigid movements remain exact, and a wall
    ! given by types of points is the same.
    subroutine polygons()
        type(hm_mesh) :: joined, by_types
        type(hm_plan) :: plan
        type(hm_basis) :: basis
        type(hm_quality_report) :: quality
        type(hm_mesh_report) :: report
        real(dp) :: x_new(n_points), y_new(n_points)
        integer, allocatable :: rows(:), start(:), types(:)
        integer :: i, k, a, b
        allocate(rows(0))
        allocate(start(1), source=1)
        do k = 0, around / 2 - 1                                ! the first ring in pairs of cells, the others as they are
            a = 2 * k
            b = modulo(2 * k + 2, around)
            rows = [rows, a + 1, a + around + 1, a + around + 2, b + around + 1, b + 1, a + 2]
            start = [start, size(rows) + 1]
        end do
        do i = around + 1, size(cells, 2)
            rows = [rows, int(cells(:, i))]
            start = [start, size(rows) + 1]
        end do
        call joined%points(x, y)
        call joined%polygons(rows, start)
        call joined%faces(faces, markers)
        call plan%analyse(joined)
        call plan%report(report)
        call check(report%polygons == around / 2 .and. report%cells == size(cells, 2) - around / 2, &
            "cells that are polygons")
        call plan%analyse(joined, conditions=[hm_condition(body, hm_rigid, x=0._dp, y=0._dp), &
            hm_condition(far_field, hm_rigid, x=0._dp, y=0._dp)])
        call plan%factor()
        call plan%solve(basis)
        x_new = x
        y_new = y
        call basis%morph(reshape([1._dp, 2._dp, cos(0.3_dp) - 1, sin(0.3_dp)], [2, 2]), x_new, y_new)
        call check(maxval(abs(x_new - (1 + x * cos(0.3_dp) - y * sin(0.3_dp)))) < 1e-11_dp, "polygons turn exactly: x")
        call check(maxval(abs(y_new - (2 + x * sin(0.3_dp) + y * cos(0.3_dp)))) < 1e-11_dp, "polygons turn exactly: y")
        call basis%quality(joined, x_new, y_new, quality)
        call check(quality%inverted == 0 .and. quality%min_quality > 0, "polygons are not inverted when they turn")
        allocate(types(n_points), source=0)
        types(faces(1, :)) = int(markers)
        types(faces(2, :)) = int(markers)
        call by_types%points(x, y)
        call by_types%polygons(rows, start)
        call by_types%point_types(types)
        call plan%analyse(by_types)
        call plan%report(report)
        call check(report%boundary_edges == size(markers), "a boundary by types of points of polygons")
        start(3) = start(2) + 2
        call by_types%points(x, y)
        call by_types%polygons(rows, start)
        call plan%analyse(by_types, stat=stat)
        call check(stat == hm_bad_mesh, "a polygon of two corners")
    end subroutine

    subroutine structured_blocks()
        integer, parameter :: ni = around + 1, nj = rings
        real(dp), target :: xs(ni, nj), ys(ni, nj), padded(2, 0:ni + 1, 0:nj + 1), flat(ni * nj), flat_y(ni * nj)
        real(dp) :: layers(2, 0:ni + 1, 0:nj + 1)
        real(dp) :: x_new(ni, nj), y_new(ni, nj), move(2, n_control), gradient(2, n_control), expected(2, n_control), &
            error
        real(dp) :: dx(ni, nj), dy(ni, nj), value(ni, nj), one(ni * nj)
        type(hm_mesh) :: block, inner
        type(hm_curves) :: curves
        type(hm_plan) :: plan
        type(hm_basis) :: its, again
        type(hm_step_report) :: step, same_step
        type(hm_quality_report) :: quality
        integer :: i, j
        do j = 1, nj
            do i = 1, ni
                call place(i - 1, j - 1, xs(i, j), ys(i, j))
            end do
        end do
        call block%points(xs, ys)
        call block%line(body, 1, ni, 1, 1)
        call block%line(far_field, ni, 1, nj, nj)
        call block%line(far_field, 1, 2, 1, 2, stat=stat)
        call check(stat == hm_bad_argument, "a line that is none")
        call block%line(far_field, 1, ni + 1, 1, 1, stat=stat)
        call check(stat == hm_bad_argument, "a line that leaves the block")
        call curves%fit(xs(:ni - 1, 1), ys(:ni - 1, 1), .true., n_control=n_control)
        call plan%analyse(block, curves, [hm_condition(body)])
        call plan%factor()
        call plan%solve(its)
        move = some_move()
        call its%morph_to(move, xs, ys, x_new, y_new)
        call check(same(x_new(1, :), x_new(ni, :)) .and. same(y_new(1, :), y_new(ni, :)), "the cut stays closed")
        call its%boundary_error(move, xs, ys, x_new, y_new, error)
        call check(error < 1e-12_dp, "its wall moves as the B-spline does")
        call its%displacement(move, dx, dy)
        call its%adjoint(dx, dy, expected)
        call its%admissible_step(block, dx, dy, step)
        call its%quality(block, x_new, y_new, quality, xs, ys)
        call check(quality%inverted == 0 .and. step%admissible > 1, "step and quality of a block")
        call its%values(2, value)
        call its%values(2, one)
        call check(same(reshape(value, [ni * nj]), one), "values of a block")

        ! The same inside ghost layers, interleaved: converted, and written back.
        padded = -7
        padded(1, 1:ni, 1:nj) = xs
        padded(2, 1:ni, 1:nj) = ys
        call inner%points(padded(1, 1:ni, 1:nj), padded(2, 1:ni, 1:nj))
        call inner%line(body, 1, ni, 1, 1)
        call inner%line(far_field, 1, ni, nj, nj)
        call plan%analyse(inner, curves, [hm_condition(body)])
        call plan%factor(padded(1, 1:ni, 1:nj), padded(2, 1:ni, 1:nj))
        call plan%solve(again)
        call again%morph(move, padded(1, 1:ni, 1:nj), padded(2, 1:ni, 1:nj))
        call check(all(abs(padded(1, 1:ni, 1:nj) - x_new) <= 0) .and. all(abs(padded(:, 0, :) + 7) <= 0), &
            "ghost layers")
        layers = padded
        padded(1, 1:ni, 1:nj) = xs
        padded(2, 1:ni, 1:nj) = ys
        call again%displacement(move, layers(1, 1:ni, 1:nj), layers(2, 1:ni, 1:nj))
        call again%adjoint(layers(1, 1:ni, 1:nj), layers(2, 1:ni, 1:nj), gradient)
        call check(maxval(abs(gradient - expected)) <= 0, "their adjoint")
        call again%admissible_step(inner, layers(1, 1:ni, 1:nj), layers(2, 1:ni, 1:nj), same_step)
        call check(same([step%admissible], [same_step%admissible]), "their admissible step, from where the mesh is now")
        call again%morph(move, xs, ys)
        call check(all(abs(xs - x_new) <= 0), "a block in place")
        call inner%free()

        ! The same as one row of points.
        do j = 1, nj
            do i = 1, ni
                call place(i - 1, j - 1, flat(i + ni * (j - 1)), flat_y(i + ni * (j - 1)))
            end do
        end do
        call inner%points(flat, flat_y)
        call inner%structured(ni, nj - 1, stat, err)
        call check(stat == hm_bad_argument, "not all points are in the block: " // err%text)
        call inner%structured(ni, nj)
        call inner%line(body, 1, ni, 1, 1)
        call inner%line(far_field, 1, ni, nj, nj)
        call plan%analyse(inner, curves, [hm_condition(body)])
        call plan%factor()
        call again%free()
        call plan%solve(again)
        call again%morph(move, flat, flat_y)
        call check(same(flat, reshape(x_new, [ni * nj])), "a block in one row")
        call inner%points(flat, flat_y(2:), stat=stat)
        call check(stat == hm_bad_argument, "x and y of different lengths")
        call inner%points(xs, ys(:, 2:), stat=stat)
        call check(stat == hm_bad_argument, "x and y of different shapes")
    end subroutine

    subroutine default_reals()
        real(c_float), target :: x4(n_points), y4(n_points), dx4(n_points), dy4(n_points)
        real(c_float) :: x_new4(n_points), y_new4(n_points)
        real(c_float) :: block_x(around, rings), block_y(around, rings), block_dx(around, rings)
        real(c_float) :: block_dy(around, rings)
        real(c_float) :: move4(2, n_control), gradient4(2, n_control), values4(n_points), block_values(around, rings)
        real(dp) :: dx(n_points), dy(n_points), gradient(2, n_control), error
        type(hm_mesh) :: mesh4
        type(hm_plan) :: plan
        type(hm_curves) :: curves
        type(hm_basis) :: its
        type(hm_step_report) :: step
        type(hm_quality_report) :: quality
        x4 = real(x, c_float)
        y4 = real(y, c_float)
        move4 = real(some_move(), c_float)
        call mesh4%points(x4, y4)
        call mesh4%cells(cells)
        call mesh4%faces(faces, markers)
        call solve(mesh4, its)
        call its%curves(curves)
        call its%displacement(real(move4, dp), dx, dy)
        call its%adjoint(dx, dy, gradient)
        call its%displacement(move4, dx4, dy4)
        call check(maxval(abs(dx4 - dx)) < 1e-8_dp .and. maxval(abs(dy4 - dy)) < 1e-8_dp, &
            "displacement in default reals")
        call its%velocity(move4, dx4, dy4)
        call its%adjoint(dx4, dy4, gradient4)
        call check(maxval(abs(gradient4 - gradient)) < 1e-5_dp * maxval(abs(gradient)), "adjoint in default reals")
        call its%morph_to(move4, x4, y4, x_new4, y_new4)
        call its%boundary_error(move4, x4, y4, x_new4, y_new4, error)
        call check(error < 1e-6_dp, "boundary in default reals")
        call its%admissible_step(mesh4, dx4, dy4, step)
        call check(step%admissible > 0, "step in default reals")
        call its%quality(mesh4, x_new4, y_new4, quality, x4, y4)
        call check(quality%inverted == 0, "quality in default reals")
        call its%values(3, values4)
        block_x = reshape(x4, shape(block_x))
        block_y = reshape(y4, shape(block_y))
        call its%morph(move4, x4, y4)
        call check(all(abs(x4 - x_new4) <= 0) .and. all(abs(y4 - y_new4) <= 0), "morph in default reals")

        ! Any rank 2 array of so many points will do for the products.
        call its%displacement(move4, block_dx, block_dy)
        call check(all(abs(reshape(block_dx, shape(dx4)) - dx4) <= 0), "displacement of a block in default reals")
        call its%adjoint(block_dx, block_dy, gradient4)
        call check(maxval(abs(gradient4 - gradient)) < 1e-5_dp * maxval(abs(gradient)), "its adjoint")
        call its%admissible_step(mesh4, block_dx, block_dy, step)
        call its%values(3, block_values)
        call check(all(abs(reshape(block_values, shape(values4)) - values4) <= 0), "values of a block in default reals")
        block_dx = block_x
        block_dy = block_y
        call its%morph(move4, block_dx, block_dy)
        call check(all(abs(reshape(block_dx, shape(x4)) - x4) <= 0), "morph of a block in default reals")
        call its%boundary_error(move4, block_x, block_y, block_dx, block_dy, error)
        call check(error < 1e-6_dp, "its boundary")
        call its%quality(mesh4, block_dx, block_dy, quality, block_x, block_y)
        call check(quality%inverted == 0, "its quality")
        call its%morph_to(move4, block_x, block_y, block_dx, block_dy)
        call check(all(abs(reshape(block_dx, shape(x4)) - x4) <= 0), "to another array")
        call mesh4%free()

        ! Default-real coordinates of a mesh that a plan knows: the plan reads them as they are now.
        x4 = real(x, c_float)
        y4 = real(y, c_float)
        call mesh4%points(x4, y4)
        call mesh4%cells(cells)
        call mesh4%faces(faces, markers)
        call plan%analyse(mesh4, curves, [hm_condition(body)])
        x4 = -x4
        call plan%factor(stat=stat, err=err)
        call check(stat == hm_bad_mesh, "a plan sees that its mesh was mirrored: " // err%text)
        x4 = -x4
        call mesh4%free()
        call plan%factor()
        call its%free()
        call plan%solve(its)
        call its%values(3, block_values)
        call check(all(abs(reshape(block_values, shape(values4)) - values4) < 1e-6_dp), "and that it was mirrored back")
    end subroutine

    subroutine long_integers()
        integer(c_int64_t), save :: cells8(4, n_cells), faces8(2, 2 * around), markers8(2 * around)
        integer(c_int64_t), save :: rows8(4 * n_cells), start8(n_cells + 1), lists8(2 * around), list_start8(3), &
            list_markers8(2)
        type(hm_mesh) :: mesh8
        type(hm_plan) :: plan
        type(hm_mesh_report) :: report
        type(hm_basis) :: its
        real(dp) :: a(n_points), b(n_points)
        integer :: k
        cells8 = cells
        faces8 = faces
        markers8 = markers
        call mesh8%points(x, y)
        call mesh8%cells(cells8)
        call mesh8%faces(faces8, markers8)
        call solve(mesh8, its)
        call its%values(1, a)
        call solve(mesh, its)
        call its%values(1, b)
        call check(same(a, b), "8-byte integers")
        rows8 = reshape(cells8, shape(rows8))
        start8 = 1 + 4 * [(int(k, c_int64_t), k = 0, n_cells)]
        call mesh8%points(x, y)
        call mesh8%cells(rows8, start8)
        call mesh8%faces(faces8, markers8)
        call plan%analyse(mesh8)
        call plan%report(report)
        call check(report%quads == n_cells, "rows of 8-byte integers")
        lists8 = [[(int(k, c_int64_t), k = 1, around)], [(int(k, c_int64_t), k = n_points - around + 1, n_points)]]
        list_start8 = [1, around + 1, 2 * around + 1]
        list_markers8 = [body, far_field]
        call mesh8%lists(lists8, list_start8, list_markers8)
        call plan%analyse(mesh8, stat=stat, err=err)
        call check(stat == hm_ok, "lists and faces together: " // err%text)
        cells8(2, 5) = 2_c_int64_t**40
        call mesh8%points(x, y)
        call mesh8%cells(cells8)
        call plan%analyse(mesh8, stat=stat, err=err)
        call check(stat == hm_bad_mesh .and. err%item == 5, "a point number beyond 4 bytes is refused: " // err%text)
    end subroutine

    subroutine files()
        type(hm_basis) :: copy, second
        real(dp) :: a(n_points), b(n_points)
        real(dp), allocatable, target :: block(:)
        real(dp), target :: x_moved(n_points)
        type(hm_mesh) :: other
        integer(c_int64_t) :: length
        integer(c_int32_t) :: mark
        integer :: unit
        character(len=*), parameter :: name = "use_basis.tmp"
        call basis%save(name)
        call copy%load(name, mesh)
        call basis%values(5, a)
        call copy%values(5, b)
        call check(same(a, b), "saved and loaded: the same")

        ! Two of them in one stream, with something round them.
        open(newunit=unit, file=name, access="stream", form="unformatted", status="replace", action="readwrite")
        write(unit) 17_c_int32_t
        call basis%write(unit)
        length = basis%bytes()
        write(unit) length
        call basis%write(unit)
        rewind(unit)
        read(unit) mark
        call copy%read(unit, mesh, bytes=length)
        read(unit) length
        call second%read(unit)
        call copy%values(5, a)
        call second%values(5, b)
        call check(same(a, b), "two in one stream")
        call check(length == second%bytes(), "their length")
        call second%read(unit, stat=stat, err=err)
        call check(stat == hm_bad_basis, "nothing left to read: " // err%text)
        rewind(unit)
        call second%read(unit, stat=stat, err=err)
        call check(stat == hm_bad_basis, "not a basis: " // err%text)
        close(unit, status="delete")
        call copy%load("no/such/file", stat=stat, err=err)
        call check(stat == hm_bad_basis .and. err%text /= "", "no such file: " // err%text)
        call basis%save("no/such/file", stat=stat)
        call check(stat == hm_bad_basis, "a file that cannot be written")

        ! A basis as an array of numbers: attached where it lies.
        allocate(block((basis%bytes() + 7) / 8))
        call basis%save(name)
        open(newunit=unit, file=name, access="stream", form="unformatted", action="read")
        read(unit) block(:basis%bytes() / 8)
        close(unit, status="delete")
        if (modulo(basis%bytes(), 8_c_int64_t) == 0) then
            call copy%attach(block, mesh)
            call copy%values(5, b)
            call check(same(a, b), "attached")
            x_moved = 2 * x
            call other%points(x_moved, y)
            call other%cells(cells)
            call other%faces(faces, markers)
            call copy%attach(block, other, stat)
            call check(stat == hm_moved, "the same mesh with other coordinates")
            call copy%attach(block(:10), stat=stat)
            call check(stat == hm_bad_basis, "cut short")
        end if
        call copy%free()
        call copy%values(1, a, stat=stat)
        call check(stat == hm_bad_argument, "nothing is left of it")
    end subroutine

    subroutine own_memory()
        real(dp), allocatable, target :: analysis(:), plan_block(:), basis_block(:)
        integer(c_int64_t) :: words
        type(hm_plan) :: plan
        type(hm_curves) :: curves
        type(hm_basis) :: its
        real(dp) :: a(n_points), b(n_points)
        call basis%curves(curves)
        call hm_analysis_words(words, mesh, curves, [hm_condition(body)])
        allocate(analysis(words))
        call plan%analyse(mesh, curves, [hm_condition(body)], work=analysis(2:), stat=stat, err=err)
        call check(stat == hm_block_too_small .and. err%value > 0, "work of the analysis 8 bytes too small")
        call plan%analyse(mesh, curves, [hm_condition(body)], work=analysis(::2), stat=stat)
        call check(stat == hm_bad_argument, "work that is not contiguous")
        call plan%analyse(mesh, curves, [hm_condition(body)], work=analysis)
        allocate(plan_block(plan%plan_words()), basis_block(plan%basis_words()))
        call plan%prepare(plan_block(2:), stat)
        call check(stat == hm_block_too_small, "work of the plan too small")
        call plan%prepare(plan_block)
        call its%init(plan, basis_block(2:), stat)
        call check(stat == hm_block_too_small, "work of the basis too small")
        call its%init(plan, basis_block)
        call plan%drop_analysis()
        analysis = -1
        call plan%factor()
        call plan%solve(its)
        call plan%free()
        plan_block = -1
        call its%values(4, a)
        call basis%values(4, b)
        call check(same(a, b), "the same functions in own memory")
        call its%free()
        basis_block = -1
        call check(same(basis_block(:1), [-1._dp]), "own memory is not freed")
    end subroutine

    subroutine threads()
        type(hm_executor) :: four
        type(hm_options) :: options
        type(hm_plan) :: plan
        type(hm_curves) :: curves
        type(hm_basis) :: its
        type(hm_step_report) :: step
        type(hm_quality_report) :: quality
        integer(c_int64_t) :: sums(4 * 2 * n_control)
        integer :: scale
        real(dp) :: move(2, n_control), gradient(2, n_control), expected(2, n_control)
        real(dp), dimension(n_points) :: a, b, dx, dy
        call basis%curves(curves)
        four%run => run_backwards
        four%n_threads = 4
        options%executor = four
        tasks_seen = 0
        call plan%analyse(mesh, curves, [hm_condition(body)], options=options)
        call plan%factor()
        call plan%solve(its)
        call its%values(2, a)
        call basis%values(2, b)
        call check(same(a, b), "four threads, whose tasks run backwards: the same bits")
        call check(tasks_seen > 0, "there were tasks")
        move = some_move()
        call basis%displacement(move, a, b)
        call basis%adjoint(a, b, expected)
        call its%displacement(move, dx, dy, executor=four)
        call check(same(dx, a) .and. same(dy, b), "displacement on threads")
        call its%adjoint(dx, dy, gradient, executor=four)
        call check(maxval(abs(gradient - expected)) <= 0, "adjoint on threads")
        call its%admissible_step(mesh, dx, dy, step, executor=four)
        call its%quality(mesh, x, y, quality, executor=four)
        call check(step%admissible > 0 .and. quality%inverted == 0, "step and quality on threads")
        call its%morph_to(move, x, y, a, b, executor=hm_openmp(2))
        call check(maxval(abs(a - x - dx)) < 1e-15_dp, "threads of OpenMP, if it is there")

        ! Each of them hands the executor on: 300 threads are refused.
        four%n_threads = 300
        call its%displacement(move, dx, dy, executor=four, stat=stat)
        call check(stat == hm_bad_argument, "displacement on 300 threads")
        call its%adjoint(dx, dy, gradient, executor=four, stat=stat)
        call check(stat == hm_bad_argument, "adjoint on 300 threads")
        call its%admissible_step(mesh, dx, dy, step, executor=four, stat=stat)
        call check(stat == hm_bad_argument, "step on 300 threads")
        call its%quality(mesh, x, y, quality, executor=four, stat=stat)
        call check(stat == hm_bad_argument, "quality on 300 threads")
        call its%assess(mesh, dx, dy, step, quality, executor=four, stat=stat)
        call check(stat == hm_bad_argument, "assessment on 300 threads")
        scale = 0
        call its%adjoint_scale(dx, dy, scale, executor=four, stat=stat)
        call check(stat == hm_bad_argument, "scale on 300 threads")
        call its%adjoint_sums(dx, dy, scale, sums, executor=four, stat=stat)
        call check(stat == hm_bad_argument, "sums on 300 threads")
    end subroutine

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
        call solve(mesh, conformal)
        call conformal%info(info)
        call check(info%operator_kind == hm_conformal .and. info%exponent_quarters == 6 .and. &
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
        options%exponent_quarters = hm_no_weight
        call solve(mesh, other, options=options)
        call other%values(3, a)
        call other%values(3, b, number=2)
        call check(maxval(abs(a - laplace)) < 1e-12_dp .and. maxval(abs(b)) < 1e-12_dp, "conformal, no weight: Laplace")

        options = hm_options(operator_kind=hm_weighted, exponent_quarters=8)
        call solve(mesh, other, options=options)
        call other%values(3, a)
        options%precision = hm_single
        call solve(mesh, other, options=options)
        call other%values(3, b)
        call check(maxval(abs(a - b)) < 1e-8_dp .and. .not. same(a, b), "a factor in single precision")
        call check(maxval(abs(a - laplace)) > 1e-2_dp, "weights matter")

        call conformal%curves(curves)
        options = hm_options(operator_kind=hm_laplace, engine=hm_multigrid, levels=3, block_width=4, &
            agglomeration=hm_agglomerate_isotropic)
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
        call plan%level(2, merged, n_merged)
        call check(n_merged > 0 .and. 2 * n_merged < n_points .and. maxval(merged) == n_merged .and. &
            all(merged(:around) == 0) .and. count(merged == 0) == 2 * around, "its second level")
        call plan%level(4, merged, stat=stat)
        call check(stat == hm_bad_argument .and. .not. allocated(merged), "there is no fourth one")
        options%engine = hm_fas
        call plan%analyse(mesh, curves, [hm_condition(body)], options=options)
        call plan%factor()
        call other%free()
        call plan%solve(other, report)
        call other%values(3, a)
        call check(maxval(abs(a - laplace)) < 1e-7_dp .and. report%iterations > 5, &
            "the paper's iteration: the same again")
        options%engine = hm_multigrid
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
        options%agglomeration = 99
        call plan%analyse(mesh, curves, [hm_condition(body)], options=options, stat=stat)
        call check(stat == hm_bad_argument, "an agglomeration to come")

        ! With the offset correction a rigid motion of the control points is one of the wall; without, its offset stays.
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

    ! How far the wall is from where a turn about the origin takes it.
    subroutine turn_wall(its, degrees, error)
        type(hm_basis), intent(in) :: its
        real(dp), intent(in) :: degrees
        real(dp), intent(out) :: error
        type(hm_curves) :: curves
        real(dp) :: dx(n_points), dy(n_points), wanted(2, around)
        call its%curves(curves)
        call its%displacement(turn(curves%control, degrees), dx, dy)
        wanted = turn(xy(:, :around), degrees)
        error = maxval(hypot(dx(:around) - wanted(1, :), dy(:around) - wanted(2, :)))
    end subroutine

    ! A rigid hole in a channel; left and right are a periodic pair, the ceiling slips, the floor is fixed.
    subroutine conditions()
        real(dp), target :: cx(231), cy(231)
        integer(c_int32_t), target :: its_cells(4, 200), its_faces(2, 100), its_markers(100)
        type(hm_mesh) :: channel
        type(hm_plan) :: plan
        type(hm_basis) :: its, again
        type(hm_basis_info) :: info
        type(hm_condition), allocatable :: known(:)
        type(hm_curves) :: none
        real(dp) :: move(2, 2), dx(231), dy(231), c, s, value(231), angle
        integer :: cell_count, face_count, k
        integer, allocatable :: hole(:), below(:), above(:), left(:), right(:)
        call make_channel(cx, cy, its_cells, cell_count, its_faces, its_markers, face_count)
        call channel%points(cx, cy)
        call channel%cells(its_cells(:, :cell_count))
        call channel%faces(its_faces(:, :face_count), its_markers(:face_count))
        call plan%analyse(channel, conditions=[hm_condition(5, hm_rigid, x=10._dp, y=5._dp), hm_condition(3, hm_slip), &
            hm_condition(4, hm_periodic_pair, partner=2)])
        call plan%boundary([5], hole)
        call plan%boundary([1], below)
        call plan%boundary([2], right)
        call plan%boundary([3], above)
        call plan%boundary([4], left)
        call plan%factor()
        call plan%solve(its)
        call its%info(info)
        call check(info%bodies == 1 .and. info%functions == 2 .and. info%curves == 0 .and. &
            info%numbers_per_value == 4, "a rigid body without curves")
        call check(size(info%curve_point) == 12 .and. all(info%point_curve == 1), "its points")
        call its%curves(none)
        call check(size(none%control, 2) == 0 .and. size(none%curve) == 0, "no curves to be had")

        c = cos(0.3_dp) - 1
        s = sin(0.3_dp)
        move = reshape([0.4_dp, 0.2_dp, c, s], [2, 2])
        call its%displacement(move, dx, dy)
        call check(all(abs(dx(hole) - (0.4_dp + c * (cx(hole) - 10) - s * (cy(hole) - 5))) < 1e-14_dp) .and. &
            all(abs(dy(hole) - (0.2_dp + s * (cx(hole) - 10) + c * (cy(hole) - 5))) < 1e-14_dp), &
            "the body moves rigidly")
        call check(all(abs(dx(below)) <= 0) .and. all(abs(dy(below)) <= 0), "the floor stays")
        call check(all(abs(dy(above)) <= 0) .and. maxval(abs(dx(above))) > 1e-3_dp, "the ceiling slips")
        call check(same(dx(left), dx(right(size(right):1:-1))) .and. same(dy(left), dy(right(size(right):1:-1))) .and. &
            maxval(abs(dx(left))) > 1e-3_dp, "left and right move alike")

        call its%conditions(known)
        call check(size(known) == 3, "three conditions are known")
        call check(known(1)%kind == hm_rigid .and. known(1)%body == 1 .and. abs(known(1)%x - 10) + abs(known(1)%y - &
            5) <= 0 .and. known(2)%kind == hm_slip .and. known(2)%marker == 3 .and. known(3)%partner == 2, &
            "as they were given")
        call plan%analyse(channel, conditions=known)
        call plan%factor()
        call plan%solve(again)
        do k = 1, 4
            call its%values(2, dx, number=k)
            call again%values(2, value, number=k)
            call check(same(dx, value), "the same conditions, the same functions")
        end do
        call again%free()
        call again%conditions(known, stat)
        call check(stat == hm_bad_argument, "an empty basis has no conditions")
        call plan%analyse(channel, conditions=[hm_condition(5, hm_rigid, body=2)], stat=stat)
        call check(stat == hm_bad_condition, "bodies count without gaps")
        call plan%analyse(channel, conditions=[hm_condition(5, hm_rigid), hm_condition(1, hm_free)], stat=stat)
        call check(stat == hm_unsupported, "free sides are not for conformal functions")
        call plan%analyse(channel, conditions=[hm_condition(5, hm_rigid), &
            hm_condition(4, hm_periodic_pair, partner=3)], stat=stat)
        call check(stat == hm_bad_condition, "no pair")

        ! Bent round (1, 2), the right side is the left one, turned by an angle.
        angle = 0.5_dp
        do k = 1, size(cx)
            c = angle * cx(k) / 20
            s = 30 - cy(k)
            cx(k) = 1 + s * cos(c)
            cy(k) = 2 + s * sin(c)
        end do
        call channel%points(cx, cy)
        call channel%cells(its_cells(:, :cell_count))
        call channel%faces(its_faces(:, :face_count), its_markers(:face_count))
        call plan%analyse(channel, conditions=[hm_condition(5, hm_rigid, x=30._dp, y=5._dp), &
            hm_condition(4, hm_rotation_pair, partner=2, x=1._dp, y=2._dp)])
        call plan%factor()
        call plan%solve(its)
        call its%displacement(move, dx, dy)
        right = right(size(right):1:-1)
        call check(all(abs(cos(angle) * dx(left) - sin(angle) * dy(left) - dx(right)) < 1e-14_dp) .and. &
            all(abs(sin(angle) * dx(left) + cos(angle) * dy(left) - dy(right)) < 1e-14_dp) .and. &
            maxval(abs(dx(left))) > 1e-3_dp, "the right side of a passage moves as the left one, turned")
        call its%conditions(known)
        call check(known(2)%kind == hm_rotation_pair .and. abs(known(2)%x - 1) + abs(known(2)%y - 2) <= 0, &
            "a rotation pair as it was given")
    end subroutine

    ! assess says before the morph what admissible_step and quality say before and after it, in every layout.
    subroutine assessments()
        real(dp) :: move(2, n_control), x_new(n_points), y_new(n_points), dx(n_points), dy(n_points)
        real(dp) :: block_x(around, rings), block_y(around, rings)
        type(hm_step_report) :: step, its_step
        type(hm_quality_report) :: quality, its_quality
        call solve(mesh, basis)
        move = 5 * some_move()
        call basis%displacement(move, dx, dy)
        call basis%morph_to(move, x, y, x_new, y_new)
        call basis%admissible_step(mesh, dx, dy, step)
        call basis%quality(mesh, x_new, y_new, quality, x, y)
        call basis%assess(mesh, dx, dy, its_step, its_quality)
        call compare_assessment(step, its_step, quality, its_quality)
        call check(its_step%cell == step%cell .and. its_quality%min_quality_cell == quality%min_quality_cell, "where")
        block_x = reshape(dx, shape(block_x))
        block_y = reshape(dy, shape(block_y))
        call basis%assess(mesh, block_x, block_y, its_step, its_quality, executor=hm_openmp(2))
        call compare_assessment(step, its_step, quality, its_quality)
        call basis%assess(mesh, real(dx, c_float), real(dy, c_float), its_step, its_quality)
        call compare_assessment(step, its_step, quality, its_quality)
        call basis%assess(mesh, real(block_x, c_float), real(block_y, c_float), its_step, its_quality)
        call compare_assessment(step, its_step, quality, its_quality)
        call basis%assess(mesh, dx(2:), dy(2:), its_step, its_quality, stat=stat)
        call check(stat == hm_bad_argument, "a displacement too few")
        call starts_elsewhere(dx, dy, step, quality)
    end subroutine

    ! A mesh whose arrays hold other coordinates than those the movement starts from: it is judged from where it starts.
    subroutine starts_elsewhere(dx, dy, step, quality)
        real(dp), intent(in) :: dx(:), dy(:)
        type(hm_step_report), intent(in) :: step
        type(hm_quality_report), intent(in) :: quality
        real(dp), target :: x_now(n_points), y_now(n_points)
        type(hm_mesh) :: elsewhere
        type(hm_step_report) :: its_step
        type(hm_quality_report) :: its_quality
        x_now = x + 0.5_dp * step%admissible * dx
        y_now = y + 0.5_dp * step%admissible * dy
        call elsewhere%points(x_now, y_now)
        call elsewhere%cells(cells)
        call elsewhere%faces(faces, markers)
        call basis%admissible_step(elsewhere, dx, dy, its_step, x, y)
        call check(abs(its_step%admissible - step%admissible) <= 0, "the step from other coordinates")
        call basis%assess(elsewhere, dx, dy, its_step, its_quality, x, y)
        call check(abs(its_step%admissible - step%admissible) <= 0, "the assessed step from other coordinates")
        call compare_assessment(step, its_step, quality, its_quality)
        call basis%admissible_step(elsewhere, dx, dy, its_step)
        call check(abs(its_step%admissible - 0.5_dp * step%admissible) < 1e-9_dp * step%admissible, &
            "the step from the mesh's own coordinates")
        call basis%admissible_step(elsewhere, dx, dy, its_step, x, stat=stat)
        call check(stat == hm_bad_argument, "x without y")
        call basis%assess(elsewhere, dx, dy, its_step, its_quality, x(2:), y(2:), stat=stat)
        call check(stat == hm_bad_argument, "a start of one point too few")
    end subroutine

    subroutine compare_assessment(step, its_step, quality, its_quality)
        type(hm_step_report), intent(in) :: step, its_step
        type(hm_quality_report), intent(in) :: quality, its_quality
        call check(abs(its_step%admissible / step%admissible - 1) < 1e-4_dp .and. &
            abs(its_quality%mean_quality - quality%mean_quality) < 1e-5_dp .and. &
            its_quality%inverted == quality%inverted, "assessment")
    end subroutine

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
        real, target :: x4(n_points), y4(n_points)
        type(hm_basis) :: safe
        type(hm_safe_report) :: safe_report
        real(dp), allocatable, target :: walls(:, :, :), fields_x(:, :), fields_y(:, :), gradients(:, :, :)
        integer, allocatable :: points(:), list(:)
        integer :: k
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
        call check(all(same_numbers(found_x(points), wall(1, :))) .and. all(same_numbers(found_y(points), wall(2, :))), &
            "wall points move by the given bits")
        x2 = x
        y2 = y
        list = [(around + 1 - k, k = 1, around)]
        wall(1, :) = dx(list)
        wall(2, :) = dy(list)
        call plan%displace(wall, x2, y2, list)
        call check(all(same_numbers(x2, x + found_x)) .and. all(same_numbers(y2, y + found_y)), "in place, by a list")

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
        call plan%displace_safe(safe, wall, x2, y2, points=list, report=safe_report)
        call check(safe_report%strategy == hm_strategy_linear .and. safe_report%other == -1, "a small one, safely")
        call check(maxval(abs(x2 - x - found_x)) + maxval(abs(y2 - y - found_y)) < 1e-13_dp, "the same mesh, safely")
        wall(1, :) = -0.3_dp * x(list) - 0.8_dp * y(list)
        wall(2, :) = 0.8_dp * x(list) - 0.3_dp * y(list)
        call plan%displace_safe(safe, wall, x2, y2, points=list, options=hm_safe_options(min_quality=-1._dp), &
            report=safe_report, stat=stat, err=err)
        call check(stat == hm_ok .and. safe_report%inverted == 0, "a large one, safely: " // err%text)
        call check(all(same_numbers(x2(list), x(list) + wall(1, :))) .and. all(same_numbers(y2(list), y(list) + wall(2, :))), &
            "a large one, by the given bits")
        x4 = real(x)
        y4 = real(y)
        call plan%displace_safe(safe, real(0.01_dp * wall), x4, y4, points=list)
        call check(maxval(abs(x4(list) - x(list) - 0.01_dp * wall(1, :))) < 1e-6_dp, "safely, in default reals")
        wall(1, 3) = 1e4_dp
        call plan%displace_safe(safe, wall, x2, y2, points=list, stat=stat)
        call check(stat == hm_crossing, "a wall that crosses itself, safely")
        call plan%displace_safe(safe, wall, x2(2:), y2(2:), points=list, stat=stat)
        call check(stat == hm_bad_argument, "fewer mesh points, safely")
        call plan%displace_safe(safe, wall, x2, y2, move, list, stat=stat)
        call check(stat == hm_bad_argument, "a movement of functions that are not there, safely")
        call safe_together()

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
        call check(report%step_fraction >= 1 .and. all(same_numbers(x2(points), x(points) + wall(1, :))), &
            "the outer boundary as given")
        call basis%morph_to(move, x, y, moved_x, moved_y)
        call check(maxval(abs(x2(:around) - moved_x(:around))) < 1e-14_dp, "and the curve in the same call")
    end subroutine

    elemental logical function same_numbers(a, b)
        real(dp), intent(in) :: a, b
        same_numbers = abs(a - b) <= 0
    end function

    ! The far field slides along its circle.
    subroutine slide_on_a_circle()
        type(hm_plan) :: plan, empty
        type(hm_curves) :: curves
        type(hm_basis) :: sliding, along_circle
        type(hm_curves), target :: circle
        type(hm_condition) :: conditions(2)
        type(hm_condition), allocatable :: known(:)
        real(dp), dimension(n_points) :: x_new, y_new, gx, gy, x_tangent, y_tangent
        real(dp) :: radius, off, rate
        logical :: outer(n_points)
        real(dp), parameter :: h = 1e-6_dp
        call basis%curves(curves)
        call plan%analyse(mesh, curves, [hm_condition(body), hm_condition(far_field, hm_slip)])
        call plan%prepare()
        call plan%factor()
        call plan%solve(sliding)
        call sliding%morph_to(turn(curves%control, 30._dp), x, y, x_tangent, y_tangent)
        outer = .false.
        outer(n_points - around + 1:) = .true.   ! a circle about (-0.02, 0), but for some parts in 10 000
        radius = sum(hypot(x + 0.02_dp, y), mask=outer) / around
        x_new = x_tangent
        y_new = y_tangent
        call plan%slide(x_new, y_new)
        off = maxval(abs(hypot(x_tangent + 0.02_dp, y_tangent) - radius), mask=outer)
        call check(off > 1e-2_dp * radius, "the functions move points along tangents")
        off = maxval(abs(hypot(x_new + 0.02_dp, y_new) - radius), mask=outer)
        call check(off < 1e-3_dp * radius, "slide puts them onto the circle")
        ! The change of the sum of all coordinates, a little farther along the movement.
        gx = 1
        gy = 1
        call plan%slide_adjoint(x_tangent, y_tangent, gx, gy)
        rate = sum(gx * (x_tangent - x)) + sum(gy * (y_tangent - y))
        gx = x_tangent + h * (x_tangent - x)
        gy = y_tangent + h * (y_tangent - y)
        call plan%slide(gx, gy)
        off = sum(gx - x_new) + sum(gy - y_new)
        call check(abs(off / h - rate) < 1e-3_dp * max(1._dp, abs(rate)), "its transpose")
        call plan%slide(x_new(2:), y_new(2:), stat=stat)
        call check(stat == hm_bad_argument, "a point too few to slide")
        call empty%slide(x_new, y_new, stat=stat)
        call check(stat == hm_bad_argument, "sliding without an analysis")
        circle = rational_circle(-0.02_dp, radius)
        conditions = [hm_condition(body), hm_condition(far_field, hm_slip)]
        conditions(2)%along => circle
        call plan%analyse(mesh, curves, conditions)
        call plan%prepare()
        call plan%factor()
        call plan%solve(along_circle)
        gx = x_tangent
        gy = y_tangent
        call plan%slide(gx, gy)
        off = maxval(abs(hypot(gx + 0.02_dp, gy) - radius), mask=outer)
        call check(off < 1e-3_dp * radius, "slide puts them onto a circle that is given")
        off = maxval(hypot(gx - x_new, gy - y_new))
        call check(off > 1e-12_dp .and. off < 1e-3_dp * radius, "which is not quite that of the points")
        call along_circle%conditions(known)
        call check(known(2)%n_curves == 1 .and. .not. associated(known(2)%along), "a basis does not keep it")
        call plan%analyse(mesh, curves, known, stat=stat)
        call check(stat == hm_bad_condition, "so its conditions are refused")
        known(2)%along => circle
        call plan%analyse(mesh, curves, known, stat=stat)
        call check(stat == hm_ok, "until it is given again")
    end subroutine

    ! About (x, 0), in quarters.
    function rational_circle(x, radius) result(circle)
        real(dp), intent(in) :: x, radius
        type(hm_curves) :: circle
        real(dp) :: angle, far
        integer :: k
        allocate(circle%control(2, 8), circle%weights(8), circle%curve(1))
        do k = 1, 8
            angle = 0.3_dp + (k - 1) * atan(1._dp)
            far = merge(1._dp, sqrt(2._dp), mod(k, 2) == 1)
            circle%weights(k) = 1 / far
            circle%control(:, k) = far * radius * [cos(angle), sin(angle)] + [x, 0._dp]
        end do
        circle%curve(1)%degree = 2
        circle%curve(1)%indices = [1, 2, 3, 4, 5, 6, 7, 8, 1]
        circle%curve(1)%knots = real([0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4], dp)
    end function

    subroutine safe_morphs()
        type(hm_plan) :: plan
        type(hm_curves) :: curves
        type(hm_basis) :: laplace, weighted, derivative, others(1)
        type(hm_safe_report) :: report
        type(hm_improve_report) :: improved
        type(hm_quality_report) :: quality
        real(dp), dimension(n_points) :: x_new, y_new, x_other, y_other
        real(dp) :: move(2, n_control), error, ratio, block_x(around, rings), block_y(around, rings)
        real(c_float) :: x4(n_points), y4(n_points), block_x4(around, rings), block_y4(around, rings)
        real(dp), allocatable, target :: work(:)
        real(dp), pointer, contiguous :: reached(:, :)
        integer :: top
        call basis%curves(curves)
        call solve(mesh, laplace, options=hm_options(operator_kind=hm_laplace))
        call plan%morph_safe(laplace, some_move(), x_new, y_new, stat=stat)
        call check(stat == hm_bad_argument, "a plan that is empty")

        ! What is small is the morph.
        call plan%analyse(mesh, curves, [hm_condition(body)], options=hm_options(operator_kind=hm_laplace))
        call plan%prepare()
        move = 0.1_dp * some_move()
        call plan%morph_safe(laplace, move, x_new, y_new, report=report)
        call laplace%morph_to(move, x, y, x_other, y_other)
        call check(report%strategy == hm_strategy_linear .and. report%other == 0 .and. report%steps == 1 .and. &
            report%inverted == 0, "a small movement in one step")
        call check(maxval(abs(x_new - x_other)) < 1e-15_dp .and. maxval(abs(y_new - y_other)) < 1e-15_dp, &
            "it is the morph")

        ! What is large is too much for the functions, but not in several steps.
        move = turn(curves%control, 40._dp)
        call laplace%morph_to(move, x, y, x_other, y_other)
        call laplace%quality(mesh, x_other, y_other, quality)
        call check(quality%inverted > 0, "Laplace's functions invert cells at 40 degrees")
        call plan%morph_safe(laplace, move, x_new, y_new, report=report)
        call laplace%quality(mesh, x_new, y_new, quality, x, y)
        call check(quality%inverted == 0 .and. quality%self_crossing == 0 .and. &
            report%strategy >= hm_strategy_substeps .and. &
            report%step_fraction >= 1, "a safe morph inverts none")
        call check(abs(quality%min_quality - report%min_quality) < 1e-12_dp .and. report%min_quality_cell == &
            quality%min_quality_cell, "its report")
        call laplace%boundary_error(move, x, y, x_new, y_new, error)
        call check(error < 1e-12_dp, "its wall is the B-spline's")
        call solve(mesh, others(1))
        call plan%morph_safe(laplace, move, x_new, y_new, others=others, report=report)
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
        call laplace%quality(mesh, x_new, y_new, quality)
        call check(quality%inverted == 0 .and. report%cell >= 1 .and. report%resolves == 0, &
            "what was possible is valid")

        ! A body that grows: conformal functions stretch the first layers, heights brings them back.
        call plan%analyse(mesh, curves, [hm_condition(body)])
        call plan%prepare()
        call plan%morph_safe(others(1), 0.3_dp * curves%control, x_new, y_new, report=report)
        ratio = report%mean_height_ratio
        call plan%morph_safe(others(1), 0.3_dp * curves%control, x_new, y_new, options=hm_safe_options(heights=1._dp), &
            report=report)
        call check(report%heights > 0 .and. abs(report%mean_height_ratio - 1) < 0.8_dp * abs(ratio - 1), &
            "heights of first layers are brought back")

        ! The derivative of several steps: on straight lines it times the movement is the movement.
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

        ! Every layout, in own memory, on the spot.
        allocate(work(plan%morph_safe_words()))
        block_x = 0
        block_y = 0
        call plan%morph_safe(weighted, move, block_x, block_y, work=work)
        call check(same(reshape(block_x, [n_points]), x_new) .and. same(reshape(block_y, [n_points]), y_new), "a block")
        call plan%morph_safe(weighted, move, x_other, y_other, work=work(2:), stat=stat)
        call check(stat == hm_block_too_small, "work 8 bytes too small")
        call plan%morph_safe(weighted, real(move, c_float), x4, y4)
        call check(maxval(abs(x4 - x_new)) < 1e-5_dp, "default reals")
        call plan%morph_safe(weighted, real(move, c_float), block_x4, block_y4)
        call check(all(abs(reshape(block_x4, shape(x4)) - x4) <= 0) .and. &
            all(abs(reshape(block_y4, shape(y4)) - y4) <= 0), "a block of default reals")
        x_other = x_new
        y_other = y_new
        call plan%improve(x_other, y_other, report=improved)
        call check(improved%movable > 0 .and. improved%mean_quality >= improved%mean_quality_before, "an improvement")
        call basis%quality(mesh, x_other, y_other, quality, x, y)
        call check(abs(quality%min_quality - improved%min_quality) <= 0 .and. quality%inverted == 0, "and its report")
        deallocate(work)
        allocate(work(plan%improve_words()))
        block_x = reshape(x_new, [around, rings])
        block_y = reshape(y_new, [around, rings])
        call plan%improve(block_x, block_y, reshape(x, [around, rings]), reshape(y, [around, rings]), work=work)
        call check(same(reshape(block_x, [n_points]), x_other) .and. same(reshape(block_y, [n_points]), y_other), &
            "the mesh before the movement as reference, a block, own memory")
        call plan%improve(x_other, y_other, max_iterations=-1, stat=stat)
        call check(stat == hm_bad_argument, "fewer steps than none")
        call plan%improve(x_other(2:), y_other(2:), stat=stat)
        call check(stat == hm_bad_argument, "an improvement of a point too few")
        call slide_on_a_circle()
        call plan%morph_safe(weighted, move, x_new, y_new, options=hm_safe_options(min_quality=0.999_dp), report=report, &
            stat=stat, err=err)
        call check(stat == hm_poor .and. report%n_worst == 5 .and. report%worst(1)%cell == report%min_quality_cell .and. &
            err%item == report%worst(1)%cell .and. index(err%text, "(") > 0, "poorer than asked for: " // err%text)
        call plan%morph_safe(weighted, move, x_new, y_new, options=hm_safe_options(min_quality=1.5_dp), stat=stat)
        call check(stat == hm_bad_argument, "a quality above 1")
        call plan%morph_safe(weighted, move(:, 2:), x_new, y_new, stat=stat)
        call check(stat == hm_bad_argument, "a movement too few")
        call plan%morph_safe(weighted, move, x_new(2:), y_new(2:), stat=stat)
        call check(stat == hm_bad_argument, "a point too few")
        move = 0
        top = maxloc(curves%control(2, :), 1)
        move(2, top) = -4 * curves%control(2, top)
        x_other = x_new
        call plan%morph_safe(weighted, move, x_new, y_new, report=report, stat=stat, err=err)
        call check(stat == hm_crossing .and. same(x_new, x_other) .and. report%crossing_points(4) >= 1, &
            "a boundary that crosses itself: " // err%text)
        call make_points(x_other, y_other)
        call check(same(x, x_other) .and. same(y, y_other), "the mesh is where it was")
    end subroutine

    ! From every second point in both directions to all of them.
    subroutine transfers()
        integer, parameter :: n = around / 2, m = (rings + 1) / 2
        real(dp), target :: cx(n * m), cy(n * m)
        integer(c_int32_t), target :: its_cells(4, n * (m - 1)), its_faces(2, 2 * n), its_markers(2 * n)
        type(hm_mesh) :: coarse_mesh
        type(hm_basis) :: coarse, fine, again
        type(hm_plan) :: plan
        type(hm_curves) :: curves
        type(hm_transfer_report) :: report
        real(dp) :: a(n_points), b(n_points)
        real(dp), allocatable, target :: work(:)
        integer :: i, j, next
        do i = 0, n - 1
            next = modulo(i + 1, n)
            do j = 0, m - 1
                call place(2 * i, 2 * j, cx(1 + i + n * j), cy(1 + i + n * j))
                if (j < m - 1) its_cells(:, 1 + i + n * j) = 1 + [i + n * j, i + n * (j + 1), next + n * (j + 1), &
                    next + n * j]
            end do
            its_faces(:, 1 + i) = 1 + [i, next]
            its_faces(:, 1 + n + i) = 1 + n * (m - 1) + [i, next]
        end do
        its_markers(:n) = body
        its_markers(n + 1:) = far_field
        call coarse_mesh%points(cx, cy)
        call coarse_mesh%cells(its_cells)
        call coarse_mesh%faces(its_faces, its_markers)
        call basis%curves(curves)
        call plan%analyse(coarse_mesh, curves, [hm_condition(body)])
        call plan%factor()
        call plan%solve(coarse)
        call plan%analyse(mesh, curves, [hm_condition(body)])
        call plan%transfer(coarse, coarse_mesh, fine, report)
        call check(report%points == n_points - 2 * around .and. report%boundary_error < 1e-14_dp, &
            "points between the walls")
        call check(report%outside == 0 .and. report%max_distance_point == -1, "round a convex body none is outside")
        call check(report%wall_correction > 0 .and. report%wall_correction < 0.1_dp, &
            "the coarse mesh resolves the functions")
        call fine%values(4, a)
        call basis%values(4, b)
        call check(same(a(:around), b(:around)), "on the wall the functions are those of the fine mesh")
        call check(maxval(abs(a - b)) < report%wall_correction .and. maxval(abs(a - b)) > 0, "elsewhere nearly")
        allocate(work(plan%transfer_words(coarse_mesh)))
        call plan%transfer(coarse, coarse_mesh, again, work=work)
        call again%values(4, b)
        call check(same(a, b), "the same in own memory")
        call plan%transfer(coarse, coarse_mesh, again, work=work(2:), stat=stat)
        call check(stat == hm_block_too_small, "work 8 bytes too small")
        call plan%transfer(coarse, mesh, again, stat=stat, err=err)
        call check(stat == hm_bad_basis, "another mesh's functions: " // err%text)
        call plan%free()
        call plan%transfer(coarse, coarse_mesh, again, stat=stat)
        call check(stat == hm_bad_argument, "no analysis")
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
        real(dp), dimension(n_points) :: dx, dy, its_dx, its_dy
        real(dp), parameter :: eps = 1e-5_dp
        call basis%curves(curves)
        call curves%refine(1, [0.3_dp, 0.6_dp], finer, matrix)
        call check(size(finer%control, 2) == size(curves%control, 2) + 2, "two knots are two control points more")
        call check(maxval(abs(matmul(curves%control, transpose(matrix)) - finer%control)) < 1e-14_dp, "the matrix of refine")
        call curves%point(1, 0.45_dp, xy_u)
        call finer%point(1, 0.45_dp, same_u)
        call check(maxval(abs(xy_u - same_u)) < 1e-14_dp, "the same curve")
        call curves%elevate(1, finer, matrix)
        call finer%point(1, 0.45_dp, same_u)
        call check(finer%curve(1)%degree == 4 .and. maxval(abs(xy_u - same_u)) < 1e-14_dp, "degree 4, the same curve")
        call curves%refine(1, [7._dp], finer, stat=stat, err=err)
        call check(stat == hm_bad_argument .and. index(err%text, "knot 1") == 1, "a knot outside: " // err%text)

        section%nose = [minval(curves%control(1, :)), 0._dp]
        section%edge = [maxval(curves%control(1, :)), 0._dp]
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
        section%nose(1) = section%nose(1) - 1
        call curves%measure(wanted, values, section=section, stat=stat, err=err)
        call check(stat == hm_bad_curve .and. err%item == 2, "a station without section: " // err%text)
        section%nose(1) = section%nose(1) + 1

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
        call basis%displacement(move, its_dx, its_dy)
        call check(maxval(abs(dx - its_dx)) < 1e-15_dp .and. maxval(abs(dy - its_dy)) < 1e-15_dp, "they move the mesh alike")
        call few%adjoint(dx, dy, of_few)
        call basis%adjoint(dx, dy, of_all)
        call check(abs(sum(of_few * v) - sum(of_all * move)) < 1e-13_dp * sum(abs(of_all * move)), "and their gradients")
        call few%moved_curves(v, moved)
        call check(maxval(abs(moved%control - curves%control - move)) < 1e-15_dp, "moved curves")
        call basis%combine(real(map, dp), again, stat=stat, err=err)
        call check(stat == hm_bad_condition, "columns that are zero: " // err%text)
        call basis%combine(aimag(map), again)
        call again%info(info)
        call check(info%combined == 5, "a real matrix")
        call tables()
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

    ! Functions in single precision: the wall moves as before, the rest nearly so; the adjoint follows.
    subroutine single_precision()
        type(hm_basis) :: narrow, again
        type(hm_basis_info) :: info, whole
        type(hm_plan) :: plan
        type(hm_curves) :: curves
        real(dp) :: move(2, n_control), gradient(2, n_control)
        real(dp), dimension(n_points) :: dx, dy, its_dx, its_dy
        real(dp), allocatable, target :: work(:)
        move = some_move()
        call basis%displacement(move, dx, dy)
        call basis%single(narrow)
        call basis%info(whole)
        call narrow%info(info)
        call check(info%storage == hm_single .and. whole%storage == hm_double .and. info%solved .and. &
            2 * info%bytes < whole%bytes + whole%bytes / 2, "a basis in single precision is smaller")
        call narrow%displacement(move, its_dx, its_dy)
        call check(same(its_dx(info%curve_point), dx(info%curve_point)), "the wall moves bit by bit as before")
        call check(maxval(abs(its_dx - dx)) > 0 .and. &
            maxval(abs(its_dx - dx)) < 1e-7_dp * maxval(abs(move)) * n_control, &
            "the rest nearly so")
        call narrow%adjoint(its_dx, its_dy, gradient)
        call check(abs(sum(gradient * move) / (sum(its_dx**2) + sum(its_dy**2)) - 1) < 1e-13_dp, "and its transpose")
        allocate(work(basis%single_words()))
        call basis%single(again, work(2:), stat)
        call check(stat == hm_block_too_small, "work 8 bytes too small")
        call basis%single(again, work)
        call again%displacement(move, dx, dy)
        call check(same(dx, its_dx) .and. same(dy, its_dy), "in work")
        call check(narrow%single_words() == 0, "single precision twice: no size")
        call narrow%single(again, stat=stat)
        call check(stat == hm_unsupported, "single precision twice")
        call basis%curves(curves)
        call plan%analyse(mesh, curves, [hm_condition(body)])
        call plan%factor()
        its_dx = dx
        call plan%morph_safe(narrow, move, dx, dy, stat=stat)
        call check(stat == hm_unsupported .and. same(dx, its_dx), "a safe morph needs double precision")
    end subroutine

    ! Three processes in turn: each solves a share of the functions, gets the rows of its points, and gives its part of
    ! the gradient. The same bits as all at once.
    subroutine meshes_in_parts()
        integer, parameter :: parts = 3, length = 1056
        type(hm_plan) :: plan
        type(hm_curves) :: curves
        type(hm_basis) :: shares(parts), rows, some
        real(dp) :: move(2, n_control), gradient(2, n_control), expected(2, n_control)
        real(dp), dimension(n_points) :: dx, dy, its_dx, its_dy
        real(c_float) :: gradient4(2, n_control)
        real(dp), allocatable, target :: parcel(:), work(:)
        integer(c_int64_t) :: sums(4 * 2 * n_control), its_sums(4 * 2 * n_control)
        integer, allocatable :: points(:)
        integer :: part, k, first, n, done, scale, its_scale
        call basis%curves(curves)
        call plan%analyse(mesh, curves, [hm_condition(body)])
        call plan%factor()
        done = 0
        do part = 1, parts
            call plan%share_of(part, parts, first, n)
            call check(first == done + 1 .and. n >= 4, "shares follow one another")
            if (part == 2) then
                allocate(work(plan%share_words(first, n)))
                call shares(part)%init_share(plan, first, n, work(2:), stat)
                call check(stat == hm_block_too_small, "work of a share 8 bytes too small")
                call shares(part)%init_share(plan, first, n, work)
            else
                call shares(part)%init_share(plan, first, n)
            end if
            call plan%solve(shares(part))
            done = done + n
        end do
        call check(done == n_control, "all functions")
        call plan%share_of(4, parts, first, n, stat)
        call check(stat == hm_bad_argument, "there is no fourth part")
        call shares(1)%displacement(some_move(), dx, dy, stat=stat)
        call check(stat == hm_bad_basis, "a share does not move the mesh")

        move = some_move()
        call basis%displacement(move, dx, dy)
        call basis%adjoint(dx, dy, expected)
        call basis%adjoint_scale(dx, dy, scale)
        sums = 0
        allocate(points(0), parcel(0))
        do part = 1, parts
            points = [(k, k = min(part * length, n_points), (part - 1) * length + 1, -1)]
            call shares(1)%extract(points, rows)
            do k = 1, parts
                parcel = [(0._dp, n = 1, int(shares(k)%parcel_words(size(points))))]
                call shares(k)%pack(points, parcel(2:), stat)
                call check(stat == hm_bad_argument, "a parcel that is too short")
                call shares(k)%pack(points, parcel)
                call rows%unpack(parcel)
            end do
            call rows%displacement(move, its_dx(:size(points)), its_dy(:size(points)))
            call check(same(its_dx(:size(points)), dx(points)) .and. same(its_dy(:size(points)), dy(points)), &
                "rows of a part move its points as the whole basis does")
            call rows%adjoint_scale(dx(points), dy(points), its_scale)
            call check(its_scale <= scale, "the largest scale is that of all points")
            call rows%adjoint_sums(dx(points), dy(points), scale, its_sums)
            sums = sums + its_sums
        end do
        call rows%adjoint_finish(scale, sums, gradient)
        call check(maxval(abs(gradient - expected)) <= 0, "the gradient of all parts: the same bits")
        call rows%adjoint_finish(scale, sums, gradient4)
        call check(maxval(abs(gradient4 - real(expected, c_float))) <= 0, "in default reals")
        call rows%unpack(parcel, stat)
        call check(stat < 0, "a parcel too many")
        call rows%adjoint_sums(dx(points), dy(points), scale, its_sums(2:), stat=stat)
        call check(stat == hm_bad_argument, "sums that are too short")
        call rows%adjoint_sums(dx(points), dy(points), its_scale - 1, its_sums, stat=stat)
        call check(stat == hm_bad_argument, "a scale that is too small")

        ! Any layout; from the whole basis in one step.
        deallocate(work)
        allocate(work(basis%extract_words(size(points))))
        call basis%extract(points, some, work)
        call some%displacement(move, its_dx(:size(points)), its_dy(:size(points)))
        call check(same(its_dx(:size(points)), dx(points)), "rows of the whole basis")
        call basis%extract(points, some, work(2:), stat)
        call check(stat == hm_block_too_small, "work of rows 8 bytes too small")
        call basis%extract([n_points + 1], some, stat=stat)
        call check(stat == hm_bad_argument, "a point that does not exist")
        call basis%adjoint_sums(dx, dy, scale, sums)
        call basis%adjoint_scale(reshape(dx, [around, rings]), reshape(dy, [around, rings]), its_scale)
        call basis%adjoint_sums(reshape(dx, [around, rings]), reshape(dy, [around, rings]), scale, its_sums, &
            executor=hm_openmp(2))
        call check(its_scale == scale .and. all(sums == its_sums), "sums of a block, on threads")
        call basis%adjoint_scale(real(dx, c_float), real(dy, c_float), its_scale)
        call basis%adjoint_sums(real(dx, c_float), real(dy, c_float), its_scale, sums)
        call basis%adjoint_scale(reshape(real(dx, c_float), [around, rings]), &
            reshape(real(dy, c_float), [around, rings]), its_scale)
        call basis%adjoint_sums(reshape(real(dx, c_float), [around, rings]), &
            reshape(real(dy, c_float), [around, rings]), its_scale, its_sums)
        call basis%adjoint_finish(its_scale, its_sums, gradient)
        call check(all(sums == its_sums) .and. maxval(abs(gradient - expected)) < 1e-5_dp * maxval(abs(expected)), &
            "sums in default reals")
    end subroutine

    ! Numbers in texts and items count from 1, whatever C says.
    subroutine numbers_in_errors()
        type(hm_curves) :: curves, copy
        real(dp) :: move(2, n_control), its_x(around), its_y(around), nan
        nan = transfer(9221120237041090560_c_int64_t, nan)
        its_x = x(:around)
        its_y = y(:around)
        its_x(1) = nan
        call curves%fit(its_x, its_y, .true., stat=stat, err=err)
        call check(err%item == 1, "the first point of a fit")
        call check(err%text == "point 1 is not finite", "in words: " // err%text)
        its_x = x(:around)
        its_x(11) = its_x(10)
        its_y(11) = its_y(10)
        call curves%fit(its_x, its_y, .true., stat=stat, err=err)
        call check(err%text == "points 10 and 11 follow each other and coincide", "two points of a fit: " // err%text)
        call check(err%item == 10, "the first of them")
        call curves%set(reshape([0, 0, 1, 0, 2, 1, 3, 0] * 1._dp, [2, 4]))
        call curves%add(1, [0, 0, 1, 1] * 1._dp, [1_c_int32_t, 2_c_int32_t])
        call curves%add(2, [0, 0, 0, 2, 1, 1, 1] * 1._dp)
        call curves%check(stat, err)
        call check(err%text == "knot 5 of curve 2 is smaller than the one before it", "a knot: " // err%text)
        call check(err%item == 5, "its number")
        copy = curves
        copy%curve(2)%knots = [0, 0, 0, 1, 2, 2, 2] * 1._dp
        copy%control(1, 2) = nan
        call copy%check(stat, err)
        call check(err%text == "control point 2 of curve 1 is not finite", "a control point: " // err%text)
        call check(err%item == 2, "control points count from 1 in C, too")
        copy = curves
        copy%curve(2)%degree = 0
        copy%curve(2)%knots = [0, 0, 1, 1, 1] * 1._dp
        call copy%check(stat, err)
        call check(err%text == "curve 2 has degree 0; 1 to 5 are possible", "a degree: " // err%text)
        call check(err%item == 2, "of the second curve")
        move = 0
        move(2, n_control) = nan
        call basis%displacement(move, x, y, stat=stat, err=err)
        call check(index(err%text, "movement of function 14 ") > 0, "a movement: " // err%text)
        call check(err%item == n_control, "of the last function")
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
        call basis%adjoint(a, b(2:), gradient, stat=stat)
        call check(stat == hm_bad_argument, "a gradient of different lengths")
        call basis%boundary_error(some_move(), x, y, a(2:), b(2:), error, stat=stat)
        call check(stat == hm_bad_argument, "another length")
        call basis%quality(mesh, x, y, quality, x(2:), y(2:), stat=stat)
        call check(stat == hm_bad_argument, "a reference of another length")
        call basis%values(0, a, stat=stat)
        call check(stat == hm_bad_argument, "there is no function 0")
        call basis%values(1, a(2:), stat=stat)
        call check(stat == hm_bad_argument, "too little room for values")
        call plan%solve(empty, report, stat)
        call check(stat == hm_bad_argument, "an empty plan")
        call bad%cells(cells, stat, err)
        call check(stat == hm_bad_argument, "cells before points: " // err%text)
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

    ! What must stop the program with the reason.
    subroutine stop_by(what)
        character(len=*), intent(in) :: what
        type(hm_mesh) :: another_mesh
        type(hm_plan) :: plan, another_plan
        type(hm_basis) :: another_basis
        select case (what)
        case ("refused")
            call basis%save("nothing", err=err)
        case ("assign_mesh")
            another_mesh = mesh
        case ("assign_plan")
            another_plan = plan
        case ("assign_basis")
            another_basis = basis
        end select
        print "(a)", "went on"
    end subroutine
end program
