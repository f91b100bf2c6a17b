! harmorph for FORTRAN 77: external subroutines, plain arrays, no modules at the caller. MIT licence. Compile after
! harmorph.f90 with the caller's compiler and link both, and libharmorph.a.
!
!     DOUBLE PRECISION W(LW)                       everything that is kept is in W; several W are several meshes
!     CALL HMOPEN (W, LW, IERR, MSG)
!     CALL HMMESH (W, NP, X, Y, INC, NC, NPC, CELLS, NF, FACES, MARKS, IERR, MSG)      CELLS(NPC,NC), FACES(2,NF),
!                                                                                      MARKS(NF)
!     CALL HMTYPE (W, ITYPE, IERR, MSG)                          after HMMESH with NF = 0, for a boundary given by types
!                                                                of points: ITYPE(NP) is 0 for inner points, for others
!                                                                a mark. A face between two types has the larger one
!  or CALL HMBLOK (W, NI, NJ, X, Y, MARKS, IERR, MSG)      structured; MARKS(4) of sides i=1, i=NI, j=1, j=NJ, 0: a cut
!     CALL HMWALL (W, MARK, NMAX, IPTS, N, LOOP, IERR, MSG)      a marker's points IPTS(N) in order; LOOP 1: closed
!     CALL HMFIT  (W, MARK, NCP, IDEG, ICLOS, DMAX, IERR, MSG)   curve through a marker; ICLOS as hm_closed_auto, ...
!  or CALL HMCTRL (W, NCP, P, IERR, MSG)                         control points P(2,NCP); forgets all curves; then
!     CALL HMCURV (W, IDEG, NIDX, IDX, U, IERR, MSG)             a curve through control points IDX(NIDX), knots
!                                                                U(NIDX+IDEG+1)
!     CALL HMCOND (W, MARK, KIND, ICURV, NCURV, IERR, MSG)       KIND 0: on curves ICURV..ICURV+NCURV-1, 2 fixed
!                                                                (as markers without condition), 3 slips along its
!                                                                straight lines, 4 free (not with OPERATOR 0), 6 moved
!                                                                by HMGIVE; ICURV and NCURV both 0 or 1 then
!     CALL HMRIGD (W, MARK, IBODY, XC, YC, IERR, MSG)            belongs to rigid body IBODY, which turns about XC, YC
!     CALL HMPAIR (W, MARK, MARK2, IERR, MSG)                    these two are translates of each other and move alike
!     CALL HMNEAR (W, X, Y, IERR, MSG)                           the last condition is only of the piece of its marker
!                                                                that is nearest to X, Y: one of several bodies or sides
!     CALL HMOPT  (W, NAME, IVAL, IERR, MSG)                     before HMSOLV; NAME and values of hm_options:
!                                                                'OPERATOR' 0 conformal, 1 Laplace, 2 weighted;
!                                                                'EXPONENT' 4 q of the weight 1/d**q, -1: no weight;
!                                                                'SCHEME', 'ENGINE', 'KERNEL', 'OFFSET', 'PRECISION'
!     CALL HMSOLV (W, RESID, IERR, MSG)                          the functions, and their residual. IERR 1: not converged;
!                                                                IERR 5: solved, but a point lies far from its curve,
!                                                                see MSG: is the marker the right one?
!     CALL HMFACT (W, RESID, IERR, MSG)                          as HMSOLV, and W keeps the factor for HMGIVE, HMGADJ
!     CALL HMGIVE (W, N, IP, WX, WY, DX, DY, INC, IERR, MSG)     displacements DX, DY of all mesh points from WX(N),
!                                                                WY(N) of the points IP(N), all of the markers of HMCOND
!                                                                with KIND 6: any number of times, each as a
!                                                                substitution; of velocities: velocities
!     CALL HMGADJ (W, N, IP, GX, GY, INC, HX, HY, IERR, MSG)     the transpose: HX(N), HY(N) from GX, GY of mesh points
!     CALL HMGSAF (W, N, IP, WX, WY, DP, XN, YN, INC, FRAC,      XN, YN: the mesh of HMMESH moved by WX, WY and, if there
!                  ISTRAT, IERR, MSG)                            are curves or rigid bodies, by DP, so that no cell is
!                                                                inverted; see HMSAFE. After HMSOLV or HMFACT
!     CALL HMGETP (W, NMAX, P, NCP, IERR, MSG)                   the control points P(2,NCP)
!     CALL HMMEAS (W, KIND, STATN, DP, VALUE, G, IERR, MSG)      area, thickness, ...: quantity KIND of hm_measure, at
!                                                                the station STATN or 0, of all curves after the
!                                                                movement DP; G(2,NCP): its derivatives
!     CALL HMMORF (W, DP, X, Y, INC, IERR, MSG)                  moves mesh points X, Y in place; DP(2,NCP), or with
!                                                                rigid bodies DP(2,NCP+2*NBODY), see hm_morph
!     CALL HMSAFE (W, DP, XN, YN, INC, DR, FRAC, ISTRAT, IERR,   XN, YN: the mesh of HMMESH moved so that no cell is
!                  MSG)                                          inverted, however large DP is; FRAC: how much of DP
!                                                                (IERR 3: not all), DR, like DP: the movement that XN,
!                                                                YN have, as bodies turn on the way not FRAC*DP then;
!                                                                ISTRAT 0: as HMMORF, 2: in several steps, 3: untangled
!     CALL HMDISP (W, DP, DX, DY, INC, IERR, MSG)                displacements alone; of velocities: velocities
!     CALL HMADJ  (W, GX, GY, INC, G, IERR, MSG)                 gradient G(2,NCP) by control points from mesh points'
!     CALL HMSTEP (W, X, Y, DX, DY, INC, S, ICELL, IERR, MSG)    largest S for which X + S*DX has no inverted cell
!     CALL HMQUAL (W, X, Y, INC, NINV, AMIN, QMIN, IERR, MSG)    inverted cells, least corner area, least quality
!     CALL HMSAVE (W, LUN, IERR, MSG), HMLOAD (same)             the functions to, from an open unformatted file
!     CALL HMSNGL (W, IERR, MSG)                                 the functions in W in single precision, but on the
!                                                                wall: half the room, HMMORF and HMADJ are faster. Not
!                                                                before HMSAFE
!     CALL HMCLOS (W)                                            W is free for other use
!
! Default INTEGER of 4 bytes. Coordinates are X(1), X(1+INC), ...; all counts begin with 1. IERR: 0 done, above 0 a
! warning, below 0 refused with the reason in MSG, CHARACTER*112 or so. -7: W is too small; MSG says what it needs, as
! far as is known. X, Y, CELLS, FACES and MARKS of HMMESH, and W, must stay where they are: main program, COMMON, SAVE.
! HMMESH first, then curves, conditions, HMSOLV; or HMMESH and HMLOAD. HMSOLV again after the mesh has moved: as before.
! HMSAFE wants HMSOLV before it in the same W, and X, Y as they were then.
module harmorph77_state
    use, intrinsic :: iso_c_binding, only: c_associated, c_double, c_f_pointer, c_int32_t, c_int64_t, c_int8_t, &
        c_intptr_t, c_loc, c_null_ptr, c_ptr, c_size_t, c_sizeof
    use harmorph
    implicit none
    public
    private :: c_intptr_t

    integer, parameter :: most_curves = 16, most_conditions = 64

    type, bind(c) :: state                      ! at the beginning of W
        integer(c_intptr_t) :: here = 0         ! its own address, by which the work of HMOPEN is known
        integer(c_int64_t) :: words = 0         ! of W
        integer(c_int64_t) :: used = 0          ! from the beginning, for good; the rest is free for each call
        integer(c_int64_t) :: own = 0           ! the part of `used` that is neither curves nor functions
        integer(c_int64_t) :: no_basis = 0      ! the part that is not functions
        type(hm_c_mesh) :: mesh
        type(hm_c_curves) :: set
        type(hm_c_curve) :: curve(most_curves)
        type(hm_c_condition) :: condition(most_conditions)
        integer(c_int32_t) :: n_conditions = 0
        type(hm_c_options) :: options
        type(c_ptr) :: basis = c_null_ptr
        type(c_ptr) :: plan = c_null_ptr        ! kept by HMFACT, above `words`
        integer(c_int64_t) :: all_words = 0     ! of W, with what is kept there
    end type

