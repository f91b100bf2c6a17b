! Cells: integers of any kind, which are copied; both kinds of cells, in several calls and as rows.
module cells_tests
    use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t
    use kept
    implicit none
    private
    public :: integers_of_any_kind, cells_of_two_kinds

contains

    ! Copies: the arrays may be expressions, sections, of 8 bytes, and gone after the call.
    subroutine integers_of_any_kind()
        integer(c_int64_t), allocatable :: cells8(:, :)
        integer(c_int32_t), allocatable :: wide(:, :)
        integer, allocatable :: bodies(:), far(:)
        type(hm_mesh) :: mesh
        integer :: k
        allocate(wide(6, n_cells), bodies(around + 1), far(around + 1))
        wide(2:5, :) = cells
        call mesh%points(x, y)
        call mesh%cells(wide(2:5, :))
        bodies(:) = [[(k, k = 1, around)], 1]
        far(:) = [[(k, k = n_points - around + 1, n_points)], n_points - around + 1]
        call mesh%lists([bodies, far], [1, around + 2, 2 * around + 3], [body, far_field])
        wide = 0
        deallocate(wide, bodies, far)
        call check_values(mesh, "sections of cells, and lists [b1, b2]")
        call mesh%points(x, y, first=0)
        call mesh%cells(cells - 1)
        cells8 = faces - 1
        call mesh%faces(cells8, int(markers, c_int64_t))
        deallocate(cells8)
        call solve_from_0(mesh)
    end subroutine

    subroutine solve_from_0(mesh)
        type(hm_mesh), intent(in) :: mesh
        type(hm_basis) :: basis
        type(hm_basis_info) :: info
        real(dp) :: found(n_points)
        call solve(mesh, basis, first=0)
        call basis%values(3, found)
        call check(maxval(abs(found - values)) <= 0, "cells - 1, and faces of 8 bytes")
        call basis%info(info)
        call check(info%index_base == 0 .and. minval(info%curve_point) == 0 .and. &
            maxval(info%curve_point) == around - 1 .and. all(info%point_curve == 1), "curve points count from 0, too")
    end subroutine

    ! Triangles from some quads, then the other quads: cell numbers run on.
    subroutine cells_of_two_kinds()
        integer, parameter :: split = 100
        integer, save :: triangles(3, 2 * split), rows(6 * split + 4 * (n_cells - split))
        integer :: start(n_cells + split + 1)
        type(hm_mesh) :: mesh, as_rows
        type(hm_plan) :: plan
        type(hm_mesh_report) :: report
        type(hm_basis) :: a, b
        real(dp) :: of_a(n_points), of_b(n_points)
        integer :: k
        type(hm_error) :: err
        integer :: stat
        do k = 1, split
            triangles(:, 2 * k - 1) = cells([1, 2, 3], k)
            triangles(:, 2 * k) = cells([1, 3, 4], k)
        end do
        call mesh%points(x, y)
        call mesh%cells(triangles(:, :50))
        call mesh%cells(triangles(:, 51:))
        call mesh%cells(cells(:, split + 1:))
        call mesh%faces(faces, markers)
        call plan%analyse(mesh)
        call plan%report(report)
        call check(report%triangles == 2 * split, "triangles in two calls")
        call check(report%quads == n_cells - split, "then quads")
        call check(report%inverted == 0, "none of them inverted")

        rows = [reshape(triangles, [6 * split]), reshape(cells(:, split + 1:), [4 * (n_cells - split)])]
        start = [[(1 + 3 * k, k = 0, 2 * split - 1)], [(1 + 6 * split + 4 * k, k = 0, n_cells - split)]]
        call as_rows%points(x, y)
        call as_rows%cells(rows, start)
        call as_rows%faces(faces, markers)
        call solve(mesh, a)
        call solve(as_rows, b)
        call a%values(3, of_a)
        call b%values(3, of_b)
        call check(maxval(abs(of_a - of_b)) <= 0, "as one list of rows")

        ! Rows after quads; a wrong point is named by the cell's number in all of them.
        call mesh%points(x, y)
        call mesh%cells(cells(:, :n_cells - 2))
        call mesh%cells([cells(:, n_cells - 1), cells(:3, n_cells), n_points + 5], [1, 5, 9])
        call mesh%faces(faces, markers)
        call plan%analyse(mesh, stat=stat, err=err)
        call check(stat == hm_bad_mesh, "a point that does not exist: " // err%text)
        call check(err%item == n_cells, "in the last cell")
        call mesh%cells(reshape([1], [5, 0]), stat, err)
        call check(stat == hm_bad_argument, "cells of five points: " // err%text)
        call mesh%cells([1, 2, 3], [1, 5], stat, err)
        call check(stat == hm_bad_argument, "rows shorter than start says: " // err%text)
        call mesh%cells([1, 2, 3], [2, 4], stat, err)
        call check(stat == hm_bad_argument, "rows that begin with 2: " // err%text)
        call mesh%cells([1, 2, 3], [1, 4, 3], stat, err)
        call check(stat == hm_bad_argument, "rows that decrease: " // err%text)
    end subroutine
end module
