C     EVERY LEGACY CALL FROM FORTRAN 77, WITH ASSERTIONS.
      PROGRAM LEGACY
      INTEGER NA, NR, NP, NC, NF, LW, NCP
      PARAMETER (NA = 96, NR = 33, NP = NA*NR, NC = NA*(NR - 1))
      PARAMETER (NF = 2*NA, LW = 2000000, NCP = 14)
      DOUBLE PRECISION W, X, Y, XN, YN, DX, DY, GX, GY
      INTEGER CELLS, FACES, MARKS
      COMMON /WORK/ W(LW)
      COMMON /MESH/ X(NP), Y(NP), CELLS(4,NC), FACES(2,NF), MARKS(NF)
      COMMON /MOVED/ XN(NP), YN(NP), DX(NP), DY(NP), GX(NP), GY(NP)
      DOUBLE PRECISION V(2,NP), XB(NA+1,NR), YB(NA+1,NR)
      COMMON /OTHER/ V, XB, YB
      DOUBLE PRECISION P(2,40), DP(2,NCP), G(2,NCP), TURN(2,NCP), U(8)
      DOUBLE PRECISION VX(NP), VY(NP)
      DOUBLE PRECISION DR(2,NCP), WX(NA), WY(NA), HX(NA), HY(NA)
      DOUBLE PRECISION DMAX, RESID, S, AMIN, QMIN, HERE, THERE, BIG
      INTEGER IWALL(NA)
      INTEGER IPTS(NA), IDX(5), MB(4), N, M, LOOP, ICELL, NINV, IERR
      INTEGER I, J, K
      CHARACTER*112 MSG
      CHARACTER*9 NAMES(6)
      INTEGER ITYPE
      COMMON /TYPES/ ITYPE(NP)
      INTEGER NPASS, NFAIL
      COMMON /COUNTS/ NPASS, NFAIL
      DATA IDX /1, 2, 3, 4, 1/
      DATA U /0D0, 0D0, 1D0, 2D0, 3D0, 4D0, 4D0, 5D0/
      DATA MB /0, 0, 7, 9/
      DATA NAMES /'OPERATOR', 'EXPONENT', 'SCHEME', 'ENGINE', 'KERNEL',
     &            'PRECISION'/

      CALL MAKE (NA, NR, X, Y, CELLS, FACES, MARKS)

C     BEFORE THE BEGINNING, AND A WORK ARRAY THAT IS TOO SMALL.
      W(1) = 0D0
      CALL HMSOLV (W, RESID, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'NOT OPENED: ', MSG)
      CALL HMOPEN (W, 10, IERR, MSG)
      CALL CHECK (IERR .EQ. -7, 'TEN WORDS: ', MSG)
      CALL HMOPEN (W, 20000, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'OPENED: ', MSG)
      CALL HMMESH (W, NP, X, Y, 1, NC, 4, CELLS, NF, FACES, MARKS, IERR,
     &             MSG)
      CALL CHECK (IERR .EQ. 0, 'MESH: ', MSG)
      CALL HMFIT (W, 7, NCP, 3, 0, DMAX, IERR, MSG)
      CALL CHECK (IERR .EQ. -7, 'TOO SMALL FOR THE MESH: ', MSG)

C     A MESH OF QUADS, A FIT, THE FUNCTIONS.
      CALL HMOPEN (W, LW, IERR, MSG)
      CALL HMMESH (W, NP, X, Y, 1, NC, 5, CELLS, NF, FACES, MARKS, IERR,
     &             MSG)
      CALL CHECK (IERR .EQ. -2, 'CELLS OF FIVE POINTS: ', MSG)
      CALL HMMESH (W, NP, X, Y, 1, NC, 4, CELLS, NF, FACES, MARKS, IERR,
     &             MSG)
      CALL HMWALL (W, 7, NA, IPTS, N, LOOP, IERR, MSG)
      CALL CHECK (IERR .EQ. 0 .AND. N .EQ. NA .AND. LOOP .EQ. 1,
     &            'POINTS OF THE WALL: ', MSG)
      CALL HMWALL (W, 7, 10, IPTS, N, LOOP, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'TOO LITTLE ROOM: ', MSG)
      CALL HMWALL (W, 8, NA, IPTS, N, LOOP, IERR, MSG)
      CALL CHECK (IERR .LT. 0, 'NO SUCH MARKER: ', MSG)
      CALL HMMORF (W, DP, X, Y, 1, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'NOT SOLVED: ', MSG)
      CALL HMSOLV (W, RESID, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'NO CURVE: ', MSG)
      CALL HMFIT (W, 7, NCP, 3, 0, DMAX, IERR, MSG)
      CALL CHECK (IERR .EQ. 0 .AND. DMAX .LT. 2D-3, 'FIT: ', MSG)
      CALL HMSOLV (W, RESID, IERR, MSG)
      CALL CHECK (IERR .LT. 0, 'NO CONDITION: ', MSG)
      CALL HMCOND (W, 7, 0, 1, 1, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'CONDITION: ', MSG)
      CALL HMSOLV (W, RESID, IERR, MSG)
      CALL CHECK (IERR .EQ. 0 .AND. RESID .LT. 1D-12, 'SOLVED: ', MSG)
      CALL HMGETP (W, 40, P, N, IERR, MSG)
      CALL CHECK (IERR .EQ. 0 .AND. N .EQ. NCP, 'POINTS: ', MSG)
      CALL HMGETP (W, 3, P, N, IERR, MSG)
      CALL CHECK (IERR .EQ. -2 .AND. N .EQ. NCP, 'NO ROOM: ', MSG)

