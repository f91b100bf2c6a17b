/* Numbers of the core and scalars of PETSc. With real scalars an unknown a + i b of the conformal
 * operator is two scalars a, b; with complex scalars it is one scalar, and a real unknown has the
 * imaginary part 0. */
#ifndef HARMORPH_PETSC_SCALARS_H
#define HARMORPH_PETSC_SCALARS_H

#include "part.h"

#ifdef PETSC_USE_COMPLEX

static PetscInt scalars_of_unknown(int32_t numbers) {
    (void)numbers;
    return 1;
}

/* Convert numbers [unknowns * info.numbers] to scalars, and back. */
static void to_scalars(const hm_petsc* system, const double* numbers, PetscScalar* scalar) {
    const int32_t n = system->info.numbers;
    int64_t k;
    for (k = 0; k < system->info.unknowns; ++k) {
        scalar[k] = numbers[n * k];
        if (n == 2) scalar[k] += PETSC_i * numbers[2 * k + 1];
    }
}

static void to_numbers(const hm_petsc* system, const PetscScalar* scalar, double* numbers) {
    const int32_t n = system->info.numbers;
    int64_t k;
    for (k = 0; k < system->info.unknowns; ++k) {
        numbers[n * k] = PetscRealPart(scalar[k]);
        if (n == 2) numbers[2 * k + 1] = PetscImaginaryPart(scalar[k]);
    }
}

/* The block of an entry (n x n numbers, row by row), as scalars, and its conjugate transpose. */
static void to_block(const double* values, int32_t n, PetscScalar block[4],
                     PetscScalar transpose[4]) {
    block[0] = n == 1 ? values[0] : values[0] + PETSC_i * values[2];
    transpose[0] = PetscConj(block[0]);
}

#else

static PetscInt scalars_of_unknown(int32_t numbers) { return numbers; }

static void to_scalars(const hm_petsc* system, const double* numbers, PetscScalar* scalar) {
    memcpy(scalar, numbers,
           (size_t)system->info.unknowns * (size_t)system->info.numbers * sizeof *numbers);
}

static void to_numbers(const hm_petsc* system, const PetscScalar* scalar, double* numbers) {
    memcpy(numbers, scalar,
           (size_t)system->info.unknowns * (size_t)system->info.numbers * sizeof *numbers);
}

static void to_block(const double* values, int32_t n, PetscScalar block[4],
                     PetscScalar transpose[4]) {
    int32_t i, j;
    for (i = 0; i < n; ++i) {
        for (j = 0; j < n; ++j) {
            block[n * i + j] = values[n * i + j];
            transpose[n * j + i] = values[n * i + j];
        }
    }
}

#endif
#endif
