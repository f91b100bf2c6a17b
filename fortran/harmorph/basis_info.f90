
! ---- What a basis tells of itself: its sizes and method, the curves and conditions that it was solved with

    type, public :: hm_basis_info
        integer(c_int64_t) :: bytes = 0
        logical :: solved = .false.
        integer :: points = 0, cells = 0, functions = 0, curves = 0, curve_points = 0, numbers_per_value = 0
        integer :: operator_kind = 0, scheme = 0, engine = 0, index_base = 0
        integer, allocatable :: curve_point(:)                  ! mesh points on curves
        integer, allocatable :: point_curve(:)                  ! the curve each is on; curves + b: rigid body b
        real(c_double), allocatable :: point_u(:)               ! and its parameter
        integer :: exponent_quarters = 0, bodies = 0            ! functions: control points, and two for each body
        logical :: offset_correction = .false.
        integer :: storage = hm_double                          ! hm_single: made by basis%single
        integer :: combined = 0                                 ! functions of design variables, made by basis%combine
        integer :: control_points = 0
        integer :: modes = 0                                    ! functions by table, made by plan%tabulate
    end type

contains
    subroutine basis_info(self, info, stat, err)
        class(hm_basis), intent(in) :: self
        type(hm_basis_info), intent(out) :: info
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(hm_c_basis_info) :: c
        integer(c_int32_t), pointer :: numbers(:)
        real(c_double), pointer :: u(:)
        call need_basis(self, done)
        c%struct_size = int(c_sizeof(c), c_int64_t)
        if (done%ok()) done%status = hm_c_basis_info_get(self%address(), c, done%error)
        if (done%status >= 0) then
            info%bytes = c%bytes
            info%solved = c%solved /= 0
            info%points = int(c%points)
            info%cells = int(c%cells)
            info%functions = int(c%functions)
            info%curves = int(c%curves)
            info%curve_points = int(c%curve_points)
            info%numbers_per_value = int(c%numbers_per_value)
            info%operator_kind = int(c%operator_kind)
            info%scheme = int(c%scheme)
            info%engine = int(c%engine)
            info%index_base = int(c%index_base)
            call c_f_pointer(c%curve_point, numbers, [c%curve_points])
            info%curve_point = int(numbers) + 1
            call c_f_pointer(c%point_curve, numbers, [c%curve_points])
            info%point_curve = int(numbers) + 1
            call c_f_pointer(c%point_u, u, [c%curve_points])
            info%point_u = u
            info%exponent_quarters = int(c%exponent_quarters)
            info%bodies = int(c%bodies)
            info%offset_correction = c%offset_correction /= 0
            info%storage = int(c%storage)
            info%combined = int(c%combined)
            info%control_points = int(c%control_points)
            info%modes = int(c%modes)
        end if
        call done%finish("basis%info", stat, err)
    end subroutine

    ! The curves the basis was solved with.
    subroutine basis_curves(self, curves, stat, err)
        class(hm_basis), intent(in) :: self
        type(hm_curves), intent(inout) :: curves
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(hm_c_curves) :: set
        type(hm_c_curve), allocatable :: list(:)
        type(hm_basis_info) :: info
        call need_basis(self, done)
        if (done%ok()) then
            call self%info(info)
            allocate(list(info%curves))
            set%struct_size = int(c_sizeof(set), c_int64_t)
            done%status = hm_c_basis_curves(self%address(), set, list, int(info%curves, c_int32_t), done%error)
        end if
        if (done%status >= 0) call copy_curves(set, list, curves)
        call done%finish("basis%curves", stat, err)
    end subroutine

    ! The same curves after a movement: their control points plus move.
    subroutine basis_moved_curves(self, move, curves, stat, err)
        class(hm_basis), intent(in) :: self
        real(c_double), intent(in) :: move(:, :)
        type(hm_curves), intent(inout) :: curves
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(hm_c_curves) :: set
        type(hm_c_curve), allocatable :: list(:)
        type(hm_basis_info) :: info
        real(c_double), allocatable, target :: control(:, :)
        call check_pairs(self, move, done)
        if (done%ok()) then
            call self%info(info)
            allocate(list(info%curves), control(2, max(info%control_points, 1)))
            set%struct_size = int(c_sizeof(set), c_int64_t)
            done%status = hm_c_moved_curves(self%address(), move, c_loc(control), set, list, &
                int(info%curves, c_int32_t), done%error)
        end if
        if (done%status >= 0) call copy_curves(set, list, curves)
        call done%finish("basis%moved_curves", stat, err)
    end subroutine

    ! The conditions the basis was solved with.
    subroutine basis_conditions(self, conditions, stat, err)
        class(hm_basis), intent(in) :: self
        type(hm_condition), allocatable, intent(out) :: conditions(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(hm_c_condition), allocatable :: list(:)
        integer(c_int32_t) :: n
        integer :: k
        n = 0
        call need_basis(self, done)
        do k = 1, 2                           ! first without room, to learn how many there are
            allocate(list(n))
            if (n > 0) list%struct_size = int(c_sizeof(list(1)), c_int64_t)
            if (done%ok() .or. k == 2) done%status = hm_c_basis_conditions(self%address(), list, n, n, done%error)
            if (.not. (k == 1 .and. done%status == hm_bad_argument .and. n > 0)) exit
            deallocate(list)
        end do
        if (done%status >= 0) then
            conditions = [(hm_condition(int(list(k)%marker), int(list(k)%kind), int(list(k)%first_curve) + 1, &
                int(list(k)%n_curves), int(list(k)%body) + 1, int(list(k)%partner), list(k)%x, list(k)%y, &
                int(list(k)%piece), list(k)%near_x, list(k)%near_y), k = 1, int(n))]
            where (conditions%kind == hm_slip .and. conditions%n_curves > 0) &
                conditions%first_curve = 0                      ! until `along` is set
        end if
        call done%finish("basis%conditions", stat, err)
    end subroutine
