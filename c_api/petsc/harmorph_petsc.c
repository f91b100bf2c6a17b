/* The calls of harmorph_petsc.h. This file includes the other files of this folder: compile this
 * file alone. */
#include "harmorph_petsc.h"
#include "private.h"

#include "mpi/agreement.h"
#include "petsc/agreement.h"
#include "petsc/mail.h"
#include "petsc/owners.h"
#include "petsc/part.h"
#include "petsc/problem.h"
#include "petsc/scalars.h"
#include "petsc/matrix.h"
#include "petsc/solution.h"

/* ---- Creation ---- */

/* The checks that need no message. */
static hm_status begin_system(hm_petsc* made, hm_petsc** system, const hm_part_mesh* part,
                              MPI_Comm comm, hm_error* err) {
    PetscBool running = PETSC_FALSE;
    if (made == NULL) return no_memory(err);
    if (system == NULL) return refuse_argument(err, "system is NULL");
    PetscInitialized(&running);
    if (refuse_other_version(err) < 0) return err->code;
    if (!running) return refuse_argument(err, "PetscInitialize has not been called");
    made->comm = comm;
    MPI_Comm_rank(comm, &made->rank);
    MPI_Comm_size(comm, &made->size);
    return take_part(made, part, err);
}

/* The systems of process 0 have different numbers: all processes get that of the new one. */
static hm_status number_system(hm_petsc* made, hm_error* err) {
    PetscObjectId number = 0;
    hm_status status = agree(
        petsc_status(PetscObjectGetId((PetscObject)made->matrix, &number), err), made->comm, err);
    made->number = number;
    MPI_Bcast(&made->number, 1, MPI_INT64_T, 0, made->comm);
    return status;
}

/* Makes the part and the equations. The status is a warning if points are far from their curve. */
static hm_status fill_system(hm_petsc* made, const hm_problem* problem, const hm_options* options,
                             hm_error* err) {
    hm_private_edge *edges = NULL, *all = NULL;
    int32_t n = 0;
    hm_status status = agree(take_edges(made, &edges, &n, err), made->comm, err), next;
    if (status >= 0) status = own_points(made, edges, n, err);
    if (status >= 0) status = gather_boundary(made, edges, n, &all, &made->boundary_edges, err);
    if (status >= 0) {
        status = agree(make_equations(made, all, made->boundary_edges, problem, options, err),
                       made->comm, err);
    }
    free(edges);
    free(all);
    if (status < 0) return status;
    next = compare_problems(made, problem, options, err);
    if (next >= 0) next = make_matrix(made, err);
    if (next >= 0) next = agree(petsc_status(make_solver(made), err), made->comm, err);
    if (next >= 0) next = number_system(made, err);
    return next < 0 ? next : status;
}

hm_status hm_petsc_create(hm_petsc** system, const hm_part_mesh* part, const hm_problem* problem,
                          const hm_options* options, MPI_Comm comm, hm_error* err) {
    hm_petsc* made = NULL;
    hm_status status;
    BEGIN_CALL(comm, err);
    made = room_for(1, sizeof *made);
    status = agree(begin_system(made, system, part, comm, err), comm, err);
    if (status >= 0) status = fill_system(made, problem, options, err);
    if (status < 0) {
        hm_petsc_free(&made);
    } else {
        *system = made;
    }
    return status;
}

void hm_petsc_free(hm_petsc** system) {
    hm_petsc* const old = system != NULL ? *system : NULL;
    if (old == NULL) return;
    if (old->solver != NULL) KSPDestroy(&old->solver);
    if (old->matrix != NULL) MatDestroy(&old->matrix);
    if (old->to_local != NULL) VecScatterDestroy(&old->to_local);
    if (old->local != NULL) VecDestroy(&old->local);
    free(old->part_block);
    free(old->equations_block);
    free(old->owned);
    free(old);
    *system = NULL;
}

/* ---- Solution ---- */

/* Collective; the status is that of this process. */
static hm_status check_system(const hm_petsc* system, MPI_Comm comm, hm_error* err) {
    const int64_t number = system != NULL ? system->number : 0;
    const int differs = differs_from_first(&number, 1, comm);
    int is_same = MPI_UNEQUAL;
    if (system == NULL) return refuse_argument(err, "system is NULL");
    MPI_Comm_compare(system->comm, comm, &is_same);
    if (is_same != MPI_IDENT && is_same != MPI_CONGRUENT)
        return refuse_argument(err, "comm is not the communicator of hm_petsc_create");
    return differs ? refuse_argument(err, "system is not the one that rank 0 passes") : HM_OK;
}

static hm_status check_report(const hm_petsc_report* report, hm_error* err) {
    if (report == NULL || is_struct_size(report->struct_size)) return HM_OK;
    return refuse_argument(err, "report.struct_size is wrong");
}

