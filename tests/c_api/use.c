/* A whole life of a basis in C99, from a mesh made here to a morphed one: what a solver written in
 * C would do. Needs nothing but the library, not even -lm. */
#include <harmorph_design.h>
#include <harmorph_study.h>
#include "use_case.h"

/* The body's points in order, by an analysis of the mesh alone; then a periodic cubic through them.
 */
static const hm_curves* fit_body(const hm_mesh* mesh, void** block) {
    hm_error error = {HM_OK};
    hm_problem problem;
    HM_INIT(problem);
    hm_mesh_report report;
    HM_INIT(report);
    hm_fit_options options;
    HM_INIT(options);
    hm_fit_report fit;
    HM_INIT(fit);
    hm_analysis* analysis = NULL;
    const hm_curves* curves = NULL;
    const int32_t marker = BODY;
    int32_t points[AROUND], n = 0, is_loop = 0, k;
    double body_x[AROUND], body_y[AROUND];
    hm_memory memory;

    problem.mesh = mesh;
    require(hm_analysis_init(NULL, emptied(&memory), &problem, NULL, &error),
            "size of the mesh's analysis", &error);
    *block = memory.block = block_of(memory.bytes);
    require(hm_analysis_init(&analysis, &memory, &problem, NULL, &error), "analysis of the mesh",
            &error);
    require(hm_analysis_report(analysis, &report, &error), "report on the mesh", &error);
    check(report.points == POINTS && report.cells == CELLS && report.quads == CELLS, "counts",
          &error);
    check(report.boundary_edges == 2 * AROUND && report.boundary_loops == 2, "boundaries", &error);
    check(report.inverted == 0 && report.min_area > 0, "validity", &error);
    require(hm_analysis_boundary(analysis, 1, &marker, 0, points, AROUND, &n, &is_loop, &error),
            "its points", &error);
    check(n == AROUND && is_loop == 1, "the body is one loop", &error);
    for (k = 0; k < n; ++k) {
        body_x[k] = x[points[k] - 1];
        body_y[k] = y[points[k] - 1];
    }
    free(*block);

    options.n_control = CONTROL;
    require(hm_fit(NULL, emptied(&memory), NULL, n, 0, &options, NULL, &error), "size of the fit",
            &error);
    *block = memory.block = block_of(memory.bytes);
    require(hm_fit(&curves, &memory, &(hm_points){body_x, body_y, 1}, n, is_loop, &options, &fit,
                   &error),
            "the fit", &error);
    check(fit.closed == HM_PERIODIC && curves->n_control == CONTROL,
          "a smooth body gets a periodic curve", &error);
    check(fit.max_error < 2e-3 && fit.rms_error <= fit.max_error, "the fit is close", &error);
    require(hm_curves_check(curves, &error), "the fitted curves are well formed", &error);
    return curves;
}

static int32_t cancel(void* user, int32_t phase, double fraction) {
    (void)fraction;
    return phase == *(const int32_t*)user;
}

/* The functions, in a block that holds them and nothing else; the analysis and the plan are given
 * back. */
static hm_basis* solve(const hm_problem* problem, void** block) {
    hm_error error = {HM_OK};
    hm_options options;
    HM_INIT(options);
    hm_solve_report report;
    HM_INIT(report);
    hm_analysis* analysis = NULL;
    hm_plan* plan = NULL;
    hm_basis* basis = NULL;
    void *analysis_block, *plan_block;
    hm_memory analysis_memory, plan_memory, basis_memory;
    int32_t stop_in = HM_PHASE_SOLVE;

    options.progress = cancel;
    options.progress_user = &stop_in;
    require(hm_analysis_init(NULL, emptied(&analysis_memory), problem, &options, &error),
            "size of the analysis", &error);
    analysis_block = analysis_memory.block = block_of(analysis_memory.bytes);
    check(hm_analysis_init(&analysis, &(hm_memory){analysis_block, analysis_memory.bytes - 1},
                           problem, &options, &error) == HM_BLOCK_TOO_SMALL &&
              error.value >= 1,
          "a block that is a byte too small is refused", &error);
    error.code = HM_OK;
    require(hm_analysis_init(&analysis, &analysis_memory, problem, &options, &error),
            "the analysis", &error);
    require(hm_plan_init(NULL, emptied(&plan_memory), analysis, &error), "size of the plan",
            &error);
    require(hm_basis_init(NULL, emptied(&basis_memory), analysis, &error), "size of the basis",
            &error);
    plan_block = plan_memory.block = block_of(plan_memory.bytes);
    *block = basis_memory.block = block_of(basis_memory.bytes);
    require(hm_plan_init(&plan, &plan_memory, analysis, &error), "the plan", &error);
    require(hm_basis_init(&basis, &basis_memory, analysis, &error), "the basis", &error);
    free(analysis_block);

    require(hm_plan_factor(plan, NULL, &error), "the factor", &error);
    check(hm_plan_solve(plan, basis, &report, &error) == HM_CANCELLED,
          "the callback cancels the solution", &error);
    stop_in = -1;
    error.code = HM_OK;
    require(hm_plan_solve(plan, basis, &report, &error), "the solution after that", &error);
    check(report.functions == CONTROL && report.curve_points == AROUND, "counts of the solution",
          &error);
    check(report.residual <= 1e-12 && report.boundary_error <= 1e-12, "residual and boundary error",
          &error);
    check(report.partition_defect <= 1e-12 && report.max_value < 1.5 && report.min_value > -0.5,
          "values", &error);
    free(plan_block);
    return basis;
}

