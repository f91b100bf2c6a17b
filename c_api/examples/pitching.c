/* Pitches an airfoil about its quarter chord, as a time-dependent solver does: 1000 steps, two
 * periods. Every mesh is made from the first one, so errors do not accumulate: at angle 0 the first
 * mesh is back, bit by bit. The velocities of the control points give those of the mesh points in
 * the same way. */
#include <harmorph.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    NI = 129,
    NJ = 49,
    N = NI * NJ,
    WALL = 1,
    FAR = 2,
    CONTROL = 16,
    STEPS = 1000,
    PERIOD = 500
};
static const double two_pi = 6.283185307179586, amplitude = 10 * 6.283185307179586 / 360,
                    pivot = -0.8;
static double x_first[N], y_first[N], x[N], y[N], x_before[N], y_before[N], x_after[N], y_after[N],
    vx[N], vy[N];

static void check(hm_status status, const hm_error* error) {
    if (status >= 0) return;
    fprintf(stderr, "%s: %s\n", hm_status_name(status), error->text);
    exit(1);
}

/* A structured O-mesh around an ellipse of chord 3.2. */
static void make_mesh(void) {
    for (int j = 0; j < NJ; ++j) {
        for (int i = 0; i < NI; ++i) {
            double angle = two_pi * (i % (NI - 1)) / (NI - 1), r = exp(3.0 * j / (NJ - 1));
            x_first[i + NI * j] = (r + 0.6 / r) * cos(angle);
            y_first[i + NI * j] = (r - 0.6 / r) * sin(angle);
        }
    }
}

static double angle_at(double step) {
    return amplitude * sin(two_pi * fmod(step, PERIOD) / PERIOD);
}

/* The movements of the control points that rotate them by the angle about the pivot. */
static void turn(const double* control, double angle, double* move) {
    for (int i = 0; i < CONTROL; ++i) {
        double px = control[2 * i] - pivot, py = control[2 * i + 1];
        move[2 * i] = (cos(angle) - 1) * px + sin(angle) * py;
        move[2 * i + 1] = (cos(angle) - 1) * py - sin(angle) * px;
    }
}

static void velocity(const double* control, double angle, double rate, double* speed) {
    for (int i = 0; i < CONTROL; ++i) {
        double px = control[2 * i] - pivot, py = control[2 * i + 1];
        speed[2 * i] = rate * (-sin(angle) * px + cos(angle) * py);
        speed[2 * i + 1] = rate * (-sin(angle) * py - cos(angle) * px);
    }
}

int main(void) {
    make_mesh();
    int32_t lists[2 * NI], start[] = {0, NI, 2 * NI}, markers[] = {WALL, FAR};
    for (int i = 0; i < NI; ++i) {
        lists[i] = i;
        lists[NI + i] = i + NI * (NJ - 1);
    }
    hm_mesh mesh;
    HM_INIT(mesh);
    mesh.n_points = N;
    mesh.points = (hm_points){x_first, y_first, 1};
    mesh.cell_layout = HM_CELLS_STRUCTURED;
    mesh.ni = NI;
    mesh.nj = NJ;
    mesh.n_lists = 2;
    mesh.list_start = start;
    mesh.list_points = lists;
    mesh.list_markers = markers;
    hm_fit_options fit;
    HM_INIT(fit);
    fit.n_control = CONTROL;
    fit.closed = HM_PERIODIC;
    const hm_curves* curves;
    hm_error error;
    hm_memory of_curve = {0}, first = {0}, second = {0};
    check(hm_fit_marker(&curves, &of_curve, &mesh, 1, markers, &fit, NULL, &error), &error);
    of_curve.block = malloc(of_curve.bytes);
    check(hm_fit_marker(&curves, &of_curve, &mesh, 1, markers, &fit, NULL, &error), &error);

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

    const hm_points now = {x, y, 1};
    const hm_points_out to_now = {x, y, 1}, to_velocity = {vx, vy, 1};
    const hm_points_out to_before = {x_before, y_before, 1}, to_after = {x_after, y_after, 1};
    double move[2 * CONTROL], least_quality = 1, rigid = 0, slip = 0;
    int returned = 0, inverted = 0;
    for (int step = 0; step <= STEPS; ++step) {
        const double angle = angle_at(step),
                     rate = amplitude * two_pi / PERIOD * cos(two_pi * step / PERIOD);
        turn(curves->control, angle, move);
        check(hm_morph(basis, move, &mesh.points, &to_now, NULL, &error), &error);
        velocity(curves->control, angle, rate, move);
        check(hm_morph(basis, move, NULL, &to_velocity, NULL, &error), &error);
        /* Here a solver would take its time step, with (x, y) and the velocities (vx, vy) of the
         * mesh. */

        hm_quality_report quality;
        HM_INIT(quality);
        check(hm_assess(basis, &mesh, &now, NULL, &mesh.points, NULL, NULL, &quality, &error),
              &error);
        inverted += quality.inverted;
        least_quality = fmin(least_quality, quality.min_quality);
        if (step % (PERIOD / 2) == 0 && angle == 0) {
            returned += memcmp(x, x_first, sizeof x) == 0 && memcmp(y, y_first, sizeof y) == 0;
        }
        for (int i = 0; i < NI; ++i) {
            double px = x_first[i] - pivot, py = y_first[i];
            rigid = fmax(rigid, fabs(x[i] - pivot - cos(angle) * px - sin(angle) * py));
            rigid = fmax(rigid, fabs(y[i] - cos(angle) * py + sin(angle) * px));
        }
        turn(curves->control, angle_at(step + 0.5), move);
        check(hm_morph(basis, move, &mesh.points, &to_after, NULL, &error), &error);
        turn(curves->control, angle_at(step + PERIOD - 0.5), move);
        check(hm_morph(basis, move, &mesh.points, &to_before, NULL, &error), &error);
        for (int k = 0; k < N; ++k) {
            slip = fmax(slip, fabs(x_after[k] - x_before[k] - vx[k]) +
                                  fabs(y_after[k] - y_before[k] - vy[k]));
        }
    }
    printf("%d steps of +-10 degrees: %d inverted cells, least quality %.2f\n", STEPS, inverted,
           least_quality);
    printf("back at angle 0: the first mesh bit by bit, %d of 3 times\n", returned);
    printf("wall: at most %.1e from a rigid motion; velocities: at most %.1e from differences\n",
           rigid, slip);
    return !(inverted == 0 && returned == 3 && rigid < 1e-3 && slip < 1e-5);
}
