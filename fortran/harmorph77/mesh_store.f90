
! ---- The mesh in W ---------------------------------------------------------------------------------------------------

contains

    integer(c_int64_t) function own_words(this)
        type(legacy_call), intent(in) :: this
        own_words = words_of(c_sizeof(this%kept))
    end function

    ! Another mesh, whose arrays are the caller's but for `words` behind the state. Curves are forgotten.
    subroutine keep_mesh(this, mesh, words)
        type(legacy_call), intent(inout) :: this
        type(hm_c_mesh), intent(in) :: mesh
        integer(c_int64_t), intent(in) :: words
        if (.not. this%ok()) return
        this%top = this%kept%all_words          ! a plan of HMFACT is given up
        if (.not. this%fits(words, own_words(this))) return
        this%kept%mesh = mesh
        this%kept%mesh%struct_size = int(c_sizeof(mesh), c_int64_t)
        this%kept%mesh%index_base = 1
        this%kept%plane = c_null_ptr
        this%kept%mesh_end = own_words(this) + words
        call forget_curves(this%kept)
    end subroutine

    ! Blocks, one after the other; copies of their sizes nij(2,nb) and markers marks(4,nb) go into W.
    subroutine keep_blocks(this, nb, nij, points, marks)
        type(legacy_call), intent(inout) :: this
        integer, intent(in) :: nb
        integer(c_int32_t), intent(in) :: nij(2, *), marks(4, *)
        type(hm_c_points), intent(in) :: points
        type(hm_c_mesh) :: mesh
        integer(c_int32_t), pointer :: numbers(:)
        integer :: b
        if (.not. this%ok()) return
        call this%refuse_if(any(nij(:, :nb) < 2), "NI and NJ must be at least 2")
        mesh = hm_c_mesh(points=points, n_blocks=nb, cell_layout=hm_cells_blocks)
        mesh%n_points = sum([(nij(1, b) * nij(2, b), b = 1, nb)])
        call keep_mesh(this, mesh, 3_c_int64_t * nb)
        if (.not. this%ok()) return
        call c_f_pointer(this%at(own_words(this) + 1), numbers, [6 * nb])
        numbers(:2 * nb) = reshape(nij(:, :nb), [2 * nb])
        numbers(2 * nb + 1:) = reshape(merge(hm_no_marker, marks(:, :nb), marks(:, :nb) == 0), [4 * nb])
        this%kept%mesh%block_sizes = c_loc(numbers)
        this%kept%mesh%block_markers = c_loc(numbers(2 * nb + 1))
    end subroutine

    ! The corners of the cells, four a column, of which a triangle repeats one.
    subroutine corners_of_cells(this, corners)
        type(legacy_call), intent(inout) :: this
        integer(c_int32_t), allocatable, intent(out) :: corners(:, :)
        integer :: triangles
        if (.not. this%ok()) return
        call this%refuse_if(c_associated(this%kept%plane), "the mesh of HMPLAN has the markers of its sides")
        call this%refuse_if(this%kept%mesh%n_cells < 0, "NC must be at least 1")
        if (.not. this%ok()) return
        associate (mesh => this%kept%mesh)
            allocate(corners(4, mesh%n_cells))
            select case (mesh%cell_layout)
            case (hm_cells_triangles)
                call copy_corners(mesh%cell_points, 3, corners)
            case (hm_cells_quads)
                call copy_corners(mesh%cell_points, 4, corners)
            case (hm_cells_mixed)
                triangles = int(mesh%n_cells - mesh%n_quads)
                call copy_corners(mesh%cell_points, 3, corners(:, :triangles))
                call copy_corners(mesh%quad_points, 4, corners(:, triangles + 1:))
            case (hm_cells_polygons)
                call fans_of_polygons(this, corners)
            case default
                call this%refuse("HMMESH, HMMIXD or HMPOLY comes before HMTYPE")
            end select
            if (this%ok()) call this%refuse_if(any(corners < 1 .or. corners > mesh%n_points), &
                "CELLS has a point that the mesh has not")
        end associate
    end subroutine

    subroutine copy_corners(points, width, corners)
        type(c_ptr), intent(in) :: points
        integer, intent(in) :: width
        integer(c_int32_t), intent(inout) :: corners(:, :)
        integer(c_int32_t), pointer :: cells(:, :)
        if (size(corners) == 0) return
        call c_f_pointer(points, cells, [width, size(corners, 2)])
        corners(:width, :) = cells
        if (width == 3) corners(4, :) = cells(3, :)
    end subroutine

    ! Polygons as fans of triangles: each inner side is there twice, as sides between cells are.
    subroutine fans_of_polygons(this, corners)
        type(legacy_call), intent(inout) :: this
        integer(c_int32_t), allocatable, intent(inout) :: corners(:, :)
        integer(c_int32_t), pointer :: points(:), start(:)
        integer :: c, k, n, m
        n = int(this%kept%mesh%n_cells)
        call c_f_pointer(this%kept%mesh%cell_start, start, [n + 1])
        call this%refuse_if(start(1) /= 1 .or. any(start(2:) < start(:n) + 3), "a cell has not 3 points")
        if (.not. this%ok()) return
        call c_f_pointer(this%kept%mesh%cell_points, points, [start(n + 1) - 1])
        deallocate(corners)
        allocate(corners(4, start(n + 1) - 1 - 2 * n))
        m = 0
        do c = 1, n
            do k = start(c) + 1, start(c + 1) - 2
                m = m + 1
                corners(:, m) = [points(start(c)), points(k), points(k + 1), points(k + 1)]
            end do
        end do
    end subroutine

    ! What every use of the plane of HMPLAN begins with.
    subroutine open_plane(this, w)
        type(legacy_call), intent(inout) :: this
        real(c_double), intent(in), target :: w(*)
        call this%open(w)
        if (.not. this%ok()) return
        call this%refuse_if(.not. c_associated(this%kept%plane), "there is no plane: HMPLAN comes first")
    end subroutine

    type(hm_c_space_points) function space_points_of(x, y, z, inc)
        real(c_double), intent(in), target :: x(*), y(*), z(*)
        integer, intent(in) :: inc
        space_points_of = hm_c_space_points(c_loc(x), c_loc(y), c_loc(z), int(max(inc, 1), c_int64_t))
    end function
