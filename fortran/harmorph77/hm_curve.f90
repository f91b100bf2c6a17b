
! ---- Curves ----------------------------------------------------------------------------------------------------------

subroutine hmwall(w, mark, x, y, inc, nmax, ipts, n, loop, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: mark, inc, nmax
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(in), target :: x(*), y(*)
    integer, intent(inout) :: ipts(*)
    integer, intent(out) :: n, loop, ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(c_ptr) :: analysis, place
    integer(c_int32_t), pointer :: points(:)
    integer(c_int32_t) :: found, is_loop
    found = 0
    is_loop = 0
    call open_at(this, w, x, y, inc)
    call analyse(this, .false., analysis)
    call this%room(4_c_size_t * max(nmax, 0), place)
    if (this%ok()) then
        call c_f_pointer(place, points, [max(nmax, 0)])
        call this%told(hm_c_analysis_boundary(analysis, 1_c_int32_t, [short(mark)], 0_c_int32_t, points, short(nmax), &
            found, is_loop, this%e))
    end if
    if (this%ok()) ipts(:found) = int(points(:found))
    n = int(found)
    loop = int(is_loop)
    call this%finish(ierr, msg)
end subroutine

subroutine hmfit(w, mark, x, y, inc, ncp, ideg, iclos, dmax, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: mark, inc, ncp, ideg, iclos
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(in), target :: x(*), y(*)
    real(c_double), intent(inout) :: dmax
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(c_ptr) :: made
    type(hm_c_fit_options) :: options
    type(hm_fit_report) :: report
    type(hm_c_memory) :: memory
    options = hm_c_fit_options(degree=short(ideg), n_control=short(ncp), closed=short(iclos), index_base=1)
    options%struct_size = int(c_sizeof(options), c_int64_t)
    report%struct_size = int(c_sizeof(report), c_int64_t)
    call open_at(this, w, x, y, inc)
    if (this%ok()) call forget_curves(this%kept)
    if (this%ok()) this%top = this%kept%words
    if (this%ok()) call this%told(hm_c_fit_marker(made, memory, this%kept%mesh, 1_c_int32_t, [short(mark)], options, &
        report, this%e))
    call this%room(memory%bytes, memory%block)
    if (this%ok()) call this%told(hm_c_fit_marker(made, memory, this%kept%mesh, 1_c_int32_t, [short(mark)], options, &
        report, this%e))
    if (this%ok()) call keep_set(this, made)
    if (this%ok()) dmax = report%max_error
    call this%finish(ierr, msg)
end subroutine

subroutine hmctrl(w, ncp, p, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: ncp
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(in) :: p(2, *)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    call this%open(w)
    call this%refuse_if(ncp < 2, "NCP must be at least 2")
    if (this%ok()) call forget_curves(this%kept)
    if (this%ok()) this%top = this%kept%words
    if (this%ok()) call keep_control(this, ncp, p)
    call this%finish(ierr, msg)
end subroutine

subroutine hmcurv(w, ideg, nidx, idx, u, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: ideg, nidx, idx(*)
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(in) :: u(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    call this%open(w)
    if (this%ok()) call this%refuse_if(.not. c_associated(this%kept%set%control), &
        "W has no control points: call HMCTRL before HMCURV")
    call this%refuse_if(nidx < 2 .or. ideg < 1 .or. ideg > 5, "IDEG must be between 1 and 5, and NIDX at least 2")
    if (this%ok()) call keep_curve(this, ideg, nidx, idx, u)
    if (this%ok()) then
        call this%told(hm_c_curves_check(this%kept%set, this%e))
        if (.not. this%ok()) this%kept%set%n_curves = this%kept%set%n_curves - 1_c_int32_t
    end if
    call this%finish(ierr, msg)
end subroutine

subroutine hmgetp(w, nmax, p, ncp, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: nmax
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(inout) :: p(2, *)
    integer, intent(out) :: ncp, ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(hm_c_curves) :: set
    type(hm_c_curve) :: list(most_curves)
    real(c_double), pointer :: control(:, :)
    ncp = 0
    call this%open(w)
    call curves_now(this, set, list)
    if (this%ok()) ncp = int(set%n_control)
    call this%refuse_if(ncp > nmax, "P is too small: P needs room for NCP control points")
    if (this%ok() .and. ncp > 0) then
        call c_f_pointer(set%control, control, [2, ncp])
        p(:, :ncp) = control
    end if
    call this%finish(ierr, msg)
end subroutine

subroutine hmrefn(w, icurv, ideg, nu, u, la, a, ncp, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: icurv, ideg, nu, la
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(in) :: u(*)
    real(c_double), intent(inout) :: a(*)
    integer, intent(out) :: ncp, ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(hm_c_curves) :: set
    type(hm_c_curve) :: list(most_curves)
    type(c_ptr) :: finer, matrix
    type(hm_c_memory) :: memory
    ncp = 0
    call this%open(w)
    call curves_now(this, set, list)
    if (this%ok()) call this%told(hm_c_refine(finer, matrix, memory, set, short(icurv - 1), short(ideg), short(nu), &
        u, this%e))
    call this%room(memory%bytes, memory%block)
    if (this%ok()) call this%told(hm_c_refine(finer, matrix, memory, set, short(icurv - 1), short(ideg), short(nu), &
        u, this%e))
    if (this%ok()) call keep_finer(this, finer, matrix, int(set%n_control), la, a, ncp)
    call this%finish(ierr, msg)
end subroutine
