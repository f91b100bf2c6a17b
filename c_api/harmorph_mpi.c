#include "harmorph_mpi.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static hm_status refuse(hm_error *err, hm_status code, const char *sentence) {
    if (err != NULL) {
        memset(err, 0, sizeof *err);
        err->code = code;
        err->item = -1;
        snprintf(err->text, sizeof err->text, "%s", sentence);
    }
    return code;
}

/* The worst status of all processes. Where it is another one's, the reason is there. */
static hm_status worst(hm_status own, hm_status of_all, hm_error *err) {
    if (of_all >= 0 || own < 0) return own < 0 ? of_all : own;
    return refuse(err, of_all, "another process refused; its error has the reason");
}

static hm_status agree(hm_status own, MPI_Comm comm, hm_error *err) {
    hm_status of_all = own;
    MPI_Allreduce(&own, &of_all, 1, MPI_INT32_T, MPI_MIN, comm);
    return worst(own, of_all, err);
}

/* At least one byte, so that NULL always means that there is no memory. */
static void *room_for(size_t n, size_t size) { return calloc(n > 0 ? n : 1, size); }

/* ---- Exchange ------------------------------------------------------------------------------------------------- */

/* One number for each process: lengths, and where they begin when put one after the other. */
typedef struct lengths {
    int *count, *start;
    int64_t total;
} lengths;

static void place(lengths *l, int n_processes) {
    int k;
    l->total = 0;
    for (k = 0; k < n_processes; ++k) {
        l->start[k] = l->total <= INT_MAX ? (int)l->total : 0;
        l->total += l->count[k];
    }
}

typedef struct exchange {
    MPI_Comm comm;
    int n_processes;
    lengths lists, sent, received; /* points; doubles of parcels */
    int32_t *points;               /* all processes' lists */
    double *outgoing, *incoming;
} exchange;

static hm_status begin(exchange *its, MPI_Comm comm, hm_error *err) {
    int *numbers;
    memset(its, 0, sizeof *its);
    its->comm = comm;
    MPI_Comm_size(comm, &its->n_processes);
    numbers = room_for(6 * (size_t)its->n_processes, sizeof *numbers);
    if (numbers == NULL) return refuse(err, HM_BAD_ARGUMENT, "there is no memory for the exchange of rows");
    its->lists.count = numbers;
    its->lists.start = numbers + its->n_processes;
    its->sent.count = numbers + 2 * its->n_processes;
    its->sent.start = numbers + 3 * its->n_processes;
    its->received.count = numbers + 4 * its->n_processes;
    its->received.start = numbers + 5 * its->n_processes;
    return HM_OK;
}

static void end(exchange *its) {
    free(its->lists.count);
    free(its->points);
    free(its->outgoing);
    free(its->incoming);
}

/* Every process learns all lists. */
static hm_status gather_lists(exchange *its, int32_t n, const int32_t *points, hm_error *err) {
    hm_status status = HM_OK;
    int own = n;
    MPI_Allgather(&own, 1, MPI_INT, its->lists.count, 1, MPI_INT, its->comm);
    place(&its->lists, its->n_processes);
    its->points = its->lists.total <= INT_MAX ? room_for((size_t)its->lists.total, sizeof *its->points) : NULL;
    if (its->points == NULL) status = refuse(err, HM_BAD_ARGUMENT, "there is no memory for the lists of all processes");
    status = agree(status, its->comm, err);
    if (status < 0) return status;
    MPI_Allgatherv(points, n, MPI_INT32_T, its->points, its->lists.count, its->lists.start, MPI_INT32_T, its->comm);
    return HM_OK;
}

static hm_status measure_parcels(exchange *its, const hm_basis *share, hm_error *err) {
    int k;
    for (k = 0; k < its->n_processes; ++k) {
        int64_t doubles = 0;
        hm_status status = hm_parcel_size(share, its->lists.count[k], &doubles, err);
        if (status < 0) return status;
        if (doubles > INT_MAX) return refuse(err, HM_UNSUPPORTED, "a message would have more than 2^31 numbers");
        its->sent.count[k] = (int)doubles;
    }
    return HM_OK;
}

static hm_status pack(exchange *its, const hm_basis *share, hm_error *err) {
    int k;
    place(&its->sent, its->n_processes);
    place(&its->received, its->n_processes);
    if (its->sent.total > INT_MAX || its->received.total > INT_MAX) {
        return refuse(err, HM_UNSUPPORTED, "this process would send or receive more than 2^31 numbers");
    }
    its->outgoing = room_for((size_t)its->sent.total, sizeof *its->outgoing);
    its->incoming = room_for((size_t)its->received.total, sizeof *its->incoming);
    if (its->outgoing == NULL || its->incoming == NULL) {
        return refuse(err, HM_BAD_ARGUMENT, "there is no memory for the exchange of rows");
    }
    for (k = 0; k < its->n_processes; ++k) {
        hm_status status = hm_parcel_pack(share, its->lists.count[k], its->points + its->lists.start[k],
                                          its->outgoing + its->sent.start[k], err);
        if (status < 0) return status;
    }
    return HM_OK;
}

