! Meshes with known numbers, and what is done with them again and again.
module meshes
    use, intrinsic :: iso_c_binding, only: c_double, c_float, c_int32_t
    use harmorph
    implicit none
    integer, parameter :: dp = c_double
    integer, parameter :: around = 96, rings = 33, n_points = around * rings, n_cells = around * (rings - 1)
    integer, parameter :: body = 7, far_field = 9, n_control = 14

contains

    ! Round a body that Joukowski's mapping makes of a circle: round in front, slender and rounded behind.
    subroutine place(column, ring, x, y)
        integer, intent(in) :: column, ring
        real(dp), intent(out) :: x, y
        complex(dp) :: z
        z = 1.2_dp * 1.12_dp**ring * exp(cmplx(0, 6.283185307179586_dp * modulo(column, around) / around, dp)) - 0.08_dp
        z = 0.25_dp * (z + 1 / z)
        x = real(z, dp)
        y = aimag(z)
    end subroutine

    subroutine make_points(x, y)
        real(dp), intent(out) :: x(n_points), y(n_points)
        integer :: i, j
        do j = 0, rings - 1
            do i = 0, around - 1
                call place(i, j, x(1 + i + around * j), y(1 + i + around * j))
            end do
        end do
    end subroutine

    subroutine make_cells(cells, faces, markers)
        integer(c_int32_t), intent(out) :: cells(4, n_cells), faces(2, 2 * around), markers(2 * around)
        integer :: i, j, next
        do i = 0, around - 1
            next = modulo(i + 1, around)
            do j = 0, rings - 2
                cells(:, 1 + i + around * j) = 1 + [i + around * j, i + around * (j + 1), next + around * (j + 1), &
                    next + around * j]
            end do
            faces(:, 1 + i) = 1 + [i, next]
            faces(:, 1 + around + i) = 1 + around * (rings - 1) + [i, next]
        end do
        markers(:around) = body
        markers(around + 1:) = far_field
    end subroutine

    ! A smooth, repeatable movement.
    function some_move() result(move)
        real(dp) :: move(2, n_control)
        integer :: k
        do k = 1, n_control
            move(:, k) = 0.01_dp * [sin(1.7_dp * k), cos(2.9_dp * k)]
        end do
    end function

    subroutine solve(mesh, basis, first, options)
        type(hm_mesh), intent(in) :: mesh
        type(hm_basis), intent(inout) :: basis
        integer, intent(in), optional :: first                  ! what the mesh counts from
        type(hm_options), intent(in), optional :: options
        type(hm_curves) :: curves
        type(hm_plan) :: plan
        integer, allocatable :: wall(:)
        real(dp), target :: x(n_points), y(n_points)
        logical :: loop
        call make_points(x, y)
        call plan%analyse(mesh)
        call plan%boundary([body], wall, loop)
        if (present(first)) wall = wall - first + 1
        call curves%fit(x(wall), y(wall), loop, n_control=n_control)
        call plan%analyse(mesh, curves, [hm_condition(body)], options=options)
        call plan%factor()
        call basis%free()
        call plan%solve(basis)
    end subroutine

    ! The control points' movements that turn them about the origin.
    function turn(control, degrees) result(move)
        real(dp), intent(in) :: control(:, :), degrees
        real(dp) :: move(2, size(control, 2)), c, s
        c = cos(degrees * 0.017453292519943295_dp)
        s = sin(degrees * 0.017453292519943295_dp)
        move(1, :) = (c - 1) * control(1, :) - s * control(2, :)
        move(2, :) = s * control(1, :) + (c - 1) * control(2, :)
    end function

    ! Squares in a channel of 20 by 10 with a hole of 4 by 2: markers 1 to 4 below, right, above, left; 5: the hole.
    subroutine make_channel(x, y, cells, n_cells, faces, markers, n_faces)
        real(dp), intent(out) :: x(:), y(:)
        integer(c_int32_t), intent(out) :: cells(:, :), faces(:, :), markers(:)
        integer, intent(out) :: n_cells, n_faces
        integer :: i, j, side
        integer(c_int32_t) :: corner(5)
        logical :: outside(4)
        x = [((i, i = 0, 20), j = 0, 10)]
        y = [((j, i = 0, 20), j = 0, 10)]
        n_cells = 0
        n_faces = 0
        do j = 1, 10
            do i = 1, 20
                if (in_hole(i, j)) cycle
                corner = i + 21 * (j - 1) + [0, 1, 22, 21, 0]
                n_cells = n_cells + 1
                cells(:, n_cells) = corner(:4)
                outside = [j == 1, i == 20, j == 10, i == 1]
                do side = 1, 4
                    if (outside(side)) call add_face(side)
                end do
                if (in_hole(i, j - 1)) call add_face(1, 5)
                if (in_hole(i + 1, j)) call add_face(2, 5)
                if (in_hole(i, j + 1)) call add_face(3, 5)
                if (in_hole(i - 1, j)) call add_face(4, 5)
            end do
        end do

    contains

        logical function in_hole(i, j)
            integer, intent(in) :: i, j
            in_hole = i >= 9 .and. i <= 12 .and. j >= 5 .and. j <= 6
        end function

        subroutine add_face(side, marker)
            integer, intent(in) :: side
            integer, intent(in), optional :: marker
            n_faces = n_faces + 1
            faces(:, n_faces) = corner(side:side + 1)
            markers(n_faces) = int(side, c_int32_t)
            if (present(marker)) markers(n_faces) = int(marker, c_int32_t)
        end subroutine
    end subroutine

    logical function same(a, b)
        real(dp), intent(in) :: a(:), b(:)
        same = all(a >= b .and. a <= b)
    end function

    ! No number, and one that traps when it is converted, as arrays may hold before results are written into them.
    real(c_float) function signaling()
        signaling = transfer(2139095041_c_int32_t, 0._c_float)
    end function
end module
