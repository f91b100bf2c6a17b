! A mesh of several structured blocks: one after the other, and in arrays of their own.
module blocks_tests
    use, intrinsic :: iso_c_binding, only: c_float
    use body_mesh
    implicit none
    private
    public :: several_blocks

contains

    ! The mesh in three blocks, one after the other: the functions are those of the mesh in one.
    subroutine several_blocks()
        integer, parameter :: third = around / 3, ni = third + 1, nj = rings
        real(dp), target :: bx(3 * ni * nj), by(3 * ni * nj)
        real(dp) :: qx(n_points), qy(n_points), move(2, n_control)
        integer :: sizes(2, 3), sides(4, 3), i, j, b, k, own(3 * ni * nj)
        type(hm_mesh) :: blocks
        type(hm_curves) :: curves
        type(hm_plan) :: plan
        type(hm_basis) :: in_blocks, in_one
        integer :: stat
        k = 0
        do b = 0, 2
            do j = 0, nj - 1
                do i = 0, ni - 1
                    k = k + 1
                    own(k) = 1 + modulo(b * third + i, around) + around * j
                end do
            end do
            sizes(:, b + 1) = [ni, nj]
            sides(:, b + 1) = [integer :: hm_no_marker, hm_no_marker, body, hm_no_marker]
        end do
        bx = x(own)
        by = y(own)
        call blocks%points(bx, by)
        call blocks%blocks(sizes, sides(:, 2:), stat=stat)
        call check(stat == hm_bad_argument, "sides of another number of blocks")
        call blocks%blocks(sizes, sides)
        call blocks%blocks(sizes, stat=stat)
        call check(stat == hm_bad_argument, "blocks twice")
        call blocks%cells(cells, stat=stat)
        call check(stat == hm_bad_argument, "blocks and cells")
        call blocks%line(far_field, 1, ni, nj, nj, block=4, stat=stat)
        call check(stat == hm_bad_argument, "a line of a block that does not exist")
        do b = 1, 3
            call blocks%line(far_field, 1, ni, nj, nj, block=b)
        end do
        call curves%fit(x(:around), y(:around), .true., n_control=n_control)
        call plan%analyse(blocks, curves, [hm_condition(body)])
        call plan%factor()
        call plan%solve(in_blocks)
        call plan%analyse(mesh, curves, [hm_condition(body)])
        call plan%factor()
        call plan%solve(in_one)
        move = some_move()
        qx = x
        qy = y
        call in_one%morph(move, qx, qy)
        call in_blocks%morph(move, bx, by)
        call check(maxval(abs(bx - qx(own))) + maxval(abs(by - qy(own))) < 1e-11_dp, "blocks move as the mesh in one")
        call blocks_apart(own, sides(3, 1), move, in_blocks, bx, by)
    end subroutine

    ! The blocks are in arrays of their own, the second one inside ghost layers.
    subroutine blocks_apart(own, wall, move, one_after_the_other, moved_x, moved_y)
        integer, parameter :: ni = around / 3 + 1, nj = rings, n = ni * nj
        integer, intent(in) :: own(:), wall
        real(dp), intent(in) :: move(:, :), moved_x(:), moved_y(:)
        type(hm_basis), intent(in) :: one_after_the_other
        real(dp), target :: ax(ni, nj), ay(ni, nj), bx(0:ni + 1, 0:nj + 1), by(0:ni + 1, 0:nj + 1)
        real(c_float), target :: cx(ni, nj), cy(ni, nj)
        real(dp), target :: px(ni, nj), py(ni, nj)
        real(dp) :: dx(3 * n), dy(3 * n), ex(3 * n), ey(3 * n)
        integer :: sides(4), k
        type(hm_mesh) :: blocks
        type(hm_curves) :: curves
        type(hm_plan) :: plan
        type(hm_basis) :: basis
        integer :: stat
        sides = [integer :: hm_no_marker, hm_no_marker, wall, far_field]
        bx = 7
        by = 8
        ax = reshape(x(own(:n)), [ni, nj])
        ay = reshape(y(own(:n)), [ni, nj])
        bx(1:ni, 1:nj) = reshape(x(own(n + 1:2 * n)), [ni, nj])
        by(1:ni, 1:nj) = reshape(y(own(n + 1:2 * n)), [ni, nj])
        call blocks%gather(1, ax, ay, dx, dy, stat=stat)
        call check(stat == hm_bad_argument, "gather without blocks")
        call blocks%add_block(ax, ay, sides(:3), stat=stat)
        call check(stat == hm_bad_argument, "a block of three sides")
        call blocks%add_block(ax, ay, sides)
        call blocks%points(ax, ay)
        call blocks%add_block(ax, ay, sides, stat=stat)
        call check(stat == hm_bad_argument, "add_block after points")
        call blocks%free()
        call blocks%add_block(ax, ay, sides)
        call blocks%add_block(bx(1:ni, 1:nj), by(1:ni, 1:nj), sides)
        px = reshape(x(own(2 * n + 1:)), [ni, nj])
        py = reshape(y(own(2 * n + 1:)), [ni, nj])
        call blocks%add_block(ax, ay, sides, stat=stat)         ! the first block twice is no mesh
        call plan%analyse(blocks, stat=stat)
        call check(stat == hm_bad_mesh, "a block that is there twice")
        call blocks%free()
        call blocks%add_block(ax, ay, sides)
        call blocks%add_block(bx(1:ni, 1:nj), by(1:ni, 1:nj), sides)
        call blocks%add_block(px, py, sides)
        call curves%fit(x(:around), y(:around), .true., n_control=n_control)
        call plan%analyse(blocks, curves, [hm_condition(body)])
        call plan%factor()
        call plan%solve(basis)
        call basis%displacement(move, dx, dy)
        call one_after_the_other%displacement(move, ex, ey)
        call check(all(dx == ex), "the functions of the blocks one after the other: x")
        call check(all(dy == ey), "the functions of the blocks one after the other: y")
        call basis%morph_mesh(move, blocks)
        call check(all(reshape(ax, [n]) == moved_x(:n)), "the first block moves in place")
        call check(all(reshape(by(1:ni, 1:nj), [n]) == moved_y(n + 1:2 * n)), "the second one inside ghost layers")
        call check(all(reshape(px, [n]) == moved_x(2 * n + 1:)), "the third one")
        call check(all(bx(0, :) == 7) .and. all(by(:, nj + 1) == 8), "ghost points stay")
        call blocks%scatter(2, dx, dy, px, py)
        call check(all(reshape(px, [n]) == dx(n + 1:2 * n)), "displacements of the second block")
        ex = 0
        call blocks%gather(2, px, py, ex, ey)
        call check(all(ex == [(0._dp, k = 1, n), dx(n + 1:2 * n), (0._dp, k = 1, n)]), "back among all points")
        call blocks%scatter(4, dx, dy, px, py, stat=stat)
        call check(stat == hm_bad_argument, "a block that does not exist")
        call blocks%scatter(1, dx(2:), dy, px, py, stat=stat)
        call check(stat == hm_bad_argument, "displacements of other points")
        call blocks%scatter(1, dx, dy, bx, by, stat=stat)
        call check(stat == hm_bad_argument, "a block of another shape")
        cx = real(ax, c_float)
        cy = real(ay, c_float)
        call blocks%free()
        call blocks%add_block(cx, cy, sides)
        call basis%morph_mesh(move, blocks, stat=stat)
        call check(stat == hm_bad_argument, "morph of a mesh of other points")
    end subroutine
end module
