! The flow solver of potential.f90 on several processes: the stream function psi on linear triangles, each process with
! its own cells and no process with the mesh. psi = psi_0 on the airfoil; the free stream on the far field; psi_0 from
! the Kutta condition, that the speeds on both sides of the trailing edge are equal. Conjugate gradients; sums at points
! that several processes have. Nothing here knows of harmorph.
module partitioned_flow
    use, intrinsic :: iso_fortran_env, only: dp => real64, int64
    use mpi_f08
    use read_su2, only: read_su2_mesh, su2_marker, su2_mesh
    implicit none
    integer, parameter :: airfoil = 1, far_field = 2
    integer :: rank, n_processes, np, nt, nw    ! points, triangles, faces of the airfoil here
    real(dp), allocatable, target :: x(:), y(:)
    integer, allocatable, target :: tri(:, :), faces(:, :), marks(:)
    integer(int64), allocatable :: numbers(:)   ! global numbers of the points
    integer, allocatable :: wall(:, :)          ! (3,nw) triangles on the airfoil: the face's points, then the third one
    integer, allocatable :: te(:)               ! those of the two faces at the trailing edge that are here
    integer, allocatable :: border(:), place(:) ! points that other processes have too, and their places in the sums
    integer :: n_border                         ! of all processes
    logical, allocatable :: mine(:)             ! of these points each counts on one process
    real(dp), allocatable :: on_airfoil(:), on_far(:), inside(:)        ! 1 or 0 at each point
    real(dp), allocatable :: psi(:), cp(:), cp_target(:), weight(:)
    real(dp) :: alpha = 0.035_dp, psi_0         ! incidence, 2 degrees

