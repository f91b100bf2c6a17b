! The step and the quality that a displacement would have.
module assessment_tests
    use, intrinsic :: iso_c_binding, only: c_float
    use body_mesh
    implicit none
    private
    public :: assessments

contains

    ! assess says before the morph how good the moved mesh is, in every layout of the arrays.
    subroutine assessments()
        real(dp) :: move(2, n_control), dx(n_points), dy(n_points)
        real(dp), target :: x_new(n_points), y_new(n_points)
        real(dp) :: block_x(around, rings), block_y(around, rings)
        type(hm_mesh) :: moved
        type(hm_step_report) :: step, new_step
        type(hm_quality_report) :: quality, new_quality
        integer :: stat
        move = 5 * some_move()
        call basis%displacement(move, dx, dy)
        call basis%morph_to(move, x, y, x_new, y_new)
        call moved%points(x_new, y_new)
        call moved%cells(cells)
        call moved%faces(faces, markers)
        call basis%assess(mesh, dx, dy, step)
        call basis%assess(moved, quality, x, y)
        call basis%assess(mesh, dx, dy, new_step, new_quality)
        call compare_assessment(step, new_step, quality, new_quality)
        call cell_qualities(moved, dx, dy)
        call check(new_step%cell == step%cell .and. new_quality%min_quality_cell == quality%min_quality_cell, "where")
        call basis%assess(moved, new_quality, reshape(x, shape(block_x)), reshape(y, shape(block_y)))
        call compare_assessment(step, new_step, quality, new_quality)
        call basis%assess(moved, new_quality, real(x, c_float), real(y, c_float))
        call compare_assessment(step, new_step, quality, new_quality)
        call basis%assess(moved, new_quality)
        call check(new_quality%inverted == quality%inverted .and. new_quality%mean_quality > quality%mean_quality, &
            "without reference the sizes of the cells do not count")
        block_x = reshape(dx, shape(block_x))
        block_y = reshape(dy, shape(block_y))
        call basis%assess(mesh, block_x, block_y, new_step, new_quality, executor=hm_openmp(2))
        call compare_assessment(step, new_step, quality, new_quality)
        call basis%assess(mesh, real(dx, c_float), real(dy, c_float), new_step, new_quality)
        call compare_assessment(step, new_step, quality, new_quality)
        call basis%assess(mesh, real(block_x, c_float), real(block_y, c_float), new_step, new_quality)
        call compare_assessment(step, new_step, quality, new_quality)
        call basis%assess(mesh, dx(2:), dy(2:), new_step, new_quality, stat=stat)
        call check(stat == hm_bad_argument, "a displacement too few")
        call starts_elsewhere(dx, dy, step, quality)
    end subroutine

    ! The quality of each cell, in all forms of the call.
    subroutine cell_qualities(moved, dx, dy)
        type(hm_mesh), intent(in) :: moved
        real(dp), intent(in) :: dx(:), dy(:)
        type(hm_quality_report) :: quality
        real(dp), allocatable :: of_cells(:), alone(:), shapes(:)
        integer :: stat
        call basis%assess(mesh, dx, dy, quality=quality, cells=of_cells)
        call check(size(of_cells) == size(cells, 2), "a number for each cell")
        call check(abs(minval(of_cells) - quality%min_quality) <= 0, "the smallest quality of a cell")
        call check(minloc(of_cells, 1) == quality%min_quality_cell, "the cell of the smallest quality")
        call check(abs(sum(of_cells) / size(of_cells) - quality%mean_quality) < 1e-13_dp, "the mean quality of cells")
        call basis%assess(mesh, real(dx, c_float), real(dy, c_float), cells=alone)
        call check(maxval(abs(alone - of_cells)) < 1e-5_dp, "the quality of each cell without the report")
        call basis%assess(moved, quality, x, y, cells=alone)
        call check(maxval(abs(alone - of_cells)) < 1e-10_dp, "the quality of each cell of the moved mesh")
        call basis%assess(moved, quality, cells=shapes)
        call check(all(shapes >= alone - 1e-12_dp), "sizes do not count without a reference")
        call basis%assess(mesh, dx(2:), dy(2:), cells=shapes, stat=stat)
        call check(stat == hm_bad_argument .and. size(shapes) == size(alone), "a refused call leaves the array")
    end subroutine

    ! A mesh whose arrays hold other coordinates than those the movement starts from: it is judged from where it starts.
    subroutine starts_elsewhere(dx, dy, step, quality)
        real(dp), intent(in) :: dx(:), dy(:)
        type(hm_step_report), intent(in) :: step
        type(hm_quality_report), intent(in) :: quality
        real(dp), target :: x_now(n_points), y_now(n_points)
        type(hm_mesh) :: elsewhere
        type(hm_step_report) :: new_step
        type(hm_quality_report) :: new_quality
        integer :: stat
        x_now = x + 0.5_dp * step%admissible * dx
        y_now = y + 0.5_dp * step%admissible * dy
        call elsewhere%points(x_now, y_now)
        call elsewhere%cells(cells)
        call elsewhere%faces(faces, markers)
        call basis%assess(elsewhere, dx, dy, new_step, x=x, y=y)
        call check(abs(new_step%admissible - step%admissible) <= 0, "the step from other coordinates")
        call basis%assess(elsewhere, dx, dy, new_step, new_quality, x, y)
        call check(abs(new_step%admissible - step%admissible) <= 0, "the assessed step from other coordinates")
        call compare_assessment(step, new_step, quality, new_quality)
        call basis%assess(elsewhere, dx, dy, new_step)
        call check(abs(new_step%admissible - 0.5_dp * step%admissible) < 1e-9_dp * step%admissible, &
            "the step from the mesh's own coordinates")
        call basis%assess(elsewhere, dx, dy, new_step, x=x, stat=stat)
        call check(stat == hm_bad_argument, "x without y")
        call basis%assess(elsewhere, dx, dy, new_step, new_quality, x(2:), y(2:), stat=stat)
        call check(stat == hm_bad_argument, "a start of one point too few")
    end subroutine

    subroutine compare_assessment(step, new_step, quality, new_quality)
        type(hm_step_report), intent(in) :: step, new_step
        type(hm_quality_report), intent(in) :: quality, new_quality
        call check(abs(new_step%admissible / step%admissible - 1) < 1e-4_dp .and. &
            abs(new_quality%mean_quality - quality%mean_quality) < 1e-5_dp .and. &
            new_quality%inverted == quality%inverted, "assessment")
    end subroutine
end module
