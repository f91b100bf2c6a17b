/* usage: petsc [MESH.su2 ...]: functions by PETSc on parts of meshes are those of the direct engine on the whole mesh,
 * on any number of processes and for any partition; parts that do not fit together are refused by all processes.
 * Without a file: generated meshes. */
#include "petsc_case.h"

#include <harmorph_mpi.h>
#include <petscsys.h>
#include <read_su2.h>

static int passed, failed, rank, size;

static void check(int holds, const char *what, const char *where) {
    if (holds) {
        ++passed;
    } else {
        ++failed;
        printf("petsc.c, process %d of %d: %s: %s\n", rank, size, where, what);
    }
}

static void set_option(const char *name, const char *value) {
    if (value != NULL) {
        PetscOptionsSetValue(NULL, name, value);
    } else {
        PetscOptionsClearValue(NULL, name);
    }
}

static void use_mumps(int yes) {
    set_option("-hm_ksp_type", yes ? "preonly" : NULL);
    set_option("-hm_pc_type", yes ? "cholesky" : NULL);
    set_option("-hm_pc_factor_mat_solver_type", yes ? "mumps" : NULL);
}

/* A problem on a whole mesh, and its functions by the direct engine. */
typedef struct reference {
    whole_mesh mesh;
    hm_mesh view;
    hm_problem problem;
    hm_options options;
    hm_basis *basis;
    void *basis_block;
    const char *name;
} reference;

static void solve_whole(reference *its) {
    hm_error error;
    hm_analysis *analysis;
    hm_plan *plan;
    size_t bytes;
    void *analysis_block, *plan_block;
    hm_mesh view = {sizeof view};
    view.n_points = its->mesh.n_points;
    view.points.x = its->mesh.x;
    view.points.y = its->mesh.y;
    view.cell_layout = HM_CELLS_QUADS;
    view.n_cells = its->mesh.n_cells;
    view.cell_points = its->mesh.cells;
    view.n_faces = its->mesh.n_faces;
    view.face_points = its->mesh.faces;
    view.face_markers = its->mesh.markers;
    its->view = view;
    its->problem.mesh = &its->view;
    need(hm_analysis_size(&its->problem, &its->options, &bytes, &error), &error);
    analysis_block = room(bytes);
    need(hm_analysis_init(&analysis, analysis_block, bytes, &its->problem, &its->options, &error), &error);
    need(hm_plan_size(analysis, &bytes, &error), &error);
    plan_block = room(bytes);
    need(hm_plan_init(&plan, plan_block, bytes, analysis, &error), &error);
    need(hm_basis_size(analysis, &bytes, &error), &error);
    its->basis_block = room(bytes);
    need(hm_basis_init(&its->basis, its->basis_block, bytes, analysis, &error), &error);
    need(hm_plan_factor(plan, NULL, &error), &error);
    need(hm_plan_solve(plan, its->basis, NULL, &error), &error);
    free(analysis_block);
    free(plan_block);
}

static double largest_difference(const reference *of, const hm_basis *rows, const own_part *mine) {
    hm_basis_info info = {sizeof info};
    hm_error error;
    double *all = room(sizeof *all * (size_t)of->mesh.n_points), *own = room(sizeof *own * (size_t)mine->n_points);
    double worst = 0;
    int32_t i, number, k;
    need(hm_basis_info_get(of->basis, &info, &error), &error);
    for (i = 0; i < info.functions; ++i) {
        for (number = 0; number < info.numbers_per_value; ++number) {
            need(hm_basis_values(of->basis, i, number, all, &error), &error);
            need(hm_basis_values(rows, i, number, own, &error), &error);
            for (k = 0; k < mine->n_points; ++k) {
                const double off = fabs(own[k] - all[mine->global[k]]);
                if (!(off <= worst)) worst = off;
            }
        }
    }
    free(all);
    free(own);
    MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    return worst;
}

