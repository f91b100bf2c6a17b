! read_namelist < FILE: what `harmorph morph --curve-out shape.nml` wrote,
! one number on a line as read_curves.awk prints it.
program read_namelist
    use, intrinsic :: iso_fortran_env, only: dp => real64, iostat_end
    implicit none
    integer, parameter :: most = 1000
    integer :: n, degree, n_indices, indices(most), status, i
    real(dp) :: xy(2, most), weights(most), knots(most)
    character(8) :: closed
    namelist /control_points/ n, xy, weights
    namelist /curve/ degree, closed, n_indices, indices, knots

    weights = 1
    read (*, nml=control_points)
    do
        read (*, nml=curve, iostat=status)
        if (status == iostat_end) exit
        if (status /= 0) error stop "a curve cannot be read"
        print "(a, i0)", "degree ", degree
        do i = 1, n_indices + degree + 1
            call show("knot", knots(i))
        end do
        do i = 1, n_indices
            call show("x", xy(1, indices(i)))
            call show("y", xy(2, indices(i)))
            call show("weight", weights(indices(i)))
        end do
    end do
contains
    subroutine show(name, value)
        character(*), intent(in) :: name
        real(dp), intent(in) :: value
        print "(a, 1x, es25.17e3)", name, value
    end subroutine
end program
