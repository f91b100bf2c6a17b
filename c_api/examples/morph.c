/* Morphs a structured O-mesh around an ellipse: fit, solve once, move as often as wanted. */
#include <harmorph.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { NI = 129, NJ = 49, WALL = 1, FAR = 2 };
static double x[NI * NJ], y[NI * NJ], dx[NI * NJ], dy[NI * NJ];
static hm_error error;

static void check(hm_status status) {
    if (status >= 0) return;
    fprintf(stderr, "%s: %s\n", hm_status_name(status), error.text);
    exit(1);
}

int main(void) {
    int32_t lists[2 * NI], start[] = {0, NI, 2 * NI}, markers[] = {WALL, FAR};
    for (int k = 0; k < NI * NJ; ++k) {
        double angle = 6.283185307179586 * (k % NI % (NI - 1)) / (NI - 1),
               r = exp(3.0 * (k / NI) / (NJ - 1));
        x[k] = (r + 0.6 / r) * cos(angle);
        y[k] = (r - 0.6 / r) * sin(angle);
    }
    for (int i = 0; i < NI; ++i) lists[i] = i, lists[NI + i] = i + NI * (NJ - 1);
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

    /* A periodic cubic B-spline with 12 control points through the points of the wall. */
    size_t bytes, work;
    hm_fit_options fit;
    HM_INIT(fit);
    fit.n_control = 12;
    fit.closed = HM_PERIODIC;
    const hm_curves* curves;
    check(hm_fit_marker_size(&mesh, 1, markers, &fit, &bytes, &work, &error));
    check(hm_fit_marker(&curves, malloc(bytes), bytes, &mesh, 1, markers, &fit, NULL, malloc(work),
                        work, &error));

    /* One function for each control point. A morph then needs only the basis. */
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
    check(hm_analysis_size(&problem, NULL, &bytes, &error));
    check(hm_analysis_init(&analysis, malloc(bytes), bytes, &problem, NULL, &error));
    check(hm_plan_size(analysis, &bytes, &error));
    check(hm_plan_init(&plan, malloc(bytes), bytes, analysis, &error));
    check(hm_basis_size(analysis, &bytes, &error));
    check(hm_basis_init(&basis, malloc(bytes), bytes, analysis, &error));
    check(hm_plan_factor(plan, NULL, &error));
    check(hm_plan_solve(plan, basis, NULL, &error));

    /* The upper control points go up. The displacements are judged before the mesh moves. */
    double move[2 * 12] = {0};
    for (int i = 0; i < 12; ++i) move[2 * i + 1] = curves->control[2 * i + 1] > 0 ? 0.1 : 0;
    hm_points displacement = {dx, dy, 1};
    hm_points_out to_displacement = {dx, dy, 1}, to_mesh = {x, y, 1};
    hm_step_report step;
    hm_quality_report quality;
    HM_INIT(step);
    HM_INIT(quality);
    check(hm_morph(basis, move, NULL, &to_displacement, NULL, &error));
    check(hm_assess(basis, &mesh, NULL, &displacement, NULL, NULL, &step, &quality, &error));
    printf("%d inverted cells; the mesh could follow %.1f times as far\n", quality.inverted,
           step.admissible);
    if (quality.inverted > 0) return 1;
    check(hm_morph(basis, move, &mesh.points, &to_mesh, NULL, &error));
    return 0;
}
