! A mesh one cell thick, in arrays x(:), y(:), z(:) and x(:,:,:), of both kinds of reals, and the plane of it.
module plane_tests
    use, intrinsic :: iso_c_binding, only: c_float, c_int32_t, c_int64_t
    use harmorph
    use counts
    use meshes
    use body_mesh, only: x, y, cells, faces, markers
    implicit none
    private
    public :: planes
    integer(c_int32_t) :: sides(4, 2 * around)
    real(dp) :: sx(2 * n_points), sy(2 * n_points), sz(2 * n_points)
    type(hm_mesh) :: mesh
    type(hm_basis) :: basis
    type(hm_plane) :: plane
    type(hm_plane_info) :: info

contains

    subroutine planes()
        type(hm_error) :: err
        integer :: stat
        type(hm_curves) :: curves
        type(hm_plan) :: plan
        integer(c_int32_t) :: k
        sx = [x, x]                             ! the plane x-z; the second layer follows the first
        sz = [y, y]
        sy = [(0._dp, k = 1, n_points), (0.25_dp, k = 1, n_points)]
        sides(1:2, :) = faces
        sides(3, :) = faces(2, :) + n_points
        sides(4, :) = faces(1, :) + n_points

        call plane%find(stat=stat, err=err)
        call check(stat == hm_bad_argument .and. index(err%text, "call points first") > 0, "find without points")
        call plane%points(sx, sy, sz)
        call plane%morph(basis, reshape([0._dp, 0._dp], [2, 1]), sx, sy, sz, stat=stat, err=err)
        call check(stat == hm_bad_argument .and. index(err%text, "call find first") > 0, "morph without find")
        call plane%faces(cells)
        call plane%sides(sides, markers)
        call plane%find()
        call plane%info(info)
        call check(info%kind == hm_planes .and. info%points == n_points .and. info%layers == 2, "info")
        call check(all(info%follows == [(k, k = 1, n_points), (k, k = 1, n_points)]), "who follows whom")
        call check(all(info%space_point == [(k, k = 1, n_points)]), "points of the plane")
        call check(all(abs(info%normal) <= [0, 1, 0]), "normal")
        call check(info%max_distance <= 0 .and. info%max_distance_point == -1, "all are exact")

        call plane%mesh(mesh)
        call curves%fit(x(:around), y(:around), loop=.true., n_control=n_control)
        call plan%analyse(mesh, curves, [hm_condition(body)])
        call plan%factor()
        call plan%solve(basis)
        call vectors()
        call blocks()
        call single_precision()
        call what_is_refused()
    end subroutine

    subroutine vectors()
        real(dp), dimension(2 * n_points) :: px, py, pz, dx, dy, dz, gx, gy, gz
        real(dp) :: qx(n_points), qy(n_points), ax(n_points), ay(n_points), gradient(2, n_control), move(2, n_control)
        integer :: i
        move = some_move()
        px = sx
        py = sy
        pz = sz
        qx = x
        qy = y
        call basis%morph(move, qx, qy)
        call plane%morph(basis, move, px, py, pz)
        call check(all(px == [qx, qx]) .and. all(pz == [qy, qy]) .and. all(py == sy), &
            "morph: both layers, as the plane")
        call plane%displacement(basis, move, dx, dy, dz)
        call check(all(sx + dx == px) .and. all(sz + dz == pz) .and. all(dy == 0), "displacement")
        gx = [(sin(2._dp * i), i = 1, size(gx))]
        gy = 7
        gz = [(cos(5._dp * i), i = 1, size(gx))]
        call plane%adjoint(basis, gx, gy, gz, gradient)
        call check(abs(sum(gradient * move) - sum(gx * dx + gz * dz)) < 1e-13_dp, "adjoint: the transpose")
        call plane%gather(gx, gy, gz, ax, ay)
        call check(all(ax == gx(:n_points) + gx(n_points + 1:)), "gather sums the layers")
        px = sx
        py = sy
        pz = sz
        call plane%spread(ax, ay, px, py, pz)
        call check(all(px == sx + [ax, ax]) .and. all(pz == sz + [ay, ay]) .and. all(py == sy), "spread")
    end subroutine

    ! Solvers of structured meshes have such arrays, one cell thick; the compiler copies the sections.
    subroutine blocks()
        real(dp) :: bx(around, n_points / around, 2), by(around, n_points / around, 2), bz(around, n_points / around, 2)
        real(dp) :: ghosts(0:around + 1, n_points / around, 2)
        real(dp), dimension(2 * n_points) :: px, py, pz
        px = sx
        py = sy
        pz = sz
        call plane%morph(basis, some_move(), px, py, pz)
        bx = reshape(sx, shape(bx))
        by = reshape(sy, shape(by))
        bz = reshape(sz, shape(bz))
        call plane%morph(basis, some_move(), bx, by, bz)
        call check(all(reshape(bx, shape(px)) == px) .and. all(reshape(bz, shape(pz)) == pz), "blocks (i,j,k)")
        ghosts(1:around, :, :) = reshape(sx, shape(bx))
        by = reshape(sy, shape(by))
        bz = reshape(sz, shape(bz))
        call plane%morph(basis, some_move(), ghosts(1:around, :, :), by, bz)
        call check(all(ghosts(1:around, :, :) == bx), "blocks inside ghost layers")
    end subroutine

    subroutine single_precision()
        type(hm_plane) :: narrow
        type(hm_plane_info) :: narrow_info
        real(c_float), dimension(2 * n_points) :: px, py, pz, gx
        real(c_float) :: gradient(2, n_control), ax(n_points), ay(n_points), dx(2 * n_points), dy(2 * n_points), &
            dz(2 * n_points)
        real(dp) :: wx(2 * n_points), wy(2 * n_points), wz(2 * n_points)
        px = real(sx, c_float)
        py = real(sy, c_float)
        pz = real(sz, c_float)
        call narrow%points(px, py, pz, first=0)
        call narrow%faces(int(cells, c_int64_t) - 1_c_int64_t)
        call narrow%find(kind=hm_planes, tolerance=1e-5_dp)
        call narrow%info(narrow_info)
        call check(all(narrow_info%follows == info%follows - 1), "single precision, numbers from 0: who follows whom")
        wx = real(px, dp)
        wy = real(py, dp)
        wz = real(pz, dp)
        call plane%morph(basis, real(some_move(), c_float), px, py, pz)
        call plane%morph(basis, real(real(some_move(), c_float), dp), wx, wy, wz)
        call check(all(px == real(wx, c_float)) .and. all(pz == real(wz, c_float)), "morph in single precision")
        dx = signaling()
        dy = signaling()
        dz = signaling()
        call plane%displacement(basis, real(some_move(), c_float), dx, dy, dz)
        call check(all(abs(dx - (wx - sx)) < 1e-6_dp) .and. all(abs(dz - (wz - sz)) < 1e-6_dp) .and. &
            all(abs(dy) <= 0), "displacement in single precision")
        gx = 1
        gradient = signaling()
        ax = signaling()
        ay = signaling()
        call plane%adjoint(basis, gx, gx, gx, gradient)
        call plane%gather(gx, gx, gx, ax, ay)
        call check(all(abs(ax - 2) <= 0) .and. all(abs(gradient) < 1e4), "derivatives in single precision")
        px = real(sx, c_float)
        call plane%spread(ax, ay, px, py, pz)
        call check(all(px == real(sx, c_float) + 2), "spread in single precision")
    end subroutine

    subroutine what_is_refused()
        type(hm_plane) :: other
        real(dp) :: px(2 * n_points)
        type(hm_error) :: err
        integer :: stat
        px = sx
        call other%points(sx, sy, sz(2:), stat=stat, err=err)
        call check(stat == hm_bad_argument, "arrays of different shapes")
        call other%points(sx, sy, sz)
        call other%faces(sides(:2, :), stat=stat)
        call check(stat == hm_bad_argument, "faces of two points")
        call other%sides(sides, markers(2:), stat=stat)
        call check(stat == hm_bad_argument, "sides without markers")
        call other%find(stat=stat, err=err)
        call check(stat == hm_bad_mesh, "no faces: " // err%text)
        call other%faces(cells)
        call other%find(kind=hm_wedge, stat=stat, err=err)
        call check(stat == hm_bad_argument, "a wedge without inclined planes: " // err%text)
        px(n_points + 5) = px(n_points + 5) + 0.01_dp
        call other%points(px, sy, sz)
        call other%faces(cells)
        call other%find(stat=stat, err=err)
        call check(stat == hm_bad_mesh .and. err%item == n_points + 5, "no plane mesh in layers: " // err%text)
        call plane%morph(basis, some_move(), px(2:), sy(2:), sz(2:), stat=stat)
        call check(stat == hm_bad_argument, "arrays of another length")
        call plane%spread(x(2:), y(2:), px, sy, sz, stat=stat)
        call check(stat == hm_bad_argument, "arrays of another length than the plane's")
        call other%free()
        call other%info(info, stat=stat)
        call check(stat == hm_bad_argument, "an empty plane")
    end subroutine
end module
