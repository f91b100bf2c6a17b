
! ---- Functions in files: written once, read without solving

contains
    ! How long the basis is, in memory and in a file.
    integer(c_int64_t) function basis_bytes(self)
        class(hm_basis), intent(in) :: self
        type(hm_c_basis_info) :: info
        type(hm_c_error) :: e
        info%struct_size = int(c_sizeof(info), c_int64_t)
        basis_bytes = 0
        if (hm_c_basis_info_get(self%address(), info, e) >= 0) basis_bytes = info%bytes
    end function

    ! To where the unit stands, opened with access="stream", form="unformatted".
    subroutine basis_write(self, unit, stat, err)
        class(hm_basis), intent(in) :: self
        integer, intent(in) :: unit
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        integer(c_int8_t), pointer :: bytes(:)
        integer :: failed
        character(len=80) :: reason
        call need_basis(self, done)
        if (done%ok()) then
            call c_f_pointer(self%address(), bytes, [self%bytes()])
            write(unit, iostat=failed, iomsg=reason) bytes
            if (failed /= 0) call done%refuse("the basis cannot be written: " // reason, hm_bad_basis)
        end if
        call done%finish("basis%write", stat, err)
    end subroutine

    ! From where the unit stands: so many bytes, or all that the file still has.
    subroutine basis_read(self, unit, mesh, bytes, stat, err)
        class(hm_basis), intent(inout) :: self
        integer, intent(in) :: unit
        type(hm_mesh), intent(in), optional :: mesh
        integer(c_int64_t), intent(in), optional :: bytes
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        integer(c_int8_t), pointer :: letters(:)
        integer(c_int64_t) :: n, position
        integer :: failed
        character(len=80) :: reason
        call self%free()
        if (present(bytes)) then
            n = bytes
        else
            inquire(unit, size=n, pos=position)
            n = n - position + 1
        end if
        if (n < 1) call done%refuse("no basis can be read: the file has ended, or is none", hm_bad_basis)
        call room_for(self, n, letters, done)
        if (done%ok()) then
            read(unit, iostat=failed, iomsg=reason) letters
            if (failed /= 0) call done%refuse("the basis cannot be read: " // reason, hm_bad_basis)
        end if
        call attach_block(self, mesh, done)
        call done%finish("basis%read", stat, err)
    end subroutine

    subroutine basis_save(self, file, stat, err)
        class(hm_basis), intent(in) :: self
        character(len=*), intent(in) :: file
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        integer :: unit
        call done%refuse_if(.not. c_associated(self%address()), "the basis is empty: there is nothing to save")
        call open_stream(unit, file, "write", done)
        call done%finish("basis%save", stat, err)
        if (.not. done%ok()) return
        call self%write(unit, stat, err)
        close(unit)
    end subroutine

    subroutine basis_load(self, file, mesh, stat, err)
        class(hm_basis), intent(inout) :: self
        character(len=*), intent(in) :: file
        type(hm_mesh), intent(in), optional :: mesh
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        integer :: unit
        call open_stream(unit, file, "read", done)
        call done%finish("basis%load", stat, err)
        if (.not. done%ok()) return
        call self%read(unit, mesh, stat=stat, err=err)
        close(unit)
    end subroutine

    subroutine open_stream(unit, file, action, done)
        integer, intent(inout) :: unit
        character(len=*), intent(in) :: file, action
        type(outcome), intent(inout) :: done
        integer :: failed
        character(len=80) :: reason
        if (.not. done%ok()) return
        open(newunit=unit, file=file, access="stream", form="unformatted", action=action, iostat=failed, iomsg=reason, &
            status=merge("replace", "old    ", action == "write"))
        if (failed /= 0) call done%refuse(reason, hm_bad_basis)
    end subroutine
