! Smooth bounds of the quality with derivatives, and the corners that limit the admissible step.
module bounds_tests
    use, intrinsic :: iso_c_binding, only: c_float
    use body_mesh
    implicit none
    private
    public :: smooth_bounds

contains

    subroutine smooth_bounds()
        integer, parameter :: kinds(6) = [hm_bound_quality, hm_bound_kept_quality, hm_bound_area, hm_bound_height, &
            hm_bound_stretch, hm_bound_angle]
        real(dp), parameter :: eps = 1e-5_dp
        real(dp) :: move(2, n_control), dx(n_points), dy(n_points), slope(2, n_control)
        real(dp), allocatable :: gradients(:, :, :)
        real(dp) :: x_new(n_points), y_new(n_points), difference
        type(hm_quality) :: quality
        type(hm_bound_value) :: values(6), same(6), up(6), down(6)
        type(hm_step_corner), allocatable :: corners(:)
        type(hm_step_report) :: step
        type(hm_error) :: err
        integer :: k, stat
        allocate(gradients(2, n_points, 6))
        move = some_move()
        call basis%displacement(move, dx, dy)
        call quality%bounds(kinds, x, y, values, stat=stat, err=err)
        call check(stat == hm_bad_argument, "no start mesh: " // err%text)
        call quality%start(basis, mesh)
        call quality%start(basis, mesh, x, y)
        x_new = x + dx
        y_new = y + dy
        call quality%bounds(kinds, x_new, y_new, values, gradients, sharpness=50._dp)
        call check(all(values%item >= 1), "items")
        call quality%bounds(kinds, x_new + eps * dx, y_new + eps * dy, up, sharpness=50._dp)
        call quality%bounds(kinds, x_new - eps * dx, y_new - eps * dy, down, sharpness=50._dp)
        do k = 1, 6
            call basis%adjoint(gradients(1, :, k), gradients(2, :, k), slope)
            difference = (up(k)%bound - down(k)%bound) / (2 * eps) - sum(slope * move)
            call check(abs(difference) < 1e-6_dp * max(1._dp, abs(sum(slope * move))), "derivatives of a bound")
        end do
        call quality%bounds(kinds, reshape(x_new, [around, rings]), reshape(y_new, [around, rings]), same, &
            sharpness=50._dp, executor=hm_openmp(2))
        call check(maxval(abs(same%bound - values%bound)) <= 0, "blocks and threads")
        call quality%bounds(kinds, real(x_new, c_float), real(y_new, c_float), same, sharpness=50._dp)
        call check(maxval(abs(same%bound - values%bound)) < 1e-3_dp, "default reals")
        call quality%bounds(kinds, x, y, same(:5), stat=stat)
        call check(stat == hm_bad_argument, "a value too few")
        call quality%bounds([17], x, y, same(:1), stat=stat, err=err)
        call check(stat == hm_bad_argument .and. index(err%text, "the kind of bound 1 is 17") == 1, err%text)
        call quality%free()

        call basis%assess(mesh, dx, dy, step)
        call basis%step_corners(mesh, dx, dy, corners, closeness=0.5_dp)
        call check(size(corners) > 1 .and. abs(corners(1)%step - step%admissible) <= 1e-13_dp * step%admissible, &
            "corners that limit the step")
        call check(all(corners(2:)%step >= corners(:size(corners) - 1)%step), "corners in the order of their steps")
        call basis%step_corners(mesh, 0 * dx, 0 * dy, corners, x=x, y=y)
        call check(size(corners) == 0, "no limit")
        call basis%step_corners(mesh, dx(2:), dy(2:), corners, stat=stat)
        call check(stat == hm_bad_argument, "a displacement too short")
    end subroutine
end module
