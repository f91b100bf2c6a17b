C     DESIGN BY THE LEGACY CALLS: FINER CURVES, MEASURES, BOUNDS OF THE
C     QUALITY, SMOOTH GRADIENTS, VARIABLES, COMBINED FUNCTIONS AND
C     FUNCTIONS BY TABLE.
      PROGRAM LEGDES
      INTEGER NA, NR, NP, NC, NF, LW, NCP, LA
      PARAMETER (NA = 48, NR = 16, NP = NA*NR, NC = NA*(NR - 1))
      PARAMETER (NF = 2*NA, LW = 1500000, NCP = 12, LA = 2000)
      DOUBLE PRECISION W, X, Y, DX, DY, EX, EY, GX, GY, XN, YN
      INTEGER CELLS, FACES, MARKS
      COMMON /WORK/ W(LW)
      COMMON /MESH/ X(NP), Y(NP), CELLS(4,NC), FACES(2,NF), MARKS(NF)
      COMMON /MOVED/ DX(NP), DY(NP), EX(NP), EY(NP), GX(NP), GY(NP),
     &               XN(NP), YN(NP)
      DOUBLE PRECISION A(LA), P(2,40), Q(2,40), DP(2,40), DV(2,40)
      DOUBLE PRECISION G(2,40), H(2,40), OUT(1), U(2), PAR(10), CHORD(4)
      DOUBLE PRECISION ERR(80), POLY(2,3), WX(NA), WY(NA), MODES(2*NA*2)
      DOUBLE PRECISION AREA, S, T, BIG, RESID, DMAX, DIFFER, BOUND(2)
      INTEGER IWALL(NA), N, M, NV, I, J, K, KIND, NINV, IERR, ICROSS
      CHARACTER*112 MSG
      CHARACTER*3 TEXT
      INTEGER NPASS, NFAIL
      COMMON /COUNTS/ NPASS, NFAIL
      DATA TEXT /'NaN'/
      DATA U /0.31D0, 0.72D0/
      DATA CHORD /-0.52D0, 0D0, 0.48D0, 0D0/
      DATA POLY /-0.1D0, 0D0, 0.1D0, 0.01D0, 0D0, -0.02D0/
      NPASS = 0
      NFAIL = 0
      DO 10 K = 1, 40
         DP(1,K) = 0D0
         DP(2,K) = 0D0
         DV(1,K) = 0D0
         DV(2,K) = 0D0
   10 CONTINUE
      CALL MAKE (NA, NR, X, Y, CELLS, FACES, MARKS)
      CALL HMOPEN (W, LW, IERR, MSG)
      CALL HMREFN (W, 1, 0, 2, U, LA, A, N, IERR, MSG)
      CALL CHECK (IERR .LT. 0, 'NO CURVE: ', MSG)
      CALL HMMESH (W, NP, NC, 4, CELLS, NF, FACES, MARKS, IERR, MSG)
      CALL HMOPT (W, 'OPERATOR', 1, IERR, MSG)
      CALL HMFIT (W, 7, X, Y, 1, NCP, 3, 2, DMAX, IERR, MSG)
      CALL HMCOND (W, 7, 0, 1, 1, IERR, MSG)
      CALL HMSOLV (W, X, Y, 1, RESID, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'A TIED CURVE: ', MSG)
      CALL HMGETP (W, 40, P, N, IERR, MSG)
      CALL HMMEAS (W, 0, 0D0, DP, AREA, G, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'AREA: ', MSG)

