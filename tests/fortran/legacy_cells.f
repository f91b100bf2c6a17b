C     MESHES OF THE LEGACY CALLS: TRIANGLES AND QUADRILATERALS APART,
C     POLYGONS, BLOCKS, ONE CELL THICK. ALL MOVE AS THE SAME MESH DOES
C     AS A LIST OF CELLS.
      PROGRAM LEGCEL
      INTEGER NA, NR, NP, NC, NF, LW, NCP, NS, NB
      PARAMETER (NA = 48, NR = 16, NP = NA*NR, NC = NA*(NR - 1))
      PARAMETER (NF = 2*NA, LW = 1500000, NCP = 12, NS = 2*NP)
      PARAMETER (NB = (NA/2 + 1)*NR)
      DOUBLE PRECISION W, X, Y, DX, DY, EX, EY
      INTEGER CELLS, FACES, MARKS
      COMMON /WORK/ W(LW)
      COMMON /MESH/ X(NP), Y(NP), CELLS(4,NC), FACES(2,NF), MARKS(NF)
      COMMON /MOVED/ DX(NS), DY(NS), EX(NS), EY(NS)
      DOUBLE PRECISION XB, YB, X3, Y3, Z3, GX, GY, GZ
      COMMON /OTHER/ XB(2*NB), YB(2*NB), X3(NS), Y3(NS), Z3(NS),
     &               GX(NS), GY(NS), GZ(NS)
      INTEGER ITRI, IQUAD, MIXED, ISTART, IPTS, ITYPE, SIDES, IFOL
      COMMON /LISTS/ ITRI(3,2*NC), IQUAD(4,NC), MIXED(4,2*NC),
     &               ISTART(NC+1), IPTS(4*NC), ITYPE(NP), SIDES(4,NF),
     &               IFOL(NS)
      DOUBLE PRECISION DP(2,NCP), G(2,NCP), AXIS(6), HERE, THERE, BIG
      DOUBLE PRECISION DIFFER, XG(0:NA/2+2,0:NR+1), YG(0:NA/2+2,0:NR+1)
      INTEGER NIJ(2,2), MB(4,2), N, M, I, J, K, L, IERR, ICROSS
      CHARACTER*112 MSG
      INTEGER NPASS, NFAIL
      COMMON /COUNTS/ NPASS, NFAIL
      DATA AXIS /6*0D0/
      NPASS = 0
      NFAIL = 0

      CALL MAKE (NA, NR, X, Y, CELLS, FACES, MARKS)
      DO 10 K = 1, NCP
         DP(1,K) = 0.01D0*SIN(1.7D0*K)
         DP(2,K) = 0.01D0*COS(2.9D0*K)
   10 CONTINUE
      CALL HMOPEN (W, LW, IERR, MSG)
      CALL HMPFOL (W, NS, IFOL, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'NO PLANE: ', MSG)

