
! ---- Meshes of three dimensions that are one cell thick: the mesh of one symmetry plane, and what follows it ---------

    type, public :: hm_plane_info
        integer :: kind = hm_planes                             ! or hm_wedge
        integer :: points = 0, space_points = 0                 ! of the plane's mesh; of the mesh of three dimensions
        integer :: layers = 0                                   ! most points that follow one of the plane, itself too
        real(c_double) :: origin(3) = 0, x_direction(3) = 0, y_direction(3) = 0, normal(3) = 0
        real(c_double) :: max_distance = 0                      ! of a point from the place of its plane point
        integer :: max_distance_point = -1
        integer, allocatable :: follows(:)                      ! the plane point that each point follows
        integer, allocatable :: space_point(:)                  ! the point of the faces that is each plane point
    end type

    type, public :: hm_plane
        private
        type(c_ptr) :: handle = c_null_ptr
        type(block_of_memory) :: memory
        integer :: first = 1
        integer(c_int64_t) :: space_points = 0, plane_points = 0
        real(c_double), pointer :: given(:, :) => null()        ! (n,3): coordinates, up to find
        type(integers) :: given_faces, given_sides, given_markers
    contains
!@each space
        procedure, private :: plane_points_@FORM@, plane_morph_@FORM@, plane_displacement_@FORM@, &
            plane_adjoint_@FORM@, plane_spread_@FORM@, plane_gather_@FORM@
        generic :: points => plane_points_@FORM@
        generic :: morph => plane_morph_@FORM@
        generic :: displacement => plane_displacement_@FORM@
        generic :: velocity => plane_displacement_@FORM@
        generic :: adjoint => plane_adjoint_@FORM@
        generic :: spread => plane_spread_@FORM@
        generic :: gather => plane_gather_@FORM@
!@end
!@each integer
        procedure, private :: plane_faces_@FORM@, plane_sides_@FORM@
        generic :: faces => plane_faces_@FORM@
        generic :: sides => plane_sides_@FORM@
!@end
        procedure :: find => plane_find
        procedure :: mesh => plane_mesh
        procedure :: info => plane_info
        procedure :: free => plane_free
        procedure, private :: plane_assign
        generic :: assignment(=) => plane_assign
        final :: plane_final
    end type

contains
    ! ---- Plane: input

!@each space
    ! points(x, y, z [, first]): begins a plane; what the variable had before is forgotten. The coordinates are copied.
    subroutine plane_points_@FORM@(self, x, y, z, first, stat, err)
        class(hm_plane), intent(inout) :: self
        real(@KIND@), intent(in) :: x@SHAPE@, y@SHAPE@, z@SHAPE@
        integer, intent(in), optional :: first
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        integer(c_int64_t) :: n
        integer :: failed
        call done%check_version()
        n = size(x, kind=c_int64_t)
        call done%refuse_if(any(shape(x) /= shape(y)) .or. any(shape(x) /= shape(z)), &
            "x, y and z have different shapes")
        call done%refuse_if(n > huge(0_c_int32_t), "there are more than 2^31-1 points")
        if (present(first)) call done%refuse_if(first /= 0 .and. first /= 1, "first must be 0 or 1")
        if (done%ok()) then
            call self%free()
            allocate(self%given(n, 3), stat=failed)
            call done%refuse_if(failed /= 0, "no memory for a copy of the coordinates")
        end if
        if (done%ok()) then
            if (present(first)) self%first = first
            self%space_points = n
            self%given(:, 1) = real(reshape(x, [n]), c_double)
            self%given(:, 2) = real(reshape(y, [n]), c_double)
            self%given(:, 3) = real(reshape(z, [n]), c_double)
        end if
        call done%finish("plane%points", stat, err)
    end subroutine

