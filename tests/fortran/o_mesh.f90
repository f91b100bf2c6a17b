! The mesh of the tests with MPI: a block round an ellipse, its first and last column a cut.
module o_mesh
    use, intrinsic :: iso_fortran_env, only: dp => real64
    use harmorph
    implicit none
    private
    public :: make_o_mesh

contains
    subroutine make_o_mesh(x, y, mesh, wall, far)
        real(dp), pointer, intent(in) :: x(:, :), y(:, :)
        type(hm_mesh), intent(inout) :: mesh
        integer, intent(in) :: wall, far
        real(dp) :: angle, r
        integer :: i, j, ni, nj
        ni = size(x, 1)
        nj = size(x, 2)
        do j = 1, nj
            do i = 1, ni
                angle = 6.283185307179586_dp * modulo(i - 1, ni - 1) / (ni - 1)
                r = exp(3._dp * (j - 1) / (nj - 1))
                x(i, j) = (r + 0.6_dp / r) * cos(angle)
                y(i, j) = (r - 0.6_dp / r) * sin(angle)
            end do
        end do
        call mesh%points(x, y)
        call mesh%line(wall, 1, ni, 1, 1)
        call mesh%line(far, 1, ni, nj, nj)
    end subroutine
end module
