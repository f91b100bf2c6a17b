
! ---- Functions by table: modes given at the points of markers with hm_given

contains
    ! Another basis: the functions of basis, and behind them one for each mode. modes(n,modes) at n wall points: those
    ! of `points`, or all with given displacements in the library's order (hm_c_given_points). Factor must have been
    ! called.
    subroutine tabulate_real(self, basis, modes, tabulated, points, work, stat, err)
        class(hm_plan), intent(in) :: self
        type(hm_basis), intent(in) :: basis
        real(c_double), intent(in) :: modes(:, :)
        type(hm_basis), intent(inout) :: tabulated              ! not basis
        integer, intent(in), optional :: points(:)
        real(c_double), pointer, intent(in), optional :: work(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call tabulate_numbers(self, basis, shape(modes), 1, reshape(modes, [size(modes)]), tabulated, points, work, &
            stat, err)
    end subroutine

    subroutine tabulate_complex(self, basis, modes, tabulated, points, work, stat, err)
        class(hm_plan), intent(in) :: self
        type(hm_basis), intent(in) :: basis
        complex(c_double), intent(in) :: modes(:, :)
        type(hm_basis), intent(inout) :: tabulated              ! not basis
        integer, intent(in), optional :: points(:)
        real(c_double), pointer, intent(in), optional :: work(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        real(c_double), allocatable :: pairs(:, :, :)
        allocate(pairs(2, size(modes, 1), size(modes, 2)))
        pairs(1, :, :) = real(modes, c_double)
        pairs(2, :, :) = aimag(modes)
        call tabulate_numbers(self, basis, shape(modes), 2, reshape(pairs, [size(pairs)]), tabulated, points, work, &
            stat, err)
    end subroutine

    subroutine tabulate_numbers(self, basis, extents, numbers, table, tabulated, points, work, stat, err)
        class(hm_plan), intent(in) :: self
        type(hm_basis), intent(in) :: basis
        integer, intent(in) :: extents(2), numbers
        real(c_double), intent(in) :: table(:)
        type(hm_basis), intent(inout) :: tabulated
        integer, intent(in), optional :: points(:)
        real(c_double), pointer, intent(in), optional :: work(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(hm_solve_report) :: report
        type(block_of_memory) :: block
        integer(c_int32_t), allocatable, target :: list(:)
        integer(c_size_t) :: bytes, work_bytes
        type(c_ptr) :: to_list
        call tabulated%free()
        call need_basis(basis, done)
        call done%refuse_if(.not. c_associated(self%plan), "the plan has no factor: call factor first")
        to_list = c_null_ptr
        allocate(list(0))
        if (present(points)) then
            list = int(points, c_int32_t)
            call done%refuse_if(size(points) /= extents(1), "modes must have a row for each point")
            if (size(list) > 0) to_list = c_loc(list)
        end if
        if (done%ok()) done%status = hm_c_tabulate_size(self%plan, basis%address(), int(extents(2), c_int32_t), &
            int(numbers, c_int32_t), bytes, work_bytes, done%error)
        call block%take(work_bytes, done=done)
        call tabulated%memory%take(bytes, work, done)
        report%struct_size = int(c_sizeof(report), c_int64_t)
        if (done%ok()) done%status = hm_c_tabulate(tabulated%handle, tabulated%memory%start, tabulated%memory%bytes, &
            self%plan, basis%address(), int(extents(1), c_int32_t), to_list, int(extents(2), c_int32_t), &
            int(numbers, c_int32_t), table, block%start, block%bytes, report, done%error)
        call block%give_back()
        call count_points(tabulated, done)
        call done%finish("plan%tabulate", stat, err)
    end subroutine
