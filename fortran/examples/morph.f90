! Morphs a structured O-mesh around an ellipse: fit, solve once, move control points as often as wished.
program morph
    use, intrinsic :: iso_fortran_env, only: dp => real64
    use harmorph
    implicit none
    integer, parameter :: ni = 129, nj = 49, wall = 1, far = 2
    real(dp), target :: x(ni, nj), y(ni, nj)
    real(dp) :: dx(ni, nj), dy(ni, nj), move(2, 12), angle, r
    type(hm_mesh) :: mesh
    type(hm_curves) :: curves
    type(hm_plan) :: plan
    type(hm_basis) :: basis
    type(hm_step_report) :: step
    type(hm_quality_report) :: quality
    integer :: i, j

    do j = 1, nj
        do i = 1, ni
            angle = 6.283185307179586_dp * modulo(i - 1, ni - 1) / (ni - 1)
            r = exp(3._dp * (j - 1) / (nj - 1))
            x(i, j) = (r + 0.6_dp / r) * cos(angle)
            y(i, j) = (r - 0.6_dp / r) * sin(angle)
        end do
    end do
    call mesh%points(x, y)                  ! the solver's own arrays, which are not copied
    call mesh%line(wall, 1, ni, 1, 1)       ! i = 1 .. ni along j = 1; an unstructured mesh has cells and faces instead
    call mesh%line(far, 1, ni, nj, nj)

    ! A periodic cubic B-spline with 12 control points through the points of the wall; one function for each.
    call curves%fit(mesh, wall, n_control=12)
    call plan%analyse(mesh, curves, [hm_condition(wall)])
    call plan%factor()
    call plan%solve(basis)
    call plan%free()

    ! The upper control points go up. The displacements are judged before the mesh moves.
    move = 0
    where (curves%control(2, :) > 0.05_dp) move(2, :) = 0.1_dp
    call basis%displacement(move, dx, dy)
    call basis%assess(mesh, dx, dy, step, quality)
    print "(i0, a, f0.1, a)", quality%inverted, " inverted cells; the mesh could follow ", step%admissible, &
        " times as far"
    if (quality%inverted > 0) error stop
    call basis%morph(move, x, y)
end program
