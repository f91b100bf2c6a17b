
! ---- Blocks of memory: the caller's, or allocated here ---------------------------------------------------------------

    type :: block_of_memory
        integer(c_int64_t), pointer, private :: words(:) => null()      ! allocated here
        type(c_ptr) :: start = c_null_ptr
        integer(c_size_t) :: bytes = 0
    contains
        procedure :: take
        procedure :: give_back
        procedure :: allocated_here
    end type

contains
    pure function words_of(bytes) result(words)
        integer(c_size_t), intent(in) :: bytes
        integer(c_int64_t) :: words
        words = int((bytes + 7) / 8, c_int64_t)
    end function

    ! At least so many bytes: all of work, where it is given.
    subroutine take(self, bytes, work, done)
        class(block_of_memory), intent(inout) :: self
        integer(c_size_t), intent(in) :: bytes
        real(c_double), pointer, intent(in), optional :: work(:)
        type(outcome), intent(inout) :: done
        integer(c_int64_t), parameter :: huge_page = 2_c_int64_t**18    ! words
        integer(c_int64_t) :: n, skipped
        integer :: failed
        if (done%status < 0) return
        self%bytes = bytes
        if (present(work)) then
            if (.not. associated(work)) then
                call done%refuse("work is not associated")
                return
            end if
            self%bytes = 8 * size(work, kind=c_size_t)
            if (size(work) > 1) call done%refuse_if( &
                bytes_between(c_loc(work(1)), c_loc(work(min(2, size(work))))) /= 8, "work is not contiguous")
            if (done%status < 0) then
                self%bytes = 0
            else if (self%bytes < bytes .or. size(work) == 0) then
                call done%refuse("work is too small", hm_block_too_small, real(bytes - self%bytes, c_double))
            else
                self%start = c_loc(work(1))
            end if
            return
        end if
        n = words_of(bytes)
        if (n >= huge_page) n = n + huge_page       ! room to begin where a huge page of 2 MiB may begin
        allocate(self%words(n), stat=failed)
        if (failed == 0) then
            skipped = 0
            if (n >= 2 * huge_page) &
                skipped = modulo(-transfer(c_loc(self%words(1)), 0_c_intptr_t) / 8, int(huge_page, c_intptr_t))
            self%start = c_loc(self%words(skipped + 1))
        else
            nullify(self%words)
            call done%refuse("no memory for a block", hm_block_too_small, real(bytes, c_double))
        end if
    end subroutine

    pure logical function allocated_here(self)
        class(block_of_memory), intent(in) :: self
        allocated_here = associated(self%words)
    end function

    subroutine give_back(self)
        class(block_of_memory), intent(inout) :: self
        if (associated(self%words)) deallocate(self%words)
        nullify(self%words)
        self%start = c_null_ptr
        self%bytes = 0
    end subroutine