/* Values at points of the curve against B-spline functions evaluated again: equal numbers. */
static void check_wall(const reference *of, const hm_basis *rows, int32_t n_points) {
    hm_basis_info info = {sizeof info};
    hm_error error;
    double *own = room(sizeof *own * (size_t)n_points);
    int32_t i, k, c, wrong = 0;
    need(hm_basis_info_get(rows, &info, &error), &error);
    for (i = 0; i < info.control_points; ++i) {
        need(hm_basis_values(rows, i, 0, own, &error), &error);
        for (k = 0; k < info.curve_points; ++k) {
            int32_t control[6];
            double values[12], expected = 0;
            if (info.point_curve[k] >= info.curves) continue;
            need(hm_curve_basis(of->problem.curves, info.point_curve[k], info.point_u[k], 0, control, values, &error),
                 &error);
            for (c = 0; c <= of->problem.curves->curve[info.point_curve[k]].degree; ++c) {
                if (control[c] == i) expected += values[c];
            }
            wrong += own[info.curve_point[k]] != expected;
        }
    }
    check(wrong == 0, "values on the wall are those of the B-spline", of->name);
    free(own);
}

static void check_use(const reference *of, const hm_petsc *system, const hm_basis *rows, const own_part *mine) {
    hm_basis_info info = {sizeof info};
    hm_step_report step = {sizeof step}, its_step = {sizeof its_step};
    hm_quality_report quality = {sizeof quality}, its_quality = {sizeof its_quality};
    hm_error error;
    const size_t n = (size_t)of->mesh.n_points, n_own = (size_t)mine->n_points;
    double *all = room(2 * n * sizeof *all), *own = room(2 * n_own * sizeof *own), worst = 0, *move, *gradient,
           *expected;
    uint8_t *owned = room(n_own);
    size_t k;
    int32_t n_functions;
    need(hm_basis_info_get(of->basis, &info, &error), &error);
    n_functions = info.functions;
    move = room(2 * (size_t)n_functions * sizeof *move);
    gradient = room(2 * (size_t)n_functions * sizeof *gradient);
    expected = room(2 * (size_t)n_functions * sizeof *expected);
    for (k = 0; k < 2 * (size_t)n_functions; ++k) move[k] = 0.01 * cos(3.0 * (double)k);
    need(hm_morph(of->basis, move, NULL, &(hm_points_out){all, all + n, 1}, NULL, &error), &error);
    need(hm_morph(rows, move, NULL, &(hm_points_out){own, own + n_own, 1}, NULL, &error), &error);
    for (k = 0; k < n_own; ++k) {
        worst = fmax(worst, fabs(own[k] - all[mine->global[k]]));
        worst = fmax(worst, fabs(own[n_own + k] - all[n + (size_t)mine->global[k]]));
    }
    check(worst < 1e-8, "points move as on one process", of->name);
    need(hm_assess(of->basis, &of->view, NULL, &(hm_points){all, all + n, 1}, NULL, &step, &quality, &error), &error);
    need(hm_petsc_assess(system, rows, NULL, &(hm_points){own, own + n_own, 1}, &its_step, &its_quality, NULL, &error),
         &error);
    check(fabs(its_step.admissible / step.admissible - 1) < 1e-6, "the admissible step is that of one process",
          of->name);
    check(fabs(its_quality.min_quality - quality.min_quality) < 1e-6, "the least quality is that of one process",
          of->name);
    check(fabs(its_quality.mean_quality - quality.mean_quality) < 1e-8, "the mean quality is that of one process",
          of->name);
    check(its_quality.inverted == quality.inverted, "as many cells are inverted", of->name);
    need(hm_petsc_owned(system, owned, &error), &error);
    for (k = 0; k < 2 * n; ++k) all[k] = sin(1.7 * (double)k);
    for (k = 0; k < n_own; ++k) {
        own[k] = owned[k] ? all[mine->global[k]] : 0;
        own[n_own + k] = owned[k] ? all[n + (size_t)mine->global[k]] : 0;
    }
    need(hm_adjoint(of->basis, &(hm_points){all, all + n, 1}, expected, NULL, &error), &error);
    need(hm_mpi_adjoint(rows, &(hm_points){own, own + n_own, 1}, gradient, NULL, MPI_COMM_WORLD, &error), &error);
    for (worst = 0, k = 0; k < 2 * (size_t)n_functions; ++k) worst = fmax(worst, fabs(gradient[k] - expected[k]));
    check(worst < 1e-6, "the gradient is that of one process", of->name);
    free(all);
    free(own);
    free(owned);
    free(move);
    free(gradient);
    free(expected);
}

