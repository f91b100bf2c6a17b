! Sizes and places of the fields of every struct that C and Fortran share, and the constants: Fortran's against C's
! (layout.c). A struct that gets a field in C only fails here.
program layout
    use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_intptr_t, c_loc, c_ptr, c_size_t, c_sizeof
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
    type(hm_c_curve), target :: curve
    type(hm_c_curves), target :: curves
    type(hm_c_fit_options), target :: fit_options
    type(hm_fit_report), target :: fit_report
    type(hm_c_condition), target :: condition
    type(hm_c_problem), target :: problem
    type(hm_c_options), target :: options
    type(hm_mesh_report), target :: mesh_report
    type(hm_solve_report), target :: solve_report
    type(hm_c_basis_info), target :: basis_info
    type(hm_step_report), target :: step_report
    type(hm_quality_report), target :: quality_report

    call compare("hm_error", 1, [c_sizeof(error), place(c_loc(error), c_loc(error%code)), place(c_loc(error), &
        c_loc(error%item)), place(c_loc(error), c_loc(error%value)), place(c_loc(error), c_loc(error%text))])
    call compare("hm_executor", 2, [c_sizeof(executor), place(c_loc(executor), c_loc(executor%struct_size)), &
        place(c_loc(executor), c_loc(executor%run)), place(c_loc(executor), c_loc(executor%user)), place(c_loc(executor), &
        c_loc(executor%n_threads)), place(c_loc(executor), c_loc(executor%reserved))])
    call compare("hm_mesh", 3, [c_sizeof(mesh), place(c_loc(mesh), c_loc(mesh%struct_size)), place(c_loc(mesh), &
        c_loc(mesh%index_base)), place(c_loc(mesh), c_loc(mesh%n_points)), place(c_loc(mesh), c_loc(mesh%x)), &
        place(c_loc(mesh), c_loc(mesh%y)), place(c_loc(mesh), c_loc(mesh%stride)), place(c_loc(mesh), &
        c_loc(mesh%cell_layout)), place(c_loc(mesh), c_loc(mesh%n_cells)), place(c_loc(mesh), c_loc(mesh%cell_start)), &
        place(c_loc(mesh), c_loc(mesh%cell_points)), place(c_loc(mesh), c_loc(mesh%ni)), place(c_loc(mesh), &
        c_loc(mesh%nj)), place(c_loc(mesh), c_loc(mesh%n_faces)), place(c_loc(mesh), c_loc(mesh%face_points)), &
        place(c_loc(mesh), c_loc(mesh%face_markers)), place(c_loc(mesh), c_loc(mesh%n_lists)), place(c_loc(mesh), &
        c_loc(mesh%list_start)), place(c_loc(mesh), c_loc(mesh%list_points)), place(c_loc(mesh), c_loc(mesh%list_markers))])
    call compare("hm_curve", 4, [c_sizeof(curve), place(c_loc(curve), c_loc(curve%struct_size)), place(c_loc(curve), &
        c_loc(curve%degree)), place(c_loc(curve), c_loc(curve%n_indices)), place(c_loc(curve), c_loc(curve%indices)), &
        place(c_loc(curve), c_loc(curve%knots))])
    call compare("hm_curves", 5, [c_sizeof(curves), place(c_loc(curves), c_loc(curves%struct_size)), place(c_loc(curves), &
        c_loc(curves%index_base)), place(c_loc(curves), c_loc(curves%n_control)), place(c_loc(curves), &
        c_loc(curves%control)), place(c_loc(curves), c_loc(curves%weights)), place(c_loc(curves), c_loc(curves%n_curves)), &
        place(c_loc(curves), c_loc(curves%curve))])
    call compare("hm_fit_options", 6, [c_sizeof(fit_options), place(c_loc(fit_options), c_loc(fit_options%struct_size)), &
        place(c_loc(fit_options), c_loc(fit_options%degree)), place(c_loc(fit_options), c_loc(fit_options%n_control)), &
        place(c_loc(fit_options), c_loc(fit_options%closed))])
    call compare("hm_fit_report", 7, [c_sizeof(fit_report), place(c_loc(fit_report), c_loc(fit_report%struct_size)), &
        place(c_loc(fit_report), c_loc(fit_report%max_error)), place(c_loc(fit_report), c_loc(fit_report%rms_error)), &
        place(c_loc(fit_report), c_loc(fit_report%max_error_point)), place(c_loc(fit_report), c_loc(fit_report%closed)), &
        place(c_loc(fit_report), c_loc(fit_report%first_point)), place(c_loc(fit_report), c_loc(fit_report%base_points))])
    call compare("hm_condition", 8, [c_sizeof(condition), place(c_loc(condition), c_loc(condition%struct_size)), &
        place(c_loc(condition), c_loc(condition%marker)), place(c_loc(condition), c_loc(condition%kind)), &
        place(c_loc(condition), c_loc(condition%first_curve)), place(c_loc(condition), c_loc(condition%n_curves))])
    call compare("hm_problem", 9, [c_sizeof(problem), place(c_loc(problem), c_loc(problem%struct_size)), &
        place(c_loc(problem), c_loc(problem%mesh)), place(c_loc(problem), c_loc(problem%curves)), place(c_loc(problem), &
        c_loc(problem%n_conditions)), place(c_loc(problem), c_loc(problem%conditions)), place(c_loc(problem), &
        c_loc(problem%n_given)), place(c_loc(problem), c_loc(problem%given_points)), place(c_loc(problem), &
        c_loc(problem%given_curves)), place(c_loc(problem), c_loc(problem%given_u))])
    call compare("hm_options", 10, [c_sizeof(options), place(c_loc(options), c_loc(options%struct_size)), &
        place(c_loc(options), c_loc(options%operator_kind)), place(c_loc(options), c_loc(options%scheme)), &
        place(c_loc(options), c_loc(options%engine)), place(c_loc(options), c_loc(options%kernel)), place(c_loc(options), &
        c_loc(options%tolerance)), place(c_loc(options), c_loc(options%progress)), place(c_loc(options), &
        c_loc(options%progress_user)), place(c_loc(options), c_loc(options%executor))])
    call compare("hm_mesh_report", 11, [c_sizeof(mesh_report), place(c_loc(mesh_report), c_loc(mesh_report%struct_size)), &
        place(c_loc(mesh_report), c_loc(mesh_report%points)), place(c_loc(mesh_report), c_loc(mesh_report%used_points)), &
        place(c_loc(mesh_report), c_loc(mesh_report%cells)), place(c_loc(mesh_report), c_loc(mesh_report%triangles)), &
        place(c_loc(mesh_report), c_loc(mesh_report%quads)), place(c_loc(mesh_report), c_loc(mesh_report%edges)), &
        place(c_loc(mesh_report), c_loc(mesh_report%boundary_edges)), place(c_loc(mesh_report), &
        c_loc(mesh_report%boundary_loops)), place(c_loc(mesh_report), c_loc(mesh_report%inverted)), &
        place(c_loc(mesh_report), c_loc(mesh_report%first_inverted)), place(c_loc(mesh_report), &
        c_loc(mesh_report%min_area)), place(c_loc(mesh_report), c_loc(mesh_report%min_quality)), place(c_loc(mesh_report), &
        c_loc(mesh_report%mean_quality))])
    call compare("hm_solve_report", 12, [c_sizeof(solve_report), place(c_loc(solve_report), &
        c_loc(solve_report%struct_size)), place(c_loc(solve_report), c_loc(solve_report%unknowns)), &
        place(c_loc(solve_report), c_loc(solve_report%functions)), place(c_loc(solve_report), &
        c_loc(solve_report%residual)), place(c_loc(solve_report), c_loc(solve_report%residual_function)), &
        place(c_loc(solve_report), c_loc(solve_report%boundary_error_point)), place(c_loc(solve_report), &
        c_loc(solve_report%boundary_error)), place(c_loc(solve_report), c_loc(solve_report%partition_defect)), &
        place(c_loc(solve_report), c_loc(solve_report%min_value)), place(c_loc(solve_report), &
        c_loc(solve_report%max_value)), place(c_loc(solve_report), c_loc(solve_report%max_distance)), &
        place(c_loc(solve_report), c_loc(solve_report%max_distance_point)), place(c_loc(solve_report), &
        c_loc(solve_report%curve_points)), place(c_loc(solve_report), c_loc(solve_report%refinements)), &
        place(c_loc(solve_report), c_loc(solve_report%reserved)), place(c_loc(solve_report), &
        c_loc(solve_report%factor_entries))])
    call compare("hm_basis_info", 13, [c_sizeof(basis_info), place(c_loc(basis_info), c_loc(basis_info%struct_size)), &
        place(c_loc(basis_info), c_loc(basis_info%bytes)), place(c_loc(basis_info), c_loc(basis_info%solved)), &
        place(c_loc(basis_info), c_loc(basis_info%points)), place(c_loc(basis_info), c_loc(basis_info%cells)), &
        place(c_loc(basis_info), c_loc(basis_info%functions)), place(c_loc(basis_info), c_loc(basis_info%curves)), &
        place(c_loc(basis_info), c_loc(basis_info%curve_points)), place(c_loc(basis_info), &
        c_loc(basis_info%numbers_per_value)), place(c_loc(basis_info), c_loc(basis_info%operator_kind)), &
        place(c_loc(basis_info), c_loc(basis_info%scheme)), place(c_loc(basis_info), c_loc(basis_info%engine)), &
        place(c_loc(basis_info), c_loc(basis_info%index_base)), place(c_loc(basis_info), c_loc(basis_info%curve_point)), &
        place(c_loc(basis_info), c_loc(basis_info%point_curve)), place(c_loc(basis_info), c_loc(basis_info%point_u))])
    call compare("hm_step_report", 14, [c_sizeof(step_report), place(c_loc(step_report), c_loc(step_report%struct_size)), &
        place(c_loc(step_report), c_loc(step_report%admissible)), place(c_loc(step_report), c_loc(step_report%cell)), &
        place(c_loc(step_report), c_loc(step_report%point))])
    call compare("hm_quality_report", 15, [c_sizeof(quality_report), place(c_loc(quality_report), &
        c_loc(quality_report%struct_size)), place(c_loc(quality_report), c_loc(quality_report%inverted)), &
        place(c_loc(quality_report), c_loc(quality_report%first_inverted)), place(c_loc(quality_report), &
        c_loc(quality_report%min_area)), place(c_loc(quality_report), c_loc(quality_report%min_quality)), &
        place(c_loc(quality_report), c_loc(quality_report%mean_quality)), place(c_loc(quality_report), &
        c_loc(quality_report%min_quality_cell)), place(c_loc(quality_report), c_loc(quality_report%self_crossing)), &
        place(c_loc(quality_report), c_loc(quality_report%crossing_points))])
    call compare("constants", 16, int([hm_abi, hm_ok, hm_not_converged, hm_moved, hm_cancelled, hm_bad_argument, &
        hm_bad_mesh, hm_bad_curve, hm_bad_condition, hm_bad_basis, hm_block_too_small, hm_not_positive, hm_unsupported], &
        c_size_t))
    call compare("constants", 17, int([hm_cells_rows, hm_cells_triangles, hm_cells_quads, hm_cells_structured, &
        hm_closed_auto, hm_open, hm_tied, hm_periodic, hm_on_curve, hm_fixed, hm_free, hm_laplace, hm_compact, hm_direct, &
        hm_kernel_auto, hm_kernel_baseline, hm_kernel_avx2, hm_kernel_avx512, hm_phase_structure, hm_phase_ordering, &
        hm_phase_symbolic, hm_phase_assembly, hm_phase_factor, hm_phase_solve, hm_phase_residual], c_size_t))

    print "(i0, a, i0, a)", passed, " passed, ", failed, " failed"
    if (failed > 0) error stop

contains

    subroutine compare(what, number, ours)
        character(len=*), intent(in) :: what
        integer, intent(in) :: number
        integer(c_size_t), intent(in) :: ours(:)
        integer(c_int64_t) :: theirs(100)
        integer :: k, n
        n = layout_of(int(number, c_int32_t), theirs)
        if (n /= size(ours)) then
            failed = failed + 1
            print "(3a, i0, a, i0)", "layout: ", what, " has ", n, " numbers in C, here ", size(ours)
        end if
        do k = 1, min(n, size(ours))
            if (theirs(k) == int(ours(k), c_int64_t)) then
                passed = passed + 1
            else
                failed = failed + 1
                print "(3a, i0, a, i0, a, i0)", "layout: ", what, ", number ", k, ": ", theirs(k), " in C, here ", ours(k)
            end if
        end do
    end subroutine

    integer(c_size_t) function place(start, field)
        type(c_ptr), intent(in) :: start, field
        place = int(transfer(field, 0_c_intptr_t) - transfer(start, 0_c_intptr_t), c_size_t)
    end function
end program
