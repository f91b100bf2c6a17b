/* On any number of processes: what is solved in shares, exchanged, moved and summed up has the bits
 * of one process. */
#include "mpi_case.h"

#include <harmorph_pthreads.h>

#include <string.h>

static int passed, failed, rank, size;

static void check(int holds, const char* what) {
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

/* Points anywhere in the mesh, in the order of no one; the first n_own are the process's own,
 * ghosts follow. */
typedef struct part {
    int32_t *points, n, n_own;
} part;

static part make_part(int32_t n_points) {
    part out;
    int32_t k;
    out.points = room(sizeof *out.points * (size_t)n_points);
    out.n = 0;
    for (k = n_points - 1; k >= 0; --k) {
        if ((int)(scrambled((uint32_t)k) % (uint32_t)size) == rank) out.points[out.n++] = k;
    }
    out.n_own = out.n;
    for (k = 0; k < n_points; ++k) {
        const uint32_t key = scrambled((uint32_t)k);
        if ((int)(key % (uint32_t)size) != rank && key / 1000 % 7 == 0) out.points[out.n++] = k;
    }
    return out;
}

static int same_bits(const double* a, const double* b, int32_t n) {
    return memcmp(a, b, sizeof *a * (size_t)n) == 0;
}

static hm_basis* extract(const hm_basis* from, int32_t n, const int32_t* points, void** block) {
    hm_error error;
    hm_basis* rows = NULL;
    size_t bytes;
    need(hm_private_extract_size(from, n, &bytes, &error), &error);
    *block = room(bytes);
    need(hm_private_extract_init(&rows, *block, bytes, from, n, points, &error), &error);
    return rows;
}

static void check_blocks(const hm_basis* a, const hm_basis* b) {
    hm_basis_info one = {sizeof one}, other = {sizeof other};
    hm_error error;
    need(hm_basis_info_get(a, &one, &error), &error);
    need(hm_basis_info_get(b, &other, &error), &error);
    check(one.solved == 1, "the rows are solved");
    check(one.bytes == other.bytes && memcmp(a, b, (size_t)one.bytes) == 0,
          "rows as on one process, byte by byte");
}

static void check_morph(const hm_basis* whole, const hm_basis* rows, const part* mine,
                        const problem_case* setup) {
    const int32_t n = setup->n_points;
    double *move = room(2 * sizeof *move * (size_t)setup->n_functions),
           *all = room(2 * sizeof *all * (size_t)n);
    double* own = room(2 * sizeof *own * (size_t)mine->n);
    hm_error error;
    int32_t k, wrong = 0;
    for (k = 0; k < 2 * setup->n_functions; ++k) move[k] = 0.01 * cos(3.0 * k);
    for (k = 0; k < mine->n; ++k) {
        own[k] = setup->x[mine->points[k]];
        own[mine->n + k] = setup->y[mine->points[k]];
    }
    need(hm_morph(whole, move, &(hm_points){setup->x, setup->y, 1},
                  &(hm_points_out){all, all + n, 1}, NULL, &error),
         &error);
    need(hm_morph(rows, move, &(hm_points){own, own + mine->n, 1},
                  &(hm_points_out){own, own + mine->n, 1}, NULL, &error),
         &error);
    for (k = 0; k < mine->n; ++k) {
        wrong += memcmp(&own[k], &all[mine->points[k]], sizeof *own) != 0;
        wrong += memcmp(&own[mine->n + k], &all[n + mine->points[k]], sizeof *own) != 0;
    }
    check(wrong == 0, "points move as on one process");
    free(move);
    free(all);
    free(own);
}

static void check_adjoint(const hm_basis* whole, const hm_basis* rows, const part* mine,
                          const problem_case* setup) {
    const int32_t n = setup->n_points, n_gradient = 2 * setup->n_functions;
    double *all = room(2 * sizeof *all * (size_t)n), *own = room(2 * sizeof *own * (size_t)mine->n);
    double *expected = room(sizeof *expected * (size_t)n_gradient),
           *found = room(sizeof *found * (size_t)n_gradient);
    hm_pthreads pool;
    hm_executor executor = hm_pthreads_start(&pool, 3);
    hm_error error;
    int32_t k, not_a_number = 0;
    for (k = 0; k < 2 * n; ++k)
        all[k] = sin(1.7 * k) * pow(10.0, -(double)(scrambled((uint32_t)k) % 12));
    for (k = 0; k < mine->n; ++k) {
        own[k] = k < mine->n_own ? all[mine->points[k]] : 0;
        own[mine->n + k] = k < mine->n_own ? all[n + mine->points[k]] : 0;
    }
    need(hm_adjoint(whole, &(hm_points){all, all + n, 1}, expected, NULL, &error), &error);
    need(hm_mpi_adjoint(rows, &(hm_points){own, own + mine->n, 1}, found, NULL, MPI_COMM_WORLD,
                        &error),
         &error);
    check(same_bits(found, expected, n_gradient), "the gradient is that of one process");
    memset(found, 0, sizeof *found * (size_t)n_gradient);
    need(hm_mpi_adjoint(rows, &(hm_points){own, own + mine->n, 1}, found, &executor, MPI_COMM_WORLD,
                        &error),
         &error);
    check(same_bits(found, expected, n_gradient), "and on several threads of each");
    hm_pthreads_stop(&pool);

    if (rank == size - 1) own[0] = NAN;
    need(hm_mpi_adjoint(rows, &(hm_points){own, own + mine->n, 1}, found, NULL, MPI_COMM_WORLD,
                        &error),
         &error);
    for (k = 0; k < n_gradient; ++k) not_a_number += found[k] != found[k];
    check(not_a_number == n_gradient, "one NaN on one process: NaN on all");
    free(all);
    free(own);
    free(expected);
    free(found);
}

static void check_operator(int32_t operator_kind, int32_t n_functions) {
    problem_case setup;
    solver with;
    part mine;
    hm_error error;
    hm_solve_report report;
    void *whole_block, *rows_block, *expected_block;
    hm_basis *whole, *rows;

    make_case(&setup, 65, 25, n_functions, operator_kind);
    make_solver(&with, &setup);
    mine = make_part(setup.n_points);
    whole = solve_share(&with, 0, n_functions, &whole_block);
    report.struct_size = sizeof report;
    need(solve_rows(&with, mine.n, mine.points, &rows, &rows_block, &report, &error), &error);
    check(report.functions == n_functions * (rank + 1) / size - n_functions * rank / size,
          "each process solves a share of the functions");
    free_solver(&with);
    check_blocks(rows, extract(whole, mine.n, mine.points, &expected_block));
    check_morph(whole, rows, &mine, &setup);
    check_adjoint(whole, rows, &mine, &setup);
    free(whole_block);
    free(rows_block);
    free(expected_block);
    free(mine.points);
}

/* Displacements of wall points that each process knows a part of: the bits of one process, and the
 * exact transpose. */
static void check_displacements(int32_t operator_kind) {
    enum { FIELDS = 3 };
    problem_case setup;
    solver with;
    part mine;
    hm_error error;
    hm_condition given = {sizeof given};
    hm_points wall[FIELDS], on_wall[FIELDS], dj[FIELDS], own_dj[FIELDS];
    hm_points_out to[FIELDS], own_to[FIELDS], all_gradient[FIELDS], gradient[FIELDS];
    const int root = size - 1;
    int32_t k, field, n_wall = 0, n_given = 0, wrong = 0;
    int32_t *all_given, *own_wall;
    double *own_x, *own_y;
    hm_memory memory;
    void* work;

    make_case(&setup, 65, 25, 8, operator_kind);
    given.marker = WALL;
    given.kind = HM_GIVEN;
    setup.problem.curves = NULL;
    setup.problem.conditions = &given;
    make_solver(&with, &setup); /* of one process: what is expected */
    mine = make_part(setup.n_points);
    hm_given_points(with.plan, NULL, 0, &n_given, NULL);
    all_given = room(sizeof *all_given * (size_t)n_given);
    need(hm_given_points(with.plan, all_given, n_given, &n_given, &error), &error);
    own_wall = room(sizeof *own_wall * (size_t)mine.n);
    for (k = 0; k < mine.n; ++k) { /* ghosts too: in several lists */
        if (mine.points[k] < 65) own_wall[n_wall++] = mine.points[k];
    }
    own_x = room(2 * sizeof *own_x * (size_t)mine.n);
    own_y = own_x + mine.n;
    for (field = 0; field < FIELDS; ++field) {
        double *a = room(2 * sizeof *a * (size_t)n_given),
               *b = room(2 * sizeof *b * (size_t)mine.n);
        double *c = room(2 * sizeof *c * (size_t)setup.n_points),
               *d = room(2 * sizeof *d * (size_t)setup.n_points);
        double *e = room(2 * sizeof *e * (size_t)mine.n), *f = room(2 * sizeof *f * (size_t)mine.n);
        double *g = room(2 * sizeof *g * (size_t)mine.n),
               *h = room(2 * sizeof *h * (size_t)n_given);
        for (k = 0; k < n_given; ++k) {
            a[2 * k] = 0.01 * cos(setup.x[all_given[k]] + field);
            a[2 * k + 1] = 0.01 * sin(3 * setup.y[all_given[k]]);
        }
        for (k = 0; k < n_wall; ++k) {
            b[2 * k] = 0.01 * cos(setup.x[own_wall[k]] + field);
            b[2 * k + 1] = 0.01 * sin(3 * setup.y[own_wall[k]]);
        }
        for (k = 0; k < setup.n_points; ++k) {
            c[2 * k] = sin(1.3 * k + field);
            c[2 * k + 1] = cos(0.7 * k);
        }
        for (k = 0; k < mine.n; ++k) {
            e[k] = k < mine.n_own ? c[2 * mine.points[k]] : 0;
            e[mine.n + k] = k < mine.n_own ? c[2 * mine.points[k] + 1] : 0;
        }
        wall[field] = (hm_points){a, a + 1, 2};
        on_wall[field] = (hm_points){b, b + 1, 2};
        dj[field] = (hm_points){c, c + 1, 2};
        to[field] = (hm_points_out){d, d + setup.n_points, 1};
        own_dj[field] = (hm_points){e, e + mine.n, 0};
        own_to[field] = (hm_points_out){f, f + mine.n, 1};
        gradient[field] = (hm_points_out){g, g + mine.n, 1};
        all_gradient[field] = (hm_points_out){h, h + 1, 2};
    }
    need(hm_displace(with.plan, 0, NULL, FIELDS, NULL, NULL, NULL, emptied(&memory), NULL, &error),
         &error);
    work = memory.block = room(memory.bytes);
    need(hm_displace(with.plan, n_given, NULL, FIELDS, wall, NULL, to, &memory, NULL, &error),
         &error);
    need(hm_mpi_displace(rank == root ? with.plan : NULL, n_wall, own_wall, FIELDS, on_wall, mine.n,
                         mine.points, NULL, own_to, root, MPI_COMM_WORLD, &error),
         &error);
    for (field = 0; field < FIELDS; ++field) {
        for (k = 0; k < mine.n; ++k) {
            wrong += memcmp(&own_to[field].x[k], &to[field].x[mine.points[k]], sizeof(double)) != 0;
            wrong += memcmp(&own_to[field].y[k], &to[field].y[mine.points[k]], sizeof(double)) != 0;
        }
    }
    check(wrong == 0, "displacements as on one process");

    need(hm_displace_adjoint(with.plan, n_given, NULL, FIELDS, dj, all_gradient, &memory, NULL,
                             &error),
         &error);
    need(hm_mpi_displace_adjoint(rank == root ? with.plan : NULL, n_wall, own_wall, FIELDS, own_dj,
                                 mine.n, mine.points, gradient, root, MPI_COMM_WORLD, &error),
         &error);
    for (field = 0; field < FIELDS; ++field) {
        double sums[130] = {0}, of_all[130] = {0};
        double size_of_it = 0;
        for (k = 0; k < n_wall; ++k) {
            const int32_t at =
                own_wall[k] == 64 ? 0 : own_wall[k]; /* the two sides of the cut move together */
            sums[2 * at] += gradient[field].x[k];
            sums[2 * at + 1] += gradient[field].y[k];
        }
        MPI_Allreduce(sums, of_all, 130, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
        for (k = 0; k < n_given; ++k) {
            const int32_t at = all_given[k] == 64 ? 0 : all_given[k];
            size_of_it = fmax(size_of_it, fabs(all_gradient[field].x[2 * k]));
            of_all[2 * at] -= all_gradient[field].x[2 * k];
            of_all[2 * at + 1] -= all_gradient[field].y[2 * k];
        }
        for (wrong = 0, k = 0; k < 130; ++k) wrong += fabs(of_all[k]) > 0;
        check(size_of_it > 0.01, "there is a gradient");
        check(wrong == 0, "gradients of all processes together are those of one process");
    }

    for (k = 0; k < mine.n; ++k) { /* in place, with coordinates */
        own_x[k] = setup.x[mine.points[k]];
        own_y[k] = setup.y[mine.points[k]];
    }
    to[0] = (hm_points_out){to[0].x, to[0].y, 1};
    need(hm_displace(with.plan, n_given, NULL, 1, wall, &(hm_points){setup.x, setup.y, 1}, to,
                     &memory, NULL, &error),
         &error);
    need(hm_mpi_displace(rank == root ? with.plan : NULL, n_wall, own_wall, 1, on_wall, mine.n,
                         mine.points, &(hm_points){own_x, own_y, 1},
                         &(hm_points_out){own_x, own_y, 1}, root, MPI_COMM_WORLD, &error),
         &error);
    for (wrong = 0, k = 0; k < mine.n; ++k) {
        wrong += memcmp(&own_x[k], &to[0].x[mine.points[k]], sizeof(double)) != 0;
        wrong += memcmp(&own_y[k], &to[0].y[mine.points[k]], sizeof(double)) != 0;
    }
    check(wrong == 0, "points move as on one process");

    for (field = 0; field < FIELDS; ++field) {
        free((void*)(size_t)wall[field].x);
        free((void*)(size_t)on_wall[field].x);
        free((void*)(size_t)dj[field].x);
        free((void*)(size_t)own_dj[field].x);
        free(to[field].x);
        free(own_to[field].x);
        free(gradient[field].x);
        free(all_gradient[field].x);
    }
    free(own_x);
    free(work);
    free(all_given);
    free(own_wall);
    free(mine.points);
    free_solver(&with);
}

int main(int argc, char** argv) {
    int own[2], all[2];
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    check_operator(HM_LAPLACE, 14);
    check_operator(HM_CONFORMAL, 9);
    check_operator(HM_LAPLACE, 5); /* not many more than processes */
    check_displacements(HM_LAPLACE);
    check_displacements(HM_CONFORMAL);
    own[0] = passed;
    own[1] = failed;
    MPI_Reduce(own, all, 2, MPI_INT, MPI_SUM, 0, MPI_COMM_WORLD);
    if (rank == 0) printf("%d passed, %d failed\n", all[0], all[1]);
    MPI_Finalize();
    return failed > 0;
}
