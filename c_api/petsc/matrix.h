/* The matrix of the mesh: PETSc has each row on the process that owns the unknown. */
#ifndef HARMORPH_PETSC_MATRIX_H
#define HARMORPH_PETSC_MATRIX_H

#include "private.h"
#include "scalars.h"

typedef struct numbering {
    int64_t* row;   /* [unknowns of this process] row in the whole matrix, in unknowns */
    int64_t* owner; /* [unknowns] the process that has the row */
    PetscInt* rows; /* [unknowns] row in scalars of PETSc */
} numbering;

static hm_status number_unknowns(hm_petsc* system, numbering* rows, hm_error* err) {
    const int32_t n = system->info.unknowns;
    named* records = room_for((size_t)n, sizeof *records);
    directory names;
    int64_t k, own = 0, first = 0;
    hm_status status = agree(records == NULL ? no_memory(err) : HM_OK, system->comm, err);
    clear_directory(&names);
    for (k = 0; status >= 0 && k < n; ++k) {
        records[k].name = system->info.unknown[k];
        records[k].process = system->rank;
        records[k].role = system->info.own[k] != 0 ? ON_BORDER : GHOST;
    }
    if (status >= 0) status = look_up(&names, system->comm, n, records, rows->owner, err);
    if (status >= 0) {
        for (k = 0; k < n; ++k) own += rows->owner[k] == system->rank;
        MPI_Exscan(&own, &first, 1, MPI_INT64_T, MPI_SUM, system->comm);
        if (system->rank == 0) first = 0;
        MPI_Allreduce(&own, &system->unknowns, 1, MPI_INT64_T, MPI_SUM, system->comm);
        for (k = 0; k < n; ++k) rows->row[k] = rows->owner[k] == system->rank ? first++ : -1;
        if (system->unknowns > (int64_t)PETSC_MAX_INT / system->width) {
            status = refuse(err, HM_UNSUPPORTED,
                            "the mesh has more unknowns than the integers of PETSc count: use a "
                            "PETSc with 64-bit integers");
        } else {
            system->own_rows = (PetscInt)own * system->width;
        }
    }
    if (status >= 0) status = spread(&names, rows->row, err);
    for (k = 0; status >= 0 && k < n; ++k) rows->rows[k] = (PetscInt)rows->row[k];
    end_directory(&names);
    free(records);
    return status;
}

static PetscErrorCode make_scatter(hm_petsc* system, const numbering* rows) {
    IS to;
    Vec global;
    TRY(VecCreateSeq(PETSC_COMM_SELF, system->info.unknowns * system->width, &system->local));
    TRY(VecCreateMPI(system->comm, system->own_rows, PETSC_DETERMINE, &global));
    TRY(ISCreateBlock(system->comm, system->width, system->info.unknowns, rows->rows,
                      PETSC_COPY_VALUES, &to));
    TRY(VecScatterCreate(global, to, system->local, NULL, &system->to_local));
    TRY(ISDestroy(&to));
    return VecDestroy(&global);
}

/* Adds system->local of all processes. */
static PetscErrorCode sum_up(const hm_petsc* system, Vec sum) {
    TRY(VecZeroEntries(sum));
    TRY(VecScatterBegin(system->to_local, system->local, sum, ADD_VALUES, SCATTER_REVERSE));
    return VecScatterEnd(system->to_local, system->local, sum, ADD_VALUES, SCATTER_REVERSE);
}

/* The entries of some unknowns with themselves and later ones: a window that moves over the part.
 */
enum { WINDOW = 4096 };

typedef struct window {
    int32_t *row, *column;
    double* values;
    int64_t n, capacity;
} window;

static void end_window(window* at) {
    free(at->row);
    free(at->column);
    free(at->values);
}

/* Takes memory for the largest window. */
static hm_status make_window(const hm_petsc* system, window* at, hm_error* err) {
    const int32_t bs = system->info.numbers;
    int32_t first, n;
    memset(at, 0, sizeof *at);
    for (first = 0; first < system->info.unknowns; first += n) {
        int64_t count = 0;
        n = system->info.unknowns - first < WINDOW ? system->info.unknowns - first : WINDOW;
        hm_private_equations_entries(system->equations, first, n, NULL, NULL, NULL, 0, &count,
                                     NULL); /* only counts */
        if (count > at->capacity) at->capacity = count;
    }
    at->row = room_for((size_t)at->capacity, sizeof *at->row);
    at->column = room_for((size_t)at->capacity, sizeof *at->column);
    at->values = room_for((size_t)at->capacity * (size_t)(bs * bs), sizeof *at->values);
    return at->row == NULL || at->column == NULL || at->values == NULL ? no_memory(err) : HM_OK;
}

/* Moves to the next window, whose first unknown is then *first. Returns 0 at the end. */
static int next_window(const hm_petsc* system, window* at, int32_t* first) {
    const int32_t n =
        system->info.unknowns - *first < WINDOW ? system->info.unknowns - *first : WINDOW;
    if (n <= 0) return 0;
    hm_private_equations_entries(system->equations, *first, n, at->row, at->column, at->values,
                                 at->capacity, &at->n, NULL);
    *first += n;
    return 1;
}

/* Counts in system->local the entries that this part has in each row. With `elsewhere`, counts
 * those in columns of other processes than the owner of the row. */
