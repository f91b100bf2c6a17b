/* Steps of a shape optimisation, as an adjoint solver does them. In each step the derivatives with
 * respect to the mesh points become derivatives with respect to the control points; the exact
 * admissible step limits the movement; then the mesh moves. The objective needs no flow: the area
 * of the body becomes 10 % larger, with the smallest movement of the control points. */
#include <harmorph.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { NI = 128, NJ = 49, N = NI * NJ, CELLS = NI * (NJ - 1), WALL = 1, FAR = 2, CONTROL = 12 };
static double x[N], y[N], dx[N], dy[N], gx[N], gy[N];
static int32_t cells[4 * CELLS], faces[4 * NI], markers[2 * NI];

static void check(hm_status status, const hm_error* error) {
    if (status >= 0) return;
    fprintf(stderr, "%s: %s\n", hm_status_name(status), error->text);
    exit(1);
}

/* Quadrilaterals around an ellipse, as a list of cells and a list of faces; points are counted from
 * 1, as in a Fortran code. */
static void make_mesh(void) {
    for (int j = 0; j < NJ; ++j) {
        for (int i = 0; i < NI; ++i) {
            double angle = 6.283185307179586 * i / NI, r = exp(3.0 * j / (NJ - 1));
            int point = i + NI * j, next = (i + 1) % NI + NI * j;
            x[point] = (r + 0.6 / r) * cos(angle);
            y[point] = (r - 0.6 / r) * sin(angle);
            if (j < NJ - 1) {
                int32_t cell[] = {point + 1, point + NI + 1, next + NI + 1, next + 1};
                for (int k = 0; k < 4; ++k) cells[4 * point + k] = cell[k];
            }
            if (j == 0 || j == NJ - 1) {
                int face = j == 0 ? i : NI + i;
                faces[2 * face] = point + 1;
                faces[2 * face + 1] = next + 1;
                markers[face] = j == 0 ? WALL : FAR;
            }
        }
    }
}

/* The area inside the wall, and the derivatives of the area with respect to the mesh points, which
 * are 0 away from the wall. */
static double area(double* by_x, double* by_y) {
    double sum = 0;
    for (int k = 0; k < N; ++k) by_x[k] = by_y[k] = 0;
    for (int i = 0; i < NI; ++i) {
        int next = (i + 1) % NI, before = (i + NI - 1) % NI;
        sum += 0.5 * (x[i] * y[next] - x[next] * y[i]);
        by_x[i] = 0.5 * (y[next] - y[before]);
        by_y[i] = 0.5 * (x[before] - x[next]);
    }
    return sum;
}

int main(void) {
    make_mesh();
    hm_mesh mesh;
    HM_INIT(mesh);
    mesh.index_base = 1;
    mesh.n_points = N;
    mesh.points = (hm_points){x, y, 1};
    mesh.cell_layout = HM_CELLS_QUADS;
    mesh.n_cells = CELLS;
    mesh.cell_points = cells;
    mesh.n_faces = 2 * NI;
    mesh.face_points = faces;
    mesh.face_markers = markers;
    hm_fit_options fit;
    HM_INIT(fit);
    fit.n_control = CONTROL;
    fit.closed = HM_PERIODIC;
    const hm_curves* curves;
    hm_error error;
    hm_memory of_curve = {0}, first = {0}, second = {0};
    const int32_t wall = WALL;
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

    const hm_points by_points = {gx, gy, 1}, displacement = {dx, dy, 1};
    const hm_points_out to_displacement = {dx, dy, 1}, to_mesh = {x, y, 1};
    const double wanted = 1.1 * area(gx, gy);
    double missing = wanted;
    int inverted = 0, step;
    for (step = 0; step < 20; ++step) {
        missing = wanted - area(gx, gy);
        printf("step %d: area missing %.3e\n", step, missing);
        if (fabs(missing) < 1e-10 * wanted) break;

        double move[2 * CONTROL], square = 0;
        /* The derivatives of the area with respect to the control points. */
        check(hm_adjoint(basis, &by_points, move, NULL, &error), &error);
        for (int k = 0; k < 2 * CONTROL; ++k) square += move[k] * move[k];
        for (int k = 0; k < 2 * CONTROL; ++k) move[k] *= missing / square;
        check(hm_morph(basis, move, NULL, &to_displacement, NULL, &error), &error);
        hm_step_report limit;
        HM_INIT(limit);
        check(hm_assess(basis, &mesh, NULL, &displacement, NULL, NULL, &limit, NULL, &error),
              &error);
        for (int k = 0; k < 2 * CONTROL; ++k) move[k] *= fmin(1, 0.5 * limit.admissible);
        check(hm_morph(basis, move, &mesh.points, &to_mesh, NULL, &error), &error);

        hm_quality_report quality;
        HM_INIT(quality);
        check(hm_assess(basis, &mesh, NULL, NULL, NULL, NULL, NULL, &quality, &error), &error);
        inverted += quality.inverted;
    }
    printf("%d inverted cells on the way\n", inverted);
    return !(inverted == 0 && fabs(missing) < 1e-10 * wanted);
}
