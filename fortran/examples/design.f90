! A design loop with the mesh as a constraint. The pressure of the airfoil at a higher incidence is wanted, with 12 CST
! variables. At least 98 % of the area and of the thickness at a quarter of the chord must stay, and the cells must
! remain good: no corner area below 0.3 of its start, and no quality below 0.4 of its start. The functions are those of
! Laplace's equation, which carry small movements only. The same loop without the mesh constraint ends in a refused
! morph. The method is that of the augmented Lagrangian with quasi-Newton steps; the flow solver is potential.f90.
! design_c.c is this program in C. The lines that end in !hm touch harmorph.
program design
    use harmorph                                                                        !hm
    use bfgs, only: scaled_identity, update
    use potential, only: airfoil, alpha, cells, cp, cp_target, dp, faces, gradient, marks, np, objective, read_mesh, &
        solve_flow, x, y
    implicit none
    integer, parameter :: n = 12, m = 4                         ! variables; constraints
    type(hm_mesh) :: mesh                                                               !hm
    type(hm_curves) :: curves, moved                                                    !hm
    type(hm_plan) :: plan                                                               !hm
    type(hm_basis) :: basis, few                                                        !hm
    type(hm_quality) :: quality                                                         !hm
    type(hm_options) :: options                                                         !hm
    type(hm_quantity) :: measured(2)                                                    !hm
    complex(dp), allocatable :: map(:, :)
    real(dp), allocatable :: x_start(:), y_start(:), dx(:), dy(:), slopes(:, :, :)
    real(dp) :: j, g(n), c(m), by_variable(m, n), first_j, start(2), v(n)
    integer, allocatable :: points(:)
    logical :: loop, refused
    character(len=256) :: file

    file = "naca0012.su2"
    if (command_argument_count() > 0) call get_command_argument(1, file)
    call read_mesh(file)
    allocate(dx(np), dy(np))
    x_start = x
    y_start = y
    alpha = alpha + 0.08_dp                                     ! the pressure at this incidence is wanted
    call solve_flow()
    cp_target = cp
    alpha = alpha - 0.08_dp

    ! Done once: the functions of 6 variables on each side, and the mesh with which later ones are compared.
    call mesh%points(x, y)                                                              !hm
    call mesh%cells(cells)                                                              !hm
    call mesh%faces(faces, marks)                                                       !hm
    call plan%analyse(mesh)                                                             !hm
    call plan%boundary([airfoil], points, loop)                                         !hm
    call curves%fit(x(points), y(points), loop, n_control=30)                           !hm
    options%operator_kind = hm_laplace                                                  !hm
    call plan%analyse(mesh, curves, [hm_condition(airfoil)], options=options)           !hm
    call plan%factor()                                                                  !hm
    call plan%solve(basis)                                                              !hm
    call plan%free()                                                                    !hm
    call curves%map(hm_variables(hm_cst, n_upper=n / 2, n_lower=n / 2), map)            !hm
    call basis%combine(map, few)                                                        !hm
    call quality%start(few, mesh)                                                       !hm
    measured = [hm_quantity(hm_area), hm_quantity(hm_thickness, 0.25_dp)]               !hm
    allocate(slopes(2, size(map, 1), 2))
    call curves%measure(measured, start)                                                !hm
    v = 0
    call go_to(v, refused)
    call evaluate()
    first_j = j

    call check_gradients()
    print "(a)", "with the mesh constraint:"
    call optimise(m, refused)
    if (refused) error stop "A morph was refused, although the mesh is a constraint."
    print "(a, f0.3, a, 4f8.3)", "pressure error: divided by ", sqrt(first_j / j), ", margins of the constraints ", c
    if (any(c < -1e-3_dp)) error stop "A constraint is not satisfied."
    if (j > 0.9_dp * first_j) error stop "The pressure error did not fall."
    print "(a)", "without the mesh constraint:"
    call optimise(m - 2, refused)
    if (.not. refused) error stop "The loop without the mesh constraint needed no refused morph."

