! Reads two-dimensional meshes in the format of SU2. Compile this source with your code. MIT licence.
!
!     use read_su2
!     type(su2_mesh), target :: file                  TARGET: harmorph uses file%x and file%y in place
!     call read_su2_mesh("naca0012.su2", file)        stops the program with the reason; or stat=, message=
!     call mesh%points(file%x, file%y)
!     call mesh%cells(file%cells, file%start)
!     call mesh%faces(file%faces, file%markers)       the number of a marker is the place in file%names:
!     wall = su2_marker(file, "airfoil")              0 if there is no such name
!
! The file contains NDIME= 2, NELEM with triangles (5) and quads (9), NPOIN, NMARK, MARKER_TAG, and MARKER_ELEMS with
! lines (3), in any order, with comments (%) and further numbers at the ends of lines. Markers of single points (1), as
! SEND_RECEIVE has them, and other keywords are ignored. Three dimensions, several zones, files that are cut off, and
! numbers of points that do not exist are refused. Points count from 1 here and from 0 in the file.
module read_su2
    use, intrinsic :: iso_fortran_env, only: error_unit, int32, real64
    implicit none
    private
    public :: read_su2_mesh, su2_marker

    type, public :: su2_mesh
        real(real64), allocatable :: x(:), y(:)
        integer(int32), allocatable :: cells(:), start(:)       ! cell k has the points cells(start(k):start(k+1)-1)
        integer(int32), allocatable :: faces(:, :), markers(:)  ! (2,n) and (n)
        character(len=64), allocatable :: names(:)              ! names of the markers, in the order of the file
    end type

    type :: reader
        integer :: unit = 0, line_number = 0, markers = 0, markers_said = 0
        character(len=256) :: line = ""
        character(len=160) :: message = ""                      ! the first error
    end type

