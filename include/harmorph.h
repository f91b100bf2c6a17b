/* harmorph: morphs an airfoil and the CFD mesh around the airfoil together. MIT licence.
 *
 * The airfoil is a B-spline curve. Each of its basis functions N_i is boundary data for Laplace's equation (or a
 * related operator) on the mesh. The solutions F_i are computed once. They carry any movement dP_i of the control
 * points to every mesh point: X_new = X + sum_i F_i dP_i. (Method: Nikolos, Lygidakis, Leloudas, Tavla, "Application of
 * B-spline basis functions as harmonic functions for the concurrent shape and mesh morphing of airfoils".)
 *
 * CONVENTIONS: they hold for every function below.
 *
 * Languages        This header is valid C99 and C++11. The library is written in C++17 and needs no C++ run-time
 *                  library. The Fortran module needs Fortran 2008. Tested with gcc, g++ and gfortran 12.2.
 * Order of calls   hm_analysis_size > hm_analysis_init   checks mesh, curves, conditions; ordering; symbolic pass
 *                  hm_plan_size > hm_plan_init           memory for the matrix and the factor, in a block of the caller
 *                  hm_basis_size > hm_basis_init         memory for the functions F_i, in another block of the caller
 *                  hm_plan_factor > hm_plan_solve        numbers; then analysis and plan may be discarded
 *                  hm_morph, hm_adjoint, ...             any number of times; they need only the basis and the mesh
 * Memory           The library allocates no memory. A *_size function returns the exact number of bytes; any alignment
 *                  is accepted. An object lives inside the caller's block: nothing has to be freed, and the block must
 *                  not move while the object is in use (a basis may be copied or written to a file: hm_basis_attach).
 *                  Morphs and adjoints are faster with blocks at multiples of 64 bytes, those of large meshes in huge
 *                  pages: harmorph_pages.h.
 * Ownership        Arrays in structs remain the caller's, and input arrays are never changed. The arrays of a mesh must
 *                  exist as long as the analysis and the plan that were made from the mesh, the arrays of the curves as
 *                  long as the analysis. The basis contains copies of everything that the basis needs.
 * Units            Coordinates have any length unit, the same one everywhere. Angles are in degrees where they are
 *                  reported, and given by their cosine and sine where bodies turn. Array lengths stand in [brackets].
 * Range            Coordinates of points, control points and centres are at most 1e100 in size. Every corner of a cell
 *                  has a height, twice its area divided by the longer of its two edges, of at least 1e-100, and of at
 *                  least 2^-46 (1.4e-14) of the largest coordinate of the cell: a movement rounds coordinates to 2^-53
 *                  of their size, and thinner cells would be inverted by rounding. hm_analysis_init refuses everything
 *                  else. Move the origin to the body if cells are too thin for their coordinates.
 * Numbering        Points and cells are counted from mesh.index_base (also in reports, unless stated otherwise),
 *                  control points from curves.index_base. Arguments and fields that name a curve, a condition or a
 *                  function are counted from 0. Function i belongs to control point i + curves.index_base. Errors count
 *                  everything from the same number: see hm_error.
 * Orientation      Cells may be numbered clockwise, counter-clockwise or mixed. Two neighbours of equal orientation
 *                  traverse their common edge in opposite directions; this finds the cells of equal orientation, and
 *                  the orientation with the larger total area is taken as positive.
 * Inverted         A cell is inverted if one of its corners has an area <= 0 in the positive orientation. The area of a
 *                  corner is half the cross product of the two edges that meet there. A quadrilateral that is not
 *                  convex is therefore inverted even if its total area is positive. For polygons (HM_CELLS_POLYGONS)
 *                  see hm_mesh. Areas are rounded: a corner with a sine of less than 5e-16 may count as either. A cell
 *                  with an area that is infinite or NaN is inverted, too.
 * Markers          A marker without a condition is fixed: the points on it do not move.
 * NULL             Allowed only where stated. hm_error may always be NULL.
 * Status           0: success. Positive: success with a warning, the result can be used. Negative: the call was
 *                  refused; outputs and blocks are as before the call, but a block given for a new object may have been
 *                  written.
 * Structs          Set struct_size = sizeof the struct and all other fields to 0 first: `hm_options options = {sizeof
 *                  options};`. A field that is 0 has its default value. New fields are only ever added at the end.
 *                  Reports are filled up to the caller's struct_size. Options that this library does not know:
 *                  HM_UNSUPPORTED.
 * Threads          There is no hidden state. Only one thread at a time may write an object (plan, basis) or make other
 *                  objects from one (analysis); any number may read (morph, adjoint, quality). The library starts no
 *                  threads; it uses those of an hm_executor, if given.
 * Exceptions       A call that succeeds on finite numbers raises no floating-point exception but inexact and underflow.
 * Repeatability    The same input and the same kernel give bitwise identical results: from run to run, for any number
 *                  of threads, and for any number of processes (harmorph_mpi.h).
 */
#ifndef HARMORPH_H
#define HARMORPH_H

#include <stddef.h>
#include <stdint.h>

#define HM_VERSION "0.2.0"
#define HM_VERSION_MAJOR 0 /* semantic version; before 1.0.0 any minor version may change the interface */
#define HM_VERSION_MINOR 2
#define HM_VERSION_PATCH 0
#define HM_ABI 4 /* hm_abi_version() returns this value if header and library belong together. The shared library has
                    this number in its name: libharmorph.so.HM_ABI */

