! The method of Broyden, Fletcher, Goldfarb and Shanno: it builds the inverse of the Hessian from steps and changes of
! the slope.
module bfgs
    use, intrinsic :: iso_fortran_env, only: dp => real64
    implicit none
    private
    public :: scaled_identity, update

contains

    ! A multiple of the unit matrix such that the first step changes no variable by more than longest.
    pure function scaled_identity(slope, longest) result(h)
        real(dp), intent(in) :: slope(:), longest
        real(dp) :: h(size(slope), size(slope))
        integer :: k
        h = 0
        do k = 1, size(slope)
            h(k, k) = longest / maxval(abs(slope))
        end do
    end function

    ! Updates the matrix after the step ds, which changed the slope by dg.
    pure subroutine update(h, ds, dg)
        real(dp), intent(inout) :: h(:, :)
        real(dp), intent(in) :: ds(:), dg(:)
        real(dp) :: hg(size(dg)), curvature
        curvature = dot_product(ds, dg)
        if (curvature <= 0) return
        hg = matmul(h, dg)
        h = h + (1 + dot_product(dg, hg) / curvature) / curvature * outer(ds, ds) - &
            (outer(ds, hg) + outer(hg, ds)) / curvature
    end subroutine

    pure function outer(u, v) result(uv)
        real(dp), intent(in) :: u(:), v(:)
        real(dp) :: uv(size(u), size(v))
        uv = spread(u, 2, size(v)) * spread(v, 1, size(u))
    end function
end module
