
! ---- What a plan is made of: conditions and options as users say them, and as C has them, where it keeps them --------

    type, public :: hm_options                ! 0 and null are the defaults
        integer :: operator_kind = hm_conformal, scheme = hm_compact, engine = hm_direct, kernel = hm_kernel_auto
        real(c_double) :: tolerance = 0
        procedure(hm_progress), pointer, nopass :: progress => null()
        type(hm_executor) :: executor = hm_executor()           ! copied; its procedure must outlive the plan
        integer :: exponent_quarters = 0      ! 4 q of the weight 1 / d**q, or hm_no_weight
        logical :: offset_correction = .false.
        integer :: precision = hm_double
        ! hm_multigrid and hm_fas only; the history of its residuals must outlive the plan.
        integer :: levels = 0, agglomeration = hm_agglomerate_auto, block_width = 0, max_iterations = 0
        integer :: start = hm_start_coarsest  ! hm_fas only
        real(c_double), pointer, contiguous :: history(:) => null()
    end type

    ! hm_condition(3), hm_condition(4, hm_slip), hm_condition(5, hm_rigid, x=0.25d0), hm_condition(6, hm_periodic_pair,
    ! partner=7). A component of another kind than the condition's that is not its default is refused.
    type, public :: hm_condition
        integer :: marker = 0
        integer :: kind = hm_on_curve
        integer :: first_curve = 1, n_curves = 1
        integer :: body = 1                                     ! rigid: which one; markers may share one
        integer :: partner = 0                                  ! pairs: the other marker, which has no condition
        real(c_double) :: x = 0, y = 0                          ! rigid, rotation pair: the centre of rotation
        integer :: piece = 0                                    ! 1: the piece of the marker nearest to near_x, near_y
        real(c_double) :: near_x = 0, near_y = 0
        type(hm_curves), pointer :: along => null()             ! slip: the curves along which points slide
    end type

    type :: c_along                   ! those of a condition, as C sees them
        type(hm_c_curves) :: set
        type(hm_c_curve), allocatable :: curve(:)
    end type

    type :: problem                   ! all that analysis and plan point to, beside the mesh's arrays
        type(mesh_arrays), pointer :: arrays => null()          ! shared with the mesh
        type(hm_c_mesh) :: mesh
        type(hm_curves) :: curves
        type(hm_c_curves) :: set
        type(hm_c_curve), allocatable :: curve(:)
        type(hm_c_condition), allocatable :: conditions(:)
        type(c_along), allocatable :: along(:)
        integer(c_int32_t), allocatable :: given_points(:), given_curves(:)
        real(c_double), allocatable :: given_u(:)
        type(callback) :: progress
        type(c_threads) :: threads
        type(hm_c_options) :: options
        type(hm_c_problem) :: c
    end type

