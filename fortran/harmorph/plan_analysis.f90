
! ---- The analysis of a mesh: checks, reports, boundaries, and how much memory plan, basis and shares take

    public :: hm_analysis_words

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
        call release(data%arrays)
        if (done%status >= 0) words = words_of(bytes)
        call done%finish("hm_analysis_words", stat, err)
    end subroutine

    ! Checks mesh, curves and conditions, and orders the unknowns. Without curves or rigid bodies: the mesh alone. What
    ! the plan had before is forgotten. given_*: curve points whose parameters are known.
    subroutine plan_analyse(self, mesh, curves, conditions, given_points, given_curves, given_u, options, work, stat, &
        err)
        class(hm_plan), intent(inout) :: self
        type(hm_mesh), intent(in) :: mesh
        type(hm_curves), intent(in), optional :: curves
        type(hm_condition), intent(in), optional :: conditions(:)
        integer, intent(in), optional :: given_points(:), given_curves(:)
        real(c_double), intent(in), optional :: given_u(:)
        type(hm_options), intent(in), optional :: options
        real(c_double), pointer, intent(in), optional :: work(:)
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
        call done%finish("plan%analyse", stat, err)
    end subroutine

    subroutine plan_report(self, report, stat, err)
        class(hm_plan), intent(in) :: self
        type(hm_mesh_report), intent(inout) :: report
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        call need_analysis(self, done)
        report%struct_size = int(c_sizeof(report), c_int64_t)
        if (done%ok()) done%status = hm_c_analysis_report(self%analysis, report, done%error)
        call done%finish("plan%report", stat, err)
    end subroutine

    ! The points of these markers in order, the mesh on the left; loop: closed, the first point is not repeated.
    subroutine plan_boundary(self, markers, points, loop, piece, stat, err)
        class(hm_plan), intent(in) :: self
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
        call done%finish("plan%boundary", stat, err)
    end subroutine

    ! 8-byte numbers of work for prepare, and for a basis; 0 without an analysis that has curves.
    integer(c_int64_t) function plan_words(self)
        class(hm_plan), intent(in) :: self
        type(hm_c_error) :: e
        integer(c_size_t) :: bytes
        plan_words = 0
        if (hm_c_plan_size(self%analysis, bytes, e) >= 0) plan_words = words_of(bytes)
    end function

    integer(c_int64_t) function basis_words(self)
        class(hm_plan), intent(in) :: self
        type(hm_c_error) :: e
        integer(c_size_t) :: bytes
        basis_words = 0
        if (hm_c_basis_size(self%analysis, bytes, e) >= 0) basis_words = words_of(bytes)
    end function

    integer(c_int64_t) function share_words(self, first, n)
        class(hm_plan), intent(in) :: self
        integer, intent(in) :: first, n
        type(hm_c_error) :: e
        integer(c_size_t) :: bytes
        share_words = 0
        if (hm_c_share_size(self%analysis, int(first - 1, c_int32_t), int(n, c_int32_t), bytes, e) >= 0) &
            share_words = words_of(bytes)
    end function

    ! Which functions part k of n_parts may solve; n is 0 where there are more parts than functions.
    subroutine plan_share_of(self, part, n_parts, first, n, stat, err)
        class(hm_plan), intent(in) :: self
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
        call done%finish("plan%share_of", stat, err)
    end subroutine

