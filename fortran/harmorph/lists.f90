! Where integers lie: those of 4 bytes as they are, those of 8 bytes converted.
module harmorph_lists
    use, intrinsic :: iso_c_binding, only: c_f_pointer, c_int32_t, c_int64_t, c_loc, c_null_ptr, c_ptr
    use harmorph_outcome, only: outcome
    implicit none
    private
    public :: list_of, small

    type :: integers
        integer(c_int32_t), allocatable :: at(:)
    end type

    type, public :: list
        type(c_ptr) :: start = c_null_ptr
        integer :: extents(2) = 1
        integer(c_int64_t) :: last = 0                          ! the value at the end
        logical :: contiguous = .true.
        type(integers), pointer :: copy => null()
    contains
        procedure :: check
    end type

    type, public :: kept_list                                   ! the copy that a mesh has of a list
        type(integers), pointer, private :: copy => null()
    contains
        procedure :: keep
        procedure :: append
        procedure :: forget
    end type

    ! Recursive, as gfortran's check of recursion (-fcheck=all) mistakes two calls in one statement for one.
    interface list_of
        procedure :: list_of_i4, list_of_i8, list_of_pairs_i4, list_of_pairs_i8
    end interface

contains
    recursive function list_of_i4(array) result(its)
        integer(c_int32_t), intent(in), target :: array(:)
        type(list) :: its
        its%extents(1) = size(array)
        its%contiguous = is_contiguous(array)
        if (size(array) > 0) then
            its%start = c_loc(array(1))
            its%last = array(size(array))
        end if
    end function

    recursive function list_of_pairs_i4(array) result(its)
        integer(c_int32_t), intent(in), target :: array(:, :)
        type(list) :: its
        its%extents = shape(array)
        its%contiguous = is_contiguous(array)
        if (size(array) > 0) its%start = c_loc(array(1, 1))
    end function

    recursive function list_of_i8(array) result(its)
        integer(c_int64_t), intent(in) :: array(:)
        type(list) :: its
        its%extents(1) = size(array)
        its%copy => converted(array, size(array))
        if (size(array) > 0) then
            its%start = c_loc(its%copy%at)
            its%last = array(size(array))
        end if
    end function

    recursive function list_of_pairs_i8(array) result(its)
        integer(c_int64_t), intent(in) :: array(:, :)
        type(list) :: its
        its%extents = shape(array)
        its%copy => converted(array, size(array))
        if (size(array) > 0) its%start = c_loc(its%copy%at)
    end function

    function converted(array, n) result(copy)
        integer, intent(in) :: n
        integer(c_int64_t), intent(in) :: array(n)              ! of any rank
        type(integers), pointer :: copy
        allocate(copy)
        copy%at = small(array)
    end function

    ! Numbers that do not fit become -1, which no check lets pass as a point.
    elemental function small(number) result(its)
        integer(c_int64_t), intent(in) :: number
        integer(c_int32_t) :: its
        its = -1
        if (abs(number) <= huge(its)) its = int(number, c_int32_t)
    end function

    subroutine check(self, name, done)
        class(list), intent(in) :: self
        character(len=*), intent(in) :: name
        type(outcome), intent(inout) :: done
        call done%refuse_if(.not. self%contiguous, name // " is not contiguous")
    end subroutine

    ! Takes over the copy, where there is one, for as long as address is in use; a refused list's copy ends here.
    subroutine keep(self, its, address, done)
        class(kept_list), intent(inout) :: self
        type(list), intent(in) :: its
        type(c_ptr), intent(inout) :: address
        type(outcome), intent(in) :: done
        type(kept_list) :: refused
        if (done%ok()) then
            call self%forget()
            self%copy => its%copy
            address = its%start
        else
            refused%copy => its%copy
            call refused%forget()
        end if
    end subroutine

    ! The n integers at address and some more behind them.
    subroutine append(self, address, n, more)
        class(kept_list), intent(inout) :: self
        type(c_ptr), intent(inout) :: address
        integer, intent(in) :: n
        integer(c_int32_t), intent(in) :: more(:)
        integer(c_int32_t), pointer :: old(:)
        type(integers), pointer :: grown
        allocate(grown)
        allocate(grown%at(n + size(more)))
        if (n > 0) then
            call c_f_pointer(address, old, [n])
            grown%at(:n) = old
        end if
        grown%at(n + 1:) = more
        call self%forget()
        self%copy => grown
        address = c_loc(grown%at)
    end subroutine

    subroutine forget(self)
        class(kept_list), intent(inout) :: self
        if (associated(self%copy)) deallocate(self%copy)
        nullify(self%copy)
    end subroutine
end module
