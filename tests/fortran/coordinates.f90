! Nodes as flow solvers have them.
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

! Coordinates in every layout, which a mesh must use in place, as they are now.
module coordinates_tests
    use, intrinsic :: iso_c_binding, only: c_double, c_float, c_int32_t, c_intptr_t, c_loc, c_null_ptr, c_ptr
    use kept
    use nodes
    implicit none
    private
    public :: derived_types, addresses, pointers, sections, not_doubles, one_array_twice

contains

    ! Compilers that associate a pointer with components give them in place; others are found out.
    subroutine derived_types()
        type(solver_node), allocatable, target :: node(:)
        type(hm_mesh) :: mesh
        type(hm_plan) :: plan
        type(hm_error) :: err
        integer :: stat
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

    ! Without stat: stops the program.
    subroutine one_array_twice()
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
        type(hm_error) :: err
        integer :: stat
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
        call any_bounds(0)
        call any_bounds(-3)
        call any_bounds(2)
    end subroutine

    ! A pointer has the lower bound of its target: the first point of the mesh is the first of the array.
    subroutine any_bounds(first)
        integer, intent(in) :: first
        real(dp), allocatable, target :: ax(:), ay(:)
        real(dp), pointer :: px(:), py(:)
        type(hm_mesh) :: mesh
        allocate(ax(first:first + n_points - 1), ay(first:first + n_points - 1))
        ax = x
        ay = y
        call mesh%points(ax, ay)
        call complete(mesh)
        call check_values(mesh, "arrays of any lower bound")
        px(first:) => ax
        py(first:) => ay
        call through_pointers(px, py, "pointers of any lower bound")
    end subroutine

    subroutine through_pointers(px, py, what)
        real(dp), pointer, intent(in) :: px(:), py(:)
        character(len=*), intent(in) :: what
        type(hm_mesh) :: mesh
        type(hm_error) :: err
        integer :: stat
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
        type(hm_error) :: err
        integer :: stat
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

    ! Each call that uses the mesh reads arrays again that the library cannot use as they lie in memory.
    subroutine not_doubles()
        type(odd_node), allocatable, target :: node(:)
        real(c_float), allocatable, target :: x4(:), xy4(:, :)
        type(hm_mesh) :: mesh
        type(hm_plan) :: plan
        real(dp), parameter :: nearly = 1e-4_dp
        integer :: stat
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
end module
