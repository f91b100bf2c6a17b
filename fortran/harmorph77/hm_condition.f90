
! ---- Conditions ------------------------------------------------------------------------------------------------------

subroutine hmcond(w, mark, kind, icurv, ncurv, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: mark, kind, icurv, ncurv
    real(c_double), intent(inout), target :: w(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(hm_c_condition) :: condition
    call this%open(w)
    call this%refuse_if(kind == hm_rigid, "KIND is that of a rigid body: call HMRIGD")
    call this%refuse_if(kind == hm_periodic_pair, "KIND is that of a periodic pair: call HMPAIR")
    call this%refuse_if(kind == hm_rotation_pair, "KIND is that of a rotation pair: call HMROTA")
    call this%refuse_if(kind == hm_interface, "KIND is that of a sliding interface: call HMINTF")
    condition = hm_c_condition(marker=short(mark), kind=short(kind))
    if (kind == hm_on_curve .or. .not. (icurv == ncurv .and. (icurv == 0 .or. icurv == 1))) then
        condition%first_curve = short(icurv - 1)
        condition%n_curves = short(ncurv)
        if (kind == hm_on_curve .and. ncurv == 0 .and. this%ok()) &
            condition%n_curves = this%kept%set%n_curves - short(icurv - 1)     ! all curves from ICURV on
    end if
    call keep_condition(this, condition)
    call this%finish(ierr, msg)
end subroutine

subroutine hmrigd(w, mark, ibody, xc, yc, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: mark, ibody
    real(c_double), intent(in) :: xc, yc
    real(c_double), intent(inout), target :: w(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    call add_condition(w, hm_c_condition(marker=short(mark), kind=hm_rigid, body=short(ibody - 1), x=xc, y=yc), ierr, &
        msg)
end subroutine

subroutine hmpair(w, mark, mark2, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: mark, mark2
    real(c_double), intent(inout), target :: w(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    call add_condition(w, hm_c_condition(marker=short(mark), kind=hm_periodic_pair, partner=short(mark2)), ierr, msg)
end subroutine

subroutine hmrota(w, mark, mark2, xc, yc, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: mark, mark2
    real(c_double), intent(in) :: xc, yc
    real(c_double), intent(inout), target :: w(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    call add_condition(w, hm_c_condition(marker=short(mark), kind=hm_rotation_pair, partner=short(mark2), x=xc, y=yc), &
        ierr, msg)
end subroutine

subroutine hmintf(w, mark, mark2, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: mark, mark2
    real(c_double), intent(inout), target :: w(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    call add_condition(w, hm_c_condition(marker=short(mark), kind=hm_interface, partner=short(mark2)), ierr, msg)
end subroutine

subroutine hmnear(w, x, y, ierr, msg)
    use harmorph77
    implicit none
    real(c_double), intent(in) :: x, y
    real(c_double), intent(inout), target :: w(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    call this%open(w)
    if (this%ok()) call this%refuse_if(this%kept%n_conditions == 0, "HMNEAR: there is no condition yet")
    if (this%ok()) then
        associate (last => this%kept%condition(this%kept%n_conditions))
            last%piece = 1
            last%near_x = x
            last%near_y = y
        end associate
    end if
    call this%finish(ierr, msg)
end subroutine

subroutine hmalng(w, ncp, p, wt, ideg, nidx, idx, u, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: ncp, ideg, nidx, idx(*)
    real(c_double), intent(in) :: p(2, *), wt(*), u(*)
    real(c_double), intent(inout), target :: w(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    call this%open(w)
    if (this%ok()) call this%refuse_if(this%kept%n_conditions == 0, "HMALNG: there is no condition yet")
    if (this%ok()) call this%refuse_if(this%kept%condition(this%kept%n_conditions)%kind /= hm_slip, &
        "HMALNG: the KIND of the last condition is not 3")
    call this%refuse_if(ncp < 2, "NCP must be at least 2")
    call this%refuse_if(nidx < 2 .or. ideg < 1 .or. ideg > 5, "IDEG must be between 1 and 5, and NIDX at least 2")
    if (this%ok()) call keep_along(this, ncp, p, wt, ideg, nidx, idx, u)
    call this%finish(ierr, msg)
end subroutine