static void check_agreement(const reference *of, int kind, int mumps) {
    own_part mine;
    int *const part_of = partition(&of->mesh, kind, size);
    hm_petsc *system = NULL;
    hm_petsc_report report = {sizeof report};
    hm_basis *rows = NULL;
    hm_error error = {0};
    size_t bytes;
    void *block;
    hm_status status;
    double off;
    char what[200];
    take_part(&mine, &of->mesh, part_of, rank, kind == GHOSTS);
    use_mumps(mumps);
    need(hm_petsc_create(&system, &mine.part, &of->problem, &of->options, MPI_COMM_WORLD, &error), &error);
    need(hm_petsc_rows_size(system, &bytes, &error), &error);
    block = room(bytes);
    status = hm_petsc_solve(system, &rows, block, bytes, &report, &error);
    need(status, &error);
    off = largest_difference(of, rows, &mine);
    snprintf(what, sizeof what, "%s, %s: off by %.1e, status %d, error %.1e, %d iterations, %d solutions",
             partition_names[kind], mumps ? "MUMPS" : "iterative", off, (int)status, report.error,
             (int)report.iterations, (int)report.solutions);
    check(off < (mumps ? 1e-11 : 1e-8) && status == HM_OK, what, of->name);
    if (getenv("VERBOSE") != NULL && rank == 0) printf("    %s, %d processes: %s\n", of->name, size, what);
    if (of->problem.curves != NULL) check_wall(of, rows, mine.n_points);
    check_use(of, system, rows, &mine);
    hm_petsc_free(&system);
    check(system == NULL, "free leaves NULL", of->name);
    use_mumps(0);
    free(block);
    free(part_of);
    free_part(&mine);
}

/* ---- Meshes ---------------------------------------------------------------------------------------------------------
 */

static void structured(whole_mesh *its, int32_t ni, int32_t nj) {
    int32_t i, j;
    its->n_points = ni * nj;
    its->n_cells = (ni - 1) * (nj - 1);
    its->x = room(sizeof *its->x * (size_t)its->n_points);
    its->y = room(sizeof *its->y * (size_t)its->n_points);
    its->cells = room(sizeof *its->cells * 4 * (size_t)its->n_cells);
    its->faces = room(sizeof *its->faces * 4 * (size_t)(ni + nj));
    its->markers = room(sizeof *its->markers * 2 * (size_t)(ni + nj));
    its->n_faces = 0;
    for (j = 0; j + 1 < nj; ++j) {
        for (i = 0; i + 1 < ni; ++i) {
            int32_t *const cell = its->cells + 4 * (i + (ni - 1) * j), a = i + ni * j;
            cell[0] = a;
            cell[1] = a + 1;
            cell[2] = a + ni + 1;
            cell[3] = a + ni;
        }
    }
}

static void add_face(whole_mesh *its, int32_t a, int32_t b, int32_t marker) {
    its->faces[2 * its->n_faces] = a;
    its->faces[2 * its->n_faces + 1] = b;
    its->markers[its->n_faces++] = marker;
}

/* O-mesh round an ellipse, with a seam; heights of the first layer: first. */
static void o_mesh(reference *its, int32_t ni, int32_t nj, double first, int32_t operator_kind, int rigid) {
    static hm_condition condition;
    hm_condition on_wall = {sizeof on_wall};
    hm_problem problem = {sizeof problem};
    hm_options options = {sizeof options};
    hm_fit_options fit = {sizeof fit};
    hm_error error;
    size_t bytes;
    int32_t i, j;
    memset(its, 0, sizeof *its);
    structured(&its->mesh, ni, nj);
    for (j = 0; j < nj; ++j) {
        const double t = (double)j / (nj - 1), s = first > 0 ? first * expm1(t * log1p(20 / first)) : expm1(3 * t);
        for (i = 0; i < ni; ++i) {
            const double angle = 6.283185307179586 * (i % (ni - 1)) / (ni - 1), r = 1 + s;
            its->mesh.x[i + ni * j] = (r + 0.6 / r) * cos(angle);
            its->mesh.y[i + ni * j] = (r - 0.6 / r) * sin(angle);
        }
    }
    for (i = 0; i + 1 < ni; ++i) {
        add_face(&its->mesh, i + 1, i, WALL);
        add_face(&its->mesh, i + ni * (nj - 1), i + 1 + ni * (nj - 1), FAR_FIELD);
    }
    on_wall.marker = WALL;
    if (rigid) {
        on_wall.kind = HM_RIGID;
        on_wall.x = 0.1;
    } else {
        fit.n_control = 4;
        fit.closed = HM_PERIODIC;
        on_wall.n_curves = 1;
        need(hm_fit_size(ni - 1, &fit, &bytes, &error), &error);
        need(hm_fit(&problem.curves, room(bytes), bytes, &(hm_points){its->mesh.x, its->mesh.y, 1}, ni - 1, 1, &fit,
                    NULL, &error),
             &error);
    }
    condition = on_wall;
    problem.n_conditions = 1;
    problem.conditions = &condition;
    options.operator_kind = operator_kind;
    its->problem = problem;
    its->options = options;
}

