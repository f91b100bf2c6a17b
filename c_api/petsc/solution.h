/* Several right-hand sides: PETSc solves, and residuals of the core refine the solutions. */
#ifndef HARMORPH_PETSC_SOLUTION_H
#define HARMORPH_PETSC_SOLUTION_H

#include "private.h"
#include "matrix.h"

/* BoomerAMG relaxes forwards towards coarser levels and backwards towards finer levels: a cycle is
 * then symmetric, as CG needs it, for half the work of the default of PETSc, which relaxes in both
 * directions each time. Only options of PETSc can choose this: they are set for this solver unless
 * the user has chosen, and removed again. */
enum { RELAXATIONS = 2 };
static const char* const relaxation[RELAXATIONS][2] = {
    {"-hm_pc_hypre_boomeramg_relax_type_down", "l1-Gauss-Seidel"},
    {"-hm_pc_hypre_boomeramg_relax_type_up", "backward-l1-Gauss-Seidel"}};

static PetscErrorCode set_options(KSP solver) {
    PetscBool has_all = PETSC_FALSE, has[RELAXATIONS];
    int k;
    TRY(PetscOptionsHasName(NULL, NULL, "-hm_pc_hypre_boomeramg_relax_type_all", &has_all));
    for (k = 0; k < RELAXATIONS; ++k) {
        TRY(PetscOptionsHasName(NULL, NULL, relaxation[k][0], &has[k]));
        has[k] = has[k] || has_all ? PETSC_TRUE : PETSC_FALSE;
        if (!has[k]) TRY(PetscOptionsSetValue(NULL, relaxation[k][0], relaxation[k][1]));
    }
    TRY(KSPSetFromOptions(solver));
    for (k = 0; k < RELAXATIONS; ++k) {
        if (!has[k]) TRY(PetscOptionsClearValue(NULL, relaxation[k][0]));
    }
    return 0;
}

static PetscErrorCode make_solver(hm_petsc* system) {
    PC pc;
    TRY(KSPCreate(system->comm, &system->solver));
    TRY(KSPSetOptionsPrefix(system->solver, "hm_"));
    TRY(KSPSetOperators(system->solver, system->matrix, system->matrix));
    TRY(KSPSetType(system->solver, KSPCG));
    TRY(KSPSetTolerances(system->solver, 1e-6, PETSC_DEFAULT, PETSC_DEFAULT, 1000));
    TRY(KSPGetPC(system->solver, &pc));
#ifdef PETSC_HAVE_HYPRE
    TRY(PCSetType(pc, PCHYPRE));
    TRY(PCHYPRESetType(pc, "boomeramg"));
#else
    TRY(PCSetType(pc, PCGAMG));
#endif
    return set_options(system->solver);
}

/* The columns and the place of their values: functions, or one field of displacements. */
typedef struct columns {
    hm_petsc* system;
    int32_t n;
    hm_basis* rows;                     /* for functions; NULL: a field */
    double *work, *numbers, *residuals; /* for a field, see hm_private_field_init */
    double* column;                     /* [unknowns * info.numbers] */
} columns;

static size_t length_of_column(const hm_petsc* system) {
    return (size_t)system->info.unknowns * (size_t)system->info.numbers;
}

/* Puts the right-hand side of this part into wanted->column. */
static hm_status get_column(const columns* wanted, int32_t column, hm_error* err) {
    const size_t length = length_of_column(wanted->system);
    if (wanted->rows != NULL)
        return hm_private_rows_get(wanted->system->equations, wanted->rows, column, wanted->column,
                                   err);
    memcpy(wanted->column, wanted->numbers + (size_t)column * length,
           length * sizeof *wanted->column);
    return HM_OK;
}

/* wanted->column contains values of the unknowns, and receives the residual of this part. */
static hm_status set_column(const columns* wanted, int32_t column, hm_error* err) {
    hm_petsc* const system = wanted->system;
    const size_t length = length_of_column(system);
    hm_status status;
    if (wanted->rows != NULL) {
        status = hm_private_rows_set(system->equations, wanted->rows, column, wanted->column, err);
        return status < 0 ? status
                          : hm_private_rows_residual(system->equations, wanted->rows, column,
                                                     wanted->column, err);
    }
    memcpy(wanted->numbers + (size_t)column * length, wanted->column,
           length * sizeof *wanted->column);
    status = hm_private_field_residual(system->equations, wanted->work, wanted->numbers,
                                       wanted->residuals, err);
    memcpy(wanted->column, wanted->residuals + (size_t)column * length,
           length * sizeof *wanted->column);
    return status;
}

typedef struct progress { /* the progress of one column */
    double change, ratio, error;
    int solutions;
    PetscInt iterations;
    int done;
} progress;

enum { MOST_SOLUTIONS = 8, MOST_AT_ONCE = 16 };

