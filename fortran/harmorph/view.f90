
! ---- Coordinates of one call -----------------------------------------------------------------------------------------
!
! Calls come in four forms, _v8, _v4, _b8 and _b4: vectors x(:) or blocks x(:, :), of real(c_double) or real(c_float).
! view_of makes one thing of them, put_back hands results to what had to be copied. space_for is the same for arrays
! that only receive results: what they hold may be no number, and is not converted. Nothing of it outlives the call, so
! that the arrays may be temporary copies of the compiler.

    type :: view
        type(c_ptr) :: x = c_null_ptr, y = c_null_ptr
        integer(c_int64_t) :: stride = 1, n = 0
        integer :: ni = 0, nj = 0                               ! of a block
        real(c_double), pointer :: copy(:, :, :) => null()      ! (n,1,2) or (ni,nj,2), where there must be one
        character(len=112) :: wrong = ""
    contains
        procedure :: drop
        procedure, private :: put_back_v8, put_back_b8, put_back_v4, put_back_b4
        generic :: put_back => put_back_v8, put_back_b8, put_back_v4, put_back_b4
    end type

    interface view_of
        procedure :: view_of_v8, view_of_b8, view_of_v4, view_of_b4
    end interface
    interface space_for
        procedure :: view_of_v8, view_of_b8, space_for_v4, space_for_b4
    end interface

contains
    function view_of_v8(x, y) result(v)
        real(c_double), intent(in), target :: x(:), y(:)
        type(view) :: v
        integer(c_intptr_t) :: bytes
        v%n = size(x, kind=c_int64_t)
        if (size(y, kind=c_int64_t) /= v%n) v%wrong = "x and y have different lengths"
        if (v%n == 0) v%wrong = "an array of coordinates is empty"
        if (v%wrong /= "") return
        v%x = c_loc(x(1))
        v%y = c_loc(y(1))
        if (v%n == 1) return
        bytes = bytes_between(v%x, c_loc(x(2)))
        v%stride = bytes / 8
        if (bytes > 0 .and. mod(bytes, 8_c_intptr_t) == 0 .and. bytes == bytes_between(v%y, c_loc(y(2)))) return
        call make_copy(v, shape(x), shape(y))
        if (.not. associated(v%copy)) return
        v%copy(:, 1, 1) = x
        v%copy(:, 1, 2) = y
    end function

    ! By addresses, as points_at has them.
    function view_at(place) result(v)
        type(array_place), intent(in) :: place
        type(view) :: v
        v%n = place%n()
        v%x = place%x
        v%y = place%y
        v%stride = place%stride()
        v%wrong = place%wrong
        if (v%wrong == "" .and. v%stride == 0) v%wrong = "bytes from point to point are not a multiple of 8"
    end function

    function view_of_b8(x, y) result(v)
        real(c_double), intent(in), target :: x(:, :), y(:, :)
        type(view) :: v
        if (is_contiguous(x) .and. is_contiguous(y) .and. all(shape(x) == shape(y)) .and. size(x) > 0) then
            v%ni = size(x, 1)
            v%nj = size(x, 2)
            v%n = size(x, kind=c_int64_t)
            v%x = c_loc(x(1, 1))
            v%y = c_loc(y(1, 1))
            return
        end if
        call make_copy(v, shape(x), shape(y))
        if (.not. associated(v%copy)) return
        v%copy(:, :, 1) = x
        v%copy(:, :, 2) = y
    end function

    function view_of_v4(x, y) result(v)
        real(c_float), intent(in) :: x(:), y(:)
        type(view) :: v
        call make_copy(v, shape(x), shape(y))
        if (.not. associated(v%copy)) return
        v%copy(:, 1, 1) = real(x, c_double)
        v%copy(:, 1, 2) = real(y, c_double)
    end function

    function view_of_b4(x, y) result(v)
        real(c_float), intent(in) :: x(:, :), y(:, :)
        type(view) :: v
        call make_copy(v, shape(x), shape(y))
        if (.not. associated(v%copy)) return
        v%copy(:, :, 1) = real(x, c_double)
        v%copy(:, :, 2) = real(y, c_double)
    end function

    function space_for_v4(x, y) result(v)
        real(c_float), intent(in) :: x(:), y(:)
        type(view) :: v
        call make_copy(v, shape(x), shape(y))
        if (associated(v%copy)) v%copy = 0
    end function

    function space_for_b4(x, y) result(v)
        real(c_float), intent(in) :: x(:, :), y(:, :)
        type(view) :: v
        call make_copy(v, shape(x), shape(y))
        if (associated(v%copy)) v%copy = 0
    end function

    subroutine make_copy(v, shape_x, shape_y)
        type(view), intent(inout) :: v
        integer, intent(in) :: shape_x(:), shape_y(:)
        integer :: extents(2), failed
        if (any(shape_x /= shape_y)) v%wrong = "x and y have different shapes"
        if (any(shape_x == 0)) v%wrong = "an array of coordinates is empty"
        if (v%wrong /= "") return
        extents = 1                                             ! of a vector: n, 1
        extents(:size(shape_x)) = shape_x
        allocate(v%copy(extents(1), extents(2), 2), stat=failed)
        if (failed /= 0) then
            nullify(v%copy)
            v%wrong = "no memory to convert the coordinates"
            return
        end if
        v%n = size(v%copy, kind=c_int64_t) / 2
        v%stride = 1
        v%x = c_loc(v%copy(1, 1, 1))
        v%y = c_loc(v%copy(1, 1, 2))
        if (size(shape_x) == 1) return
        v%ni = shape_x(1)
        v%nj = shape_x(2)
    end subroutine

    ! As C has it.
    pure function c_points(v) result(points)
        type(view), intent(in) :: v
        type(hm_c_points) :: points
        points = hm_c_points(v%x, v%y, v%stride)
    end function

    ! Of points that need not be given: null where they are not.
    function c_address(points) result(address)
        type(hm_c_points), intent(in), target :: points
        type(c_ptr) :: address
        address = c_null_ptr
        if (c_associated(points%x)) address = c_loc(points)
    end function

    ! The end of a view.
    subroutine drop(self)
        class(view), intent(inout) :: self
        if (associated(self%copy)) deallocate(self%copy)
        nullify(self%copy)
    end subroutine

    subroutine put_back_v8(self, x, y)
        class(view), intent(inout) :: self
        real(c_double), intent(inout) :: x(:), y(:)
        if (.not. associated(self%copy)) return
        x = self%copy(:, 1, 1)
        y = self%copy(:, 1, 2)
        call self%drop()
    end subroutine

    subroutine put_back_b8(self, x, y)
        class(view), intent(inout) :: self
        real(c_double), intent(inout) :: x(:, :), y(:, :)
        if (.not. associated(self%copy)) return
        x = self%copy(:, :, 1)
        y = self%copy(:, :, 2)
        call self%drop()
    end subroutine

    subroutine put_back_v4(self, x, y)
        class(view), intent(inout) :: self
        real(c_float), intent(inout) :: x(:), y(:)
        if (.not. associated(self%copy)) return
        x = real(self%copy(:, 1, 1), c_float)
        y = real(self%copy(:, 1, 2), c_float)
        call self%drop()
    end subroutine

    subroutine put_back_b4(self, x, y)
        class(view), intent(inout) :: self
        real(c_float), intent(inout) :: x(:, :), y(:, :)
        if (.not. associated(self%copy)) return
        x = real(self%copy(:, :, 1), c_float)
        y = real(self%copy(:, :, 2), c_float)
        call self%drop()
    end subroutine
