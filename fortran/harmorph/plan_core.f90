! A plan: matrix and factor on an analysed mesh, and what solves with them.
module harmorph_plan_core
    use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_int32_t, c_int64_t, c_null_ptr, c_ptr, c_size_t, &
        c_sizeof
    use harmorph_structs, only: hm_c_error, hm_c_points, hm_solve_report
    use harmorph_calls
    use harmorph_outcome, only: hm_error, outcome
    use harmorph_memory, only: block_of_memory
    use harmorph_view, only: c_address, c_points, view
    use harmorph_analysis, only: analysis_of, n_points_of, need_analysis, plan_analysis
    use harmorph_basis_core, only: check_view, make_basis
    use harmorph_basis, only: hm_basis
    implicit none
    private
    public :: factor_on, plan_of

    type, public :: hm_safe_options           ! of morph_safe; 0 are the defaults
        integer :: max_resolves = 0
        integer :: skipped_rungs = 0          ! sum of 2**hm_rung_... of those not to be tried
        real(c_double) :: heights = 0         ! 0 .. 1: how far distances from the walls are brought back
        ! (2, :) like move: receives the movement that x_new has; short of the target it is not all of move.
        real(c_double), pointer, contiguous :: reached(:, :) => null()
    end type

    type, extends(plan_analysis), public :: plan_core
        private
        type(c_ptr) :: plan = c_null_ptr
        type(block_of_memory) :: plan_memory
    contains
        procedure :: prepare => plan_prepare
        procedure, private :: plan_factor
        generic :: factor => plan_factor
        procedure :: solve => plan_solve
        procedure :: level => plan_level
        procedure :: free => plan_free
        final :: plan_final
    end type

contains
    ! The block for matrix and factor; factor does it by itself where memory need not be given.
    subroutine plan_prepare(self, work, stat, err)
        class(plan_core), intent(inout) :: self
        real(c_double), intent(inout), target, optional :: work(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        call make_plan(self, work, done)
        call done%finish(stat, err)
    end subroutine

    subroutine make_plan(self, work, done)
        class(plan_core), intent(inout) :: self
        real(c_double), intent(inout), target, optional :: work(:)
        type(outcome), intent(inout) :: done
        integer(c_size_t) :: bytes
        call need_analysis(self, done)
        if (done%ok()) done%status = hm_c_plan_size(analysis_of(self), bytes, done%error)
        if (done%ok()) then
            self%plan = c_null_ptr
            call self%plan_memory%give_back()
        end if
        call self%plan_memory%take(bytes, work, done)
        if (done%ok()) done%status = hm_c_plan_init(self%plan, self%plan_memory%start, self%plan_memory%bytes, &
            analysis_of(self), done%error)
    end subroutine

    ! On the coordinates of the mesh. The other forms of factor: on moved ones of the same mesh.
    subroutine plan_factor(self, stat, err)
        class(plan_core), intent(inout) :: self
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        call factor_on(self, view(), done)
        call done%finish(stat, err)
    end subroutine

    subroutine factor_on(self, v, done)
        class(plan_core), intent(inout) :: self
        type(view), intent(in) :: v
        type(outcome), intent(inout) :: done
        type(hm_c_points), target :: at
        if (.not. c_associated(self%plan)) call make_plan(self, done=done)
        at = c_points(v)
        if (done%ok() .and. (c_associated(v%x) .or. v%wrong /= "")) &
            call check_view(v, int(n_points_of(self), c_int64_t), done)
        if (done%ok()) done%status = hm_c_plan_factor(self%plan, c_address(at), done%error)
    end subroutine

    ! All functions; a basis that has no memory yet is made first.
    subroutine plan_solve(self, basis, report, stat, err)
        class(plan_core), intent(inout) :: self
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
        if (its%residual_function >= 0) its%residual_function = its%residual_function + 1_c_int32_t
        if (present(report)) report = its
        call done%finish(stat, err)
    end subroutine

    ! Where agglomeration merged the mesh, after factor with an engine that has levels: in which cell of a level, 1 the
    ! finest, each point's control volume is; 0: a point whose value is known. cells(n_points) has values up to n_cells.
    subroutine plan_level(self, level, cells, n_cells, stat, err)
        class(plan_core), intent(in) :: self
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
        call done%finish(stat, err)
    end subroutine

    subroutine plan_free(self)
        class(plan_core), intent(inout) :: self
        self%plan = c_null_ptr
        call self%plan_memory%give_back()
        call self%plan_analysis%free()
    end subroutine

    impure elemental subroutine plan_final(self)
        type(plan_core), intent(inout) :: self
        call self%plan_memory%give_back()
    end subroutine

    ! The library's object, for the modules that follow; null: none.
    type(c_ptr) function plan_of(self)
        class(plan_core), intent(in) :: self
        plan_of = self%plan
    end function
end module
