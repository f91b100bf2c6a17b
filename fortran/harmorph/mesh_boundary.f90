
! ---- The boundary of a mesh: faces with their markers, lists of points, or lines of a block --------------------------

contains
    ! ---- Mesh: boundary. Further calls add further faces, lists and lines.

!@each integer
    ! faces(points(2,n), markers(n)): in any order and direction.
    subroutine faces_@FORM@(self, points, markers, stat, err)
        class(hm_mesh), intent(inout) :: self
        integer(@KIND@), intent(in) :: points(:, :), markers(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        call prepare_to_add(self, done)
        call done%refuse_if(size(points, 1) /= 2 .or. size(points, 2) /= size(markers), &
            "faces wants points(2,n), markers(n)")
        if (done%ok()) then
            call self%arrays%face_points%append(small(reshape(points, [size(points)])), done)
            call self%arrays%face_markers%append(small(markers), done)
        end if
        call done%finish("mesh%faces", stat, err)
    end subroutine

    ! lists(points, start(n+1), markers(n)): points in order along the boundary; a closed list repeats its first point.
    subroutine lists_@FORM@(self, points, start, markers, stat, err)
        class(hm_mesh), intent(inout) :: self
        integer(@KIND@), intent(in) :: points(:), start(:), markers(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        call prepare_to_add(self, done)
        call done%refuse_if(size(start) /= size(markers) + 1, "lists wants start(n+1), markers(n)")
        if (done%ok()) then
            call check_rows("lists", self%arrays%first, size(points), small(start), done)
            call add_lists(self%arrays, small(points), small(start), small(markers), done)
        end if
        call done%finish("mesh%lists", stat, err)
    end subroutine

!@end
    subroutine add_lists(arrays, points, start, markers, done)
        type(mesh_arrays), intent(inout) :: arrays
        integer(c_int32_t), intent(in) :: points(:), start(:), markers(:)
        type(outcome), intent(inout) :: done
        call add_rows(arrays%first, arrays%list_points, arrays%list_start, points, start, done)
        call arrays%list_markers%append(markers, done)
    end subroutine

    ! Points (i_from,j_from) .. (i_to,j_to) along i or j of a structured block, on a marker. block: which of several.
    subroutine mesh_line(self, marker, i_from, i_to, j_from, j_to, block, stat, err)
        class(hm_mesh), intent(inout) :: self
        integer, intent(in) :: marker, i_from, i_to, j_from, j_to
        integer, intent(in), optional :: block
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        integer :: n, i_step, j_step, k, ni, nj, first, before, its_block
        integer(c_int32_t), allocatable :: line(:)
        call prepare_to_add(self, done)
        ni = 0
        nj = 0
        first = 1
        before = 0                                              ! points of the blocks before
        its_block = 1
        if (present(block)) its_block = block
        if (done%ok()) then
            ni = self%arrays%ni
            nj = self%arrays%nj
            first = self%arrays%first
            call done%refuse_if(.not. has_blocks(self%arrays), "the mesh has no structured points")
            call done%refuse_if(its_block < 1 .or. its_block > max(self%arrays%block_sizes%n() / 2, 1), &
                "there is no block of this number")
        end if
        if (done%ok() .and. self%arrays%block_sizes%n() > 0) then
            ni = int(self%arrays%block_sizes%at(2 * its_block - 1))
            nj = int(self%arrays%block_sizes%at(2 * its_block))
            do k = 1, its_block - 1
                before = before + int(self%arrays%block_sizes%at(2 * k - 1) * self%arrays%block_sizes%at(2 * k))
            end do
        end if
        if (done%ok()) then
            call done%refuse_if(i_from /= i_to .and. j_from /= j_to, "neither i nor j stays the same")
            call done%refuse_if(min(i_from, i_to) < 1 .or. max(i_from, i_to) > ni .or. min(j_from, j_to) < 1 .or. &
                max(j_from, j_to) > nj, "i or j is outside the block")
        end if
        if (done%ok()) then
            n = max(abs(i_to - i_from), abs(j_to - j_from)) + 1
            i_step = sign(merge(1, 0, i_to /= i_from), i_to - i_from)
            j_step = sign(merge(1, 0, j_to /= j_from), j_to - j_from)
            line = [(int(first + before + i_from - 1 + k * i_step + ni * (j_from - 1 + k * j_step), c_int32_t), &
                k = 0, n - 1)]
            call add_lists(self%arrays, line, int([first, first + n], c_int32_t), [int(marker, c_int32_t)], done)
        end if
        call done%finish("mesh%line", stat, err)
    end subroutine

