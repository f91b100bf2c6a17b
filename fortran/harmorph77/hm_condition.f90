
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
    call this%refuse_if(kind == hm_rotation_pair, "KIND is that of a rotation pair: call HMTURN")
    call this%refuse_if(kind == hm_interface, "KIND is that of a sliding interface: call HMINTF")
    condition = hm_c_condition(marker=mark, kind=kind)
    if (kind == hm_on_curve .or. .not. (icurv == ncurv .and. (icurv == 0 .or. icurv == 1))) then
        condition%first_curve = icurv - 1
        condition%n_curves = ncurv
        if (kind == hm_on_curve .and. ncurv == 0 .and. this%ok()) &
            condition%n_curves = this%kept%set%n_curves - int(icurv - 1, c_int32_t)     ! all curves from ICURV on
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
    call add_condition(w, hm_c_condition(marker=mark, kind=hm_rigid, body=ibody - 1, x=xc, y=yc), ierr, msg)
end subroutine

subroutine hmpair(w, mark, mark2, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: mark, mark2
    real(c_double), intent(inout), target :: w(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    call add_condition(w, hm_c_condition(marker=mark, kind=hm_periodic_pair, partner=mark2), ierr, msg)
end subroutine

subroutine hmturn(w, mark, mark2, xc, yc, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: mark, mark2
    real(c_double), intent(in) :: xc, yc
    real(c_double), intent(inout), target :: w(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    call add_condition(w, hm_c_condition(marker=mark, kind=hm_rotation_pair, partner=mark2, x=xc, y=yc), ierr, msg)
end subroutine

subroutine hmintf(w, mark, mark2, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: mark, mark2
    real(c_double), intent(inout), target :: w(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    call add_condition(w, hm_c_condition(marker=mark, kind=hm_interface, partner=mark2), ierr, msg)
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

! Conditions with the same control points share one set of curves.
subroutine hmalng(w, ncp, p, wt, ideg, nidx, idx, u, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: ncp, ideg, nidx
    integer, intent(in), target :: idx(nidx)
    real(c_double), intent(in), target :: p(2, ncp), wt(ncp), u(*)
    real(c_double), intent(inout), target :: w(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    integer :: n, first
    call this%open(w)
    if (this%ok()) call this%refuse_if(this%kept%n_conditions == 0, "HMALNG: there is no condition yet")
    if (this%ok()) call this%refuse_if(this%kept%condition(this%kept%n_conditions)%kind /= hm_slip, &
        "HMALNG: the KIND of the last condition is not 3")
    if (this%ok()) then
        associate (kept => this%kept)
            n = kept%n_conditions
            kept%along_curve(n) = hm_c_curve(int(c_sizeof(kept%along_curve(n)), c_int64_t), &
                ideg, nidx, c_loc(idx), c_loc(u))
            kept%along(n) = hm_c_curves(int(c_sizeof(kept%along(n)), c_int64_t), &
                1_c_int32_t, ncp, c_loc(p), c_loc(wt), 1_c_int32_t, c_loc(kept%along_curve(n)))
            call this%told(hm_c_curves_check(kept%along(n), this%e))
            if (this%ok()) then
                first = 1
                do while (first < n)
                    if (c_associated(kept%condition(first)%along) .and. &
                        c_associated(kept%along(first)%control, c_loc(p))) exit
                    first = first + 1
                end do
                kept%condition(n)%along = c_loc(kept%along(first))
                kept%condition(n)%n_curves = 1
            end if
        end associate
    end if
    call this%finish(ierr, msg)
end subroutine