/* Says how many bytes the rows of each process take. */
static hm_status count_rows(const hm_petsc* system, hm_memory* memory, MPI_Comm comm,
                            hm_error* err) {
    size_t bytes = 0;
    hm_status status = check_system(system, comm, err);
    if (status >= 0) status = hm_private_rows_size(system->equations, &bytes, err);
    status = agree(status, comm, err);
    if (status >= 0) memory->bytes = bytes;
    return status;
}

hm_status hm_petsc_solve(hm_petsc* system, hm_basis** rows, hm_memory* memory,
                         hm_petsc_report* report, MPI_Comm comm, hm_error* err) {
    hm_petsc_report found = {sizeof found};
    hm_basis* made = NULL;
    columns wanted;
    hm_status status;
    BEGIN_CALL(comm, err);
    status = agree_on_query(memory, comm, err);
    if (status < 0) return status;
    if (asks(memory)) return count_rows(system, memory, comm, err);
    status = check_system(system, comm, err);
    if (status >= 0) status = check_report(report, err);
    if (status >= 0 && rows == NULL) status = refuse_argument(err, "rows is NULL");
    if (status >= 0 && memory == NULL) status = refuse_argument(err, "memory is NULL");
    if (status >= 0)
        status = hm_private_rows_init(&made, memory->block, memory->bytes, system->equations, err);
    status = agree(status, comm, err);
    if (status < 0) return status;
    memset(&wanted, 0, sizeof wanted);
    wanted.system = system;
    wanted.rows = made;
    wanted.n = system->info.columns;
    status = solve_all(&wanted, &found, err);
    if (status >= 0)
        status = agree(hm_private_rows_finish(system->equations, made, 0, err), comm, err);
    if (status < 0) return status;
    *rows = made;
    return finish_report(system, &found, report, err);
}

/* Makes the right-hand sides of one field. */
static hm_status begin_field(columns* wanted, const hm_points_out* displacement, hm_error* err) {
    const hm_petsc* const system = wanted->system;
    const size_t length = length_of_column(system) * (size_t)system->info.field_columns;
    hm_points given;
    if (displacement == NULL) return refuse_argument(err, "displacement is NULL");
    wanted->n = system->info.field_columns;
    wanted->work = room_for(2 * (size_t)system->mesh.n_points, sizeof *wanted->work);
    wanted->numbers = room_for(2 * length, sizeof *wanted->numbers);
    if (wanted->work == NULL || wanted->numbers == NULL) return no_memory(err);
    wanted->residuals = wanted->numbers + length;
    given.x = displacement->x;
    given.y = displacement->y;
    given.stride = displacement->stride;
    return hm_private_field_init(system->equations, &given, wanted->work, wanted->numbers, err);
}

hm_status hm_petsc_displace(hm_petsc* system, const hm_points_out* displacement,
                            hm_petsc_report* report, MPI_Comm comm, hm_error* err) {
    hm_petsc_report found = {sizeof found};
    columns wanted;
    hm_status status;
    BEGIN_CALL(comm, err);
    memset(&wanted, 0, sizeof wanted);
    wanted.system = system;
    status = check_system(system, comm, err);
    if (status >= 0) status = check_report(report, err);
    if (status >= 0) status = begin_field(&wanted, displacement, err);
    status = agree(status, comm, err);
    if (status >= 0) status = solve_all(&wanted, &found, err);
    if (status >= 0) {
        status = agree(hm_private_field_finish(system->equations, wanted.work, wanted.numbers,
                                               displacement, err),
                       comm, err);
    }
    free(wanted.work);
    free(wanted.numbers);
    return status < 0 ? status : finish_report(system, &found, report, err);
}

/* ---- The whole mesh ---- */

hm_status hm_petsc_owned(const hm_petsc* system, uint8_t* owned, hm_error* err) {
    if (system == NULL || owned == NULL) return refuse_argument(err, "system or owned is NULL");
    memcpy(owned, system->owned, (size_t)system->mesh.n_points);
    return HM_OK;
}

/* The smallest value of all processes, and the process that has this value. */
static void find_least(double* value, int* rank, MPI_Comm comm) {
    struct {
        double value;
        int rank;
    } own, of_all;
    MPI_Comm_rank(comm, &own.rank);
    own.value = *value;
    MPI_Allreduce(&own, &of_all, 1, MPI_DOUBLE_INT, MPI_MINLOC, comm);
    *value = of_all.value;
    *rank = of_all.rank;
}

