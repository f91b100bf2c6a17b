
! ---- Structured blocks in arrays of their own ------------------------------------------------------------------------

contains
!@each block
    ! add_block(x, y [, markers(4)]): one more block of arrays x(ni,nj), y(ni,nj), which are not copied; markers of its
    ! sides i=1, i=ni, j=1, j=nj, or hm_no_marker, as all sides are without markers. Instead of points and blocks. All
    ! calls with points of the mesh have the blocks one after the other, in the order of add_block.
    subroutine add_block_@FORM@(self, x, y, markers, stat, err)
        class(hm_mesh), intent(inout) :: self
        real(@KIND@), pointer, intent(in) :: x(:, :), y(:, :)
        integer, intent(in), optional :: markers(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        call take_block(self, place_of(x, y), markers, done)
        call done%finish("mesh%add_block", stat, err)
    end subroutine

    ! gather(block, x, y, all_x, all_y): numbers of one block (from 1), as derivatives, to their places among those of
    ! all points. The others stay.
    subroutine gather_@FORM@(self, block, x, y, all_x, all_y, stat, err)
        class(hm_mesh), intent(in) :: self
        integer, intent(in) :: block
        real(@KIND@), intent(in) :: x(:, :), y(:, :)
        real(@KIND@), intent(inout) :: all_x(:), all_y(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        integer :: first, last
        call range_of_block(self, block, shape(x), shape(y), [size(all_x), size(all_y)], first, last, done)
        if (done%ok()) then
            all_x(first:last) = reshape(x, [size(x)])
            all_y(first:last) = reshape(y, [size(y)])
        end if
        call done%finish("mesh%gather", stat, err)
    end subroutine

    ! scatter(block, all_x, all_y, x, y): the way back, of displacements, velocities, coordinates.
    subroutine scatter_@FORM@(self, block, all_x, all_y, x, y, stat, err)
        class(hm_mesh), intent(in) :: self
        integer, intent(in) :: block
        real(@KIND@), intent(in) :: all_x(:), all_y(:)
        real(@KIND@), intent(inout) :: x(:, :), y(:, :)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        integer :: first, last
        call range_of_block(self, block, shape(x), shape(y), [size(all_x), size(all_y)], first, last, done)
        if (done%ok()) then
            x = reshape(all_x(first:last), shape(x))
            y = reshape(all_y(first:last), shape(y))
        end if
        call done%finish("mesh%scatter", stat, err)
    end subroutine

!@end
    subroutine take_block(self, place, markers, done)
        class(hm_mesh), intent(inout) :: self
        type(array_place), intent(in) :: place
        integer, intent(in), optional :: markers(:)
        type(outcome), intent(inout) :: done
        type(array_place), allocatable :: grown(:)
        integer(c_int32_t) :: sides(4)
        integer(c_int64_t) :: points
        integer :: n, failed
        sides = hm_no_marker
        call done%refuse_if(place%wrong /= "", place%wrong)
        if (present(markers)) call done%refuse_if(size(markers) /= 4, "markers must be those of the four sides")
        n = 0
        points = place%n()
        if (associated(self%arrays)) then
            call done%refuse_if(.not. allocated(self%arrays%block_places), &
                "the mesh has points already; free() begins a new one")
            if (done%ok()) n = size(self%arrays%block_places)
            if (done%ok()) points = points + self%arrays%coordinates%n()
        end if
        call done%refuse_if(points > huge(0_c_int32_t), "there are more than 2^31-1 points")
        if (.not. done%ok()) return
        if (present(markers)) sides = int(markers, c_int32_t)
        if (associated(self%arrays)) then
            call prepare_to_add(self, done)
        else
            allocate(self%arrays)
        end if
        allocate(grown(n + 1))
        if (n > 0) grown(:n) = self%arrays%block_places
        grown(n + 1) = place
        call move_alloc(grown, self%arrays%block_places)
        self%arrays%layout = hm_cells_blocks
        self%arrays%coordinates%extents = [int(points), 1]
        self%arrays%coordinates%step = -1                       ! nowhere: they are copied from the blocks
        if (allocated(self%arrays%copy)) deallocate(self%arrays%copy)
        allocate(self%arrays%copy(points, 2), stat=failed)
        if (failed /= 0) call done%refuse("no memory for a copy of the coordinates", hm_block_too_small, &
            16._c_double * points)
        call self%arrays%block_sizes%append(int(place%extents, c_int32_t), done)
        call self%arrays%block_markers%append(sides, done)
        if (.not. done%ok()) call release(self%arrays)
    end subroutine

    subroutine range_of_block(self, block, of_x, of_y, of_all, first, last, done)
        class(hm_mesh), intent(in) :: self
        integer, intent(in) :: block, of_x(2), of_y(2), of_all(2)
        integer, intent(out) :: first, last
        type(outcome), intent(inout) :: done
        integer :: k
        first = 1
        last = 0
        if (.not. associated(self%arrays)) then
            call done%refuse("the mesh has no points yet")
            return
        end if
        call done%refuse_if(block < 1 .or. 2 * block > self%arrays%block_sizes%n(), "there is no block of this number")
        if (done%ok()) call done%refuse_if(any(of_x /= self%arrays%block_sizes%at(2 * block - 1:2 * block)) .or. &
            any(of_y /= of_x), "x and y have not the shape of this block")
        call done%refuse_if(any(of_all /= self%arrays%coordinates%n()), &
            "the arrays of all points have not their number")
        if (.not. done%ok()) return
        do k = 1, block
            first = last + 1
            last = last + product(int(self%arrays%block_sizes%at(2 * k - 1:2 * k)))
        end do
    end subroutine

    ! morph_mesh(move, mesh): the mesh's own arrays in place, of whatever kind and wherever they lie: those of points,
    ! or of each block.
    subroutine basis_morph_mesh(self, move, mesh, executor, stat, err)
        class(hm_basis), intent(in) :: self
        real(c_double), intent(in) :: move(:, :)
        class(hm_mesh), intent(in) :: mesh
        type(hm_executor), intent(in), optional :: executor
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(hm_c_mesh) :: c
        type(view) :: from, to
        real(c_double), allocatable, target :: moved(:, :)
        integer(c_int64_t) :: first, last
        integer :: k
        call done%refuse_if(.not. associated(mesh%arrays), "the mesh has no points yet")
        if (done%ok()) then
            c = c_mesh_of(mesh)
            allocate(moved(c%n_points, 2))
            from = view(x=c%points%x, y=c%points%y, stride=c%points%stride, n=int(c%n_points, c_int64_t))
            to = view(x=c_loc(moved(1, 1)), y=c_loc(moved(1, 2)), n=from%n)
            call move_points(self, move, from, to, executor, done)
        end if
        if (done%ok()) then
            if (.not. allocated(mesh%arrays%block_places)) then
                call mesh%arrays%coordinates%write(moved)
            else
                last = 0
                do k = 1, size(mesh%arrays%block_places)
                    first = last + 1
                    last = last + mesh%arrays%block_places(k)%n()
                    call mesh%arrays%block_places(k)%write(moved(first:last, :))
                end do
            end if
        end if
        call done%finish("basis%morph_mesh", stat, err)
    end subroutine
