
! ---- A work array, options, files ------------------------------------------------------------------------------------

subroutine hmopen(w, lw, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: lw
    real(c_double), intent(inout), target :: w(lw)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(state), pointer :: kept
    type(state) :: fresh
    character(len=112) :: text
    write(text, "(a, i0, a)") "W is too small: W needs at least ", words_of(c_sizeof(fresh)), " words"
    if (lw < words_of(c_sizeof(fresh))) call this%refuse(text, hm_block_too_small)
    call this%refuse_if(hm_abi_version() /= hm_abi, "harmorph77.f90 and libharmorph.a have different versions")
    if (this%ok()) then
        call c_f_pointer(c_loc(w), kept)
        call begin(kept, c_loc(w), int(lw, c_int64_t))
    end if
    call this%finish(ierr, msg)
end subroutine

subroutine hmclos(w)
    use harmorph77
    implicit none
    real(c_double), intent(inout) :: w(*)
    w(1) = 0
end subroutine

! Says why the last call with this W, except HMERR, was refused. All numbers count from 1.
subroutine hmerr(w, kind, item, kind2, item2, value, xy)
    use harmorph77
    implicit none
    real(c_double), intent(inout), target :: w(*)
    integer, intent(out) :: kind, item, kind2, item2
    real(c_double), intent(out) :: value, xy(2)
    type(legacy_call) :: this
    type(hm_error) :: last
    call this%open(w)
    if (this%ok()) last = hm_error_of(0_c_int32_t, this%kept%last)
    kind = last%item_kind
    item = last%item
    kind2 = last%other_kind
    item2 = last%other
    value = last%value
    xy = [last%x, last%y]
end subroutine

! HMSOLV checks whether the values are possible together.
subroutine hmopt(w, name, ival, ierr, msg)
    use harmorph77
    implicit none
    character(len=*), intent(in) :: name
    integer, intent(in) :: ival
    real(c_double), intent(inout), target :: w(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    call this%open(w)
    if (this%ok()) then
        associate (options => this%kept%options, value => short(ival))
            select case (name)
            case ("OPERATOR")
                options%operator_kind = value
            case ("EXPONENT")
                options%exponent = value / 4._c_double
            case ("SCHEME")
                this%kept%study%scheme = value
            case ("ENGINE")
                options%engine = value
            case ("OFFSET")
                options%offset_correction = value
            case default
                call this%refuse("NAME is unknown: " // name)
            end select
        end associate
    end if
    call this%finish(ierr, msg)
end subroutine

! Writes two records: the length, and the block unchanged.
subroutine hmsave(w, lun, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: lun
    real(c_double), intent(inout), target :: w(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    integer(c_int8_t), pointer :: block(:)
    integer(c_int64_t) :: bytes
    integer :: failed
    call this%open_solved(w)
    if (this%ok()) bytes = bytes_of_functions(this)
    if (this%ok()) then
        call c_f_pointer(this%kept%basis, block, [bytes])
        write(lun, iostat=failed) bytes
        if (failed == 0) write(lun, iostat=failed) block
        call this%refuse_if(failed /= 0, "the functions cannot be written to the unit")
    end if
    call this%finish(ierr, msg)
end subroutine

subroutine hmload(w, lun, x, y, inc, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: lun, inc
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(in), target :: x(*), y(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(c_ptr) :: basis, place
    integer(c_int8_t), pointer :: block(:)
    integer(c_int64_t) :: bytes
    integer :: failed
    bytes = 0
    call open_at(this, w, x, y, inc)
    if (this%ok()) then
        call forget_curves(this%kept)
        this%top = this%kept%words
        read(lun, iostat=failed) bytes
        if (failed /= 0) bytes = 0
        call this%refuse_if(bytes < 1, "the unit contains no functions that HMSAVE has written")
    end if
    call this%spare(int(bytes, c_size_t), place)
    if (this%ok()) then
        call c_f_pointer(place, block, [bytes])
        read(lun, iostat=failed) block
        call this%refuse_if(failed /= 0, "the file ends before all functions are read")
    end if
    if (this%ok()) call this%told(hm_c_basis_attach(basis, place, int(bytes, c_size_t), c_loc(this%kept%mesh), this%e))
    call keep_functions(this, basis)
    call this%finish(ierr, msg)
end subroutine
