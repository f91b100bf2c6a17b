/* Threads of OpenMP: the functions, a morph, its transpose and a safe morph have the same bits with
 * one thread and with four. tests/fuzz/sanitize.sh compiles this program with the thread sanitizer.
 */
#include <harmorph_openmp.h>

#include "use_case.h"

enum { NUMBERS = 4 * POINTS + 2 * CONTROL };

static void compute(const hm_mesh* mesh, const hm_curves* curves, int32_t operator_kind,
                    int32_t n_threads, double* result) {
    hm_memory memory;
    int i;
    double move[2 * CONTROL];
    double *dx = result, *dy = dx + POINTS, *far_x = dy + POINTS, *far_y = far_x + POINTS;
    hm_error error;
    hm_analysis* analysis;
    hm_plan* plan;
    hm_basis* basis;
    hm_executor executor = hm_openmp_executor(n_threads);
    hm_options options;
    hm_condition on_curve;
    hm_problem problem;
    HM_INIT(options);
    options.operator_kind = operator_kind;
    options.executor = &executor;
    HM_INIT(on_curve);
    on_curve.marker = BODY;
    on_curve.kind = HM_ON_CURVE;
    on_curve.n_curves = 1;
    HM_INIT(problem);
    problem.mesh = mesh;
    problem.curves = curves;
    problem.n_conditions = 1;
    problem.conditions = &on_curve;
    require(hm_analysis_init(NULL, emptied(&memory), &problem, &options, &error),
            "size of an analysis", &error);
    require(hm_analysis_init(&analysis, &(hm_memory){block_of(memory.bytes), memory.bytes},
                             &problem, &options, &error),
            "analysis", &error);
    require(hm_plan_init(NULL, emptied(&memory), analysis, &error), "size of a plan", &error);
    require(
        hm_plan_init(&plan, &(hm_memory){block_of(memory.bytes), memory.bytes}, analysis, &error),
        "plan", &error);
    require(hm_basis_init(NULL, emptied(&memory), analysis, &error), "size of a basis", &error);
    require(
        hm_basis_init(&basis, &(hm_memory){block_of(memory.bytes), memory.bytes}, analysis, &error),
        "basis", &error);
    require(hm_plan_factor(plan, NULL, &error), "factor", &error);
    require(hm_plan_solve(plan, basis, NULL, &error), "functions", &error);
    for (i = 0; i < CONTROL; ++i) {
        move[2 * i] = 0.01 * (i % 2);
        move[2 * i + 1] = 0.4;
    }
    {
        hm_points_out to = {dx, dy, 1}, far = {far_x, far_y, 1};
        hm_points by = {dx, dy, 1};
        hm_safe_target target;
        HM_INIT(target);
        target.move = move;
        require(hm_morph(basis, move, NULL, &to, &executor, &error), "morph", &error);
        require(hm_adjoint(basis, &by, result + 4 * POINTS, &executor, &error), "adjoint", &error);
        require(hm_move_safe(plan, basis, &target, NULL, emptied(&memory), NULL, NULL, &error),
                "size of a safe morph", &error);
        check(hm_move_safe(plan, basis, &target, &far,
                           &(hm_memory){block_of(memory.bytes), memory.bytes}, NULL, NULL,
                           &error) >= HM_OK,
              "safe morph", &error);
    }
}

int main(void) {
    static double one[NUMBERS], four[NUMBERS];
    const int32_t kinds[] = {HM_LAPLACE, HM_WEIGHTED, HM_CONFORMAL}, body[] = {BODY};
    hm_memory memory;
    int k;
    hm_error error;
    hm_fit_options fit;
    const hm_curves* curves;
    hm_mesh mesh = make_mesh();
    HM_INIT(fit);
    fit.n_control = CONTROL;
    fit.closed = HM_PERIODIC;
    require(hm_fit_marker(NULL, emptied(&memory), &mesh, 1, body, &fit, NULL, &error),
            "size of a fit", &error);
    require(hm_fit_marker(&curves, &(hm_memory){block_of(memory.bytes), memory.bytes}, &mesh, 1,
                          body, &fit, NULL, &error),
            "fit", &error);
    for (k = 0; k < 3; ++k) {
        compute(&mesh, curves, kinds[k], 1, one);
        compute(&mesh, curves, kinds[k], 4, four);
        check(memcmp(one, four, sizeof one) == 0, "one and four threads, the same bits", &error);
    }
    printf("%d passed, %d failed\n", passed, failed);
    return failed > 0;
}
