/* Bases that are made from another basis: its functions in single precision, combined into one
 * function for each design variable, interpolated to a finer mesh, or extended by functions whose
 * values at the wall are given by a table; and the functions as a dense array. The conventions of
 * harmorph.h hold. */
#ifndef HARMORPH_BASES_H
#define HARMORPH_BASES_H

#include "harmorph.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Functions as a dense array, for products elsewhere ---- */

/* Copies all functions at all points to matrix [numbers_per_value * n_points * functions]: planes
 * of numbers (hm_basis_info), in each plane the points one after the other, for each point the
 * functions. With the planes as matrices F0, F1, ... [n_points, functions], and the movements of
 * hm_morph as the columns px, py [functions], the displacements of hm_morph are, but for rounding,
 *     1 plane:   dx = F0 px              dy = F0 py
 *     2 planes:  dx = F0 px - F1 py      dy = F1 px + F0 py
 *     4 planes:  dx = F0 px + F1 py      dy = F2 px + F3 py
 * so that a thousand movements are one product of matrices in any library, on any device. */
HM_API hm_status hm_basis_matrix(const hm_basis* basis, double* matrix, hm_error* err);

/* ---- Functions in single precision ---- */

/* Makes a second basis with the same functions in single precision, in half the memory. hm_morph
 * and hm_adjoint are limited by reading the basis; if the basis fits in no cache, hm_morph is 1.5
 * to 1.9 times as fast with AVX-512 or AVX2, 1.4 times without either; hm_adjoint, which computes
 * more, gains with AVX-512 only: 1.4 to 1.8 times. The first basis must be solved and have all
 * functions (it may be an extract); it is no longer needed afterwards.
 *
 * Points on curves and rigid bodies, and points joined to them by a cut, keep F in double
 * precision: the wall moves bitwise as with the first basis. Fixed points do not move. Elsewhere
 * |F' - F| <= 2^-24 |F| for each number (below 2^-126: 2^-150), so that a displacement differs by
 * at most 2^-24 sum_i |F_i| |dP_i| plus rounding of the sum; the functions sum to 1, and points
 * slip along inclined lines, to that accuracy. Products and sums are in double precision, and
 * hm_adjoint is the transpose of hm_morph as accurately as in double precision; bitwise identical
 * for any threads, kernel and partition.
 *
 * The new basis is written, attached, extracted from and used like any basis. Calls that need F in
 * double precision return HM_UNSUPPORTED: hm_plan_solve, hm_transfer, hm_move_safe, hm_combine,
 * hm_tabulate, hm_single_init. Bytes: basis. */
HM_API hm_status hm_single_init(hm_basis** single, hm_memory* memory, const hm_basis* basis,
                                hm_error* err);

/* ---- Combined functions: one for each design variable ---- */

/* Makes a second basis with n functions F M, n >= 1: function j carries variable j, which moves
 * control point i by M_ij times itself. matrix [controls * n * numbers] with the n values of
 * control point 0 first; controls = functions - 2 * bodies - modes of the given basis; numbers 1:
 * real values, 2: pairs x,y, complex numbers (hm_section_move.matrix). Rigid bodies and modes
 * keep their functions after the n. Points are moved, gradients formed, and curves moved
 * (hm_basis_curves) by variables instead of control points; the basis has the memory of n
 * functions, and the first basis is no longer needed. Values are real if those of the first basis
 * and the matrix are. If the matrix of a variable or the functions are complex, the movement is
 * rotated by the angle of the variable; a variable that is one number v moves by (v, 0).
 *
 * The new basis is used, solved again (hm_plan_solve, on moved coordinates too), extracted, sent in
 * parcels, written, attached, stored in single precision and combined like any basis. Only
 * hm_transfer refuses it, with HM_UNSUPPORTED: transfer the functions of the control points, and
 * combine those. The first basis must be solved, complete and in double precision. Refused with
 * HM_BAD_CONDITION (error.item: the column, from 0): a column that is zero, or a combination of the
 * columns before; with HM_BAD_ARGUMENT: a matrix that is not finite. Bytes: basis, n, numbers. */
HM_API hm_status hm_combine(hm_basis** combined, hm_memory* memory, const hm_basis* basis,
                            int32_t n, int32_t numbers, const double* matrix, hm_error* err);

