
! ---- The functions: solved, combined, by table, in single precision --------------------------------------------------

subroutine hmsolv(w, x, y, inc, resid, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: inc
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(in), target :: x(*), y(*)
    real(c_double), intent(inout) :: resid
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    call solve(w, x, y, inc, .false., resid, ierr, msg)
end subroutine

subroutine hmfact(w, x, y, inc, resid, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: inc
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(in), target :: x(*), y(*)
    real(c_double), intent(inout) :: resid
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    call solve(w, x, y, inc, .true., resid, ierr, msg)
end subroutine

subroutine hmcomb(w, n, num, a, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: n, num
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(in) :: a(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(c_ptr) :: made
    type(hm_c_memory) :: memory
    call this%open_solved(w)
    if (this%ok()) call this%told(hm_c_combine(made, memory, this%kept%basis, short(n), short(num), a, this%e))
    call this%spare(memory%bytes, memory%block)
    if (this%ok()) call this%told(hm_c_combine(made, memory, this%kept%basis, short(n), short(num), a, this%e))
    call replace_functions(this, made)
    call this%finish(ierr, msg)
end subroutine

subroutine hmtabl(w, m, num, n, ip, v, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: m, num, n, ip(*)
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(in), target :: v(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(hm_solve_report) :: report
    type(hm_c_modes) :: modes
    type(c_ptr) :: made
    type(hm_c_memory) :: memory
    call this%open_solved(w)
    if (this%ok()) call this%refuse_if(.not. c_associated(this%kept%plan), "W has no factor: call HMFACT first")
    if (this%ok()) call this%refuse_if(num < 1 .or. num > 2, "NUM must be 1 or 2")
    call this%list(ip, n, modes%points)
    modes%struct_size = int(c_sizeof(modes), c_int64_t)
    modes%n_modes = short(m)
    modes%numbers = short(num)
    modes%n = short(n)
    modes%values = c_loc(v)
    if (this%ok()) call this%told(hm_c_tabulate(made, memory, this%kept%plan, this%kept%basis, modes, report, this%e))
    call this%spare(memory%bytes, memory%block)
    report%struct_size = int(c_sizeof(report), c_int64_t)
    if (this%ok()) call this%told(hm_c_tabulate(made, memory, this%kept%plan, this%kept%basis, modes, report, this%e))
    call replace_functions(this, made)
    call this%finish(ierr, msg)
end subroutine

subroutine hmsngl(w, ierr, msg)
    use harmorph77
    implicit none
    real(c_double), intent(inout), target :: w(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(c_ptr) :: made
    type(hm_c_memory) :: memory
    call this%open_solved(w)
    if (this%ok()) call this%told(hm_c_single_init(made, memory, this%kept%basis, this%e))
    call this%spare(memory%bytes, memory%block)
    if (this%ok()) call this%told(hm_c_single_init(made, memory, this%kept%basis, this%e))
    call replace_functions(this, made)
    call this%finish(ierr, msg)
end subroutine