C     THE QUADS OF THE FIRST RINGS CUT IN TWO: TRIANGLES AND QUADS.
      N = 0
      M = 0
      DO 20 K = 1, NC
         IF (K .LE. NC/2) THEN
            DO 15 I = 1, 3
               ITRI(I,N+1) = CELLS(I,K)
               ITRI(I,N+2) = CELLS(MOD(I + 1, 4) + 1,K)
   15       CONTINUE
            N = N + 2
         ELSE
            M = M + 1
            DO 17 I = 1, 4
               IQUAD(I,M) = CELLS(I,K)
   17       CONTINUE
         END IF
   20 CONTINUE
      DO 30 K = 1, N + M
         DO 25 I = 1, 4
            IF (K .LE. N) MIXED(I,K) = ITRI(MIN(I, 3),K)
            IF (K .GT. N) MIXED(I,K) = IQUAD(I,K - N)
   25    CONTINUE
   30 CONTINUE
      CALL HMMESH (W, NP, N + M, 4, MIXED, NF, FACES, MARKS, IERR, MSG)
      CALL SOLVED (W, X, Y, NCP, IERR, MSG)
      CALL HMDISP (W, DP, DX, DY, 1, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'TRIANGLES AMONG QUADS: ', MSG)
      CALL HMMIXD (W, NP, N, ITRI, -1, IQUAD, NF, FACES, MARKS, IERR,
     &             MSG)
      CALL CHECK (IERR .EQ. -2, 'QUADS BELOW ZERO: ', MSG)
      CALL HMDISP (W, DP, EX, EY, 1, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'REFUSED, THE MESH STAYS: ', MSG)
      CALL HMMIXD (W, NP, N, ITRI, M, IQUAD, NF, FACES, MARKS, IERR,
     &             MSG)
      CALL SOLVED (W, X, Y, NCP, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'TWO ARRAYS: ', MSG)
      CALL HMDISP (W, DP, EX, EY, 1, IERR, MSG)
      CALL CHECK (DIFFER(NP, DX, DY, EX, EY) .LE. 0D0,
     &            'TWO ARRAYS: THE SAME FUNCTIONS', ' ')
      DO 40 K = 1, NP
         ITYPE(K) = 0
         IF (K .LE. NA) ITYPE(K) = 7
         IF (K .GT. NP - NA) ITYPE(K) = 9
   40 CONTINUE
      CALL HMMIXD (W, NP, N, ITRI, M, IQUAD, 0, FACES, MARKS, IERR, MSG)
      CALL HMTYPE (W, ITYPE, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'TWO ARRAYS, TYPES: ', MSG)
      CALL SOLVED (W, X, Y, NCP, IERR, MSG)
      CALL HMDISP (W, DP, EX, EY, 1, IERR, MSG)
      CALL CHECK (DIFFER(NP, DX, DY, EX, EY) .LE. 0D0,
     &            'TYPES: THE SAME FUNCTIONS', ' ')

C     POLYGONS: PAIRS OF QUADS OF THE OUTER RINGS ARE CELLS OF SIX
C     POINTS.
      CALL HMMESH (W, NP, NC, 4, CELLS, NF, FACES, MARKS, IERR, MSG)
      CALL SOLVED (W, X, Y, NCP, IERR, MSG)
      CALL HMDISP (W, DP, DX, DY, 1, IERR, MSG)
      N = 0
      L = 0
      ISTART(1) = 1
      DO 60 K = 1, NC
         J = (K - 1)/NA
         IF (J .GE. NR/2 .AND. MOD(K, 2) .EQ. 0) GO TO 60
         N = N + 1
         IPTS(L+1) = CELLS(1,K)
         IPTS(L+2) = CELLS(2,K)
         IF (J .LT. NR/2) THEN
            IPTS(L+3) = CELLS(3,K)
            IPTS(L+4) = CELLS(4,K)
            L = L + 4
         ELSE
            IPTS(L+3) = CELLS(3,K)
            IPTS(L+4) = CELLS(3,MIN(K+1, NC))
            IPTS(L+5) = CELLS(4,MIN(K+1, NC))
            IPTS(L+6) = CELLS(4,K)
            L = L + 6
         END IF
         ISTART(N+1) = L + 1
   60 CONTINUE
      CALL HMPOLY (W, NP, N, ISTART, IPTS, NF, FACES, MARKS, IERR, MSG)
      CALL SOLVED (W, X, Y, NCP, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'POLYGONS: ', MSG)
      CALL HMDISP (W, DP, EX, EY, 1, IERR, MSG)
      BIG = DIFFER(NP, DX, DY, EX, EY)
      CALL CHECK (BIG .GT. 0D0, 'POLYGONS: NOT QUADS', ' ')
      CALL CHECK (BIG .LT. 2D-3, 'POLYGONS: NEARLY QUADS', ' ')
      CALL CHECK (DIFFER(NA, DX, DY, EX, EY) .LE. 1D-16,
     &            'POLYGONS: THE SAME WALL', ' ')
      CALL HMQUAL (W, X, Y, 1, M, ICROSS, HERE, THERE, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'POLYGONS: VALID', MSG)
      CALL CHECK (M .EQ. 0,
     &            'POLYGONS: VALID', ' ')
      CALL HMPOLY (W, NP, N, ISTART, IPTS, 0, FACES, MARKS, IERR, MSG)
      CALL HMTYPE (W, ITYPE, IERR, MSG)
      CALL SOLVED (W, X, Y, NCP, IERR, MSG)
      CALL HMDISP (W, DP, GX, GY, 1, IERR, MSG)
      CALL CHECK (DIFFER(NP, EX, EY, GX, GY) .LE. 0D0,
     &            'POLYGONS, TYPES: THE SAME FUNCTIONS', ' ')
      ISTART(3) = ISTART(2) + 2
      CALL HMPOLY (W, NP, N, ISTART, IPTS, 0, FACES, MARKS, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'A CELL OF TWO POINTS: ', MSG)

