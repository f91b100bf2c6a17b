/* usage: petsc NI NJ FUNCTIONS OPERATOR FIRST   O-mesh of NI x NJ points (the seam repeats a
 * column); FIRST: height of the first layer, 0: cells as long as wide. Each process makes its own
 * rings alone. Prints: processes, points, seconds to create and to solve (processor time of the
 * slowest process), iterations of the slowest function, seconds of a morph; megabytes of the
 * largest process: harmorph with its basis, the rest (PETSc and its solvers), and the most that the
 * process had at a time; estimated error. */
#include "../../c_api/memory.h"

#include <harmorph_petsc.h>

#include <math.h>
#include <petscsys.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

enum { WALL = 1, FAR_FIELD = 2 };

static void need(hm_status status, const hm_error* error) {
    if (status >= 0) return;
    fprintf(stderr, "%s: %s\n", hm_status_name(status), error->text);
    MPI_Abort(MPI_COMM_WORLD, 1);
}

static double seconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double resident(void) { /* bytes, now */
    long pages = 0, all = 0;
    FILE* file = fopen("/proc/self/statm", "r");
    if (file == NULL || fscanf(file, "%ld %ld", &all, &pages) != 2) pages = 0;
    if (file != NULL) fclose(file);
    return (double)pages * (double)sysconf(_SC_PAGESIZE);
}

static double most_resident(void) { /* bytes, at any time */
    struct rusage use;
    getrusage(RUSAGE_SELF, &use);
    return 1024.0 * (double)use.ru_maxrss;
}

static void place(int i, int j, int ni, int nj, double first, double* x, double* y) {
    const double angle = 6.283185307179586 * (i % (ni - 1)) / (ni - 1), t = (double)j / (nj - 1);
    const double even = exp(6.283185307179586 * (nj - 1) / (ni - 1)) - 1;
    const double r =
        1 + (first > 0 ? first * expm1(t * log1p(20 / first)) : expm1(t * log1p(even)));
    *x = (r + 0.6 / r) * cos(angle);
    *y = (r - 0.6 / r) * sin(angle);
}

int main(int argc, char** argv) {
    const int ni = argc > 1 ? atoi(argv[1]) : 401, nj = argc > 2 ? atoi(argv[2]) : 101;
    const int functions = argc > 3 ? atoi(argv[3]) : 20,
              operator_kind = argc > 4 ? atoi(argv[4]) : HM_LAPLACE;
    const double first = argc > 5 ? atof(argv[5]) : 0;
    int rank, size, begin, end, i, j, n = 0;
    hm_error error;
    PetscInitialize(NULL, NULL, NULL, NULL);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    begin = (int)((long)(nj - 1) * rank / size);
    end = (int)((long)(nj - 1) * (rank + 1) / size);
    {
        const size_t points = (size_t)ni * (size_t)(end - begin + 1);
        double *const x = malloc(points * sizeof *x), *const y = malloc(points * sizeof *y),
                      *wall = malloc(2 * (size_t)ni * sizeof *wall);
        int64_t* const numbers = malloc(points * sizeof *numbers);
        int32_t* const lists = malloc(2 * (size_t)ni * sizeof *lists);
        int32_t start[3] = {0, ni, 2 * ni}, markers[2] = {WALL, FAR_FIELD}, n_lists = 0;
        hm_mesh mesh = {sizeof mesh};
        hm_part_mesh part = {sizeof part};
        hm_fit_options fit = {sizeof fit};
        hm_condition on_curve = {sizeof on_curve};
        hm_problem problem = {sizeof problem};
        hm_options options = {sizeof options};
        hm_petsc_report report = {sizeof report};
        hm_petsc* system;
        hm_basis* rows;
        hm_memory memory;
        void* block;
        double before, times[4], megabytes[3], *move;
        for (j = begin; j <= end; ++j) {
            for (i = 0; i < ni; ++i, ++n) {
                place(i, j, ni, nj, first, &x[n], &y[n]);
                numbers[n] = i + (int64_t)ni * j;
            }
        }
        for (i = 0; i < ni; ++i) place(i, 0, ni, nj, first, &wall[i], &wall[ni + i]);
        if (rank == 0) {
            for (i = 0; i < ni; ++i) lists[i] = i;
            ++n_lists;
        }
        if (rank == size - 1) {
            for (i = 0; i < ni; ++i) lists[n_lists * ni + i] = i + ni * (end - begin);
            if (n_lists == 0) markers[0] = FAR_FIELD;
            ++n_lists;
        }
        mesh.n_points = n;
        mesh.points = (hm_points){x, y, 1};
        mesh.cell_layout = HM_CELLS_STRUCTURED;
        mesh.ni = ni;
        mesh.nj = end - begin + 1;
        mesh.n_lists = n_lists;
        mesh.list_start = start;
        mesh.list_points = lists;
        mesh.list_markers = markers;
        part.mesh = &mesh;
        part.numbers = numbers;
        fit.n_control = functions;
        fit.closed = HM_PERIODIC;
        need(hm_fit(NULL, emptied(&memory), NULL, ni - 1, 0, &fit, NULL, &error), &error);
        need(hm_fit(&problem.curves, &(hm_memory){malloc(memory.bytes), memory.bytes},
                    &(hm_points){wall, wall + ni, 1}, ni - 1, 1, &fit, NULL, &error),
             &error);
        on_curve.marker = WALL;
        on_curve.n_curves = 1;
        problem.n_conditions = 1;
        problem.conditions = &on_curve;
        options.operator_kind = operator_kind;
        before = resident();
        times[0] = seconds();
        need(hm_petsc_create(&system, &part, &problem, &options, MPI_COMM_WORLD, &error), &error);
        times[1] = seconds();
        need(hm_petsc_solve(system, NULL, emptied(&memory), NULL, MPI_COMM_WORLD, &error), &error);
        block = memory.block = malloc(memory.bytes);
        need(hm_petsc_solve(system, &rows, &memory, &report, MPI_COMM_WORLD, &error), &error);
        times[2] = seconds();
        megabytes[0] = 1e-6 * ((double)report.bytes + (double)memory.bytes);
        megabytes[1] = 1e-6 * (resident() - before) - megabytes[0];
        megabytes[2] = 1e-6 * (most_resident() - before);
        move = calloc(2 * (size_t)functions, sizeof *move);
        move[0] = 0.01;
        need(hm_morph(rows, move, &mesh.points, &(hm_points_out){x, y, 1}, NULL, &error), &error);
        times[3] = seconds();
        for (i = 3; i > 0; --i) times[i] -= times[i - 1];
        MPI_Allreduce(MPI_IN_PLACE, times + 1, 3, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
        MPI_Allreduce(MPI_IN_PLACE, megabytes, 3, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
        if (rank == 0) {
            printf("%d %ld %.2f %.2f %d %.4f %.1f %.1f %.1f %.1e\n", size, (long)ni * nj, times[1],
                   times[2], (int)report.iterations, times[3], megabytes[0], megabytes[1],
                   megabytes[2], report.error);
        }
        hm_petsc_free(&system);
    }
    PetscFinalize();
    return 0;
}