C     MORPH, ADJOINT, STEP, QUALITY.
      DO 10 K = 1, NCP
         DP(1,K) = 0D0
         DP(2,K) = 0D0
   10 CONTINUE
C     THE AREA, AND ITS DERIVATIVES: GROWN BY 1 PER CENT, BY 2.01.
      CALL HMMEAS (W, 0, 0D0, DP, S, G, IERR, MSG)
      CALL CHECK (IERR .EQ. 0 .AND. S .GT. 0D0, 'AREA: ', MSG)
      CALL HMGETP (W, 40, P, N, IERR, MSG)
      BIG = 0D0
      DO 11 K = 1, NCP
         DP(1,K) = 1D-2*P(1,K)
         DP(2,K) = 1D-2*P(2,K)
         BIG = BIG + G(1,K)*DP(1,K) + G(2,K)*DP(2,K)
   11 CONTINUE
      CALL CHECK (ABS(BIG - 2D-2*S) .LT. 1D-12*S,
     &            'DERIVATIVES OF THE AREA', ' ')
      CALL HMMEAS (W, 0, 0D0, DP, BIG, G, IERR, MSG)
      CALL CHECK (ABS(BIG - 1.0201D0*S) .LT. 1D-12*S,
     &            'AREA AFTER A MOVEMENT', ' ')
      CALL HMMEAS (W, 7, 0.5D0, DP, BIG, G, IERR, MSG)
      CALL CHECK (IERR .EQ. -4, 'NO TRAILING EDGE: ', MSG)
      DO 12 K = 1, NCP
         DP(1,K) = 0D0
         DP(2,K) = 0D0
   12 CONTINUE
      CALL COPY (NP, X, Y, XN, YN)
      CALL HMMORF (W, DP, XN, YN, 1, IERR, MSG)
      J = 0
      DO 20 K = 1, NP
         IF (ABS(XN(K) - X(K)) + ABS(YN(K) - Y(K))
     &       .LE. 0D0) J = J + 1
   20 CONTINUE
      CALL CHECK (J .EQ. NP, 'NOTHING KEEPS ALL BITS', ' ')
      DO 30 K = 1, NCP
         DP(1,K) = 0.01D0*SIN(1.7D0*K)
         DP(2,K) = 0.01D0*COS(2.9D0*K)
   30 CONTINUE
      CALL HMDISP (W, DP, DX, DY, 1, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'DISPLACEMENT: ', MSG)
      CALL HMSTEP (W, X, Y, DX, DY, 1, S, ICELL, IERR, MSG)
      CALL CHECK (IERR .EQ. 0 .AND. S .GT. 1D0 .AND. ICELL .GE. 1,
     &            'STEP: ', MSG)
      CALL HMMORF (W, DP, XN, YN, 1, IERR, MSG)
      BIG = 0D0
      HERE = 0D0
      DO 40 K = 1, NP
         BIG = MAX(BIG, ABS(X(K) + DX(K) - XN(K)),
     &             ABS(Y(K) + DY(K) - YN(K)))
         GX(K) = SIN(1D0*K)
         GY(K) = COS(3D0*K)
         HERE = HERE + GX(K)*DX(K) + GY(K)*DY(K)
   40 CONTINUE
      CALL CHECK (BIG .LT. 1D-14, 'MORPH = X + DISPLACEMENT', ' ')
      CALL HMQUAL (W, XN, YN, 1, NINV, AMIN, QMIN, IERR, MSG)
      CALL CHECK (IERR .EQ. 0 .AND. NINV .EQ. 0 .AND. AMIN .GT. 0D0
     &            .AND. QMIN .GT. 0D0, 'QUALITY: ', MSG)
      CALL HMADJ (W, GX, GY, 1, G, IERR, MSG)
      THERE = 0D0
      DO 50 K = 1, NCP
         THERE = THERE + G(1,K)*DP(1,K) + G(2,K)*DP(2,K)
   50 CONTINUE
      CALL CHECK (IERR .EQ. 0 .AND. ABS(HERE - THERE) .LT. 1D-12,
     &            'ADJOINT IS THE TRANSPOSE: ', MSG)

