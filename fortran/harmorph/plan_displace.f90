
! ---- Displacements that are given at points of markers with hm_given, and the transpose ------------------------------

    type :: displace_call                                       ! the list of wall points, and memory
        integer(c_int32_t), pointer :: list(:) => null()
        type(c_ptr) :: points = c_null_ptr
        integer(c_int32_t) :: n = 0
        type(block_of_memory) :: work
        type(hm_solve_report) :: report
    end type

contains
    ! The points of markers with hm_given in order along the boundary: what arrays of wall points have without `points`.
    subroutine plan_given_points(self, points, stat, err)
        class(hm_plan), intent(in) :: self
        integer, allocatable, intent(out) :: points(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        integer(c_int32_t), allocatable :: found(:)
        integer(c_int32_t) :: n
        call done%refuse_if(.not. c_associated(self%plan), "the plan is empty: call prepare or factor first")
        allocate(found(n_given(self)))
        if (done%ok()) done%status = hm_c_given_points(self%plan, found, int(size(found), c_int32_t), n, done%error)
        if (done%status >= 0) points = int(found)
        call done%finish("plan%given_points", stat, err)
    end subroutine

!@each form
    ! displace(wall, x, y): moves the mesh points x, y, in place, by the displacements wall(2,n) of points(n).
    subroutine displace_@FORM@(self, wall, x, y, points, report, stat, err)
        class(hm_plan), intent(inout) :: self
        real(@KIND@), intent(in) :: wall(:, :)
        real(@KIND@), intent(inout), target :: x@SHAPE@, y@SHAPE@
        integer, intent(in), optional :: points(:)
        type(hm_solve_report), intent(out), optional :: report
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(view) :: v
        v = view_of(x, y)
        call displace_points(self, real(wall, c_double), v, v, points, report, done)
        call v%put_back(x, y)
        call done%finish("plan%displace", stat, err)
    end subroutine

    ! displacement(wall, dx, dy): that of all mesh points alone. As velocity: from velocities of wall points.
    subroutine plan_displacement_@FORM@(self, wall, dx, dy, points, report, stat, err)
        class(hm_plan), intent(inout) :: self
        real(@KIND@), intent(in) :: wall(:, :)
        real(@KIND@), intent(inout), target :: dx@SHAPE@, dy@SHAPE@
        integer, intent(in), optional :: points(:)
        type(hm_solve_report), intent(out), optional :: report
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(view) :: v
        v = space_for(dx, dy)
        call displace_points(self, real(wall, c_double), view(), v, points, report, done)
        if (done%status >= hm_ok) call v%put_back(dx, dy)
        call v%drop()
        call done%finish("plan%displacement", stat, err)
    end subroutine

    ! displace_adjoint(dj_dx, dj_dy, gradient): the transpose of displacement, gradient(2,n) by the wall points.
    subroutine displace_adjoint_@FORM@(self, dj_dx, dj_dy, gradient, points, report, stat, err)
        class(hm_plan), intent(inout) :: self
        real(@KIND@), intent(in), target :: dj_dx@SHAPE@, dj_dy@SHAPE@
        real(@KIND@), intent(inout) :: gradient(:, :)
        integer, intent(in), optional :: points(:)
        type(hm_solve_report), intent(out), optional :: report
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(displace_call) :: call_of
        type(view) :: v
        real(c_double), target :: its(2, size(gradient, 2))
        type(hm_c_points) :: dj(1), to(1)
        v = view_of(dj_dx, dj_dy)
        its = 0
        call begin_displace(self, shape(gradient), points, 1, call_of, done)
        call check_view(v, mesh_points_of(self), done)
        dj = c_points(v)
        to = pairs_at(its)
        if (done%ok()) done%status = hm_c_displace_adjoint(self%plan, call_of%n, call_of%points, 1_c_int32_t, dj, to, &
            call_of%work%start, call_of%work%bytes, call_of%report, done%error)
        if (done%status >= 0) gradient = real(its, @KIND@)
        call end_displace(call_of, report)
        call v%drop()
        call done%finish("plan%displace_adjoint", stat, err)
    end subroutine

    ! displace_safe(basis, wall, x_new, y_new): however large the displacements are, x_new has no inverted cell;
    ! hm_short: only a part of the way; see morph_safe. basis: of the same plan, made here if empty; solved, where the
    ! problem has curves or rigid bodies. move: what these move by in the same call. In the report, `other` is the
    ! operator_kind of hm_strategy_other, -1: none. The mesh's own coordinates are the start, and x_new may be the same
    ! arrays.
    subroutine displace_safe_@FORM@(self, basis, wall, x_new, y_new, move, points, options, report, stat, err)
        class(hm_plan), intent(inout) :: self
        type(hm_basis), intent(inout) :: basis
        real(@KIND@), intent(in) :: wall(:, :)
        real(@KIND@), intent(inout), target :: x_new@SHAPE@, y_new@SHAPE@
        real(@KIND@), intent(in), optional :: move(:, :)
        integer, intent(in), optional :: points(:)
        type(hm_safe_options), intent(in), optional :: options
        type(hm_safe_report), intent(out), optional :: report
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(view) :: to
        type(displace_call) :: call_of
        type(hm_c_safe_options) :: c_options
        type(hm_safe_report) :: its
        real(c_double), target :: given(2, size(wall, 2))
        real(c_double), allocatable, target :: movement(:, :)
        type(c_ptr) :: at_movement
        integer(c_size_t) :: bytes
        to = space_for(x_new, y_new)
        if (associated(self%data)) call read_again(self%data%arrays)
        call begin_list(self, shape(wall), points, call_of, done)
        if (done%ok() .and. .not. c_associated(basis%address())) call make_basis(basis, self, done=done)
        call check_points(basis, to, done)
        at_movement = c_null_ptr
        if (present(move)) then
            movement = real(move, c_double)
            call check_pairs(basis, movement, done)
            if (size(movement) > 0) at_movement = c_loc(movement)
        end if
        call read_safe_options(options, basis, c_options, done)
        if (done%ok()) done%status = hm_c_displace_safe_size(self%plan, basis%address(), bytes, done%error)
        if (done%ok()) call call_of%work%take(bytes, done=done)
        its%struct_size = int(c_sizeof(its), c_int64_t)
        if (done%ok()) then
            given = real(wall, c_double)
            done%status = hm_c_displace_safe(self%plan, basis%address(), at_movement, call_of%n, call_of%points, &
                pairs_at(given), c_points(to), call_of%work%start, call_of%work%bytes, c_options, its, done%error)
        end if
        if (present(report)) report = its
        call end_displace(call_of)
        if (done%status >= hm_ok) call to%put_back(x_new, y_new)
        call to%drop()
        call done%finish("plan%displace_safe", stat, err)
    end subroutine

!@end
    ! Several fields at once, wall(2,n,m) to dx(:,m), dy(:,m), for instance modes: cheaper than one after the other.
    subroutine plan_displacements(self, wall, dx, dy, points, report, stat, err)
        class(hm_plan), intent(inout) :: self
        real(c_double), intent(in), contiguous, target :: wall(:, :, :)
        real(c_double), intent(inout), contiguous, target :: dx(:, :), dy(:, :)
        integer, intent(in), optional :: points(:)
        type(hm_solve_report), intent(out), optional :: report
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(displace_call) :: call_of
        type(hm_c_points) :: given(size(wall, 3)), to(size(wall, 3))
        integer :: k
        call begin_displace(self, [size(wall, 1), size(wall, 2)], points, size(wall, 3), call_of, done)
        call check_fields(self, shape(dx), shape(dy), size(wall, 3), done)
        if (done%ok()) then
            do k = 1, size(wall, 3)
                given(k) = hm_c_points(c_loc(wall(1, 1, k)), c_loc(wall(2, 1, k)), 2_c_int64_t)
                to(k) = hm_c_points(c_loc(dx(1, k)), c_loc(dy(1, k)), 1_c_int64_t)
            end do
            done%status = hm_c_displace(self%plan, call_of%n, call_of%points, int(size(wall, 3), c_int32_t), given, &
                c_null_ptr, to, call_of%work%start, call_of%work%bytes, call_of%report, done%error)
        end if
        call end_displace(call_of, report)
        call done%finish("plan%displacements", stat, err)
    end subroutine

    ! The transpose of displacements.
    subroutine plan_displace_adjoints(self, dj_dx, dj_dy, gradient, points, report, stat, err)
        class(hm_plan), intent(inout) :: self
        real(c_double), intent(in), contiguous, target :: dj_dx(:, :), dj_dy(:, :)
        real(c_double), intent(inout), contiguous, target :: gradient(:, :, :)
        integer, intent(in), optional :: points(:)
        type(hm_solve_report), intent(out), optional :: report
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(displace_call) :: call_of
        type(hm_c_points) :: dj(size(gradient, 3)), to(size(gradient, 3))
        integer :: k
        call begin_displace(self, [size(gradient, 1), size(gradient, 2)], points, size(gradient, 3), call_of, done)
        call check_fields(self, shape(dj_dx), shape(dj_dy), size(gradient, 3), done)
        if (done%ok()) then
            do k = 1, size(gradient, 3)
                to(k) = hm_c_points(c_loc(gradient(1, 1, k)), c_loc(gradient(2, 1, k)), 2_c_int64_t)
                dj(k) = hm_c_points(c_loc(dj_dx(1, k)), c_loc(dj_dy(1, k)), 1_c_int64_t)
            end do
            done%status = hm_c_displace_adjoint(self%plan, call_of%n, call_of%points, &
                int(size(gradient, 3), c_int32_t), dj, to, call_of%work%start, call_of%work%bytes, call_of%report, &
                done%error)
        end if
        call end_displace(call_of, report)
        call done%finish("plan%displace_adjoints", stat, err)
    end subroutine

    subroutine displace_points(self, wall, from, to, points, report, done)
        class(hm_plan), intent(inout) :: self
        real(c_double), intent(in), contiguous, target :: wall(:, :)
        type(view), intent(in) :: from, to
        integer, intent(in), optional :: points(:)
        type(hm_solve_report), intent(out), optional :: report
        type(outcome), intent(inout) :: done
        type(displace_call) :: call_of
        type(hm_c_points) :: given(1), result(1)
        type(hm_c_points), target :: start
        call begin_displace(self, shape(wall), points, 1, call_of, done)
        if (c_associated(from%x) .or. from%wrong /= "") call check_view(from, mesh_points_of(self), done)
        call check_view(to, mesh_points_of(self), done)
        given = pairs_at(wall)
        result = c_points(to)
        start = c_points(from)
        if (done%ok()) done%status = hm_c_displace(self%plan, call_of%n, call_of%points, 1_c_int32_t, given, &
            c_address(start), result, call_of%work%start, call_of%work%bytes, call_of%report, done%error)
        call end_displace(call_of, report)
    end subroutine

    ! The list of wall points, of (2,n) arrays, and memory.
    subroutine begin_displace(self, extents, points, n_fields, its, done)
        class(hm_plan), intent(inout) :: self
        integer, intent(in) :: extents(:), n_fields
        integer, intent(in), optional :: points(:)
        type(displace_call), intent(inout) :: its
        type(outcome), intent(inout) :: done
        integer(c_size_t) :: bytes
        call begin_list(self, extents, points, its, done)
        its%report%struct_size = int(c_sizeof(its%report), c_int64_t)
        if (done%ok()) done%status = hm_c_displace_size(self%plan, int(n_fields, c_int32_t), bytes, done%error)
        if (done%ok()) call its%work%take(bytes, done=done)
    end subroutine

    subroutine begin_list(self, extents, points, its, done)
        class(hm_plan), intent(in) :: self
        integer, intent(in) :: extents(:)
        integer, intent(in), optional :: points(:)
        type(displace_call), intent(inout) :: its
        type(outcome), intent(inout) :: done
        call done%refuse_if(.not. c_associated(self%plan), "the plan is empty: call factor first")
        call done%refuse_if(extents(1) /= 2 .or. extents(2) < 1, &
            "an array of wall points is empty, or its first extent is not 2")
        its%n = int(extents(2), c_int32_t)
        if (present(points)) then
            call done%refuse_if(size(points) /= extents(2), &
                "points and the array of wall points have different lengths")
            allocate(its%list(size(points)))
            its%list = int(points, c_int32_t)
            if (size(points) > 0) its%points = c_loc(its%list(1))
        end if
    end subroutine

    subroutine end_displace(its, report)
        type(displace_call), intent(inout) :: its
        type(hm_solve_report), intent(out), optional :: report
        call its%work%give_back()
        if (associated(its%list)) deallocate(its%list)
        nullify(its%list)
        if (its%report%residual_function >= 0) its%report%residual_function = its%report%residual_function + 1_c_int32_t
        if (present(report)) report = its%report
    end subroutine

    subroutine check_fields(self, extents_x, extents_y, n_fields, done)
        class(hm_plan), intent(in) :: self
        integer, intent(in) :: extents_x(2), extents_y(2), n_fields
        type(outcome), intent(inout) :: done
        call done%refuse_if(any(extents_x /= extents_y), "x and y have different shapes")
        call done%refuse_if(extents_x(2) /= n_fields, "the arrays have different numbers of fields")
        if (done%ok()) call done%refuse_if(int(extents_x(1), c_int64_t) /= mesh_points_of(self), &
            "the arrays do not have as many points as the mesh")
    end subroutine

    ! Pairs as C sees them.
    function pairs_at(pairs) result(points)
        real(c_double), intent(in), contiguous, target :: pairs(:, :)
        type(hm_c_points) :: points
        points = hm_c_points(c_null_ptr, c_null_ptr, 2_c_int64_t)
        if (size(pairs, 1) < 2 .or. size(pairs, 2) < 1) return
        points%x = c_loc(pairs(1, 1))
        points%y = c_loc(pairs(2, 1))
    end function

    integer(c_int64_t) function mesh_points_of(self)
        class(hm_plan), intent(in) :: self
        mesh_points_of = 0
        if (associated(self%data)) mesh_points_of = int(n_points_of(self), c_int64_t)
    end function

    integer(c_int32_t) function n_given(self)
        class(hm_plan), intent(in) :: self
        type(hm_c_error) :: e
        integer(c_int32_t) :: status, none(1)
        n_given = 0
        if (c_associated(self%plan)) status = hm_c_given_points(self%plan, none, 0_c_int32_t, n_given, e)
    end function
