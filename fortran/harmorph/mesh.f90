
! ---- The caller's mesh: where the coordinates lie, and copies of everything else -------------------------------------

    type :: mesh_arrays                                         ! what a mesh shares with the plans made of it
        integer :: owners = 1
        integer :: first = 1                                    ! what the caller's points and cells count from
        type(array_place) :: coordinates
        type(array_place), allocatable :: block_places(:)       ! of each block, where they are given by add_block
        real(c_double), allocatable :: copy(:, :)               ! (n,2) where the library cannot use them as they lie
        integer :: layout = hm_cells_rows, ni = 0, nj = 0
        type(integers) :: cells, cell_start, face_points, face_markers, list_points, list_start, list_markers
        type(integers) :: block_sizes, block_markers
    end type

    type, public :: hm_mesh
        type(mesh_arrays), pointer, private :: arrays => null()
    contains
!@each form
        procedure, private :: points_@FORM@
        generic :: points => points_@FORM@
!@end
        procedure :: points_at => mesh_points_at
        procedure :: structured => mesh_structured
!@each integer
        procedure, private :: cells_fixed_@FORM@, cells_rows_@FORM@, faces_@FORM@, lists_@FORM@, point_types_@FORM@, &
            blocks_@FORM@, polygons_@FORM@
        generic :: cells => cells_fixed_@FORM@, cells_rows_@FORM@
        generic :: faces => faces_@FORM@
        generic :: lists => lists_@FORM@
        generic :: blocks => blocks_@FORM@
        generic :: polygons => polygons_@FORM@
        generic :: point_types => point_types_@FORM@
!@end
!@each block
        procedure, private :: add_block_@FORM@, gather_@FORM@, scatter_@FORM@
        generic :: add_block => add_block_@FORM@
        generic :: gather => gather_@FORM@
        generic :: scatter => scatter_@FORM@
!@end
        procedure :: line => mesh_line
        procedure :: free => mesh_free
        procedure, private :: mesh_assign
        generic :: assignment(=) => mesh_assign
        final :: mesh_final
    end type

contains
    ! ---- Mesh: points

!@each form
    ! points(x, y [, first]): begins a mesh; what the variable had before is forgotten. first: 1, or 0 where the
    ! caller's points and cells count from 0, in arrays and reports.
    subroutine points_@FORM@(self, x, y, first, stat, err)
        class(hm_mesh), intent(inout) :: self
        real(@KIND@), pointer, intent(in) :: x@SHAPE@, y@SHAPE@
        integer, intent(in), optional :: first
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call take_points(self, "points", place_of(x, y), first, stat, err)
    end subroutine