C     TWO BLOCKS, ONE AFTER THE OTHER: LEFT AND RIGHT HALF OF THE RINGS.
      M = NA/2 + 1
      DO 80 J = 1, NR
         DO 70 I = 1, M
            K = I + M*(J - 1)
            L = I + NA*(J - 1)
            XB(K) = X(L)
            YB(K) = Y(L)
            L = MOD(I + M - 2, NA) + 1 + NA*(J - 1)
            XB(NB+K) = X(L)
            YB(NB+K) = Y(L)
   70    CONTINUE
   80 CONTINUE
      DO 90 K = 1, 2
         NIJ(1,K) = M
         NIJ(2,K) = NR
         MB(1,K) = 0
         MB(2,K) = 0
         MB(3,K) = 7
         MB(4,K) = 9
   90 CONTINUE
      CALL HMBLKS (W, 0, NIJ, MB, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'NO BLOCKS: ', MSG)
      CALL HMBLKS (W, 2, NIJ, MB, IERR, MSG)
      CALL SOLVED (W, XB, YB, NCP, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'BLOCKS: ', MSG)
      CALL HMDISP (W, DP, EX, EY, 1, IERR, MSG)
      DO 110 J = 1, NR
         DO 100 I = 1, M
            K = I + M*(J - 1)
            L = I + NA*(J - 1)
            GX(K) = DX(L)
            GY(K) = DY(L)
            L = MOD(I + M - 2, NA) + 1 + NA*(J - 1)
            GX(NB+K) = DX(L)
            GY(NB+K) = DY(L)
  100    CONTINUE
  110 CONTINUE
      CALL CHECK (DIFFER(2*NB, EX, EY, GX, GY) .LT. 1D-12,
     &            'BLOCKS: THE SAME FUNCTIONS', ' ')
      CALL HMTYPE (W, ITYPE, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'TYPES OF BLOCKS: ', MSG)

C     BLOCKS IN ARRAYS OF THEIR OWN, WITH A LAYER OF GHOST POINTS.
      DO 114 J = 0, NR + 1
         DO 112 I = 0, M + 1
            XG(I,J) = 7D0
            YG(I,J) = 8D0
  112    CONTINUE
  114 CONTINUE
      CALL HMBPUT (W, 2, EX, EY, 1, XG(1,1), YG(1,1), M + 2, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'OUT OF A BLOCK: ', MSG)
      BIG = 0D0
      HERE = 0D0
      DO 118 J = 0, NR + 1
         DO 116 I = 0, M + 1
            IF (I .GE. 1 .AND. I .LE. M .AND. J .GE. 1 .AND. J .LE. NR)
     &      THEN
               K = NB + I + M*(J - 1)
               BIG = MAX(BIG, ABS(XG(I,J) - EX(K)),
     &                   ABS(YG(I,J) - EY(K)))
            ELSE
               HERE = MAX(HERE, ABS(XG(I,J) - 7D0), ABS(YG(I,J) - 8D0))
            END IF
  116    CONTINUE
  118 CONTINUE
      CALL CHECK (BIG .LE. 0D0, 'ITS NUMBERS', ' ')
      CALL CHECK (HERE .LE. 0D0, 'GHOST POINTS STAY', ' ')
      DO 119 K = 1, 2*NB
         GX(K) = EX(K)
         GY(K) = EY(K)
         IF (K .GT. NB) GX(K) = 0D0
         IF (K .GT. NB) GY(K) = 0D0
  119 CONTINUE
      CALL HMBGET (W, 2, XG(1,1), YG(1,1), M + 2, GX, GY, 1, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'INTO A BLOCK: ', MSG)
      CALL CHECK (DIFFER(2*NB, EX, EY, GX, GY) .LE. 0D0,
     &            'THE OTHER BLOCK STAYS', ' ')
      CALL HMBGET (W, 3, XG(1,1), YG(1,1), M + 2, GX, GY, 1, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'NO SUCH BLOCK: ', MSG)
      CALL HMBPUT (W, 1, EX, EY, 1, XG(1,1), YG(1,1), M - 1, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'ROWS THAT OVERLAP: ', MSG)
      NIJ(1,2) = 1
      CALL HMBLKS (W, 2, NIJ, MB, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'A BLOCK OF ONE LINE: ', MSG)

