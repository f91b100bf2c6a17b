! usage: read_su2 FILE   What the Fortran reader finds in an SU2 file, in the words of read_su2.c.
program show
    use, intrinsic :: iso_fortran_env, only: int64
    use read_su2
    implicit none
    type(su2_mesh) :: mesh
    character(len=256) :: file
    character(len=160) :: message
    character(len=40) :: sum_of_points
    integer(int64) :: cells, faces, i, k
    integer :: stat
    call get_command_argument(1, file)
    call read_su2_mesh(trim(file), mesh, stat, message)
    if (stat /= 0) then
        print "(2a)", "refused: ", trim(message)
        if (allocated(mesh%x)) error stop
        stop
    end if
    cells = 0
    do k = 1, size(mesh%start) - 1
        do i = mesh%start(k), mesh%start(k + 1) - 1
            cells = cells + modulo(k, 1000_int64) * mesh%cells(i)
        end do
    end do
    faces = 0
    do k = 1, size(mesh%markers)
        faces = faces + mesh%markers(k) * (mesh%faces(1, k) + 7_int64 * mesh%faces(2, k))
    end do
    print "(a, i0, a, i0, a, i0)", "points ", size(mesh%x), " cells ", size(mesh%start) - 1, " faces ", &
        size(mesh%markers)
    write(sum_of_points, "(f0.5)") sum(mesh%x - 3 * mesh%y)
    print "(2a, 2(1x, i0))", "sums ", with_zero(trim(sum_of_points)), cells, faces
    do k = 1, size(mesh%names)
        print "(2a)", "marker ", trim(mesh%names(k))
    end do
    print "(a, i0)", "airfoil is ", su2_marker(mesh, "airfoil")

contains
    ! Writes a number as C does, with a digit before the point.
    function with_zero(number) result(text)
        character(len=*), intent(in) :: number
        character(len=:), allocatable :: text
        text = number
        if (text(1:1) == ".") text = "0" // text
        if (text(1:2) == "-.") text = "-0" // text(2:)
    end function
end program