/* Estimates the remaining error from the last correction and the ratio of the last corrections. */
static void judge(progress* column, double change, double tolerance) {
    const double ratio = column->change > 0 ? change / column->change : 1;
    if (column->solutions > 1 && ratio > column->ratio) column->ratio = ratio;
    column->error = column->solutions > 1 && column->ratio < 0.5 ? column->ratio * change : change;
    column->done = column->error <= tolerance || change == 0 ||
                   (column->solutions > 2 && ratio > 0.5) || column->solutions == MOST_SOLUTIONS;
    column->change = change;
}

typedef struct solution { /* a block of columns */
    Mat b, dx, x;         /* dense, `width` columns */
    PetscInt width;
    int32_t first, n;
    int direct; /* 1: all columns are solved at once */
    progress at[MOST_AT_ONCE];
    int is_indefinite; /* PETSc could not factor or solve, as it says on all processes */
    hm_status status;
} solution;

static PetscErrorCode solve_at_once(const hm_petsc* system, solution* now) {
    KSPConvergedReason reason;
    int32_t k;
    TRY(KSPMatSolve(system->solver, now->b, now->dx));
    TRY(KSPGetConvergedReason(system->solver, &reason));
    if (reason < 0) now->is_indefinite = 1;
    for (k = 0; k < now->n; ++k) now->at[k].iterations += 1;
    return 0;
}

static PetscErrorCode solve_one(const hm_petsc* system, solution* now, int32_t k) {
    KSPConvergedReason reason;
    PetscInt before = 0, after = 0;
    Vec b, dx;
    TRY(MatDenseGetColumnVecRead(now->b, k, &b));
    TRY(MatDenseGetColumnVecWrite(now->dx, k, &dx));
    TRY(KSPGetTotalIterations(system->solver, &before));
    TRY(KSPSolve(system->solver, b, dx));
    TRY(KSPGetTotalIterations(system->solver, &after));
    TRY(KSPGetConvergedReason(system->solver, &reason));
    if (reason == KSP_DIVERGED_PC_FAILED || reason == KSP_DIVERGED_INDEFINITE_MAT ||
        reason == KSP_DIVERGED_INDEFINITE_PC || reason == KSP_DIVERGED_NANORINF) {
        now->is_indefinite = 1;
    }
    now->at[k].iterations += after - before;
    TRY(MatDenseRestoreColumnVecWrite(now->dx, k, &dx));
    return MatDenseRestoreColumnVecRead(now->b, k, &b);
}

/* Makes column k of b from wanted->column of all processes. */
static PetscErrorCode send_column(const columns* wanted, const solution* now, int32_t k) {
    const hm_petsc* const system = wanted->system;
    PetscScalar* local;
    Vec b;
    TRY(VecGetArray(system->local, &local));
    to_scalars(system, wanted->column, local);
    TRY(VecRestoreArray(system->local, &local));
    TRY(MatDenseGetColumnVecWrite(now->b, k, &b));
    TRY(sum_up(system, b));
    return MatDenseRestoreColumnVecWrite(now->b, k, &b);
}

/* Adds dx to x; wanted->column receives the values of this process. */
static PetscErrorCode receive_column(const columns* wanted, solution* now, int32_t k,
                                     double* change) {
    const hm_petsc* const system = wanted->system;
    const PetscScalar* local;
    PetscReal correction, size;
    Vec dx, x;
    TRY(MatDenseGetColumnVecRead(now->dx, k, &dx));
    TRY(MatDenseGetColumnVec(now->x, k, &x));
    TRY(VecAXPY(x, 1, dx));
    TRY(VecNorm(dx, NORM_INFINITY, &correction));
    TRY(VecNorm(x, NORM_INFINITY, &size));
    TRY(VecScatterBegin(system->to_local, x, system->local, INSERT_VALUES, SCATTER_FORWARD));
    TRY(VecScatterEnd(system->to_local, x, system->local, INSERT_VALUES, SCATTER_FORWARD));
    TRY(MatDenseRestoreColumnVec(now->x, k, &x));
    TRY(MatDenseRestoreColumnVecRead(now->dx, k, &dx));
    TRY(VecGetArrayRead(system->local, &local));
    to_numbers(system, local, wanted->column);
    TRY(VecRestoreArrayRead(system->local, &local));
    *change = size > 0 ? correction / size : 0;
    return 0;
}

/* Called after a solution: stores the values, and makes b the residual. */
static PetscErrorCode take_over(const columns* wanted, solution* now, int32_t k, hm_error* err) {
    double change = 0;
    hm_status status;
    TRY(receive_column(wanted, now, k, &change));
    status = set_column(wanted, now->first + k, err);
    if (status < 0) now->status = status;
    TRY(send_column(wanted, now, k));
    ++now->at[k].solutions;
    judge(&now->at[k], change, wanted->system->tolerance);
    return 0;
}

