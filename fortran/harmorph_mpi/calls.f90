
    ! ---- C -----------------------------------------------------------------------------------------------------------

    interface
        function c_exchange(rows, share, n, points, comm, err) result(status) bind(c, name="hm_mpi_exchange_f")
            import :: c_int, c_int32_t, c_ptr, hm_c_error
            implicit none
            type(c_ptr), value, intent(in) :: rows, share
            integer(c_int32_t), value, intent(in) :: n
            integer(c_int32_t), intent(in) :: points(*)
            integer(c_int), value, intent(in) :: comm
            type(hm_c_error), intent(inout) :: err
            integer(c_int32_t) :: status
        end function
        function c_adjoint(rows, dj, gradient, executor, comm, err) result(status) bind(c, name="hm_mpi_adjoint_f")
            import :: c_int, c_int32_t, c_ptr, hm_c_error, hm_c_points
            implicit none
            type(c_ptr), value, intent(in) :: rows, gradient, executor
            type(hm_c_points), intent(in) :: dj
            integer(c_int), value, intent(in) :: comm
            type(hm_c_error), intent(inout) :: err
            integer(c_int32_t) :: status
        end function
        function c_displace(plan, n_wall, wall_points, n_fields, wall, n, points, from, to, root, comm, err) &
            result(status) bind(c, name="hm_mpi_displace_f")
            import :: c_int, c_int32_t, c_ptr, hm_c_error, hm_c_points
            implicit none
            type(c_ptr), value, intent(in) :: plan, from                    ! from: null for displacements
            integer(c_int32_t), value, intent(in) :: n_wall, n_fields, n, root
            integer(c_int32_t), intent(in) :: wall_points(*), points(*)
            type(hm_c_points), intent(in) :: wall(*), to(*)                 ! [n_fields]
            integer(c_int), value, intent(in) :: comm
            type(hm_c_error), intent(inout) :: err
            integer(c_int32_t) :: status
        end function
        function c_displace_adjoint(plan, n_wall, wall_points, n_fields, dj, n, points, gradient, root, comm, err) &
            result(status) bind(c, name="hm_mpi_displace_adjoint_f")
            import :: c_int, c_int32_t, c_ptr, hm_c_error, hm_c_points
            implicit none
            type(c_ptr), value, intent(in) :: plan
            integer(c_int32_t), value, intent(in) :: n_wall, n_fields, n, root
            integer(c_int32_t), intent(in) :: wall_points(*), points(*)
            type(hm_c_points), intent(in) :: dj(*), gradient(*)             ! [n_fields]
            integer(c_int), value, intent(in) :: comm
            type(hm_c_error), intent(inout) :: err
            integer(c_int32_t) :: status
        end function
    end interface
