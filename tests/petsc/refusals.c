/* What is wrong on one process alone is refused by all of them; none waits for ever. */
#include <harmorph_parts.h>
#include "check.h"

#include "../mpi_case.h"

#include <string.h>

/* All processes have the same negative status; the one that is to blame has the reason. */
static void check_refused(hm_status own, const hm_error* error, int is_possible, const char* what) {
    hm_status least, most;
    MPI_Allreduce(&own, &least, 1, MPI_INT32_T, MPI_MIN, MPI_COMM_WORLD);
    MPI_Allreduce(&own, &most, 1, MPI_INT32_T, MPI_MAX, MPI_COMM_WORLD);
    check(least == most, "all processes have the same status", what);
    if (!is_possible) return;
    check(own < 0, "refused", what);
    check(error->text[0] != 0, "with a text", what);
    if (verbose)
        printf("    process %d: %s: %s (item %d)\n", rank, what, error->text, (int)error->item);
}

/* ---- Parts ---- */

enum {
    POSITION,
    GAP,
    NO_MARKER,
    MARKED_INSIDE,
    NUMBERS,
    INSIDE_TWICE,
    NO_OWNER,
    NO_CELLS,
    N_FAULTS
};
static const char* const fault_names[N_FAULTS] = {
    "two positions",         "a gap",         "no marker",
    "a marker inside",       "wrong numbers", "the same numbers inside two parts",
    "a ghost without owner", "no cells"};

static void set_marker_inside(own_part* mine) {
    const int32_t* const cell = mine->cells + 4 * (mine->n_cells - 1);
    mine->faces[2 * mine->n_faces] = cell[0]; /* some side of a cell inside the mesh */
    mine->faces[2 * mine->n_faces + 1] = cell[1];
    mine->markers[mine->n_faces++] = 9;
}

static int32_t ghost_point(const own_part* mine) {
    uint8_t* own = calloc((size_t)mine->n_points, 1);
    int32_t k;
    for (k = 0; k < 4 * mine->n_cells; ++k) own[mine->cells[k]] |= !mine->ghosts[k / 4];
    for (k = 0; k < mine->n_points && own[k]; ++k) {}
    free(own);
    return k;
}

/* A point that another process has too. */
static int32_t shared_point(const own_part* mine, const whole_mesh* whole, const int* part_of) {
    int32_t k, c, at = 0;
    for (k = 0; k < whole->n_cells; ++k) {
        if (part_of[k] == rank) continue;
        for (c = 0; c < 4; ++c) {
            for (at = 0; at < mine->n_points; ++at) {
                if (mine->global[at] == whole->cells[4 * k + c]) return at;
            }
        }
    }
    return 0;
}

/* What the last process has wrong. 0: a fault that needs two processes. */
static int spoil(own_part* mine, const whole_mesh* whole, const int* part_of, int fault) {
    int32_t at, k;
    int64_t number;
    if (size == 1 && fault != GAP && fault != NO_MARKER && fault != NO_CELLS) return 0;
    if (rank != size - 1) return 1;
    at = fault == POSITION || fault == NUMBERS ? shared_point(mine, whole, part_of) : 0;
    switch (fault) {
        case POSITION: mine->x[at] += 1e-9; break;
        case NUMBERS:
            number = mine->numbers[at];
            mine->numbers[at] = mine->numbers[at == 0 ? 1 : 0];
            mine->numbers[at == 0 ? 1 : 0] = number;
            break;
        case GAP: --mine->n_cells; break;
        case NO_MARKER: --mine->n_faces; break;
        case MARKED_INSIDE: set_marker_inside(mine); break;
        case INSIDE_TWICE:
            for (k = 0; k < mine->n_points; ++k) mine->numbers[k] = number_of(k);
            break;
        case NO_CELLS: mine->n_points = mine->n_cells = mine->n_faces = 0; break;
        case NO_OWNER: mine->numbers[ghost_point(mine)] = 123456789; break;
        default: break;
    }
    refer(mine);
    return 1;
}

