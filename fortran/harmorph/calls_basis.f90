
! ---- The functions of harmorph.h: bases ------------------------------------------------------------------------------

    public :: hm_c_combine_size, hm_c_combine, hm_c_basis_attach, hm_c_basis_info_get, hm_c_basis_curves, &
        hm_c_moved_curves, hm_c_basis_conditions, hm_c_basis_values, hm_c_single_size, hm_c_single_init, hm_c_morph, &
        hm_c_adjoint, hm_c_boundary_error, hm_c_extract_size, hm_c_extract_init, hm_c_parcel_size, hm_c_parcel_pack, &
        hm_c_parcel_unpack, hm_c_adjoint_scale, hm_c_adjoint_sums, hm_c_adjoint_finish, hm_c_admissible_step, &
        hm_c_quality, hm_c_assess

    interface
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
    end interface
