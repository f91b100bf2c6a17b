! Inverse design with constraints: the pressure of a thinner, cambered airfoil is wanted, but area and thickness at two
! stations must stay. The design variables are 12 CST coefficients; the method is sequential quadratic programming with
! the flow solver potential.f90. harmorph gives the gradients of mesh and constraints with respect to the variables.
program constrained
    use harmorph
    use potential, only: airfoil, cells, cp, cp_target, dp, faces, gradient, marks, np, objective, read_mesh, &
        solve_flow, x, y
    implicit none
    integer, parameter :: n = 12, m = 3, most = 60
    type(hm_mesh) :: mesh
    type(hm_curves) :: curves, moved
    type(hm_plan) :: plan
    type(hm_basis) :: basis, few
    type(hm_step_report) :: limit
    type(hm_quality_report) :: quality
    type(hm_quantity) :: wanted(m)
    complex(dp), allocatable :: map(:, :)
    real(dp), allocatable :: x_start(:), y_start(:), dx(:), dy(:), gx(:), gy(:), goal(:, :), slopes(:, :, :)
    real(dp) :: v(n), d(n), g(n), old_g(n), a(m, n), old_a(m, n), c(m), start(m), lambda(m), b(n, n), y_step(n)
    real(dp) :: j, first_j, merit, penalty, step, steepest, first_slope
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

    ! Done once: the functions of the control points are replaced by those of 6 CST variables on each side.
    call mesh%points(x, y)
    call mesh%cells(cells)
    call mesh%faces(faces, marks)
    call plan%analyse(mesh)
    call plan%boundary([airfoil], points, loop)
    call curves%fit(x(points), y(points), loop, n_control=30)
    call plan%analyse(mesh, curves, [hm_condition(airfoil)])
    call plan%factor()
    call plan%solve(basis)
    call plan%free()
    call curves%map(hm_variables(hm_cst, n_upper=n / 2, n_lower=n / 2), map)
    call basis%combine(map, few)
    wanted = [hm_quantity(hm_area), hm_quantity(hm_thickness, 0.25_dp), hm_quantity(hm_thickness, 0.6_dp)]
    allocate(slopes(2, size(map, 1), m))

    ! The wanted pressure is that of an airfoil with more camber and 15 % less thickness.
    goal = 0 * curves%control
    goal(2, :) = 0.08_dp * curves%control(1, :) * (1 - curves%control(1, :)) - 0.15_dp * curves%control(2, :)
    call basis%morph_to(goal, x_start, y_start, x, y)
    call solve_flow()
    cp_target = cp
    v = 0
    call go_to(v)
    call evaluate(v)
    start = c
    c = 0
    call check_gradients()
    first_j = j
    first_slope = norm2(g)
    b = 0
    do k = 1, n
        b(k, k) = norm2(g) / 0.03_dp
    end do
    penalty = 0
    print "(a)", "step  pressure error  largest constraint  gradient of the Lagrangian  inverted"
    do k = 0, most
        call quadratic_step(d, lambda)
        steepest = norm2(g + matmul(lambda, a))
        call basis%assess(mesh, quality)
        print "(i4, es16.4, es20.1, es28.1, i10)", k, sqrt(j / first_j), maxval(abs(c)), steepest / first_slope, &
            quality%inverted
        if (quality%inverted > 0) error stop "The mesh has inverted cells."
        if (steepest < 1e-4_dp * first_slope .and. maxval(abs(c)) < 1e-10_dp) exit
        if (k == most) exit
        call few%displacement(pairs(d), dx, dy)
        call few%assess(mesh, dx, dy, limit)
        step = min(1._dp, 0.5_dp * limit%admissible)
        penalty = max(penalty, 2 * maxval(abs(lambda)))
        merit = j + penalty * sum(abs(c))
        old_g = g
        old_a = a
        do tries = 1, 20
            call go_to(v + step * d)
            call evaluate(v + step * d)
            if (j + penalty * sum(abs(c)) <= &
                merit + 1e-4_dp * step * (dot_product(old_g, d) - penalty * sum(abs(c)))) exit
            step = 0.5_dp * step
        end do
        v = v + step * d
        y_step = g - old_g + matmul(lambda, a - old_a)
        call update(step * d, y_step)
    end do
    print "(a, f0.2)", "pressure error: divided by ", sqrt(first_j / j)
    print "(a, 3es10.2)", "area and thicknesses: changes ", c
    if (maxval(abs(c)) > 1e-10_dp) error stop "A constraint is not satisfied."
    if (steepest > 1e-4_dp * first_slope) error stop "The gradient of the Lagrangian is too large."

