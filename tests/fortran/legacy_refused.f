C     LEGACY CALLS THAT ARE REFUSED LEAVE W AND THE OUTPUTS AS THEY WERE:
C     LISTS, NUMBERS THAT ARE NOT FINITE, A BOUNDARY THAT CROSSES ITSELF.
      PROGRAM REFUSE
      INTEGER NA, NR, NP, NC, NF, LW, NCP
      PARAMETER (NA = 48, NR = 13, NP = NA*NR, NC = NA*(NR - 1))
      PARAMETER (NF = 2*NA, LW = 600000, NCP = 12)
      DOUBLE PRECISION W, X, Y, DX, DY, EX, EY
      INTEGER CELLS, FACES, MARKS
      COMMON /WORK/ W(LW)
      COMMON /MESH/ X(NP), Y(NP), CELLS(4,NC), FACES(2,NF), MARKS(NF)
      COMMON /MOVED/ DX(NP), DY(NP), EX(NP), EY(NP)
      DOUBLE PRECISION DP(2,NCP), G(2,NCP), P(2,NCP), U(60), V(60)
      DOUBLE PRECISION WX(NA), WY(NA), HX(NA), HY(NA)
      DOUBLE PRECISION BAD, HERE, DMAX, RESID, S, AMIN, QMIN, XY(2)
      DOUBLE PRECISION DIFFER
      INTEGER IDX(60), IWALL(NA), N, M, K, IERR, NINV, ICROSS, ICELL
      INTEGER LOW, HIGH
      CHARACTER*112 MSG
      CHARACTER*3 TEXT
      INTEGER NPASS, NFAIL
      COMMON /COUNTS/ NPASS, NFAIL
      DATA TEXT /'NaN'/

      READ (TEXT, *) BAD
      CALL MAKE (NA, NR, X, Y, CELLS, FACES, MARKS)

C     LISTS COUNT FROM 1. THE ORDER IS CURVES, THEN CONDITIONS.
      CALL HMOPEN (W, LW, IERR, MSG)
      CALL SHIFT (2*NF, FACES, -1)
      CALL HMMESH (W, NP, NC, 4, CELLS, NF, FACES, MARKS, IERR, MSG)
      CALL CHECK (IERR .EQ. -3, 'FACES FROM 0: ', MSG)
      CALL CHECK (INDEX(MSG, 'IFACES(1,1) names point 0') .EQ. 1,
     &            'THE ENTRY: ', MSG)
      CALL HMERR (W, K, N, M, ICELL, S, XY)
      CALL CHECK (K .EQ. 3 .AND. N .EQ. 1, 'THE FACE: ', MSG)
      CALL SHIFT (2*NF, FACES, 1)
      CELLS(3,5) = NP + 1
      CALL HMMESH (W, NP, NC, 4, CELLS, NF, FACES, MARKS, IERR, MSG)
      CALL CHECK (IERR .EQ. -3 .AND. INDEX(MSG, 'ICELLS(3,5)') .EQ. 1,
     &            'A CELL: ', MSG)
      CALL HMERR (W, K, N, M, ICELL, S, XY)
      CALL CHECK (K .EQ. 2 .AND. N .EQ. 5, 'ITS NUMBER: ', MSG)
      CALL HMMIXD (W, NP, 0, CELLS, NC, CELLS, NF, FACES, MARKS, IERR,
     &             MSG)
      CALL CHECK (IERR .EQ. -3 .AND. INDEX(MSG, 'IQUAD(3,5)') .EQ. 1,
     &            'A QUADRILATERAL: ', MSG)
      DO 10 K = 1, 60
         IDX(K) = 4*K - 3
   10 CONTINUE
      CALL HMPOLY (W, NP, 50, IDX, CELLS, NF, FACES, MARKS, IERR, MSG)
      CALL CHECK (IERR .EQ. -3 .AND. INDEX(MSG, 'IPTS(19)') .EQ. 1,
     &            'A POLYGON: ', MSG)
      IDX(7) = IDX(6) + 2
      CALL HMPOLY (W, NP, 50, IDX, CELLS, NF, FACES, MARKS, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'A CELL OF TWO POINTS: ', MSG)
      CALL MAKE (NA, NR, X, Y, CELLS, FACES, MARKS)
      CALL HMMESH (W, NP, NC, 4, CELLS, NF, FACES, MARKS, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'A MESH: ', MSG)
      CALL HMMESH (W, NP, 0, 4, CELLS, NF, FACES, MARKS, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'NO CELLS: ', MSG)
      CALL HMCOND (W, 7, 0, 1, 0, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'NO CURVES: ', MSG)
      CALL HMFIT (W, 7, X, Y, 1, NCP, 3, 0, DMAX, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'A FIT: ', MSG)
      CALL HMCOND (W, 7, 0, 2, 1, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'NO SECOND CURVE: ', MSG)
      CALL HMCOND (W, 7, 0, 1, 0, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'ALL CURVES: ', MSG)

