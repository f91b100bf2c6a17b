/* Checksums of fits, bases, morphs and all that follows, with the baseline kernel: the same lines
 * on every processor.
 *
 *     morphs                 prints the checksums
 *     morphs save FILE       writes a basis in single precision
 *     morphs attach FILE     attaches a basis that another machine wrote: the checksum of its use,
 * or the refusal */
#include <harmorph_bases.h>
#include <harmorph_study.h>
#include "../../c_api/memory.h"
#include "case.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static case_memory memory;
static double x_new[POINTS], y_new[POINTS];
static int32_t triangles[6 * (NI - 1) * (NJ - 1)];

static const struct {
    const char* name;
    int32_t operator_kind, scheme, engine;
    int safe; /* a safe morph, too: substeps and untangling take most of the time */
} methods[] = {{"conformal", HM_CONFORMAL, HM_COMPACT, HM_DIRECT, 1},
               {"Laplace", HM_LAPLACE, HM_COMPACT, HM_DIRECT, 0},
               {"weighted", HM_WEIGHTED, HM_COMPACT, HM_DIRECT, 0},
               {"bounded", HM_LAPLACE, HM_BOUNDED, HM_DIRECT, 1},
               {"nodal gradients", HM_LAPLACE, HM_NODAL_GRADIENT, HM_DIRECT, 0},
               {"multigrid", HM_LAPLACE, HM_COMPACT, HM_MULTIGRID, 0},
               {"FAS", HM_LAPLACE, HM_COMPACT, HM_FAS, 0}};

static hm_error error;

static void check(hm_status status, const char* what) {
    if (status >= 0) return;
    printf("refused: %s: %s: %s\n", what, hm_status_name(status), error.text);
    exit(1);
}
static void* block_of(size_t bytes) {
    void* block = malloc(bytes);
    if (block == NULL) exit(1);
    return block;
}
static void say(const char* mesh, const char* method, const char* what, uint64_t sum) {
    printf("%s, %s, %s: %08lx%08lx\n", mesh, method, what, (unsigned long)(sum >> 32),
           (unsigned long)(sum & 0xffffffffu));
}

static const hm_curves* fit(void** block) {
    hm_fit_options options;
    hm_points wall;
    const hm_curves* curves = NULL;
    hm_memory room;
    HM_INIT(options);
    options.n_control = CONTROL;
    options.closed = HM_PERIODIC;
    wall.x = memory.x, wall.y = memory.y, wall.stride = 1;
    check(hm_fit(NULL, emptied(&room), NULL, NI - 1, 0, &options, NULL, &error),
          "the size of hm_fit");
    *block = room.block = block_of(room.bytes);
    check(hm_fit(&curves, &room, &wall, NI - 1, 1, &options, NULL, &error), "hm_fit");
    return curves;
}

/* The plan and the basis of a method; blocks [3] are the caller's to free. */
static hm_plan* solve(const hm_mesh* mesh, const hm_curves* curves, int method, hm_basis** basis,
                      void** blocks) {
    hm_condition on_curve;
    hm_problem problem;
    hm_executor executor;
    hm_options options;
    hm_study_options study;
    hm_analysis* analysis = NULL;
    hm_plan* plan = NULL;
    hm_memory room;
    HM_INIT(on_curve);
    HM_INIT(problem);
    HM_INIT(options);
    HM_INIT(study);
    on_curve.marker = WALL;
    on_curve.kind = HM_ON_CURVE;
    on_curve.n_curves = 1;
    problem.mesh = mesh;
    problem.curves = curves;
    problem.n_conditions = 1;
    problem.conditions = &on_curve;
    HM_INIT(executor);
    executor.kernel = HM_KERNEL_BASELINE;
    options.executor = &executor;
    options.operator_kind = methods[method].operator_kind;
    options.engine = methods[method].engine;
    study.scheme = methods[method].scheme;
    options.study = &study;
    check(hm_analysis_init(NULL, emptied(&room), &problem, &options, &error),
          "the size of hm_analysis");
    check(hm_analysis_init(&analysis, &(hm_memory){blocks[0] = block_of(room.bytes), room.bytes},
                           &problem, &options, &error),
          "hm_analysis_init");
    check(hm_plan_init(NULL, emptied(&room), analysis, &error), "the size of hm_plan");
    check(hm_plan_init(&plan, &(hm_memory){blocks[1] = block_of(room.bytes), room.bytes}, analysis,
                       &error),
          "hm_plan_init");
    check(hm_basis_init(NULL, emptied(&room), analysis, &error), "the size of hm_basis");
    check(hm_basis_init(basis, &(hm_memory){blocks[2] = block_of(room.bytes), room.bytes}, analysis,
                        &error),
          "hm_basis_init");
    check(hm_plan_factor(plan, NULL, &error), "hm_plan_factor");
    check(hm_plan_solve(plan, *basis, NULL, &error), "hm_plan_solve");
    return plan;
}

