/* On any number of processes: what is solved in shares, exchanged, moved and summed up has the bits of one process. */
#include "mpi_case.h"

#include <harmorph_pthreads.h>

#include <string.h>

static int passed, failed, rank, size;

static void check(int holds, const char *what) {
    if (holds) {
        ++passed;
    } else {
        ++failed;
        printf("mpi.c, process %d of %d: %s\n", rank, size, what);
    }
}

static uint32_t scrambled(uint32_t k) {
    k = (k ^ (k >> 16)) * 0x45d9f3bu;
    k = (k ^ (k >> 16)) * 0x45d9f3bu;
    return k ^ (k >> 16);
}

/* Points anywhere in the mesh, in the order of no one; the first n_own are the process's own, ghosts follow. */
typedef struct part {
    int32_t *points, n, n_own;
} part;

static part make_part(int32_t n_points) {
    part its;
    int32_t k;
    its.points = room(sizeof *its.points * (size_t)n_points);
    its.n = 0;
    for (k = n_points - 1; k >= 0; --k) {
        if ((int)(scrambled((uint32_t)k) % (uint32_t)size) == rank) its.points[its.n++] = k;
    }
    its.n_own = its.n;
    for (k = 0; k < n_points; ++k) {
        const uint32_t its_number = scrambled((uint32_t)k);
        if ((int)(its_number % (uint32_t)size) != rank && its_number / 1000 % 7 == 0) its.points[its.n++] = k;
    }
    return its;
}

static int same_bits(const double *a, const double *b, int32_t n) { return memcmp(a, b, sizeof *a * (size_t)n) == 0; }

static void check_blocks(const hm_basis *a, const hm_basis *b) {
    hm_basis_info one = {sizeof one}, other = {sizeof other};
    hm_error error;
    need(hm_basis_info_get(a, &one, &error), &error);
    need(hm_basis_info_get(b, &other, &error), &error);
    check(one.solved == 1, "the rows are solved");
    check(one.bytes == other.bytes && memcmp(a, b, (size_t)one.bytes) == 0, "rows as on one process, byte by byte");
}

static void check_morph(const hm_basis *whole, const hm_basis *rows, const part *mine, const problem_case *its) {
    const int32_t n = its->n_points;
    double *move = room(2 * sizeof *move * (size_t)its->n_functions), *all = room(2 * sizeof *all * (size_t)n);
    double *own = room(2 * sizeof *own * (size_t)mine->n);
    hm_error error;
    int32_t k, wrong = 0;
    for (k = 0; k < 2 * its->n_functions; ++k) move[k] = 0.01 * cos(3.0 * k);
    for (k = 0; k < mine->n; ++k) {
        own[k] = its->x[mine->points[k]];
        own[mine->n + k] = its->y[mine->points[k]];
    }
    need(hm_morph(whole, move, &(hm_points){its->x, its->y, 1}, &(hm_points_out){all, all + n, 1}, NULL,
                  &error), &error);
    need(hm_morph(rows, move, &(hm_points){own, own + mine->n, 1}, &(hm_points_out){own, own + mine->n, 1}, NULL,
                  &error), &error);
    for (k = 0; k < mine->n; ++k) {
        wrong += memcmp(&own[k], &all[mine->points[k]], sizeof *own) != 0;
        wrong += memcmp(&own[mine->n + k], &all[n + mine->points[k]], sizeof *own) != 0;
    }
    check(wrong == 0, "points move as on one process");
    free(move);
    free(all);
    free(own);
}

static void check_adjoint(const hm_basis *whole, const hm_basis *rows, const part *mine, const problem_case *its) {
    const int32_t n = its->n_points, n_gradient = 2 * its->n_functions;
    double *all = room(2 * sizeof *all * (size_t)n), *own = room(2 * sizeof *own * (size_t)mine->n);
    double *expected = room(sizeof *expected * (size_t)n_gradient), *found = room(sizeof *found * (size_t)n_gradient);
    hm_pthreads pool;
    hm_executor executor = hm_pthreads_start(&pool, 3);
    hm_error error;
    int32_t k, not_a_number = 0;
    for (k = 0; k < 2 * n; ++k) all[k] = sin(1.7 * k) * pow(10.0, -(double)(scrambled((uint32_t)k) % 12));
    for (k = 0; k < mine->n; ++k) {
        own[k] = k < mine->n_own ? all[mine->points[k]] : 0;
        own[mine->n + k] = k < mine->n_own ? all[n + mine->points[k]] : 0;
    }
    need(hm_adjoint(whole, &(hm_points){all, all + n, 1}, expected, NULL, &error), &error);
    need(hm_mpi_adjoint(rows, &(hm_points){own, own + mine->n, 1}, found, NULL, MPI_COMM_WORLD, &error), &error);
    check(same_bits(found, expected, n_gradient), "the gradient is that of one process");
    memset(found, 0, sizeof *found * (size_t)n_gradient);
    need(hm_mpi_adjoint(rows, &(hm_points){own, own + mine->n, 1}, found, &executor, MPI_COMM_WORLD, &error), &error);
    check(same_bits(found, expected, n_gradient), "and on several threads of each");
    hm_pthreads_stop(&pool);

    if (rank == size - 1) own[0] = NAN;
    need(hm_mpi_adjoint(rows, &(hm_points){own, own + mine->n, 1}, found, NULL, MPI_COMM_WORLD, &error), &error);
    for (k = 0; k < n_gradient; ++k) not_a_number += found[k] != found[k];
    check(not_a_number == n_gradient, "one NaN on one process: NaN on all");

    check(hm_mpi_adjoint(rows, &(hm_points){own, own + mine->n, 1}, rank == 0 ? NULL : found, NULL, MPI_COMM_WORLD,
                         &error) == HM_BAD_ARGUMENT, "what one process has wrong is refused by all");
    check(rank == 0 || strstr(error.text, "another process") != NULL, "and told on");
    free(all);
    free(own);
    free(expected);
    free(found);
}

