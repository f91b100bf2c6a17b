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

static hm_status refuse_point(hm_error *err, const char *before, int32_t point, const char *behind) {
    char text[sizeof err->text];
    snprintf(text, sizeof text, "%s%d%s", before, (int)point, behind);
    refuse(err, HM_BAD_ARGUMENT, text);
    if (err != NULL) err->item = point;
    return HM_BAD_ARGUMENT;
}

/* The worst status of all processes. If another process has it, the reason is in that process's error. */
static hm_status worst(hm_status own, hm_status of_all, hm_error *err) {
    if (of_all >= 0 || own < 0) return own < 0 ? of_all : own;
    return refuse(err, of_all, "another process refused; its error has the reason");
}

static hm_status agree(hm_status own, MPI_Comm comm, hm_error *err) {
    hm_status of_all = own;
    MPI_Allreduce(&own, &of_all, 1, MPI_INT32_T, MPI_MIN, comm);
    return worst(own, of_all, err);
}

/* Asks for at least one byte, so that NULL always means that there is no memory. */
static void *room_for(size_t n, size_t size) { return calloc(n > 0 ? n : 1, size); }

/* ---- Exchange ------------------------------------------------------------------------------------------------- */

/* Of each process: a length, and the start of that part when all parts are put one after the other. */
typedef struct lengths {
    int *count, *start;
    int64_t total;
} lengths;

static void set_starts(lengths *l, int n_processes) {
    int k;
    l->total = 0;
    for (k = 0; k < n_processes; ++k) {
        l->start[k] = l->total <= INT_MAX ? (int)l->total : 0;
        l->total += l->count[k];
    }
}

typedef struct row_exchange {
    MPI_Comm comm;
    int n_processes;
    lengths lists, sent, received; /* numbers of points; of doubles sent and received */
    int32_t *points;               /* the lists of all processes, one after the other */
    double *outgoing, *incoming;
} row_exchange;

static hm_status begin(row_exchange *exchange, MPI_Comm comm, hm_error *err) {
    int *numbers;
    memset(exchange, 0, sizeof *exchange);
    exchange->comm = comm;
    MPI_Comm_size(comm, &exchange->n_processes);
    numbers = room_for(6 * (size_t)exchange->n_processes, sizeof *numbers);
    if (numbers == NULL) return refuse(err, HM_BAD_ARGUMENT, "there is no memory for the exchange of rows");
    exchange->lists.count = numbers;
    exchange->lists.start = numbers + exchange->n_processes;
    exchange->sent.count = numbers + 2 * exchange->n_processes;
    exchange->sent.start = numbers + 3 * exchange->n_processes;
    exchange->received.count = numbers + 4 * exchange->n_processes;
    exchange->received.start = numbers + 5 * exchange->n_processes;
    return HM_OK;
}

static void end(row_exchange *exchange) {
    free(exchange->lists.count);
    free(exchange->points);
    free(exchange->outgoing);
    free(exchange->incoming);
}

/* Gathers the lists of points of all processes on every process. */
static hm_status gather_lists(row_exchange *exchange, int32_t n, const int32_t *points, hm_error *err) {
    hm_status status = HM_OK;
    int own = n;
    MPI_Allgather(&own, 1, MPI_INT, exchange->lists.count, 1, MPI_INT, exchange->comm);
    set_starts(&exchange->lists, exchange->n_processes);
    exchange->points = exchange->lists.total <= INT_MAX
                           ? room_for((size_t)exchange->lists.total, sizeof *exchange->points)
                           : NULL;
    if (exchange->points == NULL) {
        status = refuse(err, HM_BAD_ARGUMENT, "there is no memory for the lists of all processes");
    }
    status = agree(status, exchange->comm, err);
    if (status < 0) return status;
    MPI_Allgatherv(points, n, MPI_INT32_T, exchange->points, exchange->lists.count, exchange->lists.start, MPI_INT32_T,
                   exchange->comm);
    return HM_OK;
}

static hm_status measure_parcels(row_exchange *exchange, const hm_basis *share, hm_error *err) {
    int k;
    for (k = 0; k < exchange->n_processes; ++k) {
        int64_t doubles = 0;
        hm_status status = hm_parcel_size(share, exchange->lists.count[k], &doubles, err);
        if (status < 0) return status;
        if (doubles > INT_MAX) return refuse(err, HM_UNSUPPORTED, "a message would have more than 2^31 numbers");
        exchange->sent.count[k] = (int)doubles;
    }
    return HM_OK;
}

