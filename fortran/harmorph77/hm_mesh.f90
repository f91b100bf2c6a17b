
! ---- The mesh --------------------------------------------------------------------------------------------------------

subroutine hmmesh(w, np, nc, npc, cells, nf, faces, marks, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: np, nc, npc, cells(*), nf, faces(*), marks(*)
    real(c_double), intent(inout), target :: w(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(hm_c_mesh) :: mesh
    integer(c_int64_t) :: n
    n = int(npc, c_int64_t) * nc
    call this%open(w)
    call this%refuse_if(npc /= 3 .and. npc /= 4, &
        "NPC must be 3 or 4; triangles among quadrilaterals repeat their last point")
    mesh%n_points = short(np)
    mesh%n_cells = short(nc)
    mesh%cell_layout = short(merge(hm_cells_triangles, hm_cells_quads, npc == 3))
    call keep_mesh(this, mesh, words_of_list(n) + words_of_faces(nf))
    if (this%ok()) then
        this%kept%mesh%cell_points = kept_list(this, cells, n)
        call keep_faces(this, nf, faces, marks)
    end if
    call this%finish(ierr, msg)
end subroutine

subroutine hmmixd(w, np, nt, itri, nq, iquad, nf, faces, marks, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: np, nt, itri(*), nq, iquad(*), nf, faces(*), marks(*)
    real(c_double), intent(inout), target :: w(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(hm_c_mesh) :: mesh
    integer(c_int64_t) :: n, m
    n = 3_c_int64_t * nt
    m = 4_c_int64_t * nq
    call this%open(w)
    call this%refuse_if(min(nt, nq) < 0, "NT and NQ must be at least 0")
    mesh%n_points = short(np)
    mesh%n_cells = short(nt + nq)
    mesh%n_quads = short(nq)
    mesh%cell_layout = hm_cells_mixed
    call keep_mesh(this, mesh, words_of_list(n) + words_of_list(m) + words_of_faces(nf))
    if (this%ok()) then
        this%kept%mesh%cell_points = kept_list(this, itri, n)
        this%kept%mesh%quad_points = kept_list(this, iquad, m)
        call keep_faces(this, nf, faces, marks)
    end if
    call this%finish(ierr, msg)
end subroutine

subroutine hmpoly(w, np, nc, istart, ipts, nf, faces, marks, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: np, nc, istart(*), ipts(*), nf, faces(*), marks(*)
    real(c_double), intent(inout), target :: w(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(hm_c_mesh) :: mesh
    integer(c_int64_t) :: n, m
    n = max(nc, 0) + 1_c_int64_t
    m = istart(n) - 1_c_int64_t
    call this%open(w)
    mesh%n_points = short(np)
    mesh%n_cells = short(nc)
    mesh%cell_layout = hm_cells_polygons
    call keep_mesh(this, mesh, words_of_list(n) + words_of_list(m) + words_of_faces(nf))
    if (this%ok()) then
        this%kept%mesh%cell_start = kept_list(this, istart, n)
        this%kept%mesh%cell_points = kept_list(this, ipts, m)
        call keep_faces(this, nf, faces, marks)
    end if
    call this%finish(ierr, msg)
end subroutine

subroutine hmtype(w, itype, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: itype(*)
    real(c_double), intent(inout), target :: w(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    integer(c_int32_t), allocatable :: corners(:, :), faces(:, :), marks(:)
    integer :: n
    call this%open(w)
    n = 0
    call corners_of_cells(this, corners)
    if (this%ok()) then
        call hm_faces_of_types(corners, short(itype(:this%kept%mesh%n_points)), faces, marks)
        n = size(marks)
        this%top = this%kept%all_words          ! curves and functions go with the old faces
    end if
    if (this%fits(words_of_faces(n), this%kept%cells_end)) then
        call forget_faces(this%kept)
        call keep_faces(this, n, int(faces), int(marks))
    end if
    call this%finish(ierr, msg)
end subroutine

subroutine hmblok(w, ni, nj, marks, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: ni, nj, marks(4)
    real(c_double), intent(inout), target :: w(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    call this%open(w)
    call keep_blocks(this, 1, [ni, nj], marks)
    call this%finish(ierr, msg)
end subroutine

subroutine hmblks(w, nb, nij, marks, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: nb, nij(2, *), marks(4, *)
    real(c_double), intent(inout), target :: w(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    call this%open(w)
    call this%refuse_if(nb < 1, "NB must be at least 1")
    call keep_blocks(this, nb, nij, marks)
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
    if (this%ok()) call this%told(hm_c_blocks_gather(this%kept%mesh, short(ib - 1), 1_c_int32_t, &
        [hm_c_block_points(c_loc(xb), c_loc(yb), 1_c_int64_t, int(ld, c_int64_t))], points_of(x, y, inc), this%e))
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
    if (this%ok()) call this%told(hm_c_blocks_scatter(this%kept%mesh, short(ib - 1), 1_c_int32_t, &
        points_of(x, y, inc), [hm_c_block_points(c_loc(xb), c_loc(yb), 1_c_int64_t, int(ld, c_int64_t))], this%e))
    call this%finish(ierr, msg)
end subroutine
