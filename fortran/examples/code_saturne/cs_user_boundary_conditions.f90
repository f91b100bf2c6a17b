! The flow enters from the left; the two planes are symmetry planes, and the ellipse is a wall.
subroutine cs_f_user_boundary_conditions(nvar, nscal, icodcl, itrifb, itypfb, izfppp, dt, rcodcl)
    use paramx
    use numvar
    use mesh
    implicit none
    integer :: nvar, nscal, icodcl(nfabor, nvar), itrifb(nfabor), itypfb(nfabor), izfppp(nfabor)
    double precision :: dt(ncelet), rcodcl(nfabor, nvar, 3)
    integer :: list(nfabor), n
    call getfbr("1", n, list)
    itypfb(list(:n)) = iparoi
    call getfbr("3", n, list)
    itypfb(list(:n)) = isymet
    call getfbr("2 and x < 0", n, list)
    itypfb(list(:n)) = ientre
    rcodcl(list(:n), iu, 1) = 1
    rcodcl(list(:n), iv, 1) = 0
    rcodcl(list(:n), iw, 1) = 0
    call getfbr("2 and x >= 0", n, list)
    itypfb(list(:n)) = isolib
end subroutine