static void print_safe_morph(const hm_mesh* mesh, const char* name, const char* method,
                             hm_plan* plan, const hm_basis* basis) {
    const hm_points to_read = {x_new, y_new, 1};
    const hm_points_out to = {x_new, y_new, 1};
    hm_quality_report quality;
    uint64_t sum;
    void* work;
    hm_memory room;
    hm_safe_target target;
    HM_INIT(target);
    HM_INIT(quality);
    make_move(1, memory.move);
    target.move = memory.move;
    check(hm_move_safe(plan, basis, &target, NULL, emptied(&room), NULL, NULL, &error),
          "the size of hm_move_safe");
    work = room.block = block_of(room.bytes);
    check(hm_move_safe(plan, basis, &target, &to, &room, NULL, NULL, &error), "hm_move_safe");
    free(work);
    check(hm_assess(basis, mesh, &to_read, NULL, &mesh->points, NULL, NULL, &quality, &error),
          "hm_assess");
    sum = add_numbers(add_numbers(empty_sum, x_new, POINTS), y_new, POINTS);
    say(name, method, "safe morph", add_numbers(sum, &quality.mean_quality, 1));
}

static void print_sums(const hm_mesh* mesh, const char* name) {
    void *curve_block, *blocks[3];
    const hm_curves* curves = fit(&curve_block);
    int method;
    say(name, "cubic", "fit", add_numbers(empty_sum, curves->control, 2 * CONTROL));
    for (method = 0; method < (int)(sizeof methods / sizeof methods[0]); ++method) {
        hm_basis* basis = NULL;
        hm_plan* plan = solve(mesh, curves, method, &basis, blocks);
        hm_basis_info info;
        uint64_t sum;
        HM_INIT(info);
        check(hm_basis_info_get(basis, &info, &error), "hm_basis_info_get");
        check(use_basis(basis, info.bytes, mesh, &memory, &sum, &error), "hm_morph");
        say(name, methods[method].name, "morph", sum);
        make_mesh(&memory);
        if (methods[method].safe) print_safe_morph(mesh, name, methods[method].name, plan, basis);
        free(blocks[0]), free(blocks[1]), free(blocks[2]);
    }
    free(curve_block);
}

static int save(const hm_mesh* mesh, const char* path) {
    void *curve_block, *blocks[3];
    hm_basis *basis = NULL, *single = NULL;
    hm_basis_info info;
    hm_memory room;
    FILE* file = fopen(path, "wb");
    HM_INIT(info);
    solve(mesh, fit(&curve_block), 0, &basis, blocks);
    check(hm_single_init(NULL, emptied(&room), basis, &error), "the size of hm_single");
    room.block = block_of(room.bytes);
    check(hm_single_init(&single, &room, basis, &error), "hm_single_init");
    check(hm_basis_info_get(single, &info, &error), "hm_basis_info_get");
    return file == NULL || fwrite(single, 1, info.bytes, file) != info.bytes || fclose(file) != 0;
}

static int attach(const hm_mesh* mesh, const char* path) {
    FILE* file = fopen(path, "rb");
    const size_t room = (size_t)1 << 20;
    void* block = block_of(room);
    const size_t bytes = file == NULL ? 0 : fread(block, 1, room, file);
    uint64_t sum;
    check(use_basis(block, bytes, mesh, &memory, &sum, &error), "hm_basis_attach");
    say("attached", "single precision", "use", sum);
    return 0;
}

int main(int n, char** arguments) {
    hm_mesh mesh = make_mesh(&memory);
    int32_t i, j, *to = triangles;
    if (n == 3 && strcmp(arguments[1], "save") == 0) return save(&mesh, arguments[2]);
    if (n == 3 && strcmp(arguments[1], "attach") == 0) return attach(&mesh, arguments[2]);
    print_sums(&mesh, "quadrilaterals");
    for (j = 0; j < NJ - 1; ++j) {
        for (i = 0; i < NI - 1; ++i) {
            const int32_t a = i + NI * j;
            *to++ = a, *to++ = a + 1, *to++ = a + NI + 1;
            *to++ = a, *to++ = a + NI + 1, *to++ = a + NI;
        }
    }
    mesh.cell_layout = HM_CELLS_TRIANGLES;
    mesh.n_cells = 2 * (NI - 1) * (NJ - 1);
    mesh.cell_points = triangles;
    mesh.ni = mesh.nj = 0;
    print_sums(&mesh, "triangles");
    return 0;
}