C     A MOVEMENT THAT THE FUNCTIONS BEAR: HMSAFE IS HMMORF, BUT FOR THE
C     OFFSETS OF WALL POINTS FROM THE CURVE, WHICH TURN. CONFORMAL
C     FUNCTIONS WITHOUT WEIGHT ARE THOSE OF LAPLACE. WITH THESE, A TURN
C     BY 60 DEGREES INVERTS CELLS; HMSAFE GETS THERE.
      CALL HMSAFE (W, DP, GX, GY, 1, DR, S, K, IERR, MSG)
      CALL CHECK (IERR .EQ. 0 .AND. K .EQ. 0 .AND. ABS(S - 1D0)
     &            .LE. 0D0, 'A SAFE STEP: ', MSG)
      BIG = 0D0
      DO 51 K = 1, NP
         BIG = MAX(BIG, ABS(GX(K) - XN(K)), ABS(GY(K) - YN(K)))
   51 CONTINUE
      CALL CHECK (BIG .LT. 1D-3, 'IT IS NEARLY THE MORPH', ' ')
      J = 0
      DO 515 K = 1, NCP
         IF (ABS(DR(1,K) - DP(1,K)) + ABS(DR(2,K) - DP(2,K))
     &       .LE. 0D0) J = J + 1
  515 CONTINUE
      CALL CHECK (J .EQ. NCP, 'ALL OF THE MOVEMENT IS REACHED', ' ')
      CALL HMOPT (W, 'EXPONANT', 1, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'AN OPTION THAT IS NONE: ', MSG)
      DO 516 K = 1, 6
         CALL HMOPT (W, NAMES(K), 77, IERR, MSG)
         CALL HMSOLV (W, RESID, IERR, MSG)
         CALL CHECK (IERR .LT. 0, NAMES(K), MSG)
         CALL HMOPT (W, NAMES(K), 0, IERR, MSG)
  516 CONTINUE
      CALL HMOPT (W, 'EXPONENT', -1, IERR, MSG)
      CALL HMSOLV (W, RESID, IERR, MSG)
      CALL HMDISP (W, DP, DX, DY, 1, IERR, MSG)
      CALL HMOPT (W, 'EXPONENT', 0, IERR, MSG)
      CALL HMOPT (W, 'OPERATOR', 1, IERR, MSG)
      CALL HMSOLV (W, RESID, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'LAPLACE: ', MSG)
      CALL HMDISP (W, DP, GX, GY, 1, IERR, MSG)
      BIG = 0D0
      S = 0D0
      DO 52 K = 1, NP
         BIG = MAX(BIG, ABS(DX(K) - GX(K)) + ABS(DY(K) - GY(K)))
         S = MAX(S, ABS(X(K) + GX(K) - XN(K)))
   52 CONTINUE
      CALL CHECK (BIG .LT. 1D-12 .AND. S .GT. 1D-4,
     &            'NO WEIGHT: LAPLACE', ' ')
      CALL HMGETP (W, 40, P, N, IERR, MSG)
      DO 53 K = 1, NCP
         TURN(1,K) = -0.5D0*P(1,K) - SQRT(0.75D0)*P(2,K)
         TURN(2,K) = SQRT(0.75D0)*P(1,K) - 0.5D0*P(2,K)
   53 CONTINUE
      CALL COPY (NP, X, Y, GX, GY)
      CALL HMMORF (W, TURN, GX, GY, 1, IERR, MSG)
      CALL HMQUAL (W, GX, GY, 1, NINV, AMIN, QMIN, IERR, MSG)
      CALL CHECK (NINV .GT. 0, '60 DEGREES: CELLS INVERT', ' ')
      CALL HMSAFE (W, TURN, GX, GY, 1, DR, S, K, IERR, MSG)
      CALL CHECK (IERR .EQ. 0 .AND. K .GE. 2 .AND. S .GE. 1D0,
     &            '60 DEGREES, SAFELY: ', MSG)
      CALL HMQUAL (W, GX, GY, 1, NINV, AMIN, QMIN, IERR, MSG)
      CALL CHECK (NINV .EQ. 0 .AND. AMIN .GT. 0D0, 'NONE DOES', ' ')
      BIG = 0D0
      DO 54 K = 1, NA
         BIG = MAX(BIG, ABS(0.5D0*X(K) - SQRT(0.75D0)*Y(K) - GX(K)),
     &             ABS(SQRT(0.75D0)*X(K) + 0.5D0*Y(K) - GY(K)))
   54 CONTINUE
      CALL CHECK (BIG .LT. 2D-3, 'THE WALL IS TURNED', ' ')
      CALL HMDISP (W, DR, DX, DY, 1, IERR, MSG)
      BIG = 0D0
      DO 541 K = 1, NA
         BIG = MAX(BIG, ABS(X(K) + DX(K) - GX(K)),
     &             ABS(Y(K) + DY(K) - GY(K)))
  541 CONTINUE
      CALL CHECK (BIG .LT. 1D-12, 'THE MOVEMENT IS THE WALL''S', ' ')
      CALL HMOPT (W, 'OPERATOR', 0, IERR, MSG)
      CALL HMOPT (W, 'OFFSET', 1, IERR, MSG)
      CALL HMSOLV (W, RESID, IERR, MSG)
      CALL HMDISP (W, TURN, GX, GY, 1, IERR, MSG)
      BIG = 0D0
      DO 545 K = 1, NA
         BIG = MAX(BIG, ABS(0.5D0*X(K) + SQRT(0.75D0)*Y(K) + GX(K)),
     &             ABS(SQRT(0.75D0)*X(K) - 0.5D0*Y(K) - GY(K)))
  545 CONTINUE
      CALL CHECK (BIG .LT. 1D-12, 'ITS OFFSET TURNS ALONG', ' ')
      CALL HMOPT (W, 'OFFSET', 0, IERR, MSG)
      X(NP) = X(NP) + 1D-3
      CALL HMSAFE (W, TURN, GX, GY, 1, DR, S, K, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'X HAS CHANGED: ', MSG)
      CALL MAKE (NA, NR, X, Y, CELLS, FACES, MARKS)

