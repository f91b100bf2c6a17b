/* Morphs a mesh of three dimensions that is one cell thick in y: an O-mesh around an ellipse in the
 * plane x-z, and a copy of it. */
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
    hm_memory of_plane = {0}, of_curve = {0}, first = {0}, second = {0};
    const int32_t wall = WALL;

    /* README: the mesh of the plane */
    hm_space_mesh space;
    HM_INIT(space);
    space.n_points = N;
    space.points = (hm_space_points){x, y, z, 1};
    space.n_faces = (NI - 1) * (NJ - 1);
    space.face_points = faces;
    space.n_sides = 2 * (NI - 1);
    space.side_points = sides;
    space.side_markers = side_markers;
    hm_plane* plane;
    hm_mesh mesh;
    HM_INIT(mesh);
    check(hm_plane_init(&plane, &of_plane, &space, &error), &error);
    of_plane.block = malloc(of_plane.bytes);
    check(hm_plane_init(&plane, &of_plane, &space, &error), &error);
    check(hm_plane_mesh(plane, &mesh, &error), &error);
    /* end */

    hm_fit_options fit;
    HM_INIT(fit);
    fit.n_control = 12;
    fit.closed = HM_PERIODIC;
    const hm_curves* curves;
    check(hm_fit_marker(&curves, &of_curve, &mesh, 1, &wall, &fit, NULL, &error), &error);
    of_curve.block = malloc(of_curve.bytes);
    check(hm_fit_marker(&curves, &of_curve, &mesh, 1, &wall, &fit, NULL, &error), &error);
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
    hm_setup setup;
    HM_INIT(setup);
    check(hm_setup_init(&setup, &first, &problem, NULL, &error), &error);
    first.block = malloc(first.bytes);
    check(hm_setup_init(&setup, &first, &problem, NULL, &error), &error);
    check(hm_setup_solve(&setup, &second, NULL, &error), &error);
    second.block = malloc(second.bytes);
    check(hm_setup_solve(&setup, &second, NULL, &error), &error);
    const hm_basis* const basis = setup.basis;

    double move[2 * 12] = {0}, gradient[2 * 12];
    for (int i = 0; i < 12; ++i) move[2 * i + 1] = curves->control[2 * i + 1] > 0.05 ? 0.1 : 0;
    /* README: all points move, and all derivatives count */
    hm_space_points from = {x, y, z, 1}, dj = {dj_dx, dj_dy, dj_dz, 1};
    hm_space_points_out to = {x, y, z, 1};
    check(hm_plane_morph(plane, basis, move, &from, &to, NULL, &error), &error);
    check(hm_plane_adjoint(plane, basis, &dj, gradient, NULL, &error), &error);
    /* end */

    hm_points moved = {x, z, 1};
    hm_quality_report quality;
    HM_INIT(quality);
    check(hm_assess(basis, &mesh, &moved, NULL, NULL, NULL, NULL, &quality, &error), &error);
    int apart = 0;
    for (int k = 0; k < LAYER; ++k)
        apart += x[k] != x[k + LAYER] || z[k] != z[k + LAYER] || y[k + LAYER] != 1;
    printf("one cell thick: %d inverted cells, %d points left their opposites\n", quality.inverted,
           apart);
    return quality.inverted > 0 || apart > 0;
}
