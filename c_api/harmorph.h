/* harmorph: morphs an airfoil and its CFD mesh together. MIT licence.
 *
 * The airfoil is a B-spline. Its basis functions N_i are boundary data of Laplace's equation on the mesh; the solutions
 * F_i, computed once, carry any movement dP_i of the control points to every mesh point: X += sum_i F_i dP_i. (Method:
 * Nikolos, Lygidakis, Leloudas, Tavla, "Application of B-spline basis functions as harmonic functions for the concurrent
 * shape and mesh morphing of airfoils".)
 *
 * CONVENTIONS, which hold for every function below
 *
 * Order of calls   hm_analysis_size > hm_analysis_init   mesh, curves and conditions checked; ordering; symbolic pass
 *                  hm_plan_size > hm_plan_init           the matrix and its factor, in a block of the caller
 *                  hm_basis_size > hm_basis_init         the functions F_i, in another block of the caller
 *                  hm_plan_factor > hm_plan_solve        numbers; then the analysis and the plan may be given back
 *                  hm_morph, hm_adjoint, ...             as often as wished; they need nothing but basis and mesh
 * Memory           The library allocates nothing. A *_size function tells how many bytes, exactly; any alignment is fine.
 *                  The object lives inside the block: there is nothing to free, and the block must not move while the
 *                  object is used (a basis may be copied or written to a file, see hm_basis_attach).
 * Ownership        Arrays given in structs stay the caller's; they are never changed. A mesh's arrays must outlive the
 *                  analysis and the plan made of them, the curves' arrays the analysis. The basis keeps copies of all it
 *                  needs.
 * Numbers          Coordinates in any one length unit. Angles do not occur. All lengths of arrays stand in [brackets].
 * Numbering        Points and cells count from mesh.index_base (also in reports, unless said otherwise), control points
 *                  from curves.index_base. Curves, conditions and functions count from 0; function i belongs to control
 *                  point i + curves.index_base. In texts of errors "(from 0)" follows each number that counts from 0.
 * Orientation      Free: cells may run clockwise, counter-clockwise or mixed. Neighbours traverse a shared edge in
 *                  opposite directions; that settles which cells agree, and the sign of the larger total area wins.
 *                  Cells against it are the inverted ones.
 * NULL             Allowed only where it is said so. hm_error may always be NULL.
 * Status           0: done. Above 0: done and usable, with a warning. Below 0: refused; outputs and blocks' contents as
 *                  before the call, except that a block given for a new object may have been written.
 * Structs          Set struct_size = sizeof the struct and the rest to 0 first: `hm_options options = {sizeof options};`
 *                  A field that is 0 has its default. Fields are only ever added at the end; reports are filled as far
 *                  as the caller's struct_size goes, options that this library does not know are HM_UNSUPPORTED.
 * Threads          No hidden state. One thread at a time may write an object (plan, basis) or make others of it
 *                  (analysis); reading (morph, adjoint, quality) is free for any number. Two plans in two threads share
 *                  nothing. The library starts no threads; it uses those of an hm_executor where one is given.
 * Repeatability    Same input and same kernel, same bits: from run to run, for any number of threads, and of
 *                  processes (harmorph_mpi.h).
 */
#ifndef HARMORPH_H
#define HARMORPH_H

#include <stddef.h>
#include <stdint.h>

#define HM_VERSION "0.1.0"
#define HM_ABI 2 /* what hm_abi_version() returns when header and library fit */