C     TWO KNOTS MORE, THEN A HIGHER DEGREE: NEW POINTS ARE A TIMES THE
C     OLD ONES, DERIVATIVES BY OLD POINTS THE TRANSPOSE OF A TIMES THOSE
C     BY NEW ONES, THE SHAPE IS THE SAME, AND SO ARE THE CONDITIONS.
      OUT(1) = -1D0
      CALL HMREFN (W, 1, 0, 1, OUT, LA, A, M, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'A KNOT OUTSIDE: ', MSG)
      CALL HMREFN (W, 2, 0, 2, U, LA, A, M, IERR, MSG)
      CALL CHECK (IERR .LT. 0, 'NO SUCH CURVE: ', MSG)
      CALL HMREFN (W, 1, 0, 2, U, N*(N + 2) - 1, A, M, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'NO ROOM FOR A: ', MSG)
      CALL CHECK (M .EQ. N + 2, 'NCP SAYS HOW MANY', ' ')
      CALL HMMEAS (W, 0, 0D0, DP, S, H, IERR, MSG)
      CALL CHECK (ABS(S - AREA) .LE. 0D0, 'REFUSED: NO CHANGE', ' ')
      DO 50 KIND = 1, 2
         IF (KIND .EQ. 1) CALL HMREFN (W, 1, 0, 2, U, LA, A, M, IERR,
     &                                 MSG)
         IF (KIND .EQ. 2) CALL HMREFN (W, 1, 4, 0, U, LA, A, M, IERR,
     &                                 MSG)
         CALL CHECK (IERR .EQ. 0, 'MORE CONTROL POINTS: ', MSG)
         CALL CHECK (M .GT. N, 'MORE THAN BEFORE', ' ')
         CALL HMDISP (W, DP, DX, DY, 1, IERR, MSG)
         CALL CHECK (IERR .EQ. -2, 'NO FUNCTIONS YET: ', MSG)
         CALL HMGETP (W, 40, Q, K, IERR, MSG)
         CALL CHECK (K .EQ. M, 'POINTS OF THE FINER CURVE', ' ')
         BIG = 0D0
         DO 30 I = 1, M
            S = 0D0
            T = 0D0
            DO 20 J = 1, N
               S = S + A(J + N*(I - 1))*P(1,J)
               T = T + A(J + N*(I - 1))*P(2,J)
   20       CONTINUE
            BIG = MAX(BIG, ABS(S - Q(1,I)), ABS(T - Q(2,I)))
   30    CONTINUE
         CALL CHECK (BIG .LT. 1D-15, 'A TIMES THE OLD POINTS', ' ')
         CALL HMSOLV (W, X, Y, 1, RESID, IERR, MSG)
         CALL CHECK (IERR .EQ. 0, 'THE CONDITION STAYS: ', MSG)
         CALL HMMEAS (W, 0, 0D0, DP, S, H, IERR, MSG)
         CALL CHECK (ABS(S - AREA) .LT. 1D-14, 'THE SAME SHAPE', ' ')
         BIG = 0D0
         DO 40 J = 1, N
            S = 0D0
            T = 0D0
            DO 35 I = 1, M
               S = S + A(J + N*(I - 1))*H(1,I)
               T = T + A(J + N*(I - 1))*H(2,I)
   35       CONTINUE
            BIG = MAX(BIG, ABS(S - G(1,J)), ABS(T - G(2,J)))
   40    CONTINUE
         CALL CHECK (BIG .LT. 1D-14, 'TRANSPOSE OF A', ' ')
         N = M
         CALL HMGETP (W, 40, P, N, IERR, MSG)
         CALL HMMEAS (W, 0, 0D0, DP, AREA, G, IERR, MSG)
   50 CONTINUE

C     THICKNESS AND CLEARANCE, DERIVATIVES AGAINST DIFFERENCES.
      CALL HMSECT (W, 1, 1, CHORD, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'A CHORD: ', MSG)
      DO 70 KIND = 1, 2
         IF (KIND .EQ. 1) CALL HMMEAS (W, 7, 0.4D0, DP, S, G, IERR, MSG)
         IF (KIND .EQ. 2) CALL HMCLEA (W, 3, POLY, DP, S, G, IERR, MSG)
         CALL CHECK (IERR .EQ. 0, 'MEASURED: ', MSG)
         CALL CHECK (S .GT. 0D0, 'ABOVE ZERO', ' ')
         BIG = 0D0
         DO 60 K = 1, N
            DO 55 I = 1, 2
               DP(I,K) = 1D-6
               IF (KIND .EQ. 1)
     &            CALL HMMEAS (W, 7, 0.4D0, DP, T, H, IERR, MSG)
               IF (KIND .EQ. 2)
     &            CALL HMCLEA (W, 3, POLY, DP, T, H, IERR, MSG)
               BIG = MAX(BIG, ABS((T - S)/1D-6 - G(I,K)))
               DP(I,K) = 0D0
   55       CONTINUE
   60    CONTINUE
         CALL CHECK (BIG .LT. 1D-4, 'DERIVATIVES', ' ')
   70 CONTINUE
      POLY(1,1) = -0.6D0
      CALL HMCLEA (W, 3, POLY, DP, S, G, IERR, MSG)
      CALL CHECK (S .LT. 0D0, 'A POLYGON THAT STANDS OUT: ', MSG)
      CALL HMCLEA (W, 0, POLY, DP, T, G, IERR, MSG)
      CALL CHECK (IERR .LT. 0, 'A POLYGON WITHOUT POINTS: ', MSG)