void check_parts_that_do_not_fit(void) {
    reference serial;
    int fault;
    make_o_mesh(&serial, 25, 9, 0, HM_LAPLACE);
    for (fault = 0; fault < N_FAULTS; ++fault) {
        int *const part_of = partition(&serial.mesh, STRIPES_X, size), is_possible;
        own_part mine;
        hm_petsc* system = NULL;
        hm_error error = {0};
        hm_status status;
        take_part(&mine, &serial.mesh, part_of, rank, fault == NO_OWNER);
        is_possible = spoil(&mine, &serial.mesh, part_of, fault);
        status = hm_petsc_create(&system, &mine.part, &serial.problem, &serial.options,
                                 MPI_COMM_WORLD, &error);
        check_refused(status, &error, is_possible, fault_names[fault]);
        if (is_possible) check(system == NULL, "no system is left", fault_names[fault]);
        if (fault == NO_CELLS && rank == size - 1) {
            check(strstr(error.text, "MPI_Comm_split") != NULL, "what to do", fault_names[fault]);
        }
        hm_petsc_free(&system);
        free(part_of);
        free_part(&mine);
    }
    free_case(&serial);
}

/* ---- Arguments: wrong on the last process, right on the others ---- */

static void check_creation(const reference* serial, const own_part* mine) {
    enum {
        NO_SYSTEM,
        NO_PART,
        NO_PROBLEM,
        UNSET,
        MARKER,
        TOLERANCE,
        CONTROL,
        OPERATOR,
        OTHER_MARKER,
        NUMBER_KINDS
    };
    static const char* const names[NUMBER_KINDS] = {"create: the system NULL",
                                                    "create: the part NULL",
                                                    "create: the problem NULL",
                                                    "create: no struct_size",
                                                    "create: unknown marker",
                                                    "create: another tolerance",
                                                    "create: another curve",
                                                    "create: another operator",
                                                    "create: another marker's condition"};
    const int is_last = rank == size - 1;
    int kind;
    for (kind = 0; kind < NUMBER_KINDS; ++kind) {
        const int is_possible = size > 1 || kind < TOLERANCE;
        hm_petsc* system = NULL;
        hm_error error = {0};
        hm_condition condition = serial->conditions[0];
        hm_problem problem = serial->problem;
        hm_options options = serial->options;
        hm_part_mesh part = mine->part;
        hm_curves curves = *serial->problem.curves;
        double control[64];
        hm_status status;
        problem.conditions = &condition;
        problem.curves = &curves;
        memcpy(control, curves.control, 2 * (size_t)curves.n_control * sizeof *control);
        curves.control = control;
        if (is_last && kind == UNSET) part.struct_size = 0;
        if (is_last && kind == MARKER) condition.marker = 77;
        if (is_last && kind == TOLERANCE) options.tolerance = 1e-4;
        if (is_last && kind == CONTROL) control[1] += 1e-12;
        if (is_last && kind == OPERATOR) options.operator_kind = HM_CONFORMAL;
        if (is_last && kind == OTHER_MARKER) condition.marker = FAR_FIELD;
        status = hm_petsc_create(is_last && kind == NO_SYSTEM ? NULL : &system,
                                 is_last && kind == NO_PART ? NULL : &part,
                                 is_last && kind == NO_PROBLEM ? NULL : &problem, &options,
                                 MPI_COMM_WORLD, &error);
        check_refused(status, &error, is_possible, names[kind]);
        if (is_possible) check(system == NULL, "no system is left", names[kind]);
        hm_petsc_free(&system);
    }
}

