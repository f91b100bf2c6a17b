/* Refusals that are the same on all processes. */
#ifndef HARMORPH_PETSC_AGREEMENT_H
#define HARMORPH_PETSC_AGREEMENT_H

#include "harmorph_petsc.h"

#include <limits.h>
#include <petscsys.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Hands on the error of a call of PETSc, in functions that return one. */
#define TRY(call)                      \
    do {                               \
        PetscErrorCode const e = call; \
        if (e != 0) return e;          \
    } while (0)

/* point: a global number, or -1. */
static hm_status refuse(hm_error* err, hm_status code, int64_t point, const char* sentence) {
    if (err != NULL) {
        memset(err, 0, sizeof *err);
        err->code = code;
        err->item = err->other = -1;
        if (point >= 0 && point <= INT32_MAX) {
            err->item_kind = HM_ITEM_GLOBAL_POINT;
            err->item = (int32_t)point;
        }
        snprintf(err->text, sizeof err->text, "%s", sentence);
    }
    return code;
}

static hm_status refuse_argument(hm_error* err, const char* sentence) {
    return refuse(err, HM_BAD_ARGUMENT, -1, sentence);
}

static hm_status no_memory(hm_error* err) { return refuse_argument(err, "there is no memory"); }

/* The worst status of all processes; where another process has it, the error says so. */
static hm_status agree(hm_status own, MPI_Comm comm, hm_error* err) {
    hm_status of_all = own;
    MPI_Allreduce(&own, &of_all, 1, MPI_INT32_T, MPI_MIN, comm);
    if (of_all >= 0) { /* warnings are positive */
        MPI_Allreduce(&own, &of_all, 1, MPI_INT32_T, MPI_MAX, comm);
        return of_all;
    }
    if (own < 0) return of_all;
    return refuse(err, of_all, -1, "another process refused; its error has the reason");
}

/* A failed call of PETSc: what PETSc says. */
static hm_status petsc_status(PetscErrorCode code, hm_error* err) {
    const char* text = NULL;
    char sentence[sizeof err->text];
    if (code == 0) return HM_OK;
    PetscErrorMessage(code, &text, NULL);
    snprintf(sentence, sizeof sentence, "PETSc: %s", text != NULL ? text : "unknown error");
    return refuse(err, HM_UNSUPPORTED, -1, sentence);
}

/* Zeros; at least one byte, so that NULL always means that there is no memory. */
static void* room_for(size_t n, size_t size) { return calloc(n > 0 ? n : 1, size); }

#endif