/* Solves for the columns first .. first + n - 1. The loop ends at the same time on all processes,
 * as norms and the agreed status are the same. */
static PetscErrorCode solve_columns(const columns* wanted, solution* now, hm_error* err) {
    const hm_petsc* const system = wanted->system;
    int32_t k;
    int going = 1;
    memset(now->at, 0, sizeof now->at);
    TRY(MatZeroEntries(now->x));
    TRY(MatZeroEntries(now->b));
    for (k = 0; k < now->n; ++k) {
        const hm_status status = get_column(wanted, now->first + k, err);
        if (status < 0) now->status = status;
        TRY(send_column(wanted, now, k));
    }
    now->status = agree(now->status, system->comm, err);
    while (going && now->status >= 0 && !now->is_indefinite) {
        going = 0;
        if (now->direct) TRY(solve_at_once(system, now));
        for (k = 0; k < now->n; ++k) {
            if (now->at[k].done) continue;
            if (!now->direct) TRY(solve_one(system, now, k));
            TRY(take_over(wanted, now, k, err));
            going = going || !now->at[k].done;
        }
        now->status = agree(now->status, system->comm, err);
    }
    return 0;
}

static void include(hm_petsc_report* report, const solution* now) {
    int32_t k;
    for (k = 0; k < now->n; ++k) {
        const progress* const at = &now->at[k];
        if (at->iterations > report->iterations) report->iterations = (int32_t)at->iterations;
        if (at->solutions > report->solutions) report->solutions = at->solutions;
        if (!(at->change <= report->change)) report->change = at->change;
        if (!(at->error <= report->error)) report->error = at->error;
    }
}

static PetscErrorCode solve_blocks(const columns* wanted, solution* now, hm_petsc_report* report,
                                   hm_error* err) {
    const hm_petsc* const system = wanted->system;
    const PetscInt all = (PetscInt)system->unknowns * system->width;
    PetscBool direct = PETSC_FALSE;
    if (wanted->n == 0 || all == 0) return 0;
    TRY(PetscObjectTypeCompare((PetscObject)system->solver, KSPPREONLY, &direct));
    now->direct = direct;
    now->width = !direct ? 1 : wanted->n < MOST_AT_ONCE ? wanted->n : MOST_AT_ONCE;
    TRY(MatCreateDense(system->comm, system->own_rows, PETSC_DECIDE, all, now->width, NULL,
                       &now->b));
    TRY(MatDuplicate(now->b, MAT_DO_NOT_COPY_VALUES, &now->dx));
    TRY(MatDuplicate(now->b, MAT_DO_NOT_COPY_VALUES, &now->x));
    TRY(MatZeroEntries(now->dx));
    for (now->first = 0; now->first < wanted->n && now->status >= 0 && !now->is_indefinite;
         now->first += (int32_t)now->width) {
        now->n = wanted->n - now->first < now->width ? wanted->n - now->first : (int32_t)now->width;
        TRY(solve_columns(wanted, now, err));
        include(report, now);
    }
    return 0;
}

/* Solves for all columns. The status is the same on all processes. */
static hm_status solve_all(columns* wanted, hm_petsc_report* report, hm_error* err) {
    const hm_petsc* const system = wanted->system;
    solution now;
    PetscErrorCode code;
    hm_status status;
    wanted->column = room_for(length_of_column(system), sizeof *wanted->column);
    status = agree(wanted->column == NULL ? no_memory(err) : HM_OK, system->comm, err);
    if (status < 0) {
        free(wanted->column);
        return status;
    }
    memset(&now, 0, sizeof now);
    code = solve_blocks(wanted, &now, report, err);
    MatDestroy(&now.b);
    MatDestroy(&now.dx);
    MatDestroy(&now.x);
    free(wanted->column);
    status = agree(petsc_status(code, err), system->comm, err);
    if (status >= 0) status = now.status;
    if (status < 0 || !now.is_indefinite) return status;
    return refuse(err, HM_NOT_POSITIVE,
                  "PETSc could not factor or solve: the matrix is not positive definite");
}

/* Copies the report for the caller; the status says whether the tolerance was reached. */
static hm_status finish_report(const hm_petsc* system, hm_petsc_report* found,
                               hm_petsc_report* report, hm_error* err) {
    const hm_status status = found->error <= system->tolerance ? HM_OK : HM_NOT_CONVERGED;
    found->unknowns = system->unknowns;
    found->functions = system->info.functions;
    found->boundary_edges = system->boundary_edges;
    found->bytes = system->bytes;
    if (status == HM_NOT_CONVERGED) {
        refuse(err, HM_NOT_CONVERGED,
               "the iteration ended, but the error of the values may be larger than the tolerance");
        err->value = found->error;
    }
    if (report != NULL) {
        found->struct_size = report->struct_size;
        memcpy(report, found, known_bytes(report->struct_size, sizeof *found));
    }
    return status;
}

#endif
