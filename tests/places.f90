! Arrays that a mesh keeps: coordinates in every layout, which must be those of the caller and as they are now; lists of
! integers, of which the mesh has copies. With an argument: does what must stop the program (see fortran.sh).
module nodes
    use, intrinsic :: iso_c_binding, only: c_double, c_float, c_int32_t
    implicit none

    type :: solver_node                                         ! as flow solvers have them: flow, then coordinates
        real(c_double) :: flow(4) = 0, x = 0, y = 0
        integer :: cell = 0, reserved = 0
    end type

    type :: odd_node                                            ! 20 bytes from node to node
        sequence
        real(c_float) :: x = 0, y = 0, flow(3) = 0
    end type
end module

program places
    use, intrinsic :: iso_c_binding, only: c_double, c_float, c_int32_t, c_int64_t, c_intptr_t, c_loc, c_null_ptr, c_ptr
    use harmorph
    use use_meshes
    use nodes
    implicit none
    integer :: cells(4, n_cells), faces(2, 2 * around), markers(2 * around)
    real(dp), target :: x(n_points), y(n_points)
    real(dp) :: values(n_points)                                ! of a function solved on x, y
    integer :: stat
    type(hm_error) :: err
    character(len=32) :: mode

    call make_points(x, y)
    call make_all_cells()
    call get_command_argument(1, mode)
    if (mode == "refused") call stop_without_stat()
    call plain()
    call derived_types()
    call addresses()
    call pointers()
    call sections()
    call not_doubles()
    call integers_of_any_kind()
    call cells_of_two_kinds()
    call boundary_in_pieces()
    call types_of_points()
    call shared_with_plans()
    call working_memory()
    print "(i0, a, i0, a)", passed, " passed, ", failed, " failed"
    if (failed > 0) error stop

