/* design.f90 in C: a design loop with the mesh as a constraint. The flow solver is that of
 * potential.f90, which potential_c.f90 makes known to C by bind(C). The pressure of the airfoil at
 * a higher incidence is wanted, with 12 CST variables; area, thickness and the quality of the mesh
 * are constraints. The same loop without the mesh constraint ends in a refused morph. Lines with
 * names that begin with hm_ or HM_ touch harmorph. */
#include <harmorph_bases.h>
#include <harmorph_design.h>
#include <harmorph_quality.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    N = 12,
    M = 4,
    AIRFOIL = 1,
    CONTROL = 30
}; /* variables, constraints, marker, control points */

struct flow {
    int32_t points, cells, faces;
    double *x, *y;
    int32_t *cell_points, *face_points, *face_markers;
};
void flow_read(const char* file, struct flow* mesh);
void flow_want(double more);
double flow_objective(double* gx, double* gy);

static hm_error error;
static hm_mesh mesh;
static hm_basis* few;
static hm_quality* quality;
static const hm_quantity measured[2] = {{sizeof(hm_quantity), HM_AREA},
                                        {sizeof(hm_quantity), HM_THICKNESS, 0, 0.25}};
static struct flow flow;
static double *start_x, *start_y, *gx, *gy, *map, *by_points[2], *slopes;
static double start[2], first_j, j, g[N], c[M], by_variable[M][N];
static int control_points;

static void check(hm_status status) {
    if (status >= 0) return;
    fprintf(stderr, "%s: %s\n", hm_status_name(status), error.text);
    exit(1);
}
static void* reserve(size_t bytes) {
    void* block = malloc(bytes);
    if (block == NULL) exit(1);
    return block;
}
static void fail(const char* text) {
    fprintf(stderr, "%s\n", text);
    exit(1);
}
static double dot(const double* a, const double* b) {
    double sum = 0;
    int i;
    for (i = 0; i < N; ++i) sum += a[i] * b[i];
    return sum;
}

/* Done once: the functions of 6 variables on each side, and the mesh with which later ones are
 * compared. */
static void prepare(void) {
    static const int32_t airfoil = AIRFOIL;
    hm_memory of_curve = {NULL, 0}, first = {NULL, 0}, second = {NULL, 0}, work = {NULL, 0},
              combined = {NULL, 0}, compared = {NULL, 0};
    const hm_curves* curves;
    hm_setup setup = {sizeof setup};
    hm_fit_options fit = {sizeof fit, 0, CONTROL};
    hm_options options = {sizeof options, HM_LAPLACE};
    hm_condition on_curve = {sizeof on_curve, AIRFOIL, HM_ON_CURVE, 0, 1};
    hm_problem problem = {sizeof problem, &mesh, NULL, 1, &on_curve};
    hm_variables variables = {sizeof variables, HM_CST, N / 2, N / 2};
    hm_movement movement = {sizeof movement, HM_LINEAR};
    hm_section_move linear = {sizeof linear};
    HM_INIT(mesh);
    mesh.index_base = 1;
    mesh.n_points = flow.points;
    mesh.points = (hm_points){flow.x, flow.y, 1};
    mesh.cell_layout = HM_CELLS_QUADS;
    mesh.n_cells = flow.cells;
    mesh.cell_points = flow.cell_points;
    mesh.n_faces = flow.faces;
    mesh.face_points = flow.face_points;
    mesh.face_markers = flow.face_markers;
    check(hm_fit_marker(&curves, &of_curve, &mesh, 1, &airfoil, &fit, NULL, &error));
    of_curve.block = reserve(of_curve.bytes);
    check(hm_fit_marker(&curves, &of_curve, &mesh, 1, &airfoil, &fit, NULL, &error));
    problem.curves = curves;
    check(hm_setup_init(&setup, &first, &problem, &options, &error));
    first.block = reserve(first.bytes);
    check(hm_setup_init(&setup, &first, &problem, &options, &error));
    check(hm_setup_solve(&setup, &second, NULL, &error));
    second.block = reserve(second.bytes);
    check(hm_setup_solve(&setup, &second, NULL, &error));
    movement.variables = &variables;
    check(hm_move_section(curves, NULL, 1, &movement, NULL, &linear, &work, &error));
    work.block = reserve(work.bytes);
    control_points = curves->n_control;
    map = reserve(2 * N * (size_t)control_points * sizeof(double));
    linear.matrix = map;
    check(hm_move_section(curves, NULL, 1, &movement, NULL, &linear, &work, &error));
    check(hm_combine(&few, &combined, setup.basis, N, 2, map, &error));
    combined.block = reserve(combined.bytes);
    check(hm_combine(&few, &combined, setup.basis, N, 2, map, &error));
    check(hm_quality_init(&quality, &compared, few, &mesh, NULL, &error));
    compared.block = reserve(compared.bytes);
    check(hm_quality_init(&quality, &compared, few, &mesh, NULL, &error));
    check(hm_measure(curves, NULL, 2, measured, start, NULL, NULL, &error));
}

