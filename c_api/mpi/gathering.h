/* The lists of points of all processes on one process, and fields at these points. */
#ifndef HARMORPH_MPI_GATHERING_H
#define HARMORPH_MPI_GATHERING_H

#include "lengths.h"

/* Each process has a list of points, and root has all lists. Fields at these points are sent to
 * root or received from root, as pairs x,y of all lists, one list after the other. */
typedef struct gathering {
    MPI_Comm comm;
    MPI_Datatype pair;
    int root, rank, n_processes;
    int32_t n;
    lengths lists;
    int32_t* points; /* on root: the lists of all processes */
    double* own;     /* [2 * n] */
    double* all;     /* on root: [2 * lists.total] */
} gathering;

static int64_t step_of(int64_t stride) { return stride > 0 ? stride : 1; }

static hm_status gather_points(gathering* g, int32_t n, const int32_t* points, int root,
                               MPI_Comm comm, hm_error* err) {
    hm_status status = HM_OK;
    int own = n, *numbers;
    memset(g, 0, sizeof *g);
    g->comm = comm;
    g->root = root;
    g->n = n;
    MPI_Comm_size(comm, &g->n_processes);
    MPI_Comm_rank(comm, &g->rank);
    MPI_Type_contiguous(2, MPI_DOUBLE, &g->pair);
    MPI_Type_commit(&g->pair);
    numbers = room_for(2 * (size_t)g->n_processes, sizeof *numbers);
    g->own = room_for(2 * (size_t)n, sizeof *g->own);
    if (numbers == NULL || g->own == NULL)
        status = refuse_argument(err, "there is no memory for a list of points");
    g->lists.count = numbers;
    g->lists.start = numbers != NULL ? numbers + g->n_processes : NULL;
    status = agree(status, comm, err);
    if (status < 0) return status;
    MPI_Gather(&own, 1, MPI_INT, g->lists.count, 1, MPI_INT, root, comm);
    if (g->rank == root) {
        set_starts(&g->lists, g->n_processes);
        if (g->lists.total <= INT_MAX) {
            g->points = room_for((size_t)g->lists.total, sizeof *g->points);
            g->all = room_for(2 * (size_t)g->lists.total, sizeof *g->all);
        }
        if (g->points == NULL || g->all == NULL) {
            status = refuse_argument(err, "there is no memory for the lists of all processes");
        }
    }
    status = agree(status, comm, err);
    if (status < 0) return status;
    MPI_Gatherv(points, n, MPI_INT32_T, g->points, g->lists.count, g->lists.start, MPI_INT32_T,
                root, comm);
    return HM_OK;
}

static void end_gathering(gathering* g) {
    if (g->n_processes == 0) return;
    MPI_Type_free(&g->pair);
    free(g->lists.count);
    free(g->points);
    free(g->own);
    free(g->all);
}

static void gather_field(const gathering* g, const hm_points* field) {
    int32_t k;
    for (k = 0; k < g->n; ++k) {
        g->own[2 * k] = field->x[k * step_of(field->stride)];
        g->own[2 * k + 1] = field->y[k * step_of(field->stride)];
    }
    MPI_Gatherv(g->own, g->n, g->pair, g->all, g->lists.count, g->lists.start, g->pair, g->root,
                g->comm);
}

static void scatter_field(const gathering* g, const hm_points_out* field) {
    int32_t k;
    MPI_Scatterv(g->all, g->lists.count, g->lists.start, g->pair, g->own, g->n, g->pair, g->root,
                 g->comm);
    for (k = 0; k < g->n; ++k) {
        field->x[k * step_of(field->stride)] = g->own[2 * k];
        field->y[k * step_of(field->stride)] = g->own[2 * k + 1];
    }
}

#endif