C     ONE CELL THICK, IN THE PLANE X-Z: TWO LAYERS OF POINTS.
      DO 120 K = 1, NP
         X3(K) = X(K)
         Z3(K) = Y(K)
         Y3(K) = 0D0
         X3(NP+K) = X(K)
         Z3(NP+K) = Y(K)
         Y3(NP+K) = 0.25D0
  120 CONTINUE
      DO 130 K = 1, NF
         SIDES(1,K) = FACES(1,K)
         SIDES(2,K) = FACES(2,K)
         SIDES(3,K) = FACES(2,K) + NP
         SIDES(4,K) = FACES(1,K) + NP
  130 CONTINUE
      CALL HMPLAN (W, NS, X3, Y3, Z3, 1, NC, 5, CELLS, NF, SIDES, MARKS,
     &             0, AXIS, N, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'FACES OF FIVE POINTS: ', MSG)
      X3(NP+7) = X3(NP+7) + 0.01D0
      CALL HMPLAN (W, NS, X3, Y3, Z3, 1, NC, 4, CELLS, NF, SIDES, MARKS,
     &             0, AXIS, N, IERR, MSG)
      CALL CHECK (IERR .EQ. -3, 'THREE DIMENSIONS IN EARNEST: ', MSG)
      X3(NP+7) = X(7)
      CALL HMPLAN (W, NS, X3, Y3, Z3, 1, NC, 4, CELLS, NF, SIDES, MARKS,
     &             0, AXIS, N, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'ONE CELL THICK: ', MSG)
      CALL CHECK (N .EQ. NP,
     &            'ONE CELL THICK: ', ' ')
      CALL HMTYPE (W, ITYPE, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'TYPES OF A PLANE: ', MSG)
      CALL HMPMRF (W, DP, X3, Y3, Z3, 1, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'A PLANE THAT IS NOT SOLVED: ', MSG)
      CALL SOLVED (W, X3, Y3, NCP, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'A PLANE: ', MSG)
      CALL HMPFOL (W, NP, IFOL, IERR, MSG)
      CALL CHECK (IERR .EQ. -2, 'NO ROOM: ', MSG)
      CALL HMPFOL (W, NS, IFOL, IERR, MSG)
      M = 0
      DO 140 K = 1, NP
         IF (IFOL(K) .EQ. K .AND. IFOL(NP+K) .EQ. K) M = M + 1
  140 CONTINUE
      CALL CHECK (M .EQ. NP, 'WHO FOLLOWS WHOM: ', MSG)
      DO 150 K = 1, NS
         EX(K) = X3(K)
         EY(K) = Z3(K)
         GX(K) = SIN(1D0*K)
         GY(K) = 5D0
         GZ(K) = COS(3D0*K)
  150 CONTINUE
      CALL HMPMRF (W, DP, EX, Y3, EY, -1, IERR, MSG)
      CALL CHECK (INDEX(MSG, 'INC is -1') .EQ. 1, 'NO STRIDE: ', MSG)
      CALL HMPMRF (W, DP, EX, Y3, EY, 1, IERR, MSG)
      HERE = 0D0
      M = 0
      DO 160 K = 1, NP
         IF (ABS(EX(K) - (X(K) + DX(K))) + ABS(EY(K) - (Y(K) + DY(K)))
     &       .LE. 1D-14) M = M + 1
         IF (ABS(EX(NP+K) - EX(K)) + ABS(EY(NP+K) - EY(K)) .LE. 0D0)
     &       M = M + 1
         HERE = HERE + DX(K)*(GX(K) + GX(NP+K))
     &               + DY(K)*(GZ(K) + GZ(NP+K))
  160 CONTINUE
      CALL CHECK (IERR .EQ. 0, 'BOTH LAYERS: ', MSG)
      CALL CHECK (M .EQ. NS,
     &            'BOTH LAYERS: ', ' ')
      CALL HMPADJ (W, GX, GY, GZ, 1, G, IERR, MSG)
      THERE = 0D0
      DO 170 K = 1, NCP
         THERE = THERE + G(1,K)*DP(1,K) + G(2,K)*DP(2,K)
  170 CONTINUE
      CALL CHECK (IERR .EQ. 0, 'THE LAYERS ARE SUMMED: ', MSG)
      CALL CHECK (ABS(HERE - THERE) .LT. 1D-12,
     &            'THE LAYERS ARE SUMMED: ', ' ')
      CALL HMPSPR (W, DX, DY, X3, Y3, Z3, 1, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'DISPLACEMENTS OF THE PLANE: ', MSG)
      CALL CHECK (DIFFER(NS, X3, Z3, EX, EY) .LT. 1D-14,
     &            'DISPLACEMENTS OF THE PLANE: ', ' ')
      CALL HMPGAT (W, GX, GY, GZ, 1, EX, EY, IERR, MSG)
      BIG = 0D0
      DO 180 K = 1, NP
         BIG = MAX(BIG, ABS(EX(K) - GX(K) - GX(NP+K)),
     &             ABS(EY(K) - GZ(K) - GZ(NP+K)))
  180 CONTINUE
      CALL CHECK (IERR .EQ. 0, 'SUMS: ', MSG)
      CALL CHECK (BIG .LT. 1D-15,
     &            'SUMS: ', ' ')

