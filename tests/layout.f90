! Sizes and places of the fields of every struct that C and Fortran share, and the constants: Fortran's against C's
! (layout.c). A struct that gets a field in C only fails here.
program layout
    use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_loc, c_ptr, c_size_t, c_sizeof
    use harmorph
    implicit none

    interface
        function layout_of(number, numbers) result(n) bind(c)
            import :: c_int32_t, c_int64_t
            implicit none
            integer(c_int32_t), value, intent(in) :: number
            integer(c_int64_t), intent(inout) :: numbers(*)
            integer(c_int32_t) :: n
        end function
    end interface

    integer :: passed = 0, failed = 0
    type(hm_c_error), target :: error
    type(hm_c_executor), target :: executor
    type(hm_c_mesh), target :: mesh
    type(hm_c_points), target :: points
    type(hm_c_space_points), target :: space_points
    type(hm_c_block_points), target :: block_points
    type(hm_c_space_mesh), target :: space_mesh
    type(hm_c_edge_mesh), target :: edge_mesh
    type(hm_c_plane_info), target :: plane_info
    type(hm_c_curve), target :: curve
    type(hm_c_curves), target :: curves
    type(hm_c_fit_options), target :: fit_options
    type(hm_fit_report), target :: fit_report
    type(hm_c_section), target :: section
    type(hm_c_quantity), target :: quantity
    type(hm_c_variables), target :: variables
    type(hm_c_condition), target :: condition
    type(hm_c_problem), target :: problem
    type(hm_c_options), target :: options
    type(hm_c_study_options), target :: study_options
    type(hm_mesh_report), target :: mesh_report
    type(hm_solve_report), target :: solve_report
    type(hm_c_basis_info), target :: basis_info
    type(hm_transfer_report), target :: transfer_report
    type(hm_step_report), target :: step_report
    type(hm_quality_report), target :: quality_report
    type(hm_c_safe_options), target :: safe_options
    type(hm_safe_report), target :: safe_report
    type(hm_c_improve_options), target :: improve_options
    type(hm_improve_report), target :: improve_report

    call compare("hm_error", 1, c_sizeof(error), c_loc(error), [c_loc(error%code), &
        c_loc(error%item_kind), c_loc(error%item), c_loc(error%item_base), c_loc(error%other_kind), &
        c_loc(error%other), c_loc(error%other_base), c_loc(error%reserved), c_loc(error%value), c_loc(error%x), &
        c_loc(error%y), c_loc(error%text)])
    call compare("hm_executor", 2, c_sizeof(executor), c_loc(executor), [c_loc(executor%struct_size), &
        c_loc(executor%run), c_loc(executor%user), c_loc(executor%n_threads), c_loc(executor%kernel)])
    call compare("hm_mesh", 3, c_sizeof(mesh), c_loc(mesh), [c_loc(mesh%struct_size), c_loc(mesh%index_base), &
        c_loc(mesh%n_points), c_loc(mesh%points), c_loc(mesh%cell_layout), &
        c_loc(mesh%n_cells), c_loc(mesh%cell_start), c_loc(mesh%cell_points), c_loc(mesh%ni), c_loc(mesh%nj), &
        c_loc(mesh%n_faces), c_loc(mesh%face_points), c_loc(mesh%face_markers), c_loc(mesh%n_lists), &
        c_loc(mesh%list_start), c_loc(mesh%list_points), c_loc(mesh%list_markers), c_loc(mesh%n_quads), &
        c_loc(mesh%quad_points), c_loc(mesh%n_blocks), c_loc(mesh%reserved), c_loc(mesh%block_sizes), &
        c_loc(mesh%block_markers)])
    call compare("hm_curve", 4, c_sizeof(curve), c_loc(curve), [c_loc(curve%struct_size), c_loc(curve%degree), &
        c_loc(curve%n_indices), c_loc(curve%indices), c_loc(curve%knots)])
    call compare("hm_curves", 5, c_sizeof(curves), c_loc(curves), [c_loc(curves%struct_size), &
        c_loc(curves%index_base), c_loc(curves%n_control), c_loc(curves%control), c_loc(curves%weights), &
        c_loc(curves%n_curves), c_loc(curves%curve)])
    call compare("hm_fit_options", 6, c_sizeof(fit_options), c_loc(fit_options), [c_loc(fit_options%struct_size), &
        c_loc(fit_options%degree), c_loc(fit_options%n_control), c_loc(fit_options%closed), &
        c_loc(fit_options%index_base)])
    call compare("hm_fit_report", 7, c_sizeof(fit_report), c_loc(fit_report), [c_loc(fit_report%struct_size), &
        c_loc(fit_report%max_error), c_loc(fit_report%rms_error), c_loc(fit_report%max_error_point), &
        c_loc(fit_report%closed), c_loc(fit_report%first_point), c_loc(fit_report%base_points), &
        c_loc(fit_report%reason), c_loc(fit_report%corners), c_loc(fit_report%backtrack_point), &
        c_loc(fit_report%pieces)])
    call compare("hm_condition", 8, c_sizeof(condition), c_loc(condition), [c_loc(condition%struct_size), &
        c_loc(condition%marker), c_loc(condition%kind), c_loc(condition%first_curve), c_loc(condition%n_curves), &
        c_loc(condition%body), c_loc(condition%partner), c_loc(condition%x), c_loc(condition%y), &
        c_loc(condition%piece), c_loc(condition%reserved), c_loc(condition%near_x), c_loc(condition%near_y), &
        c_loc(condition%along)])
    call compare("hm_problem", 9, c_sizeof(problem), c_loc(problem), [c_loc(problem%struct_size), c_loc(problem%mesh), &
        c_loc(problem%curves), c_loc(problem%n_conditions), c_loc(problem%conditions), c_loc(problem%n_given), &
        c_loc(problem%given_points), c_loc(problem%given_curves), c_loc(problem%given_u)])
    call compare("hm_options", 10, c_sizeof(options), c_loc(options), [c_loc(options%struct_size), &
        c_loc(options%operator_kind), c_loc(options%engine), c_loc(options%precision), c_loc(options%kernel), &
        c_loc(options%tolerance), c_loc(options%progress), c_loc(options%progress_user), c_loc(options%executor), &
        c_loc(options%exponent_quarters), c_loc(options%offset_correction), c_loc(options%study)])
    call compare("hm_study_options", 110, c_sizeof(study_options), c_loc(study_options), &
        [c_loc(study_options%struct_size), c_loc(study_options%scheme), c_loc(study_options%levels), &
        c_loc(study_options%agglomeration), c_loc(study_options%block_width), c_loc(study_options%max_iterations), &
        c_loc(study_options%history), c_loc(study_options%history_length), c_loc(study_options%start)])
    call compare("hm_mesh_report", 11, c_sizeof(mesh_report), c_loc(mesh_report), [c_loc(mesh_report%struct_size), &
        c_loc(mesh_report%points), c_loc(mesh_report%used_points), c_loc(mesh_report%cells), &
        c_loc(mesh_report%triangles), c_loc(mesh_report%quads), c_loc(mesh_report%edges), &
        c_loc(mesh_report%boundary_edges), c_loc(mesh_report%boundary_loops), c_loc(mesh_report%inverted), &
        c_loc(mesh_report%first_inverted), c_loc(mesh_report%min_area), c_loc(mesh_report%min_quality), &
        c_loc(mesh_report%mean_quality), c_loc(mesh_report%polygons), c_loc(mesh_report%reserved)])
    call compare("hm_solve_report", 12, c_sizeof(solve_report), c_loc(solve_report), [c_loc(solve_report%struct_size), &
        c_loc(solve_report%unknowns), c_loc(solve_report%functions), c_loc(solve_report%residual), &
        c_loc(solve_report%residual_function), c_loc(solve_report%boundary_error_point), &
        c_loc(solve_report%boundary_error), c_loc(solve_report%partition_defect), c_loc(solve_report%min_value), &
        c_loc(solve_report%max_value), c_loc(solve_report%max_distance), c_loc(solve_report%max_distance_point), &
        c_loc(solve_report%curve_points), c_loc(solve_report%refinements), c_loc(solve_report%reserved), &
        c_loc(solve_report%factor_entries), c_loc(solve_report%iterations), c_loc(solve_report%levels), &
        c_loc(solve_report%fine_sweeps), c_loc(solve_report%reserved_too)])
    call compare("hm_basis_info", 13, c_sizeof(basis_info), c_loc(basis_info), [c_loc(basis_info%struct_size), &
        c_loc(basis_info%bytes), c_loc(basis_info%solved), c_loc(basis_info%points), c_loc(basis_info%cells), &
        c_loc(basis_info%functions), c_loc(basis_info%curves), c_loc(basis_info%curve_points), &
        c_loc(basis_info%numbers_per_value), c_loc(basis_info%operator_kind), c_loc(basis_info%scheme), &
        c_loc(basis_info%engine), c_loc(basis_info%index_base), c_loc(basis_info%curve_point), &
        c_loc(basis_info%point_curve), c_loc(basis_info%point_u), c_loc(basis_info%exponent_quarters), &
        c_loc(basis_info%bodies), c_loc(basis_info%offset_correction), c_loc(basis_info%storage), &
        c_loc(basis_info%combined), c_loc(basis_info%control_points), &
        c_loc(basis_info%modes), c_loc(basis_info%reserved)])
    call compare("hm_transfer_report", 14, c_sizeof(transfer_report), c_loc(transfer_report), &
        [c_loc(transfer_report%struct_size), c_loc(transfer_report%points), c_loc(transfer_report%outside), &
        c_loc(transfer_report%max_distance), c_loc(transfer_report%max_distance_point), &
        c_loc(transfer_report%boundary_error_point), c_loc(transfer_report%boundary_error), &
        c_loc(transfer_report%wall_correction)])
    call compare("hm_step_report", 15, c_sizeof(step_report), c_loc(step_report), [c_loc(step_report%struct_size), &
        c_loc(step_report%admissible), c_loc(step_report%cell), c_loc(step_report%point), &
        c_loc(step_report%boundary), c_loc(step_report%boundary_points), c_loc(step_report%reserved)])
    call compare("hm_quality_report", 16, c_sizeof(quality_report), c_loc(quality_report), &
        [c_loc(quality_report%struct_size), c_loc(quality_report%inverted), c_loc(quality_report%first_inverted), &
        c_loc(quality_report%min_area), c_loc(quality_report%min_quality), c_loc(quality_report%mean_quality), &
        c_loc(quality_report%min_quality_cell), c_loc(quality_report%self_crossing), &
        c_loc(quality_report%crossing_points)])
    call compare("hm_safe_options", 17, c_sizeof(safe_options), c_loc(safe_options), [c_loc(safe_options%struct_size), &
        c_loc(safe_options%max_resolves), c_loc(safe_options%skipped_strategies), c_loc(safe_options%n_others), &
        c_loc(safe_options%improve), c_loc(safe_options%others), c_loc(safe_options%heights), &
        c_loc(safe_options%reached), c_loc(safe_options%min_quality), c_loc(safe_options%max_height_change)])
    call compare("hm_safe_report", 18, c_sizeof(safe_report), c_loc(safe_report), [c_loc(safe_report%struct_size), &
        c_loc(safe_report%strategy), c_loc(safe_report%other), c_loc(safe_report%steps), c_loc(safe_report%resolves), &
        c_loc(safe_report%step_fraction), c_loc(safe_report%admissible), c_loc(safe_report%cell), &
        c_loc(safe_report%point), c_loc(safe_report%untangled), c_loc(safe_report%iterations), &
        c_loc(safe_report%crossing_points), c_loc(safe_report%inverted), c_loc(safe_report%min_quality_cell), &
        c_loc(safe_report%min_quality), c_loc(safe_report%mean_quality), c_loc(safe_report%mean_angle_change), &
        c_loc(safe_report%max_angle_change), c_loc(safe_report%mean_height_ratio), &
        c_loc(safe_report%min_height_ratio), c_loc(safe_report%max_height_ratio), c_loc(safe_report%heights), &
        c_loc(safe_report%angle_point), c_loc(safe_report%min_height_point), c_loc(safe_report%max_height_point), &
        c_loc(safe_report%n_worst), c_loc(safe_report%turned_offset), c_loc(safe_report%start_quality), &
        c_loc(safe_report%worst), c_loc(safe_report%worst(1)%reserved), c_loc(safe_report%worst(1)%quality), &
        c_loc(safe_report%worst(1)%start_quality), c_loc(safe_report%worst(1)%x), c_loc(safe_report%worst(1)%y), &
        c_loc(safe_report%worst(2)), c_loc(safe_report%end_point), c_loc(safe_report%reserved), &
        c_loc(safe_report%end_leaves)])
    call compare("hm_improve_options", 101, c_sizeof(improve_options), c_loc(improve_options), &
        [c_loc(improve_options%struct_size), c_loc(improve_options%max_iterations), c_loc(improve_options%reserved), &
        c_loc(improve_options%reference)])
    call compare("hm_improve_report", 102, c_sizeof(improve_report), c_loc(improve_report), &
        [c_loc(improve_report%struct_size), c_loc(improve_report%iterations), c_loc(improve_report%movable), &
        c_loc(improve_report%min_quality_before), c_loc(improve_report%mean_quality_before), &
        c_loc(improve_report%min_quality), c_loc(improve_report%mean_quality), &
        c_loc(improve_report%min_quality_cell_before), c_loc(improve_report%min_quality_cell)])
    include "constants_f.inc"  ! all constants of harmorph.h: fortran.sh writes this call

    call compare("hm_points", 21, c_sizeof(points), c_loc(points), [c_loc(points%x), c_loc(points%y), &
        c_loc(points%stride)])
    call compare("hm_points_out", 22, c_sizeof(points), c_loc(points), [c_loc(points%x), c_loc(points%y), &
        c_loc(points%stride)])

    call compare("hm_block_points", 31, c_sizeof(block_points), c_loc(block_points), [c_loc(block_points%x), &
        c_loc(block_points%y), c_loc(block_points%stride), c_loc(block_points%row)])
    call compare("hm_block_points_out", 32, c_sizeof(block_points), c_loc(block_points), [c_loc(block_points%x), &
        c_loc(block_points%y), c_loc(block_points%stride), c_loc(block_points%row)])
    call compare("hm_space_points", 23, c_sizeof(space_points), c_loc(space_points), [c_loc(space_points%x), &
        c_loc(space_points%y), c_loc(space_points%z), c_loc(space_points%stride)])
    call compare("hm_space_points_out", 24, c_sizeof(space_points), c_loc(space_points), [c_loc(space_points%x), &
        c_loc(space_points%y), c_loc(space_points%z), c_loc(space_points%stride)])
    call compare("hm_space_mesh", 25, c_sizeof(space_mesh), c_loc(space_mesh), [c_loc(space_mesh%struct_size), &
        c_loc(space_mesh%index_base), c_loc(space_mesh%n_points), c_loc(space_mesh%points), c_loc(space_mesh%kind), &
        c_loc(space_mesh%n_faces), c_loc(space_mesh%face_start), c_loc(space_mesh%face_points), &
        c_loc(space_mesh%n_sides), c_loc(space_mesh%side_points), c_loc(space_mesh%side_markers), &
        c_loc(space_mesh%axis_point), c_loc(space_mesh%axis), c_loc(space_mesh%tolerance)])
    call compare("hm_edge_mesh", 33, c_sizeof(edge_mesh), c_loc(edge_mesh), [c_loc(edge_mesh%struct_size), &
        c_loc(edge_mesh%index_base), c_loc(edge_mesh%n_points), c_loc(edge_mesh%points), c_loc(edge_mesh%n_cells), &
        c_loc(edge_mesh%n_edges), c_loc(edge_mesh%edge_points), c_loc(edge_mesh%edge_cells), &
        c_loc(edge_mesh%edge_markers)])
    call compare("hm_plane_info", 26, c_sizeof(plane_info), c_loc(plane_info), [c_loc(plane_info%struct_size), &
        c_loc(plane_info%kind), c_loc(plane_info%n_points), c_loc(plane_info%n_space_points), &
        c_loc(plane_info%layers), c_loc(plane_info%origin), c_loc(plane_info%x_direction), &
        c_loc(plane_info%y_direction), c_loc(plane_info%normal), c_loc(plane_info%max_distance), &
        c_loc(plane_info%max_distance_point), c_loc(plane_info%reserved), c_loc(plane_info%follows), &
        c_loc(plane_info%space_point)])
    call compare("hm_section", 27, c_sizeof(section), c_loc(section), [c_loc(section%struct_size), &
        c_loc(section%first_curve), c_loc(section%n_curves), c_loc(section%leading_x), c_loc(section%leading_y), &
        c_loc(section%trailing_x), c_loc(section%trailing_y)])
    call compare("hm_quantity", 28, c_sizeof(quantity), c_loc(quantity), [c_loc(quantity%struct_size), &
        c_loc(quantity%kind), c_loc(quantity%n_polygon), c_loc(quantity%station), c_loc(quantity%polygon)])
    call compare("hm_variables", 29, c_sizeof(variables), c_loc(variables), [c_loc(variables%struct_size), &
        c_loc(variables%kind), c_loc(variables%n_upper), c_loc(variables%n_lower), c_loc(variables%degree_x), &
        c_loc(variables%degree_y), c_loc(variables%x_min), c_loc(variables%y_min), c_loc(variables%x_max), &
        c_loc(variables%y_max), c_loc(variables%peaks), c_loc(variables%leading_exponent), &
        c_loc(variables%trailing_exponent), c_loc(variables%width)])

    print "(i0, a, i0, a)", passed, " passed, ", failed, " failed"
    if (failed > 0) error stop

