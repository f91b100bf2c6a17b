/* Calls for the modules of harmorph_mpi.h and harmorph_petsc.h, which are joined with this file
 * (packaging/join.sh). They are no part of the interface: this file is not installed, and the calls
 * may change with every version, so the modules refuse a library of another version. The calls know
 * nothing of processes: they work on the arrays of one part, and the modules send what they give to
 * other parts. The conventions of harmorph.h hold.
 *
 * Equations of a part; memory is proportional to the part, and to the boundary of the whole mesh:
 *     hm_private_part_init          a part: its own cells, perhaps ghost cells, global numbers
 *     hm_private_part_edges         edges that have one cell in this part: sent to the part that
 *                                   compares
 *     hm_private_match_edges        drops edges that two parts share; the edges that remain of all
 *                                   parts, gathered everywhere, are the boundary of the mesh and
 *                                   its cuts
 *     hm_private_equations_init     conditions, wall parameters, unknowns, matrix of the part
 *     hm_private_equations_entries  entries of the part: the matrix is the sum over all parts
 *     hm_private_rows_init          a basis for the points of the part, with its right-hand sides
 *     hm_private_rows_get           right-hand sides: those of the mesh are sums over all parts
 *     hm_private_rows_set           values of the unknowns, from the solver
 *     hm_private_rows_residual      b - A x of the part, as sums of differences: refinement makes
 *                                   the solution as accurate as that of HM_DIRECT
 *     hm_private_rows_finish        the basis is solved */
#ifndef HARMORPH_PRIVATE_H
#define HARMORPH_PRIVATE_H

#include "harmorph.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Bases of some points or some functions ---- */

/* Makes a basis for some points only, for instance those of one process. Point k of the new basis
 * is points[k], counted from the index_base of the mesh, in any order; ghosts and repeated points
 * are allowed. hm_morph, hm_adjoint, hm_boundary_error and hm_basis_values use arrays of n points
 * in that order, and points in reports are positions in the list. A wall point remains a wall point
 * at its first position in the list (or that of the other side of a cut). The new basis has no
 * cells: calls with a mesh refuse it. Like any basis it is one block that refers to nothing else
 * and may be moved. The size is a bound, sufficient for any list of n points, n <= 2^30. An extract
 * of a basis that has only some functions (hm_private_share_init) receives its values by
 * hm_private_parcel_unpack.
 */
HM_API hm_status hm_private_extract_size(const hm_basis* basis, int32_t n, size_t* bytes,
                                         hm_error* err);
HM_API hm_status hm_private_extract_init(hm_basis** rows, void* block, size_t bytes,
                                         const hm_basis* basis, int32_t n, const int32_t* points,
                                         hm_error* err);

/* Distributes the functions evenly, in order: part k (from 0) of n_parts solves functions *first ..
 * *first + *n - 1, from 0. *n is 0 for some parts if there are more parts than functions. */
HM_API hm_status hm_private_share_of(const hm_analysis* analysis, int32_t part, int32_t n_parts,
                                     int32_t* first, int32_t* n, hm_error* err);
/* Makes a share: a basis with memory for functions first .. first+n-1 only, from 0, n >= 0.
 * hm_plan_solve solves for them, with the same bits as for all functions together; the report
 * covers the share, with partition_defect 0. Calls that need all functions (morph, adjoint) refuse
 * a share. The functions keep their numbers, and hm_basis_info.functions counts all functions. */
HM_API hm_status hm_private_share_size(const hm_analysis* analysis, int32_t first, int32_t n,
                                       size_t* bytes, hm_error* err);
HM_API hm_status hm_private_share_init(hm_basis** share, void* block, size_t bytes,
                                       const hm_analysis* analysis, int32_t first, int32_t n,
                                       hm_error* err);
/* A parcel carries the values of a share to the rows (hm_private_extract_init) of another process:
 * doubles
 * [*doubles] for a list of n points. Unpack the parcels of all shares in the order of their
 * functions, each packed for the list that the rows were made with. After the last parcel the rows
 * are solved. Refused with HM_BAD_BASIS: a parcel of other functions, for another list (also for
 * the same points in another order), or out of order; the rows stay as they were. */
HM_API hm_status hm_private_parcel_size(const hm_basis* share, int32_t n, int64_t* doubles,
                                        hm_error* err);
HM_API hm_status hm_private_parcel_pack(const hm_basis* share, int32_t n, const int32_t* points,
                                        double* parcel, hm_error* err);
HM_API hm_status hm_private_parcel_unpack(hm_basis* rows, const double* parcel, int64_t doubles,
                                          hm_error* err);

/* hm_adjoint in parts, with the same bits for any partition: take the largest of the scales of all
 * parts; compute the sums [4 * functions * numbers_per_value] of each part with that scale and add
 * them elementwise; finish with the total. Each mesh point must count in one part only: set dj to 0
 * at ghosts. Products are rounded once and added as integers, in units of 2^-63 of the scale (a
 * power of two up to 2 max|F| max|dj|): the error is at most 2^-51 sum|F dj| + N 2^-63 max|F|
 * max|dj| for N points, N <= 2^30. hm_adjoint is these three calls. If a number is not finite or a
 * product could overflow, the gradient is NaN. */
