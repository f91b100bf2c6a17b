
! ---- Matrix and factor on an analysed mesh, and the solution with them

contains
    ! The block for matrix and factor; factor does it by itself where memory need not be given.
    subroutine plan_prepare(self, work, stat, err)
        class(hm_plan), intent(inout) :: self
        real(c_double), pointer, intent(in), optional :: work(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        call make_plan(self, work, done)
        call done%finish("plan%prepare", stat, err)
    end subroutine

    subroutine make_plan(self, work, done)
        class(hm_plan), intent(inout) :: self
        real(c_double), pointer, intent(in), optional :: work(:)
        type(outcome), intent(inout) :: done
        integer(c_size_t) :: bytes
        call need_analysis(self, done)
        if (done%ok()) done%status = hm_c_plan_size(self%analysis, bytes, done%error)
        if (done%ok()) then
            self%plan = c_null_ptr
            call self%plan_memory%give_back()
        end if
        call self%plan_memory%take(bytes, work, done)
        if (done%ok()) done%status = hm_c_plan_init(self%plan, self%plan_memory%start, self%plan_memory%bytes, &
            self%analysis, done%error)
    end subroutine

    ! On the coordinates of the mesh. The other forms of factor: on moved ones of the same mesh.
    subroutine plan_factor(self, stat, err)
        class(hm_plan), intent(inout) :: self
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        call factor_on(self, view(), done)
        call done%finish("plan%factor", stat, err)
    end subroutine

    subroutine factor_on(self, v, done)
        class(hm_plan), intent(inout) :: self
        type(view), intent(in) :: v
        type(outcome), intent(inout) :: done
        type(hm_c_points), target :: at
        if (.not. c_associated(self%plan)) call make_plan(self, done=done)
        if (done%ok()) call read_again(self%data%arrays)
        at = c_points(v)
        if (done%ok() .and. (c_associated(v%x) .or. v%wrong /= "")) &
            call check_view(v, int(n_points_of(self), c_int64_t), done)
        if (done%ok()) done%status = hm_c_plan_factor(self%plan, c_address(at), done%error)
    end subroutine

    ! All functions; a basis that has no memory yet is made first, and one of another analysis made anew.
    subroutine plan_solve(self, basis, report, stat, err)
        class(hm_plan), intent(inout) :: self
        type(hm_basis), intent(inout) :: basis
        type(hm_solve_report), intent(out), optional :: report
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(hm_solve_report) :: its
        call done%refuse_if(.not. c_associated(self%plan), "the plan has no factor: call factor first")
        if (done%ok() .and. .not. c_associated(basis%address())) call make_basis(basis, self, done=done)
        its%struct_size = int(c_sizeof(its), c_int64_t)
        if (done%ok()) done%status = hm_c_plan_solve(self%plan, basis%address(), its, done%error)
        if ((done%status == hm_bad_basis .or. done%status == hm_unsupported) .and. can_be_made_anew(basis) .and. &
            c_associated(self%analysis)) then
            done%status = hm_ok
            call make_basis(basis, self, done=done)
            if (done%ok()) done%status = hm_c_plan_solve(self%plan, basis%address(), its, done%error)
        end if
        if (its%residual_function >= 0) its%residual_function = its%residual_function + 1_c_int32_t
        if (present(report)) report = its
        call done%finish("plan%solve", stat, err)
    end subroutine

    ! Where agglomeration merged the mesh, after factor with an engine that has levels: in which cell of a level, 1 the
    ! finest, each point's control volume is; 0: a point whose value is known. cells(n_points) has values up to n_cells.
    subroutine plan_level(self, level, cells, n_cells, stat, err)
        class(hm_plan), intent(in) :: self
        integer, intent(in) :: level
        integer, allocatable, intent(out) :: cells(:)
        integer, intent(out), optional :: n_cells
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        integer(c_int32_t) :: n
        integer(c_int32_t), allocatable :: found(:)
        n = 0
        call done%refuse_if(.not. c_associated(self%plan), "the plan has no factor: call factor first")
        if (done%ok()) n = n_points_of(self)
        allocate(found(n))
        if (done%ok()) done%status = hm_c_plan_level(self%plan, int(level - 1, c_int32_t), found, n, done%error)
        if (done%status >= 0) cells = int(found) + 1
        if (present(n_cells)) n_cells = int(n)
        call done%finish("plan%level", stat, err)
    end subroutine

