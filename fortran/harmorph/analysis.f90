! The analysis of a mesh: checks, reports, boundaries, and how much memory plan, basis and shares take.
module harmorph_analysis
    use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_int32_t, c_int64_t, c_loc, c_null_ptr, c_ptr, &
        c_size_t, c_sizeof
    use harmorph_constants
    use harmorph_structs, only: hm_c_error, hm_mesh_report
    use harmorph_calls
    use harmorph_outcome, only: hm_error, outcome
    use harmorph_memory, only: block_of_memory, words_of
    use harmorph_mesh, only: hm_mesh
    use harmorph_curves, only: hm_curves
    use harmorph_problem, only: hm_condition, hm_options, problem, set_problem
    implicit none
    private
    public :: hm_analysis_words, analysis_of, n_points_of, need_analysis

    type, public :: plan_analysis
        private
        type(problem), pointer :: data => null()
        type(block_of_memory) :: analysis_memory
        type(c_ptr) :: analysis = c_null_ptr
    contains
        procedure :: analyse => plan_analyse
        procedure :: report => plan_report
        procedure :: boundary => plan_boundary
        procedure :: plan_words
        procedure :: basis_words
        procedure :: share_words
        procedure :: share_of => plan_share_of
        procedure :: drop_analysis
        procedure :: free => analysis_free
        procedure, private :: analysis_assign
        generic :: assignment(=) => analysis_assign
        final :: analysis_final
    end type

