
contains

    ! ---- Plane: movements and derivatives. Arrays of three dimensions have any shape with as many numbers as there are
    ! points; sections that are not contiguous are copied by the compiler.

!@each space
    ! morph(basis, move, x, y, z), in place; the basis is one of the plane's mesh.
    subroutine plane_morph_@FORM@(self, basis, move, x, y, z, executor, stat, err)
        class(hm_plane), intent(inout) :: self
        type(hm_basis), intent(in) :: basis
        real(@KIND@), intent(in) :: move(:, :)
        real(@KIND@), intent(inout) :: x@SHAPE@, y@SHAPE@, z@SHAPE@
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        call check_space(self, shape(x), shape(y), shape(z), done)
        if (done%ok()) call move_space_@KIND@(self, basis, real(move, c_double), .true., size(x), x, y, z, &
            executor, done)
        call done%finish("plane%morph", stat, err)
    end subroutine

    ! displacement(basis, move, dx, dy, dz) of all points; as velocity: their velocities from those of the
    ! control points.
    subroutine plane_displacement_@FORM@(self, basis, move, dx, dy, dz, executor, stat, err)
        class(hm_plane), intent(inout) :: self
        type(hm_basis), intent(in) :: basis
        real(@KIND@), intent(in) :: move(:, :)
        real(@KIND@), intent(inout) :: dx@SHAPE@, dy@SHAPE@, dz@SHAPE@
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        call check_space(self, shape(dx), shape(dy), shape(dz), done)
        if (done%ok()) call move_space_@KIND@(self, basis, real(move, c_double), .false., size(dx), dx, dy, dz, &
            executor, done)
        call done%finish("plane%displacement", stat, err)
    end subroutine

    ! adjoint(basis, dj_dx, dj_dy, dj_dz, gradient): the transpose.
    subroutine plane_adjoint_@FORM@(self, basis, dj_dx, dj_dy, dj_dz, gradient, executor, stat, err)
        class(hm_plane), intent(inout) :: self
        type(hm_basis), intent(in) :: basis
        real(@KIND@), intent(in) :: dj_dx@SHAPE@, dj_dy@SHAPE@, dj_dz@SHAPE@
        real(@KIND@), intent(inout) :: gradient(:, :)
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        real(c_double) :: its(size(gradient, 1), size(gradient, 2))
        call check_space(self, shape(dj_dx), shape(dj_dy), shape(dj_dz), done)
        if (done%ok()) call adjoint_space_@KIND@(self, basis, size(dj_dx), dj_dx, dj_dy, dj_dz, its, executor, done)
        if (done%status >= hm_ok) gradient = real(its, @KIND@)
        call done%finish("plane%adjoint", stat, err)
    end subroutine

    ! spread(dx, dy, x, y, z): moves all points, in place, by displacements of the points of the plane from elsewhere.
    subroutine plane_spread_@FORM@(self, dx, dy, x, y, z, executor, stat, err)
        class(hm_plane), intent(in) :: self
        real(@KIND@), intent(in) :: dx(:), dy(:)
        real(@KIND@), intent(inout) :: x@SHAPE@, y@SHAPE@, z@SHAPE@
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        call check_space(self, shape(x), shape(y), shape(z), done)
        call check_in_plane(self, size(dx), size(dy), done)
        if (done%ok()) call spread_space_@KIND@(self, real(dx, c_double), real(dy, c_double), size(x), x, y, z, &
            executor, done)
        call done%finish("plane%spread", stat, err)
    end subroutine

    ! gather(dj_dx, dj_dy, dj_dz, plane_dx, plane_dy): the transpose, summed over the layers.
    subroutine plane_gather_@FORM@(self, dj_dx, dj_dy, dj_dz, plane_dx, plane_dy, executor, stat, err)
        class(hm_plane), intent(in) :: self
        real(@KIND@), intent(in) :: dj_dx@SHAPE@, dj_dy@SHAPE@, dj_dz@SHAPE@
        real(@KIND@), intent(inout) :: plane_dx(:), plane_dy(:)
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        real(c_double), allocatable, target :: sums(:, :)
        call check_space(self, shape(dj_dx), shape(dj_dy), shape(dj_dz), done)
        call check_in_plane(self, size(plane_dx), size(plane_dy), done)
        if (done%ok()) then
            allocate(sums(size(plane_dx), 2))
            call gather_space_@KIND@(self, size(dj_dx), dj_dx, dj_dy, dj_dz, sums, executor, done)
        end if
        if (done%ok()) then
            plane_dx = real(sums(:, 1), @KIND@)
            plane_dy = real(sums(:, 2), @KIND@)
        end if
        call done%finish("plane%gather", stat, err)
    end subroutine

