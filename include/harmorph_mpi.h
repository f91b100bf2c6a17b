/* harmorph in codes that run on several processes with MPI. Compile harmorph_mpi.c with mpicc, and
 * link your code with the object file and libharmorph.a; the library itself does not call MPI.
 *
 * While functions are solved, every process has a copy of the whole mesh and solves some of the
 * functions. Afterwards a process keeps the rows of the points of its own partition, with all
 * functions:
 *
 *     hm_analysis_init, hm_plan_init, hm_plan_factor      on every process, of the same problem
 *     hm_mpi_solve(&rows, &memory, plan, analysis, n, points, &report, comm, &error)
 *     hm_morph(rows, ...), hm_mpi_adjoint(rows, ...)      any number of times
 *
 * After hm_mpi_solve analysis, plan and the copy of the mesh may be freed. hm_morph(rows, ...)
 * moves the points of this process and needs no communication. Results are bitwise identical to a
 * serial run, for any number of processes and any partition, if all processes use the same kernel
 * (set hm_executor.kernel where processors differ).
 *
 * The calls of this header are collective: all processes of the communicator must make them. Either
 * all processes succeed, or all get the same status and the same hm_error: that of the first
 * process with the worst status, whose rank is in front of the text ("rank 2: ..."). This holds for
 * every wrong argument of one process, also for a number of fields, functions or a mesh that are
 * not those of the other processes. Items of the error are numbered as on that process. A process
 * on which an earlier call has failed, for instance hm_analysis_init because a coordinate is NaN,
 * must make the collective call all the same, or the others wait for ever: hm_mpi_solve with plan =
 * NULL makes all processes refuse the call, and so do hm_mpi_adjoint with rows = NULL, and
 * hm_mpi_displace with n_fields = 0. A process may have no points (n = 0). The calls allocate
 * memory for the messages, and free it before they return. The library must have the version with
 * whose headers harmorph_mpi.c was compiled (HM_VERSION): with another one, hm_mpi_solve and
 * hm_mpi_adjoint are refused (HM_UNSUPPORTED).
 *
 * MPI itself decides what happens if a process ends or cannot be reached: by default
 * (MPI_ERRORS_ARE_FATAL) MPI ends all processes. harmorph adds nothing to this, and does not look
 * at what calls of MPI return. */
#ifndef HARMORPH_MPI_H
#define HARMORPH_MPI_H

#include "harmorph.h"
#include <mpi.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Solves for all functions, each process for some of them, and gives each process the values of all
 * functions at its own points. The plan must have a factor, and the analysis must be that of the
 * plan; both must be those of the same problem on all processes.
 *
 * *rows is a basis in the block with n points: point k is points[k], counted from the index_base of
 * the mesh, in any order; ghosts and repeated points are allowed. hm_morph, hm_mpi_adjoint,
 * hm_boundary_error and hm_basis_values use arrays of n points in that order, and points in reports
 * are positions in the list. The rows have no cells, so calls with a mesh refuse them. Like any
 * basis they are one block that refers to nothing else.
 *
 * report: of the functions that this process has solved, with partition_defect 0; may be NULL.
 * HM_NOT_CONVERGED is that of hm_plan_solve on any process. A process sends (points of all
 * processes) * numbers_per_value * (its functions) doubles, and receives n * numbers_per_value *
 * (all functions); either number must be below 2^31. Bytes: analysis, n; enough for any list of n
 * points. The size query is collective, too: it is refused where some processes ask for the size
 * and others solve. */
hm_status hm_mpi_solve(hm_basis** rows, hm_memory* memory, hm_plan* plan,
                       const hm_analysis* analysis, int32_t n, const int32_t* points,
                       hm_solve_report* report, MPI_Comm comm, hm_error* err);

/* hm_adjoint for the rows of all processes together: gradient [2*functions] is bitwise the same on
 * all processes. The rows are those of one hm_mpi_solve; rows with another number of functions than
 * those of rank 0 are refused (HM_BAD_BASIS). dj must be 0 at ghost points, so that every point
 * counts once. Communication: an all-reduce of four 32-bit integers, and one of 4 *
 * numbers_per_value * functions 64-bit integers.
 */
hm_status hm_mpi_adjoint(const hm_basis* rows, const hm_points* dj, double* gradient,
                         const hm_executor* executor, MPI_Comm comm, hm_error* err);

/* Does hm_displace for codes that have the mesh in parts: one process, `root`, has the whole mesh
 * and a plan with a factor; plan is NULL on the others, which need neither mesh nor plan.
 *
 * n_wall, wall_points [n_wall], wall [n_fields]: the given points that this process knows, by their
 * numbers in the whole mesh, and their displacements. The lists of all processes together are that
 * of hm_displace: each given point must be in one of them, and may be in several, with equal
 * displacements. n, points [n], to [n_fields]: the points of this process, including ghosts, and
 * the arrays that receive their results. from [n]: their coordinates; NULL on all processes: `to`
 * receives displacements. With `from` each point of the mesh must be in a list, because the
 * boundary is judged as a whole. n_fields and root are the same on all processes.
 *
 * Results have the bits of hm_displace on one process, for any partition. Communication: lists and
 * fields to root, results back, 16 bytes for each point and field. If the call is refused, `to` is
 * unchanged on all processes. */
hm_status hm_mpi_displace(hm_plan* plan, int32_t n_wall, const int32_t* wall_points,
                          int32_t n_fields, const hm_points* wall, int32_t n, const int32_t* points,
                          const hm_points* from, const hm_points_out* to, int32_t root,
                          MPI_Comm comm, hm_error* err);
/* The transpose. dj [n_fields]: each of n points, 0 at ghosts, so that every point counts once.
 * gradient [n_fields]: each of n_wall points. The first list that has a point, in the order of
 * ranks, receives its whole derivative, and the others 0, so that sums over all processes are sums
 * over the wall. */
hm_status hm_mpi_displace_adjoint(hm_plan* plan, int32_t n_wall, const int32_t* wall_points,
                                  int32_t n_fields, const hm_points* dj, int32_t n,
                                  const int32_t* points, const hm_points_out* gradient,
                                  int32_t root, MPI_Comm comm, hm_error* err);

/* The same calls with Fortran communicators (MPI_Fint), for harmorph_mpi.f90. */
hm_status hm_mpi_solve_f(hm_basis** rows, hm_memory* memory, hm_plan* plan,
                         const hm_analysis* analysis, int32_t n, const int32_t* points,
                         hm_solve_report* report, MPI_Fint comm, hm_error* err);
hm_status hm_mpi_adjoint_f(const hm_basis* rows, const hm_points* dj, double* gradient,
                           const hm_executor* executor, MPI_Fint comm, hm_error* err);
hm_status hm_mpi_displace_f(hm_plan* plan, int32_t n_wall, const int32_t* wall_points,
                            int32_t n_fields, const hm_points* wall, int32_t n,
                            const int32_t* points, const hm_points* from, const hm_points_out* to,
                            int32_t root, MPI_Fint comm, hm_error* err);
hm_status hm_mpi_displace_adjoint_f(hm_plan* plan, int32_t n_wall, const int32_t* wall_points,
                                    int32_t n_fields, const hm_points* dj, int32_t n,
                                    const int32_t* points, const hm_points_out* gradient,
                                    int32_t root, MPI_Fint comm, hm_error* err);

#ifdef __cplusplus
}
#endif
#endif
