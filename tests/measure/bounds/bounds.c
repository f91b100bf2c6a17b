/* Measures the processor time of hm_quality_bounds with derivatives, in multiples of that of
 * hm_assess, on meshes of triangles, of quadrilaterals, and of polygons with four and six corners.
 * usage: bounds [points around] [repeats] */
#include <harmorph_quality.h>
#include <harmorph_space.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { WALL = 1, FAR = 2, QUADS = 0, STRUCTURED = 1, TRIANGLES = 2, POLYGONS = 3, HEXAGONS = 4 };
static const char* const layouts[] = {"quadrilaterals", "structured", "triangles", "polygons",
                                      "hexagons"};

static void check(hm_status status, const hm_error* error) {
    if (status >= 0) return;
    fprintf(stderr, "%s: %s\n", hm_status_name(status), error->text);
    exit(1);
}

static double now(void) {
    struct timespec at;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &at);
    return (double)at.tv_sec + 1e-9 * (double)at.tv_nsec;
}

static void* reserve(size_t bytes) {
    void* block = malloc(bytes);
    if (block == NULL) exit(1);
    return block;
}

/* The time of the fastest of several runs. */
#define MEASURE(result, repeats, call)                  \
    do {                                                \
        int run_;                                       \
        result = 1e30;                                  \
        for (run_ = 0; run_ < (repeats); ++run_) {      \
            double const begun_ = now();                \
            double taken_;                              \
            check(call, &error);                        \
            taken_ = now() - begun_;                    \
            result = taken_ < result ? taken_ : result; \
        }                                               \
    } while (0)

