! The mesh round a body, its points and cells in several layouts, and functions that are solved on it: tests read all of
! this and change nothing.
module body_mesh
    use, intrinsic :: iso_c_binding, only: c_int32_t
    use harmorph
    use counts
    use meshes
    implicit none
    real(dp), target :: x(n_points), y(n_points), xy(2, n_points), by_column(n_points, 2)
    integer(c_int32_t), target :: cells(4, n_cells), faces(2, 2 * around), markers(2 * around)
    type(hm_mesh), target :: mesh
    type(hm_basis), target :: basis

contains

    subroutine make_body_mesh()
        call make_points(x, y)
        call make_cells(cells, faces, markers)
        xy(1, :) = x
        xy(2, :) = y
        by_column(:, 1) = x
        by_column(:, 2) = y
        call mesh%points(x, y)
        call mesh%cells(cells)
        call mesh%faces(faces, markers)
        call solve(mesh, basis)
    end subroutine
end module