contains

    ! Size and places of the fields, given as their addresses.
    subroutine compare(what, number, bytes, start, fields)
        character(len=*), intent(in) :: what
        integer, intent(in) :: number
        integer(c_size_t), intent(in) :: bytes
        type(c_ptr), intent(in) :: start, fields(:)
        integer(c_int64_t) :: ours(1 + size(fields))
        integer :: k
        ours(1) = int(bytes, c_int64_t)
        do k = 1, size(fields)
            ours(1 + k) = transfer(fields(k), 0_c_int64_t) - transfer(start, 0_c_int64_t)
        end do
        call compare_numbers(what, number, ours)
    end subroutine

    subroutine compare_numbers(what, number, ours)
        character(len=*), intent(in) :: what
        integer, intent(in) :: number
        integer(c_int64_t), intent(in) :: ours(:)
        integer(c_int64_t) :: theirs(400)
        integer :: k, n
        n = layout_of(int(number, c_int32_t), theirs)
        if (n /= size(ours)) then
            failed = failed + 1
            print "(3a, i0, a, i0)", "layout: ", what, " has ", n, " numbers in C, here ", size(ours)
        end if
        do k = 1, min(n, size(ours))
            if (theirs(k) == ours(k)) then
                passed = passed + 1
            else
                failed = failed + 1
                print "(3a, i0, a, i0, a, i0)", "layout: ", what, ", number ", k, ": ", theirs(k), " in C, here ", &
                    ours(k)
            end if
        end do
    end subroutine
end program