C     A REFUSED CALL LEAVES CURVES, CONDITIONS AND FUNCTIONS IN W.
      CALL HMSOLV (W, X, Y, 1, RESID, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'SOLVED: ', MSG)
      DO 20 K = 1, NCP
         DP(1,K) = 0.01D0*SIN(1.7D0*K)
         DP(2,K) = 0.01D0*COS(2.9D0*K)
   20 CONTINUE
      CALL HMDISP (W, DP, DX, DY, 1, IERR, MSG)
      HERE = X(100)
      X(100) = BAD
      DMAX = 7D0
      CALL HMFIT (W, 7, X, Y, 1, 3, 3, 0, DMAX, IERR, MSG)
      CALL CHECK (IERR .LT. 0, 'TOO FEW CONTROL POINTS: ', MSG)
      CALL HMSOLV (W, X, Y, 1, RESID, IERR, MSG)
      CALL CHECK (IERR .EQ. -3, 'A POINT THAT IS NONE: ', MSG)
      CALL HMFACT (W, X, Y, 1, RESID, IERR, MSG)
      CALL CHECK (IERR .EQ. -3, 'NO FACTOR: ', MSG)
      X(100) = HERE
      HERE = X(3)
      X(3) = BAD
      CALL HMFIT (W, 7, X, Y, 1, NCP, 3, 0, DMAX, IERR, MSG)
      CALL CHECK (IERR .LT. 0, 'A WALL THAT IS NONE: ', MSG)
      X(3) = HERE
      CALL CHECK (ABS(DMAX - 7D0) .LE. 0D0, 'DMAX STAYS', ' ')
C     THE KNOTS OF THIS CURVE FALL.
      DO 35 K = 1, 4
         U(K) = -DBLE(K)
   35 CONTINUE
      CALL HMCURV (W, 1, 2, IDX, U, IERR, MSG)
      CALL CHECK (IERR .LT. 0, 'NO CURVE: ', MSG)
      CALL HMDISP (W, DP, EX, EY, 1, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'THE FUNCTIONS ARE THERE: ', MSG)
      CALL CHECK (DIFFER(NP, DX, DY, EX, EY) .LE. 0D0,
     &            'AND ARE THE SAME', ' ')
      OPEN (9, STATUS = 'SCRATCH', FORM = 'UNFORMATTED')
      CALL HMLOAD (W, 9, X, Y, 1, IERR, MSG)
      CALL CHECK (IERR .LT. 0, 'AN EMPTY FILE: ', MSG)
      CLOSE (9)
      CALL HMDISP (W, DP, EX, EY, 1, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'THEY ARE STILL THERE: ', MSG)
      CALL HMSOLV (W, X, Y, 1, RESID, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'CONDITIONS, TOO: ', MSG)

      CALL STRIDE (W, NCP, NP, X, Y, EX, EY, DP, G, IDX)

C     NUMBERS THAT ARE NOT FINITE.
      CALL HMDISP (W, DP, DX, DY, 1, IERR, MSG)
      CALL COPY (NP, X, Y, EX, EY)
      EY(17) = BAD
      CALL HMMORF (W, DP, EX, EY, 1, IERR, MSG)
      CALL CHECK (IERR .EQ. -3 .AND. INDEX(MSG, 'Y of point 17') .EQ. 1,
     &            'MORPH: ', MSG)
      CALL HMERR (W, K, N, M, ICELL, S, XY)
      CALL CHECK (K .EQ. 1 .AND. N .EQ. 17, 'ITS POINT: ', MSG)
      CALL CHECK (ABS(EX(1) - X(1)) .LE. 0D0, 'NOTHING MOVED', ' ')
      CALL HMQUAL (W, EX, EY, 1, NINV, ICROSS, AMIN, QMIN, IERR, MSG)
      CALL CHECK (IERR .EQ. -3, 'QUALITY: ', MSG)
      CALL HMSTEP (W, EX, EY, DX, DY, 1, S, ICELL, IERR, MSG)
      CALL CHECK (IERR .EQ. -3, 'STEP: ', MSG)
      CALL HMSTEP (W, X, Y, EX, EY, 1, S, ICELL, IERR, MSG)
      CALL CHECK (IERR .EQ. -2 .AND. INDEX(MSG, 'DY of') .EQ. 1,
     &            'A DIRECTION: ', MSG)
      G(1,1) = 5D0
      CALL HMADJ (W, EX, EY, 1, G, IERR, MSG)
      CALL CHECK (IERR .EQ. -2 .AND. INDEX(MSG, 'GY of') .EQ. 1,
     &            'ADJOINT: ', MSG)
      CALL CHECK (ABS(G(1,1) - 5D0) .LE. 0D0, 'G STAYS', ' ')
      HERE = DP(1,2)
      DP(1,2) = BAD
      CALL HMDISP (W, DP, EX, EY, 1, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'A MOVEMENT: ', MSG)
      DP(1,2) = HERE

