
! ---- Functions in parts, for codes on several processes: harmorph.h says how they go together

contains
    ! Memory for a basis that other bindings fill (harmorph_petsc.f90): room, then take with the object that they made
    ! there.
    subroutine basis_room(self, bytes, address, stat, err)
        class(hm_basis), intent(inout) :: self
        integer(c_size_t), intent(in) :: bytes
        type(c_ptr), intent(out) :: address
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        call self%free()
        call self%memory%take(bytes, done=done)
        address = self%memory%start
        call done%finish("basis%room", stat, err)
    end subroutine

    subroutine basis_take(self, handle)
        class(hm_basis), intent(inout) :: self
        type(c_ptr), intent(in) :: handle
        type(outcome) :: done
        self%handle = handle
        call count_points(self, done)
    end subroutine

    ! Length of a parcel of n points; 0 of a basis that is not solved.
    integer(c_int64_t) function basis_parcel_words(self, n)
        class(hm_basis), intent(in) :: self
        integer, intent(in) :: n
        type(hm_c_error) :: e
        basis_parcel_words = 0
        if (hm_c_parcel_size(self%address(), int(n, c_int32_t), basis_parcel_words, e) < 0) basis_parcel_words = 0
    end function

    ! The values of a share at some points, for another process: parcel(parcel_words(n)).
    subroutine basis_pack(self, points, parcel, stat, err)
        class(hm_basis), intent(in) :: self
        integer, intent(in) :: points(:)
        real(c_double), intent(inout) :: parcel(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        call need_basis(self, done)
        call done%refuse_if(size(parcel, kind=c_int64_t) < self%parcel_words(size(points)), &
            "parcel is too short")
        if (done%ok()) done%status = hm_c_parcel_pack(self%address(), int(size(points), c_int32_t), int(points, &
            c_int32_t), parcel, done%error)
        call done%finish("basis%pack", stat, err)
    end subroutine

    ! The parcels of all shares, in the order of their functions, make the extract of a share a basis.
    subroutine basis_unpack(self, parcel, stat, err)
        class(hm_basis), intent(inout) :: self
        real(c_double), intent(in) :: parcel(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        call need_basis(self, done)
        if (done%ok()) done%status = hm_c_parcel_unpack(self%address(), parcel, size(parcel, kind=c_int64_t), &
            done%error)
        call done%finish("basis%unpack", stat, err)
    end subroutine

!@each real
    ! The gradient by the control points, of all parts' sums.
    subroutine adjoint_finish_@FORM@(self, scale, sums, gradient, stat, err)
        class(hm_basis), intent(in) :: self
        integer, intent(in) :: scale
        integer(c_int64_t), intent(in) :: sums(:)
        real(@KIND@), intent(inout) :: gradient(:, :)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        real(c_double) :: its(size(gradient, 1), size(gradient, 2))
        call check_sums(self, sums, done)
        call check_pairs(self, its, done)
        if (done%ok()) done%status = hm_c_adjoint_finish(self%address(), int(scale, c_int32_t), sums, its, done%error)
        if (done%status >= hm_ok) gradient = real(its, @KIND@)
        call done%finish("basis%adjoint_finish", stat, err)
    end subroutine

!@end
