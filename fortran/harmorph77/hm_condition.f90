
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
    call this%refuse_if(kind == hm_rigid, "a rigid body is made by HMRIGD")
    call this%refuse_if(kind == hm_periodic_pair, "a periodic pair is made by HMPAIR")
    call this%refuse_if(kind == hm_rotation_pair, "a pair of turned sides is made by HMTURN")
    condition = hm_c_condition(marker=mark, kind=kind)
    if (kind == hm_on_curve .or. .not. (icurv == ncurv .and. (icurv == 0 .or. icurv == 1))) then
        condition%first_curve = icurv - 1
        condition%n_curves = ncurv
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
    type(legacy_call) :: this
    call this%open(w)
    call keep_condition(this, hm_c_condition(marker=mark, kind=hm_rigid, body=ibody - 1, x=xc, y=yc))
    call this%finish(ierr, msg)
end subroutine

subroutine hmpair(w, mark, mark2, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: mark, mark2
    real(c_double), intent(inout), target :: w(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    call this%open(w)
    call keep_condition(this, hm_c_condition(marker=mark, kind=hm_periodic_pair, partner=mark2))
    call this%finish(ierr, msg)
end subroutine

subroutine hmturn(w, mark, mark2, xc, yc, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: mark, mark2
    real(c_double), intent(in) :: xc, yc
    real(c_double), intent(inout), target :: w(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    call this%open(w)
    call keep_condition(this, hm_c_condition(marker=mark, kind=hm_rotation_pair, partner=mark2, x=xc, y=yc))
    call this%finish(ierr, msg)
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