static hm_status pack(row_exchange *exchange, const hm_basis *share, hm_error *err) {
    int k;
    set_starts(&exchange->sent, exchange->n_processes);
    set_starts(&exchange->received, exchange->n_processes);
    if (exchange->sent.total > INT_MAX || exchange->received.total > INT_MAX) {
        return refuse(err, HM_UNSUPPORTED, "this process would send or receive more than 2^31 numbers");
    }
    exchange->outgoing = room_for((size_t)exchange->sent.total, sizeof *exchange->outgoing);
    exchange->incoming = room_for((size_t)exchange->received.total, sizeof *exchange->incoming);
    if (exchange->outgoing == NULL || exchange->incoming == NULL) {
        return refuse(err, HM_BAD_ARGUMENT, "there is no memory for the exchange of rows");
    }
    for (k = 0; k < exchange->n_processes; ++k) {
        hm_status status = hm_parcel_pack(share, exchange->lists.count[k], exchange->points + exchange->lists.start[k],
                                          exchange->outgoing + exchange->sent.start[k], err);
        if (status < 0) return status;
    }
    return HM_OK;
}

/* Unpacks in the order of ranks, which is that of the functions. If the own share has all functions, the rows are
 * solved already, and nothing is unpacked. */
static hm_status unpack(row_exchange *exchange, hm_basis *rows, hm_error *err) {
    int k;
    hm_basis_info info = {sizeof info};
    hm_status status = hm_basis_info_get(rows, &info, err);
    for (k = 0; status >= 0 && k < exchange->n_processes && !info.solved; ++k) {
        status = hm_parcel_unpack(rows, exchange->incoming + exchange->received.start[k], exchange->received.count[k],
                                  err);
    }
    if (status >= 0) status = hm_basis_info_get(rows, &info, err);
    if (status < 0 || info.solved) return status;
    return refuse(err, HM_BAD_BASIS, "the shares of all processes together are not all functions");
}

static hm_status exchange_rows(row_exchange *exchange, hm_basis *rows, const hm_basis *share, int32_t n,
                               const int32_t *points, hm_error *err) {
    hm_status status = gather_lists(exchange, n, points, err);
    if (status < 0) return status;
    status = agree(measure_parcels(exchange, share, err), exchange->comm, err);
    if (status < 0) return status;
    MPI_Alltoall(exchange->sent.count, 1, MPI_INT, exchange->received.count, 1, MPI_INT, exchange->comm);
    status = agree(pack(exchange, share, err), exchange->comm, err);
    if (status < 0) return status;
    MPI_Alltoallv(exchange->outgoing, exchange->sent.count, exchange->sent.start, MPI_DOUBLE, exchange->incoming,
                  exchange->received.count, exchange->received.start, MPI_DOUBLE, exchange->comm);
    return agree(unpack(exchange, rows, err), exchange->comm, err);
}

hm_status hm_mpi_exchange(hm_basis *rows, const hm_basis *share, int32_t n, const int32_t *points, MPI_Comm comm,
                          hm_error *err) {
    row_exchange exchange;
    hm_status status = begin(&exchange, comm, err);
    if (status >= 0 && (rows == NULL || share == NULL || n < 0 || (n > 0 && points == NULL))) {
        status = refuse(err, HM_BAD_ARGUMENT, "an argument is NULL, or the number of points is negative");
    }
    status = agree(status, comm, err);
    if (status >= 0) status = exchange_rows(&exchange, rows, share, n, points, err);
    end(&exchange);
    return status;
}

/* ---- Adjoint -------------------------------------------------------------------------------------------------- */

hm_status hm_mpi_adjoint(const hm_basis *rows, const hm_points *dj, double *gradient,
                         const hm_executor *executor, MPI_Comm comm, hm_error *err) {
    hm_basis_info info = {sizeof info};
    int64_t *sums = NULL;
    int32_t own[2] = {0, 0}, of_all[2] = {0, 0}; /* scale; minus the status: reduced by MPI_MAX */
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

/* ---- Given displacements -------------------------------------------------------------------------------------- */

/* A list of points on each process, all of them on root, and fields at these points that go to root or come from there:
 * pairs x,y of all lists, one list after the other. */
typedef struct gathering {
    MPI_Comm comm;
    MPI_Datatype pair;
    int root, rank, n_processes;
    int32_t n;
    lengths lists;
    int32_t *points; /* on root: the lists of all processes */
    double *own;     /* [2 * n] */
    double *all;     /* on root: [2 * lists.total] */
} gathering;

static int64_t step_of(int64_t stride) { return stride > 0 ? stride : 1; }

static hm_status gather_points(gathering *g, int32_t n, const int32_t *points, int root, MPI_Comm comm, hm_error *err) {
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
    if (numbers == NULL || g->own == NULL) status = refuse(err, HM_BAD_ARGUMENT, "there is no memory for a list of points");
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
            status = refuse(err, HM_BAD_ARGUMENT, "there is no memory for the lists of all processes");
        }
    }
    status = agree(status, comm, err);
    if (status < 0) return status;
    MPI_Gatherv(points, n, MPI_INT32_T, g->points, g->lists.count, g->lists.start, MPI_INT32_T, root, comm);
    return HM_OK;
}

