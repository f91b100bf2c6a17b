
! ---- Where arrays lie that are used after the call that was given them -----------------------------------------------
!
! Dummy arguments of such calls are pointers with intent(in): the compiler then associates them with the caller's array
! itself, refuses arrays without TARGET, and refuses expressions, of which it would otherwise pass a temporary copy.

    type :: array_place                                         ! two arrays of numbers: point (i,j) is at
        type(c_ptr) :: x = c_null_ptr, y = c_null_ptr           ! x + step(1)*(i-1) + step(2)*(j-1), and so y
        integer(c_intptr_t) :: step(2) = 0                      ! [bytes]
        integer :: extents(2) = 1
        integer :: precision = hm_double
        logical :: block = .false.                              ! arrays (i,j)
        character(len=112) :: wrong = ""
    contains
        procedure :: n => place_n
        procedure :: stride => place_stride
        procedure :: read => place_read
        procedure :: write => place_write
    end type

    interface place_of
        procedure :: place_of_v8, place_of_v4, place_of_b8, place_of_b4
    end interface

    character(len=*), parameter :: not_in_place = "this compiler does not pass components in place: call points_at"

contains
    ! ---- Places of arrays

!@each vector
    function place_of_@FORM@(x, y) result(place)
        real(@KIND@), pointer, intent(in) :: x(:), y(:)
        type(array_place) :: place
        place%precision = merge(hm_single, hm_double, kind(x) == c_float)
        if (.not. associated(x) .or. .not. associated(y)) then
            place%wrong = "an array of coordinates is not associated"
            return
        end if
        place%extents(1) = size(x)
        if (size(y) /= size(x)) place%wrong = "x and y have different lengths"
        if (size(x) == 0) place%wrong = "an array of coordinates is empty"
        if (place%wrong /= "") return
        place%x = c_loc(x(1))
        place%y = c_loc(y(1))
        if (size(x) == 1) return
        place%step(1) = bytes_between(place%x, c_loc(x(2)))
        if (place%step(1) /= bytes_between(place%y, c_loc(y(2)))) &
            place%wrong = "x and y do not have the same distance from point to point"
        call check_place(place, is_contiguous(x) .or. is_contiguous(y), storage_size(x) / 8)
    end function

!@end
!@each block
    function place_of_@FORM@(x, y) result(place)
        real(@KIND@), pointer, intent(in) :: x(:, :), y(:, :)
        type(array_place) :: place
        place%precision = merge(hm_single, hm_double, kind(x) == c_float)
        place%block = .true.
        if (.not. associated(x) .or. .not. associated(y)) then
            place%wrong = "an array of coordinates is not associated"
            return
        end if
        place%extents = shape(x)
        if (any(shape(y) /= shape(x))) place%wrong = "x and y have different shapes"
        if (any(shape(x) < 2)) place%wrong = "a block has fewer than two points along i or j"
        if (place%wrong /= "") return
        place%x = c_loc(x(1, 1))
        place%y = c_loc(y(1, 1))
        place%step = [bytes_between(place%x, c_loc(x(2, 1))), bytes_between(place%x, c_loc(x(1, 2)))]
        if (any(place%step /= [bytes_between(place%y, c_loc(y(2, 1))), bytes_between(place%y, c_loc(y(1, 2)))])) &
            place%wrong = "x and y do not have the same distance from point to point"
        call check_place(place, is_contiguous(x) .or. is_contiguous(y), storage_size(x) / 8)
    end function

!@end
    function place_at(x, y, bytes, n, precision) result(place)
        type(c_ptr), intent(in) :: x, y
        integer, intent(in) :: bytes, n
        integer, intent(in), optional :: precision
        type(array_place) :: place
        place%x = x
        place%y = y
        place%step(1) = bytes
        place%extents(1) = n
        if (present(precision)) place%precision = precision
        if (.not. c_associated(x) .or. .not. c_associated(y)) place%wrong = "an address of coordinates is null"
        if (n < 1) place%wrong = "n must be at least 1"
        if (place%precision /= hm_double .and. place%precision /= hm_single) &
            place%wrong = "precision must be hm_double or hm_single"
        if (bytes < merge(4, 8, place%precision == hm_single)) &
            place%wrong = "bytes from point to point are fewer than those of a number"
    end function

    ! gfortran (12) associates a pointer dummy with the first component of a derived type, whichever is given, and then
    ! takes the array for contiguous, which its distances from point to point contradict.
    subroutine check_place(place, contiguous, bytes)
        type(array_place), intent(inout) :: place
        logical, intent(in) :: contiguous
        integer, intent(in) :: bytes                            ! of a number
        if (place%wrong /= "") return
        if (contiguous .and. any(place%step /= bytes * [1, merge(place%extents(1), 0, place%block)])) &
            place%wrong = not_in_place
        if (bytes_between(place%x, place%y) == 0) &
            place%wrong = "x and y are the same array; of a derived type: call points_at"
    end subroutine

    pure integer(c_intptr_t) function bytes_between(from, to)
        type(c_ptr), intent(in) :: from, to
        bytes_between = transfer(to, bytes_between) - transfer(from, bytes_between)
    end function

    pure integer(c_int64_t) function place_n(self)
        class(array_place), intent(in) :: self
        place_n = product(int(self%extents, c_int64_t))
    end function

    ! [doubles] from point to point where the library can use the arrays as they lie, otherwise 0.
    pure integer(c_int64_t) function place_stride(self)
        class(array_place), intent(in) :: self
        place_stride = 0
        if (self%precision /= hm_double .or. self%step(1) < 0 .or. mod(self%step(1), 8_c_intptr_t) /= 0) return
        if (self%block .and. self%step(2) /= self%extents(1) * self%step(1)) return
        place_stride = max(self%step(1) / 8, 1_c_intptr_t)
    end function

    ! The numbers as they are now, in copy(n, 2).
    subroutine place_read(self, copy)
        class(array_place), intent(in) :: self
        real(c_double), intent(inout) :: copy(:, :)
        real(c_double), pointer :: double
        real(c_float), pointer :: single
        integer :: k, xy
        do xy = 1, 2
            do k = 1, int(self%n())
                if (self%precision == hm_single) then
                    call c_f_pointer(address_of(self, xy, k), single)
                    copy(k, xy) = real(single, c_double)
                else
                    call c_f_pointer(address_of(self, xy, k), double)
                    copy(k, xy) = double
                end if
            end do
        end do
    end subroutine

    ! The way back.
    subroutine place_write(self, copy)
        class(array_place), intent(in) :: self
        real(c_double), intent(in) :: copy(:, :)
        real(c_double), pointer :: double
        real(c_float), pointer :: single
        integer :: k, xy
        do xy = 1, 2
            do k = 1, int(self%n())
                if (self%precision == hm_single) then
                    call c_f_pointer(address_of(self, xy, k), single)
                    single = real(copy(k, xy), c_float)
                else
                    call c_f_pointer(address_of(self, xy, k), double)
                    double = copy(k, xy)
                end if
            end do
        end do
    end subroutine

    ! x or y (1 or 2) of point k.
    pure type(c_ptr) function address_of(self, xy, k) result(address)
        class(array_place), intent(in) :: self
        integer, intent(in) :: xy, k
        integer(c_intptr_t) :: start
        start = transfer(self%x, start)
        if (xy == 2) start = transfer(self%y, start)
        address = transfer(start + mod(k - 1, &
            self%extents(1)) * self%step(1) + ((k - 1) / self%extents(1)) * self%step(2), &
            c_null_ptr)
    end function