static void morph(const hm_basis* basis, const hm_mesh* mesh) {
    hm_error error = {HM_OK};
    hm_step_report step;
    HM_INIT(step);
    hm_quality_report quality;
    HM_INIT(quality);
    double move[2 * CONTROL] = {0}, gradient[2 * CONTROL], boundary_error = 1, here = 0, there = 0;
    static double dx[POINTS], dy[POINTS], dj_dx[POINTS], dj_dy[POINTS];
    int32_t point = 0;
    int k;

    require(hm_morph(basis, move, &(hm_points){x, y, 1}, &(hm_points_out){x_new, y_new, 1}, NULL,
                     &error),
            "a movement of nothing", &error);
    check(memcmp(x, x_new, sizeof x) == 0 && memcmp(y, y_new, sizeof y) == 0, "it keeps all bits",
          &error);

    for (k = 0; k < 2 * CONTROL; ++k) move[k] = 0.01 * noise();
    require(hm_morph(basis, move, NULL, &(hm_points_out){dx, dy, 1}, NULL, &error),
            "displacements alone", &error);
    require(hm_assess(basis, mesh, NULL, &(hm_points){dx, dy, 1}, NULL, NULL, &step, NULL, &error),
            "the admissible step", &error);
    check(step.admissible > 0 && step.cell >= 1 && step.cell <= CELLS,
          "somewhere a cell sets the limit", &error);
    for (k = 0; k < 2 * CONTROL; ++k) move[k] *= step.admissible < 2 ? 0.5 * step.admissible : 1;
    require(hm_morph(basis, move, &(hm_points){x, y, 1}, &(hm_points_out){x_new, y_new, 1}, NULL,
                     &error),
            "half the admissible step", &error);
    require(hm_boundary_error(basis, move, &(hm_points){x, y, 1}, &(hm_points){x_new, y_new, 1},
                              &boundary_error, &point, &error),
            "its check", &error);
    check(boundary_error <= 1e-12, "the wall moves as the B-spline does", &error);
    require(hm_assess(basis, mesh, &(hm_points){x_new, y_new, 1}, NULL, &(hm_points){x, y, 1}, NULL,
                      NULL, &quality, &error),
            "quality", &error);
    check(quality.inverted == 0 && quality.min_area > 0 && quality.self_crossing == 0,
          "the morphed mesh is valid", &error);
    check(quality.min_quality > 0 && quality.min_quality <= quality.mean_quality,
          "least and mean quality", &error);

    /* <g, F m> = <F^T g, m> */
    require(hm_morph(basis, move, NULL, &(hm_points_out){dx, dy, 1}, NULL, &error),
            "displacements of this step", &error);
    for (k = 0; k < POINTS; ++k) {
        dj_dx[k] = noise();
        dj_dy[k] = noise();
        here += dj_dx[k] * dx[k] + dj_dy[k] * dy[k];
    }
    require(hm_adjoint(basis, &(hm_points){dj_dx, dj_dy, 1}, gradient, NULL, &error), "the adjoint",
            &error);
    for (k = 0; k < 2 * CONTROL; ++k) there += gradient[k] * move[k];
    check(absolute(here - there) <= 1e-13 * POINTS * 0.01, "the adjoint is the transpose", &error);
}

/* Twice as thick and far away: what would invert cells at once is done in steps, for which the plan
 * is needed. */
