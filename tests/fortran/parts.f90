! A mesh in parts: shares of the functions, rows of points, sums of gradients.
module parts_tests
    use, intrinsic :: iso_c_binding, only: c_float, c_int64_t
    use body_mesh
    implicit none
    private
    public :: meshes_in_parts

contains

    ! Three processes in turn: each solves a share of the functions, gets the rows of its points, and gives its part of
    ! the gradient. The same bits as all at once.
    subroutine meshes_in_parts()
        integer, parameter :: parts = 3, length = 1056
        type(hm_plan) :: plan
        type(hm_curves) :: curves
        type(hm_basis) :: shares(parts), rows, some
        real(dp) :: move(2, n_control), gradient(2, n_control), expected(2, n_control)
        real(dp), dimension(n_points) :: dx, dy, part_dx, part_dy
        real(c_float) :: gradient4(2, n_control)
        real(dp), allocatable, target :: parcel(:), work(:)
        integer(c_int64_t) :: sums(4 * 2 * n_control), part_sums(4 * 2 * n_control)
        integer, allocatable :: points(:)
        integer :: part, k, first, n, done, scale, part_scale
        integer :: stat
        call basis%curves(curves)
        call plan%analyse(mesh, curves, [hm_condition(body)])
        call plan%factor()
        done = 0
        do part = 1, parts
            call plan%share_of(part, parts, first, n)
            call check(first == done + 1 .and. n >= 4, "shares follow one another")
            if (part == 2) then
                allocate(work(plan%share_words(first, n)))
                call shares(part)%init_share(plan, first, n, work(2:), stat)
                call check(stat == hm_block_too_small, "work of a share 8 bytes too small")
                call shares(part)%init_share(plan, first, n, work)
            else
                call shares(part)%init_share(plan, first, n)
            end if
            call plan%solve(shares(part))
            done = done + n
        end do
        call check(done == n_control, "all functions")
        call plan%share_of(4, parts, first, n, stat)
        call check(stat == hm_bad_argument, "there is no fourth part")
        call shares(1)%displacement(some_move(), dx, dy, stat=stat)
        call check(stat == hm_bad_basis, "a share does not move the mesh")

        move = some_move()
        call basis%displacement(move, dx, dy)
        call basis%adjoint(dx, dy, expected)
        call basis%adjoint_scale(dx, dy, scale)
        sums = 0
        allocate(points(0), parcel(0))
        do part = 1, parts
            points = [(k, k = min(part * length, n_points), (part - 1) * length + 1, -1)]
            call shares(1)%extract(points, rows)
            do k = 1, parts
                parcel = [(0._dp, n = 1, int(shares(k)%parcel_words(size(points))))]
                call shares(k)%pack(points, parcel(2:), stat)
                call check(stat == hm_bad_argument, "a parcel that is too short")
                call shares(k)%pack(points, parcel)
                call rows%unpack(parcel)
            end do
            call rows%displacement(move, part_dx(:size(points)), part_dy(:size(points)))
            call check(same(part_dx(:size(points)), dx(points)) .and. same(part_dy(:size(points)), dy(points)), &
                "rows of a part move its points as the whole basis does")
            call rows%adjoint_scale(dx(points), dy(points), part_scale)
            call check(part_scale <= scale, "the largest scale is that of all points")
            call rows%adjoint_sums(dx(points), dy(points), scale, part_sums)
            sums = sums + part_sums
        end do
        call rows%adjoint_finish(scale, sums, gradient)
        call check(maxval(abs(gradient - expected)) <= 0, "the gradient of all parts: the same bits")
        gradient4 = signaling()
        call rows%adjoint_finish(scale, sums, gradient4)
        call check(maxval(abs(gradient4 - real(expected, c_float))) <= 0, "in default reals")
        call rows%unpack(parcel, stat)
        call check(stat < 0, "a parcel too many")
        call rows%adjoint_sums(dx(points), dy(points), scale, part_sums(2:), stat=stat)
        call check(stat == hm_bad_argument, "sums that are too short")
        call rows%adjoint_sums(dx(points), dy(points), part_scale - 1, part_sums, stat=stat)
        call check(stat == hm_bad_argument, "a scale that is too small")

        ! Any layout; from the whole basis in one step.
        deallocate(work)
        allocate(work(basis%extract_words(size(points))))
        call basis%extract(points, some, work)
        call some%displacement(move, part_dx(:size(points)), part_dy(:size(points)))
        call check(same(part_dx(:size(points)), dx(points)), "rows of the whole basis")
        call basis%extract(points, some, work(2:), stat)
        call check(stat == hm_block_too_small, "work of rows 8 bytes too small")
        call basis%extract([n_points + 1], some, stat=stat)
        call check(stat == hm_bad_argument, "a point that does not exist")
        call basis%adjoint_sums(dx, dy, scale, sums)
        call basis%adjoint_scale(reshape(dx, [around, rings]), reshape(dy, [around, rings]), part_scale)
        call basis%adjoint_sums(reshape(dx, [around, rings]), reshape(dy, [around, rings]), scale, part_sums, &
            executor=hm_openmp(2))
        call check(part_scale == scale .and. all(sums == part_sums), "sums of a block, on threads")
        call basis%adjoint_scale(real(dx, c_float), real(dy, c_float), part_scale)
        call basis%adjoint_sums(real(dx, c_float), real(dy, c_float), part_scale, sums)
        call basis%adjoint_scale(reshape(real(dx, c_float), [around, rings]), &
            reshape(real(dy, c_float), [around, rings]), part_scale)
        call basis%adjoint_sums(reshape(real(dx, c_float), [around, rings]), &
            reshape(real(dy, c_float), [around, rings]), part_scale, part_sums)
        call basis%adjoint_finish(part_scale, part_sums, gradient)
        call check(all(sums == part_sums) .and. maxval(abs(gradient - expected)) < 1e-5_dp * maxval(abs(expected)), &
            "sums in default reals")
    end subroutine
end module
