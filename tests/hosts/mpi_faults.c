/* usage: mpi_faults, on any number of processes. In each case of a table one process gives a wrong
 * argument, and each process in turn is this one: all processes get the same status and the same
 * error, which names the process; nothing is written; and none waits for ever. */
#include "mpi_case.h"
#include "mpi_refusal.h"

static int passed, failed, rank, size;

enum { N_I = 33, N_J = 9, FUNCTIONS = 8, OTHER_FUNCTIONS = 6 };

/* Right and wrong objects of this process. */
static solver with, of_curves, of_other_mesh, of_less;
static hm_plan *unfactored, *unfactored_of_curves;
static hm_basis *rows, *rows_of_less;
static int32_t points[N_I * N_J], other_points[N_I * N_J], wall_points[N_I + 1];
static double x[N_I * N_J], y[N_I * N_J], spoiled[2 * N_I * N_J];
static const double not_numbers[N_I * N_J] = {NAN};
static double results[2 * N_I * N_J];

typedef struct arguments {
    hm_basis* rows;
    hm_basis** made;
    hm_memory memory;
    hm_plan* of_curves; /* for the functions of curves, with its analysis */
    const hm_analysis* analysis;
    int32_t n, n_wall, n_fields, root;
    const int32_t *points, *wall_points;
    const hm_points *field, *from; /* displacements at the wall, or derivatives at the points */
    const hm_points_out* to;
    double* gradient;
    hm_plan* plan;
    hm_points field_of_one, from_of_one; /* for the changes of a case */
    hm_points_out to_of_one;
} arguments;

static hm_status solve(const arguments* a, hm_error* err) {
    hm_memory memory = a->memory;
    return hm_mpi_solve(a->made, &memory, a->of_curves, a->analysis, a->n, a->points, NULL,
                        MPI_COMM_WORLD, err);
}
static hm_status adjoint(const arguments* a, hm_error* err) {
    return hm_mpi_adjoint(a->rows, a->field, a->gradient, NULL, MPI_COMM_WORLD, err);
}
static hm_status displace(const arguments* a, hm_error* err) {
    return hm_mpi_displace(a->plan, a->n_wall, a->wall_points, a->n_fields, a->field, a->n,
                           a->points, NULL, a->to, a->root, MPI_COMM_WORLD, err);
}
static hm_status move(const arguments* a, hm_error* err) {
    return hm_mpi_displace(a->plan, a->n_wall, a->wall_points, a->n_fields, a->field, a->n,
                           a->points, a->from, a->to, a->root, MPI_COMM_WORLD, err);
}
static hm_status transpose(const arguments* a, hm_error* err) {
    return hm_mpi_displace_adjoint(a->plan, a->n_wall, a->wall_points, a->n_fields, a->field, a->n,
                                   a->points, a->to, a->root, MPI_COMM_WORLD, err);
}

/* What the guilty process has wrong. */
#define WRONG(name, change)          \
    static void name(arguments* a) { \
        (void)a;                     \
        change;                      \
    }
WRONG(no_rows, a->rows = NULL)
WRONG(no_result_rows, a->made = NULL)
WRONG(no_block, a->memory.block = NULL)
WRONG(size_query, a->memory = (hm_memory){0})
WRONG(small_block, a->memory.bytes = 64)
WRONG(no_plan, a->of_curves = NULL)
WRONG(no_analysis, a->analysis = NULL)
WRONG(analysis_of_another, a->analysis = of_less.analysis)
WRONG(negative_n, a->n = -1)
WRONG(no_points, a->points = NULL)
WRONG(other_mesh, a->of_curves = of_other_mesh.plan; a->analysis = of_other_mesh.analysis)
WRONG(functions_missing, a->of_curves = of_less.plan; a->analysis = of_less.analysis)
WRONG(no_factor_of_curves, a->of_curves = unfactored_of_curves)
WRONG(fewer_points, --a->n)
WRONG(point_outside, other_points[0] = N_I * N_J; a->points = other_points)
WRONG(no_gradient, a->gradient = NULL)
WRONG(no_array, a->field_of_one.x = NULL; a->field = &a->field_of_one)
WRONG(negative_stride, a->field_of_one.stride = -1; a->field = &a->field_of_one)
WRONG(no_field, a->field = NULL)
WRONG(other_rows, a->rows = rows_of_less)
WRONG(no_wall, a->wall_points = NULL)
WRONG(negative_wall, a->n_wall = -1)
WRONG(shorter_wall, a->n_wall = 0)
WRONG(not_at_wall, wall_points[0] = N_I)
WRONG(wall_outside, wall_points[0] = -7)
WRONG(no_fields, a->n_fields = 0)
WRONG(more_fields, a->n_fields = 2)
WRONG(other_root, a->root = (a->root + 1) % size)
WRONG(root_outside, a->root = size)
WRONG(negative_root, a->root = -1)
WRONG(no_from, a->from = NULL)
WRONG(no_result, a->to = NULL)
WRONG(no_result_array, a->to_of_one.y = NULL; a->to = &a->to_of_one)
WRONG(other_plan, a->plan = a->plan == NULL ? with.plan : NULL)
WRONG(no_factor, if (a->plan != NULL) a->plan = unfactored)
WRONG(not_a_number, spoiled[0] = NAN)
WRONG(infinite, spoiled[1] = INFINITY)
WRONG(other_displacement, wall_points[a->n_wall] = (rank + 1) % size; spoiled[2 * a->n_wall++] = 5)
WRONG(not_a_place, a->from_of_one.y = not_numbers; a->from = &a->from_of_one)