static void end_gathering(gathering *g) {
    if (g->n_processes == 0) return;
    MPI_Type_free(&g->pair);
    free(g->lists.count);
    free(g->points);
    free(g->own);
    free(g->all);
}

static void gather_field(const gathering *g, const hm_points *field) {
    int32_t k;
    for (k = 0; k < g->n; ++k) {
        g->own[2 * k] = field->x[k * step_of(field->stride)];
        g->own[2 * k + 1] = field->y[k * step_of(field->stride)];
    }
    MPI_Gatherv(g->own, g->n, g->pair, g->all, g->lists.count, g->lists.start, g->pair, g->root, g->comm);
}

static void scatter_field(const gathering *g, const hm_points_out *field) {
    int32_t k;
    MPI_Scatterv(g->all, g->lists.count, g->lists.start, g->pair, g->own, g->n, g->pair, g->root, g->comm);
    for (k = 0; k < g->n; ++k) {
        field->x[k * step_of(field->stride)] = g->own[2 * k];
        field->y[k * step_of(field->stride)] = g->own[2 * k + 1];
    }
}

/* What root has of all processes together: fields at the wall's points and at all points of the mesh, and memory. */
typedef struct whole_fields {
    gathering wall, mesh;
    int32_t n_points, index_base, n_fields;
    double *at_wall, *at_points, *from; /* [n_fields * 2 * wall points], [n_fields * 2 * n_points], [2 * n_points] */
    hm_points *in;                      /* [n_fields] */
    hm_points_out *out;
    void *work;
    size_t bytes;
} whole_fields;

static int is_root(const whole_fields *whole) { return whole->mesh.rank == whole->mesh.root; }

/* On root: memory, and are all points of the lists points of the mesh? */
static hm_status make_room(whole_fields *whole, const hm_plan *plan, int needs_all, hm_error *err) {
    const size_t n_fields = (size_t)whole->n_fields, n_wall = (size_t)whole->wall.lists.total;
    unsigned char *seen;
    int64_t k, missing = -1, wrong = -1;
    hm_status status = hm_plan_points(plan, &whole->n_points, &whole->index_base, err);
    if (status >= 0) status = hm_displace_size(plan, whole->n_fields, &whole->bytes, err);
    if (status < 0) return status;
    whole->at_wall = room_for(2 * n_fields * n_wall, sizeof(double));
    whole->at_points = room_for(2 * n_fields * (size_t)whole->n_points, sizeof(double));
    whole->from = needs_all ? room_for(2 * (size_t)whole->n_points, sizeof(double)) : NULL;
    whole->in = room_for(n_fields, sizeof *whole->in);
    whole->out = room_for(n_fields, sizeof *whole->out);
    whole->work = room_for(whole->bytes, 1);
    seen = room_for((size_t)whole->n_points, 1);
    if (whole->at_wall == NULL || whole->at_points == NULL || (needs_all && whole->from == NULL) || whole->in == NULL ||
        whole->out == NULL || whole->work == NULL || seen == NULL) {
        free(seen);
        return refuse(err, HM_BAD_ARGUMENT, "there is no memory for the fields of all processes");
    }
    for (k = 0; k < whole->mesh.lists.total; ++k) {
        const int64_t point = (int64_t)whole->mesh.points[k] - whole->index_base;
        if (point >= 0 && point < whole->n_points) {
            seen[point] = 1;
        } else if (wrong < 0) {
            wrong = k;
        }
    }
    for (k = 0; k < whole->n_points && missing < 0; ++k) missing = seen[k] ? -1 : k;
    free(seen);
    if (wrong >= 0) return refuse_point(err, "a process has point ", whole->mesh.points[wrong], ", which the mesh has not");
    if (!needs_all || missing < 0) return HM_OK;
    return refuse_point(err, "point ", (int32_t)missing + whole->index_base, " is in the list of no process");
}

static void free_whole(whole_fields *whole) {
    free(whole->at_wall);
    free(whole->at_points);
    free(whole->from);
    free(whole->in);
    free(whole->out);
    free(whole->work);
    end_gathering(&whole->wall);
    end_gathering(&whole->mesh);
}

