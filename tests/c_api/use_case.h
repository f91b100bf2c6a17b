/* What use.c counts, and the meshes that it begins with. */
#ifndef HARMORPH_TESTS_USE_CASE_H
#define HARMORPH_TESTS_USE_CASE_H

#include "memory.h"

#include <harmorph.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    AROUND = 96,
    RINGS = 33,
    POINTS = AROUND * RINGS,
    CELLS = AROUND * (RINGS - 1),
    CONTROL = 14
};
enum { BODY = 7, FAR_FIELD = 9 }; /* markers are any integers */

static double x[POINTS], y[POINTS], x_new[POINTS], y_new[POINTS];
static int32_t cells[4 * CELLS], faces[4 * AROUND], markers[2 * AROUND];

static int passed, failed;

static void check(int holds, const char* what, const hm_error* error) {
    if (holds) {
        ++passed;
        return;
    }
    ++failed;
    printf("use: %s", what);
    if (error->code != HM_OK)
        printf(" (%s: %s, item %d)", hm_status_name(error->code), error->text, (int)error->item);
    printf("\n");
}

/* What cannot go on without. */
static void require(hm_status status, const char* what, const hm_error* error) {
    check(status == HM_OK, what, error);
    if (status != HM_OK) {
        printf("%d passed, %d failed\n", passed, failed);
        exit(1);
    }
}

static void* block_of(size_t bytes) {
    void* block = malloc(bytes);
    if (block == NULL) exit(1);
    return block;
}

static double absolute(double value) { return value < 0 ? -value : value; }

/* A repeatable sequence in [-1, 1). */
static double noise(void) {
    static uint32_t state = 1;
    state = 1664525u * state + 1013904223u;
    return (double)(state >> 8) / 8388608.0 - 1;
}

/* Rings round a body that Joukowski's mapping makes of a circle: round in front, slender and
 * rounded behind, chord about 1. Cells are quads; points count from 1, as a Fortran code would have
 * them. */
static hm_mesh make_mesh(void) {
    /* cos and sin of 2 pi / AROUND, by which the unit vector turns from column to column */
    const double turn_x = 0.99785892323860348, turn_y = 0.065403129230143069;
    double unit_x = 1, unit_y = 0, factor = 1;
    hm_mesh mesh;
    HM_INIT(mesh);
    int i, j, k;
    for (i = 0; i < AROUND; ++i) {
        const double next_x = unit_x * turn_x - unit_y * turn_y;
        factor = 1;
        for (j = 0; j < RINGS; ++j, factor *= 1.12) {
            const double r = 1.2 * factor;
            const double a = r * unit_x - 0.08, b = r * unit_y, square = a * a + b * b;
            x[j * AROUND + i] = 0.25 * (a + a / square);
            y[j * AROUND + i] = 0.25 * (b - b / square);
        }
        unit_y = unit_x * turn_y + unit_y * turn_x;
        unit_x = next_x;
    }
    for (j = 0, k = 0; j < RINGS - 1; ++j) {
        for (i = 0; i < AROUND; ++i, k += 4) {
            const int next = (i + 1) % AROUND;
            cells[k] = 1 + j * AROUND + i;
            cells[k + 1] = 1 + (j + 1) * AROUND + i;
            cells[k + 2] = 1 + (j + 1) * AROUND + next;
            cells[k + 3] = 1 + j * AROUND + next;
        }
    }
    for (i = 0; i < AROUND; ++i) {
        const int next = (i + 1) % AROUND, outer = (RINGS - 1) * AROUND;
        faces[2 * i] = 1 + i;
        faces[2 * i + 1] = 1 + next;
        markers[i] = BODY;
        faces[2 * (AROUND + i)] = 1 + outer + i;
        faces[2 * (AROUND + i) + 1] = 1 + outer + next;
        markers[AROUND + i] = FAR_FIELD;
    }
    mesh.index_base = 1;
    mesh.n_points = POINTS;
    mesh.points.x = x;
    mesh.points.y = y;
    mesh.cell_layout = HM_CELLS_QUADS;
    mesh.n_cells = CELLS;
    mesh.cell_points = cells;
    mesh.n_faces = 2 * AROUND;
    mesh.face_points = faces;
    mesh.face_markers = markers;
    return mesh;
}

/* Cells of both kinds, in two arrays: the same mesh with the quads of the innermost ring split into
 * triangles. */
static hm_mesh with_triangles(hm_mesh mesh) {
    static int32_t triangles[6 * AROUND];
    int k;
    for (k = 0; k < AROUND; ++k) {
        const int32_t* const quad = cells + 4 * k;
        const int32_t halves[6] = {quad[0], quad[1], quad[2], quad[0], quad[2], quad[3]};
        memcpy(triangles + 6 * k, halves, sizeof halves);
    }
    mesh.cell_layout = HM_CELLS_MIXED;
    mesh.n_cells = CELLS + AROUND;
    mesh.cell_points = triangles;
    mesh.n_quads = CELLS - AROUND;
    mesh.quad_points = cells + 4 * AROUND;
    return mesh;
}

#endif
