/* The system of a process. This file makes the part of the mesh and the boundary of all parts. */
#ifndef HARMORPH_PETSC_PART_H
#define HARMORPH_PETSC_PART_H

#include "private.h"
#include "owners.h"

#include <petscksp.h>

struct hm_petsc {
    MPI_Comm comm;
    int rank, size;
    int64_t number; /* of this system, the same on all processes */
    hm_part_mesh part_mesh;
    hm_mesh mesh; /* views of the caller's arrays */
    void *part_block, *equations_block;
    hm_private_part* part;
    hm_private_equations* equations;
    hm_private_equations_info info;
    uint8_t* owned; /* [points] */
    double tolerance;
    int32_t boundary_edges;
    uint64_t bytes;

    PetscInt width;    /* scalars of PETSc for each unknown, see scalars.h */
    PetscInt own_rows; /* rows of this process, in scalars */
    int64_t unknowns;  /* number of unknowns of all processes */
    Mat matrix;
    KSP solver;
    Vec local; /* [unknowns of this process * width] */
    VecScatter to_local;
};

static hm_status take_part(hm_petsc* system, const hm_part_mesh* part, hm_error* err) {
    hm_private_part_mesh view = {sizeof view};
    size_t bytes = 0;
    hm_status status;
    if (part == NULL || !is_struct_size(part->struct_size) || part->mesh == NULL ||
        !is_struct_size(part->mesh->struct_size)) {
        return refuse_argument(err, "part or part.mesh is NULL, or a struct_size is wrong");
    }
    memcpy(&system->part_mesh, part, known_bytes(part->struct_size, sizeof *part));
    memcpy(&system->mesh, part->mesh, known_bytes(part->mesh->struct_size, sizeof system->mesh));
    system->part_mesh.mesh = &system->mesh;
    if (system->mesh.n_points == 0 && system->mesh.n_cells == 0) {
        return refuse(err, HM_BAD_MESH,
                      "this process has no cells: make a communicator of the processes that have "
                      "(MPI_Comm_split)");
    }
    view.mesh = &system->mesh;
    view.numbers = part->numbers;
    view.ghosts = part->ghosts;
    status = hm_private_part_size(&view, &bytes, err);
    if (status < 0) return status;
    system->part_block = malloc(bytes);
    if (system->part_block == NULL) return no_memory(err);
    system->bytes += bytes;
    return hm_private_part_init(&system->part, system->part_block, bytes, &view, err);
}

/* Makes edges [n] of this part, which the caller frees. */
static hm_status take_edges(const hm_petsc* system, hm_private_edge** edges, int32_t* n,
                            hm_error* err) {
    hm_private_part_edges(system->part, NULL, 0, n, NULL);
    *edges = room_for((size_t)*n, sizeof **edges);
    if (*edges == NULL) return no_memory(err);
    return hm_private_part_edges(system->part, *edges, *n, n, err);
}

static int by_number(const void* a, const void* b) {
    const int64_t p = *(const int64_t*)a, q = *(const int64_t*)b;
    return p < q ? -1 : p > q;
}

/* The points of own and ghost cells, with the role that each has here: records [returned], point
 * [returned]. role [points] is that of hm_private_part_points; border [n_border] contains the
 * sorted global numbers of the ends of edges with one own cell. */
static int64_t list_points(const hm_petsc* system, const uint8_t* role, const int64_t* border,
                           size_t n_border, named* records, int32_t* point) {
    const int64_t stride = system->mesh.points.stride == 0 ? 1 : system->mesh.points.stride;
    int64_t k, n = 0;
    for (k = 0; k < system->mesh.n_points; ++k) {
        const int64_t number = system->part_mesh.numbers[k];
        if (role[k] == 0) continue;
        records[n].name = number;
        records[n].x = system->mesh.points.x[k * stride];
        records[n].y = system->mesh.points.y[k * stride];
        records[n].process = system->rank;
        records[n].role = GHOST;
        if (role[k] == 2) {
            records[n].role = bsearch(&number, border, n_border, sizeof *border, by_number) == NULL
                                  ? INSIDE
                                  : ON_BORDER;
        }
        point[n++] = (int32_t)k;
    }
    return n;
}