/* A channel: the lower wall on a curve, the sides slide along themselves. */
static void channel(reference *its, int32_t ni, int32_t nj, int32_t operator_kind) {
    static hm_condition conditions[3];
    hm_condition any = {sizeof any};
    hm_problem problem = {sizeof problem};
    hm_options options = {sizeof options};
    hm_fit_options fit = {sizeof fit};
    hm_error error;
    size_t bytes;
    int32_t i, j;
    memset(its, 0, sizeof *its);
    structured(&its->mesh, ni, nj);
    for (j = 0; j < nj; ++j) {
        for (i = 0; i < ni; ++i) {
            const double x = 2.0 * i / (ni - 1), t = (double)j / (nj - 1);
            its->mesh.x[i + ni * j] = x;
            its->mesh.y[i + ni * j] = t + (1 - t) * 0.1 * sin(3.141592653589793 * x / 2);
        }
    }
    for (i = 0; i + 1 < ni; ++i) {
        add_face(&its->mesh, i, i + 1, 1);
        add_face(&its->mesh, i + 1 + ni * (nj - 1), i + ni * (nj - 1), 2);
    }
    for (j = 0; j + 1 < nj; ++j) {
        add_face(&its->mesh, ni - 1 + ni * j, ni - 1 + ni * (j + 1), 3);
        add_face(&its->mesh, ni * (j + 1), ni * j, 4);
    }
    fit.n_control = 4;
    fit.closed = HM_OPEN;
    need(hm_fit_size(ni, &fit, &bytes, &error), &error);
    need(hm_fit(&problem.curves, room(bytes), bytes, &(hm_points){its->mesh.x, its->mesh.y, 1}, ni, 0, &fit, NULL,
                &error),
         &error);
    conditions[0] = conditions[1] = conditions[2] = any;
    conditions[0].marker = 1;
    conditions[0].n_curves = 1;
    conditions[1].marker = 3;
    conditions[1].kind = HM_SLIP;
    conditions[2].marker = 4;
    conditions[2].kind = HM_SLIP;
    problem.n_conditions = 3;
    problem.conditions = conditions;
    options.operator_kind = operator_kind;
    its->problem = problem;
    its->options = options;
}