static void pairs_of(const double* v, double* pairs) {
    int i;
    for (i = 0; i < N; ++i) {
        pairs[2 * i] = v[i];
        pairs[2 * i + 1] = 0;
    }
}

/* Moves the mesh to these variables, always from the start. The morph is refused if a cell would be
 * inverted. Objective and constraints c >= 0 follow, with their gradients by the variables. */
static int go_to(const double* v) {
    double pairs[2 * N], found[2], *moved_control = slopes + 4 * control_points;
    int i, k, l;
    /* gx and gy hold displacements before the flow is solved, and derivatives afterwards. */
    const hm_points from = {start_x, start_y, 1}, in_place = {gx, gy, 1};
    const hm_points_out displacement = {gx, gy, 1}, to = {flow.x, flow.y, 1};
    const hm_points_out gradients[2] = {{by_points[0], by_points[0] + flow.points, 1},
                                        {by_points[1], by_points[1] + flow.points, 1}};
    const hm_bound bounds[2] = {{sizeof(hm_bound), HM_BOUND_AREA},
                                {sizeof(hm_bound), HM_BOUND_KEPT_QUALITY}};
    hm_bound_value values[2] = {{sizeof(hm_bound_value)}, {sizeof(hm_bound_value)}};
    hm_step_report limit = {sizeof limit};
    hm_curves moved = {sizeof moved};
    hm_curve curve[2];
    pairs_of(v, pairs);
    check(hm_morph(few, pairs, NULL, &displacement, NULL, &error));
    check(hm_assess(few, &mesh, &from, &in_place, NULL, NULL, &limit, NULL, &error));
    if (limit.admissible <= 1) {
        printf(
            "the morph is refused: the mesh can follow %.3f of the movement, before a corner "
            "inverts at point %d\n",
            limit.admissible, (int)limit.point);
        return 0;
    }
    check(hm_morph(few, pairs, &from, &to, NULL, &error));
    j = flow_objective(gx, gy);
    check(hm_adjoint(few, &in_place, pairs, NULL, &error));
    for (i = 0; i < N; ++i) g[i] = pairs[2 * i];

    pairs_of(v, pairs);
    check(hm_basis_curves(few, pairs, moved_control, &moved, curve, 2, &error));
    check(hm_measure(&moved, NULL, 2, measured, found, NULL, slopes, &error));
    for (k = 0; k < 2; ++k) {
        c[k] = found[k] / start[k] - 0.98;
        for (i = 0; i < N; ++i) {
            by_variable[k][i] = 0;
            for (l = 0; l < 2 * control_points; ++l)
                by_variable[k][i] += slopes[2 * control_points * k + l] *
                                     map[2 * (N * (l / 2) + i) + l % 2] / start[k];
        }
    }
    check(hm_quality_bounds(quality, NULL, 2, bounds, values, gradients, NULL, &error));
    for (k = 0; k < 2; ++k) {
        const hm_points by_bound = {gradients[k].x, gradients[k].y, 1};
        c[2 + k] = values[k].bound - (k == 0 ? 0.3 : 0.4);
        check(hm_adjoint(few, &by_bound, pairs, NULL, &error));
        for (i = 0; i < N; ++i) by_variable[2 + k][i] = pairs[2 * i];
    }
    return 1;
}

/* The augmented Lagrangian of the first m constraints, and its gradient. */
static double lagrangian(int m, const double* lambda, double penalty, double* slope) {
    double merit = j / first_j;
    int i, k;
    for (i = 0; i < N; ++i) slope[i] = g[i] / first_j;
    for (k = 0; k < m; ++k) {
        double const active = fmax(0, lambda[k] / penalty - c[k]);
        merit += 0.5 * penalty * active * active;
        for (i = 0; i < N; ++i) slope[i] -= penalty * active * by_variable[k][i];
    }
    return merit;
}