static void measure(int layout, int ni, int nj, int repeats) {
    int const n_points = ni * nj, n_quads = (ni - 1) * (nj - 1);
    double* x = reserve(6 * (size_t)n_points * sizeof(double));
    double *y = x + n_points, *dx = y + n_points, *dy = dx + n_points, *to_x = dy + n_points,
           *to_y = to_x + n_points;
    double* gradient = reserve(4 * (size_t)n_points * sizeof(double));
    int32_t* cells = reserve(6 * (size_t)n_quads * sizeof(int32_t));
    int32_t* rows = reserve(2 * (size_t)n_quads * sizeof(int32_t));
    int32_t* lists = reserve(2 * (size_t)ni * sizeof(int32_t));
    int32_t start[3], markers[2] = {WALL, FAR};
    int i, j, n = 0;
    double assess_time, bounds_time[4];
    size_t bytes;
    hm_error error;
    hm_mesh mesh;
    hm_condition given;
    hm_problem problem;
    hm_analysis* analysis;
    hm_basis* basis;
    hm_quality* quality;
    hm_step_report step;
    hm_quality_report report;
    hm_bound bounds[6];
    hm_bound_value values[6];
    hm_points displacement, at;
    hm_points_out gradients[2];
    for (j = 0; j < nj; ++j) {
        for (i = 0; i < ni; ++i) {
            int const k = i + ni * j;
            double const angle = 6.283185307179586 * (i % (ni - 1)) / (ni - 1),
                         r = exp(3.0 * j / (nj - 1));
            x[k] = (r + 0.6 / r) * cos(angle);
            y[k] = (r - 0.6 / r) * sin(angle);
            dx[k] = 0.02 * sin(3 * y[k]) / r;
            dy[k] = 0.02 * cos(2 * x[k]) / r;
            to_x[k] = x[k] + dx[k];
            to_y[k] = y[k] + dy[k];
        }
    }
    for (j = 0; j < nj - 1; ++j) {
        for (i = 0; i < ni - 1; ++i) {
            int32_t const a = i + ni * j, b = a + 1, c = b + ni, d = a + ni;
            int32_t const quad[] = {a, b, c, d}, halves[] = {a, b, c, a, c, d};
            if (layout == HEXAGONS) {
                int32_t const six[] = {a, b, b + 1, c + 1, c, d};
                if (i % 2 == 1) continue;
                memcpy(cells + 6 * n, six, sizeof six);
                rows[n] = 6 * n;
            } else if (layout == TRIANGLES) {
                memcpy(cells + 6 * n, halves, sizeof halves);
            } else {
                memcpy(cells + 4 * n, quad, sizeof quad);
                rows[n] = 4 * n;
            }
            ++n;
        }
    }
    rows[n] = (layout == HEXAGONS ? 6 : 4) * n;
    for (i = 0; i < ni; ++i) {
        lists[i] = i;
        lists[ni + i] = i + ni * (nj - 1);
    }
    start[0] = 0;
    start[1] = ni;
    start[2] = 2 * ni;
    HM_INIT(mesh);
    mesh.n_points = n_points;
    mesh.points.x = x;
    mesh.points.y = y;
    mesh.cell_points = cells;
    mesh.n_cells = layout == TRIANGLES ? 2 * n : n;
    mesh.cell_layout = layout == TRIANGLES    ? HM_CELLS_TRIANGLES
                       : layout == STRUCTURED ? HM_CELLS_STRUCTURED
                       : layout >= POLYGONS   ? HM_CELLS_POLYGONS
                                              : HM_CELLS_QUADS;
    mesh.ni = layout == STRUCTURED ? ni : 0;
    mesh.nj = layout == STRUCTURED ? nj : 0;
    if (layout == STRUCTURED) mesh.cell_points = NULL;
    if (layout >= POLYGONS) mesh.cell_start = rows;
    mesh.n_lists = 2;
    mesh.list_start = start;
    mesh.list_points = lists;
    mesh.list_markers = markers;
    HM_INIT(given);
    given.marker = WALL;
    given.kind = HM_GIVEN;
    HM_INIT(problem);
    problem.mesh = &mesh;
    problem.n_conditions = 1;
    problem.conditions = &given;
    check(hm_analysis_size(&problem, NULL, &bytes, &error), &error);
    check(hm_analysis_init(&analysis, reserve(bytes), bytes, &problem, NULL, &error), &error);
    check(hm_basis_size(analysis, &bytes, &error), &error);
    check(hm_basis_init(&basis, reserve(bytes), bytes, analysis, &error), &error);
    check(hm_quality_size(basis, &mesh, &bytes, &error), &error);
    check(hm_quality_init(&quality, reserve(bytes), bytes, basis, &mesh, NULL, &error), &error);

    memset(&displacement, 0, sizeof displacement);
    displacement.x = dx;
    displacement.y = dy;
    at = displacement;
    at.x = to_x;
    at.y = to_y;
    HM_INIT(step);
    HM_INIT(report);
    for (i = 0; i < 6; ++i) {
        HM_INIT(bounds[i]);
        HM_INIT(values[i]);
        bounds[i].kind = i;
    }
    bounds[1].kind = HM_BOUND_AREA;
    memset(gradients, 0, sizeof gradients);
    gradients[0].x = gradient;
    gradients[0].y = gradient + n_points;
    gradients[1].x = gradient + 2 * n_points;
    gradients[1].y = gradient + 3 * n_points;
    MEASURE(assess_time, repeats,
            hm_assess(basis, &mesh, NULL, &displacement, NULL, NULL, &step, &report, &error));
    MEASURE(bounds_time[0], repeats,
            hm_quality_bounds(quality, &at, 2, bounds, values, NULL, NULL, &error));
    MEASURE(bounds_time[1], repeats,
            hm_quality_bounds(quality, &at, 1, bounds, values, gradients, NULL, &error));
    MEASURE(bounds_time[2], repeats,
            hm_quality_bounds(quality, &at, 1, bounds + 1, values, gradients, NULL, &error));
    MEASURE(bounds_time[3], repeats,
            hm_quality_bounds(quality, &at, 2, bounds, values, gradients, NULL, &error));
    printf("%-14s %8d %8.2f ms %9.2f %9.2f %9.2f %9.2f   %.3f <= %.3f (hm_assess %.3f)\n",
           layouts[layout], (int)mesh.n_cells, 1e3 * assess_time, bounds_time[0] / assess_time,
           bounds_time[1] / assess_time, bounds_time[2] / assess_time, bounds_time[3] / assess_time,
           values[0].bound, values[0].extreme, report.min_quality);
}

int main(int argc, char** argv) {
    int const around = argc > 1 ? atoi(argv[1]) : 641, repeats = argc > 2 ? atoi(argv[2]) : 20;
    int layout;
    printf("processor time, one thread; hm_quality_bounds in multiples of hm_assess\n");
    printf("%-14s %8s %11s %9s %9s %9s %9s\n", "layout", "cells", "hm_assess", "values", "quality",
           "areas", "both");
    for (layout = QUADS; layout <= HEXAGONS; ++layout) measure(layout, around, around / 4, repeats);
    return 0;
}