contains

    ! The part of a process: a stripe of the file's cells. A code with larger meshes reads no more than this.
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
        do k = 1, nt
            if (area2(tri(:, k)) < 0) tri(:, k) = tri([1, 3, 2], k)
        end do
        do k = 1, size(from%markers)            ! faces whose cell is here
            face = local(from%faces(:, k))
            if (any(face == 0)) cycle
            if (triangle_of(face) == 0) cycle
            faces = reshape([faces, face], [2, size(marks) + 1])
            marks = [marks, merge(airfoil, far_field, from%markers(k) == su2_marker(from, "airfoil"))]
        end do
        call find_border(merge(1, 0, local > 0))
        call find_boundary()
    end subroutine

    integer function triangle_of(face)
        integer, intent(in) :: face(2)
        do triangle_of = nt, 1, -1
            if (any(tri(:, triangle_of) == face(1)) .and. any(tri(:, triangle_of) == face(2))) return
        end do
    end function

    ! touched(points of the file): 1 if the point is here. A code with larger meshes has lists of its neighbours.
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

    ! Points of the boundary, also of faces that other processes have; triangles on the airfoil; the trailing edge.
    subroutine find_boundary()
        integer :: k, t
        real(dp) :: edge
        allocate(on_airfoil(np), on_far(np), psi(np))
        on_airfoil = 0
        on_far = 0
        do k = 1, size(marks)
            if (marks(k) == airfoil) on_airfoil(faces(:, k)) = 1
            if (marks(k) == far_field) on_far(faces(:, k)) = 1
        end do
        call add_up(on_airfoil)
        call add_up(on_far)
        on_airfoil = min(on_airfoil, 1._dp)
        on_far = min(on_far, 1._dp)
        inside = 1 - on_airfoil - on_far
        edge = maxval(x, mask=on_airfoil > 0)
        call MPI_Allreduce(MPI_IN_PLACE, edge, 1, MPI_DOUBLE_PRECISION, MPI_MAX, MPI_COMM_WORLD)
        nw = 0
        allocate(wall(3, count(marks == airfoil)), te(0))
        do k = 1, size(marks)
            if (marks(k) /= airfoil) cycle
            t = triangle_of(faces(:, k))
            do while (any(tri(3, t) == faces(:, k)))
                tri(:, t) = tri([2, 3, 1], t)
            end do
            nw = nw + 1
            wall(:, nw) = tri(:, t)
            if (any(x(faces(:, k)) >= edge)) te = [te, nw]
        end do
        weight = hypot(x(wall(1, :)) - x(wall(2, :)), y(wall(1, :)) - y(wall(2, :)))
        allocate(cp(nw), cp_target(nw))
    end subroutine

    ! ---- Sums over all processes --------------------------------------------------------------------------------

    ! Contributions at the points of several processes.
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

    ! Twice the area.
    real(dp) function area2(t)
        integer, intent(in) :: t(3)
        area2 = (x(t(2)) - x(t(1))) * (y(t(3)) - y(t(1))) - (x(t(3)) - x(t(1))) * (y(t(2)) - y(t(1)))
    end function

    ! b(m)/area2, c(m)/area2 is the gradient of the linear function that is 1 at corner m.
    subroutine shape_gradients(t, b, c)
        integer, intent(in) :: t(3)
        real(dp), intent(out) :: b(3), c(3)
        b = [y(t(2)) - y(t(3)), y(t(3)) - y(t(1)), y(t(1)) - y(t(2))]
        c = [x(t(3)) - x(t(2)), x(t(1)) - x(t(3)), x(t(2)) - x(t(1))]
    end subroutine

    ! K field of the own cells, at all points; its diagonal.
    subroutine apply_own(field, product, diagonal)
        real(dp), intent(in) :: field(np)
        real(dp), intent(out) :: product(np)
        real(dp), intent(out), optional :: diagonal(np)
        real(dp) :: b(3), c(3), area4
        integer :: i, t(3)
        product = 0
        if (present(diagonal)) diagonal = 0
        do i = 1, nt
            t = tri(:, i)
            call shape_gradients(t, b, c)
            area4 = 2 * area2(t)
            product(t) = product(t) + (b * sum(b * field(t)) + c * sum(c * field(t))) / area4
            if (present(diagonal)) diagonal(t) = diagonal(t) + (b**2 + c**2) / area4
        end do
    end subroutine

    ! K field of all processes.
    subroutine apply_matrix(field, product)
        real(dp), intent(in) :: field(np)
        real(dp), intent(out) :: product(np)
        call apply_own(field, product)
        call add_up(product)
    end subroutine

    ! Solves K z = -load for the points inside; 0 at the others. Conjugate gradients, preconditioned by the diagonal.
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

    ! The speed along face k of the airfoil is this times psi(third point) - psi_0.
    real(dp) function steepness(k)
        integer, intent(in) :: k
        steepness = norm2([x(wall(1, k)) - x(wall(2, k)), y(wall(1, k)) - y(wall(2, k))]) / area2(wall(:, k))
    end function

    ! Difference of the speeds on both sides of the trailing edge; the loop runs against one of them.
    real(dp) function kutta(field, value)
        real(dp), intent(in) :: field(np), value
        integer :: k
        kutta = 0
        do k = 1, size(te)
            kutta = kutta + steepness(te(k)) * (field(wall(3, te(k))) - value)
        end do
        kutta = total(kutta)
    end function

    ! The flow on the mesh as it is: psi, psi_0 and the pressure coefficients cp on the airfoil's faces.
    subroutine solve_flow()
        real(dp), dimension(np) :: stream, round, product, z
        integer :: k
        stream = on_far * (y * cos(alpha) - x * sin(alpha))
        call apply_matrix(stream, product)
        call solve_matrix(product, z)
        stream = stream + z
        call apply_matrix(on_airfoil, product)
        call solve_matrix(product, z)
        round = on_airfoil + z
        psi_0 = -kutta(stream, 0._dp) / kutta(round, 1._dp)
        psi = stream + psi_0 * round
        do k = 1, nw
            cp(k) = 1 - (steepness(k) * (psi(wall(3, k)) - psi_0))**2
        end do
    end subroutine

    real(dp) function objective()
        objective = total(0.5_dp * sum(weight * (cp - cp_target)**2))
    end function

    ! ---- The objective's gradient by the points, by the discrete adjoint of all of the above ----------------------

    ! Contributions of the own cells and faces: the gradient is their sum over all processes.
    subroutine gradient(gx, gy)
        real(dp), intent(out) :: gx(np), gy(np)
        real(dp), dimension(np) :: by_psi, kutta_by_psi, product, lambda, lambda_k
        real(dp) :: by_speed(nw), by_psi_0, kutta_by_psi_0, mu
        integer :: k
        by_psi = 0
        kutta_by_psi = 0
        by_psi_0 = 0
        kutta_by_psi_0 = 0
        do k = 1, nw
            by_speed(k) = -2 * weight(k) * (cp(k) - cp_target(k)) * steepness(k) * (psi(wall(3, k)) - psi_0)
            by_psi(wall(3, k)) = by_psi(wall(3, k)) + by_speed(k) * steepness(k)
            by_psi_0 = by_psi_0 - by_speed(k) * steepness(k)
        end do
        do k = 1, size(te)
            kutta_by_psi(wall(3, te(k))) = kutta_by_psi(wall(3, te(k))) + steepness(te(k))
            kutta_by_psi_0 = kutta_by_psi_0 - steepness(te(k))
        end do
        call add_up(by_psi)
        call add_up(kutta_by_psi)
        call apply_matrix(on_airfoil, product)
        call solve_matrix(by_psi, lambda)
        call solve_matrix(kutta_by_psi, lambda_k)
        mu = -(total(by_psi_0) + inner(lambda, product)) / (total(kutta_by_psi_0) + inner(lambda_k, product))
        lambda = lambda + mu * lambda_k

        gx = 0
        gy = 0
        call add_matrix_gradient(lambda, gx, gy)
        do k = 1, nw
            call add_steepness_gradient(k, by_speed(k) * (psi(wall(3, k)) - psi_0), gx, gy)
        end do
        do k = 1, size(te)
            call add_steepness_gradient(te(k), mu * (psi(wall(3, te(k))) - psi_0), gx, gy)
        end do
        call apply_own(lambda, product)         ! the free stream's psi depends on where the far field is
        gx = gx - on_far * product * sin(alpha)
        gy = gy + on_far * product * cos(alpha)
    end subroutine

    ! Of lambda K psi. In each triangle it is (p r + q s) / (2 area2), with p = sum b psi, q = sum c psi, r, s of
    ! lambda.
    subroutine add_matrix_gradient(lambda, gx, gy)
        real(dp), intent(in) :: lambda(np)
        real(dp), intent(inout) :: gx(np), gy(np)
        real(dp) :: b(3), c(3), twice, energy, u(3), v(3), p, q, r, s
        integer :: i, t(3)
        do i = 1, nt
            t = tri(:, i)
            call shape_gradients(t, b, c)
            twice = area2(t)
            p = sum(b * psi(t))
            q = sum(c * psi(t))
            r = sum(b * lambda(t))
            s = sum(c * lambda(t))
            energy = (p * r + q * s) / (2 * twice)
            u = cshift(psi(t), -1) - cshift(psi(t), 1)          ! of p by y, and of -q by x
            v = cshift(lambda(t), -1) - cshift(lambda(t), 1)
            gx(t) = gx(t) - (u * s + v * q) / (2 * twice) - energy * b / twice
            gy(t) = gy(t) + (u * r + v * p) / (2 * twice) - energy * c / twice
        end do
    end subroutine

    subroutine add_steepness_gradient(k, factor, gx, gy)
        integer, intent(in) :: k
        real(dp), intent(in) :: factor
        real(dp), intent(inout) :: gx(np), gy(np)
        real(dp) :: b(3), c(3), dx, dy, length, twice
        integer :: t(3)
        t = wall(:, k)
        call shape_gradients(t, b, c)
        dx = x(t(1)) - x(t(2))
        dy = y(t(1)) - y(t(2))
        length = norm2([dx, dy])
        twice = area2(t)
        gx(t) = gx(t) + factor * ([dx, -dx, 0._dp] / (length * twice) - length * b / twice**2)
        gy(t) = gy(t) + factor * ([dy, -dy, 0._dp] / (length * twice) - length * c / twice**2)
    end subroutine
end module