C     HMGETC GIVES WHAT HMCURV TAKES: THE SAME CURVE, THE SAME FUNCTIONS.
      CALL HMGETP (W, NCP, P, N, IERR, MSG)
      CALL HMGETC (W, 1, 3, K, N, IDX, U, IERR, MSG)
      CALL CHECK (IERR .EQ. -2 .AND. N .GT. 3, 'NO ROOM: ', MSG)
      CALL HMGETC (W, 2, 60, K, N, IDX, U, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'NO CURVE 2: ', MSG)
      CALL HMGETC (W, 1, 40, K, N, IDX, U, IERR, MSG)
      CALL CHECK (IERR .EQ. 0 .AND. K .EQ. 3, 'THE CURVE: ', MSG)
      CALL HMCTRL (W, NCP, P, IERR, MSG)
      CALL HMCURV (W, K, N, IDX, U, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'THE CURVE AGAIN: ', MSG)
      CALL HMGETC (W, 1, 40, K, M, IWALL, V, IERR, MSG)
      DO 30 K = 1, N
         IF (IDX(K) .NE. IWALL(K)) M = 0
   30 CONTINUE
      CALL CHECK (IERR .EQ. 0 .AND. M .EQ. N, 'ITS POINTS: ', MSG)
      CALL CHECK (DIFFER(N, U, U, V, V) .LE. 0D0, 'ITS KNOTS', ' ')
      CALL HMCOND (W, 7, 0, 1, 1, IERR, MSG)
      CALL HMSOLV (W, X, Y, 1, RESID, IERR, MSG)
      CALL HMDISP (W, DP, EX, EY, 1, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'SOLVED AGAIN: ', MSG)
      CALL CHECK (DIFFER(NP, DX, DY, EX, EY) .LE. 0D0,
     &            'THE SAME FUNCTIONS', ' ')

C     A REFUSED HMFACT LEAVES THE FACTOR; A SECOND ONE NEEDS NO MORE WORDS
C     THAN THE FIRST.
      LOW = 20000
      HIGH = LW
   40 IF (HIGH - LOW .GT. 1) THEN
         M = (LOW + HIGH)/2
         CALL BEGIN (W, M, NP, NC, CELLS, NF, FACES, MARKS, X, Y, IERR)
         IF (IERR .EQ. 0) HIGH = M
         IF (IERR .NE. 0) LOW = M
         GO TO 40
      END IF
      DO 60 M = 1, 2
         IF (M .EQ. 2) HIGH = LW
         CALL BEGIN (W, HIGH, NP, NC, CELLS, NF, FACES, MARKS, X, Y,
     &               IERR)
         DO 50 K = 1, 3
            CALL HMFACT (W, X, Y, 1, RESID, IERR, MSG)
            CALL CHECK (IERR .EQ. 0, 'A FACTOR AGAIN: ', MSG)
   50    CONTINUE
   60 CONTINUE
      DO 70 K = 1, NA
         IWALL(K) = K
         WX(K) = 0.01D0*SIN(1.7D0*K)
         WY(K) = 0.01D0*COS(2.9D0*K)
   70 CONTINUE
      CALL HMGIVE (W, NA, IWALL, WX, WY, DX, DY, 1, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'GIVEN: ', MSG)
      HERE = X(100)
      X(100) = BAD
      CALL HMFACT (W, X, Y, 1, RESID, IERR, MSG)
      CALL CHECK (IERR .EQ. -3, 'A FACTOR OF NOTHING: ', MSG)
      X(100) = HERE
      CALL HMGIVE (W, NA, IWALL, WX, WY, EX, EY, 1, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'THE FACTOR IS THERE: ', MSG)
      CALL CHECK (DIFFER(NP, DX, DY, EX, EY) .LE. 0D0,
     &            'AND IS THE SAME', ' ')
      WX(5) = BAD
      CALL HMGIVE (W, NA, IWALL, WX, WY, EX, EY, 1, IERR, MSG)
      CALL CHECK (IERR .LT. 0, 'A WALL WITHOUT A NUMBER: ', MSG)
      EX(9) = BAD
      CALL HMGADJ (W, NA, IWALL, EX, EY, 1, HX, HY, IERR, MSG)
      CALL CHECK (IERR .LT. 0, 'ITS TRANSPOSE: ', MSG)

      CALL STRIP (W, LW)
      CALL RESULT
      END

