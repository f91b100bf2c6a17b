/* harmorph on meshes that no process has as a whole: MPI and PETSc solve for the functions (PETSc
 * 3.18 or later, with real or complex scalars). Compile harmorph_petsc.c, which is one file where
 * harmorph is installed, and, for the adjoint, harmorph_mpi.c with mpicc and PETSc's flags (`pkg-
 * config --cflags --libs petsc`). The library itself calls neither MPI nor PETSc, and must have the
 * version with whose headers harmorph_petsc.c was compiled (HM_VERSION; else hm_petsc_create is
 * refused with HM_UNSUPPORTED).
 *
 *     PetscInitialize                          by the caller
 *     hm_petsc_create(&system, &part, ...)     own cells, points with global numbers
 *     hm_petsc_solve                           a basis with the rows of this process's points
 *     hm_morph(rows, ...)                      moves the points of this process; no messages
 *     hm_petsc_assess                          admissible step and quality of the whole mesh
 *     hm_mpi_adjoint(rows, ...)                see harmorph_mpi.h
 *     hm_petsc_free                            the rows stay
 *
 * All calls but hm_petsc_owned are collective: all processes of the communicator must make them,
 * and each must have at least one own cell. Either all succeed, or all get the same status and the
 * same hm_error: that of the first process with the worst status, whose rank is in front of the
 * text ("rank 2: ..."), also where one process alone gives a wrong argument, such as NULL for the
 * system, or another system than the others. For this purpose each call has the communicator, which
 * must be that of hm_petsc_create (or a duplicate). A refused call leaves all arguments as they
 * were. A process on which an earlier call has failed must make the collective call all the same,
 * with NULL as the part or the system, or the others wait for ever. A process without cells is
 * refused: make a communicator of the processes that have cells (MPI_Comm_split). The calls
 * allocate memory; where harmorph lacks memory, all processes get a status, but if PETSc or hypre
 * lack memory, the job ends. For processes that end, see harmorph_mpi.h.
 *
 * Solver: conjugate gradients with hypre's BoomerAMG (where PETSc has hypre, otherwise GAMG), with
 * a relative tolerance of 1e-6 for each solution; refinement with residuals as sums of differences
 * continues until the estimated error is below options.tolerance. All options of PETSc with the
 * prefix hm_ are used: `-hm_ksp_type preonly -hm_pc_type cholesky -hm_pc_factor_mat_solver_type
 * mumps` factors the matrix; others are `-hm_pc_type gamg`, `-hm_ksp_monitor`, `-hm_mat_type`.
 *
 * Scalars: with real scalars an unknown of the conformal operator has two rows, a block of 2 x 2;
 * with complex scalars the unknown has one row, and the matrix is Hermitian (MUMPS has no Hermitian
 * Cholesky, and factors by `-hm_pc_type lu`). Real operators have one row for each unknown with
 * either kind of scalars. */
#ifndef HARMORPH_PETSC_H
#define HARMORPH_PETSC_H

#include <harmorph.h>
#include <mpi.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hm_petsc hm_petsc;

typedef struct hm_part_mesh {
    uint64_t struct_size;
    /* The part: points, cells, boundary faces. Every face of an own cell that is on the boundary of
     * the whole mesh must have a marker, cuts excepted (see hm_mesh); faces of ghost cells must not
     * be given. index_base counts the points and cells of the part. */
    const hm_mesh* mesh;
    /* [n_points] global numbers of the points, 0 .. 2^61, all different. A point of several parts
     * has the same number and the same coordinates in each. Numbers need not be consecutive. */
    const int64_t* numbers;
    /* [n_cells] 1: a ghost cell, which is an own cell of another part; NULL: all cells are own.
     * Points of ghost cells have functions, and move; ghost cells have no equations. */
    const uint8_t* ghosts;
} hm_part_mesh;

typedef struct hm_petsc_report {
    uint64_t struct_size;
    int64_t unknowns; /* points with an unknown, of the whole mesh */
    int32_t functions;
    /* iterations of the KSP: the largest sum over all solutions of one function; with a direct
     * solver, the number of solutions */
    int32_t iterations;
    int32_t solutions; /* largest number of solutions of a function: the first, and refinements */
    /* boundary faces and edges of cuts of the whole mesh, which every process has */
    int32_t boundary_edges;
    /* [-] largest last correction of a function, relative to its largest value */
    double change;
    /* [-] error estimated from the corrections; above options.tolerance: HM_NOT_CONVERGED */
    double error;
    uint64_t bytes; /* allocated by harmorph on this process, beside the basis */
} hm_petsc_report;

