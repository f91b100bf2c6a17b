
! ---- The structs of harmorph.h; users have the reports as they are, and hm_c_* only where they call C themselves -----

    type, bind(c), public :: hm_c_error
        integer(c_int32_t) :: code = 0, item = -1
        real(c_double) :: value = 0
        character(kind=c_char) :: text(112) = c_null_char
    end type

    type, bind(c), public :: hm_c_executor
        integer(c_int64_t) :: struct_size = 0
        type(c_funptr) :: run = c_null_funptr
        type(c_ptr) :: user = c_null_ptr
        integer(c_int32_t) :: n_threads = 1, kernel = 0
    end type

    type, bind(c), public :: hm_c_points        ! hm_points and hm_points_out
        type(c_ptr) :: x = c_null_ptr, y = c_null_ptr
        integer(c_int64_t) :: stride = 1
    end type

    type, bind(c), public :: hm_c_block_points  ! hm_block_points and hm_block_points_out
        type(c_ptr) :: x = c_null_ptr, y = c_null_ptr
        integer(c_int64_t) :: stride = 1, row = 0
    end type

    type, bind(c), public :: hm_c_mesh
        integer(c_int64_t) :: struct_size = 0
        integer(c_int32_t) :: index_base = 0, n_points = 0
        type(hm_c_points) :: points
        integer(c_int32_t) :: cell_layout = 0, n_cells = 0
        type(c_ptr) :: cell_start = c_null_ptr, cell_points = c_null_ptr
        integer(c_int32_t) :: ni = 0, nj = 0, n_faces = 0
        type(c_ptr) :: face_points = c_null_ptr, face_markers = c_null_ptr
        integer(c_int32_t) :: n_lists = 0
        type(c_ptr) :: list_start = c_null_ptr, list_points = c_null_ptr, list_markers = c_null_ptr
        integer(c_int32_t) :: n_quads = 0
        type(c_ptr) :: quad_points = c_null_ptr
        integer(c_int32_t) :: n_blocks = 0, reserved = 0
        type(c_ptr) :: block_sizes = c_null_ptr, block_markers = c_null_ptr
    end type

    type, bind(c), public :: hm_c_space_points  ! hm_space_points and hm_space_points_out
        type(c_ptr) :: x = c_null_ptr, y = c_null_ptr, z = c_null_ptr
        integer(c_int64_t) :: stride = 1
    end type

    type, bind(c), public :: hm_c_space_mesh
        integer(c_int64_t) :: struct_size = 0
        integer(c_int32_t) :: index_base = 0, n_points = 0
        type(hm_c_space_points) :: points
        integer(c_int32_t) :: kind = 0, n_faces = 0
        type(c_ptr) :: face_start = c_null_ptr, face_points = c_null_ptr
        integer(c_int32_t) :: n_sides = 0
        type(c_ptr) :: side_points = c_null_ptr, side_markers = c_null_ptr
        real(c_double) :: axis_point(3) = 0, axis(3) = 0, tolerance = 0
    end type

    type, bind(c), public :: hm_c_plane_info
        integer(c_int64_t) :: struct_size = 0
        integer(c_int32_t) :: kind = 0, n_points = 0, n_space_points = 0, layers = 0
        real(c_double) :: origin(3) = 0, x_direction(3) = 0, y_direction(3) = 0, normal(3) = 0, max_distance = 0
        integer(c_int32_t) :: max_distance_point = 0, reserved = 0
        type(c_ptr) :: follows = c_null_ptr, space_point = c_null_ptr
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
        integer(c_int32_t) :: degree = 0, n_control = 0, closed = 0, reserved = 0
    end type

    type, bind(c), public :: hm_fit_report
        integer(c_int64_t) :: struct_size = 0
        real(c_double) :: max_error = 0, rms_error = 0
        integer(c_int32_t) :: max_error_point = 0, closed = 0, first_point = 0, base_points = 0
        integer(c_int32_t) :: reason = 0, corners = 0, backtrack_point = 0, reserved = 0
    end type

    type, bind(c), public :: hm_c_section
        integer(c_int64_t) :: struct_size = 0
        integer(c_int32_t) :: first_curve = 0, n_curves = 0
        real(c_double) :: nose_x = 0, nose_y = 0, edge_x = 0, edge_y = 0
    end type

    type, bind(c), public :: hm_c_quantity
        integer(c_int64_t) :: struct_size = 0
        integer(c_int32_t) :: kind = 0, n_polygon = 0
        real(c_double) :: station = 0
        type(c_ptr) :: polygon = c_null_ptr
    end type

    type, bind(c), public :: hm_c_variables
        integer(c_int64_t) :: struct_size = 0
        integer(c_int32_t) :: kind = 0, n_upper = 0, n_lower = 0, degree_x = 0, degree_y = 0
        real(c_double) :: x_min = 0, y_min = 0, x_max = 0, y_max = 0
        type(c_ptr) :: peaks = c_null_ptr
        real(c_double) :: nose_exponent = 0, edge_exponent = 0, width = 0
    end type

    type, bind(c), public :: hm_c_condition
        integer(c_int64_t) :: struct_size = 0
        integer(c_int32_t) :: marker = 0, kind = 0, first_curve = 0, n_curves = 0, body = 0, partner = 0
        real(c_double) :: x = 0, y = 0
        integer(c_int32_t) :: piece = 0, reserved = 0
        real(c_double) :: near_x = 0, near_y = 0
        type(c_ptr) :: along = c_null_ptr
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
        integer(c_int32_t) :: polygons = 0, reserved = 0
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
        integer(c_int32_t) :: combined = 0, control_points = 0, modes = 0, reserved = 0
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
        integer(c_int32_t) :: max_resolves = 0, skipped_strategies = 0, n_others = 0, reserved = 0
        type(c_ptr) :: others = c_null_ptr
        real(c_double) :: heights = 0
        type(c_ptr) :: reached = c_null_ptr
        real(c_double) :: min_quality = 0, max_height_change = 0
    end type

    type, bind(c), public :: hm_worst_cell
        integer(c_int32_t) :: cell = 0, reserved = 0
        real(c_double) :: quality = 0, start_quality = 0, x = 0, y = 0
    end type

    type, bind(c), public :: hm_safe_report
        integer(c_int64_t) :: struct_size = 0
        integer(c_int32_t) :: strategy = 0, other = 0, steps = 0, resolves = 0
        real(c_double) :: step_fraction = 0, admissible = 0
        integer(c_int32_t) :: cell = 0, point = 0, untangled = 0, iterations = 0, crossing_points(4) = 0
        integer(c_int32_t) :: inverted = 0, min_quality_cell = 0
        real(c_double) :: min_quality = 0, mean_quality = 0, mean_angle_change = 0, max_angle_change = 0
        real(c_double) :: mean_height_ratio = 0, min_height_ratio = 0, max_height_ratio = 0, heights = 0
        integer(c_int32_t) :: angle_point = 0, min_height_point = 0, max_height_point = 0, n_worst = 0
        real(c_double) :: turned_offset = 0, start_quality = 0
        type(hm_worst_cell) :: worst(5)
    end type

    type, bind(c), public :: hm_c_improve_options
        integer(c_int64_t) :: struct_size = 0
        integer(c_int32_t) :: max_iterations = 0, reserved = 0
        type(c_ptr) :: reference = c_null_ptr
    end type

    type, bind(c), public :: hm_improve_report
        integer(c_int64_t) :: struct_size = 0
        integer(c_int32_t) :: iterations = 0, movable = 0
        real(c_double) :: min_quality_before = 0, mean_quality_before = 0, min_quality = 0, mean_quality = 0
        integer(c_int32_t) :: min_quality_cell_before = 0, min_quality_cell = 0
    end type