contains
    ! stat is 0, or 1 if the file is refused; then message has the reason, and the mesh is empty.
    subroutine read_su2_mesh(file, mesh, stat, message)
        character(len=*), intent(in) :: file
        type(su2_mesh), intent(out) :: mesh
        integer, intent(out), optional :: stat
        character(len=*), intent(inout), optional :: message
        type(reader) :: from
        type(su2_mesh) :: empty
        integer :: failed
        open(newunit=from%unit, file=file, status="old", action="read", iostat=failed, iomsg=from%message)
        if (failed == 0) then
            from%message = ""
            allocate(mesh%x(0), mesh%y(0), mesh%cells(0), mesh%start(1), mesh%faces(2, 0), mesh%markers(0), &
                mesh%names(0))
            mesh%start = 1
            call read_sections(from, mesh)
            if (from%message == "") call check_points(from, mesh)
            close(from%unit)
        end if
        if (from%message /= "") mesh = empty
        if (present(message)) message = from%message
        if (present(stat)) then
            stat = merge(1, 0, from%message /= "")
        else if (from%message /= "") then
            write(error_unit, "(3a)") file, ": ", trim(from%message)
            error stop "read_su2: refused"
        end if
    end subroutine

    pure integer function su2_marker(mesh, name)
        type(su2_mesh), intent(in) :: mesh
        character(len=*), intent(in) :: name
        integer :: k
        su2_marker = 0
        if (.not. allocated(mesh%names)) return
        do k = 1, size(mesh%names)
            if (mesh%names(k) == name) su2_marker = k
        end do
    end function

    subroutine read_sections(from, mesh)
        type(reader), intent(inout) :: from
        type(su2_mesh), intent(inout) :: mesh
        character(len=32) :: key
        integer :: equals, n
        do while (from%message == "")
            if (.not. next_line(from)) exit
            equals = index(from%line, "=")
            if (equals == 0) cycle
            key = adjustl(from%line(:equals - 1))
            select case (key)
            case ("NDIME")
                if (count_in(from) /= 2) call refuse(from, "only two dimensions are read")
            case ("NZONE")
                if (count_in(from) /= 1) call refuse(from, "only files of one zone are read")
            case ("NELEM")
                n = count_in(from)
                call read_cells(from, n, mesh%cells, mesh%start)
            case ("NPOIN")
                n = count_in(from)
                call read_points(from, n, mesh%x, mesh%y)
            case ("NMARK")
                from%markers_said = count_in(from)
            case ("MARKER_TAG")
                call read_marker(from, trim(adjustl(from%line(equals + 1:))), mesh)
            end select
        end do
    end subroutine

    subroutine read_cells(from, n, cells, start)
        type(reader), intent(inout) :: from
        integer, intent(in) :: n
        integer(int32), allocatable, intent(inout) :: cells(:), start(:)
        integer(int32) :: row(4)
        integer :: k, m, kind, used, failed
        if (from%message /= "") return
        deallocate(cells, start)
        allocate(cells(4 * n), start(n + 1), stat=failed)
        if (failed /= 0) call refuse(from, "no memory for so many cells")
        used = 0
        do k = 1, n
            if (.not. need_line(from, "cells", k, n)) return
            read(from%line, *, iostat=failed) kind
            m = 0
            if (failed == 0 .and. kind == 5) m = 3
            if (failed == 0 .and. kind == 9) m = 4
            if (m == 0) call refuse(from, "expected a triangle (5 and 3 points) or a quad (9 and 4 points)")
            if (m > 0) read(from%line, *, iostat=failed) kind, row(:m)
            if (failed /= 0) call refuse(from, "a cell has too few points")
            if (from%message /= "") return
            start(k) = int(used + 1, int32)
            cells(used + 1:used + m) = row(:m) + 1_int32
            used = used + m
        end do
        start(n + 1) = int(used + 1, int32)
        cells = cells(:used)
    end subroutine

    subroutine read_points(from, n, x, y)
        type(reader), intent(inout) :: from
        integer, intent(in) :: n
        real(real64), allocatable, intent(inout) :: x(:), y(:)
        integer :: k, failed
        if (from%message /= "") return
        deallocate(x, y)
        allocate(x(n), y(n), stat=failed)
        if (failed /= 0) call refuse(from, "no memory for so many points")
        do k = 1, n
            if (.not. need_line(from, "points", k, n)) return
            read(from%line, *, iostat=failed) x(k), y(k)
            if (failed /= 0) call refuse(from, "expected the two coordinates of a point")
            if (from%message /= "") return
        end do
    end subroutine

    ! Reads MARKER_ELEMS and the faces behind a tag; SEND_TO may be in between.
    subroutine read_marker(from, name, mesh)
        type(reader), intent(inout) :: from
        character(len=*), intent(in) :: name
        type(su2_mesh), intent(inout) :: mesh
        integer(int32), allocatable :: faces(:, :)
        integer :: k, n, kind, kept, failed
        from%markers = from%markers + 1
        do
            if (.not. need_line(from, "markers", 0, 0)) return
            if (adjustl(from%line(:max(index(from%line, "=") - 1, 0))) == "MARKER_ELEMS") exit
            if (index(from%line, "SEND_TO") == 0) call refuse(from, "expected MARKER_ELEMS= of marker " // name)
        end do
        n = count_in(from)
        if (from%message /= "") return
        allocate(faces(2, n))
        kept = 0
        k = 0
        do while (k < n)
            if (.not. need_line(from, "faces of marker " // name, k + 1, n)) return
            if (index(from%line, "SEND_TO") > 0) cycle
            k = k + 1
            read(from%line, *, iostat=failed) kind
            if (failed == 0 .and. kind == 1) cycle
            if (failed /= 0 .or. kind /= 3) call refuse(from, "expected a line (3 and 2 points) of marker " // name)
            if (from%message /= "") return
            kept = kept + 1
            read(from%line, *, iostat=failed) kind, faces(:, kept)
            if (failed /= 0) call refuse(from, "a face has too few points")
        end do
        if (kept == 0) return
        mesh%names = [character(len=64) :: mesh%names, name]
        mesh%faces = reshape([mesh%faces, faces(:, :kept) + 1_int32], [2, size(mesh%faces, 2) + kept])
        mesh%markers = [mesh%markers, spread(int(size(mesh%names), int32), 1, kept)]
    end subroutine

    subroutine check_points(from, mesh)
        type(reader), intent(inout) :: from
        type(su2_mesh), intent(in) :: mesh
        integer :: n
        n = size(mesh%x)
        from%line_number = 0
        if (n == 0) call refuse(from, "the file has no points (NPOIN)")
        if (size(mesh%cells) == 0) call refuse(from, "the file has no cells (NELEM)")
        if (from%markers < from%markers_said) call refuse(from, "the file has fewer markers than NMARK says")
        if (any(mesh%cells < 1 .or. mesh%cells > n)) call refuse(from, "a cell names a point that the file has not")
        if (any(mesh%faces < 1 .or. mesh%faces > n)) call refuse(from, "a face names a point that the file has not")
    end subroutine

    ! ---- Lines

    ! Reads the next line that is neither empty nor a comment.
    logical function next_line(from)
        type(reader), intent(inout) :: from
        integer :: failed, percent
        do
            read(from%unit, "(a)", iostat=failed) from%line
            next_line = failed == 0
            if (.not. next_line) return
            from%line_number = from%line_number + 1
            percent = index(from%line, "%")
            if (percent > 0) from%line(percent:) = ""
            percent = index(from%line, achar(13))               ! the line may end as on other systems
            if (percent > 0) from%line(percent:) = ""
            if (from%line /= "") return
        end do
    end function

    logical function need_line(from, what, k, n)
        type(reader), intent(inout) :: from
        character(len=*), intent(in) :: what
        integer, intent(in) :: k, n
        character(len=40) :: numbers
        need_line = .false.
        if (from%message /= "") return
        need_line = next_line(from)
        if (need_line) return
        numbers = ""
        if (n > 0) write(numbers, "(a, i0, a, i0)") ": ", k, " of ", n
        call refuse(from, "the file ends among the " // what // trim(numbers))
    end function

    ! The number behind the equals sign.
    integer function count_in(from)
        type(reader), intent(inout) :: from
        integer :: failed
        count_in = 0
        read(from%line(index(from%line, "=") + 1:), *, iostat=failed) count_in
        if (failed /= 0 .or. count_in < 0) call refuse(from, "expected a number behind =")
        if (failed /= 0 .or. count_in < 0) count_in = 0
    end function

    subroutine refuse(from, reason)
        type(reader), intent(inout) :: from
        character(len=*), intent(in) :: reason
        if (from%message /= "") return
        from%message = reason
        if (from%line_number > 0) write(from%message, "(a, i0, 2a)") "line ", from%line_number, ": ", reason
    end subroutine
end module
