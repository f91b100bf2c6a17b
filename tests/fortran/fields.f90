! Swept areas, distances to walls and interpolation.
module fields_tests
    use, intrinsic :: iso_c_binding, only: c_float, c_int32_t, c_int64_t
    use body_mesh
    implicit none
    private
    public :: fields

contains

    subroutine fields()
        type(hm_plan) :: plan
        call plan%analyse(mesh)
        call sweeps()
        call distances(plan)
        call interpolations(plan)
    end subroutine

    ! A smooth movement of all points.
    subroutine moved(x1, y1)
        real(dp), intent(out) :: x1(n_points), y1(n_points)
        x1 = x + 0.01_dp * sin(3 * y)
        y1 = 1.1_dp * y
    end subroutine

    subroutine sweeps()
        real(dp) :: x1(n_points), y1(n_points), grown, swept, bound
        real(dp), allocatable :: sides(:), duals(:), halves(:, :)
        integer :: stat, k
        integer(c_int64_t) :: n
        type(hm_error) :: err
        call moved(x1, y1)
        n = hm_swept_count(mesh)
        call check(n == 4 * n_cells, "four sides for each cell")
        allocate(sides(n), duals(n), halves(2, n))
        call hm_swept_areas(mesh, x, y, x1, y1, sides, duals, halves)
        bound = 0
        do k = 1, n_cells
            swept = sum(sides(4 * k - 3:4 * k))
            grown = area(x1, y1, k) - area(x, y, k)
            bound = max(bound, abs(swept - grown) / sum(abs(sides(4 * k - 3:4 * k))))
        end do
        call check(bound < 1e-12_dp, "each cell grows by what its sides sweep")
        call check(maxval(abs(halves(1, :) + halves(2, :) - sides)) < 1e-15_dp * maxval(abs(sides)), &
            "two halves are one side")
        call hm_swept_areas(mesh, x, y, x, y, duals=duals)
        call check(maxval(abs(duals)) <= 0, "what does not move sweeps nothing")
        call hm_swept_areas(mesh, x, y, x1, y1, sides(2:), stat=stat, err=err)
        call check(stat == hm_bad_argument .and. index(err%text, "sides must have") == 1, "an array that is too short")
        call hm_swept_areas(mesh, x, y, x1, y1, stat=stat)
        call check(stat == hm_bad_argument, "no array at all")
    end subroutine

    real(dp) function area(px, py, k)
        real(dp), intent(in) :: px(:), py(:)
        integer, intent(in) :: k
        integer :: p(4)
        p = int(cells(:, k))
        area = 0.5_dp * ((px(p(3)) - px(p(1))) * (py(p(4)) - py(p(2))) - (py(p(3)) - py(p(1))) * (px(p(4)) - px(p(2))))
    end function

    subroutine distances(plan)
        type(hm_plan), intent(in) :: plan
        type(hm_walls) :: walls
        real(dp) :: d(n_points), again(n_points), t(n_points), dd(n_points), dj(n_points), gx(n_points), gy(n_points), &
            x1(n_points), y1(n_points)
        real(dp), allocatable :: h(:), ratios(:), angles(:)
        integer(c_int32_t) :: face(n_points), hint(n_points)
        integer, allocatable :: ends(:, :), markers_of(:), wall_points(:), layer_points(:)
        integer :: stat, k
        type(hm_error) :: err
        call walls%distance(x, y, d, stat=stat, err=err)
        call check(stat == hm_bad_argument .and. err%text == "the walls are empty: call find first", &
            "walls before find")
        call walls%find(plan, [body])
        call walls%faces(ends, markers_of)
        call check(size(ends, 2) == around .and. all(markers_of == body), "all faces of the body")
        call walls%distance(x, y, d, face, t)
        call check(maxval(abs(d(:around))) <= 0, "wall points have the distance 0")
        call check(minval(d(around + 1:)) > 0, "other points have a distance")
        k = n_points - 5
        call check(abs(d(k) - hypot(x(k) - (1 - t(k)) * x(ends(1, face(k))) - t(k) * x(ends(2, face(k))), &
            y(k) - (1 - t(k)) * y(ends(1, face(k))) - t(k) * y(ends(2, face(k))))) < 1e-14_dp, "faces and parameters")
        call moved(x1, y1)
        call walls%move(x1, y1)
        hint = face
        call walls%distance(x1, y1, d, face)
        call walls%distance(x1, y1, again, face, hint=hint)
        call check(maxval(abs(again - d)) <= 0, "hints do not change distances")
        call walls%change(x1, y1, face, x1, y1, dd)
        call check(maxval(abs(dd - d)) < 1e-13_dp, "distances scale with the mesh")
        dj = sin(real([(k, k = 1, n_points)], dp))
        gx = 0
        gy = 0
        call walls%adjoint(x1, y1, face, dj, gx, gy)
        call check(abs(sum(gx * x1 + gy * y1) - sum(dj * dd)) < 1e-11_dp, "the transpose")
        call walls%change(x1, y1, face, x1, y1, dd(2:), stat=stat)
        call check(stat == hm_bad_argument, "a change for each point")
        call walls%layer(wall_points, layer_points)
        allocate(h(size(wall_points)))
        call walls%move(x, y)
        call walls%heights(x, y, h)
        call check(all(layer_points == wall_points + around), "the first layer")
        call check(minval(h) > 0 .and. maxval(h) < 0.1_dp, "heights of the first layer")
        allocate(ratios, angles, mold=h)
        call walls%layer_changes(x, y, -2 * y, 2 * x, ratios, angles)
        call check(maxval(abs(ratios - 2)) < 1e-12_dp .and. maxval(abs(angles)) < 1e-5_dp, &
            "a rotation and a scale of 2: twice the heights, the same angles")
        call walls%layer_changes(x, y, x, y, ratios(2:), angles(2:), stat=stat)
        call check(stat == hm_bad_argument, "a change for each wall point")
        call walls%find(plan, [77], stat=stat)
        call check(stat == hm_bad_condition, "no such marker")
    end subroutine

    subroutine interpolations(plan)
        type(hm_plan), intent(in) :: plan
        type(hm_interpolation) :: interpolation
        type(hm_interpolation_report) :: report
        integer, parameter :: n = 200
        real(dp) :: px(n), py(n), from(n_points, 2), to(n, 2), back(n_points, 2), distance(n), g(n, 2)
        integer :: stat, k
        do k = 1, n
            px(k) = 3 * sin(1.3_dp * k)
            py(k) = 2 * cos(2.9_dp * k)
        end do
        px(n) = 100
        call interpolation%find(plan, px, py, distance, report)
        call check(report%outside >= 1 .and. report%max_distance_point == n, "one point is far outside")
        call check(abs(maxval(distance) - report%max_distance) <= 0, "the largest distance")
        from(:, 1) = 1 + x - 2 * y
        from(:, 2) = 3
        call interpolation%apply(from, to)
        call check(maxval(abs(to(:, 1) - 1 - px + 2 * py), mask=distance <= 0) < 1e-11_dp, "a linear field")
        call check(maxval(abs(to(:, 2) - 3)) < 1e-13_dp, "a constant field")
        g = reshape(sin(real([(k, k = 1, 2 * n)], dp)), [n, 2])
        back = 0
        call interpolation%adjoint(g, back)
        call check(abs(sum(back * from) - sum(g * to)) < 1e-9_dp, "the transpose of the interpolation")
        call interpolation%apply(from(:, :1), to, stat=stat)
        call check(stat == hm_bad_argument, "as many fields on both sides")
    end subroutine

end module
