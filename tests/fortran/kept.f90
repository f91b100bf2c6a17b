! Shared by tests of the arrays that a mesh keeps: the body's mesh in integers of the default kind, and whether
! functions on another mesh are those of x and y.
module kept
    use harmorph
    use counts
    use meshes
    use body_mesh, only: x, y, basis, their_cells => cells, their_faces => faces, their_markers => markers
    implicit none
    integer :: cells(4, n_cells), faces(2, 2 * around), markers(2 * around)
    real(dp) :: values(n_points)                                ! of a function solved on x, y

contains

    subroutine make_kept()
        cells = their_cells
        faces = their_faces
        markers = their_markers
        call basis%values(3, values)
        call check(maxval(values) > 0.1_dp, "a function to compare with")
    end subroutine

    subroutine complete(mesh)
        type(hm_mesh), intent(inout) :: mesh
        call mesh%cells(cells)
        call mesh%faces(faces, markers)
    end subroutine

    ! Checks that the functions are those on x, y to the tolerance that default reals allow.
    subroutine check_values(mesh, what, tolerance)
        type(hm_mesh), intent(in) :: mesh
        character(len=*), intent(in) :: what
        real(dp), intent(in), optional :: tolerance
        type(hm_basis) :: basis
        real(dp) :: found(n_points), bound
        bound = 0
        if (present(tolerance)) bound = tolerance
        call solve(mesh, basis)
        call basis%values(3, found)
        call check(maxval(abs(found - values)) <= bound, what // ": the functions are those of x and y")
    end subroutine

    ! The caller has made x or y 0 everywhere, which is refused: the plan reads coordinates as they are now.
    subroutine check_collapsed(plan, what)
        type(hm_plan), intent(inout) :: plan
        character(len=*), intent(in) :: what
        type(hm_error) :: err
        integer :: stat
        call plan%factor(stat=stat, err=err)
        call check(stat == hm_bad_mesh, what // ": the plan sees coordinates as they are now")
    end subroutine

    subroutine analyse(plan, mesh)
        type(hm_plan), intent(inout) :: plan
        type(hm_mesh), intent(in) :: mesh
        type(hm_curves) :: curves
        integer, allocatable :: wall(:)
        logical :: loop
        call plan%analyse(mesh)
        call plan%boundary([body], wall, loop)
        call curves%fit(x(wall), y(wall), loop, n_control=n_control)
        call plan%analyse(mesh, curves, [hm_condition(body)])
        call plan%factor()
    end subroutine
end module