#ifdef __cplusplus
extern "C" {
#endif
#if defined(__GNUC__)
#define HM_API __attribute__((visibility("default")))
#else
#define HM_API
#endif

/* ---- Status and error ---- */

typedef int32_t hm_status;
enum {
    HM_OK = 0,
    HM_NOT_CONVERGED = 1,     /* solved, but a residual is above options.tolerance, or the iteration or the refinement
                                 ended before the values were as accurate; error.value: their estimated error */
    HM_MOVED = 2,             /* attached, but the coordinates of the mesh are not those the basis was solved on */
    HM_SHORT = 3,             /* hm_morph_safe, hm_displace_safe: the mesh is valid, but only a part of the movement
                                 was possible */
    HM_BACKTRACKS = 4,        /* hm_fit: the curve runs backwards between two points; error.item: the first of them */
    HM_FAR_FROM_CURVE = 5,    /* hm_analysis_init: a point is farther from its curve than 5 % of the extent of the
                                 curve or of all points on curves, or lies beyond the end of its curve;
                                 error.item: the point for which this part is largest,
                                 error.value: the distance of that point from the curve */
    HM_POOR = 6,              /* hm_morph_safe: the mesh is valid and at the target, but cells are poorer, or heights of
                                 the first layer changed more, than was asked for;
                                 error.item: the cell, or the wall point */
    HM_CANCELLED = -1,        /* the progress callback asked to stop; repeat the cancelled call to continue */
    HM_BAD_ARGUMENT = -2,     /* NULL, a size or number out of range, a struct_size that no such struct has */
    HM_BAD_MESH = -3,         /* index, repeated point, non-manifold edge, inverted cell, boundary, coordinate */
    HM_BAD_CURVE = -4,        /* degree, knots, indices, weights, control points, or a fit that is not determined */
    HM_BAD_CONDITION = -5,    /* marker that no face has, curve that does not exist, field of another kind,
                                 nothing to solve */
    HM_BAD_BASIS = -6,        /* the block is not a basis, truncated (error.value: missing bytes, at least), damaged,
                                 of another mesh, or not solved yet */
    HM_BLOCK_TOO_SMALL = -7,  /* error.value: missing bytes */
    HM_NOT_POSITIVE = -8,     /* the matrix is not positive definite; error.item: the mesh point where this was found */
    HM_UNSUPPORTED = -9,      /* a combination of options that is not available */
    HM_CROSSING = -10         /* no mesh has the moved boundary: faces cross, a body leaves the domain, is inside
                                 another one or inside out, or points on the boundary alone invert a cell;
                                 error.item: a point of the boundary, or the cell */
};

enum {                        /* hm_error.item_kind, other_kind: what the number counts */
    HM_ITEM_NONE = 0,
    HM_ITEM_POINT = 1,        /* a point of the mesh, or one of the points of hm_fit */
    HM_ITEM_CELL = 2,         /* a cell of the mesh, or a face of an hm_space_mesh */
    HM_ITEM_SIDE = 3,         /* a face of the boundary (mesh.face_points), or a side of an hm_space_mesh */
    HM_ITEM_MARKER = 4,       /* the caller's own number; item_base is 0 */
    HM_ITEM_CURVE = 5,
    HM_ITEM_CONTROL_POINT = 6,
    HM_ITEM_CONDITION = 7,
    HM_ITEM_FUNCTION = 8,
    HM_ITEM_BODY = 9,         /* hm_condition.body */
    HM_ITEM_LIST = 10,        /* of mesh.list_start */
    HM_ITEM_BLOCK = 11,       /* of mesh.block_sizes */
    HM_ITEM_KNOT = 12,        /* of the curve that is the other item, or of those to be inserted */
    HM_ITEM_VARIABLE = 13,    /* a design variable: a column of a matrix of hm_map or hm_combine */
    HM_ITEM_QUANTITY = 14,    /* of hm_measure */
    HM_ITEM_FIELD = 15,       /* of hm_displace, or a mode of hm_tabulate */
    HM_ITEM_ENTRY = 16,       /* an entry of the array that the text names, or a level, a part, a piece, a column */
    HM_ITEM_GLOBAL_POINT = 17 /* the caller's own number (hm_part_mesh.numbers); item_base is 0 */
};

/* The items of an error, and all numbers in its text, are counted from one base: the index_base of the mesh, also of the
 * mesh that an analysis, a plan, a basis or a plane was made from; in calls with curves alone, the index_base of the
 * curves; in other calls 0. Where a call has a mesh and curves, curves, control points and knots keep the index_base of
 * the curves. item - item_base is the index of a C array, whatever the base is. Markers and global points are the
 * caller's own numbers. Counts and values in the text, such as the degree of a curve, are what the caller gave. */
typedef struct hm_error {     /* 256 bytes */
    hm_status code;
    int32_t   item_kind;      /* HM_ITEM_...: what the error is about */
    int32_t   item;           /* the first offending one; -1 if item_kind is HM_ITEM_NONE */
    int32_t   item_base;      /* what item is counted from: 0 or 1 */
    int32_t   other_kind;     /* what else the error is about: the second of two points, the curve of a knot; */
    int32_t   other;          /* HM_ITEM_NONE, -1 and 0 if there is nothing else */
    int32_t   other_base;
    int32_t   reserved;       /* 0 */
    double    value;          /* the value found: area [length^2], residual [-], missing [bytes], the count or option
                                 that was given; 0 if there is none */
    double    x, y;           /* the place that the text names [length], never NaN; 0, 0 if it names none */
    char      text[200];      /* one sentence, NUL-terminated */
} hm_error;

HM_API int32_t     hm_abi_version(void);
HM_API const char *hm_version(void);                      /* "major.minor.patch" of the library */
HM_API const char *hm_status_name(hm_status status);      /* "HM_OK", ...; "unknown status" otherwise */

/* ---- Vector instructions ---- */

enum {                             /* kernels: the library contains those of its architecture */
    HM_KERNEL_AUTO = 0,            /* the best that the processor has; the library asks the processor */
    HM_KERNEL_BASELINE = 1, HM_KERNEL_AVX2 = 2, HM_KERNEL_AVX512 = 3,
    HM_KERNEL_NEON = 4             /* 64-bit ARM; the AVX kernels are those of x86-64 */
};
/* The best kernel that this processor has; never HM_KERNEL_AUTO. On a virtual machine the question may take 15 us, more
 * than a morph of 5000 points. So ask once, and keep the answer in hm_executor.kernel. */
HM_API int32_t hm_best_kernel(void);

/* ---- Threads of the caller ---- */

/* Calls task(context, i) once for each i in 0 .. n_tasks-1, in any order, on any threads, and returns when all tasks
 * are done. No task waits for another task. Ready-made: harmorph_openmp.h, harmorph_pthreads.h. */
typedef void (*hm_run)(void *user, int32_t n_tasks, void (*task)(void *context, int32_t index), void *context);

typedef struct hm_executor {
    uint64_t struct_size;
    hm_run   run;                  /* NULL: everything runs on the calling thread */
    void    *user;                 /* passed to run */
    int32_t  n_threads;            /* about how many tasks run at once, 1 .. 256; 0 means 1.
                                      The memory of a plan grows with n_threads */
    int32_t  kernel;               /* HM_KERNEL_...: hm_best_kernel(), asked once; the ready-made executors contain it.
                                      HM_KERNEL_AUTO: each call that has enough to do asks the processor, small ones
                                      take the baseline. Results of calls without hm_options (morph, adjoint, quality)
                                      do not depend on the kernel. The number is checked (HM_UNSUPPORTED), the processor
                                      is not: with a kernel that it lacks, the program ends with an illegal
                                      instruction; a kernel of another architecture means the baseline */
} hm_executor;

/* ---- Points: two numbers for each point of a mesh, in the caller's arrays ---- */

/* Coordinates, displacements, velocities, or derivatives with respect to the coordinates. The numbers of point k, k
 * from 0, are x[k*stride] and y[k*stride]. Fortran's x(n), y(n): {x, y, 1}. Pairs xy(2,n): {xy, xy+1, 2}. xy(n,2): {xy,
 * xy+n, 1}. An array of structs s: {&s[0].x, &s[0].y, sizeof s[0] / sizeof(double)}. Nothing is read
 * behind the last point. */
typedef struct hm_points {         /* input; 24 bytes for ever */
    const double *x, *y;
    int64_t stride;                /* [doubles] from one point to the next, >= 1; 0 means 1 */
} hm_points;

typedef struct hm_points_out {     /* output; the same layout */
    double *x, *y;
    int64_t stride;
} hm_points_out;

/* ---- Mesh: a view of the caller's arrays ---- */

enum {                        /* hm_mesh.cell_layout */
    HM_CELLS_ROWS = 0,        /* cell_start, cell_points: compressed rows of 3 or 4 points */
    HM_CELLS_TRIANGLES = 1,   /* cell_points [3*n_cells] */
    HM_CELLS_QUADS = 2,       /* cell_points [4*n_cells]; a triangle repeats its last point */
    HM_CELLS_STRUCTURED = 3,  /* no list: point (i,j) is i + ni*j, cell (i,j) is i + (ni-1)*j, i and j from 0 */
    HM_CELLS_MIXED = 4,       /* two arrays: the triangles in cell_points [3*(n_cells-n_quads)], the quadrilaterals in
                                 quad_points [4*n_quads]. The triangles are the first cells, the quadrilaterals the
                                 cells from index_base + n_cells - n_quads on */
    HM_CELLS_BLOCKS = 5,      /* no list: structured blocks one after the other, points and cells of each as in
                                 HM_CELLS_STRUCTURED, behind those of the blocks before. Interfaces of blocks are cuts,
                                 see below: their points exist once in each block, with equal coordinates.
                                 Blocks in separate arrays: hm_blocks_gather */
    HM_CELLS_POLYGONS = 6     /* cell_start, cell_points: compressed rows of 3 to 1024 points, among them hanging nodes,
                                 which are explained below */
};
enum { HM_NO_MARKER = INT32_MIN }; /* hm_mesh.block_markers: the side is an interface or a cut, or has faces or lists */

typedef struct hm_mesh {
    uint64_t struct_size;
    int32_t  index_base;           /* 0 or 1: the first number of points and cells, in all arrays and reports */
    int32_t  n_points;             /* 3 .. 2^30; points that no cell uses are allowed and never move */
    hm_points points;              /* [n_points] coordinates */
    int32_t  cell_layout;          /* HM_CELLS_... */
    int32_t  n_cells;              /* 1 .. 2^29; structured and blocks: 0 or the cells of the blocks, of each
                                      (ni-1)*(nj-1); mixed: both kinds together */
    const int32_t *cell_start;     /* [n_cells+1] rows and polygons only: where the points of a cell begin, counted from
                                      index_base. Size queries read the cell_start of polygons */
    const int32_t *cell_points;    /* the points of each cell in order around the cell */
    int32_t  ni, nj;               /* structured only: points along i (fastest) and j; ni*nj = n_points */
    int32_t  n_faces;              /* boundary given as faces (0 if it is given as lists); both may be given */
    const int32_t *face_points;    /* [2*n_faces] */
    const int32_t *face_markers;   /* [n_faces] any integers */
    int32_t  n_lists;              /* boundary given as ordered lists of points;
                                      a closed list repeats its first point */
    const int32_t *list_start;     /* [n_lists+1] counted from index_base */
    const int32_t *list_points;
    const int32_t *list_markers;   /* [n_lists] */
    int32_t  n_quads;              /* mixed only, otherwise 0: 0 .. n_cells */
    const int32_t *quad_points;    /* [4*n_quads] mixed only; a triangle repeats its last point */
    int32_t  n_blocks;             /* blocks only, otherwise 0: 1 .. 65536. Time grows with their number; thousands of
                                      blocks are better given as HM_CELLS_QUADS */
    int32_t  reserved;             /* 0 */
    const int32_t *block_sizes;    /* [2*n_blocks] ni, nj >= 2 of each block; n_points is the sum of ni*nj */
    const int32_t *block_markers;  /* [4*n_blocks] markers of the sides i=0, i=ni-1, j=0, j=nj-1 of each block, or
                                      HM_NO_MARKER; NULL: the boundary is given as faces or lists */
} hm_mesh;
/* Every boundary edge must be on a marker. The exception is a cut, such as the seam of an O-mesh or the wake line of a
 * C-mesh: two points of unmarked boundary edges with equal coordinates are one point for the library and move together.
 * Faces of one marker may belong to several bodies, and one body may have several markers.
 *
 * Polygons: a point that lies on a side of a cell (a hanging node) is a corner of that cell, so that any two neighbours
 * have the points of their common sides in common. At the coordinates of hm_analysis_init, a corner is convex if the
 * tangent of its exterior angle is above 1/8 (interior angle below 172.8 degrees), flat within this tolerance, or
 * reflex. Triangles, and quadrilaterals with four convex corners, are treated as in the other layouts. Every other
 * cell is divided into triangles without new points, such that the worst triangle is as good as possible; the operators
 * act on these triangles, so linear fields are exact. The division belongs to the analysis, and to the bases made from
 * it, and does not change when the points move. Such a cell is inverted if one of its triangles has an area <= 0, or a
 * corner leaves its range of interior angles: 0 to 180 degrees if it was convex (no convex corner becomes reflex), 45
 * to 225 if it was flat (a hanging node may bend by 45 degrees towards the inside), 135 to 315 if it was reflex. So the
 * area of a valid cell is positive. Admissible steps, which are exact for this definition, too, quality, the safe morph
 * and hm_improve judge a cell by it; cells are reported in the caller's numbering.
 * Quality of such a cell: with m convex corners of areas A_k between sides a_k and b_k,
 * m / (sin(2 pi / m) sum_k |a_k| |b_k| / (2 A_k)), at most 1: 1 if all angles are equal, as for a rectangle with
 * hanging nodes; 0 if the cell is inverted. */

/* ---- Structured blocks in arrays of their own ---- */

/* Solvers with several blocks mostly have arrays for each of them, often with layers of ghost points around. The mesh
 * (HM_CELLS_BLOCKS) and all calls with points of it have the blocks one after the other: keep one pair of arrays
 * [n_points] for mesh.points, fill the pair by hm_blocks_gather, and hand results back by hm_blocks_scatter:
 * coordinates after hm_morph, displacements, derivatives for hm_adjoint (in which the copies of a point on an interface
 * all count).
 *
 * The numbers of the point i, j of one block, i and j from 0, are x[i*stride + j*row] and y[i*stride + j*row].
 * Fortran's x(0:ni+1, 0:nj+1), with the block inside one layer of ghost points: {&x(1,1), &y(1,1), 1, ni + 2}. A C
 * array x[i][j], j the faster index: {x, y, nj, 1}. */
typedef struct hm_block_points {   /* input; 32 bytes for ever */
    const double *x, *y;
    int64_t stride;                /* [doubles] from i to i+1, >= 1; 0 means 1 */
    int64_t row;                   /* [doubles] from j to j+1, >= 1; 0 means ni*stride. Both at most 2^40 */
} hm_block_points;

typedef struct hm_block_points_out { /* output; the same layout. stride and row must keep the points apart */
    double *x, *y;
    int64_t stride, row;
} hm_block_points_out;

/* Copies the blocks first .. first+n-1, from 0, of a mesh with HM_CELLS_BLOCKS: from `blocks` [n] to their places in
 * `to` [n_points], or from `from` [n_points] to `blocks` [n]. All other numbers stay as they are. Only the sizes of the
 * blocks are read of the mesh; mesh.points need not have values yet. Arrays read and arrays written must have no number
 * in common. */
HM_API hm_status hm_blocks_gather(const hm_mesh *mesh, int32_t first, int32_t n, const hm_block_points *blocks,
                                  const hm_points_out *to, hm_error *err);
HM_API hm_status hm_blocks_scatter(const hm_mesh *mesh, int32_t first, int32_t n, const hm_points *from,
                                   const hm_block_points_out *blocks, hm_error *err);

/* ---- Curves ---- */

typedef struct hm_curve {          /* C(u) = sum_k N_k(u) P[indices[k]], u in [knots[degree], knots[n_indices]] */
    uint64_t struct_size;          /* the same in all curves of one hm_curves */
    int32_t  degree;               /* 1..5 */
    int32_t  n_indices;            /* control points, repeated ones counted again; > degree */
    const int32_t *indices;        /* [n_indices] NULL: the points in order. Repeated points close a curve: with
                                      periodic knots the first `degree` points stand again at the end, with clamped
                                      knots the first point does */
    const double  *knots;          /* [n_indices + degree + 1] non-decreasing, up to 1e100;
                                      inner knots are at most degree-fold */
} hm_curve;

typedef struct hm_curves {         /* curves with common control points; a point used by two curves belongs to both */
    uint64_t struct_size;
    int32_t  index_base;           /* 0 or 1 */
    int32_t  n_control;            /* control points >= 2 = number of functions */
    const double *control;         /* [2*n_control] x,y pairs, finite */
    const double *weights;         /* [n_control] 1e-10 .. 1e10, or NULL: not rational */
    int32_t  n_curves;             /* >= 1 */
    const hm_curve *curve;         /* [n_curves] */
} hm_curves;

/* Checks that the curves are well-formed; two knots differ by 0 or by at least 1e-18 of the range of all knots. */
HM_API hm_status hm_curves_check(const hm_curves *curves, hm_error *err);
/* The degree+1 B-spline basis functions (rational ones if there are weights) that are not 0 at u.
 * control [degree+1]: their control points; values [(n_derivatives+1)*(degree+1)]: row d is the d-th derivative by u.
 * 0 <= n_derivatives <= 5. (Piegl & Tiller, The NURBS Book, A2.3 and eq. 4.8.) */
HM_API hm_status hm_curve_basis(const hm_curves *curves, int32_t curve, double u, int32_t n_derivatives,
                                int32_t *control, double *values, hm_error *err);
/* C(u) and its derivatives: xy [2*(n_derivatives+1)], x,y pairs. */
HM_API hm_status hm_curve_point(const hm_curves *curves, int32_t curve, double u, int32_t n_derivatives,
                                double *xy, hm_error *err);
/* The parameter u of the curve point nearest to (x, y), and the distance [length]: a global search, then Newton. */
HM_API hm_status hm_curve_project(const hm_curves *curves, int32_t curve, double x, double y,
                                  double *u, double *distance, hm_error *err);

/* ---- Fit: a B-spline through the ordered points of a boundary ---- */

enum {                             /* hm_fit_options.closed */
    HM_CLOSED_AUTO = 0,            /* for a loop without a corner: periodic; with a blunt base: open, plus a straight
                                      curve of degree 1 along the base that has both end points in common with it;
                                      otherwise tied at the sharpest corner. A base is straight, lies between two
                                      corners at the end of the section that is farthest from the nose, is at most 0.15
                                      of the extent long, and the outline turns back at both of its ends. Facets of a
                                      leading edge and rounded edges are not bases. For points that are no loop: open */
    HM_OPEN = 1,                   /* clamped at the first and the last point */
    HM_TIED = 2,                   /* clamped, both ends are one control point: a sharp trailing edge */
    HM_PERIODIC = 3                /* smooth everywhere */
};
enum {                             /* hm_fit_report.reason */
    HM_FIT_ASKED = 0,              /* closed as the options say */
    HM_FIT_NO_LOOP = 1,            /* open: the points are no loop */
    HM_FIT_NO_CORNER = 2,          /* periodic: no corner was found */
    HM_FIT_CORNER = 3,             /* tied: there are corners and no blunt base */
    HM_FIT_BASE = 4                /* open: there is a blunt base */
};

typedef struct hm_fit_options {
    uint64_t struct_size;
    int32_t  degree;               /* 1..5; 0 means 3 */
    int32_t  n_control;            /* distinct control points > degree; at most the number of points; 0 means 20 */
    int32_t  closed;               /* HM_CLOSED_AUTO, ... */
    int32_t  index_base;           /* 0 or 1: what errors count points from */
} hm_fit_options;

typedef struct hm_fit_report {
    uint64_t struct_size;
    double   max_error, rms_error; /* [length] distances of the points from the curves */
    int32_t  max_error_point;      /* the point with the largest distance, 0 .. n-1 */
    int32_t  closed;               /* the closure used: HM_OPEN, HM_TIED or HM_PERIODIC */
    int32_t  first_point;          /* where the curve begins (the corner of a loop), from 0 */
    int32_t  base_points;          /* points on a blunt base including both ends; 0: no base */
    int32_t  reason;               /* HM_FIT_...: why the curve is closed in this way */
    int32_t  corners;              /* points where the direction of the outline jumps,
                                      including the ends of the curve */
    int32_t  backtrack_point;      /* the curve runs backwards from this point (from 0) to the next one; -1: nowhere */
    int32_t  reserved;             /* 0 */
} hm_fit_report;

HM_API hm_status hm_fit_size(int32_t n, const hm_fit_options *options, size_t *bytes, hm_error *err);
/* Least-squares fit to n points in order. is_loop: the last point is connected to the first one, which is not repeated.
 * Without is_loop, a last point that is equal to the first one is refused (HM_BAD_CURVE, error.item: the last point):
 * the curve would open there. Set is_loop and leave the last point out.
 * Knots are placed by arc length and curvature. *curves and its arrays are inside the block (index_base 0). options and
 * report may be NULL. HM_BACKTRACKS: the fit is complete, but the curve runs against the order of the points somewhere,
 * as curves of high degree do where there are hardly more points than control points. */
HM_API hm_status hm_fit(const hm_curves **curves, void *block, size_t bytes, const hm_points *points, int32_t n,
                        int32_t is_loop, const hm_fit_options *options, hm_fit_report *report, hm_error *err);

/* ---- More control points for the same shape ---- */

/* Coarse-to-fine design: the same curves with more control points. hm_refine inserts n knots u [n] into one curve, in
 * any order, a value as often as its knot is to be repeated; hm_elevate raises the degree of one curve by 1. Both are
 * exact: all points C(u) are the same but for rounding, also of rational curves. The other curves of the set are kept.
 * *matrix [finer->n_control * curves->n_control] contains rows M: new control points = M * old ones (of x and of y),
 * and derivatives with respect to the old ones = transpose of M * those with respect to the new ones. Rows sum to 1.
 * Weights are constants here; the new ones are in finer->weights. matrix may be NULL.
 * Control points are numbered anew: first those of the changed curve in its order, then those that only other curves
 * use or no curve. A control point that the change does not touch stays one point, however many curves or ends use it:
 * ties and common ends persist. Periodic curves (the first `degree` points again at the end, with periodic knots)
 * remain periodic; the knot is inserted in all its images.
 * *finer and its arrays and *matrix are inside the block, finer->index_base is that of curves. Refused with
 * HM_BAD_ARGUMENT: a knot that is not finite or not between the ends of the curve (the beginning of a periodic curve is
 * allowed); with HM_BAD_CURVE: a multiplicity above the degree, and degree 5 for hm_elevate. (Polar forms: Ramshaw,
 * Comput. Aided Geom. Des. 6 (1989) 323.) */
HM_API hm_status hm_refine_size(const hm_curves *curves, int32_t curve, int32_t n, const double *u, size_t *bytes,
                                hm_error *err);
HM_API hm_status hm_refine(const hm_curves **finer, const double **matrix, void *block, size_t bytes,
                           const hm_curves *curves, int32_t curve, int32_t n, const double *u, hm_error *err);
HM_API hm_status hm_elevate_size(const hm_curves *curves, int32_t curve, size_t *bytes, hm_error *err);
HM_API hm_status hm_elevate(const hm_curves **finer, const double **matrix, void *block, size_t bytes,
                            const hm_curves *curves, int32_t curve, hm_error *err);

/* ---- Measures of a section, with derivatives by the control points ---- */

typedef struct hm_section {        /* which curves are the outline of the section, and its chord */
    uint64_t struct_size;
    int32_t  first_curve, n_curves;/* the curves first_curve .. first_curve+n_curves-1 are the outline, each joined to
                                      the one before; 1 .. 8 curves; both 0: all curves of the set. A last curve of
                                      degree 1 with two control points, behind another one, is a blunt base. An outline
                                      that is not closed is closed by a straight line */
    double   nose_x, nose_y, edge_x, edge_y; /* a chord line that does not move, from the leading to the trailing edge.
                                      All 0: the chord of the curves: the trailing edge is the midpoint of the two ends
                                      (without base) of the outline, the leading edge the point of the outline farthest
                                      from there, and both move with the control points.
                                      Periodic curves have no ends: their chord must be given */
} hm_section;

enum {                             /* hm_quantity.kind */
    HM_AREA = 0,                   /* [length^2] enclosed, > 0 for both orientations */
    HM_CENTROID_X = 1, HM_CENTROID_Y = 2, /* [length] of the enclosed area */
    HM_MOMENT_XX = 3, HM_MOMENT_YY = 4, HM_MOMENT_XY = 5, /* [length^4] integrals of (y - yc)^2, (x - xc)^2,
                                      (x - xc)(y - yc) over the area, (xc, yc) its centroid */
    HM_CHORD = 6,                  /* [length] of the chord line */
    HM_THICKNESS = 7,              /* [length] at a station: from the lowest to the highest point of the outline on the
                                      normal to the chord line through the station */
    HM_CAMBER = 8,                 /* [length] the mean height of these two points above the chord line (left of the
                                      direction from the leading to the trailing edge) */
    HM_MAX_THICKNESS = 9,          /* [length] over all stations */
    HM_MAX_CAMBER = 10,            /* [length] the camber of the largest magnitude, with its sign */
    HM_NOSE_RADIUS = 11,           /* [length] radius of curvature at the leading edge: the point of the outline
                                      farthest from the trailing edge of the chord; > 0 where the outline is convex */
    HM_EDGE_ANGLE = 12,            /* [degrees] interior angle between the two ends of the outline at the trailing edge;
                                      negative: they have crossed */
    HM_EDGE_GAP = 13,              /* [length] between the two ends, normal to the chord; negative: they have crossed */
    HM_MIN_RADIUS = 14,            /* [length] smallest radius of curvature, > 0; corners do not count */
    HM_CURVATURE_VARIATION = 15,   /* [1/length^3] integral of (d curvature / d arc length)^2 over the arc length; jumps
                                      at knots and corners do not count; degree >= 2 */
    HM_CLEARANCE = 16              /* [length] smallest signed distance of the outline from a polygon that is to fit
                                      inside; negative: a part of the polygon is outside */
};

typedef struct hm_quantity {
    uint64_t struct_size;          /* the same in all quantities of one call */
    int32_t  kind;                 /* HM_AREA, ... */
    int32_t  n_polygon;            /* clearance: points of the polygon, 1 .. 2^20; a polygon of 2 points is a line */
    double   station;              /* thickness, camber: 0 < station < 1 along the chord line */
    const double *polygon;         /* [2*n_polygon] clearance: x,y pairs; the last point is connected to the first */
} hm_quantity;

/* values [n]; at [2*n]: where, or NULL: the point of the chord line for thickness, camber and chord, the centroid for
 * integrals over the area, otherwise a point of the outline. gradients [n * 2*n_control], or NULL: row k contains the
 * derivatives of value k by x and y of each control point, weights constant. section NULL: all curves, with their own
 * chord. Integrals are evaluated by Gauss rules that are exact for polynomial curves; for rational curves, and for the
 * curvature variation, intervals are halved until nothing changes but rounding. Derivatives are exact; those of
 * extremes hold while the extreme stays where it is, and are those of one side where two places have the same value.
 * Refused with HM_BAD_CURVE: curves not joined, beyond 1e50, no area, no chord, a station where the outline is parallel
 * to the normal of the chord or that the normal meets at less than two points, a leading edge or an outline without
 * curvature, a trailing edge without directions. item: the quantity, from 0. Outputs are then unchanged. */
HM_API hm_status hm_measure(const hm_curves *curves, const hm_section *section, int32_t n,
                            const hm_quantity *quantities, double *values, double *at, double *gradients,
                            hm_error *err);

/* ---- Design variables: maps to the control points ---- */

enum {                             /* hm_variables.kind: how one unit of each variable moves the outline */
    HM_FFD = 0,                    /* free-form deformation: variable i + (degree_x+1) j is the node i, j of a box,
                                      whose movement (dx, dy) moves the points inside by B_i(x) B_j(y) (dx, dy),
                                      Bernstein polynomials; points outside do not move. (Sederberg, Parry 1986) */
    HM_CST = 1,                    /* class and shape functions: chord * t^nose_exponent (1-t)^edge_exponent B_k(t)
                                      normal to the chord, n_upper Bernstein polynomials of degree n_upper-1 of the
                                      upper side, then n_lower of the lower one; t: station, 0 .. 1.
                                      (Kulfan, J. Aircraft 45 (2008) 142) */
    HM_HICKS_HENNE = 2,            /* bumps chord * sin(pi t^(log .5 / log peak))^width normal to the chord, n_upper on
                                      the upper side, then n_lower. (Hicks, Henne, J. Aircraft 15 (1978) 407) */
    HM_NACA4 = 3                   /* NACA's four-digit sections: n_upper camber lines of 1 chord, each with its largest
                                      camber at its peak, and last the thickness: half of it on either side, closed at
                                      t = 1, 1 unit being a thickness of 1 chord. n_upper may be 0 */
};

typedef struct hm_variables {
    uint64_t struct_size;
    int32_t  kind;                 /* HM_FFD, ... */
    int32_t  n_upper, n_lower;     /* 0 .. 64, together at least 1 (not HM_NACA4); upper: left of the chord */
    int32_t  degree_x, degree_y;   /* FFD: 0 .. 63 */
    double   x_min, y_min, x_max, y_max; /* FFD: the box; all 0: the box of the control points, 5 % larger */
    const double *peaks;           /* [n_upper+n_lower] Hicks-Henne, NACA: stations between 0 and 1; NULL: Hicks-Henne
                                      (2 k + 1) / (2 n) of each side, NACA .4 */
    double   nose_exponent, edge_exponent; /* CST: 0 .. 10; both 0: .5 and 1, a round nose and a pointed edge */
    double   width;                /* Hicks-Henne: exponent of the sine, 1 .. 100; 0: 3 */
} hm_variables;
/* Fields of another kind must be 0. */

/* *n: number of variables; *bytes: working memory of hm_variables_map. section as in hm_measure. */
HM_API hm_status hm_variables_size(const hm_curves *curves, const hm_section *section, const hm_variables *variables,
                                   int32_t *n, size_t *bytes, hm_error *err);
/* d(control) / d(variable): matrix [n_control * n * 2], for each control point the pairs (x, y) by which one unit of
 * each variable moves this point, as complex numbers: the variables v, also complex, move control point i by sum_j
 * matrix_ij v_j. The variables of FFD have two components; those of the other kinds are real. The matrix is the
 * least-squares approximation, over the curves' parameters, of the wanted movement of the outline by the B-spline's,
 * with the free ends of curves exact: error [2*n] contains the root mean square and the largest of what is left,
 * [length] per unit of each variable, or NULL. hm_combine takes the matrix unchanged. Control points that no curve of
 * the section uses do not move. Refused, outputs unchanged: a variable that moves nothing, or that is a combination of
 * those before (HM_BAD_CONDITION, item: the variable, from 0). */
HM_API hm_status hm_variables_map(const hm_curves *curves, const hm_section *section, const hm_variables *variables,
                                  void *work, size_t bytes, double *matrix, double *error, hm_error *err);

/* ---- Problem: what is to be solved ---- */

enum {                             /* hm_condition.kind; for a point on several markers the first of these kinds holds:
                                      on curve, rigid, given, fixed, slip, free */
    HM_ON_CURVE = 0,               /* F_i = N_i(u) */
    HM_RIGID = 1,                  /* a body that only translates, rotates and scales, see hm_morph */
    HM_FIXED = 2,                  /* F_i = 0; also every marker without a condition */
    HM_SLIP = 3,                   /* points slide along the boundary: along straight lines, or along the smooth curve
                                      through the points of the marker (see hm_slide), or along B-splines that are given
                                      (hm_condition.along). Without these, a marker may have several of
                                      both; where they meet at a corner, the point is fixed. A corner: the direction of
                                      the boundary jumps by more than 30 degrees, or by more than 1.1 degrees and 2.5
                                      times as much as at a neighbouring point */
    HM_FREE = 4,                   /* zero normal derivative: points may also leave the boundary line */
    HM_PERIODIC_PAIR = 5,          /* this marker and its partner are translates of each other:
                                      their points move by bitwise identical displacements. A wall that moves may not
                                      have a point on them: give its part next to them a marker of its own, fixed or
                                      sliding */
    HM_GIVEN = 6,                  /* the points move by displacements that are given from call to call (hm_displace).
                                      The functions of curves and rigid bodies are 0 there */
    HM_ROTATION_PAIR = 7           /* one passage of a cascade in an annulus: the partner is this marker, turned about
                                      the centre (x, y) by an angle that is found from the points. The displacement of
                                      each point of the partner is that of its image on this marker, turned by the same
                                      angle: the mesh of all passages moves as one. A point on the centre does not
                                      move. Several pairs turn about one centre by one angle, in either sense.
                                      Not beside HM_PERIODIC_PAIR */
};

typedef struct hm_condition {
    uint64_t struct_size;          /* the same in all conditions of one problem */
    int32_t  marker;
    int32_t  kind;                 /* HM_ON_CURVE, ... */
    int32_t  first_curve;          /* on curve: each point lies on one of the curves first_curve ..
                                      first_curve+n_curves-1. Refused: a point that lies on a curve which the condition
                                      does not name; a point that is farther from its curve than the control polygon,
                                      or all points on curves together, are wide or high: the marker is another one's,
                                      or the curve has another unit. Beyond 5 % of that, and beyond the end of a curve
                                      by more than a quarter of a face: HM_FAR_FROM_CURVE */
    int32_t  n_curves;             /* on curve: see first_curve; no default. A section with a blunt base has two curves
                                      (hm_fit): n_curves is curves->n_curves. slip: the number of curves in `along` */
    int32_t  body;                 /* rigid: number of the body, from 0 without gaps;
                                      several markers may form one body */
    int32_t  partner;              /* pairs: the other marker of the pair, which has no condition of its own */
    double   x, y;                 /* rigid, rotation: the centre of rotation [length] */
    int32_t  piece;                /* 0: all faces of the marker that no other condition chooses as a piece.
                                      1: one piece of the marker, the one nearest to (near_x, near_y). Pieces are runs
                                      of faces of one marker, one after the other along the boundary: each of several
                                      bodies, or each side of a channel. Not for pairs */
    int32_t  reserved;             /* 0 */
    double   near_x, near_y;       /* piece: a point near it, at the start coordinates [length] */
    const hm_curves *along;        /* slip: the curves along which the points slide, all of this set; NULL (n_curves 0):
                                      the polyline of the marker, made smooth: straight lines, or the smooth curves
                                      through its points (see hm_slide). The control points of the curves do not move
                                      and have no functions. Each piece of the boundary between two corners slides along
                                      the curve that is nearest to all of its points; a point that is not on the curve
                                      keeps its offset. Corners, where a point is fixed, are the points nearest to the
                                      ends of open curves and to the corner of closed ones, and where another marker
                                      begins that slides, unless that marker has the same `along`. Refused
                                      (HM_BAD_CONDITION): a point farther from the curve than 5 % of the length of its
                                      piece of the boundary, and a corner in the middle of a curve. Read by
                                      hm_analysis_size and hm_analysis_init, not needed afterwards. A basis does not
                                      keep these curves: hm_basis_conditions gives n_curves and NULL, which is refused
                                      as a condition until `along` is set again.
                                      Not for meshes in parts (HM_UNSUPPORTED) */
} hm_condition;
/* Fields that belong to another kind must be 0; otherwise HM_BAD_CONDITION, error.item: the condition, from 0. A marker
 * has at most one condition without a piece; pieces without any condition are fixed. Refused (HM_BAD_CONDITION): a
 * piece that two conditions choose, and a condition that other ones leave no piece for. */

typedef struct hm_problem {
    uint64_t struct_size;
    const hm_mesh *mesh;
    const hm_curves *curves;       /* NULL, no rigid body and no marker with HM_GIVEN: the analysis covers the mesh only
                                      (hm_analysis_report, hm_analysis_boundary) */
    int32_t  n_conditions;         /* at least one condition is on a curve, rigid or given */
    const hm_condition *conditions; /* [n_conditions] */
    int32_t  n_given;              /* curve points with a given parameter;
                                      the parameters of the others are found by projection */
    const int32_t *given_points;   /* [n_given] */
    const int32_t *given_curves;   /* [n_given] */
    const double  *given_u;        /* [n_given] */
} hm_problem;

/* Available combinations (all others: HM_UNSUPPORTED). The value of a function at a point is a linear map of the plane:
 * 1, 2 or 4 numbers (hm_basis_info.numbers_per_value). With rigid bodies "real" becomes "complex". With
 * HM_ROTATION_PAIR all values are complex, and the combinations are those of HM_COMPACT and HM_DIRECT, without slip;
 * not for meshes in parts (harmorph_distributed.h).
 *   operator      scheme                   engine         conditions      values
 *   HM_CONFORMAL  HM_COMPACT               HM_DIRECT      all but free    complex; with slip 2 x 2 matrices
 *   HM_LAPLACE    HM_COMPACT               HM_DIRECT      all             real; with slip 2 x 2 matrices
 *   HM_WEIGHTED   HM_COMPACT               HM_DIRECT      all             real; with slip 2 x 2 matrices
 *   HM_LAPLACE    HM_BOUNDED               HM_DIRECT      all but slip    real
 *   HM_WEIGHTED   HM_BOUNDED               HM_DIRECT      all but slip    real
 *   HM_LAPLACE    HM_COMPACT               HM_MULTIGRID   all             real; with slip 2 x 2 matrices
 *   HM_WEIGHTED   HM_COMPACT               HM_MULTIGRID   all             real; with slip 2 x 2 matrices
 *   HM_LAPLACE    HM_COMPACT               HM_FAS         all but slip    real
 *   HM_WEIGHTED   HM_COMPACT               HM_FAS         all but slip    real
 *   HM_LAPLACE    HM_NODAL_GRADIENT        HM_DIRECT      no slip/given   real
 *   HM_LAPLACE    HM_NODAL_GRADIENT        HM_FAS         no slip/given   real
 *   HM_LAPLACE    HM_NODAL_GRADIENT_PLAIN  HM_FAS         no slip/given   real
 *
 * The weight of an operator is k = 1 / d^q. d is the distance from the barycentre of a cell to the nearest face on a
 * curve or a rigid body (or on the periodic or turned image of one), divided by the extent of these faces. Cells near
 * the moving boundary are stiff and preserve their shape; cells far away deform. */
enum {                             /* operator_kind */
    HM_CONFORMAL = 0,              /* minimises the integral of k |f_x + i f_y|^2 over complex functions f: the maps
                                      closest to angle-preserving ones. Angles at the wall are preserved, heights of the
                                      first layer scale with the stretch of the wall. Movements may be about 20 times
                                      larger than with HM_LAPLACE. Every boundary point must be prescribed: with a free
                                      boundary the problem is ill-posed */
    HM_LAPLACE = 1,                /* minimises the integral of |grad F|^2: the harmonic functions of the paper */
    HM_WEIGHTED = 2                /* minimises the integral of k |grad F|^2 */
};
enum { HM_NO_WEIGHT = -1 };        /* exponent_quarters: k = 1. The conformal functions are then those of HM_LAPLACE */
enum {                             /* scheme: discretisation of the fluxes; all schemes reproduce linear fields */
    HM_COMPACT = 0,                /* median dual, cell gradients: second order. Recommended */
    HM_BOUNDED = 2,                /* compact scheme on the constrained Delaunay triangulation of the mesh points (edges
                                      are flipped; points and boundary remain; the weight is taken at the midpoint of an
                                      edge). 0 <= F <= 1 if every boundary is fixed or on a curve. Edges on free
                                      boundaries and periodic pairs are not flipped: there the bound may fail, and the
                                      functions depend, within the discretisation error, on where a periodic mesh is
                                      cut. The plan can only be factored on the analysed coordinates */
    HM_NODAL_GRADIENT = 1,         /* the paper's scheme: Green-Gauss gradients over the cells around each point; the
                                      flux through a face uses the mean of the gradients of its two points, with the
                                      component along the edge replaced by the difference of the values. Second order;
                                      for comparison. Errors on 128 x 128 squares 4.1e-5 (compact: 1.1e-5), on
                                      perturbed ones 3.0e-5 (3.7e-5), on perturbed triangles 3.8e-5 (4.5e-5). On
                                      airfoil meshes, viscous ones too, the functions differ from the compact scheme by
                                      1e-3 to 7e-3 at edges of the airfoil and by 1e-4 on average; by 0.2 where few
                                      points surround an edge in cells with aspect ratios of 1e4 */
    HM_NODAL_GRADIENT_PLAIN = 3    /* the same without that replacement, as in the text of the paper; only to reproduce
                                      the paper. Odd-even oscillations are not damped: errors 2.3e-4 on those squares,
                                      and 2e-2 on perturbed ones, where the errors do not decrease with refinement. 500
                                      to 2000 cycles on isotropic meshes. On viscous meshes it mostly does not converge
                                      (HM_NOT_CONVERGED), because eigenvalues may have the wrong sign: values left [0,
                                      1] by 0.3 on one mesh and grew without limit on another */
};
enum {                             /* engine */
    HM_DIRECT = 0,                 /* nested dissection and multifrontal Cholesky factorisation; the fastest.
                                      With HM_NODAL_GRADIENT the factor of the compact scheme preconditions BiCGStab:
                                      3 to 13 steps on airfoil meshes */
    HM_MULTIGRID = 1,              /* conjugate gradients, preconditioned by agglomeration multigrid. 15 to 35
                                      iterations for any mesh size and any stretching. Plan and analysis take 730 bytes
                                      per point, 500 with block_width 4; HM_DIRECT takes 840 bytes per point for
                                      10 000 points, 1090 for a million */
    HM_FAS = 2                     /* the paper's iteration: pseudo-time stepping with an explicit four-stage
                                      Runge-Kutta scheme, local time steps and the full approximation scheme on
                                      agglomerated levels, started on the coarsest level (FMG-FAS); with one level:
                                      Runge-Kutta alone. The slowest engine; for comparison with the paper */
};
enum {                             /* agglomeration: which cells are merged */
    HM_AGGLOMERATE_AUTO = 0,       /* along the strong couplings where the aspect ratio exceeds 2,
                                      otherwise in any direction */
    HM_AGGLOMERATE_ISOTROPIC = 1,  /* those with the most mesh edges between them, for any aspect ratio: for comparison.
                                      On viscous meshes HM_MULTIGRID may not converge: on one of two meshes the residual
                                      was 3e-5 after 200 iterations, where the automatic rule needs 29 iterations;
                                      on the other mesh this rule takes 28 iterations, the automatic one 22 */
    HM_AGGLOMERATE_DIRECTIONAL = 2 /* always the most strongly coupled ones */
};

enum {                             /* start of HM_FAS */
    HM_START_COARSEST = 0,         /* solved on the coarsest level, then on the next finer one, and so on (FMG) */
    HM_START_ZERO = 1
};

enum {                             /* precision; HM_SINGLE is available with HM_DIRECT in all its combinations */
    HM_DOUBLE = 0,
    HM_SINGLE = 1                  /* the factor takes half the memory, the plan 0.6 times the memory; no time is saved.
                                      The functions have the accuracy of HM_DOUBLE: refinement reduces the estimated
                                      error to 1e-10 of the largest value, in 2 steps of one solve each, or 3 where
                                      first cells have a relative height of 1e-5 or thin cells lie far from the wall.
                                      Cells too thin: HM_NOT_CONVERGED with the error in error.value, or HM_NOT_POSITIVE
                                      (hm_plan_factor). HM_UNSUPPORTED: bodies not in 1e-12 .. 1e24, sums beyond 1e36 */
};
enum {                             /* phases, in the order in which they are reported */
    HM_PHASE_STRUCTURE = 0, HM_PHASE_ORDERING = 1, HM_PHASE_SYMBOLIC = 2,   /* hm_analysis_init */
    HM_PHASE_ASSEMBLY = 3, HM_PHASE_FACTOR = 4,                             /* hm_plan_factor */
    HM_PHASE_SOLVE = 5, HM_PHASE_RESIDUAL = 6                               /* hm_plan_solve */
};
/* Called at the start of each phase (fraction 0), sometimes in between, and at the end (1). A return value other than
 * 0 stops the call: HM_CANCELLED. */
typedef int32_t (*hm_progress)(void *user, int32_t phase, double fraction);

typedef struct hm_options {
    uint64_t struct_size;
    int32_t  operator_kind;        /* default HM_CONFORMAL */
    int32_t  scheme;               /* default HM_COMPACT */
    int32_t  engine;               /* default HM_DIRECT */
    int32_t  kernel;               /* HM_KERNEL_...: vector instructions of the plan; choose one for equal bits on
                                      different processors. HM_KERNEL_AUTO: executor.kernel, if given, otherwise the
                                      best that the processor has. A kernel that the processor lacks: HM_UNSUPPORTED */
    double   tolerance;            /* [-] relative residual above which hm_plan_solve warns; 0 means 1e-10. Iterative
                                      engines continue until the relative residual is below the tolerance and the
                                      estimated error of the values is about tolerance times the largest value. With
                                      thin cells a small residual does not guarantee accurate values, and with very thin
                                      cells the residual may be large although the solution is accurate. HM_DIRECT
                                      therefore does not warn if, in every row, the residual is no more than rounding of
                                      the fluxes of that row and refinement estimates an error below the tolerance;
                                      HM_NODAL_GRADIENT is excepted */
    hm_progress progress;          /* NULL: none; always called on the thread that made the call */
    void    *progress_user;
    const hm_executor *executor;   /* NULL: one thread. The struct is copied, but the object that executor.user
                                      points to must exist as long as analysis and plan */
    int32_t  exponent_quarters;    /* 4 q of the weight, 1 .. 16, or HM_NO_WEIGHT;
                                      0 means 6 for HM_CONFORMAL, 4 for HM_WEIGHTED */
    int32_t  offset_correction;    /* 0 or 1; conformal only. 1: boundary functions N_i + e N_i' / C', e the offset of
                                      the mesh point from the curve, so that the offset rotates with the curve: rigid
                                      motions of all control points then move every wall point rigidly; other motions
                                      add e dC' / C'. Omitted at corners and where |e| sum_i |N_i'| >= |C'|,
                                      for instance where C' vanishes */
    /* HM_MULTIGRID and HM_FAS only; with another engine a value other than 0 is HM_UNSUPPORTED: */
    int32_t  levels;               /* largest number of levels including the finest, 1 .. 20; 0: as many as possible,
                                      about 5 for 10 000 points, 9 for a million. HM_FAS does not solve the coarsest
                                      level exactly: the more cells that level has, the more cycles are needed */
    int32_t  agglomeration;        /* HM_AGGLOMERATE_... */
    int32_t  block_width;          /* functions solved at a time: 4, 8 or 16; 0 means 8. Plan memory for the vectors of
                                      each thread: 56 bytes per unknown and function of a block */
    int32_t  max_iterations;       /* then HM_NOT_CONVERGED (HM_FAS: also when a residual has grown by a factor of
                                      1000); 0 means 200; HM_FAS: 2000 cycles, or with one level 200000 steps */
    double  *history;              /* [history_length] largest relative residual of all functions before the first
                                      iteration and after each, up to report.iterations. NULL: not wanted.
                                      The array must exist as long as the plan */
    int32_t  history_length;
    int32_t  precision;            /* HM_DOUBLE (default) or HM_SINGLE: of the factor; HM_DIRECT only */
    int32_t  start;                /* HM_START_...: HM_FAS only */
    int32_t  reserved;             /* 0 */
} hm_options;

/* ---- Analysis: everything that does not depend on numerical values ---- */

typedef struct hm_analysis hm_analysis;

typedef struct hm_mesh_report {
    uint64_t struct_size;
    int32_t  points, used_points, cells, triangles, quads, edges, boundary_edges, boundary_loops;
    int32_t  inverted;             /* inverted cells (see CONVENTIONS) */
    int32_t  first_inverted;       /* the first inverted cell; -1: none */
    double   min_area;             /* [length^2] smallest signed corner area */
    double   min_quality, mean_quality; /* [0..1] skew quality, see hm_quality */
    int32_t  polygons, reserved;   /* cells that are divided into triangles, see hm_mesh;
                                      they are in neither `triangles` nor `quads` */
} hm_mesh_report;

/* Bytes from the counts alone (points, cells, faces, control points). options NULL: defaults. */
HM_API hm_status hm_analysis_size(const hm_problem *problem, const hm_options *options, size_t *bytes, hm_error *err);
/* Checks all input, numbers the unknowns and finds the parameters of the curve points. Ordering and symbolic
 * factorisation use the threads of options.executor. A mesh with inverted cells is refused, unless problem.curves is
 * NULL and there is no rigid body: then hm_analysis_report counts the inverted cells. */
HM_API hm_status hm_analysis_init(hm_analysis **analysis, void *block, size_t bytes, const hm_problem *problem,
                                  const hm_options *options, hm_error *err);
HM_API hm_status hm_analysis_report(const hm_analysis *analysis, hm_mesh_report *report, hm_error *err);
/* The points of the given markers in order along the boundary, with the mesh on the left (around a body: clockwise). If
 * the markers form several pieces, `piece` (from 0) selects one. points [capacity]; *n: number of points, also if the
 * capacity is too small (HM_BAD_ARGUMENT); *is_loop: 1 if the piece is closed; the first point is not repeated. */
HM_API hm_status hm_analysis_boundary(const hm_analysis *analysis, int32_t n_markers, const int32_t *markers,
                                      int32_t piece, int32_t *points, int32_t capacity, int32_t *n, int32_t *is_loop,
                                      hm_error *err);

/* ---- Plan and basis ---- */

typedef struct hm_plan hm_plan;
typedef struct hm_basis hm_basis;

/* The analysis must have curves, rigid bodies or markers with HM_GIVEN; with the latter alone, the basis has no
 * functions, and serves hm_quality, hm_admissible_step and hm_assess. The plan and the basis copy what they need from
 * the analysis. */
HM_API hm_status hm_plan_size(const hm_analysis *analysis, size_t *bytes, hm_error *err);
HM_API hm_status hm_plan_init(hm_plan **plan, void *block, size_t bytes, const hm_analysis *analysis, hm_error *err);
HM_API hm_status hm_basis_size(const hm_analysis *analysis, size_t *bytes, hm_error *err);
HM_API hm_status hm_basis_init(hm_basis **basis, void *block, size_t bytes, const hm_analysis *analysis, hm_error *err);

/* Assembles and factors the matrix with the coordinates `at` of the mesh points (NULL: the mesh's own coordinates); the
 * ordering and the symbolic factorisation are reused. A failed or cancelled call leaves the plan without a factor.
 * Refused (HM_BAD_MESH): a coordinate that is not finite or larger than 1e100, a cell that is inverted at `at`. */
HM_API hm_status hm_plan_factor(hm_plan *plan, const hm_points *at, hm_error *err);

typedef struct hm_solve_report {
    uint64_t struct_size;
    int32_t  unknowns, functions;
    double   residual;             /* [-] largest |b - A F| / |b| of all functions, 2-norms; see options.tolerance */
    int32_t  residual_function;    /* the function with that residual */
    int32_t  boundary_error_point; /* the point with the boundary error below */
    double   boundary_error;       /* [-] largest |F_i - N_i(u)| on the curves, with N_i evaluated again */
    double   partition_defect;     /* [-] largest |sum_i F_i - 1| on the curves */
    double   min_value, max_value; /* [-] of all F_i of control points */
    double   max_distance;         /* [length] largest distance of a curve point from the curve.
                                      The morph preserves this offset between mesh and fit */
    int32_t  max_distance_point;
    int32_t  curve_points;         /* mesh points on curves */
    int32_t  refinements;          /* steps of iterative refinement, done because of the residual or of thin cells */
    int32_t  reserved;             /* 0 */
    int64_t  factor_entries;       /* numbers in the factor; 0: the engine has no factor */
    int32_t  iterations;           /* iterative engines: largest number of all functions.
                                      HM_DIRECT: 0, or the steps of BiCGStab for HM_NODAL_GRADIENT */
    int32_t  levels;               /* of agglomeration */
    int32_t  fine_sweeps;          /* sweeps over the finest level, largest number of all functions: symmetric
                                      Gauss-Seidel sweeps or Runge-Kutta steps */
    int32_t  reserved_too;         /* 0 */
} hm_solve_report;

/* Solves for all functions of the basis with the factor of the plan. Both must come from the same analysis. report may
 * be NULL. Cancelled: the basis counts as not solved; the factor remains valid. */
HM_API hm_status hm_plan_solve(hm_plan *plan, hm_basis *basis, hm_solve_report *report, hm_error *err);

/* The agglomeration, after hm_plan_factor with an engine that has levels: cells [n_points] receives the merged cell,
 * from 0, that contains the control volume of each point on a level (0: the finest); -1 for points with known values.
 * Where points slide, movements along x and y are merged separately; cells are those of the first component.
 * *n_cells: the number of merged cells. Refused if the level does not exist. */
HM_API hm_status hm_plan_level(const hm_plan *plan, int32_t level, int32_t *cells, int32_t *n_cells, hm_error *err);

/* A basis is one block without pointers: write the block to a file unchanged (hm_basis_info.bytes), read or map the
 * file, and attach. The block must be aligned to 8 bytes. Refused with the reason: not a basis, another format version
 * or byte order, truncated, damaged (checksum), of a mesh with other cells or with other points on the markers. mesh
 * NULL: not compared. HM_MOVED: the same mesh with other coordinates. */
HM_API hm_status hm_basis_attach(const hm_basis **basis, const void *block, size_t bytes, const hm_mesh *mesh,
                                 hm_error *err);

typedef struct hm_basis_info {
    uint64_t struct_size;
    uint64_t bytes;                /* of the block, from the address of the basis */
    int32_t  solved;               /* 0 or 1 */
    int32_t  points, cells, functions, curves, curve_points; /* curve_points: including rigid and given ones */
    int32_t  numbers_per_value;    /* 1: real f; 2: complex a + i b; 4: matrix xx, xy, yx, yy */
    int32_t  operator_kind, scheme, engine;
    int32_t  index_base;           /* of the mesh that the basis was solved on:
                                      the first number of points and cells in reports */
    const int32_t *curve_point;    /* [curve_points] mesh points on curves, counted from 0 */
    const int32_t *point_curve;    /* [curve_points] the curve of each of them; curves + b: rigid body b;
                                      curves + bodies: a point of a marker with HM_GIVEN */
    const double  *point_u;        /* [curve_points] the parameter of each of them */
    int32_t  exponent_quarters;    /* 0: no weight */
    int32_t  bodies;               /* rigid bodies; functions = control points + 2 * bodies, see also below */
    int32_t  offset_correction;    /* 0 or 1 */
    int32_t  storage;              /* HM_DOUBLE, or HM_SINGLE: see hm_single_init */
    int32_t  combined;             /* functions of design variables (hm_combine); 0: those of the control points */
    int32_t  control_points;       /* functions = (combined, or control_points where that is 0) + 2 * bodies + modes */
    int32_t  modes;                /* functions by table (hm_tabulate) */
    int32_t  reserved;             /* 0 */
} hm_basis_info;
HM_API hm_status hm_basis_info_get(const hm_basis *basis, hm_basis_info *info, hm_error *err);
/* The curves that the basis was solved with (index_base 0). curve [capacity >= info.curves] receives the curves, and
 * out->curve points to this array. All other arrays are inside the basis. */
HM_API hm_status hm_basis_curves(const hm_basis *basis, hm_curves *out, hm_curve *curve, int32_t capacity,
                                 hm_error *err);
/* The same curves after a movement: control [2*n_control] receives the control points plus `move` (see hm_morph; rigid
 * bodies have no curve), and out->control points to this array of the caller. The rest is as in hm_basis_curves. */
HM_API hm_status hm_moved_curves(const hm_basis *basis, const double *move, double *control, hm_curves *out,
                                 hm_curve *curve, int32_t capacity, hm_error *err);
/* The conditions that the basis was solved with: out [capacity], with out[0].struct_size set; *n: number of conditions,
 * also if the capacity is too small (HM_BAD_ARGUMENT). Curves, conditions and parameters together restore the
 * problem, but for the curves `along` of sliding boundaries. */
HM_API hm_status hm_basis_conditions(const hm_basis *basis, hm_condition *out, int32_t capacity, int32_t *n,
                                     hm_error *err);
/* values [n_points]: one of the numbers_per_value numbers of one function; function and number are counted from 0. */
HM_API hm_status hm_basis_values(const hm_basis *basis, int32_t function, int32_t number, double *values,
                                 hm_error *err);

/* ---- Functions in single precision ---- */

/* A second basis with the same functions in single precision, in half the memory. hm_morph and hm_adjoint are
 * limited by reading the basis; if the basis fits in no cache, hm_morph is 1.5 to 1.9 times faster with AVX-512
 * or AVX2, 1.4 times without either; hm_adjoint, which computes more, gains with AVX-512 only: 1.4 to 1.8 times. The
 * first basis must be solved and have all functions (it may be an extract); it is no longer needed afterwards. Points
 * on curves and rigid bodies, and points joined to them by a cut, keep F in double precision: the wall moves bitwise as
 * with the first basis. Fixed points do not move. Elsewhere |F' - F| <= 2^-24 |F| for each number (below 2^-126:
 * 2^-150), so that a displacement differs by at most 2^-24 sum_i |F_i| |dP_i| plus rounding of the sum; the functions
 * sum to 1, and points slide along inclined lines, to that accuracy. Products and sums are in double precision, and
 * hm_adjoint is the transpose of hm_morph as accurately as in double precision; bitwise identical for any threads,
 * kernel and partition. The new basis is written, attached, extracted from and used like any basis. Calls that need F
 * in double precision return HM_UNSUPPORTED: hm_plan_solve, hm_transfer, hm_morph_safe, hm_combine,
 * hm_tabulate, parcels, hm_single_size. */
HM_API hm_status hm_single_size(const hm_basis *basis, size_t *bytes, hm_error *err);
HM_API hm_status hm_single_init(hm_basis **single, void *block, size_t bytes, const hm_basis *basis, hm_error *err);

/* ---- Combined functions: one for each design variable ---- */

/* A second basis with n functions F M, n >= 1: function j carries variable j, which moves control point i by M_ij times
 * itself. matrix [controls * n * numbers] with the n values of control point 0 first; controls = functions - 2 * bodies
 * - modes of the given basis; numbers 1: real values, 2: pairs x,y, complex numbers (those of hm_variables_map). Rigid
 * bodies and modes keep their functions behind the n. Points are moved, gradients formed, and curves moved
 * (hm_moved_curves) by variables instead of control points; the basis has the memory of n functions, and the first
 * basis is no longer needed. Values are real if those of the first basis and the matrix are. A variable whose matrix is
 * not real, or a function that is not, turns with its movement: variables that are one number v move by (v, 0).
 * The new basis is used, solved again (hm_plan_solve, on moved coordinates too), extracted, sent in parcels, written,
 * attached, stored in single precision and combined like any basis. Only hm_transfer refuses it, with HM_UNSUPPORTED:
 * transfer the functions of the control points, and combine those. The first basis must be solved, complete and in
 * double precision. Refused with HM_BAD_CONDITION, item: the column, from 0: a column that is zero, or a combination of
 * the columns before; with HM_BAD_ARGUMENT a matrix that is not finite. */
HM_API hm_status hm_combine_size(const hm_basis *basis, int32_t n, int32_t numbers, size_t *bytes, hm_error *err);
HM_API hm_status hm_combine(hm_basis **combined, void *block, size_t bytes, const hm_basis *basis, int32_t n,
                            int32_t numbers, const double *matrix, hm_error *err);

/* ---- Coarse to fine: functions solved on one mesh, interpolated to the points of a finer mesh of the same domain  */

typedef struct hm_transfer_report {
    uint64_t struct_size;
    int32_t  points;               /* interpolated points: neither on a curve nor fixed */
    int32_t  outside;              /* interpolated points and curve points that are outside the coarse mesh */
    double   max_distance;         /* [length] largest distance of those points from the coarse mesh */
    int32_t  max_distance_point;   /* the point with that distance; -1: none is outside */
    int32_t  boundary_error_point; /* the point with the boundary error below */
    double   boundary_error;       /* [-] largest |F_i - N_i(u)| on the curves, with N_i evaluated again */
    double   wall_correction;      /* [-] the same before N_i was restored:
                                      how well the coarse mesh resolves the functions */
} hm_transfer_report;

/* Bytes of working memory. The fine analysis must have the curves, conditions and options of the coarse basis. */
HM_API hm_status hm_transfer_size(const hm_analysis *analysis, const hm_mesh *coarse_mesh, size_t *bytes,
                                  hm_error *err);
/* Fills a basis that was made from the fine analysis; no plan is needed. A point receives the values of the coarse cell
 * that contains the point. A point beyond a curved boundary receives the linear extrapolation of the nearest cell; if
 * the point is farther away than half the longest side of that cell, the call is refused (HM_BAD_MESH, error.item: the
 * point, error.value: the distance). Curve points receive N_i(u), and points nearer to them than one coarse cell are
 * corrected with them; fixed points receive 0; sliding points remain on their lines. Second order in the coarse
 * spacing, exact for linear functions. Uses the threads of the analysis. After a refused call the basis is not solved.
 * report may be NULL. */
HM_API hm_status hm_transfer(hm_basis *basis, void *block, size_t bytes, const hm_analysis *analysis,
                             const hm_basis *coarse, const hm_mesh *coarse_mesh, hm_transfer_report *report,
                             hm_error *err);

/* ---- Morph ---- */

/* to = from + sum_i F_i (dx, dy)_i at each point. move [2*functions] contains the dx,dy pairs of the control points
 * [length], then for each rigid body two pairs: the translation dx,dy [length], and s - 1, where s = scale * (cos a,
 * sin a) and a is the counter-clockwise angle of rotation. The points z of the body move exactly to c + s (z - c) +
 * (dx, dy), c the centre of rotation. `to` may be the arrays of `from` with the same stride; otherwise `to` and `from`
 * must have no number in common (refused where the strides are equal). Points with a displacement of 0 keep their
 * coordinates bit by bit. from NULL: taken as 0, so that `to` receives displacements, or velocities if `move` contains
 * velocities of the control points. executor NULL: one thread. */
HM_API hm_status hm_morph(const hm_basis *basis, const double *move, const hm_points *from, const hm_points_out *to,
                          const hm_executor *executor, hm_error *err);
/* The transpose of hm_morph. dj: derivatives of an objective J with respect to the mesh points (x: dJ/dx_k, y:
 * dJ/dy_k); gradient [2*functions]: those with respect to the control points. The result does not depend on the
 * numbering of the mesh points, see hm_adjoint_scale. If a number is not finite, the whole gradient is NaN. */
HM_API hm_status hm_adjoint(const hm_basis *basis, const hm_points *dj, double *gradient, const hm_executor *executor,
                            hm_error *err);
/* Largest difference [length] on the curves between the displacement of the points, to - from, and that of the
 * B-spline. *point: where; point may be NULL. */
HM_API hm_status hm_boundary_error(const hm_basis *basis, const double *move, const hm_points *from,
                                   const hm_points *to, double *error, int32_t *point, hm_error *err);

/* ---- Points that slide along curves ---- */

/* On a straight line the functions keep sliding points (HM_SLIP) on the line. On a curve they move each point along its
 * tangent: hm_morph, hm_displace and their transposes stay linear, and a movement by d leaves the point about
 * d^2 / (2 R) beside the curve, R the radius of curvature. hm_slide puts these points onto the curve, at the nearest
 * place, and moves inner points along, the less the nearer they are to other boundaries. Points on other boundaries
 * keep their bits. hm_morph_safe and hm_displace_safe do so in each of their steps, so all of their checks see the
 * points on the curve; after hm_morph or hm_displace, call hm_slide before hm_quality.
 * The curve is given (hm_condition.along), or goes through the marker's points where the analysis had them: cubic
 * segments whose tangents are those of circles through three neighbouring points; straight on behind the ends. Of a
 * given curve, eight cubic segments for each face have its places and tangents. A point of a circle with 24 faces stays
 * on the circle to 1e-7 of the radius. hm_plan_factor with `at` takes the tangents at the nearest places of the same
 * curve.
 * to [n_points] may be the arrays of from. Points of a cut or a periodic pair move by the same displacements.
 * Refused (HM_BAD_MESH): a coordinate of a sliding point that is not finite or larger than 1e100. */
HM_API hm_status hm_slide(const hm_analysis *analysis, const hm_points *from, const hm_points_out *to, hm_error *err);
/* The transpose of the derivative of hm_slide: from derivatives dj by the points after hm_slide, to derivatives dj_from
 * by those before it, `from`. For the gradient of an objective of the mesh after hm_morph and hm_slide:
 * hm_slide_adjoint, then hm_adjoint. dj_from may be the arrays of dj. */
HM_API hm_status hm_slide_adjoint(const hm_analysis *analysis, const hm_points *from, const hm_points *dj,
                                  const hm_points_out *dj_from, hm_error *err);

/* ---- Given displacements: wall points as a structural code, a CAD system or a table has them ---- */

/* Points of markers with HM_GIVEN move as each call says; no functions are needed. The displacement of the mesh is one
 * substitution with the factor of the plan, so a time step costs a small part of hm_plan_factor: factor once, displace
 * as often as wished. To decide whether a mesh is still good enough: hm_assess with a basis of the same analysis, which
 * need not be solved, tells the admissible step and the quality at the target. If the admissible step is no longer well
 * above 1, or the quality has fallen, move the mesh to the last good position, factor there (hm_plan_factor with `at`;
 * ordering and symbolic factorisation are reused), and give displacements from that position on.
 *
 * Displacements are linear: velocities of wall points give velocities of mesh points. Points on curves, rigid bodies
 * and fixed markers stay where they are. Where curves and bodies move in the same step, move them first, by hm_morph,
 * and give the result as `from`: then the boundary is judged where everything has moved.
 *
 * The wall points of a call are listed in `points` [n] in any order, counted from mesh.index_base; NULL: in the order
 * of hm_given_points, and n is their number. All points of the markers with HM_GIVEN must be there. A point may stand
 * in the list twice, and so may the two sides of a cut, with equal displacements: lists of several processes can be put
 * together. On a point of several markers the first of these conditions holds: on curve, rigid, given; only in the last
 * case the point belongs to the list. */

/* Of the mesh that the plan was made from. */
HM_API hm_status hm_plan_points(const hm_plan *plan, int32_t *n_points, int32_t *index_base, hm_error *err);
/* The wall points with given displacements, in order along the boundary with the mesh on the left. points [capacity];
 * *n: number of points, also if the capacity is too small (HM_BAD_ARGUMENT). */
HM_API hm_status hm_given_points(const hm_plan *plan, int32_t *points, int32_t capacity, int32_t *n, hm_error *err);
/* Working memory of hm_displace and hm_displace_adjoint for n_fields fields, 1 .. 2^20: 16 bytes for each mesh point
 * and field, and the same once more for at most 12 fields. */
HM_API hm_status hm_displace_size(const hm_plan *plan, int32_t n_fields, size_t *bytes, hm_error *err);
/* n_fields displacement fields at once, for instance structural modes; up to 12 fields are one substitution. wall
 * [n_fields]: each of n wall points [length]; to [n_fields]: each of n_points mesh points; to = from + displacement,
 * see hm_morph. from NULL: taken as 0, so that `to` receives displacements or velocities. Wall points move by the given
 * bits, and points with a displacement of 0 keep their coordinates bit by bit. Arrays of different fields, and `wall`,
 * must have no number of `to` in common. With `from`, a boundary that crosses itself at `to` is refused (HM_CROSSING,
 * error.item: a point of the face); cells may be inverted (hm_assess). All fields are computed before any is written.
 * report may be NULL; functions are fields there, and what concerns curves is 0. Where nothing cancelled in the factor
 * of HM_DIRECT, the solution is as accurate as the factor, and residuals are computed only for the report, which makes
 * the call half as long again, or more. Otherwise, and with engines that iterate, HM_NOT_CONVERGED as of
 * hm_plan_solve. progress is called for HM_PHASE_SOLVE and HM_PHASE_RESIDUAL of each substitution. */
HM_API hm_status hm_displace(hm_plan *plan, int32_t n, const int32_t *points, int32_t n_fields, const hm_points *wall,
                             const hm_points *from, const hm_points_out *to, void *work, size_t bytes,
                             hm_solve_report *report, hm_error *err);
/* The transpose of hm_displace. dj [n_fields]: derivatives of objectives J with respect to the n_points mesh points (x:
 * dJ/dx_k, y: dJ/dy_k); gradient [n_fields]: those with respect to the displacements of the n wall points, complete
 * where a point stands first in the list and 0 where it is repeated. Exact to rounding with HM_DIRECT, to
 * options.tolerance with the engines that iterate. For work: forces on the mesh points become forces on the wall that
 * do the same work in every displacement. */
HM_API hm_status hm_displace_adjoint(hm_plan *plan, int32_t n, const int32_t *points, int32_t n_fields,
                                     const hm_points *dj, const hm_points_out *gradient, void *work, size_t bytes,
                                     hm_solve_report *report, hm_error *err);

/* ---- Functions by table: modes given at wall points ---- */

/* A second basis: the functions of `basis`, and behind them n_modes functions with given values at the points of the
 * markers with HM_GIVEN: structural modes, modes of a proper orthogonal decomposition, anything linear. They are solved
 * with the plan, as hm_displace solves; an amplitude moves wall point k by its mode times the amplitude. modes
 * [n_modes * n * numbers]: mode by mode, at the n wall points listed in `points` (see hm_displace; NULL: in the order
 * of hm_given_points); numbers 1: real values, which move points along the amplitude (dx, dy); 2: pairs x,y, complex
 * numbers: the amplitude (1, 0) moves the points by (x, y), (0, 1) by the same turned by 90 degrees. Values of the
 * functions are real if those of `basis` and the modes are. move, see hm_morph, has the amplitudes last.
 * The new basis depends on nothing else and is used like any basis: hm_plan_solve solves it again, on moved coordinates
 * too, with the same values at the wall, if it has at most 1024 numbers at a point for its modes. hm_transfer refuses
 * it with HM_UNSUPPORTED, because a table says nothing between its points. `basis` must be of the same analysis as the
 * plan, complete, in double precision, and solved if it has functions. work: working memory of work_bytes. report may
 * be NULL; functions are fields there. Refused with HM_BAD_CONDITION: no marker with HM_GIVEN, a mode that is zero
 * (item: the mode, from 0), a list that is not that of the given points; with HM_BAD_ARGUMENT: values that are not
 * finite. HM_NOT_CONVERGED as of hm_plan_solve. */
HM_API hm_status hm_tabulate_size(const hm_plan *plan, const hm_basis *basis, int32_t n_modes, int32_t numbers,
                                  size_t *bytes, size_t *work_bytes, hm_error *err);
HM_API hm_status hm_tabulate(hm_basis **tabulated, void *block, size_t bytes, hm_plan *plan, const hm_basis *basis,
                             int32_t n, const int32_t *points, int32_t n_modes, int32_t numbers, const double *modes,
                             void *work, size_t work_bytes, hm_solve_report *report, hm_error *err);

/* ---- Three-dimensional codes with two-dimensional meshes ---- */

/* For solvers that have three dimensions only, and meshes one cell thick. The library finds the mesh of one symmetry
 * plane, and which point of that plane each point follows; analysis, plan and basis are those of the plane's mesh.
 * Points may form any number of layers: a plane mesh that was extruded by several cells is treated in the same way.
 *
 *   HM_PLANES   the layers are parallel planes of any direction, and each is the plane's mesh, translated along the
 *               normal
 *   HM_WEDGE    the layers are the plane's mesh, turned about an axis that lies in its plane and does not cross the
 *               mesh; points on the axis belong to all layers
 *
 * Coordinates of the plane: x-y if the normal is z, x-z if the normal is y, y-z if the normal is x, with the bits of
 * the given coordinates; in an inclined plane, right-angled coordinates whose origin is the point nearest to the
 * origin. Wedge: x along the axis, y the distance from the axis. hm_plane_info has the directions. */
enum {                             /* hm_space_mesh.kind */
    HM_SPACE_AUTO = 0,             /* a wedge if the points that no face has lie in one plane inclined to the faces: the
                                      axis is a coordinate axis if one lies in both planes, otherwise the line where the
                                      planes meet; parallel planes otherwise */
    HM_PLANES = 1,
    HM_WEDGE = 2
};

typedef struct hm_space_points {   /* as hm_points, with three coordinates; 32 bytes for ever */
    const double *x, *y, *z;
    int64_t stride;                /* [doubles] from one point to the next, >= 1; 0 means 1 */
} hm_space_points;

typedef struct hm_space_points_out {
    double *x, *y, *z;
    int64_t stride;
} hm_space_points_out;

typedef struct hm_space_mesh {
    uint64_t struct_size;
    int32_t  index_base;           /* 0 or 1: the first number of points, faces and sides in all arrays and reports,
                                      and of the points and cells of the plane's mesh */
    int32_t  n_points;             /* 3 .. 2^30: all points of the mesh of three dimensions */
    hm_space_points points;        /* [n_points] coordinates */
    int32_t  kind;                 /* HM_SPACE_AUTO, HM_PLANES, HM_WEDGE */
    int32_t  n_faces;              /* 1 .. 2^29: the faces in one symmetry plane, of 3 to 1024 points; they are the
                                      cells of the plane's mesh, in this order */
    const int32_t *face_start;     /* [n_faces+1] counted from index_base; NULL: each face has four entries */
    const int32_t *face_points;    /* the points of each face in order;
                                      of four entries, a triangle repeats its last point */
    int32_t  n_sides;              /* faces of the boundary from one layer to the next;
                                      0: none, then the caller adds the boundary to the plane's mesh */
    const int32_t *side_points;    /* [4*n_sides] in order; a triangle, at the axis of a wedge, repeats a point */
    const int32_t *side_markers;   /* [n_sides] any integers: markers of the plane's mesh */
    double   axis_point[3];        /* wedge only: a point of the axis [length] */
    double   axis[3];              /* wedge only: the direction of the axis, of any length;
                                      0,0,0: found (two layers only) */
    double   tolerance;            /* [length] how far a point may be from the place of its plane point, and a point of
                                      a face from the plane; 0 means 1e-5 of the extent of all points. In any case a
                                      point is refused that is farther away than a quarter of the shortest edge at the
                                      plane point */
} hm_space_mesh;

typedef struct hm_plane hm_plane;

/* Bytes from the counts alone: points, faces, corners of faces, sides, and kind. */
HM_API hm_status hm_plane_size(const hm_space_mesh *space, size_t *bytes, hm_error *err);
/* Nothing of `space` is needed afterwards. Where several points of the plane lie at one place (the two sides of a cut,
 * or of a plate without thickness), the points of each layer at that place follow them in the order of their numbers.
 * Refused (HM_BAD_MESH, error.item: the point or side, error.value: the distance): a point of a face outside the plane
 * of the others; a point that is opposite to no point of the plane, as those of a mesh with three dimensions are; a
 * point of the plane that no point of another layer follows; a side with other than two different points of the
 * plane. */
HM_API hm_status hm_plane_init(hm_plane **plane, void *block, size_t bytes, const hm_space_mesh *space, hm_error *err);

typedef struct hm_plane_info {
    uint64_t struct_size;
    int32_t  kind;                 /* HM_PLANES or HM_WEDGE */
    int32_t  n_points;             /* of the plane's mesh */
    int32_t  n_space_points;       /* of the mesh of three dimensions */
    int32_t  layers;               /* the largest number of points that follow one point of the plane, with itself */
    double   origin[3];            /* the point (x, y) of the plane is origin + x * x_direction + y * y_direction */
    double   x_direction[3], y_direction[3], normal[3]; /* unit vectors, right-handed; wedge: x_direction is the axis */
    double   max_distance;         /* [length] largest distance of a point from the place of its plane point */
    int32_t  max_distance_point;   /* the point with that distance; -1: all are exact */
    int32_t  reserved;             /* 0 */
    const int32_t *follows;        /* [n_space_points] the plane point that each point follows,
                                      counted from index_base */
    const int32_t *space_point;    /* [n_points] the point of the faces that is each plane point,
                                      counted from index_base: in increasing order */
} hm_plane_info;
HM_API hm_status hm_plane_info_get(const hm_plane *plane, hm_plane_info *info, hm_error *err);
/* The mesh of the plane, for hm_problem.mesh: coordinates, cells, faces with markers. The arrays are inside the block
 * of the plane and do not change. mesh->struct_size is set by the caller. */
HM_API hm_status hm_plane_mesh(const hm_plane *plane, hm_mesh *mesh, hm_error *err);

/* hm_morph of all points: to = from + the movement of the plane point that each point follows, in the plane; wedge:
 * along the axis and along the radius at the angle that the point had in hm_plane_init. The basis is one of the plane's
 * mesh. Rules for from, to and NULL are those of hm_morph. A coordinate across the layers (of coordinate planes) and
 * points that do not move keep their bits. Writes working arrays of the plane: one thread at a time may call
 * hm_plane_morph or hm_plane_adjoint. */
HM_API hm_status hm_plane_morph(hm_plane *plane, const hm_basis *basis, const double *move, const hm_space_points *from,
                                const hm_space_points_out *to, const hm_executor *executor, hm_error *err);
/* The transpose: dj are derivatives with respect to the three coordinates of all points, gradient [2*functions] as of
 * hm_adjoint. The layers are summed in the order of the numbers of the points. */
HM_API hm_status hm_plane_adjoint(hm_plane *plane, const hm_basis *basis, const hm_space_points *dj, double *gradient,
                                  const hm_executor *executor, hm_error *err);
/* The two steps in between, for displacements from elsewhere (hm_displace, or hm_morph_safe minus the mesh's points):
 * to = from + displacement [n_points] of the plane point that each point follows; and the transpose, dj summed over the
 * layers into `plane_dj` [n_points]. */
HM_API hm_status hm_plane_spread(const hm_plane *plane, const hm_points *displacement, const hm_space_points *from,
                                 const hm_space_points_out *to, const hm_executor *executor, hm_error *err);
HM_API hm_status hm_plane_gather(const hm_plane *plane, const hm_space_points *dj, const hm_points_out *plane_dj,
                                 const hm_executor *executor, hm_error *err);

/* ---- Distributed meshes: several processes, see harmorph_mpi.h ---- */

/* A basis for some points only, for instance those of one process. Point k of the new basis is points[k], counted from
 * the index_base of the mesh, in any order; ghosts and repeated points are allowed. hm_morph, hm_adjoint,
 * hm_boundary_error and hm_basis_values use arrays of n points in that order, and points in reports are positions in
 * the list. A wall point remains a wall point at its first position in the list (or that of the other side of a cut).
 * The new basis has no cells:
 * calls with a mesh refuse it. Like any basis it is one block that depends on nothing else and may be moved. The size
 * is sufficient for any list of n points, n <= 2^30.
 * Made from a basis that has only some functions (hm_share_init), it has to receive its values by hm_parcel_unpack. */
HM_API hm_status hm_extract_size(const hm_basis *basis, int32_t n, size_t *bytes, hm_error *err);
HM_API hm_status hm_extract_init(hm_basis **rows, void *block, size_t bytes, const hm_basis *basis, int32_t n,
                                 const int32_t *points, hm_error *err);

/* Distributes the functions evenly, in order: part k (from 0) of n_parts solves functions *first .. *first + *n - 1,
 * from 0. *n is 0 for some parts if there are more parts than functions. */
HM_API hm_status hm_share_of(const hm_analysis *analysis, int32_t part, int32_t n_parts, int32_t *first, int32_t *n,
                             hm_error *err);
/* A share: a basis with memory for functions first .. first+n-1 only, from 0, n >= 0. hm_plan_solve solves for them,
 * bitwise as for all functions together; the report covers the share, with partition_defect 0. Calls that need all
 * functions (morph, adjoint) refuse a share. The functions keep their numbers, and hm_basis_info.functions counts all
 * functions. */
HM_API hm_status hm_share_size(const hm_analysis *analysis, int32_t first, int32_t n, size_t *bytes, hm_error *err);
HM_API hm_status hm_share_init(hm_basis **share, void *block, size_t bytes, const hm_analysis *analysis, int32_t first,
                               int32_t n, hm_error *err);
/* A parcel carries the values of a share to the rows (hm_extract_init) of another process: doubles [*doubles] for a
 * list of n points. Unpack the parcels of all shares in the order of their functions, each packed for the list that the
 * rows were made with. After the last parcel the rows are solved. */
HM_API hm_status hm_parcel_size(const hm_basis *share, int32_t n, int64_t *doubles, hm_error *err);
HM_API hm_status hm_parcel_pack(const hm_basis *share, int32_t n, const int32_t *points, double *parcel, hm_error *err);
HM_API hm_status hm_parcel_unpack(hm_basis *rows, const double *parcel, int64_t doubles, hm_error *err);

/* hm_adjoint in parts, bitwise identical for any partition: take the largest of the scales of all parts; compute the
 * sums [4 * functions * numbers_per_value] of each part with that scale and add them elementwise; finish with the
 * total. Each mesh point must count in one part only: set dj to 0 at ghosts. Products are rounded once and added as
 * integers, in units of 2^-63 of the scale (a power of two up to 2 max|F| max|dj|): the error is at most 2^-51 sum|F
 * dj| + N 2^-63 max|F| max|dj| for N points, N <= 2^30. hm_adjoint is these three calls. If a number is not finite or a
 * product could overflow, the gradient is NaN. */
HM_API hm_status hm_adjoint_scale(const hm_basis *basis, const hm_points *dj, int32_t *scale,
                                  const hm_executor *executor, hm_error *err);
HM_API hm_status hm_adjoint_sums(const hm_basis *basis, const hm_points *dj, int32_t scale, int64_t *sums,
                                 const hm_executor *executor, hm_error *err);
HM_API hm_status hm_adjoint_finish(const hm_basis *basis, int32_t scale, const int64_t *sums, double *gradient,
                                   hm_error *err);

/* ---- Validity and quality ----------------------------------------------------------------------------------------
 * The mesh must be that of the basis: the same cells with their points in the same order, in any layout, but
 * HM_CELLS_POLYGONS only if the basis is of polygons. Refused (HM_BAD_BASIS): other counts, or other points in one of
 * 64 cells that are compared; hm_basis_attach compares all cells. */

typedef struct hm_step_report {
    uint64_t struct_size;
    double   admissible;           /* [-] largest s for which no cell of from + t displacement is inverted for all t <
                                      s; infinite: no limit; 0: a cell is inverted at `from` */
    int32_t  cell, point;          /* the limiting cell and the point of the limiting corner; -1: none */
} hm_step_report;
/* How far the mesh points can move from `from` (NULL: the mesh's own coordinates) along `displacement` (from hm_morph
 * with from = NULL). Use the same `from` as in the hm_morph that follows: another one has another limit. The result is
 * exact: the area of each corner is a quadratic function of s. */
HM_API hm_status hm_admissible_step(const hm_basis *basis, const hm_mesh *mesh, const hm_points *from,
                                    const hm_points *displacement, const hm_executor *executor, hm_step_report *report,
                                    hm_error *err);

typedef struct hm_quality_report {
    uint64_t struct_size;
    int32_t  inverted, first_inverted; /* number of inverted cells; the first one, or -1 */
    double   min_area;             /* [length^2] smallest signed corner area; minus infinity where an area is
                                      infinite or NaN */
    double   min_quality, mean_quality; /* [0..1] size-skew quality sqrt(f_size) f_skew; 0 for inverted cells */
    int32_t  min_quality_cell;
    int32_t  self_crossing;        /* 1: the boundary crosses itself or another body, or faces coincide.
                                      Two walls that have come into contact count, the two sides of a wall without
                                      thickness do not */
    int32_t  crossing_points[4];   /* first and last point of one face, then of the other; -1: none */
} hm_quality_report;
/* Quality of the mesh at the coordinates `at` (NULL: the mesh's own). f_size = min(t, 1/t), t the area of a cell
 * divided by the area at the coordinates `reference`; reference NULL: f_size = 1. f_skew: Knupp, Finite Elem. Anal.
 * Des. 39 (2003) 217, the shape metric for triangles. Combined as in de Boer, van der Schoot, Bijl, Comput. Struct. 85
 * (2007) 784. */
HM_API hm_status hm_quality(const hm_basis *basis, const hm_mesh *mesh, const hm_points *at, const hm_points *reference,
                            const hm_executor *executor, hm_quality_report *report, hm_error *err);
/* Both in one pass over the cells, before anything moves: the admissible step from `from` (NULL: the mesh's own
 * coordinates) along the displacement, and the quality at from + displacement with `from` as the reference. */
HM_API hm_status hm_assess(const hm_basis *basis, const hm_mesh *mesh, const hm_points *from,
                           const hm_points *displacement, const hm_executor *executor, hm_step_report *step,
                           hm_quality_report *quality, hm_error *err);

/* ---- Large movements that stay valid ---- */

/* Strategies are tried in this order until the mesh is at the target and as good as options.min_quality and
 * options.max_height_change ask for. The best mesh of all is given: the one nearest to the target, and of several at
 * the target the one of better quality.
 *   HM_STRATEGY_LINEAR     x + sum_i F_i dP_i, if the admissible step is larger than 1
 *   HM_STRATEGY_OTHER      the same with other bases that the caller has solved (other operators or exponents), in
 *                          their order
 *   HM_STRATEGY_SUBSTEPS   several steps, each at most half of the admissible step, and shorter where the quality falls
 *                          too fast. After each step the functions are solved again on the new mesh; the analysis is
 *                          reused. Where the steps become too short to reach the target, another operator takes over
 *                          (the conformal one with exponent 1, Laplace's) if its step is longer. At all times the
 *                          points on curves and rigid bodies are where the B-spline (with rotated offsets, see below)
 *                          or the body has them for the current control points. Meanwhile each body, that is each loop
 *                          of the boundary that moves all round, rotates and scales about the centre of its control
 *                          points, by the best-fitting similarity, at a constant rate; the rest of the movement grows
 *                          linearly. Walls that end on another boundary move on straight lines, so that what is held at
 *                          their ends stays; so do functions with real values. If the target is not reached, all is
 *                          tried on straight lines, too
 *   HM_STRATEGY_UNTANGLED  the rest of the movement at once; then inner points are placed such that no cell is inverted
 *                          (foldover-free energy of Garanzha et al., ACM Trans. Graph. 40 (2021), with the initial
 *                          cells as the target shapes). Where substeps would need more than 5 solutions, or become too
 *                          short, this is tried, with improvement, before the functions are solved again; if the mesh
 *                          is not good then, the substeps continue. With a derivative only after all substeps
 *   HM_STRATEGY_IMPROVED   inner points of a mesh at the target are placed for quality, see hm_improve
 * If no strategy reaches the target, the mesh is never nearer to the start than what one linear step reaches.
 *
 * Points of a wall are not exactly on their curve. With complex functions, a body that rotates or scales takes them
 * along: the best-fitting similarity is applied to the points themselves, and the rest of the movement to the curve. So
 * hm_morph_safe moves a point at x = C(u) + e by sum_i N_i dP_i + (r - 1) e, r the rotation and scale of its body,
 * where hm_morph moves it by the sum alone (for hm_options.offset_correction see there); near the wall the mesh
 * follows.
 *
 * Targets that no mesh can have are refused immediately, with the place (HM_CROSSING). Boundaries that slide, are
 * periodic or free are judged only as far as it is known where they end. Points that slide along curves are on their
 * curves after each step (see hm_slide). */
enum { HM_STRATEGY_LINEAR = 0, HM_STRATEGY_OTHER = 1, HM_STRATEGY_SUBSTEPS = 2, HM_STRATEGY_UNTANGLED = 3,
       HM_STRATEGY_IMPROVED = 4 };

typedef struct hm_safe_options {
    uint64_t struct_size;
    int32_t  max_resolves;         /* how many times the functions may be solved again; 0 means 10; negative: never */
    int32_t  skipped_strategies;   /* sum of 1 << HM_STRATEGY_... of the strategies to skip */
    int32_t  n_others;             /* 0 .. 64 */
    int32_t  reserved;             /* 0 */
    const hm_basis *const *others; /* [n_others] solved bases of the same mesh, curves, conditions and offset
                                      correction. If a derivative is wanted, only those are tried that have the
                                      numbers_per_value of the basis */
    double   heights;              /* [0..1] 0: off. Restores the initial distances between moving walls and the points
                                      near them, which angle-preserving functions scale with the stretch of the wall. A
                                      closed formula, applied at the end along the wall normals; it fades out where the
                                      curvature of the wall or another wall becomes important, and is reduced until no
                                      cell is inverted. Not part of the derivative */
    double  *reached;              /* [2*functions] receives the movement that `to` has; NULL: not wanted. If this is
                                      not the whole movement, it differs from `move` times step_fraction, because bodies
                                      rotate on the way */
    double   min_quality;          /* [0..1] smallest size-skew quality of the mesh at the target, relative to the
                                      start, in parts of the smallest quality of the start; 0 means 0.05;
                                      negative: any valid mesh */
    double   max_height_change;    /* [-] > 1: heights of the first layer may grow and shrink by this factor at most;
                                      where they do by more, they are restored as far as that helps. 0: any */
} hm_safe_options;

typedef struct hm_worst_cell {
    int32_t  cell, reserved;
    double   quality, start_quality; /* [0..1] size-skew quality relative to the start; skew quality of the start */
    double   x, y;                   /* mean of the corners, in `to` */
} hm_worst_cell;

typedef struct hm_safe_report {
    uint64_t struct_size;
    int32_t  strategy;             /* the last HM_STRATEGY_... that moved the mesh */
    int32_t  other;                /* which of `others`, from 0; -1: none */
    int32_t  steps, resolves;      /* of the mesh that is given; solutions of all strategies */
    double   step_fraction;        /* [0..1] part of the movement that was reached; 1: all of it */
    double   admissible;           /* [-] admissible step of the last step that was tried, relative to that step,
                                      see hm_step_report */
    int32_t  cell, point;          /* what limits that step; -1: nothing */
    int32_t  untangled;            /* number of inverted cells before untangling */
    int32_t  iterations;           /* of untangling */
    int32_t  crossing_points[4];   /* see hm_quality_report */
    int32_t  inverted;             /* inverted cells of `to`: always 0 */
    int32_t  min_quality_cell;
    double   min_quality, mean_quality; /* [0..1] of `to` with the start as the reference, see hm_quality */
    double   mean_angle_change, max_angle_change; /* [degrees] of the angles between wall and first-layer edges */
    /* [-] first-layer height after / before; 1 where nothing moved, or without such edges */
    double   mean_height_ratio, min_height_ratio, max_height_ratio;
    double   heights;              /* [0..1] the part of the distances that was restored */
    int32_t  angle_point;          /* where the angle changed most; -1: no wall point has a first-layer edge */
    int32_t  min_height_point, max_height_point;
    int32_t  n_worst;              /* 0 .. 5, as many as the mesh has cells */
    double   turned_offset;        /* [length] largest |(r - 1) e| that a point of a wall moved in addition to the
                                      movement of the curve, see above; hm_boundary_error includes it */
    double   start_quality;        /* [0..1] smallest skew quality of the start */
    hm_worst_cell worst[5];        /* [n_worst] the cells of lowest quality of `to`, the worst first */
} hm_safe_report;

/* Working memory of hm_morph_safe with a basis like this one, NULL: as hm_basis_init makes it; space for such a basis,
 * several copies of the mesh points, and untangling. */
HM_API hm_status hm_morph_safe_size(const hm_plan *plan, const hm_basis *basis, size_t *bytes, hm_error *err);
/* Moves the mesh that the plan was made from, starting at the mesh's own coordinates, which must be those that the
 * basis was solved on (else HM_BAD_MESH: after hm_morph in place, solve again, or restore them), by `move` (see
 * hm_morph). The basis may be a combined one (hm_combine) or have functions by table (hm_tabulate); they move on
 * straight lines, because their values on the wall cannot turn. `others` must then have the same functions. `to`
 * [n_points] may be the arrays of the mesh. Returns HM_OK: the whole movement; HM_NOT_CONVERGED: the same, but a
 * solution on the way missed the tolerance; HM_POOR: the whole movement and a valid mesh, but options.min_quality or
 * options.max_height_change is missed; HM_SHORT: the best valid mesh, report.step_fraction of the movement. If the call
 * is refused or cancelled, `to` is unchanged. `to` never contains an inverted cell, and the boundary of `to` does not
 * cross itself unless the boundary of the mesh does. options NULL: defaults. report may be NULL. The threads are those
 * of the plan. Where functions were solved again, the plan has no factor afterwards: call hm_plan_factor before the
 * next hm_plan_solve.
 *
 * derivative: NULL, or another basis of the same analysis (hm_basis_init). It receives the sum of the functions of all
 * steps, each weighted by the part of the movement that the step made. With this basis hm_morph is the derivative of
 * `to` by `move` and hm_adjoint the transpose. If the whole movement was possible, this is exact for the points of a
 * wall that lie on their curve. Neglected are: for points off their curve, the change of the rotated offset (r - 1) e
 * with `move` (report.turned_offset tells how large the offset's part of the movement is); inside the mesh, the
 * dependence of later functions on the earlier steps and the movement that follows rotated offsets; the dependence of
 * step lengths and body rotations on `move`; and what untangling, improvement and options.heights moved. */
HM_API hm_status hm_morph_safe(hm_plan *plan, const hm_basis *basis, const double *move, const hm_points_out *to,
                               hm_basis *derivative, void *work, size_t bytes, const hm_safe_options *options,
                               hm_safe_report *report, hm_error *err);

/* The same for displacements that are given at the points of markers with HM_GIVEN, see hm_displace: all strategies,
 * options, results and refusals are those of hm_morph_safe, but n_others must be 0; where one step is not enough, the
 * functions of other operators are solved as they are needed (HM_STRATEGY_OTHER; report.other is their operator_kind).
 * basis: of the same analysis as the plan, from hm_basis_init; solved if it has functions, without functions by table.
 * move [2*functions]: what curves and rigid bodies move by in the same call, as in hm_morph_safe; NULL: nothing.
 * points [n], wall [n]: the displacements, see hm_displace. A loop of the boundary all of whose points are given is a
 * body, whose rotation is taken out; points of other loops move on straight lines. Where the whole movement is
 * possible, the points of `points` are displaced by the given bits. The plan needs no factor; where
 * functions were solved again, call hm_plan_factor before the next hm_displace. Work: that of hm_morph_safe for three
 * complex functions for each body, one more, and those of the basis, and of a basis with these. */
HM_API hm_status hm_displace_safe_size(const hm_plan *plan, const hm_basis *basis, size_t *bytes, hm_error *err);
HM_API hm_status hm_displace_safe(hm_plan *plan, const hm_basis *basis, const double *move, int32_t n,
                                  const int32_t *points, const hm_points *wall, const hm_points_out *to, void *work,
                                  size_t bytes, const hm_safe_options *options, hm_safe_report *report, hm_error *err);

/* ---- Better cells in a mesh that is valid ---- */

typedef struct hm_improve_options {
    uint64_t struct_size;
    int32_t  max_iterations;       /* steps of Newton's method, 0 .. 10000; 0 means 60 */
    int32_t  reserved;             /* 0 */
    const hm_points *reference;    /* [n_points] coordinates before the movement: a valid mesh, whose cells are the
                                      targets. NULL: the mesh's own, which must be those of the analysis: after a
                                      morph in place, HM_BAD_MESH */
} hm_improve_options;

typedef struct hm_improve_report {
    uint64_t struct_size;
    int32_t  iterations;           /* steps of Newton's method */
    int32_t  movable;              /* points that could move */
    double   min_quality_before, mean_quality_before; /* [0..1] of `from`, relative to the reference, see hm_quality */
    double   min_quality, mean_quality; /* [0..1] of `to` */
    int32_t  min_quality_cell_before, min_quality_cell;
} hm_improve_report;

/* Working memory of hm_improve: several copies of the mesh points, and a sparse matrix of 2 x 2 blocks. */
HM_API hm_status hm_improve_size(const hm_plan *plan, size_t *bytes, hm_error *err);
/* Moves the inner points of a mesh after a movement so that the cells are more like the cells before the movement:
 * target-matrix optimisation (Knupp, Eng. Comput. 28 (2012) 419) by Newton's method. The plan needs no factor and
 * keeps the one that it has. `from`: coordinates of a valid mesh; `to` may be the arrays of `from`.
 * Targets are the cells of the reference; thin cells at walls are stretched with the wall, so that they keep their
 * heights. Then the worst cells are raised: no cell should have less than the smallest quality of the reference, or
 * less than half of its own quality there. Of all meshes on the way, `to` is the one that misses this least, and of
 * equal ones the one with the largest mean quality. The reference itself does not change. No cell is ever inverted.
 * Points on walls and on fixed and free boundaries keep their bits. The outer ends of the first-layer edges at walls
 * are put where the wall carries them, at the heights and angles of the reference, as far as no cell inverts, and
 * stay there unless a cell there has less than half of the quality that it had; if the smallest quality would end
 * below that of `from`, they are held as in `from`. If that does not help, `to` is `from`: the smallest quality, as
 * hm_quality reports it, never falls. Sliding points stay on their straight lines and on their curves. On a curve
 * (see hm_slide, which comes before) those points slide that are within 1e-6 of a face of the curve; others stay where
 * they are. Points of a cut or of a pair move together, those of HM_ROTATION_PAIR turned.
 * options and report may be NULL. Refused (HM_BAD_MESH): an inverted cell, a coordinate that is not finite or larger
 * than 1e100. After a refused call `to` is unchanged. The threads are those of the plan. */
HM_API hm_status hm_improve(hm_plan *plan, const hm_points *from, const hm_points_out *to, void *work, size_t bytes,
                            const hm_improve_options *options, hm_improve_report *report, hm_error *err);

#ifdef __cplusplus
}
#endif
#endif
