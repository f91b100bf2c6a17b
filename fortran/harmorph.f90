! harmorph for Fortran: morphs an airfoil and its CFD mesh together. MIT licence. Compile this file with your solver
! (gfortran -c harmorph.f90) and link libharmorph.a. harmorph.h says what is computed; here is how Fortran asks for it.
!
!     type(hm_mesh) :: mesh;  type(hm_curves) :: curves;  type(hm_plan) :: plan;  type(hm_basis) :: basis
!     call mesh%points(x, y)                       the solver's own arrays, viewed, not copied: give them TARGET
!     call mesh%cells(cells)                       (3,n), (4,n), or rows and their start; none for a block x(ni,nj)
!     call mesh%faces(face_points, markers)        or lists; line(...) for the sides of a block
!     call plan%analyse(mesh)                      the mesh alone: plan%report, plan%boundary
!     call curves%fit(x(wall), y(wall), loop)      or curves%set and curves%add
!     call plan%analyse(mesh, curves, [hm_condition(wing), hm_condition(tunnel, hm_slip)], options=options)
!     call plan%factor()
!     call plan%solve(basis)                       then plan%free(): the basis and the mesh are all that a morph needs
!     call basis%morph(move, x, y)                 move(2,functions); also morph_to, displacement, velocity, adjoint
!     call basis%admissible_step(mesh, dx, dy, report);  call basis%quality(mesh, x, y, report);  assess: both
!     call plan%morph_safe(basis, move, x, y)      a movement of any size without inverted cells; it needs the plan
!     call plan%transfer(coarse, coarse_mesh, basis)      functions of a coarser mesh instead of factor and solve
!     call basis%save(file);  call basis%load(file, mesh)
!     call basis%single(narrow)                    the functions in single precision: half the memory, faster morphs
!
! Operators     hm_options: the default is the conformal one; hm_laplace are the paper's harmonic functions.
! Layouts       Coordinates are x(:), y(:), or structured x(:,:), y(:,:). Any constant distance from point to point is
!               used as it lies: xy(1,:), xy(2,:) are not copied. Default reals, and blocks inside their ghost layers,
!               work too but are converted in a copy at each call. Connectivity is contiguous; 8-byte integers are
!               converted.
! Mesh          hm_mesh keeps the places of the arrays given to points, cells, faces and lists: they must outlive mesh
!               and plan and not be expressions. Of what had to be converted it has a copy: after such coordinates
!               change, call points again.
! Numbering     Everything counts from 1: points, cells, control points, functions, numbers of a value, curves, bodies,
!               pieces, conditions, parts. (Texts of errors count curves, conditions and functions from 0.)
! stat, err     stat: 0 done, above 0 a warning, below 0 refused: arrays are as before; a plan or basis that was to be
!               made anew is empty. Without stat, what is refused stops the program with the reason. err holds it too.
! Memory        Blocks are allocated here and freed by the type's finalisation or free(). Or give `work`, as many 8-byte
!               numbers as the procedure whose name ends in _words says; it must not move while in use.
! Assignment    Of a mesh, plan or basis: stops the program, as two owners would free one block. Curves are plain data.
! Threads       hm_openmp(n), where this file is compiled with OpenMP; or your own procedure in an hm_executor.
! Parts         Codes on several processes: share_of, init_share, extract, pack, unpack, adjoint_scale, _sums, _finish,
!               see harmorph.h.
module harmorph
    use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_double, c_f_pointer, c_f_procpointer, c_float, &
        c_funloc, c_funptr, c_int32_t, c_int64_t, c_int8_t, c_intptr_t, c_loc, c_null_char, c_null_funptr, c_null_ptr, &
        c_ptr, c_size_t, c_sizeof
    implicit none
    private

    ! ---- Constants, with the values of harmorph.h

    character(len=*), parameter, public :: hm_header_version = "0.1.0"
    integer, parameter, public :: hm_abi = 1

    integer, parameter, public :: hm_ok = 0, hm_not_converged = 1, hm_moved = 2, hm_short = 3
    integer, parameter, public :: hm_cancelled = -1, hm_bad_argument = -2, hm_bad_mesh = -3, hm_bad_curve = -4
    integer, parameter, public :: hm_bad_condition = -5, hm_bad_basis = -6, hm_block_too_small = -7, &
        hm_not_positive = -8
    integer, parameter, public :: hm_unsupported = -9, hm_crossing = -10

    integer, parameter, public :: hm_cells_rows = 0, hm_cells_triangles = 1, hm_cells_quads = 2, hm_cells_structured = 3
    integer, parameter, public :: hm_closed_auto = 0, hm_open = 1, hm_tied = 2, hm_periodic = 3
    integer, parameter, public :: hm_on_curve = 0, hm_rigid = 1, hm_fixed = 2, hm_slip = 3, hm_free = 4
    integer, parameter, public :: hm_periodic_pair = 5
    integer, parameter, public :: hm_conformal = 0, hm_laplace = 1, hm_weighted = 2, hm_no_weight = -1
    integer, parameter, public :: hm_compact = 0, hm_nodal_gradient = 1, hm_bounded = 2, hm_nodal_gradient_plain = 3
    integer, parameter, public :: hm_direct = 0, hm_multigrid = 1, hm_fas = 2
    integer, parameter, public :: hm_agglomerate_auto = 0, hm_agglomerate_isotropic = 1, hm_agglomerate_directional = 2
    integer, parameter, public :: hm_double = 0, hm_single = 1
    integer, parameter, public :: hm_start_coarsest = 0, hm_start_zero = 1
    integer, parameter, public :: hm_kernel_auto = 0, hm_kernel_baseline = 1, hm_kernel_avx2 = 2, hm_kernel_avx512 = 3
    integer, parameter, public :: hm_phase_structure = 0, hm_phase_ordering = 1, hm_phase_symbolic = 2
    integer, parameter, public :: hm_phase_assembly = 3, hm_phase_factor = 4, hm_phase_solve = 5, hm_phase_residual = 6
    integer, parameter, public :: hm_rung_linear = 0, hm_rung_other = 1, hm_rung_substeps = 2, hm_rung_untangled = 3

    ! ---- The structs of harmorph.h (tests/layout.f90 compares them). Reports are used as they are; hm_c_* stay inside.

    type, bind(c), public :: hm_c_error
        integer(c_int32_t) :: code = 0, item = -1
        real(c_double) :: value = 0
        character(kind=c_char) :: text(112) = c_null_char
    end type

    type, bind(c), public :: hm_c_executor
        integer(c_int64_t) :: struct_size = 0
        type(c_funptr) :: run = c_null_funptr
        type(c_ptr) :: user = c_null_ptr
        integer(c_int32_t) :: n_threads = 1, reserved = 0
    end type

    type, bind(c), public :: hm_c_mesh
        integer(c_int64_t) :: struct_size = 0
        integer(c_int32_t) :: index_base = 0, n_points = 0
        type(c_ptr) :: x = c_null_ptr, y = c_null_ptr
        integer(c_int64_t) :: stride = 0
        integer(c_int32_t) :: cell_layout = 0, n_cells = 0
        type(c_ptr) :: cell_start = c_null_ptr, cell_points = c_null_ptr
        integer(c_int32_t) :: ni = 0, nj = 0, n_faces = 0
        type(c_ptr) :: face_points = c_null_ptr, face_markers = c_null_ptr
        integer(c_int32_t) :: n_lists = 0
        type(c_ptr) :: list_start = c_null_ptr, list_points = c_null_ptr, list_markers = c_null_ptr
    end type

    type, bind(c), public :: hm_c_curve
        integer(c_int64_t) :: struct_size = 0
        integer(c_int32_t) :: degree = 0, n_indices = 0
        type(c_ptr) :: indices = c_null_ptr, knots = c_null_ptr
    end type

    type, bind(c), public :: hm_c_curves
        integer(c_int64_t) :: struct_size = 0
        integer(c_int32_t) :: index_base = 0, n_control = 0
        type(c_ptr) :: control = c_null_ptr, weights = c_null_ptr
        integer(c_int32_t) :: n_curves = 0
        type(c_ptr) :: curve = c_null_ptr
    end type

    type, bind(c), public :: hm_c_fit_options
        integer(c_int64_t) :: struct_size = 0
        integer(c_int32_t) :: degree = 0, n_control = 0, closed = 0
    end type

    type, bind(c), public :: hm_fit_report
        integer(c_int64_t) :: struct_size = 0
        real(c_double) :: max_error = 0, rms_error = 0
        integer(c_int32_t) :: max_error_point = 0, closed = 0, first_point = 0, base_points = 0
    end type

    type, bind(c), public :: hm_c_condition
        integer(c_int64_t) :: struct_size = 0
        integer(c_int32_t) :: marker = 0, kind = 0, first_curve = 0, n_curves = 0, body = 0, partner = 0
        real(c_double) :: x = 0, y = 0
    end type

    type, bind(c), public :: hm_c_problem
        integer(c_int64_t) :: struct_size = 0
        type(c_ptr) :: mesh = c_null_ptr, curves = c_null_ptr
        integer(c_int32_t) :: n_conditions = 0
        type(c_ptr) :: conditions = c_null_ptr
        integer(c_int32_t) :: n_given = 0
        type(c_ptr) :: given_points = c_null_ptr, given_curves = c_null_ptr, given_u = c_null_ptr
    end type

    type, bind(c), public :: hm_c_options
        integer(c_int64_t) :: struct_size = 0
        integer(c_int32_t) :: operator_kind = 0, scheme = 0, engine = 0, kernel = 0
        real(c_double) :: tolerance = 0
        type(c_funptr) :: progress = c_null_funptr
        type(c_ptr) :: progress_user = c_null_ptr, executor = c_null_ptr
        integer(c_int32_t) :: exponent_quarters = 0, offset_correction = 0
        integer(c_int32_t) :: levels = 0, agglomeration = 0, block_width = 0, max_iterations = 0
        type(c_ptr) :: history = c_null_ptr
        integer(c_int32_t) :: history_length = 0, precision = 0, start = 0, reserved = 0
    end type

    type, bind(c), public :: hm_mesh_report
        integer(c_int64_t) :: struct_size = 0
        integer(c_int32_t) :: points = 0, used_points = 0, cells = 0, triangles = 0, quads = 0, edges = 0
        integer(c_int32_t) :: boundary_edges = 0, boundary_loops = 0, inverted = 0, first_inverted = 0
        real(c_double) :: min_area = 0, min_quality = 0, mean_quality = 0
    end type

    type, bind(c), public :: hm_solve_report
        integer(c_int64_t) :: struct_size = 0
        integer(c_int32_t) :: unknowns = 0, functions = 0
        real(c_double) :: residual = 0
        integer(c_int32_t) :: residual_function = 0, boundary_error_point = 0
        real(c_double) :: boundary_error = 0, partition_defect = 0, min_value = 0, max_value = 0, max_distance = 0
        integer(c_int32_t) :: max_distance_point = 0, curve_points = 0, refinements = 0, reserved = 0
        integer(c_int64_t) :: factor_entries = 0
        integer(c_int32_t) :: iterations = 0, levels = 0, fine_sweeps = 0, reserved_too = 0
    end type

    type, bind(c), public :: hm_c_basis_info
        integer(c_int64_t) :: struct_size = 0, bytes = 0
        integer(c_int32_t) :: solved = 0, points = 0, cells = 0, functions = 0, curves = 0, curve_points = 0
        integer(c_int32_t) :: numbers_per_value = 0, operator_kind = 0, scheme = 0, engine = 0, index_base = 0
        type(c_ptr) :: curve_point = c_null_ptr, point_curve = c_null_ptr, point_u = c_null_ptr
        integer(c_int32_t) :: exponent_quarters = 0, bodies = 0, offset_correction = 0, storage = 0
    end type

    type, bind(c), public :: hm_transfer_report
        integer(c_int64_t) :: struct_size = 0
        integer(c_int32_t) :: points = 0, outside = 0
        real(c_double) :: max_distance = 0
        integer(c_int32_t) :: max_distance_point = 0, boundary_error_point = 0
        real(c_double) :: boundary_error = 0, wall_correction = 0
    end type

    type, bind(c), public :: hm_step_report
        integer(c_int64_t) :: struct_size = 0
        real(c_double) :: admissible = 0
        integer(c_int32_t) :: cell = 0, point = 0
    end type

    type, bind(c), public :: hm_quality_report
        integer(c_int64_t) :: struct_size = 0
        integer(c_int32_t) :: inverted = 0, first_inverted = 0
        real(c_double) :: min_area = 0, min_quality = 0, mean_quality = 0
        integer(c_int32_t) :: min_quality_cell = 0, self_crossing = 0, crossing_points(4) = 0
    end type

    type, bind(c), public :: hm_c_safe_options
        integer(c_int64_t) :: struct_size = 0
        integer(c_int32_t) :: max_resolves = 0, skipped_rungs = 0, n_others = 0, reserved = 0
        type(c_ptr) :: others = c_null_ptr
        real(c_double) :: heights = 0
        type(c_ptr) :: reached = c_null_ptr
    end type

    type, bind(c), public :: hm_safe_report
        integer(c_int64_t) :: struct_size = 0
        integer(c_int32_t) :: rung = 0, other = 0, steps = 0, resolves = 0
        real(c_double) :: step_fraction = 0, admissible = 0
        integer(c_int32_t) :: cell = 0, point = 0, untangled = 0, iterations = 0, crossing_points(4) = 0
        integer(c_int32_t) :: inverted = 0, min_quality_cell = 0
        real(c_double) :: min_quality = 0, mean_quality = 0, mean_angle_change = 0, max_angle_change = 0
        real(c_double) :: mean_height_ratio = 0, min_height_ratio = 0, max_height_ratio = 0, heights = 0
        integer(c_int32_t) :: angle_point = 0, min_height_point = 0, max_height_point = 0, reserved = 0
    end type

    ! ---- What Fortran callers use

    type, public :: hm_error
        integer :: code = hm_ok
        integer :: item = -1                  ! first offending point, cell, ...; -1: none
        real(c_double) :: value = 0           ! what was found: area, residual, missing bytes
        character(len=112) :: text = ""
    end type

    type, public :: hm_tasks                  ! the work of one call, for an executor
        private
        type(c_funptr) :: task = c_null_funptr
        type(c_ptr) :: context = c_null_ptr
    contains
        procedure :: run => tasks_run         ! call tasks%run(k)
    end type

    abstract interface
        ! Calls tasks%run(k) once for each k in 1 .. n_tasks, in any order, on any threads; returns when all are done.
        subroutine hm_run(n_threads, n_tasks, tasks)
            import :: hm_tasks
            implicit none
            integer, intent(in) :: n_threads, n_tasks
            type(hm_tasks), intent(in) :: tasks
        end subroutine
        ! Called at the start of each phase (fraction 0), sometimes in between, at its end (1). Set cancel to stop.
        subroutine hm_progress(phase, fraction, cancel)
            import :: c_double
            implicit none
            integer, intent(in) :: phase
            real(c_double), intent(in) :: fraction
            logical, intent(inout) :: cancel
        end subroutine
        subroutine c_task(context, index) bind(c)
            import :: c_int32_t, c_ptr
            implicit none
            type(c_ptr), value, intent(in) :: context
            integer(c_int32_t), value, intent(in) :: index
        end subroutine
    end interface
    public :: hm_run, hm_progress

    type, public :: hm_executor
        procedure(hm_run), pointer, nopass :: run => null()     ! null: everything on the calling thread
        integer :: n_threads = 1                                ! 1 .. 256
    end type

    type, bind(c) :: callback                 ! what C hands back as `user`
        type(c_funptr) :: procedure = c_null_funptr
        integer(c_int32_t) :: n_threads = 1
    end type

    type, bind(c) :: c_threads                ! an executor of C, and the one of Fortran that it calls
        type(hm_c_executor) :: c
        type(callback) :: its
    end type

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

    type, public :: hm_safe_options           ! of morph_safe; 0 are the defaults
        integer :: max_resolves = 0
        integer :: skipped_rungs = 0          ! sum of 2**hm_rung_... of those not to be tried
        real(c_double) :: heights = 0         ! 0 .. 1: how far distances from the walls are brought back
        ! (2, :) like move: receives the movement that x_new has; short of the target it is not all of move.
        real(c_double), pointer, contiguous :: reached(:, :) => null()
    end type

    ! hm_condition(3), hm_condition(4, hm_slip), hm_condition(5, hm_rigid, x=0.25d0), hm_condition(6, hm_periodic_pair,
    ! partner=7). A component of another kind than the condition's that is not its default is refused.
    type, public :: hm_condition
        integer :: marker = 0
        integer :: kind = hm_on_curve
        integer :: first_curve = 1, n_curves = 1
        integer :: body = 1                                     ! rigid: which one; markers may share one
        integer :: partner = 0                                  ! periodic: the other marker, which has no condition
        real(c_double) :: x = 0, y = 0                          ! rigid: the point that the body turns about
    end type

    type, public :: hm_curve
        integer :: degree = 3
        integer(c_int32_t), allocatable :: indices(:)           ! not allocated: the control points in order
        real(c_double), allocatable :: knots(:)
    end type

    type, public :: hm_curves                 ! plain data: read it, change it, assign it
        real(c_double), allocatable :: control(:, :)            ! (2,n_control)
        real(c_double), allocatable :: weights(:)               ! not allocated: not rational
        type(hm_curve), allocatable :: curve(:)
    contains
        procedure :: set => curves_set
        procedure, private :: curves_add_all, curves_add_some_i4, curves_add_some_i8
        generic :: add => curves_add_all, curves_add_some_i4, curves_add_some_i8
        procedure :: check => curves_check
        procedure :: basis => curves_basis
        procedure :: point => curves_point
        procedure :: project => curves_project
        procedure, private :: curves_fit_8, curves_fit_4
        generic :: fit => curves_fit_8, curves_fit_4
    end type

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
    end type

    type :: block_of_memory
        integer(c_int64_t), pointer :: words(:) => null()       ! what was allocated here
        type(c_ptr) :: start = c_null_ptr
        integer(c_size_t) :: bytes = 0
    end type

    type :: integers                          ! an array that hm_mesh had to convert
        integer(c_int32_t), pointer :: at(:) => null()
    end type
    integer, parameter :: in_start = 1, in_cells = 2, in_faces = 3, in_face_markers = 4, in_list_start = 5, &
        in_lists = 6, in_list_markers = 7

    type, public :: hm_mesh
        private
        type(hm_c_mesh) :: c = hm_c_mesh(index_base=1)
        real(c_double), pointer :: coordinates(:, :) => null()  ! where they could not be used as they lie
        type(integers) :: converted(7)
    contains
        procedure, private :: points_v8, points_v4, points_b8, points_b4
        generic :: points => points_v8, points_v4, points_b8, points_b4
        procedure, private :: cells_fixed_i4, cells_fixed_i8, cells_rows_i4, cells_rows_i8
        generic :: cells => cells_fixed_i4, cells_fixed_i8, cells_rows_i4, cells_rows_i8
        procedure, private :: faces_i4, faces_i8, lists_i4, lists_i8
        generic :: faces => faces_i4, faces_i8
        generic :: lists => lists_i4, lists_i8
        procedure :: structured => mesh_structured
        procedure :: line => mesh_line
        procedure :: count_from => mesh_count_from
        procedure :: free => mesh_free
        procedure, private :: mesh_assign
        generic :: assignment(=) => mesh_assign
        final :: mesh_final
    end type

    type :: plan_data                         ! all that analysis and plan point to, beside the mesh's arrays
        type(hm_c_mesh) :: mesh
        type(hm_curves) :: curves
        type(hm_c_curves) :: set
        type(hm_c_curve), allocatable :: curve(:)
        type(hm_c_condition), allocatable :: conditions(:)
        integer(c_int32_t), allocatable :: given_points(:), given_curves(:)
        real(c_double), allocatable :: given_u(:)
        type(callback) :: progress
        type(c_threads) :: threads
        type(hm_c_options) :: c_options
        type(hm_c_problem) :: problem
    end type

    type, public :: hm_plan
        private
        type(plan_data), pointer :: data => null()
        type(block_of_memory) :: analysis_memory, plan_memory
        type(c_ptr) :: analysis = c_null_ptr, plan = c_null_ptr
    contains
        procedure :: analyse => plan_analyse
        procedure :: report => plan_report
        procedure :: boundary => plan_boundary
        procedure :: plan_words
        procedure :: basis_words
        procedure :: prepare => plan_prepare
        procedure :: drop_analysis => plan_drop_analysis
        procedure, private :: plan_factor, factor_v8, factor_v4, factor_b8, factor_b4
        generic :: factor => plan_factor, factor_v8, factor_v4, factor_b8, factor_b4
        procedure :: solve => plan_solve
        procedure :: level => plan_level
        procedure :: transfer => plan_transfer
        procedure :: transfer_words => plan_transfer_words
        procedure, private :: morph_safe_v8, morph_safe_v4, morph_safe_b8, morph_safe_b4
        generic :: morph_safe => morph_safe_v8, morph_safe_v4, morph_safe_b8, morph_safe_b4
        procedure :: morph_safe_words => plan_morph_safe_words
        procedure :: share_of => plan_share_of
        procedure :: share_words => plan_share_words
        procedure :: free => plan_free
        procedure, private :: plan_assign
        generic :: assignment(=) => plan_assign
        final :: plan_final
    end type

    type, public :: hm_basis
        private
        type(c_ptr) :: handle = c_null_ptr
        type(block_of_memory) :: memory
        integer(c_int64_t) :: n_points = 0, n_functions = 0, n_numbers = 1
    contains
        procedure :: init => basis_init
        procedure :: init_share => basis_init_share
        procedure :: address => basis_address
        procedure :: attach => basis_attach
        procedure :: write => basis_write
        procedure :: read => basis_read
        procedure :: save => basis_save
        procedure :: load => basis_load
        procedure :: bytes => basis_bytes
        procedure :: info => basis_info
        procedure :: curves => basis_curves
        procedure :: conditions => basis_conditions
        procedure, private :: values_v8, values_b8, values_v4, values_b4
        generic :: values => values_v8, values_b8, values_v4, values_b4
        procedure, private :: morph_v8, morph_v4, morph_b8, morph_b4
        generic :: morph => morph_v8, morph_v4, morph_b8, morph_b4
        procedure, private :: morph_to_v8, morph_to_v4, morph_to_b8, morph_to_b4
        generic :: morph_to => morph_to_v8, morph_to_v4, morph_to_b8, morph_to_b4
        procedure, private :: displacement_v8, displacement_v4, displacement_b8, displacement_b4
        generic :: displacement => displacement_v8, displacement_v4, displacement_b8, displacement_b4
        generic :: velocity => displacement_v8, displacement_v4, displacement_b8, displacement_b4
        procedure, private :: adjoint_v8, adjoint_v4, adjoint_b8, adjoint_b4
        generic :: adjoint => adjoint_v8, adjoint_v4, adjoint_b8, adjoint_b4
        procedure, private :: boundary_error_v8, boundary_error_v4, boundary_error_b8, boundary_error_b4
        generic :: boundary_error => boundary_error_v8, boundary_error_v4, boundary_error_b8, boundary_error_b4
        procedure, private :: admissible_step_v8, admissible_step_v4, admissible_step_b8, admissible_step_b4
        generic :: admissible_step => admissible_step_v8, admissible_step_v4, admissible_step_b8, admissible_step_b4
        procedure, private :: quality_v8, quality_v4, quality_b8, quality_b4
        generic :: quality => quality_v8, quality_v4, quality_b8, quality_b4
        procedure, private :: assess_v8, assess_v4, assess_b8, assess_b4
        generic :: assess => assess_v8, assess_v4, assess_b8, assess_b4
        procedure :: single => basis_single
        procedure :: single_words => basis_single_words
        procedure :: extract => basis_extract
        procedure :: extract_words => basis_extract_words
        procedure :: pack => basis_pack
        procedure :: unpack => basis_unpack
        procedure :: parcel_words => basis_parcel_words
        procedure, private :: adjoint_scale_v8, adjoint_scale_v4, adjoint_scale_b8, adjoint_scale_b4
        generic :: adjoint_scale => adjoint_scale_v8, adjoint_scale_v4, adjoint_scale_b8, adjoint_scale_b4
        procedure, private :: adjoint_sums_v8, adjoint_sums_v4, adjoint_sums_b8, adjoint_sums_b4
        generic :: adjoint_sums => adjoint_sums_v8, adjoint_sums_v4, adjoint_sums_b8, adjoint_sums_b4
        procedure, private :: adjoint_finish_8, adjoint_finish_4
        generic :: adjoint_finish => adjoint_finish_8, adjoint_finish_4
        procedure :: free => basis_free
        procedure, private :: basis_assign
        generic :: assignment(=) => basis_assign
        final :: basis_final
    end type

    public :: hm_abi_version, hm_version, hm_status_name, hm_openmp, hm_fit_words, hm_analysis_words

    ! ---- The C functions, for those who want them as they are

    public :: hm_c_abi_version, hm_c_version, hm_c_status_name, hm_c_curves_check, hm_c_curve_basis, hm_c_curve_point, &
        hm_c_curve_project, hm_c_fit_size, hm_c_fit, hm_c_analysis_size, hm_c_analysis_init, hm_c_analysis_report, &
        hm_c_analysis_boundary, hm_c_plan_size, hm_c_plan_init, hm_c_basis_size, hm_c_basis_init, hm_c_plan_factor, &
        hm_c_plan_solve, hm_c_plan_level, hm_c_basis_attach, hm_c_basis_info_get, hm_c_basis_curves, &
        hm_c_basis_conditions, hm_c_basis_values, hm_c_single_size, hm_c_single_init, hm_c_transfer_size, &
        hm_c_transfer, hm_c_morph, hm_c_adjoint, &
        hm_c_boundary_error, hm_c_extract_size, hm_c_extract_init, hm_c_share_of, hm_c_share_size, hm_c_share_init, &
        hm_c_parcel_size, hm_c_parcel_pack, hm_c_parcel_unpack, hm_c_adjoint_scale, hm_c_adjoint_sums, &
        hm_c_adjoint_finish, hm_c_admissible_step, hm_c_quality, hm_c_assess, hm_c_morph_safe_size, hm_c_morph_safe

    interface
        integer(c_int32_t) function hm_c_abi_version() bind(c, name="hm_abi_version")
            import
        end function
        type(c_ptr) function hm_c_version() bind(c, name="hm_version")
            import
        end function
        type(c_ptr) function hm_c_status_name(status) bind(c, name="hm_status_name")
            import
            integer(c_int32_t), value, intent(in) :: status
        end function
        integer(c_int32_t) function hm_c_curves_check(curves, err) bind(c, name="hm_curves_check")
            import
            type(hm_c_curves), intent(in) :: curves
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_curve_basis(curves, curve, u, n_derivatives, control, values, err) &
            bind(c, name="hm_curve_basis")
            import
            type(hm_c_curves), intent(in) :: curves
            integer(c_int32_t), value, intent(in) :: curve
            real(c_double), value, intent(in) :: u
            integer(c_int32_t), value, intent(in) :: n_derivatives
            integer(c_int32_t), intent(inout) :: control(*)
            real(c_double), intent(inout) :: values(*)
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_curve_point(curves, curve, u, n_derivatives, xy, err) &
            bind(c, name="hm_curve_point")
            import
            type(hm_c_curves), intent(in) :: curves
            integer(c_int32_t), value, intent(in) :: curve
            real(c_double), value, intent(in) :: u
            integer(c_int32_t), value, intent(in) :: n_derivatives
            real(c_double), intent(inout) :: xy(*)
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_curve_project(curves, curve, x, y, u, distance, err) &
            bind(c, name="hm_curve_project")
            import
            type(hm_c_curves), intent(in) :: curves
            integer(c_int32_t), value, intent(in) :: curve
            real(c_double), value, intent(in) :: x, y
            real(c_double), intent(inout) :: u, distance
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_fit_size(n, options, bytes, err) bind(c, name="hm_fit_size")
            import
            integer(c_int32_t), value, intent(in) :: n
            type(hm_c_fit_options), intent(in) :: options
            integer(c_size_t), intent(inout) :: bytes
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_fit(curves, block, bytes, x, y, stride, n, is_loop, options, report, err) &
            bind(c, name="hm_fit")
            import
            type(c_ptr), intent(inout) :: curves
            type(c_ptr), value, intent(in) :: block
            integer(c_size_t), value, intent(in) :: bytes
            type(c_ptr), value, intent(in) :: x, y
            integer(c_int64_t), value, intent(in) :: stride
            integer(c_int32_t), value, intent(in) :: n, is_loop
            type(hm_c_fit_options), intent(in) :: options
            type(hm_fit_report), intent(inout) :: report
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_analysis_size(problem, options, bytes, err) bind(c, name="hm_analysis_size")
            import
            type(hm_c_problem), intent(in) :: problem
            type(c_ptr), value, intent(in) :: options
            integer(c_size_t), intent(inout) :: bytes
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_analysis_init(analysis, block, bytes, problem, options, err) &
            bind(c, name="hm_analysis_init")
            import
            type(c_ptr), intent(inout) :: analysis
            type(c_ptr), value, intent(in) :: block
            integer(c_size_t), value, intent(in) :: bytes
            type(hm_c_problem), intent(in) :: problem
            type(c_ptr), value, intent(in) :: options
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_analysis_report(analysis, report, err) bind(c, name="hm_analysis_report")
            import
            type(c_ptr), value, intent(in) :: analysis
            type(hm_mesh_report), intent(inout) :: report
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_analysis_boundary(analysis, n_markers, markers, piece, points, capacity, n, &
            is_loop, err) bind(c, name="hm_analysis_boundary")
            import
            type(c_ptr), value, intent(in) :: analysis
            integer(c_int32_t), value, intent(in) :: n_markers
            integer(c_int32_t), intent(in) :: markers(*)
            integer(c_int32_t), value, intent(in) :: piece
            integer(c_int32_t), intent(inout) :: points(*)
            integer(c_int32_t), value, intent(in) :: capacity
            integer(c_int32_t), intent(inout) :: n, is_loop
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_plan_size(analysis, bytes, err) bind(c, name="hm_plan_size")
            import
            type(c_ptr), value, intent(in) :: analysis
            integer(c_size_t), intent(inout) :: bytes
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_plan_init(plan, block, bytes, analysis, err) bind(c, name="hm_plan_init")
            import
            type(c_ptr), intent(inout) :: plan
            type(c_ptr), value, intent(in) :: block
            integer(c_size_t), value, intent(in) :: bytes
            type(c_ptr), value, intent(in) :: analysis
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_basis_size(analysis, bytes, err) bind(c, name="hm_basis_size")
            import
            type(c_ptr), value, intent(in) :: analysis
            integer(c_size_t), intent(inout) :: bytes
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_basis_init(basis, block, bytes, analysis, err) bind(c, name="hm_basis_init")
            import
            type(c_ptr), intent(inout) :: basis
            type(c_ptr), value, intent(in) :: block
            integer(c_size_t), value, intent(in) :: bytes
            type(c_ptr), value, intent(in) :: analysis
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_plan_factor(plan, x, y, stride, err) bind(c, name="hm_plan_factor")
            import
            type(c_ptr), value, intent(in) :: plan, x, y
            integer(c_int64_t), value, intent(in) :: stride
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_plan_solve(plan, basis, report, err) bind(c, name="hm_plan_solve")
            import
            type(c_ptr), value, intent(in) :: plan, basis
            type(hm_solve_report), intent(inout) :: report
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_plan_level(plan, level, cells, n_cells, err) bind(c, name="hm_plan_level")
            import
            type(c_ptr), value, intent(in) :: plan
            integer(c_int32_t), value, intent(in) :: level
            integer(c_int32_t), intent(inout) :: cells(*), n_cells
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_basis_attach(basis, block, bytes, mesh, err) bind(c, name="hm_basis_attach")
            import
            type(c_ptr), intent(inout) :: basis
            type(c_ptr), value, intent(in) :: block
            integer(c_size_t), value, intent(in) :: bytes
            type(c_ptr), value, intent(in) :: mesh
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_basis_info_get(basis, info, err) bind(c, name="hm_basis_info_get")
            import
            type(c_ptr), value, intent(in) :: basis
            type(hm_c_basis_info), intent(inout) :: info
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_basis_curves(basis, out, curve, capacity, err) bind(c, name="hm_basis_curves")
            import
            type(c_ptr), value, intent(in) :: basis
            type(hm_c_curves), intent(inout) :: out
            type(hm_c_curve), intent(inout) :: curve(*)
            integer(c_int32_t), value, intent(in) :: capacity
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_basis_conditions(basis, out, capacity, n, err) &
            bind(c, name="hm_basis_conditions")
            import
            type(c_ptr), value, intent(in) :: basis
            type(hm_c_condition), intent(inout) :: out(*)
            integer(c_int32_t), value, intent(in) :: capacity
            integer(c_int32_t), intent(inout) :: n
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_basis_values(basis, function, number, values, err) &
            bind(c, name="hm_basis_values")
            import
            type(c_ptr), value, intent(in) :: basis
            integer(c_int32_t), value, intent(in) :: function, number
            type(c_ptr), value, intent(in) :: values
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_single_size(basis, bytes, err) bind(c, name="hm_single_size")
            import
            type(c_ptr), value, intent(in) :: basis
            integer(c_size_t), intent(inout) :: bytes
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_single_init(single, block, bytes, basis, err) bind(c, name="hm_single_init")
            import
            type(c_ptr), intent(inout) :: single
            type(c_ptr), value, intent(in) :: block
            integer(c_size_t), value, intent(in) :: bytes
            type(c_ptr), value, intent(in) :: basis
            type(hm_c_error), intent(inout) :: err
        end function

        integer(c_int32_t) function hm_c_transfer_size(analysis, coarse_mesh, bytes, err) &
            bind(c, name="hm_transfer_size")
            import
            type(c_ptr), value, intent(in) :: analysis
            type(hm_c_mesh), intent(in) :: coarse_mesh
            integer(c_size_t), intent(inout) :: bytes
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_transfer(basis, block, bytes, analysis, coarse, coarse_mesh, report, err) &
            bind(c, name="hm_transfer")
            import
            type(c_ptr), value, intent(in) :: basis, block
            integer(c_size_t), value, intent(in) :: bytes
            type(c_ptr), value, intent(in) :: analysis, coarse
            type(hm_c_mesh), intent(in) :: coarse_mesh
            type(hm_transfer_report), intent(inout) :: report
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_morph(basis, move, x, y, stride, x_new, y_new, stride_new, executor, err) &
            bind(c, name="hm_morph")
            import
            type(c_ptr), value, intent(in) :: basis
            real(c_double), intent(in) :: move(*)
            type(c_ptr), value, intent(in) :: x, y
            integer(c_int64_t), value, intent(in) :: stride
            type(c_ptr), value, intent(in) :: x_new, y_new
            integer(c_int64_t), value, intent(in) :: stride_new
            type(c_ptr), value, intent(in) :: executor
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_adjoint(basis, dj_dx, dj_dy, stride, gradient, executor, err) &
            bind(c, name="hm_adjoint")
            import
            type(c_ptr), value, intent(in) :: basis, dj_dx, dj_dy
            integer(c_int64_t), value, intent(in) :: stride
            real(c_double), intent(inout) :: gradient(*)
            type(c_ptr), value, intent(in) :: executor
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_boundary_error(basis, move, x, y, stride, x_new, y_new, stride_new, error, &
            point, err) bind(c, name="hm_boundary_error")
            import
            type(c_ptr), value, intent(in) :: basis
            real(c_double), intent(in) :: move(*)
            type(c_ptr), value, intent(in) :: x, y
            integer(c_int64_t), value, intent(in) :: stride
            type(c_ptr), value, intent(in) :: x_new, y_new
            integer(c_int64_t), value, intent(in) :: stride_new
            real(c_double), intent(inout) :: error
            integer(c_int32_t), intent(inout) :: point
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_extract_size(basis, n, bytes, err) bind(c, name="hm_extract_size")
            import
            type(c_ptr), value, intent(in) :: basis
            integer(c_int32_t), value, intent(in) :: n
            integer(c_size_t), intent(inout) :: bytes
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_extract_init(rows, block, bytes, basis, n, points, err) &
            bind(c, name="hm_extract_init")
            import
            type(c_ptr), intent(inout) :: rows
            type(c_ptr), value, intent(in) :: block
            integer(c_size_t), value, intent(in) :: bytes
            type(c_ptr), value, intent(in) :: basis
            integer(c_int32_t), value, intent(in) :: n
            integer(c_int32_t), intent(in) :: points(*)
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_share_of(analysis, part, n_parts, first, n, err) bind(c, name="hm_share_of")
            import
            type(c_ptr), value, intent(in) :: analysis
            integer(c_int32_t), value, intent(in) :: part, n_parts
            integer(c_int32_t), intent(inout) :: first, n
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_share_size(analysis, first, n, bytes, err) bind(c, name="hm_share_size")
            import
            type(c_ptr), value, intent(in) :: analysis
            integer(c_int32_t), value, intent(in) :: first, n
            integer(c_size_t), intent(inout) :: bytes
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_share_init(share, block, bytes, analysis, first, n, err) &
            bind(c, name="hm_share_init")
            import
            type(c_ptr), intent(inout) :: share
            type(c_ptr), value, intent(in) :: block
            integer(c_size_t), value, intent(in) :: bytes
            type(c_ptr), value, intent(in) :: analysis
            integer(c_int32_t), value, intent(in) :: first, n
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_parcel_size(share, n, doubles, err) bind(c, name="hm_parcel_size")
            import
            type(c_ptr), value, intent(in) :: share
            integer(c_int32_t), value, intent(in) :: n
            integer(c_int64_t), intent(inout) :: doubles
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_parcel_pack(share, n, points, parcel, err) bind(c, name="hm_parcel_pack")
            import
            type(c_ptr), value, intent(in) :: share
            integer(c_int32_t), value, intent(in) :: n
            integer(c_int32_t), intent(in) :: points(*)
            real(c_double), intent(inout) :: parcel(*)
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_parcel_unpack(rows, parcel, doubles, err) bind(c, name="hm_parcel_unpack")
            import
            type(c_ptr), value, intent(in) :: rows
            real(c_double), intent(in) :: parcel(*)
            integer(c_int64_t), value, intent(in) :: doubles
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_adjoint_scale(basis, dj_dx, dj_dy, stride, scale, executor, err) &
            bind(c, name="hm_adjoint_scale")
            import
            type(c_ptr), value, intent(in) :: basis, dj_dx, dj_dy
            integer(c_int64_t), value, intent(in) :: stride
            integer(c_int32_t), intent(inout) :: scale
            type(c_ptr), value, intent(in) :: executor
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_adjoint_sums(basis, dj_dx, dj_dy, stride, scale, sums, executor, err) &
            bind(c, name="hm_adjoint_sums")
            import
            type(c_ptr), value, intent(in) :: basis, dj_dx, dj_dy
            integer(c_int64_t), value, intent(in) :: stride
            integer(c_int32_t), value, intent(in) :: scale
            integer(c_int64_t), intent(inout) :: sums(*)
            type(c_ptr), value, intent(in) :: executor
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_adjoint_finish(basis, scale, sums, gradient, err) &
            bind(c, name="hm_adjoint_finish")
            import
            type(c_ptr), value, intent(in) :: basis
            integer(c_int32_t), value, intent(in) :: scale
            integer(c_int64_t), intent(in) :: sums(*)
            real(c_double), intent(inout) :: gradient(*)
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_admissible_step(basis, mesh, dx, dy, stride, executor, report, err) &
            bind(c, name="hm_admissible_step")
            import
            type(c_ptr), value, intent(in) :: basis
            type(hm_c_mesh), intent(in) :: mesh
            type(c_ptr), value, intent(in) :: dx, dy
            integer(c_int64_t), value, intent(in) :: stride
            type(c_ptr), value, intent(in) :: executor
            type(hm_step_report), intent(inout) :: report
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_quality(basis, mesh, x, y, stride, x_ref, y_ref, stride_ref, executor, &
            report, err) bind(c, name="hm_quality")
            import
            type(c_ptr), value, intent(in) :: basis
            type(hm_c_mesh), intent(in) :: mesh
            type(c_ptr), value, intent(in) :: x, y
            integer(c_int64_t), value, intent(in) :: stride
            type(c_ptr), value, intent(in) :: x_ref, y_ref
            integer(c_int64_t), value, intent(in) :: stride_ref
            type(c_ptr), value, intent(in) :: executor
            type(hm_quality_report), intent(inout) :: report
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_assess(basis, mesh, dx, dy, stride, executor, step, quality, err) &
            bind(c, name="hm_assess")
            import
            type(c_ptr), value, intent(in) :: basis
            type(hm_c_mesh), intent(in) :: mesh
            type(c_ptr), value, intent(in) :: dx, dy
            integer(c_int64_t), value, intent(in) :: stride
            type(c_ptr), value, intent(in) :: executor
            type(hm_step_report), intent(inout) :: step
            type(hm_quality_report), intent(inout) :: quality
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_morph_safe_size(plan, bytes, err) bind(c, name="hm_morph_safe_size")
            import
            type(c_ptr), value, intent(in) :: plan
            integer(c_size_t), intent(inout) :: bytes
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_morph_safe(plan, basis, move, x_new, y_new, stride_new, derivative, work, &
            bytes, options, report, err) bind(c, name="hm_morph_safe")
            import
            type(c_ptr), value, intent(in) :: plan, basis
            real(c_double), intent(in) :: move(*)
            type(c_ptr), value, intent(in) :: x_new, y_new
            integer(c_int64_t), value, intent(in) :: stride_new
            type(c_ptr), value, intent(in) :: derivative, work
            integer(c_size_t), value, intent(in) :: bytes
            type(hm_c_safe_options), intent(in) :: options
            type(hm_safe_report), intent(inout) :: report
            type(hm_c_error), intent(inout) :: err
        end function
    end interface

    ! ---- Where coordinates lie

    type :: view
        type(c_ptr) :: x = c_null_ptr, y = c_null_ptr
        integer(c_int64_t) :: stride = 1, n = 0
        integer :: ni = 0, nj = 0                               ! structured
        real(c_double), pointer :: copy(:, :) => null()         ! (n,2) where they cannot be used as they lie
        character(len=112) :: wrong = ""
    end type

    interface view_of
        procedure :: view_of_v8, view_of_b8, view_of_v4, view_of_b4
    end interface
    interface put_back
        procedure :: put_back_b8, put_back_v4, put_back_b4
    end interface
    interface hm_finish   ! harmorph_mpi.f90 ends its calls like those here
        procedure :: finish
    end interface
    public :: hm_finish
    interface as_double
        procedure :: as_double_8, as_double_4
    end interface