contains

    ! Moves the mesh to these variables, always from the start. The morph is refused if a cell would be inverted.
    subroutine go_to(to, is_refused)
        real(dp), intent(in) :: to(n)
        logical, intent(out) :: is_refused
        type(hm_step_report) :: limit                                                   !hm
        call few%displacement(pairs(to), dx, dy)                                        !hm
        call few%assess(mesh, dx, dy, limit, x=x_start, y=y_start)                      !hm
        is_refused = limit%admissible <= 1                                              !hm
        if (is_refused) print "(a, f0.3, a, i0)", "the morph is refused: the mesh can follow ", &
            limit%admissible, " of the movement, before a corner inverts at point ", limit%point            !hm
        if (.not. is_refused) call few%morph_to(pairs(to), x_start, y_start, x, y)      !hm
        if (.not. is_refused) call few%moved_curves(pairs(to), moved)                   !hm
    end subroutine

    ! The objective and the constraints c >= 0 on the present mesh, with their gradients by the variables.
    subroutine evaluate()
        type(hm_bound_value) :: bound(2)                                                !hm
        real(dp) :: gx(np), gy(np), by_points(2, np, 2), both(2, n), found(2)
        integer :: k
        call solve_flow()
        j = objective()
        call gradient(gx, gy)
        call few%adjoint(gx, gy, both)                                                  !hm
        g = both(1, :)
        call moved%measure(measured, found, gradients=slopes)                           !hm
        c(:2) = found / start - 0.98_dp
        do k = 1, 2
            by_variable(k, :) = matmul(slopes(1, :, k), real(map, dp)) + matmul(slopes(2, :, k), aimag(map))
            by_variable(k, :) = by_variable(k, :) / start(k)
        end do
        call quality%bounds([hm_bound_area, hm_bound_kept_quality], x, y, bound, by_points)             !hm
        c(3:) = bound%bound - [0.3_dp, 0.4_dp]                                          !hm
        do k = 1, 2
            call few%adjoint(by_points(1, :, k), by_points(2, :, k), both)              !hm
            by_variable(2 + k, :) = both(1, :)
        end do
    end subroutine

    pure function pairs(chosen) result(xy)
        real(dp), intent(in) :: chosen(n)
        real(dp) :: xy(2, n)
        xy = 0
        xy(1, :) = chosen
    end function

    ! Minimises the objective subject to the first constraints, from the start.
    subroutine optimise(n_constraints, is_refused)
        integer, intent(in) :: n_constraints
        logical, intent(out) :: is_refused
        real(dp) :: lambda(n_constraints), h(n, n), d(n), slope(n), old_slope(n), step, merit, old_merit
        real(dp), parameter :: penalty = 20, longest = 0.03_dp
        integer :: outer, k, tries
        v = 0
        lambda = 0
        call go_to(v, is_refused)
        call evaluate()
        do outer = 1, 5
            call lagrangian(lambda, penalty, merit, slope)
            h = scaled_identity(slope, 0.3_dp * longest)
            do k = 1, 12
                d = -matmul(h, slope)
                d = d * min(1._dp, longest / maxval(abs(d)))
                if (dot_product(d, slope) > -1e-9_dp) exit
                old_merit = merit
                old_slope = slope
                step = 1
                do tries = 1, 8
                    call go_to(v + step * d, is_refused)
                    if (is_refused) return
                    call evaluate()
                    call lagrangian(lambda, penalty, merit, slope)
                    if (merit <= old_merit + 1e-4_dp * step * dot_product(old_slope, d)) exit
                    step = 0.4_dp * step
                end do
                v = v + step * d
                call update(h, step * d, slope - old_slope)
            end do
            print "(i4, a, f8.5, a, 4f8.3)", outer, "  pressure error ", sqrt(j / first_j), "  margins ", c
            lambda = max(0._dp, lambda - penalty * c(:n_constraints))
        end do
    end subroutine

    ! The augmented Lagrangian and its gradient.
    subroutine lagrangian(lambda, penalty, merit, slope)
        real(dp), intent(in) :: lambda(:), penalty
        real(dp), intent(out) :: merit, slope(n)
        real(dp) :: active(size(lambda))
        active = max(0._dp, lambda / penalty - c(:size(lambda)))
        merit = j / first_j + 0.5_dp * penalty * sum(active**2)
        slope = g / first_j - penalty * matmul(active, by_variable(:size(lambda), :))
    end subroutine

    ! Compares the gradients by the variables with central differences, which agree to second order.
    subroutine check_gradients()
        real(dp) :: direction(n), slope(m + 1), up(m + 1), down(m + 1), error(2), eps
        logical :: stopped
        integer :: i, k
        direction = [(cos(2._dp * i), i = 1, n)]
        slope = [dot_product(g, direction) / first_j, matmul(by_variable, direction)]
        do k = 1, 2
            eps = 1e-4_dp / 2**k
            call go_to(eps * direction, stopped)
            call evaluate()
            up = [j / first_j, c]
            call go_to(-eps * direction, stopped)
            call evaluate()
            down = [j / first_j, c]
            error(k) = maxval(abs((up - down) / (2 * eps) - slope) / maxval(abs(slope)))
        end do
        print "(a, 2es9.1)", "gradients by variables: relative differences for two steps", error
        if (error(2) > 1e-4_dp .or. error(1) < 3 * error(2)) error stop "A gradient differs from central differences."
    end subroutine
end program
