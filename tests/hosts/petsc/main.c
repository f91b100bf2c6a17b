/* usage: petsc [MESH.su2 ... | NI:NJ:FIRST ...]   Functions by PETSc on parts of meshes against
 * those of the direct engine. Without arguments: small generated meshes with all conditions, and
 * refusals. MESH.su2: a file; NI:NJ:FIRST: an O-mesh, see make_o_mesh. Environment: PARTITIONS,
 * SOLVERS, OPERATORS: digits, of partitions in parts.h, of solvers in check.h, of operators in
 * harmorph.h; VERBOSE. */
#include "check.h"

#include "../mpi_case.h"

#include <petscsys.h>
#include <string.h>

int rank, size, verbose;
static int passed, failed;

void check(int holds, const char* what, const char* where) {
    if (holds) {
        ++passed;
    } else {
        ++failed;
        printf("petsc, process %d of %d: %s: %s\n", rank, size, where, what);
    }
}

static int is_wanted(const char* variable, const char* otherwise, int digit) {
    const char* const wanted = getenv(variable) != NULL ? getenv(variable) : otherwise;
    return strchr(wanted, '0' + digit) != NULL;
}

static void check_large(const char* what, int operator_kind) {
    reference serial;
    int ni, nj, kind, solver;
    double first;
    if (sscanf(what, "%d:%d:%lf", &ni, &nj, &first) == 3) {
        make_o_mesh(&serial, ni, nj, first, operator_kind);
    } else {
        make_from_file(&serial, what, operator_kind);
    }
    solve_whole(&serial);
    for (kind = 0; kind < N_PARTITIONS; ++kind) {
        if (!is_wanted("PARTITIONS", size == 1 ? "0" : "012345", kind)) continue;
        for (solver = 0; solver < N_SOLVERS; ++solver) {
            if (is_wanted("SOLVERS", "01", solver)) check_agreement(&serial, kind, solver);
        }
    }
    free_case(&serial);
}

/* Of a small mesh one partition, another one for each case and number of processes, so that all
 * have their turn. On more than two processes, which may share processors and then wait for each
 * other, CG solves the first case alone, and MUMPS, which has fewer messages, the others. All
 * combinations: PARTITIONS=012345 SOLVERS=01 OPERATORS=012. */
static void check_small(reference* serial, int* turn) {
    const char partition[2] = {(char)('0' + *turn % N_PARTITIONS), 0};
    const char* const solvers = size <= 2 ? "01" : *turn == size ? "0" : "1";
    int kind, solver;
    ++*turn;
    solve_whole(serial);
    for (kind = 0; kind < N_PARTITIONS; ++kind) {
        if (!is_wanted("PARTITIONS", partition, kind)) continue;
        for (solver = 0; solver < N_SOLVERS; ++solver) {
            if (is_wanted("SOLVERS", solvers, solver)) check_agreement(serial, kind, solver);
        }
    }
}

static void check_conditions(int operator_kind, int* turn) {
    reference serial;
    hm_condition* rigid;
    make_o_mesh(&serial, 25, 9, 1e-5, operator_kind);
    check_small(&serial, turn);
    check_combined(&serial, *turn % N_PARTITIONS, FACTORED);
    free_case(&serial);
    if (operator_kind == HM_CONFORMAL) {
        make_o_mesh(&serial, 25, 9, 0, operator_kind);
        serial.options.offset_correction = 1;
        snprintf(serial.name, sizeof serial.name, "offset correction, operator %d", operator_kind);
    } else {
        make_o_mesh(&serial, 25, 9, 0, operator_kind);
        add_condition(&serial, FAR_FIELD, HM_FREE);
        snprintf(serial.name, sizeof serial.name, "free far field, operator %d", operator_kind);
    }
    check_small(&serial, turn);
    free_case(&serial);
    make_o_mesh(&serial, 25, 9, 0, operator_kind);
    rigid = add_condition(&serial, FAR_FIELD, HM_RIGID);
    rigid->x = 0.1;
    snprintf(serial.name, sizeof serial.name, "rigid body, operator %d", operator_kind);
    check_small(&serial, turn);
    free_case(&serial);
    make_channel(&serial, 0, operator_kind);
    add_condition(&serial, RIGHT, HM_SLIP);
    add_condition(&serial, LEFT, HM_SLIP);
    snprintf(serial.name, sizeof serial.name, "sliding sides, operator %d", operator_kind);
    check_small(&serial, turn);
    free_case(&serial);
    make_channel(&serial, 0.2, operator_kind);
    add_condition(&serial, TOP, HM_SLIP);
    snprintf(serial.name, sizeof serial.name, "sliding along a smooth curve, operator %d",
             operator_kind);
    check_small(&serial, turn);
    free_case(&serial);
    make_passage(&serial, operator_kind);
    check_small(&serial, turn);
    free_case(&serial);
}

static void check_given_conditions(int operator_kind, int* turn) {
    reference serial;
    make_o_mesh(&serial, 25, 9, 1e-4, operator_kind);
    check_given(&serial, (*turn)++ % N_PARTITIONS, FACTORED);
    free_case(&serial);
    make_channel(&serial, 0, operator_kind);
    add_condition(&serial, RIGHT, HM_SLIP);
    add_condition(&serial, LEFT, HM_SLIP);
    check_given(&serial, (*turn)++ % N_PARTITIONS, FACTORED);
    free_case(&serial);
    make_passage(&serial, operator_kind);
    check_given(&serial, (*turn)++ % N_PARTITIONS, FACTORED);
    free_case(&serial);
}

int main(int argc, char** argv) {
    static const char* const operators[] = {"012", "012", "0",
                                            "1"}; /* by the number of processes */
    int own[2], all[2], k, operator_kind, turn;
    PetscInitialize(NULL, NULL, NULL, NULL);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    verbose = getenv("VERBOSE") != NULL;
    turn = size;
    for (operator_kind = HM_CONFORMAL; operator_kind <= HM_WEIGHTED; ++operator_kind) {
        if (!is_wanted("OPERATORS", argc > 1 ? "01" : operators[size < 4 ? size - 1 : 3],
                       operator_kind))
            continue;
        for (k = 1; k < argc; ++k) check_large(argv[k], operator_kind);
        if (argc > 1) continue;
        check_conditions(operator_kind, &turn);
        check_given_conditions(operator_kind, &turn);
    }
    if (argc == 1) {
        check_parts_that_do_not_fit();
        check_arguments();
    }
    own[0] = passed;
    own[1] = failed;
    MPI_Reduce(own, all, 2, MPI_INT, MPI_SUM, 0, MPI_COMM_WORLD);
    if (rank == 0) printf("%d passed, %d failed\n", all[0], all[1]);
    PetscFinalize();
    return failed > 0;
}
