
! ---- Design with curves: more control points, measures of a section, design variables that are not control points ----

    type, public :: hm_section                                  ! which curves are the outline, and its chord
        integer :: first_curve = 1, n_curves = 0                ! 0: all from the first one on
        real(c_double) :: nose(2) = 0, edge(2) = 0              ! a chord that does not move; all 0: that of the curves
    end type

    type, public :: hm_quantity                                 ! hm_quantity(hm_thickness, 0.25_dp)
        integer :: kind = hm_area
        real(c_double) :: station = 0                           ! of hm_thickness and hm_camber
        real(c_double), allocatable :: polygon(:, :)            ! (2,n) of hm_clearance
    end type

    type, public :: hm_variables                                ! hm_variables(hm_cst, n_upper=6, n_lower=6)
        integer :: kind = hm_ffd
        integer :: n_upper = 0, n_lower = 0
        integer :: degree_x = 0, degree_y = 0
        real(c_double) :: box(4) = 0                            ! x_min, y_min, x_max, y_max; all 0: round all points
        real(c_double), allocatable :: peaks(:)
        real(c_double) :: nose_exponent = 0, edge_exponent = 0, width = 0
    end type

contains
    ! The same curves with knots u inserted into one of them. matrix(new,old): new control points are matmul(control,
    ! transpose(matrix)), gradients by the old ones matmul(gradient, matrix).
    subroutine curves_refine(self, curve, u, finer, matrix, stat, err)
        class(hm_curves), intent(in), target :: self
        integer, intent(in) :: curve
        real(c_double), intent(in) :: u(:)
        class(hm_curves), intent(inout) :: finer                ! not self
        real(c_double), allocatable, intent(inout), optional :: matrix(:, :)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(hm_c_curves) :: set
        type(hm_c_curve), allocatable, target :: list(:)
        type(block_of_memory) :: block
        type(c_ptr) :: made, rows
        integer(c_size_t) :: bytes
        call open_curve(self, curve, set, list, done)
        if (done%ok()) done%status = hm_c_refine_size(set, int(curve - 1, c_int32_t), int(size(u), c_int32_t), u, &
            bytes, done%error)
        call block%take(bytes, done=done)
        if (done%ok()) done%status = hm_c_refine(made, rows, block%start, block%bytes, set, int(curve - 1, c_int32_t), &
            int(size(u), c_int32_t), u, done%error)
        if (done%status >= 0) call take_finer(made, rows, int(set%n_control), finer, matrix)
        call block%give_back()
        call done%finish("curves%refine", stat, err)
    end subroutine

    ! The same curves, the degree of one of them raised by 1.
    subroutine curves_elevate(self, curve, finer, matrix, stat, err)
        class(hm_curves), intent(in), target :: self
        integer, intent(in) :: curve
        class(hm_curves), intent(inout) :: finer                ! not self
        real(c_double), allocatable, intent(inout), optional :: matrix(:, :)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(hm_c_curves) :: set
        type(hm_c_curve), allocatable, target :: list(:)
        type(block_of_memory) :: block
        type(c_ptr) :: made, rows
        integer(c_size_t) :: bytes
        call open_curve(self, curve, set, list, done)
        if (done%ok()) done%status = hm_c_elevate_size(set, int(curve - 1, c_int32_t), bytes, done%error)
        call block%take(bytes, done=done)
        if (done%ok()) done%status = hm_c_elevate(made, rows, block%start, block%bytes, set, &
            int(curve - 1, c_int32_t), done%error)
        if (done%status >= 0) call take_finer(made, rows, int(set%n_control), finer, matrix)
        call block%give_back()
        call done%finish("curves%elevate", stat, err)
    end subroutine

    subroutine take_finer(made, rows, n_old, finer, matrix)
        type(c_ptr), intent(in) :: made, rows
        integer, intent(in) :: n_old
        class(hm_curves), intent(inout) :: finer
        real(c_double), allocatable, intent(inout), optional :: matrix(:, :)
        type(hm_c_curves), pointer :: set
        type(hm_c_curve), pointer :: list(:)
        real(c_double), pointer :: in_rows(:, :)
        call c_f_pointer(made, set)
        call c_f_pointer(set%curve, list, [set%n_curves])
        call copy_curves(set, list, finer)
        if (.not. present(matrix)) return
        call c_f_pointer(rows, in_rows, [n_old, int(set%n_control)])
        matrix = transpose(in_rows)
    end subroutine

    type(hm_c_section) function c_section_of(section) result(c)
        type(hm_section), intent(in), optional :: section
        c%struct_size = int(c_sizeof(c), c_int64_t)
        if (.not. present(section)) return
        c%first_curve = int(section%first_curve - 1, c_int32_t)
        c%n_curves = int(section%n_curves, c_int32_t)
        c%nose_x = section%nose(1)
        c%nose_y = section%nose(2)
        c%edge_x = section%edge(1)
        c%edge_y = section%edge(2)
    end function

    ! values(n) of quantities(n), where they are, at(2,n), and their derivatives by the control points,
    ! gradients(2,n_control,n).
    subroutine curves_measure(self, quantities, values, at, gradients, section, stat, err)
        class(hm_curves), intent(in), target :: self
        type(hm_quantity), intent(in), target :: quantities(:)
        real(c_double), intent(inout) :: values(:)
        real(c_double), intent(inout), optional :: at(:, :), gradients(:, :, :)
        type(hm_section), intent(in), optional :: section
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(hm_c_curves) :: set
        type(hm_c_curve), allocatable, target :: list(:)
        type(hm_c_section) :: its
        type(hm_c_quantity) :: asked(size(quantities))
        real(c_double), allocatable, target :: value(:), place(:, :), slope(:, :, :)
        type(c_ptr) :: to_place, to_slope
        integer :: k, n
        n = size(quantities)
        call c_curves_of(self, set, list, done)
        call done%refuse_if(size(values) /= n, "values must have one number for each quantity")
        if (present(at)) call done%refuse_if(any(shape(at) /= [2, n]), "at must be (2, quantities)")
        if (present(gradients) .and. done%ok()) call done%refuse_if(any(shape(gradients) /= &
            [2, int(set%n_control), n]), "gradients must be (2, control points, quantities)")
        its = c_section_of(section)
        if (its%n_curves == 0 .and. done%ok() .and. its%first_curve > 0) its%n_curves = set%n_curves - its%first_curve
        do k = 1, n
            asked(k)%struct_size = int(c_sizeof(asked(k)), c_int64_t)
            asked(k)%kind = int(quantities(k)%kind, c_int32_t)
            asked(k)%station = quantities(k)%station
            if (.not. allocated(quantities(k)%polygon)) cycle
            call done%refuse_if(size(quantities(k)%polygon, 1) /= 2, "a polygon is not (2,n)")
            asked(k)%n_polygon = int(size(quantities(k)%polygon, 2), c_int32_t)
            if (asked(k)%n_polygon > 0) asked(k)%polygon = c_loc(quantities(k)%polygon)
        end do
        allocate(value(n), place(2, n), slope(2, merge(int(set%n_control), 0, present(gradients)), n))
        if (done%ok()) then
            to_place = c_null_ptr
            to_slope = c_null_ptr
            if (n > 0) to_place = c_loc(place)
            if (present(gradients) .and. n > 0) to_slope = c_loc(slope)
            done%status = hm_c_measure(set, its, int(n, c_int32_t), asked, value, to_place, to_slope, done%error)
            if (done%status < 0 .and. done%error%item >= 0) call count_item_from_one(done)
        end if
        if (done%status >= 0) then
            values = value
            if (present(at)) at = place
            if (present(gradients)) gradients = slope
        end if
        call done%finish("curves%measure", stat, err)
    end subroutine

    ! Items that the text does not name, which therefore says not that they count from 0.
    subroutine count_item_from_one(done)
        type(outcome), intent(inout) :: done
        if (.not. counts_from_zero(sentence(done%error), &
            int(done%error%item))) done%error%item = done%error%item + 1_c_int32_t
    end subroutine

    ! How design variables move the control points: complex matrix(n_control,n); variables v move them by matmul(matrix,
    ! v), as complex numbers. error(2,n): root mean square and largest difference from the wanted movement of the
    ! curves.
    subroutine curves_map(self, variables, matrix, error, section, stat, err)
        class(hm_curves), intent(in), target :: self
        type(hm_variables), intent(in), target :: variables
        complex(c_double), allocatable, intent(inout) :: matrix(:, :)
        real(c_double), allocatable, intent(inout), optional :: error(:, :)
        type(hm_section), intent(in), optional :: section
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(hm_c_curves) :: set
        type(hm_c_curve), allocatable, target :: list(:)
        type(hm_c_section) :: its
        type(hm_c_variables) :: asked
        type(block_of_memory) :: block
        real(c_double), allocatable :: pairs(:, :, :), errors(:, :)
        integer(c_int32_t) :: n
        integer(c_size_t) :: bytes
        call c_curves_of(self, set, list, done)
        its = c_section_of(section)
        if (its%n_curves == 0 .and. done%ok() .and. its%first_curve > 0) its%n_curves = set%n_curves - its%first_curve
        asked%struct_size = int(c_sizeof(asked), c_int64_t)
        asked%kind = int(variables%kind, c_int32_t)
        asked%n_upper = int(variables%n_upper, c_int32_t)
        asked%n_lower = int(variables%n_lower, c_int32_t)
        asked%degree_x = int(variables%degree_x, c_int32_t)
        asked%degree_y = int(variables%degree_y, c_int32_t)
        asked%x_min = variables%box(1)
        asked%y_min = variables%box(2)
        asked%x_max = variables%box(3)
        asked%y_max = variables%box(4)
        asked%nose_exponent = variables%nose_exponent
        asked%edge_exponent = variables%edge_exponent
        asked%width = variables%width
        if (allocated(variables%peaks)) then
            call done%refuse_if(size(variables%peaks) /= variables%n_upper + variables%n_lower, &
                "one peak for each variable of the sides")
            if (size(variables%peaks) > 0) asked%peaks = c_loc(variables%peaks)
        end if
        n = 0
        if (done%ok()) done%status = hm_c_variables_size(set, its, asked, n, bytes, done%error)
        call block%take(bytes, done=done)
        allocate(pairs(2, n, set%n_control), errors(2, n))
        if (done%ok()) done%status = hm_c_variables_map(set, its, asked, block%start, block%bytes, pairs, errors, &
            done%error)
        if (done%status >= 0) then
            matrix = transpose(cmplx(pairs(1, :, :), pairs(2, :, :), c_double))
            if (present(error)) error = errors
        end if
        call block%give_back()
        call done%finish("curves%map", stat, err)
    end subroutine