C     INC MUST BE AT LEAST 1 IN EVERY CALL.
      SUBROUTINE STRIDE (W, NCP, NP, X, Y, EX, EY, DP, G, LIST)
      INTEGER NCP, NP, LIST(*), I, K, M, N, INC, IERR
      DOUBLE PRECISION W(*), X(NP), Y(NP), EX(NP), EY(NP), DP(2,NCP)
      DOUBLE PRECISION G(2,NCP), R, S, AXIS(6)
      CHARACTER*112 MSG
      DATA AXIS /6*0D0/
      CALL COPY (NP, X, Y, EX, EY)
      DO 20 INC = -2, 0, 2
         DO 10 I = 1, 18
            MSG = ' '
            IERR = 0
            K = 0
            IF (I .EQ. 1) CALL HMWALL (W, 7, X, Y, INC, 60, LIST, N, M,
     &                                 IERR, MSG)
            IF (I .EQ. 2) CALL HMFIT (W, 7, X, Y, INC, NCP, 3, 0, S,
     &                                IERR, MSG)
            IF (I .EQ. 3) CALL HMSOLV (W, X, Y, INC, S, IERR, MSG)
            IF (I .EQ. 4) CALL HMFACT (W, X, Y, INC, S, IERR, MSG)
            IF (I .EQ. 5) CALL HMMORF (W, DP, EX, EY, INC, IERR, MSG)
            IF (I .EQ. 6) CALL HMSAFE (W, DP, X, Y, EX, EY, INC, G, S,
     &                                 K, IERR, MSG)
            IF (I .EQ. 7) CALL HMRECO (W, X, Y, INC, G, S, IERR, MSG)
            IF (I .EQ. 8) CALL HMDISP (W, DP, EX, EY, INC, IERR, MSG)
            IF (I .EQ. 9) CALL HMADJ (W, X, Y, INC, G, IERR, MSG)
            IF (I .EQ. 10) CALL HMSLIP (W, X, Y, EX, EY, INC, IERR, MSG)
            IF (I .EQ. 11) CALL HMSTEP (W, X, Y, EX, EY, INC, S, K,
     &                                  IERR, MSG)
            IF (I .EQ. 12) CALL HMQUAL (W, X, Y, INC, M, N, R, S, IERR,
     &                                  MSG)
            IF (I .EQ. 13) CALL HMBOUN (W, 0, 0D0, X, Y, X, Y, INC, S,
     &                                  EX, EY, IERR, MSG)
            IF (I .EQ. 14) CALL HMGIVE (W, 1, LIST, X, Y, EX, EY, INC,
     &                                  IERR, MSG)
            IF (I .EQ. 15) CALL HMGADJ (W, 1, LIST, X, Y, INC, EX, EY,
     &                                  IERR, MSG)
            IF (I .EQ. 16) CALL HMBGET (W, 1, X, Y, 1, EX, EY, INC,
     &                                  IERR, MSG)
            IF (I .EQ. 17) CALL HMPLAN (W, NP, X, Y, Y, INC, 1, 4, LIST,
     &                                  1, LIST, LIST, 0, AXIS, N, IERR,
     &                                  MSG)
            IF (I .EQ. 18) CALL HMLOAD (W, 9, X, Y, INC, IERR, MSG)
            CALL CHECK (IERR .EQ. -2 .AND. INDEX(MSG, 'INC is') .EQ. 1,
     &                  'NO STRIDE: ', MSG)
   10    CONTINUE
   20 CONTINUE
      END

