/* harmorph for studies: schemes, engines and options with which the results of the paper are
 * reproduced and compared, and diagnostics. The conventions of harmorph.h hold. Most users need
 * none of this. */
#ifndef HARMORPH_STUDY_H
#define HARMORPH_STUDY_H

#include "harmorph.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Schemes and engines ---- */

/* Combinations beside those of harmorph.h (all others: HM_UNSUPPORTED):
 *
 *   operator                  scheme                    engine              conditions
 *   HM_LAPLACE, HM_WEIGHTED   HM_COMPACT                HM_FAS              all but slip
 *   HM_LAPLACE, HM_WEIGHTED   HM_BOUNDED                HM_DIRECT           all but slip
 *   HM_LAPLACE                HM_NODAL_GRADIENT         HM_DIRECT, HM_FAS   no slip, no given
 *   HM_LAPLACE                HM_NODAL_GRADIENT_PLAIN   HM_FAS              no slip, no given
 *
 * Values are real, and complex with rigid bodies. HM_ROTATION_PAIR needs HM_COMPACT and HM_DIRECT.
 */

/* scheme: discretisation of the fluxes; all schemes reproduce linear fields */
enum {
    HM_COMPACT = 0, /* median dual, cell gradients: second order. Recommended */
    /* The compact scheme on the constrained Delaunay triangulation of the mesh points (edges are
     * flipped; points and boundary remain; the weight is taken at the midpoint of an edge): 0 <= F
     * <= 1 if every boundary is fixed or on a curve. Edges on free boundaries and periodic pairs
     * are not flipped: there the bound may fail, and the functions depend, within the
     * discretisation error, on where a periodic mesh is cut. The plan can only be factored on the
     * analysed coordinates. */
    HM_BOUNDED = 2,
    /* The scheme of the paper: Green-Gauss gradients over the cells around each point; the flux
     * through a face uses the mean of the gradients of its two points, with the component along the
     * edge replaced by the difference of the values. Second order, with errors like those of the
     * compact scheme; on squares both are the five-point scheme. On airfoil meshes the functions
     * differ most from those of the compact scheme at edges of the airfoil, and much where few
     * points surround an edge in long thin cells. For comparison. */
    HM_NODAL_GRADIENT = 1,
    /* HM_NODAL_GRADIENT without that replacement, as in the text of the paper; only to reproduce
     * the paper. Odd-even oscillations are not damped: on perturbed squares the errors do not
     * decrease with refinement. The scheme takes hundreds of cycles on isotropic meshes. On viscous
     * meshes it mostly does not converge (HM_NOT_CONVERGED), because eigenvalues may have the wrong
     * sign: values may leave [0, 1], or grow without limit. */
    HM_NODAL_GRADIENT_PLAIN = 3
};
/* hm_options.engine, beside those of harmorph.h. Of the engines that iterate, hm_solve_report tells
 * the largest number of iterations of any function, the number of levels, and the work for that
 * function: products of a level's matrix and a vector, all levels included, in units of a
 * Runge-Kutta step on the finest level, which has four such products. */
enum {
    /* The paper's iteration: pseudo-time stepping with an explicit four-stage Runge-Kutta scheme,
     * local time steps and the full approximation scheme on agglomerated levels (V-cycles), started
     * on the coarsest level (FMG-FAS); with one level: Runge-Kutta alone. The slowest engine; for
     * comparison with the paper. See `cycle` of hm_study_options for an improved iteration. */
    HM_FAS = 2
};
/* agglomeration: which cells HM_FAS merges */
enum {
    /* along the strong couplings where the aspect ratio exceeds 2, otherwise in any direction */
    HM_AGGLOMERATE_AUTO = 0,
    /* cells with the most mesh edges between them, for any aspect ratio: for comparison */
    HM_AGGLOMERATE_ISOTROPIC = 1,
    HM_AGGLOMERATE_DIRECTIONAL = 2 /* always the most strongly coupled cells */
};

/* cycle of HM_FAS */
enum {
    /* V-cycles; the correction of a merged cell is added to the values of its members, as in the
     * paper */
    HM_CYCLE_PAPER = 0,
    /* W-cycles; a step of Jacobi's method smooths each correction, and the length of the correction
     * minimises the energy of the error: a quarter of the cycles and a third of the work in the
     * cases of the paper (`make paper`) */
    HM_CYCLE_IMPROVED = 1
};
/* start of HM_FAS */
enum {
    /* solved on the coarsest level, then on the next finer one, and so on (FMG) */
    HM_START_COARSEST = 0,
    HM_START_ZERO = 1
};

/* hm_options.study. Fields other than `scheme` are for HM_MULTIGRID and HM_FAS only; with another
 * engine a value other than 0 is refused (HM_UNSUPPORTED). */