contains

    subroutine make_all_cells()
        integer(c_int32_t) :: cells4(4, n_cells), faces4(2, 2 * around), markers4(2 * around)
        call make_cells(cells4, faces4, markers4)
        cells = cells4
        faces = faces4
        markers = markers4
    end subroutine

    subroutine complete(mesh)
        type(hm_mesh), intent(inout) :: mesh
        call mesh%cells(cells)
        call mesh%faces(faces, markers)
    end subroutine

    ! The same functions as on x, y; tolerance: what default reals leave of them.
    subroutine check_values(mesh, what, tolerance)
        type(hm_mesh), intent(in) :: mesh
        character(len=*), intent(in) :: what
        real(dp), intent(in), optional :: tolerance
        type(hm_basis) :: basis
        real(dp) :: its(n_points), bound
        bound = 0
        if (present(tolerance)) bound = tolerance
        call solve(mesh, basis)
        call basis%values(3, its)
        call check(maxval(abs(its - values)) <= bound, what // ": the functions are those of x and y")
    end subroutine

    ! The caller has made x or y 0 everywhere, which is refused: the plan reads coordinates as they are now.
    subroutine check_collapsed(plan, what)
        type(hm_plan), intent(inout) :: plan
        character(len=*), intent(in) :: what
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

    subroutine plain()
        type(hm_mesh) :: mesh
        type(hm_basis) :: basis
        call mesh%points(x, y)
        call complete(mesh)
        call solve(mesh, basis)
        call basis%values(3, values)
        call check(maxval(values) > 0.1_dp, "a function to compare with")
    end subroutine

    ! Compilers that associate a pointer with components give them in place; others are found out.
    subroutine derived_types()
        type(solver_node), allocatable, target :: node(:)
        type(hm_mesh) :: mesh
        type(hm_plan) :: plan
        allocate(node(n_points))
        node%x = x
        node%y = y
        call mesh%points(node%x, node%y, stat=stat, err=err)
        if (stat == hm_ok) then
            call complete(mesh)
            call check_values(mesh, "node%x, node%y")
            call analyse(plan, mesh)
            node%x = 0
            call check_collapsed(plan, "node%x, node%y")
        else
            call check(stat == hm_bad_argument, "node%x, node%y are refused")
            call check(index(err%text, "points_at") > 0, "the refusal says what to call: " // err%text)
        end if
        ! One of them alone: the other is an array of doubles.
        node%x = x
        call mesh%points(node%x, y, stat=stat)
        call check(stat == hm_bad_argument, "x and y of different distances from point to point")
        call mesh%points(node(::2)%x, node(::2)%y, stat=stat)
        if (stat == hm_ok) then
            call mesh%free()
        else
            call check(stat == hm_bad_argument, "sections of components are refused")
        end if
        call mesh%points(x, x, stat=stat, err=err)
        call check(stat == hm_bad_argument, "x and y are one array: " // err%text)
    end subroutine

    subroutine stop_without_stat()
        type(hm_mesh) :: mesh
        call mesh%points(x, x)
        print "(a)", "went on"
    end subroutine

    integer function bytes_between(from, to)
        type(c_ptr), intent(in) :: from, to
        bytes_between = int(transfer(to, 0_c_intptr_t) - transfer(from, 0_c_intptr_t))
    end function

    subroutine addresses()
        type(solver_node), allocatable, target :: node(:)
        type(hm_mesh) :: mesh
        type(hm_plan) :: plan
        type(hm_basis) :: basis
        real(dp) :: expected_x(n_points), expected_y(n_points)
        integer :: bytes
        allocate(node(n_points))
        node%x = x
        node%y = y
        bytes = bytes_between(c_loc(node(1)), c_loc(node(2)))
        call check(bytes == storage_size(node) / 8, "bytes from node to node are storage_size / 8")
        call mesh%points_at(c_loc(node(1)%x), c_loc(node(1)%y), bytes, n_points)
        call complete(mesh)
        call check_values(mesh, "points_at")
        call solve(mesh, basis)
        expected_x = x
        expected_y = y
        call basis%morph(some_move(), expected_x, expected_y)
        call basis%morph_at(some_move(), c_loc(node(1)%x), c_loc(node(1)%y), bytes, n_points)
        call check(all(abs(node%x - expected_x) <= 0) .and. all(abs(node%y - expected_y) <= 0), "morph_at moves nodes")
        call check(all(abs(node%flow(1)) <= 0) .and. all(node%cell == 0), "and nothing else of them")
        call basis%morph_at(some_move(), c_loc(node(1)%x), c_loc(node(1)%y), bytes, n_points - 1, stat=stat)
        call check(stat == hm_bad_argument, "morph_at of one node too few")
        call basis%morph_at(some_move(), c_loc(node(1)%x), c_loc(node(1)%y), bytes + 4, n_points, stat=stat)
        call check(stat == hm_bad_argument, "morph_at of bytes that are not a multiple of 8")
        node%x = x
        node%y = y
        call analyse(plan, mesh)
        node%y = 0
        call check_collapsed(plan, "points_at")
        call mesh%points_at(c_loc(node(1)%x), c_loc(node(1)%y), 7, n_points, stat=stat, err=err)
        call check(stat == hm_bad_argument, "nodes of seven bytes: " // err%text)
        call mesh%points_at(c_loc(node(1)%x), c_loc(node(1)%y), bytes, 0, stat=stat)
        call check(stat == hm_bad_argument, "no node")
        call mesh%points_at(c_null_ptr, c_loc(node(1)%y), bytes, n_points, stat=stat)
        call check(stat == hm_bad_argument, "no address")
        call mesh%points_at(c_loc(node(1)%x), c_loc(node(1)%y), bytes, n_points, precision=7, stat=stat)
        call check(stat == hm_bad_argument, "an unknown precision")
        call mesh%points_at(c_loc(node(1)%x), c_loc(node(1)%y), bytes, n_points, first=2, stat=stat)
        call check(stat == hm_bad_argument, "points that count from 2")
    end subroutine

    subroutine pointers()
        type(solver_node), allocatable, target :: node(:)
        real(dp), pointer :: px(:), py(:)
        allocate(node(n_points))
        node%x = x
        node%y = y
        px => x
        py => y
        call through_pointers(px, py, "pointers to arrays")
        px => node%x
        py => node%y
        call through_pointers(px, py, "pointers to components")
        nullify(px)
        call through_nothing(px, py)
    end subroutine

    subroutine through_pointers(px, py, what)
        real(dp), pointer, intent(in) :: px(:), py(:)
        character(len=*), intent(in) :: what
        type(hm_mesh) :: mesh
        call mesh%points(px, py, stat=stat, err=err)
        if (stat == hm_ok) then
            call complete(mesh)
            call check_values(mesh, what)
        else
            call check(index(err%text, "points_at") > 0, what // " are refused: " // err%text)
        end if
    end subroutine

    subroutine through_nothing(px, py)
        real(dp), pointer, intent(in) :: px(:), py(:)
        type(hm_mesh) :: mesh
        call mesh%points(px, py, stat=stat, err=err)
        call check(stat == hm_bad_argument, "a pointer to nothing: " // err%text)
    end subroutine

    subroutine sections()
        real(dp), allocatable, target :: xy(:, :), back(:, :), both(:, :)
        type(hm_mesh) :: mesh
        type(hm_plan) :: plan
        allocate(xy(3, n_points), back(n_points, 2), both(n_points, 2))
        xy(1, :) = x
        xy(3, :) = y
        call mesh%points(xy(1, :), xy(3, :))
        call complete(mesh)
        call check_values(mesh, "xy(1,:), xy(3,:)")
        call analyse(plan, mesh)
        xy(1, :) = 0
        call check_collapsed(plan, "xy(1,:), xy(3,:)")
        both(:, 1) = x
        both(:, 2) = y
        call mesh%points(both(:, 1), both(:, 2))
        call complete(mesh)
        call check_values(mesh, "xy(:,1), xy(:,2)")
        back(n_points:1:-1, 1) = x
        back(n_points:1:-1, 2) = y
        call mesh%points(back(n_points:1:-1, 1), back(n_points:1:-1, 2))
        call complete(mesh)
        call check_values(mesh, "arrays that run backwards")
        call analyse(plan, mesh)
        back(:, 2) = 0
        call check_collapsed(plan, "arrays that run backwards")
    end subroutine

    ! What the library cannot use as it lies is read again by each call that uses the mesh.
    subroutine not_doubles()
        type(odd_node), allocatable, target :: node(:)
        real(c_float), allocatable, target :: x4(:), xy4(:, :)
        type(hm_mesh) :: mesh
        type(hm_plan) :: plan
        real(dp), parameter :: nearly = 1e-4_dp
        allocate(node(n_points), xy4(2, n_points))
        node%x = real(x, c_float)
        node%y = real(y, c_float)
        call mesh%points_at(c_loc(node(1)%x), c_loc(node(1)%y), storage_size(node) / 8, n_points, precision=hm_single)
        call complete(mesh)
        call check_values(mesh, "default reals in nodes of 20 bytes", nearly)
        call analyse(plan, mesh)
        node%x = 0
        call check_collapsed(plan, "default reals in nodes")
        x4 = real(x, c_float)
        xy4(1, :) = x4
        xy4(2, :) = real(y, c_float)
        call mesh%points(xy4(1, :), xy4(2, :))
        call complete(mesh)
        call check_values(mesh, "default reals xy(1,:), xy(2,:)", nearly)
        call mesh%points(x4, xy4(2, :), stat=stat)
        call check(stat == hm_bad_argument, "default reals of different distances")
    end subroutine

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
        real(dp) :: its(n_points)
        call solve(mesh, basis, first=0)
        call basis%values(3, its)
        call check(maxval(abs(its - values)) <= 0, "cells - 1, and faces of 8 bytes")
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

    subroutine boundary_in_pieces()
        type(hm_mesh) :: mesh
        integer :: k
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
        integer(c_int32_t), allocatable :: its_faces(:, :), its_markers(:)
        real(dp), target :: bx(7, 5), by(7, 5)
        type(hm_mesh) :: mesh, block
        type(hm_plan) :: plan
        type(hm_mesh_report) :: report
        integer, allocatable :: points(:)
        logical :: loop
        types = 0
        types(:around) = body
        types(n_points - around + 1:) = far_field
        call hm_faces_of_types(int(cells, c_int32_t), int(types, c_int32_t), its_faces, its_markers)
        call check(size(its_markers) == 2 * around, "each boundary edge is a face")
        wrong = 0
        do k = 1, 2 * around
            if (.not. any(minval(faces, 1) == its_faces(1, k) .and. maxval(faces, 1) == its_faces(2, k) .and. &
                markers == its_markers(k))) wrong = wrong + 1
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

    ! A plan has its share of the mesh's copies; the mesh may go on without it.
    subroutine shared_with_plans()
        type(hm_mesh), allocatable :: mesh
        type(hm_plan) :: plan
        type(hm_basis) :: basis
        real(dp) :: its(n_points)
        allocate(mesh)
        call mesh%points(x, y)
        call complete(mesh)
        call analyse(plan, mesh)
        call mesh%cells(cells(:, :1))
        call plan%factor(stat=stat)
        call check(stat == hm_ok, "cells that a mesh gets later are not the plan's")
        deallocate(mesh)
        call plan%factor()
        call plan%solve(basis)
        call basis%values(3, its)
        call check(maxval(abs(its - values)) <= 0, "a plan outlives the mesh")
    end subroutine

    subroutine working_memory()
        type(hm_mesh) :: mesh
        type(hm_plan) :: plan
        type(hm_basis) :: basis
        type(hm_curves) :: curves
        real(dp), allocatable, target :: work(:), every_second(:, :)
        real(dp), pointer :: nothing(:)
        call mesh%points(x, y)
        call complete(mesh)
        call curves%fit(x(:around), y(:around), .true., n_control=n_control)
        call plan%analyse(mesh, curves, [hm_condition(body)])
        allocate(every_second(2, plan%basis_words()))
        call basis%init(plan, every_second(1, :), stat, err)
        call check(stat == hm_bad_argument, "work that is not contiguous: " // err%text)
        nullify(nothing)
        call basis%init(plan, nothing, stat, err)
        call check(stat == hm_bad_argument, "work that is nothing: " // err%text)
        allocate(work(2 * plan%basis_words()))
        call basis%init(plan, work(3:), stat)
        call check(stat == hm_ok, "a part of an array as work")
    end subroutine
end program
