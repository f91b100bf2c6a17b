
! ---- Measures of the section, smooth gradients, design variables -----------------------------------------------------

subroutine hmsect(w, icurv, ncurv, chord, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: icurv, ncurv
    real(c_double), intent(in) :: chord(4)
    real(c_double), intent(inout), target :: w(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    call this%open(w)
    if (this%ok()) this%kept%section = hm_c_section(this%kept%section%struct_size, &
        short(merge(icurv - 1, 0, ncurv > 0)), short(ncurv), chord(1), chord(2), chord(3), chord(4))
    call this%finish(ierr, msg)
end subroutine

subroutine hmmeas(w, kind, statn, dp, value, g, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: kind
    real(c_double), intent(in) :: statn, dp(2, *)
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(inout) :: value
    real(c_double), intent(inout), target :: g(2, *)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    call this%open_solved(w)
    call measure(this, "HMMEAS", hm_c_quantity(kind=short(kind), station=statn), dp, value, g)
    call this%finish(ierr, msg)
end subroutine

subroutine hmclea(w, npol, poly, dp, value, g, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: npol
    real(c_double), intent(in) :: dp(2, *)
    real(c_double), intent(in), target :: poly(2, *)
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(inout) :: value
    real(c_double), intent(inout), target :: g(2, *)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(hm_c_quantity) :: clearance
    call this%open_solved(w)
    clearance = hm_c_quantity(kind=hm_clearance, n_polygon=short(npol))
    clearance%polygon = c_loc(poly)
    call measure(this, "HMCLEA", clearance, dp, value, g)
    call this%finish(ierr, msg)
end subroutine

subroutine hmsmth(w, alen, g, s, ierr, msg)
    use harmorph77
    implicit none
    real(c_double), intent(in) :: alen, g(2, *)
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(inout) :: s(2, *)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(hm_c_curves) :: set
    type(hm_c_curve) :: list(most_curves)
    type(hm_c_memory) :: memory
    call this%open(w)
    call curves_now(this, set, list)
    if (this%ok()) call this%told(hm_c_smooth_gradient(set, alen, g, s, memory, this%e))
    call this%room(memory%bytes, memory%block)
    if (this%ok()) call this%told(hm_c_smooth_gradient(set, alen, g, s, memory, this%e))
    call this%finish(ierr, msg)
end subroutine

subroutine hmvars(w, kind, n1, n2, par, la, a, nv, err, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: kind, n1, n2, la
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(in), target :: par(*)
    real(c_double), intent(inout) :: a(*), err(*)
    integer, intent(out) :: nv, ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(hm_c_curves) :: set
    type(hm_c_curve) :: list(most_curves)
    type(hm_c_variables) :: variables
    integer(c_int32_t) :: n
    type(hm_c_memory) :: memory
    nv = 0
    call this%open(w)
    call curves_now(this, set, list)
    variables = hm_c_variables(kind=short(kind))
    variables%struct_size = int(c_sizeof(variables), c_int64_t)
    if (kind == hm_ffd) then
        variables%degree_x = short(n1)
        variables%degree_y = short(n2)
        variables%x_min = par(1)
        variables%y_min = par(2)
        variables%x_max = par(3)
        variables%y_max = par(4)
    else
        variables%n_upper = short(n1)
        variables%n_lower = short(n2)
    end if
    select case (kind)
    case (hm_cst)
        variables%leading_exponent = par(1)
        variables%trailing_exponent = par(2)
    case (hm_hicks_henne)
        variables%width = par(1)
        if (par(2) > 0) variables%peaks = c_loc(par(2))
    case (hm_naca4)
        if (par(1) > 0) variables%peaks = c_loc(par)
    end select
    if (this%ok()) call this%told(hm_c_variables_map(set, this%kept%section, variables, n, memory, a, err, this%e))
    if (this%ok()) then
        nv = int(n)
        call this%refuse_if(la < 2 * nv * set%n_control, "A is too small: A needs 2*NV*NCP numbers")
    end if
    call this%room(memory%bytes, memory%block)
    if (this%ok()) call this%told(hm_c_variables_map(set, this%kept%section, variables, n, memory, a, err, this%e))
    call this%finish(ierr, msg)
end subroutine
