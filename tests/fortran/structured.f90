! A mesh that is one structured block.
module structured_tests
    use body_mesh
    implicit none
    private
    public :: structured_block

contains

    ! An O-mesh as a block: the first and the last column are the same points.
    subroutine structured_block()
        integer, parameter :: ni = around + 1, nj = rings
        real(dp), target :: xs(ni, nj), ys(ni, nj), padded(2, 0:ni + 1, 0:nj + 1), flat(ni * nj), flat_y(ni * nj)
        real(dp) :: layers(2, 0:ni + 1, 0:nj + 1)
        real(dp), allocatable, target :: from_zero(:, :, :)
        real(dp), pointer :: zero_x(:, :), zero_y(:, :)
        real(dp) :: zero_dx(ni, nj), zero_dy(ni, nj)
        real(dp) :: x_new(ni, nj), y_new(ni, nj), move(2, n_control), gradient(2, n_control), expected(2, n_control), &
            error
        real(dp) :: dx(ni, nj), dy(ni, nj), value(ni, nj), one(ni * nj)
        type(hm_mesh) :: block, inner
        type(hm_curves) :: curves
        type(hm_plan) :: plan
        type(hm_basis) :: own, again
        type(hm_step_report) :: step, same_step
        type(hm_quality_report) :: quality
        integer :: i, j
        type(hm_error) :: err
        integer :: stat
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
        call plan%solve(own)
        move = some_move()
        call own%morph_to(move, xs, ys, x_new, y_new)
        call check(same(x_new(1, :), x_new(ni, :)) .and. same(y_new(1, :), y_new(ni, :)), "the cut stays closed")
        call own%boundary_error(move, xs, ys, x_new, y_new, error)
        call check(error < 1e-12_dp, "its wall moves as the B-spline does")
        call own%displacement(move, dx, dy)
        call own%adjoint(dx, dy, expected)
        call own%assess(block, dx, dy, step, quality)
        call check(quality%inverted == 0 .and. step%admissible > 1, "step and quality of a block")
        call own%values(2, value)
        call own%values(2, one)
        call check(same(reshape(value, [ni * nj]), one), "values of a block")

        ! Arrays with indices from 0, as many codes have them.
        allocate(from_zero(ni, 0:nj - 1, 2))
        from_zero(:, :, 1) = xs
        from_zero(:, :, 2) = ys
        zero_x(1:, 0:) => from_zero(:, :, 1)
        zero_y(1:, 0:) => from_zero(:, :, 2)
        call inner%points(zero_x, zero_y)
        call inner%line(body, 1, ni, 1, 1)
        call inner%line(far_field, ni, 1, nj, nj)
        call plan%analyse(inner, curves, [hm_condition(body)])
        call plan%factor()
        call plan%solve(again)
        call again%displacement(move, zero_dx, zero_dy)
        call check(all(abs(zero_dx - dx) <= 0) .and. all(abs(zero_dy - dy) <= 0), "a block with indices from 0")
        call again%free()
        call inner%free()

        ! Interleaved arrays inside ghost layers are converted and written back.
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
        call again%assess(inner, layers(1, 1:ni, 1:nj), layers(2, 1:ni, 1:nj), same_step)
        call check(same([step%admissible], [same_step%admissible]), "their admissible step, from where the mesh is now")
        call again%morph(move, xs, ys)
        call check(all(abs(xs - x_new) <= 0), "a block in place")
        call inner%free()

        ! The block is given as one row of points.
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
end module