C     THE WALL WITHOUT A CURVE: WHAT HMDISP MADE OF IT, GIVEN POINT BY
C     POINT, MOVES THE MESH ALIKE. THE TRANSPOSE DOES THE SAME WORK.
      CALL HMOPT (W, 'OPERATOR', 1, IERR, MSG)
      CALL HMSOLV (W, RESID, IERR, MSG)
      CALL HMDISP (W, DP, DX, DY, 1, IERR, MSG)
      CALL HMGIVE (W, NA, IWALL, DX, DY, VX, VY, 1, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'NO FACTOR IS KEPT: ', MSG)
      CALL HMMESH (W, NP, X, Y, 1, NC, 4, CELLS, NF, FACES, MARKS, IERR,
     &             MSG)
      CALL HMCOND (W, 7, 6, 0, 0, IERR, MSG)
      CALL HMFACT (W, RESID, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'FACTOR FOR GIVEN DISPLACEMENTS: ', MSG)
      DO 546 K = 1, NA
         IWALL(K) = K
         WX(K) = DX(K)
         WY(K) = DY(K)
  546 CONTINUE
      CALL HMGIVE (W, NA, IWALL, WX, WY, VX, VY, 1, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'GIVEN DISPLACEMENTS: ', MSG)
      BIG = 0D0
      HERE = 0D0
      DO 547 K = 1, NP
         BIG = MAX(BIG, ABS(VX(K) - DX(K)), ABS(VY(K) - DY(K)))
         GX(K) = SIN(1D0*K)
         GY(K) = COS(3D0*K)
         HERE = HERE + VX(K)*GX(K) + VY(K)*GY(K)
  547 CONTINUE
      CALL CHECK (BIG .LT. 1D-12, 'THEY ARE THOSE OF THE CURVE', ' ')
      CALL HMGADJ (W, NA, IWALL, GX, GY, 1, HX, HY, IERR, MSG)
      THERE = 0D0
      DO 548 K = 1, NA
         THERE = THERE + WX(K)*HX(K) + WY(K)*HY(K)
  548 CONTINUE
      CALL CHECK (IERR .EQ. 0 .AND. ABS(HERE - THERE) .LT. 1D-12,
     &            'SAME WORK ON MESH AND WALL: ', MSG)
      CALL HMGIVE (W, NA - 1, IWALL, WX, WY, VX, VY, 1, IERR, MSG)
      CALL CHECK (IERR .EQ. -5, 'A POINT IS MISSING: ', MSG)
      CALL HMQUAL (W, X, Y, 1, NINV, AMIN, QMIN, IERR, MSG)
      CALL CHECK (IERR .EQ. 0 .AND. NINV .EQ. 0, 'QUALITY: ', MSG)

C     TURNED BY 120 DEGREES, THE WALL GETS THERE BIT BY BIT; HMGIVE GOES
C     ON WITH THE FACTOR OF HMFACT.
      DO 549 K = 1, NA
         WX(K) = -1.5D0*X(K) - SQRT(0.75D0)*Y(K)
         WY(K) = SQRT(0.75D0)*X(K) - 1.5D0*Y(K)
  549 CONTINUE
      CALL HMGSAF (W, NA, IWALL, WX, WY, DP, VX, VY, 1, S, K, IERR, MSG)
      CALL CHECK (IERR .EQ. 0 .OR. IERR .EQ. 6, 'SAFELY GIVEN: ', MSG)
      CALL CHECK (S .GE. 1D0 .AND. K .GE. 1, 'ALL OF THE WAY', ' ')
      CALL HMQUAL (W, VX, VY, 1, NINV, AMIN, QMIN, IERR, MSG)
      CALL CHECK (NINV .EQ. 0 .AND. AMIN .GT. 0D0, 'NONE INVERTS', ' ')
      BIG = 0D0
      DO 550 K = 1, NA
         BIG = MAX(BIG, ABS(VX(K) - (X(K) + WX(K))),
     &             ABS(VY(K) - (Y(K) + WY(K))))
  550 CONTINUE
      CALL CHECK (BIG .LE. 0D0, 'THE GIVEN BITS', ' ')
      CALL HMGSAF (W, NA - 1, IWALL, WX, WY, DP, VX, VY, 1, S, K, IERR,
     &             MSG)
      CALL CHECK (IERR .EQ. -5, 'A POINT IS MISSING, SAFELY: ', MSG)
      CALL HMGIVE (W, NA, IWALL, WX, WY, VX, VY, 1, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'GIVEN ONCE MORE: ', MSG)