/* The airfoil of a mesh file: the marker that is no far field, with a fitted curve. */
static void from_file(reference *its, const char *file, int32_t operator_kind) {
    static hm_condition condition;
    hm_condition on_wall = {sizeof on_wall};
    hm_problem problem = {sizeof problem};
    hm_options options = {sizeof options};
    hm_fit_options fit = {sizeof fit};
    hm_analysis *analysis;
    hm_error error;
    su2_mesh from;
    char message[256];
    size_t bytes;
    void *block;
    int32_t k, c, n = 0, is_loop = 0, *points, marker = 0;
    double *x, *y;
    if (read_su2(file, &from, message) != 0) {
        fprintf(stderr, "%s: %s\n", file, message);
        MPI_Abort(MPI_COMM_WORLD, 1);
    }
    memset(its, 0, sizeof *its);
    its->mesh.n_points = from.n_points;
    its->mesh.n_cells = from.n_cells;
    its->mesh.n_faces = from.n_faces;
    its->mesh.x = from.x;
    its->mesh.y = from.y;
    its->mesh.faces = from.face_points;
    its->mesh.markers = from.face_markers;
    its->mesh.cells = room(4 * sizeof *its->mesh.cells * (size_t)from.n_cells);
    for (k = 0; k < from.n_cells; ++k) {
        const int32_t last = from.cell_start[k + 1] - from.cell_start[k] - 1;
        for (c = 0; c < 4; ++c)
            its->mesh.cells[4 * k + c] = from.cell_points[from.cell_start[k] + (c < last ? c : last)];
    }
    for (k = 0; k < from.n_markers; ++k) {
        if (strncmp(from.names[k], "far", 3) != 0 && strncmp(from.names[k], "FAR", 3) != 0 &&
            strncmp(from.names[k], "Far", 3) != 0)
            marker = k;
    }
    { /* the points of the airfoil in order: an analysis of the mesh alone */
        hm_mesh view = {sizeof view};
        view.n_points = from.n_points;
        view.points.x = from.x;
        view.points.y = from.y;
        view.n_cells = from.n_cells;
        view.cell_start = from.cell_start;
        view.cell_points = from.cell_points;
        view.n_faces = from.n_faces;
        view.face_points = from.face_points;
        view.face_markers = from.face_markers;
        problem.mesh = &view;
        need(hm_analysis_size(&problem, NULL, &bytes, &error), &error);
        block = room(bytes);
        need(hm_analysis_init(&analysis, block, bytes, &problem, NULL, &error), &error);
        points = room(sizeof *points * (size_t)from.n_faces);
        need(hm_analysis_boundary(analysis, 1, &marker, 0, points, from.n_faces, &n, &is_loop, &error), &error);
        free(block);
    }
    x = room(sizeof *x * (size_t)n);
    y = room(sizeof *y * (size_t)n);
    for (k = 0; k < n; ++k) {
        x[k] = from.x[points[k]];
        y[k] = from.y[points[k]];
    }
    fit.n_control = 12;
    need(hm_fit_size(n, &fit, &bytes, &error), &error);
    need(hm_fit(&problem.curves, room(bytes), bytes, &(hm_points){x, y, 1}, n, is_loop, &fit, NULL, &error), &error);
    on_wall.marker = marker;
    on_wall.n_curves = problem.curves->n_curves;
    condition = on_wall;
    problem.n_conditions = 1;
    problem.conditions = &condition;
    options.operator_kind = operator_kind;
    its->problem = problem;
    its->options = options;
}

static void check_case(reference *its, const char *name) {
    /* On one process all partitions are the same; on each other number another one. */
    const int wanted = size == 1   ? 1 << STRIPES
                       : size == 2 ? 1 << STRIPES | 1 << GHOSTS
                       : size == 3 ? 1 << BISECTION
                                   : 1 << RANDOM;
    int kind;
    its->name = name;
    solve_whole(its);
    for (kind = 0; kind < N_PARTITIONS; ++kind) {
        if ((wanted >> kind & 1) == 0) continue;
        check_agreement(its, kind, 0);
        check_agreement(its, kind, 1);
    }
    free(its->basis_block);
}

/* ---- Given displacements
 * --------------------------------------------------------------------------------------------- */