!@end
!@each integer
    ! faces(points(3,n)) or faces(points(4,n)) of one symmetry plane: the cells of the plane's mesh. Of four points, a
    ! triangle repeats its last. A further call adds further faces.
    subroutine plane_faces_@FORM@(self, points, stat, err)
        class(hm_plane), intent(inout) :: self
        integer(@KIND@), intent(in) :: points(:, :)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        integer(c_int32_t), allocatable :: four(:, :)
        integer :: m
        m = size(points, 1)
        call need_space(self, done)
        call done%refuse_if(m < 3 .or. m > 4, "faces must be (3,n) or (4,n)")
        if (done%ok()) then
            allocate(four(4, size(points, 2)))
            four(:m, :) = small(points)
            four(4, :) = small(points(m, :))
            call self%given_faces%append(reshape(four, [size(four)]), done)
        end if
        call done%finish("plane%faces", stat, err)
    end subroutine

    ! sides(points(4,n), markers(n)): faces of the boundary from one layer to the next. A further call adds
    ! further ones.
    subroutine plane_sides_@FORM@(self, points, markers, stat, err)
        class(hm_plane), intent(inout) :: self
        integer(@KIND@), intent(in) :: points(:, :), markers(:)
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        call need_space(self, done)
        call done%refuse_if(size(points, 1) /= 4 .or. size(points, 2) /= size(markers), &
            "sides wants points(4,n), markers(n)")
        if (done%ok()) then
            call self%given_sides%append(small(reshape(points, [size(points)])), done)
            call self%given_markers%append(small(markers), done)
        end if
        call done%finish("plane%sides", stat, err)
    end subroutine

