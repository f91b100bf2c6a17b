
! ---- Movements by the functions, and the assessment of meshes --------------------------------------------------------

subroutine hmmorf(w, dp, x, y, inc, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: inc
    real(c_double), intent(inout), target :: w(*), x(*), y(*)
    real(c_double), intent(in) :: dp(2, *)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(hm_c_points), target :: points
    points = points_of(x, y, inc)
    call this%open_solved(w)
    if (this%ok()) call this%told(hm_c_morph(this%kept%basis, dp, c_loc(points), points, c_null_ptr, this%e))
    call this%finish(ierr, msg)
end subroutine

subroutine hmreco(w, x, y, inc, dp, res, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: inc
    real(c_double), intent(inout), target :: w(*), x(*), y(*)
    real(c_double), intent(inout) :: dp(2, *), res
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(hm_c_memory) :: memory
    type(hm_recover_report) :: report
    report%struct_size = int(c_sizeof(report), c_int64_t)
    call this%open_solved(w)
    if (this%ok()) call this%told(hm_c_recover_movement(this%kept%basis, points_of(x, y, inc), 0._c_double, dp, &
        report, memory, this%e))
    call this%room(memory%bytes, memory%block)
    if (this%ok()) call this%told(hm_c_recover_movement(this%kept%basis, points_of(x, y, inc), 0._c_double, dp, &
        report, memory, this%e))
    if (this%ok()) res = report%residual
    call this%finish(ierr, msg)
end subroutine

subroutine hmdisp(w, dp, dx, dy, inc, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: inc
    real(c_double), intent(inout), target :: w(*), dx(*), dy(*)
    real(c_double), intent(in) :: dp(2, *)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    call this%open_solved(w)
    if (this%ok()) call this%told(hm_c_morph(this%kept%basis, dp, c_null_ptr, points_of(dx, dy, inc), c_null_ptr, &
        this%e))
    call this%finish(ierr, msg)
end subroutine

subroutine hmadj(w, gx, gy, inc, g, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: inc
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(in), target :: gx(*), gy(*)
    real(c_double), intent(inout) :: g(2, *)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    call this%open_solved(w)
    if (this%ok()) call this%told(hm_c_adjoint(this%kept%basis, points_of(gx, gy, inc), g, c_null_ptr, this%e))
    call this%finish(ierr, msg)
end subroutine

subroutine hmsafe(w, dp, x, y, xn, yn, inc, dr, frac, istrat, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: inc
    real(c_double), intent(inout), target :: w(*), xn(*), yn(*)
    real(c_double), intent(in), target :: x(*), y(*), dp(2, *)
    real(c_double), intent(inout), target :: dr(2, *)
    real(c_double), intent(inout) :: frac
    integer, intent(inout) :: istrat
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(hm_c_safe_options) :: options
    type(hm_c_safe_target) :: goal
    type(hm_safe_report) :: report
    type(c_ptr) :: plan
    type(hm_c_memory) :: memory
    options%struct_size = int(c_sizeof(options), c_int64_t)
    options%reached = c_loc(dr)
    goal%struct_size = int(c_sizeof(goal), c_int64_t)
    goal%move = c_loc(dp)
    report%struct_size = int(c_sizeof(report), c_int64_t)
    call open_solved_at(this, w, x, y, inc)
    call plan_of_start(this, "HMSAFE", plan)
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

subroutine hmslip(w, xs, ys, x, y, inc, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: inc
    real(c_double), intent(inout), target :: w(*), x(*), y(*)
    real(c_double), intent(in), target :: xs(*), ys(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(c_ptr) :: analysis
    call open_solved_at(this, w, xs, ys, inc)
    call analysis_of_start(this, "HMSLIP", analysis)
    call this%forgive()
    if (this%ok()) call this%told(hm_c_slip(analysis, points_of(x, y, inc), points_of(x, y, inc), this%e))
    call this%finish(ierr, msg)
end subroutine

subroutine hmsadj(w, xs, ys, x, y, gx, gy, inc, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: inc
    real(c_double), intent(inout), target :: w(*), gx(*), gy(*)
    real(c_double), intent(in), target :: xs(*), ys(*), x(*), y(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(c_ptr) :: analysis
    call open_solved_at(this, w, xs, ys, inc)
    call analysis_of_start(this, "HMSADJ", analysis)
    call this%forgive()
    if (this%ok()) call this%told(hm_c_slip_adjoint(analysis, points_of(x, y, inc), points_of(gx, gy, inc), &
        points_of(gx, gy, inc), this%e))
    call this%finish(ierr, msg)
end subroutine

subroutine hmstep(w, x, y, dx, dy, inc, s, icell, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: inc
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(in), target :: x(*), y(*), dx(*), dy(*)
    real(c_double), intent(inout) :: s
    integer, intent(out) :: icell, ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(hm_step_report), target :: report
    type(hm_c_points), target :: from, along
    icell = 0
    from = points_of(x, y, inc)
    report%struct_size = int(c_sizeof(report), c_int64_t)
    call this%open_solved(w)
    along = points_of(dx, dy, inc)
    if (this%ok()) call this%told(hm_c_assess(this%kept%basis, this%kept%mesh, c_loc(from), c_loc(along), &
        c_null_ptr, c_null_ptr, c_loc(report), c_null_ptr, this%e))
    if (this%ok()) then
        s = report%admissible
        icell = int(report%cell)
    end if
    call this%finish(ierr, msg)
end subroutine

subroutine hmqual(w, x, y, inc, ninv, amin, qmin, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: inc
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(in), target :: x(*), y(*)
    real(c_double), intent(inout) :: amin, qmin
    integer, intent(out) :: ninv, ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(hm_quality_report), target :: report
    type(hm_c_points), target :: at
    ninv = 0
    at = points_of(x, y, inc)
    report%struct_size = int(c_sizeof(report), c_int64_t)
    call this%open_solved(w)
    if (this%ok()) call this%told(hm_c_assess(this%kept%basis, this%kept%mesh, c_loc(at), c_null_ptr, c_null_ptr, &
        c_null_ptr, c_null_ptr, c_loc(report), this%e))
    if (this%ok()) then
        ninv = int(report%inverted)
        amin = report%min_area
        qmin = report%min_quality
    end if
    call this%finish(ierr, msg)
end subroutine

subroutine hmboun(w, kind, rho, xs, ys, x, y, inc, bound, gx, gy, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: kind, inc
    real(c_double), intent(in) :: rho
    real(c_double), intent(in), target :: xs(*), ys(*), x(*), y(*)
    real(c_double), intent(inout), target :: w(*), gx(*), gy(*)
    real(c_double), intent(inout) :: bound
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(hm_c_points), target :: start, at, gradient
    type(hm_c_bound) :: wanted
    type(hm_bound_value) :: found(1)
    type(c_ptr) :: quality
    type(hm_c_memory) :: memory
    start = points_of(xs, ys, inc)
    at = points_of(x, y, inc)
    gradient = points_of(gx, gy, inc)
    wanted = hm_c_bound(kind=short(kind), sharpness=rho)
    wanted%struct_size = int(c_sizeof(wanted), c_int64_t)
    found%struct_size = int(c_sizeof(found(1)), c_int64_t)
    call this%open_solved(w)
    if (this%ok()) call this%told(hm_c_quality_init(quality, memory, this%kept%basis, this%kept%mesh, c_loc(start), &
        this%e))
    call this%room(memory%bytes, memory%block)
    if (this%ok()) call this%told(hm_c_quality_init(quality, memory, this%kept%basis, this%kept%mesh, c_loc(start), &
        this%e))
    if (this%ok()) call this%told(hm_c_quality_bounds(quality, c_loc(at), 1_c_int32_t, [wanted], found, &
        c_loc(gradient), c_null_ptr, this%e))
    if (this%ok()) bound = found(1)%bound
    call this%finish(ierr, msg)
end subroutine
