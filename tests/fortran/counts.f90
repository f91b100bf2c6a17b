! Counts the checks that hold and the checks that fail.
module counts
    implicit none
    integer :: passed = 0, failed = 0

contains

    subroutine check(holds, what)
        logical, intent(in) :: holds
        character(len=*), intent(in) :: what
        if (holds) then
            passed = passed + 1
        else
            failed = failed + 1
            print "(2a)", "use: ", what
        end if
    end subroutine

    subroutine tell_counts()
        print "(i0, a, i0, a)", passed, " passed, ", failed, " failed"
        if (failed > 0) error stop
    end subroutine
end module
