/* Each point and unknown that several processes have belongs to one of them. */
#ifndef HARMORPH_PETSC_OWNERS_H
#define HARMORPH_PETSC_OWNERS_H

#include "mail.h"

enum { GHOST = 0, ON_BORDER = 1, INSIDE = 2 };

typedef struct named { /* a point or an unknown of one process */
    int64_t name;
    double x, y;           /* coordinates of a point; 0 for unknowns */
    int32_t role, process; /* GHOST, ... */
    int64_t index;         /* place among the received records */
} named;

typedef struct directory { /* the part of all records that this process compares */
    mail post;
    named* in;        /* [n_in] sorted by name */
    int64_t* answers; /* [n_in] by index */
} directory;

static int by_name(const void* a, const void* b) {
    const named *const p = a, *const q = b;
    if (p->name != q->name) return p->name < q->name ? -1 : 1;
    return p->process != q->process ? (p->process < q->process ? -1 : 1) : 0;
}

/* The owner of a group of equal names is the first process whose record is not a ghost. owner [n]
 * is ordered by index. */
static hm_status find_owners(named* records, int64_t n, int64_t* owner, hm_error* err) {
    int64_t k, next;
    qsort(records, (size_t)n, sizeof *records, by_name);
    for (k = 0; k < n; k = next) {
        int64_t other, first = -1;
        for (next = k; next < n && records[next].name == records[k].name; ++next) {
            const named* const one = &records[next];
            if (one->x != records[k].x || one->y != records[k].y) {
                return refuse_point(err, one->name, "has different coordinates in two parts");
            }
            if (one->role == GHOST) continue;
            if (first >= 0 && (one->role == INSIDE || records[first].role == INSIDE)) {
                return refuse_point(err, one->name,
                                    "is inside two parts, so that global numbers must be wrong");
            }
            if (first < 0) first = next;
        }
        if (first < 0) {
            return refuse_point(err, records[k].name,
                                "is in ghost cells, but in no own cell of any part");
        }
        for (other = k; other < next; ++other) owner[records[other].index] = records[first].process;
    }
    return HM_OK;
}

static void clear_directory(directory* names) {
    memset(names, 0, sizeof *names);
    clear_mail(&names->post);
}

static void end_directory(directory* names) {
    end_mail(&names->post);
    free(names->in);
    free(names->answers);
}

/* Finds owner [n] of each record. */
static hm_status look_up(directory* names, MPI_Comm comm, int64_t n, const named* records,
                         int64_t* owner, hm_error* err) {
    int *to = room_for((size_t)n, sizeof *to), size;
    int64_t k;
    void* in = NULL;
    hm_status status = agree(to == NULL ? no_memory(err) : HM_OK, comm, err);
    clear_directory(names);
    MPI_Comm_size(comm, &size);
    for (k = 0; status >= 0 && k < n; ++k) to[k] = process_of((uint64_t)records[k].name, size);
    if (status >= 0) status = begin_mail(&names->post, comm, n, to, err);
    if (status >= 0) status = deliver(&names->post, records, sizeof *records, &in, err);
    names->in = in;
    if (status >= 0) {
        names->answers = room_for((size_t)names->post.n_in, sizeof *names->answers);
        status = agree(names->answers == NULL ? no_memory(err) : HM_OK, comm, err);
    }
    if (status >= 0) {
        for (k = 0; k < names->post.n_in; ++k) names->in[k].index = k;
        status = agree(find_owners(names->in, names->post.n_in, names->answers, err), comm, err);
    }
    if (status >= 0) status = answer(&names->post, names->answers, owner, err);
    free(to);
    return status;
}

/* Called after look_up. number [n] contains numbers of the records that this process owns, and -1
 * for others; on return it contains the numbers of all records. */
static hm_status spread(directory* names, int64_t* number, hm_error* err) {
    int64_t k, next, other, *came = NULL;
    void* in = NULL;
    hm_status status = deliver(&names->post, number, sizeof *number, &in, err);
    came = in;
    for (k = 0; status >= 0 && k < names->post.n_in; k = next) {
        int64_t known = -1;
        for (next = k; next < names->post.n_in && names->in[next].name == names->in[k].name;
             ++next) {
            if (came[names->in[next].index] >= 0) known = came[names->in[next].index];
        }
        for (other = k; other < next; ++other) names->answers[names->in[other].index] = known;
    }
    if (status >= 0) status = answer(&names->post, names->answers, number, err);
    free(in);
    return status;
}

#endif
