/* Given displacements, modes and combined functions on parts are those of the whole mesh. */
#include <harmorph_bases.h>
#include <harmorph_study.h>
#include "check.h"

#include "../mpi_case.h"

/* Displacements at points of the wall, elsewhere what is to be replaced. */
static void set_wall(const double* x, const double* y, size_t n, double* to) {
    size_t k;
    for (k = 0; k < n; ++k) {
        to[k] = 0.01 * sin(2 * x[k]);
        to[n + k] = 0.02 * cos(y[k]);
    }
}

typedef struct expectation { /* at all points of the mesh: displacement, and function of a mode of
                                the same values */
    double *field, *mode;    /* [2 * n_points] */
} expectation;

static void displace_whole(reference* serial, expectation* made) {
    const size_t n = (size_t)serial->mesh.n_points;
    double *all = room(2 * sizeof *all * n), *wall, *modes;
    hm_error error;
    hm_analysis* analysis;
    hm_basis *basis, *tabulated;
    hm_modes table = {sizeof table};
    void *blocks[2], *work, *block;
    hm_memory memory;
    size_t k, n_wall;
    int32_t listed = 0, *list, number;
    hm_plan* const plan = make_plan(serial, blocks, &analysis);
    hm_given_points(plan, NULL, 0, &listed, &error);
    n_wall = (size_t)listed;
    list = room(sizeof *list * n_wall);
    wall = room(2 * sizeof *wall * n_wall);
    modes = room(2 * sizeof *modes * n_wall);
    need(hm_given_points(plan, list, listed, &listed, &error), &error);
    set_wall(serial->mesh.x, serial->mesh.y, n, all);
    for (k = 0; k < n_wall; ++k) {
        modes[2 * k] = wall[k] = all[list[k]];
        modes[2 * k + 1] = wall[n_wall + k] = all[n + (size_t)list[k]];
    }
    need(hm_displace(plan, 0, NULL, 1, NULL, NULL, NULL, emptied(&memory), NULL, &error), &error);
    work = memory.block = room(memory.bytes);
    need(hm_displace(plan, listed, list, 1, &(hm_points){wall, wall + n_wall, 1}, NULL,
                     &(hm_points_out){made->field, made->field + n, 1}, &memory, NULL, &error),
         &error);
    free(work);
    need(hm_basis_init(NULL, emptied(&memory), analysis, &error), &error);
    serial->basis_block = memory.block = room(memory.bytes);
    need(hm_basis_init(&basis, &memory, analysis, &error), &error);
    need(hm_plan_solve(plan, basis, NULL, &error), &error);
    table.n_modes = 1;
    table.n = listed;
    table.points = list;
    table.values = modes;
    need(hm_tabulate(NULL, emptied(&memory), plan, basis, &table, NULL, &error), &error);
    block = memory.block = room(memory.bytes);
    need(hm_tabulate(&tabulated, &memory, plan, basis, &table, NULL, &error), &error);
    for (number = 0; number < 2;
         ++number) { /* the function of the mode is the last one; x and y by amplitude (1, 0) */
        hm_basis_info info = {sizeof info};
        need(hm_basis_info_get(tabulated, &info, &error), &error);
        need(hm_basis_values(tabulated, info.functions - 1, number * info.numbers_per_value / 2,
                             made->mode + (size_t)number * n, &error),
             &error);
    }
    free(blocks[0]);
    free(blocks[1]);
    free(block);
    free(list);
    free(wall);
    free(modes);
    free(all);
}

