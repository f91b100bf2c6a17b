/* Morphs a structured O-mesh around an ellipse: fit, solve once, move as often as wanted. */
#include <harmorph.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { NI = 129, NJ = 49, WALL = 1, FAR = 2 };
static double x[NI * NJ], y[NI * NJ], dx[NI * NJ], dy[NI * NJ], move[2 * 12];
static int32_t lists[2 * NI], start[] = {0, NI, 2 * NI}, markers[] = {WALL, FAR};
static hm_error error;
static void check(hm_status status) {
    if (status < 0) exit((fprintf(stderr, "%s: %s\n", hm_status_name(status), error.text), 1));
}
int main(void) {
    for (int k = 0; k < NI * NJ; ++k) {
        double angle = 6.283185307179586 * (k % NI % (NI - 1)) / (NI - 1),
               r = exp(3.0 * (k / NI) / (NJ - 1));
        x[k] = (r + 0.6 / r) * cos(angle);
        y[k] = (r - 0.6 / r) * sin(angle);
    }
    for (int i = 0; i < NI; ++i) lists[i] = i, lists[NI + i] = i + NI * (NJ - 1);
    const hm_curves* curves;
    hm_points displacement = {dx, dy, 1};
    hm_points_out to_displacement = {dx, dy, 1}, to_mesh = {x, y, 1};
    hm_step_report step = {.struct_size = sizeof step};
    hm_quality_report quality = {.struct_size = sizeof quality};
    /* README: the kernel of this program */
    hm_mesh mesh = {sizeof mesh, .n_points = NI * NJ, .points = {x, y, 1}};
    mesh.cell_layout = HM_CELLS_STRUCTURED, mesh.ni = NI, mesh.nj = NJ, mesh.n_lists = 2;
    mesh.list_start = start, mesh.list_points = lists, mesh.list_markers = markers;

    /* A periodic cubic B-spline with 12 control points through the points of the wall. */
    hm_memory a = {0}, b = {0}, c = {0}; /* the first of two equal calls asks for the bytes */
    hm_fit_options fit = {sizeof fit, .n_control = 12, .closed = HM_PERIODIC};
    check(hm_fit_marker(&curves, &a, &mesh, 1, markers, &fit, NULL, &error));
    a.block = malloc(a.bytes);
    check(hm_fit_marker(&curves, &a, &mesh, 1, markers, &fit, NULL, &error));

    /* One function for each control point. */
    hm_condition wall = {sizeof wall, .marker = WALL, .kind = HM_ON_CURVE, .n_curves = 1};
    hm_problem problem = {sizeof problem, &mesh, curves, .n_conditions = 1, .conditions = &wall};
    hm_setup setup = {.struct_size = sizeof setup};
    check(hm_setup_init(&setup, &b, &problem, NULL, &error));
    b.block = malloc(b.bytes);
    check(hm_setup_init(&setup, &b, &problem, NULL, &error));
    check(hm_setup_solve(&setup, &c, NULL, &error));
    c.block = malloc(c.bytes);
    check(hm_setup_solve(&setup, &c, NULL, &error));

    /* The upper control points go up. The displacements are judged before the mesh moves. */
    for (int i = 0; i < 12; ++i) move[2 * i + 1] = curves->control[2 * i + 1] > 0.05 ? 0.1 : 0;
    check(hm_morph(setup.basis, move, NULL, &to_displacement, NULL, &error));
    check(hm_assess(setup.basis, &mesh, NULL, &displacement, NULL, NULL, &step, &quality, &error));
    if (quality.inverted == 0)
        check(hm_morph(setup.basis, move, &mesh.points, &to_mesh, NULL, &error));
    /* end */
    printf("%d inverted cells; the mesh could follow %.1f times as far\n", quality.inverted,
           step.admissible);
    return quality.inverted;
}
