
! ---- Integers of the caller: copies of 4 bytes each, whatever kind, stride or expression they come from --------------

    type :: integers
        integer(c_int32_t), allocatable :: at(:)
    contains
        procedure :: append => integers_append
        procedure :: address => integers_address
        procedure :: n => integers_n
    end type

    interface small
        procedure :: small_i4, small_i8
    end interface

contains
    ! ---- Integers

    elemental integer(c_int32_t) function small_i4(number)
        integer(c_int32_t), intent(in) :: number
        small_i4 = number
    end function

    ! Numbers that do not fit become -huge, which no check lets pass as a point or a cell.
    elemental integer(c_int32_t) function small_i8(number)
        integer(c_int64_t), intent(in) :: number
        small_i8 = -huge(small_i8)
        if (number >= hm_no_marker .and. number <= huge(small_i8)) small_i8 = int(number, c_int32_t)
    end function

    subroutine integers_append(self, more, done)
        class(integers), intent(inout) :: self
        integer(c_int32_t), intent(in) :: more(:)
        type(outcome), intent(inout) :: done
        integer(c_int32_t), allocatable :: grown(:)
        integer :: n, failed
        if (done%status < 0) return
        n = self%n()
        allocate(grown(n + size(more)), stat=failed)
        if (failed /= 0) then
            call done%refuse("no memory for a copy of integers", hm_block_too_small, 4._c_double * (n + size(more)))
            return
        end if
        if (n > 0) grown(:n) = self%at
        grown(n + 1:) = more
        call move_alloc(grown, self%at)
    end subroutine

    pure integer function integers_n(self)
        class(integers), intent(in) :: self
        integers_n = 0
        if (allocated(self%at)) integers_n = size(self%at)
    end function

    type(c_ptr) function integers_address(self)
        class(integers), intent(in), target :: self
        integers_address = c_null_ptr
        if (.not. allocated(self%at)) return
        if (size(self%at) > 0) integers_address = c_loc(self%at)
    end function

