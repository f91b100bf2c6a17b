/* usage: speed NI NJ CONTROL   Milliseconds of the library with one thread and the baseline kernel,
 * one line for each part; speed.mjs prints the same lines for WebAssembly. The mesh consists of
 * rings round an ellipse. */
#define _POSIX_C_SOURCE 199309L
#include "../../c_api/memory.h"

#include <harmorph.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static hm_error error;
static void check(hm_status status) {
    if (status >= 0) return;
    fprintf(stderr, "%s: %s\n", hm_status_name(status), error.text);
    exit(1);
}
static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}
/* Each part is repeated until it has taken 2 s, three times at least; the shortest time counts. */
#define MEASURE(name, body)                                              \
    do {                                                                 \
        double best = 1e300, all = 0;                                    \
        int runs;                                                        \
        for (runs = 0; runs < 3 || (all < 2000 && runs < 200); ++runs) { \
            const double begun = now();                                  \
            double took;                                                 \
            body;                                                        \
            took = now() - begun;                                        \
            all += took;                                                 \
            if (took < best) best = took;                                \
        }                                                                \
        printf("%s %.4f\n", name, best);                                 \
        fflush(stdout);                                                  \
    } while (0)

static hm_analysis* analysis;
static hm_plan* plan;
static hm_basis* basis;
static void* blocks[3];

static void prepare(const hm_problem* problem, const hm_options* options) {
    hm_memory memory;
    int k;
    for (k = 0; k < 3; ++k) free(blocks[k]);
    check(hm_analysis_init(NULL, emptied(&memory), problem, options, &error));
    check(hm_analysis_init(&analysis, &(hm_memory){blocks[0] = malloc(memory.bytes), memory.bytes},
                           problem, options, &error));
    check(hm_plan_init(NULL, emptied(&memory), analysis, &error));
    check(hm_plan_init(&plan, &(hm_memory){blocks[1] = malloc(memory.bytes), memory.bytes},
                       analysis, &error));
    check(hm_basis_init(NULL, emptied(&memory), analysis, &error));
    check(hm_basis_init(&basis, &(hm_memory){blocks[2] = malloc(memory.bytes), memory.bytes},
                        analysis, &error));
}

int main(int count, char** arguments) {
    const int ni = count > 1 ? atoi(arguments[1]) : 513, nj = count > 2 ? atoi(arguments[2]) : 193;
    const int n = ni * nj, n_control = count > 3 ? atoi(arguments[3]) : 20;
    double *xy = malloc(16 * (size_t)n), *moved = malloc(16 * (size_t)n),
           *move = calloc((size_t)n_control, 16);
    int32_t *lists = malloc(8 * (size_t)ni), start[3], markers[] = {1, 2};
    int i, j;
    hm_memory memory;
    hm_mesh mesh;
    hm_fit_options fit;
    hm_condition wall;
    hm_problem problem;
    hm_executor executor;
    hm_options options;
    hm_step_report step;
    hm_quality_report quality;
    const hm_curves* curves;
    hm_points points, by;
    hm_points_out to;
    HM_INIT(mesh);
    HM_INIT(fit);
    HM_INIT(wall);
    HM_INIT(problem);
    HM_INIT(executor);
    HM_INIT(options);
    HM_INIT(step);
    HM_INIT(quality);
    for (j = 0; j < nj; ++j) {
        const double r = exp(3.0 * j / (nj - 1));
        for (i = 0; i < ni; ++i) {
            const double angle = 6.283185307179586 * (i % (ni - 1)) / (ni - 1);
            xy[2 * (i + ni * j)] = (r + 0.6 / r) * cos(angle);
            xy[2 * (i + ni * j) + 1] = (r - 0.6 / r) * sin(angle);
        }
    }
    for (i = 0; i < ni; ++i) lists[i] = i, lists[ni + i] = i + ni * (nj - 1);
    start[0] = 0, start[1] = ni, start[2] = 2 * ni;
    points.x = xy, points.y = xy + 1, points.stride = 2;
    by.x = to.x = moved, by.y = to.y = moved + 1, by.stride = to.stride = 2;
    mesh.n_points = n, mesh.points = points, mesh.cell_layout = HM_CELLS_STRUCTURED, mesh.ni = ni,
    mesh.nj = nj;
    mesh.n_lists = 2, mesh.list_start = start, mesh.list_points = lists,
    mesh.list_markers = markers;
    fit.n_control = n_control, fit.closed = HM_PERIODIC;
    check(hm_fit(NULL, emptied(&memory), NULL, ni - 1, 0, &fit, NULL, &error));
    check(hm_fit(&curves, &(hm_memory){malloc(memory.bytes), memory.bytes}, &points, ni - 1, 1,
                 &fit, NULL, &error));
    wall.marker = 1, wall.n_curves = 1;
    problem.mesh = &mesh, problem.curves = curves, problem.n_conditions = 1,
    problem.conditions = &wall;
    executor.kernel = HM_KERNEL_BASELINE;
    options.executor = &executor;
    for (i = 0; i < n_control; ++i) move[2 * i + 1] = 0.01 * (i % 3);
    MEASURE("analysis", prepare(&problem, &options));
    MEASURE("factor", check(hm_plan_factor(plan, NULL, &error)));
    MEASURE("solution", check(hm_plan_solve(plan, basis, NULL, &error)));
    MEASURE("morph", check(hm_morph(basis, move, NULL, &to, &executor, &error)));
    MEASURE("adjoint", check(hm_adjoint(basis, &by, move, &executor, &error)));
    MEASURE("assessment",
            check(hm_assess(basis, &mesh, NULL, &by, NULL, &executor, &step, &quality, &error)));
    MEASURE("together", prepare(&problem, &options); check(hm_plan_factor(plan, NULL, &error));
            check(hm_plan_solve(plan, basis, NULL, &error)));
    return 0;
}