C     THE SAME OF TRIANGLES.
      DO 190 K = 1, NC
         DO 185 I = 1, 3
            ITRI(I,2*K-1) = CELLS(I,K)
            ITRI(I,2*K) = CELLS(MOD(I + 1, 4) + 1,K)
  185    CONTINUE
  190 CONTINUE
      CALL HMPLAN (W, NS, X3, Y3, Z3, 1, 2*NC, 3, ITRI, NF, SIDES,
     &             MARKS, 0, AXIS, N, IERR, MSG)
      CALL SOLVED (W, X3, Y3, NCP, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'A PLANE OF TRIANGLES: ', MSG)

C     A WEDGE: THE LAYERS MEET AT THE X AXIS AT AN ANGLE OF 5 DEGREES.
      DO 200 K = 1, NP
         BIG = 50D0 + Y(K)
         X3(K) = X(K)
         Y3(K) = BIG
         Z3(K) = 0D0
         X3(NP+K) = X(K)
         Y3(NP+K) = BIG*COS(0.08726646259971647D0)
         Z3(NP+K) = BIG*SIN(0.08726646259971647D0)
  200 CONTINUE
      CALL HMPLAN (W, NS, X3, Y3, Z3, 1, NC, 4, CELLS, NF, SIDES, MARKS,
     &             0, AXIS, N, IERR, MSG)
      CALL SOLVED (W, X3, Y3, NCP, IERR, MSG)
      CALL CHECK (IERR .EQ. 0, 'A WEDGE: ', MSG)
      CALL CHECK (N .EQ. NP,
     &            'A WEDGE: ', ' ')
      CALL HMPMRF (W, DP, X3, Y3, Z3, 1, IERR, MSG)
      BIG = 0D0
      DO 210 K = 1, NP
         BIG = MAX(BIG, ABS(SQRT(Y3(NP+K)**2 + Z3(NP+K)**2) - Y3(K)),
     &             ABS(X3(NP+K) - X3(K)), ABS(Y3(K) - 50D0 - Y(K)
     &             - DY(K)))
  210 CONTINUE
      CALL CHECK (IERR .EQ. 0, 'A WEDGE MOVES ALONG ITS RADII: ', MSG)
      CALL CHECK (BIG .LT. 1D-10,
     &            'A WEDGE MOVES ALONG ITS RADII: ', ' ')
      CALL RESULT
      END

C     A FIT OF MARKER 7, AND LAPLACE'S FUNCTIONS.
      SUBROUTINE SOLVED (W, X, Y, NCP, IERR, MSG)
      DOUBLE PRECISION W(*), X(*), Y(*), DMAX, RESID
      INTEGER NCP, IERR
      CHARACTER*(*) MSG
      CALL HMOPT (W, 'OPERATOR', 1, IERR, MSG)
      IF (IERR .GE. 0)
     &   CALL HMFIT (W, 7, X, Y, 1, NCP, 3, 3, DMAX, IERR, MSG)
      IF (IERR .GE. 0) CALL HMCOND (W, 7, 0, 1, 1, IERR, MSG)
      IF (IERR .GE. 0) CALL HMSOLV (W, X, Y, 1, RESID, IERR, MSG)
      END
