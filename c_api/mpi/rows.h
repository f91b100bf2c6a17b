/* Each process solves a share of the functions, and sends the values of these functions to the
 * processes that have the points. */
#ifndef HARMORPH_MPI_ROWS_H
#define HARMORPH_MPI_ROWS_H

#include "private.h"
#include "lengths.h"

typedef struct row_exchange {
    MPI_Comm comm;
    int n_processes;
    lengths lists, sent, received; /* points, doubles sent, doubles received */
    int32_t* points;               /* the lists of all processes, one after the other */
    double *outgoing, *incoming;
    hm_basis *share, *rows;
    void* share_block;
} row_exchange;

static hm_status begin(row_exchange* exchange, MPI_Comm comm, hm_error* err) {
    int* numbers;
    memset(exchange, 0, sizeof *exchange);
    exchange->comm = comm;
    MPI_Comm_size(comm, &exchange->n_processes);
    numbers = room_for(6 * (size_t)exchange->n_processes, sizeof *numbers);
    if (numbers == NULL) return refuse_argument(err, "there is no memory for the exchange of rows");
    exchange->lists.count = numbers;
    exchange->lists.start = numbers + exchange->n_processes;
    exchange->sent.count = numbers + 2 * exchange->n_processes;
    exchange->sent.start = numbers + 3 * exchange->n_processes;
    exchange->received.count = numbers + 4 * exchange->n_processes;
    exchange->received.start = numbers + 5 * exchange->n_processes;
    return HM_OK;
}

static void end(row_exchange* exchange) {
    free(exchange->lists.count);
    free(exchange->points);
    free(exchange->outgoing);
    free(exchange->incoming);
    free(exchange->share_block);
}

/* Makes a basis for functions first .. first+n-1 in a new block, which the caller frees. */
static hm_status make_share(hm_basis** share, void** block, const hm_analysis* analysis,
                            int32_t first, int32_t n, hm_error* err) {
    size_t bytes = 0;
    hm_status status = hm_private_share_size(analysis, first, n, &bytes, err);
    if (status < 0) return status;
    *block = malloc(bytes);
    if (*block == NULL) return refuse_argument(err, "there is no memory for functions");
    return hm_private_share_init(share, *block, bytes, analysis, first, n, err);
}

/* Solves the functions of this process. */
static hm_status solve_share(row_exchange* exchange, hm_plan* plan, const hm_analysis* analysis,
                             hm_solve_report* report, hm_error* err) {
    int rank;
    int32_t first = 0, n = 0;
    hm_status status;
    MPI_Comm_rank(exchange->comm, &rank);
    status = hm_private_share_of(analysis, rank, exchange->n_processes, &first, &n, err);
    if (status >= 0) {
        status = make_share(&exchange->share, &exchange->share_block, analysis, first, n, err);
    }
    return status < 0 ? status : hm_plan_solve(plan, exchange->share, report, err);
}

/* Gathers the lists of points of all processes on every process. */
static hm_status gather_lists(row_exchange* exchange, int32_t n, const int32_t* points,
                              hm_error* err) {
    hm_status status = HM_OK;
    int own = n;
    MPI_Allgather(&own, 1, MPI_INT, exchange->lists.count, 1, MPI_INT, exchange->comm);
    set_starts(&exchange->lists, exchange->n_processes);
    exchange->points = exchange->lists.total <= INT_MAX
                           ? room_for((size_t)exchange->lists.total, sizeof *exchange->points)
                           : NULL;
    if (exchange->points == NULL) {
        status = refuse_argument(err, "there is no memory for the lists of all processes");
    }
    status = agree(status, exchange->comm, err);
    if (status < 0) return status;
    MPI_Allgatherv(points, n, MPI_INT32_T, exchange->points, exchange->lists.count,
                   exchange->lists.start, MPI_INT32_T, exchange->comm);
    return HM_OK;
}

static hm_status measure_parcels(row_exchange* exchange, hm_error* err) {
    int k;
    for (k = 0; k < exchange->n_processes; ++k) {
        int64_t doubles = 0;
        hm_status status =
            hm_private_parcel_size(exchange->share, exchange->lists.count[k], &doubles, err);
        if (status < 0) return status;
        if (doubles > INT_MAX)
            return refuse(err, HM_UNSUPPORTED, "a message would have more than 2^31 numbers");
        exchange->sent.count[k] = (int)doubles;
    }
    return HM_OK;
}

static hm_status pack(row_exchange* exchange, hm_error* err) {
    int k;
    set_starts(&exchange->sent, exchange->n_processes);
    set_starts(&exchange->received, exchange->n_processes);
    if (exchange->sent.total > INT_MAX || exchange->received.total > INT_MAX) {
        return refuse(err, HM_UNSUPPORTED,
                      "this process would send or receive more than 2^31 numbers");
    }
    exchange->outgoing = room_for((size_t)exchange->sent.total, sizeof *exchange->outgoing);
    exchange->incoming = room_for((size_t)exchange->received.total, sizeof *exchange->incoming);
    if (exchange->outgoing == NULL || exchange->incoming == NULL) {
        return refuse_argument(err, "there is no memory for the exchange of rows");
    }
    for (k = 0; k < exchange->n_processes; ++k) {
        hm_status status = hm_private_parcel_pack(
            exchange->share, exchange->lists.count[k], exchange->points + exchange->lists.start[k],
            exchange->outgoing + exchange->sent.start[k], err);
        if (status < 0) {
            name_rank(err, "the list of rank", k);
            return status;
        }
    }
    return HM_OK;
}

/* Unpacks the messages in the order of ranks, which is the order of the functions. If the share of
 * this process has all functions, the rows are solved already, and nothing is unpacked. */
static hm_status unpack(row_exchange* exchange, hm_error* err) {
    int k;
    hm_basis* const rows = exchange->rows;
    hm_basis_info info = {sizeof info};
    hm_status status = hm_basis_info_get(rows, &info, err);
    for (k = 0; status >= 0 && k < exchange->n_processes && !info.solved; ++k) {
        status = hm_private_parcel_unpack(rows, exchange->incoming + exchange->received.start[k],
                                          exchange->received.count[k], err);
        if (status < 0) name_rank(err, "the message from rank", k);
    }
    if (status >= 0) status = hm_basis_info_get(rows, &info, err);
    if (status < 0 || info.solved) return status;
    return refuse(err, HM_BAD_BASIS,
                  "the shares of all processes together do not contain all functions");
}

static hm_status exchange_rows(row_exchange* exchange, int32_t n, const int32_t* points,
                               hm_error* err) {
    hm_status status = gather_lists(exchange, n, points, err);
    if (status < 0) return status;
    status = agree(measure_parcels(exchange, err), exchange->comm, err);
    if (status < 0) return status;
    MPI_Alltoall(exchange->sent.count, 1, MPI_INT, exchange->received.count, 1, MPI_INT,
                 exchange->comm);
    status = agree(pack(exchange, err), exchange->comm, err);
    if (status < 0) return status;
    MPI_Alltoallv(exchange->outgoing, exchange->sent.count, exchange->sent.start, MPI_DOUBLE,
                  exchange->incoming, exchange->received.count, exchange->received.start,
                  MPI_DOUBLE, exchange->comm);
    return agree(unpack(exchange, err), exchange->comm, err);
}

#endif
