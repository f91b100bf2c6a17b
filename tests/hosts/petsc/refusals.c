/* What is wrong on one process alone is refused by all of them; none waits for ever. */
#include "check.h"

#include "../mpi_case.h"
#include "../mpi_refusal.h"

#include <string.h>

static int guilty; /* the process that is wrong: each one in turn */

/* A call that all processes refuse alike; the reason names the guilty process, or (is_named 0) the
 * process that has noticed. */
static void check_refused(hm_status own, const hm_error* error, hm_status wanted, int is_named,
                          const char* reason, const char* what) {
    check(refused_by_all(own, error, wanted, is_named ? guilty : -1, reason),
          "refused by all alike", what);
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
    NOT_A_NUMBER,
    INVERTED,
    OTHER_MESH
};
static const struct part_fault {
    const char* name;
    int fault, processes, is_named; /* the fewest processes that can notice */
    hm_status status;
    const char* reason;
} part_faults[] = {
    {"two positions", POSITION, 2, 0, HM_BAD_MESH, "different coordinates"},
    {"a gap", GAP, 1, 0, HM_BAD_MESH, ""},
    {"no marker", NO_MARKER, 1, 0, HM_BAD_MESH, ""},
    {"a marker inside", MARKED_INSIDE, 2, 0, HM_BAD_MESH, ""},
    {"wrong numbers", NUMBERS, 2, 0, HM_BAD_MESH, ""},
    {"the same numbers inside two parts", INSIDE_TWICE, 2, 0, HM_BAD_MESH, ""},
    {"a ghost without owner", NO_OWNER, 2, 0, HM_BAD_MESH, "ghost cells"},
    {"no cells", NO_CELLS, 1, 1, HM_BAD_MESH, "MPI_Comm_split"},
    {"a coordinate that is NaN", NOT_A_NUMBER, 1, 1, HM_BAD_MESH, ""},
    {"an inverted cell", INVERTED, 1, 1, HM_BAD_MESH, ""},
    {"a part of another mesh", OTHER_MESH, 2, 0, HM_BAD_MESH, "different coordinates"}};

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

static void spoil(own_part* mine, const whole_mesh* whole, const int* part_of, int fault) {
    int32_t at, k;
    int64_t number;
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
        case NOT_A_NUMBER: mine->y[mine->n_points - 1] = NAN; break;
        case INVERTED:
            at = mine->cells[0];
            mine->cells[0] = mine->cells[1];
            mine->cells[1] = at;
            break;
        case OTHER_MESH:
            for (k = 0; k < mine->n_points; ++k) mine->y[k] *= 1.5;
            break;
        default: break;
    }
    refer(mine);
}

static void check_part(const reference* serial, const struct part_fault* now) {
    int* const part_of = partition(&serial->mesh, STRIPES_X, size);
    own_part mine;
    hm_petsc* system = NULL;
    hm_error error = {0};
    hm_status status;
    take_part(&mine, &serial->mesh, part_of, rank, now->fault == NO_OWNER);
    if (rank == guilty) spoil(&mine, &serial->mesh, part_of, now->fault);
    expect_end_of(now->name, guilty);
    status = hm_petsc_create(&system, &mine.part, &serial->problem, &serial->options,
                             MPI_COMM_WORLD, &error);
    check_refused(status, &error, now->status, now->is_named, now->reason, now->name);
    check(system == NULL, "no system is left", now->name);
    free(part_of);
    free_part(&mine);
}

void check_parts_that_do_not_fit(void) {
    reference serial;
    size_t k;
    make_o_mesh(&serial, 25, 9, 0, HM_LAPLACE);
    for (k = 0; k < sizeof part_faults / sizeof *part_faults; ++k) {
        for (guilty = 0; guilty < size && size >= part_faults[k].processes; ++guilty)
            check_part(&serial, &part_faults[k]);
    }
    free_case(&serial);
}

/* ---- Arguments: wrong on the guilty process, right on the others ---- */

