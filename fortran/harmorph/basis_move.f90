
! ---- What a basis does with coordinates: it moves points, takes gradients by points to those by control points, and
! judges meshes before and after

contains
!@each form
    ! values(function, values [, number]): which of the info's numbers_per_value, 1: the only one, real part, or xx.
    subroutine values_@FORM@(self, function, values, number, stat, err)
        class(hm_basis), intent(in) :: self
        integer, intent(in) :: function
        real(@KIND@), intent(inout) :: values@SHAPE@
        integer, intent(in), optional :: number
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(basis_counts) :: n
        real(c_double), allocatable, target :: all(:)
        integer :: its
        its = 1
        if (present(number)) its = number
        n = self%counts
        call check_points(self, view(n=size(values, kind=c_int64_t)), done)
        call done%refuse_if(function < 1 .or. function > n%functions, "there is no function of this number")
        call done%refuse_if(its < 1 .or. its > n%numbers, "values have no number of this number")
        if (done%ok()) then
            allocate(all(n%points))
            done%status = hm_c_basis_values(self%address(), int(function - 1, c_int32_t), int(its - 1, c_int32_t), &
                c_loc(all), done%error)
            if (done%status >= 0) values = reshape(real(all, @KIND@), shape(values))
        end if
        call done%finish("basis%values", stat, err)
    end subroutine

    ! morph(move, x, y), in place.
    subroutine morph_@FORM@(self, move, x, y, executor, stat, err)
        class(hm_basis), intent(in) :: self
        real(@KIND@), intent(in) :: move(:, :)
        real(@KIND@), intent(inout), target :: x@SHAPE@, y@SHAPE@
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(view) :: v
        v = view_of(x, y)
        call move_points(self, real(move, c_double), v, v, executor, done)
        call v%put_back(x, y)
        call done%finish("basis%morph", stat, err)
    end subroutine

    ! morph_to(move, x, y, x_new, y_new); the arrays must not overlap.
    subroutine morph_to_@FORM@(self, move, x, y, x_new, y_new, executor, stat, err)
        class(hm_basis), intent(in) :: self
        real(@KIND@), intent(in) :: move(:, :)
        real(@KIND@), intent(in), target :: x@SHAPE@, y@SHAPE@
        real(@KIND@), intent(inout), target :: x_new@SHAPE@, y_new@SHAPE@
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(view) :: from, to
        from = view_of(x, y)
        to = space_for(x_new, y_new)
        call move_points(self, real(move, c_double), from, to, executor, done)
        call from%drop()
        if (done%status >= hm_ok) call to%put_back(x_new, y_new)
        call to%drop()
        call done%finish("basis%morph_to", stat, err)
    end subroutine

    ! displacement(move, dx, dy): F move alone. As velocity: the mesh points' velocities from the control points'.
    subroutine displacement_@FORM@(self, move, dx, dy, executor, stat, err)
        class(hm_basis), intent(in) :: self
        real(@KIND@), intent(in) :: move(:, :)
        real(@KIND@), intent(inout), target :: dx@SHAPE@, dy@SHAPE@
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(view) :: v
        v = space_for(dx, dy)
        call move_points(self, real(move, c_double), view(), v, executor, done)
        if (done%status >= hm_ok) call v%put_back(dx, dy)
        call v%drop()
        call done%finish("basis%displacement", stat, err)
    end subroutine

    ! adjoint(dj_dx, dj_dy, gradient): the transpose, gradients by the control points from those by the mesh points.
    subroutine adjoint_@FORM@(self, dj_dx, dj_dy, gradient, executor, stat, err)
        class(hm_basis), intent(in) :: self
        real(@KIND@), intent(in), target :: dj_dx@SHAPE@, dj_dy@SHAPE@
        real(@KIND@), intent(inout) :: gradient(:, :)
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(c_threads), target :: threads
        type(view) :: v
        real(c_double) :: its(size(gradient, 1), size(gradient, 2))
        v = view_of(dj_dx, dj_dy)
        call check_pairs(self, its, done)
        call check_points(self, v, done)
        if (done%ok()) done%status = hm_c_adjoint(self%address(), c_points(v), its, &
            c_executor_of(executor, threads), done%error)
        if (done%status >= hm_ok) gradient = real(its, @KIND@)
        call v%drop()
        call done%finish("basis%adjoint", stat, err)
    end subroutine

    ! The adjoint in parts. adjoint_scale(dj_dx, dj_dy, scale): take the largest of all parts.
    subroutine adjoint_scale_@FORM@(self, dj_dx, dj_dy, scale, executor, stat, err)
        class(hm_basis), intent(in) :: self
        real(@KIND@), intent(in), target :: dj_dx@SHAPE@, dj_dy@SHAPE@
        integer, intent(inout) :: scale
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(c_threads), target :: threads
        type(view) :: v
        integer(c_int32_t) :: its
        v = view_of(dj_dx, dj_dy)
        call check_points(self, v, done)
        if (done%ok()) done%status = hm_c_adjoint_scale(self%address(), c_points(v), its, &
            c_executor_of(executor, threads), done%error)
        if (done%status >= 0) scale = int(its)
        call v%drop()
        call done%finish("basis%adjoint_scale", stat, err)
    end subroutine

    ! adjoint_sums(dj_dx, dj_dy, scale, sums): add those of all parts. sums(4 * functions * numbers_per_value).
    subroutine adjoint_sums_@FORM@(self, dj_dx, dj_dy, scale, sums, executor, stat, err)
        class(hm_basis), intent(in) :: self
        real(@KIND@), intent(in), target :: dj_dx@SHAPE@, dj_dy@SHAPE@
        integer, intent(in) :: scale
        integer(c_int64_t), intent(inout) :: sums(:)
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(c_threads), target :: threads
        type(view) :: v
        v = view_of(dj_dx, dj_dy)
        call check_points(self, v, done)
        call check_sums(self, sums, done)
        if (done%ok()) done%status = hm_c_adjoint_sums(self%address(), c_points(v), int(scale, c_int32_t), &
            sums, c_executor_of(executor, threads), done%error)
        call v%drop()
        call done%finish("basis%adjoint_sums", stat, err)
    end subroutine

    ! boundary_error(move, x, y, x_new, y_new, error [, point]).
    subroutine boundary_error_@FORM@(self, move, x, y, x_new, y_new, error, point, stat, err)
        class(hm_basis), intent(in) :: self
        real(@KIND@), intent(in) :: move(:, :)
        real(@KIND@), intent(in), target :: x@SHAPE@, y@SHAPE@, x_new@SHAPE@, y_new@SHAPE@
        real(c_double), intent(inout) :: error
        integer, intent(out), optional :: point
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(view) :: from, to
        integer(c_int32_t) :: its
        its = -1
        from = view_of(x, y)
        to = view_of(x_new, y_new)
        call check_pairs(self, real(move, c_double), done)
        call check_points(self, from, done)
        call check_points(self, to, done)
        if (done%ok()) done%status = hm_c_boundary_error(self%address(), real(move, c_double), c_points(from), &
            c_points(to), error, its, done%error)
        if (present(point)) point = int(its)
        call from%drop()
        call to%drop()
        call done%finish("basis%boundary_error", stat, err)
    end subroutine

    ! admissible_step(mesh, dx, dy, report [, x, y]): how far from x, y along dx, dy; without x, y from where the mesh
    ! is. Give the x, y that morph_to then starts from.
    subroutine admissible_step_@FORM@(self, mesh, dx, dy, report, x, y, executor, stat, err)
        class(hm_basis), intent(in) :: self
        type(hm_mesh), intent(in) :: mesh
        real(@KIND@), intent(in), target :: dx@SHAPE@, dy@SHAPE@
        type(hm_step_report), intent(inout) :: report
        real(@KIND@), intent(in), target, optional :: x@SHAPE@, y@SHAPE@
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(c_threads), target :: threads
        type(view) :: v, start
        type(hm_c_points), target :: from
        v = view_of(dx, dy)
        call check_points(self, v, done)
        call done%refuse_if(present(x) .neqv. present(y), "only one of x and y is given")
        if (present(x) .and. present(y)) then
            start = view_of(x, y)
            call check_points(self, start, done)
        end if
        from = c_points(start)
        report%struct_size = int(c_sizeof(report), c_int64_t)
        if (done%ok()) done%status = hm_c_admissible_step(self%address(), c_mesh_of(mesh), c_address(from), &
            c_points(v), c_executor_of(executor, threads), report, done%error)
        call v%drop()
        call start%drop()
        call done%finish("basis%admissible_step", stat, err)
    end subroutine

    ! quality(mesh, x, y, report [, x_ref, y_ref]).
    subroutine quality_@FORM@(self, mesh, x, y, report, x_ref, y_ref, executor, stat, err)
        class(hm_basis), intent(in) :: self
        type(hm_mesh), intent(in) :: mesh
        real(@KIND@), intent(in), target :: x@SHAPE@, y@SHAPE@
        type(hm_quality_report), intent(inout) :: report
        real(@KIND@), intent(in), target, optional :: x_ref@SHAPE@, y_ref@SHAPE@
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(c_threads), target :: threads
        type(view) :: v, ref
        type(hm_c_points), target :: at, reference
        v = view_of(x, y)
        call check_points(self, v, done)
        if (present(x_ref) .and. present(y_ref)) then
            ref = view_of(x_ref, y_ref)
            call check_points(self, ref, done)
        end if
        at = c_points(v)
        reference = c_points(ref)
        report%struct_size = int(c_sizeof(report), c_int64_t)
        if (done%ok()) done%status = hm_c_quality(self%address(), c_mesh_of(mesh), c_address(at), &
            c_address(reference), c_executor_of(executor, threads), report, done%error)
        call v%drop()
        call ref%drop()
        call done%finish("basis%quality", stat, err)
    end subroutine

    ! assess(mesh, dx, dy, step, quality [, x, y]): both in one pass, the quality where dx, dy lead from x, y, relative
    ! to x, y, before anything moves; without x, y from where the mesh is.
    subroutine assess_@FORM@(self, mesh, dx, dy, step, quality, x, y, executor, stat, err)
        class(hm_basis), intent(in) :: self
        type(hm_mesh), intent(in) :: mesh
        real(@KIND@), intent(in), target :: dx@SHAPE@, dy@SHAPE@
        type(hm_step_report), intent(inout) :: step
        type(hm_quality_report), intent(inout) :: quality
        real(@KIND@), intent(in), target, optional :: x@SHAPE@, y@SHAPE@
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(c_threads), target :: threads
        type(view) :: v, start
        type(hm_c_points), target :: from
        v = view_of(dx, dy)
        call check_points(self, v, done)
        call done%refuse_if(present(x) .neqv. present(y), "only one of x and y is given")
        if (present(x) .and. present(y)) then
            start = view_of(x, y)
            call check_points(self, start, done)
        end if
        from = c_points(start)
        step%struct_size = int(c_sizeof(step), c_int64_t)
        quality%struct_size = int(c_sizeof(quality), c_int64_t)
        if (done%ok()) done%status = hm_c_assess(self%address(), c_mesh_of(mesh), c_address(from), c_points(v), &
            c_executor_of(executor, threads), step, quality, done%error)
        call v%drop()
        call start%drop()
        call done%finish("basis%assess", stat, err)
    end subroutine

