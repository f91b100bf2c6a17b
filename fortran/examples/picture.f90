! Draws a picture of the inverse design: the airfoils, their pressures, and the convergence.
module picture
    use, intrinsic :: iso_fortran_env, only: dp => real64
    implicit none
    private
    public :: draw_target, draw_start, draw_result, write_picture
    type :: airfoil_data
        real(dp), allocatable :: x(:), y(:), middle(:), cp(:)
    end type
    type(airfoil_data) :: drawn(3)              ! target, start, result
    character(len=*), parameter :: colour(3) = ["#111111", "#2266cc", "#cc3322"]
    character(len=*), parameter :: label(3) = ["target", "start ", "result"]

contains

    subroutine draw_target(x, y, middle, cp)
        real(dp), intent(in) :: x(:), y(:), middle(:), cp(:)
        drawn(1) = airfoil_data(x, y, middle, cp)
    end subroutine

    subroutine draw_start(x, y, middle, cp)
        real(dp), intent(in) :: x(:), y(:), middle(:), cp(:)
        drawn(2) = airfoil_data(x, y, middle, cp)
    end subroutine

    subroutine draw_result(x, y, middle, cp)
        real(dp), intent(in) :: x(:), y(:), middle(:), cp(:)
        drawn(3) = airfoil_data(x, y, middle, cp)
    end subroutine

    ! Writes three panels, one below the other.
    subroutine write_picture(file, error)
        character(len=*), intent(in) :: file
        real(dp), intent(in) :: error(:)
        integer :: unit, k
        real(dp) :: decades
        open(newunit=unit, file=file, status="replace", action="write")
        write(unit, "(a)") '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 720 740" font-family="sans-serif"'
        write(unit, "(a)") ' font-size="13">'
        write(unit, "(a)") '<rect width="720" height="740" fill="white"/>'
        do k = 1, 3
            call line(unit, 40 + 640 * [drawn(k)%x, drawn(k)%x(1)], 110 - 640 * [drawn(k)%y, drawn(k)%y(1)], k)
            call line(unit, 40 + 640 * drawn(k)%middle, 370 + 120 * drawn(k)%cp, k)
            call text(unit, 600, 30 + 18 * k, trim(label(k)), colour(k))
        end do
        decades = ceiling(-log10(minval(error) / error(1)))
        call line(unit, 40 + 640 * [(real(k, dp), k = 0, size(error) - 1)] / max(size(error) - 1, 1), &
            560 - 160 / decades * log10(error / error(1)), 3)
        do k = 0, nint(decades)
            write(unit, "(a, i0, a, i0, a)") '<path d="M40 ', nint(560 + 160 * k / decades), 'h640" stroke="#ccc"/>'
            call text(unit, 5, nint(564 + 160 * k / decades), "1e-" // achar(iachar("0") + k), "#555555")
        end do
        call text(unit, 40, 20, "airfoils", "#111111")
        call text(unit, 40, 200, "pressure coefficient, suction up", "#111111")
        call text(unit, 40, 545, "pressure error by steps, first step = 1", "#111111")
        write(unit, "(a)") '</svg>'
        close(unit)
    end subroutine

    subroutine line(unit, x, y, k)
        integer, intent(in) :: unit, k
        real(dp), intent(in) :: x(:), y(:)
        integer :: i
        write(unit, "(5a)") '<polyline fill="none" stroke="', colour(k), '" stroke-width="', &
            merge("4  ", "1.5", k == 1), '" points="'
        write(unit, "(2(f0.2, 1x))") (x(i), y(i), i = 1, size(x))
        write(unit, "(a)") '"/>'
    end subroutine

    subroutine text(unit, x, y, words, fill)
        integer, intent(in) :: unit, x, y
        character(len=*), intent(in) :: words, fill
        write(unit, "(a, i0, a, i0, 5a)") '<text x="', x, '" y="', y, '" fill="', fill, '">', words, '</text>'
    end subroutine
end module
