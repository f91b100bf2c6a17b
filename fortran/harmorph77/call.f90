
! ---- One call: finds the state in W, takes memory from W, and tells how the call ended -------------------------------

    private :: open, open_solved, ok, told, refuse, refuse_if, forgive, fits, at, room, spare, finish

    type :: legacy_call
        type(state), pointer :: kept => null()
        type(hm_c_error) :: e                   ! for C functions, whose status goes to `told`
        integer(c_int64_t) :: top = 0           ! the last word of W that is free in this call
        type(hm_error), private :: outcome
    contains
        procedure :: open
        procedure :: open_solved
        procedure :: ok
        procedure :: told
        procedure :: refuse
        procedure :: refuse_if
        procedure :: forgive
        procedure :: fits
        procedure :: at
        procedure :: room
        procedure :: spare
        procedure :: finish
    end type

contains

    subroutine open(self, w)
        class(legacy_call), intent(inout) :: self
        real(c_double), intent(in), target :: w(*)
        type(state), pointer :: found
        call c_f_pointer(c_loc(w), found)
        if (found%here /= transfer(c_loc(w), found%here)) then
            call self%refuse("W was not opened by HMOPEN, or has moved")
            return
        end if
        self%kept => found
        self%top = found%words
    end subroutine

    ! What every use of the functions begins with.
    subroutine open_solved(self, w)
        class(legacy_call), intent(inout) :: self
        real(c_double), intent(in), target :: w(*)
        call self%open(w)
        if (.not. self%ok()) return
        if (.not. c_associated(self%kept%basis)) call self%refuse("there are no functions: HMSOLV or HMLOAD first")
    end subroutine

    ! Whether nothing was refused so far.
    logical function ok(self)
        class(legacy_call), intent(in) :: self
        ok = self%outcome%code >= hm_ok
    end function

    ! What a C function returned. The last warning stays.
    subroutine told(self, status)
        class(legacy_call), intent(inout) :: self
        integer(c_int32_t), intent(in) :: status
        if (status /= hm_ok) self%outcome = hm_error_of(status, self%e)
    end subroutine

    ! The first reason stays.
    subroutine refuse(self, text, code)
        class(legacy_call), intent(inout) :: self
        character(len=*), intent(in) :: text
        integer, intent(in), optional :: code
        if (.not. self%ok()) return
        self%outcome%code = hm_bad_argument
        if (present(code)) self%outcome%code = code
        self%outcome%text = text
    end subroutine

    subroutine refuse_if(self, wrong, text)
        class(legacy_call), intent(inout) :: self
        logical, intent(in) :: wrong
        character(len=*), intent(in) :: text
        if (wrong) call self%refuse(text)
    end subroutine

    ! Warnings so far are not for the caller.
    subroutine forgive(self)
        class(legacy_call), intent(inout) :: self
        if (self%ok()) self%outcome = hm_error()
    end subroutine

    ! Refuses if there are not so many free words behind `used`, or behind `from`.
    logical function fits(self, words, from)
        class(legacy_call), intent(inout) :: self
        integer(c_int64_t), intent(in) :: words
        integer(c_int64_t), intent(in), optional :: from
        character(len=112) :: text
        integer(c_int64_t) :: missing
        fits = .false.
        if (.not. self%ok()) return
        missing = self%kept%used + words - self%top
        if (present(from)) missing = from + words - self%top
        fits = missing <= 0
        write(text, "(a, i0, a)") "W is too small: it needs at least ", self%kept%all_words + missing, " words"
        if (.not. fits) call self%refuse(text, hm_block_too_small)
    end function

    ! Where word k of W lies.
    type(c_ptr) function at(self, k)
        class(legacy_call), intent(in) :: self
        integer(c_int64_t), intent(in) :: k
        at = transfer(self%kept%here + int(8 * (k - 1), c_intptr_t), c_null_ptr)
    end function

    ! Memory at the end of W until this call ends.
    subroutine room(self, bytes, place)
        class(legacy_call), intent(inout) :: self
        integer(c_size_t), intent(in) :: bytes
        type(c_ptr), intent(out) :: place
        place = c_null_ptr
        if (.not. self%ok()) return
        if (.not. self%fits(words_of(bytes))) return
        self%top = self%top - words_of(bytes)
        place = self%at(self%top + 1)
    end subroutine

    ! Memory behind what W keeps: to be kept, or until this call ends.
    subroutine spare(self, bytes, place)
        class(legacy_call), intent(inout) :: self
        integer(c_size_t), intent(in) :: bytes
        type(c_ptr), intent(out) :: place
        place = c_null_ptr
        if (.not. self%ok()) return
        if (self%fits(words_of(bytes))) place = self%at(self%kept%used + 1)
    end subroutine

    ! The end of every call.
    subroutine finish(self, ierr, msg)
        class(legacy_call), intent(in) :: self
        integer, intent(out) :: ierr
        character(len=*), intent(inout) :: msg
        ierr = self%outcome%code
        msg = self%outcome%text
    end subroutine
