/* Cuts a mesh, which the tests have as a whole, into the parts of processes; and the functions of the direct engine. */
#ifndef PETSC_CASE_H
#define PETSC_CASE_H

#include "mpi_case.h"

#include <harmorph_petsc.h>

#include <string.h>

enum { STRIPES, RANDOM, BISECTION, GHOSTS, N_PARTITIONS };
static const char *const partition_names[] = {"stripes", "random cells", "recursive bisection",
                                              "stripes with ghost cells"};

/* Cells as quads, a triangle repeats its last point; faces with markers. */
typedef struct whole_mesh {
    int32_t n_points, n_cells, n_faces;
    double *x, *y;
    int32_t *cells, *faces, *markers;
} whole_mesh;

/* The arrays of one process. */
typedef struct own_part {
    int32_t n_points, n_cells, n_faces, *global, *cells, *faces, *markers;
    double *x, *y;
    int64_t *numbers;
    uint8_t *ghosts;
    hm_mesh mesh;
    hm_part_mesh part;
} own_part;

static uint32_t mixed(uint32_t k) {
    k = (k ^ (k >> 16)) * 0x45d9f3bu;
    k = (k ^ (k >> 16)) * 0x45d9f3bu;
    return k ^ (k >> 16);
}

/* Global numbers: neither consecutive nor in the order of the mesh. */
static int64_t number_of(int32_t point) { return 2 * (int64_t)(point ^ 5) + 11; }

static const double *sorted_by;
static int by_value(const void *a, const void *b) {
    const double p = sorted_by[*(const int32_t *)a], q = sorted_by[*(const int32_t *)b];
    return p < q ? -1 : p > q;
}

/* Halves along x and y in turn; number of parts 1 .. 4. */
static void bisect(const double *cx, const double *cy, int32_t *cells, int32_t n, int first, int parts, int level,
                   int *part_of) {
    int32_t k, half;
    if (parts == 1) {
        for (k = 0; k < n; ++k) part_of[cells[k]] = first;
        return;
    }
    sorted_by = level % 2 == 0 ? cx : cy;
    qsort(cells, (size_t)n, sizeof *cells, by_value);
    half = (int32_t)((int64_t)n * (parts / 2) / parts);
    bisect(cx, cy, cells, half, first, parts / 2, level + 1, part_of);
    bisect(cx, cy, cells + half, n - half, first + parts / 2, parts - parts / 2, level + 1, part_of);
}

static int *partition(const whole_mesh *of, int kind, int size) {
    int *part_of = room(sizeof *part_of * (size_t)of->n_cells);
    double *cx = room(sizeof *cx * (size_t)of->n_cells), *cy = room(sizeof *cy * (size_t)of->n_cells);
    int32_t *order = room(sizeof *order * (size_t)of->n_cells), k;
    for (k = 0; k < of->n_cells; ++k) {
        const int32_t a = of->cells[4 * k], c = of->cells[4 * k + 2];
        cx[k] = of->x[a] + of->x[c];
        cy[k] = of->y[a] + of->y[c];
        order[k] = k;
        part_of[k] =
            kind == RANDOM ? (int)(mixed((uint32_t)k) % (uint32_t)size) : (int)((int64_t)k * size / of->n_cells);
    }
    if (kind == BISECTION) bisect(cx, cy, order, of->n_cells, 0, size, 0, part_of);
    free(cx);
    free(cy);
    free(order);
    return part_of;
}

static void refer(own_part *its) {
    hm_mesh mesh = {sizeof mesh};
    hm_part_mesh part = {sizeof part};
    mesh.n_points = its->n_points;
    mesh.points.x = its->x;
    mesh.points.y = its->y;
    mesh.cell_layout = HM_CELLS_QUADS;
    mesh.n_cells = its->n_cells;
    mesh.cell_points = its->cells;
    mesh.n_faces = its->n_faces;
    mesh.face_points = its->faces;
    mesh.face_markers = its->markers;
    its->mesh = mesh;
    part.mesh = &its->mesh;
    part.numbers = its->numbers;
    part.ghosts = its->ghosts;
    its->part = part;
}