C     THE MESH WITH A MARKER OF GIVEN DISPLACEMENTS, IN L WORDS.
      SUBROUTINE BEGIN (W, L, NP, NC, CELLS, NF, FACES, MARKS, X, Y,
     &                  IERR)
      INTEGER L, NP, NC, NF, CELLS(4,NC), FACES(2,NF), MARKS(NF), IERR
      DOUBLE PRECISION W(L), X(NP), Y(NP), RESID
      CHARACTER*112 MSG
      CALL HMOPEN (W, L, IERR, MSG)
      IF (IERR .EQ. 0)
     &   CALL HMMESH (W, NP, NC, 4, CELLS, NF, FACES, MARKS, IERR, MSG)
      IF (IERR .EQ. 0) CALL HMCOND (W, 7, 6, 0, 0, IERR, MSG)
      IF (IERR .EQ. 0) CALL HMFACT (W, X, Y, 1, RESID, IERR, MSG)
      END

C     A STRIP ROUND NEARLY A WHOLE CIRCLE, WHICH GROWS UNTIL ITS ENDS
C     MEET: NO CELL INVERTS, BUT THE BOUNDARY CROSSES ITSELF.
      SUBROUTINE STRIP (W, LW)
      INTEGER LW, NI, NJ, NP
      PARAMETER (NI = 81, NJ = 4, NP = NI*NJ)
      DOUBLE PRECISION W(LW), X(NP), Y(NP), DX(NP), DY(NP), XN(NP)
      DOUBLE PRECISION YN(NP), A, R, S, T, DMAX, RESID, AMIN, QMIN
      INTEGER MB(4), I, J, K, IERR, ICELL, NINV, ICROSS
      CHARACTER*112 MSG
      DATA MB /1, 2, 3, 4/
      DO 20 J = 1, NJ
         DO 10 I = 1, NI
            K = I + NI*(J - 1)
            R = 1D0 + 0.05D0*(J - 1)
            A = 6.1D0*(I - 1)/(NI - 1)
            X(K) = R*COS(A)
            Y(K) = R*SIN(A)
            A = 6.5D0*(I - 1)/(NI - 1)
            DX(K) = R*COS(A) - X(K)
            DY(K) = R*SIN(A) - Y(K)
   10    CONTINUE
   20 CONTINUE
      CALL HMOPEN (W, LW, IERR, MSG)
      CALL HMBLOK (W, NI, NJ, MB, IERR, MSG)
      CALL HMFIT (W, 3, X, Y, 1, 20, 3, 1, DMAX, IERR, MSG)
      CALL HMCOND (W, 3, 0, 1, 1, IERR, MSG)
      CALL HMSOLV (W, X, Y, 1, RESID, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'A STRIP: ', MSG)
      CALL HMSTEP (W, X, Y, DX, DY, 1, S, ICELL, IERR, MSG)
      CALL CHECK (IERR .EQ. 0 .AND. S .GT. 0.3D0 .AND. S .LT. 0.7D0,
     &            'UNTIL THE ENDS MEET: ', MSG)
      CALL CHECK (ICELL .EQ. 0, 'NO CELL LIMITS THE STEP', ' ')
      DO 40 J = 0, 2
         T = S*(1D0 + 0.02D0*(J - 1))
         IF (J .EQ. 1) T = 1D0
         DO 30 K = 1, NP
            XN(K) = X(K) + T*DX(K)
            YN(K) = Y(K) + T*DY(K)
   30    CONTINUE
         CALL HMQUAL (W, XN, YN, 1, NINV, ICROSS, AMIN, QMIN, IERR, MSG)
         CALL CHECK (IERR .EQ. 0 .AND. NINV .EQ. 0, 'CELLS: ', MSG)
         IF (J .EQ. 0) CALL CHECK (ICROSS .EQ. 0, 'NO CROSSING', ' ')
         IF (J .GT. 0) CALL CHECK (ICROSS .GE. 1 .AND. ICROSS .LE. NP,
     &                             'A CROSSING', ' ')
   40 CONTINUE
C     NOTHING LIMITS A TRANSLATION.
      DO 50 K = 1, NP
         DX(K) = 1D0
         DY(K) = 0D0
   50 CONTINUE
      CALL HMSTEP (W, X, Y, DX, DY, 1, S, ICELL, IERR, MSG)
      CALL CHECK (S .GT. 1D30 .AND. ICELL .EQ. -1, 'NO LIMIT: ', MSG)
      END

      SUBROUTINE SHIFT (N, LIST, BY)
      INTEGER N, LIST(N), BY, K
      DO 10 K = 1, N
         LIST(K) = LIST(K) + BY
   10 CONTINUE
      END
