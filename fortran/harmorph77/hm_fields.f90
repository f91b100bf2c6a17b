
! ---- Swept areas, distances to the walls, fields on another mesh -----------------------------------------------------

subroutine hmswep(w, x0, y0, x1, y1, inc, sides, duals, halves, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: inc
    real(c_double), intent(inout), target :: w(*), sides(*), duals(*), halves(*)
    real(c_double), intent(in), target :: x0(*), y0(*), x1(*), y1(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(hm_c_points), target :: from
    from = points_of(x0, y0, inc)
    call this%open(w)
    if (this%ok()) call this%told(hm_c_swept_areas(this%kept%mesh, c_loc(from), points_of(x1, y1, inc), &
        c_loc(sides), c_loc(duals), c_loc(halves), c_null_ptr, this%e))
    call this%finish(ierr, msg)
end subroutine

subroutine hmwals(w, nmark, marks, ww, lww, nface, nwall, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: nmark, lww
    real(c_double), intent(inout), target :: w(*), ww(*)
    integer(c_int32_t), intent(in) :: marks(*)
    integer, intent(inout) :: nface, nwall
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(hm_c_walls_info) :: info
    type(c_ptr) :: analysis, walls
    integer(c_size_t) :: bytes
    character(len=112) :: text
    call this%open(w)
    call analyse(this, .false., analysis)
    if (this%ok()) call this%told(hm_c_walls_size(analysis, int(nmark, c_int32_t), marks, bytes, this%e))
    write(text, "(a, i0, a)") "WW is too small: WW needs at least ", words_of(bytes), " words"
    if (this%ok() .and. lww < words_of(bytes)) call this%refuse(text, hm_block_too_small)
    if (this%ok()) call this%told(hm_c_walls_init(walls, c_loc(ww), bytes, analysis, int(nmark, c_int32_t), marks, &
        c_null_ptr, this%e))
    info%struct_size = int(c_sizeof(info), c_int64_t)
    if (this%ok()) call this%told(hm_c_walls_info_get(walls, info, this%e))
    if (this%ok()) then
        this%kept%walls = walls
        nface = info%n_faces
        nwall = info%n_wall_points
    end if
    call this%finish(ierr, msg)
end subroutine

subroutine hmwdis(w, x, y, inc, near, dist, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: inc
    real(c_double), intent(inout), target :: w(*), dist(*)
    real(c_double), intent(in), target :: x(*), y(*)
    integer(c_int32_t), intent(inout), target :: near(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    call open_walls(this, w)
    if (this%ok()) call this%told(hm_c_walls_move(this%kept%walls, points_of(x, y, inc), this%e))
    if (this%ok()) call this%told(hm_c_wall_distance(this%kept%walls, this%kept%mesh%n_points, points_of(x, y, inc), &
        c_loc(near), dist, c_loc(near), c_null_ptr, c_null_ptr, this%e))
    call this%finish(ierr, msg)
end subroutine

subroutine hmlayr(w, x, y, inc, ip, height, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: inc
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(inout) :: height(*)
    real(c_double), intent(in), target :: x(*), y(*)
    integer(c_int32_t), intent(inout) :: ip(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(hm_c_walls_info) :: info
    integer(c_int32_t), pointer :: points(:)
    call open_walls(this, w)
    info%struct_size = int(c_sizeof(info), c_int64_t)
    if (this%ok()) call this%told(hm_c_walls_info_get(this%kept%walls, info, this%e))
    if (this%ok()) call this%told(hm_c_first_layer(this%kept%walls, points_of(x, y, inc), height, this%e))
    if (this%ok()) then
        call c_f_pointer(info%wall_points, points, [info%n_wall_points])
        ip(:info%n_wall_points) = points
    end if
    call this%finish(ierr, msg)
end subroutine

subroutine hmintp(w, x, y, inc, n, xt, yt, nf, f, ft, dist, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: inc, n, nf
    real(c_double), intent(inout), target :: w(*), dist(*)
    real(c_double), intent(in), target :: x(*), y(*), xt(*), yt(*)
    real(c_double), intent(in) :: f(*)
    real(c_double), intent(inout) :: ft(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(hm_interpolation_report) :: report
    type(hm_c_points), target :: at
    type(c_ptr) :: analysis, interpolation, block
    integer(c_size_t) :: bytes
    at = points_of(x, y, inc)
    report%struct_size = int(c_sizeof(report), c_int64_t)
    call this%open(w)
    call analyse(this, .false., analysis)
    if (this%ok()) call this%told(hm_c_interpolation_size(analysis, int(n, c_int32_t), bytes, this%e))
    call this%room(bytes, block)
    if (this%ok()) call this%told(hm_c_interpolation_init(interpolation, block, bytes, analysis, c_loc(at), &
        int(n, c_int32_t), points_of(xt, yt, inc), c_loc(dist), c_null_ptr, report, this%e))
    if (this%ok()) call this%told(hm_c_interpolate(interpolation, int(nf, c_int32_t), f, ft, c_null_ptr, this%e))
    call this%finish(ierr, msg)
end subroutine