C     SMOOTH GRADIENTS: THE MATRIX IS SYMMETRIC AND POSITIVE DEFINITE.
      CALL HMMEAS (W, 0, 0D0, DP, S, G, IERR, MSG)
      CALL HMMEAS (W, 7, 0.4D0, DP, S, H, IERR, MSG)
      CALL HMSMTH (W, 0D0, G, Q, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'SMOOTH GRADIENTS: ', MSG)
      CALL CHECK (DIFFER(2*N, G, G, Q, Q) .LT. 1D-15,
     &            'A LENGTH OF 0 RETURNS THE GRADIENT', ' ')
      CALL HMSMTH (W, -1D0, G, Q, IERR, MSG)
      CALL CHECK (IERR .LT. 0, 'A LENGTH BELOW 0: ', MSG)
      CALL HMSMTH (W, 0.3D0, G, Q, IERR, MSG)
      CALL HMSMTH (W, 0.3D0, H, P, IERR, MSG)
      S = 0D0
      T = 0D0
      BIG = 0D0
      DO 72 K = 1, N
         S = S + G(1,K)*Q(1,K) + G(2,K)*Q(2,K)
         T = T + G(1,K)**2 + G(2,K)**2
         BIG = BIG + H(1,K)*Q(1,K) + H(2,K)*Q(2,K)
     &         - P(1,K)*G(1,K) - P(2,K)*G(2,K)
   72 CONTINUE
      CALL CHECK (S .GT. 0D0 .AND. S .LT. T, 'A DESCENT', ' ')
      CALL CHECK (ABS(BIG) .LT. 1D-14, 'SYMMETRIC', ' ')

C     BOUNDS OF THE QUALITY: DERIVATIVES AGAINST DIFFERENCES.
      DO 74 K = 1, N
         DP(1,K) = 1D-2*SIN(1D0*K)
         DP(2,K) = 1D-2*COS(2D0*K)
         DV(1,K) = COS(3D0*K)
         DV(2,K) = SIN(5D0*K)
   74 CONTINUE
      CALL HMDISP (W, DV, DX, DY, 1, IERR, MSG)
      CALL HMDISP (W, DP, EX, EY, 1, IERR, MSG)
      DO 79 KIND = 0, 5
         DO 76 I = 1, 2
            CALL ALONG (NP, X, Y, EX, EY, (2*I - 3)*1D-6, DX, DY, XN,
     &                  YN)
            CALL HMBOUN (W, KIND, 1D2, X, Y, XN, YN, 1, BOUND(I), GX,
     &                   GY, IERR, MSG)
   76    CONTINUE
         CALL ALONG (NP, X, Y, EX, EY, 0D0, DX, DY, XN, YN)
         CALL HMBOUN (W, KIND, 1D2, X, Y, XN, YN, 1, S, GX, GY, IERR,
     &                MSG)
         CALL CHECK (IERR .EQ. 0, 'A BOUND: ', MSG)
         CALL HMADJ (W, GX, GY, 1, H, IERR, MSG)
         T = 0D0
         DO 78 K = 1, N
            T = T + H(1,K)*DV(1,K) + H(2,K)*DV(2,K)
   78    CONTINUE
         CALL CHECK (ABS((BOUND(2) - BOUND(1))/2D-6 - T) .LT.
     &               1D-6*(1D0 + ABS(T)), 'DERIVATIVE', ' ')
         IF (KIND .NE. 0) GO TO 79
         CALL HMQUAL (W, XN, YN, 1, NINV, ICROSS, T, BIG, IERR, MSG)
         CALL CHECK (SQRT(0.5D0)*S .LE. BIG, 'BELOW QUALITIES', ' ')
   79 CONTINUE
      CALL HMBOUN (W, 6, 1D2, X, Y, XN, YN, 1, S, GX, GY, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'NO SUCH BOUND: ', MSG)
      DO 82 K = 1, N
         DV(2,K) = 0D0
   82 CONTINUE

