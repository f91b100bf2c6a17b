/* Morphs an unstructured mesh around an airfoil with a sharp trailing edge. The mesh is a list of
 * triangles, and a list of boundary faces with markers; points and faces are in no order.
 * hm_fit_marker finds the order of the wall points and the trailing edge. */
#include <harmorph.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum {
    AROUND = 120,
    LAYERS = 40,
    N = AROUND * (LAYERS + 1),
    CELLS = 2 * AROUND * LAYERS,
    FACES = 2 * AROUND,
    AIRFOIL = 7,
    FAR = 3
};
static double x[N], y[N], dx[N], dy[N];
static int32_t cells[3 * CELLS], faces[2 * FACES], face_markers[FACES];

static void check(hm_status status, const hm_error* error) {
    if (status >= 0) return;
    fprintf(stderr, "%s: %s\n", hm_status_name(status), error->text);
    exit(1);
}

/* The number of point i of layer j. 1009 is a prime number that does not divide N, so the numbers
 * are all different; neighbours have distant numbers, as in files of mesh generators. */
static int32_t point(int i, int j) { return (i % AROUND + AROUND * j) * 1009 % N; }

static void make_mesh(void) {
    for (int j = 0; j <= LAYERS; ++j) {
        for (int i = 0; i < AROUND; ++i) {
            /* Joukowski's map of a circle around -0.1 through 1: a section of chord 4. */
            const double angle = 6.283185307179586 * i / AROUND, r = 1.1 * exp(2.5 * j / LAYERS),
                         p = r * cos(angle) - 0.1, q = r * sin(angle), square = p * p + q * q;
            x[point(i, j)] = p * (1 + 1 / square);
            y[point(i, j)] = q * (1 - 1 / square);
        }
    }
    int32_t* corner = cells;
    for (int j = 0; j < LAYERS; ++j) {
        for (int i = 0; i < AROUND; ++i) {
            const int32_t a = point(i, j), b = point(i, j + 1), c = point(i + 1, j + 1),
                          d = point(i + 1, j);
            const int32_t upper[] = {a, b, c, a, c, d}, lower[] = {a, b, d, b, c, d};
            for (int k = 0; k < 6; ++k) *corner++ = i < AROUND / 2 ? upper[k] : lower[k];
        }
    }
    /* Faces of the airfoil and of the far field by turns, those of each around the body in steps of
     * 49 faces, in either direction. */
    for (int k = 0; k < FACES; ++k) {
        const int i = 49 * (k / 2) % AROUND, j = k % 2 == 0 ? 0 : LAYERS, turned = k % 3 == 0;
        faces[2 * k] = point(i + turned, j);
        faces[2 * k + 1] = point(i + !turned, j);
        face_markers[k] = j == 0 ? AIRFOIL : FAR;
    }
}

int main(void) {
    make_mesh();
    hm_mesh mesh;
    HM_INIT(mesh);
    mesh.n_points = N;
    mesh.points = (hm_points){x, y, 1};
    mesh.cell_layout = HM_CELLS_TRIANGLES;
    mesh.n_cells = CELLS;
    mesh.cell_points = cells;
    mesh.n_faces = FACES;
    mesh.face_points = faces;
    mesh.face_markers = face_markers;

    /* A cubic B-spline with 20 control points through the points of the marker. */
    const int32_t airfoil = AIRFOIL;
    const hm_curves* curves;
    hm_fit_report fit;
    HM_INIT(fit);
    hm_error error;
    hm_memory of_curve = {0}, first = {0}, second = {0};
    check(hm_fit_marker(&curves, &of_curve, &mesh, 1, &airfoil, NULL, &fit, &error), &error);
    of_curve.block = malloc(of_curve.bytes);
    check(hm_fit_marker(&curves, &of_curve, &mesh, 1, &airfoil, NULL, &fit, &error), &error);

    hm_condition on_curves;
    HM_INIT(on_curves);
    on_curves.marker = AIRFOIL;
    on_curves.kind = HM_ON_CURVE;
    on_curves.n_curves = curves->n_curves;
    hm_problem problem;
    HM_INIT(problem);
    problem.mesh = &mesh;
    problem.curves = curves;
    problem.n_conditions = 1;
    problem.conditions = &on_curves;
    hm_setup setup;
    HM_INIT(setup);
    check(hm_setup_init(&setup, &first, &problem, NULL, &error), &error);
    first.block = malloc(first.bytes);
    check(hm_setup_init(&setup, &first, &problem, NULL, &error), &error);
    check(hm_setup_solve(&setup, &second, NULL, &error), &error);
    second.block = malloc(second.bytes);
    check(hm_setup_solve(&setup, &second, NULL, &error), &error);
    const hm_basis* const basis = setup.basis;

    /* The section gets a camber of 5 % of the chord; leading and trailing edge stay. */
    double* move = malloc(2 * (size_t)curves->n_control * sizeof *move);
    for (int32_t i = 0; i < curves->n_control; ++i) {
        const double px = curves->control[2 * i];
        move[2 * i] = 0;
        move[2 * i + 1] = 0.2 * fmax(0, 1 - px * px / 4);
    }
    const hm_points displacement = {dx, dy, 1};
    const hm_points_out to_displacement = {dx, dy, 1}, to_mesh = {x, y, 1};
    hm_step_report step;
    hm_quality_report quality;
    HM_INIT(step);
    HM_INIT(quality);
    check(hm_morph(basis, move, NULL, &to_displacement, NULL, &error), &error);
    check(hm_assess(basis, &mesh, NULL, &displacement, NULL, NULL, &step, &quality, &error),
          &error);
    printf(
        "unstructured: %s trailing edge, %d inverted cells, smallest quality %.2f; the mesh "
        "could follow %.1f times as far\n",
        fit.closed == HM_TIED ? "sharp" : "no sharp", (int)quality.inverted, quality.min_quality,
        step.admissible);
    if (fit.closed != HM_TIED || quality.inverted > 0) return 1;
    check(hm_morph(basis, move, &mesh.points, &to_mesh, NULL, &error), &error);
    return 0;
}
