! Lines of Fortran on the pages, which readme.sh saves as readme_*.inc, among what they name: they compile.
module readme_lines
    use, intrinsic :: iso_c_binding, only: c_loc
    use, intrinsic :: iso_fortran_env, only: dp => real64
    use harmorph
    implicit none
    type node_type
        integer :: number
        real(dp) :: x, y
    end type
contains
    subroutine nodes(mesh, basis, move)
        type(hm_mesh), intent(inout) :: mesh
        type(hm_basis), intent(inout) :: basis
        real(dp), intent(in) :: move(:, :)
        include "readme_nodes.inc"
    end subroutine

    subroutine variables(curves, basis, x, y, gx, gy, v)
        type(hm_curves), intent(inout) :: curves
        type(hm_basis), intent(inout) :: basis
        real(dp), intent(inout), target :: x(:), y(:)
        real(dp), intent(in) :: gx(:), gy(:), v(2, 12)
        type(hm_curves) :: moved
        type(hm_basis) :: few
        complex(dp), allocatable :: matrix(:, :)
        real(dp) :: gradient(2, 12), values(2)
        real(dp), allocatable :: slopes(:, :, :)
        include "readme_variables.inc"
    end subroutine
end module
