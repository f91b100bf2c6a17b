
! ---- What is asked of curves: points and parameters, and the least-squares fit that makes one ------------------------

    public :: hm_fit_words


contains
    subroutine curves_check(self, stat, err)
        class(hm_curves), intent(in), target :: self
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(hm_c_curves) :: set
        type(hm_c_curve), allocatable, target :: list(:)
        call c_curves_of(self, set, list, done)
        if (done%ok()) done%status = hm_c_curves_check(set, done%error)
        call done%finish("curves%check", stat, err)
    end subroutine

    ! The basis functions that are not 0 at u: their control points, and values(k,d), d-th derivative from 0 on.
    subroutine curves_basis(self, curve, u, control, values, stat, err)
        class(hm_curves), intent(in), target :: self
        integer, intent(in) :: curve
        real(c_double), intent(in) :: u
        integer, allocatable, intent(out) :: control(:)
        real(c_double), intent(inout) :: values(1:, 0:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(hm_c_curves) :: set
        type(hm_c_curve), allocatable, target :: list(:)
        integer(c_int32_t) :: number(6)
        real(c_double) :: value(36)
        integer :: order, d
        order = 0
        call open_curve(self, curve, set, list, done)
        if (done%ok()) then
            order = int(list(curve)%degree) + 1
            if (size(values, 1) < order .or. size(values, 2) < 1 .or. size(values, 2) > 6) &
                call done%refuse("values is not (degree+1, 0:derivatives) with at most 5 derivatives")
        end if
        if (done%ok()) done%status = hm_c_curve_basis(set, int(curve - 1, c_int32_t), u, &
            int(size(values, 2) - 1, c_int32_t), number, value, done%error)
        if (done%status >= 0) then
            control = int(number(:order))
            do d = 0, ubound(values, 2)
                values(:order, d) = value(d * order + 1:(d + 1) * order)
            end do
        end if
        call done%finish("curves%basis", stat, err)
    end subroutine

    ! The point at u, xy(:,0), and as many derivatives as xy(2,0:) has room for.
    subroutine curves_point(self, curve, u, xy, stat, err)
        class(hm_curves), intent(in), target :: self
        integer, intent(in) :: curve
        real(c_double), intent(in) :: u
        real(c_double), intent(inout) :: xy(1:, 0:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(hm_c_curves) :: set
        type(hm_c_curve), allocatable, target :: list(:)
        real(c_double) :: value(12)
        call open_curve(self, curve, set, list, done)
        if (size(xy, 1) /= 2 .or. size(xy, 2) < 1 .or. size(xy, 2) > 6) &
            call done%refuse("xy is not (2, 0:derivatives) with at most 5 derivatives")
        if (done%ok()) done%status = hm_c_curve_point(set, int(curve - 1, c_int32_t), u, &
            int(size(xy, 2) - 1, c_int32_t), value, done%error)
        if (done%status >= 0) xy = reshape(value(:size(xy)), shape(xy))
        call done%finish("curves%point", stat, err)
    end subroutine

    ! The parameter of the point nearest to (x, y), and how far it is.
    subroutine curves_project(self, curve, x, y, u, distance, stat, err)
        class(hm_curves), intent(in), target :: self
        integer, intent(in) :: curve
        real(c_double), intent(in) :: x, y
        real(c_double), intent(inout) :: u, distance
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(hm_c_curves) :: set
        type(hm_c_curve), allocatable, target :: list(:)
        call open_curve(self, curve, set, list, done)
        if (done%ok()) done%status = hm_c_curve_project(set, int(curve - 1, c_int32_t), x, y, u, distance, done%error)
        call done%finish("curves%project", stat, err)
    end subroutine

    subroutine open_curve(curves, curve, set, list, done)
        class(hm_curves), intent(in), target :: curves
        integer, intent(in) :: curve
        type(hm_c_curves), intent(out) :: set
        type(hm_c_curve), intent(out), allocatable, target :: list(:)
        type(outcome), intent(inout) :: done
        call c_curves_of(curves, set, list, done)
        if (done%ok()) call done%refuse_if(curve < 1 .or. curve > size(list), "there is no curve of this number")
    end subroutine

    function c_fit_options_of(degree, n_control, closed) result(options)
        integer, intent(in), optional :: degree, n_control, closed
        type(hm_c_fit_options) :: options
        options%struct_size = int(c_sizeof(options), c_int64_t)
        if (present(degree)) options%degree = int(degree, c_int32_t)
        if (present(n_control)) options%n_control = int(n_control, c_int32_t)
        if (present(closed)) options%closed = int(closed, c_int32_t)
    end function

    ! 8-byte numbers of work that a fit through n points needs.
    subroutine hm_fit_words(n, words, degree, n_control, closed, stat, err)
        integer, intent(in) :: n
        integer(c_int64_t), intent(inout) :: words
        integer, intent(in), optional :: degree, n_control, closed
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        integer(c_size_t) :: bytes
        done%status = hm_c_fit_size(int(n, c_int32_t), c_fit_options_of(degree, n_control, closed), bytes, done%error)
        if (done%status >= 0) words = words_of(bytes)
        call done%finish("hm_fit_words", stat, err)
    end subroutine

!@each real
    ! Least squares through points in order; loop: the last is joined to the first, which is not repeated. A list that
    ! repeats the first point at its end is refused: give loop = .true. and the list without the last point.
    subroutine fit_@FORM@(self, x, y, loop, degree, n_control, closed, report, work, stat, err)
        class(hm_curves), intent(inout) :: self
        real(@KIND@), intent(in), target :: x(:), y(:)
        logical, intent(in) :: loop
        integer, intent(in), optional :: degree, n_control, closed
        type(hm_fit_report), intent(out), optional :: report
        real(c_double), pointer, intent(in), optional :: work(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(view) :: v
        v = view_of(x, y)
        call fit_view(self, v, loop, c_fit_options_of(degree, n_control, closed), report, work, stat, err)
        call v%drop()
    end subroutine

!@end
    subroutine fit_view(self, v, loop, options, report, work, stat, err)
        class(hm_curves), intent(inout) :: self
        type(view), intent(in) :: v
        logical, intent(in) :: loop
        type(hm_c_fit_options), intent(in) :: options
        type(hm_fit_report), intent(out), optional :: report
        real(c_double), pointer, intent(in), optional :: work(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(hm_fit_report) :: its
        type(block_of_memory) :: block
        type(hm_c_curves), pointer :: set
        type(hm_c_curve), pointer :: list(:)
        type(c_ptr) :: made
        integer(c_int32_t) :: n
        integer(c_size_t) :: bytes
        call done%check_version()
        call done%refuse_if(v%wrong /= "", v%wrong)
        n = int(min(v%n, int(huge(n), c_int64_t)), c_int32_t)
        if (done%ok()) done%status = hm_c_fit_size(n, options, bytes, done%error)
        call block%take(bytes, work, done)
        if (done%ok()) then
            its%struct_size = int(c_sizeof(its), c_int64_t)
            done%status = hm_c_fit(made, block%start, block%bytes, c_points(v), n, &
                merge(1_c_int32_t, 0_c_int32_t, loop), options, its, done%error)
        end if
        if (done%status >= 0) then
            call c_f_pointer(made, set)
            call c_f_pointer(set%curve, list, [set%n_curves])
            call copy_curves(set, list, self)
            its%max_error_point = its%max_error_point + 1_c_int32_t
            its%first_point = its%first_point + 1_c_int32_t
            if (its%backtrack_point >= 0) its%backtrack_point = its%backtrack_point + 1_c_int32_t   ! -1: nowhere
            if (present(report)) report = its
        end if
        call block%give_back()
        call done%finish("curves%fit", stat, err)
    end subroutine