C     ALL FOUR KINDS OF VARIABLES. COMBINED FUNCTIONS MOVE THE MESH AS
C     THE CONTROL POINTS DO THAT THE VARIABLES MOVE.
      DO 120 KIND = 0, 3
         CALL HMSOLV (W, X, Y, 1, RESID, IERR, MSG)
         DO 80 K = 1, 10
            PAR(K) = 0D0
            IF (KIND .EQ. 3) PAR(K) = 0.1D0 + 0.2D0*K
   80    CONTINUE
         I = 3
         J = 2
         IF (KIND .EQ. 3) J = 0
         CALL HMVARS (W, KIND, I, J, PAR, 10, A, NV, ERR, IERR, MSG)
         CALL CHECK (IERR .EQ. -2, 'NO ROOM FOR VARIABLES: ', MSG)
         CALL HMVARS (W, KIND, I, J, PAR, LA, A, NV, ERR, IERR, MSG)
         CALL CHECK (IERR .EQ. 0, 'VARIABLES: ', MSG)
         M = 5
         IF (KIND .EQ. 0) M = 12
         IF (KIND .EQ. 3) M = 4
         CALL CHECK (NV .EQ. M, 'THEIR NUMBER', ' ')
         BIG = 0D0
         DO 90 K = 1, 2*NV
            BIG = MAX(BIG, ERR(K))
   90    CONTINUE
         CALL CHECK (BIG .LT. 0.2D0, 'THE CURVE FOLLOWS THEM', ' ')
         DO 100 K = 1, N
            DP(1,K) = 0D0
            DP(2,K) = 0D0
            DO 95 J = 1, NV
               DV(1,J) = 1D-2*SIN(2D0*J)
               DP(1,K) = DP(1,K) + A(1 + 2*(J - 1 + NV*(K-1)))*DV(1,J)
               DP(2,K) = DP(2,K) + A(2 + 2*(J - 1 + NV*(K-1)))*DV(1,J)
   95       CONTINUE
  100    CONTINUE
         CALL HMDISP (W, DP, DX, DY, 1, IERR, MSG)
         CALL HMCOMB (W, NV, 2, A, IERR, MSG)
         CALL CHECK (IERR .EQ. 0, 'COMBINED: ', MSG)
         CALL HMDISP (W, DV, EX, EY, 1, IERR, MSG)
         CALL CHECK (DIFFER(NP, DX, DY, EX, EY) .LT. 1D-15,
     &               'THE SAME MOVEMENT', ' ')
  120 CONTINUE
C     PEAKS THAT ARE NEGATIVE OR NO NUMBERS ARE NOT THOSE BY DEFAULT.
      DO 125 KIND = 2, 3
         DO 122 K = 1, 10
            PAR(K) = 0D0
  122    CONTINUE
         CALL HMVARS (W, KIND, 1, 0, PAR, LA, A, NV, ERR, IERR, MSG)
         CALL CHECK (IERR .EQ. 0, 'PEAKS BY DEFAULT: ', MSG)
         PAR(4-KIND) = -0.3D0
         CALL HMVARS (W, KIND, 1, 0, PAR, LA, A, NV, ERR, IERR, MSG)
         CALL CHECK (IERR .EQ. -2, 'A NEGATIVE PEAK: ', MSG)
         READ (TEXT, *) PAR(4-KIND)
         CALL HMVARS (W, KIND, 1, 0, PAR, LA, A, NV, ERR, IERR, MSG)
         CALL CHECK (IERR .EQ. -2, 'A PEAK THAT IS NONE: ', MSG)
  125 CONTINUE
      CALL HMVARS (W, 4, 3, 2, PAR, LA, A, NV, ERR, IERR, MSG)
      CALL CHECK (IERR .LT. 0, 'NO SUCH KIND: ', MSG)
      DO 130 K = 1, 40
         A(K) = 0D0
  130 CONTINUE
      CALL HMCOMB (W, 1, 1, A, IERR, MSG)
      CALL CHECK (IERR .EQ. -5, 'A VARIABLE THAT IS ZERO: ', MSG)
      CALL HMDISP (W, DV, EX, EY, 1, IERR, MSG)
      CALL CHECK (DIFFER(NP, DX, DY, EX, EY) .LT. 1D-15,
     &            'THE FUNCTIONS STAY', ' ')

