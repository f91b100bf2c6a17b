! A solver with three dimensions and a structured mesh one cell thick in y: an O-mesh around an ellipse, x(i,j,k).
program one_cell_thick
    use, intrinsic :: iso_fortran_env, only: dp => real64
    use harmorph
    implicit none
    integer, parameter :: ni = 97, nj = 33, wall = 1, far = 2
    real(dp), dimension(ni, nj, 2) :: x, y, z, dj_dx, dj_dy, dj_dz
    integer :: faces(4, (ni - 1) * (nj - 1)), sides(4, 2 * (ni - 1)), markers(2 * (ni - 1))
    real(dp) :: dx(ni, nj), dy(ni, nj), move(2, 12), gradient(2, 12), angle, r
    type(hm_plane) :: plane
    type(hm_mesh) :: mesh
    type(hm_curves) :: curves
    type(hm_plan) :: plan
    type(hm_basis) :: basis
    type(hm_quality_report) :: quality
    integer :: i, j, n

    n = 0
    do j = 1, nj
        do i = 1, ni
            angle = 6.283185307179586_dp * modulo(i - 1, ni - 1) / (ni - 1)
            r = exp(3._dp * (j - 1) / (nj - 1))
            x(i, j, :) = (r + 0.6_dp / r) * cos(angle)
            y(i, j, :) = [0, 1]
            z(i, j, :) = (r - 0.6_dp / r) * sin(angle)
            if (i == ni .or. j == nj) cycle
            n = n + 1
            faces(:, n) = i + ni * (j - 1) + [0, 1, 1 + ni, ni]
        end do
    end do
    do i = 1, ni - 1
        sides(:, i) = i + [0, 1, 1 + ni * nj, ni * nj]
        sides(:, ni - 1 + i) = ni * (nj - 1) + sides(:, i)
    end do
    markers = [(wall, i = 1, ni - 1), (far, i = 1, ni - 1)]
    dj_dx = 1
    dj_dy = 0
    dj_dz = 1

    ! README: the mesh of the plane
    call plane%points(x, y, z)
    call plane%faces(faces)                 ! faces of one symmetry plane
    call plane%sides(sides, markers)        ! boundary faces from one plane to the other
    call plane%find()
    call plane%mesh(mesh)
    ! end

    call curves%fit(x(:ni - 1, 1, 1), z(:ni - 1, 1, 1), loop=.true., n_control=12)
    call plan%analyse(mesh, curves, [hm_condition(wall)])
    call plan%factor()
    call plan%solve(basis)
    call plan%free()
    move = 0
    where (curves%control(2, :) > 0.05_dp) move(2, :) = 0.1_dp

    call basis%displacement(move, dx, dy)
    call basis%assess(mesh, dx, dy, quality=quality)

    ! README: all points move, and all derivatives count
    call plane%morph(basis, move, x, y, z)
    call plane%adjoint(basis, dj_dx, dj_dy, dj_dz, gradient)
    ! end

    n = count(x(:, :, 1) /= x(:, :, 2) .or. z(:, :, 1) /= z(:, :, 2) .or. y(:, :, 1) /= 0)
    print "(a, i0, a, i0, a)", "one cell thick: ", quality%inverted, " inverted cells, ", n, &
        " points left their opposites"
    if (quality%inverted > 0 .or. n > 0) error stop
end program
