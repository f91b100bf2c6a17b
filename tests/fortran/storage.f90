! A basis in files and streams, as an array of numbers, and in single precision.
module storage_tests
    use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t
    use body_mesh
    implicit none
    private
    public :: files, single_precision

contains

    subroutine files()
        type(hm_basis) :: copy, second
        real(dp) :: a(n_points), b(n_points)
        real(dp), allocatable, target :: block(:)
        real(dp), target :: x_moved(n_points)
        type(hm_mesh) :: other
        integer(c_int64_t) :: length
        integer(c_int32_t) :: mark
        integer :: unit
        character(len=*), parameter :: name = "use_basis.tmp"
        type(hm_error) :: err
        integer :: stat
        call basis%save(name)
        call copy%load(name, mesh)
        call basis%values(5, a)
        call copy%values(5, b)
        call check(same(a, b), "saved and loaded: the same")

        ! Two of them in one stream, with something round them.
        open(newunit=unit, file=name, access="stream", form="unformatted", status="replace", action="readwrite")
        write(unit) 17_c_int32_t
        call basis%write(unit)
        length = basis%bytes()
        write(unit) length
        call basis%write(unit)
        rewind(unit)
        read(unit) mark
        call copy%read(unit, mesh, bytes=length)
        read(unit) length
        call second%read(unit)
        call copy%values(5, a)
        call second%values(5, b)
        call check(same(a, b), "two in one stream")
        call check(length == second%bytes(), "their length")
        call second%read(unit, stat=stat, err=err)
        call check(stat == hm_bad_basis, "nothing left to read: " // err%text)
        rewind(unit)
        call second%read(unit, stat=stat, err=err)
        call check(stat == hm_bad_basis, "not a basis: " // err%text)
        close(unit, status="delete")
        call copy%load("no/such/file", stat=stat, err=err)
        call check(stat == hm_bad_basis .and. err%text /= "", "no such file: " // err%text)
        call basis%save("no/such/file", stat=stat)
        call check(stat == hm_bad_basis, "a file that cannot be written")

        ! A basis as an array of numbers: attached where it lies.
        allocate(block((basis%bytes() + 7) / 8))
        call basis%save(name)
        open(newunit=unit, file=name, access="stream", form="unformatted", action="read")
        read(unit) block(:basis%bytes() / 8)
        close(unit, status="delete")
        if (modulo(basis%bytes(), 8_c_int64_t) == 0) then
            call copy%attach(block, mesh)
            call copy%values(5, b)
            call check(same(a, b), "attached")
            x_moved = 2 * x
            call other%points(x_moved, y)
            call other%cells(cells)
            call other%faces(faces, markers)
            call copy%attach(block, other, stat)
            call check(stat == hm_moved, "the same mesh with other coordinates")
            call copy%attach(block(:10), stat=stat)
            call check(stat == hm_bad_basis, "cut short")
        end if
        call copy%free()
        call copy%values(1, a, stat=stat)
        call check(stat == hm_bad_argument, "nothing is left of it")
    end subroutine

    ! Functions in single precision: the wall moves as before, the rest nearly so; the adjoint follows.
    subroutine single_precision()
        type(hm_basis) :: narrow, again
        type(hm_basis_info) :: info, whole
        type(hm_plan) :: plan
        type(hm_curves) :: curves
        real(dp) :: move(2, n_control), gradient(2, n_control)
        real(dp), dimension(n_points) :: dx, dy, new_dx, new_dy
        real(dp), allocatable, target :: work(:)
        integer :: stat
        move = some_move()
        call basis%displacement(move, dx, dy)
        call basis%single(narrow)
        call basis%info(whole)
        call narrow%info(info)
        call check(info%storage == hm_single .and. whole%storage == hm_double .and. info%solved .and. &
            2 * info%bytes < whole%bytes + whole%bytes / 2, "a basis in single precision is smaller")
        call narrow%displacement(move, new_dx, new_dy)
        call check(same(new_dx(info%curve_point), dx(info%curve_point)), "the wall moves bit by bit as before")
        call check(maxval(abs(new_dx - dx)) > 0 .and. &
            maxval(abs(new_dx - dx)) < 1e-7_dp * maxval(abs(move)) * n_control, &
            "the rest nearly so")
        call narrow%adjoint(new_dx, new_dy, gradient)
        call check(abs(sum(gradient * move) / (sum(new_dx**2) + sum(new_dy**2)) - 1) < 1e-13_dp, "and its transpose")
        allocate(work(basis%single_words()))
        call basis%single(again, work(2:), stat)
        call check(stat == hm_block_too_small, "work 8 bytes too small")
        call basis%single(again, work)
        call again%displacement(move, dx, dy)
        call check(same(dx, new_dx) .and. same(dy, new_dy), "in work")
        call check(narrow%single_words() == 0, "single precision twice: no size")
        call narrow%single(again, stat=stat)
        call check(stat == hm_unsupported, "single precision twice")
        call basis%curves(curves)
        call plan%analyse(mesh, curves, [hm_condition(body)])
        call plan%factor()
        new_dx = dx
        call plan%morph_safe(narrow, move, dx, dy, stat=stat)
        call check(stat == hm_unsupported .and. same(dx, new_dx), "a safe morph needs double precision")
    end subroutine
end module