C     TWO MODES OF THE WALL: HMDISP BY AMPLITUDES IS HMGIVE.
      CALL HMTABL (W, 2, 1, NA, IWALL, MODES, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'NO FACTOR IS KEPT: ', MSG)
      CALL HMMESH (W, NP, NC, 4, CELLS, NF, FACES, MARKS, IERR, MSG)
      CALL HMCOND (W, 7, 6, 0, 0, IERR, MSG)
      CALL HMFACT (W, X, Y, 1, RESID, IERR, MSG)
      DO 140 K = 1, NA
         IWALL(K) = K
         MODES(K) = SIN(3D0*X(K))
         MODES(NA+K) = X(K)**2
         WX(K) = 0.02D0*MODES(K) - 0.01D0*MODES(NA+K)
         WY(K) = -0.03D0*MODES(K) + 0.05D0*MODES(NA+K)
  140 CONTINUE
      CALL HMTABL (W, 2, 1, NA - 1, IWALL, MODES, IERR, MSG)
      CALL CHECK (IERR .EQ. -5, 'A POINT IS MISSING: ', MSG)
      CALL HMTABL (W, 2, 3, NA, IWALL, MODES, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'THREE NUMBERS: ', MSG)
      CALL HMTABL (W, 2, 1, NA, IWALL, MODES, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'BY TABLE: ', MSG)
      DV(1,1) = 0.02D0
      DV(2,1) = -0.03D0
      DV(1,2) = -0.01D0
      DV(2,2) = 0.05D0
      CALL HMDISP (W, DV, DX, DY, 1, IERR, MSG)
      CALL HMGIVE (W, NA, IWALL, WX, WY, EX, EY, 1, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'THE FACTOR STAYS: ', MSG)
      CALL CHECK (DIFFER(NP, DX, DY, EX, EY) .LT. 1D-15,
     &            'AMPLITUDES', ' ')
      CALL HMADJ (W, EX, EY, 1, G, IERR, MSG)
      S = 0D0
      DO 150 K = 1, NP
         S = S + EX(K)*DX(K) + EY(K)*DY(K)
  150 CONTINUE
      DO 160 K = 1, 2
         S = S - G(1,K)*DV(1,K) - G(2,K)*DV(2,K)
  160 CONTINUE
      CALL CHECK (ABS(S) .LT. 1D-13, 'FORCES OF MODES', ' ')
      DO 170 K = 1, NA
         MODES(K) = 0D0
  170 CONTINUE
      CALL HMFACT (W, X, Y, 1, RESID, IERR, MSG)
      CALL HMTABL (W, 2, 1, NA, IWALL, MODES, IERR, MSG)
      CALL CHECK (IERR .EQ. -5, 'A MODE THAT IS ZERO: ', MSG)

C     A COMPLEX MODE, Z - (-.1, 0): (COS T - 1, SIN T) TURNS THE WALL.
      DO 180 K = 1, NA
         MODES(2*K-1) = X(K) + 0.1D0
         MODES(2*K) = Y(K)
  180 CONTINUE
      CALL HMTABL (W, 1, 2, NA, IWALL, MODES, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'A COMPLEX MODE: ', MSG)
      DV(1,1) = COS(0.1D0) - 1D0
      DV(2,1) = SIN(0.1D0)
      CALL HMDISP (W, DV, DX, DY, 1, IERR, MSG)
      BIG = 0D0
      DO 190 K = 1, NA
         BIG = MAX(BIG, ABS(X(K) + 0.1D0 + DX(K) -
     &             COS(0.1D0)*(X(K) + 0.1D0) + SIN(0.1D0)*Y(K)),
     &             ABS(Y(K) + DY(K) -
     &             SIN(0.1D0)*(X(K) + 0.1D0) - COS(0.1D0)*Y(K)))
  190 CONTINUE
      CALL CHECK (BIG .LT. 1D-15, 'IT TURNS', ' ')
      DO 200 K = 0, 1
         CALL AGAIN (W, LW, K, NA, NR, X, Y, XN, YN, CELLS, FACES,
     &               MARKS)
  200 CONTINUE
      CALL RESULT
      END