/* The inverse of the Hessian, by Broyden, Fletcher, Goldfarb and Shanno. */
static void update(double h[N][N], const double* ds, const double* dg) {
    double hg[N], curvature = dot(ds, dg), factor;
    int i, k;
    if (curvature <= 0) return;
    for (i = 0; i < N; ++i) hg[i] = dot(h[i], dg);
    factor = (1 + dot(dg, hg) / curvature) / curvature;
    for (i = 0; i < N; ++i)
        for (k = 0; k < N; ++k)
            h[i][k] += factor * ds[i] * ds[k] - (ds[i] * hg[k] + hg[i] * ds[k]) / curvature;
}

/* Minimises the objective subject to the first m constraints, from the start. Returns 0 when a
 * morph is refused. */
static int optimise(int m) {
    double const penalty = 20, longest = 0.03;
    double v[N] = {0}, lambda[M] = {0}, h[N][N], d[N], slope[N], old_slope[N], to[N];
    double step, merit, old_merit, size;
    int outer, i, k, tries;
    if (!go_to(v)) return 0;
    for (outer = 1; outer <= 5; ++outer) {
        merit = lagrangian(m, lambda, penalty, slope);
        for (size = 0, i = 0; i < N; ++i) size = fmax(size, fabs(slope[i]));
        memset(h, 0, sizeof h);
        for (i = 0; i < N; ++i) h[i][i] = 0.3 * longest / size;
        for (k = 0; k < 12; ++k) {
            for (size = 0, i = 0; i < N; ++i) {
                d[i] = -dot(h[i], slope);
                size = fmax(size, fabs(d[i]));
            }
            for (i = 0; i < N; ++i) d[i] *= fmin(1, longest / size);
            if (dot(d, slope) > -1e-9) break;
            old_merit = merit;
            memcpy(old_slope, slope, sizeof slope);
            for (step = 1, tries = 0; tries < 8; ++tries, step *= 0.4) {
                for (i = 0; i < N; ++i) to[i] = v[i] + step * d[i];
                if (!go_to(to)) return 0;
                merit = lagrangian(m, lambda, penalty, slope);
                if (merit <= old_merit + 1e-4 * step * dot(old_slope, d)) break;
            }
            for (i = 0; i < N; ++i) {
                d[i] = to[i] - v[i];
                old_slope[i] = slope[i] - old_slope[i];
            }
            memcpy(v, to, sizeof v);
            update(h, d, old_slope);
        }
        printf("%4d  pressure error %8.5f  margins %7.3f %7.3f %7.3f %7.3f\n", outer,
               sqrt(j / first_j), c[0], c[1], c[2], c[3]);
        for (k = 0; k < m; ++k) lambda[k] = fmax(0, lambda[k] - penalty * c[k]);
    }
    return 1;
}

int main(int argc, char** argv) {
    double v[N] = {0};
    size_t n;
    flow_read(argc > 1 ? argv[1] : "naca0012.su2", &flow);
    n = (size_t)flow.points;
    start_x = reserve(8 * n * sizeof(double));
    start_y = start_x + n;
    gx = start_y + n;
    gy = gx + n;
    by_points[0] = gy + n;
    by_points[1] = by_points[0] + 2 * n;
    memcpy(start_x, flow.x, n * sizeof(double));
    memcpy(start_y, flow.y, n * sizeof(double));
    flow_want(0.08);
    prepare();
    slopes = reserve(6 * (size_t)control_points * sizeof(double));
    if (!go_to(v)) return 1;
    first_j = j;
    printf("with the mesh constraint:\n");
    if (!optimise(M)) fail("A morph was refused, although the mesh is a constraint.");
    printf("pressure error: divided by %.3f, margins of the constraints %.3f %.3f %.3f %.3f\n",
           sqrt(first_j / j), c[0], c[1], c[2], c[3]);
    if (fmin(fmin(c[0], c[1]), fmin(c[2], c[3])) < -1e-3) fail("A constraint is not satisfied.");
    if (j > 0.9 * first_j) fail("The pressure error did not fall.");
    printf("without the mesh constraint:\n");
    if (optimise(M - 2)) fail("The loop without the mesh constraint needed no refused morph.");
    return 0;
}
