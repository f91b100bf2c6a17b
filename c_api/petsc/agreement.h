/* Refusals that are the same on all processes, also those of PETSc. */
#ifndef HARMORPH_PETSC_AGREEMENT_H
#define HARMORPH_PETSC_AGREEMENT_H

#include "harmorph_petsc.h"
#include "mpi/agreement.h"

#include <petscsys.h>

/* Returns the error of a call of PETSc from functions that return such errors. */
#define TRY(call)                      \
    do {                               \
        PetscErrorCode const e = call; \
        if (e != 0) return e;          \
    } while (0)

/* The structs of a caller may be those of another version of the headers. */
static int is_struct_size(uint64_t size) { return size >= sizeof size && size <= 4096; }
static size_t known_bytes(uint64_t struct_size, size_t known) {
    return struct_size < known ? (size_t)struct_size : known;
}

/* The sentence begins with the global number of a point. */
static hm_status refuse_point(hm_error* err, int64_t point, const char* rest) {
    char sentence[sizeof err->text];
    snprintf(sentence, sizeof sentence, "the point with the global number %lld %s",
             (long long)point, rest);
    refuse(err, HM_BAD_MESH, sentence);
    if (point >= 0 && point <= INT32_MAX) {
        err->item_kind = HM_ITEM_GLOBAL_POINT;
        err->item = (int32_t)point;
    }
    return HM_BAD_MESH;
}

static hm_status no_memory(hm_error* err) {
    return refuse_argument(err, "there is no memory for the equations of this part");
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

#endif
