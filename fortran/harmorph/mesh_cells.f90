
! ---- Cells of a mesh -------------------------------------------------------------------------------------------------

contains
    ! ---- Mesh: cells. Triangles (3,n), quads (4,n), or rows and their start; a further call adds further cells, whose
    ! numbers run on.

!@each integer
    subroutine cells_fixed_@FORM@(self, cells, stat, err)
        class(hm_mesh), intent(inout) :: self
        integer(@KIND@), intent(in) :: cells(:, :)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        integer(c_int32_t), allocatable :: start(:)
        integer :: m, k
        m = size(cells, 1)
        call prepare_to_add(self, done)
        call done%refuse_if(m < 3 .or. m > 4, "cells must be (3,n) or (4,n)")
        if (done%ok()) then
            if (self%arrays%cells%n() == 0 .or. self%arrays%layout == fixed_layout(m)) then
                call add_fixed(self%arrays, m, small(reshape(cells, [size(cells)])), done)
            else
                start = [(int(self%arrays%first + m * k, c_int32_t), k = 0, size(cells, 2))]
                call add_cell_rows(self%arrays, small(reshape(cells, [size(cells)])), start, done)
            end if
        end if
        call done%finish("mesh%cells", stat, err)
    end subroutine

    subroutine cells_rows_@FORM@(self, cells, start, stat, err)
        class(hm_mesh), intent(inout) :: self
        integer(@KIND@), intent(in) :: cells(:), start(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        call prepare_to_add(self, done)
        if (done%ok()) call add_cell_rows(self%arrays, small(cells), small(start), done)
        call done%finish("mesh%cells", stat, err)
    end subroutine

    ! polygons(cells, start): rows as above, of 3 to 1024 points; hanging nodes are corners of the cells beside them.
    subroutine polygons_@FORM@(self, cells, start, stat, err)
        class(hm_mesh), intent(inout) :: self
        integer(@KIND@), intent(in) :: cells(:), start(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        call prepare_to_add(self, done)
        if (done%ok()) call add_cell_rows(self%arrays, small(cells), small(start), done)
        if (done%ok()) self%arrays%layout = hm_cells_polygons
        call done%finish("mesh%polygons", stat, err)
    end subroutine

    ! blocks(sizes(2,n) [, markers(4,n)]): ni, nj of structured blocks whose points follow each other; markers of the
    ! sides i=1, i=ni, j=1, j=nj of each block, or hm_no_marker. Interfaces have equal coordinates on both sides.
    subroutine blocks_@FORM@(self, sizes, markers, stat, err)
        class(hm_mesh), intent(inout) :: self
        integer(@KIND@), intent(in) :: sizes(:, :)
        integer(@KIND@), intent(in), optional :: markers(:, :)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        call prepare_to_add(self, done)
        call done%refuse_if(size(sizes, 1) /= 2, "sizes must be (2,n)")
        if (present(markers)) call done%refuse_if(size(markers, 1) /= 4 .or. size(markers, 2) /= size(sizes, 2), &
            "markers must be (4,n), as many as there are blocks")
        if (done%ok()) call done%refuse_if(self%arrays%cells%n() > 0 .or. self%arrays%block_sizes%n() > 0, &
            "the mesh has cells already")
        if (done%ok()) then
            call self%arrays%block_sizes%append(small(reshape(sizes, [size(sizes)])), done)
            if (present(markers)) call self%arrays%block_markers%append(small(reshape(markers, [size(markers)])), done)
            self%arrays%layout = hm_cells_blocks
        end if
        call done%finish("mesh%blocks", stat, err)
    end subroutine

!@end
    pure integer function fixed_layout(m)
        integer, intent(in) :: m
        fixed_layout = merge(hm_cells_triangles, hm_cells_quads, m == 3)
    end function

    subroutine add_fixed(arrays, m, points, done)
        type(mesh_arrays), intent(inout) :: arrays
        integer, intent(in) :: m
        integer(c_int32_t), intent(in) :: points(:)
        type(outcome), intent(inout) :: done
        call done%refuse_if(has_blocks(arrays), "a block has no list of cells")
        call arrays%cells%append(points, done)
        if (done%ok()) arrays%layout = fixed_layout(m)
    end subroutine

    ! Cells of different kinds: what there is becomes rows, the new ones follow.
    subroutine add_cell_rows(arrays, points, start, done)
        type(mesh_arrays), intent(inout) :: arrays
        integer(c_int32_t), intent(in) :: points(:), start(:)
        type(outcome), intent(inout) :: done
        integer :: k, m
        call done%refuse_if(has_blocks(arrays), "a block has no list of cells")
        call check_rows("cells", arrays%first, size(points), start, done)
        if (done%ok() .and. arrays%cells%n() > 0 .and. .not. has_rows(arrays)) then
            m = merge(3, 4, arrays%layout == hm_cells_triangles)
            call arrays%cell_start%append([(int(arrays%first + m * k, c_int32_t), k = 0, n_cells_of(arrays))], done)
        end if
        if (done%ok() .and. .not. has_rows(arrays)) arrays%layout = hm_cells_rows
        call add_rows(arrays%first, arrays%cells, arrays%cell_start, points, start, done)
    end subroutine

    pure logical function has_rows(arrays)
        type(mesh_arrays), intent(in) :: arrays
        has_rows = arrays%layout == hm_cells_rows .or. arrays%layout == hm_cells_polygons
    end function

    pure logical function has_blocks(arrays)
        type(mesh_arrays), intent(in) :: arrays
        has_blocks = arrays%layout == hm_cells_structured .or. arrays%layout == hm_cells_blocks
    end function

    pure integer function n_cells_of(arrays)
        type(mesh_arrays), intent(in) :: arrays
        select case (arrays%layout)
        case (hm_cells_triangles)
            n_cells_of = arrays%cells%n() / 3
        case (hm_cells_quads)
            n_cells_of = arrays%cells%n() / 4
        case (hm_cells_rows, hm_cells_polygons)
            n_cells_of = max(arrays%cell_start%n() - 1, 0)
        case default
            n_cells_of = 0
        end select
    end function

    ! ---- Rows, of cells or lists, that begin where start says

    subroutine check_rows(name, first, n, start, done)
        character(len=*), intent(in) :: name
        integer, intent(in) :: first, n
        integer(c_int32_t), intent(in) :: start(:)
        type(outcome), intent(inout) :: done
        character(len=112) :: text
        if (size(start) < 2) then
            call done%refuse(name // ": start must have a number for each row, and one more")
        else if (start(1) /= first) then
            write(text, "(2a, i0)") name, ": start must begin with ", first
            call done%refuse(text)
        else if (any(start(2:) < start(:size(start) - 1))) then
            call done%refuse(name // ": start decreases")
        else if (start(size(start)) - first > n) then
            write(text, "(2a, i0, a, i0)") name, ": start says there are ", start(size(start)) - first, &
                " points, but there are ", n
            call done%refuse(text)
        end if
    end subroutine

    subroutine add_rows(first, points, start, more_points, more_start, done)
        integer, intent(in) :: first
        type(integers), intent(inout) :: points, start
        integer(c_int32_t), intent(in) :: more_points(:), more_start(:)
        type(outcome), intent(inout) :: done
        integer(c_int32_t) :: before
        if (done%status < 0) return
        before = int(points%n(), c_int32_t)
        if (start%n() == 0) call start%append([int(first, c_int32_t)], done)
        call points%append(more_points(:more_start(size(more_start)) - first), done)
        call start%append(more_start(2:) + before, done)
    end subroutine