static void morph_safely(const hm_problem* problem, const hm_basis* basis) {
    hm_error error = {HM_OK};
    hm_options options;
    HM_INIT(options);
    hm_step_report step;
    HM_INIT(step);
    hm_quality_report quality;
    HM_INIT(quality);
    hm_safe_options safe_options;
    hm_safe_report report;
    hm_safe_target target;
    HM_INIT(report);
    hm_improve_report improved;
    HM_INIT(improved);
    hm_basis_info info;
    HM_INIT(info);
    hm_curves curves;
    HM_INIT(curves);
    hm_curve curve;
    hm_condition condition;
    HM_INIT(condition);
    hm_analysis* analysis = NULL;
    hm_plan* plan = NULL;
    hm_basis* laplace = NULL;
    void *analysis_block, *plan_block, *laplace_block, *work;
    static double dx[POINTS], dy[POINTS], values[POINTS];
    double move[2 * CONTROL], boundary_error = 1;
    hm_memory memory;
    int32_t point = 0, n = 0;
    int k;

    require(hm_basis_info_get(basis, &info, &error), "what the basis is", &error);
    check(info.operator_kind == HM_CONFORMAL && info.numbers_per_value == 2,
          "the default is conformal", &error);
    require(hm_basis_values(basis, 3, 1, values, &error), "its imaginary parts", &error);
    check(hm_basis_values(basis, 3, 2, values, &error) == HM_BAD_ARGUMENT,
          "complex values are two numbers", &error);
    require(hm_basis_conditions(basis, &condition, 1, &n, &error), "its conditions", &error);
    check(n == 1 && condition.marker == BODY && condition.kind == HM_ON_CURVE,
          "they are those of the problem", &error);
    require(hm_basis_curves(basis, NULL, NULL, &curves, &curve, 1, &error), "its curve", &error);

    options.operator_kind = HM_LAPLACE;
    require(hm_analysis_init(NULL, emptied(&memory), problem, &options, &error),
            "size of Laplace's analysis", &error);
    analysis_block = memory.block = block_of(memory.bytes);
    require(hm_analysis_init(&analysis, &memory, problem, &options, &error), "its analysis",
            &error);
    require(hm_plan_init(NULL, emptied(&memory), analysis, &error), "size of Laplace's plan",
            &error);
    plan_block = memory.block = block_of(memory.bytes);
    require(hm_plan_init(&plan, &memory, analysis, &error), "Laplace's plan", &error);
    require(hm_basis_init(NULL, emptied(&memory), analysis, &error), "size of Laplace's basis",
            &error);
    laplace_block = memory.block = block_of(memory.bytes);
    require(hm_basis_init(&laplace, &memory, analysis, &error), "Laplace's basis", &error);
    require(hm_plan_factor(plan, NULL, &error), "Laplace's factor", &error);
    require(hm_plan_solve(plan, laplace, NULL, &error), "Laplace's functions", &error);
    free(analysis_block);

    for (k = 0; k < CONTROL; ++k) {
        move[2 * k] = 0.3;
        move[2 * k + 1] = curves.control[2 * k + 1] + 0.3;
    }
    require(hm_morph(laplace, move, NULL, &(hm_points_out){dx, dy, 1}, NULL, &error),
            "a large displacement", &error);
    require(hm_assess(laplace, problem->mesh, NULL, &(hm_points){dx, dy, 1}, NULL, NULL, &step,
                      &quality, &error),
            "its assessment", &error);
    check(step.admissible < 1 && quality.inverted > 0, "at once, cells are inverted", &error);
    HM_INIT(safe_options); /* the mesh is improved by a call of its own */
    safe_options.skipped_strategies = 1 << HM_STRATEGY_IMPROVED;
    HM_INIT(target);
    target.move = move;
    require(hm_move_safe(plan, laplace, &target, NULL, emptied(&memory), NULL, NULL, &error),
            "size of a safe morph", &error);
    work = memory.block = block_of(memory.bytes);
    require(hm_move_safe(plan, laplace, &target, &(hm_points_out){x_new, y_new, 1}, &memory,
                         &safe_options, &report, &error),
            "it", &error);
    check(report.step_fraction >= 1 && report.strategy >= HM_STRATEGY_SUBSTEPS &&
              report.inverted == 0,
          "all of it", &error);
    require(hm_assess(laplace, problem->mesh, &(hm_points){x_new, y_new, 1}, NULL,
                      &(hm_points){x, y, 1}, NULL, NULL, &quality, &error),
            "quality", &error);
    check(quality.inverted == 0 && quality.self_crossing == 0, "no cell is inverted", &error);
    require(hm_boundary_error(laplace, move, &(hm_points){x, y, 1}, &(hm_points){x_new, y_new, 1},
                              &boundary_error, &point, &error),
            "its wall", &error);
    check(boundary_error <= 1e-12, "the wall is where the B-spline is", &error);
    free(work);
    require(hm_improve(plan, NULL, NULL, emptied(&memory), NULL, NULL, &error),
            "size of an improvement", &error);
    work = memory.block = block_of(memory.bytes);
    require(hm_improve(plan, &(hm_points){x_new, y_new, 1}, &(hm_points_out){dx, dy, 1}, &memory,
                       NULL, &improved, &error),
            "an improvement", &error);
    check(improved.min_quality_before == report.min_quality &&
              improved.mean_quality_before == report.mean_quality,
          "it begins where the safe morph ended", &error);
    require(hm_assess(laplace, problem->mesh, &(hm_points){dx, dy, 1}, NULL, &(hm_points){x, y, 1},
                      NULL, NULL, &quality, &error),
            "its quality", &error);
    check(quality.min_quality == improved.min_quality && quality.inverted == 0,
          "it is what the report says", &error);
    check(improved.mean_quality > improved.mean_quality_before, "the mesh is better", &error);
    free(work);
    free(laplace_block);
    free(plan_block);
}

