! Points that slip along curves.
module slip_tests
    use body_mesh
    implicit none
    private
    public :: slip_on_a_circle

contains

    ! The far field slips along its circle.
    subroutine slip_on_a_circle()
        type(hm_plan) :: plan, empty
        type(hm_curves) :: curves
        type(hm_basis) :: slipping, along_circle
        type(hm_curves), target :: circle
        type(hm_condition) :: conditions(2)
        type(hm_condition), allocatable :: known(:)
        real(dp), dimension(n_points) :: x_new, y_new, gx, gy, x_tangent, y_tangent
        real(dp) :: radius, off, rate
        logical :: outer(n_points)
        real(dp), parameter :: h = 1e-6_dp
        integer :: stat
        call basis%curves(curves)
        call plan%analyse(mesh, curves, [hm_condition(body), hm_condition(far_field, hm_slip)])
        call plan%prepare()
        call plan%factor()
        call plan%solve(slipping)
        call slipping%morph_to(turn(curves%control, 30._dp), x, y, x_tangent, y_tangent)
        outer = .false.
        outer(n_points - around + 1:) = .true.   ! a circle about (-0.02, 0), but for some parts in 10 000
        radius = sum(hypot(x + 0.02_dp, y), mask=outer) / around
        x_new = x_tangent
        y_new = y_tangent
        call plan%slip(x_new, y_new)
        off = maxval(abs(hypot(x_tangent + 0.02_dp, y_tangent) - radius), mask=outer)
        call check(off > 1e-2_dp * radius, "the functions move points along tangents")
        off = maxval(abs(hypot(x_new + 0.02_dp, y_new) - radius), mask=outer)
        call check(off < 1e-3_dp * radius, "slip puts them onto the circle")
        ! The change of the sum of all coordinates, a little farther along the movement.
        gx = 1
        gy = 1
        call plan%slip_adjoint(x_tangent, y_tangent, gx, gy)
        rate = sum(gx * (x_tangent - x)) + sum(gy * (y_tangent - y))
        gx = x_tangent + h * (x_tangent - x)
        gy = y_tangent + h * (y_tangent - y)
        call plan%slip(gx, gy)
        off = sum(gx - x_new) + sum(gy - y_new)
        call check(abs(off / h - rate) < 1e-3_dp * max(1._dp, abs(rate)), "its transpose")
        call plan%slip(x_new(2:), y_new(2:), stat=stat)
        call check(stat == hm_bad_argument, "a point too few to slip")
        call empty%slip(x_new, y_new, stat=stat)
        call check(stat == hm_bad_argument, "slipping without an analysis")
        circle = rational_circle(-0.02_dp, radius)
        conditions = [hm_condition(body), hm_condition(far_field, hm_slip)]
        conditions(2)%along => circle
        call plan%analyse(mesh, curves, conditions)
        call plan%prepare()
        call plan%factor()
        call plan%solve(along_circle)
        gx = x_tangent
        gy = y_tangent
        call plan%slip(gx, gy)
        off = maxval(abs(hypot(gx + 0.02_dp, gy) - radius), mask=outer)
        call check(off < 1e-3_dp * radius, "slip puts them onto a circle that is given")
        off = maxval(hypot(gx - x_new, gy - y_new))
        call check(off > 1e-12_dp .and. off < 1e-3_dp * radius, "which is not quite that of the points")
        call along_circle%conditions(known)
        call check(known(2)%n_curves == 1 .and. .not. associated(known(2)%along), "a basis does not keep it")
        call plan%analyse(mesh, curves, known, stat=stat)
        call check(stat == hm_bad_condition, "so its conditions are refused")
        known(2)%along => circle
        call plan%analyse(mesh, curves, known, stat=stat)
        call check(stat == hm_ok, "until it is given again")
    end subroutine

    ! About (x, 0), in quarters.
    function rational_circle(x, radius) result(circle)
        real(dp), intent(in) :: x, radius
        type(hm_curves) :: circle
        real(dp) :: angle, far
        integer :: k
        allocate(circle%control(2, 8), circle%weights(8), circle%curve(1))
        do k = 1, 8
            angle = 0.3_dp + (k - 1) * atan(1._dp)
            far = merge(1._dp, sqrt(2._dp), mod(k, 2) == 1)
            circle%weights(k) = 1 / far
            circle%control(:, k) = far * radius * [cos(angle), sin(angle)] + [x, 0._dp]
        end do
        circle%curve(1)%degree = 2
        circle%curve(1)%indices = [1, 2, 3, 4, 5, 6, 7, 8, 1]
        circle%curve(1)%knots = real([0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4], dp)
    end function
end module