static void check_creation(const reference* serial, const own_part* mine) {
    enum {
        NO_SYSTEM,
        NO_PART,
        NO_PROBLEM,
        UNSET,
        MARKER,
        TOLERANCE, /* from here on: a difference between processes */
        EXPONENT,
        CONTROL,
        OPERATOR,
        OTHER_MARKER,
        FEWER_FUNCTIONS,
        NUMBER_KINDS
    };
    static const char* const names[NUMBER_KINDS] = {
        "create: the system NULL",     "create: the part NULL",
        "create: the problem NULL",    "create: no struct_size",
        "create: unknown marker",      "create: another tolerance",
        "create: another exponent",    "create: another curve",
        "create: another operator",    "create: another marker's condition",
        "create: other control points"};
    const int is_guilty = rank == guilty;
    int kind;
    for (kind = 0; kind < NUMBER_KINDS; ++kind) {
        const int differs = kind >= TOLERANCE;
        hm_petsc* system = NULL;
        hm_error error = {0};
        hm_condition condition = serial->conditions[0];
        hm_problem problem = serial->problem;
        hm_options options = serial->options;
        hm_part_mesh part = mine->part;
        hm_curves curves = *serial->problem.curves;
        double control[64];
        hm_status status;
        if (differs && size == 1) continue;
        problem.conditions = &condition;
        problem.curves = &curves;
        memcpy(control, curves.control, 2 * (size_t)curves.n_control * sizeof *control);
        curves.control = control;
        options.operator_kind = kind == EXPONENT ? HM_WEIGHTED : HM_LAPLACE;
        if (is_guilty && kind == UNSET) part.struct_size = 0;
        if (is_guilty && kind == MARKER) condition.marker = 77;
        if (is_guilty && kind == TOLERANCE) options.tolerance = 1e-4;
        if (is_guilty && kind == EXPONENT) options.exponent = 1.25;
        if (is_guilty && kind == CONTROL) control[1] += 1e-12;
        if (is_guilty && kind == OPERATOR) options.operator_kind = HM_CONFORMAL;
        if (is_guilty && kind == OTHER_MARKER) condition.marker = FAR_FIELD;
        if (is_guilty && kind == FEWER_FUNCTIONS) {
            condition.kind = HM_RIGID;
            condition.n_curves = 0;
            problem.curves = NULL;
        }
        expect_end_of(names[kind], guilty);
        status = hm_petsc_create(is_guilty && kind == NO_SYSTEM ? NULL : &system,
                                 is_guilty && kind == NO_PART ? NULL : &part,
                                 is_guilty && kind == NO_PROBLEM ? NULL : &problem, &options,
                                 MPI_COMM_WORLD, &error);
        /* What differs from rank 0 is on another process; a marker is looked for first. */
        check_refused(status, &error,
                      differs || kind == MARKER ? HM_BAD_CONDITION : HM_BAD_ARGUMENT,
                      !differs || guilty > 0,
                      differs && kind != OTHER_MARKER ? "those of rank 0" : "", names[kind]);
        check(system == NULL, "no system is left", names[kind]);
    }
}

