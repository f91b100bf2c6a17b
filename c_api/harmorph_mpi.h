/* harmorph in codes that run on several processes with MPI. Compile harmorph_mpi.c with mpicc and link it with your
 * code and libharmorph.a; the library itself knows nothing of MPI.
 *
 * Every process has a copy of the whole mesh while it solves a share of the functions; then it keeps the rows of its
 * own points, with all functions:
 *
 *     hm_analysis_init, hm_plan_init, hm_plan_factor      on every process, of the same problem
 *     hm_share_of(analysis, rank, size, &first, &n, &error)
 *     hm_share_init, hm_plan_solve(plan, share, ...)      its functions
 *     hm_extract_init(&rows, ..., share, n_points, points, &error)
 *     hm_mpi_exchange(rows, share, n_points, points, comm, &error)
 *
 * Then analysis, plan, share and the copy of the mesh may be given back. hm_morph(rows, ...) moves the process's points
 * and needs no message. All numbers have the same bits as on one process, for any number of processes and any
 * partition, where all processes use the same kernel (options.kernel, if processors differ).
 *
 * Calls here are collective: all processes of the communicator call them. Either all succeed or all get the same
 * status; the reason is in the hm_error of the process that has it. They allocate what they need for the messages, and
 * free it. */
#ifndef HARMORPH_MPI_H
#define HARMORPH_MPI_H

#include <harmorph.h>
#include <mpi.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Fills rows, made of this process's share by hm_extract_init with the list points [n]. The shares of the processes, in
 * the order of their ranks, must be all functions. A process sends and receives fewer than 2^31 numbers: all processes'
 * points * numbers_per_value * functions of its share, and n * numbers_per_value * functions. */
hm_status hm_mpi_exchange(hm_basis *rows, const hm_basis *share, int32_t n, const int32_t *points, MPI_Comm comm,
                          hm_error *err);

/* hm_adjoint of all processes' rows together: gradient [2*functions] is the same on all of them, bit by bit. Ghosts: 0
 * in dj. One all-reduce of two integers, and one of 4 * numbers_per_value * functions. */
hm_status hm_mpi_adjoint(const hm_basis *rows, const hm_points *dj, double *gradient,
                         const hm_executor *executor, MPI_Comm comm, hm_error *err);

/* The same for Fortran's communicators; harmorph_mpi.f90 calls these. */
hm_status hm_mpi_exchange_f(hm_basis *rows, const hm_basis *share, int32_t n, const int32_t *points, MPI_Fint comm,
                            hm_error *err);
hm_status hm_mpi_adjoint_f(const hm_basis *rows, const hm_points *dj, double *gradient,
                           const hm_executor *executor, MPI_Fint comm, hm_error *err);

#ifdef __cplusplus
}
#endif
#endif
