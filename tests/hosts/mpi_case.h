/* A problem that every process makes for itself, an O-mesh round an ellipse with the wall on a
 * periodic cubic, and the calls up to a basis. A refusal ends all processes with the reason. */
#ifndef MPI_CASE_H
#define MPI_CASE_H

#include "../c_api/memory.h"

#include <harmorph_mpi.h>
#include <private.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { WALL = 1, FAR_FIELD = 2 };

typedef struct problem_case {
    int32_t n_points, n_functions;
    double *x, *y;
    int32_t *lists, start[3], markers[2];
    hm_mesh mesh;
    hm_fit_options fit;
    const hm_curves* curves;
    hm_condition on_curve;
    hm_problem problem;
    hm_options options;
} problem_case;

static void need(hm_status status, const hm_error* error) {
    if (status >= 0) return;
    fprintf(stderr, "%s: %s\n", hm_status_name(status), error->text);
    MPI_Abort(MPI_COMM_WORLD, 1);
}

static void* room(size_t bytes) {
    void* block = malloc(bytes > 0 ? bytes : 1);
    if (block == NULL) MPI_Abort(MPI_COMM_WORLD, 1);
    return block;
}

static void make_case(problem_case* made, int32_t ni, int32_t nj, int32_t n_functions,
                      int32_t operator_kind) {
    hm_mesh mesh = {sizeof mesh};
    hm_fit_options fit = {sizeof fit};
    hm_condition on_curve = {sizeof on_curve};
    hm_problem problem = {sizeof problem};
    hm_options options = {sizeof options};
    hm_error error;
    hm_memory memory;
    int32_t i, j;
    made->n_points = ni * nj;
    made->n_functions = n_functions;
    made->x = room(sizeof *made->x * (size_t)made->n_points);
    made->y = room(sizeof *made->y * (size_t)made->n_points);
    made->lists = room(sizeof *made->lists * 2 * (size_t)ni);
    for (j = 0; j < nj; ++j) {
        for (i = 0; i < ni; ++i) {
            const double angle = 6.283185307179586 * (i % (ni - 1)) / (ni - 1),
                         r = exp(3.0 * j / (nj - 1));
            made->x[i + ni * j] = (r + 0.6 / r) * cos(angle);
            made->y[i + ni * j] = (r - 0.6 / r) * sin(angle);
        }
    }
    for (i = 0; i < ni; ++i) {
        made->lists[i] = i;
        made->lists[ni + i] = i + ni * (nj - 1);
    }
    made->start[0] = 0;
    made->start[1] = ni;
    made->start[2] = 2 * ni;
    made->markers[0] = WALL;
    made->markers[1] = FAR_FIELD;
    mesh.n_points = made->n_points;
    mesh.points.x = made->x;
    mesh.points.y = made->y;
    mesh.cell_layout = HM_CELLS_STRUCTURED;
    mesh.ni = ni;
    mesh.nj = nj;
    mesh.n_lists = 2;
    mesh.list_start = made->start;
    mesh.list_points = made->lists;
    mesh.list_markers = made->markers;
    made->mesh = mesh;
    fit.n_control = n_functions;
    fit.closed = HM_PERIODIC;
    made->fit = fit;
    need(hm_fit(NULL, emptied(&memory), NULL, ni - 1, 0, &fit, NULL, &error), &error);
    need(hm_fit(&made->curves, &(hm_memory){room(memory.bytes), memory.bytes},
                &(hm_points){made->x, made->y, 1}, ni - 1, 1, &fit, NULL, &error),
         &error);
    on_curve.marker = WALL;
    on_curve.kind = HM_ON_CURVE;
    on_curve.n_curves = 1;
    made->on_curve = on_curve;
    problem.mesh = &made->mesh;
    problem.curves = made->curves;
    problem.n_conditions = 1;
    problem.conditions = &made->on_curve;
    made->problem = problem;
    options.operator_kind = operator_kind;
    made->options = options;
}

/* The stages before the solution, and their blocks. */
typedef struct solver {
    void *analysis_block, *plan_block;
    hm_analysis* analysis;
    hm_plan* plan;
    size_t bytes; /* of both */
} solver;

static void make_solver(solver* made, const problem_case* setup) {
    hm_error error;
    hm_memory memory;
    need(hm_analysis_init(NULL, emptied(&memory), &setup->problem, &setup->options, &error),
         &error);
    made->bytes = memory.bytes;
    made->analysis_block = memory.block = room(memory.bytes);
    need(hm_analysis_init(&made->analysis, &memory, &setup->problem, &setup->options, &error),
         &error);
    need(hm_plan_init(NULL, emptied(&memory), made->analysis, &error), &error);
    made->bytes += memory.bytes;
    made->plan_block = memory.block = room(memory.bytes);
    need(hm_plan_init(&made->plan, &memory, made->analysis, &error), &error);
    need(hm_plan_factor(made->plan, NULL, &error), &error);
}

static void free_solver(solver* made) {
    free(made->analysis_block);
    free(made->plan_block);
}

/* Functions first .. first+n-1, solved, in a block of their own. */
static inline hm_basis* solve_share(solver* with, int32_t first, int32_t n, void** block) {
    hm_error error;
    hm_basis* share = NULL;
    size_t bytes;
    need(hm_private_share_size(with->analysis, first, n, &bytes, &error), &error);
    *block = room(bytes);
    need(hm_private_share_init(&share, *block, bytes, with->analysis, first, n, &error), &error);
    need(hm_plan_solve(with->plan, share, NULL, &error), &error);
    return share;
}

/* The rows of these points, solved on all processes together, in a block of their own. */
static hm_status solve_rows(solver* with, int32_t n, const int32_t* points, hm_basis** rows,
                            void** block, hm_solve_report* report, hm_error* error) {
    hm_memory memory;
    need(hm_mpi_solve(NULL, emptied(&memory), NULL, with->analysis, n, NULL, NULL, MPI_COMM_WORLD,
                      error),
         error);
    *block = memory.block = room(memory.bytes);
    return hm_mpi_solve(rows, &memory, with->plan, with->analysis, n, points, report,
                        MPI_COMM_WORLD, error);
}

#endif