HM_API hm_status hm_private_adjoint_scale(const hm_basis* basis, const hm_points* dj,
                                          int32_t* scale, const hm_executor* executor,
                                          hm_error* err);
HM_API hm_status hm_private_adjoint_sums(const hm_basis* basis, const hm_points* dj, int32_t scale,
                                         int64_t* sums, const hm_executor* executor, hm_error* err);
HM_API hm_status hm_private_adjoint_finish(const hm_basis* basis, int32_t scale,
                                           const int64_t* sums, double* gradient, hm_error* err);

/* ---- A part of the mesh ---- */

typedef struct hm_private_part hm_private_part;

typedef struct hm_private_part_mesh {
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
} hm_private_part_mesh;

/* The arrays of `mesh` must exist as long as the part, and must not change before
 * hm_private_equations_init. Refused (HM_BAD_MESH): cells that hm_analysis_init refuses, and a
 * global number that is negative, too large or repeated; error.item counts from mesh.index_base.
 * Polygons (HM_CELLS_POLYGONS) are divided as in the whole mesh if each part gives their points in
 * the same order: each polygon is an own cell of one part, which alone divides it. */
HM_API hm_status hm_private_part_size(const hm_private_part_mesh* mesh, size_t* bytes,
                                      hm_error* err);
HM_API hm_status hm_private_part_init(hm_private_part** part, void* block, size_t bytes,
                                      const hm_private_part_mesh* mesh, hm_error* err);
/* The own cells as a mesh for hm_assess with the basis of this part (hm_private_rows_init):
 * HM_CELLS_QUADS, or HM_CELLS_POLYGONS if the part has polygons, counter-clockwise, with the
 * caller's points. *cell [n_cells of this mesh]: the number of each cell in the caller's mesh, or
 * NULL: the same number. own->struct_size is set by the caller. */
HM_API hm_status hm_private_part_cells(const hm_private_part* part, hm_mesh* own,
                                       const int32_t** cell, hm_error* err);

/* role [n_points]: 2 for points of own cells, 1 for those of ghost cells alone, 0 for points of no
 * cell. */
HM_API hm_status hm_private_part_points(const hm_private_part* part, uint8_t* role, hm_error* err);

/* An edge of a part. The struct will always have 56 bytes and has no pointers: send it as it is. */
typedef struct hm_private_edge {
    /* global numbers of the two ends; the cell is on the left of the way from begin to end */
    int64_t begin, end;
    double begin_x, begin_y, end_x, end_y;
    int32_t marker, marked; /* marked 1: a boundary face; 0: marker is 0 */
} hm_private_edge;

/* The edges of the part with one own cell. edges [capacity]; *n: their number, also if the capacity
 * is too small (HM_BAD_ARGUMENT). */
HM_API hm_status hm_private_part_edges(const hm_private_part* part, hm_private_edge* edges,
                                       int32_t capacity, int32_t* n, hm_error* err);
/* Drops the edges inside the mesh. edges [*n]: edges of several parts in any order; all edges with
 * the same two ends must be among them. Two that run in opposite directions are one edge inside the
 * mesh. On return *n edges are left, in the order of their numbers: boundary faces and open edges.
 * Refused (HM_BAD_MESH; item: global number of a point, -1 above 2^31 - 1): a point with two
 * positions, an edge of more than two cells, cells that overlap, a marker on an edge that has cells
 * on both sides. The order of the edges may have changed then. */
HM_API hm_status hm_private_match_edges(hm_private_edge* edges, int64_t* n, hm_error* err);

/* ---- Equations of a part ---- */

typedef struct hm_private_equations hm_private_equations;

/* Makes the equations of a part. problem: curves and conditions, the same in all parts;
 * problem.mesh is ignored, and n_known must be 0. options: operator, exponent, offset correction,
 * tolerance, kernel and executor count; scheme, engine and precision must be HM_COMPACT, HM_DIRECT
 * and HM_DOUBLE (else HM_UNSUPPORTED), though no engine is used. edges [n_edges]: the edges that
 * hm_private_match_edges has left of all parts, in any order, the same in all parts. The size is an
 * upper bound from the counts of the part and the edges; only hm_private_equations_init reads the
 * edges.
 *
 * All conditions of HM_DIRECT with HM_COMPACT are available but HM_ROTATION_PAIR and
 * hm_condition.along (HM_UNSUPPORTED). Points that slip along curves move along the tangents at the
 * start: a movement by d leaves them d^2 / (2 R) beside the curve, R the radius of curvature.
 * hm_slip needs the whole mesh. */
HM_API hm_status hm_private_equations_size(const hm_private_part* part, int32_t n_edges,
                                           const hm_problem* problem, const hm_options* options,
                                           size_t* bytes, hm_error* err);
