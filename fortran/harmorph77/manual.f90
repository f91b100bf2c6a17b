! harmorph for FORTRAN 77: external subroutines, plain arrays, no modules at the caller. MIT licence. Compile after
! harmorph.f90 with the caller's compiler and link both, and libharmorph.a.
!
!     DOUBLE PRECISION W(LW)                       everything that is kept is in W; several W are several meshes
!     CALL HMOPEN (W, LW, IERR, MSG)
!
! THE MESH: one of
!     CALL HMMESH (W, NP, X, Y, INC, NC, NPC, CELLS,           CELLS(NPC,NC), NPC 3 or 4; FACES(2,NF), MARKS(NF)
!                  NF, FACES, MARKS, IERR, MSG)
!     CALL HMMIXD (W, NP, X, Y, INC, NT, ITRI, NQ, IQUAD,      triangles ITRI(3,NT), the first cells, and quadrilaterals
!                  NF, FACES, MARKS, IERR, MSG)                IQUAD(4,NQ)
!     CALL HMPOLY (W, NP, X, Y, INC, NC, ISTART, IPTS,         cells of 3 to 1024 points, hanging nodes among them:
!                  NF, FACES, MARKS, IERR, MSG)                cell K has IPTS(ISTART(K)) to IPTS(ISTART(K+1)-1)
!     CALL HMBLOK (W, NI, NJ, X, Y, MARKS, IERR, MSG)          structured; MARKS(4) of sides i=1, i=NI, j=1, j=NJ, 0:
!                                                              a cut
!     CALL HMBLKS (W, NB, NIJ, X, Y, INC, MARKS, IERR, MSG)    NB structured blocks, one after the other in X, Y:
!                                                              NIJ(2,NB), MARKS(4,NB), 0: an interface or a cut
!     CALL HMPLAN (W, NP, X, Y, Z, INC, NF, NPF, FACES,        a mesh one cell thick of a code with three dimensions:
!                  NS, SIDES, MARKS, KIND, AXIS, NPLANE,       FACES(NPF,NF) of one symmetry plane, SIDES(4,NS) of the
!                  IERR, MSG)                                  boundary from one plane to the next, MARKS(NS). KIND 0:
!                                                              found, 1: parallel planes, 2: a wedge round AXIS(6), a
!                                                              point and a direction; all 0: found. The mesh is that
!                                                              of the plane, with NPLANE points
! and
!     CALL HMTYPE (W, ITYPE, IERR, MSG)                        with NF = 0, for a boundary given by types of points:
!                                                              ITYPE(NP) is 0 for inner points, for others a mark. A
!                                                              face between two types has the larger one
!     CALL HMBGET (W, IB, XB, YB, LD, X, Y, INC, IERR, MSG)    from XB(LD,*), YB(LD,*), arrays of block IB of HMBLKS
!                                                              alone, into the places of this block in X, Y
!     CALL HMBPUT (W, IB, X, Y, INC, XB, YB, LD, IERR, MSG)    and back
!
! CURVES
!     CALL HMWALL (W, MARK, NMAX, IPTS, N, LOOP, IERR, MSG)    a marker's points IPTS(N) in order; LOOP 1: closed
!     CALL HMFIT  (W, MARK, NCP, IDEG, ICLOS, DMAX, IERR, MSG) curve through a marker; ICLOS as hm_closed_auto, ...
!  or CALL HMCTRL (W, NCP, P, IERR, MSG)                       control points P(2,NCP); forgets all curves; then
!     CALL HMCURV (W, IDEG, NIDX, IDX, U, IERR, MSG)           a curve through control points IDX(NIDX), knots
!                                                              U(NIDX+IDEG+1)
!     CALL HMREFN (W, ICURV, NU, U, LA, A, NCP, IERR, MSG)     inserts the knots U(NU) into a curve: the same shape with
!                                                              NCP control points. A(old,NCP), of LA numbers: a new
!                                                              point is the sum of A(I,.) times old ones. Conditions
!                                                              stay, functions do not
!     CALL HMELEV (W, ICURV, LA, A, NCP, IERR, MSG)            the same by a degree that is higher by 1
!     CALL HMGETP (W, NMAX, P, NCP, IERR, MSG)                 the control points P(2,NCP)
!
! CONDITIONS
!     CALL HMCOND (W, MARK, KIND, ICURV, NCURV, IERR, MSG)     KIND 0: on curves ICURV..ICURV+NCURV-1, 2 fixed
!                                                              (as markers without condition), 3 slips along its
!                                                              lines (on curves HMMORF moves points along tangents,
!                                                              HMSLID puts them back), 4 free (not with OPERATOR 0),
!                                                              6 moved by HMGIVE; ICURV and NCURV both 0 or 1 then
!     CALL HMALNG (W, NCP, P, WT, IDEG, NIDX, IDX, U, IERR,    the points of the last condition, of KIND 3, slide along
!                  MSG)                                        this curve: as of HMCTRL and HMCURV, with the weights
!                                                              WT(NCP), 1 if it is not rational. P, WT, IDX, U are not
!                                                              copied. Markers with the same P: points slide from one
!                                                              to the next. After HMLOAD, call HMCOND and HMALNG again
!     CALL HMRIGD (W, MARK, IBODY, XC, YC, IERR, MSG)          belongs to rigid body IBODY, which turns about XC, YC
!     CALL HMPAIR (W, MARK, MARK2, IERR, MSG)                  these two are translates of each other and move alike
!     CALL HMTURN (W, MARK, MARK2, XC, YC, IERR, MSG)          one passage of an annulus: MARK2 is MARK, turned about
!                                                              XC, YC; its points move as those of MARK, turned
!     CALL HMNEAR (W, X, Y, IERR, MSG)                         the last condition is only of the piece of its marker
!                                                              that is nearest to X, Y: one of several bodies or sides
!     CALL HMOPT  (W, NAME, IVAL, IERR, MSG)                   before HMSOLV; NAME and values of hm_options:
!                                                              'OPERATOR' 0 conformal, 1 Laplace, 2 weighted;
!                                                              'EXPONENT' 4 q of the weight 1/d**q, -1: no weight;
!                                                              'SCHEME', 'ENGINE', 'KERNEL', 'OFFSET', 'PRECISION'
!
! FUNCTIONS
!     CALL HMSOLV (W, RESID, IERR, MSG)                        the functions, and their residual. IERR 1: not converged;
!                                                              IERR 5: solved, but a point lies far from its curve,
!                                                              see MSG: is the marker the right one?
!     CALL HMFACT (W, RESID, IERR, MSG)                        as HMSOLV, and W keeps the factor for HMGIVE, HMGADJ,
!                                                              HMTABL
!     CALL HMCOMB (W, N, NUM, A, IERR, MSG)                    the functions become N combinations of themselves:
!                                                              A(NUM,N,NCP), NUM 1: real; 2: pairs, complex, as of
!                                                              HMVARS. DP(2,N+2*NBODY) from now on
!     CALL HMTABL (W, M, NUM, N, IP, V, IERR, MSG)             after HMFACT: M more functions behind the others, whose
!                                                              values at the points IP(N), as of HMGIVE, are
!                                                              V(NUM,N,M): modes of a structure, ...
!     CALL HMSNGL (W, IERR, MSG)                               the functions in W in single precision, but on the
!                                                              wall: half the room, HMMORF and HMADJ are faster. Not
!                                                              before HMSAFE, HMCOMB, HMTABL
!     CALL HMSAVE (W, LUN, IERR, MSG), HMLOAD (same)           the functions to, from an open unformatted file
!
! MOVEMENTS
!     CALL HMMORF (W, DP, X, Y, INC, IERR, MSG)                moves mesh points X, Y in place; DP(2,NCP), or with
!                                                              rigid bodies DP(2,NCP+2*NBODY), see hm_morph
!     CALL HMSAFE (W, DP, XN, YN, INC, DR, FRAC, ISTRAT, IERR, XN, YN: the mesh of HMMESH moved so that no cell is
!                  MSG)                                        inverted, however large DP is; FRAC: how much of DP
!                                                              (IERR 3: not all), DR, like DP: the movement that XN,
!                                                              YN have, as bodies turn on the way not FRAC*DP then;
!                                                              ISTRAT 0: as HMMORF, 2: in several steps, 3: untangled
!     CALL HMDISP (W, DP, DX, DY, INC, IERR, MSG)              displacements alone; of velocities: velocities
!     CALL HMADJ  (W, GX, GY, INC, G, IERR, MSG)               gradient G, like DP, from derivatives by mesh points
!     CALL HMSLID (W, X, Y, INC, IERR, MSG)                    after HMMORF, where points slide along curves: puts
!                                                              these points of X, Y onto their curves, and the mesh
!                                                              with them. X, Y are not XN, YN of HMMESH, which must be
!                                                              as HMSOLV found them; analyses the mesh again
!     CALL HMSADJ (W, X, Y, GX, GY, INC, IERR, MSG)            its transpose, before HMADJ: X, Y before HMSLID; GX, GY
!                                                              by the points after HMSLID become those by X, Y
!     CALL HMSTEP (W, X, Y, DX, DY, INC, S, ICELL, IERR, MSG)  largest S for which X + S*DX has no inverted cell
!     CALL HMQUAL (W, X, Y, INC, NINV, AMIN, QMIN, IERR, MSG)  inverted cells, least corner area, least quality
!     CALL HMGIVE (W, N, IP, WX, WY, DX, DY, INC, IERR, MSG)   displacements DX, DY of all mesh points from WX(N),
!                                                              WY(N) of the points IP(N), all of the markers of HMCOND
!                                                              with KIND 6: any number of times, each as a
!                                                              substitution; of velocities: velocities
!     CALL HMGADJ (W, N, IP, GX, GY, INC, HX, HY, IERR, MSG)   the transpose: HX(N), HY(N) from GX, GY of mesh points
!     CALL HMGSAF (W, N, IP, WX, WY, DP, XN, YN, INC, FRAC,    XN, YN: the mesh of HMMESH moved by WX, WY and, if there
!                  ISTRAT, IERR, MSG)                          are curves or rigid bodies, by DP, so that no cell is
!                                                              inverted; see HMSAFE. After HMSOLV or HMFACT
!
! MESHES ONE CELL THICK, after HMPLAN
!     CALL HMPFOL (W, NMAX, IFOL, IERR, MSG)                   the point of the plane that each point follows: IFOL(NP)
!     CALL HMPMRF (W, DP, X, Y, Z, INC, IERR, MSG)             HMMORF of all NP points
!     CALL HMPADJ (W, GX, GY, GZ, INC, G, IERR, MSG)           HMADJ of them: the planes are summed
!     CALL HMPSPR (W, DX, DY, X, Y, Z, INC, IERR, MSG)         displacements DX, DY(NPLANE) of HMDISP or HMGIVE, or XN
!                                                              of HMSAFE less that of before, added to X, Y, Z
!     CALL HMPGAT (W, GX, GY, GZ, INC, PX, PY, IERR, MSG)      the transpose: PX, PY(NPLANE)
!
! MEASURES AND DESIGN VARIABLES
!     CALL HMMEAS (W, KIND, STATN, DP, VALUE, G, IERR, MSG)    area, thickness, ...: quantity KIND of hm_measure, at
!                                                              the station STATN or 0, of the curves after the
!                                                              movement DP; G(2,NCP): its derivatives by the control
!                                                              points
!     CALL HMCLEA (W, NPOL, POLY, DP, VALUE, G, IERR, MSG)     the smallest distance of the outline from the polygon
!                                                              POLY(2,NPOL) inside; negative: a part is outside
!     CALL HMVARS (W, KIND, N1, N2, PAR, LA, A, NV, ERR, IERR, A(2,NV,NCP), of LA numbers, for HMCOMB: NV variables,
!                  MSG)                                        and ERR(2,NV), what the curve cannot follow: root mean
!                                                              square and largest, for one unit. KIND 0: box of degrees
!                                                              N1, N2 with corners PAR(4), all 0: round the section; 1:
!                                                              CST, N1 above, N2 below, exponents PAR(2), both 0: .5 and
!                                                              1; 2: Hicks-Henne, N1 above, N2 below, PAR(1) the width
!                                                              or 0, PAR(2) to PAR(1+N1+N2) the peaks, or PAR(2) = 0;
!                                                              3: NACA, N1 camber lines and the thickness, N2 = 0, the
!                                                              peaks PAR(N1), or PAR(1) = 0
!     CALL HMSECT (W, ICURV, NCURV, CHORD, IERR, MSG)          the outline for these three: curves ICURV ..
!                                                              ICURV+NCURV-1, NCURV 0: all; CHORD(4): leading and
!                                                              trailing edge, all 0: the curves' own. Periodic curves
!                                                              have none
!     CALL HMCLOS (W)                                          W is free for other use
!
! Default INTEGER of 4 bytes. Coordinates are X(1), X(1+INC), ...; all counts begin with 1. IERR: 0 done, above 0 a
! warning, below 0 refused with the reason in MSG, CHARACTER*112 or so, and outputs as they were. -7: W is too small;
! MSG says what it needs, as far as is known. X, Y, the arrays of cells and faces, and W, must stay where they are: main
! program, COMMON, SAVE; not so NIJ and MARKS of blocks, and nothing of HMPLAN, which copies. The mesh first, then
! curves, conditions, HMSOLV; or the mesh and HMLOAD. HMSOLV again after the mesh has moved: as before; after it HMCOMB
! and HMTABL again. HMSAFE wants HMSOLV before it in the same W, and X, Y as they were then.