void check_given(reference* serial, int kind, int solver) {
    const size_t n = (size_t)serial->mesh.n_points;
    own_part mine;
    hm_petsc* system = NULL;
    hm_petsc_report report = {sizeof report};
    hm_error error;
    expectation expected;
    size_t k, n_own;
    double *own, worst = 0, off_mode = 0;
    int* part_of;
    serial->conditions[0].kind = HM_GIVEN;
    serial->conditions[0].n_curves = 0;
    serial->problem.curves = NULL;
    part_of = partition(&serial->mesh, kind, size);
    take_part(&mine, &serial->mesh, part_of, rank, kind == GHOSTS);
    expected.field = room(2 * sizeof(double) * n);
    expected.mode = room(2 * sizeof(double) * n);
    if (rank == 0) displace_whole(serial, &expected);
    MPI_Bcast(expected.field, (int)(2 * n), MPI_DOUBLE, 0, MPI_COMM_WORLD);
    MPI_Bcast(expected.mode, (int)(2 * n), MPI_DOUBLE, 0, MPI_COMM_WORLD);
    n_own = (size_t)mine.n_points;
    own = room(2 * sizeof *own * n_own);
    set_wall(mine.x, mine.y, n_own, own);
    use_solver(solver);
    need(hm_petsc_create(&system, &mine.part, &serial->problem, &serial->options, MPI_COMM_WORLD,
                         &error),
         &error);
    need(hm_petsc_displace(system, &(hm_points_out){own, own + n_own, 1}, &report, MPI_COMM_WORLD,
                           &error),
         &error);
    for (k = 0; k < 2 * n_own; ++k) {
        const size_t at = k < n_own ? (size_t)mine.global[k] : n + (size_t)mine.global[k - n_own];
        worst = fmax(worst, fabs(own[k] - expected.field[at]));
        off_mode = fmax(off_mode, fabs(own[k] - expected.mode[at]));
    }
    check(worst < 1e-10, "given displacements are those of one process", serial->name);
    check(off_mode < 1e-10, "a displacement is the function of the mode with the same values",
          serial->name);
    hm_petsc_free(&system);
    use_solver(ITERATIVE);
    free(expected.field);
    free(expected.mode);
    free(own);
    free(part_of);
    free_part(&mine);
}

/* A second basis of two variables; its block is to be freed. */
static hm_basis* combine(const hm_basis* from, int32_t controls, void** block) {
    double* matrix = room(4 * sizeof *matrix * (size_t)controls);
    hm_basis* made = NULL;
    hm_error error;
    hm_memory memory;
    int32_t k;
    for (k = 0; k < 4 * controls; ++k) matrix[k] = cos(3.0 * k);
    need(hm_combine(NULL, emptied(&memory), from, 2, 2, NULL, &error), &error);
    *block = memory.block = room(memory.bytes);
    need(hm_combine(&made, &memory, from, 2, 2, matrix, &error), &error);
    free(matrix);
    return made;
}

void check_combined(const reference* serial, int kind, int solver) {
    own_part mine;
    int* const part_of = partition(&serial->mesh, kind, size);
    hm_petsc* system = NULL;
    hm_basis *rows = NULL, *all = NULL, *own;
    hm_error error;
    void *block, *all_block = NULL, *own_block;
    hm_memory memory;
    double *expected = room(sizeof *expected * (size_t)serial->mesh.n_points), *values, worst = 0;
    int32_t i, number, k;
    take_part(&mine, &serial->mesh, part_of, rank, kind == GHOSTS);
    values = room(sizeof *values * (size_t)mine.n_points);
    use_solver(solver);
    need(hm_petsc_create(&system, &mine.part, &serial->problem, &serial->options, MPI_COMM_WORLD,
                         &error),
         &error);
    need(hm_petsc_solve(system, NULL, emptied(&memory), NULL, MPI_COMM_WORLD, &error), &error);
    block = memory.block = room(memory.bytes);
    need(hm_petsc_solve(system, &rows, &memory, NULL, MPI_COMM_WORLD, &error), &error);
    hm_petsc_free(&system); /* the rows stay */
    use_solver(ITERATIVE);
    own = combine(rows, serial->controls, &own_block);
    if (rank == 0) all = combine(serial->basis, serial->controls, &all_block);
    for (i = 0; i < 2; ++i) {
        for (number = 0; number < 2; ++number) {
            whole_values(serial, all, i, number, expected);
            need(hm_basis_values(own, i, number, values, &error), &error);
            for (k = 0; k < mine.n_points; ++k)
                worst = fmax(worst, fabs(values[k] - expected[mine.global[k]]));
        }
    }
    check(worst < 1e-8, "functions of design variables are those of one process", serial->name);
    free(all_block);
    free(own_block);
    free(block);
    free(expected);
    free(values);
    free(part_of);
    free_part(&mine);
}