/* A basis is a block of bytes: copied, it is the same; cut short or changed, it is refused. */
static void attach(const hm_basis* basis, const hm_mesh* mesh) {
    hm_error error = {HM_OK};
    hm_basis_info info;
    HM_INIT(info);
    const hm_basis* copy = NULL;
    static double first[POINTS], second[POINTS];
    unsigned char* bytes;

    require(hm_basis_info_get(basis, &info, &error), "what the basis is", &error);
    check(info.solved == 1 && info.points == POINTS && info.functions == CONTROL, "its counts",
          &error);
    bytes = block_of((size_t)info.bytes);
    memcpy(bytes, basis, (size_t)info.bytes);
    require(hm_basis_attach(&copy, bytes, (size_t)info.bytes, mesh, &error), "a copy is attached",
            &error);
    require(hm_basis_values(basis, 3, 0, first, &error), "values of the basis", &error);
    require(hm_basis_values(copy, 3, 0, second, &error), "values of the copy", &error);
    check(memcmp(first, second, sizeof first) == 0, "they are the same", &error);
    check(hm_basis_attach(&copy, bytes, (size_t)info.bytes - 8, mesh, &error) == HM_BAD_BASIS,
          "cut short: refused", &error);
    bytes[info.bytes / 2] ^= 1;
    check(hm_basis_attach(&copy, bytes, (size_t)info.bytes, mesh, &error) == HM_BAD_BASIS,
          "a bit changed: refused", &error);
    free(bytes);
}

/* Cells of both kinds in two arrays are one mesh; triangles alone leave edges without a cell. */
static void two_arrays(hm_mesh mesh) {
    hm_error error = {HM_OK};
    hm_problem problem;
    HM_INIT(problem);
    hm_mesh_report report;
    HM_INIT(report);
    hm_analysis* analysis = NULL;
    void* block;
    hm_memory memory;

    problem.mesh = &mesh;
    require(hm_analysis_init(NULL, emptied(&memory), &problem, NULL, &error),
            "size of the analysis of both kinds of cells", &error);
    block = memory.block = block_of(memory.bytes);
    require(hm_analysis_init(&analysis, &memory, &problem, NULL, &error),
            "the analysis of both kinds", &error);
    require(hm_analysis_report(analysis, &report, &error), "the report on both kinds", &error);
    check(report.triangles == 2 * AROUND, "triangles of both kinds", &error);
    check(report.quads == CELLS - AROUND, "quads of both kinds", &error);
    check(report.boundary_loops == 2 && report.inverted == 0, "they are one mesh", &error);
    mesh.n_cells = 2 * AROUND;
    mesh.n_quads = 0;
    check(hm_analysis_init(&analysis, &memory, &problem, NULL, &error) == HM_BAD_MESH,
          "triangles alone", &error);
    check(strstr(error.text, "is not an edge of any cell") != NULL &&
              error.item == 1 + (RINGS - 1) * AROUND,
          "the first edge without a cell is named", &error);
    free(block);
}

int main(void) {
    hm_error none = {HM_OK};
    const hm_mesh mesh = make_mesh();
    hm_condition on_body; /* the far field has no condition, so it is fixed */
    HM_INIT(on_body);
    hm_problem problem;
    HM_INIT(problem);
    hm_basis* basis;
    void *curves_block = NULL, *basis_block = NULL;

    check(hm_abi_version() == HM_ABI && strcmp(hm_version(), HM_VERSION) == 0,
          "header and library fit", &none);
    problem.mesh = &mesh;
    problem.curves = fit_body(&mesh, &curves_block);
    problem.n_conditions = 1;
    problem.conditions = &on_body;
    on_body.marker = BODY;
    on_body.kind = HM_ON_CURVE;
    on_body.n_curves = 1;
    basis = solve(&problem, &basis_block);
    morph_safely(&problem, basis);
    free(curves_block);
    morph(basis, &mesh);
    attach(basis, &mesh);
    free(basis_block);
    two_arrays(with_triangles(mesh));

    printf("%d passed, %d failed\n", passed, failed);
    return failed != 0;
}
