! Fluid-structure interaction: the last 40 % of an airfoil bends in two modes, driven by the loads of a potential flow
! (potential.f90). The structural code has displacements of wall points; no curve is needed. The mesh follows by one
! substitution in each step, and the transpose turns forces on all mesh points into forces on the wall. The lines
! that end in !hm touch harmorph.
program fsi
    use harmorph                                                                        !hm
    use potential
    implicit none
    integer, parameter :: steps = 200
    real(dp), parameter :: dt = 0.03_dp, hinge = 0.6_dp
    real(dp), parameter :: mass(2) = [0.02_dp, 0.005_dp], stiffness(2) = [1.5_dp, 3.0_dp], &
        damping(2) = [0.05_dp, 0.03_dp]
    real(dp), parameter :: calm = 0.035_dp, gust = 0.15_dp      ! incidence, and the additional incidence of a gust
    type(hm_mesh) :: mesh                                                               !hm
    type(hm_plan) :: plan                                                               !hm
    type(hm_basis) :: judge                                                             !hm
    type(hm_step_report) :: limit                                                       !hm
    type(hm_quality_report) :: quality                                                  !hm
    real(dp), allocatable :: x_start(:), y_start(:), dx(:), dy(:), fx(:), fy(:), x_old(:), y_old(:)
    real(dp), allocatable :: shapes(:, :), displacement(:, :), change(:, :), force(:, :)  ! all at wall points
    integer, allocatable :: points(:)
    real(dp) :: q(2), v(2), load(2), q_old(2), on_mesh, on_wall, in_modes, worst, least_step, least_quality
    integer :: k
    character(len=256) :: file

    file = "naca0012.su2"
    if (command_argument_count() > 0) call get_command_argument(1, file)
    call read_mesh(file)
    allocate(dx(np), dy(np), fx(np), fy(np))
    x_start = x
    y_start = y
    x_old = x
    y_old = y

    ! Done once: analysis and factor. The points of the wall have the order of given_points.
    call mesh%points(x, y)                                                              !hm
    call mesh%cells(cells)                                                              !hm
    call mesh%faces(faces, marks)                                                       !hm
    call plan%analyse(mesh, conditions=[hm_condition(airfoil, hm_given)])               !hm
    call plan%factor()                                                                  !hm
    call plan%given_points(points)                                                      !hm
    call judge%init(plan)                                                               !hm

    ! The modes of a bending cantilever: the heights of both modes at the wall points.
    allocate(shapes(size(points), 2), displacement(2, size(points)), force(2, size(points)))
    shapes(:, 1) = (max(x(points) - hinge, 0._dp) / (1 - hinge))**2
    shapes(:, 2) = shapes(:, 1) * (5 * (max(x(points) - hinge, 0._dp) / (1 - hinge)) - 4)

    q = 0
    v = 0
    worst = 0
    least_step = huge(least_step)
    least_quality = 1
    displacement = 0
    print "(a)", " step       mode 1       mode 2   work on mesh  on the wall     in modes"
    do k = 1, steps
        alpha = calm + gust * sin(3.14159265358979_dp * min(k * dt, 1._dp))**2
        call solve_flow()
        call forces_on_mesh()
        call plan%displace_adjoint(fx, fy, force)                                       !hm
        load = matmul(force(2, :), shapes)

        q_old = q
        v = v + dt * (load - damping * v - stiffness * q) / mass
        q = q + dt * v
        change = -displacement
        displacement(2, :) = matmul(shapes, q)
        change = change + displacement

        ! Displacements from the start accumulate no errors; they are judged before the mesh moves.
        call plan%displacement(displacement, dx, dy)                                    !hm
        call judge%assess(mesh, dx, dy, limit, quality, x_start, y_start)               !hm
        if (quality%inverted > 0) error stop "The mesh would have inverted cells: factor again on the last valid mesh."
        least_step = min(least_step, limit%admissible)
        least_quality = min(least_quality, quality%min_quality)
        x_old = x
        y_old = y
        x = x_start + dx
        y = y_start + dy

        on_mesh = sum(fx * (x - x_old) + fy * (y - y_old))
        on_wall = sum(force * change)
        in_modes = sum(load * (q - q_old))
        worst = max(worst, max(abs(on_wall - in_modes), abs(on_mesh - in_modes)) / (sum(abs(force * change)) + &
            sum(abs(fx * (x - x_old)) + abs(fy * (y - y_old)))))
        if (modulo(k, 20) == 0) print "(i5, 2f13.8, 3es14.6)", k, q, on_mesh, on_wall, in_modes
    end do
    print "(a, es8.1)", "work on mesh, on the wall and in modes: largest relative difference", worst
    print "(a, i0, a, f0.2, a, f0.2)", "valid in ", steps, " steps; admissible steps of at least ", least_step, &
        ", cell qualities of at least ", least_quality
    if (worst > 1e-12_dp) error stop "The work on the mesh, on the wall and in the modes differs."
    if (maxval(abs(q)) < 1e-4_dp) error stop "The trailing edge has not moved."

contains

    ! The forces of the discrete flow on all mesh points are the derivative of its kinetic energy with constant psi,
    ! psi K psi / 2. Inside, they are as small as the error of the discretisation; on the wall they are those of the
    ! pressure.
    subroutine forces_on_mesh()
        fx = 0
        fy = 0
        call add_matrix_gradient(0.5_dp * psi, fx, fy)
    end subroutine
end program
