
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
    call open_at(this, w, x0, y0, inc)
    if (this%ok()) call this%told(hm_c_swept_areas(this%kept%mesh, c_loc(from), points_of(x1, y1, inc), &
        c_loc(sides), c_loc(duals), c_loc(halves), c_null_ptr, this%e))
    call this%finish(ierr, msg)
end subroutine

subroutine hmwals(w, nmark, marks, x, y, inc, ww, lww, nface, nwall, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: nmark, marks(*), inc, lww
    real(c_double), intent(inout), target :: w(*), ww(*)
    real(c_double), intent(in), target :: x(*), y(*)
    integer, intent(inout) :: nface, nwall
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(hm_c_walls_info) :: info
    type(c_ptr) :: analysis, place, walls
    integer(c_int32_t), pointer :: markers(:)
    type(hm_c_memory) :: memory
    character(len=112) :: text
    call open_at(this, w, x, y, inc)
    call analyse(this, .false., analysis)
    call this%list(marks, nmark, place)
    if (this%ok()) call c_f_pointer(place, markers, [max(nmark, 0)])
    if (this%ok()) call this%told(hm_c_walls_init(walls, memory, analysis, short(nmark), markers, c_null_ptr, this%e))
    write(text, "(a, i0, a)") "WW is too small: WW needs at least ", words_of(memory%bytes), " words"
    if (this%ok() .and. lww < words_of(memory%bytes)) call this%refuse(text, hm_block_too_small)
    memory%block = c_loc(ww)
    if (this%ok()) call this%told(hm_c_walls_init(walls, memory, analysis, short(nmark), markers, c_null_ptr, this%e))
    info%struct_size = int(c_sizeof(info), c_int64_t)
    if (this%ok()) call this%told(hm_c_walls_info_get(walls, info, this%e))
    if (this%ok()) then
        this%kept%walls = walls
        this%kept%ww = c_loc(ww)
        nface = int(info%n_faces)
        nwall = int(info%n_wall_points)
    end if
    call this%finish(ierr, msg)
end subroutine

subroutine hmwdis(w, ww, x, y, inc, near, dist, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: inc
    real(c_double), intent(inout), target :: w(*), ww(*), dist(*)
    real(c_double), intent(in), target :: x(*), y(*)
    integer, intent(inout) :: near(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(c_ptr) :: place
    integer(c_int32_t), pointer :: nearest(:)
    call open_walls(this, w, ww)
    if (this%ok()) call this%list(near, int(this%kept%mesh%n_points), place)
    if (this%ok()) call this%told(hm_c_walls_move(this%kept%walls, points_of(x, y, inc), this%e))
    if (this%ok()) call this%told(hm_c_wall_distance(this%kept%walls, this%kept%mesh%n_points, points_of(x, y, inc), &
        place, dist, place, c_null_ptr, c_null_ptr, this%e))
    if (this%ok()) then
        call c_f_pointer(place, nearest, [this%kept%mesh%n_points])
        near(:this%kept%mesh%n_points) = int(nearest)
    end if
    call this%finish(ierr, msg)
end subroutine

subroutine hmlayr(w, ww, x, y, inc, ip, height, ierr, msg)
    use harmorph77
    implicit none
    integer, intent(in) :: inc
    real(c_double), intent(inout), target :: w(*), ww(*)
    real(c_double), intent(inout) :: height(*)
    real(c_double), intent(in), target :: x(*), y(*)
    integer, intent(inout) :: ip(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(legacy_call) :: this
    type(hm_c_walls_info) :: info
    integer(c_int32_t), pointer :: points(:)
    call open_walls(this, w, ww)
    info%struct_size = int(c_sizeof(info), c_int64_t)
    if (this%ok()) call this%told(hm_c_walls_info_get(this%kept%walls, info, this%e))
    if (this%ok()) call this%told(hm_c_first_layer(this%kept%walls, points_of(x, y, inc), height, this%e))
    if (this%ok()) then
        call c_f_pointer(info%wall_points, points, [info%n_wall_points])
        ip(:info%n_wall_points) = int(points)
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
    type(c_ptr) :: analysis, interpolation
    type(hm_c_memory) :: memory
    at = points_of(x, y, inc)
    report%struct_size = int(c_sizeof(report), c_int64_t)
    call open_at(this, w, x, y, inc)
    call analyse(this, .false., analysis)
    if (this%ok()) call this%told(hm_c_interpolation_init(interpolation, memory, analysis, c_loc(at), short(n), &
        points_of(xt, yt, inc), c_loc(dist), c_null_ptr, report, this%e))
    call this%room(memory%bytes, memory%block)
    if (this%ok()) call this%told(hm_c_interpolation_init(interpolation, memory, analysis, c_loc(at), short(n), &
        points_of(xt, yt, inc), c_loc(dist), c_null_ptr, report, this%e))
    if (this%ok()) call this%told(hm_c_interpolate(interpolation, short(nf), f, ft, c_null_ptr, this%e))
    call this%finish(ierr, msg)
end subroutine
