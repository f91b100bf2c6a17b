/* Agreement of the processes on a status, and the lengths of their messages. */
#ifndef HARMORPH_MPI_AGREEMENT_H
#define HARMORPH_MPI_AGREEMENT_H

#include "harmorph_mpi.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static hm_status refuse(hm_error* err, hm_status code, const char* sentence) {
    if (err != NULL) {
        memset(err, 0, sizeof *err);
        err->code = code;
        err->item = err->other = -1;
        snprintf(err->text, sizeof err->text, "%s", sentence);
    }
    return code;
}

static hm_status refuse_point(hm_error* err, const char* before, int32_t point, int32_t base,
                              const char* behind) {
    char text[sizeof err->text];
    snprintf(text, sizeof text, "%s%d%s", before, (int)point, behind);
    refuse(err, HM_BAD_ARGUMENT, text);
    if (err != NULL) {
        err->item_kind = HM_ITEM_POINT;
        err->item = point;
        err->item_base = base;
    }
    return HM_BAD_ARGUMENT;
}

/* The worst status of all processes. If another process has this status, the reason is in the error
 * of that process. */
static hm_status worst(hm_status own, hm_status of_all, hm_error* err) {
    if (of_all >= 0 || own < 0) return own < 0 ? of_all : own;
    return refuse(err, of_all,
                  "another process refused the call; the error of that process has the reason");
}

static hm_status agree(hm_status own, MPI_Comm comm, hm_error* err) {
    hm_status of_all = own;
    MPI_Allreduce(&own, &of_all, 1, MPI_INT32_T, MPI_MIN, comm);
    return worst(own, of_all, err);
}

/* Allocates at least one byte, so that NULL always means that there is no memory. */
static void* room_for(size_t n, size_t size) { return calloc(n > 0 ? n : 1, size); }

/* For each process: a length, and the start of this part if all parts follow each other. */
typedef struct lengths {
    int *count, *start;
    int64_t total;
} lengths;

static void set_starts(lengths* l, int n_processes) {
    int k;
    l->total = 0;
    for (k = 0; k < n_processes; ++k) {
        l->start[k] = l->total <= INT_MAX ? (int)l->total : 0;
        l->total += l->count[k];
    }
}

#endif
