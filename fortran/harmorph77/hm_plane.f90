
! ---- Three-dimensional codes with meshes one cell thick --------------------------------------------------------------

! W keeps the plane and the mesh of the plane as arrays of the mesh.
subroutine hmplan(w, np, x, y, z, inc, nf, npf, faces, ns, sides, marks, kind, axis, nplane, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: np, inc, nf, npf, faces(*), ns, sides(*), marks(*), kind
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(in), target :: x(*), y(*), z(*)
    real(c_double), intent(in) :: axis(6)
    integer, intent(out) :: nplane, ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(hm_c_space_mesh) :: space
    type(hm_c_mesh) :: mesh
    type(c_ptr) :: place
    integer(c_int32_t), pointer :: start(:)
    integer :: k
    type(hm_c_memory) :: memory
    integer(c_int64_t) :: top
    nplane = 0
    call this%open(w)
    call this%refuse_if(npf /= 3 .and. npf /= 4, "NPF must be 3 or 4; triangles of 4 points repeat their last point")
    space = hm_c_space_mesh(index_base=1, n_points=short(np), points=space_points_of(x, y, z, inc), kind=short(kind), &
        n_faces=short(nf), n_sides=short(ns), axis_point=axis(:3), axis=axis(4:))
    space%struct_size = int(c_sizeof(space), c_int64_t)
    if (this%ok()) then
        call forget_curves(this%kept)
        this%top = this%kept%words
    end if
    call this%list(faces, npf * nf, space%face_points)
    call this%list(sides, 4 * ns, space%side_points)
    call this%list(marks, ns, space%side_markers)
    if (this%ok() .and. npf == 3) then
        call this%room(4_c_size_t * (nf + 1), place)
        if (this%ok()) then
            call c_f_pointer(place, start, [nf + 1])
            start = [(short(3 * k + 1), k = 0, nf)]
        end if
        space%face_start = place
    end if
    if (this%ok()) call this%told(hm_c_plane_init(this%kept%plane, memory, space, this%e))
    if (this%fits(words_of(memory%bytes), own_words(this))) then
        top = this%top                          ! the copies stay until this call ends
        call keep_mesh(this, hm_c_mesh(), words_of(memory%bytes))
        this%kept%mesh_end = own_words(this) + words_of(memory%bytes)
        call forget_curves(this%kept)
        this%top = top
    end if
    memory%block = this%at(own_words(this) + 1)
    if (this%ok()) call this%told(hm_c_plane_init(this%kept%plane, memory, space, this%e))
    mesh%struct_size = int(c_sizeof(mesh), c_int64_t)
    if (this%ok()) call this%told(hm_c_plane_mesh(this%kept%plane, mesh, this%e))
    if (this%ok()) then
        this%kept%mesh = mesh
        nplane = int(mesh%n_points)
    end if
    call this%finish(ierr, msg)
end subroutine

subroutine hmpfol(w, nmax, ifol, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: nmax
    real(c_double), intent(inout), target :: w(*)
    integer, intent(inout) :: ifol(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(hm_c_plane_info) :: info
    integer(c_int32_t), pointer :: follows(:)
    info%struct_size = int(c_sizeof(info), c_int64_t)
    call open_plane(this, w)
    if (this%ok()) call this%told(hm_c_plane_info_get(this%kept%plane, info, this%e))
    call this%refuse_if(info%n_space_points > nmax, "IFOL is too small: IFOL needs room for NP numbers")
    if (this%ok()) then
        call c_f_pointer(info%follows, follows, [info%n_space_points])
        ifol(:info%n_space_points) = int(follows)
    end if
    call this%finish(ierr, msg)
end subroutine

subroutine hmpmrf(w, dp, x, y, z, inc, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: inc
    real(c_double), intent(inout), target :: w(*), x(*), y(*), z(*)
    real(c_double), intent(in) :: dp(2, *)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(hm_c_space_points), target :: points
    points = space_points_of(x, y, z, inc)
    call open_plane(this, w)
    call this%open_solved(w)
    if (this%ok()) call this%told(hm_c_plane_morph(this%kept%plane, this%kept%basis, dp, c_loc(points), points, &
        c_null_ptr, this%e))
    call this%finish(ierr, msg)
end subroutine

subroutine hmpadj(w, gx, gy, gz, inc, g, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: inc
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(in), target :: gx(*), gy(*), gz(*)
    real(c_double), intent(inout) :: g(2, *)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    call open_plane(this, w)
    call this%open_solved(w)
    if (this%ok()) call this%told(hm_c_plane_adjoint(this%kept%plane, this%kept%basis, &
        space_points_of(gx, gy, gz, inc), g, c_null_ptr, this%e))
    call this%finish(ierr, msg)
end subroutine

subroutine hmpspr(w, dx, dy, x, y, z, inc, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: inc
    real(c_double), intent(inout), target :: w(*), x(*), y(*), z(*)
    real(c_double), intent(in), target :: dx(*), dy(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(hm_c_space_points), target :: points
    points = space_points_of(x, y, z, inc)
    call open_plane(this, w)
    if (this%ok()) call this%told(hm_c_plane_spread(this%kept%plane, points_of(dx, dy, 1), c_loc(points), points, &
        c_null_ptr, this%e))
    call this%finish(ierr, msg)
end subroutine

subroutine hmpgat(w, gx, gy, gz, inc, px, py, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: inc
    real(c_double), intent(inout), target :: w(*), px(*), py(*)
    real(c_double), intent(in), target :: gx(*), gy(*), gz(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    call open_plane(this, w)
    if (this%ok()) call this%told(hm_c_plane_gather(this%kept%plane, space_points_of(gx, gy, gz, inc), &
        points_of(px, py, 1), c_null_ptr, this%e))
    call this%finish(ierr, msg)
end subroutine