/* Arguments that all processes must have alike, and arrays that must be there. Then the lists, and memory on root. */
static hm_status begin_whole(whole_fields *whole, hm_plan *plan, int32_t n_wall, const int32_t *wall_points,
                             int32_t n_fields, int arrays_given, int32_t n, const int32_t *points, int has_from, int32_t root,
                             MPI_Comm comm, hm_error *err) {
    int32_t own[6] = {n_fields, -n_fields, root, -root, has_from, -has_from}, least[6];
    int rank, size;
    hm_status status = HM_OK;
    memset(whole, 0, sizeof *whole);
    whole->n_fields = n_fields;
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &size);
    MPI_Allreduce(own, least, 6, MPI_INT32_T, MPI_MIN, comm);
    if (least[0] != -least[1] || least[2] != -least[3] || least[4] != -least[5]) {
        return refuse(err, HM_BAD_ARGUMENT, "n_fields, root, or whether `from` is NULL, differ between processes");
    }
    if (root < 0 || root >= size || n_fields < 1) {
        return refuse(err, HM_BAD_ARGUMENT, "root is not a rank, or n_fields is less than 1");
    }
    if (n_wall < 0 || n < 0 || (n_wall > 0 && wall_points == NULL) || (n > 0 && points == NULL) || !arrays_given) {
        status = refuse(err, HM_BAD_ARGUMENT, "an argument is NULL, or a number of points is negative");
    } else if ((plan != NULL) != (rank == root)) {
        status = refuse(err, HM_BAD_ARGUMENT, "root must have a plan, and nobody else");
    }
    status = agree(status, comm, err);
    if (status >= 0) status = gather_points(&whole->wall, n_wall, wall_points, root, comm, err);
    if (status >= 0) status = gather_points(&whole->mesh, n, points, root, comm, err);
    if (status < 0) return status;
    return agree(rank == root ? make_room(whole, plan, has_from, err) : HM_OK, comm, err);
}

/* The arrays of one field of n points, pairs x,y. */
static double *field_of(double *all, int64_t n, int32_t field) { return all + 2 * (size_t)n * (size_t)field; }

/* Root's status, a warning too, is that of all. */
static hm_status as_root(const whole_fields *whole, hm_status own, hm_error *err) {
    hm_status of_root = own;
    MPI_Bcast(&of_root, 1, MPI_INT32_T, whole->mesh.root, whole->mesh.comm);
    if (is_root(whole) || of_root == HM_OK) return of_root;
    return refuse(err, of_root, "see the error of the process that has the plan");
}

/* Are there n_fields fields with arrays, where there are points? */
static int have_arrays(const hm_points *fields, int32_t n_fields, int32_t n) {
    int32_t k;
    if (fields == NULL) return 0;
    for (k = 0; k < n_fields && n > 0; ++k) {
        if (fields[k].x == NULL || fields[k].y == NULL || fields[k].stride < 0) return 0;
    }
    return 1;
}
static int have_arrays_out(const hm_points_out *fields, int32_t n_fields, int32_t n) {
    int32_t k;
    if (fields == NULL) return 0;
    for (k = 0; k < n_fields && n > 0; ++k) {
        if (fields[k].x == NULL || fields[k].y == NULL || fields[k].stride < 0) return 0;
    }
    return 1;
}