C     HMSOLV AFTER THE MESH HAS MOVED: THE CURVES ARE THOSE OF THE MOVED
C     WALL, AND A MOVEMENT MOVES THE WALL AS BY THE FIRST FUNCTIONS. THE
C     CURVE HAS SO FEW CONTROL POINTS THAT OFFSETS OF POINTS ARE LARGE.
C     BODY 1: THE OUTER BOUNDARY IS A RIGID BODY, WHICH ROTATES ABOUT THE
C     CENTRE THAT HAS MOVED WITH IT.
      SUBROUTINE AGAIN (W, LW, BODY, NA, NR, X, Y, XN, YN, CELLS, FACES,
     &                  MARKS)
      INTEGER LW, BODY, NA, NR, CELLS(4,*), FACES(2,*), MARKS(*)
      DOUBLE PRECISION W(LW), X(NA*NR), Y(NA*NR), XN(NA*NR), YN(NA*NR)
      DOUBLE PRECISION XW(100), YW(100), P(2,20), Q(2,20), D(2,20)
      DOUBLE PRECISION XF(100), YF(100)
      DOUBLE PRECISION B(2,20), G(2,20), DMAX, RESID, S, AREA, BIG
      DOUBLE PRECISION DIFFER
      INTEGER NP, NC, N, NF, STEP, I, K, L, IERR
      CHARACTER*112 MSG
      NP = NA*NR
      L = NP - NA + 1
      NC = NA*(NR - 1)
      NF = 2*NA
      CALL MAKE (NA, NR, X, Y, CELLS, FACES, MARKS)
      CALL HMOPEN (W, LW, IERR, MSG)
      CALL HMMESH (W, NP, NC, 4, CELLS, NF, FACES, MARKS, IERR, MSG)
      CALL HMOPT (W, 'OPERATOR', 1, IERR, MSG)
      CALL HMFIT (W, 7, X, Y, 1, 8, 3, 3, DMAX, IERR, MSG)
      CALL HMCOND (W, 7, 0, 1, 0, IERR, MSG)
      IF (BODY .EQ. 1) CALL HMRIGD (W, 9, 1, 0D0, 0D0, IERR, MSG)
      CALL HMSOLV (W, X, Y, 1, RESID, IERR, MSG)
      CALL CHECK (IERR .GE. 0, 'BEFORE THE SHIFT: ', MSG)
      CALL HMGETP (W, 20, P, N, IERR, MSG)