/* Sets system->owned to 1 at points that belong to this process. */
static hm_status own_points(hm_petsc* system, const hm_private_edge* edges, int32_t n_edges,
                            hm_error* err) {
    const size_t n = (size_t)system->mesh.n_points;
    named* records = room_for(n, sizeof *records);
    int64_t k, used = 0, *owner = room_for(n, sizeof *owner),
               *border = room_for(2 * (size_t)n_edges, sizeof *border);
    int32_t* point = room_for(n, sizeof *point);
    directory names;
    hm_status status = HM_OK;
    clear_directory(&names);
    system->owned = room_for(n, 1);
    if (records == NULL || owner == NULL || point == NULL || border == NULL ||
        system->owned == NULL) {
        status = no_memory(err);
    }
    if (status >= 0) {
        system->bytes += n;
        status = hm_private_part_points(system->part, system->owned,
                                        err); /* contains roles until the end */
    }
    status = agree(status, system->comm, err);
    if (status >= 0) {
        for (k = 0; k < n_edges; ++k) {
            border[2 * k] = edges[k].begin;
            border[2 * k + 1] = edges[k].end;
        }
        qsort(border, 2 * (size_t)n_edges, sizeof *border, by_number);
        used = list_points(system, system->owned, border, 2 * (size_t)n_edges, records, point);
        memset(system->owned, 0, n);
        status = look_up(&names, system->comm, used, records, owner, err);
    }
    for (k = 0; status >= 0 && k < used; ++k) system->owned[point[k]] = owner[k] == system->rank;
    end_directory(&names);
    free(records);
    free(owner);
    free(point);
    free(border);
    return status;
}

/* Sends edges [left] of this process to all processes. The caller frees *all [*n_all]. */
static hm_status gather_edges(const hm_petsc* system, mail* post, const void* edges, int64_t left,
                              hm_private_edge** all, int32_t* n_all, hm_error* err) {
    int *counts = room_for(2 * (size_t)system->size, sizeof *counts), own = (int)left, p;
    int64_t total = 0;
    hm_status status = agree(counts == NULL ? no_memory(err) : HM_OK, system->comm, err);
    if (status >= 0) {
        MPI_Allgather(&own, 1, MPI_INT, counts, 1, MPI_INT, system->comm);
        for (p = 0; p < system->size; ++p) {
            counts[system->size + p] = (int)(total <= INT_MAX ? total : 0);
            total += counts[p];
        }
        if (total <= INT_MAX / 4) *all = room_for((size_t)total, sizeof **all);
        status = agree(*all == NULL ? no_memory(err) : HM_OK, system->comm, err);
    }
    if (status >= 0) {
        *n_all = (int32_t)total;
        MPI_Allgatherv(edges, own, post->record, *all, counts, counts + system->size, post->record,
                       system->comm);
    }
    free(counts);
    return status;
}

/* Compares edges [n] of all processes, each pair on one of them. *all [*n_all], which the caller
 * frees, receives those that are left, the same on all processes. */
static hm_status gather_boundary(const hm_petsc* system, const hm_private_edge* edges, int32_t n,
                                 hm_private_edge** all, int32_t* n_all, hm_error* err) {
    mail post;
    void* in = NULL;
    int* to = room_for((size_t)n, sizeof *to);
    int64_t k, left = 0;
    hm_status status = agree(to == NULL ? no_memory(err) : HM_OK, system->comm, err);
    clear_mail(&post);
    for (k = 0; status >= 0 && k < n; ++k) {
        to[k] = process_of((uint64_t)edges[k].begin ^ (uint64_t)edges[k].end, system->size);
    }
    if (status >= 0) status = begin_mail(&post, system->comm, n, to, err);
    if (status >= 0) status = deliver(&post, edges, sizeof *edges, &in, err);
    if (status >= 0) {
        left = post.n_in;
        status = agree(hm_private_match_edges(in, &left, err), system->comm, err);
    }
    if (status >= 0) status = gather_edges(system, &post, in, left, all, n_all, err);
    end_mail(&post);
    free(in);
    free(to);
    return status;
}

#endif