/* Makes a system. The arrays of the part must exist as long as the system. problem and options are
 * the same on all processes; problem.mesh is ignored, and n_known and n_fluxes must be 0. All
 * conditions of HM_DIRECT with HM_COMPACT are available but HM_ROTATION_PAIR and
 * hm_condition.along; options.engine and the scheme must have their defaults (else
 * HM_UNSUPPORTED). Points that slip
 * along curves move along the tangents at the start: a movement by d leaves them d^2 / (2 R) beside
 * the curve, R the radius of curvature. hm_slip needs the whole mesh. Polygons (HM_CELLS_POLYGONS)
 * are divided as in the whole mesh if each part gives their points in the same order.
 *
 * HM_FAR_FROM_CURVE and HM_TORN are those of hm_analysis_init. Refused on all processes: cells that
 * hm_analysis_init refuses; a global number that is negative, too large or repeated; a point with
 * two positions; an edge of more than two cells; cells that overlap; a marker on an edge that has
 * cells on both sides; a point that two processes have inside their own cells (global numbers are
 * wrong); a ghost point that no process has in an own cell (HM_BAD_MESH; the item of a point is the
 * global number, or -1 above 2^31 - 1); curves, conditions or options that are not those of rank 0
 * (HM_BAD_CONDITION). */
hm_status hm_petsc_create(hm_petsc** system, const hm_part_mesh* part, const hm_problem* problem,
                          const hm_options* options, MPI_Comm comm, hm_error* err);
/* Frees the system; collective, because the solvers of PETSc end together. *system becomes NULL. If
 * it is NULL already, on all processes, the call does nothing. */
void hm_petsc_free(hm_petsc** system);

/* Solves for all functions; *rows, a basis for the points of this process, is in the block.
 * HM_NOT_CONVERGED: solved, but less accurate than the tolerance. HM_NOT_POSITIVE: PETSc could not
 * factor or solve. report may be NULL. Bytes: system. The size query is collective, too: it is
 * refused where some processes ask for the size and others solve. */
hm_status hm_petsc_solve(hm_petsc* system, hm_basis** rows, hm_memory* memory,
                         hm_petsc_report* report, MPI_Comm comm, hm_error* err);
/* Does hm_displace for one field of displacements: x and y [points] contain the given numbers at
 * points of markers with HM_GIVEN on every process that has such a point, the same numbers on each
 * (which is not examined), and receive the displacements of all points. After a refused call they
 * are unchanged. */
hm_status hm_petsc_displace(hm_petsc* system, const hm_points_out* displacement,
                            hm_petsc_report* report, MPI_Comm comm, hm_error* err);

/* owned [points] receives 1 at points that this process counts, 0 elsewhere: every point of the
 * mesh is owned by one process. This serves sums over all points, such as those of hm_mpi_adjoint.
 */
hm_status hm_petsc_owned(const hm_petsc* system, uint8_t* owned, hm_error* err);
/* Does hm_assess for the cells of all processes; reports are the same everywhere. step, quality and
 * displacement must not be NULL. rank [2], or
 * NULL: the process with the limiting cell, and the process with the cell of lowest quality; cells
 * and points in the reports are numbered as in the part of that process. The call does not examine
 * whether the boundary touches or crosses itself: boundary is infinite, self_crossing 0. from NULL:
 * the coordinates of the part. quality->cell_quality [cells of the part], or NULL, receives the
 * quality of the own cells; entries of ghost cells keep their values. */
hm_status hm_petsc_assess(const hm_petsc* system, const hm_basis* rows, const hm_points* from,
                          const hm_points* displacement, hm_step_report* step,
                          hm_quality_report* quality, int* rank, MPI_Comm comm, hm_error* err);

/* The same calls with Fortran communicators (MPI_Fint), for harmorph_petsc.f90. */
hm_status hm_petsc_create_f(hm_petsc** system, const hm_part_mesh* part, const hm_problem* problem,
                            const hm_options* options, MPI_Fint comm, hm_error* err);
hm_status hm_petsc_solve_f(hm_petsc* system, hm_basis** rows, hm_memory* memory,
                           hm_petsc_report* report, MPI_Fint comm, hm_error* err);
hm_status hm_petsc_displace_f(hm_petsc* system, const hm_points_out* displacement,
                              hm_petsc_report* report, MPI_Fint comm, hm_error* err);
hm_status hm_petsc_assess_f(const hm_petsc* system, const hm_basis* rows, const hm_points* from,
                            const hm_points* displacement, hm_step_report* step,
                            hm_quality_report* quality, int* rank, MPI_Fint comm, hm_error* err);

#ifdef __cplusplus
}
#endif
#endif