contains
    ! Everything that the analysis will point to, where it stays.
    subroutine set_problem(self, mesh, curves, conditions, given_points, given_curves, given_u, options, done)
        type(problem), intent(inout), target :: self
        type(hm_mesh), intent(in) :: mesh
        type(hm_curves), intent(in), optional :: curves
        type(hm_condition), intent(in), optional :: conditions(:)
        integer, intent(in), optional :: given_points(:), given_curves(:)
        real(c_double), intent(in), optional :: given_u(:)
        type(hm_options), intent(in), optional :: options
        type(outcome), intent(inout) :: done
        type(hm_options) :: its
        call release(self%arrays)
        self%arrays => shared(mesh)
        self%mesh = c_mesh_of(mesh)
        self%c%struct_size = int(c_sizeof(self%c), c_int64_t)
        self%c%mesh = c_loc(self%mesh)
        if (present(options)) its = options
        self%options%struct_size = int(c_sizeof(self%options), c_int64_t)
        self%options%operator_kind = int(its%operator_kind, c_int32_t)
        self%options%scheme = int(its%scheme, c_int32_t)
        self%options%engine = int(its%engine, c_int32_t)
        self%options%kernel = int(its%kernel, c_int32_t)
        self%options%tolerance = its%tolerance
        self%options%exponent_quarters = int(its%exponent_quarters, c_int32_t)
        self%options%offset_correction = merge(1_c_int32_t, 0_c_int32_t, its%offset_correction)
        self%options%levels = int(its%levels, c_int32_t)
        self%options%agglomeration = int(its%agglomeration, c_int32_t)
        self%options%block_width = int(its%block_width, c_int32_t)
        self%options%max_iterations = int(its%max_iterations, c_int32_t)
        self%options%precision = int(its%precision, c_int32_t)
        self%options%start = int(its%start, c_int32_t)
        if (associated(its%history)) then
            self%options%history_length = int(size(its%history), c_int32_t)
            if (size(its%history) > 0) self%options%history = c_loc(its%history)
        end if
        if (associated(its%progress)) then
            self%options%progress = c_funloc(call_progress)
            self%progress%progress => its%progress
            self%options%progress_user = c_loc(self%progress)
        end if
        self%options%executor = c_executor_of(its%executor, self%threads)
        if (present(curves)) then
            self%curves = curves
            call c_curves_of(self%curves, self%set, self%curve, done)
            self%c%curves = c_loc(self%set)
        end if
        if (present(conditions)) then
            self%conditions = c_conditions_of(conditions)
            call set_along(self, conditions, done)
            self%c%n_conditions = int(size(conditions), c_int32_t)
            if (size(conditions) > 0) self%c%conditions = c_loc(self%conditions)
        end if
        if (.not. present(given_points)) return
        if (.not. present(given_curves) .or. .not. present(given_u)) then
            call done%refuse("given_points without given_curves or given_u")
            return
        end if
        if (size(given_curves) /= size(given_points) .or. size(given_u) /= size(given_points)) &
            call done%refuse("given_points, given_curves and given_u have different lengths")
        if (done%status < 0 .or. size(given_points) == 0) return
        self%given_points = int(given_points, c_int32_t)
        self%given_curves = int(given_curves - 1, c_int32_t)
        self%given_u = given_u
        self%c%n_given = int(size(given_points), c_int32_t)
        self%c%given_points = c_loc(self%given_points)
        self%c%given_curves = c_loc(self%given_curves)
        self%c%given_u = c_loc(self%given_u)
    end subroutine

    ! Conditions with the same curves share one C struct, so that points slide past where their markers meet.
    subroutine set_along(self, conditions, done)
        type(problem), intent(inout), target :: self
        type(hm_condition), intent(in) :: conditions(:)
        type(outcome), intent(inout) :: done
        integer :: k, first
        if (allocated(self%along)) deallocate(self%along)
        allocate(self%along(size(conditions)))
        do k = 1, size(conditions)
            if (.not. associated(conditions(k)%along)) cycle
            first = 1
            do while (.not. associated(conditions(first)%along, conditions(k)%along))
                first = first + 1
            end do
            if (first == k) call c_curves_of(conditions(k)%along, self%along(k)%set, self%along(k)%curve, done)
            self%conditions(k)%along = c_loc(self%along(first)%set)
            if (conditions(k)%kind /= hm_slip) cycle
            self%conditions(k)%first_curve = 0
            self%conditions(k)%n_curves = self%along(first)%set%n_curves
        end do
    end subroutine

    function c_conditions_of(conditions) result(list)
        type(hm_condition), intent(in) :: conditions(:)
        type(hm_c_condition) :: list(size(conditions))
        integer :: k
        do k = 1, size(conditions)
            list(k)%struct_size = int(c_sizeof(list(k)), c_int64_t)
            list(k)%marker = int(conditions(k)%marker, c_int32_t)
            list(k)%kind = int(conditions(k)%kind, c_int32_t)
            list(k)%first_curve = int(conditions(k)%first_curve - 1, c_int32_t)
            list(k)%n_curves = int(conditions(k)%n_curves, c_int32_t)
            ! What a condition of another kind has of itself is not asked for.
            if (conditions(k)%kind /= hm_on_curve .and. conditions(k)%first_curve == 1 .and. &
                conditions(k)%n_curves == 1) &
                list(k)%n_curves = 0
            list(k)%body = int(conditions(k)%body - 1, c_int32_t)
            list(k)%partner = int(conditions(k)%partner, c_int32_t)
            list(k)%x = conditions(k)%x
            list(k)%y = conditions(k)%y
            list(k)%piece = int(conditions(k)%piece, c_int32_t)
            list(k)%near_x = conditions(k)%near_x
            list(k)%near_y = conditions(k)%near_y
        end do
    end function
