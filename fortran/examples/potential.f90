! A flow solver as there are many: incompressible potential flow round an airfoil, by the stream function psi on linear
! triangles. Laplace's equation inside; psi = psi_0 on the airfoil; the free stream on the far field; psi_0 from the
! condition of Kutta, that the speeds on both sides of the trailing edge are equal. Unknowns in the mesh's order, matrix
! in profile storage, Cholesky. Nothing here knows of harmorph.
module potential
    use, intrinsic :: iso_fortran_env, only: dp => real64
    use read_su2, only: read_su2_mesh, su2_marker, su2_mesh
    implicit none
    integer, parameter :: airfoil = 1, far_field = 2
    integer :: np, nc, nf, nt, nw, nu           ! points, cells, faces, triangles, faces of the airfoil, unknowns
    real(dp), allocatable, target :: x(:), y(:)
    integer, allocatable, target :: cells(:, :), faces(:, :), marks(:)  ! a triangle among the quads repeats its last point
    integer, allocatable :: tri(:, :)           ! the cells as triangles, counter-clockwise
    integer, allocatable :: wall(:, :)          ! (3,nw) triangles on the airfoil: the face's points, then the third one
    integer :: te(2)                            ! the two faces at the trailing edge
    integer, allocatable :: unknown(:)          ! of each point, or 0
    integer, allocatable :: first(:), place(:)  ! of each row: its first column, and where column 0 would lie in a
    real(dp), allocatable :: a(:)
    real(dp), allocatable :: psi(:), cp(:), cp_target(:), weight(:)
    real(dp) :: alpha = 0.035_dp, psi_0         ! incidence, 2 degrees

