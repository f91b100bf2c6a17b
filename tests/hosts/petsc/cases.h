/* Problems on whole meshes, and their functions by the direct engine, which process 0 has. */
#ifndef TESTS_PETSC_CASES_H
#define TESTS_PETSC_CASES_H

#include "parts.h"

enum { TOP = 2, RIGHT = 3, LEFT = 4, BOTTOM = 5 }; /* markers; the moving wall is WALL */

typedef struct reference {
    char name[120];
    whole_mesh mesh;
    hm_mesh view;
    void* curves_block;
    hm_condition conditions[4];
    hm_problem problem; /* refers to the above: a reference stays where it is */
    hm_options options;
    void* basis_block; /* of process 0 */
    hm_basis* basis;
    int32_t functions, controls, numbers; /* of the basis, on all processes */
} reference;

/* O-mesh round an ellipse, with a seam, that is, a cut. first: height of the first layer, 0: cells
 * of like sides. The wall is on a curve of four control points, from which its points are off. */
void make_o_mesh(reference* serial, int32_t ni, int32_t nj, double first, int32_t operator_kind);
/* Two units long, one high and in the middle `arch` higher, with a bump on the lower wall, which is
 * on a curve; the sides are straight. */
void make_channel(reference* serial, double arch, int32_t operator_kind);
/* A rectangle with a hole, whose outline is on a curve: a passage of a cascade. TOP and BOTTOM are
 * translates. Points inside the hole are in no cell. */
void make_passage(reference* serial, int32_t operator_kind);
/* The airfoil of an SU2 file: the marker whose name does not begin with "far" is on a fitted curve.
 */
void make_from_file(reference* serial, const char* file, int32_t operator_kind);
void free_case(reference* serial);

/* A further condition on another marker. */
hm_condition* add_condition(reference* serial, int32_t marker, int32_t kind);

/* Collective. */
void solve_whole(reference* serial);
/* One number of one function of `basis`, which process 0 has, at all points [n_points]: on all
 * processes. */
void whole_values(const reference* serial, const hm_basis* basis, int32_t function, int32_t number,
                  double* values);
/* The plan of the direct engine, factored; *blocks [2] are to be freed. */
hm_plan* make_plan(reference* serial, void** blocks, hm_analysis** analysis);

#endif
