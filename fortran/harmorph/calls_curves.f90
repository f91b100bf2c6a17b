
! ---- The functions of harmorph.h: the library, and curves ------------------------------------------------------------

    public :: hm_best_kernel, hm_c_abi_version, hm_c_version, hm_c_status_name, hm_c_curves_check, hm_c_curve_basis, &
        hm_c_curve_point, hm_c_curve_project, hm_c_refine_size, hm_c_refine, hm_c_elevate_size, hm_c_elevate, &
        hm_c_measure, hm_c_variables_size, hm_c_variables_map, hm_c_fit_size, hm_c_fit

    interface
        integer(c_int32_t) function hm_c_abi_version() bind(c, name="hm_abi_version")
            import
        end function
        ! Of this processor; to be asked once, for hm_executor%kernel.
        integer(c_int32_t) function hm_best_kernel() bind(c, name="hm_best_kernel")
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
    end interface