contains

    pure function pairs(chosen) result(xy)
        real(dp), intent(in) :: chosen(n)
        real(dp) :: xy(2, n)
        xy = 0
        xy(1, :) = chosen
    end function

    subroutine go_to(chosen)
        real(dp), intent(in) :: chosen(n)
        call few%morph_to(pairs(chosen), x_start, y_start, x, y)
    end subroutine

    ! Computes objective and constraints with their gradients on the present mesh.
    subroutine evaluate(chosen)
        real(dp), intent(in) :: chosen(n)
        real(dp) :: both(2, n)
        integer :: i
        call solve_flow()
        j = objective()
        call gradient(gx, gy)
        call few%adjoint(gx, gy, both)
        g = both(1, :)
        call few%moved_curves(pairs(chosen), moved)
        call moved%measure(wanted, c, gradients=slopes)
        do i = 1, m
            a(i, :) = matmul(slopes(1, :, i), real(map, dp)) + matmul(slopes(2, :, i), aimag(map))
        end do
        if (maxval(abs(chosen)) > 0) c = c - start
    end subroutine

    ! Finds d that minimises g d + d b d / 2 with c + a d = 0, and the multipliers lambda.
    subroutine quadratic_step(d, lambda)
        real(dp), intent(out) :: d(n), lambda(m)
        real(dp) :: kkt(n + m, n + m + 1), row(n + m + 1)
        integer :: i, l, pivot
        kkt = 0
        kkt(:n, :n) = b
        kkt(:n, n + 1:n + m) = transpose(a)
        kkt(n + 1:, :n) = a
        kkt(:, n + m + 1) = [-g, -c]
        do i = 1, n + m
            pivot = i - 1 + maxloc(abs(kkt(i:, i)), 1)
            row = kkt(pivot, :)
            kkt(pivot, :) = kkt(i, :)
            kkt(i, :) = row / row(i)
            do l = 1, n + m
                if (l /= i) kkt(l, :) = kkt(l, :) - kkt(l, i) * kkt(i, :)
            end do
        end do
        d = kkt(:n, n + m + 1)
        lambda = kkt(n + 1:, n + m + 1)
    end subroutine

    ! Updates b by Powell's damped BFGS, so that b stays positive definite.
    subroutine update(s, y_all)
        real(dp), intent(in) :: s(n), y_all(n)
        real(dp) :: bs(n), sbs, part, y(n)
        bs = matmul(b, s)
        sbs = dot_product(s, bs)
        part = 1
        if (dot_product(s, y_all) < 0.2_dp * sbs) part = 0.8_dp * sbs / (sbs - dot_product(s, y_all))
        y = part * y_all + (1 - part) * bs
        b = b - spread(bs, 2, n) * spread(bs, 1, n) / sbs + spread(y, 2, n) * spread(y, 1, n) / dot_product(s, y)
    end subroutine

    ! Compares the gradients with central differences for each variable.
    subroutine check_gradients()
        real(dp) :: chosen(n), up(m + 1), of_j(n), of_c(m, n), worst(2)
        real(dp), parameter :: eps = 1e-6_dp
        integer :: i
        of_j = g
        of_c = a
        worst = 0
        do i = 1, n
            chosen = 0
            chosen(i) = eps
            call go_to(chosen)
            call evaluate(chosen)
            up = [j, c]
            call go_to(-chosen)
            call evaluate(-chosen)
            worst(1) = max(worst(1), abs(of_j(i) - (up(1) - j) / (2 * eps)))
            worst(2) = max(worst(2), maxval(abs(of_c(:, i) - (up(2:) - c) / (2 * eps))))
        end do
        worst = worst / [maxval(abs(of_j)), maxval(abs(of_c))]
        print "(a, 2es9.1)", "gradients by variables, of pressure and constraints: relative differences", worst
        if (any(worst > 1e-6_dp)) error stop "A gradient differs from central differences."
        call go_to(v)
        call evaluate(v)
        c = 0
    end subroutine
end program