!@end
    subroutine need_space(self, done)
        class(hm_plane), intent(in) :: self
        type(outcome), intent(inout) :: done
        call done%refuse_if(.not. associated(self%given), "the plane has no points yet: points comes first")
    end subroutine

    subroutine need_plane(self, done)
        class(hm_plane), intent(in) :: self
        type(outcome), intent(inout) :: done
        call done%refuse_if(.not. c_associated(self%handle), "the plane has not been found yet: find comes first")
    end subroutine

    ! find([kind, axis_point, axis, tolerance]): the plane's mesh, and who follows whom. kind: hm_space_auto, hm_planes
    ! or hm_wedge, whose axis may be given by a point and a direction.
    subroutine plane_find(self, kind, axis_point, axis, tolerance, stat, err)
        class(hm_plane), intent(inout) :: self
        integer, intent(in), optional :: kind
        real(c_double), intent(in), optional :: axis_point(3), axis(3), tolerance
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(hm_c_space_mesh) :: space
        type(hm_c_plane_info) :: info
        integer(c_size_t) :: bytes
        call need_space(self, done)
        if (done%ok()) then
            space%struct_size = int(c_sizeof(space), c_int64_t)
            space%index_base = int(self%first, c_int32_t)
            space%n_points = int(self%space_points, c_int32_t)
            space%points = hm_c_space_points(c_loc(self%given(1, 1)), c_loc(self%given(1, 2)), &
                c_loc(self%given(1, 3)), 1_c_int64_t)
            if (present(kind)) space%kind = int(kind, c_int32_t)
            space%n_faces = int(self%given_faces%n() / 4, c_int32_t)
            space%face_points = self%given_faces%address()
            space%n_sides = int(self%given_markers%n(), c_int32_t)
            space%side_points = self%given_sides%address()
            space%side_markers = self%given_markers%address()
            if (present(axis_point)) space%axis_point = axis_point
            if (present(axis)) space%axis = axis
            if (present(tolerance)) space%tolerance = tolerance
            done%status = hm_c_plane_size(space, bytes, done%error)
        end if
        call self%memory%take(bytes, done=done)
        if (done%ok()) done%status = hm_c_plane_init(self%handle, self%memory%start, self%memory%bytes, space, &
            done%error)
        if (done%ok()) then
            info%struct_size = int(c_sizeof(info), c_int64_t)
            done%status = hm_c_plane_info_get(self%handle, info, done%error)
            self%plane_points = info%n_points
            deallocate(self%given)
            nullify(self%given)
        else
            call self%memory%give_back()
            self%handle = c_null_ptr
        end if
        call done%finish("plane%find", stat, err)
    end subroutine

    ! ---- Plane: output

    ! mesh(mesh): the mesh of the plane, with the coordinates in the plane's block, so that the plane must outlive mesh.
    ! The boundary is that of sides; faces, lists or point_types of the mesh may add to it.
    subroutine plane_mesh(self, mesh, stat, err)
        class(hm_plane), intent(in) :: self
        type(hm_mesh), intent(inout) :: mesh
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(hm_c_mesh) :: c
        real(c_double), pointer :: x(:), y(:)
        integer(c_int32_t), pointer :: points(:), start(:), markers(:)
        call need_plane(self, done)
        c%struct_size = int(c_sizeof(c), c_int64_t)
        if (done%ok()) done%status = hm_c_plane_mesh(self%handle, c, done%error)
        if (done%ok()) then
            call c_f_pointer(c%points%x, x, [c%n_points])
            call c_f_pointer(c%points%y, y, [c%n_points])
            call mesh%points(x, y, first=self%first)
            call c_f_pointer(c%cell_start, start, [c%n_cells + 1])
            call c_f_pointer(c%cell_points, points, [start(c%n_cells + 1) - c%index_base])
            if (c%cell_layout == hm_cells_polygons) then
                call mesh%polygons(points, start)
            else
                call mesh%cells(points, start)
            end if
            call c_f_pointer(c%face_points, points, [2 * c%n_faces])
            call c_f_pointer(c%face_markers, markers, [c%n_faces])
            if (c%n_faces > 0) call mesh%faces(reshape(points, [2, int(c%n_faces)]), markers)
        end if
        call done%finish("plane%mesh", stat, err)
    end subroutine

    subroutine plane_info(self, info, stat, err)
        class(hm_plane), intent(in) :: self
        type(hm_plane_info), intent(out) :: info
        integer, intent(out), optional :: stat
        type(hm_error), intent(out), optional :: err
        type(outcome) :: done
        type(hm_c_plane_info) :: c
        integer(c_int32_t), pointer :: numbers(:)
        call need_plane(self, done)
        c%struct_size = int(c_sizeof(c), c_int64_t)
        if (done%ok()) done%status = hm_c_plane_info_get(self%handle, c, done%error)
        if (done%ok()) then
            info%kind = int(c%kind)
            info%points = int(c%n_points)
            info%space_points = int(c%n_space_points)
            info%layers = int(c%layers)
            info%origin = c%origin
            info%x_direction = c%x_direction
            info%y_direction = c%y_direction
            info%normal = c%normal
            info%max_distance = c%max_distance
            info%max_distance_point = int(c%max_distance_point)
            call c_f_pointer(c%follows, numbers, [c%n_space_points])
            info%follows = int(numbers)
            call c_f_pointer(c%space_point, numbers, [c%n_points])
            info%space_point = int(numbers)
        end if
        call done%finish("plane%info", stat, err)
    end subroutine

    subroutine plane_free(self)
        class(hm_plane), intent(inout) :: self
        if (associated(self%given)) deallocate(self%given)
        nullify(self%given)
        call self%memory%give_back()
        self%handle = c_null_ptr
        self%space_points = 0
        self%plane_points = 0
        self%first = 1
        if (allocated(self%given_faces%at)) deallocate(self%given_faces%at)
        if (allocated(self%given_sides%at)) deallocate(self%given_sides%at)
        if (allocated(self%given_markers%at)) deallocate(self%given_markers%at)
    end subroutine

    subroutine plane_final(self)
        type(hm_plane), intent(inout) :: self
        call self%free()
    end subroutine

    subroutine plane_assign(self, other)
        class(hm_plane), intent(inout) :: self
        type(hm_plane), intent(in) :: other
        if (c_associated(self%handle) .or. c_associated(other%handle)) continue
        error stop "harmorph: a plane cannot be assigned: its block would have two owners"
    end subroutine
