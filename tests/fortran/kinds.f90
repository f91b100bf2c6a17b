! Reals of 4 bytes and integers of 8, which the module converts.
module kinds_tests
    use, intrinsic :: iso_c_binding, only: c_float, c_int64_t
    use body_mesh
    implicit none
    private
    public :: default_reals, long_integers

contains

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
        type(hm_basis) :: own
        type(hm_step_report) :: step
        type(hm_quality_report) :: quality
        type(hm_error) :: err
        integer :: stat
        x4 = real(x, c_float)
        y4 = real(y, c_float)
        move4 = real(some_move(), c_float)
        call mesh4%points(x4, y4)
        call mesh4%cells(cells)
        call mesh4%faces(faces, markers)
        call solve(mesh4, own)
        call own%curves(curves)
        call own%displacement(real(move4, dp), dx, dy)
        call own%adjoint(dx, dy, gradient)
        dx4 = signaling()
        dy4 = signaling()
        x_new4 = signaling()
        y_new4 = signaling()
        gradient4 = signaling()
        call own%displacement(move4, dx4, dy4)
        call check(maxval(abs(dx4 - dx)) < 1e-8_dp .and. maxval(abs(dy4 - dy)) < 1e-8_dp, &
            "displacement in default reals")
        call own%velocity(move4, dx4, dy4)
        call own%adjoint(dx4, dy4, gradient4)
        call check(maxval(abs(gradient4 - gradient)) < 1e-5_dp * maxval(abs(gradient)), "adjoint in default reals")
        call own%morph_to(move4, x4, y4, x_new4, y_new4)
        call own%boundary_error(move4, x4, y4, x_new4, y_new4, error)
        call check(error < 1e-6_dp, "boundary in default reals")
        call own%assess(mesh4, dx4, dy4, step)
        call check(step%admissible > 0, "step in default reals")
        call own%assess(mesh4, x_new4 - x4, y_new4 - y4, quality=quality)
        call check(quality%inverted == 0, "quality in default reals")
        call own%values(3, values4)
        block_x = reshape(x4, shape(block_x))
        block_y = reshape(y4, shape(block_y))
        call own%morph(move4, x4, y4)
        call check(all(abs(x4 - x_new4) <= 0) .and. all(abs(y4 - y_new4) <= 0), "morph in default reals")

        ! Any rank 2 array of so many points will do for the products.
        call own%displacement(move4, block_dx, block_dy)
        call check(all(abs(reshape(block_dx, shape(dx4)) - dx4) <= 0), "displacement of a block in default reals")
        call own%adjoint(block_dx, block_dy, gradient4)
        call check(maxval(abs(gradient4 - gradient)) < 1e-5_dp * maxval(abs(gradient)), "its adjoint")
        call own%assess(mesh4, block_dx, block_dy, step)
        call own%values(3, block_values)
        call check(all(abs(reshape(block_values, shape(values4)) - values4) <= 0), "values of a block in default reals")
        block_dx = block_x
        block_dy = block_y
        call own%morph(move4, block_dx, block_dy)
        call check(all(abs(reshape(block_dx, shape(x4)) - x4) <= 0), "morph of a block in default reals")
        call own%boundary_error(move4, block_x, block_y, block_dx, block_dy, error)
        call check(error < 1e-6_dp, "its boundary")
        call own%assess(mesh4, quality, block_x, block_y)
        call check(quality%inverted == 0, "its quality")
        call own%morph_to(move4, block_x, block_y, block_dx, block_dy)
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
        call own%free()
        call plan%solve(own)
        call own%values(3, block_values)
        call check(all(abs(reshape(block_values, shape(values4)) - values4) < 1e-6_dp), "and that it was mirrored back")
    end subroutine

    subroutine long_integers()
        integer(c_int64_t), save :: cells8(4, n_cells), faces8(2, 2 * around), markers8(2 * around)
        integer(c_int64_t), save :: rows8(4 * n_cells), start8(n_cells + 1), lists8(2 * around), list_start8(3), &
            list_markers8(2)
        type(hm_mesh) :: mesh8
        type(hm_plan) :: plan
        type(hm_mesh_report) :: report
        type(hm_basis) :: own
        real(dp) :: a(n_points), b(n_points)
        integer :: k
        type(hm_error) :: err
        integer :: stat
        cells8 = cells
        faces8 = faces
        markers8 = markers
        call mesh8%points(x, y)
        call mesh8%cells(cells8)
        call mesh8%faces(faces8, markers8)
        call solve(mesh8, own)
        call own%values(1, a)
        call solve(mesh, own)
        call own%values(1, b)
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
end module
