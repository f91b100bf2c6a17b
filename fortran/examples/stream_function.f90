! Potential flow by the stream function psi on linear triangles: this module has the parts that do not depend on the
! solution method and on the distribution of triangles among processes. potential.f90 and partitioned_flow.f90 solve the
! equations. psi is psi_0 on the airfoil; all sums are over the triangles and faces in these arrays.
module stream_function
    use, intrinsic :: iso_fortran_env, only: dp => real64
    implicit none
    integer, parameter :: airfoil = 1, far_field = 2
    integer :: np, nt, nw                       ! numbers of points, triangles, faces of the airfoil
    real(dp), allocatable, target :: x(:), y(:)
    integer, allocatable, target :: tri(:, :), faces(:, :), marks(:)    ! triangles counter-clockwise
    integer, allocatable :: wall(:, :)          ! (3,nw) triangles on the airfoil: points of the face, third point
    integer, allocatable :: te(:)               ! the faces at the trailing edge that are in this part
    real(dp), allocatable :: on_airfoil(:), on_far(:)                   ! 1 or 0 at each point
    real(dp), allocatable :: psi(:), cp(:), cp_target(:), weight(:)     ! weight: lengths of the faces
    real(dp) :: alpha = 0.035_dp, psi_0         ! incidence, 2 degrees

contains

    ! Twice the area of a triangle.
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

    subroutine turn_counter_clockwise()
        integer :: i
        do i = 1, nt
            if (area2(tri(:, i)) < 0) tri(:, i) = tri([1, 3, 2], i)
        end do
    end subroutine

    ! The triangle at a face, or 0 if there is none.
    integer function triangle_of(face)
        integer, intent(in) :: face(2)
        do triangle_of = nt, 1, -1
            if (any(tri(:, triangle_of) == face(1)) .and. any(tri(:, triangle_of) == face(2))) return
        end do
    end function

    ! Finds the triangles on the airfoil; edge is the largest x of the airfoil.
    subroutine find_wall(edge)
        real(dp), intent(in) :: edge
        integer :: k, t
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

    ! 1 at the points of these faces, 0 elsewhere.
    subroutine mark_boundary()
        integer :: k
        allocate(on_airfoil(np), on_far(np))
        on_airfoil = 0
        on_far = 0
        do k = 1, size(marks)
            if (marks(k) == airfoil) on_airfoil(faces(:, k)) = 1
            if (marks(k) == far_field) on_far(faces(:, k)) = 1
        end do
    end subroutine

    ! Compute K field, and the diagonal of K.
    subroutine apply_matrix(field, product, diagonal)
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

    ! The speed along face k of the airfoil is this times psi(third point) - psi_0.
    real(dp) function steepness(k)
        integer, intent(in) :: k
        steepness = norm2([x(wall(1, k)) - x(wall(2, k)), y(wall(1, k)) - y(wall(2, k))]) / area2(wall(:, k))
    end function

    real(dp) function speed(k)
        integer, intent(in) :: k
        speed = steepness(k) * (psi(wall(3, k)) - psi_0)
    end function

    ! The difference of the speeds on both sides of the trailing edge; the loop of faces runs against one of them.
    real(dp) function speed_difference(field, value) result(difference)
        real(dp), intent(in) :: field(np), value
        integer :: k
        difference = 0
        do k = 1, size(te)
            difference = difference + steepness(te(k)) * (field(wall(3, te(k))) - value)
        end do
    end function

    subroutine find_pressure()
        integer :: k
        cp = [(1 - speed(k)**2, k = 1, nw)]
    end subroutine

    real(dp) function half_square_error()
        half_square_error = 0.5_dp * sum(weight * (cp - cp_target)**2)
    end function

    ! ---- Derivatives ----------------------------------------------------------------------------------------------

    ! The derivatives of half_square_error with respect to the speeds, to psi and to psi_0.
    subroutine error_slopes(by_speed, by_psi, by_psi_0)
        real(dp), intent(out) :: by_speed(nw), by_psi(np), by_psi_0
        integer :: k
        by_psi = 0
        by_psi_0 = 0
        do k = 1, nw
            by_speed(k) = -2 * weight(k) * (cp(k) - cp_target(k)) * speed(k)
            by_psi(wall(3, k)) = by_psi(wall(3, k)) + by_speed(k) * steepness(k)
            by_psi_0 = by_psi_0 - by_speed(k) * steepness(k)
        end do
    end subroutine

    ! The derivatives of speed_difference with respect to psi and to psi_0.
    subroutine difference_slopes(by_psi, by_psi_0)
        real(dp), intent(out) :: by_psi(np), by_psi_0
        integer :: k
        by_psi = 0
        by_psi_0 = 0
        do k = 1, size(te)
            by_psi(wall(3, te(k))) = by_psi(wall(3, te(k))) + steepness(te(k))
            by_psi_0 = by_psi_0 - steepness(te(k))
        end do
    end subroutine

    ! The derivatives of the Lagrangian, lambda K psi + the errors of the speeds + mu speed_difference, with respect to
    ! the coordinates, including the psi of the free stream, which depends on the position of the far field.
    subroutine lagrangian_gradient(lambda, mu, by_speed, gx, gy)
        real(dp), intent(in) :: lambda(np), mu, by_speed(nw)
        real(dp), intent(out) :: gx(np), gy(np)
        real(dp) :: product(np)
        integer :: k
        gx = 0
        gy = 0
        call add_matrix_gradient(lambda, gx, gy)
        do k = 1, nw
            call add_steepness_gradient(k, by_speed(k) * (psi(wall(3, k)) - psi_0), gx, gy)
        end do
        do k = 1, size(te)
            call add_steepness_gradient(te(k), mu * (psi(wall(3, te(k))) - psi_0), gx, gy)
        end do
        call apply_matrix(lambda, product)
        gx = gx - on_far * product * sin(alpha)
        gy = gy + on_far * product * cos(alpha)
    end subroutine

    ! The derivatives of lambda K psi. In each triangle it is (p r + q s) / (2 area2), with p = sum b psi, q = sum c
    ! psi, r, s of lambda.
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
            u = cshift(psi(t), -1) - cshift(psi(t), 1)          ! derivatives of p by y and of -q by x
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