/* ---- Coarse to fine: functions of one mesh for a finer mesh of the same domain ---- */

typedef struct hm_transfer_report {
    uint64_t struct_size;
    int32_t points; /* interpolated points: neither on a curve nor fixed */
    /* interpolated points and curve points that are outside the coarse mesh */
    int32_t outside;
    /* [length] largest distance of those points from the coarse mesh */
    double max_distance;
    int32_t max_distance_point;   /* the point with that distance; -1: none is outside */
    int32_t boundary_error_point; /* the point with the boundary error below */
    /* [-] largest |F_i - N_i(u)| on the curves, with N_i evaluated again */
    double boundary_error;
    /* [-] the same before N_i was restored: how well the coarse mesh resolves the functions */
    double wall_correction;
} hm_transfer_report;

/* Fills a basis that was made from the fine analysis by interpolation; no plan is needed. The fine
 * analysis must have the curves, conditions and options of the coarse basis. A point
 * receives the values of the coarse cell that contains the point. A point beyond a curved boundary
 * receives the linear extrapolation of the nearest cell; if the point is farther away than half the
 * longest side of that cell, the call is refused (HM_BAD_MESH, error.item: the point, error.value:
 * the distance). Curve points receive N_i(u), and points nearer to them than one coarse cell are
 * corrected accordingly; fixed points receive 0; points with slip remain on their lines. The result
 * is of second order in the coarse spacing, and exact for linear functions. Uses the threads of the
 * analysis. `coarse` must have all functions, not a share of them (HM_BAD_BASIS), and must not be
 * `basis` (HM_BAD_ARGUMENT). Objects that do not belong together are refused before anything is
 * written; after any other refusal the basis is not solved. report may be NULL. Bytes: analysis,
 * coarse_mesh; working memory. */
HM_API hm_status hm_transfer(hm_basis* basis, hm_memory* memory, const hm_analysis* analysis,
                             const hm_basis* coarse, const hm_mesh* coarse_mesh,
                             hm_transfer_report* report, hm_error* err);

/* ---- Functions by table: modes given at wall points ---- */

/* A table of modes: displacements of wall points for a unit of each amplitude. */
typedef struct hm_modes {
    uint64_t struct_size;
    int32_t n_modes; /* 1 .. 2^20 */
    /* 0 or 2: pairs x,y, complex numbers: the amplitude (1, 0) moves the points by (x, y), (0, 1)
     * by the same rotated by 90 degrees. 1: real values, which move points along the amplitude. */
    int32_t numbers;
    int32_t n; /* wall points */
    int32_t reserved;
    const int32_t* points; /* [n] see hm_displace; NULL: in the order of hm_given_points */
    const double* values;  /* [n_modes * n * numbers] mode by mode; a size query does not read it */
} hm_modes;

/* Makes a second basis: the functions of `basis`, and after them functions with given values at the
 * points of the markers with HM_GIVEN: structural modes, modes of a proper orthogonal
 * decomposition, anything linear. They are solved with the plan, as by hm_displace; an amplitude
 * moves wall point k by its mode times the amplitude. Values of the functions are real if those of
 * `basis` and the modes are. move, see hm_morph, has the amplitudes last.
 *
 * The new basis refers to nothing else and is used like any basis: hm_plan_solve solves it again,
 * on moved coordinates too, with the same values at the wall, if it has at most 1024 numbers at a
 * point for its modes. hm_transfer refuses it with HM_UNSUPPORTED, because a table says nothing
 * between its points. `basis` must be of the same analysis as the plan, complete, in double
 * precision, and solved if it has functions. The new basis lies at the beginning of the block, and
 * working memory behind it: only hm_basis_info.bytes bytes from the basis on are needed afterwards.
 * report may be NULL; functions are fields there. Refused with HM_BAD_CONDITION: no marker with
 * HM_GIVEN, a mode that is zero (error.item: the mode, from 0), a list that is not that of the
 * given points; with HM_BAD_ARGUMENT: values that are not finite. HM_NOT_CONVERGED is that of
 * hm_plan_solve. Bytes: plan, basis, modes. */
HM_API hm_status hm_tabulate(hm_basis** tabulated, hm_memory* memory, hm_plan* plan,
                             const hm_basis* basis, const hm_modes* modes, hm_solve_report* report,
                             hm_error* err);

#ifdef __cplusplus
}
#endif
#endif