contains

    subroutine read_mesh(file)
        character(len=*), intent(in) :: file
        type(su2_mesh) :: from
        integer :: k, m
        call read_su2_mesh(file, from)
        np = size(from%x)
        nc = size(from%start) - 1
        nf = size(from%markers)
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

    ! Triangles, unknowns, profile.
    subroutine prepare()
        integer :: i, k, m, low
        logical :: on_face(2)
        allocate(tri(3, 2 * nc), unknown(np), psi(np))
        nt = 0
        do i = 1, nc
            nt = nt + 1
            tri(:, nt) = cells(:3, i)
            if (cells(3, i) /= cells(4, i)) then
                nt = nt + 1
                tri(:, nt) = cells([1, 3, 4], i)
            end if
        end do
        do i = 1, nt
            if (area2(tri(:, i)) < 0) tri(:, i) = tri([1, 3, 2], i)
        end do

        unknown = 1
        do i = 1, nf
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

        nw = count(marks == airfoil)
        allocate(wall(3, nw), cp(nw), cp_target(nw), weight(nw))
        do k = 1, nw
            do i = 1, nt
                on_face = [any(tri(:, i) == faces(1, k)), any(tri(:, i) == faces(2, k))]
                if (all(on_face)) exit
            end do
            do while (any(tri(3, i) == faces(:, k)))
                tri(:, i) = tri([2, 3, 1], i)
            end do
            wall(:, k) = tri(:, i)
            weight(k) = norm2([x(wall(1, k)) - x(wall(2, k)), y(wall(1, k)) - y(wall(2, k))])
        end do
        i = maxloc(x(wall(1, :)), 1)
        i = wall(1, i)
        te(1) = findloc(wall(1, :), i, 1)
        te(2) = findloc(wall(2, :), i, 1)
    end subroutine

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

    ! K field, at all points.
    subroutine apply_matrix(field, product)
        real(dp), intent(in) :: field(np)
        real(dp), intent(out) :: product(np)
        integer :: i
        real(dp) :: b(3), c(3), area4
        product = 0
        do i = 1, nt
            call shape_gradients(tri(:, i), b, c)
            area4 = 2 * area2(tri(:, i))
            product(tri(:, i)) = product(tri(:, i)) + (b * sum(b * field(tri(:, i))) + c * sum(c * field(tri(:, i)))) / area4
        end do
    end subroutine

    ! Solves K z = -load for the unknowns; 0 at the other points.
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

    ! The speed along face k of the airfoil is this times psi(third point) - psi_0.
    real(dp) function steepness(k)
        integer, intent(in) :: k
        steepness = norm2([x(wall(1, k)) - x(wall(2, k)), y(wall(1, k)) - y(wall(2, k))]) / area2(wall(:, k))
    end function

    ! Difference of the speeds on both sides of the trailing edge; the loop runs against one of them.
    real(dp) function kutta(field, value)
        real(dp), intent(in) :: field(np), value
        kutta = steepness(te(1)) * (field(wall(3, te(1))) - value) + steepness(te(2)) * (field(wall(3, te(2))) - value)
    end function

    ! The flow on the mesh as it is: psi, psi_0 and the pressure coefficients cp on the airfoil's faces.
    subroutine solve_flow()
        real(dp) :: stream(np), round(np), product(np), z(np)
        integer :: i, k
        call factor_matrix()
        stream = 0
        round = 0
        do i = 1, nf
            if (marks(i) == far_field) stream(faces(:, i)) = y(faces(:, i)) * cos(alpha) - x(faces(:, i)) * sin(alpha)
            if (marks(i) == airfoil) round(faces(:, i)) = 1
        end do
        call apply_matrix(stream, product)
        call solve_matrix(product, z)
        stream = stream + z
        call apply_matrix(round, product)
        call solve_matrix(product, z)
        round = round + z
        psi_0 = -kutta(stream, 0._dp) / kutta(round, 1._dp)
        psi = stream + psi_0 * round
        do k = 1, nw
            cp(k) = 1 - (steepness(k) * (psi(wall(3, k)) - psi_0))**2
        end do
    end subroutine

    real(dp) function objective()
        objective = 0.5_dp * sum(weight * (cp - cp_target)**2)
    end function

    ! The objective's gradient by the coordinates of all points, by the discrete adjoint of all of the above.
    subroutine gradient(gx, gy)
        real(dp), intent(out) :: gx(np), gy(np)
        real(dp) :: by_speed(nw), by_psi(np), by_psi_0, kutta_by_psi(np), kutta_by_psi_0, round(np), product(np)
        real(dp) :: lambda(np), lambda_k(np), mu
        integer :: i, k
        by_psi = 0
        by_psi_0 = 0
        kutta_by_psi = 0
        kutta_by_psi_0 = 0
        do k = 1, nw
            by_speed(k) = -2 * weight(k) * (cp(k) - cp_target(k)) * steepness(k) * (psi(wall(3, k)) - psi_0)
            by_psi(wall(3, k)) = by_psi(wall(3, k)) + by_speed(k) * steepness(k)
            by_psi_0 = by_psi_0 - by_speed(k) * steepness(k)
        end do
        do k = 1, 2
            kutta_by_psi(wall(3, te(k))) = kutta_by_psi(wall(3, te(k))) + steepness(te(k))
            kutta_by_psi_0 = kutta_by_psi_0 - steepness(te(k))
        end do
        round = 0
        do i = 1, nf
            if (marks(i) == airfoil) round(faces(:, i)) = 1
        end do
        call apply_matrix(round, product)
        call solve_matrix(by_psi, lambda)
        call solve_matrix(kutta_by_psi, lambda_k)
        mu = -(by_psi_0 + sum(lambda * product)) / (kutta_by_psi_0 + sum(lambda_k * product))
        lambda = lambda + mu * lambda_k

        gx = 0
        gy = 0
        call add_matrix_gradient(lambda, gx, gy)
        do k = 1, nw
            call add_steepness_gradient(k, by_speed(k) * (psi(wall(3, k)) - psi_0), gx, gy)
        end do
        do k = 1, 2
            call add_steepness_gradient(te(k), mu * (psi(wall(3, te(k))) - psi_0), gx, gy)
        end do
        round = 0                               ! the free stream's psi depends on where the far field is
        do i = 1, nf
            if (marks(i) == far_field) round(faces(:, i)) = 1
        end do
        call apply_matrix(lambda, product)
        gx = gx - round * product * sin(alpha)
        gy = gy + round * product * cos(alpha)
    end subroutine

    ! Of lambda K psi. In each triangle it is (p r + q s) / (2 area2), with p = sum b psi, q = sum c psi, r, s of lambda.
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