C     A RIGID BODY INSTEAD OF THE CURVE: MOVED, AND TURNED BY 10 DEGREES
C     ABOUT ITS QUARTER CHORD.
      CALL HMMESH (W, NP, X, Y, 1, NC, 4, CELLS, NF, FACES, MARKS, IERR,
     &             MSG)
      CALL HMOPT (W, 'OPERATOR', 0, IERR, MSG)
      CALL HMRIGD (W, 7, 1, -0.25D0, 0D0, IERR, MSG)
      CALL HMSOLV (W, RESID, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'A RIGID BODY: ', MSG)
      CALL HMGETP (W, 40, P, N, IERR, MSG)
      CALL CHECK (IERR .EQ. 0 .AND. N .EQ. 0, 'NO POINTS: ', MSG)
      TURN(1,1) = 0.1D0
      TURN(2,1) = -0.05D0
      TURN(1,2) = COS(0.17453292519943295D0) - 1D0
      TURN(2,2) = SIN(0.17453292519943295D0)
      CALL HMDISP (W, TURN, DX, DY, 1, IERR, MSG)
      BIG = 0D0
      DO 55 K = 1, NA
         S = TURN(1,1) + TURN(1,2)*(X(K) + 0.25D0) - TURN(2,2)*Y(K)
         BIG = MAX(BIG, ABS(DX(K) - S))
         S = TURN(2,1) + TURN(2,2)*(X(K) + 0.25D0) + TURN(1,2)*Y(K)
         BIG = MAX(BIG, ABS(DY(K) - S))
   55 CONTINUE
      CALL CHECK (BIG .LT. 1D-15, 'IT MOVES RIGIDLY', ' ')
      CALL HMFIT (W, 7, NCP, 3, 0, DMAX, IERR, MSG)
      CALL HMCOND (W, 7, 0, 1, 1, IERR, MSG)
      CALL HMSOLV (W, RESID, IERR, MSG)

C     INTERLEAVED: V(1,*) = X, V(2,*) = Y.
      DO 60 K = 1, NP
         V(1,K) = X(K)
         V(2,K) = Y(K)
   60 CONTINUE
      CALL HMMORF (W, DP, V(1,1), V(2,1), 2, IERR, MSG)
      J = 0
      DO 70 K = 1, NP
         IF (ABS(V(1,K) - XN(K)) + ABS(V(2,K) - YN(K))
     &       .LE. 0D0) J = J + 1
   70 CONTINUE
      CALL CHECK (J .EQ. NP, 'INTERLEAVED: THE SAME BITS', ' ')

C     SAVE, CLOSE, LOAD.
      OPEN (11, STATUS = 'SCRATCH', FORM = 'UNFORMATTED')
      CALL HMSAVE (W, 11, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'SAVED: ', MSG)
      CALL HMCLOS (W)
      CALL HMSAVE (W, 11, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'CLOSED: ', MSG)
      REWIND 11
      CALL HMOPEN (W, LW, IERR, MSG)
      CALL HMMESH (W, NP, X, Y, 1, NC, 4, CELLS, NF, FACES, MARKS, IERR,
     &             MSG)
      CALL HMLOAD (W, 11, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'LOADED: ', MSG)
      CALL COPY (NP, X, Y, DX, DY)
      CALL HMMORF (W, DP, DX, DY, 1, IERR, MSG)
      J = 0
      DO 80 K = 1, NP
         IF (ABS(DX(K) - XN(K)) + ABS(DY(K) - YN(K))
     &       .LE. 0D0) J = J + 1
   80 CONTINUE
      CALL CHECK (J .EQ. NP, 'LOADED: THE SAME BITS', ' ')
      CALL HMGETP (W, 40, P, N, IERR, MSG)
      CALL CHECK (N .EQ. NCP, 'LOADED: ITS POINTS', MSG)
      CALL HMSAFE (W, DP, DX, DY, 1, DR, S, K, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'SAFELY AFTER HMLOAD: ', MSG)

C     IN SINGLE PRECISION: THE WALL AS BEFORE, THE REST NEARLY.
      CALL HMSNGL (W, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'SINGLE: ', MSG)
      CALL COPY (NP, X, Y, DX, DY)
      CALL HMMORF (W, DP, DX, DY, 1, IERR, MSG)
      J = 0
      S = 0D0
      DO 85 K = 1, NP
         IF (K .LE. NA .AND. ABS(DX(K) - XN(K)) + ABS(DY(K) - YN(K))
     &       .LE. 0D0) J = J + 1
         S = MAX(S, ABS(DX(K) - XN(K)) + ABS(DY(K) - YN(K)))
   85 CONTINUE
      CALL CHECK (IERR .EQ. 0 .AND. J .EQ. NA .AND. S .GT. 0D0 .AND.
     &            S .LT. 1D-8, 'SINGLE: THE WALL BIT BY BIT', MSG)
      CALL HMSNGL (W, IERR, MSG)
      CALL CHECK (IERR .EQ. -9, 'SINGLE TWICE: ', MSG)
      CALL HMLOAD (W, 11, IERR, MSG)
      CALL CHECK (IERR .LT. 0, 'NOTHING LEFT: ', MSG)
      CLOSE (11)