static void take_part(own_part *its, const whole_mesh *of, const int *part_of, int rank, int with_ghosts) {
    const size_t n = (size_t)of->n_points;
    int32_t *local = room(sizeof *local * n), k, c;
    uint8_t *touched = calloc(n, 1);
    memset(its, 0, sizeof *its);
    its->global = room(sizeof *its->global * n);
    its->x = room(sizeof *its->x * n);
    its->y = room(sizeof *its->y * n);
    its->numbers = room(sizeof *its->numbers * n);
    its->cells = room(sizeof *its->cells * 4 * (size_t)of->n_cells);
    its->faces = room(sizeof *its->faces * 2 * (size_t)of->n_faces);
    its->markers = room(sizeof *its->markers * (size_t)of->n_faces);
    its->ghosts = with_ghosts ? calloc((size_t)of->n_cells, 1) : NULL;
    memset(local, -1, sizeof *local * n);
    for (k = 0; k < 4 * of->n_cells; ++k) {
        if (part_of[k / 4] == rank) touched[of->cells[k]] = 1;
    }
    for (k = 0; k < of->n_cells; ++k) {
        int wanted = part_of[k] == rank;
        for (c = 0; c < 4; ++c) wanted = wanted || (with_ghosts && touched[of->cells[4 * k + c]]);
        if (!wanted) continue;
        if (with_ghosts) its->ghosts[its->n_cells] = part_of[k] != rank;
        for (c = 0; c < 4; ++c) {
            const int32_t point = of->cells[4 * k + c];
            if (local[point] < 0) {
                local[point] = its->n_points++;
                its->global[local[point]] = point;
                its->x[local[point]] = of->x[point];
                its->y[local[point]] = of->y[point];
                its->numbers[local[point]] = number_of(point);
            }
            its->cells[4 * its->n_cells + c] = local[point];
        }
        ++its->n_cells;
    }
    /* A face belongs to the part whose own cell has both ends side by side. */
    for (k = 0; k < of->n_cells; ++k) {
        if (part_of[k] != rank) continue;
        for (c = 0; c < 4; ++c) touched[of->cells[4 * k + c]] = 2;
    }
    {
        int32_t *first = room(sizeof *first * (n + 2)), *list = room(sizeof *list * 4 * (size_t)of->n_cells), f;
        memset(first, 0, sizeof *first * (n + 2));
        for (k = 0; k < 4 * of->n_cells; ++k) ++first[of->cells[k] + 1];
        for (k = 0; k < of->n_points; ++k) first[k + 1] += first[k];
        for (k = 0; k < 4 * of->n_cells; ++k)
            list[first[of->cells[k]]++] = k / 4; /* now first[p] is where p's list ends */
        for (f = 0; f < of->n_faces; ++f) {
            const int32_t a = of->faces[2 * f], b = of->faces[2 * f + 1];
            for (k = a > 0 ? first[a - 1] : 0; k < first[a]; ++k) {
                const int32_t *const cell = of->cells + 4 * list[k];
                int is_side = 0;
                for (c = 0; c < 4; ++c) {
                    const int32_t p = cell[c], q = cell[(c + 1) % 4];
                    is_side = is_side || (p == a && q == b) || (p == b && q == a);
                }
                if (!is_side || part_of[list[k]] != rank) continue;
                its->faces[2 * its->n_faces] = local[a];
                its->faces[2 * its->n_faces + 1] = local[b];
                its->markers[its->n_faces++] = of->markers[f];
                break;
            }
        }
        free(first);
        free(list);
    }
    free(local);
    free(touched);
    refer(its);
}

static void free_part(own_part *its) {
    free(its->global);
    free(its->x);
    free(its->y);
    free(its->numbers);
    free(its->cells);
    free(its->faces);
    free(its->markers);
    free(its->ghosts);
}

#endif
