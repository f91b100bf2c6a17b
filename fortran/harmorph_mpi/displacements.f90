
    ! ---- Displacements given at wall points -----------------------------------------------------------------------

    interface hm_mpi_displacement
!@each comm
        procedure :: displacement_@FORM@, displacements_@FORM@
!@end
    end interface
    interface hm_mpi_displace
!@each comm
        procedure :: displace_@FORM@
!@end
    end interface
    interface hm_mpi_displace_adjoint
!@each comm
        procedure :: displace_adjoint_@FORM@, displace_adjoints_@FORM@
!@end
    end interface

contains

!@each comm
    ! Displacements, or velocities, dx, dy of the process's points.
    subroutine displacement_@FORM@(plan, wall_points, wall, points, dx, dy, comm, root, stat, err)
        type(hm_plan), intent(in) :: plan
        integer(c_int32_t), intent(in), contiguous :: wall_points(:), points(:)
        real(c_double), intent(in), contiguous, target :: wall(:, :)
        real(c_double), intent(inout), contiguous, target :: dx(:), dy(:)
        @KIND@, intent(in) :: comm
        integer, intent(in), optional :: root
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call move(plan, wall_points, [pairs(wall)], size(wall) == 2 * size(wall_points), points, &
            [points_of(dx, dy, size(points))], c_null_ptr, number_of(comm), root, "hm_mpi_displacement", stat, err)
    end subroutine

    ! Of several fields.
    subroutine displacements_@FORM@(plan, wall_points, wall, points, dx, dy, comm, root, stat, err)
        type(hm_plan), intent(in) :: plan
        integer(c_int32_t), intent(in), contiguous :: wall_points(:), points(:)
        real(c_double), intent(in), contiguous, target :: wall(:, :, :)
        real(c_double), intent(inout), contiguous, target :: dx(:, :), dy(:, :)
        @KIND@, intent(in) :: comm
        integer, intent(in), optional :: root
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        integer :: k, m
        logical :: fits
        m = size(wall, 3)
        fits = all(shape(wall) == [2, size(wall_points), m]) .and. size(dx, 2) == m .and. size(dy, 2) == m
        if (.not. fits) m = 0
        call move(plan, wall_points, [(pairs(wall(:, :, k)), k = 1, m)], fits, points, &
            [(points_of(dx(:, k), dy(:, k), size(points)), k = 1, m)], c_null_ptr, number_of(comm), root, &
            "hm_mpi_displacement", stat, err)
    end subroutine

    ! Moves x, y in place.
    subroutine displace_@FORM@(plan, wall_points, wall, points, x, y, comm, root, stat, err)
        type(hm_plan), intent(in) :: plan
        integer(c_int32_t), intent(in), contiguous :: wall_points(:), points(:)
        real(c_double), intent(in), contiguous, target :: wall(:, :)
        real(c_double), intent(inout), contiguous, target :: x(:), y(:)
        @KIND@, intent(in) :: comm
        integer, intent(in), optional :: root
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_points), target :: all
        all = points_of(x, y, size(points))
        call move(plan, wall_points, [pairs(wall)], size(wall) == 2 * size(wall_points), points, [all], c_loc(all), &
            number_of(comm), root, "hm_mpi_displace", stat, err)
    end subroutine

    subroutine displace_adjoint_@FORM@(plan, wall_points, dj_dx, dj_dy, points, gradient, comm, root, stat, err)
        type(hm_plan), intent(in) :: plan
        integer(c_int32_t), intent(in), contiguous :: wall_points(:), points(:)
        real(c_double), intent(in), contiguous, target :: dj_dx(:), dj_dy(:)
        real(c_double), intent(inout), contiguous, target :: gradient(:, :)
        @KIND@, intent(in) :: comm
        integer, intent(in), optional :: root
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call gather(plan, wall_points, [points_of(dj_dx, dj_dy, size(points))], points, [pairs(gradient)], &
            size(gradient) == 2 * size(wall_points), number_of(comm), root, stat, err)
    end subroutine

    ! Of several fields.
    subroutine displace_adjoints_@FORM@(plan, wall_points, dj_dx, dj_dy, points, gradient, comm, root, stat, err)
        type(hm_plan), intent(in) :: plan
        integer(c_int32_t), intent(in), contiguous :: wall_points(:), points(:)
        real(c_double), intent(in), contiguous, target :: dj_dx(:, :), dj_dy(:, :)
        real(c_double), intent(inout), contiguous, target :: gradient(:, :, :)
        @KIND@, intent(in) :: comm
        integer, intent(in), optional :: root
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        integer :: k, m
        logical :: fits
        m = size(gradient, 3)
        fits = all(shape(gradient) == [2, size(wall_points), m]) .and. size(dj_dx, 2) == m .and. size(dj_dy, 2) == m
        if (.not. fits) m = 0
        call gather(plan, wall_points, [(points_of(dj_dx(:, k), dj_dy(:, k), size(points)), k = 1, m)], points, &
            [(pairs(gradient(:, :, k)), k = 1, m)], fits, number_of(comm), root, stat, err)
    end subroutine