C     A BLOCK, WITH A CURVE OF DEGREE 1 BY HAND: THE WALL MAY BE AWAY
C     FROM IT, THE OFFSET IS KEPT.
      DO 100 J = 1, NR
         DO 90 I = 1, NA
            XB(I,J) = X(I + NA*(J - 1))
            YB(I,J) = Y(I + NA*(J - 1))
   90    CONTINUE
         XB(NA+1,J) = XB(1,J)
         YB(NA+1,J) = YB(1,J)
  100 CONTINUE
      CALL HMBLOK (W, NA + 1, NR, XB, YB, MB, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'BLOCK: ', MSG)
      CALL HMCURV (W, 1, 5, IDX, U, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'NO CONTROL POINTS: ', MSG)
      P(1,1) = 0.6D0
      P(2,1) = 0D0
      P(1,2) = 0D0
      P(2,2) = 0.2D0
      P(1,3) = -0.6D0
      P(2,3) = 0D0
      P(1,4) = 0D0
      P(2,4) = -0.2D0
      CALL HMCTRL (W, 1, P, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'ONE POINT: ', MSG)
      CALL HMCTRL (W, 4, P, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'CONTROL POINTS: ', MSG)
      U(3) = 9D0
      CALL HMCURV (W, 1, 5, IDX, U, IERR, MSG)
      CALL CHECK (IERR .EQ. -4, 'KNOTS THAT DECREASE: ', MSG)
      U(3) = 1D0
      CALL HMCURV (W, 1, 5, IDX, U, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'CURVE: ', MSG)
      CALL HMCOND (W, 7, 0, 1, 1, IERR, MSG)
      CALL HMCOND (W, 9, 2, 1, 1, IERR, MSG)
      CALL HMSOLV (W, RESID, IERR, MSG)
      CALL CHECK (IERR .EQ. 5, 'BLOCK SOLVED, A WARNING: ', MSG)
      CALL CHECK (INDEX(MSG, 'its curve') .GT. 0, 'ITS TEXT: ', MSG)
      DO 110 K = 1, 4
         DP(1,K) = 0.01D0
         DP(2,K) = 0D0
  110 CONTINUE
      CALL HMDISP (W, DP, DX, DY, 1, IERR, MSG)
      M = 0
      DO 120 K = 1, NA
         IF (ABS(DX(K) - 0.01D0) .LT. 1D-15) M = M + 1
  120 CONTINUE
      CALL CHECK (M .EQ. NA, 'THE WALL MOVES AS A WHOLE', ' ')
      CALL HMSOLV (W, RESID, IERR, MSG)
      CALL CHECK (IERR .EQ. 5, 'SOLVED AGAIN: ', MSG)
C     A RECTANGLE OF 20 BY 10 POINTS, A MARKER FOR EACH SIDE.
      DO 130 K = 1, 200
         XN(K) = MOD(K - 1, 20)
         YN(K) = (K - 1)/20
  130 CONTINUE
      DO 135 K = 1, 4
         MB(K) = K
  135 CONTINUE
      CALL HMBLOK (W, 20, 10, XN, YN, MB, IERR, MSG)
      CALL HMWALL (W, 2, NA, IPTS, N, LOOP, IERR, MSG)
      CALL CHECK (IERR .EQ. 0 .AND. N .EQ. 10 .AND. LOOP .EQ. 0 .AND.
     &            MIN(IPTS(1), IPTS(N)) .EQ. 20, 'SIDE 2: ', MSG)
      CALL HMFIT (W, 5, NCP, 3, 0, DMAX, IERR, MSG)
      CALL CHECK (IERR .EQ. -5, 'NO SIDE 5: ', MSG)
      CALL HMFIT (W, 1, 6, 2, 1, DMAX, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'AN OPEN FIT OF SIDE 1: ', MSG)
      CALL HMCOND (W, 1, 0, 1, 1, IERR, MSG)
      CALL HMCOND (W, 3, 4, 1, 1, IERR, MSG)
      CALL HMSOLV (W, RESID, IERR, MSG)
      CALL CHECK (IERR .EQ. -9, 'CONFORMAL WITH A FREE SIDE: ', MSG)
      CALL HMOPT (W, 'OPERATOR', 1, IERR, MSG)
      CALL HMSOLV (W, RESID, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'LAPLACE WITH A FREE SIDE: ', MSG)

