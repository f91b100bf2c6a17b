! The flow solver of potential.f90 on several processes: the stream function psi on linear triangles. Each process has
! its own cells, and no process has the whole mesh. psi is psi_0 on the airfoil and that of the free stream on the far
! field; psi_0 follows from the Kutta condition, that the speeds on both sides of the trailing edge are equal. The
! equations are solved by conjugate gradients, with sums at points that several processes have. Nothing here depends on
! harmorph.
module partitioned_flow
    use, intrinsic :: iso_fortran_env, only: int64
    use mpi_f08
    use read_su2, only: read_su2_mesh, su2_marker, su2_mesh
    use stream_function, apply_own => apply_matrix
    implicit none
    integer :: rank, n_processes
    integer(int64), allocatable :: numbers(:)   ! global numbers of the points
    integer, allocatable :: border(:), place(:) ! points that other processes have too, and their places in the sums
    integer :: n_border                         ! number of border points of all processes
    logical, allocatable :: mine(:)             ! each point counts on one process
    real(dp), allocatable :: inside(:)          ! 1 or 0 at each point

contains

    ! Makes the part of a process: a stripe of the cells of the file. A code for larger meshes reads only this part.
    subroutine read_part(file)
        character(len=*), intent(in) :: file
        type(su2_mesh) :: from
        integer, allocatable :: local(:)
        integer :: k, m, c, first, last, face(2)
        call read_su2_mesh(file, from)
        m = size(from%start) - 1
        first = int(int(m, int64) * rank / n_processes) + 1
        last = int(int(m, int64) * (rank + 1) / n_processes)
        allocate(local(size(from%x)), tri(3, 2 * (last - first + 1)))
        local = 0
        np = 0
        nt = 0
        do k = first, last
            m = from%start(k)
            do c = m, from%start(k + 1) - 1
                if (local(from%cells(c)) > 0) cycle
                np = np + 1
                local(from%cells(c)) = np
            end do
            nt = nt + 1
            tri(:, nt) = local(from%cells(m:m + 2))
            if (from%start(k + 1) - m == 3) cycle
            nt = nt + 1
            tri(:, nt) = local(from%cells([m, m + 2, m + 3]))
        end do
        tri = tri(:, :nt)
        allocate(x(np), y(np), numbers(np), faces(2, 0), marks(0))
        do k = 1, size(local)
            if (local(k) == 0) cycle
            x(local(k)) = from%x(k)
            y(local(k)) = from%y(k)
            numbers(local(k)) = k
        end do
        call turn_counter_clockwise()
        do k = 1, size(from%markers)            ! faces whose cell is in this part
            face = local(from%faces(:, k))
            if (any(face == 0)) cycle
            if (triangle_of(face) == 0) cycle
            faces = reshape([faces, face], [2, size(marks) + 1])
            marks = [marks, merge(airfoil, far_field, from%markers(k) == su2_marker(from, "airfoil"))]
        end do
        call find_border(merge(1, 0, local > 0))
        call find_boundary()
    end subroutine

    ! touched(points of the file) is 1 if the point is in this part. A code for larger meshes has lists of neighbours.
    subroutine find_border(touched)
        integer, intent(in) :: touched(:)
        integer :: k, order(size(touched))
        integer, allocatable :: owner(:)
        call MPI_Allreduce(touched, order, size(touched), MPI_INTEGER, MPI_SUM, MPI_COMM_WORLD)
        n_border = 0
        do k = 1, size(order)
            if (order(k) > 1) n_border = n_border + 1
            order(k) = merge(n_border, 0, order(k) > 1)
        end do
        border = pack([(k, k = 1, np)], order(int(numbers)) > 0)
        place = order(int(numbers(border)))
        allocate(owner(n_border), mine(np))
        owner = n_processes
        owner(place) = rank
        call MPI_Allreduce(MPI_IN_PLACE, owner, n_border, MPI_INTEGER, MPI_MIN, MPI_COMM_WORLD)
        mine = .true.
        mine(border) = owner(place) == rank
    end subroutine

    ! Finds the points of the boundary, also of faces of other processes, the triangles on the airfoil, and the trailing
    ! edge.
    subroutine find_boundary()
        real(dp) :: edge
        call mark_boundary()
        call add_up(on_airfoil)
        call add_up(on_far)
        on_airfoil = min(on_airfoil, 1._dp)
        on_far = min(on_far, 1._dp)
        inside = 1 - on_airfoil - on_far
        edge = maxval(x, mask=on_airfoil > 0)
        call MPI_Allreduce(MPI_IN_PLACE, edge, 1, MPI_DOUBLE_PRECISION, MPI_MAX, MPI_COMM_WORLD)
        call find_wall(edge)
    end subroutine

    ! ---- Sums over all processes --------------------------------------------------------------------------------

    ! Adds the contributions of several processes at their common points.
    subroutine add_up(field)
        real(dp), intent(inout) :: field(:)
        real(dp) :: sums(n_border)
        sums = 0
        sums(place) = field(border)
        call MPI_Allreduce(MPI_IN_PLACE, sums, n_border, MPI_DOUBLE_PRECISION, MPI_SUM, MPI_COMM_WORLD)
        field(border) = sums(place)
    end subroutine

    real(dp) function total(part)
        real(dp), intent(in) :: part
        call MPI_Allreduce(part, total, 1, MPI_DOUBLE_PRECISION, MPI_SUM, MPI_COMM_WORLD)
    end function

    real(dp) function inner(a, b)
        real(dp), intent(in) :: a(:), b(:)
        inner = total(sum(a * b, mask=mine))
    end function

    ! ---- The flow -----------------------------------------------------------------------------------------------

    ! Computes K field, with the contributions of all processes.
    subroutine apply_matrix(field, product)
        real(dp), intent(in) :: field(np)
        real(dp), intent(out) :: product(np)
        call apply_own(field, product)
        call add_up(product)
    end subroutine

    ! Solves K z = -load for the points inside by conjugate gradients with a diagonal preconditioner; z is 0 at other
    ! points.
    subroutine solve_matrix(load, z)
        real(dp), intent(in) :: load(np)
        real(dp), intent(out) :: z(np)
        real(dp), dimension(np) :: r, p, q, diagonal
        real(dp) :: rho, old_rho, goal, length
        integer :: step
        call apply_own(load, q, diagonal)
        call add_up(diagonal)
        z = 0
        r = -load * inside
        p = r / diagonal
        rho = inner(r, p)
        goal = 1e-24_dp * rho
        do step = 1, 20 * 1000
            if (rho <= goal) return
            call apply_matrix(p, q)
            q = q * inside
            length = rho / inner(p, q)
            z = z + length * p
            r = r - length * q
            old_rho = rho
            rho = inner(r, r / diagonal)
            p = r / diagonal + (rho / old_rho) * p
        end do
    end subroutine

    ! Computes the flow on the present mesh: psi, psi_0 and the pressure coefficients cp on the faces of the airfoil.
    subroutine solve_flow()
        real(dp), dimension(np) :: stream, round, product, z
        stream = on_far * (y * cos(alpha) - x * sin(alpha))
        call apply_matrix(stream, product)
        call solve_matrix(product, z)
        stream = stream + z
        call apply_matrix(on_airfoil, product)
        call solve_matrix(product, z)
        round = on_airfoil + z
        psi_0 = -kutta(stream, 0._dp) / kutta(round, 1._dp)
        psi = stream + psi_0 * round
        call find_pressure()
    end subroutine

    real(dp) function objective()
        objective = total(half_square_error())
    end function

    real(dp) function kutta(field, value)
        real(dp), intent(in) :: field(np), value
        kutta = total(speed_difference(field, value))
    end function

    ! ---- The gradient of the objective with respect to the points, by the discrete adjoint ------------------------

    ! Adds the contributions of the own cells and faces; the gradient is their sum over all processes.
    subroutine gradient(gx, gy)
        real(dp), intent(out) :: gx(np), gy(np)
        real(dp), dimension(np) :: by_psi, kutta_by_psi, product, lambda, lambda_k
        real(dp) :: by_speed(nw), by_psi_0, kutta_by_psi_0, mu
        call error_slopes(by_speed, by_psi, by_psi_0)
        call difference_slopes(kutta_by_psi, kutta_by_psi_0)
        call add_up(by_psi)
        call add_up(kutta_by_psi)
        call apply_matrix(on_airfoil, product)
        call solve_matrix(by_psi, lambda)
        call solve_matrix(kutta_by_psi, lambda_k)
        mu = -(total(by_psi_0) + inner(lambda, product)) / (total(kutta_by_psi_0) + inner(lambda_k, product))
        call lagrangian_gradient(lambda + mu * lambda_k, mu, by_speed, gx, gy)
    end subroutine

end module
