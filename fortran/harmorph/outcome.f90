
! ---- How calls end: a status and C's error for each, told by stat and err or by stopping the program -----------------

    public :: hm_abi_version, hm_version, hm_status_name, hm_error_of, hm_finish

    character(len=*), parameter :: from_zero = " (from 0)"       ! what C's texts have behind numbers that count from 0

    type, public :: hm_error
        integer :: code = hm_ok
        integer :: item = -1                  ! first offending point, cell, ...; -1: none
        real(c_double) :: value = 0           ! what was found: area, residual, missing bytes
        character(len=112) :: text = ""
    end type

    ! Each call has one, passes its parts to C, and ends with finish.
    type :: outcome
        integer(c_int32_t) :: status = hm_ok
        type(hm_c_error) :: error
    contains
        procedure :: ok
        procedure :: refuse
        procedure :: refuse_if
        procedure :: check_version
        procedure :: finish
    end type

contains
    pure logical function ok(self)
        class(outcome), intent(in) :: self
        ok = self%status == hm_ok
    end function

    ! Refuses with a reason found here. An error that was found before stays.
    subroutine refuse(self, text, code, value)
        class(outcome), intent(inout) :: self
        character(len=*), intent(in) :: text
        integer, intent(in), optional :: code
        real(c_double), intent(in), optional :: value
        integer :: k
        if (self%status < 0) return
        self%status = hm_bad_argument
        if (present(code)) self%status = int(code, c_int32_t)
        self%error = hm_c_error(code=self%status)
        if (present(value)) self%error%value = value
        do k = 1, min(len_trim(text), size(self%error%text) - 1)
            self%error%text(k) = text(k:k)
        end do
    end subroutine

    subroutine refuse_if(self, wrong, text)
        class(outcome), intent(inout) :: self
        logical, intent(in) :: wrong
        character(len=*), intent(in) :: text
        if (wrong) call self%refuse(text)
    end subroutine

    subroutine check_version(self)
        class(outcome), intent(inout) :: self
        if (hm_c_abi_version() /= hm_abi) call self%refuse("harmorph.f90 and libharmorph.a are of different versions", &
            hm_unsupported)
    end subroutine

    ! The end of every call: tells the caller, or stops the program.
    subroutine finish(self, call, stat, err)
        class(outcome), intent(in) :: self
        character(len=*), intent(in) :: call
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call hm_finish(call, self%status, self%error, stat, err)
    end subroutine

    subroutine hm_finish(call, status, e, stat, err)
        character(len=*), intent(in) :: call                    ! its name, for the program's last words
        integer(c_int32_t), intent(in) :: status
        type(hm_c_error), intent(in) :: e
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_error) :: reason
        logical :: is_done                                      ! perhaps with a warning about the input
        is_done = status >= 0 .and. status /= hm_not_converged .and. status /= hm_short
        if (present(err)) err = hm_error_of(status, e)
        if (present(stat)) then
            stat = int(status)
        else if (.not. is_done) then
            reason = hm_error_of(status, e)
            write(error_unit, "(7a)") "harmorph: ", call, ": ", hm_status_name(int(status)), ": ", trim(reason%text)
            if (status < 0) error stop "harmorph: refused"
            error stop "harmorph: not as asked"
        end if
    end subroutine

    ! C's error, where all numbers count from 1.
    function hm_error_of(status, e) result(error)
        integer(c_int32_t), intent(in) :: status
        type(hm_c_error), intent(in) :: e
        type(hm_error) :: error
        error = hm_error(int(status), int(e%item), e%value, sentence(e))
        if (counts_from_zero(error%text, error%item)) error%item = error%item + 1
        call count_from_one(error%text)
    end function

    ! Whether the first place where the text names this number says that it counts from 0.
    pure logical function counts_from_zero(text, number)
        character(len=*), intent(in) :: text
        integer, intent(in) :: number
        character(len=12) :: digits
        integer :: begin, end, found
        counts_from_zero = .false.
        write(digits, "(i0)") number
        end = 0
        do
            found = index(text(end + 1:), trim(digits))
            if (found == 0) return
            begin = end + found
            end = begin + len_trim(digits) - 1
            if (verify(text(end + 1:end + 1), "0123456789") == 0) cycle
            if (begin > 1) then
                if (verify(text(begin - 1:begin - 1), "0123456789-.") == 0) cycle
            end if
            counts_from_zero = text(end + 1:min(end + len(from_zero), len(text))) == from_zero
            return
        end do
    end function

    ! 7 (from 0) is 8.
    pure subroutine count_from_one(text)
        character(len=*), intent(inout) :: text
        character(len=12) :: digits
        integer :: begin, end, number
        do
            end = index(text, from_zero) - 1
            if (end < 1) return
            begin = verify(text(:end), "-0123456789", back=.true.) + 1
            number = 0
            if (begin <= end) read(text(begin:end), *) number
            write(digits, "(i0)") number + 1
            text = text(:begin - 1) // trim(digits) // text(end + 1 + len(from_zero):)
        end do
    end subroutine

    pure function sentence(e) result(text)
        type(hm_c_error), intent(in) :: e
        character(len=112) :: text
        integer :: k
        text = ""
        do k = 1, size(e%text)
            if (e%text(k) == c_null_char) exit
            text(k:k) = e%text(k)
        end do
    end function

    integer function hm_abi_version()
        hm_abi_version = int(hm_c_abi_version())
    end function

    function hm_version() result(text)
        character(len=:), allocatable :: text
        text = c_string(hm_c_version())
    end function

    function hm_status_name(status) result(text)
        integer, intent(in) :: status
        character(len=:), allocatable :: text
        text = c_string(hm_c_status_name(int(status, c_int32_t)))
    end function

    function c_string(start) result(text)
        type(c_ptr), intent(in) :: start
        character(len=:), allocatable :: text
        character(kind=c_char), pointer :: letters(:)
        integer :: k, n
        call c_f_pointer(start, letters, [100])
        n = 0
        do while (letters(n + 1) /= c_null_char)
            n = n + 1
        end do
        allocate(character(len=n) :: text)
        do k = 1, n
            text(k:k) = letters(k)
        end do
    end function
