
! ---- Displacements given at wall points ------------------------------------------------------------------------------

subroutine hmgive(w, n, ip, wx, wy, dx, dy, inc, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: n, inc, ip(*)
    real(c_double), intent(inout), target :: w(*), dx(*), dy(*)
    real(c_double), intent(in), target :: wx(*), wy(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(hm_solve_report) :: report
    type(c_ptr) :: points
    type(hm_c_memory) :: memory
    report%struct_size = int(c_sizeof(report), c_int64_t)
    call this%open(w)
    call work_of_field(this, memory)
    call this%list(ip, n, points)
    if (this%ok()) call this%told(hm_c_displace(this%kept%plan, short(n), points, 1_c_int32_t, &
        [points_of(wx, wy, 1)], c_null_ptr, [points_of(dx, dy, inc)], memory, report, this%e))
    call this%finish(ierr, msg)
end subroutine

subroutine hmgadj(w, n, ip, gx, gy, inc, hx, hy, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: n, inc, ip(*)
    real(c_double), intent(inout), target :: w(*), hx(*), hy(*)
    real(c_double), intent(in), target :: gx(*), gy(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(hm_solve_report) :: report
    type(c_ptr) :: points
    type(hm_c_memory) :: memory
    report%struct_size = int(c_sizeof(report), c_int64_t)
    call this%open(w)
    call work_of_field(this, memory)
    call this%list(ip, n, points)
    if (this%ok()) call this%told(hm_c_displace_adjoint(this%kept%plan, short(n), points, 1_c_int32_t, &
        [points_of(gx, gy, inc)], [points_of(hx, hy, 1)], memory, report, this%e))
    call this%finish(ierr, msg)
end subroutine

subroutine hmgsaf(w, n, ip, wx, wy, dp, x, y, xn, yn, inc, frac, istrat, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: n, inc, ip(*)
    real(c_double), intent(inout), target :: w(*), xn(*), yn(*)
    real(c_double), intent(in), target :: wx(*), wy(*), dp(2, *), x(*), y(*)
    real(c_double), intent(inout) :: frac
    integer, intent(inout) :: istrat
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(hm_c_basis_info) :: info
    type(hm_c_safe_options) :: options
    type(hm_safe_report) :: report
    type(hm_c_safe_target) :: goal
    type(hm_c_points), target :: of_wall
    type(c_ptr) :: plan
    type(hm_c_memory) :: memory
    info%struct_size = int(c_sizeof(info), c_int64_t)
    options%struct_size = int(c_sizeof(options), c_int64_t)
    report%struct_size = int(c_sizeof(report), c_int64_t)
    call open_solved_at(this, w, x, y, inc)
    call plan_of_start(this, "HMGSAF", plan)
    goal%struct_size = int(c_sizeof(goal), c_int64_t)
    call this%list(ip, n, goal%points)
    if (this%ok()) call this%told(hm_c_basis_info_get(this%kept%basis, info, this%e))
    if (info%functions > 0) goal%move = c_loc(dp)
    goal%n = short(n)
    of_wall = points_of(wx, wy, 1)
    goal%wall = c_loc(of_wall)
    if (this%ok()) call this%told(hm_c_move_safe(plan, this%kept%basis, goal, points_of(xn, yn, inc), memory, &
        options, report, this%e))
    call this%room(memory%bytes, memory%block)
    if (this%ok()) call this%told(hm_c_move_safe(plan, this%kept%basis, goal, points_of(xn, yn, inc), memory, &
        options, report, this%e))
    if (this%ok()) then
        frac = report%step_fraction
        istrat = int(report%strategy)
    end if
    call this%finish(ierr, msg)
end subroutine
