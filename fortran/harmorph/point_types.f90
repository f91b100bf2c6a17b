
! ---- A boundary given by a type for each point, as many codes have it ------------------------------------------------

    public :: hm_faces_of_types

contains
    ! ---- Mesh: boundary by types of points

!@each integer
    ! types(n): 0 for inner points, for others a marker. A boundary edge (an edge of one cell) whose points have types
    ! gets theirs; between two types the larger one: give the walls on curves the smallest numbers. Edges with a point
    ! of type 0 get no marker: the library takes them for a cut, or refuses them. After cells.
    subroutine point_types_@FORM@(self, types, stat, err)
        class(hm_mesh), intent(inout) :: self
        integer(@KIND@), intent(in) :: types(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        integer(c_int32_t), allocatable :: faces(:, :), markers(:)
        call prepare_to_add(self, done)
        if (done%ok()) call done%refuse_if(size(types) /= self%arrays%coordinates%n(), &
            "types must have a number for each point")
        if (done%ok()) call faces_of_arrays(self%arrays, small(types), faces, markers, done)
        if (done%ok()) then
            call self%arrays%face_points%append(reshape(faces, [size(faces)]), done)
            call self%arrays%face_markers%append(markers, done)
        end if
        call done%finish("mesh%point_types", stat, err)
    end subroutine

!@end
    subroutine faces_of_arrays(arrays, types, faces, markers, done)
        type(mesh_arrays), intent(in) :: arrays
        integer(c_int32_t), intent(in) :: types(:)
        integer(c_int32_t), allocatable, intent(out) :: faces(:, :), markers(:)
        type(outcome), intent(inout) :: done
        integer(c_int32_t), allocatable :: quads(:, :), start(:)
        integer :: i, j, k
        call done%refuse_if(arrays%layout /= hm_cells_structured .and. arrays%cells%n() == 0, &
            "the mesh has no cells yet: point_types comes after cells")
        if (done%status < 0) return
        select case (arrays%layout)
        case (hm_cells_structured)
            quads = reshape([((int(i + arrays%ni * (j - 1) + [0, 1, arrays%ni + 1, arrays%ni], c_int32_t), &
                i = 1, arrays%ni - 1), j = 1, arrays%nj - 1)], [4, (arrays%ni - 1) * (arrays%nj - 1)])
        case (hm_cells_triangles, hm_cells_quads)
            quads = reshape(arrays%cells%at, [merge(3, 4, arrays%layout == hm_cells_triangles), n_cells_of(arrays)]) + &
                int(1 - arrays%first, c_int32_t)
        case default
            allocate (start, source=arrays%cell_start%at + int(1 - arrays%first, c_int32_t))
            associate (corners => start(2:) - start(:size(start) - 1))
                call done%refuse_if(any(corners < 3) .or. (arrays%layout == hm_cells_rows .and. any(corners > 4)), &
                    "a cell has not 3 or 4 points")
                if (done%status < 0) return
                allocate(quads(4, sum(corners - 2)))
            end associate
            k = 0
            do i = 1, size(start) - 1                           ! as fans of triangles: inner sides have two of them
                do j = start(i) + 1, start(i + 1) - 2
                    k = k + 1
                    quads(:, k) = arrays%cells%at([start(i), int(j, c_int32_t), int(j + 1, c_int32_t), &
                        int(j + 1, c_int32_t)]) + int(1 - arrays%first, c_int32_t)
                end do
            end do
        end select
        call done%refuse_if(any(quads < 1 .or. quads > size(types)), "a cell has a point that the mesh has not")
        if (done%status < 0) return
        call hm_faces_of_types(quads, types, faces, markers)
        faces = faces + int(arrays%first - 1, c_int32_t)
    end subroutine

    ! Of cells(3 or 4, n), whose points count from 1; a triangle among quads repeats a point. Edges are gathered at the
    ! smaller of their two points; those that one cell alone has are faces.
    subroutine hm_faces_of_types(cells, types, faces, markers)
        integer(c_int32_t), intent(in) :: cells(:, :), types(:)
        integer(c_int32_t), allocatable, intent(out) :: faces(:, :), markers(:)
        integer(c_int32_t), allocatable :: other(:)
        integer, allocatable :: start(:)
        integer(c_int32_t) :: a, b
        integer :: pass, k, side, n, m
        m = size(cells, 1)
        allocate(start(size(types) + 2), source=0)
        allocate(other(size(cells)))
        do pass = 1, 2                                          ! count, then gather
            do k = 1, size(cells, 2)
                do side = 1, m
                    a = min(cells(side, k), cells(modulo(side, m) + 1, k))
                    b = max(cells(side, k), cells(modulo(side, m) + 1, k))
                    if (a == b) cycle
                    if (pass == 2) other(start(a + 1) + 1) = b
                    start(a + pass_shift(pass)) = start(a + pass_shift(pass)) + 1
                end do
            end do
            if (pass == 1) then
                do k = 2, size(start)
                    start(k) = start(k) + start(k - 1)
                end do
            end if
        end do
        do pass = 1, 2                                          ! count, then write
            n = 0
            do a = 1, int(size(types), c_int32_t)
                if (types(a) == 0) cycle
                do k = start(a) + 1, start(a + 1)
                    b = other(k)
                    if (types(b) == 0) cycle
                    if (count(other(start(a) + 1:start(a + 1)) == b) /= 1) cycle
                    n = n + 1
                    if (pass == 1) cycle
                    faces(:, n) = [a, b]
                    markers(n) = max(types(a), types(b))
                end do
            end do
            if (pass == 1) allocate(faces(2, n), markers(n))
        end do

    contains
        pure integer function pass_shift(pass)                  ! counts of a lie at a + 2, then its next place at a + 1
            integer, intent(in) :: pass
            pass_shift = 3 - pass
        end function
    end subroutine

