! Cells with more than four corners.
module polygons_tests
    use body_mesh
    implicit none
    private
    public :: polygons

contains

    ! Two cells of the mesh become one of six corners, two of which are flat: rigid movements remain exact, and a wall
    ! given by types of points is the same.
    subroutine polygons()
        type(hm_mesh) :: joined, by_types
        type(hm_plan) :: plan
        type(hm_basis) :: basis
        type(hm_quality_report) :: quality
        type(hm_mesh_report) :: report
        real(dp) :: x_new(n_points), y_new(n_points)
        integer, allocatable :: rows(:), start(:), types(:)
        integer :: i, k, a, b
        integer :: stat
        allocate(rows(0))
        allocate(start(1), source=1)
        do k = 0, around / 2 - 1                                ! the first ring in pairs of cells, the others alone
            a = 2 * k
            b = modulo(2 * k + 2, around)
            rows = [rows, a + 1, a + around + 1, a + around + 2, b + around + 1, b + 1, a + 2]
            start = [start, size(rows) + 1]
        end do
        do i = around + 1, size(cells, 2)
            rows = [rows, int(cells(:, i))]
            start = [start, size(rows) + 1]
        end do
        call joined%points(x, y)
        call joined%polygons(rows, start)
        call joined%faces(faces, markers)
        call plan%analyse(joined)
        call plan%report(report)
        call check(report%polygons == around / 2 .and. report%cells == size(cells, 2) - around / 2, &
            "cells that are polygons")
        call plan%analyse(joined, conditions=[hm_condition(body, hm_rigid, x=0._dp, y=0._dp), &
            hm_condition(far_field, hm_rigid, x=0._dp, y=0._dp)])
        call plan%factor()
        call plan%solve(basis)
        x_new = x
        y_new = y
        call basis%morph(reshape([1._dp, 2._dp, cos(0.3_dp) - 1, sin(0.3_dp)], [2, 2]), x_new, y_new)
        call check(maxval(abs(x_new - (1 + x * cos(0.3_dp) - y * sin(0.3_dp)))) < 1e-11_dp, "polygons turn exactly: x")
        call check(maxval(abs(y_new - (2 + x * sin(0.3_dp) + y * cos(0.3_dp)))) < 1e-11_dp, "polygons turn exactly: y")
        call basis%assess(joined, x_new - x, y_new - y, quality=quality)
        call check(quality%inverted == 0 .and. quality%min_quality > 0, "polygons are not inverted when they turn")
        allocate(types(n_points), source=0)
        types(faces(1, :)) = int(markers)
        types(faces(2, :)) = int(markers)
        call by_types%points(x, y)
        call by_types%polygons(rows, start)
        call by_types%point_types(types)
        call plan%analyse(by_types)
        call plan%report(report)
        call check(report%boundary_edges == size(markers), "a boundary by types of points of polygons")
        start(3) = start(2) + 2
        call by_types%points(x, y)
        call by_types%polygons(rows, start)
        call plan%analyse(by_types, stat=stat)
        call check(stat == hm_bad_mesh, "a polygon of two corners")
    end subroutine
end module
