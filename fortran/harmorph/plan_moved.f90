
! ---- What a plan does with coordinates: it factors on moved ones, moves them safely, and improves them

contains
!@each form
    ! factor(x, y): on moved coordinates of the same mesh.
    subroutine factor_@FORM@(self, x, y, stat, err)
        class(hm_plan), intent(inout) :: self
        real(@KIND@), intent(in), target :: x@SHAPE@, y@SHAPE@
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(view) :: v
        v = view_of(x, y)
        call factor_on(self, v, done)
        call v%drop()
        call done%finish("plan%factor", stat, err)
    end subroutine

    ! morph_safe(basis, move, x_new, y_new): however large move is, x_new has no inverted cell; hm_short: x_new has only
    ! a part of move; hm_poor: all of move, but cells are poorer than options ask for. The mesh's own coordinates are
    ! the start; they must be those that the basis was solved on (after basis%morph in place: plan%factor and solve).
    ! x_new may be the same arrays. derivative: another basis for the step as a whole, made here if empty; what the
    ! derivative neglects stands at hm_morph_safe in harmorph.h. others: bases to be tried where this one would invert
    ! cells; the report counts them from 1, 0: none.
    subroutine morph_safe_@FORM@(self, basis, move, x_new, y_new, derivative, others, options, report, work, stat, err)
        class(hm_plan), intent(inout) :: self
        type(hm_basis), intent(in) :: basis
        real(@KIND@), intent(in) :: move(:, :)
        real(@KIND@), intent(inout), target :: x_new@SHAPE@, y_new@SHAPE@
        type(hm_basis), intent(inout), optional :: derivative
        type(hm_basis), intent(in), optional :: others(:)
        type(hm_safe_options), intent(in), optional :: options
        type(hm_safe_report), intent(out), optional :: report
        real(c_double), pointer, intent(in), optional :: work(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(view) :: to
        type(hm_c_safe_options) :: c_options
        type(hm_safe_report) :: its
        type(c_ptr), allocatable, target :: handles(:)
        type(c_ptr) :: sum_of_steps
        type(block_of_memory) :: block
        integer(c_size_t) :: bytes
        integer :: k
        to = space_for(x_new, y_new)
        if (associated(self%data)) call read_again(self%data%arrays)
        call done%refuse_if(.not. c_associated(self%plan), "the plan is empty: call prepare or factor first")
        call check_pairs(basis, real(move, c_double), done)
        call check_points(basis, to, done)
        sum_of_steps = c_null_ptr
        if (present(derivative)) then
            if (done%ok() .and. .not. c_associated(derivative%address())) call make_basis(derivative, self, done=done)
            sum_of_steps = derivative%address()
        end if
        call read_safe_options(options, basis, c_options, done)
        if (present(others)) then
            handles = [(others(k)%address(), k = 1, size(others))]
            c_options%n_others = int(size(others), c_int32_t)
            if (size(others) > 0) c_options%others = c_loc(handles)
        end if
        if (done%ok()) done%status = hm_c_morph_safe_size(self%plan, basis%address(), bytes, &
            done%error)
        call block%take(bytes, work, done)
        its%struct_size = int(c_sizeof(its), c_int64_t)
        if (done%ok()) done%status = hm_c_morph_safe(self%plan, basis%address(), real(move, c_double), &
            c_points(to), sum_of_steps, block%start, block%bytes, c_options, its, done%error)
        its%other = its%other + 1_c_int32_t
        if (present(report)) report = its
        call block%give_back()
        if (done%status >= hm_ok) call to%put_back(x_new, y_new)
        call to%drop()
        call done%finish("plan%morph_safe", stat, err)
    end subroutine

    ! improve(x, y [, x_ref, y_ref]): of a mesh after a movement, inner points go where cells are more like those of the
    ! mesh before, x_ref, y_ref; without them, of the mesh as analysed, whose arrays must still hold that (x, y are
    ! others then): after basis%morph in place the call is refused without x_ref, y_ref.
    subroutine improve_@FORM@(self, x, y, x_ref, y_ref, max_iterations, report, work, stat, err)
        class(hm_plan), intent(inout) :: self
        real(@KIND@), intent(inout), target :: x@SHAPE@, y@SHAPE@
        real(@KIND@), intent(in), target, optional :: x_ref@SHAPE@, y_ref@SHAPE@
        integer, intent(in), optional :: max_iterations
        type(hm_improve_report), intent(out), optional :: report
        real(c_double), pointer, intent(in), optional :: work(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(view) :: v, ref
        type(hm_c_points), target :: reference
        type(hm_c_improve_options) :: options
        type(hm_improve_report) :: its
        type(block_of_memory) :: block
        integer(c_size_t) :: bytes
        v = view_of(x, y)
        if (associated(self%data)) call read_again(self%data%arrays)
        call done%refuse_if(.not. c_associated(self%plan), "the plan is empty: call prepare or factor first")
        call done%refuse_if(present(x_ref) .neqv. present(y_ref), "only one of x_ref and y_ref is given")
        if (done%ok()) call check_view(v, int(n_points_of(self), c_int64_t), done)
        if (present(x_ref) .and. present(y_ref)) then
            ref = view_of(x_ref, y_ref)
            if (done%ok()) call check_view(ref, int(n_points_of(self), c_int64_t), done)
            reference = c_points(ref)
            options%reference = c_loc(reference)
        end if
        options%struct_size = int(c_sizeof(options), c_int64_t)
        if (present(max_iterations)) options%max_iterations = int(max_iterations, c_int32_t)
        if (done%ok()) done%status = hm_c_improve_size(self%plan, bytes, done%error)
        call block%take(bytes, work, done)
        its%struct_size = int(c_sizeof(its), c_int64_t)
        if (done%ok()) done%status = hm_c_improve(self%plan, c_points(v), c_points(v), block%start, block%bytes, &
            options, its, done%error)
        if (present(report)) report = its
        call block%give_back()
        call ref%drop()
        call v%put_back(x, y)
        call done%finish("plan%improve", stat, err)
    end subroutine

    ! slide(x, y): of a mesh after basis%morph or plan%displace, points that slide along curves are put onto these
    ! curves, and the mesh follows. Needs the analysis.
    subroutine slide_@FORM@(self, x, y, stat, err)
        class(hm_plan), intent(in) :: self
        real(@KIND@), intent(inout), target :: x@SHAPE@, y@SHAPE@
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(view) :: v
        v = view_of(x, y)
        call check_analysed(self, v, done)
        if (done%ok()) done%status = hm_c_slide(self%analysis, c_points(v), c_points(v), done%error)
        call v%put_back(x, y)
        call done%finish("plan%slide", stat, err)
    end subroutine

    ! slide_adjoint(x, y, gx, gy): x, y is the mesh before slide. gx, gy: derivatives of an objective by the points
    ! after slide; they become those by the points before.
    subroutine slide_adjoint_@FORM@(self, x, y, gx, gy, stat, err)
        class(hm_plan), intent(in) :: self
        real(@KIND@), intent(in), target :: x@SHAPE@, y@SHAPE@
        real(@KIND@), intent(inout), target :: gx@SHAPE@, gy@SHAPE@
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(view) :: v, g
        v = view_of(x, y)
        g = view_of(gx, gy)
        call check_analysed(self, v, done)
        call check_analysed(self, g, done)
        if (done%ok()) done%status = hm_c_slide_adjoint(self%analysis, c_points(v), c_points(g), c_points(g), &
            done%error)
        call v%drop()
        call g%put_back(gx, gy)
        call done%finish("plan%slide_adjoint", stat, err)
    end subroutine

!@end
    subroutine check_analysed(self, v, done)
        class(hm_plan), intent(in) :: self
        type(view), intent(in) :: v
        type(outcome), intent(inout) :: done
        call done%refuse_if(.not. c_associated(self%analysis), "the plan has no analysis: call analyse first")
        if (done%ok()) call check_view(v, int(n_points_of(self), c_int64_t), done)
    end subroutine

    subroutine read_safe_options(options, basis, c_options, done)
        type(hm_safe_options), intent(in), optional :: options
        type(hm_basis), intent(in) :: basis
        type(hm_c_safe_options), intent(inout) :: c_options
        type(outcome), intent(inout) :: done
        c_options%struct_size = int(c_sizeof(c_options), c_int64_t)
        if (.not. present(options)) return
        c_options%max_resolves = int(options%max_resolves, c_int32_t)
        c_options%skipped_strategies = int(options%skipped_strategies, c_int32_t)
        c_options%heights = options%heights
        c_options%min_quality = options%min_quality
        c_options%max_height_change = options%max_height_change
        if (.not. associated(options%reached)) return
        call check_pairs(basis, options%reached, done)
        c_options%reached = c_loc(options%reached)
    end subroutine

