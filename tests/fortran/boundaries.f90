! The boundary in pieces, and by types of points.
module boundaries_tests
    use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t
    use kept
    implicit none
    private
    public :: boundary_in_pieces, types_of_points

contains

    subroutine boundary_in_pieces()
        type(hm_mesh) :: mesh
        integer :: k
        type(hm_error) :: err
        integer :: stat
        call mesh%points(x, y)
        call mesh%cells(cells)
        call mesh%faces(faces(:, :around), markers(:around))
        call mesh%faces(faces(:, around + 1:), [(far_field, k = 1, around)])
        call check_values(mesh, "faces in two calls")
        call mesh%points(x, y)
        call mesh%cells(cells)
        call mesh%lists([[(k, k = 1, around)], 1], [1, around + 2], [body])
        call mesh%lists([[(k, k = n_points - around + 1, n_points)], n_points - around + 1], [1, around + 2], &
            [far_field])
        call check_values(mesh, "lists in two calls")
        call mesh%lists([1, 2], [1, 4], [body], stat, err)
        call check(stat == hm_bad_argument, "a list shorter than start says: " // err%text)
    end subroutine

    ! Types of points make the faces that the mesh was given before.
    subroutine types_of_points()
        integer :: types(n_points), block_types(7, 5), k, wrong
        integer(c_int32_t), allocatable :: found_faces(:, :), found_markers(:)
        real(dp), target :: bx(7, 5), by(7, 5)
        type(hm_mesh) :: mesh, block
        type(hm_plan) :: plan
        type(hm_mesh_report) :: report
        integer, allocatable :: points(:)
        logical :: loop
        type(hm_error) :: err
        integer :: stat
        types = 0
        types(:around) = body
        types(n_points - around + 1:) = far_field
        call hm_faces_of_types(int(cells, c_int32_t), int(types, c_int32_t), found_faces, found_markers)
        call check(size(found_markers) == 2 * around, "each boundary edge is a face")
        wrong = 0
        do k = 1, 2 * around
            if (.not. any(minval(faces, 1) == found_faces(1, k) .and. maxval(faces, 1) == found_faces(2, k) .and. &
                markers == found_markers(k))) wrong = wrong + 1
        end do
        call check(wrong == 0, "with its points and its marker")
        call mesh%points(x, y)
        call mesh%point_types(types, stat, err)
        call check(stat == hm_bad_argument, "types before cells: " // err%text)
        call mesh%cells(cells)
        call mesh%point_types(types(2:), stat, err)
        call check(stat == hm_bad_argument, "a type too few: " // err%text)
        call mesh%point_types(types)
        call check_values(mesh, "types of points")
        call mesh%points(x, y)
        call mesh%cells(cells)
        call mesh%cells([1, 2, n_points + 1], [1, 4])
        call mesh%point_types(types, stat, err)
        call check(stat == hm_bad_argument, "a cell of a point that does not exist: " // err%text)
        call mesh%points(x, y)
        call mesh%cells(reshape(cells, [4 * n_cells]), [(1 + 4 * k, k = 0, n_cells)])
        call mesh%point_types(int(types, c_int64_t))
        call check_values(mesh, "types of points, cells in rows")

        ! A rectangle: 1 below, its corners too; 2 elsewhere. The upright sides are of the larger type to the corners.
        do k = 1, 5
            bx(:, k) = [0, 1, 2, 3, 4, 5, 6]
            by(:, k) = k
        end do
        block_types = 0
        block_types([1, 7], :) = 2
        block_types(:, 5) = 2
        block_types(:, 1) = 1
        call block%points(bx, by)
        call block%point_types(reshape(block_types, [35]))
        call plan%analyse(block)
        call plan%report(report)
        call check(report%boundary_edges == 20, "all edges round a block")
        call plan%boundary([1], points, loop)
        call check(size(points) == 7, "the lower side has the lower corners")
        call plan%boundary([2], points, loop)
        call check(size(points) == 15, "the other sides have them, too")
    end subroutine
end module
