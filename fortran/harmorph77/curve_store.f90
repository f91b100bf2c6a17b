
! ---- Curves in W -----------------------------------------------------------------------------------------------------

contains

    ! The curves that there are: those of the functions, otherwise those of HMFIT, HMCTRL and HMCURV.
    subroutine curves_now(this, set, list)
        type(legacy_call), intent(inout) :: this
        type(hm_c_curves), intent(out) :: set
        type(hm_c_curve), intent(inout) :: list(most_curves)
        if (.not. this%ok()) return
        if (c_associated(this%kept%basis)) then
            set%struct_size = int(c_sizeof(set), c_int64_t)
            list(1)%struct_size = int(c_sizeof(list(1)), c_int64_t)
            call this%told(hm_c_basis_curves(this%kept%basis, set, list, int(most_curves, c_int32_t), this%e))
        else
            set = this%kept%set
        end if
    end subroutine

    ! Control points p(2,n) alone, for curves to come.
    subroutine keep_control(this, n, p)
        type(legacy_call), intent(inout) :: this
        integer, intent(in) :: n
        real(c_double), intent(in) :: p(2, n)
        real(c_double), pointer :: copy(:, :)
        if (.not. this%fits(2_c_int64_t * n, this%kept%mesh_end)) return
        call forget_curves(this%kept)
        this%kept%set%control = this%at(this%kept%used + 1)
        this%kept%set%n_control = int(n, c_int32_t)
        call c_f_pointer(this%kept%set%control, copy, [2, n])
        copy = p
        this%kept%curves_end = this%kept%mesh_end + 2 * n
        call forget_functions(this%kept)
    end subroutine

    ! One more curve, through control points that count from 1.
    subroutine keep_curve(this, degree, n, indices, knots)
        type(legacy_call), intent(inout) :: this
        integer, intent(in) :: degree, n
        integer(c_int32_t), intent(in) :: indices(n)
        real(c_double), intent(in) :: knots(n + degree + 1)
        integer(c_int64_t) :: m
        integer(c_int32_t), pointer :: index_copy(:)
        real(c_double), pointer :: knot_copy(:)
        call this%refuse_if(this%kept%set%n_curves == most_curves, "there are 16 curves already")
        m = n + degree + 1
        if (.not. this%fits(m + (n + 1) / 2, this%kept%curves_end)) return
        call forget_functions(this%kept)
        associate (kept => this%kept)
            call c_f_pointer(this%at(kept%used + 1), knot_copy, [m])
            call c_f_pointer(this%at(kept%used + m + 1), index_copy, [n])
            knot_copy = knots
            index_copy = indices
            kept%set%n_curves = kept%set%n_curves + 1_c_int32_t
            kept%set%curve = c_loc(kept%curve)
            kept%curve(kept%set%n_curves) = hm_c_curve(int(c_sizeof(kept%curve(1)), c_int64_t), int(degree, &
                c_int32_t), &
                int(n, c_int32_t), c_loc(index_copy), c_loc(knot_copy))
            kept%curves_end = kept%curves_end + m + (n + 1) / 2
            call forget_functions(kept)
        end associate
    end subroutine

    ! Instead of the curves in W those of C, which lie elsewhere. Conditions and functions are forgotten.
    subroutine keep_set(this, address)
        type(legacy_call), intent(inout) :: this
        type(c_ptr), intent(in) :: address
        type(hm_c_curves), pointer :: set
        type(hm_c_curve), pointer :: list(:)
        integer(c_int32_t), pointer :: indices(:)
        integer(c_int32_t), allocatable :: from_1(:)
        real(c_double), pointer :: control(:, :), knots(:)
        integer(c_int64_t) :: words
        integer(c_int32_t) :: j, k, n
        if (.not. this%ok()) return
        call c_f_pointer(address, set)
        call c_f_pointer(set%curve, list, [set%n_curves])
        words = 2 * set%n_control
        do k = 1, set%n_curves
            words = words + list(k)%n_indices + list(k)%degree + 1 + (list(k)%n_indices + 1) / 2
        end do
        if (.not. this%fits(words, this%kept%mesh_end)) return
        call c_f_pointer(set%control, control, [2, int(set%n_control)])
        call keep_control(this, int(set%n_control), control)
        do k = 1, set%n_curves
            n = list(k)%n_indices
            allocate(from_1(n), source=[(j, j = 1, n)])
            if (c_associated(list(k)%indices)) then
                call c_f_pointer(list(k)%indices, indices, [n])
                from_1(:) = indices + 1_c_int32_t - set%index_base
            end if
            call c_f_pointer(list(k)%knots, knots, [n + list(k)%degree + 1])
            call keep_curve(this, int(list(k)%degree), int(n), from_1, knots)
            deallocate(from_1)
        end do
    end subroutine

    ! What HMREFN and HMELEV end with: the finer curves instead of the ones in W, under the same conditions, and the
    ! matrix a(old,ncp).
    subroutine keep_finer(this, finer, matrix, old, la, a, ncp)
        type(legacy_call), intent(inout) :: this
        type(c_ptr), intent(in) :: finer, matrix
        integer, intent(in) :: old, la
        real(c_double), intent(inout) :: a(*)
        integer, intent(out) :: ncp
        type(hm_c_curves), pointer :: set
        type(hm_c_condition) :: condition(most_conditions)
        type(hm_c_section) :: section
        real(c_double), pointer :: values(:)
        integer(c_int32_t) :: n_conditions
        call c_f_pointer(finer, set)
        ncp = int(set%n_control)
        call this%refuse_if(la < old * ncp, "A has not enough room: it takes the old control points times NCP")
        if (.not. this%ok()) return
        call c_f_pointer(matrix, values, [old * ncp])
        condition = this%kept%condition
        n_conditions = this%kept%n_conditions
        section = this%kept%section
        call keep_set(this, finer)
        if (.not. this%ok()) return
        a(:old * ncp) = values
        this%kept%condition = condition
        this%kept%n_conditions = n_conditions
        this%kept%section = section
    end subroutine