static void check_operator(int32_t operator_kind, int32_t n_functions) {
    problem_case its;
    solver with;
    part mine;
    hm_error error;
    int32_t first, n;
    void *whole_block, *share_block, *rows_block, *expected_block;
    hm_basis *whole, *share, *rows;

    make_case(&its, 65, 25, n_functions, operator_kind);
    make_solver(&with, &its);
    mine = make_part(its.n_points);
    whole = solve_share(&with, 0, n_functions, &whole_block);
    need(hm_share_of(with.analysis, rank, size, &first, &n, &error), &error);
    share = solve_share(&with, first, n, &share_block);
    free_solver(&with);
    rows = extract(share, mine.n, mine.points, &rows_block);

    check(hm_mpi_exchange(rows, rank == 0 ? NULL : share, mine.n, mine.points, MPI_COMM_WORLD, &error) ==
              HM_BAD_ARGUMENT, "an exchange without a share on one process is refused by all");
    check(rank == 0 || strstr(error.text, "another process") != NULL, "and told on");
    need(hm_mpi_exchange(rows, share, mine.n, mine.points, MPI_COMM_WORLD, &error), &error);
    free(share_block);
    check_blocks(rows, extract(whole, mine.n, mine.points, &expected_block));
    check_morph(whole, rows, &mine, &its);
    check_adjoint(whole, rows, &mine, &its);
    free(whole_block);
    free(rows_block);
    free(expected_block);
    free(mine.points);
}

/* Shares that do not belong together are noticed, by all processes. */
static void check_mixture(void) {
    problem_case its;
    solver with;
    hm_error error;
    int32_t first, n;
    const int32_t points[] = {4, 2};
    void *share_block, *rows_block;
    hm_basis *share, *rows;
    make_case(&its, 33, 9, 8, rank == 0 ? HM_WEIGHTED : HM_LAPLACE);
    if (rank == 0) its.x[40] += 1e-3;
    make_solver(&with, &its);
    need(hm_share_of(with.analysis, rank, size, &first, &n, &error), &error);
    share = solve_share(&with, first, n, &share_block);
    rows = extract(share, 2, points, &rows_block);
    check(hm_mpi_exchange(rows, share, 2, points, MPI_COMM_WORLD, &error) == (size > 1 ? HM_BAD_BASIS : HM_OK),
          "shares of different meshes");
    free_solver(&with);
    free(share_block);

    /* The last function is missing. */
    if (rank == 0) its.x[40] -= 1e-3;
    its.options.operator_kind = HM_LAPLACE;
    make_solver(&with, &its);
    need(hm_share_of(with.analysis, rank, size, &first, &n, &error), &error);
    share = solve_share(&with, first, rank == size - 1 ? n - 1 : n, &share_block);
    free(rows_block);
    rows = extract(share, 2, points, &rows_block);
    check(hm_mpi_exchange(rows, share, 2, points, MPI_COMM_WORLD, &error) == HM_BAD_BASIS, "shares that leave one out");
    check(strstr(error.text, "not all functions") != NULL, "and why");
    free_solver(&with);
    free(share_block);
    free(rows_block);
}

int main(int argc, char **argv) {
    int own[2], all[2];
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    check_operator(HM_LAPLACE, 14);
    check_operator(HM_CONFORMAL, 9);
    check_operator(HM_LAPLACE, 5); /* not many more than processes */
    check_mixture();
    own[0] = passed;
    own[1] = failed;
    MPI_Reduce(own, all, 2, MPI_INT, MPI_SUM, 0, MPI_COMM_WORLD);
    if (rank == 0) printf("%d passed, %d failed\n", all[0], all[1]);
    MPI_Finalize();
    return failed > 0;
}
