! Functions of a coarse mesh on a fine one.
module transfer_tests
    use, intrinsic :: iso_c_binding, only: c_int32_t
    use body_mesh
    implicit none
    private
    public :: transfers

contains

    ! Functions go from every second point in both directions to all points.
    subroutine transfers()
        integer, parameter :: n = around / 2, m = (rings + 1) / 2
        real(dp), target :: cx(n * m), cy(n * m)
        integer(c_int32_t), target :: coarse_cells(4, n * (m - 1)), coarse_faces(2, 2 * n), coarse_markers(2 * n)
        type(hm_mesh) :: coarse_mesh
        type(hm_basis) :: coarse, fine, again
        type(hm_plan) :: plan
        type(hm_curves) :: curves
        type(hm_transfer_report) :: report
        real(dp) :: a(n_points), b(n_points)
        real(dp), allocatable, target :: work(:)
        integer :: i, j, next
        type(hm_error) :: err
        integer :: stat
        do i = 0, n - 1
            next = modulo(i + 1, n)
            do j = 0, m - 1
                call place(2 * i, 2 * j, cx(1 + i + n * j), cy(1 + i + n * j))
                if (j < m - 1) coarse_cells(:, 1 + i + n * j) = 1 + [i + n * j, i + n * (j + 1), next + n * (j + 1), &
                    next + n * j]
            end do
            coarse_faces(:, 1 + i) = 1 + [i, next]
            coarse_faces(:, 1 + n + i) = 1 + n * (m - 1) + [i, next]
        end do
        coarse_markers(:n) = body
        coarse_markers(n + 1:) = far_field
        call coarse_mesh%points(cx, cy)
        call coarse_mesh%cells(coarse_cells)
        call coarse_mesh%faces(coarse_faces, coarse_markers)
        call basis%curves(curves)
        call plan%analyse(coarse_mesh, curves, [hm_condition(body)])
        call plan%factor()
        call plan%solve(coarse)
        call plan%analyse(mesh, curves, [hm_condition(body)])
        call plan%transfer(coarse, coarse_mesh, fine, report)
        call check(report%points == n_points - 2 * around .and. report%boundary_error < 1e-14_dp, &
            "points between the walls")
        call check(report%outside == 0 .and. report%max_distance_point == -1, "round a convex body none is outside")
        call check(report%wall_correction > 0 .and. report%wall_correction < 0.1_dp, &
            "the coarse mesh resolves the functions")
        call fine%values(4, a)
        call basis%values(4, b)
        call check(same(a(:around), b(:around)), "on the wall the functions are those of the fine mesh")
        call check(maxval(abs(a - b)) < report%wall_correction .and. maxval(abs(a - b)) > 0, "elsewhere nearly")
        allocate(work(plan%transfer_words(coarse_mesh)))
        call plan%transfer(coarse, coarse_mesh, again, work=work)
        call again%values(4, b)
        call check(same(a, b), "the same in own memory")
        call plan%transfer(coarse, coarse_mesh, again, work=work(2:), stat=stat)
        call check(stat == hm_block_too_small, "work 8 bytes too small")
        call plan%transfer(coarse, mesh, again, stat=stat, err=err)
        call check(stat == hm_bad_basis, "another mesh's functions: " // err%text)
        call plan%free()
        call plan%transfer(coarse, coarse_mesh, again, stat=stat)
        call check(stat == hm_bad_argument, "no analysis")
    end subroutine
end module
