/* Refusals that are the same on all processes. */
#ifndef HARMORPH_PETSC_AGREEMENT_H
#define HARMORPH_PETSC_AGREEMENT_H

#include "harmorph_petsc.h"

#include <limits.h>
#include <petscsys.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Returns the error of a call of PETSc from functions that return such errors. */
#define TRY(call)                      \
    do {                               \
        PetscErrorCode const e = call; \
        if (e != 0) return e;          \
    } while (0)

static hm_status refuse(hm_error* err, hm_status code, const char* sentence) {
    if (err != NULL) {
        memset(err, 0, sizeof *err);
        err->code = code;
        err->item = err->other = -1;
        snprintf(err->text, sizeof err->text, "%s", sentence);
    }
    return code;
}

/* The sentence begins with the global number of a point. */
static hm_status refuse_point(hm_error* err, int64_t point, const char* rest) {
    char sentence[sizeof err->text];
    snprintf(sentence, sizeof sentence, "the point with the global number %lld %s",
             (long long)point, rest);
    refuse(err, HM_BAD_MESH, sentence);
    if (err != NULL && point >= 0 && point <= INT32_MAX) {
        err->item_kind = HM_ITEM_GLOBAL_POINT;
        err->item = (int32_t)point;
    }
    return HM_BAD_MESH;
}

static hm_status refuse_argument(hm_error* err, const char* sentence) {
    return refuse(err, HM_BAD_ARGUMENT, sentence);
}

static hm_status no_memory(hm_error* err) {
    return refuse_argument(err, "there is no memory for the equations of this part");
}

/* The worst status of all processes. If another process has this status, the error says so. */
static hm_status agree(hm_status own, MPI_Comm comm, hm_error* err) {
    hm_status of_all = own;
    MPI_Allreduce(&own, &of_all, 1, MPI_INT32_T, MPI_MIN, comm);
    if (of_all >= 0) { /* warnings are positive */
        MPI_Allreduce(&own, &of_all, 1, MPI_INT32_T, MPI_MAX, comm);
        return of_all;
    }
    if (own < 0) return of_all;
    return refuse(err, of_all,
                  "another process refused the call; the error of that process has the reason");
}

/* The status and error of a failed call of PETSc, with the text of PETSc. */
static hm_status petsc_status(PetscErrorCode code, hm_error* err) {
    const char* text = NULL;
    char sentence[sizeof err->text];
    if (code == 0) return HM_OK;
    PetscErrorMessage(code, &text, NULL);
    snprintf(sentence, sizeof sentence, "PETSc: %s", text != NULL ? text : "unknown error");
    return refuse(err, HM_UNSUPPORTED, sentence);
}

/* Memory filled with zeros: at least one byte, so that NULL always means that there is no memory.
 */
static void* room_for(size_t n, size_t size) { return calloc(n > 0 ? n : 1, size); }

#endif
