C     WHAT THE TESTS OF THE LEGACY CALLS SHARE: ASSERTIONS AND MESHES.
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

      SUBROUTINE RESULT
      INTEGER NPASS, NFAIL
      COMMON /COUNTS/ NPASS, NFAIL
      WRITE (*, '(I0, A, I0, A)') NPASS, ' passed, ', NFAIL, ' failed'
      IF (NFAIL .GT. 0) STOP 1
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

      DOUBLE PRECISION FUNCTION DIFFER (N, AX, AY, BX, BY)
      INTEGER N, K
      DOUBLE PRECISION AX(N), AY(N), BX(N), BY(N)
      DIFFER = 0D0
      DO 10 K = 1, N
         DIFFER = MAX(DIFFER, ABS(AX(K) - BX(K)), ABS(AY(K) - BY(K)))
   10 CONTINUE
      END