C     SIDE 1 MOVES, SIDE 3 SLIPS: IT STAYS ON ITS LINE, Y = 0, AND DOES
C     NOT STAY WHERE IT IS.
      DO 136 K = 1, NCP
         DP(1,K) = 0.1D0*K
         DP(2,K) = 0.05D0*K
  136 CONTINUE
      CALL HMFIT (W, 1, 6, 2, 1, DMAX, IERR, MSG)
      CALL HMCOND (W, 1, 0, 1, 1, IERR, MSG)
      CALL HMCOND (W, 3, 3, 0, 0, IERR, MSG)
      CALL HMOPT (W, 'OPERATOR', 0, IERR, MSG)
      CALL HMSOLV (W, RESID, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'A SIDE THAT SLIPS: ', MSG)
      CALL HMDISP (W, DP, DX, DY, 1, IERR, MSG)
      M = 0
      BIG = 0D0
      DO 137 K = 2, 19
         IF (ABS(DY(K)) .LE. 0D0) M = M + 1
         BIG = MAX(BIG, ABS(DX(K)))
  137 CONTINUE
      CALL CHECK (M .EQ. 18 .AND. BIG .GT. 1D-3, 'IT SLIPS', ' ')
      CALL HMCOND (W, 3, 5, 0, 0, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'A PAIR BY HMCOND: ', MSG)
      CALL HMCOND (W, 3, 1, 0, 0, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'A BODY BY HMCOND: ', MSG)
      DO 140 K = 1, 20
         CALL HMCURV (W, 1, 2, IDX, U(2), IERR, MSG)
         IF (K .EQ. 15) CALL CHECK (IERR .EQ. 0, '16 CURVES: ', MSG)
  140 CONTINUE
      CALL CHECK (IERR .EQ. -2, '21 CURVES: ', MSG)
      DO 150 K = 1, 70
         CALL HMCOND (W, 1, 0, 1, 1, IERR, MSG)
  150 CONTINUE
      CALL CHECK (IERR .EQ. -2, '72 CONDITIONS: ', MSG)
      MB(3) = 0
      CALL HMBLOK (W, 1, NR, XB, YB, MB, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'NO BLOCK: ', MSG)

C     A CASCADE: THE RECTANGLE WITH A RIGID HOLE IN IT; ITS LOWER AND
C     UPPER SIDES ARE A PAIR AND MOVE ALIKE, BIT BY BIT.
      CALL HOLE (N, CELLS, M, FACES, MARKS)
      CALL HMMESH (W, 200, XN, YN, 1, N, 4, CELLS, M, FACES, MARKS,
     &             IERR, MSG)
      CALL HMRIGD (W, 5, 1, 9D0, 4D0, IERR, MSG)
      CALL HMNEAR (W, 9D0, 4D0, IERR, MSG)
      CALL HMPAIR (W, 1, 3, IERR, MSG)
      CALL HMSOLV (W, RESID, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'A PAIR: ', MSG)
      TURN(1,1) = 0.1D0
      TURN(2,1) = 0.2D0
      TURN(1,2) = 0D0
      TURN(2,2) = 0.1D0
      CALL HMDISP (W, TURN, DX, DY, 1, IERR, MSG)
      M = 0
      BIG = 0D0
      DO 160 K = 1, 20
         IF (ABS(DX(K) - DX(K + 180)) + ABS(DY(K) - DY(K + 180))
     &       .LE. 0D0) M = M + 1
         BIG = MAX(BIG, ABS(DX(K)))
  160 CONTINUE
      CALL CHECK (M .EQ. 20 .AND. BIG .GT. 1D-3, 'BIT BY BIT', ' ')

C     A BOUNDARY BY TYPES OF POINTS: THE SAME FUNCTIONS AS BY FACES.
      CALL MAKE (NA, NR, X, Y, CELLS, FACES, MARKS)
      CALL HMMESH (W, NP, X, Y, 1, NC, 4, CELLS, NF, FACES, MARKS, IERR,
     &             MSG)
      CALL HMFIT (W, 7, NCP, 3, 0, DMAX, IERR, MSG)
      CALL HMCOND (W, 7, 0, 1, 1, IERR, MSG)
      CALL HMSOLV (W, RESID, IERR, MSG)
      CALL HMDISP (W, DP, DX, DY, 1, IERR, MSG)
      DO 170 K = 1, NP
         ITYPE(K) = 0
         IF (K .LE. NA) ITYPE(K) = 7
         IF (K .GT. NP - NA) ITYPE(K) = 9
  170 CONTINUE
      CALL HMMESH (W, NP, X, Y, 1, NC, 4, CELLS, 0, FACES, MARKS, IERR,
     &             MSG)
      CALL HMTYPE (W, ITYPE, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'TYPES OF POINTS: ', MSG)
      CALL HMWALL (W, 7, NA, IPTS, N, LOOP, IERR, MSG)
      CALL CHECK (N .EQ. NA, 'ALL POINTS OF THE WALL: ', MSG)
      CALL CHECK (LOOP .EQ. 1, 'ITS LOOP: ', MSG)
      CALL HMFIT (W, 7, NCP, 3, 0, DMAX, IERR, MSG)
      CALL HMCOND (W, 7, 0, 1, 1, IERR, MSG)
      CALL HMSOLV (W, RESID, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'SOLVED BY TYPES: ', MSG)
      CALL HMDISP (W, DP, GX, GY, 1, IERR, MSG)
      BIG = 0D0
      DO 180 K = 1, NP
         BIG = MAX(BIG, ABS(GX(K) - DX(K)), ABS(GY(K) - DY(K)))
  180 CONTINUE
      CALL CHECK (BIG .LE. 0D0, 'THE SAME FUNCTIONS', ' ')
      CELLS(1,1) = NP + 1
      CALL HMTYPE (W, ITYPE, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'NO SUCH POINT: ', MSG)
      MB(3) = 7
      CALL HMBLOK (W, NA + 1, NR, XB, YB, MB, IERR, MSG)
      CALL HMTYPE (W, ITYPE, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'TYPES OF A BLOCK: ', MSG)

      WRITE (*, '(I0, A, I0, A)') NPASS, ' passed, ', NFAIL, ' failed'
      IF (NFAIL .GT. 0) STOP 1
      END

      SUBROUTINE CHECK (HOLDS, WHAT, MSG)
      LOGICAL HOLDS
      CHARACTER*(*) WHAT, MSG
      INTEGER NPASS, NFAIL
      COMMON /COUNTS/ NPASS, NFAIL
      IF (HOLDS) THEN
         NPASS = NPASS + 1
      ELSE
         NFAIL = NFAIL + 1
         WRITE (*, *) 'legacy: ', WHAT, MSG
      END IF
      END

      SUBROUTINE COPY (N, X, Y, XN, YN)
      INTEGER N, K
      DOUBLE PRECISION X(N), Y(N), XN(N), YN(N)
      DO 10 K = 1, N
         XN(K) = X(K)
         YN(K) = Y(K)
   10 CONTINUE
      END