contains
    ! ==== Errors and status ===========================================================================================

    ! The end of every call: tells the caller, or stops the program.
    subroutine finish(status, e, stat, err)
        integer(c_int32_t), intent(in) :: status
        type(hm_c_error), intent(in) :: e
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        character(len=:), allocatable :: text
        if (present(err)) then
            err%code = int(status)
            err%item = int(e%item)
            err%value = e%value
            err%text = sentence(e)
        end if
        if (present(stat)) then
            stat = int(status)
        else if (status < 0) then
            text = "harmorph: " // hm_status_name(int(status)) // ": " // trim(sentence(e))
            error stop text
        end if
    end subroutine

    pure function sentence(e) result(text)
        type(hm_c_error), intent(in) :: e
        character(len=112) :: text
        integer :: k
        text = ""
        do k = 1, size(e%text)
            if (e%text(k) == c_null_char) exit
            text(k:k) = e%text(k)
        end do
    end function

    ! Refuses with a reason found here. An error that was found before stays.
    subroutine refuse(status, e, text, code)
        integer(c_int32_t), intent(inout) :: status
        type(hm_c_error), intent(inout) :: e
        character(len=*), intent(in) :: text
        integer, intent(in), optional :: code
        integer :: k
        if (status < 0) return
        status = hm_bad_argument
        if (present(code)) status = int(code, c_int32_t)
        e = hm_c_error(code=status)
        do k = 1, min(len_trim(text), size(e%text) - 1)
            e%text(k) = text(k:k)
        end do
    end subroutine

    function c_string(start) result(text)
        type(c_ptr), intent(in) :: start
        character(len=:), allocatable :: text
        character(kind=c_char), pointer :: letters(:)
        integer :: k, n
        call c_f_pointer(start, letters, [100])
        n = 0
        do while (letters(n + 1) /= c_null_char)
            n = n + 1
        end do
        allocate(character(len=n) :: text)
        do k = 1, n
            text(k:k) = letters(k)
        end do
    end function

    integer function hm_abi_version()
        hm_abi_version = int(hm_c_abi_version())
    end function

    function hm_version() result(text)
        character(len=:), allocatable :: text
        text = c_string(hm_c_version())
    end function

    function hm_status_name(status) result(text)
        integer, intent(in) :: status
        character(len=:), allocatable :: text
        text = c_string(hm_c_status_name(int(status, c_int32_t)))
    end function

    subroutine check_abi(status, e)
        integer(c_int32_t), intent(inout) :: status
        type(hm_c_error), intent(inout) :: e
        if (hm_c_abi_version() /= hm_abi) call refuse(status, e, &
            "harmorph.f90 and libharmorph.a are of different versions", &
            hm_unsupported)
    end subroutine

    ! ==== Threads =====================================================================================================

    subroutine tasks_run(self, task)
        class(hm_tasks), intent(in) :: self
        integer, intent(in) :: task
        procedure(c_task), pointer :: run
        call c_f_procpointer(self%task, run)
        call run(self%context, int(task - 1, c_int32_t))
    end subroutine

    ! Threads of OpenMP, where this file is compiled with it (-fopenmp); otherwise the calling thread alone.
    function hm_openmp(n_threads) result(executor)
        integer, intent(in) :: n_threads
        type(hm_executor) :: executor
        executor%n_threads = 1
        !$ executor%n_threads = min(n_threads, 256)
        if (executor%n_threads /= 1) executor%run => run_openmp
        if (n_threads < 1) executor%n_threads = n_threads        ! the call will refuse it
    end function

    subroutine run_openmp(n_threads, n_tasks, tasks)
        integer, intent(in) :: n_threads, n_tasks
        type(hm_tasks), intent(in) :: tasks
        integer :: k
        !$omp parallel do schedule(dynamic, 1) num_threads(n_threads)
        do k = 1, n_tasks
            call tasks%run(k)
        end do
        if (n_threads < 0) return                                ! used without OpenMP, too
    end subroutine

    subroutine call_executor(user, n_tasks, task, context) bind(c, name="")
        type(c_ptr), value, intent(in) :: user
        integer(c_int32_t), value, intent(in) :: n_tasks
        type(c_funptr), value, intent(in) :: task
        type(c_ptr), value, intent(in) :: context
        type(callback), pointer :: its
        procedure(hm_run), pointer :: run
        call c_f_pointer(user, its)
        call c_f_procpointer(its%procedure, run)
        call run(int(its%n_threads), int(n_tasks), hm_tasks(task, context))
    end subroutine

    function call_progress(user, phase, fraction) result(cancelled) bind(c, name="")
        type(c_ptr), value, intent(in) :: user
        integer(c_int32_t), value, intent(in) :: phase
        real(c_double), value, intent(in) :: fraction
        integer(c_int32_t) :: cancelled
        type(callback), pointer :: its
        procedure(hm_progress), pointer :: progress
        logical :: cancel
        call c_f_pointer(user, its)
        call c_f_procpointer(its%procedure, progress)
        cancel = .false.
        call progress(int(phase), fraction, cancel)
        cancelled = merge(1_c_int32_t, 0_c_int32_t, cancel)
    end function

    ! The C executor that calls the Fortran one; `threads` must outlive the call.
    function c_executor_of(executor, threads) result(address)
        type(hm_executor), intent(in), optional :: executor
        type(c_threads), intent(inout), target :: threads
        type(c_ptr) :: address
        address = c_null_ptr
        if (.not. present(executor)) return
        threads%c%struct_size = int(c_sizeof(threads%c), c_int64_t)
        threads%c%n_threads = int(executor%n_threads, c_int32_t)
        threads%its%n_threads = threads%c%n_threads
        if (associated(executor%run)) then
            threads%c%run = c_funloc(call_executor)
            threads%its%procedure = c_funloc(executor%run)
        end if
        threads%c%user = c_loc(threads%its)
        address = c_loc(threads%c)
    end function

    ! ==== Memory ======================================================================================================

    pure function words_of(bytes) result(words)
        integer(c_size_t), intent(in) :: bytes
        integer(c_int64_t) :: words
        words = int((bytes + 7) / 8, c_int64_t)
    end function

    ! A block of so many bytes: the caller's, or allocated here.
    subroutine take(block, bytes, work, status, e)
        type(block_of_memory), intent(inout) :: block
        integer(c_size_t), intent(in) :: bytes
        real(c_double), intent(inout), target, optional :: work(:)
        integer(c_int32_t), intent(inout) :: status
        type(hm_c_error), intent(inout) :: e
        integer :: failed
        if (status < 0) return
        block%bytes = bytes
        if (present(work)) then
            block%bytes = 8 * size(work, kind=c_size_t)
            if (.not. is_contiguous(work)) then
                call refuse(status, e, "work is not contiguous")
            else if (block%bytes < bytes) then
                call refuse(status, e, "work is too small", hm_block_too_small)
                e%value = real(bytes - block%bytes, c_double)
            else
                block%start = c_loc(work(1))
            end if
            return
        end if
        allocate(block%words(words_of(bytes)), stat=failed)
        if (failed /= 0) then
            nullify(block%words)
            call refuse(status, e, "no memory for a block", hm_block_too_small)
            e%value = real(bytes, c_double)
            return
        end if
        block%start = c_loc(block%words(1))
    end subroutine

    subroutine give_back(block)
        type(block_of_memory), intent(inout) :: block
        if (associated(block%words)) deallocate(block%words)
        block = block_of_memory()
    end subroutine

    ! ==== Where coordinates lie =======================================================================================

    ! Distance of two numbers in memory; 0: not a whole number of them.
    function distance(from, to) result(numbers)
        type(c_ptr), intent(in) :: from, to
        integer(c_int64_t) :: numbers
        integer(c_intptr_t) :: bytes
        bytes = transfer(to, bytes) - transfer(from, bytes)
        numbers = 0
        if (mod(bytes, 8_c_intptr_t) == 0) numbers = int(bytes / 8, c_int64_t)
    end function

    function view_of_v8(x, y) result(v)
        real(c_double), intent(in), target :: x(:), y(:)
        type(view) :: v
        v%n = size(x, kind=c_int64_t)
        if (size(y, kind=c_int64_t) /= v%n) v%wrong = "x and y have different lengths"
        if (v%n == 0) v%wrong = "an array of coordinates is empty"
        if (v%wrong /= "") return
        v%x = c_loc(x(1))
        v%y = c_loc(y(1))
        if (v%n == 1) return
        v%stride = distance(c_loc(x(1)), c_loc(x(2)))
        if (v%stride < 1 .or. v%stride /= distance(c_loc(y(1)), c_loc(y(2)))) &
            v%wrong = "x and y must run upwards, with the same distance from point to point"
    end function

    function view_of_b8(x, y) result(v)
        real(c_double), intent(in), target :: x(:, :), y(:, :)
        type(view) :: v
        integer :: j
        integer(c_int64_t) :: k
        v%ni = size(x, 1)
        v%nj = size(x, 2)
        if (is_contiguous(x) .and. is_contiguous(y) .and. all(shape(x) == shape(y)) .and. size(x) > 0) then
            v%n = size(x, kind=c_int64_t)
            v%x = c_loc(x(1, 1))
            v%y = c_loc(y(1, 1))
            return
        end if
        call make_copy(v, size(x, kind=c_int64_t), all(shape(x) == shape(y)))
        if (.not. associated(v%copy)) return
        do j = 1, v%nj
            k = int(v%ni, c_int64_t) * (j - 1)
            v%copy(k + 1:k + v%ni, 1) = x(:, j)
            v%copy(k + 1:k + v%ni, 2) = y(:, j)
        end do
    end function

    function view_of_v4(x, y) result(v)
        real(c_float), intent(in) :: x(:), y(:)
        type(view) :: v
        call make_copy(v, size(x, kind=c_int64_t), size(x) == size(y))
        if (.not. associated(v%copy)) return
        v%copy(:, 1) = real(x, c_double)
        v%copy(:, 2) = real(y, c_double)
    end function

    function view_of_b4(x, y) result(v)
        real(c_float), intent(in) :: x(:, :), y(:, :)
        type(view) :: v
        integer :: j
        integer(c_int64_t) :: k
        v%ni = size(x, 1)
        v%nj = size(x, 2)
        call make_copy(v, size(x, kind=c_int64_t), all(shape(x) == shape(y)))
        if (.not. associated(v%copy)) return
        do j = 1, v%nj
            k = int(v%ni, c_int64_t) * (j - 1)
            v%copy(k + 1:k + v%ni, 1) = real(x(:, j), c_double)
            v%copy(k + 1:k + v%ni, 2) = real(y(:, j), c_double)
        end do
    end function

    subroutine make_copy(v, n, same_shape)
        type(view), intent(inout) :: v
        integer(c_int64_t), intent(in) :: n
        logical, intent(in) :: same_shape
        integer :: failed
        if (.not. same_shape) v%wrong = "x and y have different shapes"
        if (n == 0) v%wrong = "an array of coordinates is empty"
        if (v%wrong /= "") return
        allocate(v%copy(n, 2), stat=failed)
        if (failed /= 0) then
            nullify(v%copy)
            v%wrong = "no memory to convert the coordinates"
            return
        end if
        v%n = n
        v%x = c_loc(v%copy(1, 1))
        v%y = c_loc(v%copy(1, 2))
    end subroutine

    subroutine drop(v)
        type(view), intent(in) :: v
        real(c_double), pointer :: copy(:, :)
        copy => v%copy
        if (associated(copy)) deallocate(copy)
    end subroutine

    ! Results go from the copy, where there is one, to the caller's arrays. Double vectors need none.
    subroutine put_back_b8(v, x, y)
        type(view), intent(inout) :: v
        real(c_double), intent(inout) :: x(:, :), y(:, :)
        if (.not. associated(v%copy)) return
        x = reshape(v%copy(:, 1), shape(x))
        y = reshape(v%copy(:, 2), shape(y))
        call drop(v)
    end subroutine

    subroutine put_back_v4(v, x, y)
        type(view), intent(inout) :: v
        real(c_float), intent(inout) :: x(:), y(:)
        if (.not. associated(v%copy)) return
        x = real(v%copy(:, 1), c_float)
        y = real(v%copy(:, 2), c_float)
        call drop(v)
    end subroutine

    subroutine put_back_b4(v, x, y)
        type(view), intent(inout) :: v
        real(c_float), intent(inout) :: x(:, :), y(:, :)
        if (.not. associated(v%copy)) return
        x = reshape(real(v%copy(:, 1), c_float), shape(x))
        y = reshape(real(v%copy(:, 2), c_float), shape(y))
        call drop(v)
    end subroutine

    function as_double_8(pairs) result(copy)
        real(c_double), intent(in) :: pairs(:, :)
        real(c_double), allocatable :: copy(:, :)
        copy = pairs
    end function

    function as_double_4(pairs) result(copy)
        real(c_float), intent(in) :: pairs(:, :)
        real(c_double), allocatable :: copy(:, :)
        copy = real(pairs, c_double)
    end function

    ! ==== Mesh ========================================================================================================

    subroutine mesh_take(self, v, stat, err)
        class(hm_mesh), intent(inout) :: self
        type(view), intent(in) :: v
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        integer(c_int32_t) :: status
        status = hm_ok
        if (v%wrong /= "") call refuse(status, e, v%wrong)
        if (v%n > huge(0_c_int32_t)) call refuse(status, e, "there are more than 2^31-1 points")
        if (status == hm_ok) then
            self%c%x = v%x
            self%c%y = v%y
            self%c%stride = v%stride
            self%c%n_points = int(v%n, c_int32_t)
            call keep_copy(self, v%copy)
            if (v%ni > 0) then
                self%c%cell_layout = hm_cells_structured
                self%c%ni = int(v%ni, c_int32_t)
                self%c%nj = int(v%nj, c_int32_t)
            end if
        end if
        call finish(status, e, stat, err)
    end subroutine

    subroutine points_v8(self, x, y, stat, err)
        class(hm_mesh), intent(inout) :: self
        real(c_double), intent(in), target :: x(:), y(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call mesh_take(self, view_of(x, y), stat, err)
    end subroutine

    subroutine points_v4(self, x, y, stat, err)
        class(hm_mesh), intent(inout) :: self
        real(c_float), intent(in), target :: x(:), y(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call mesh_take(self, view_of(x, y), stat, err)
    end subroutine

    subroutine points_b8(self, x, y, stat, err)
        class(hm_mesh), intent(inout) :: self
        real(c_double), intent(in), target :: x(:, :), y(:, :)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call mesh_take(self, view_of(x, y), stat, err)
    end subroutine

    subroutine points_b4(self, x, y, stat, err)
        class(hm_mesh), intent(inout) :: self
        real(c_float), intent(in), target :: x(:, :), y(:, :)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call mesh_take(self, view_of(x, y), stat, err)
    end subroutine

    subroutine cells_fixed_i4(self, cells, stat, err)
        class(hm_mesh), intent(inout) :: self
        integer(c_int32_t), intent(in), target :: cells(:, :)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        if (refused(size(cells, 1) < 3 .or. size(cells, 1) > 4, "cells must be (3,n) or (4,n)", stat, err)) return
        if (refused(.not. is_contiguous(cells), "cells is not contiguous", stat, err)) return
        self%c%cell_points = place_2(cells)
        call set_cells(self, merge(hm_cells_triangles, hm_cells_quads, size(cells, 1) == 3), size(cells, 2))
    end subroutine

    subroutine cells_fixed_i8(self, cells, stat, err)
        class(hm_mesh), intent(inout) :: self
        integer(c_int64_t), intent(in), target :: cells(:, :)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        if (refused(size(cells, 1) < 3 .or. size(cells, 1) > 4, "cells must be (3,n) or (4,n)", stat, err)) return
        call convert(self%converted(in_cells), cells, size(cells, kind=c_int64_t), self%c%cell_points)
        call set_cells(self, merge(hm_cells_triangles, hm_cells_quads, size(cells, 1) == 3), size(cells, 2))
    end subroutine

    subroutine cells_rows_i4(self, cells, start, stat, err)
        class(hm_mesh), intent(inout) :: self
        integer(c_int32_t), intent(in), target :: cells(:), start(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        if (refused(size(start) < 2, "start must be (n_cells+1)", stat, err)) return
        if (refused(start(size(start)) - self%c%index_base > size(cells), "cells is shorter than start says", stat, &
            err)) return
        if (refused(.not. is_contiguous(cells), "cells is not contiguous", stat, err)) return
        self%c%cell_points = place_1(cells)
        if (refused(.not. is_contiguous(start), "start is not contiguous", stat, err)) return
        self%c%cell_start = place_1(start)
        call set_cells(self, hm_cells_rows, size(start) - 1)
    end subroutine

    subroutine cells_rows_i8(self, cells, start, stat, err)
        class(hm_mesh), intent(inout) :: self
        integer(c_int64_t), intent(in), target :: cells(:), start(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        if (refused(size(start) < 2, "start must be (n_cells+1)", stat, err)) return
        if (refused(start(size(start)) - self%c%index_base > size(cells), "cells is shorter than start says", stat, &
            err)) return
        call convert(self%converted(in_cells), cells, size(cells, kind=c_int64_t), self%c%cell_points)
        call convert(self%converted(in_start), start, size(start, kind=c_int64_t), self%c%cell_start)
        call set_cells(self, hm_cells_rows, size(start) - 1)
    end subroutine

    subroutine faces_i4(self, points, markers, stat, err)
        class(hm_mesh), intent(inout) :: self
        integer(c_int32_t), intent(in), target :: points(:, :), markers(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        if (refused(size(points, 1) /= 2 .or. size(points, 2) /= size(markers), "faces wants points(2,n), markers(n)", &
            stat, err)) return
        if (refused(.not. is_contiguous(points), "points is not contiguous", stat, err)) return
        self%c%face_points = place_2(points)
        if (refused(.not. is_contiguous(markers), "markers is not contiguous", stat, err)) return
        self%c%face_markers = place_1(markers)
        self%c%n_faces = int(size(markers), c_int32_t)
    end subroutine

    subroutine faces_i8(self, points, markers, stat, err)
        class(hm_mesh), intent(inout) :: self
        integer(c_int64_t), intent(in), target :: points(:, :), markers(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        if (refused(size(points, 1) /= 2 .or. size(points, 2) /= size(markers), "faces wants points(2,n), markers(n)", &
            stat, err)) return
        call convert(self%converted(in_faces), points, size(points, kind=c_int64_t), self%c%face_points)
        call convert(self%converted(in_face_markers), markers, size(markers, kind=c_int64_t), self%c%face_markers)
        self%c%n_faces = int(size(markers), c_int32_t)
    end subroutine

    subroutine lists_i4(self, points, start, markers, stat, err)
        class(hm_mesh), intent(inout) :: self
        integer(c_int32_t), intent(in), target :: points(:), start(:), markers(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        if (refused(size(start) /= size(markers) + 1, "lists wants start(n+1), markers(n)", stat, err)) return
        if (refused(start(size(start)) - self%c%index_base > size(points), "lists: points is too short", stat, &
            err)) return
        if (refused(.not. is_contiguous(points), "points is not contiguous", stat, err)) return
        self%c%list_points = place_1(points)
        if (refused(.not. is_contiguous(start), "start is not contiguous", stat, err)) return
        self%c%list_start = place_1(start)
        if (refused(.not. is_contiguous(markers), "markers is not contiguous", stat, err)) return
        self%c%list_markers = place_1(markers)
        self%c%n_lists = int(size(markers), c_int32_t)
    end subroutine

    subroutine lists_i8(self, points, start, markers, stat, err)
        class(hm_mesh), intent(inout) :: self
        integer(c_int64_t), intent(in), target :: points(:), start(:), markers(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        if (refused(size(start) /= size(markers) + 1, "lists wants start(n+1), markers(n)", stat, err)) return
        if (refused(start(size(start)) - self%c%index_base > size(points), "lists: points is too short", stat, &
            err)) return
        call convert(self%converted(in_lists), points, size(points, kind=c_int64_t), self%c%list_points)
        call convert(self%converted(in_list_start), start, size(start, kind=c_int64_t), self%c%list_start)
        call convert(self%converted(in_list_markers), markers, size(markers, kind=c_int64_t), self%c%list_markers)
        self%c%n_lists = int(size(markers), c_int32_t)
    end subroutine

    subroutine set_cells(self, layout, n)
        class(hm_mesh), intent(inout) :: self
        integer, intent(in) :: layout, n
        self%c%cell_layout = int(layout, c_int32_t)
        self%c%n_cells = int(n, c_int32_t)
    end subroutine

    ! Points given as one array that are those of a block: (i,j) is i + ni*(j-1).
    subroutine mesh_structured(self, ni, nj)
        class(hm_mesh), intent(inout) :: self
        integer, intent(in) :: ni, nj
        call set_cells(self, hm_cells_structured, 0)
        self%c%ni = int(ni, c_int32_t)
        self%c%nj = int(nj, c_int32_t)
    end subroutine

    ! Refuses by stat and err (or stops) if wrong; tells the caller that all is well otherwise.
    logical function refused(wrong, text, stat, err)
        logical, intent(in) :: wrong
        character(len=*), intent(in) :: text
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        integer(c_int32_t) :: status
        status = hm_ok
        if (wrong) call refuse(status, e, text)
        call finish(status, e, stat, err)
        refused = wrong
    end function

    ! Where coordinates had to be converted: new ones of the same mesh go where the old ones were, as plans look there.
    subroutine keep_copy(self, copy)
        class(hm_mesh), intent(inout) :: self
        real(c_double), pointer, intent(in) :: copy(:, :)
        real(c_double), pointer :: passing(:, :)
        passing => copy
        if (associated(self%coordinates)) then
            if (associated(passing)) then
                if (size(passing) == size(self%coordinates)) then
                    self%coordinates = passing
                    deallocate(passing)
                    self%c%x = c_loc(self%coordinates(1, 1))
                    self%c%y = c_loc(self%coordinates(1, 2))
                    return
                end if
            end if
            deallocate(self%coordinates)
        end if
        self%coordinates => passing
    end subroutine

    ! 4-byte integers are used where they lie, 8-byte ones converted.
    function place_1(array) result(address)
        integer(c_int32_t), intent(in), target :: array(:)
        type(c_ptr) :: address
        address = c_null_ptr
        if (size(array) > 0) address = c_loc(array(1))
    end function

    function place_2(array) result(address)
        integer(c_int32_t), intent(in), target :: array(:, :)
        type(c_ptr) :: address
        address = c_null_ptr
        if (size(array) > 0) address = c_loc(array(1, 1))
    end function

    subroutine convert(its, array, n, address)
        type(integers), intent(inout) :: its
        integer(c_int64_t), intent(in) :: n
        integer(c_int64_t), intent(in) :: array(n)
        type(c_ptr), intent(inout) :: address
        call forget(its)
        allocate(its%at(n))
        its%at = small(array)
        address = c_null_ptr
        if (n > 0) address = c_loc(its%at)
    end subroutine

    ! Numbers that do not fit become -1, which no check lets pass as a point.
    elemental function small(number) result(its)
        integer(c_int64_t), intent(in) :: number
        integer(c_int32_t) :: its
        its = -1
        if (abs(number) <= huge(its)) its = int(number, c_int32_t)
    end function

    subroutine forget(array)
        type(integers), intent(inout) :: array
        if (associated(array%at)) deallocate(array%at)
        nullify(array%at)
    end subroutine

    ! Adds points (i_from,j_from) .. (i_to,j_to) along i or j of a structured block to the boundary, on a marker.
    subroutine mesh_line(self, marker, i_from, i_to, j_from, j_to, stat, err)
        class(hm_mesh), intent(inout) :: self
        integer, intent(in) :: marker, i_from, i_to, j_from, j_to
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        integer(c_int32_t) :: status
        integer :: n, i_step, j_step, k
        integer(c_int32_t), allocatable :: line(:)
        status = hm_ok
        if (self%c%cell_layout /= hm_cells_structured) call refuse(status, e, "line: the mesh has no structured points")
        if (i_from /= i_to .and. j_from /= j_to) call refuse(status, e, "line: neither i nor j stays the same")
        if (min(i_from, i_to) < 1 .or. max(i_from, i_to) > self%c%ni .or. min(j_from, j_to) < 1 .or. &
            max(j_from, j_to) > self%c%nj) call refuse(status, e, "line: i or j is outside the block")
        if (status == hm_ok) then
            n = max(abs(i_to - i_from), abs(j_to - j_from)) + 1
            i_step = sign(merge(1, 0, i_to /= i_from), i_to - i_from)
            j_step = sign(merge(1, 0, j_to /= j_from), j_to - j_from)
            allocate(line(n))
            do k = 0, n - 1
                line(k + 1) = int(self%c%index_base + i_from - 1 + k * i_step + self%c%ni * (j_from - 1 + k * j_step), &
                    c_int32_t)
            end do
            if (self%c%n_lists == 0) then
                call append(self, in_list_start, self%c%list_start, 0, [self%c%index_base])
                self%c%list_points = c_null_ptr
            end if
            call append(self, in_lists, self%c%list_points, list_end(self), line)
            call append(self, in_list_start, self%c%list_start, int(self%c%n_lists) + 1, &
                [int(self%c%index_base + list_end(self) + n, c_int32_t)])
            call append(self, in_list_markers, self%c%list_markers, int(self%c%n_lists), [int(marker, c_int32_t)])
            self%c%n_lists = self%c%n_lists + 1_c_int32_t
        end if
        call finish(status, e, stat, err)
    end subroutine

    ! How many points the lists have so far.
    integer function list_end(self)
        class(hm_mesh), intent(in) :: self
        integer(c_int32_t), pointer :: start(:)
        call c_f_pointer(self%c%list_start, start, [self%c%n_lists + 1])
        list_end = start(self%c%n_lists + 1) - self%c%index_base
    end function

    ! The n integers at address and some more behind them, in memory of the mesh.
    subroutine append(self, slot, address, n, more)
        class(hm_mesh), intent(inout) :: self
        integer, intent(in) :: slot, n
        type(c_ptr), intent(inout) :: address
        integer(c_int32_t), intent(in) :: more(:)
        integer(c_int32_t), pointer :: old(:), grown(:)
        allocate(grown(n + size(more)))
        if (n > 0) then
            call c_f_pointer(address, old, [n])
            grown(:n) = old
        end if
        grown(n + 1:) = more
        call forget(self%converted(slot))
        self%converted(slot)%at => grown
        address = c_loc(grown(1))
    end subroutine

    ! 1, or 0 for arrays (and reports) that count points and cells from 0. Before line.
    subroutine mesh_count_from(self, first)
        class(hm_mesh), intent(inout) :: self
        integer, intent(in) :: first
        self%c%index_base = int(first, c_int32_t)
    end subroutine

    function c_mesh_of(mesh) result(c)
        class(hm_mesh), intent(in) :: mesh
        type(hm_c_mesh) :: c
        c = mesh%c
        c%struct_size = int(c_sizeof(c), c_int64_t)
    end function

    subroutine mesh_free(self)
        class(hm_mesh), intent(inout) :: self
        integer :: k
        if (associated(self%coordinates)) deallocate(self%coordinates)
        nullify(self%coordinates)
        do k = 1, size(self%converted)
            call forget(self%converted(k))
        end do
        self%c = hm_c_mesh(index_base=1)
    end subroutine

    impure elemental subroutine mesh_final(self)
        type(hm_mesh), intent(inout) :: self
        call self%free()
    end subroutine

    subroutine mesh_assign(to, from)
        class(hm_mesh), intent(inout) :: to
        type(hm_mesh), intent(in) :: from
        if (to%c%n_points >= 0 .or. from%c%n_points >= 0) error stop "harmorph: a mesh cannot be assigned"
    end subroutine

    ! ==== Curves ======================================================================================================

    ! C structs that point into the curves; `list` must outlive `set`.
    subroutine c_curves_of(curves, set, list)
        class(hm_curves), intent(in), target :: curves
        type(hm_c_curves), intent(out) :: set
        type(hm_c_curve), intent(out), allocatable, target :: list(:)
        integer :: k
        set%struct_size = int(c_sizeof(set), c_int64_t)
        set%index_base = 1
        if (allocated(curves%control)) then
            set%n_control = int(size(curves%control) / 2, c_int32_t)
            if (size(curves%control) > 0) set%control = c_loc(curves%control)
        end if
        if (allocated(curves%weights)) then
            if (size(curves%weights) > 0) set%weights = c_loc(curves%weights)
        end if
        allocate(list(0))
        if (.not. allocated(curves%curve)) return
        if (size(curves%curve) == 0) return
        deallocate(list)
        allocate(list(size(curves%curve)))
        do k = 1, size(list)
            list(k)%struct_size = int(c_sizeof(list(k)), c_int64_t)
            list(k)%degree = int(curves%curve(k)%degree, c_int32_t)
            if (allocated(curves%curve(k)%knots)) then
                list(k)%n_indices = int(size(curves%curve(k)%knots) - curves%curve(k)%degree - 1, c_int32_t)
                if (size(curves%curve(k)%knots) > 0) list(k)%knots = c_loc(curves%curve(k)%knots)
            end if
            if (allocated(curves%curve(k)%indices)) then
                list(k)%n_indices = int(size(curves%curve(k)%indices), c_int32_t)
                if (size(curves%curve(k)%indices) > 0) list(k)%indices = c_loc(curves%curve(k)%indices)
            end if
        end do
        set%n_curves = int(size(list), c_int32_t)
        set%curve = c_loc(list)
    end subroutine

    ! What C cannot see: whether the arrays have the lengths that the numbers say.
    subroutine check_lengths(curves, status, e)
        class(hm_curves), intent(in) :: curves
        integer(c_int32_t), intent(inout) :: status
        type(hm_c_error), intent(inout) :: e
        integer :: k, n
        if (.not. allocated(curves%control) .or. .not. allocated(curves%curve)) then
            call refuse(status, e, "curves without control points, or no curve was added")
            return
        end if
        if (size(curves%control, 1) /= 2) call refuse(status, e, "curves%control is not (2,n_control)")
        if (allocated(curves%weights)) then
            if (size(curves%weights) /= size(curves%control, 2)) call refuse(status, e, &
                "one weight for each control point")
        end if
        do k = 1, size(curves%curve)
            if (.not. allocated(curves%curve(k)%knots)) then
                call refuse(status, e, "a curve has no knots")
                return
            end if
            n = size(curves%control, 2)
            if (allocated(curves%curve(k)%indices)) n = size(curves%curve(k)%indices)
            if (size(curves%curve(k)%knots) /= n + curves%curve(k)%degree + 1) &
                call refuse(status, e, "a curve must have as many knots as indices and degree + 1", hm_bad_curve)
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

    subroutine curves_check(self, stat, err)
        class(hm_curves), intent(in), target :: self
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        type(hm_c_curves) :: set
        type(hm_c_curve), allocatable, target :: list(:)
        integer(c_int32_t) :: status
        status = hm_ok
        call check_lengths(self, status, e)
        if (status == hm_ok) then
            call c_curves_of(self, set, list)
            status = hm_c_curves_check(set, e)
        end if
        call finish(status, e, stat, err)
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
        type(hm_c_error) :: e
        type(hm_c_curves) :: set
        type(hm_c_curve), allocatable, target :: list(:)
        integer(c_int32_t) :: status, number(6)
        real(c_double) :: value(36)
        integer :: order, d
        order = 0
        call open_curve(self, curve, set, list, status, e)
        if (status == hm_ok) then
            order = int(list(curve)%degree) + 1
            if (size(values, 1) < order .or. size(values, 2) < 1 .or. size(values, 2) > 6) &
                call refuse(status, e, "values is not (degree+1, 0:derivatives) with at most 5 derivatives")
        end if
        if (status == hm_ok) status = hm_c_curve_basis(set, int(curve - 1, c_int32_t), u, &
            int(size(values, 2) - 1, c_int32_t), number, value, e)
        if (status >= 0) then
            control = int(number(:order))
            do d = 0, ubound(values, 2)
                values(:order, d) = value(d * order + 1:(d + 1) * order)
            end do
        end if
        call finish(status, e, stat, err)
    end subroutine

    ! The point at u, xy(:,0), and as many derivatives as xy(2,0:) has room for.
    subroutine curves_point(self, curve, u, xy, stat, err)
        class(hm_curves), intent(in), target :: self
        integer, intent(in) :: curve
        real(c_double), intent(in) :: u
        real(c_double), intent(inout) :: xy(1:, 0:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        type(hm_c_curves) :: set
        type(hm_c_curve), allocatable, target :: list(:)
        integer(c_int32_t) :: status
        real(c_double) :: value(12)
        call open_curve(self, curve, set, list, status, e)
        if (size(xy, 1) /= 2 .or. size(xy, 2) < 1 .or. size(xy, 2) > 6) &
            call refuse(status, e, "xy is not (2, 0:derivatives) with at most 5 derivatives")
        if (status == hm_ok) status = hm_c_curve_point(set, int(curve - 1, c_int32_t), u, &
            int(size(xy, 2) - 1, c_int32_t), value, e)
        if (status >= 0) xy = reshape(value(:size(xy)), shape(xy))
        call finish(status, e, stat, err)
    end subroutine

    ! The parameter of the point nearest to (x, y), and how far it is.
    subroutine curves_project(self, curve, x, y, u, distance, stat, err)
        class(hm_curves), intent(in), target :: self
        integer, intent(in) :: curve
        real(c_double), intent(in) :: x, y
        real(c_double), intent(inout) :: u, distance
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        type(hm_c_curves) :: set
        type(hm_c_curve), allocatable, target :: list(:)
        integer(c_int32_t) :: status
        call open_curve(self, curve, set, list, status, e)
        if (status == hm_ok) status = hm_c_curve_project(set, int(curve - 1, c_int32_t), x, y, u, distance, e)
        call finish(status, e, stat, err)
    end subroutine

    subroutine open_curve(curves, curve, set, list, status, e)
        class(hm_curves), intent(in), target :: curves
        integer, intent(in) :: curve
        type(hm_c_curves), intent(out) :: set
        type(hm_c_curve), intent(out), allocatable, target :: list(:)
        integer(c_int32_t), intent(out) :: status
        type(hm_c_error), intent(inout) :: e
        status = hm_ok
        call check_lengths(curves, status, e)
        if (status < 0) return
        if (curve < 1 .or. curve > size(curves%curve)) call refuse(status, e, "there is no curve of this number")
        if (status < 0) return
        call c_curves_of(curves, set, list)
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
        type(hm_c_error) :: e
        integer(c_int32_t) :: status
        integer(c_size_t) :: bytes
        status = hm_c_fit_size(int(n, c_int32_t), c_fit_options_of(degree, n_control, closed), bytes, e)
        if (status >= 0) words = words_of(bytes)
        call finish(status, e, stat, err)
    end subroutine

    ! Least squares through points in order; loop: the last is joined to the first, which is not repeated.
    subroutine curves_fit_8(self, x, y, loop, degree, n_control, closed, report, work, stat, err)
        class(hm_curves), intent(inout) :: self
        real(c_double), intent(in), target :: x(:), y(:)
        logical, intent(in) :: loop
        integer, intent(in), optional :: degree, n_control, closed
        type(hm_fit_report), intent(out), optional :: report
        real(c_double), intent(inout), target, optional :: work(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call fit(self, view_of(x, y), loop, c_fit_options_of(degree, n_control, closed), report, work, stat, err)
    end subroutine

    subroutine curves_fit_4(self, x, y, loop, degree, n_control, closed, report, work, stat, err)
        class(hm_curves), intent(inout) :: self
        real(c_float), intent(in), target :: x(:), y(:)
        logical, intent(in) :: loop
        integer, intent(in), optional :: degree, n_control, closed
        type(hm_fit_report), intent(out), optional :: report
        real(c_double), intent(inout), target, optional :: work(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call fit(self, view_of(x, y), loop, c_fit_options_of(degree, n_control, closed), report, work, stat, err)
    end subroutine

    subroutine fit(self, v, loop, options, report, work, stat, err)
        class(hm_curves), intent(inout) :: self
        type(view), intent(in) :: v
        logical, intent(in) :: loop
        type(hm_c_fit_options), intent(in) :: options
        type(hm_fit_report), intent(out), optional :: report
        real(c_double), intent(inout), target, optional :: work(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        type(hm_fit_report) :: its
        type(block_of_memory) :: block
        type(hm_c_curves), pointer :: set
        type(hm_c_curve), pointer :: list(:)
        type(c_ptr) :: made
        integer(c_int32_t) :: status, n
        integer(c_size_t) :: bytes
        status = hm_ok
        call check_abi(status, e)
        if (v%wrong /= "") call refuse(status, e, v%wrong)
        n = int(min(v%n, int(huge(n), c_int64_t)), c_int32_t)
        if (status == hm_ok) status = hm_c_fit_size(n, options, bytes, e)
        call take(block, bytes, work, status, e)
        if (status == hm_ok) then
            its%struct_size = int(c_sizeof(its), c_int64_t)
            status = hm_c_fit(made, block%start, block%bytes, v%x, v%y, v%stride, n, merge(1_c_int32_t, 0_c_int32_t, &
                loop), options, its, e)
        end if
        if (status >= 0) then
            call c_f_pointer(made, set)
            call c_f_pointer(set%curve, list, [set%n_curves])
            call copy_curves(set, list, self)
            its%max_error_point = its%max_error_point + 1_c_int32_t
            its%first_point = its%first_point + 1_c_int32_t
            if (present(report)) report = its
        end if
        call give_back(block)
        call drop(v)
        call finish(status, e, stat, err)
    end subroutine

    ! ==== Plan ========================================================================================================

    ! Everything that the analysis will point to, where it stays.
    subroutine set_data(data, mesh, curves, conditions, given_points, given_curves, given_u, options, status, e)
        type(plan_data), intent(inout), target :: data
        type(hm_mesh), intent(in) :: mesh
        type(hm_curves), intent(in), optional :: curves
        type(hm_condition), intent(in), optional :: conditions(:)
        integer, intent(in), optional :: given_points(:), given_curves(:)
        real(c_double), intent(in), optional :: given_u(:)
        type(hm_options), intent(in), optional :: options
        integer(c_int32_t), intent(inout) :: status
        type(hm_c_error), intent(inout) :: e
        type(hm_options) :: its
        data%mesh = c_mesh_of(mesh)
        data%problem%struct_size = int(c_sizeof(data%problem), c_int64_t)
        data%problem%mesh = c_loc(data%mesh)
        if (present(options)) its = options
        data%c_options%struct_size = int(c_sizeof(data%c_options), c_int64_t)
        data%c_options%operator_kind = int(its%operator_kind, c_int32_t)
        data%c_options%scheme = int(its%scheme, c_int32_t)
        data%c_options%engine = int(its%engine, c_int32_t)
        data%c_options%kernel = int(its%kernel, c_int32_t)
        data%c_options%tolerance = its%tolerance
        data%c_options%exponent_quarters = int(its%exponent_quarters, c_int32_t)
        data%c_options%offset_correction = merge(1_c_int32_t, 0_c_int32_t, its%offset_correction)
        data%c_options%levels = int(its%levels, c_int32_t)
        data%c_options%agglomeration = int(its%agglomeration, c_int32_t)
        data%c_options%block_width = int(its%block_width, c_int32_t)
        data%c_options%max_iterations = int(its%max_iterations, c_int32_t)
        data%c_options%precision = int(its%precision, c_int32_t)
        data%c_options%start = int(its%start, c_int32_t)
        if (associated(its%history)) then
            data%c_options%history_length = int(size(its%history), c_int32_t)
            if (size(its%history) > 0) data%c_options%history = c_loc(its%history)
        end if
        if (associated(its%progress)) then
            data%c_options%progress = c_funloc(call_progress)
            data%progress%procedure = c_funloc(its%progress)
            data%c_options%progress_user = c_loc(data%progress)
        end if
        data%c_options%executor = c_executor_of(its%executor, data%threads)
        if (present(curves)) then
            call check_lengths(curves, status, e)
            data%curves = curves
            call c_curves_of(data%curves, data%set, data%curve)
            data%problem%curves = c_loc(data%set)
        end if
        if (present(conditions)) then
            data%conditions = c_conditions_of(conditions)
            data%problem%n_conditions = int(size(conditions), c_int32_t)
            if (size(conditions) > 0) data%problem%conditions = c_loc(data%conditions)
        end if
        if (.not. present(given_points)) return
        if (.not. present(given_curves) .or. .not. present(given_u)) then
            call refuse(status, e, "given_points without given_curves or given_u")
            return
        end if
        if (size(given_curves) /= size(given_points) .or. size(given_u) /= size(given_points)) &
            call refuse(status, e, "given_points, given_curves and given_u have different lengths")
        if (status < 0 .or. size(given_points) == 0) return
        data%given_points = int(given_points, c_int32_t)
        data%given_curves = int(given_curves - 1, c_int32_t)
        data%given_u = given_u
        data%problem%n_given = int(size(given_points), c_int32_t)
        data%problem%given_points = c_loc(data%given_points)
        data%problem%given_curves = c_loc(data%given_curves)
        data%problem%given_u = c_loc(data%given_u)
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
            if (conditions(k)%kind /= hm_on_curve .and. conditions(k)%first_curve == 1 .and. conditions(k)%n_curves == 1) &
                list(k)%n_curves = 0
            list(k)%body = int(conditions(k)%body - 1, c_int32_t)
            list(k)%partner = int(conditions(k)%partner, c_int32_t)
            list(k)%x = conditions(k)%x
            list(k)%y = conditions(k)%y
        end do
    end function

    ! 8-byte numbers of work that an analysis needs; the arguments are those of analyse.
    subroutine hm_analysis_words(words, mesh, curves, conditions, given_points, given_curves, given_u, options, stat, &
        err)
        integer(c_int64_t), intent(inout) :: words
        type(hm_mesh), intent(in) :: mesh
        type(hm_curves), intent(in), optional :: curves
        type(hm_condition), intent(in), optional :: conditions(:)
        integer, intent(in), optional :: given_points(:), given_curves(:)
        real(c_double), intent(in), optional :: given_u(:)
        type(hm_options), intent(in), optional :: options
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(plan_data), target :: data
        type(hm_c_error) :: e
        integer(c_int32_t) :: status
        integer(c_size_t) :: bytes
        status = hm_ok
        call set_data(data, mesh, curves, conditions, given_points, given_curves, given_u, options, status, e)
        if (status == hm_ok) status = hm_c_analysis_size(data%problem, c_loc(data%c_options), bytes, e)
        if (status >= 0) words = words_of(bytes)
        call finish(status, e, stat, err)
    end subroutine

    ! Checks mesh, curves and conditions, and orders the unknowns. Without curves or rigid bodies: the mesh alone. What
    ! the plan had before is forgotten. given_*: curve points whose parameters are known.
    subroutine plan_analyse(self, mesh, curves, conditions, given_points, given_curves, given_u, options, work, stat, &
        err)
        class(hm_plan), intent(inout) :: self
        type(hm_mesh), intent(in) :: mesh
        type(hm_curves), intent(in), optional :: curves
        type(hm_condition), intent(in), optional :: conditions(:)
        integer, intent(in), optional :: given_points(:), given_curves(:)
        real(c_double), intent(in), optional :: given_u(:)
        type(hm_options), intent(in), optional :: options
        real(c_double), intent(inout), target, optional :: work(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        integer(c_int32_t) :: status
        integer(c_size_t) :: bytes
        call self%free()
        status = hm_ok
        call check_abi(status, e)
        allocate(self%data)
        call set_data(self%data, mesh, curves, conditions, given_points, given_curves, given_u, options, status, e)
        if (status == hm_ok) status = hm_c_analysis_size(self%data%problem, c_loc(self%data%c_options), bytes, e)
        call take(self%analysis_memory, bytes, work, status, e)
        if (status == hm_ok) status = hm_c_analysis_init(self%analysis, self%analysis_memory%start, &
            self%analysis_memory%bytes, self%data%problem, c_loc(self%data%c_options), e)
        if (status < 0) call self%free()
        call finish(status, e, stat, err)
    end subroutine

    subroutine need_analysis(self, status, e)
        class(hm_plan), intent(in) :: self
        integer(c_int32_t), intent(inout) :: status
        type(hm_c_error), intent(inout) :: e
        if (.not. c_associated(self%analysis)) call refuse(status, e, "the plan has no analysis: call analyse first")
    end subroutine

    subroutine plan_report(self, report, stat, err)
        class(hm_plan), intent(in) :: self
        type(hm_mesh_report), intent(inout) :: report
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        integer(c_int32_t) :: status
        status = hm_ok
        call need_analysis(self, status, e)
        report%struct_size = int(c_sizeof(report), c_int64_t)
        if (status == hm_ok) status = hm_c_analysis_report(self%analysis, report, e)
        call finish(status, e, stat, err)
    end subroutine

    ! The points of these markers in order, the mesh on the left; loop: closed, the first point is not repeated.
    subroutine plan_boundary(self, markers, points, loop, piece, stat, err)
        class(hm_plan), intent(in) :: self
        integer, intent(in) :: markers(:)
        integer, allocatable, intent(out) :: points(:)
        logical, intent(out), optional :: loop
        integer, intent(in), optional :: piece
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        integer(c_int32_t) :: status, its_piece, n, is_loop, its_markers(size(markers))
        integer(c_int32_t), allocatable :: found(:)
        integer :: k
        status = hm_ok
        call need_analysis(self, status, e)
        its_piece = 0
        if (present(piece)) its_piece = int(piece - 1, c_int32_t)
        its_markers = int(markers, c_int32_t)
        n = 0
        is_loop = 0
        do k = 1, 2                           ! first without room, to learn how many there are
            allocate(found(n))
            if (status == hm_ok .or. k == 2) status = hm_c_analysis_boundary(self%analysis, int(size(markers), &
                c_int32_t), its_markers, its_piece, found, n, n, is_loop, e)
            if (.not. (k == 1 .and. status == hm_bad_argument .and. n > 0)) exit
            deallocate(found)
        end do
        if (status >= 0) points = int(found)
        if (present(loop)) loop = is_loop /= 0
        call finish(status, e, stat, err)
    end subroutine

    ! 8-byte numbers of work for prepare, and for a basis; 0 without an analysis that has curves.
    integer(c_int64_t) function plan_words(self)
        class(hm_plan), intent(in) :: self
        type(hm_c_error) :: e
        integer(c_size_t) :: bytes
        plan_words = 0
        if (hm_c_plan_size(self%analysis, bytes, e) >= 0) plan_words = words_of(bytes)
    end function

    integer(c_int64_t) function basis_words(self)
        class(hm_plan), intent(in) :: self
        type(hm_c_error) :: e
        integer(c_size_t) :: bytes
        basis_words = 0
        if (hm_c_basis_size(self%analysis, bytes, e) >= 0) basis_words = words_of(bytes)
    end function

    ! The block for matrix and factor; factor does it by itself where memory need not be given.
    subroutine plan_prepare(self, work, stat, err)
        class(hm_plan), intent(inout) :: self
        real(c_double), intent(inout), target, optional :: work(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        integer(c_int32_t) :: status
        integer(c_size_t) :: bytes
        status = hm_ok
        call need_analysis(self, status, e)
        if (status == hm_ok) status = hm_c_plan_size(self%analysis, bytes, e)
        if (status == hm_ok) then
            self%plan = c_null_ptr
            call give_back(self%plan_memory)
        end if
        call take(self%plan_memory, bytes, work, status, e)
        if (status == hm_ok) status = hm_c_plan_init(self%plan, self%plan_memory%start, self%plan_memory%bytes, &
            self%analysis, e)
        call finish(status, e, stat, err)
    end subroutine

    ! Saves memory: after prepare or factor, and basis%init, nobody needs the analysis.
    subroutine plan_drop_analysis(self)
        class(hm_plan), intent(inout) :: self
        self%analysis = c_null_ptr
        call give_back(self%analysis_memory)
    end subroutine

    ! On the coordinates of the mesh. The other forms of factor: on moved ones of the same mesh.
    subroutine plan_factor(self, stat, err)
        class(hm_plan), intent(inout) :: self
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call factor(self, view(), stat, err)
    end subroutine

    subroutine factor(self, v, stat, err)
        class(hm_plan), intent(inout) :: self
        type(view), intent(in) :: v
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        type(hm_error) :: reason
        integer(c_int32_t) :: status
        integer :: prepared
        status = hm_ok
        if (.not. c_associated(self%plan)) then
            call self%prepare(stat=prepared, err=reason)
            if (prepared < 0) call refuse(status, e, trim(reason%text), prepared)
        end if
        if (v%wrong /= "") call refuse(status, e, v%wrong)
        if (status == hm_ok .and. c_associated(v%x)) call check_count(v, int(self%data%mesh%n_points, c_int64_t), &
            status, e)
        if (status == hm_ok) status = hm_c_plan_factor(self%plan, v%x, v%y, v%stride, e)
        call drop(v)
        call finish(status, e, stat, err)
    end subroutine

    subroutine factor_v8(self, x, y, stat, err)
        class(hm_plan), intent(inout) :: self
        real(c_double), intent(in), target :: x(:), y(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call factor(self, view_of(x, y), stat, err)
    end subroutine

    subroutine factor_v4(self, x, y, stat, err)
        class(hm_plan), intent(inout) :: self
        real(c_float), intent(in), target :: x(:), y(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call factor(self, view_of(x, y), stat, err)
    end subroutine

    subroutine factor_b8(self, x, y, stat, err)
        class(hm_plan), intent(inout) :: self
        real(c_double), intent(in), target :: x(:, :), y(:, :)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call factor(self, view_of(x, y), stat, err)
    end subroutine

    subroutine factor_b4(self, x, y, stat, err)
        class(hm_plan), intent(inout) :: self
        real(c_float), intent(in), target :: x(:, :), y(:, :)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call factor(self, view_of(x, y), stat, err)
    end subroutine

    ! All functions; a basis that has no memory yet is made first.
    subroutine plan_solve(self, basis, report, stat, err)
        class(hm_plan), intent(inout) :: self
        type(hm_basis), intent(inout) :: basis
        type(hm_solve_report), intent(out), optional :: report
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        type(hm_error) :: reason
        type(hm_solve_report) :: its
        integer(c_int32_t) :: status
        integer :: made
        status = hm_ok
        if (.not. c_associated(self%plan)) call refuse(status, e, "the plan has no factor: call factor first")
        if (status == hm_ok .and. .not. c_associated(basis%handle)) then
            call basis%init(self, stat=made, err=reason)
            if (made < 0) call refuse(status, e, trim(reason%text), made)
        end if
        its%struct_size = int(c_sizeof(its), c_int64_t)
        if (status == hm_ok) status = hm_c_plan_solve(self%plan, basis%handle, its, e)
        if (its%residual_function >= 0) its%residual_function = its%residual_function + 1_c_int32_t
        if (present(report)) report = its
        call finish(status, e, stat, err)
    end subroutine

    ! Where agglomeration merged the mesh, after factor with an engine that has levels: in which cell of a level, 1 the
    ! finest, each point's control volume is; 0: a point whose value is known. cells(n_points) has values up to n_cells.
    subroutine plan_level(self, level, cells, n_cells, stat, err)
        class(hm_plan), intent(in) :: self
        integer, intent(in) :: level
        integer, allocatable, intent(out) :: cells(:)
        integer, intent(out), optional :: n_cells
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        integer(c_int32_t) :: status, n
        integer(c_int32_t), allocatable :: found(:)
        status = hm_ok
        n = 0
        if (.not. c_associated(self%plan)) call refuse(status, e, "the plan has no factor: call factor first")
        if (status == hm_ok) n = self%data%mesh%n_points
        allocate(found(n))
        if (status == hm_ok) status = hm_c_plan_level(self%plan, int(level - 1, c_int32_t), found, n, e)
        if (status >= 0) cells = int(found) + 1
        if (present(n_cells)) n_cells = int(n)
        call finish(status, e, stat, err)
    end subroutine

    ! Functions solved on a coarse mesh, for this denser one of the same domain: the plan needs no factor.
    subroutine plan_transfer(self, coarse, coarse_mesh, basis, report, work, stat, err)
        class(hm_plan), intent(in) :: self
        type(hm_basis), intent(in) :: coarse
        type(hm_mesh), intent(in) :: coarse_mesh
        type(hm_basis), intent(inout) :: basis
        type(hm_transfer_report), intent(out), optional :: report
        real(c_double), intent(inout), target, optional :: work(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        type(hm_error) :: reason
        type(hm_transfer_report) :: its
        type(block_of_memory) :: block
        integer(c_int32_t) :: status
        integer(c_size_t) :: bytes
        integer :: made
        status = hm_ok
        call need_analysis(self, status, e)
        call need_basis(coarse, status, e)
        if (status == hm_ok .and. .not. c_associated(basis%handle)) then
            call basis%init(self, stat=made, err=reason)
            if (made < 0) call refuse(status, e, trim(reason%text), made)
        end if
        if (status == hm_ok) status = hm_c_transfer_size(self%analysis, c_mesh_of(coarse_mesh), bytes, e)
        call take(block, bytes, work, status, e)
        its%struct_size = int(c_sizeof(its), c_int64_t)
        if (status == hm_ok) status = hm_c_transfer(basis%handle, block%start, block%bytes, self%analysis, &
            coarse%handle, c_mesh_of(coarse_mesh), its, e)
        if (present(report)) report = its
        call give_back(block)
        call finish(status, e, stat, err)
    end subroutine

    integer(c_int64_t) function plan_transfer_words(self, coarse_mesh)
        class(hm_plan), intent(in) :: self
        type(hm_mesh), intent(in) :: coarse_mesh
        type(hm_c_error) :: e
        integer(c_size_t) :: bytes
        plan_transfer_words = 0
        if (hm_c_transfer_size(self%analysis, c_mesh_of(coarse_mesh), bytes, &
            e) >= 0) plan_transfer_words = words_of(bytes)
    end function

    ! Which functions part k of n_parts may solve; n is 0 where there are more parts than functions.
    subroutine plan_share_of(self, part, n_parts, first, n, stat, err)
        class(hm_plan), intent(in) :: self
        integer, intent(in) :: part, n_parts
        integer, intent(inout) :: first, n
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        integer(c_int32_t) :: status, its_first, its_n
        status = hm_ok
        call need_analysis(self, status, e)
        if (status == hm_ok) status = hm_c_share_of(self%analysis, int(part - 1, c_int32_t), int(n_parts, c_int32_t), &
            its_first, its_n, e)
        if (status >= 0) then
            first = int(its_first) + 1
            n = int(its_n)
        end if
        call finish(status, e, stat, err)
    end subroutine

    integer(c_int64_t) function plan_share_words(self, first, n)
        class(hm_plan), intent(in) :: self
        integer, intent(in) :: first, n
        type(hm_c_error) :: e
        integer(c_size_t) :: bytes
        plan_share_words = 0
        if (hm_c_share_size(self%analysis, int(first - 1, c_int32_t), int(n, c_int32_t), bytes, e) >= 0) &
            plan_share_words = words_of(bytes)
    end function

    ! Working space of morph_safe; 0 without prepare or factor.
    integer(c_int64_t) function plan_morph_safe_words(self)
        class(hm_plan), intent(in) :: self
        type(hm_c_error) :: e
        integer(c_size_t) :: bytes
        plan_morph_safe_words = 0
        if (hm_c_morph_safe_size(self%plan, bytes, e) >= 0) plan_morph_safe_words = words_of(bytes)
    end function

    subroutine move_safely(self, basis, move, to, derivative, others, options, report, work, stat, err)
        class(hm_plan), intent(inout) :: self
        type(hm_basis), intent(in) :: basis
        real(c_double), intent(in) :: move(:, :)
        type(view), intent(in) :: to
        type(hm_basis), intent(inout), optional :: derivative
        type(hm_basis), intent(in), optional :: others(:)
        type(hm_safe_options), intent(in), optional :: options
        type(hm_safe_report), intent(out), optional :: report
        real(c_double), intent(inout), target, optional :: work(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        type(hm_error) :: reason
        type(hm_c_safe_options) :: c_options
        type(hm_safe_report) :: its
        type(c_ptr), allocatable, target :: handles(:)
        type(c_ptr) :: sum_of_steps
        type(block_of_memory) :: block
        integer(c_int32_t) :: status
        integer(c_size_t) :: bytes
        integer :: k, made
        status = hm_ok
        if (.not. c_associated(self%plan)) call refuse(status, e, "the plan is empty: call prepare or factor first")
        call need_basis(basis, status, e)
        call check_pairs_of_control(basis, move, status, e)
        call check_count(to, basis%n_points, status, e)
        sum_of_steps = c_null_ptr
        if (present(derivative) .and. status == hm_ok) then
            if (.not. c_associated(derivative%handle)) then
                call derivative%init(self, stat=made, err=reason)
                if (made < 0) call refuse(status, e, trim(reason%text), made)
            end if
            sum_of_steps = derivative%handle
        end if
        c_options%struct_size = int(c_sizeof(c_options), c_int64_t)
        if (present(options)) then
            c_options%max_resolves = int(options%max_resolves, c_int32_t)
            c_options%skipped_rungs = int(options%skipped_rungs, c_int32_t)
            c_options%heights = options%heights
            if (associated(options%reached)) then
                call check_pairs_of_control(basis, options%reached, status, e)
                c_options%reached = c_loc(options%reached)
            end if
        end if
        if (present(others)) then
            allocate(handles(size(others)))
            do k = 1, size(others)
                handles(k) = others(k)%handle
            end do
            c_options%n_others = int(size(others), c_int32_t)
            if (size(others) > 0) c_options%others = c_loc(handles)
        end if
        if (status == hm_ok) status = hm_c_morph_safe_size(self%plan, bytes, e)
        call take(block, bytes, work, status, e)
        its%struct_size = int(c_sizeof(its), c_int64_t)
        if (status == hm_ok) status = hm_c_morph_safe(self%plan, basis%handle, move, to%x, to%y, to%stride, &
            sum_of_steps, block%start, block%bytes, c_options, its, e)
        its%other = its%other + 1_c_int32_t
        if (present(report)) report = its
        call give_back(block)
        call finish(status, e, stat, err)
    end subroutine

    ! morph_safe(basis, move, x_new, y_new): however large move is, x_new has no inverted cell; hm_short: it is not all
    ! of move. From the mesh's own coordinates; x_new may be they. derivative: another basis for the step as a whole,
    ! made here if empty. others: bases to be tried where this one would invert cells; the report counts them from 1,
    ! 0: none.
    subroutine morph_safe_v8(self, basis, move, x_new, y_new, derivative, others, options, report, work, stat, err)
        class(hm_plan), intent(inout) :: self
        type(hm_basis), intent(in) :: basis
        real(c_double), intent(in) :: move(:, :)
        real(c_double), intent(inout), target :: x_new(:), y_new(:)
        type(hm_basis), intent(inout), optional :: derivative
        type(hm_basis), intent(in), optional :: others(:)
        type(hm_safe_options), intent(in), optional :: options
        type(hm_safe_report), intent(out), optional :: report
        real(c_double), intent(inout), target, optional :: work(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(view) :: v
        v = view_of(x_new, y_new)
        call move_safely(self, basis, as_double(move), v, derivative, others, options, report, work, stat, err)
    end subroutine

    subroutine morph_safe_v4(self, basis, move, x_new, y_new, derivative, others, options, report, work, stat, err)
        class(hm_plan), intent(inout) :: self
        type(hm_basis), intent(in) :: basis
        real(c_float), intent(in) :: move(:, :)
        real(c_float), intent(inout), target :: x_new(:), y_new(:)
        type(hm_basis), intent(inout), optional :: derivative
        type(hm_basis), intent(in), optional :: others(:)
        type(hm_safe_options), intent(in), optional :: options
        type(hm_safe_report), intent(out), optional :: report
        real(c_double), intent(inout), target, optional :: work(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(view) :: v
        v = view_of(x_new, y_new)
        call move_safely(self, basis, as_double(move), v, derivative, others, options, report, work, stat, err)
        call put_back(v, x_new, y_new)
    end subroutine

    subroutine morph_safe_b8(self, basis, move, x_new, y_new, derivative, others, options, report, work, stat, err)
        class(hm_plan), intent(inout) :: self
        type(hm_basis), intent(in) :: basis
        real(c_double), intent(in) :: move(:, :)
        real(c_double), intent(inout), target :: x_new(:, :), y_new(:, :)
        type(hm_basis), intent(inout), optional :: derivative
        type(hm_basis), intent(in), optional :: others(:)
        type(hm_safe_options), intent(in), optional :: options
        type(hm_safe_report), intent(out), optional :: report
        real(c_double), intent(inout), target, optional :: work(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(view) :: v
        v = view_of(x_new, y_new)
        call move_safely(self, basis, as_double(move), v, derivative, others, options, report, work, stat, err)
        call put_back(v, x_new, y_new)
    end subroutine

    subroutine morph_safe_b4(self, basis, move, x_new, y_new, derivative, others, options, report, work, stat, err)
        class(hm_plan), intent(inout) :: self
        type(hm_basis), intent(in) :: basis
        real(c_float), intent(in) :: move(:, :)
        real(c_float), intent(inout), target :: x_new(:, :), y_new(:, :)
        type(hm_basis), intent(inout), optional :: derivative
        type(hm_basis), intent(in), optional :: others(:)
        type(hm_safe_options), intent(in), optional :: options
        type(hm_safe_report), intent(out), optional :: report
        real(c_double), intent(inout), target, optional :: work(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(view) :: v
        v = view_of(x_new, y_new)
        call move_safely(self, basis, as_double(move), v, derivative, others, options, report, work, stat, err)
        call put_back(v, x_new, y_new)
    end subroutine

    subroutine plan_free(self)
        class(hm_plan), intent(inout) :: self
        self%analysis = c_null_ptr
        self%plan = c_null_ptr
        call give_back(self%analysis_memory)
        call give_back(self%plan_memory)
        if (associated(self%data)) deallocate(self%data)
        nullify(self%data)
    end subroutine

    impure elemental subroutine plan_final(self)
        type(hm_plan), intent(inout) :: self
        call self%free()
    end subroutine

    subroutine plan_assign(to, from)
        class(hm_plan), intent(inout) :: to
        type(hm_plan), intent(in) :: from
        if (associated(to%data) .or. associated(from%data) .or. .true.) error stop "harmorph: a plan cannot be assigned"
    end subroutine

    ! ==== Basis: its life =============================================================================================

    ! Memory for the functions; solve does it by itself where memory need not be given.
    subroutine basis_init(self, plan, work, stat, err)
        class(hm_basis), intent(inout) :: self
        class(hm_plan), intent(in) :: plan
        real(c_double), intent(inout), target, optional :: work(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        integer(c_int32_t) :: status
        integer(c_size_t) :: bytes
        call self%free()
        status = hm_ok
        call need_analysis(plan, status, e)
        if (status == hm_ok) status = hm_c_basis_size(plan%analysis, bytes, e)
        call take(self%memory, bytes, work, status, e)
        if (status == hm_ok) status = hm_c_basis_init(self%handle, self%memory%start, self%memory%bytes, &
            plan%analysis, e)
        call know_basis(self, status)
        call finish(status, e, stat, err)
    end subroutine

    ! Memory for functions first .. first+n-1 alone, n >= 0: a share, which solve fills.
    subroutine basis_init_share(self, plan, first, n, work, stat, err)
        class(hm_basis), intent(inout) :: self
        class(hm_plan), intent(in) :: plan
        integer, intent(in) :: first, n
        real(c_double), intent(inout), target, optional :: work(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        integer(c_int32_t) :: status
        integer(c_size_t) :: bytes
        call self%free()
        status = hm_ok
        call need_analysis(plan, status, e)
        if (status == hm_ok) status = hm_c_share_size(plan%analysis, int(first - 1, c_int32_t), int(n, c_int32_t), &
            bytes, e)
        call take(self%memory, bytes, work, status, e)
        if (status == hm_ok) status = hm_c_share_init(self%handle, self%memory%start, self%memory%bytes, &
            plan%analysis, int(first - 1, c_int32_t), int(n, c_int32_t), e)
        call know_basis(self, status)
        call finish(status, e, stat, err)
    end subroutine

    ! The library's object, for its other bindings; null: none.
    type(c_ptr) function basis_address(self)
        class(hm_basis), intent(in) :: self
        basis_address = self%handle
    end function

    ! The counts that the lengths of arrays are compared with; nothing stays of a basis that failed.
    subroutine know_basis(self, status)
        class(hm_basis), intent(inout) :: self
        integer(c_int32_t), intent(in) :: status
        type(hm_c_basis_info) :: info
        type(hm_c_error) :: e
        if (status >= 0) then
            info%struct_size = int(c_sizeof(info), c_int64_t)
            if (hm_c_basis_info_get(self%handle, info, e) < 0) return
            self%n_points = info%points
            self%n_functions = info%functions
            self%n_numbers = info%numbers_per_value
        else
            call self%free()
        end if
    end subroutine

    ! A basis that lies in an array already: shared memory, a message, a file. With a mesh: is it the mesh's?
    subroutine basis_attach(self, block, mesh, stat, err)
        class(hm_basis), intent(inout) :: self
        real(c_double), intent(inout), target :: block(:)
        type(hm_mesh), intent(in), optional :: mesh
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        integer(c_int32_t) :: status
        call self%free()
        status = hm_ok
        call take(self%memory, 8_c_size_t, block, status, e)
        call attach(self, mesh, status, e)
        call finish(status, e, stat, err)
    end subroutine

    subroutine attach(self, mesh, status, e)
        class(hm_basis), intent(inout) :: self
        type(hm_mesh), intent(in), optional :: mesh
        integer(c_int32_t), intent(inout) :: status
        type(hm_c_error), intent(inout) :: e
        type(hm_c_mesh), target :: its
        type(c_ptr) :: address
        call check_abi(status, e)
        address = c_null_ptr
        if (present(mesh)) then
            its = c_mesh_of(mesh)
            address = c_loc(its)
        end if
        if (status == hm_ok) status = hm_c_basis_attach(self%handle, self%memory%start, self%memory%bytes, address, e)
        call know_basis(self, status)
    end subroutine

    ! How long the basis is, in memory and in a file.
    integer(c_int64_t) function basis_bytes(self)
        class(hm_basis), intent(in) :: self
        type(hm_basis_info) :: info
        integer :: stat
        call self%info(info, stat)
        basis_bytes = info%bytes
    end function

    ! To where the unit stands, opened with access="stream", form="unformatted".
    subroutine basis_write(self, unit, stat, err)
        class(hm_basis), intent(in) :: self
        integer, intent(in) :: unit
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        integer(c_int32_t) :: status
        integer(c_int8_t), pointer :: bytes(:)
        integer :: failed
        character(len=80) :: reason
        status = hm_ok
        call need_basis(self, status, e)
        if (status == hm_ok) then
            call c_f_pointer(self%handle, bytes, [self%bytes()])
            write(unit, iostat=failed, iomsg=reason) bytes
            if (failed /= 0) call refuse(status, e, "the basis cannot be written: " // reason, hm_bad_basis)
        end if
        call finish(status, e, stat, err)
    end subroutine

    ! From where the unit stands: so many bytes, or all that the file still has.
    subroutine basis_read(self, unit, mesh, bytes, stat, err)
        class(hm_basis), intent(inout) :: self
        integer, intent(in) :: unit
        type(hm_mesh), intent(in), optional :: mesh
        integer(c_int64_t), intent(in), optional :: bytes
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        integer(c_int32_t) :: status
        integer(c_int8_t), pointer :: letters(:)
        integer(c_int64_t) :: n, position
        integer :: failed
        character(len=80) :: reason
        call self%free()
        status = hm_ok
        if (present(bytes)) then
            n = bytes
        else
            inquire(unit, size=n, pos=position)
            n = n - position + 1
        end if
        if (n < 1) call refuse(status, e, "no basis can be read: the file has ended, or is none", hm_bad_basis)
        call take(self%memory, int(max(n, 0_c_int64_t), c_size_t), status=status, e=e)
        if (status == hm_ok) then
            self%memory%bytes = int(n, c_size_t)
            call c_f_pointer(self%memory%start, letters, [n])
            read(unit, iostat=failed, iomsg=reason) letters
            if (failed /= 0) call refuse(status, e, "the basis cannot be read: " // reason, hm_bad_basis)
        end if
        call attach(self, mesh, status, e)
        call finish(status, e, stat, err)
    end subroutine

    subroutine basis_save(self, file, stat, err)
        class(hm_basis), intent(in) :: self
        character(len=*), intent(in) :: file
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        integer :: unit
        if (refused(.not. c_associated(self%handle), "the basis is empty: there is nothing to save", stat, err)) return
        call open_stream(unit, file, "write", stat, err)
        if (unit == -1) return
        call self%write(unit, stat, err)
        close(unit)
    end subroutine

    subroutine basis_load(self, file, mesh, stat, err)
        class(hm_basis), intent(inout) :: self
        character(len=*), intent(in) :: file
        type(hm_mesh), intent(in), optional :: mesh
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        integer :: unit
        call open_stream(unit, file, "read", stat, err)
        if (unit == -1) return
        call self%read(unit, mesh, stat=stat, err=err)
        close(unit)
    end subroutine

    ! unit -1: refused, and told.
    subroutine open_stream(unit, file, action, stat, err)
        integer, intent(out) :: unit
        character(len=*), intent(in) :: file, action
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        integer(c_int32_t) :: status
        integer :: failed
        character(len=80) :: reason
        open(newunit=unit, file=file, access="stream", form="unformatted", action=action, iostat=failed, iomsg=reason, &
            status=merge("replace", "old    ", action == "write"))
        if (failed == 0) return
        unit = -1
        status = hm_ok
        call refuse(status, e, reason, hm_bad_basis)
        call finish(status, e, stat, err)
    end subroutine

    subroutine need_basis(self, status, e)
        class(hm_basis), intent(in) :: self
        integer(c_int32_t), intent(inout) :: status
        type(hm_c_error), intent(inout) :: e
        if (.not. c_associated(self%handle)) call refuse(status, e, &
            "the basis is empty: solve, read or attach it first")
    end subroutine

    subroutine basis_info(self, info, stat, err)
        class(hm_basis), intent(in) :: self
        type(hm_basis_info), intent(out) :: info
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        type(hm_c_basis_info) :: c
        integer(c_int32_t) :: status
        integer(c_int32_t), pointer :: numbers(:)
        real(c_double), pointer :: u(:)
        status = hm_ok
        call need_basis(self, status, e)
        c%struct_size = int(c_sizeof(c), c_int64_t)
        if (status == hm_ok) status = hm_c_basis_info_get(self%handle, c, e)
        if (status >= 0) then
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
        end if
        call finish(status, e, stat, err)
    end subroutine

    ! 8-byte numbers of work for the functions in single precision; 0 of a basis that cannot have them.
    integer(c_int64_t) function basis_single_words(self)
        class(hm_basis), intent(in) :: self
        type(hm_c_error) :: e
        integer(c_size_t) :: bytes
        basis_single_words = 0
        if (hm_c_single_size(self%handle, bytes, e) >= 0) basis_single_words = words_of(bytes)
    end function

    ! The functions in single precision, but on the wall: another basis, which needs this one no longer.
    subroutine basis_single(self, narrow, work, stat, err)
        class(hm_basis), intent(in) :: self
        type(hm_basis), intent(inout) :: narrow
        real(c_double), intent(inout), target, optional :: work(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        integer(c_int32_t) :: status
        integer(c_size_t) :: bytes
        call narrow%free()
        status = hm_ok
        call need_basis(self, status, e)
        if (status == hm_ok) status = hm_c_single_size(self%handle, bytes, e)
        call take(narrow%memory, bytes, work, status, e)
        if (status == hm_ok) status = hm_c_single_init(narrow%handle, narrow%memory%start, narrow%memory%bytes, &
            self%handle, e)
        call know_basis(narrow, status)
        call finish(status, e, stat, err)
    end subroutine

    ! The conditions the basis was solved with.
    subroutine basis_conditions(self, conditions, stat, err)
        class(hm_basis), intent(in) :: self
        type(hm_condition), allocatable, intent(out) :: conditions(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        type(hm_c_condition), allocatable :: list(:)
        integer(c_int32_t) :: status, n
        integer :: k
        status = hm_ok
        n = 0
        call need_basis(self, status, e)
        do k = 1, 2                           ! first without room, to learn how many there are
            allocate(list(n))
            if (n > 0) list%struct_size = int(c_sizeof(list(1)), c_int64_t)
            if (status == hm_ok .or. k == 2) status = hm_c_basis_conditions(self%handle, list, n, n, e)
            if (.not. (k == 1 .and. status == hm_bad_argument .and. n > 0)) exit
            deallocate(list)
        end do
        if (status >= 0) then
            conditions = [(hm_condition(int(list(k)%marker), int(list(k)%kind), int(list(k)%first_curve) + 1, &
                int(list(k)%n_curves), int(list(k)%body) + 1, int(list(k)%partner), list(k)%x, list(k)%y), k = 1, &
                int(n))]
        end if
        call finish(status, e, stat, err)
    end subroutine

    ! The curves the basis was solved with.
    subroutine basis_curves(self, curves, stat, err)
        class(hm_basis), intent(in) :: self
        type(hm_curves), intent(inout) :: curves
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        type(hm_c_curves) :: set
        type(hm_c_curve), allocatable :: list(:)
        type(hm_basis_info) :: info
        integer(c_int32_t) :: status
        integer :: known
        status = hm_ok
        call need_basis(self, status, e)
        if (status == hm_ok) then
            call self%info(info, known)
            allocate(list(info%curves))
            set%struct_size = int(c_sizeof(set), c_int64_t)
            status = hm_c_basis_curves(self%handle, set, list, int(info%curves, c_int32_t), e)
        end if
        if (status >= 0) call copy_curves(set, list, curves)
        call finish(status, e, stat, err)
    end subroutine

    subroutine basis_free(self)
        class(hm_basis), intent(inout) :: self
        self%handle = c_null_ptr
        call give_back(self%memory)
        self%n_points = 0
        self%n_functions = 0
    end subroutine

    impure elemental subroutine basis_final(self)
        type(hm_basis), intent(inout) :: self
        call self%free()
    end subroutine

    subroutine basis_assign(to, from)
        class(hm_basis), intent(inout) :: to
        type(hm_basis), intent(in) :: from
        if (to%n_points >= 0 .or. from%n_points >= 0) error stop "harmorph: a basis cannot be assigned"
    end subroutine

    ! ==== Basis: its use ==============================================================================================

    subroutine check_count(v, n, status, e)
        type(view), intent(in) :: v
        integer(c_int64_t), intent(in) :: n
        integer(c_int32_t), intent(inout) :: status
        type(hm_c_error), intent(inout) :: e
        character(len=112) :: text
        if (v%wrong /= "") call refuse(status, e, v%wrong)
        if (status < 0 .or. v%n == n) return
        write(text, "(a, i0, a, i0)") "an array holds ", v%n, " points, the mesh has ", n
        call refuse(status, e, text)
    end subroutine

    subroutine check_pairs_of_control(self, pairs, status, e)
        class(hm_basis), intent(in) :: self
        real(c_double), intent(in) :: pairs(:, :)
        integer(c_int32_t), intent(inout) :: status
        type(hm_c_error), intent(inout) :: e
        character(len=112) :: text
        if (size(pairs, 1) == 2 .and. size(pairs, 2, kind=c_int64_t) == self%n_functions) return
        write(text, "(a, i0, a)") "a movement, or a gradient, must be (2,", self%n_functions, ")"
        call refuse(status, e, text)
    end subroutine

    ! values: not allocated if refused.
    subroutine function_values(self, function, number, room, values, stat, err)
        class(hm_basis), intent(in) :: self
        integer, intent(in) :: function
        integer, intent(in), optional :: number
        integer(c_int64_t), intent(in) :: room
        real(c_double), allocatable, target, intent(out) :: values(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        integer(c_int32_t) :: status
        integer :: its_number
        status = hm_ok
        its_number = 1
        if (present(number)) its_number = number
        call need_basis(self, status, e)
        call check_count(view(n=room), self%n_points, status, e)
        if (function < 1 .or. function > self%n_functions) call refuse(status, e, "there is no function of this number")
        if (its_number < 1 .or. its_number > self%n_numbers) call refuse(status, e, &
            "values have no number of this number")
        if (status == hm_ok) then
            allocate(values(self%n_points))
            status = hm_c_basis_values(self%handle, int(function - 1, c_int32_t), int(its_number - 1, c_int32_t), &
                c_loc(values), e)
            if (status < 0) deallocate(values)
        end if
        call finish(status, e, stat, err)
    end subroutine

    ! values(function, values [, number]): which of the info's numbers_per_value, 1: the only one, real part, or xx.
    subroutine values_v8(self, function, values, number, stat, err)
        class(hm_basis), intent(in) :: self
        integer, intent(in) :: function
        real(c_double), intent(inout) :: values(:)
        integer, intent(in), optional :: number
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        real(c_double), allocatable, target :: all(:)
        call function_values(self, function, number, size(values, kind=c_int64_t), all, stat, err)
        if (allocated(all)) values = all
    end subroutine

    subroutine values_v4(self, function, values, number, stat, err)
        class(hm_basis), intent(in) :: self
        integer, intent(in) :: function
        real(c_float), intent(inout) :: values(:)
        integer, intent(in), optional :: number
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        real(c_double), allocatable, target :: all(:)
        call function_values(self, function, number, size(values, kind=c_int64_t), all, stat, err)
        if (allocated(all)) values = real(all, c_float)
    end subroutine

    subroutine values_b8(self, function, values, number, stat, err)
        class(hm_basis), intent(in) :: self
        integer, intent(in) :: function
        real(c_double), intent(inout) :: values(:, :)
        integer, intent(in), optional :: number
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        real(c_double), allocatable, target :: all(:)
        call function_values(self, function, number, size(values, kind=c_int64_t), all, stat, err)
        if (allocated(all)) values = reshape(all, shape(values))
    end subroutine

    subroutine values_b4(self, function, values, number, stat, err)
        class(hm_basis), intent(in) :: self
        integer, intent(in) :: function
        real(c_float), intent(inout) :: values(:, :)
        integer, intent(in), optional :: number
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        real(c_double), allocatable, target :: all(:)
        call function_values(self, function, number, size(values, kind=c_int64_t), all, stat, err)
        if (allocated(all)) values = real(reshape(all, shape(values)), c_float)
    end subroutine

    ! to = from + sum_i F_i move_i; from empty: 0.
    subroutine move_points(self, move, from, to, executor, stat, err)
        class(hm_basis), intent(in) :: self
        real(c_double), intent(in) :: move(:, :)
        type(view), intent(in) :: from, to
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        type(c_threads), target :: threads
        integer(c_int32_t) :: status
        status = hm_ok
        call need_basis(self, status, e)
        call check_pairs_of_control(self, move, status, e)
        if (c_associated(from%x) .or. from%wrong /= "") call check_count(from, self%n_points, status, e)
        call check_count(to, self%n_points, status, e)
        if (status == hm_ok) status = hm_c_morph(self%handle, move, from%x, from%y, from%stride, to%x, to%y, &
            to%stride, c_executor_of(executor, threads), e)
        call finish(status, e, stat, err)
    end subroutine

    ! morph(move, x, y), in place.
    subroutine morph_v8(self, move, x, y, executor, stat, err)
        class(hm_basis), intent(in) :: self
        real(c_double), intent(in) :: move(:, :)
        real(c_double), intent(inout), target :: x(:), y(:)
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(view) :: v
        v = view_of(x, y)
        call move_points(self, as_double(move), v, v, executor, stat, err)
    end subroutine

    subroutine morph_v4(self, move, x, y, executor, stat, err)
        class(hm_basis), intent(in) :: self
        real(c_float), intent(in) :: move(:, :)
        real(c_float), intent(inout), target :: x(:), y(:)
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(view) :: v
        v = view_of(x, y)
        call move_points(self, as_double(move), v, v, executor, stat, err)
        call put_back(v, x, y)
    end subroutine

    subroutine morph_b8(self, move, x, y, executor, stat, err)
        class(hm_basis), intent(in) :: self
        real(c_double), intent(in) :: move(:, :)
        real(c_double), intent(inout), target :: x(:, :), y(:, :)
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(view) :: v
        v = view_of(x, y)
        call move_points(self, as_double(move), v, v, executor, stat, err)
        call put_back(v, x, y)
    end subroutine

    subroutine morph_b4(self, move, x, y, executor, stat, err)
        class(hm_basis), intent(in) :: self
        real(c_float), intent(in) :: move(:, :)
        real(c_float), intent(inout), target :: x(:, :), y(:, :)
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(view) :: v
        v = view_of(x, y)
        call move_points(self, as_double(move), v, v, executor, stat, err)
        call put_back(v, x, y)
    end subroutine

    ! morph_to(move, x, y, x_new, y_new); the arrays must not overlap.
    subroutine morph_to_v8(self, move, x, y, x_new, y_new, executor, stat, err)
        class(hm_basis), intent(in) :: self
        real(c_double), intent(in) :: move(:, :)
        real(c_double), intent(in), target :: x(:), y(:)
        real(c_double), intent(inout), target :: x_new(:), y_new(:)
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(view) :: from, to
        from = view_of(x, y)
        to = view_of(x_new, y_new)
        call move_points(self, as_double(move), from, to, executor, stat, err)
    end subroutine

    subroutine morph_to_v4(self, move, x, y, x_new, y_new, executor, stat, err)
        class(hm_basis), intent(in) :: self
        real(c_float), intent(in) :: move(:, :)
        real(c_float), intent(in), target :: x(:), y(:)
        real(c_float), intent(inout), target :: x_new(:), y_new(:)
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(view) :: from, to
        from = view_of(x, y)
        to = view_of(x_new, y_new)
        call move_points(self, as_double(move), from, to, executor, stat, err)
        call drop(from)
        call put_back(to, x_new, y_new)
    end subroutine

    subroutine morph_to_b8(self, move, x, y, x_new, y_new, executor, stat, err)
        class(hm_basis), intent(in) :: self
        real(c_double), intent(in) :: move(:, :)
        real(c_double), intent(in), target :: x(:, :), y(:, :)
        real(c_double), intent(inout), target :: x_new(:, :), y_new(:, :)
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(view) :: from, to
        from = view_of(x, y)
        to = view_of(x_new, y_new)
        call move_points(self, as_double(move), from, to, executor, stat, err)
        call drop(from)
        call put_back(to, x_new, y_new)
    end subroutine

    subroutine morph_to_b4(self, move, x, y, x_new, y_new, executor, stat, err)
        class(hm_basis), intent(in) :: self
        real(c_float), intent(in) :: move(:, :)
        real(c_float), intent(in), target :: x(:, :), y(:, :)
        real(c_float), intent(inout), target :: x_new(:, :), y_new(:, :)
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(view) :: from, to
        from = view_of(x, y)
        to = view_of(x_new, y_new)
        call move_points(self, as_double(move), from, to, executor, stat, err)
        call drop(from)
        call put_back(to, x_new, y_new)
    end subroutine

    ! displacement(move, dx, dy): F move alone. As velocity: the mesh points' velocities from the control points'.
    subroutine displacement_v8(self, move, dx, dy, executor, stat, err)
        class(hm_basis), intent(in) :: self
        real(c_double), intent(in) :: move(:, :)
        real(c_double), intent(inout), target :: dx(:), dy(:)
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(view) :: v
        v = view_of(dx, dy)
        call move_points(self, as_double(move), view(), v, executor, stat, err)
    end subroutine

    subroutine displacement_v4(self, move, dx, dy, executor, stat, err)
        class(hm_basis), intent(in) :: self
        real(c_float), intent(in) :: move(:, :)
        real(c_float), intent(inout), target :: dx(:), dy(:)
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(view) :: v
        v = view_of(dx, dy)
        call move_points(self, as_double(move), view(), v, executor, stat, err)
        call put_back(v, dx, dy)
    end subroutine

    subroutine displacement_b8(self, move, dx, dy, executor, stat, err)
        class(hm_basis), intent(in) :: self
        real(c_double), intent(in) :: move(:, :)
        real(c_double), intent(inout), target :: dx(:, :), dy(:, :)
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(view) :: v
        v = view_of(dx, dy)
        call move_points(self, as_double(move), view(), v, executor, stat, err)
        call put_back(v, dx, dy)
    end subroutine

    subroutine displacement_b4(self, move, dx, dy, executor, stat, err)
        class(hm_basis), intent(in) :: self
        real(c_float), intent(in) :: move(:, :)
        real(c_float), intent(inout), target :: dx(:, :), dy(:, :)
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(view) :: v
        v = view_of(dx, dy)
        call move_points(self, as_double(move), view(), v, executor, stat, err)
        call put_back(v, dx, dy)
    end subroutine

    ! The transpose: the gradient by the control points from the one by the mesh points.
    subroutine pull_back(self, v, gradient, executor, stat, err)
        class(hm_basis), intent(in) :: self
        type(view), intent(in) :: v
        real(c_double), intent(inout) :: gradient(:, :)
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        type(c_threads), target :: threads
        integer(c_int32_t) :: status
        status = hm_ok
        call need_basis(self, status, e)
        call check_pairs_of_control(self, gradient, status, e)
        call check_count(v, self%n_points, status, e)
        if (status == hm_ok) status = hm_c_adjoint(self%handle, v%x, v%y, v%stride, gradient, &
            c_executor_of(executor, threads), e)
        call drop(v)
        call finish(status, e, stat, err)
    end subroutine

    ! adjoint(dj_dx, dj_dy, gradient).
    subroutine adjoint_v8(self, dj_dx, dj_dy, gradient, executor, stat, err)
        class(hm_basis), intent(in) :: self
        real(c_double), intent(in), target :: dj_dx(:), dj_dy(:)
        real(c_double), intent(inout) :: gradient(:, :)
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call pull_back(self, view_of(dj_dx, dj_dy), gradient, executor, stat, err)
    end subroutine

    subroutine adjoint_v4(self, dj_dx, dj_dy, gradient, executor, stat, err)
        class(hm_basis), intent(in) :: self
        real(c_float), intent(in), target :: dj_dx(:), dj_dy(:)
        real(c_float), intent(inout) :: gradient(:, :)
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        real(c_double) :: values(size(gradient, 1), size(gradient, 2))
        values = real(gradient, c_double)
        call pull_back(self, view_of(dj_dx, dj_dy), values, executor, stat, err)
        gradient = real(values, c_float)
    end subroutine

    subroutine adjoint_b8(self, dj_dx, dj_dy, gradient, executor, stat, err)
        class(hm_basis), intent(in) :: self
        real(c_double), intent(in), target :: dj_dx(:, :), dj_dy(:, :)
        real(c_double), intent(inout) :: gradient(:, :)
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call pull_back(self, view_of(dj_dx, dj_dy), gradient, executor, stat, err)
    end subroutine

    subroutine adjoint_b4(self, dj_dx, dj_dy, gradient, executor, stat, err)
        class(hm_basis), intent(in) :: self
        real(c_float), intent(in), target :: dj_dx(:, :), dj_dy(:, :)
        real(c_float), intent(inout) :: gradient(:, :)
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        real(c_double) :: values(size(gradient, 1), size(gradient, 2))
        values = real(gradient, c_double)
        call pull_back(self, view_of(dj_dx, dj_dy), values, executor, stat, err)
        gradient = real(values, c_float)
    end subroutine

    subroutine measure_boundary(self, move, from, to, error, point, stat, err)
        class(hm_basis), intent(in) :: self
        real(c_double), intent(in) :: move(:, :)
        type(view), intent(in) :: from, to
        real(c_double), intent(inout) :: error
        integer, intent(out), optional :: point
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        integer(c_int32_t) :: status, its
        status = hm_ok
        its = -1
        call need_basis(self, status, e)
        call check_pairs_of_control(self, move, status, e)
        call check_count(from, self%n_points, status, e)
        call check_count(to, self%n_points, status, e)
        if (status == hm_ok) status = hm_c_boundary_error(self%handle, move, from%x, from%y, from%stride, to%x, to%y, &
            to%stride, error, its, e)
        if (present(point)) point = int(its)
        call drop(from)
        call drop(to)
        call finish(status, e, stat, err)
    end subroutine

    ! boundary_error(move, x, y, x_new, y_new, error [, point]).
    subroutine boundary_error_v8(self, move, x, y, x_new, y_new, error, point, stat, err)
        class(hm_basis), intent(in) :: self
        real(c_double), intent(in) :: move(:, :)
        real(c_double), intent(in), target :: x(:), y(:), x_new(:), y_new(:)
        real(c_double), intent(inout) :: error
        integer, intent(out), optional :: point
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call measure_boundary(self, as_double(move), view_of(x, y), view_of(x_new, y_new), error, point, stat, err)
    end subroutine

    subroutine boundary_error_v4(self, move, x, y, x_new, y_new, error, point, stat, err)
        class(hm_basis), intent(in) :: self
        real(c_float), intent(in) :: move(:, :)
        real(c_float), intent(in), target :: x(:), y(:), x_new(:), y_new(:)
        real(c_double), intent(inout) :: error
        integer, intent(out), optional :: point
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call measure_boundary(self, as_double(move), view_of(x, y), view_of(x_new, y_new), error, point, stat, err)
    end subroutine

    subroutine boundary_error_b8(self, move, x, y, x_new, y_new, error, point, stat, err)
        class(hm_basis), intent(in) :: self
        real(c_double), intent(in) :: move(:, :)
        real(c_double), intent(in), target :: x(:, :), y(:, :), x_new(:, :), y_new(:, :)
        real(c_double), intent(inout) :: error
        integer, intent(out), optional :: point
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call measure_boundary(self, as_double(move), view_of(x, y), view_of(x_new, y_new), error, point, stat, err)
    end subroutine

    subroutine boundary_error_b4(self, move, x, y, x_new, y_new, error, point, stat, err)
        class(hm_basis), intent(in) :: self
        real(c_float), intent(in) :: move(:, :)
        real(c_float), intent(in), target :: x(:, :), y(:, :), x_new(:, :), y_new(:, :)
        real(c_double), intent(inout) :: error
        integer, intent(out), optional :: point
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call measure_boundary(self, as_double(move), view_of(x, y), view_of(x_new, y_new), error, point, stat, err)
    end subroutine

    subroutine limit_step(self, mesh, v, report, executor, stat, err)
        class(hm_basis), intent(in) :: self
        type(hm_mesh), intent(in) :: mesh
        type(view), intent(in) :: v
        type(hm_step_report), intent(inout) :: report
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        type(c_threads), target :: threads
        integer(c_int32_t) :: status
        status = hm_ok
        call need_basis(self, status, e)
        call check_count(v, self%n_points, status, e)
        report%struct_size = int(c_sizeof(report), c_int64_t)
        if (status == hm_ok) status = hm_c_admissible_step(self%handle, c_mesh_of(mesh), v%x, v%y, v%stride, &
            c_executor_of(executor, threads), report, e)
        call drop(v)
        call finish(status, e, stat, err)
    end subroutine

    ! admissible_step(mesh, dx, dy, report); the start is where the mesh is.
    subroutine admissible_step_v8(self, mesh, dx, dy, report, executor, stat, err)
        class(hm_basis), intent(in) :: self
        type(hm_mesh), intent(in) :: mesh
        real(c_double), intent(in), target :: dx(:), dy(:)
        type(hm_step_report), intent(inout) :: report
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call limit_step(self, mesh, view_of(dx, dy), report, executor, stat, err)
    end subroutine

    subroutine admissible_step_v4(self, mesh, dx, dy, report, executor, stat, err)
        class(hm_basis), intent(in) :: self
        type(hm_mesh), intent(in) :: mesh
        real(c_float), intent(in), target :: dx(:), dy(:)
        type(hm_step_report), intent(inout) :: report
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call limit_step(self, mesh, view_of(dx, dy), report, executor, stat, err)
    end subroutine

    subroutine admissible_step_b8(self, mesh, dx, dy, report, executor, stat, err)
        class(hm_basis), intent(in) :: self
        type(hm_mesh), intent(in) :: mesh
        real(c_double), intent(in), target :: dx(:, :), dy(:, :)
        type(hm_step_report), intent(inout) :: report
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call limit_step(self, mesh, view_of(dx, dy), report, executor, stat, err)
    end subroutine

    subroutine admissible_step_b4(self, mesh, dx, dy, report, executor, stat, err)
        class(hm_basis), intent(in) :: self
        type(hm_mesh), intent(in) :: mesh
        real(c_float), intent(in), target :: dx(:, :), dy(:, :)
        type(hm_step_report), intent(inout) :: report
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call limit_step(self, mesh, view_of(dx, dy), report, executor, stat, err)
    end subroutine

    subroutine measure_quality(self, mesh, v, ref, report, executor, stat, err)
        class(hm_basis), intent(in) :: self
        type(hm_mesh), intent(in) :: mesh
        type(view), intent(in) :: v, ref
        type(hm_quality_report), intent(inout) :: report
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        type(c_threads), target :: threads
        integer(c_int32_t) :: status
        status = hm_ok
        call need_basis(self, status, e)
        call check_count(v, self%n_points, status, e)
        if (c_associated(ref%x) .or. ref%wrong /= "") call check_count(ref, self%n_points, status, e)
        report%struct_size = int(c_sizeof(report), c_int64_t)
        if (status == hm_ok) status = hm_c_quality(self%handle, c_mesh_of(mesh), v%x, v%y, v%stride, ref%x, ref%y, &
            ref%stride, c_executor_of(executor, threads), report, e)
        call drop(v)
        call drop(ref)
        call finish(status, e, stat, err)
    end subroutine

    ! quality(mesh, x, y, report [, x_ref, y_ref]).
    subroutine quality_v8(self, mesh, x, y, report, x_ref, y_ref, executor, stat, err)
        class(hm_basis), intent(in) :: self
        type(hm_mesh), intent(in) :: mesh
        real(c_double), intent(in), target :: x(:), y(:)
        type(hm_quality_report), intent(inout) :: report
        real(c_double), intent(in), target, optional :: x_ref(:), y_ref(:)
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(view) :: ref
        if (present(x_ref) .and. present(y_ref)) ref = view_of(x_ref, y_ref)
        call measure_quality(self, mesh, view_of(x, y), ref, report, executor, stat, err)
    end subroutine

    subroutine quality_v4(self, mesh, x, y, report, x_ref, y_ref, executor, stat, err)
        class(hm_basis), intent(in) :: self
        type(hm_mesh), intent(in) :: mesh
        real(c_float), intent(in), target :: x(:), y(:)
        type(hm_quality_report), intent(inout) :: report
        real(c_float), intent(in), target, optional :: x_ref(:), y_ref(:)
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(view) :: ref
        if (present(x_ref) .and. present(y_ref)) ref = view_of(x_ref, y_ref)
        call measure_quality(self, mesh, view_of(x, y), ref, report, executor, stat, err)
    end subroutine

    subroutine quality_b8(self, mesh, x, y, report, x_ref, y_ref, executor, stat, err)
        class(hm_basis), intent(in) :: self
        type(hm_mesh), intent(in) :: mesh
        real(c_double), intent(in), target :: x(:, :), y(:, :)
        type(hm_quality_report), intent(inout) :: report
        real(c_double), intent(in), target, optional :: x_ref(:, :), y_ref(:, :)
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(view) :: ref
        if (present(x_ref) .and. present(y_ref)) ref = view_of(x_ref, y_ref)
        call measure_quality(self, mesh, view_of(x, y), ref, report, executor, stat, err)
    end subroutine

    subroutine quality_b4(self, mesh, x, y, report, x_ref, y_ref, executor, stat, err)
        class(hm_basis), intent(in) :: self
        type(hm_mesh), intent(in) :: mesh
        real(c_float), intent(in), target :: x(:, :), y(:, :)
        type(hm_quality_report), intent(inout) :: report
        real(c_float), intent(in), target, optional :: x_ref(:, :), y_ref(:, :)
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(view) :: ref
        if (present(x_ref) .and. present(y_ref)) ref = view_of(x_ref, y_ref)
        call measure_quality(self, mesh, view_of(x, y), ref, report, executor, stat, err)
    end subroutine

    subroutine judge(self, mesh, v, step, quality, executor, stat, err)
        class(hm_basis), intent(in) :: self
        type(hm_mesh), intent(in) :: mesh
        type(view), intent(in) :: v
        type(hm_step_report), intent(inout) :: step
        type(hm_quality_report), intent(inout) :: quality
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        type(c_threads), target :: threads
        integer(c_int32_t) :: status
        status = hm_ok
        call need_basis(self, status, e)
        call check_count(v, self%n_points, status, e)
        step%struct_size = int(c_sizeof(step), c_int64_t)
        quality%struct_size = int(c_sizeof(quality), c_int64_t)
        if (status == hm_ok) status = hm_c_assess(self%handle, c_mesh_of(mesh), v%x, v%y, v%stride, &
            c_executor_of(executor, threads), step, quality, e)
        call drop(v)
        call finish(status, e, stat, err)
    end subroutine

    ! assess(mesh, dx, dy, step, quality): both in one pass, the quality where dx, dy lead, before anything moves.
    subroutine assess_v8(self, mesh, dx, dy, step, quality, executor, stat, err)
        class(hm_basis), intent(in) :: self
        type(hm_mesh), intent(in) :: mesh
        real(c_double), intent(in), target :: dx(:), dy(:)
        type(hm_step_report), intent(inout) :: step
        type(hm_quality_report), intent(inout) :: quality
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call judge(self, mesh, view_of(dx, dy), step, quality, executor, stat, err)
    end subroutine

    subroutine assess_v4(self, mesh, dx, dy, step, quality, executor, stat, err)
        class(hm_basis), intent(in) :: self
        type(hm_mesh), intent(in) :: mesh
        real(c_float), intent(in), target :: dx(:), dy(:)
        type(hm_step_report), intent(inout) :: step
        type(hm_quality_report), intent(inout) :: quality
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call judge(self, mesh, view_of(dx, dy), step, quality, executor, stat, err)
    end subroutine

    subroutine assess_b8(self, mesh, dx, dy, step, quality, executor, stat, err)
        class(hm_basis), intent(in) :: self
        type(hm_mesh), intent(in) :: mesh
        real(c_double), intent(in), target :: dx(:, :), dy(:, :)
        type(hm_step_report), intent(inout) :: step
        type(hm_quality_report), intent(inout) :: quality
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call judge(self, mesh, view_of(dx, dy), step, quality, executor, stat, err)
    end subroutine

    subroutine assess_b4(self, mesh, dx, dy, step, quality, executor, stat, err)
        class(hm_basis), intent(in) :: self
        type(hm_mesh), intent(in) :: mesh
        real(c_float), intent(in), target :: dx(:, :), dy(:, :)
        type(hm_step_report), intent(inout) :: step
        type(hm_quality_report), intent(inout) :: quality
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call judge(self, mesh, view_of(dx, dy), step, quality, executor, stat, err)
    end subroutine

    ! ==== Meshes in parts: several processes, see harmorph.h ==========================================================

    ! 8-byte numbers of work for an extract of n points, of a parcel of n points; 0 of a basis that is not solved.
    integer(c_int64_t) function basis_extract_words(self, n)
        class(hm_basis), intent(in) :: self
        integer, intent(in) :: n
        type(hm_c_error) :: e
        integer(c_size_t) :: bytes
        basis_extract_words = 0
        if (hm_c_extract_size(self%handle, int(n, c_int32_t), bytes, e) >= 0) basis_extract_words = words_of(bytes)
    end function

    integer(c_int64_t) function basis_parcel_words(self, n)
        class(hm_basis), intent(in) :: self
        integer, intent(in) :: n
        type(hm_c_error) :: e
        basis_parcel_words = 0
        if (hm_c_parcel_size(self%handle, int(n, c_int32_t), basis_parcel_words, e) < 0) basis_parcel_words = 0
    end function

    ! The rows of some points: a basis for the part of the mesh that a process has, in the order of the list.
    subroutine basis_extract(self, points, rows, work, stat, err)
        class(hm_basis), intent(in) :: self
        integer, intent(in) :: points(:)
        type(hm_basis), intent(inout) :: rows
        real(c_double), intent(inout), target, optional :: work(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        integer(c_int32_t) :: status, n
        integer(c_size_t) :: bytes
        call rows%free()
        status = hm_ok
        n = int(size(points), c_int32_t)
        call need_basis(self, status, e)
        if (status == hm_ok) status = hm_c_extract_size(self%handle, n, bytes, e)
        call take(rows%memory, bytes, work, status, e)
        if (status == hm_ok) status = hm_c_extract_init(rows%handle, rows%memory%start, rows%memory%bytes, &
            self%handle, n, int(points, c_int32_t), e)
        call know_basis(rows, status)
        call finish(status, e, stat, err)
    end subroutine

    ! The values of a share at some points, for another process: parcel(parcel_words(n)).
    subroutine basis_pack(self, points, parcel, stat, err)
        class(hm_basis), intent(in) :: self
        integer, intent(in) :: points(:)
        real(c_double), intent(inout) :: parcel(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        integer(c_int32_t) :: status
        status = hm_ok
        call need_basis(self, status, e)
        if (size(parcel, kind=c_int64_t) < self%parcel_words(size(points))) call refuse(status, e, &
            "parcel is too short")
        if (status == hm_ok) status = hm_c_parcel_pack(self%handle, int(size(points), c_int32_t), int(points, &
            c_int32_t), parcel, e)
        call finish(status, e, stat, err)
    end subroutine

    ! The parcels of all shares, in the order of their functions, make the extract of a share a basis.
    subroutine basis_unpack(self, parcel, stat, err)
        class(hm_basis), intent(inout) :: self
        real(c_double), intent(in) :: parcel(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        integer(c_int32_t) :: status
        status = hm_ok
        call need_basis(self, status, e)
        if (status == hm_ok) status = hm_c_parcel_unpack(self%handle, parcel, size(parcel, kind=c_int64_t), e)
        call finish(status, e, stat, err)
    end subroutine

    subroutine find_scale(self, v, scale, executor, stat, err)
        class(hm_basis), intent(in) :: self
        type(view), intent(in) :: v
        integer, intent(inout) :: scale
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        type(c_threads), target :: threads
        integer(c_int32_t) :: status, its
        status = hm_ok
        call need_basis(self, status, e)
        call check_count(v, self%n_points, status, e)
        if (status == hm_ok) status = hm_c_adjoint_scale(self%handle, v%x, v%y, v%stride, its, &
            c_executor_of(executor, threads), e)
        if (status >= 0) scale = int(its)
        call drop(v)
        call finish(status, e, stat, err)
    end subroutine

    ! The adjoint in parts. adjoint_scale(dj_dx, dj_dy, scale): take the largest of all parts.
    subroutine adjoint_scale_v8(self, dj_dx, dj_dy, scale, executor, stat, err)
        class(hm_basis), intent(in) :: self
        real(c_double), intent(in), target :: dj_dx(:), dj_dy(:)
        integer, intent(inout) :: scale
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call find_scale(self, view_of(dj_dx, dj_dy), scale, executor, stat, err)
    end subroutine

    subroutine adjoint_scale_v4(self, dj_dx, dj_dy, scale, executor, stat, err)
        class(hm_basis), intent(in) :: self
        real(c_float), intent(in), target :: dj_dx(:), dj_dy(:)
        integer, intent(inout) :: scale
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call find_scale(self, view_of(dj_dx, dj_dy), scale, executor, stat, err)
    end subroutine

    subroutine adjoint_scale_b8(self, dj_dx, dj_dy, scale, executor, stat, err)
        class(hm_basis), intent(in) :: self
        real(c_double), intent(in), target :: dj_dx(:, :), dj_dy(:, :)
        integer, intent(inout) :: scale
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call find_scale(self, view_of(dj_dx, dj_dy), scale, executor, stat, err)
    end subroutine

    subroutine adjoint_scale_b4(self, dj_dx, dj_dy, scale, executor, stat, err)
        class(hm_basis), intent(in) :: self
        real(c_float), intent(in), target :: dj_dx(:, :), dj_dy(:, :)
        integer, intent(inout) :: scale
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call find_scale(self, view_of(dj_dx, dj_dy), scale, executor, stat, err)
    end subroutine

    subroutine sum_up(self, v, scale, sums, executor, stat, err)
        class(hm_basis), intent(in) :: self
        type(view), intent(in) :: v
        integer, intent(in) :: scale
        integer(c_int64_t), intent(inout) :: sums(:)
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        type(c_threads), target :: threads
        integer(c_int32_t) :: status
        status = hm_ok
        call need_basis(self, status, e)
        call check_count(v, self%n_points, status, e)
        call check_sums(self, sums, status, e)
        if (status == hm_ok) status = hm_c_adjoint_sums(self%handle, v%x, v%y, v%stride, int(scale, c_int32_t), sums, &
            c_executor_of(executor, threads), e)
        call drop(v)
        call finish(status, e, stat, err)
    end subroutine

    subroutine check_sums(self, sums, status, e)
        class(hm_basis), intent(in) :: self
        integer(c_int64_t), intent(in) :: sums(:)
        integer(c_int32_t), intent(inout) :: status
        type(hm_c_error), intent(inout) :: e
        character(len=112) :: text
        if (size(sums, kind=c_int64_t) == 4 * self%n_functions * self%n_numbers) return
        write(text, "(a, i0, a)") "sums must be (", 4 * self%n_functions * self%n_numbers, ")"
        call refuse(status, e, text)
    end subroutine

    ! adjoint_sums(dj_dx, dj_dy, scale, sums): add those of all parts. sums(4 * functions * numbers_per_value).
    subroutine adjoint_sums_v8(self, dj_dx, dj_dy, scale, sums, executor, stat, err)
        class(hm_basis), intent(in) :: self
        real(c_double), intent(in), target :: dj_dx(:), dj_dy(:)
        integer, intent(in) :: scale
        integer(c_int64_t), intent(inout) :: sums(:)
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call sum_up(self, view_of(dj_dx, dj_dy), scale, sums, executor, stat, err)
    end subroutine

    subroutine adjoint_sums_v4(self, dj_dx, dj_dy, scale, sums, executor, stat, err)
        class(hm_basis), intent(in) :: self
        real(c_float), intent(in), target :: dj_dx(:), dj_dy(:)
        integer, intent(in) :: scale
        integer(c_int64_t), intent(inout) :: sums(:)
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call sum_up(self, view_of(dj_dx, dj_dy), scale, sums, executor, stat, err)
    end subroutine

    subroutine adjoint_sums_b8(self, dj_dx, dj_dy, scale, sums, executor, stat, err)
        class(hm_basis), intent(in) :: self
        real(c_double), intent(in), target :: dj_dx(:, :), dj_dy(:, :)
        integer, intent(in) :: scale
        integer(c_int64_t), intent(inout) :: sums(:)
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call sum_up(self, view_of(dj_dx, dj_dy), scale, sums, executor, stat, err)
    end subroutine

    subroutine adjoint_sums_b4(self, dj_dx, dj_dy, scale, sums, executor, stat, err)
        class(hm_basis), intent(in) :: self
        real(c_float), intent(in), target :: dj_dx(:, :), dj_dy(:, :)
        integer, intent(in) :: scale
        integer(c_int64_t), intent(inout) :: sums(:)
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call sum_up(self, view_of(dj_dx, dj_dy), scale, sums, executor, stat, err)
    end subroutine

    ! The gradient by the control points, of all parts' sums.
    subroutine adjoint_finish_8(self, scale, sums, gradient, stat, err)
        class(hm_basis), intent(in) :: self
        integer, intent(in) :: scale
        integer(c_int64_t), intent(in) :: sums(:)
        real(c_double), intent(inout) :: gradient(:, :)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(hm_c_error) :: e
        integer(c_int32_t) :: status
        status = hm_ok
        call need_basis(self, status, e)
        call check_sums(self, sums, status, e)
        call check_pairs_of_control(self, gradient, status, e)
        if (status == hm_ok) status = hm_c_adjoint_finish(self%handle, int(scale, c_int32_t), sums, gradient, e)
        call finish(status, e, stat, err)
    end subroutine

    subroutine adjoint_finish_4(self, scale, sums, gradient, stat, err)
        class(hm_basis), intent(in) :: self
        integer, intent(in) :: scale
        integer(c_int64_t), intent(in) :: sums(:)
        real(c_float), intent(inout) :: gradient(:, :)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        real(c_double) :: values(size(gradient, 1), size(gradient, 2))
        values = real(gradient, c_double)
        call adjoint_finish_8(self, scale, sums, values, stat, err)
        gradient = real(values, c_float)
    end subroutine

end module