hm_status hm_mpi_displace(hm_plan *plan, int32_t n_wall, const int32_t *wall_points, int32_t n_fields,
                          const hm_points *wall, int32_t n, const int32_t *points, const hm_points *from,
                          const hm_points_out *to, int32_t root, MPI_Comm comm, hm_error *err) {
    whole_fields whole;
    const int given = have_arrays(wall, n_fields, n_wall) && have_arrays_out(to, n_fields, n) &&
                      (from == NULL || have_arrays(from, 1, n));
    int32_t field;
    int64_t k;
    hm_status status = begin_whole(&whole, plan, n_wall, wall_points, n_fields, given, n, points, from != NULL, root,
                                   comm, err);
    if (status < 0) {
        free_whole(&whole);
        return status;
    }
    for (field = 0; field < n_fields; ++field) {
        gather_field(&whole.wall, &wall[field]);
        if (!is_root(&whole)) continue;
        memcpy(field_of(whole.at_wall, whole.wall.lists.total, field), whole.wall.all,
               2 * (size_t)whole.wall.lists.total * sizeof(double));
    }
    if (from != NULL) gather_field(&whole.mesh, from);
    if (is_root(&whole)) {
        hm_points start = {whole.from, whole.from + 1, 2};
        for (k = 0; from != NULL && k < whole.mesh.lists.total; ++k) {
            memcpy(whole.from + 2 * (whole.mesh.points[k] - whole.index_base), whole.mesh.all + 2 * k, 2 * sizeof(double));
        }
        for (field = 0; field < n_fields; ++field) {
            double *const given_here = field_of(whole.at_wall, whole.wall.lists.total, field);
            double *const result = field_of(whole.at_points, whole.n_points, field);
            whole.in[field] = (hm_points){given_here, given_here + 1, 2};
            whole.out[field] = (hm_points_out){result, result + 1, 2};
        }
        status = hm_displace(plan, (int32_t)whole.wall.lists.total, whole.wall.points, n_fields, whole.in,
                             from != NULL ? &start : NULL, whole.out, whole.work, whole.bytes, NULL, err);
    }
    status = as_root(&whole, status, err);
    for (field = 0; status >= 0 && field < n_fields; ++field) {
        for (k = 0; is_root(&whole) && k < whole.mesh.lists.total; ++k) {
            memcpy(whole.mesh.all + 2 * k,
                   field_of(whole.at_points, whole.n_points, field) + 2 * (whole.mesh.points[k] - whole.index_base),
                   2 * sizeof(double));
        }
        scatter_field(&whole.mesh, &to[field]);
    }
    free_whole(&whole);
    return status;
}

hm_status hm_mpi_displace_adjoint(hm_plan *plan, int32_t n_wall, const int32_t *wall_points, int32_t n_fields,
                                  const hm_points *dj, int32_t n, const int32_t *points, const hm_points_out *gradient,
                                  int32_t root, MPI_Comm comm, hm_error *err) {
    whole_fields whole;
    const int given = have_arrays(dj, n_fields, n) && have_arrays_out(gradient, n_fields, n_wall);
    int32_t field;
    int64_t k;
    hm_status status = begin_whole(&whole, plan, n_wall, wall_points, n_fields, given, n, points, 0, root, comm, err);
    if (status < 0) {
        free_whole(&whole);
        return status;
    }
    for (field = 0; field < n_fields; ++field) {
        gather_field(&whole.mesh, &dj[field]);
        for (k = 0; is_root(&whole) && k < whole.mesh.lists.total; ++k) {
            double *const at = field_of(whole.at_points, whole.n_points, field) +
                               2 * (whole.mesh.points[k] - whole.index_base);
            at[0] += whole.mesh.all[2 * k];
            at[1] += whole.mesh.all[2 * k + 1];
        }
    }
    if (is_root(&whole)) {
        for (field = 0; field < n_fields; ++field) {
            double *const by_points = field_of(whole.at_points, whole.n_points, field);
            double *const result = field_of(whole.at_wall, whole.wall.lists.total, field);
            whole.in[field] = (hm_points){by_points, by_points + 1, 2};
            whole.out[field] = (hm_points_out){result, result + 1, 2};
        }
        status = hm_displace_adjoint(plan, (int32_t)whole.wall.lists.total, whole.wall.points, n_fields, whole.in,
                                     whole.out, whole.work, whole.bytes, NULL, err);
    }
    status = as_root(&whole, status, err);
    for (field = 0; status >= 0 && field < n_fields; ++field) {
        if (is_root(&whole)) {
            memcpy(whole.wall.all, field_of(whole.at_wall, whole.wall.lists.total, field),
                   2 * (size_t)whole.wall.lists.total * sizeof(double));
        }
        scatter_field(&whole.wall, &gradient[field]);
    }
    free_whole(&whole);
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

hm_status hm_mpi_displace_f(hm_plan *plan, int32_t n_wall, const int32_t *wall_points, int32_t n_fields,
                            const hm_points *wall, int32_t n, const int32_t *points, const hm_points *from,
                            const hm_points_out *to, int32_t root, MPI_Fint comm, hm_error *err) {
    return hm_mpi_displace(plan, n_wall, wall_points, n_fields, wall, n, points, from, to, root, MPI_Comm_f2c(comm), err);
}

hm_status hm_mpi_displace_adjoint_f(hm_plan *plan, int32_t n_wall, const int32_t *wall_points, int32_t n_fields,
                                    const hm_points *dj, int32_t n, const int32_t *points,
                                    const hm_points_out *gradient, int32_t root, MPI_Fint comm, hm_error *err) {
    return hm_mpi_displace_adjoint(plan, n_wall, wall_points, n_fields, dj, n, points, gradient, root, MPI_Comm_f2c(comm),
                                   err);
}
