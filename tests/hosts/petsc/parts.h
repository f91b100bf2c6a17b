/* Cuts a mesh, which the tests have as a whole, into the parts of processes. */
#ifndef TESTS_PETSC_PARTS_H
#define TESTS_PETSC_PARTS_H

#include <harmorph_petsc.h>

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
    int64_t* numbers;
    uint8_t* ghosts;
    hm_mesh mesh;
    hm_part_mesh part;
} own_part;

enum { STRIPES_X, STRIPES_Y, BISECTION, RANDOM, PARTITIONER, GHOSTS, N_PARTITIONS };
extern const char* const partition_names[N_PARTITIONS];

/* part_of [n_cells], to be freed: the same on all processes. Collective: PETSc's partitioner
 * (SCOTCH or ParMETIS; where PETSc has neither, bisection) works in parallel. */
int* partition(const whole_mesh* whole, int kind, int size);
/* Global numbers: neither consecutive nor in the order of the mesh. */
int64_t number_of(int32_t point);
void take_part(own_part* part, const whole_mesh* whole, const int* part_of, int rank,
               int with_ghosts);
/* The views of the arrays, after these have changed. */
void refer(own_part* part);
void free_part(own_part* part);

#endif
