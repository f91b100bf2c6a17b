/* What the tests count, and the tests. */
#ifndef TESTS_PETSC_CHECK_H
#define TESTS_PETSC_CHECK_H

#include "cases.h"

enum { ITERATIVE, FACTORED, N_SOLVERS };

extern int rank, size, verbose;
void check(int holds, const char* what, const char* where);

/* PETSc's options for a solver. */
void use_solver(int solver);
/* Parts, solver: functions, morph, adjoint, assessment are those of the direct engine. After
 * solve_whole. */
void check_agreement(const reference* serial, int kind, int solver);
/* Displacements, modes and combined functions; the wall's condition becomes HM_GIVEN. Solves by
 * itself. */
void check_given(reference* serial, int kind, int solver);
void check_combined(const reference* serial, int kind, int solver);
/* Parts that do not fit together, and arguments that are wrong on one process alone: refused by
 * all, none waits. */
void check_parts_that_do_not_fit(void);
void check_arguments(void);

#endif
