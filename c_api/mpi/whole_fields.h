/* Given displacements of all processes together, on the process that has the plan. */
#ifndef HARMORPH_MPI_WHOLE_FIELDS_H
#define HARMORPH_MPI_WHOLE_FIELDS_H

#include <harmorph_study.h>
#include "gathering.h"

/* The data of all processes on root: fields at the wall points and at all points of the mesh, and
 * memory. */
typedef struct whole_fields {
    gathering wall, mesh;
    int32_t n_points, index_base, n_fields;
    double *at_wall, *at_points,
        *from;     /* [n_fields * 2 * wall points], [n_fields * 2 * n_points], [2 * n_points] */
    hm_points* in; /* [n_fields] */
    hm_points_out* out;
    hm_memory work;
} whole_fields;

static int is_root(const whole_fields* whole) { return whole->mesh.rank == whole->mesh.root; }

/* The process whose list has place k of all lists. */
static int process_at(const lengths* lists, int64_t k) {
    int process = 0;
    while (k >= lists->count[process]) k -= lists->count[process++];
    return process;
}

static hm_status refuse_point(hm_error* err, const char* before, int32_t point, int32_t base,
                              const char* behind) {
    char text[sizeof err->text];
    snprintf(text, sizeof text, "%s%d%s", before, (int)point, behind);
    refuse_argument(err, text);
    err->item_kind = HM_ITEM_POINT;
    err->item = point;
    err->item_base = base;
    return HM_BAD_ARGUMENT;
}

/* On root: takes memory, and checks that all points of the lists are points of the mesh. */
static hm_status make_room(whole_fields* whole, hm_plan* plan, int needs_all, hm_error* err) {
    const size_t n_fields = (size_t)whole->n_fields, n_wall = (size_t)whole->wall.lists.total;
    unsigned char* seen;
    int64_t k, missing = -1, wrong = -1;
    hm_status status = hm_plan_points(plan, &whole->n_points, &whole->index_base, err);
    if (status >= 0)
        status =
            hm_displace(plan, 0, NULL, whole->n_fields, NULL, NULL, NULL, &whole->work, NULL, err);
    if (status < 0) return status;
    whole->at_wall = room_for(2 * n_fields * n_wall, sizeof(double));
    whole->at_points = room_for(2 * n_fields * (size_t)whole->n_points, sizeof(double));
    whole->from = needs_all ? room_for(2 * (size_t)whole->n_points, sizeof(double)) : NULL;
    whole->in = room_for(n_fields, sizeof *whole->in);
    whole->out = room_for(n_fields, sizeof *whole->out);
    whole->work.block = room_for(whole->work.bytes, 1);
    seen = room_for((size_t)whole->n_points, 1);
    if (whole->at_wall == NULL || whole->at_points == NULL || (needs_all && whole->from == NULL) ||
        whole->in == NULL || whole->out == NULL || whole->work.block == NULL || seen == NULL) {
        free(seen);
        return refuse_argument(err, "there is no memory for the fields of all processes");
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
    if (wrong >= 0) {
        refuse_point(err, "point ", whole->mesh.points[wrong], whole->index_base,
                     " does not exist");
        name_rank(err, "the list of rank", process_at(&whole->mesh.lists, wrong));
        return HM_BAD_ARGUMENT;
    }
    if (!needs_all || missing < 0) return HM_OK;
    return refuse_point(err, "point ", (int32_t)missing + whole->index_base, whole->index_base,
                        " is in the list of no process");
}

static void free_whole(whole_fields* whole) {
    free(whole->at_wall);
    free(whole->at_points);
    free(whole->from);
    free(whole->in);
    free(whole->out);
    free(whole->work.block);
    end_gathering(&whole->wall);
    end_gathering(&whole->mesh);
}

/* wrong: a refusal of the arrays of this process, or NULL. Checks the other arguments, too, also
 * that those which must be the same on all processes are. Then
 * gathers the lists, and takes memory on root. */
static hm_status begin_whole(whole_fields* whole, hm_plan* plan, int32_t n_wall,
                             const int32_t* wall_points, int32_t n_fields, const char* wrong,
                             int32_t n, const int32_t* points, int has_from, int32_t root,
                             MPI_Comm comm, hm_error* err) {
    const int64_t same[] = {n_fields, root, has_from};
    const int differs = differs_from_first(same, 3, comm);
    int rank, size;
    hm_status status = HM_OK;
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &size);
    whole->n_fields = n_fields;
    if (root < 0 || root >= size || n_fields < 1) {
        status = refuse_argument(err, "root is not a rank, or n_fields is less than 1");
    } else if (differs) {
        status =
            refuse_argument(err, "n_fields, root, or whether `from` is NULL, are not as on rank 0");
    } else if (n_wall < 0 || n < 0 || (n_wall > 0 && wall_points == NULL) ||
               (n > 0 && points == NULL)) {
        status = refuse_argument(err, "a list is NULL, or a number of points is negative");
    } else if (wrong != NULL) {
        status = refuse_argument(err, wrong);
    } else if ((plan != NULL) != (rank == root)) {
        status = refuse_argument(
            err, "the process root must have a plan, and the other processes must not");
    }
    status = agree(status, comm, err);
    if (status >= 0) status = gather_points(&whole->wall, n_wall, wall_points, root, comm, err);
    if (status >= 0) status = gather_points(&whole->mesh, n, points, root, comm, err);
    if (status < 0) return status;
    return agree(rank == root ? make_room(whole, plan, has_from, err) : HM_OK, comm, err);
}

/* The arrays of one field of n points, pairs x,y. */
static double* field_of(double* all, int64_t n, int32_t field) {
    return all + 2 * (size_t)n * (size_t)field;
}

static const char* const no_array = "an array of a field is NULL, or its stride is negative";

/* True if one of n_fields fields has no arrays, although there are points. */
static int lacks_arrays(const hm_points* fields, int32_t n_fields, int32_t n) {
    int32_t k;
    if (fields == NULL) return 1;
    for (k = 0; k < n_fields && n > 0; ++k) {
        if (fields[k].x == NULL || fields[k].y == NULL || fields[k].stride < 0) return 1;
    }
    return 0;
}
static int lacks_arrays_out(const hm_points_out* fields, int32_t n_fields, int32_t n) {
    int32_t k;
    if (fields == NULL) return 1;
    for (k = 0; k < n_fields && n > 0; ++k) {
        if (fields[k].x == NULL || fields[k].y == NULL || fields[k].stride < 0) return 1;
    }
    return 0;
}

/* True if a number is infinite or NaN. */
static int has_infinite(const hm_points* fields, int32_t n_fields, int32_t n) {
    int32_t field, k;
    for (field = 0; field < n_fields; ++field) {
        for (k = 0; k < n; ++k) {
            const double x = fields[field].x[k * step_of(fields[field].stride)],
                         y = fields[field].y[k * step_of(fields[field].stride)];
            if (!(x - x == 0 && y - y == 0)) return 1;
        }
    }
    return 0;
}

#endif