typedef struct hm_study_options {
    uint64_t struct_size;
    int32_t scheme; /* HM_COMPACT, ... */
    /* Largest number of levels including the finest, 1 .. 20; 0: as many as possible, about 5 for
     * 10 000 points, 9 for a million. HM_FAS does not solve the coarsest level exactly: the more
     * cells that level has, the more cycles are needed. */
    int32_t levels;
    int32_t agglomeration; /* HM_AGGLOMERATE_...: HM_FAS only */
    /* Functions that are solved at a time: 4, 8 or 16; 0 means 8. The vectors of each thread take
     * 21 bytes of the plan per unknown and function of a block (HM_FAS: 64). HM_MULTIGRID solves
     * half as many complex functions at a time, and again half as many where cells are too thin
     * for vectors in single precision. */
    int32_t block_width;
    /* The number of iterations after which the call ends with HM_NOT_CONVERGED (HM_FAS: also when a
     * residual has grown by a factor of 1000); 0 means 200; HM_FAS: 2000 cycles, or with one level
     * 200000 steps. */
    int32_t max_iterations;
    int32_t cycle; /* HM_CYCLE_...: HM_FAS only */
    /* [history_length] receives the largest relative residual of all functions before the first
     * iteration and after each, up to report.iterations. NULL: not wanted. The array must exist as
     * long as the plan. */
    double* history;
    int32_t history_length;
    int32_t start; /* HM_START_...: HM_FAS only */
} hm_study_options;

/* ---- Diagnostics ---- */

/* The phases that hm_progress reports: three of hm_analysis_init, two of hm_plan_factor, two of
 * hm_plan_solve. */
enum {
    HM_PHASE_STRUCTURE = 0,
    HM_PHASE_ORDERING = 1,
    HM_PHASE_SYMBOLIC = 2,
    HM_PHASE_ASSEMBLY = 3,
    HM_PHASE_FACTOR = 4,
    HM_PHASE_SOLVE = 5,
    HM_PHASE_RESIDUAL = 6
};

typedef struct hm_mesh_report {
    uint64_t struct_size;
    int32_t points, used_points, cells, triangles, quads, edges, boundary_edges, boundary_loops;
    int32_t inverted;                 /* inverted cells (see CONVENTIONS) */
    int32_t first_inverted;           /* the first inverted cell; -1: none */
    double min_area;                  /* [length^2] smallest signed corner area */
    double min_quality, mean_quality; /* [0..1] skew quality, see hm_assess */
    /* cells that are divided into triangles, see harmorph_space.h; they are in neither `triangles`
     * nor `quads` */
    int32_t polygons, reserved;
} hm_mesh_report;

HM_API hm_status hm_analysis_report(const hm_analysis* analysis, hm_mesh_report* report,
                                    hm_error* err);
/* The number of points and the index base of the mesh that the plan was made from. */
HM_API hm_status hm_plan_points(const hm_plan* plan, int32_t* n_points, int32_t* index_base,
                                hm_error* err);
/* The agglomeration, after hm_plan_factor with HM_FAS: cells [n_points] receives the merged cell,
 * from 0, that contains the control volume of each point on a level (0: the finest); -1 for points
 * with known values. *n_cells: the number of merged cells. Refused if the level does not exist, and
 * for other engines, which merge no cells. */
HM_API hm_status hm_plan_level(const hm_plan* plan, int32_t level, int32_t* cells, int32_t* n_cells,
                               hm_error* err);

/* The conditions that the basis was solved with: out [capacity], with out[0].struct_size set; *n:
 * number of conditions, also if the capacity is too small (HM_BAD_ARGUMENT). Curves, conditions and
 * parameters together restore the problem; hm_basis_along restores `along`, which is NULL here. On
 * a mesh that has moved since hm_basis_init, add what hm_recover_movement finds to the control
 * points, and the translations of the bodies to their centres of rotation. */
HM_API hm_status hm_basis_conditions(const hm_basis* basis, hm_condition* out, int32_t capacity,
                                     int32_t* n, hm_error* err);
/* The curves along which the points of a condition with slip move: those that its `along` had
 * (index_base 0). condition is counted from 0. curve [capacity >= n_curves of the condition]
 * receives the curves, to which out->curve points; all other arrays are inside the basis.
 * Conditions that had the same `along` get the same arrays: give them one hm_curves again, so that
 * points can slip from one marker to the next. Refused (HM_BAD_ARGUMENT): a condition without such
 * curves, a capacity that is too small. */
HM_API hm_status hm_basis_along(const hm_basis* basis, int32_t condition, hm_curves* out,
                                hm_curve* curve, int32_t capacity, hm_error* err);
/* Copies one of the numbers_per_value numbers of one function at all points to values [n_points];
 * function and number are counted from 0. */
HM_API hm_status hm_basis_values(const hm_basis* basis, int32_t function, int32_t number,
                                 double* values, hm_error* err);

#ifdef __cplusplus
}
#endif
#endif
