/* Morphs a structured O-mesh round an ellipse: fit, solve once, move control points as often as
 * wished. */
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
    hm_mesh mesh = {.struct_size = sizeof mesh,
                    .n_points = NI * NJ,
                    .points = {x, y, 1},
                    .ni = NI,
                    .nj = NJ,
                    .cell_layout = HM_CELLS_STRUCTURED,
                    .n_lists = 2,
                    .list_start = start,
                    .list_points = lists,
                    .list_markers = markers};
    hm_error error;
    size_t bytes;

    /* A periodic cubic B-spline with 12 control points through the wall's points. */
    hm_fit_options fit = {.struct_size = sizeof fit, .n_control = 12, .closed = HM_PERIODIC};
    const hm_curves* curves;
    check(hm_fit_size(NI - 1, &fit, &bytes, &error), &error);
    check(hm_fit(&curves, malloc(bytes), bytes, &mesh.points, NI - 1, 1, &fit, NULL, &error),
          &error);

    /* One harmonic function for each control point; analysis and plan may be freed after the
     * solution. */
    hm_condition on_curve = {
        .struct_size = sizeof on_curve, .marker = WALL, .kind = HM_ON_CURVE, .n_curves = 1};
    hm_problem problem = {.struct_size = sizeof problem,
                          .mesh = &mesh,
                          .curves = curves,
                          .n_conditions = 1,
                          .conditions = &on_curve};
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

    /* The upper control points go up: displacement first, to see how far the mesh could follow;
     * then the morph. */
    double move[2 * 12] = {0}, dx[NI * NJ], dy[NI * NJ];
    for (int i = 0; i < 12; ++i) move[2 * i + 1] = curves->control[2 * i + 1] > 0 ? 0.1 : 0;
    hm_points displacement = {dx, dy, 1};
    hm_points_out to_displacement = {dx, dy, 1}, to_mesh = {x, y, 1};
    hm_step_report step = {.struct_size = sizeof step};
    check(hm_morph(basis, move, NULL, &to_displacement, NULL, &error), &error);
    check(hm_assess(basis, &mesh, NULL, &displacement, NULL, NULL, &step, NULL, &error), &error);
    check(hm_morph(basis, move, &mesh.points, &to_mesh, NULL, &error), &error);

    hm_quality_report quality = {.struct_size = sizeof quality};
    check(hm_assess(basis, &mesh, NULL, NULL, NULL, NULL, NULL, &quality, &error), &error);
    printf("%d inverted cells; the mesh could follow %.1f times as far\n", quality.inverted,
           step.admissible);
    return quality.inverted > 0;
}