contains

    ! What HMFACT keeps is given up.
    subroutine drop_factor(its)
        type(state), intent(inout) :: its
        its%plan = c_null_ptr
        its%words = its%all_words
    end subroutine

    integer(c_int64_t) function words_of(bytes)
        integer(c_size_t), intent(in) :: bytes
        words_of = int((bytes + 7) / 8, c_int64_t)
    end function

    ! The state in W; ierr /= 0: there is none.
    subroutine open_state(w, its, ierr, msg)
        real(c_double), intent(inout), target :: w(*)
        type(state), pointer, intent(out) :: its
        integer, intent(out) :: ierr
        character(len=*), intent(inout) :: msg
        call c_f_pointer(c_loc(w), its)
        ierr = hm_ok
        msg = ""
        if (its%here /= transfer(c_loc(w), its%here)) &
            call complain("W was not opened by HMOPEN, or has moved", ierr, msg)
    end subroutine

    subroutine complain(text, ierr, msg)
        character(len=*), intent(in) :: text
        integer, intent(out) :: ierr
        character(len=*), intent(inout) :: msg
        ierr = hm_bad_argument
        msg = text
    end subroutine

    ! Status and sentence of a C function for the caller.
    subroutine tell(status, e, ierr, msg)
        integer(c_int32_t), intent(in) :: status
        type(hm_c_error), intent(in) :: e
        integer, intent(out) :: ierr
        character(len=*), intent(inout) :: msg
        type(hm_error) :: reason
        reason = hm_error_of(status, e)
        ierr = reason%code
        msg = reason%text
    end subroutine

    ! Are there so many words between `used` and `top`, the last free one?
    logical function fits(its, words, top, ierr, msg)
        type(state), intent(in) :: its
        integer(c_int64_t), intent(in) :: words, top
        integer, intent(inout) :: ierr
        character(len=*), intent(inout) :: msg
        fits = its%used + words <= top
        if (fits) return
        ierr = hm_block_too_small
        write(msg, "(a, i0, a)") "W is too small: it needs at least ", its%words + its%used + words - top, " words"
    end function

    ! Forgets curves, conditions and functions.
    subroutine forget(its)
        type(state), intent(inout) :: its
        its%used = its%own
        call drop_factor(its)
        its%no_basis = its%own
        its%set = hm_c_curves(index_base=1)
        its%set%struct_size = int(c_sizeof(its%set), c_int64_t)
        its%n_conditions = 0
        its%basis = c_null_ptr
    end subroutine

    ! Analyses the mesh, with the curves if wanted, in the last words of W; top: the last word below. A warning is not
    ! in ierr, with which the caller goes on, but in `warning`; its code is hm_ok if there is none.
    subroutine analyse(w, its, with_curves, analysis, top, ierr, msg, warning)
        real(c_double), intent(inout), target :: w(*)
        type(state), intent(inout), target :: its
        logical, intent(in) :: with_curves
        type(c_ptr), intent(out) :: analysis
        integer(c_int64_t), intent(out) :: top
        integer, intent(out) :: ierr
        character(len=*), intent(inout) :: msg
        type(hm_error), intent(out), optional :: warning
        type(hm_c_problem) :: problem
        type(hm_c_error) :: e
        integer(c_size_t) :: bytes
        problem%struct_size = int(c_sizeof(problem), c_int64_t)
        problem%mesh = c_loc(its%mesh)
        if (with_curves) then
            if (its%set%n_curves > 0) problem%curves = c_loc(its%set)
            problem%n_conditions = its%n_conditions
            problem%conditions = c_loc(its%condition)
        end if
        analysis = c_null_ptr
        top = its%words
        call tell(hm_c_analysis_size(problem, c_loc(its%options), bytes, e), e, ierr, msg)
        if (ierr < 0) return
        if (.not. fits(its, words_of(bytes), top, ierr, msg)) return
        top = top - words_of(bytes)
        call tell(hm_c_analysis_init(analysis, c_loc(w(top + 1)), bytes, problem, c_loc(its%options), e), e, ierr, &
            msg)
        if (ierr <= hm_ok) return
        if (present(warning)) warning = hm_error_of(ierr, e)
        ierr = hm_ok
        msg = ""
    end subroutine

    ! What every use of the functions begins with.
    subroutine open_solved(w, its, ierr, msg)
        real(c_double), intent(inout), target :: w(*)
        type(state), pointer, intent(out) :: its
        integer, intent(out) :: ierr
        character(len=*), intent(inout) :: msg
        call open_state(w, its, ierr, msg)
        if (ierr /= hm_ok) return
        if (.not. c_associated(its%basis)) call complain("there are no functions: HMSOLV or HMLOAD first", ierr, msg)
    end subroutine

    ! From now on these functions stay.
    subroutine keep_basis(its, basis)
        type(state), intent(inout) :: its
        type(c_ptr), intent(in) :: basis
        type(hm_c_basis_info) :: info
        type(hm_c_error) :: e
        integer(c_intptr_t) :: first
        info%struct_size = int(c_sizeof(info), c_int64_t)
        if (hm_c_basis_info_get(basis, info, e) < 0) return
        first = transfer(basis, first)
        its%basis = basis
        its%used = (first - its%here + info%bytes + 7) / 8
    end subroutine

    ! Copies of control points and curves go into W, below top.
    subroutine put_control(w, its, n, control, top, ierr, msg)
        real(c_double), intent(inout), target :: w(*)
        type(state), intent(inout) :: its
        integer, intent(in) :: n
        real(c_double), intent(in) :: control(2, n)
        integer(c_int64_t), intent(in) :: top
        integer, intent(inout) :: ierr
        character(len=*), intent(inout) :: msg
        call forget(its)
        if (.not. fits(its, 2_c_int64_t * n, top, ierr, msg)) return
        w(its%used + 1:its%used + 2 * n) = reshape(control, [2 * n])
        its%set%control = c_loc(w(its%used + 1))
        its%set%n_control = int(n, c_int32_t)
        its%used = its%used + 2 * n
        its%no_basis = its%used
    end subroutine

    subroutine put_curve(w, its, degree, n, indices, knots, top, ierr, msg)
        real(c_double), intent(inout), target :: w(*)
        type(state), intent(inout), target :: its
        integer, intent(in) :: degree, n
        integer(c_int32_t), intent(in) :: indices(n)
        real(c_double), intent(in) :: knots(n + degree + 1)
        integer(c_int64_t), intent(in) :: top
        integer, intent(inout) :: ierr
        character(len=*), intent(inout) :: msg
        integer(c_int32_t), pointer :: copy(:)
        integer :: m
        m = n + degree + 1
        if (its%set%n_curves == most_curves) call complain("there are 16 curves already", ierr, msg)
        if (ierr < 0) return
        its%used = its%no_basis
        its%basis = c_null_ptr
        if (.not. fits(its, int(m + (n + 1) / 2, c_int64_t), top, ierr, msg)) return
        w(its%used + 1:its%used + m) = knots
        call c_f_pointer(c_loc(w(its%used + m + 1)), copy, [n])
        copy = indices
        its%set%n_curves = its%set%n_curves + 1_c_int32_t
        its%set%curve = c_loc(its%curve)
        its%curve(its%set%n_curves) = hm_c_curve(int(c_sizeof(its%curve(1)), c_int64_t), int(degree, c_int32_t), &
            int(n, c_int32_t), c_loc(copy), c_loc(w(its%used + 1)))
        its%used = its%used + m + (n + 1) / 2
        its%no_basis = its%used
    end subroutine

    subroutine put_condition(its, condition, ierr, msg)
        type(state), intent(inout) :: its
        type(hm_c_condition), intent(in) :: condition
        integer, intent(inout) :: ierr
        character(len=*), intent(inout) :: msg
        integer :: n
        n = int(its%n_conditions) + 1
        if (n > most_conditions) then
            call complain("there are 64 conditions already", ierr, msg)
            return
        end if
        its%condition(n) = condition
        its%condition(n)%struct_size = int(c_sizeof(condition), c_int64_t)
        its%n_conditions = int(n, c_int32_t)
    end subroutine

    ! A plan of the analysis, below top.
    subroutine make_plan(w, its, analysis, plan, top, ierr, msg)
        real(c_double), intent(inout), target :: w(*)
        type(state), intent(in) :: its
        type(c_ptr), intent(in) :: analysis
        type(c_ptr), intent(out) :: plan
        integer(c_int64_t), intent(inout) :: top
        integer, intent(inout) :: ierr
        character(len=*), intent(inout) :: msg
        type(hm_c_error) :: e
        integer(c_size_t) :: bytes
        plan = c_null_ptr
        call tell(hm_c_plan_size(analysis, bytes, e), e, ierr, msg)
        if (ierr < 0) return
        if (.not. fits(its, words_of(bytes), top, ierr, msg)) return
        top = top - words_of(bytes)
        call tell(hm_c_plan_init(plan, c_loc(w(top + 1)), bytes, analysis, e), e, ierr, msg)
    end subroutine

    ! A plan for a safe movement from where HMSOLV found the mesh, below top; info: of the functions.
    subroutine plan_of_start(w, its, name, plan, info, top, ierr, msg)
        real(c_double), intent(inout), target :: w(*)
        type(state), intent(inout), target :: its
        character(len=*), intent(in) :: name
        type(c_ptr), intent(out) :: plan
        type(hm_c_basis_info), intent(out) :: info
        integer(c_int64_t), intent(out) :: top
        integer, intent(inout) :: ierr
        character(len=*), intent(inout) :: msg
        type(hm_c_error) :: e
        type(c_ptr) :: analysis, same
        plan = c_null_ptr
        top = 0
        info%struct_size = int(c_sizeof(info), c_int64_t)
        if (its%n_conditions == 0) call complain(name // " needs HMSOLV before it, HMLOAD is not enough", ierr, msg)
        if (ierr == hm_ok) call tell(hm_c_basis_info_get(its%basis, info, e), e, ierr, msg)
        if (ierr == hm_ok) call tell(hm_c_basis_attach(same, its%basis, int(info%bytes, c_size_t), c_loc(its%mesh), e), &
            e, ierr, msg)
        if (ierr == hm_moved) call complain("X, Y are no longer where HMSOLV found them", ierr, msg)
        if (ierr == hm_ok) call analyse(w, its, .true., analysis, top, ierr, msg)
        if (ierr == hm_ok) call make_plan(w, its, analysis, plan, top, ierr, msg)
    end subroutine

    ! The functions; keeps: matrix and factor stay as well, at the end of W.
    subroutine solve(w, keeps, resid, ierr, msg)
        real(c_double), intent(inout), target :: w(*)
        logical, intent(in) :: keeps
        real(c_double), intent(inout) :: resid
        integer, intent(out) :: ierr
        character(len=*), intent(inout) :: msg
        type(state), pointer :: its
        type(hm_c_error) :: e
        type(hm_solve_report) :: report
        type(hm_error) :: warning
        type(c_ptr) :: analysis, plan, basis
        integer(c_int64_t) :: top, plan_top
        integer(c_size_t) :: bytes
        call open_state(w, its, ierr, msg)
        if (ierr /= hm_ok) return
        if (its%set%n_curves < 1 .and. all(its%condition(:its%n_conditions)%kind /= hm_rigid .and. &
            its%condition(:its%n_conditions)%kind /= hm_given)) then
            call complain("there is no curve and no rigid body: HMFIT, or HMCTRL and HMCURV, or HMRIGD", ierr, msg)
            return
        end if
        its%used = its%no_basis
        its%basis = c_null_ptr
        call drop_factor(its)
        call analyse(w, its, .true., analysis, top, ierr, msg, warning)
        if (ierr == hm_ok) call make_plan(w, its, analysis, plan, top, ierr, msg)
        plan_top = top
        if (ierr == hm_ok) call tell(hm_c_basis_size(analysis, bytes, e), e, ierr, msg)
        if (ierr < 0) return
        if (.not. fits(its, words_of(bytes), top, ierr, msg)) return
        call tell(hm_c_basis_init(basis, c_loc(w(its%used + 1)), bytes, analysis, e), e, ierr, msg)
        if (ierr == hm_ok) call tell(hm_c_plan_factor(plan, c_null_ptr, e), e, ierr, msg)
        report%struct_size = int(c_sizeof(report), c_int64_t)
        if (ierr == hm_ok) call tell(hm_c_plan_solve(plan, basis, report, e), e, ierr, msg)
        if (ierr < 0) return
        resid = report%residual
        call keep_basis(its, basis)
        if (ierr == hm_ok .and. warning%code > hm_ok) then
            ierr = warning%code
            msg = warning%text
        end if
        if (.not. keeps) return
        its%plan = plan
        its%words = plan_top
    end subroutine

    ! What every use of the factor begins with: working memory for one field of displacements.
    subroutine open_factored(w, its, work, bytes, ierr, msg)
        real(c_double), intent(inout), target :: w(*)
        type(state), pointer, intent(out) :: its
        type(c_ptr), intent(out) :: work
        integer(c_size_t), intent(out) :: bytes
        integer, intent(out) :: ierr
        character(len=*), intent(inout) :: msg
        type(hm_c_error) :: e
        work = c_null_ptr
        bytes = 0
        call open_state(w, its, ierr, msg)
        if (ierr == hm_ok .and. .not. c_associated(its%plan)) call complain("HMFACT comes first", ierr, msg)
        if (ierr == hm_ok) call tell(hm_c_displace_size(its%plan, 1_c_int32_t, bytes, e), e, ierr, msg)
        if (ierr < 0) return
        if (.not. fits(its, words_of(bytes), its%words, ierr, msg)) return
        work = c_loc(w(its%used + 1))
    end subroutine

    ! x(1), x(1+inc), ... as C has them.
    type(hm_c_points) function points_of(x, y, inc)
        real(c_double), intent(in), target :: x(*), y(*)
        integer, intent(in) :: inc
        points_of = hm_c_points(c_loc(x), c_loc(y), stride_of(inc))
    end function

    integer(c_int64_t) function stride_of(inc)
        integer, intent(in) :: inc
        stride_of = max(inc, 1)
    end function
end module

subroutine hmopen(w, lw, ierr, msg)
    use harmorph77_state
    implicit none
    integer, intent(in) :: lw
    real(c_double), intent(inout), target :: w(lw)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(state), pointer :: its
    type(state) :: fresh
    integer(c_int64_t) :: n
    ierr = hm_ok
    msg = ""
    n = words_of(c_sizeof(fresh))
    if (lw < n) then
        ierr = hm_block_too_small
        write(msg, "(a, i0, a)") "W is too small: it needs at least ", n, " words"
    else if (storage_size(lw) /= 32) then
        call complain("these calls need INTEGER of 4 bytes; the module harmorph takes 8", ierr, msg)
    else if (hm_abi_version() /= hm_abi) then
        call complain("harmorph77.f90 and libharmorph.a are of different versions", ierr, msg)
    else
        call c_f_pointer(c_loc(w), its)
        its = fresh
        its%here = transfer(c_loc(w), its%here)
        its%words = lw
        its%all_words = lw
        its%options%struct_size = int(c_sizeof(its%options), c_int64_t)
        its%own = n
        call forget(its)
    end if
end subroutine

subroutine hmclos(w)
    use harmorph77_state
    implicit none
    real(c_double), intent(inout) :: w(*)
    w(1) = 0
end subroutine

subroutine hmmesh(w, np, x, y, inc, nc, npc, cells, nf, faces, marks, ierr, msg)
    use harmorph77_state
    implicit none
    integer, intent(in) :: np, inc, nc, npc, nf
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(in), target :: x(*), y(*)
    integer(c_int32_t), intent(in), target :: cells(*), faces(*), marks(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(state), pointer :: its
    call open_state(w, its, ierr, msg)
    if (ierr == hm_ok .and. npc /= 3 .and. npc /= 4) &
        call complain("NPC must be 3 or 4; among quads, triangles repeat their last point", ierr, msg)
    if (ierr /= hm_ok) return
    its%own = words_of(c_sizeof(its))
    call forget(its)
    its%mesh = hm_c_mesh(index_base=1, n_points=np, points=points_of(x, y, inc), n_cells=nc, n_faces=nf, &
        cell_layout=merge(hm_cells_triangles, hm_cells_quads, npc == 3))
    its%mesh%struct_size = int(c_sizeof(its%mesh), c_int64_t)
    its%mesh%cell_points = c_loc(cells)
    its%mesh%face_points = c_loc(faces)
    its%mesh%face_markers = c_loc(marks)
end subroutine

! Faces, their points and then their marks, go into W.
subroutine hmtype(w, itype, ierr, msg)
    use harmorph77_state
    implicit none
    real(c_double), intent(inout), target :: w(*)
    integer(c_int32_t), intent(in) :: itype(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(state), pointer :: its
    integer(c_int32_t), pointer :: cells(:, :), numbers(:)
    integer(c_int32_t), allocatable :: faces(:, :), marks(:)
    integer(c_int64_t) :: n
    integer :: corners
    call open_state(w, its, ierr, msg)
    if (ierr == hm_ok .and. .not. c_associated(its%mesh%cell_points)) &
        call complain("HMMESH comes before HMTYPE", ierr, msg)
    if (ierr /= hm_ok) return
    corners = merge(3, 4, its%mesh%cell_layout == hm_cells_triangles)
    call c_f_pointer(its%mesh%cell_points, cells, [corners, int(its%mesh%n_cells)])
    if (any(cells < 1 .or. cells > its%mesh%n_points)) then
        call complain("CELLS has a point that the mesh has not", ierr, msg)
        return
    end if
    call hm_faces_of_types(cells, itype(:its%mesh%n_points), faces, marks)
    n = size(marks, kind=c_int64_t)
    its%own = words_of(c_sizeof(its))
    call forget(its)
    if (.not. fits(its, (3 * n + 1) / 2, its%words, ierr, msg)) return
    call c_f_pointer(c_loc(w(its%used + 1)), numbers, [3 * n])
    its%own = its%own + (3 * n + 1) / 2
    call forget(its)
    numbers(:2 * n) = reshape(faces, [2 * n])
    numbers(2 * n + 1:) = marks
    its%mesh%n_faces = int(n, c_int32_t)
    if (n == 0) return
    its%mesh%face_points = c_loc(numbers)
    its%mesh%face_markers = c_loc(numbers(2 * n + 1))
end subroutine

subroutine hmblok(w, ni, nj, x, y, marks, ierr, msg)
    use harmorph77_state
    implicit none
    integer, intent(in) :: ni, nj, marks(4)
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(in), target :: x(*), y(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(state), pointer :: its
    integer(c_int32_t), pointer :: numbers(:)
    integer(c_int64_t) :: n
    integer :: side, i, faces, along(4)
    call open_state(w, its, ierr, msg)
    if (ierr == hm_ok .and. min(ni, nj) < 2) call complain("NI and NJ must be at least 2", ierr, msg)
    if (ierr /= hm_ok) return
    along = [nj, nj, ni, ni] - 1
    n = sum(along, marks /= 0)
    its%own = words_of(c_sizeof(its))
    call forget(its)
    if (.not. fits(its, (3 * n + 1) / 2, its%words, ierr, msg)) return
    call c_f_pointer(c_loc(w(its%used + 1)), numbers, [3 * n])
    its%own = its%own + (3 * n + 1) / 2
    call forget(its)
    faces = 0
    do side = 1, 4
        if (marks(side) == 0) cycle
        do i = 1, along(side)
            numbers(2 * faces + 1) = place(i)
            numbers(2 * faces + 2) = place(i + 1)
            numbers(2 * n + faces + 1) = marks(side)
            faces = faces + 1
        end do
    end do
    its%mesh = hm_c_mesh(index_base=1, n_points=ni * nj, points=points_of(x, y, 1), ni=ni, nj=nj, n_faces=faces, &
        cell_layout=hm_cells_structured)
    its%mesh%struct_size = int(c_sizeof(its%mesh), c_int64_t)
    its%mesh%face_points = c_loc(numbers)
    its%mesh%face_markers = c_loc(numbers(2 * n + 1))

contains

    integer function place(k)                   ! point k along the side
        integer, intent(in) :: k
        select case (side)
        case (1)
            place = 1 + ni * (k - 1)
        case (2)
            place = ni * k
        case (3)
            place = k
        case default
            place = k + ni * (nj - 1)
        end select
    end function
end subroutine

subroutine hmwall(w, mark, nmax, ipts, n, loop, ierr, msg)
    use harmorph77_state
    implicit none
    integer, intent(in) :: mark, nmax
    real(c_double), intent(inout), target :: w(*)
    integer(c_int32_t), intent(inout) :: ipts(*)
    integer, intent(out) :: n, loop, ierr
    character(len=*), intent(inout) :: msg
    type(state), pointer :: its
    type(c_ptr) :: analysis
    type(hm_c_error) :: e
    integer(c_int64_t) :: top
    integer(c_int32_t) :: found, is_loop
    n = 0
    loop = 0
    call open_state(w, its, ierr, msg)
    if (ierr == hm_ok) call analyse(w, its, .false., analysis, top, ierr, msg)
    if (ierr < 0) return
    found = 0
    is_loop = 0
    call tell(hm_c_analysis_boundary(analysis, 1_c_int32_t, [int(mark, c_int32_t)], 0_c_int32_t, ipts, &
        int(nmax, c_int32_t), found, is_loop, e), e, ierr, msg)
    n = int(found)
    loop = int(is_loop)
end subroutine

subroutine hmfit(w, mark, ncp, ideg, iclos, dmax, ierr, msg)
    use harmorph77_state
    implicit none
    integer, intent(in) :: mark, ncp, ideg, iclos
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(inout) :: dmax
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(state), pointer :: its
    type(c_ptr) :: analysis, made
    type(hm_c_error) :: e
    type(hm_c_fit_options) :: options
    type(hm_fit_report) :: report
    type(hm_c_curves), pointer :: set
    type(hm_c_curve), pointer :: list(:)
    integer(c_int32_t), pointer :: points(:), indices(:)
    integer(c_int32_t), allocatable :: from_1(:)
    real(c_double), pointer :: x(:), y(:), wall(:, :), control(:, :), knots(:)
    integer(c_int32_t) :: n, is_loop, nothing(1)
    integer(c_int64_t) :: top
    integer(c_size_t) :: bytes
    integer(c_int32_t) :: k, j
    call open_state(w, its, ierr, msg)
    if (ierr /= hm_ok) return
    call forget(its)
    call analyse(w, its, .false., analysis, top, ierr, msg)
    if (ierr < 0) return

    ! Counts first, then the points below the analysis, their coordinates below them, the fit below these.
    n = 0
    if (hm_c_analysis_boundary(analysis, 1_c_int32_t, [int(mark, c_int32_t)], 0_c_int32_t, nothing, 0_c_int32_t, n, &
        is_loop, e) == hm_bad_condition) then
        call tell(e%code, e, ierr, msg)
        return
    end if
    if (.not. fits(its, 3_c_int64_t * n, top, ierr, msg)) return
    top = top - 3_c_int64_t * n
    call c_f_pointer(c_loc(w(top + 2 * n + 1)), points, [n])
    call c_f_pointer(c_loc(w(top + 1)), wall, [n, 2_c_int32_t])
    call tell(hm_c_analysis_boundary(analysis, 1_c_int32_t, [int(mark, c_int32_t)], 0_c_int32_t, points, n, n, &
        is_loop, e), e, ierr, msg)
    if (ierr < 0) return
    call c_f_pointer(its%mesh%points%x, x, [its%mesh%points%stride * its%mesh%n_points])
    call c_f_pointer(its%mesh%points%y, y, [its%mesh%points%stride * its%mesh%n_points])
    do k = 1, n
        wall(k, 1) = x((points(k) - 1) * its%mesh%points%stride + 1)
        wall(k, 2) = y((points(k) - 1) * its%mesh%points%stride + 1)
    end do
    options = hm_c_fit_options(degree=ideg, n_control=ncp, closed=iclos)
    options%struct_size = int(c_sizeof(options), c_int64_t)
    report%struct_size = int(c_sizeof(report), c_int64_t)
    call tell(hm_c_fit_size(n, options, bytes, e), e, ierr, msg)
    if (ierr < 0) return
    if (.not. fits(its, words_of(bytes), top, ierr, msg)) return
    call tell(hm_c_fit(made, c_loc(w(top - words_of(bytes) + 1)), bytes, points_of(wall(:, 1), wall(:, 2), 1), &
        n, is_loop, options, report, e), e, ierr, msg)
    if (ierr < 0) return
    top = top - words_of(bytes)

    call c_f_pointer(made, set)
    call c_f_pointer(set%control, control, [2, int(set%n_control)])
    call c_f_pointer(set%curve, list, [set%n_curves])
    call put_control(w, its, int(set%n_control), control, top, ierr, msg)
    do k = 1, set%n_curves
        if (ierr < 0) return
        allocate(from_1(list(k)%n_indices), source=[(j, j = 1, list(k)%n_indices)])
        if (c_associated(list(k)%indices)) then
            call c_f_pointer(list(k)%indices, indices, [list(k)%n_indices])
            from_1(:) = indices + 1_c_int32_t
        end if
        call c_f_pointer(list(k)%knots, knots, [list(k)%n_indices + list(k)%degree + 1])
        call put_curve(w, its, int(list(k)%degree), int(list(k)%n_indices), from_1, knots, top, ierr, msg)
        deallocate(from_1)
    end do
    dmax = report%max_error
end subroutine

subroutine hmctrl(w, ncp, p, ierr, msg)
    use harmorph77_state
    implicit none
    integer, intent(in) :: ncp
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(in) :: p(2, *)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(state), pointer :: its
    call open_state(w, its, ierr, msg)
    if (ierr == hm_ok .and. ncp < 2) call complain("NCP must be at least 2", ierr, msg)
    if (ierr == hm_ok) call put_control(w, its, ncp, p, its%words, ierr, msg)
end subroutine

subroutine hmcurv(w, ideg, nidx, idx, u, ierr, msg)
    use harmorph77_state
    implicit none
    integer, intent(in) :: ideg, nidx
    real(c_double), intent(inout), target :: w(*)
    integer(c_int32_t), intent(in) :: idx(*)
    real(c_double), intent(in) :: u(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(state), pointer :: its
    type(hm_c_error) :: e
    call open_state(w, its, ierr, msg)
    if (ierr == hm_ok .and. .not. c_associated(its%set%control)) call complain("HMCTRL comes before HMCURV", ierr, msg)
    if (ierr == hm_ok .and. (nidx < 2 .or. ideg < 1 .or. ideg > 5)) &
        call complain("IDEG or NIDX is out of range", ierr, msg)
    if (ierr == hm_ok) call put_curve(w, its, ideg, nidx, idx, u, its%words, ierr, msg)
    if (ierr /= hm_ok) return
    call tell(hm_c_curves_check(its%set, e), e, ierr, msg)
    if (ierr < 0) its%set%n_curves = its%set%n_curves - 1_c_int32_t
end subroutine

subroutine hmcond(w, mark, kind, icurv, ncurv, ierr, msg)
    use harmorph77_state
    implicit none
    integer, intent(in) :: mark, kind, icurv, ncurv
    real(c_double), intent(inout), target :: w(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(state), pointer :: its
    type(hm_c_condition) :: condition
    call open_state(w, its, ierr, msg)
    if (ierr == hm_ok .and. kind == hm_rigid) call complain("a rigid body is made by HMRIGD", ierr, msg)
    if (ierr == hm_ok .and. kind == hm_periodic_pair) call complain("a periodic pair is made by HMPAIR", ierr, msg)
    condition = hm_c_condition(marker=mark, kind=kind)
    if (kind == hm_on_curve .or. .not. (icurv == ncurv .and. (icurv == 0 .or. icurv == 1))) then
        condition%first_curve = icurv - 1
        condition%n_curves = ncurv
    end if
    if (ierr == hm_ok) call put_condition(its, condition, ierr, msg)
end subroutine

subroutine hmrigd(w, mark, ibody, xc, yc, ierr, msg)
    use harmorph77_state
    implicit none
    integer, intent(in) :: mark, ibody
    real(c_double), intent(in) :: xc, yc
    real(c_double), intent(inout), target :: w(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(state), pointer :: its
    call open_state(w, its, ierr, msg)
    if (ierr == hm_ok) call put_condition(its, hm_c_condition(marker=mark, kind=hm_rigid, body=ibody - 1, x=xc, y=yc), &
        ierr, msg)
end subroutine

subroutine hmpair(w, mark, mark2, ierr, msg)
    use harmorph77_state
    implicit none
    integer, intent(in) :: mark, mark2
    real(c_double), intent(inout), target :: w(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(state), pointer :: its
    call open_state(w, its, ierr, msg)
    if (ierr == hm_ok) call put_condition(its, hm_c_condition(marker=mark, kind=hm_periodic_pair, partner=mark2), &
        ierr, msg)
end subroutine

subroutine hmnear(w, x, y, ierr, msg)
    use harmorph77_state
    implicit none
    real(c_double), intent(in) :: x, y
    real(c_double), intent(inout), target :: w(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(state), pointer :: its
    call open_state(w, its, ierr, msg)
    if (ierr == hm_ok .and. its%n_conditions == 0) call complain("HMNEAR: there is no condition yet", ierr, msg)
    if (ierr /= hm_ok) return
    its%condition(its%n_conditions)%piece = 1
    its%condition(its%n_conditions)%near_x = x
    its%condition(its%n_conditions)%near_y = y
end subroutine

! Whether values go together, HMSOLV tells.
subroutine hmopt(w, name, ival, ierr, msg)
    use harmorph77_state
    implicit none
    character(len=*), intent(in) :: name
    integer, intent(in) :: ival
    real(c_double), intent(inout), target :: w(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(state), pointer :: its
    call open_state(w, its, ierr, msg)
    if (ierr /= hm_ok) return
    select case (name)
    case ("OPERATOR")
        its%options%operator_kind = int(ival, c_int32_t)
    case ("EXPONENT")
        its%options%exponent_quarters = int(ival, c_int32_t)
    case ("SCHEME")
        its%options%scheme = int(ival, c_int32_t)
    case ("ENGINE")
        its%options%engine = int(ival, c_int32_t)
    case ("KERNEL")
        its%options%kernel = int(ival, c_int32_t)
    case ("OFFSET")
        its%options%offset_correction = int(ival, c_int32_t)
    case ("PRECISION")
        its%options%precision = int(ival, c_int32_t)
    case default
        call complain("there is no option of this name: " // name, ierr, msg)
    end select
end subroutine

! From the end of W downwards: analysis, plan. From what is kept upwards: the functions, which stay.
subroutine hmsolv(w, resid, ierr, msg)
    use harmorph77_state
    implicit none
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(inout) :: resid
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    call solve(w, .false., resid, ierr, msg)
end subroutine

subroutine hmfact(w, resid, ierr, msg)
    use harmorph77_state
    implicit none
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(inout) :: resid
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    call solve(w, .true., resid, ierr, msg)
end subroutine

subroutine hmgive(w, n, ip, wx, wy, dx, dy, inc, ierr, msg)
    use harmorph77_state
    implicit none
    integer, intent(in) :: n, inc
    integer(c_int32_t), intent(in), target :: ip(*)
    real(c_double), intent(inout), target :: w(*), dx(*), dy(*)
    real(c_double), intent(in), target :: wx(*), wy(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(state), pointer :: its
    type(hm_c_error) :: e
    type(hm_solve_report) :: report
    type(c_ptr) :: work
    integer(c_size_t) :: bytes
    report%struct_size = int(c_sizeof(report), c_int64_t)
    call open_factored(w, its, work, bytes, ierr, msg)
    if (ierr == hm_ok) call tell(hm_c_displace(its%plan, int(n, c_int32_t), c_loc(ip), 1_c_int32_t, [points_of(wx, wy, 1)], &
        c_null_ptr, [points_of(dx, dy, inc)], work, bytes, report, e), e, ierr, msg)
end subroutine

subroutine hmgadj(w, n, ip, gx, gy, inc, hx, hy, ierr, msg)
    use harmorph77_state
    implicit none
    integer, intent(in) :: n, inc
    integer(c_int32_t), intent(in), target :: ip(*)
    real(c_double), intent(inout), target :: w(*), hx(*), hy(*)
    real(c_double), intent(in), target :: gx(*), gy(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(state), pointer :: its
    type(hm_c_error) :: e
    type(hm_solve_report) :: report
    type(c_ptr) :: work
    integer(c_size_t) :: bytes
    report%struct_size = int(c_sizeof(report), c_int64_t)
    call open_factored(w, its, work, bytes, ierr, msg)
    if (ierr == hm_ok) call tell(hm_c_displace_adjoint(its%plan, int(n, c_int32_t), c_loc(ip), 1_c_int32_t, &
        [points_of(gx, gy, inc)], [points_of(hx, hy, 1)], work, bytes, report, e), e, ierr, msg)
end subroutine

subroutine hmgsaf(w, n, ip, wx, wy, dp, xn, yn, inc, frac, istrat, ierr, msg)
    use harmorph77_state
    implicit none
    integer, intent(in) :: n, inc
    integer(c_int32_t), intent(in), target :: ip(*)
    real(c_double), intent(inout), target :: w(*), xn(*), yn(*)
    real(c_double), intent(in), target :: wx(*), wy(*), dp(2, *)
    real(c_double), intent(inout) :: frac
    integer, intent(inout) :: istrat
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(state), pointer :: its
    type(hm_c_basis_info) :: info
    type(hm_c_error) :: e
    type(hm_c_safe_options) :: options
    type(hm_safe_report) :: report
    type(c_ptr) :: plan, move
    integer(c_int64_t) :: top
    integer(c_size_t) :: bytes
    options%struct_size = int(c_sizeof(options), c_int64_t)
    report%struct_size = int(c_sizeof(report), c_int64_t)
    call open_solved(w, its, ierr, msg)
    if (ierr == hm_ok) call plan_of_start(w, its, "HMGSAF", plan, info, top, ierr, msg)
    if (ierr == hm_ok) call tell(hm_c_displace_safe_size(plan, its%basis, bytes, e), e, ierr, msg)
    if (ierr < 0) return
    if (.not. fits(its, words_of(bytes), top, ierr, msg)) return
    move = c_null_ptr
    if (info%functions > 0) move = c_loc(dp)
    call tell(hm_c_displace_safe(plan, its%basis, move, int(n, c_int32_t), c_loc(ip), points_of(wx, wy, 1), &
        points_of(xn, yn, inc), c_loc(w(top - words_of(bytes) + 1)), bytes, options, report, e), e, ierr, msg)
    if (ierr < 0) return
    frac = report%step_fraction
    istrat = int(report%strategy)
end subroutine

subroutine hmgetp(w, nmax, p, ncp, ierr, msg)
    use harmorph77_state
    implicit none
    integer, intent(in) :: nmax
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(inout) :: p(2, *)
    integer, intent(out) :: ncp, ierr
    character(len=*), intent(inout) :: msg
    type(state), pointer :: its
    type(hm_c_curves) :: set
    type(hm_c_curve) :: list(most_curves)
    type(hm_c_error) :: e
    real(c_double), pointer :: control(:, :)
    ncp = 0
    call open_state(w, its, ierr, msg)
    if (ierr /= hm_ok) return
    set = its%set
    if (c_associated(its%basis)) call tell(hm_c_basis_curves(its%basis, set, list, int(most_curves, c_int32_t), e), e, &
        ierr, msg)
    if (ierr < 0) return
    ncp = int(set%n_control)
    if (ncp > nmax) call complain("P has not enough room: NCP says how much", ierr, msg)
    if (ierr < 0 .or. ncp == 0) return
    call c_f_pointer(set%control, control, [2, ncp])
    p(:, :ncp) = control
end subroutine

subroutine hmmeas(w, kind, statn, dp, value, g, ierr, msg)
    use harmorph77_state
    implicit none
    integer, intent(in) :: kind
    real(c_double), intent(in) :: statn, dp(2, *)
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(inout) :: value
    real(c_double), intent(inout), target :: g(2, *)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(state), pointer :: its
    call open_state(w, its, ierr, msg)
    if (ierr /= hm_ok) return
    if (.not. c_associated(its%basis)) then
        call complain("HMMEAS needs HMSOLV or HMLOAD before it", ierr, msg)
        return
    end if
    call of_moved(int(its%set%n_control))

contains

    subroutine of_moved(ncp)
        integer, intent(in) :: ncp
        type(hm_c_curves) :: set
        type(hm_c_curve) :: list(most_curves)
        type(hm_c_basis_info) :: info
        type(hm_c_section) :: section
        type(hm_c_quantity) :: quantity(1)
        type(hm_c_error) :: e
        real(c_double), allocatable, target :: control(:, :)
        real(c_double) :: found(1)
        info%struct_size = int(c_sizeof(info), c_int64_t)
        call tell(hm_c_basis_info_get(its%basis, info, e), e, ierr, msg)
        allocate(control(2, max(int(info%control_points), ncp, 1)))
        set%struct_size = int(c_sizeof(set), c_int64_t)
        list(1)%struct_size = int(c_sizeof(list(1)), c_int64_t)
        call tell(hm_c_moved_curves(its%basis, dp, c_loc(control), set, list, int(most_curves, c_int32_t), e), e, ierr, msg)
        if (ierr < 0) return
        section%struct_size = int(c_sizeof(section), c_int64_t)
        quantity%struct_size = int(c_sizeof(quantity(1)), c_int64_t)
        quantity%kind = int(kind, c_int32_t)
        quantity%station = statn
        call tell(hm_c_measure(set, section, 1_c_int32_t, quantity, found, c_null_ptr, c_loc(g), e), e, ierr, msg)
        if (ierr >= 0) value = found(1)
    end subroutine
end subroutine

subroutine hmmorf(w, dp, x, y, inc, ierr, msg)
    use harmorph77_state
    implicit none
    integer, intent(in) :: inc
    real(c_double), intent(inout), target :: w(*), x(*), y(*)
    real(c_double), intent(in) :: dp(2, *)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(state), pointer :: its
    type(hm_c_error) :: e
    type(hm_c_points), target :: points
    points = points_of(x, y, inc)
    call open_solved(w, its, ierr, msg)
    if (ierr == hm_ok) call tell(hm_c_morph(its%basis, dp, c_loc(points), points, c_null_ptr, e), e, ierr, msg)
end subroutine

! The plan is made again in the free end of W, with the working space below it.
subroutine hmsafe(w, dp, xn, yn, inc, dr, frac, istrat, ierr, msg)
    use harmorph77_state
    implicit none
    integer, intent(in) :: inc
    real(c_double), intent(inout), target :: w(*), xn(*), yn(*)
    real(c_double), intent(in) :: dp(2, *)
    real(c_double), intent(inout), target :: dr(2, *)
    real(c_double), intent(inout) :: frac
    integer, intent(inout) :: istrat
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(state), pointer :: its
    type(hm_c_basis_info) :: info
    type(hm_c_error) :: e
    type(hm_c_safe_options) :: options
    type(hm_safe_report) :: report
    type(c_ptr) :: plan
    integer(c_int64_t) :: top
    integer(c_size_t) :: bytes
    options%struct_size = int(c_sizeof(options), c_int64_t)
    options%reached = c_loc(dr)
    report%struct_size = int(c_sizeof(report), c_int64_t)
    call open_solved(w, its, ierr, msg)
    if (ierr == hm_ok) call plan_of_start(w, its, "HMSAFE", plan, info, top, ierr, msg)
    if (ierr == hm_ok) call tell(hm_c_morph_safe_size(plan, its%basis, bytes, e), e, ierr, msg)
    if (ierr < 0) return
    if (.not. fits(its, words_of(bytes), top, ierr, msg)) return
    call tell(hm_c_morph_safe(plan, its%basis, dp, points_of(xn, yn, inc), c_null_ptr, &
        c_loc(w(top - words_of(bytes) + 1)), bytes, options, report, e), e, ierr, msg)
    if (ierr < 0) return
    frac = report%step_fraction
    istrat = int(report%strategy)
end subroutine

subroutine hmdisp(w, dp, dx, dy, inc, ierr, msg)
    use harmorph77_state
    implicit none
    integer, intent(in) :: inc
    real(c_double), intent(inout), target :: w(*), dx(*), dy(*)
    real(c_double), intent(in) :: dp(2, *)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(state), pointer :: its
    type(hm_c_error) :: e
    call open_solved(w, its, ierr, msg)
    if (ierr == hm_ok) call tell(hm_c_morph(its%basis, dp, c_null_ptr, points_of(dx, dy, inc), c_null_ptr, e), e, &
        ierr, msg)
end subroutine

subroutine hmadj(w, gx, gy, inc, g, ierr, msg)
    use harmorph77_state
    implicit none
    integer, intent(in) :: inc
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(in), target :: gx(*), gy(*)
    real(c_double), intent(inout) :: g(2, *)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(state), pointer :: its
    type(hm_c_error) :: e
    call open_solved(w, its, ierr, msg)
    if (ierr == hm_ok) call tell(hm_c_adjoint(its%basis, points_of(gx, gy, inc), g, c_null_ptr, e), e, ierr, msg)
end subroutine

subroutine hmstep(w, x, y, dx, dy, inc, s, icell, ierr, msg)
    use harmorph77_state
    implicit none
    integer, intent(in) :: inc
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(in), target :: x(*), y(*), dx(*), dy(*)
    real(c_double), intent(inout) :: s
    integer, intent(out) :: icell, ierr
    character(len=*), intent(inout) :: msg
    type(state), pointer :: its
    type(hm_c_error) :: e
    type(hm_step_report) :: report
    type(hm_c_points), target :: from
    icell = 0
    from = points_of(x, y, inc)
    report%struct_size = int(c_sizeof(report), c_int64_t)
    call open_solved(w, its, ierr, msg)
    if (ierr == hm_ok) call tell(hm_c_admissible_step(its%basis, its%mesh, c_loc(from), points_of(dx, dy, inc), &
        c_null_ptr, report, e), e, ierr, msg)
    if (ierr < 0) return
    s = report%admissible
    icell = int(report%cell)
end subroutine

subroutine hmqual(w, x, y, inc, ninv, amin, qmin, ierr, msg)
    use harmorph77_state
    implicit none
    integer, intent(in) :: inc
    real(c_double), intent(inout), target :: w(*)
    real(c_double), intent(in), target :: x(*), y(*)
    real(c_double), intent(inout) :: amin, qmin
    integer, intent(out) :: ninv, ierr
    character(len=*), intent(inout) :: msg
    type(state), pointer :: its
    type(hm_c_error) :: e
    type(hm_quality_report) :: report
    type(hm_c_points), target :: at
    ninv = 0
    at = points_of(x, y, inc)
    report%struct_size = int(c_sizeof(report), c_int64_t)
    call open_solved(w, its, ierr, msg)
    if (ierr == hm_ok) call tell(hm_c_quality(its%basis, its%mesh, c_loc(at), c_null_ptr, c_null_ptr, report, e), e, &
        ierr, msg)
    if (ierr < 0) return
    ninv = int(report%inverted)
    amin = report%min_area
    qmin = report%min_quality
end subroutine

! Made in the free part of W, then moved to where the functions were.
subroutine hmsngl(w, ierr, msg)
    use harmorph77_state
    implicit none
    real(c_double), intent(inout), target :: w(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(state), pointer :: its
    type(c_ptr) :: made, moved
    type(hm_c_basis_info) :: info
    type(hm_c_error) :: e
    integer(c_int8_t), pointer :: from(:), to(:)
    integer(c_int64_t) :: k
    integer(c_size_t) :: bytes
    info%struct_size = int(c_sizeof(info), c_int64_t)
    call open_solved(w, its, ierr, msg)
    if (ierr == hm_ok) call tell(hm_c_single_size(its%basis, bytes, e), e, ierr, msg)
    if (ierr < 0) return
    if (.not. fits(its, words_of(bytes), its%words, ierr, msg)) return
    call tell(hm_c_single_init(made, c_loc(w(its%used + 1)), bytes, its%basis, e), e, ierr, msg)
    if (ierr == hm_ok) call tell(hm_c_basis_info_get(made, info, e), e, ierr, msg)
    if (ierr < 0) return
    call c_f_pointer(made, from, [info%bytes])
    call c_f_pointer(c_loc(w(its%no_basis + 1)), to, [info%bytes])
    do k = 1, info%bytes
        to(k) = from(k)
    end do
    moved = c_loc(w(its%no_basis + 1))
    call keep_basis(its, moved)
end subroutine

! Two records: the length, and the block as it is.
subroutine hmsave(w, lun, ierr, msg)
    use harmorph77_state
    implicit none
    integer, intent(in) :: lun
    real(c_double), intent(inout), target :: w(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(state), pointer :: its
    type(hm_c_basis_info) :: info
    type(hm_c_error) :: e
    integer(c_int8_t), pointer :: bytes(:)
    integer :: failed
    info%struct_size = int(c_sizeof(info), c_int64_t)
    call open_solved(w, its, ierr, msg)
    if (ierr == hm_ok) call tell(hm_c_basis_info_get(its%basis, info, e), e, ierr, msg)
    if (ierr < 0) return
    call c_f_pointer(its%basis, bytes, [info%bytes])
    write(lun, iostat=failed) info%bytes
    if (failed == 0) write(lun, iostat=failed) bytes
    if (failed /= 0) call complain("the functions could not be written", ierr, msg)
end subroutine

subroutine hmload(w, lun, ierr, msg)
    use harmorph77_state
    implicit none
    integer, intent(in) :: lun
    real(c_double), intent(inout), target :: w(*)
    integer, intent(out) :: ierr
    character(len=*), intent(inout) :: msg
    type(state), pointer :: its
    type(c_ptr) :: basis
    type(hm_c_error) :: e
    integer(c_int8_t), pointer :: bytes(:)
    integer(c_int64_t) :: n
    integer :: failed
    call open_state(w, its, ierr, msg)
    if (ierr /= hm_ok) return
    call forget(its)
    read(lun, iostat=failed) n
    if (failed /= 0 .or. n < 1) then
        call complain("this unit has no functions that HMSAVE wrote", ierr, msg)
        return
    end if
    if (.not. fits(its, words_of(int(n, c_size_t)), its%words, ierr, msg)) return
    call c_f_pointer(c_loc(w(its%used + 1)), bytes, [n])
    read(lun, iostat=failed) bytes
    if (failed /= 0) then
        call complain("the file ends in the midst of the functions", ierr, msg)
        return
    end if
    call tell(hm_c_basis_attach(basis, c_loc(w(its%used + 1)), int(n, c_size_t), c_loc(its%mesh), e), e, ierr, msg)
    if (ierr >= 0) call keep_basis(its, basis)
end subroutine