!@end
    ! morph_at(move, c_loc(node(1)%x), c_loc(node(1)%y), bytes, n): in place, by addresses as points_at has them, bytes
    ! a multiple of 8.
    subroutine basis_morph_at(self, move, x, y, bytes, n, executor, stat, err)
        class(hm_basis), intent(in) :: self
        real(c_double), intent(in) :: move(:, :)
        type(c_ptr), intent(in) :: x, y
        integer, intent(in) :: bytes, n
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(view) :: v
        v = view_at(place_at(x, y, bytes, n))
        call move_points(self, move, v, v, executor, done)
        call done%finish("basis%morph_at", stat, err)
    end subroutine

    ! to = from + sum_i F_i move_i; from nowhere: 0.
    subroutine move_points(self, move, from, to, executor, done)
        class(hm_basis), intent(in) :: self
        real(c_double), intent(in) :: move(:, :)
        type(view), intent(in) :: from, to
        type(hm_executor), intent(in), optional :: executor
        type(outcome), intent(inout) :: done
        type(c_threads), target :: threads
        type(hm_c_points), target :: start
        call check_pairs(self, move, done)
        start = c_points(from)
        if (c_associated(from%x) .or. from%wrong /= "") call check_points(self, from, done)
        call check_points(self, to, done)
        if (done%ok()) done%status = hm_c_morph(self%address(), move, c_address(start), c_points(to), &
            c_executor_of(executor, threads), done%error)
    end subroutine
