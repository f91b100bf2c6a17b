! Morphs, displacements and their transpose, from every layout of the coordinates.
module morph_tests
    use, intrinsic :: iso_c_binding, only: c_int32_t
    use body_mesh
    implicit none
    private
    public :: morphs, layouts

contains

    subroutine morphs()
        real(dp) :: move(2, n_control), gradient(2, n_control), found(2, n_control), error, here, there
        real(dp), dimension(n_points) :: x_new, y_new, again, dx, dy, gx, gy
        type(hm_step_report) :: step
        type(hm_quality_report) :: quality
        type(hm_curves) :: curves, moved
        integer :: point, k
        type(hm_error) :: err
        integer :: stat
        move = 0
        call basis%morph_to(move, x, y, x_new, y_new)
        call check(same(x, x_new) .and. same(y, y_new), "a movement of nothing keeps all bits")
        move = some_move()
        call basis%displacement(move, dx, dy)
        call basis%assess(mesh, dx, dy, step)
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
        call basis%recover(x_new, y_new, found, residual=error, point=point)
        call check(maxval(abs(found - move)) < 1e-12_dp .and. error < 1e-14_dp .and. point >= 1, &
            "the movement is recovered")
        again = y_new
        again(point) = again(point) + 0.1_dp
        found = 7
        call basis%recover(x_new, again, found, stat=stat, err=err)
        call check(stat == hm_bad_mesh .and. err%item == point .and. all(found == 7), "a wall that is on no curve")
        call basis%boundary_error(move, x, y, x_new, y_new, error, point)
        call check(error < 1e-12_dp .and. point >= 1 .and. point <= n_points, "the wall moves as the B-spline does")
        call basis%assess(mesh, x_new - x, y_new - y, quality=quality)
        call check(quality%inverted == 0 .and. quality%min_area > 0 .and. quality%self_crossing == 0, "quality")
        call basis%assess(mesh, quality)
        call check(quality%min_quality > 0 .and. quality%min_quality <= quality%mean_quality, "quality of the mesh")
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

    ! Every layout that needs no copy gives the same morph.
    subroutine layouts()
        real(dp) :: move(2, n_control), gradient(2, n_control), expected(2, n_control)
        real(dp), dimension(n_points) :: x_new, y_new, dx, dy
        real(dp), target, save :: state(4, n_points)
        integer(c_int32_t), target, save :: triangles(3, 2 * n_cells), rows(4 * n_cells), start(n_cells + 1)
        integer(c_int32_t), target :: shifted(4, n_cells)
        integer(c_int32_t), target :: list(2 * around + 2), list_start(3), list_markers(2)
        type(hm_mesh) :: other
        type(hm_basis) :: own
        type(hm_step_report) :: step, own_step
        integer :: k
        move = some_move()
        call basis%morph_to(move, x, y, x_new, y_new)
        call basis%displacement(move, dx, dy)
        call basis%adjoint(dx, dy, expected)
        call basis%assess(mesh, dx, dy, step)

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
        call solve(other, own)
        call own%displacement(move, x_new, y_new)
        call check(same(x_new, dx) .and. same(y_new, dy), "a mesh of xy(2,:)")
        call own%assess(other, x_new, y_new, own_step)
        call check(same([own_step%admissible], [step%admissible]) .and. own_step%cell == step%cell, "its step")

        start = 1 + 4 * [(k, k = 0, n_cells)]
        rows = reshape(cells, shape(rows))
        list = [[(k, k = 1, around), 1], [(k, k = n_points - around + 1, n_points), n_points - around + 1]]
        list_start = [1, around + 2, 2 * around + 3]
        list_markers = [body, far_field]
        call other%free()
        call other%points(by_column(:, 1), by_column(:, 2))
        call other%cells(rows, start)
        call other%lists(list, list_start, list_markers)
        call solve(other, own)
        call own%displacement(move, x_new, y_new)
        call check(same(x_new, dx) .and. same(y_new, dy), "a mesh of rows and lists")

        call other%free()
        call other%points(x, y, first=0)
        shifted = cells - 1
        call other%cells(shifted)
        list = list - 1
        list_start = list_start - 1
        call other%lists(list, list_start, list_markers)
        call solve(other, own, first=0)
        call own%displacement(move, x_new, y_new)
        call check(same(x_new, dx) .and. same(y_new, dy), "a mesh counted from 0")
        call own%assess(other, x_new, y_new, own_step)
        call check(own_step%cell == step%cell - 1, "and reports as well")

        do k = 1, n_cells
            triangles(:, 2 * k - 1) = cells([1, 2, 3], k)
            triangles(:, 2 * k) = cells([1, 3, 4], k)
        end do
        call other%free()
        call other%points(x, y)
        call other%cells(triangles)
        call other%faces(faces, markers)
        call solve(other, own)
        call own%displacement(move, x_new, y_new)
        call check(maxval(abs(x_new - dx)) < 1e-2_dp .and. maxval(abs(x_new - dx)) > 0, "a mesh of triangles")
    end subroutine
end module