static void check_solution(hm_petsc* system, MPI_Comm of_one) {
    enum { NO_SYSTEM, NO_ROWS, NO_BLOCK, SHORT_BLOCK, UNSET, OTHER_COMM, NUMBER_KINDS };
    static const char* const names[NUMBER_KINDS] = {
        "solve: the system NULL", "solve: rows NULL",      "solve: the block NULL",
        "solve: a short block",   "solve: no struct_size", "solve: another communicator"};
    const int is_last = rank == size - 1;
    hm_error error = {0};
    size_t bytes;
    void* block;
    int kind;
    need(hm_petsc_rows_size(system, &bytes, &error), &error);
    block = room(bytes);
    for (kind = 0; kind < NUMBER_KINDS; ++kind) {
        hm_basis* rows = NULL;
        hm_petsc_report report = {sizeof report};
        hm_status status;
        if (kind == OTHER_COMM && size > 1) {
            /* A communicator of one process: nobody else waits for this call. */
            status = hm_petsc_solve(system, &rows, block, bytes, &report, of_one, &error);
        } else {
            if (is_last && kind == UNSET) report.struct_size = 0;
            status = hm_petsc_solve(is_last && kind == NO_SYSTEM ? NULL : system,
                                    is_last && kind == NO_ROWS ? NULL : &rows,
                                    is_last && kind == NO_BLOCK ? NULL : block,
                                    is_last && kind == SHORT_BLOCK ? bytes - 1 : bytes, &report,
                                    MPI_COMM_WORLD, &error);
        }
        check_refused(status, &error, kind != OTHER_COMM || size > 1, names[kind]);
        if (kind != OTHER_COMM) check(rows == NULL, "no rows are left", names[kind]);
    }
    free(block);
}

static void check_displacement_and_assessment(hm_petsc* system, const own_part* mine) {
    enum { NO_SYSTEM, NO_FIELD, NO_ARRAY, UNSET, NUMBER_KINDS };
    static const char* const names[NUMBER_KINDS] = {"the system NULL", "the displacement NULL",
                                                    "an array NULL", "no struct_size"};
    const int is_last = rank == size - 1;
    const size_t n = (size_t)mine->n_points;
    double* field = calloc(2 * n, sizeof *field);
    int kind;
    for (kind = 0; kind < NUMBER_KINDS; ++kind) {
        hm_points_out to = {field, field + n, 1};
        hm_petsc_report report = {sizeof report};
        hm_step_report step = {sizeof step};
        hm_quality_report quality = {sizeof quality};
        hm_error error = {0};
        hm_status status;
        if (is_last && kind == NO_ARRAY) to.x = NULL;
        if (is_last && kind == UNSET) report.struct_size = step.struct_size = 0;
        status = hm_petsc_displace(is_last && kind == NO_SYSTEM ? NULL : system,
                                   is_last && kind == NO_FIELD ? NULL : &to, &report,
                                   MPI_COMM_WORLD, &error);
        check_refused(status, &error, 1, names[kind]);
        status = hm_petsc_assess(is_last && kind == NO_SYSTEM ? NULL : system, NULL, NULL,
                                 &(hm_points){field, field + n, 1},
                                 is_last && kind == NO_FIELD ? NULL : &step, &quality, NULL,
                                 MPI_COMM_WORLD, &error);
        check_refused(status, &error, 1, names[kind]); /* there is no basis, either */
    }
    free(field);
}

void check_arguments(void) {
    reference serial;
    own_part mine;
    int* part_of;
    hm_petsc* system = NULL;
    hm_error error;
    MPI_Comm of_one;
    make_o_mesh(&serial, 25, 9, 0, HM_LAPLACE);
    part_of = partition(&serial.mesh, STRIPES_X, size);
    take_part(&mine, &serial.mesh, part_of, rank, 0);
    check_creation(&serial, &mine);
    need(hm_petsc_create(&system, &mine.part, &serial.problem, &serial.options, MPI_COMM_WORLD,
                         &error),
         &error);
    MPI_Comm_split(MPI_COMM_WORLD, rank, 0, &of_one);
    check_solution(system, of_one);
    check_displacement_and_assessment(system, &mine);
    check(hm_petsc_solve(system, NULL, NULL, 0, NULL, MPI_COMM_NULL, &error) == HM_BAD_ARGUMENT,
          "refused", "solve: MPI_COMM_NULL");
    MPI_Comm_free(&of_one);
    hm_petsc_free(&system);
    free(part_of);
    free_part(&mine);
    free_case(&serial);
}
