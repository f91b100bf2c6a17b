
! ---- The functions of harmorph.h: analyses and plans, and what needs them --------------------------------------------

    public :: hm_c_tabulate_size, hm_c_tabulate, hm_c_analysis_size, hm_c_analysis_init, hm_c_analysis_report, &
        hm_c_analysis_boundary, hm_c_plan_size, hm_c_plan_init, hm_c_basis_size, hm_c_basis_init, hm_c_plan_factor, &
        hm_c_plan_solve, hm_c_plan_points, hm_c_given_points, hm_c_displace_size, hm_c_displace, &
        hm_c_displace_adjoint, hm_c_plan_level, hm_c_displace_safe_size, hm_c_displace_safe, hm_c_transfer_size, &
        hm_c_transfer, hm_c_share_of, hm_c_share_size, hm_c_share_init, hm_c_morph_safe_size, hm_c_morph_safe, &
        hm_c_improve_size, hm_c_improve, hm_c_slide, hm_c_slide_adjoint

    interface
        integer(c_int32_t) function hm_c_tabulate_size(plan, basis, n_modes, numbers, bytes, work_bytes, err) &
            bind(c, name="hm_tabulate_size")
            import
            type(c_ptr), value, intent(in) :: plan, basis
            integer(c_int32_t), value, intent(in) :: n_modes, numbers
            integer(c_size_t), intent(inout) :: bytes, work_bytes
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_tabulate(tabulated, block, bytes, plan, basis, n, points, n_modes, numbers, &
            modes, work, work_bytes, report, err) bind(c, name="hm_tabulate")
            import
            type(c_ptr), intent(inout) :: tabulated
            type(c_ptr), value, intent(in) :: block, plan, basis, points, work
            integer(c_size_t), value, intent(in) :: bytes, work_bytes
            integer(c_int32_t), value, intent(in) :: n, n_modes, numbers
            real(c_double), intent(in) :: modes(*)
            type(hm_solve_report), intent(inout) :: report
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
        integer(c_int32_t) function hm_c_plan_points(plan, n_points, index_base, err) bind(c, name="hm_plan_points")
            import
            type(c_ptr), value, intent(in) :: plan
            integer(c_int32_t), intent(inout) :: n_points, index_base
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
        integer(c_int32_t) function hm_c_displace_adjoint(plan, n, points, n_fields, dj, gradient, work, bytes, &
            report, err) bind(c, name="hm_displace_adjoint")
            import
            type(c_ptr), value, intent(in) :: plan, points, work          ! points: null if there are none
            integer(c_int32_t), value, intent(in) :: n, n_fields
            type(hm_c_points), intent(in) :: dj(*), gradient(*)
            integer(c_size_t), value, intent(in) :: bytes
            type(hm_solve_report), intent(inout) :: report
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_displace_safe_size(plan, basis, bytes, err) &
            bind(c, name="hm_displace_safe_size")
            import
            type(c_ptr), value, intent(in) :: plan, basis
            integer(c_size_t), intent(inout) :: bytes
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_displace_safe(plan, basis, move, n, points, wall, to, work, bytes, options, &
            report, err) bind(c, name="hm_displace_safe")
            import
            type(c_ptr), value, intent(in) :: plan, basis, move, points, work    ! move, points: null if there are none
            integer(c_int32_t), value, intent(in) :: n
            type(hm_c_points), intent(in) :: wall, to
            integer(c_size_t), value, intent(in) :: bytes
            type(hm_c_safe_options), intent(in) :: options
            type(hm_safe_report), intent(inout) :: report
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_plan_level(plan, level, cells, n_cells, err) bind(c, name="hm_plan_level")
            import
            type(c_ptr), value, intent(in) :: plan
            integer(c_int32_t), value, intent(in) :: level
            integer(c_int32_t), intent(inout) :: cells(*), n_cells
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
        integer(c_int32_t) function hm_c_morph_safe_size(plan, basis, bytes, err) bind(c, name="hm_morph_safe_size")
            import
            type(c_ptr), value, intent(in) :: plan, basis    ! basis: or null
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
        integer(c_int32_t) function hm_c_slide(analysis, from, to, err) bind(c, name="hm_slide")
            import
            type(c_ptr), value, intent(in) :: analysis
            type(hm_c_points), intent(in) :: from, to
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_slide_adjoint(analysis, from, dj, dj_from, err) &
            bind(c, name="hm_slide_adjoint")
            import
            type(c_ptr), value, intent(in) :: analysis
            type(hm_c_points), intent(in) :: from, dj, dj_from
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
