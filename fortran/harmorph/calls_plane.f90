
! ---- The functions of harmorph.h: blocks in arrays of their own, meshes one cell thick -------------------------------

    public :: hm_c_blocks_gather, hm_c_blocks_scatter, &
        hm_c_plane_size, hm_c_plane_init, hm_c_plane_info_get, hm_c_plane_mesh, hm_c_plane_morph, &
        hm_c_plane_adjoint, hm_c_plane_spread, hm_c_plane_gather

    interface
        integer(c_int32_t) function hm_c_blocks_gather(mesh, first, n, blocks, to, err) bind(c, name="hm_blocks_gather")
            import
            type(hm_c_mesh), intent(in) :: mesh
            integer(c_int32_t), value, intent(in) :: first, n
            type(hm_c_block_points), intent(in) :: blocks(*)
            type(hm_c_points), intent(in) :: to
            type(hm_c_error), intent(inout) :: err
        end function
        integer(c_int32_t) function hm_c_blocks_scatter(mesh, first, n, from, blocks, err) &
            bind(c, name="hm_blocks_scatter")
            import
            type(hm_c_mesh), intent(in) :: mesh
            integer(c_int32_t), value, intent(in) :: first, n
            type(hm_c_points), intent(in) :: from
            type(hm_c_block_points), intent(in) :: blocks(*)
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
    end interface