/* Replaces the reports of this process by those of the whole mesh. */
static void reduce_reports(hm_step_report* step, hm_quality_report* quality, int32_t n_cells,
                           int ranks[2], MPI_Comm comm) {
    double sums[2];
    sums[0] = quality->mean_quality * n_cells;
    sums[1] = n_cells;
    find_least(&step->admissible, &ranks[0], comm);
    find_least(&quality->min_quality, &ranks[1], comm);
    MPI_Bcast(&step->cell, 1, MPI_INT32_T, ranks[0], comm);
    MPI_Bcast(&step->point, 1, MPI_INT32_T, ranks[0], comm);
    MPI_Bcast(&quality->min_quality_cell, 1, MPI_INT32_T, ranks[1], comm);
    MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, comm);
    MPI_Allreduce(MPI_IN_PLACE, &quality->inverted, 1, MPI_INT32_T, MPI_SUM, comm);
    MPI_Allreduce(MPI_IN_PLACE, &quality->min_area, 1, MPI_DOUBLE, MPI_MIN, comm);
    quality->first_inverted = quality->inverted > 0 ? quality->min_quality_cell : -1;
    quality->mean_quality = sums[0] / sums[1];
}

/* The number of a cell in the caller's mesh. */
static int32_t given_cell(const hm_mesh* own, const int32_t* cell, int32_t k) {
    return k < 0 || cell == NULL ? k : cell[k - own->index_base] + own->index_base;
}

/* Copies the quality of own cells to their places in the caller's array, which has ghost cells,
 * too. */
static void put_cells(const double* of_own, const hm_mesh* own, const int32_t* cell, double* all) {
    int32_t k;
    for (k = 0; k < own->n_cells; ++k) all[cell == NULL ? k : cell[k]] = of_own[k];
}

hm_status hm_petsc_assess(const hm_petsc* system, const hm_basis* rows, const hm_points* from,
                          const hm_points* displacement, hm_step_report* step,
                          hm_quality_report* quality, int* rank, MPI_Comm comm, hm_error* err) {
    hm_step_report found_step = {sizeof found_step};
    hm_quality_report found = {sizeof found}, asked = {sizeof asked};
    hm_mesh own = {sizeof own};
    const int32_t* cell = NULL;
    double* of_own = NULL;
    int ranks[2];
    hm_status status;
    BEGIN_CALL(comm, err);
    status = check_system(system, comm, err);
    if (status >= 0 && (step == NULL || quality == NULL || !is_struct_size(step->struct_size) ||
                        !is_struct_size(quality->struct_size))) {
        status = refuse_argument(err, "step or quality is NULL, or its struct_size is wrong");
    }
    if (status >= 0) memcpy(&asked, quality, known_bytes(quality->struct_size, sizeof asked));
    if (status >= 0) status = hm_private_part_cells(system->part, &own, &cell, err);
    if (status >= 0 && asked.cell_quality != NULL) {
        of_own = room_for((size_t)own.n_cells, sizeof *of_own);
        if (of_own == NULL) status = no_memory(err);
    }
    found.cell_quality = of_own;
    if (status >= 0)
        status = hm_assess(rows, &own, from, displacement, NULL, NULL, &found_step, &found, err);
    status = agree(status, comm, err);
    if (status >= 0 && of_own != NULL) put_cells(of_own, &own, cell, asked.cell_quality);
    free(of_own);
    if (status < 0) return status;
    found_step.cell = given_cell(&own, cell, found_step.cell);
    found.min_quality_cell = given_cell(&own, cell, found.min_quality_cell);
    reduce_reports(&found_step, &found, own.n_cells, ranks, comm);
    found_step.struct_size = step->struct_size;
    found.struct_size = quality->struct_size;
    found.cell_quality = asked.cell_quality;
    memcpy(step, &found_step, known_bytes(step->struct_size, sizeof found_step));
    memcpy(quality, &found, known_bytes(quality->struct_size, sizeof found));
    if (rank != NULL) memcpy(rank, ranks, sizeof ranks);
    return HM_OK;
}

/* ---- Fortran ---- */

hm_status hm_petsc_create_f(hm_petsc** system, const hm_part_mesh* part, const hm_problem* problem,
                            const hm_options* options, MPI_Fint comm, hm_error* err) {
    return hm_petsc_create(system, part, problem, options, MPI_Comm_f2c(comm), err);
}

hm_status hm_petsc_solve_f(hm_petsc* system, hm_basis** rows, hm_memory* memory,
                           hm_petsc_report* report, MPI_Fint comm, hm_error* err) {
    return hm_petsc_solve(system, rows, memory, report, MPI_Comm_f2c(comm), err);
}

hm_status hm_petsc_displace_f(hm_petsc* system, const hm_points_out* displacement,
                              hm_petsc_report* report, MPI_Fint comm, hm_error* err) {
    return hm_petsc_displace(system, displacement, report, MPI_Comm_f2c(comm), err);
}

hm_status hm_petsc_assess_f(const hm_petsc* system, const hm_basis* rows, const hm_points* from,
                            const hm_points* displacement, hm_step_report* step,
                            hm_quality_report* quality, int* rank, MPI_Fint comm, hm_error* err) {
    return hm_petsc_assess(system, rows, from, displacement, step, quality, rank,
                           MPI_Comm_f2c(comm), err);
}