HM_API hm_status hm_private_equations_init(hm_private_equations** equations, void* block,
                                           size_t bytes, const hm_private_part* part,
                                           int32_t n_edges, const hm_private_edge* edges,
                                           const hm_problem* problem, const hm_options* options,
                                           hm_error* err);

typedef struct hm_private_equations_info {
    uint64_t struct_size;
    /* unknowns of this part, including those of ghost points and of points of other parts, too */
    int32_t unknowns;
    /* real numbers of an unknown: 1, or 2 for the conformal operator (a + i b as a, b). The rows of
     * an unknown in the real system are numbers * unknown + 0 .. numbers - 1. */
    int32_t numbers;
    /* right-hand sides: functions; twice as many where rigid bodies make values of a real operator
     * complex, and where points slip along lines */
    int32_t columns;
    int32_t functions;
    /* right-hand sides of one field of given displacements, see hm_private_field_init: 1 or 2 */
    int32_t field_columns;
    int32_t reserved; /* 0 */
    /* [unknowns] global name of each, all different, in increasing order, otherwise arbitrary:
     * parts that share an unknown have the same name for it. Points that are joined (cuts, periodic
     * pairs) share an unknown. With slip a point has two unknowns, with names 2 m and 2 m + 1. */
    const int64_t* unknown;
    /* [unknowns] 1: an own cell of this part has it, so that the part has entries */
    const int32_t* own;
} hm_private_equations_info;
HM_API hm_status hm_private_equations_info_get(const hm_private_equations* equations,
                                               hm_private_equations_info* info, hm_error* err);

/* Entries of unknowns first .. first + n - 1 with themselves and with later unknowns: the upper
 * triangle, by unknowns. row, column [capacity]: unknowns of this part, from 0; values [capacity *
 * numbers * numbers]: the block of each, row by row. The lower triangle is the transpose: block
 * (column, row) is the transpose of block (row, column). *n_entries: their number, also if the
 * capacity is too small (HM_BAD_ARGUMENT). */
HM_API hm_status hm_private_equations_entries(const hm_private_equations* equations, int32_t first,
                                              int32_t n, int32_t* row, int32_t* column,
                                              double* values, int64_t capacity, int64_t* n_entries,
                                              hm_error* err);

/* ---- Right-hand sides, values, residuals ---- */

/* Makes a basis for the points of the part, in the order of the part. Until hm_private_rows_finish
 * the basis counts as not solved; its memory holds the right-hand sides, then the values.
 * hm_private_rows_init sets the values on the wall, which are exact, and the right-hand sides of
 * this part at unknowns.
 */
HM_API hm_status hm_private_rows_size(const hm_private_equations* equations, size_t* bytes,
                                      hm_error* err);
HM_API hm_status hm_private_rows_init(hm_basis** rows, void* block, size_t bytes,
                                      const hm_private_equations* equations, hm_error* err);
/* Read and write one column, from 0: numbers [unknowns * numbers], unknown by unknown. */
HM_API hm_status hm_private_rows_get(const hm_private_equations* equations, const hm_basis* rows,
                                     int32_t column, double* numbers, hm_error* err);
HM_API hm_status hm_private_rows_set(const hm_private_equations* equations, hm_basis* rows,
                                     int32_t column, const double* numbers, hm_error* err);
/* This part of the residual b - A x of one column, after hm_private_rows_set: residual [unknowns *
 * numbers]. */
HM_API hm_status hm_private_rows_residual(hm_private_equations* equations, const hm_basis* rows,
                                          int32_t column, double* residual, hm_error* err);
/* Completes the basis after the last hm_private_rows_set. largest: the largest magnitude of all
 * values of all parts, 0 if unknown; with the same number in all parts hm_private_adjoint_scale
 * does not depend on the partition. */
HM_API hm_status hm_private_rows_finish(hm_private_equations* equations, hm_basis* rows,
                                        double largest, hm_error* err);

/* ---- Given displacements ---- */

/* These calls do what hm_displace does, for one field at a time. displacement [points of the part]
 * contains the given numbers at points of markers with HM_GIVEN, and receives those of all points.
 * work: 2 * points doubles, which the calls of one field share. hm_private_field_init computes the
 * right-hand sides [unknowns * numbers * field_columns] of this part, column by column.
 * hm_private_field_residual computes the residuals of values in the same layout, and
 * hm_private_field_finish turns such values into the displacement of all points of the part. */
HM_API hm_status hm_private_field_init(hm_private_equations* equations,
                                       const hm_points* displacement, double* work,
                                       double* right_hand_sides, hm_error* err);
HM_API hm_status hm_private_field_residual(hm_private_equations* equations, double* work,
                                           const double* values, double* residuals, hm_error* err);
HM_API hm_status hm_private_field_finish(hm_private_equations* equations, double* work,
                                         const double* values, const hm_points_out* displacement,
                                         hm_error* err);

#ifdef __cplusplus
}
#endif
#endif
