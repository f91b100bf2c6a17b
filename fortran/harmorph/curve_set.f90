
! ---- Curves as plain data: read them, change them, assign them. And the C structs that point into them ---------------

    type, public :: hm_curve
        integer :: degree = 3
        integer(c_int32_t), allocatable :: indices(:)           ! not allocated: the control points in order
        real(c_double), allocatable :: knots(:)
    end type

    type, public :: hm_curves
        real(c_double), allocatable :: control(:, :)            ! (2,n_control)
        real(c_double), allocatable :: weights(:)               ! not allocated: not rational
        type(hm_curve), allocatable :: curve(:)
    contains
        procedure :: set => curves_set
        procedure :: check => curves_check
        procedure :: basis => curves_basis
        procedure :: point => curves_point
        procedure :: project => curves_project
        procedure :: refine => curves_refine
        procedure :: elevate => curves_elevate
        procedure :: measure => curves_measure
        procedure :: map => curves_map
!@each real
        procedure, private :: fit_@FORM@
        generic :: fit => fit_@FORM@
!@end
        procedure, private :: curves_add_all, curves_add_some_i4, curves_add_some_i8
        generic :: add => curves_add_all, curves_add_some_i4, curves_add_some_i8
    end type

contains
    ! Control points (2,n), and their weights where the curves are rational; forgets all curves.
    subroutine curves_set(self, control, weights)
        class(hm_curves), intent(inout) :: self
        real(c_double), intent(in) :: control(:, :)
        real(c_double), intent(in), optional :: weights(:)
        if (allocated(self%curve)) deallocate(self%curve)
        if (allocated(self%weights)) deallocate(self%weights)
        self%control = control
        if (present(weights)) self%weights = weights
    end subroutine

    ! A curve through all control points in order.
    subroutine curves_add_all(self, degree, knots)
        class(hm_curves), intent(inout) :: self
        integer, intent(in) :: degree
        real(c_double), intent(in) :: knots(:)
        call add_curve(self, hm_curve(degree=degree, knots=knots))
    end subroutine

    ! A curve through these; repeats close it, see harmorph.h.
    subroutine curves_add_some_i4(self, degree, knots, indices)
        class(hm_curves), intent(inout) :: self
        integer, intent(in) :: degree
        real(c_double), intent(in) :: knots(:)
        integer(c_int32_t), intent(in) :: indices(:)
        call add_curve(self, hm_curve(degree=degree, knots=knots, indices=indices))
    end subroutine

    subroutine curves_add_some_i8(self, degree, knots, indices)
        class(hm_curves), intent(inout) :: self
        integer, intent(in) :: degree
        real(c_double), intent(in) :: knots(:)
        integer(c_int64_t), intent(in) :: indices(:)
        call add_curve(self, hm_curve(degree=degree, knots=knots, indices=small(indices)))
    end subroutine

    subroutine add_curve(self, curve)
        class(hm_curves), intent(inout) :: self
        type(hm_curve), intent(in) :: curve
        type(hm_curve), allocatable :: grown(:)
        integer :: n
        n = 0
        if (allocated(self%curve)) n = size(self%curve)
        allocate(grown(n + 1))
        if (n > 0) grown(:n) = self%curve
        grown(n + 1) = curve
        call move_alloc(grown, self%curve)
    end subroutine

    ! C structs that point into the curves; `list` must outlive `set`. Both are empty if refused.
    subroutine c_curves_of(curves, set, list, done)
        class(hm_curves), intent(in), target :: curves
        type(hm_c_curves), intent(out) :: set
        type(hm_c_curve), intent(out), allocatable, target :: list(:)
        type(outcome), intent(inout) :: done
        integer :: k
        call check_lengths(curves, done)
        if (done%status < 0) return
        set%struct_size = int(c_sizeof(set), c_int64_t)
        set%index_base = 1
        set%n_control = int(size(curves%control, 2), c_int32_t)
        if (size(curves%control) > 0) set%control = c_loc(curves%control)
        if (allocated(curves%weights)) then
            if (size(curves%weights) > 0) set%weights = c_loc(curves%weights)
        end if
        allocate(list(size(curves%curve)))
        if (size(list) == 0) return
        do k = 1, size(list)
            list(k)%struct_size = int(c_sizeof(list(k)), c_int64_t)
            list(k)%degree = int(curves%curve(k)%degree, c_int32_t)
            list(k)%n_indices = int(size(curves%curve(k)%knots) - curves%curve(k)%degree - 1, c_int32_t)
            if (size(curves%curve(k)%knots) > 0) list(k)%knots = c_loc(curves%curve(k)%knots)
            if (allocated(curves%curve(k)%indices)) then
                if (size(curves%curve(k)%indices) > 0) list(k)%indices = c_loc(curves%curve(k)%indices)
            end if
        end do
        set%n_curves = int(size(list), c_int32_t)
        set%curve = c_loc(list)
    end subroutine

    ! What C cannot see: whether the arrays have the lengths that the numbers say.
    subroutine check_lengths(curves, done)
        class(hm_curves), intent(in) :: curves
        type(outcome), intent(inout) :: done
        integer :: k, n
        if (.not. allocated(curves%control) .or. .not. allocated(curves%curve)) then
            call done%refuse("curves without control points, or no curve was added")
            return
        end if
        call done%refuse_if(size(curves%control, 1) /= 2, "curves%control is not (2,n_control)")
        if (allocated(curves%weights)) then
            call done%refuse_if(size(curves%weights) /= size(curves%control, 2), &
                "one weight for each control point")
        end if
        do k = 1, size(curves%curve)
            if (.not. allocated(curves%curve(k)%knots)) then
                call done%refuse("a curve has no knots")
                return
            end if
            n = size(curves%control, 2)
            if (allocated(curves%curve(k)%indices)) n = size(curves%curve(k)%indices)
            if (size(curves%curve(k)%knots) /= n + curves%curve(k)%degree + 1) &
                call done%refuse("a curve must have as many knots as indices and degree + 1", hm_bad_curve)
        end do
    end subroutine

    ! Fortran's own copy of C's curves.
    subroutine copy_curves(set, list, curves)
        type(hm_c_curves), intent(in) :: set
        type(hm_c_curve), intent(in) :: list(:)
        class(hm_curves), intent(inout) :: curves
        type(hm_curves) :: made
        real(c_double), pointer :: control(:, :), numbers(:)
        integer(c_int32_t), pointer :: indices(:)
        integer :: k
        if (set%n_control == 0) allocate(made%control(2, 0))     ! rigid bodies alone
        if (set%n_control > 0) then
            call c_f_pointer(set%control, control, [2, int(set%n_control)])
            made%control = control
        end if
        if (c_associated(set%weights)) then
            call c_f_pointer(set%weights, numbers, [set%n_control])
            made%weights = numbers
        end if
        allocate(made%curve(set%n_curves))
        do k = 1, int(set%n_curves)
            made%curve(k)%degree = int(list(k)%degree)
            call c_f_pointer(list(k)%knots, numbers, [list(k)%n_indices + list(k)%degree + 1])
            made%curve(k)%knots = numbers
            if (c_associated(list(k)%indices)) then
                call c_f_pointer(list(k)%indices, indices, [list(k)%n_indices])
                made%curve(k)%indices = indices + 1_c_int32_t - set%index_base
            end if
        end do
        call move_alloc(made%control, curves%control)
        if (allocated(curves%weights)) deallocate(curves%weights)
        if (allocated(made%weights)) call move_alloc(made%weights, curves%weights)
        call move_alloc(made%curve, curves%curve)
    end subroutine
