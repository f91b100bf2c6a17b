/* What processes cost and gain: usage mpi NI NJ FUNCTIONS OPERATOR, under mpirun. One line of
 * numbers, see mpi.sh: seconds of the processor that works longest, not of the clock, so that other
 * programs disturb less; and the largest number of bytes that a process has for harmorph at a time.
 */
#include "mpi_case.h"

#include <string.h>
#include <time.h>

enum { REPEATS = 20 };

static double slowest(double seconds) {
    double out = seconds;
    MPI_Allreduce(&seconds, &out, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
    return out;
}

static double begin(void) {
    MPI_Barrier(MPI_COMM_WORLD);
    return (double)clock();
}

static double since(double start) { return slowest(((double)clock() - start) / CLOCKS_PER_SEC); }

int main(int argc, char** argv) {
    int rank, size, repeat;
    problem_case setup;
    solver with;
    hm_error error;
    hm_basis_info info = {sizeof info};
    int32_t first, n_share, begin_point, n, k, *points;
    double start, factor, solve, exchange, morph = 1e9, adjoint = 1e9, *xy, *numbers, bytes;
    void *share_block, *rows_block;
    hm_points from = {NULL, NULL, 1};
    hm_points_out to = {NULL, NULL, 1};
    hm_basis *share, *rows;
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    if (argc != 5) MPI_Abort(MPI_COMM_WORLD, 2);
    make_case(&setup, atoi(argv[1]), atoi(argv[2]), atoi(argv[3]), atoi(argv[4]));

    start = begin();
    make_solver(&with, &setup);
    factor = since(start);
    need(hm_private_share_of(with.analysis, rank, size, &first, &n_share, &error), &error);
    start = begin();
    share = solve_share(&with, first, n_share, &share_block);
    solve = since(start);
    need(hm_basis_info_get(share, &info, &error), &error);
    bytes = (double)(with.bytes + info.bytes);
    free(share_block);

    begin_point = (int32_t)((int64_t)setup.n_points * rank / size);
    n = (int32_t)((int64_t)setup.n_points * (rank + 1) / size) - begin_point;
    points = room(sizeof *points * (size_t)n);
    for (k = 0; k < n; ++k) points[k] = begin_point + k;
    start = begin();
    need(solve_rows(&with, n, points, &rows, &rows_block, NULL, &error), &error);
    exchange = since(start) - solve;
    free_solver(&with);

    xy = room(2 * sizeof *xy * (size_t)n);
    numbers = room(2 * sizeof *numbers * (size_t)setup.n_functions);
    for (k = 0; k < 2 * setup.n_functions; ++k) numbers[k] = 1e-9 * (k % 7);
    memcpy(xy, setup.x + begin_point, sizeof *xy * (size_t)n);
    memcpy(xy + n, setup.y + begin_point, sizeof *xy * (size_t)n);
    from.x = to.x = xy;
    from.y = to.y = xy + n;
    for (repeat = 0; repeat < REPEATS; ++repeat) {
        double seconds;
        start = begin();
        need(hm_morph(rows, numbers, &from, &to, NULL, &error), &error);
        seconds = since(start);
        morph = seconds < morph ? seconds : morph;
        start = begin();
        need(hm_mpi_adjoint(rows, &from, numbers, NULL, MPI_COMM_WORLD, &error), &error);
        seconds = since(start);
        adjoint = seconds < adjoint ? seconds : adjoint;
        for (k = 0; k < 2 * setup.n_functions; ++k) numbers[k] = 1e-9 * (k % 7);
    }
    bytes = slowest(bytes);
    if (rank == 0) {
        printf("%d %d %d %.4f %.4f %.4f %.3f %.3f %.0f\n", size, (int)setup.n_points,
               (int)setup.n_functions, factor, solve, exchange, 1e3 * morph, 1e3 * adjoint,
               bytes / setup.n_points);
    }
    MPI_Finalize();
    return 0;
}
