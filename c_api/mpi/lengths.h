/* The lengths of the messages to, or from, each process. */
#ifndef HARMORPH_MPI_LENGTHS_H
#define HARMORPH_MPI_LENGTHS_H

#include "agreement.h"

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