!@end
    subroutine check_space(self, of_x, of_y, of_z, done)
        class(hm_plane), intent(in) :: self
        integer, intent(in) :: of_x(:), of_y(:), of_z(:)
        type(outcome), intent(inout) :: done
        call need_plane(self, done)
        call done%refuse_if(any(of_x /= of_y) .or. any(of_x /= of_z), "the three arrays have different shapes")
        call done%refuse_if(product(int(of_x, c_int64_t)) /= self%space_points, &
            "the arrays do not have a number for each point of the mesh of three dimensions")
    end subroutine

    subroutine check_in_plane(self, n_x, n_y, done)
        class(hm_plane), intent(in) :: self
        integer, intent(in) :: n_x, n_y
        type(outcome), intent(inout) :: done
        call done%refuse_if(n_x /= self%plane_points .or. n_y /= self%plane_points, &
            "two arrays do not have a number for each point of the plane")
    end subroutine

    ! from_points: to = from + movement, otherwise the movement alone.
    subroutine move_space_c_double(self, basis, move, from_points, n, x, y, z, executor, done)
        class(hm_plane), intent(in) :: self
        type(hm_basis), intent(in) :: basis
        real(c_double), intent(in) :: move(:, :)
        logical, intent(in) :: from_points
        integer, intent(in) :: n
        real(c_double), intent(inout), target :: x(n), y(n), z(n)
        type(hm_executor), intent(in), optional :: executor
        type(outcome), intent(inout) :: done
        type(c_threads), target :: threads
        type(hm_c_space_points), target :: points
        type(c_ptr) :: from
        points = hm_c_space_points(c_loc(x), c_loc(y), c_loc(z), 1_c_int64_t)
        from = c_null_ptr
        if (from_points) from = c_loc(points)
        call need_basis(basis, done)
        call check_pairs(basis, move, done)
        if (done%ok()) done%status = hm_c_plane_morph(self%handle, basis%address(), move, from, points, &
            c_executor_of(executor, threads), done%error)
    end subroutine

    subroutine move_space_c_float(self, basis, move, from_points, n, x, y, z, executor, done)
        class(hm_plane), intent(in) :: self
        type(hm_basis), intent(in) :: basis
        real(c_double), intent(in) :: move(:, :)
        logical, intent(in) :: from_points
        integer, intent(in) :: n
        real(c_float), intent(inout) :: x(n), y(n), z(n)
        type(hm_executor), intent(in), optional :: executor
        type(outcome), intent(inout) :: done
        real(c_double), allocatable :: all(:, :)
        allocate(all(n, 3), source=0._c_double)
        if (from_points) then                                   ! otherwise what they hold may be no number
            all(:, 1) = real(x, c_double)
            all(:, 2) = real(y, c_double)
            all(:, 3) = real(z, c_double)
        end if
        call move_space_c_double(self, basis, move, from_points, n, all(:, 1), all(:, 2), all(:, 3), executor, done)
        if (done%status < 0) return
        x = real(all(:, 1), c_float)
        y = real(all(:, 2), c_float)
        z = real(all(:, 3), c_float)
    end subroutine

    subroutine adjoint_space_c_double(self, basis, n, x, y, z, gradient, executor, done)
        class(hm_plane), intent(in) :: self
        type(hm_basis), intent(in) :: basis
        integer, intent(in) :: n
        real(c_double), intent(in), target :: x(n), y(n), z(n)
        real(c_double), intent(inout) :: gradient(:, :)
        type(hm_executor), intent(in), optional :: executor
        type(outcome), intent(inout) :: done
        type(c_threads), target :: threads
        call need_basis(basis, done)
        call check_pairs(basis, gradient, done)
        if (done%ok()) done%status = hm_c_plane_adjoint(self%handle, basis%address(), &
            hm_c_space_points(c_loc(x), c_loc(y), c_loc(z), 1_c_int64_t), gradient, c_executor_of(executor, threads), &
            done%error)
    end subroutine

    subroutine adjoint_space_c_float(self, basis, n, x, y, z, gradient, executor, done)
        class(hm_plane), intent(in) :: self
        type(hm_basis), intent(in) :: basis
        integer, intent(in) :: n
        real(c_float), intent(in) :: x(n), y(n), z(n)
        real(c_double), intent(inout) :: gradient(:, :)
        type(hm_executor), intent(in), optional :: executor
        type(outcome), intent(inout) :: done
        call adjoint_space_c_double(self, basis, n, real(x, c_double), real(y, c_double), real(z, c_double), gradient, &
            executor, done)
    end subroutine

    subroutine spread_space_c_double(self, dx, dy, n, x, y, z, executor, done)
        class(hm_plane), intent(in) :: self
        real(c_double), intent(in), target :: dx(:), dy(:)
        integer, intent(in) :: n
        real(c_double), intent(inout), target :: x(n), y(n), z(n)
        type(hm_executor), intent(in), optional :: executor
        type(outcome), intent(inout) :: done
        type(c_threads), target :: threads
        type(hm_c_space_points), target :: points
        type(view) :: v
        points = hm_c_space_points(c_loc(x), c_loc(y), c_loc(z), 1_c_int64_t)
        v = view_of(dx, dy)
        call done%refuse_if(v%wrong /= "", v%wrong)
        if (done%ok()) done%status = hm_c_plane_spread(self%handle, c_points(v), c_loc(points), points, &
            c_executor_of(executor, threads), done%error)
        call v%drop()
    end subroutine

    subroutine spread_space_c_float(self, dx, dy, n, x, y, z, executor, done)
        class(hm_plane), intent(in) :: self
        real(c_double), intent(in) :: dx(:), dy(:)
        integer, intent(in) :: n
        real(c_float), intent(inout) :: x(n), y(n), z(n)
        type(hm_executor), intent(in), optional :: executor
        type(outcome), intent(inout) :: done
        real(c_double), allocatable :: all(:, :)
        allocate(all(n, 3))
        all(:, 1) = real(x, c_double)
        all(:, 2) = real(y, c_double)
        all(:, 3) = real(z, c_double)
        call spread_space_c_double(self, dx, dy, n, all(:, 1), all(:, 2), all(:, 3), executor, done)
        if (done%status < 0) return
        x = real(all(:, 1), c_float)
        y = real(all(:, 2), c_float)
        z = real(all(:, 3), c_float)
    end subroutine

    subroutine gather_space_c_double(self, n, x, y, z, sums, executor, done)
        class(hm_plane), intent(in) :: self
        integer, intent(in) :: n
        real(c_double), intent(in), target :: x(n), y(n), z(n)
        real(c_double), intent(inout), target, contiguous :: sums(:, :)
        type(hm_executor), intent(in), optional :: executor
        type(outcome), intent(inout) :: done
        type(c_threads), target :: threads
        if (done%ok()) done%status = hm_c_plane_gather(self%handle, &
            hm_c_space_points(c_loc(x), c_loc(y), c_loc(z), 1_c_int64_t), &
            hm_c_points(c_loc(sums(1, 1)), c_loc(sums(1, 2)), 1_c_int64_t), c_executor_of(executor, threads), &
            done%error)
    end subroutine

    subroutine gather_space_c_float(self, n, x, y, z, sums, executor, done)
        class(hm_plane), intent(in) :: self
        integer, intent(in) :: n
        real(c_float), intent(in) :: x(n), y(n), z(n)
        real(c_double), intent(inout), contiguous :: sums(:, :)
        type(hm_executor), intent(in), optional :: executor
        type(outcome), intent(inout) :: done
        call gather_space_c_double(self, n, real(x, c_double), real(y, c_double), real(z, c_double), sums, executor, &
            done)
    end subroutine