C     RINGS ROUND A BODY THAT JOUKOWSKI'S MAPPING MAKES OF A CIRCLE.
      SUBROUTINE MAKE (NA, NR, X, Y, CELLS, FACES, MARKS)
      INTEGER NA, NR, CELLS(4,*), FACES(2,*), MARKS(*), I, J, K, L, NEXT
      DOUBLE PRECISION X(*), Y(*), R, A, B, Q, T
      R = 1.2D0
      DO 20 J = 1, NR
         DO 10 I = 1, NA
            T = 6.283185307179586D0*(I - 1)/NA
            A = R*COS(T) - 0.08D0
            B = R*SIN(T)
            Q = A*A + B*B
            K = I + NA*(J - 1)
            X(K) = 0.25D0*(A + A/Q)
            Y(K) = 0.25D0*(B - B/Q)
            NEXT = K + 1
            IF (I .EQ. NA) NEXT = K + 1 - NA
            IF (J .LT. NR) THEN
               CELLS(1,K) = K
               CELLS(2,K) = K + NA
               CELLS(3,K) = NEXT + NA
               CELLS(4,K) = NEXT
            END IF
            L = 0
            IF (J .EQ. 1) L = I
            IF (J .EQ. NR) L = NA + I
            IF (L .GT. 0) THEN
               FACES(1,L) = K
               FACES(2,L) = NEXT
               MARKS(L) = 7
               IF (J .EQ. NR) MARKS(L) = 9
            END IF
   10    CONTINUE
         R = 1.12D0*R
   20 CONTINUE
      END

C     QUADS AND FACES OF THE RECTANGLE OF 20 BY 10 POINTS WITHOUT THE
C     CELLS IN ITS MIDDLE. MARKERS 1 TO 4: BELOW, RIGHT, ABOVE, LEFT;
C     5: THE HOLE.
      SUBROUTINE HOLE (NC, CELLS, NF, FACES, MARKS)
      INTEGER NC, CELLS(4,*), NF, FACES(2,*), MARKS(*), I, J, K
      LOGICAL IN
      NC = 0
      NF = 0
      DO 20 J = 1, 9
         DO 10 I = 1, 19
            IF (IN(I, J)) GO TO 10
            K = I + 20*(J - 1)
            NC = NC + 1
            CELLS(1,NC) = K
            CELLS(2,NC) = K + 1
            CELLS(3,NC) = K + 21
            CELLS(4,NC) = K + 20
            IF (J .EQ. 1) CALL FACE (NF, FACES, MARKS, K, K + 1, 1)
            IF (I .EQ. 19) CALL FACE (NF, FACES, MARKS, K+1, K+21, 2)
            IF (J .EQ. 9) CALL FACE (NF, FACES, MARKS, K+21, K+20, 3)
            IF (I .EQ. 1) CALL FACE (NF, FACES, MARKS, K + 20, K, 4)
            IF (IN(I, J - 1)) CALL FACE (NF, FACES, MARKS, K, K+1, 5)
            IF (IN(I + 1, J)) CALL FACE (NF, FACES, MARKS, K+1, K+21,
     &                                   5)
            IF (IN(I, J + 1)) CALL FACE (NF, FACES, MARKS, K+21, K+20,
     &                                   5)
            IF (IN(I - 1, J)) CALL FACE (NF, FACES, MARKS, K+20, K, 5)
   10    CONTINUE
   20 CONTINUE
      END

      LOGICAL FUNCTION IN (I, J)
      INTEGER I, J
      IN = I .GE. 8 .AND. I .LE. 11 .AND. J .GE. 4 .AND. J .LE. 5
      END

      SUBROUTINE FACE (NF, FACES, MARKS, K, L, M)
      INTEGER NF, FACES(2,*), MARKS(*), K, L, M
      NF = NF + 1
      FACES(1,NF) = K
      FACES(2,NF) = L
      MARKS(NF) = M
      END

      BLOCK DATA
      INTEGER NPASS, NFAIL
      COMMON /COUNTS/ NPASS, NFAIL
      DATA NPASS, NFAIL /0, 0/
      END
