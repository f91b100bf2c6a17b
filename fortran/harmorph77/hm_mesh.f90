
! ---- The mesh --------------------------------------------------------------------------------------------------------

subroutine hmmesh(w, np, x, y, inc, nc, npc, cells, nf, faces, marks, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: np, inc, nc, npc, nf
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(in), target :: x(*), y(*)
    integer(c_int32_t), intent(in), target :: cells(*), faces(*), marks(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(hm_c_mesh) :: mesh
    call this%open(w)
    call this%refuse_if(npc /= 3 .and. npc /= 4, &
        "NPC must be 3 or 4; triangles among quadrilaterals repeat their last point")
    mesh = hm_c_mesh(n_points=np, points=points_of(x, y, inc), n_cells=nc, n_faces=nf, &
        cell_layout=merge(hm_cells_triangles, hm_cells_quads, npc == 3))
    mesh%cell_points = c_loc(cells)
    mesh%face_points = c_loc(faces)
    mesh%face_markers = c_loc(marks)
    call keep_mesh(this, mesh, 0_c_int64_t)
    call this%finish(ierr, msg)
end subroutine

subroutine hmmixd(w, np, x, y, inc, nt, itri, nq, iquad, nf, faces, marks, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: np, inc, nt, nq, nf
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(in), target :: x(*), y(*)
    integer(c_int32_t), intent(in), target :: itri(*), iquad(*), faces(*), marks(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(hm_c_mesh) :: mesh
    call this%open(w)
    call this%refuse_if(min(nt, nq) < 0, "NT and NQ must be at least 0")
    mesh = hm_c_mesh(n_points=np, points=points_of(x, y, inc), n_cells=nt + nq, n_quads=nq, n_faces=nf, &
        cell_layout=hm_cells_mixed)
    mesh%cell_points = c_loc(itri)
    mesh%quad_points = c_loc(iquad)
    mesh%face_points = c_loc(faces)
    mesh%face_markers = c_loc(marks)
    call keep_mesh(this, mesh, 0_c_int64_t)
    call this%finish(ierr, msg)
end subroutine

subroutine hmpoly(w, np, x, y, inc, nc, istart, ipts, nf, faces, marks, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: np, inc, nc, nf
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(in), target :: x(*), y(*)
    integer(c_int32_t), intent(in), target :: istart(*), ipts(*), faces(*), marks(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(hm_c_mesh) :: mesh
    call this%open(w)
    mesh = hm_c_mesh(n_points=np, points=points_of(x, y, inc), n_cells=nc, n_faces=nf, cell_layout=hm_cells_polygons)
    mesh%cell_start = c_loc(istart)
    mesh%cell_points = c_loc(ipts)
    mesh%face_points = c_loc(faces)
    mesh%face_markers = c_loc(marks)
    call keep_mesh(this, mesh, 0_c_int64_t)
    call this%finish(ierr, msg)
end subroutine

! Copies faces to W: first their points, then their marks.
subroutine hmtype(w, itype, ierr, msg)
    use harmorph77
    implicit none
    real(c_double), intent(inout), target :: w(*)
    integer(c_int32_t), intent(in) :: itype(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    integer(c_int32_t), pointer :: numbers(:)
    integer(c_int32_t), allocatable :: corners(:, :), faces(:, :), marks(:)
    type(hm_c_mesh) :: mesh
    integer(c_int64_t) :: n
    call this%open(w)
    n = 0
    call corners_of_cells(this, corners)
    if (this%ok()) then
        mesh = this%kept%mesh
        call hm_faces_of_types(corners, itype(:mesh%n_points), faces, marks)
        n = size(marks, kind=c_int64_t)
        mesh%n_faces = int(n, c_int32_t)
        call keep_mesh(this, mesh, (3 * n + 1) / 2)
    end if
    if (this%ok() .and. n > 0) then
        call c_f_pointer(this%at(own_words(this) + 1), numbers, [3 * n])
        numbers = [reshape(faces, [2 * n]), marks]
        this%kept%mesh%face_points = c_loc(numbers)
        this%kept%mesh%face_markers = c_loc(numbers(2 * n + 1))
    end if
    call this%finish(ierr, msg)
end subroutine

subroutine hmblok(w, ni, nj, x, y, marks, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: ni, nj
    integer(c_int32_t), intent(in) :: marks(4)
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(in), target :: x(*), y(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    call this%open(w)
    call keep_blocks(this, 1, [int(ni, c_int32_t), int(nj, c_int32_t)], points_of(x, y, 1), marks)
    call this%finish(ierr, msg)
end subroutine

subroutine hmblks(w, nb, nij, x, y, inc, marks, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: nb, inc
    integer(c_int32_t), intent(in) :: nij(2, *), marks(4, *)
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(in), target :: x(*), y(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    call this%open(w)
    call this%refuse_if(nb < 1, "NB must be at least 1")
    call keep_blocks(this, nb, nij, points_of(x, y, inc), marks)
    call this%finish(ierr, msg)
end subroutine

subroutine hmbget(w, ib, xb, yb, ld, x, y, inc, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: ib, ld, inc
    real(c_double), intent(inout), target :: w(*), x(*), y(*)
    real(c_double), intent(in), target :: xb(*), yb(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    call this%open(w)
    if (this%ok()) call this%told(hm_c_blocks_gather(this%kept%mesh, int(ib - 1, c_int32_t), 1_c_int32_t, &
        [hm_c_block_points(c_loc(xb), c_loc(yb), 1, ld)], points_of(x, y, inc), this%e))
    call this%finish(ierr, msg)
end subroutine

subroutine hmbput(w, ib, x, y, inc, xb, yb, ld, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: ib, ld, inc
    real(c_double), intent(inout), target :: w(*), xb(*), yb(*)
    real(c_double), intent(in), target :: x(*), y(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    call this%open(w)
    if (this%ok()) call this%told(hm_c_blocks_scatter(this%kept%mesh, int(ib - 1, c_int32_t), 1_c_int32_t, &
        points_of(x, y, inc), [hm_c_block_points(c_loc(xb), c_loc(yb), 1, ld)], this%e))
    call this%finish(ierr, msg)
end subroutine