!@end
    ! What one process has wrong, its wrong lengths too, is refused by all: then n_wall is -1. One field more than there
    ! are, as C looks at the first one in any case.
    subroutine move(plan, wall_points, wall, fits, points, to, from, comm, root, name, stat, err)
        type(hm_plan), intent(in) :: plan
        integer(c_int32_t), intent(in), contiguous :: wall_points(:), points(:)
        type(hm_c_points), intent(in) :: wall(:), to(:)                     ! of each field
        logical, intent(in) :: fits                                         ! have the arrays of wall their shape?
        type(c_ptr), intent(in) :: from
        integer(c_int), intent(in) :: comm
        integer, intent(in), optional :: root
        character(len=*), intent(in) :: name
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        integer(c_int32_t) :: status, n_wall
        n_wall = int(size(wall_points), c_int32_t)
        if (.not. fits .or. any(to%stride < 0) .or. size(wall) == 0) n_wall = -1
        status = c_displace(plan%address(), n_wall, wall_points, int(max(size(wall), 1), c_int32_t), &
            [wall, hm_c_points()], int(size(points), c_int32_t), points, from, [to, hm_c_points()], &
            rank_of(root), comm, e)
        call hm_finish(name, status, e, stat, err)
    end subroutine

    subroutine gather(plan, wall_points, dj, points, gradient, fits, comm, root, stat, err)
        type(hm_plan), intent(in) :: plan
        integer(c_int32_t), intent(in), contiguous :: wall_points(:), points(:)
        type(hm_c_points), intent(in) :: dj(:), gradient(:)                 ! of each field
        logical, intent(in) :: fits                                         ! have the arrays of gradient their shape?
        integer(c_int), intent(in) :: comm
        integer, intent(in), optional :: root
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        integer(c_int32_t) :: status, n_wall
        n_wall = int(size(wall_points), c_int32_t)
        if (.not. fits .or. any(dj%stride < 0) .or. size(dj) == 0) n_wall = -1
        status = c_displace_adjoint(plan%address(), n_wall, wall_points, int(max(size(dj), 1), c_int32_t), &
            [dj, hm_c_points()], int(size(points), c_int32_t), points, [gradient, hm_c_points()], rank_of(root), &
            comm, e)
        call hm_finish("hm_mpi_displace_adjoint", status, e, stat, err)
    end subroutine

    ! Two arrays of n numbers; a stride below 0 if their lengths are others.
    type(hm_c_points) function points_of(x, y, n)
        real(c_double), intent(in), contiguous, target :: x(:), y(:)
        integer, intent(in) :: n
        points_of = hm_c_points(c_null_ptr, c_null_ptr, 1_c_int64_t)
        if (size(x) /= n .or. size(y) /= n) points_of%stride = -1
        if (size(x) > 0 .and. size(y) > 0) points_of = hm_c_points(c_loc(x), c_loc(y), points_of%stride)
    end function

    type(hm_c_points) function pairs(of)
        real(c_double), intent(in), contiguous, target :: of(:, :)
        pairs = hm_c_points(c_null_ptr, c_null_ptr, 2_c_int64_t)
        if (size(of, 1) < 2 .or. size(of, 2) < 1) return
        pairs%x = c_loc(of(1, 1))
        pairs%y = c_loc(of(2, 1))
    end function

    integer(c_int32_t) function rank_of(root)
        integer, intent(in), optional :: root
        rank_of = 0
        if (present(root)) rank_of = int(root, c_int32_t)
    end function
