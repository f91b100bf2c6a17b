/* A solver with three dimensions and a mesh one cell thick in y: an O-mesh round an ellipse in the
 * plane x-z, twice. */
#include <harmorph.h>
#include <harmorph_space.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { NI = 97, NJ = 33, LAYER = NI * NJ, N = 2 * LAYER, WALL = 1, FAR = 2 };
static double x[N], y[N], z[N], dj_dx[N], dj_dy[N], dj_dz[N];
static int32_t faces[4 * (NI - 1) * (NJ - 1)], sides[4 * 2 * (NI - 1)], side_markers[2 * (NI - 1)];

static void check(hm_status status, const hm_error* error) {
    if (status >= 0) return;
    fprintf(stderr, "%s: %s\n", hm_status_name(status), error->text);
    exit(1);
}

/* Points, the faces of the plane y = 0, and the faces of the boundary from one plane to the other.
 */
static void make_mesh(void) {
    int32_t *face = faces, *side = sides;
    for (int k = 0; k < N; ++k) {
        int i = k % NI, j = k / NI % NJ;
        double angle = 6.283185307179586 * (i % (NI - 1)) / (NI - 1), r = exp(3.0 * j / (NJ - 1));
        x[k] = (r + 0.6 / r) * cos(angle);
        y[k] = k / LAYER;
        z[k] = (r - 0.6 / r) * sin(angle);
    }
    for (int j = 0; j < NJ; ++j) {
        for (int i = 0; i + 1 < NI; ++i) {
            int a = i + NI * j;
            int cell[] = {a, a + 1, a + 1 + NI, a + NI},
                across[] = {a, a + 1, a + 1 + LAYER, a + LAYER};
            for (int c = 0; c < 4 && j + 1 < NJ; ++c) *face++ = cell[c];
            if (j > 0 && j + 1 < NJ) continue;
            side_markers[(side - sides) / 4] = j == 0 ? WALL : FAR;
            for (int c = 0; c < 4; ++c) *side++ = across[c];
        }
    }
}

int main(void) {
    make_mesh();
    hm_error error;
    size_t bytes;

    /* README: the mesh of the plane */
    hm_space_mesh space = {.struct_size = sizeof space,
                           .n_points = N,
                           .points = {x, y, z, 1},
                           .n_faces = (NI - 1) * (NJ - 1),
                           .face_points = faces,
                           .n_sides = 2 * (NI - 1),
                           .side_points = sides,
                           .side_markers = side_markers};
    hm_plane* plane;
    hm_mesh mesh = {.struct_size = sizeof mesh};
    check(hm_plane_size(&space, &bytes, &error), &error);
    check(hm_plane_init(&plane, malloc(bytes), bytes, &space, &error), &error);
    check(hm_plane_mesh(plane, &mesh, &error), &error);
    /* end */

    hm_fit_options fit = {.struct_size = sizeof fit, .n_control = 12, .closed = HM_PERIODIC};
    const hm_curves* curves;
    check(hm_fit_size(NI - 1, &fit, &bytes, &error), &error);
    check(hm_fit(&curves, malloc(bytes), bytes, &mesh.points, NI - 1, 1, &fit, NULL, &error),
          &error);
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

    double move[2 * 12] = {0}, gradient[2 * 12];
    for (int i = 0; i < 12; ++i) move[2 * i + 1] = curves->control[2 * i + 1] > 0 ? 0.1 : 0;
    /* README: all points move, and all derivatives count */
    hm_space_points from = {x, y, z, 1}, dj = {dj_dx, dj_dy, dj_dz, 1};
    hm_space_points_out to = {x, y, z, 1};
    check(hm_plane_morph(plane, basis, move, &from, &to, NULL, &error), &error);
    check(hm_plane_adjoint(plane, basis, &dj, gradient, NULL, &error), &error);
    /* end */

    hm_points moved = {x, z, 1};
    hm_quality_report quality = {.struct_size = sizeof quality};
    check(hm_assess(basis, &mesh, &moved, NULL, NULL, NULL, NULL, &quality, &error), &error);
    int apart = 0;
    for (int k = 0; k < LAYER; ++k)
        apart += x[k] != x[k + LAYER] || z[k] != z[k + LAYER] || y[k + LAYER] != 1;
    printf("one cell thick: %d inverted cells, %d points left their opposites\n", quality.inverted,
           apart);
    return quality.inverted > 0 || apart > 0;
}