static PetscErrorCode count_entries(const hm_petsc* system, const numbering* rows, window* at,
                                    int elsewhere) {
    const PetscInt bs = system->width;
    PetscScalar* count;
    PetscInt k;
    int64_t e;
    int32_t first = 0;
    TRY(VecZeroEntries(system->local));
    TRY(VecGetArray(system->local, &count));
    while (next_window(system, at, &first)) {
        for (e = 0; e < at->n; ++e) {
            const int32_t row = at->row[e], column = at->column[e];
            if ((rows->owner[row] != rows->owner[column]) != elsewhere) continue;
            for (k = 0; k < bs; ++k) {
                count[row * bs + k] += bs;
                if (row != column) count[column * bs + k] += bs;
            }
        }
    }
    return VecRestoreArray(system->local, &count);
}

/* An upper bound for the entries of each row, as edges between parts count twice. */
static PetscErrorCode preallocate(const hm_petsc* system, const numbering* rows, window* at) {
    const PetscInt n = system->own_rows, others = (PetscInt)system->unknowns * system->width - n;
    PetscInt k, *counts;
    Vec all;
    int elsewhere;
    TRY(VecCreateMPI(system->comm, n, PETSC_DETERMINE, &all));
    TRY(PetscMalloc1((size_t)(2 * n) + 1, &counts));
    for (elsewhere = 0; elsewhere < 2; ++elsewhere) {
        const PetscInt most = elsewhere ? others : n;
        const PetscScalar* sums;
        TRY(count_entries(system, rows, at, elsewhere));
        TRY(sum_up(system, all));
        TRY(VecGetArrayRead(all, &sums));
        for (k = 0; k < n; ++k) {
            const PetscInt wanted =
                (PetscInt)PetscRealPart(sums[k]) + (elsewhere ? 0 : system->width);
            counts[elsewhere * n + k] = wanted < most ? wanted : most;
        }
        TRY(VecRestoreArrayRead(all, &sums));
    }
    TRY(MatSeqAIJSetPreallocation(system->matrix, 0, counts));
    TRY(MatMPIAIJSetPreallocation(system->matrix, 0, counts, 0, counts + n));
    TRY(PetscFree(counts));
    return VecDestroy(&all);
}

/* Adds the entries of this part in blocks, and their transposes. */
static PetscErrorCode add_entries(const hm_petsc* system, const numbering* rows, window* at) {
    const int32_t numbers = system->info.numbers;
    int64_t e;
    int32_t first = 0;
    while (next_window(system, at, &first)) {
        for (e = 0; e < at->n; ++e) {
            const PetscInt i = rows->rows[at->row[e]], j = rows->rows[at->column[e]];
            PetscScalar block[4], transpose[4];
            to_block(at->values + e * numbers * numbers, numbers, block, transpose);
            TRY(MatSetValuesBlocked(system->matrix, 1, &i, 1, &j, block, ADD_VALUES));
            if (i != j)
                TRY(MatSetValuesBlocked(system->matrix, 1, &j, 1, &i, transpose, ADD_VALUES));
        }
    }
    TRY(MatAssemblyBegin(system->matrix, MAT_FINAL_ASSEMBLY));
    return MatAssemblyEnd(system->matrix, MAT_FINAL_ASSEMBLY);
}

static PetscErrorCode fill_matrix(hm_petsc* system, const numbering* rows, window* at) {
    TRY(MatCreate(system->comm, &system->matrix));
    TRY(MatSetSizes(system->matrix, system->own_rows, system->own_rows, PETSC_DETERMINE,
                    PETSC_DETERMINE));
    TRY(MatSetBlockSize(system->matrix, system->width));
    TRY(MatSetType(system->matrix, MATAIJ));
    TRY(MatSetOptionsPrefix(system->matrix, "hm_"));
    TRY(MatSetFromOptions(system->matrix));
    TRY(preallocate(system, rows, at));
    TRY(add_entries(system, rows, at));
#ifdef PETSC_USE_COMPLEX
    if (system->info.numbers == 1) TRY(MatSetOption(system->matrix, MAT_SYMMETRIC, PETSC_TRUE));
    return MatSetOption(system->matrix, MAT_HERMITIAN, PETSC_TRUE);
#else
    return MatSetOption(system->matrix, MAT_SPD, PETSC_TRUE);
#endif
}

/* Makes system->matrix, local and to_local. */
static hm_status make_matrix(hm_petsc* system, hm_error* err) {
    const size_t n = (size_t)system->info.unknowns;
    numbering rows;
    window at;
    hm_status status = make_window(system, &at, err);
    rows.row = room_for(n, sizeof *rows.row);
    rows.owner = room_for(n, sizeof *rows.owner);
    rows.rows = room_for(n, sizeof *rows.rows);
    if (rows.row == NULL || rows.owner == NULL || rows.rows == NULL) status = no_memory(err);
    status = agree(status, system->comm, err);
    system->width = scalars_of_unknown(system->info.numbers);
    if (status >= 0) status = number_unknowns(system, &rows, err);
    if (status >= 0) {
        PetscErrorCode code = make_scatter(system, &rows);
        if (code == 0) code = fill_matrix(system, &rows, &at);
        status = agree(petsc_status(code, err), system->comm, err);
    }
    end_window(&at);
    free(rows.row);
    free(rows.owner);
    free(rows.rows);
    return status;
}

#endif
