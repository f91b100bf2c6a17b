! A typical flow solver: incompressible potential flow around an airfoil, by the stream function psi on linear
! triangles. psi satisfies Laplace's equation inside; it is psi_0 on the airfoil and that of the free stream on the far
! field; psi_0 follows from the Kutta condition, that the speeds on both sides of the trailing edge are equal. The
! unknowns have the order of the mesh, and the matrix in profile storage is factored by Cholesky's method. Nothing here
! depends on harmorph.
module potential
    use read_su2, only: read_su2_mesh, su2_marker, su2_mesh
    use stream_function
    implicit none
    integer :: nc, nu                           ! cells, unknowns
    integer, allocatable, target :: cells(:, :) ! a triangle among the quads repeats its last point
    integer, allocatable :: unknown(:)          ! the unknown of each point, or 0
    integer, allocatable :: first(:), place(:)  ! of each row: first column, place of column 0 in a
    real(dp), allocatable :: a(:)

contains

    subroutine read_mesh(file)
        character(len=*), intent(in) :: file
        type(su2_mesh) :: from
        integer :: k, m
        call read_su2_mesh(file, from)
        np = size(from%x)
        nc = size(from%start) - 1
        x = from%x
        y = from%y
        allocate(cells(4, nc))
        do k = 1, nc
            m = from%start(k + 1) - from%start(k)
            cells(:m, k) = from%cells(from%start(k):from%start(k + 1) - 1)
            if (m == 3) cells(4, k) = cells(3, k)
        end do
        faces = from%faces
        marks = merge(airfoil, far_field, from%markers == su2_marker(from, "airfoil"))
        call prepare()
    end subroutine

    ! Makes the triangles, the unknowns and the profile.
    subroutine prepare()
        integer :: i, k, m, low
        allocate(tri(3, 2 * nc), unknown(np))
        nt = 0
        do i = 1, nc
            nt = nt + 1
            tri(:, nt) = cells(:3, i)
            if (cells(3, i) /= cells(4, i)) then
                nt = nt + 1
                tri(:, nt) = cells([1, 3, 4], i)
            end if
        end do
        call turn_counter_clockwise()

        unknown = 1
        do i = 1, size(marks)
            unknown(faces(:, i)) = 0
        end do
        nu = 0
        do i = 1, np
            if (unknown(i) == 0) cycle
            nu = nu + 1
            unknown(i) = nu
        end do
        allocate(first(nu), place(nu))
        first = [(i, i = 1, nu)]
        do i = 1, nt
            low = minval(unknown(tri(:, i)), mask=unknown(tri(:, i)) > 0)
            do k = 1, 3
                m = unknown(tri(k, i))
                if (m > 0) first(m) = min(first(m), low)
            end do
        end do
        k = 0
        do i = 1, nu
            place(i) = k - first(i) + 1
            k = k + i - first(i) + 1
        end do
        allocate(a(k))

        call mark_boundary()
        call find_wall(maxval(x, mask=on_airfoil > 0))
    end subroutine

    subroutine factor_matrix()
        integer :: i, j, k, m, n, low
        real(dp) :: b(3), c(3), area4
        a = 0
        do i = 1, nt
            call shape_gradients(tri(:, i), b, c)
            area4 = 2 * area2(tri(:, i))
            do k = 1, 3
                m = unknown(tri(k, i))
                if (m == 0) cycle
                do j = 1, 3
                    n = unknown(tri(j, i))
                    if (n > 0 .and. n <= m) a(place(m) + n) = a(place(m) + n) + (b(k) * b(j) + c(k) * c(j)) / area4
                end do
            end do
        end do
        do i = 1, nu
            do j = first(i), i
                low = max(first(i), first(j))
                a(place(i) + j) = a(place(i) + j) - dot_product(a(place(i) + low:place(i) + j - 1), &
                    a(place(j) + low:place(j) + j - 1))
                if (j < i) a(place(i) + j) = a(place(i) + j) / a(place(j) + j)
            end do
            a(place(i) + i) = sqrt(a(place(i) + i))
        end do
    end subroutine

    ! Solves K z = -load for the unknowns; z is 0 at the other points.
    subroutine solve_matrix(load, z)
        real(dp), intent(in) :: load(np)
        real(dp), intent(out) :: z(np)
        real(dp) :: v(nu)
        integer :: i
        do i = 1, np
            if (unknown(i) > 0) v(unknown(i)) = -load(i)
        end do
        do i = 1, nu
            v(i) = (v(i) - dot_product(a(place(i) + first(i):place(i) + i - 1), v(first(i):i - 1))) / a(place(i) + i)
        end do
        do i = nu, 1, -1
            v(i) = v(i) / a(place(i) + i)
            v(first(i):i - 1) = v(first(i):i - 1) - v(i) * a(place(i) + first(i):place(i) + i - 1)
        end do
        z = 0
        do i = 1, np
            if (unknown(i) > 0) z(i) = v(unknown(i))
        end do
    end subroutine

    ! Computes the flow on the present mesh: psi, psi_0 and the pressure coefficients cp on the faces of the airfoil.
    subroutine solve_flow()
        real(dp), dimension(np) :: stream, round, product, z
        call factor_matrix()
        stream = on_far * (y * cos(alpha) - x * sin(alpha))
        call apply_matrix(stream, product)
        call solve_matrix(product, z)
        stream = stream + z
        call apply_matrix(on_airfoil, product)
        call solve_matrix(product, z)
        round = on_airfoil + z
        psi_0 = -speed_difference(stream, 0._dp) / speed_difference(round, 1._dp)
        psi = stream + psi_0 * round
        call find_pressure()
    end subroutine

    real(dp) function objective()
        objective = half_square_error()
    end function

    ! Computes the gradient of the objective with respect to the coordinates of all points, by the discrete adjoint.
    subroutine gradient(gx, gy)
        real(dp), intent(out) :: gx(np), gy(np)
        real(dp), dimension(np) :: by_psi, kutta_by_psi, product, lambda, lambda_k
        real(dp) :: by_speed(nw), by_psi_0, kutta_by_psi_0, mu
        call error_slopes(by_speed, by_psi, by_psi_0)
        call difference_slopes(kutta_by_psi, kutta_by_psi_0)
        call apply_matrix(on_airfoil, product)
        call solve_matrix(by_psi, lambda)
        call solve_matrix(kutta_by_psi, lambda_k)
        mu = -(by_psi_0 + sum(lambda * product)) / (kutta_by_psi_0 + sum(lambda_k * product))
        call lagrangian_gradient(lambda + mu * lambda_k, mu, by_speed, gx, gy)
    end subroutine
end module