static void check_displace(int32_t operator_kind) {
    reference of;
    hm_condition given = {sizeof given};
    own_part mine;
    hm_petsc *system = NULL;
    hm_petsc_report report = {sizeof report};
    hm_error error;
    hm_analysis *analysis;
    hm_plan *plan;
    size_t bytes, k, n;
    int *part_of;
    int32_t n_wall, *list;
    double *all, *own, *wall, worst = 0;
    void *work;
    o_mesh(&of, 33, 17, 0, operator_kind, 0);
    given.marker = WALL;
    given.kind = HM_GIVEN;
    of.problem.curves = NULL;
    of.problem.conditions = &given;
    of.name = "given displacements";
    n = (size_t)of.mesh.n_points;
    of.view = (hm_mesh){sizeof of.view};
    of.view.n_points = of.mesh.n_points;
    of.view.points = (hm_points){of.mesh.x, of.mesh.y, 1};
    of.view.cell_layout = HM_CELLS_QUADS;
    of.view.n_cells = of.mesh.n_cells;
    of.view.cell_points = of.mesh.cells;
    of.view.n_faces = of.mesh.n_faces;
    of.view.face_points = of.mesh.faces;
    of.view.face_markers = of.mesh.markers;
    of.problem.mesh = &of.view;
    need(hm_analysis_size(&of.problem, &of.options, &bytes, &error), &error);
    need(hm_analysis_init(&analysis, room(bytes), bytes, &of.problem, &of.options, &error), &error);
    need(hm_plan_size(analysis, &bytes, &error), &error);
    need(hm_plan_init(&plan, room(bytes), bytes, analysis, &error), &error);
    need(hm_plan_factor(plan, NULL, &error), &error);
    need(hm_given_points(plan, NULL, 0, &n_wall, &error) == HM_OK || n_wall > 0 ? HM_OK : HM_BAD_ARGUMENT, &error);
    list = room(sizeof *list * (size_t)n_wall);
    wall = room(2 * sizeof *wall * (size_t)n_wall);
    all = room(2 * sizeof *all * n);
    need(hm_given_points(plan, list, n_wall, &n_wall, &error), &error);
    for (k = 0; k < (size_t)n_wall; ++k) {
        wall[k] = 0.01 * sin(2 * of.mesh.x[list[k]]);
        wall[(size_t)n_wall + k] = 0.02 * cos(of.mesh.y[list[k]]);
    }
    need(hm_displace_size(plan, 1, &bytes, &error), &error);
    work = room(bytes);
    need(hm_displace(plan, n_wall, list, 1, &(hm_points){wall, wall + n_wall, 1}, NULL,
                     &(hm_points_out){all, all + n, 1}, work, bytes, NULL, &error),
         &error);
    part_of = partition(&of.mesh, BISECTION, size);
    take_part(&mine, &of.mesh, part_of, rank, 0);
    own = room(2 * sizeof *own * (size_t)mine.n_points);
    for (k = 0; k < (size_t)mine.n_points; ++k) {
        own[k] = 0.01 * sin(2 * mine.x[k]); /* at points of the wall these count, elsewhere they are replaced */
        own[(size_t)mine.n_points + k] = 0.02 * cos(mine.y[k]);
    }
    need(hm_petsc_create(&system, &mine.part, &of.problem, &of.options, MPI_COMM_WORLD, &error), &error);
    need(hm_petsc_displace(system, &(hm_points_out){own, own + mine.n_points, 1}, &report, &error), &error);
    for (k = 0; k < (size_t)mine.n_points; ++k) {
        worst = fmax(worst, fabs(own[k] - all[mine.global[k]]));
        worst = fmax(worst, fabs(own[(size_t)mine.n_points + k] - all[n + (size_t)mine.global[k]]));
    }
    check(worst < 1e-10, "displacements are those of one process", of.name);
    hm_petsc_free(&system);
    free(own);
    free(part_of);
    free_part(&mine);
}

/* ---- Parts that do not fit
 * ------------------------------------------------------------------------------------------- */

enum { POSITION, GAP, NO_MARKER, MARKED_INSIDE, NUMBERS, INSIDE_TWICE, NULL_PART, BAD_MARKER, NO_OWNER, N_FAULTS };

/* What one process has wrong; 0 where the number of processes leaves no room for the fault. */
static int spoil(own_part *mine, const whole_mesh *of, const int *part_of, int fault) {
    int32_t k, c;
    const int last = size - 1;
    int64_t number;
    if (size == 1 && fault != GAP && fault != NO_MARKER && fault != NULL_PART && fault != BAD_MARKER) return 0;
    if (rank != last) return 1;
    switch (fault) {
    case POSITION:
    case NUMBERS:
        for (k = 0; k < of->n_cells; ++k) { /* a point that another process has, too */
            if (part_of[k] == rank) continue;
            for (c = 0; c < 4; ++c) {
                int32_t at = 0;
                while (at < mine->n_points && mine->global[at] != of->cells[4 * k + c]) ++at;
                if (at == mine->n_points) continue;
                if (fault == POSITION) {
                    mine->x[at] += 1e-9;
                } else {
                    number = mine->numbers[at];
                    mine->numbers[at] = mine->numbers[at == 0 ? 1 : 0];
                    mine->numbers[at == 0 ? 1 : 0] = number;
                }
                return 1;
            }
        }
        break;
    case GAP: --mine->n_cells; break;
    case NO_MARKER: --mine->n_faces; break;
    case MARKED_INSIDE:
        for (k = 0; k < mine->n_cells; ++k) {
            const int32_t *const cell = mine->cells + 4 * k;
            mine->faces[2 * mine->n_faces] = cell[0]; /* some side of a cell inside the mesh */
            mine->faces[2 * mine->n_faces + 1] = cell[1];
        }
        mine->markers[mine->n_faces++] = 9;
        break;
    case INSIDE_TWICE:
        for (k = 0; k < mine->n_points; ++k) mine->numbers[k] = number_of(k);
        break;
    case NO_OWNER: { /* a ghost point gets a number that no process has */
        uint8_t *own = calloc((size_t)mine->n_points, 1);
        for (k = 0; k < 4 * mine->n_cells; ++k) own[mine->cells[k]] |= !mine->ghosts[k / 4];
        for (k = 0; k < mine->n_points && own[k]; ++k) {
        }
        mine->numbers[k] = 123456789;
        free(own);
        break;
    }
    default: break;
    }
    refer(mine);
    return 1;
}