/* system, and a second one of another number of functions. */
static void check_solution(hm_petsc* system, hm_petsc* other, MPI_Comm of_one) {
    enum {
        NO_SYSTEM,
        OTHER_SYSTEM,
        NO_ROWS,
        NO_BLOCK,
        SHORT_BLOCK,
        ASKS,
        UNSET,
        OTHER_COMM,
        NUMBER_KINDS
    };
    static const char* const names[NUMBER_KINDS] = {
        "solve: the system NULL", "solve: another system",
        "solve: rows NULL",       "solve: the block NULL",
        "solve: a short block",   "solve: one process asks for the size",
        "solve: no struct_size",  "solve: another communicator"};
    const int is_guilty = rank == guilty;
    hm_error error = {0};
    hm_memory memory;
    void* block;
    int kind;
    need(hm_petsc_solve(system, NULL, emptied(&memory), NULL, MPI_COMM_WORLD, &error), &error);
    memory.bytes *= 4; /* enough for the functions of `other`, too */
    block = memory.block = room(memory.bytes);
    for (kind = 0; kind < NUMBER_KINDS; ++kind) {
        hm_basis* rows = NULL;
        hm_petsc_report report = {sizeof report};
        hm_memory given = memory;
        hm_status status;
        if (size == 1 && (kind == OTHER_SYSTEM || kind == OTHER_COMM || kind == ASKS)) continue;
        if (kind == OTHER_COMM) {
            /* A communicator of one process: nobody else waits for this call. */
            status = hm_petsc_solve(system, &rows, &memory, &report, of_one, &error);
            check(status == HM_BAD_ARGUMENT, "refused", names[kind]);
            continue;
        }
        if (is_guilty && kind == UNSET) report.struct_size = 0;
        if (is_guilty && kind == NO_BLOCK) given.block = NULL;
        if (is_guilty && kind == ASKS) given = (hm_memory){NULL, 0};
        if (is_guilty && kind == SHORT_BLOCK) given.bytes = given.bytes / 4 - 1;
        expect_end_of(names[kind], guilty);
        status = hm_petsc_solve(!is_guilty || kind > OTHER_SYSTEM ? system
                                : kind == NO_SYSTEM               ? NULL
                                                                  : other,
                                is_guilty && kind == NO_ROWS ? NULL : &rows, &given, &report,
                                MPI_COMM_WORLD, &error);
        check_refused(status, &error, kind == SHORT_BLOCK ? HM_BLOCK_TOO_SMALL : HM_BAD_ARGUMENT,
                      (kind != OTHER_SYSTEM && kind != ASKS) || guilty > 0, "", names[kind]);
        check(rows == NULL, "no rows are left", names[kind]);
    }
    free(block);
}

/* Displacements that are NaN on one process: the same judgement on all processes. */
static void check_same_reports(hm_status status, const hm_step_report* step,
                               const hm_quality_report* quality) {
    hm_step_report first_step = *step;
    hm_quality_report first = *quality;
    MPI_Bcast(&first_step, sizeof first_step, MPI_BYTE, 0, MPI_COMM_WORLD);
    MPI_Bcast(&first, sizeof first, MPI_BYTE, 0, MPI_COMM_WORLD);
    check(status == HM_OK && memcmp(&first_step, step, sizeof *step) == 0 &&
              memcmp(&first, quality, sizeof *quality) == 0,
          "the same reports", "a NaN");
    check(quality->inverted > 0 && quality->min_quality == 0 && quality->min_area == -INFINITY &&
              step->admissible == 0,
          "cells without a place are inverted", "a NaN");
    alarm(0);
}

static void fill(double* field, size_t n, int is_nan) {
    size_t k;
    for (k = 0; k < 2 * n; ++k) field[k] = is_nan ? NAN : 0;
}

/* True on all processes if the guilty one has a point of the wall. */
static int has_wall(const own_part* mine) {
    int32_t k;
    int found = 0;
    for (k = 0; k < mine->n_faces; ++k) found = found || mine->markers[k] == WALL;
    MPI_Bcast(&found, 1, MPI_INT, guilty, MPI_COMM_WORLD);
    return found;
}

