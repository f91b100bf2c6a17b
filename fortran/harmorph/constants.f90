
! ---- The constants of harmorph.h, by the same names ------------------------------------------------------------------


    character(len=*), parameter, public :: hm_header_version = "0.2.0"
    integer, parameter, public :: hm_abi = 3

    integer, parameter, public :: hm_ok = 0, hm_not_converged = 1, hm_moved = 2, hm_short = 3, &
        hm_backtracks = 4, hm_far_from_curve = 5, hm_poor = 6
    integer, parameter, public :: hm_cancelled = -1, hm_bad_argument = -2, hm_bad_mesh = -3, hm_bad_curve = -4
    integer, parameter, public :: hm_bad_condition = -5, hm_bad_basis = -6, hm_block_too_small = -7, &
        hm_not_positive = -8
    integer, parameter, public :: hm_unsupported = -9, hm_crossing = -10

    integer, parameter, public :: hm_cells_rows = 0, hm_cells_triangles = 1, hm_cells_quads = 2, &
        hm_cells_structured = 3, hm_cells_mixed = 4, hm_cells_blocks = 5, hm_cells_polygons = 6
    integer(c_int32_t), parameter, public :: hm_no_marker = -huge(0_c_int32_t) - 1_c_int32_t
    integer, parameter, public :: hm_space_auto = 0, hm_planes = 1, hm_wedge = 2
    integer, parameter, public :: hm_closed_auto = 0, hm_open = 1, hm_tied = 2, hm_periodic = 3
    integer, parameter, public :: hm_fit_asked = 0, hm_fit_no_loop = 1, hm_fit_no_corner = 2, hm_fit_corner = 3
    integer, parameter, public :: hm_fit_base = 4
    integer, parameter, public :: hm_area = 0, hm_centroid_x = 1, hm_centroid_y = 2, hm_moment_xx = 3, &
        hm_moment_yy = 4, hm_moment_xy = 5, hm_chord = 6, hm_thickness = 7, hm_camber = 8, hm_max_thickness = 9, &
        hm_max_camber = 10, hm_nose_radius = 11, hm_edge_angle = 12, hm_edge_gap = 13, hm_min_radius = 14, &
        hm_curvature_variation = 15, hm_clearance = 16
    integer, parameter, public :: hm_ffd = 0, hm_cst = 1, hm_hicks_henne = 2, hm_naca4 = 3
    integer, parameter, public :: hm_on_curve = 0, hm_rigid = 1, hm_fixed = 2, hm_slip = 3, hm_free = 4
    integer, parameter, public :: hm_periodic_pair = 5, hm_given = 6, hm_rotation_pair = 7
    integer, parameter, public :: hm_conformal = 0, hm_laplace = 1, hm_weighted = 2, hm_no_weight = -1
    integer, parameter, public :: hm_compact = 0, hm_nodal_gradient = 1, hm_bounded = 2, hm_nodal_gradient_plain = 3
    integer, parameter, public :: hm_direct = 0, hm_multigrid = 1, hm_fas = 2
    integer, parameter, public :: hm_agglomerate_auto = 0, hm_agglomerate_isotropic = 1, hm_agglomerate_directional = 2
    integer, parameter, public :: hm_double = 0, hm_single = 1
    integer, parameter, public :: hm_start_coarsest = 0, hm_start_zero = 1
    integer, parameter, public :: hm_kernel_auto = 0, hm_kernel_baseline = 1, hm_kernel_avx2 = 2, &
        hm_kernel_avx512 = 3, hm_kernel_neon = 4
    integer, parameter, public :: hm_phase_structure = 0, hm_phase_ordering = 1, hm_phase_symbolic = 2
    integer, parameter, public :: hm_phase_assembly = 3, hm_phase_factor = 4, hm_phase_solve = 5, hm_phase_residual = 6
    integer, parameter, public :: hm_strategy_linear = 0, hm_strategy_other = 1, hm_strategy_substeps = 2, &
        hm_strategy_untangled = 3, hm_strategy_improved = 4
