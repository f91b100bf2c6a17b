! The wall turns about the origin by DEGREES in each time step. FOLLOW=1: harmorph moves all points. FOLLOW=0: the
! points of the wall are given, and the others move by the diffusion of code_saturne. ntcabs is the number of the time
! step; code_saturne 6.0 leaves itrale undefined in the first call, and counts it from the start of each run.
subroutine usalcl(itrale, nvar, nscal, icodcl, itypfb, ialtyb, impale, dt, rcodcl, xyzno0, disale)
    use paramx
    use mesh
    use entsor, only: nfecra
    use optcal, only: ntcabs, ntpabs
    use moving_mesh
    implicit none
    integer :: itrale, nvar, nscal, icodcl(nfabor, nvar), itypfb(nfabor), ialtyb(nfabor), impale(nnod)
    double precision :: dt(ncelet), rcodcl(nfabor, nvar, 3), disale(3, nnod), xyzno0(3, nnod)
    integer :: list(nfabor), n, k, i, follow
    double precision :: degrees, angle, least, begin, end, moved(3, nnod)
    character(len=32) :: text
    logical, save :: is_new = .true.

    call get_environment_variable("DEGREES", text)
    read(text, *) degrees
    call get_environment_variable("FOLLOW", text)
    read(text, *) follow
    if (is_new) call start_mesh(xyzno0)
    is_new = .false.
    if (ntcabs > ntpabs) then    ! the mesh as the last time step left it
        least = quality_of(xyznod)
        write(nfecra, "(a, f8.2, a, f9.6)") "mesh at ", (ntcabs - 1) * degrees, " degrees: smallest quality ", least
    end if
    call getfbr("3", n, list)
    ialtyb(list(:n)) = igliss
    call getfbr("2", n, list)
    ialtyb(list(:n)) = ibfixe
    angle = ntcabs * degrees * atan(1d0) / 45

    call getfbr("1", n, list)
    if (follow == 1) then
        call cpu_time(begin)
        call follow_wall(angle, moved)
        call cpu_time(end)
        write(nfecra, "(a, f9.3, a)") "harmorph: ", 1000 * (end - begin), " ms for the displacements"
        disale = moved
        impale = 1
    else
        do k = 1, n
            do i = ipnfbr(list(k)), ipnfbr(list(k) + 1) - 1
                associate (p => xyzno0(:, nodfbr(i)))
                    disale(:, nodfbr(i)) = [cos(angle) * p(1) - sin(angle) * p(2) - p(1), &
                        sin(angle) * p(1) + cos(angle) * p(2) - p(2), 0d0]
                end associate
                impale(nodfbr(i)) = 1
            end do
        end do
    end if
end subroutine