/* `given`: a system whose wall has given displacements; basis: of `given`, without functions. */
static void check_displacement_and_assessment(hm_petsc* given, const hm_basis* basis,
                                              const own_part* mine) {
    enum { NO_SYSTEM, NO_FIELD, NO_ARRAY, UNSET, NOT_A_NUMBER_THERE, NUMBER_KINDS };
    static const char* const names[NUMBER_KINDS] = {"the system NULL", "the displacement NULL",
                                                    "an array NULL", "no struct_size", "a NaN"};
    const int is_guilty = rank == guilty;
    const size_t n = (size_t)mine->n_points;
    double* field = calloc(2 * n, sizeof *field);
    int kind;
    for (kind = 0; kind < NUMBER_KINDS; ++kind) {
        hm_points_out to = {field, field + n, 1};
        hm_points moved = {field, field + n, 1};
        hm_petsc_report report = {sizeof report};
        hm_step_report step = {sizeof step};
        hm_quality_report quality = {sizeof quality};
        hm_error error = {0};
        hm_status status;
        fill(field, n, is_guilty && kind == NOT_A_NUMBER_THERE);
        if (is_guilty && kind == NO_ARRAY) moved.x = to.x = NULL;
        if (is_guilty && kind == UNSET) report.struct_size = step.struct_size = 0;
        expect_end_of(names[kind], guilty);
        status = hm_petsc_displace(is_guilty && kind == NO_SYSTEM ? NULL : given,
                                   is_guilty && kind == NO_FIELD ? NULL : &to, &report,
                                   MPI_COMM_WORLD, &error);
        if (kind == NOT_A_NUMBER_THERE && !has_wall(mine)) {
            check(status == HM_OK, "points without a given displacement are not read", names[kind]);
            fill(field, n, is_guilty);
        } else {
            check_refused(status, &error, HM_BAD_ARGUMENT, 1, "", names[kind]);
        }
        expect_end_of(names[kind], guilty);
        status = hm_petsc_assess(is_guilty && kind == NO_SYSTEM ? NULL : given, basis, NULL,
                                 is_guilty && kind == NO_FIELD ? NULL : &moved, &step, &quality,
                                 NULL, MPI_COMM_WORLD, &error);
        if (kind == NOT_A_NUMBER_THERE) {
            check_same_reports(status, &step, &quality);
        } else {
            check_refused(status, &error, HM_BAD_ARGUMENT, 1, "", names[kind]);
        }
    }
    free(field);
}

static hm_petsc* make_system(const own_part* mine, const reference* serial) {
    hm_petsc* made = NULL;
    hm_error error;
    need(hm_petsc_create(&made, &mine->part, &serial->problem, &serial->options, MPI_COMM_WORLD,
                         &error),
         &error);
    return made;
}

void check_arguments(void) {
    reference serial;
    own_part mine;
    int* part_of;
    hm_petsc *system, *given, *conformal;
    hm_basis* basis = NULL;
    hm_error error;
    MPI_Comm of_one;
    hm_memory memory;
    void* block;
    make_o_mesh(&serial, 25, 9, 0, HM_LAPLACE);
    part_of = partition(&serial.mesh, STRIPES_X, size);
    take_part(&mine, &serial.mesh, part_of, rank, 0);
    for (guilty = 0; guilty < size; ++guilty) check_creation(&serial, &mine);
    system = make_system(&mine, &serial);
    serial.options.operator_kind = HM_CONFORMAL;
    conformal = make_system(&mine, &serial);
    serial.options.operator_kind = HM_LAPLACE;
    serial.problem.curves = NULL;
    serial.conditions[0].kind = HM_GIVEN;
    serial.conditions[0].n_curves = 0;
    given = make_system(&mine, &serial);
    need(hm_petsc_solve(given, NULL, emptied(&memory), NULL, MPI_COMM_WORLD, &error), &error);
    block = memory.block = room(memory.bytes);
    need(hm_petsc_solve(given, &basis, &memory, NULL, MPI_COMM_WORLD, &error), &error);
    MPI_Comm_split(MPI_COMM_WORLD, rank, 0, &of_one);
    for (guilty = 0; guilty < size; ++guilty) {
        check_solution(system, conformal, of_one);
        check_displacement_and_assessment(given, basis, &mine);
    }
    check(hm_petsc_solve(system, NULL, &(hm_memory){NULL, 0}, NULL, MPI_COMM_NULL, &error) ==
              HM_BAD_ARGUMENT,
          "refused", "solve: MPI_COMM_NULL");
    MPI_Comm_free(&of_one);
    hm_petsc_free(&system);
    hm_petsc_free(&conformal);
    hm_petsc_free(&given);
    free(block);
    free(part_of);
    free_part(&mine);
    free_case(&serial);
}
