/* Morphs a structured O-mesh around an ellipse: fit, solve once, move control points as often as
 * wanted. */
#include <harmorph.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { NI = 129, NJ = 49, WALL = 1, FAR = 2 };
static double x[NI * NJ], y[NI * NJ];

static void check(hm_status status, const hm_error* error) {
    if (status >= 0) return;
    fprintf(stderr, "%s: %s\n", hm_status_name(status), error->text);
    exit(1);
}

int main(void) {
    int32_t lists[2 * NI], start[] = {0, NI, 2 * NI}, markers[] = {WALL, FAR};
    for (int j = 0; j < NJ; ++j) {
        for (int i = 0; i < NI; ++i) {
            double angle = 6.283185307179586 * (i % (NI - 1)) / (NI - 1),
                   r = exp(3.0 * j / (NJ - 1));
            x[i + NI * j] = (r + 0.6 / r) * cos(angle);
            y[i + NI * j] = (r - 0.6 / r) * sin(angle);
        }
    }
    for (int i = 0; i < NI; ++i) {
        lists[i] = i;
        lists[NI + i] = i + NI * (NJ - 1);
    }
    hm_mesh mesh;
    HM_INIT(mesh);
    mesh.n_points = NI * NJ;
    mesh.points = (hm_points){x, y, 1};
    mesh.cell_layout = HM_CELLS_STRUCTURED;
    mesh.ni = NI;
    mesh.nj = NJ;
    mesh.n_lists = 2;
    mesh.list_start = start;
    mesh.list_points = lists;
    mesh.list_markers = markers;
    hm_error error;
    size_t bytes, work_bytes;

    /* A periodic cubic B-spline with 12 control points through the points of the wall. */
    hm_fit_options fit;
    HM_INIT(fit);
    fit.n_control = 12;
    fit.closed = HM_PERIODIC;
    const hm_curves* curves;
    check(hm_fit_marker_size(&mesh, 1, markers, &fit, &bytes, &work_bytes, &error), &error);
    void* work = malloc(work_bytes);
    check(hm_fit_marker(&curves, malloc(bytes), bytes, &mesh, 1, markers, &fit, NULL, work,
                        work_bytes, &error),
          &error);
    free(work);

    /* One function for each control point. Analysis and plan may be freed after the solution. */
    hm_condition on_curve;
    HM_INIT(on_curve);
    on_curve.marker = WALL;
    on_curve.kind = HM_ON_CURVE;
    on_curve.n_curves = 1;
    hm_problem problem;
    HM_INIT(problem);
    problem.mesh = &mesh;
    problem.curves = curves;
    problem.n_conditions = 1;
    problem.conditions = &on_curve;
    hm_analysis* analysis;
    hm_plan* plan;
    hm_basis* basis;
    check(hm_analysis_size(&problem, NULL, &bytes, &error), &error);
    check(hm_analysis_init(&analysis, malloc(bytes), bytes, &problem, NULL, &error), &error);
    check(hm_plan_size(analysis, &bytes, &error), &error);
    check(hm_plan_init(&plan, malloc(bytes), bytes, analysis, &error), &error);
    check(hm_basis_size(analysis, &bytes, &error), &error);
    check(hm_basis_init(&basis, malloc(bytes), bytes, analysis, &error), &error);
    check(hm_plan_factor(plan, NULL, &error), &error);
    check(hm_plan_solve(plan, basis, NULL, &error), &error);

    /* The upper control points go up. The displacements are computed and judged first: how far
     * the mesh could follow, and how good the cells will be. Then the mesh moves. */
    double move[2 * 12] = {0}, dx[NI * NJ], dy[NI * NJ];
    for (int i = 0; i < 12; ++i) move[2 * i + 1] = curves->control[2 * i + 1] > 0 ? 0.1 : 0;
    hm_points displacement = {dx, dy, 1};
    hm_points_out to_displacement = {dx, dy, 1}, to_mesh = {x, y, 1};
    hm_step_report step;
    hm_quality_report quality;
    HM_INIT(step);
    HM_INIT(quality);
    check(hm_morph(basis, move, NULL, &to_displacement, NULL, &error), &error);
    check(hm_assess(basis, &mesh, NULL, &displacement, NULL, NULL, &step, &quality, &error),
          &error);
    printf("%d inverted cells; the mesh could follow %.1f times as far\n", quality.inverted,
           step.admissible);
    if (quality.inverted > 0) return 1;
    check(hm_morph(basis, move, &mesh.points, &to_mesh, NULL, &error), &error);
    return 0;
}