#ifdef __cplusplus
extern "C" {
#endif
#if defined(__GNUC__)
#define HM_API __attribute__((visibility("default")))
#else
#define HM_API
#endif

/* ---- Status and error ------------------------------------------------------------------------------------------- */

typedef int32_t hm_status;
enum {
    HM_OK = 0,
    HM_NOT_CONVERGED = 1,     /* solved, but a residual is above options.tolerance, or an iteration or refinement ended
                                 before its values were about as near; error.value: by how much they may be off */
    HM_MOVED = 2,             /* attached, but the mesh's coordinates are not those the basis was solved on */
    HM_SHORT = 3,             /* hm_morph_safe: the mesh is valid, but not all of the movement was possible */
    HM_CANCELLED = -1,        /* the progress callback asked to stop; call again to go on from the last finished call */
    HM_BAD_ARGUMENT = -2,     /* NULL, a size or number out of range, a struct_size too small */
    HM_BAD_MESH = -3,         /* index, repeated point, non-manifold edge, inverted cell, boundary, coordinate */
    HM_BAD_CURVE = -4,        /* degree, knots, indices, weights, control points, or a fit that is not determined */
    HM_BAD_CONDITION = -5,    /* marker that no face has, curve that does not exist, field of another kind, nothing to solve */
    HM_BAD_BASIS = -6,        /* the block is not a basis, truncated (error.value: missing bytes, at least), damaged,
                                 foreign, or not solved yet */
    HM_BLOCK_TOO_SMALL = -7,  /* error.value: missing bytes */
    HM_NOT_POSITIVE = -8,     /* the matrix is not positive definite; error.item: the mesh point where it was seen */
    HM_UNSUPPORTED = -9,      /* options that do not go together */
    HM_CROSSING = -10         /* the moved boundary crosses itself; error.item: a point of a face that is crossed */
};

typedef struct hm_error {     /* 128 bytes for ever */
    hm_status code;
    int32_t   item;           /* first offending point, cell, ... in the caller's numbering; -1: none */
    double    value;          /* what was found: area [length^2], residual [-], missing [bytes]; 0 if nothing */
    char      text[112];      /* one sentence, NUL-terminated */
} hm_error;

HM_API int32_t     hm_abi_version(void);
HM_API const char *hm_version(void);                      /* "major.minor.patch" of the library */
HM_API const char *hm_status_name(hm_status status);      /* "HM_OK", ...; "unknown status" otherwise */

/* ---- Threads of the caller ---------------------------------------------------------------------------------------- */

/* Calls task(context, i) once for each i in 0 .. n_tasks-1, in any order, on any threads, and returns when all are done.
 * A task never waits for another one. Ready-made: harmorph_openmp.h, harmorph_pthreads.h. */
typedef void (*hm_run)(void *user, int32_t n_tasks, void (*task)(void *context, int32_t index), void *context);

typedef struct hm_executor {
    uint64_t struct_size;
    hm_run   run;                  /* NULL: everything on the calling thread */
    void    *user;                 /* handed to run */
    int32_t  n_threads;            /* how many tasks run at once, about; 1 .. 256; 0 means 1. A plan's space grows with it */
    int32_t  reserved;             /* 0 */
} hm_executor;

/* ---- Points: two numbers for each point of a mesh, in the caller's arrays --------------------------------------------- */

/* Coordinates, displacements, velocities or derivatives by the coordinates. The numbers of point k, k from 0, are
 * x[k*stride] and y[k*stride]: x(:), y(:) are {x, y, 1}; pairs xy(2,n) are {xy, xy+1, 2}; xy(n,2) is {xy, xy+n, 1};
 * an array of structs is {&s[0].x, &s[0].y, sizeof s[0] / sizeof(double)}. The arrays end with the last point. */
typedef struct hm_points {         /* read; 24 bytes for ever */
    const double *x, *y;
    int64_t stride;                /* [doubles] from point to point; 1 or more; 0 means 1 */
} hm_points;

typedef struct hm_points_out {     /* written, otherwise the same */
    double *x, *y;
    int64_t stride;
} hm_points_out;

/* ---- Mesh: a view of the caller's arrays ------------------------------------------------------------------------ */

enum {                        /* hm_mesh.cell_layout */
    HM_CELLS_ROWS = 0,        /* cell_start, cell_points: compressed rows of 3 or 4 points */
    HM_CELLS_TRIANGLES = 1,   /* cell_points [3*n_cells] */
    HM_CELLS_QUADS = 2,       /* cell_points [4*n_cells]; a triangle repeats its last point */
    HM_CELLS_STRUCTURED = 3   /* no list: point (i,j) is i + ni*j, cell (i,j) is i + (ni-1)*j, i and j from 0 */
};

typedef struct hm_mesh {
    uint64_t struct_size;
    int32_t  index_base;           /* 0 or 1: what points and cells are counted from, in all arrays and reports */
    int32_t  n_points;             /* 3 .. 2^30; points that no cell uses are allowed and never move */
    hm_points points;              /* [n_points] coordinates */
    int32_t  cell_layout;          /* HM_CELLS_... */
    int32_t  n_cells;              /* 1 .. 2^29; structured: 0 or (ni-1)*(nj-1) */
    const int32_t *cell_start;     /* [n_cells+1] rows only: where a cell's points begin, counted from index_base */
    const int32_t *cell_points;    /* each cell's points in order round it */
    int32_t  ni, nj;               /* structured only: points along i (fastest) and j; ni*nj = n_points */
    int32_t  n_faces;              /* boundary as faces (0 if given as lists, or both) */
    const int32_t *face_points;    /* [2*n_faces] */
    const int32_t *face_markers;   /* [n_faces] any integers */
    int32_t  n_lists;              /* boundary as ordered lists of points; a closed one repeats its first point */
    const int32_t *list_start;     /* [n_lists+1] counted from index_base */
    const int32_t *list_points;
    const int32_t *list_markers;   /* [n_lists] */
} hm_mesh;
/* Every boundary edge must be on a marker. The exception is a cut, as O- and C-meshes have along their seam and wake:
 * points of boundary edges on no marker that have equal coordinates are one point to the library and move as one. Faces of
 * one marker may belong to several bodies, and one body may carry several markers. */

/* ---- Curves ----------------------------------------------------------------------------------------------------- */

typedef struct hm_curve {          /* C(u) = sum_k N_k(u) P[indices[k]], u in [knots[degree], knots[n_indices]] */
    uint64_t struct_size;          /* the same in all curves of one hm_curves */
    int32_t  degree;               /* 1..5 */
    int32_t  n_indices;            /* control points counted with their repeats; > degree */
    const int32_t *indices;        /* [n_indices] NULL: the points in order. Repeats close a curve: the first `degree`
                                      points again at the end with periodic knots, or the first again with clamped knots */
    const double  *knots;          /* [n_indices + degree + 1] not decreasing, no inner knot more than degree-fold */
} hm_curve;

typedef struct hm_curves {         /* curves over common control points; a point in two curves belongs to both */
    uint64_t struct_size;
    int32_t  index_base;           /* 0 or 1 */
    int32_t  n_control;            /* control points >= 2 = number of functions */
    const double *control;         /* [2*n_control] x,y pairs, finite */
    const double *weights;         /* [n_control] > 0, or NULL: not rational */
    int32_t  n_curves;             /* >= 1 */
    const hm_curve *curve;         /* [n_curves] */
} hm_curves;

/* Are the curves well formed? */
HM_API hm_status hm_curves_check(const hm_curves *curves, hm_error *err);
/* The degree+1 B-spline basis functions (rational ones where there are weights) that are not 0 at u.
 * control [degree+1]: their control points; values [(n_derivatives+1)*(degree+1)]: row d is the d-th derivative by u.
 * 0 <= n_derivatives <= 5. (Piegl & Tiller, The NURBS Book, A2.3 and eq. 4.8.) */
HM_API hm_status hm_curve_basis(const hm_curves *curves, int32_t curve, double u, int32_t n_derivatives,
                                int32_t *control, double *values, hm_error *err);
/* C(u) and its derivatives: xy [2*(n_derivatives+1)], x,y pairs. */
HM_API hm_status hm_curve_point(const hm_curves *curves, int32_t curve, double u, int32_t n_derivatives,
                                double *xy, hm_error *err);
/* The parameter of the point of the curve nearest to (x, y), and the distance [length]; a global search, then Newton. */
HM_API hm_status hm_curve_project(const hm_curves *curves, int32_t curve, double x, double y,
                                  double *u, double *distance, hm_error *err);

/* ---- Fit: a B-spline through the ordered points of a boundary ----------------------------------------------------- */

enum {                             /* hm_fit_options.closed */
    HM_CLOSED_AUTO = 0,            /* of a loop: no corner: periodic; one: tied there; a blunt base: open, and a straight
                                      curve of degree 1 over the base that shares both end points. Otherwise open */
    HM_OPEN = 1,                   /* clamped at the first and the last point */
    HM_TIED = 2,                   /* clamped, both ends one control point: a sharp trailing edge */
    HM_PERIODIC = 3                /* smooth all round */
};

typedef struct hm_fit_options {
    uint64_t struct_size;
    int32_t  degree;               /* 1..5; 0 means 3 */
    int32_t  n_control;            /* distinct control points > degree; at most the number of points; 0 means 20 */
    int32_t  closed;               /* HM_CLOSED_AUTO, ... */
} hm_fit_options;

typedef struct hm_fit_report {
    uint64_t struct_size;
    double   max_error, rms_error; /* [length] distances of the points from the curves */
    int32_t  max_error_point;      /* which of the n points, from 0 */
    int32_t  closed;               /* HM_OPEN, HM_TIED or HM_PERIODIC: what was made */
    int32_t  first_point;          /* where the curve begins (the corner of a loop), from 0 */
    int32_t  base_points;          /* points on a blunt base, both ends counted; 0: none */
} hm_fit_report;

HM_API hm_status hm_fit_size(int32_t n, const hm_fit_options *options, size_t *bytes, hm_error *err);
/* Least squares through n points in order; is_loop: the last is joined to the first (which is not repeated). Knots are
 * placed by arc length and curvature. *curves lives in the block, as do its arrays (index_base 0). options may be NULL. */
HM_API hm_status hm_fit(const hm_curves **curves, void *block, size_t bytes, const hm_points *points, int32_t n,
                        int32_t is_loop, const hm_fit_options *options, hm_fit_report *report, hm_error *err);

/* ---- Problem: what is to be solved ------------------------------------------------------------------------------ */

enum {                             /* hm_condition.kind; a point on several markers: the smallest wins */
    HM_ON_CURVE = 0,               /* F_i = N_i(u) */
    HM_RIGID = 1,                  /* a body that only translates, turns and scales, see hm_morph */
    HM_FIXED = 2,                  /* F_i = 0; also every marker without a condition */
    HM_SLIP = 3,                   /* points stay on a straight line and slide. A marker may have several lines; where two
                                      meet at an angle the point is fixed */
    HM_FREE = 4,                   /* zero normal derivative: points are free to move off the line they are on */
    HM_PERIODIC_PAIR = 5           /* this marker and its partner are translates of each other: both move alike, bit by bit */
};

typedef struct hm_condition {
    uint64_t struct_size;          /* the same in all conditions of one problem */
    int32_t  marker;
    int32_t  kind;                 /* HM_ON_CURVE, ... */
    int32_t  first_curve, n_curves;/* on curve: the points lie on one of curves first .. first+n-1 */
    int32_t  body;                 /* rigid: which body, from 0 without gaps; markers may share one */
    int32_t  partner;              /* periodic: the other marker of the pair, which has no condition of its own */
    double   x, y;                 /* rigid: the point the body turns about [length] */
} hm_condition;
/* Fields of other kinds than the condition's must be 0: HM_BAD_CONDITION, error.item: which condition, from 0. */

typedef struct hm_problem {
    uint64_t struct_size;
    const hm_mesh      *mesh;
    const hm_curves    *curves;    /* NULL, and no rigid body: the analysis stops after the mesh (hm_analysis_report,
                                      hm_analysis_boundary) */
    int32_t             n_conditions;
    const hm_condition *conditions;/* [n_conditions] at least one on a curve or rigid */
    int32_t             n_given;   /* curve points whose parameter is given; the others' are found by projection */
    const int32_t      *given_points;  /* [n_given] */
    const int32_t      *given_curves;  /* [n_given] */
    const double       *given_u;       /* [n_given] */
} hm_problem;

/* What goes together (everything else is HM_UNSUPPORTED). A function's value at a point is a linear map of the plane: 1, 2
 * or 4 numbers (hm_basis_info.numbers_per_value). "complex": also where the table says real, if there are rigid bodies.
 *   operator      scheme                   engine         conditions      values
 *   HM_CONFORMAL  HM_COMPACT               HM_DIRECT      all but free    complex; with slip 2 x 2 matrices
 *   HM_LAPLACE    HM_COMPACT               HM_DIRECT      all             real; with slip 2 x 2 matrices
 *   HM_WEIGHTED   HM_COMPACT               HM_DIRECT      all             real; with slip 2 x 2 matrices
 *   HM_LAPLACE    HM_BOUNDED               HM_DIRECT      all but slip    real
 *   HM_WEIGHTED   HM_BOUNDED               HM_DIRECT      all but slip    real
 *   HM_LAPLACE    HM_COMPACT               HM_MULTIGRID   all but slip    real
 *   HM_WEIGHTED   HM_COMPACT               HM_MULTIGRID   all but slip    real
 *   HM_LAPLACE    HM_COMPACT               HM_FAS         all but slip    real
 *   HM_WEIGHTED   HM_COMPACT               HM_FAS         all but slip    real
 *   HM_LAPLACE    HM_NODAL_GRADIENT        HM_DIRECT      all but slip    real
 *   HM_LAPLACE    HM_NODAL_GRADIENT        HM_FAS         all but slip    real
 *   HM_LAPLACE    HM_NODAL_GRADIENT_PLAIN  HM_FAS         all but slip    real
 *
 * The weight of an operator is k = 1 / d^q, d the distance of a cell's barycentre to the nearest face on a curve or a rigid
 * body, or to its image by a periodic pair, in parts of their extent: cells near what moves keep their shape, those far
 * away give way. */
enum {                             /* operator_kind */
    HM_CONFORMAL = 0,              /* least departure from angle-preserving maps: minimises the integral of k |f_x + i f_y|^2
                                      over complex functions f. Angles at the wall stay, heights of the first layer scale with
                                      the wall's stretch. Deformations may be about 20 times those of HM_LAPLACE. It needs
                                      every boundary held: beside a free one it is badly posed */
    HM_LAPLACE = 1,                /* the paper's harmonic functions: the integral of |grad F|^2 */
    HM_WEIGHTED = 2                /* the integral of k |grad F|^2 */
};
enum { HM_NO_WEIGHT = -1 };        /* exponent_quarters: k = 1. The conformal functions are then those of HM_LAPLACE */
enum {                             /* scheme: how fluxes are formed; all reproduce linear fields */
    HM_COMPACT = 0,                /* median dual, cell gradients: second order; the choice unless another is wanted */
    HM_BOUNDED = 2,                /* compact on the constrained Delaunay triangulation of the mesh's points (edges are
                                      flipped, points and boundary stay; the weight is that of an edge's midpoint):
                                      0 <= F <= 1 where every boundary is fixed or on a curve, not always beside free ones or
                                      periodic pairs: their edges are not flipped either, so that functions depend, within the
                                      scheme's error, on where a periodic mesh is cut.
                                      Its plan factors on the analysed coordinates alone */
    HM_NODAL_GRADIENT = 1,         /* the paper's: Green-Gauss gradients over the cells round each point; a face's flux is that
                                      of the mean of its two points' gradients, whose component along the edge is replaced
                                      by the difference of their values. Second order, for comparison: errors on 128 x 128
                                      squares 3.0e-5 (compact 1.1e-5), on perturbed triangles 3.8e-5 (4.5e-5); functions on
                                      airfoil meshes, viscous ones too, differ from compact by 1e-3 to 7e-3 next to an edge,
                                      1e-4 in the mean. By 0.2 where few points go round an edge in cells of 1e4 to 1 */
    HM_NODAL_GRADIENT_PLAIN = 3    /* the same without that replacement, as the paper's text has it: to repeat it only. Blind
                                      to odd-even oscillations: errors 2.3e-4 on those squares, and 2e-2 on perturbed ones,
                                      where they do not fall with refinement. 500 to 2000 cycles on isotropic meshes; on
                                      viscous ones it mostly does not converge (HM_NOT_CONVERGED), as eigenvalues may have
                                      the wrong sign: values left [0, 1] by 0.3 on one, grew without end on another */
};
enum {                             /* engine */
    HM_DIRECT = 0,                 /* nested dissection and multifrontal Cholesky; the fastest. HM_NODAL_GRADIENT: the compact
                                      scheme's factor preconditions biconjugate gradients, 3 to 13 steps on airfoil meshes */
    HM_MULTIGRID = 1,              /* conjugate gradients, preconditioned by agglomeration multigrid. 15 to 35 iterations,
                                      whatever the size and however stretched the cells. Plan and analysis take 730 bytes
                                      a point, 500 with block_width 4; HM_DIRECT 840 for 10 000 points, 1090 for a million */
    HM_FAS = 2                     /* the paper's iteration: pseudo-time, explicit four-stage Runge-Kutta with local steps, full
                                      approximation scheme on agglomerated levels, started from the coarsest (FMG-FAS); one
                                      level: Runge-Kutta alone. The slowest: for comparison with the paper */
};
enum {                             /* agglomeration: which cells are merged */
    HM_AGGLOMERATE_AUTO = 0,       /* along the strong couplings where cells are stretched more than 2 to 1, else any */
    HM_AGGLOMERATE_ISOTROPIC = 1,  /* those with most mesh edges between them, however stretched: for comparison. On viscous
                                      meshes HM_MULTIGRID may not converge: after 200 iterations a residual of 3e-5 on one
                                      of two meshes, where the automatic rule needs 29; 28 against 22 on the other */
    HM_AGGLOMERATE_DIRECTIONAL = 2 /* always the most strongly coupled ones */
};

enum {                             /* start: of HM_FAS */
    HM_START_COARSEST = 0,         /* the problem solved on the coarsest level, then on the next finer one, and so on (FMG) */
    HM_START_ZERO = 1
};

enum {                             /* kernel: all agree to rounding; one that the processor lacks is HM_UNSUPPORTED */
    HM_KERNEL_AUTO = 0, HM_KERNEL_BASELINE = 1, HM_KERNEL_AVX2 = 2, HM_KERNEL_AVX512 = 3
};
enum {                             /* precision; HM_SINGLE goes with whatever goes with HM_DIRECT, and nothing else */
    HM_DOUBLE = 0,
    HM_SINGLE = 1                  /* the factor takes half the memory, the plan .6 of it; the functions are as accurate:
                                      they are refined until they are off by 1e-10 of the largest at most, as far as the
                                      last steps tell: 2 of them, a solve each, or 3 where first cells are 1e-5 high or thin
                                      ones far from the wall. Where cells are too thin for it there is HM_NOT_CONVERGED and
                                      error.value about the error, or HM_NOT_POSITIVE (hm_plan_factor) */
};
enum {                             /* phases, in the order in which they are reported */
    HM_PHASE_STRUCTURE = 0, HM_PHASE_ORDERING = 1, HM_PHASE_SYMBOLIC = 2,   /* hm_analysis_init */
    HM_PHASE_ASSEMBLY = 3, HM_PHASE_FACTOR = 4,                             /* hm_plan_factor */
    HM_PHASE_SOLVE = 5, HM_PHASE_RESIDUAL = 6                               /* hm_plan_solve */
};
/* Called at the start of each phase (fraction 0), sometimes in between, at its end (1). Not 0: stop, HM_CANCELLED. */
typedef int32_t (*hm_progress)(void *user, int32_t phase, double fraction);

typedef struct hm_options {
    uint64_t struct_size;
    int32_t  operator_kind;        /* default HM_CONFORMAL */
    int32_t  scheme;               /* default HM_COMPACT */
    int32_t  engine;               /* default HM_DIRECT */
    int32_t  kernel;               /* HM_KERNEL_...: which vector instructions; pin one for equal bits on unequal machines */
    double   tolerance;            /* [-] relative residual above which hm_plan_solve warns; 0 means 1e-10. HM_DIRECT does not
                                      where flows through thin cells make it: where each row's residual is rounding of its own
                                      flows, and refinement finds values off by no more than this beside the largest. (Not for
                                      HM_NODAL_GRADIENT.) Engines that iterate go on until the residual is below it, and this
                                      share of the largest value is also about what values are still off: behind thin cells
                                      small residuals hide large errors, and behind very thin ones they warn of right values */
    hm_progress progress;          /* NULL: none; always called on the thread of the call */
    void    *progress_user;
    const hm_executor *executor;   /* NULL: one thread; copied, but what executor.user points to must outlive the plan */
    int32_t  exponent_quarters;    /* 4 q of the weight, 1 .. 16, or HM_NO_WEIGHT; 0 means 6 (conformal), 4 (weighted) */
    int32_t  offset_correction;    /* 0 or 1; conformal only; 1: boundary functions N_i + e N_i' / C', e how far the mesh
                                      point is off its curve, so that the offset turns with the curve: rigid motions of all
                                      control points then move every wall point rigidly; other motions add e dC' / C'. Left
                                      out at corners and where |e| sum_i |N_i'| >= |C'|, as where C' vanishes */
    /* HM_MULTIGRID and HM_FAS only; where the engine is another one, what is not 0 is HM_UNSUPPORTED: */
    int32_t  levels;               /* of agglomeration, the finest counted, at most; 1 .. 20; 0: all there are, about 5 for
                                      10 000 points, 9 for a million. HM_FAS does not solve the coarsest one: the more cells it
                                      has, the more cycles */
    int32_t  agglomeration;        /* HM_AGGLOMERATE_... */
    int32_t  block_width;          /* functions solved at a time: 4, 8 or 16; 0 means 8. Plan space for each thread's vectors
                                      grows with it: 56 bytes per unknown and function */
    int32_t  max_iterations;       /* HM_NOT_CONVERGED at the latest after these (HM_FAS: also once a residual has grown a
                                      thousandfold); 0 means 200; HM_FAS: 2000 cycles, or with
                                      one level 200000 steps */
    double  *history;              /* [history_length] largest relative residual of all functions before the first iteration
                                      and after each, up to report.iterations; must outlive the plan. NULL: not wanted */
    int32_t  history_length;
    int32_t  precision;            /* HM_DOUBLE (default), HM_SINGLE: of the direct engine's factor, HM_DIRECT only */
    int32_t  start;                /* HM_START_...: HM_FAS only */
    int32_t  reserved;             /* 0 */
} hm_options;

/* ---- Analysis: everything that does not depend on the size of numbers --------------------------------------------- */

typedef struct hm_analysis hm_analysis;

typedef struct hm_mesh_report {
    uint64_t struct_size;
    int32_t  points, used_points, cells, triangles, quads, edges, boundary_edges, boundary_loops;
    int32_t  inverted;             /* cells with a corner of area <= 0 */
    int32_t  first_inverted;       /* cell; -1: none */
    double   min_area;             /* [length^2] smallest signed corner area (half the cross product of its two edges) */
    double   min_quality, mean_quality; /* skew quality, see hm_quality */
} hm_mesh_report;

/* Bytes from the counts alone (points, cells, faces, control points). options NULL: defaults. */
HM_API hm_status hm_analysis_size(const hm_problem *problem, const hm_options *options, size_t *bytes, hm_error *err);
/* Checks everything, numbers the unknowns, finds the parameters of the curve points; the ordering and the symbolic pass use
 * the threads of options.executor. The mesh must have no inverted cell, unless problem.curves is NULL. */
HM_API hm_status hm_analysis_init(hm_analysis **analysis, void *block, size_t bytes, const hm_problem *problem,
                                  const hm_options *options, hm_error *err);
HM_API hm_status hm_analysis_report(const hm_analysis *analysis, hm_mesh_report *report, hm_error *err);
/* The points of the given markers in order along the boundary, the mesh on the left (round a body: clockwise).
 * A marker set with several pieces: `piece` (from 0) selects one. points [capacity]; *n: how many there are, also when
 * capacity is too small (HM_BAD_ARGUMENT); *is_loop: closed, the first point is not repeated. */
HM_API hm_status hm_analysis_boundary(const hm_analysis *analysis, int32_t n_markers, const int32_t *markers,
                                      int32_t piece, int32_t *points, int32_t capacity, int32_t *n, int32_t *is_loop,
                                      hm_error *err);

/* ---- Plan and basis ---------------------------------------------------------------------------------------------- */

typedef struct hm_plan hm_plan;
typedef struct hm_basis hm_basis;

/* The analysis must have curves. Plan and basis copy what they need of it. */
HM_API hm_status hm_plan_size(const hm_analysis *analysis, size_t *bytes, hm_error *err);
HM_API hm_status hm_plan_init(hm_plan **plan, void *block, size_t bytes, const hm_analysis *analysis, hm_error *err);
HM_API hm_status hm_basis_size(const hm_analysis *analysis, size_t *bytes, hm_error *err);
HM_API hm_status hm_basis_init(hm_basis **basis, void *block, size_t bytes, const hm_analysis *analysis, hm_error *err);

/* Assembles and factors on the coordinates `at` of the mesh's points (NULL: the mesh's own): ordering and symbolic pass
 * serve again. A failed or cancelled call leaves the plan without a factor. */
HM_API hm_status hm_plan_factor(hm_plan *plan, const hm_points *at, hm_error *err);

typedef struct hm_solve_report {
    uint64_t struct_size;
    int32_t  unknowns, functions;
    double   residual;             /* [-] largest over the functions of |b - A F| / |b|, 2-norms; see options.tolerance */
    int32_t  residual_function;    /* where */
    int32_t  boundary_error_point; /* where */
    double   boundary_error;       /* [-] largest |F_i - N_i(u)| on the curves, N_i evaluated anew */
    double   partition_defect;     /* [-] largest |sum_i F_i - 1| on the curves */
    double   min_value, max_value; /* [-] of all F_i */
    double   max_distance;         /* [length] of a curve point from its curve: the mesh's offset from the fit, kept */
    int32_t  max_distance_point;
    int32_t  curve_points;         /* mesh points on curves */
    int32_t  refinements;          /* steps of iterative refinement that the residual, or a factor of thin cells, called for */
    int32_t  reserved;             /* 0 */
    int64_t  factor_entries;       /* numbers in the factor; 0: there is none */
    int32_t  iterations;           /* engines that iterate: largest over the functions; HM_DIRECT: 0, or the steps of
                                      biconjugate gradients for HM_NODAL_GRADIENT */
    int32_t  levels;               /* of agglomeration */
    int32_t  fine_sweeps;          /* over the finest level, largest over the functions: symmetric Gauss-Seidel, or
                                      Runge-Kutta steps */
    int32_t  reserved_too;         /* 0 */
} hm_solve_report;

/* Solves all functions in the basis, with the plan's factor. Both must come from one analysis. report may be NULL.
 * Cancelled: the basis counts as not solved, the factor stays. */
HM_API hm_status hm_plan_solve(hm_plan *plan, hm_basis *basis, hm_solve_report *report, hm_error *err);

/* Where agglomeration merged the mesh, after hm_plan_factor with an engine that has levels: cells [n_points] receives the
 * merged cell, from 0, in which each point's control volume is on a level (0: the finest), -1 for points whose value is
 * known; *n_cells how many there are. Refused where there is no such level. */
HM_API hm_status hm_plan_level(const hm_plan *plan, int32_t level, int32_t *cells, int32_t *n_cells, hm_error *err);

/* A basis is one block without pointers: write it to a file as it is (hm_basis_info.bytes), read or map it back, attach.
 * block aligned to 8 bytes. Refused with the reason: not a basis, another format version or byte order, truncated,
 * damaged (checksum), another mesh's. mesh NULL: not compared. HM_MOVED: the same mesh with other coordinates. */
HM_API hm_status hm_basis_attach(const hm_basis **basis, const void *block, size_t bytes, const hm_mesh *mesh,
                                 hm_error *err);

typedef struct hm_basis_info {
    uint64_t struct_size;
    uint64_t bytes;                /* of the block from the basis's address on */
    int32_t  solved;               /* 0 or 1 */
    int32_t  points, cells, functions, curves, curve_points; /* curve_points: and those of rigid bodies */
    int32_t  numbers_per_value;    /* 1: real f; 2: complex a + i b; 4: matrix xx, xy, yx, yy */
    int32_t  operator_kind, scheme, engine;
    int32_t  index_base;           /* of the mesh it was solved on: what points and cells in reports count from */
    const int32_t *curve_point;    /* [curve_points] mesh points on curves, counted from 0 */
    const int32_t *point_curve;    /* [curve_points] the curve each is on; curves + b: on rigid body b */
    const double  *point_u;        /* [curve_points] its parameter */
    int32_t  exponent_quarters;    /* 0: no weight */
    int32_t  bodies;               /* rigid ones; functions = control points + 2 * bodies */
    int32_t  offset_correction;    /* 0 or 1 */
    int32_t  storage;              /* HM_DOUBLE, or HM_SINGLE: see hm_single_init */
} hm_basis_info;
HM_API hm_status hm_basis_info_get(const hm_basis *basis, hm_basis_info *info, hm_error *err);
/* The curves the basis was solved with (index_base 0); curve [capacity >= info.curves] receives them, out->curve is it.
 * Their arrays are the basis's own. */
HM_API hm_status hm_basis_curves(const hm_basis *basis, hm_curves *out, hm_curve *curve, int32_t capacity, hm_error *err);
/* The conditions the basis was solved with: out [capacity], out[0].struct_size set; *n: how many there are, also when
 * capacity is too small (HM_BAD_ARGUMENT). With curves and parameters they make the problem again. */
HM_API hm_status hm_basis_conditions(const hm_basis *basis, hm_condition *out, int32_t capacity, int32_t *n, hm_error *err);
/* values [n_points]: one of the numbers_per_value numbers of a function, both from 0. */
HM_API hm_status hm_basis_values(const hm_basis *basis, int32_t function, int32_t number, double *values, hm_error *err);

/* ---- Functions in single precision ---------------------------------------------------------------------------------- */

/* A second basis with the same functions in single precision: half the memory, and hm_morph and hm_adjoint, which do little
 * but read it, are faster for that where F fits in no cache: hm_morph 1.6 to 2 times, hm_adjoint, which computes more, 1.4
 * to 1.9 times, both with AVX-512; with AVX2 1.2 times or more; without either hardly.
 * Made of a solved basis with all functions, or of its extract; the first one may then be given back.
 * Points on curves and rigid bodies, and those a cut joins to them, keep F in double precision: the wall moves as it does
 * with the first basis, bit by bit. Fixed points do not move. Everywhere else |F' - F| <= 2^-24 |F| for each number (below
 * 2^-126: 2^-150), so that a movement differs by at most 2^-24 sum_i |F_i| |dP_i|, but for rounding of the sum; the
 * functions' sum is 1, and points slip along a slanted line, to that. Products and sums are in double precision, and
 * hm_adjoint is the transpose of hm_morph, as exactly as ever; the same bits for any threads, kernel and partition.
 * It is written, attached, extracted from and used like any basis. Calls that need F in double precision refuse it as
 * HM_UNSUPPORTED: hm_plan_solve, hm_transfer, hm_morph_safe, parcels, hm_single_size. */
HM_API hm_status hm_single_size(const hm_basis *basis, size_t *bytes, hm_error *err);
HM_API hm_status hm_single_init(hm_basis **single, void *block, size_t bytes, const hm_basis *basis, hm_error *err);

/* ---- Coarse to fine: functions solved on one mesh, interpolated to the points of a denser one of the same domain ----- */

typedef struct hm_transfer_report {
    uint64_t struct_size;
    int32_t  points;               /* interpolated: neither on a curve nor fixed */
    int32_t  outside;              /* of them and of the curve points: outside the coarse mesh */
    double   max_distance;         /* [length] of those from the coarse mesh */
    int32_t  max_distance_point;   /* where; -1: none is outside */
    int32_t  boundary_error_point; /* where */
    double   boundary_error;       /* [-] largest |F_i - N_i(u)| on the curves, N_i evaluated anew */
    double   wall_correction;      /* [-] the same before N_i was restored: how well the coarse mesh resolves the functions */
} hm_transfer_report;

/* The fine analysis has the curves, conditions and options of the coarse basis. Bytes of working space. */
HM_API hm_status hm_transfer_size(const hm_analysis *analysis, const hm_mesh *coarse_mesh, size_t *bytes, hm_error *err);
/* Fills and seals a basis made of the analysis, without a plan. Points get the values of the coarse cell they are in, those
 * beyond a curved boundary the nearest cell's, extrapolated linearly; farther than half that cell's longest side is
 * refused (HM_BAD_MESH, error.item: the point, error.value: its distance). Curve points get N_i(u) itself, and points nearer
 * to them than a coarse cell move along; fixed points get 0, slipping ones stay on their lines. Second order in the coarse
 * spacing, and exact for functions that are linear. Uses the threads of the analysis. A refused call leaves the basis
 * unsolved. report may be NULL. */
HM_API hm_status hm_transfer(hm_basis *basis, void *block, size_t bytes, const hm_analysis *analysis,
                             const hm_basis *coarse, const hm_mesh *coarse_mesh, hm_transfer_report *report,
                             hm_error *err);

/* ---- Morph ------------------------------------------------------------------------------------------------------- */

/* to = from + sum_i F_i (dx, dy)_i at each point; move [2*functions] holds the control points' dx,dy pairs [length], then for
 * each rigid body its translation dx,dy [length] and s - 1 as a pair, s = scale * (cos a, sin a), a the angle of its turn
 * counter-clockwise: the body's points z move to c + s (z - c) + (dx, dy), c its centre, exactly. In place (the
 * same arrays with the same stride) or to other numbers, none of which is read. Points whose sum is 0 keep their bits.
 * from NULL: 0, so that `to` receives displacements, or velocities where `move` holds the control points' velocities.
 * executor NULL: one thread. */
HM_API hm_status hm_morph(const hm_basis *basis, const double *move, const hm_points *from, const hm_points_out *to,
                          const hm_executor *executor, hm_error *err);
/* The transpose: gradient [2*functions] of an objective J by the control points, from its derivatives dj (x: dJ/dx_k, y:
 * dJ/dy_k) by the mesh points. The
 * order in which the mesh numbers its points does not matter; see hm_adjoint_scale. All NaN if a number is not finite. */
HM_API hm_status hm_adjoint(const hm_basis *basis, const hm_points *dj, double *gradient, const hm_executor *executor,
                            hm_error *err);
/* Largest difference [length] on the curves between what the points moved, (to - from), and what the B-spline did. */
HM_API hm_status hm_boundary_error(const hm_basis *basis, const double *move, const hm_points *from, const hm_points *to,
                                   double *error, int32_t *point, hm_error *err);

/* ---- Meshes in parts: several processes, see harmorph_mpi.h ---------------------------------------------------------- */

/* Rows of some points: a basis for the part of the mesh that a process has. Its point k is points[k], counted from the mesh's
 * index_base, in any order, ghosts and repeats too; hm_morph, hm_adjoint, hm_boundary_error and hm_basis_values work with
 * arrays of n points in that order, and points in reports are places in the list. Points of the wall stay what they are, at
 * the first place where the list names them, or the other side of a cut there. It has no cells: calls that take a mesh
 * refuse it. Like any basis it is one block that needs nothing else and may be moved. The size is enough for any list of
 * n points, n up to 2^30.
 * Made of a share that has not all functions, it waits for its values, see hm_parcel_unpack. */
HM_API hm_status hm_extract_size(const hm_basis *basis, int32_t n, size_t *bytes, hm_error *err);
HM_API hm_status hm_extract_init(hm_basis **rows, void *block, size_t bytes, const hm_basis *basis, int32_t n,
                                 const int32_t *points, hm_error *err);

/* Which functions, from 0, part k (from 0) of n_parts may solve: all parts together all functions, in order, as evenly as can
 * be. *n is 0 where there are more parts than functions. */
HM_API hm_status hm_share_of(const hm_analysis *analysis, int32_t part, int32_t n_parts, int32_t *first, int32_t *n,
                             hm_error *err);
/* A share: a basis with a place for functions first .. first+n-1 only, from 0, n >= 0. hm_plan_solve solves these, with the
 * same bits as all of them together; the report is of the share, its partition_defect 0. Calls that need all functions
 * (morph, adjoint) refuse it; functions keep their numbers, and hm_basis_info.functions counts all. */
HM_API hm_status hm_share_size(const hm_analysis *analysis, int32_t first, int32_t n, size_t *bytes, hm_error *err);
HM_API hm_status hm_share_init(hm_basis **share, void *block, size_t bytes, const hm_analysis *analysis, int32_t first,
                               int32_t n, hm_error *err);
/* Parcels take a share's values to another process's rows: doubles [*doubles] for a list of n points. Unpack those of all
 * shares in the order of their functions, each for the list that the rows were made with; with the last one the rows are
 * solved. */
HM_API hm_status hm_parcel_size(const hm_basis *share, int32_t n, int64_t *doubles, hm_error *err);
HM_API hm_status hm_parcel_pack(const hm_basis *share, int32_t n, const int32_t *points, double *parcel, hm_error *err);
HM_API hm_status hm_parcel_unpack(hm_basis *rows, const double *parcel, int64_t doubles, hm_error *err);

/* hm_adjoint in parts, with the same bits for any parts: the largest of all parts' scales; the sums [4 * functions *
 * numbers_per_value] of each part at that scale, added up elementwise; the gradient of these. Each point of the mesh counts
 * in one part only: give 0 at ghosts. Products are rounded once and added as integers, in units of 2^-63 of the scale (a
 * power of two up to 2 max|F| max|dj|): the error is at most 2^-51 sum|F dj| + N 2^-63 max|F| max|dj| for N points, N up to
 * 2^30. hm_adjoint is these three calls. Where a number is not finite, or products might not be, the gradient is NaN. */
HM_API hm_status hm_adjoint_scale(const hm_basis *basis, const hm_points *dj, int32_t *scale, const hm_executor *executor,
                                  hm_error *err);
HM_API hm_status hm_adjoint_sums(const hm_basis *basis, const hm_points *dj, int32_t scale, int64_t *sums,
                                 const hm_executor *executor, hm_error *err);
HM_API hm_status hm_adjoint_finish(const hm_basis *basis, int32_t scale, const int64_t *sums, double *gradient,
                                   hm_error *err);

/* ---- Validity and quality ---------------------------------------------------------------------------------------- */

typedef struct hm_step_report {
    uint64_t struct_size;
    double   admissible;           /* [-] largest s for which from + t displacement has no inverted corner for all t < s; infinite:
                                      unlimited; 0: a corner of the mesh itself has no positive area */
    int32_t  cell, point;          /* the limiting cell and its corner's point; -1: none */
} hm_step_report;
/* How far the points can go from `from` (NULL: the mesh's own coordinates) along `displacement` (of hm_morph with from =
 * NULL). Give the same `from` as to the hm_morph that follows. Exact: along the step each corner's area is a quadratic in
 * s. */
HM_API hm_status hm_admissible_step(const hm_basis *basis, const hm_mesh *mesh, const hm_points *from,
                                    const hm_points *displacement, const hm_executor *executor, hm_step_report *report,
                                    hm_error *err);

typedef struct hm_quality_report {
    uint64_t struct_size;
    int32_t  inverted, first_inverted; /* cells with a corner of area <= 0; the first, or -1 */
    double   min_area;             /* [length^2] smallest signed corner area */
    double   min_quality, mean_quality; /* [0..1] size-skew quality sqrt(f_size) f_skew; inverted cells count 0 */
    int32_t  min_quality_cell;
    int32_t  self_crossing;        /* 1: the boundary crosses itself or another body, or faces lie on each other; the two
                                      sides of a wall without thickness do not, two walls that came together do */
    int32_t  crossing_points[4];   /* begin and end of one face, then of the other; -1: none */
} hm_quality_report;
/* Quality of the mesh at the coordinates `at` (NULL: the mesh's own). f_size = min(t, 1/t), t the cell's area over its
 * area at the coordinates `reference`; reference NULL: f_size = 1. f_skew: Knupp, Finite Elem. Anal. Des. 39 (2003) 217, the shape metric for
 * triangles. Combined as in de Boer, van der Schoot, Bijl, Comput. Struct. 85 (2007) 784. */
HM_API hm_status hm_quality(const hm_basis *basis, const hm_mesh *mesh, const hm_points *at, const hm_points *reference,
                            const hm_executor *executor, hm_quality_report *report, hm_error *err);
/* Both in one pass over the cells, before anything moves: how far the points can go from `from` (NULL: the mesh's own
 * coordinates) along the displacement, and the quality at from + displacement with `from` as the reference. */
HM_API hm_status hm_assess(const hm_basis *basis, const hm_mesh *mesh, const hm_points *from,
                           const hm_points *displacement, const hm_executor *executor, hm_step_report *step,
                           hm_quality_report *quality, hm_error *err);

/* ---- Large movements that stay valid ------------------------------------------------------------------------------- */

/* A ladder; the first rung that reaches the target is the last one that is climbed:
 *   HM_RUNG_LINEAR     x + sum_i F_i dP_i, if its admissible step is above 1
 *   HM_RUNG_OTHER      the same with other bases that the caller has solved (operators, exponents), in their order
 *   HM_RUNG_SUBSTEPS   several steps, each at most half of what is admissible; the functions are solved again on the mesh of
 *                      the step before, whose structure serves again. Points on curves and rigid bodies are always where the
 *                      B-spline, or the body, of the control points at that moment is. On the way a body turns and scales
 *                      about the centre of its control points as the best fitting similarity does, at an even rate; what
 *                      is left of the movement grows linearly. Functions with real values move on straight lines.
 *   HM_RUNG_UNTANGLED  the rest of the way at once; inner points then find places in which no cell is inverted (foldover-free
 *                      energy of Garanzha et al., ACM Trans. Graph. 40 (2021); the initial cells are the shapes wanted)
 * A boundary that crosses itself at the target is refused at once. */
enum { HM_RUNG_LINEAR = 0, HM_RUNG_OTHER = 1, HM_RUNG_SUBSTEPS = 2, HM_RUNG_UNTANGLED = 3 };

typedef struct hm_safe_options {
    uint64_t struct_size;
    int32_t  max_resolves;         /* how often the functions may be solved again; 0 means 10; negative: never */
    int32_t  skipped_rungs;        /* sum of 1 << HM_RUNG_... of those not to be tried */
    int32_t  n_others;             /* >= 0 */
    int32_t  reserved;             /* 0 */
    const hm_basis *const *others; /* [n_others] solved bases of the same mesh, curves, conditions and offset correction; for a
                                      derivative only those with the basis's numbers_per_value are tried */
    double   heights;              /* [0..1] 0: off. Brings distances from walls that move back to what they were, near them:
                                      angle-preserving functions scale them with the wall's stretch. A closed form at the end,
                                      along the normals, fading out where the wall's curvature or another wall begins to
                                      matter; as much of it as no cell inverts for. Not part of the derivative */
    double  *reached;              /* [2*functions] receives the movement that `to` has: short of the target not `move`
                                      times step_fraction, as bodies turn on the way. NULL: not wanted */
} hm_safe_options;

typedef struct hm_safe_report {
    uint64_t struct_size;
    int32_t  rung;                 /* HM_RUNG_... that moved the mesh last */
    int32_t  other;                /* which of `others`, from 0; -1: none */
    int32_t  steps, resolves;
    double   step_fraction;        /* [0..1] of the way to the target; 1: all of it */
    double   admissible;           /* [-] of the last step that was tried, in parts of it, see hm_step_report */
    int32_t  cell, point;          /* what limits it; -1: nothing */
    int32_t  untangled;            /* cells that were inverted before untangling */
    int32_t  iterations;           /* of untangling */
    int32_t  crossing_points[4];   /* see hm_quality_report */
    int32_t  inverted;             /* cells of `to`: always 0 */
    int32_t  min_quality_cell;
    double   min_quality, mean_quality; /* [0..1] of `to`, relative to the start, see hm_quality */
    double   mean_angle_change, max_angle_change; /* [degrees] of the angles between wall and first-layer edges */
    double   mean_height_ratio, min_height_ratio, max_height_ratio; /* [-] of first-layer heights, after over before */
    double   heights;              /* [0..1] how much of them was brought back */
    int32_t  angle_point;          /* where the angle changed most; -1: no point of the wall has such an edge */
    int32_t  min_height_point, max_height_point;
    int32_t  reserved;             /* 0 */
} hm_safe_report;

/* Working space of hm_morph_safe: it holds a basis, the mesh's points a few times, and what untangling needs. */
HM_API hm_status hm_morph_safe_size(const hm_plan *plan, size_t *bytes, hm_error *err);
/* Moves the mesh the plan was made of, which must not have changed since, by `move` (see hm_morph); `to` [n_points] may be
 * the mesh's own arrays. Returns HM_OK: all of `move`; HM_NOT_CONVERGED: the same, but functions on the way missed
 * the tolerance. HM_SHORT: the last valid mesh, report.step_fraction of the way.
 * Refused or cancelled: `to` is untouched. `to` never holds an inverted cell. options NULL: defaults. The threads are the
 * plan's. The plan is left with another factor: hm_plan_factor comes before the next hm_plan_solve.
 *
 * derivative NULL, or another basis of the same analysis (hm_basis_init): it receives the sum of the steps' functions, each
 * times what its step is of the whole movement, with which hm_morph is the derivative of `to` by `move`, and hm_adjoint its
 * transpose. Exact on the wall. Neglected elsewhere: that the functions of later steps depend on where earlier ones put
 * the mesh, that lengths of steps and the turning of bodies depend on `move`, and what untangling moved. */
HM_API hm_status hm_morph_safe(hm_plan *plan, const hm_basis *basis, const double *move, const hm_points_out *to,
                               hm_basis *derivative, void *work, size_t bytes, const hm_safe_options *options,
                               hm_safe_report *report, hm_error *err);

#ifdef __cplusplus
}
#endif
#endif