C     B SHIFTS ALL BY (0, 0.01), AND THEN BENDS THE CURVE.
      DO 60 STEP = 1, 2
         DO 10 K = 1, 20
            B(1,K) = 0D0
            B(2,K) = 0D0
            D(1,K) = 0D0
            D(2,K) = 0D0
   10    CONTINUE
         DO 20 K = 1, N
            B(2,K) = 0.01D0
            IF (STEP .EQ. 2) B(2,K) = 0.02D0*SIN(2D0*K)
            D(1,K) = 0.01D0*SIN(1.7D0*K)
            D(2,K) = 0.01D0*COS(2.9D0*K)
   20    CONTINUE
         IF (BODY .EQ. 1) THEN
            B(2,N+1) = 0.01D0
            D(1,N+2) = COS(0.05D0) - 1D0
            D(2,N+2) = SIN(0.05D0)
         END IF
         CALL HMMEAS (W, 0, 0D0, B, AREA, G, IERR, MSG)
         CALL HMMORF (W, B, X, Y, 1, IERR, MSG)
         CALL COPY (NP, X, Y, XN, YN)
         CALL HMMORF (W, D, XN, YN, 1, IERR, MSG)
         CALL COPY (NA, XN, YN, XW, YW)
         CALL COPY (NA, XN(L), YN(L), XF, YF)
         DO 50 I = 1, 3
            IF (I .NE. 2) CALL HMSOLV (W, X, Y, 1, RESID, IERR, MSG)
            IF (I .EQ. 2) CALL HMFACT (W, X, Y, 1, RESID, IERR, MSG)
            CALL CHECK (IERR .GE. 0, 'SOLVED AFTER A MOVEMENT: ', MSG)
            CALL COPY (NP, X, Y, XN, YN)
            CALL HMMORF (W, D, XN, YN, 1, IERR, MSG)
            CALL CHECK (DIFFER(NA, XN, YN, XW, YW) .LT. 1D-12,
     &                  'THE WALL FOLLOWS AS BEFORE', ' ')
            CALL CHECK (DIFFER(NA, XN(L), YN(L), XF, YF) .LT. 1D-12,
     &                  'THE OUTER BOUNDARY, TOO', ' ')
            CALL HMGETP (W, 20, Q, N, IERR, MSG)
            BIG = 0D0
            DO 30 K = 1, N
               BIG = MAX(BIG, ABS(Q(1,K) - P(1,K) - B(1,K)),
     &                   ABS(Q(2,K) - P(2,K) - B(2,K)))
   30       CONTINUE
            CALL CHECK (BIG .LT. 1D-12, 'CONTROL POINTS MOVED', ' ')
            CALL HMRECO (W, X, Y, 1, G, S, IERR, MSG)
            BIG = 0D0
            DO 40 K = 1, N
               BIG = MAX(BIG, ABS(G(1,K)), ABS(G(2,K)))
   40       CONTINUE
            CALL CHECK (IERR .EQ. 0 .AND. BIG .LT. 1D-12,
     &                  'NO MOVEMENT SINCE HMSOLV: ', MSG)
   50    CONTINUE
         D(1,N+2) = 0D0
         D(2,N+2) = 0D0
         CALL HMSAFE (W, D, X, Y, XN, YN, 1, G, S, K, IERR, MSG)
         BIG = DIFFER(NA, XN, YN, XW, YW)
         CALL CHECK (IERR .EQ. 0 .AND. BIG .LT. 1D-12 + 1D-5*BODY,
     &               'AND SAFELY: ', MSG)
         CALL HMMEAS (W, 0, 0D0, B(1,N+2), S, G, IERR, MSG)
         CALL CHECK (ABS(S - AREA) .LT. 1D-12, 'THE AREA MOVED', ' ')
         DO 55 K = 1, N
            P(1,K) = Q(1,K)
            P(2,K) = Q(2,K)
   55    CONTINUE
   60 CONTINUE
C     A WALL ON NO CURVE OF THE FUNCTIONS IS PROJECTED ONTO THE CURVE.
      DO 70 K = 1, NA
         X(K) = X(K) + 1D-3*COS(40D0*X(K) + 60D0*Y(K))
   70 CONTINUE
      CALL HMRECO (W, X, Y, 1, G, S, IERR, MSG)
      CALL CHECK (IERR .LT. 0, 'A WALL ON NO CURVE: ', MSG)
      CALL HMSOLV (W, X, Y, 1, RESID, IERR, MSG)
      CALL CHECK (IERR .GE. 0, 'IS PROJECTED: ', MSG)
      CALL HMGETP (W, 20, Q, N, IERR, MSG)
      CALL CHECK (DIFFER(2*N, P, P, Q, Q) .LE. 0D0,
     &            'ONTO THE SAME CURVE', ' ')
C     A BODY OF THE NUMBER 0 AFTER HMSOLV IS REFUSED.
      CALL HMRIGD (W, 9, 0, 0D0, 0D0, IERR, MSG)
      IF (IERR .EQ. 0) CALL HMSOLV (W, X, Y, 1, RESID, IERR, MSG)
      CALL CHECK (IERR .LT. 0, 'BODY 0: ', MSG)
      END

C     POINTS AFTER THE DISPLACEMENT E + S*D.
      SUBROUTINE ALONG (NP, X, Y, EX, EY, S, DX, DY, XN, YN)
      INTEGER NP, K
      DOUBLE PRECISION X(NP), Y(NP), EX(NP), EY(NP), S, DX(NP), DY(NP)
      DOUBLE PRECISION XN(NP), YN(NP)
      DO 10 K = 1, NP
         XN(K) = X(K) + EX(K) + S*DX(K)
         YN(K) = Y(K) + EY(K) + S*DY(K)
   10 CONTINUE
      END
