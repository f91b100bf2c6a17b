! A laminar flow on a moving mesh; the environment variable STEPS is the number of time steps.
subroutine usipph(ixmlpu, iturb, itherm, iale)
    implicit none
    integer :: ixmlpu, iturb, itherm, iale
    iturb = 0
    iale = 1
end subroutine

subroutine usipsu(nmodpp)
    use optcal, only: ntmabs, dtref
    use albase, only: nalinf
    use cstphy, only: ro0, viscl0
    implicit none
    integer :: nmodpp
    character(len=32) :: text
    call get_environment_variable("STEPS", text)
    read(text, *) ntmabs
    dtref = 0.01d0
    nalinf = 0
    ro0 = 1
    viscl0 = 0.01d0
end subroutine
