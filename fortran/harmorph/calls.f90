
! ---- The functions of harmorph.h -------------------------------------------------------------------------------------

    public :: hm_c_abi_version, hm_c_version, hm_c_status_name, hm_c_curves_check, hm_c_curve_basis, &
        hm_c_curve_point, hm_c_curve_project, hm_c_refine_size, hm_c_refine, hm_c_elevate_size, hm_c_elevate, &
        hm_c_measure, hm_c_variables_size, hm_c_variables_map, hm_c_combine_size, hm_c_combine, &
        hm_c_tabulate_size, hm_c_tabulate, &
        hm_c_fit_size, hm_c_fit, hm_c_analysis_size, hm_c_analysis_init, &
        hm_c_analysis_report, hm_c_analysis_boundary, hm_c_plan_size, hm_c_plan_init, hm_c_basis_size, &
        hm_c_basis_init, hm_c_plan_factor, hm_c_plan_solve, hm_c_plan_level, hm_c_basis_attach, &
        hm_c_basis_info_get, hm_c_basis_curves, hm_c_moved_curves, hm_c_basis_conditions, hm_c_basis_values, hm_c_single_size, &
        hm_c_single_init, hm_c_transfer_size, hm_c_transfer, hm_c_morph, hm_c_adjoint, hm_c_boundary_error, &
        hm_c_extract_size, hm_c_extract_init, hm_c_share_of, hm_c_share_size, hm_c_share_init, &
        hm_c_parcel_size, hm_c_parcel_pack, hm_c_parcel_unpack, hm_c_adjoint_scale, hm_c_adjoint_sums, &
        hm_c_adjoint_finish, hm_c_admissible_step, hm_c_quality, hm_c_assess, hm_c_morph_safe_size, &
        hm_c_morph_safe, hm_c_given_points, hm_c_displace_size, hm_c_displace, hm_c_displace_adjoint, &
        hm_c_plane_size, hm_c_plane_init, hm_c_plane_info_get, hm_c_plane_mesh, hm_c_plane_morph, &
        hm_c_plane_adjoint, hm_c_plane_spread, hm_c_plane_gather, hm_c_improve_size, hm_c_improve

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
            integer(c_int32_t), value, intent(in) :: curve, n_derivatives
            real(c_double), value, intent(in) :: u
            integer(c_int32_t), intent(inout) :: control(*)
            real(c_double), intent(inout) :: values(*)
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_curve_point(curves, curve, u, n_derivatives, xy, err) &
            bind(c, name="hm_curve_point")
            import
            type(hm_c_curves), intent(in) :: curves
            integer(c_int32_t), value, intent(in) :: curve, n_derivatives
            real(c_double), value, intent(in) :: u
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
        integer(c_int32_t) function hm_c_refine_size(curves, curve, n, u, bytes, err) bind(c, name="hm_refine_size")
            import
            type(hm_c_curves), intent(in) :: curves
            integer(c_int32_t), value, intent(in) :: curve, n
            real(c_double), intent(in) :: u(*)
            integer(c_size_t), intent(inout) :: bytes
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_refine(finer, matrix, block, bytes, curves, curve, n, u, err) &
            bind(c, name="hm_refine")
            import
            type(c_ptr), intent(inout) :: finer, matrix
            type(c_ptr), value, intent(in) :: block
            integer(c_size_t), value, intent(in) :: bytes
            type(hm_c_curves), intent(in) :: curves
            integer(c_int32_t), value, intent(in) :: curve, n
            real(c_double), intent(in) :: u(*)
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_elevate_size(curves, curve, bytes, err) bind(c, name="hm_elevate_size")
            import
            type(hm_c_curves), intent(in) :: curves
            integer(c_int32_t), value, intent(in) :: curve
            integer(c_size_t), intent(inout) :: bytes
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_elevate(finer, matrix, block, bytes, curves, curve, err) &
            bind(c, name="hm_elevate")
            import
            type(c_ptr), intent(inout) :: finer, matrix
            type(c_ptr), value, intent(in) :: block
            integer(c_size_t), value, intent(in) :: bytes
            type(hm_c_curves), intent(in) :: curves
            integer(c_int32_t), value, intent(in) :: curve
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_measure(curves, section, n, quantities, values, at, gradients, err) &
            bind(c, name="hm_measure")
            import
            type(hm_c_curves), intent(in) :: curves
            type(hm_c_section), intent(in) :: section
            integer(c_int32_t), value, intent(in) :: n
            type(hm_c_quantity), intent(in) :: quantities(*)
            real(c_double), intent(inout) :: values(*)
            type(c_ptr), value, intent(in) :: at, gradients
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_variables_size(curves, section, variables, n, bytes, err) &
            bind(c, name="hm_variables_size")
            import
            type(hm_c_curves), intent(in) :: curves
            type(hm_c_section), intent(in) :: section
            type(hm_c_variables), intent(in) :: variables
            integer(c_int32_t), intent(inout) :: n
            integer(c_size_t), intent(inout) :: bytes
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_variables_map(curves, section, variables, work, bytes, matrix, error, err) &
            bind(c, name="hm_variables_map")
            import
            type(hm_c_curves), intent(in) :: curves
            type(hm_c_section), intent(in) :: section
            type(hm_c_variables), intent(in) :: variables
            type(c_ptr), value, intent(in) :: work
            integer(c_size_t), value, intent(in) :: bytes
            real(c_double), intent(inout) :: matrix(*), error(*)
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_tabulate_size(plan, basis, n_modes, numbers, bytes, work_bytes, err) &
            bind(c, name="hm_tabulate_size")
            import
            type(c_ptr), value, intent(in) :: plan, basis
            integer(c_int32_t), value, intent(in) :: n_modes, numbers
            integer(c_size_t), intent(inout) :: bytes, work_bytes
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_tabulate(tabulated, block, bytes, plan, basis, n, points, n_modes, numbers, modes, &
            work, work_bytes, report, err) bind(c, name="hm_tabulate")
            import
            type(c_ptr), intent(inout) :: tabulated
            type(c_ptr), value, intent(in) :: block, plan, basis, points, work
            integer(c_size_t), value, intent(in) :: bytes, work_bytes
            integer(c_int32_t), value, intent(in) :: n, n_modes, numbers
            real(c_double), intent(in) :: modes(*)
            type(hm_solve_report), intent(inout) :: report
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_combine_size(basis, n, numbers, bytes, err) bind(c, name="hm_combine_size")
            import
            type(c_ptr), value, intent(in) :: basis
            integer(c_int32_t), value, intent(in) :: n, numbers
            integer(c_size_t), intent(inout) :: bytes
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_combine(combined, block, bytes, basis, n, numbers, matrix, err) &
            bind(c, name="hm_combine")
            import
            type(c_ptr), intent(inout) :: combined
            type(c_ptr), value, intent(in) :: block, basis
            integer(c_size_t), value, intent(in) :: bytes
            integer(c_int32_t), value, intent(in) :: n, numbers
            real(c_double), intent(in) :: matrix(*)
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_fit_size(n, options, bytes, err) bind(c, name="hm_fit_size")
            import
            integer(c_int32_t), value, intent(in) :: n
            type(hm_c_fit_options), intent(in) :: options
            integer(c_size_t), intent(inout) :: bytes
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_fit(curves, block, bytes, points, n, is_loop, options, report, err) &
            bind(c, name="hm_fit")
            import
            type(c_ptr), intent(inout) :: curves
            type(c_ptr), value, intent(in) :: block
            integer(c_size_t), value, intent(in) :: bytes
            type(hm_c_points), intent(in) :: points
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
            type(c_ptr), value, intent(in) :: block, options
            integer(c_size_t), value, intent(in) :: bytes
            type(hm_c_problem), intent(in) :: problem
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_analysis_report(analysis, report, err) bind(c, name="hm_analysis_report")
            import
            type(c_ptr), value, intent(in) :: analysis
            type(hm_mesh_report), intent(inout) :: report
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_analysis_boundary(analysis, n_markers, markers, piece, points, capacity, &
            n, is_loop, err) bind(c, name="hm_analysis_boundary")
            import
            type(c_ptr), value, intent(in) :: analysis
            integer(c_int32_t), value, intent(in) :: n_markers, piece, capacity
            integer(c_int32_t), intent(in) :: markers(*)
            integer(c_int32_t), intent(inout) :: points(*), n, is_loop
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
            type(c_ptr), value, intent(in) :: block, analysis
            integer(c_size_t), value, intent(in) :: bytes
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
            type(c_ptr), value, intent(in) :: block, analysis
            integer(c_size_t), value, intent(in) :: bytes
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_plan_factor(plan, at, err) bind(c, name="hm_plan_factor")
            import
            type(c_ptr), value, intent(in) :: plan, at    ! hm_c_points, or null
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_plan_solve(plan, basis, report, err) bind(c, name="hm_plan_solve")
            import
            type(c_ptr), value, intent(in) :: plan, basis
            type(hm_solve_report), intent(inout) :: report
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_given_points(plan, points, capacity, n, err) bind(c, name="hm_given_points")
            import
            type(c_ptr), value, intent(in) :: plan
            integer(c_int32_t), intent(inout) :: points(*), n
            integer(c_int32_t), value, intent(in) :: capacity
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_displace_size(plan, n_fields, bytes, err) bind(c, name="hm_displace_size")
            import
            type(c_ptr), value, intent(in) :: plan
            integer(c_int32_t), value, intent(in) :: n_fields
            integer(c_size_t), intent(inout) :: bytes
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_displace(plan, n, points, n_fields, wall, from, to, work, bytes, report, err) &
            bind(c, name="hm_displace")
            import
            type(c_ptr), value, intent(in) :: plan, points, from, work    ! points, from: null if there are none
            integer(c_int32_t), value, intent(in) :: n, n_fields
            type(hm_c_points), intent(in) :: wall(*), to(*)
            integer(c_size_t), value, intent(in) :: bytes
            type(hm_solve_report), intent(inout) :: report
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_displace_adjoint(plan, n, points, n_fields, dj, gradient, work, bytes, report, &
            err) bind(c, name="hm_displace_adjoint")
            import
            type(c_ptr), value, intent(in) :: plan, points, work          ! points: null if there are none
            integer(c_int32_t), value, intent(in) :: n, n_fields
            type(hm_c_points), intent(in) :: dj(*), gradient(*)
            integer(c_size_t), value, intent(in) :: bytes
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
            type(c_ptr), value, intent(in) :: block, mesh
            integer(c_size_t), value, intent(in) :: bytes
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
        integer(c_int32_t) function hm_c_moved_curves(basis, move, control, out, curve, capacity, err) &
            bind(c, name="hm_moved_curves")
            import
            type(c_ptr), value, intent(in) :: basis, control     ! control [2*n_control]
            real(c_double), intent(in) :: move(*)
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
            type(c_ptr), value, intent(in) :: basis, values
            integer(c_int32_t), value, intent(in) :: function, number
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
            type(c_ptr), value, intent(in) :: block, basis
            integer(c_size_t), value, intent(in) :: bytes
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
            type(c_ptr), value, intent(in) :: basis, block, analysis, coarse
            integer(c_size_t), value, intent(in) :: bytes
            type(hm_c_mesh), intent(in) :: coarse_mesh
            type(hm_transfer_report), intent(inout) :: report
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_morph(basis, move, from, to, executor, err) bind(c, name="hm_morph")
            import
            type(c_ptr), value, intent(in) :: basis, from, executor    ! from: hm_c_points, or null
            real(c_double), intent(in) :: move(*)
            type(hm_c_points), intent(in) :: to
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_adjoint(basis, dj, gradient, executor, err) bind(c, name="hm_adjoint")
            import
            type(c_ptr), value, intent(in) :: basis, executor
            type(hm_c_points), intent(in) :: dj
            real(c_double), intent(inout) :: gradient(*)
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_boundary_error(basis, move, from, to, error, point, err) &
            bind(c, name="hm_boundary_error")
            import
            type(c_ptr), value, intent(in) :: basis
            real(c_double), intent(in) :: move(*)
            type(hm_c_points), intent(in) :: from, to
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
            type(c_ptr), value, intent(in) :: block, basis
            integer(c_size_t), value, intent(in) :: bytes
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
            type(c_ptr), value, intent(in) :: block, analysis
            integer(c_size_t), value, intent(in) :: bytes
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
        integer(c_int32_t) function hm_c_adjoint_scale(basis, dj, scale, executor, err) &
            bind(c, name="hm_adjoint_scale")
            import
            type(c_ptr), value, intent(in) :: basis, executor
            type(hm_c_points), intent(in) :: dj
            integer(c_int32_t), intent(inout) :: scale
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_adjoint_sums(basis, dj, scale, sums, executor, err) &
            bind(c, name="hm_adjoint_sums")
            import
            type(c_ptr), value, intent(in) :: basis, executor
            type(hm_c_points), intent(in) :: dj
            integer(c_int32_t), value, intent(in) :: scale
            integer(c_int64_t), intent(inout) :: sums(*)
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
        integer(c_int32_t) function hm_c_admissible_step(basis, mesh, from, displacement, executor, report, err) &
            bind(c, name="hm_admissible_step")
            import
            type(c_ptr), value, intent(in) :: basis, from, executor    ! from: hm_c_points, or null
            type(hm_c_mesh), intent(in) :: mesh
            type(hm_c_points), intent(in) :: displacement
            type(hm_step_report), intent(inout) :: report
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_quality(basis, mesh, at, reference, executor, report, err) &
            bind(c, name="hm_quality")
            import
            type(c_ptr), value, intent(in) :: basis, at, reference, executor    ! at, reference: hm_c_points, or null
            type(hm_c_mesh), intent(in) :: mesh
            type(hm_quality_report), intent(inout) :: report
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_assess(basis, mesh, from, displacement, executor, step, quality, err) &
            bind(c, name="hm_assess")
            import
            type(c_ptr), value, intent(in) :: basis, from, executor    ! from: hm_c_points, or null
            type(hm_c_mesh), intent(in) :: mesh
            type(hm_c_points), intent(in) :: displacement
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
        integer(c_int32_t) function hm_c_morph_safe(plan, basis, move, to, derivative, work, bytes, options, report, &
            err) bind(c, name="hm_morph_safe")
            import
            type(c_ptr), value, intent(in) :: plan, basis, derivative, work
            real(c_double), intent(in) :: move(*)
            type(hm_c_points), intent(in) :: to
            integer(c_size_t), value, intent(in) :: bytes
            type(hm_c_safe_options), intent(in) :: options
            type(hm_safe_report), intent(inout) :: report
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_plane_size(space, bytes, err) bind(c, name="hm_plane_size")
            import
            type(hm_c_space_mesh), intent(in) :: space
            integer(c_size_t), intent(inout) :: bytes
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_plane_init(plane, block, bytes, space, err) bind(c, name="hm_plane_init")
            import
            type(c_ptr), intent(inout) :: plane
            type(c_ptr), value, intent(in) :: block
            integer(c_size_t), value, intent(in) :: bytes
            type(hm_c_space_mesh), intent(in) :: space
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_plane_info_get(plane, info, err) bind(c, name="hm_plane_info_get")
            import
            type(c_ptr), value, intent(in) :: plane
            type(hm_c_plane_info), intent(inout) :: info
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_plane_mesh(plane, mesh, err) bind(c, name="hm_plane_mesh")
            import
            type(c_ptr), value, intent(in) :: plane
            type(hm_c_mesh), intent(inout) :: mesh
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_plane_morph(plane, basis, move, from, to, executor, err) &
            bind(c, name="hm_plane_morph")
            import
            type(c_ptr), value, intent(in) :: plane, basis, from, executor
            real(c_double), intent(in) :: move(*)
            type(hm_c_space_points), intent(in) :: to
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_plane_adjoint(plane, basis, dj, gradient, executor, err) &
            bind(c, name="hm_plane_adjoint")
            import
            type(c_ptr), value, intent(in) :: plane, basis, executor
            type(hm_c_space_points), intent(in) :: dj
            real(c_double), intent(inout) :: gradient(*)
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_plane_spread(plane, displacement, from, to, executor, err) &
            bind(c, name="hm_plane_spread")
            import
            type(c_ptr), value, intent(in) :: plane, from, executor
            type(hm_c_points), intent(in) :: displacement
            type(hm_c_space_points), intent(in) :: to
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_plane_gather(plane, dj, plane_dj, executor, err) &
            bind(c, name="hm_plane_gather")
            import
            type(c_ptr), value, intent(in) :: plane, executor
            type(hm_c_space_points), intent(in) :: dj
            type(hm_c_points), intent(in) :: plane_dj
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_improve_size(plan, bytes, err) bind(c, name="hm_improve_size")
            import
            type(c_ptr), value, intent(in) :: plan
            integer(c_size_t), intent(inout) :: bytes
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_improve(plan, from, to, work, bytes, options, report, err) &
            bind(c, name="hm_improve")
            import
            type(c_ptr), value, intent(in) :: plan, work
            type(hm_c_points), intent(in) :: from, to
            integer(c_size_t), value, intent(in) :: bytes
            type(hm_c_improve_options), intent(in) :: options
            type(hm_improve_report), intent(inout) :: report
            type(hm_c_error), intent(inout) :: err
        end function
    end interface
