! Compares the types and constants of the Fortran module with the structs and constants of C (layout.c): the size of
! each struct, the offset of each member, and the value of each constant; and that struct_size says the size from the
! beginning. run.sh makes layout_f.inc from the headers: it compares every struct and every constant that the
! headers declare.
program layout
    use, intrinsic :: iso_c_binding, only: c_int32_t, c_int64_t, c_loc, c_ptr, c_size_t, c_sizeof
    use harmorph
    implicit none

    interface
        function layout_of(number, numbers) result(n) bind(c)
            import :: c_int32_t, c_int64_t
            implicit none
            integer(c_int32_t), value, intent(in) :: number
            integer(c_int64_t), intent(inout) :: numbers(*)
            integer(c_int32_t) :: n
        end function
    end interface

    integer :: passed = 0, failed = 0

    include "layout_f.inc"

    print "(i0, a, i0, a)", passed, " passed, ", failed, " failed"
    if (failed > 0) error stop

contains

    ! The members are given by their addresses.
    subroutine compare(what, number, bytes, start, members)
        character(len=*), intent(in) :: what
        integer, intent(in) :: number
        integer(c_size_t), intent(in) :: bytes
        type(c_ptr), intent(in) :: start, members(:)
        integer(c_int64_t) :: ours(1 + size(members))
        integer :: k
        ours(1) = int(bytes, c_int64_t)
        do k = 1, size(members)
            ours(1 + k) = transfer(members(k), 0_c_int64_t) - transfer(start, 0_c_int64_t)
        end do
        call compare_numbers(what, number, ours)
    end subroutine

    subroutine compare_size(what, struct_size, bytes)
        character(len=*), intent(in) :: what
        integer(c_int64_t), intent(in) :: struct_size
        integer(c_size_t), intent(in) :: bytes
        if (struct_size == int(bytes, c_int64_t)) then
            passed = passed + 1
        else
            failed = failed + 1
            print "(3a, i0, a, i0)", "layout: struct_size of ", what, " is ", struct_size, ", not ", bytes
        end if
    end subroutine

    subroutine compare_numbers(what, number, ours)
        character(len=*), intent(in) :: what
        integer, intent(in) :: number
        integer(c_int64_t), intent(in) :: ours(:)
        integer(c_int64_t) :: theirs(400)
        integer :: k, n
        n = layout_of(int(number, c_int32_t), theirs)
        if (n /= size(ours)) then
            failed = failed + 1
            print "(3a, i0, a, i0)", "layout: ", what, " has ", n, " numbers in C, here ", size(ours)
        end if
        do k = 1, min(n, size(ours))
            if (theirs(k) == ours(k)) then
                passed = passed + 1
            else
                failed = failed + 1
                print "(3a, i0, a, i0, a, i0)", "layout: ", what, ", number ", k, ": ", theirs(k), " in C, here ", &
                    ours(k)
            end if
        end do
    end subroutine
end program