!@end
    ! The same by addresses: points_at(c_loc(node(1)%x), c_loc(node(1)%y), bytes from node to node, number of nodes).
    ! precision: hm_single where the coordinates are real(c_float).
    subroutine mesh_points_at(self, x, y, bytes, n, precision, first, stat, err)
        class(hm_mesh), intent(inout) :: self
        type(c_ptr), intent(in) :: x, y
        integer, intent(in) :: bytes, n
        integer, intent(in), optional :: precision, first
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        call take_points(self, "points_at", place_at(x, y, bytes, n, precision), first, stat, err)
    end subroutine

    subroutine take_points(self, call, place, first, stat, err)
        class(hm_mesh), intent(inout) :: self
        character(len=*), intent(in) :: call
        type(array_place), intent(in) :: place
        integer, intent(in), optional :: first
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(mesh_arrays), pointer :: fresh
        integer :: failed
        call done%refuse_if(place%wrong /= "", place%wrong)
        call done%refuse_if(place%n() > huge(0_c_int32_t), "there are more than 2^31-1 points")
        if (present(first)) call done%refuse_if(first /= 0 .and. first /= 1, "first must be 0 or 1")
        if (done%ok()) then
            allocate(fresh)
            fresh%coordinates = place
            if (present(first)) fresh%first = first
            if (place%block) then
                fresh%layout = hm_cells_structured
                fresh%ni = place%extents(1)
                fresh%nj = place%extents(2)
            end if
            failed = 0
            if (place%stride() == 0) allocate(fresh%copy(place%n(), 2), stat=failed)
            if (failed /= 0) then
                deallocate(fresh)
                call done%refuse("no memory for a copy of the coordinates", hm_block_too_small, &
                    16._c_double * place%n())
            else
                call release(self%arrays)
                self%arrays => fresh
            end if
        end if
        call done%finish("mesh%" // call, stat, err)
    end subroutine

    ! Points that are those of a block: (i,j) is i + ni*(j-1). points(x(:,:), y(:,:)) does it by itself.
    subroutine mesh_structured(self, ni, nj, stat, err)
        class(hm_mesh), intent(inout) :: self
        integer, intent(in) :: ni, nj
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        call prepare_to_add(self, done)
        if (done%ok()) call done%refuse_if(allocated(self%arrays%cells%at), "the mesh has cells already")
        call done%refuse_if(min(ni, nj) < 2, "ni and nj must be at least 2")
        if (done%ok()) call done%refuse_if(int(ni, c_int64_t) * nj /= self%arrays%coordinates%n(), &
            "the mesh has not ni * nj points")
        if (done%ok()) then
            self%arrays%layout = hm_cells_structured
            self%arrays%ni = ni
            self%arrays%nj = nj
        end if
        call done%finish("mesh%structured", stat, err)
    end subroutine

    ! ---- Mesh: as a whole

    ! Points come first. Arrays that a plan uses, too, stay as they are: the mesh goes on with a copy.
    subroutine prepare_to_add(self, done)
        class(hm_mesh), intent(inout) :: self
        type(outcome), intent(inout) :: done
        type(mesh_arrays), pointer :: own
        if (.not. associated(self%arrays)) then
            call done%refuse("the mesh has no points yet: points comes first")
        else if (self%arrays%owners > 1) then
            allocate(own)
            own = self%arrays
            own%owners = 1
            call release(self%arrays)
            self%arrays => own
        end if
    end subroutine

    ! The mesh as the library sees it, with coordinates as they are now.
    function c_mesh_of(mesh) result(c)
        class(hm_mesh), intent(in) :: mesh
        type(hm_c_mesh) :: c
        c = c_mesh_of_arrays(mesh%arrays)
    end function

    function c_mesh_of_arrays(arrays) result(c)
        type(mesh_arrays), pointer, intent(in) :: arrays
        type(hm_c_mesh) :: c
        c%struct_size = int(c_sizeof(c), c_int64_t)
        c%index_base = 1
        if (.not. associated(arrays)) return
        call read_again(arrays)
        c%index_base = int(arrays%first, c_int32_t)
        c%n_points = int(arrays%coordinates%n(), c_int32_t)
        if (allocated(arrays%copy)) then
            c%points%x = c_loc(arrays%copy(1, 1))
            c%points%y = c_loc(arrays%copy(1, 2))
            c%points%stride = 1
        else
            c%points%x = arrays%coordinates%x
            c%points%y = arrays%coordinates%y
            c%points%stride = arrays%coordinates%stride()
        end if
        c%cell_layout = int(arrays%layout, c_int32_t)
        c%ni = int(arrays%ni, c_int32_t)
        c%nj = int(arrays%nj, c_int32_t)
        c%n_cells = int(n_cells_of(arrays), c_int32_t)
        c%cell_start = arrays%cell_start%address()
        c%cell_points = arrays%cells%address()
        c%face_points = arrays%face_points%address()
        c%face_markers = arrays%face_markers%address()
        c%n_blocks = int(arrays%block_sizes%n() / 2, c_int32_t)
        c%block_sizes = arrays%block_sizes%address()
        c%block_markers = arrays%block_markers%address()
        c%n_faces = int(arrays%face_markers%n(), c_int32_t)
        c%list_points = arrays%list_points%address()
        c%list_start = arrays%list_start%address()
        c%list_markers = arrays%list_markers%address()
        c%n_lists = int(arrays%list_markers%n(), c_int32_t)
    end function

    ! Coordinates that had to be converted, or lie at distances that the library does not take, as they are now.
    subroutine read_again(arrays)
        type(mesh_arrays), pointer, intent(in) :: arrays
        integer(c_int64_t) :: first, last
        integer :: k
        if (.not. allocated(arrays%block_places)) then
            if (allocated(arrays%copy)) call arrays%coordinates%read(arrays%copy)
            return
        end if
        last = 0
        do k = 1, size(arrays%block_places)
            first = last + 1
            last = last + arrays%block_places(k)%n()
            call arrays%block_places(k)%read(arrays%copy(first:last, :))
        end do
    end subroutine

    ! The arrays for another owner.
    function shared(mesh) result(arrays)
        class(hm_mesh), intent(in) :: mesh
        type(mesh_arrays), pointer :: arrays
        arrays => mesh%arrays
        if (associated(arrays)) arrays%owners = arrays%owners + 1
    end function

    ! One owner less.
    subroutine release(arrays)
        type(mesh_arrays), pointer, intent(inout) :: arrays
        if (associated(arrays)) then
            arrays%owners = arrays%owners - 1
            if (arrays%owners == 0) deallocate(arrays)
        end if
        nullify(arrays)
    end subroutine

    subroutine mesh_free(self)
        class(hm_mesh), intent(inout) :: self
        call release(self%arrays)
    end subroutine

    impure elemental subroutine mesh_final(self)
        type(hm_mesh), intent(inout) :: self
        call release(self%arrays)
    end subroutine

    subroutine mesh_assign(to, from)
        class(hm_mesh), intent(inout) :: to
        type(hm_mesh), intent(in) :: from
        if (associated(to%arrays) .or. associated(from%arrays) .or. .true.) &
            error stop "harmorph: a mesh cannot be assigned"
    end subroutine