/* NAMED: the text begins with the rank of the guilty process; BY_OTHERS: a process that receives
 * what is wrong refuses, and `reason` with %d names the sender; BY_ROOT: root refuses. */
enum { NAMED, BY_OTHERS, BY_ROOT };
static const struct fault {
    const char* what;
    hm_status (*call)(const arguments*, hm_error*);
    void (*spoil)(arguments*);
    hm_status status;
    int judge, processes; /* the fewest processes that can notice */
    const char* reason;
} faults[] = {
#define ARGUMENT(call, spoil) \
    { #call ": " #spoil, call, spoil, HM_BAD_ARGUMENT, NAMED, 1, "" }
#define OF_TWO(call, spoil, reason) \
    { #call ": " #spoil, call, spoil, HM_BAD_ARGUMENT, NAMED, 2, reason }
#define RECEIVED(spoil, status, processes, reason) \
    { "solve: " #spoil, solve, spoil, status, BY_OTHERS, processes, reason }
#define AT_ROOT(call, spoil, status) \
    { #call ": " #spoil, call, spoil, status, BY_ROOT, 1, "" }
    ARGUMENT(solve, no_result_rows),
    ARGUMENT(solve, no_block),
    OF_TWO(solve, size_query, "rank 0"),
    ARGUMENT(solve, no_plan),
    ARGUMENT(solve, no_analysis),
    ARGUMENT(solve, negative_n),
    ARGUMENT(solve, no_points),
    {"solve: small_block", solve, small_block, HM_BLOCK_TOO_SMALL, NAMED, 1, ""},
    {"solve: no_factor_of_curves", solve, no_factor_of_curves, HM_BAD_ARGUMENT, NAMED, 1, "factor"},
    {"solve: analysis_of_another", solve, analysis_of_another, HM_BAD_BASIS, NAMED, 1, ""},
    RECEIVED(other_mesh, HM_BAD_BASIS, 2, "the message from rank "),
    RECEIVED(functions_missing, HM_BAD_BASIS, 2, ""),
    {"solve: point_outside", solve, point_outside, HM_BAD_ARGUMENT, NAMED, 1, "point 297"},
    ARGUMENT(adjoint, no_rows),
    ARGUMENT(adjoint, no_gradient),
    ARGUMENT(adjoint, no_field),
    ARGUMENT(adjoint, no_array),
    ARGUMENT(adjoint, negative_stride),
    {"adjoint: other_rows", adjoint, other_rows, HM_BAD_BASIS, NAMED, 2, "than those of rank 0"},
#define OF_FIELDS(call)                                                                           \
    ARGUMENT(call, negative_n), ARGUMENT(call, no_points), ARGUMENT(call, no_wall),               \
        ARGUMENT(call, negative_wall), ARGUMENT(call, no_field), ARGUMENT(call, no_array),        \
        ARGUMENT(call, negative_stride), ARGUMENT(call, no_result),                               \
        ARGUMENT(call, no_result_array), ARGUMENT(call, no_fields), ARGUMENT(call, root_outside), \
        ARGUMENT(call, negative_root), ARGUMENT(call, other_plan),                                \
        OF_TWO(call, more_fields, "rank 0"), OF_TWO(call, other_root, "rank 0"),                  \
        {#call ": point_outside",                                                                 \
         call,                                                                                    \
         point_outside,                                                                           \
         HM_BAD_ARGUMENT,                                                                         \
         BY_OTHERS,                                                                               \
         1,                                                                                       \
         "the list of rank %d: point 297 does not exist"},                                        \
        AT_ROOT(call, not_at_wall, HM_BAD_CONDITION),                                             \
        AT_ROOT(call, wall_outside, HM_BAD_ARGUMENT),                                             \
        AT_ROOT(call, shorter_wall, HM_BAD_CONDITION), AT_ROOT(call, no_factor, HM_BAD_ARGUMENT)
    OF_FIELDS(displace),
    OF_FIELDS(move),
    OF_FIELDS(transpose),
    {"displace: other_displacement", displace, other_displacement, HM_BAD_ARGUMENT, BY_ROOT, 1,
     "has two different displacements"},
    ARGUMENT(displace, not_a_number),
    ARGUMENT(displace, infinite),
    ARGUMENT(move, not_a_number),
    ARGUMENT(move, not_a_place),
    OF_TWO(move, no_from, "rank 0"),
    AT_ROOT(move, fewer_points, HM_BAD_ARGUMENT),
};

static void check(int holds, const char* what, int guilty) {
    if (holds) {
        ++passed;
    } else {
        ++failed;
        printf("mpi_faults.c, process %d of %d: %s on rank %d\n", rank, size, what, guilty);
    }
}

/* Every size-th point. */
static int32_t own_points(int32_t n_points, int32_t* list) {
    int32_t k, n = 0;
    for (k = rank; k < n_points; k += size) list[n++] = k;
    return n;
}

/* The analysis and the plan of a problem like the right one. */
static void make_like(solver* made, int32_t n_functions, double shift) {
    problem_case setup;
    make_case(&setup, N_I, N_J, n_functions, HM_LAPLACE);
    setup.x[2 * N_I + 3] += shift;
    make_solver(made, &setup);
}

static void make_plans(problem_case* setup) {
    static hm_condition given;
    hm_error error;
    hm_memory memory;
    given.struct_size = sizeof given;
    given.marker = WALL;
    given.kind = HM_GIVEN;
    setup->problem.curves = NULL;
    setup->problem.conditions = &given;
    make_solver(&with, setup);
    need(hm_plan_init(NULL, emptied(&memory), with.analysis, &error), &error);
    need(hm_plan_init(&unfactored, &(hm_memory){room(memory.bytes), memory.bytes}, with.analysis,
                      &error),
         &error);
}

static void make_objects(void) {
    problem_case setup;
    hm_error error;
    const int32_t n = own_points(N_I * N_J, points);
    int32_t k;
    hm_memory memory;
    void* block;
    make_case(&setup, N_I, N_J, FUNCTIONS, HM_LAPLACE);
    for (k = 0; k < n; ++k) {
        x[k] = setup.x[points[k]];
        y[k] = setup.y[points[k]];
    }
    make_like(&of_curves, FUNCTIONS, 0);
    make_like(&of_other_mesh, FUNCTIONS, 1e-3);
    make_like(&of_less, OTHER_FUNCTIONS, 0);
    need(hm_plan_init(NULL, emptied(&memory), of_curves.analysis, &error), &error);
    need(hm_plan_init(&unfactored_of_curves, &(hm_memory){room(memory.bytes), memory.bytes},
                      of_curves.analysis, &error),
         &error);
    need(solve_rows(&of_less, n, points, &rows_of_less, &block, NULL, &error), &error);
    make_plans(&setup);
}

typedef struct attempt {
    arguments a;
    hm_points field[2], from;
    hm_points_out to[2];
    hm_basis* made;
    void* block; /* of new rows, or NULL */
} attempt;

static void make_right(attempt* made, hm_status (*call)(const arguments*, hm_error*)) {
    arguments* const a = &made->a;
    int32_t k;
    memset(made, 0, sizeof *made);
    a->n = own_points(N_I * N_J, points);
    for (k = 0; k < a->n; ++k) other_points[k] = points[a->n - 1 - k];
    a->n_wall = own_points(N_I, wall_points);
    for (k = 0; k < 2 * N_I * N_J; ++k) spoiled[k] = 1e-3 * cos(wall_points[0] + k);
    for (k = 0; k < 2 * N_I * N_J; ++k) results[k] = 7;
    if (call == displace || call == move) { /* both sides of the cut move together */
        for (k = 0; k < a->n_wall; ++k) spoiled[2 * k] = spoiled[2 * k + 1] = 1e-3;
    }
    for (k = 0; k < 2; ++k) {
        made->field[k] = (hm_points){spoiled, spoiled + 1, 2};
        made->to[k] = (hm_points_out){results, results + N_I * N_J, 1};
    }
    made->from = (hm_points){x, y, 1};
    a->of_curves = of_curves.plan;
    a->analysis = of_curves.analysis;
    a->rows = rows;
    a->made = &made->made;
    if (call == solve) {
        need(hm_mpi_solve(NULL, emptied(&a->memory), NULL, a->analysis, a->n, NULL, NULL,
                          MPI_COMM_WORLD, NULL),
             &(hm_error){0});
        a->memory.block = made->block = room(a->memory.bytes);
    }
    a->points = points;
    a->wall_points = wall_points;
    a->n_fields = 1;
    a->root = size - 1;
    a->field = made->field;
    a->from = &made->from;
    a->to = made->to;
    a->gradient = results;
    a->plan = rank == size - 1 ? with.plan : NULL;
    a->field_of_one = made->field[0];
    a->from_of_one = made->from;
    a->to_of_one = made->to[0];
}

static void check_right_calls(void) {
    hm_status (*const calls[])(const arguments*, hm_error*) = {solve, adjoint, displace, move,
                                                               transpose};
    attempt right;
    size_t k;
    for (k = 0; k < sizeof calls / sizeof *calls; ++k) {
        make_right(&right, calls[k]);
        expect_end_of("a call without a fault", (int)k);
        check(calls[k](&right.a, NULL) == HM_OK, "a call without a fault", (int)k);
        alarm(0);
        check(results[0] != 7 || calls[k] == solve, "it has a result", (int)k);
        if (calls[k] == solve) rows = right.made;
    }
}

/* `tells`: the guilty process wants the error, too. */
static void check_fault(const struct fault* fault, int guilty, int tells) {
    attempt now;
    hm_error error = {0};
    hm_status status;
    char reason[128];
    int32_t k, written = 0;
    int named = fault->judge == NAMED ? guilty : fault->judge == BY_ROOT ? size - 1 : -1;
    /* What differs from rank 0 is on another process. */
    if (guilty == 0 && strstr(fault->reason, "rank 0") != NULL) named = -1;
    make_right(&now, fault->call);
    if (rank == guilty) fault->spoil(&now.a);
    snprintf(reason, sizeof reason, fault->reason, guilty);
    expect_end_of(fault->what, guilty);
    status = fault->call(&now.a, tells || rank != guilty ? &error : NULL);
    if (tells) {
        check(refused_by_all(status, &error, fault->status, named, reason), fault->what, guilty);
    } else {
        check(status == fault->status && (rank == guilty || strstr(error.text, reason) != NULL),
              fault->what, guilty);
    }
    for (k = 0; k < 2 * N_I * N_J; ++k) written += results[k] != 7;
    check(written == 0 && now.made == NULL, "a refused call writes nothing", guilty);
    free(now.block);
}

/* A process may have no points at all, and no share: it takes part all the same. */
static void check_empty_process(void) {
    attempt now;
    hm_error error;
    const int is_empty = size > 1 && rank == 0;
    make_right(&now, solve);
    if (is_empty) now.a.n = 0;
    expect_end_of("no points", 0);
    need(solve(&now.a, &error), &error);
    now.a.rows = now.made;
    now.a.field = &(hm_points){is_empty ? NULL : spoiled, is_empty ? NULL : spoiled + 1, 2};
    need(adjoint(&now.a, &error), &error);
    check(fabs(results[0]) < 7, "an adjoint", 0);
    make_right(&now, displace);
    if (is_empty) now.a.n = 0;
    need(displace(&now.a, &error), &error);
    alarm(0);
    check(is_empty ? results[0] == 7 : fabs(results[0] - 1e-3) < 1e-3, "displacements", 0);
}

int main(int argc, char** argv) {
    int own[2], all[2], guilty;
    size_t k;
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    make_objects();
    check_right_calls();
    for (k = 0; k < sizeof faults / sizeof *faults; ++k) {
        if (size < faults[k].processes) continue;
        for (guilty = 0; guilty < size; ++guilty) {
            if (faults[k].spoil == no_factor && guilty != size - 1) continue;
            check_fault(&faults[k], guilty, 1);
            check_fault(&faults[k], guilty, 0);
        }
    }
    check_empty_process();
    check(hm_mpi_adjoint(rows, NULL, NULL, NULL, MPI_COMM_NULL, NULL) == HM_BAD_ARGUMENT,
          "MPI_COMM_NULL", 0);
    free_solver(&of_curves);
    free_solver(&of_other_mesh);
    free_solver(&of_less);
    own[0] = passed;
    own[1] = failed;
    MPI_Reduce(own, all, 2, MPI_INT, MPI_SUM, 0, MPI_COMM_WORLD);
    if (rank == 0) printf("%d passed, %d failed\n", all[0], all[1]);
    MPI_Finalize();
    return failed > 0;
}