/* In the order of ranks, which is that of the functions. Rows of a share that has all functions are filled already. */
static hm_status unpack(exchange *its, hm_basis *rows, hm_error *err) {
    int k;
    hm_basis_info info = {sizeof info};
    hm_status status = hm_basis_info_get(rows, &info, err);
    for (k = 0; status >= 0 && k < its->n_processes && !info.solved; ++k) {
        status = hm_parcel_unpack(rows, its->incoming + its->received.start[k], its->received.count[k], err);
    }
    if (status >= 0) status = hm_basis_info_get(rows, &info, err);
    if (status < 0 || info.solved) return status;
    return refuse(err, HM_BAD_BASIS, "the shares of all processes together are not all functions");
}

static hm_status exchange_rows(exchange *its, hm_basis *rows, const hm_basis *share, int32_t n, const int32_t *points,
                               hm_error *err) {
    hm_status status = gather_lists(its, n, points, err);
    if (status < 0) return status;
    status = agree(measure_parcels(its, share, err), its->comm, err);
    if (status < 0) return status;
    MPI_Alltoall(its->sent.count, 1, MPI_INT, its->received.count, 1, MPI_INT, its->comm);
    status = agree(pack(its, share, err), its->comm, err);
    if (status < 0) return status;
    MPI_Alltoallv(its->outgoing, its->sent.count, its->sent.start, MPI_DOUBLE, its->incoming, its->received.count,
                  its->received.start, MPI_DOUBLE, its->comm);
    return agree(unpack(its, rows, err), its->comm, err);
}

hm_status hm_mpi_exchange(hm_basis *rows, const hm_basis *share, int32_t n, const int32_t *points, MPI_Comm comm,
                          hm_error *err) {
    exchange its;
    hm_status status = begin(&its, comm, err);
    if (status >= 0 && (rows == NULL || share == NULL || n < 0 || (n > 0 && points == NULL))) {
        status = refuse(err, HM_BAD_ARGUMENT, "an argument is NULL, or the number of points is negative");
    }
    status = agree(status, comm, err);
    if (status >= 0) status = exchange_rows(&its, rows, share, n, points, err);
    end(&its);
    return status;
}

/* ---- Adjoint -------------------------------------------------------------------------------------------------- */

hm_status hm_mpi_adjoint(const hm_basis *rows, const hm_points *dj, double *gradient,
                         const hm_executor *executor, MPI_Comm comm, hm_error *err) {
    hm_basis_info info = {sizeof info};
    int64_t *sums = NULL;
    int32_t own[2] = {0, 0}, of_all[2] = {0, 0}; /* scale; minus the status: the largest of both is wanted */
    int n = 0;
    hm_status status = hm_basis_info_get(rows, &info, err);
    if (status >= 0) {
        n = 4 * info.numbers_per_value * info.functions;
        sums = room_for((size_t)n, sizeof *sums);
        if (sums == NULL) status = refuse(err, HM_BAD_ARGUMENT, "there is no memory for the adjoint's sums");
    }
    if (status >= 0 && gradient == NULL) status = refuse(err, HM_BAD_ARGUMENT, "gradient is NULL");
    if (status >= 0) status = hm_adjoint_scale(rows, dj, &own[0], executor, err);
    own[1] = -status;
    if (status < 0) own[0] = INT32_MIN;
    MPI_Allreduce(own, of_all, 2, MPI_INT32_T, MPI_MAX, comm);
    status = worst(status, -of_all[1], err);
    if (status >= 0) {
        status = hm_adjoint_sums(rows, dj, of_all[0], sums, executor, err);
        MPI_Allreduce(MPI_IN_PLACE, sums, n, MPI_INT64_T, MPI_SUM, comm);
        if (status >= 0) status = hm_adjoint_finish(rows, of_all[0], sums, gradient, err);
    }
    free(sums);
    return status;
}

/* ---- Fortran -------------------------------------------------------------------------------------------------- */

hm_status hm_mpi_exchange_f(hm_basis *rows, const hm_basis *share, int32_t n, const int32_t *points, MPI_Fint comm,
                            hm_error *err) {
    return hm_mpi_exchange(rows, share, n, points, MPI_Comm_f2c(comm), err);
}

hm_status hm_mpi_adjoint_f(const hm_basis *rows, const hm_points *dj, double *gradient,
                           const hm_executor *executor, MPI_Fint comm, hm_error *err) {
    return hm_mpi_adjoint(rows, dj, gradient, executor, MPI_Comm_f2c(comm), err);
}
