! Inverse design: which airfoil has this pressure? The flow solver (potential.f90) has a mesh, and the gradient of the
! objective with respect to all mesh points; harmorph carries both between mesh and control points. The lines
! that end in !hm touch harmorph.
program inverse
    use harmorph                                                                        !hm
    use bfgs
    use potential
    use picture
    implicit none
    integer, parameter :: n = 20, most = 100
    type(hm_mesh) :: mesh                                                               !hm
    type(hm_curves) :: curves                                                           !hm
    type(hm_plan) :: plan                                                               !hm
    type(hm_basis) :: basis                                                             !hm
    type(hm_step_report) :: limit                                                       !hm
    type(hm_quality_report) :: quality                                                  !hm
    real(dp) :: move(2, n), goal(2, n), slope(2, n), old_slope(2, n), direction(2, n), change(2, n), h(2 * n, 2 * n)
    real(dp) :: error(0:most), j, old_j, step
    real(dp), allocatable :: x_start(:), y_start(:), dx(:), dy(:), gx(:), gy(:)
    integer, allocatable :: points(:)
    logical :: loop
    integer :: k, tries
    character(len=256) :: file

    file = "naca0012.su2"
    if (command_argument_count() > 0) call get_command_argument(1, file)
    call read_mesh(file)
    allocate(dx(np), dy(np), gx(np), gy(np))
    x_start = x
    y_start = y

    ! Done once: the solver's mesh, a curve through the airfoil, and the harmonic functions.
    call mesh%points(x, y)                                                              !hm
    call mesh%cells(cells)                                                              !hm
    call mesh%faces(faces, marks)                                                       !hm
    call plan%analyse(mesh)                                                             !hm
    call plan%boundary([airfoil], points, loop)                                         !hm
    call curves%fit(x(points), y(points), loop, n_control=n)                            !hm
    call plan%analyse(mesh, curves, [hm_condition(airfoil)])                            !hm
    call plan%factor()                                                                  !hm
    call plan%solve(basis)                                                              !hm
    call plan%free()                                                                    !hm

    ! The target is an airfoil with more camber and less thickness; the loop below uses only its pressure.
    goal = 0
    goal(2, :) = 0.08_dp * curves%control(1, :) * (1 - curves%control(1, :)) - 0.15_dp * curves%control(2, :)   !hm
    call go_to(goal)
    call basis%assess(mesh, quality)                                                   !hm
    if (quality%inverted > 0) error stop "The mesh of the target has inverted cells." !hm
    call solve_flow()
    cp_target = cp
    call draw_target(x(points), y(points), wall_x(), cp)
    move = 0
    call go_to(move)
    call evaluate()
    call draw_start(x(points), y(points), wall_x(), cp)
    call check_gradients()

    ! BFGS on the heights of the control points; the first one, the trailing edge, stays.
    h = scaled_identity(reshape(slope, [2 * n]), longest=0.01_dp)
    print "(a)", "step  pressure error  admissible  inverted"
    do k = 0, most
        error(k) = sqrt(2 * j / sum(weight))
        call basis%assess(mesh, quality)                                               !hm
        print "(i4, es16.4, f12.2, i10)", k, error(k), merge(limit%admissible, 0._dp, k > 0), quality%inverted     !hm
        if (quality%inverted > 0) error stop "The mesh has inverted cells."              !hm
        if (error(k) < 1e-3_dp * error(0) .or. k == most) exit
        direction = -reshape(matmul(h, reshape(slope, [2 * n])), [2, n])
        call basis%displacement(direction, dx, dy)                                      !hm
        call basis%assess(mesh, dx, dy, limit)                                          !hm
        step = min(1._dp, 0.5_dp * limit%admissible)                                    !hm
        old_j = j
        old_slope = slope
        do tries = 1, 20
            change = step * direction
            call go_to(move + change)
            call evaluate()
            if (j < old_j + 1e-4_dp * sum(change * old_slope)) exit
            step = 0.5_dp * step
        end do
        move = move + change
        call update(h, reshape(change, [2 * n]), reshape(slope - old_slope, [2 * n]))
    end do
    call draw_result(x(points), y(points), wall_x(), cp)
    call write_picture("inverse.svg", error(0:k))
    print "(a, f0.0, a)", "pressure error: divided by ", error(0) / error(k), " since the first step"
    print "(a, es8.1)", "control points: largest distance from the target's ", maxval(abs(move - goal))
    if (error(k) > 0.01_dp * error(0)) error stop "The pressure error was not divided by 100."

contains

    ! Makes the mesh for these movements of the control points, always from the start, so that no errors accumulate.
    subroutine go_to(movement)
        real(dp), intent(in) :: movement(2, n)
        call basis%morph_to(movement, x_start, y_start, x, y)                                !hm
    end subroutine

    ! Computes the objective and the slope dJ/dP on the present mesh.
    subroutine evaluate()
        call solve_flow()
        j = objective()
        call gradient(gx, gy)
        call basis%adjoint(gx, gy, slope)                                               !hm
        slope(1, :) = 0
        slope(2, 1) = 0
    end subroutine

    function wall_x() result(middle)
        real(dp) :: middle(nw)
        middle = 0.5_dp * (x(wall(1, :)) + x(wall(2, :)))
    end function

    ! Compares gradients with central differences: along one direction of all mesh points, and for each control point.
    subroutine check_gradients()
        real(dp) :: here, there, up, probe(2, n), worst, vx(np), vy(np), scale
        real(dp), parameter :: eps = 1e-6_dp
        integer :: i
        do i = 1, np
            scale = 0.1_dp * (1 - exp(-10 * hypot(x(i) - 1, y(i))**2))      ! smaller steps for small cells
            vx(i) = scale * sin(3 * x(i) + 5 * y(i))
            vy(i) = scale * cos(4 * x(i) - 2 * y(i))
        end do
        here = sum(gx * vx + gy * vy)
        x = x_start + eps * vx
        y = y_start + eps * vy
        call solve_flow()
        up = objective()
        x = x_start - eps * vx
        y = y_start - eps * vy
        call solve_flow()
        there = (up - objective()) / (2 * eps)
        print "(a, es9.1)", "gradient by mesh points: relative difference to finite differences", abs(here / there - 1)
        if (abs(here / there - 1) > 1e-6_dp) error stop "The gradient by mesh points differs from central differences."

        worst = 0
        do i = 2, n
            probe = 0
            probe(2, i) = eps
            call go_to(probe)
            call solve_flow()
            up = objective()
            call go_to(-probe)
            call solve_flow()
            worst = max(worst, abs(slope(2, i) - (up - objective()) / (2 * eps)))
        end do
        worst = worst / maxval(abs(slope))
        print "(a, es9.1)", "gradient by control points: relative difference to finite differences", worst
        if (worst > 1e-6_dp) error stop "The gradient by control points differs from central differences."
        call go_to(move)
        call evaluate()
    end subroutine
end program