static void check_refusals(void) {
    static const char *const names[] = {"two positions",
                                        "a gap",
                                        "a missing marker",
                                        "a marker inside",
                                        "wrong numbers",
                                        "the same numbers inside two parts",
                                        "NULL",
                                        "a marker without faces",
                                        "a ghost without owner"};
    reference of;
    int fault;
    o_mesh(&of, 25, 9, 0, HM_LAPLACE, 0);
    for (fault = 0; fault < N_FAULTS; ++fault) {
        int *const part_of = partition(&of.mesh, STRIPES, size), possible;
        own_part mine;
        hm_petsc *system = NULL;
        hm_error error = {0};
        hm_condition wrong = of.problem.conditions[0];
        hm_problem problem = of.problem;
        int32_t own, least, most;
        take_part(&mine, &of.mesh, part_of, rank, fault == NO_OWNER);
        possible = spoil(&mine, &of.mesh, part_of, fault);
        if (fault == BAD_MARKER) {
            wrong.marker = 77;
            problem.conditions = &wrong;
        }
        own = hm_petsc_create(&system, fault == NULL_PART && rank == size - 1 ? NULL : &mine.part, &problem,
                              &of.options, MPI_COMM_WORLD, &error);
        MPI_Allreduce(&own, &least, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
        MPI_Allreduce(&own, &most, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
        check(least == most, "all processes have the same status", names[fault]);
        check(!possible || own < 0, "refused", names[fault]);
        check(!possible || error.text[0] != 0, "with a text", names[fault]);
        if (getenv("VERBOSE") != NULL && possible)
            printf("    process %d: %s: %s (item %d)\n", rank, names[fault], error.text, (int)error.item);
        if (possible) check(system == NULL, "no system is left", names[fault]);
        hm_petsc_free(&system);
        free(part_of);
        free_part(&mine);
    }
}

int main(int argc, char **argv) {
    int own[2], all[2], k;
    reference of;
    PetscInitialize(NULL, NULL, NULL, NULL);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    for (k = 1; k < argc; ++k) {
        from_file(&of, argv[k], HM_LAPLACE);
        check_case(&of, argv[k]);
        from_file(&of, argv[k], HM_CONFORMAL);
        check_case(&of, argv[k]);
    }
    if (argc == 1) {
        o_mesh(&of, 33, 13, 1e-5, HM_CONFORMAL, 0);
        check_case(&of, "O-mesh with thin cells, conformal");
        channel(&of, 21, 9, HM_LAPLACE);
        check_case(&of, "channel with sliding sides, Laplace");
        if (size <= 2) { /* messages take their time where processes share a processor */
            o_mesh(&of, 33, 13, 1e-4, HM_WEIGHTED, 0);
            check_case(&of, "O-mesh with thin cells, weighted");
            o_mesh(&of, 25, 9, 0, HM_LAPLACE, 1);
            check_case(&of, "rigid body, Laplace");
        }
        check_displace(HM_LAPLACE);
        check_displace(HM_CONFORMAL);
        check_refusals();
    }
    own[0] = passed;
    own[1] = failed;
    MPI_Reduce(own, all, 2, MPI_INT, MPI_SUM, 0, MPI_COMM_WORLD);
    if (rank == 0) printf("%d passed, %d failed\n", all[0], all[1]);
    PetscFinalize();
    return failed > 0;
}