contains
    ! 8-byte numbers of work that an analysis needs; the arguments are those of analyse.
    subroutine hm_analysis_words(words, mesh, curves, conditions, given_points, given_curves, given_u, options, stat, &
        err)
        integer(c_int64_t), intent(inout) :: words
        type(hm_mesh), intent(in) :: mesh
        type(hm_curves), intent(in), optional :: curves
        type(hm_condition), intent(in), optional :: conditions(:)
        integer, intent(in), optional :: given_points(:), given_curves(:)
        real(c_double), intent(in), optional :: given_u(:)
        type(hm_options), intent(in), optional :: options
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(problem), target :: data
        type(outcome) :: done
        integer(c_size_t) :: bytes
        call set_problem(data, mesh, curves, conditions, given_points, given_curves, given_u, options, done)
        if (done%ok()) done%status = hm_c_analysis_size(data%c, c_loc(data%options), bytes, done%error)
        if (done%status >= 0) words = words_of(bytes)
        call done%finish(stat, err)
    end subroutine

    ! Checks mesh, curves and conditions, and orders the unknowns. Without curves or rigid bodies: the mesh alone. What
    ! the plan had before is forgotten. given_*: curve points whose parameters are known.
    subroutine plan_analyse(self, mesh, curves, conditions, given_points, given_curves, given_u, options, work, stat, &
        err)
        class(plan_analysis), intent(inout) :: self
        type(hm_mesh), intent(in) :: mesh
        type(hm_curves), intent(in), optional :: curves
        type(hm_condition), intent(in), optional :: conditions(:)
        integer, intent(in), optional :: given_points(:), given_curves(:)
        real(c_double), intent(in), optional :: given_u(:)
        type(hm_options), intent(in), optional :: options
        real(c_double), intent(inout), target, optional :: work(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        integer(c_size_t) :: bytes
        call self%free()
        call done%check_version()
        allocate(self%data)
        call set_problem(self%data, mesh, curves, conditions, given_points, given_curves, given_u, options, done)
        if (done%ok()) done%status = hm_c_analysis_size(self%data%c, c_loc(self%data%options), bytes, done%error)
        call self%analysis_memory%take(bytes, work, done)
        if (done%ok()) done%status = hm_c_analysis_init(self%analysis, self%analysis_memory%start, &
            self%analysis_memory%bytes, self%data%c, c_loc(self%data%options), done%error)
        if (done%status < 0) call self%free()
        call done%finish(stat, err)
    end subroutine

    subroutine plan_report(self, report, stat, err)
        class(plan_analysis), intent(in) :: self
        type(hm_mesh_report), intent(inout) :: report
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        call need_analysis(self, done)
        report%struct_size = int(c_sizeof(report), c_int64_t)
        if (done%ok()) done%status = hm_c_analysis_report(self%analysis, report, done%error)
        call done%finish(stat, err)
    end subroutine

    ! The points of these markers in order, the mesh on the left; loop: closed, the first point is not repeated.
    subroutine plan_boundary(self, markers, points, loop, piece, stat, err)
        class(plan_analysis), intent(in) :: self
        integer, intent(in) :: markers(:)
        integer, allocatable, intent(out) :: points(:)
        logical, intent(out), optional :: loop
        integer, intent(in), optional :: piece
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        integer(c_int32_t) :: its_piece, n, is_loop, its_markers(size(markers))
        integer(c_int32_t), allocatable :: found(:)
        integer :: k
        call need_analysis(self, done)
        its_piece = 0
        if (present(piece)) its_piece = int(piece - 1, c_int32_t)
        its_markers = int(markers, c_int32_t)
        n = 0
        is_loop = 0
        do k = 1, 2                           ! first without room, to learn how many there are
            allocate(found(n))
            if (done%ok() .or. k == 2) done%status = hm_c_analysis_boundary(self%analysis, int(size(markers), &
                c_int32_t), its_markers, its_piece, found, n, n, is_loop, done%error)
            if (.not. (k == 1 .and. done%status == hm_bad_argument .and. n > 0)) exit
            deallocate(found)
        end do
        if (done%status >= 0) points = int(found)
        if (present(loop)) loop = is_loop /= 0
        call done%finish(stat, err)
    end subroutine

    ! 8-byte numbers of work for prepare, and for a basis; 0 without an analysis that has curves.
    integer(c_int64_t) function plan_words(self)
        class(plan_analysis), intent(in) :: self
        type(hm_c_error) :: e
        integer(c_size_t) :: bytes
        plan_words = 0
        if (hm_c_plan_size(self%analysis, bytes, e) >= 0) plan_words = words_of(bytes)
    end function

    integer(c_int64_t) function basis_words(self)
        class(plan_analysis), intent(in) :: self
        type(hm_c_error) :: e
        integer(c_size_t) :: bytes
        basis_words = 0
        if (hm_c_basis_size(self%analysis, bytes, e) >= 0) basis_words = words_of(bytes)
    end function

    integer(c_int64_t) function share_words(self, first, n)
        class(plan_analysis), intent(in) :: self
        integer, intent(in) :: first, n
        type(hm_c_error) :: e
        integer(c_size_t) :: bytes
        share_words = 0
        if (hm_c_share_size(self%analysis, int(first - 1, c_int32_t), int(n, c_int32_t), bytes, e) >= 0) &
            share_words = words_of(bytes)
    end function

    ! Which functions part k of n_parts may solve; n is 0 where there are more parts than functions.
    subroutine plan_share_of(self, part, n_parts, first, n, stat, err)
        class(plan_analysis), intent(in) :: self
        integer, intent(in) :: part, n_parts
        integer, intent(inout) :: first, n
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        integer(c_int32_t) :: its_first, its_n
        call need_analysis(self, done)
        if (done%ok()) done%status = hm_c_share_of(self%analysis, int(part - 1, c_int32_t), int(n_parts, c_int32_t), &
            its_first, its_n, done%error)
        if (done%status >= 0) then
            first = int(its_first) + 1
            n = int(its_n)
        end if
        call done%finish(stat, err)
    end subroutine

    ! Saves memory: after prepare or factor, and basis%init, nobody needs the analysis.
    subroutine drop_analysis(self)
        class(plan_analysis), intent(inout) :: self
        self%analysis = c_null_ptr
        call self%analysis_memory%give_back()
    end subroutine

    ! What is prepared or solved points to the data, which stays.
    subroutine analysis_free(self)
        class(plan_analysis), intent(inout) :: self
        call self%drop_analysis()
        if (associated(self%data)) deallocate(self%data)
        nullify(self%data)
    end subroutine

    impure elemental subroutine analysis_final(self)
        type(plan_analysis), intent(inout) :: self
        call analysis_free(self)
    end subroutine

    subroutine analysis_assign(to, from)
        class(plan_analysis), intent(inout) :: to
        class(plan_analysis), intent(in) :: from
        if (associated(to%data) .or. associated(from%data) .or. .true.) error stop "harmorph: a plan cannot be assigned"
    end subroutine

    ! ---- For the modules that follow

    subroutine need_analysis(self, done)
        class(plan_analysis), intent(in) :: self
        type(outcome), intent(inout) :: done
        call done%refuse_if(.not. c_associated(self%analysis), "the plan has no analysis: call analyse first")
    end subroutine

    type(c_ptr) function analysis_of(self)
        class(plan_analysis), intent(in) :: self
        analysis_of = self%analysis
    end function

    integer(c_int32_t) function n_points_of(self)
        class(plan_analysis), intent(in) :: self
        n_points_of = self%data%mesh%n_points
    end function
end module
