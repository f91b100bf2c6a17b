/* Functions by PETSc on parts of a mesh are those of the direct engine on the whole mesh. */
#include <harmorph_design.h>
#include <harmorph_study.h>
#include "check.h"

#include "../mpi_case.h"

#include <petscsys.h>

static void set_option(const char* name, const char* value) {
    if (value != NULL) {
        PetscOptionsSetValue(NULL, name, value);
    } else {
        PetscOptionsClearValue(NULL, name);
    }
}

void use_solver(int solver) {
#ifdef PETSC_USE_COMPLEX /* MUMPS has no Cholesky factor of Hermitian matrices */
    const char* const factor = "lu";
#else
    const char* const factor = "cholesky";
#endif
    set_option("-hm_ksp_type", solver == FACTORED ? "preonly" : NULL);
    set_option("-hm_pc_type", solver == FACTORED ? factor : NULL);
    set_option("-hm_pc_factor_mat_solver_type", solver == FACTORED ? "mumps" : NULL);
}

static void compare_functions(const reference* serial, const hm_basis* rows, const own_part* mine,
                              double* largest, int32_t* wrong_on_wall) {
    hm_basis_info info = {sizeof info};
    hm_error error;
    double *all = room(sizeof *all * (size_t)serial->mesh.n_points),
           *own = room(sizeof *own * (size_t)mine->n_points);
    int32_t i, number, k;
    *largest = 0;
    *wrong_on_wall = 0;
    need(hm_basis_info_get(rows, &info, &error), &error);
    for (i = 0; i < serial->functions; ++i) {
        for (number = 0; number < serial->numbers; ++number) {
            whole_values(serial, serial->basis, i, number, all);
            need(hm_basis_values(rows, i, number, own, &error), &error);
            for (k = 0; k < mine->n_points; ++k) {
                const double off = fabs(own[k] - all[mine->global[k]]);
                if (!(off <= *largest)) *largest = off;
            }
            for (k = 0; k < info.curve_points; ++k) {
                const int32_t point = info.curve_point[k];
                *wrong_on_wall += own[point] != all[mine->global[point]];
            }
        }
    }
    free(all);
    free(own);
    MPI_Allreduce(MPI_IN_PLACE, largest, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
}

/* Values at points of the curve against B-spline functions evaluated again: equal numbers. */
static void check_wall(const reference* serial, const hm_basis* rows, int32_t n_points) {
    hm_basis_info info = {sizeof info};
    hm_error error;
    double* own = room(sizeof *own * (size_t)n_points);
    int32_t i, k, c, wrong = 0;
    need(hm_basis_info_get(rows, &info, &error), &error);
    for (i = 0; i < info.control_points; ++i) {
        need(hm_basis_values(rows, i, 0, own, &error), &error);
        for (k = 0; k < info.curve_points; ++k) {
            int32_t control[6];
            double values[12], expected = 0;
            if (info.point_curve[k] >= info.curves) continue;
            need(hm_curve_basis(serial->problem.curves, info.point_curve[k], info.point_u[k], 0,
                                control, values, &error),
                 &error);
            for (c = 0; c <= serial->problem.curves->curve[info.point_curve[k]].degree; ++c) {
                if (control[c] == i) expected += values[c];
            }
            wrong += own[info.curve_point[k]] != expected;
        }
    }
    check(wrong == 0, "values on the wall are those of the B-spline", serial->name);
    free(own);
}

/* What the whole mesh says of one movement: by process 0. */
typedef struct expectation {
    double *displacement, *dj, *gradient;
    hm_step_report step;
    hm_quality_report quality;
} expectation;

static void expect(const reference* serial, const double* move, expectation* made) {
    const size_t n = (size_t)serial->mesh.n_points, m = 2 * (size_t)serial->functions;
    hm_error error;
    size_t k;
    made->displacement = room(2 * n * sizeof *made->displacement);
    made->dj = room(2 * n * sizeof *made->dj);
    made->gradient = room(m * sizeof *made->gradient);
    made->step = (hm_step_report){sizeof made->step};
    made->quality = (hm_quality_report){sizeof made->quality};
    for (k = 0; k < 2 * n; ++k) made->dj[k] = sin(1.7 * (double)k);
    if (rank == 0) {
        double *const x = made->displacement, *const dj = made->dj;
        need(hm_morph(serial->basis, move, NULL, &(hm_points_out){x, x + n, 1}, NULL, &error),
             &error);
        need(hm_assess(serial->basis, &serial->view, NULL, &(hm_points){x, x + n, 1}, NULL, NULL,
                       &made->step, &made->quality, &error),
             &error);
        need(hm_adjoint(serial->basis, &(hm_points){dj, dj + n, 1}, made->gradient, NULL, &error),
             &error);
    }
    MPI_Bcast(made->displacement, (int)(2 * n), MPI_DOUBLE, 0, MPI_COMM_WORLD);
    MPI_Bcast(made->gradient, (int)m, MPI_DOUBLE, 0, MPI_COMM_WORLD);
    MPI_Bcast(&made->step, (int)sizeof made->step, MPI_BYTE, 0, MPI_COMM_WORLD);
    MPI_Bcast(&made->quality, (int)sizeof made->quality, MPI_BYTE, 0, MPI_COMM_WORLD);
}

/* The quality of each own cell: the smallest one and the mean are those of the report; entries of
 * ghost cells stay. */
static void check_cells(const reference* serial, const own_part* mine, const double* cells,
                        const hm_quality_report* quality) {
    double least = 2, sums[2] = {0, 0};
    int32_t k, wrong = 0;
    for (k = 0; k < mine->n_cells; ++k) {
        const int is_ghost = mine->ghosts != NULL && mine->ghosts[k];
        if ((cells[k] == -1) != is_ghost) ++wrong;
        if (is_ghost) continue;
        least = fmin(least, cells[k]);
        sums[0] += cells[k];
        sums[1] += 1;
    }
    MPI_Allreduce(MPI_IN_PLACE, &least, 1, MPI_DOUBLE, MPI_MIN, MPI_COMM_WORLD);
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
    check(wrong == 0, "each own cell has a quality, and ghost cells have none", serial->name);
    check(least == quality->min_quality, "the least quality of a cell", serial->name);
    check(fabs(sums[0] / sums[1] - quality->mean_quality) < 1e-12, "the mean of the cells",
          serial->name);
}

static void check_use(const reference* serial, const hm_petsc* system, const hm_basis* rows,
                      const own_part* mine) {
    hm_step_report step = {sizeof step};
    hm_quality_report quality = {sizeof quality};
    hm_error error;
    expectation expected;
    const size_t n = (size_t)serial->mesh.n_points, n_own = (size_t)mine->n_points,
                 m = 2 * (size_t)serial->functions;
    double *own = room(2 * n_own * sizeof *own), *move = room(m * sizeof *move),
           *gradient = room(m * sizeof *gradient),
           *cells = room((size_t)mine->n_cells * sizeof *cells);
    double worst = 0;
    uint8_t* owned = room(n_own);
    size_t k;
    for (k = 0; k < m; ++k) move[k] = 0.01 * cos(3.0 * (double)k);
    expect(serial, move, &expected);
    need(hm_morph(rows, move, NULL, &(hm_points_out){own, own + n_own, 1}, NULL, &error), &error);
    for (k = 0; k < n_own; ++k) {
        const size_t at = (size_t)mine->global[k];
        worst = fmax(worst, fabs(own[k] - expected.displacement[at]));
        worst = fmax(worst, fabs(own[n_own + k] - expected.displacement[n + at]));
    }
    check(worst < 1e-8, "points move as on one process", serial->name);
    for (k = 0; k < (size_t)mine->n_cells; ++k) cells[k] = -1;
    quality.cell_quality = cells;
    need(hm_petsc_assess(system, rows, NULL, &(hm_points){own, own + n_own, 1}, &step, &quality,
                         NULL, MPI_COMM_WORLD, &error),
         &error);
    check(fabs(step.admissible / expected.step.admissible - 1) < 1e-6,
          "the admissible step is that of one process", serial->name);
    check(fabs(quality.min_quality - expected.quality.min_quality) < 1e-6,
          "the least quality is that of one process", serial->name);
    check(fabs(quality.mean_quality - expected.quality.mean_quality) < 1e-8,
          "the mean quality is that of one process", serial->name);
    check(quality.inverted == expected.quality.inverted, "as many cells are inverted",
          serial->name);
    check_cells(serial, mine, cells, &quality);
    need(hm_petsc_owned(system, owned, &error), &error);
    for (k = 0; k < n_own; ++k) {
        own[k] = owned[k] ? expected.dj[mine->global[k]] : 0;
        own[n_own + k] = owned[k] ? expected.dj[n + (size_t)mine->global[k]] : 0;
    }
    need(hm_mpi_adjoint(rows, &(hm_points){own, own + n_own, 1}, gradient, NULL, MPI_COMM_WORLD,
                        &error),
         &error);
    for (worst = 0, k = 0; k < m; ++k)
        worst = fmax(worst, fabs(gradient[k] - expected.gradient[k]));
    check(worst < 1e-8 * (double)n, "the gradient is that of one process", serial->name);
    free(expected.displacement);
    free(expected.dj);
    free(expected.gradient);
    free(own);
    free(owned);
    free(move);
    free(gradient);
    free(cells);
}

void check_agreement(const reference* serial, int kind, int solver) {
    own_part mine;
    int* const part_of = partition(&serial->mesh, kind, size);
    hm_petsc* system = NULL;
    hm_petsc_report report = {sizeof report};
    hm_basis* rows = NULL;
    hm_error error = {0};
    hm_memory memory;
    void* block;
    hm_status status;
    double off;
    int32_t wrong_on_wall;
    char what[240];
    take_part(&mine, &serial->mesh, part_of, rank, kind == GHOSTS);
    free(part_of);
    use_solver(solver);
    need(hm_petsc_create(&system, &mine.part, &serial->problem, &serial->options, MPI_COMM_WORLD,
                         &error),
         &error);
    need(hm_petsc_solve(system, NULL, emptied(&memory), NULL, MPI_COMM_WORLD, &error), &error);
    block = memory.block = room(memory.bytes);
    status = hm_petsc_solve(system, &rows, &memory, &report, MPI_COMM_WORLD, &error);
    need(status, &error);
    compare_functions(serial, rows, &mine, &off, &wrong_on_wall);
    snprintf(what, sizeof what,
             "%s, %s: off by %.1e, status %d, error %.1e, %d iterations, %d solutions",
             partition_names[kind], solver == FACTORED ? "MUMPS" : "iterative", off, (int)status,
             report.error, (int)report.iterations, (int)report.solutions);
    check(off < (solver == FACTORED ? 1e-11 : 1e-8), what, serial->name);
    check(status == HM_OK, what, serial->name);
    if (verbose && rank == 0) printf("    %s, %d processes: %s\n", serial->name, size, what);
    check(wrong_on_wall == 0, "values on the wall are those of the direct engine, bit for bit",
          serial->name);
    if (serial->options.offset_correction == 0) check_wall(serial, rows, mine.n_points);
    check_use(serial, system, rows, &mine);
    hm_petsc_free(&system);
    check(system == NULL, "free leaves NULL", serial->name);
    use_solver(ITERATIVE);
    free(block);
    free_part(&mine);
}
