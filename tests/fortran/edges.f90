! Meshes given as edges with the cells on both sides.
module edges_tests
    use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t
    use body_mesh
    use kept, only: check_values
    implicit none
    private
    public :: meshes_of_edges

    integer, parameter :: n_edges = around * (2 * rings - 1)
    integer :: ends(2, n_edges), sides(2, n_edges), edge_markers(n_edges)

contains

    ! The edges of the body's mesh: edges round the body, between cell (i,j-1) and cell (i,j), then edges across.
    subroutine make_edges()
        integer :: i, j, k, next
        k = 0
        edge_markers = -77                                      ! not read: edges with two cells
        do j = 0, rings - 1
            do i = 0, around - 1
                k = k + 1
                next = modulo(i + 1, around)
                ends(:, k) = 1 + around * j + [i, next]
                sides(:, k) = [0, 0]
                if (j > 0) sides(1, k) = 1 + i + around * (j - 1)
                if (j < rings - 1) sides(2, k) = 1 + i + around * j
                if (j == 0) edge_markers(k) = body
                if (j == rings - 1) edge_markers(k) = far_field
            end do
        end do
        do j = 0, rings - 2
            do i = 0, around - 1
                k = k + 1
                ends(:, k) = 1 + i + around * [j, j + 1]
                sides(:, k) = 1 + around * j + [modulo(i - 1, around), i]
            end do
        end do
    end subroutine

    subroutine meshes_of_edges()
        type(hm_mesh) :: of_edges
        type(hm_plan) :: plan
        type(hm_mesh_report) :: report
        type(hm_error) :: err
        integer :: stat
        call make_edges()
        call of_edges%points(x, y)
        call of_edges%edges(ends, sides, edge_markers)
        call plan%analyse(of_edges)
        call plan%report(report)
        call check(report%cells == n_cells .and. report%quads == n_cells .and. report%edges == n_edges, &
            "the edges form the cells")
        call check(report%inverted == 0 .and. report%boundary_edges == 2 * around .and. report%boundary_loops == 2, &
            "and the boundary")
        call check_values(of_edges, "a mesh of edges", 1e-11_dp)
        call of_edges%edges(ends, sides, edge_markers, stat, err)
        call check(stat == hm_bad_argument, "edges of a mesh with cells: " // err%text)

        ! Points counted from 0, integers of 8 bytes and separate faces give the same cells.
        call of_edges%points(x, y, first=0)
        call of_edges%edges(ends - 1_c_int64_t, sides - 1_c_int64_t)
        call of_edges%faces(faces - 1_c_int32_t, markers)
        call plan%analyse(of_edges)
        call plan%report(report)
        call check(report%quads == n_cells .and. report%boundary_edges == 2 * around, "edges that count from 0")

        ! A refused call leaves a mesh without cells.
        call of_edges%points(x, y)
        call of_edges%edges(ends(:, [1, 2]), sides(:, [1, 2]), stat=stat, err=err)
        call check(stat == hm_bad_mesh, "two edges: " // err%text)
        call of_edges%edges(ends, sides(:, 2:), edge_markers, stat)
        call check(stat == hm_bad_argument, "edges without cells")
        call of_edges%edges(ends, sides, edge_markers(2:), stat)
        call check(stat == hm_bad_argument, "edges without markers")
        ends(1, around + 3) = ends(1, around + 3) + 5
        call of_edges%edges(ends, sides, edge_markers, stat, err)
        call check(stat == hm_bad_mesh .and. err%item_kind == hm_item_cell .and. err%item == 3, &
            "edges that form no loop: " // err%text)
        call check(err%item_base == 1 .and. err%other_kind == hm_item_point, "the point is named, too")
        ends(1, 7) = n_points + 1
        call of_edges%edges(ends, sides, edge_markers, stat, err)
        call check(stat == hm_bad_mesh .and. err%item_kind == hm_item_side .and. err%item == 7, &
            "an edge of a point that does not exist: " // err%text)
        call of_edges%free()
        call of_edges%edges(ends, sides, stat=stat)
        call check(stat == hm_bad_argument, "edges before points")
    end subroutine
end module
