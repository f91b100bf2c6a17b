/* clang-format off */
/* harmorph morphs an airfoil and the CFD mesh around the airfoil together, in two dimensions. MIT
 * licence.
 *
 * The airfoil is a B-spline curve. Each basis function N_i of the curve is boundary data for
 * Laplace's equation, or a related one, on the mesh. The solutions F_i are computed once, and then
 * carry any movement dP_i of the control points to every mesh point: X_new = X + sum_i F_i dP_i.
 * (Nikolos, Lygidakis, Leloudas, Tavla, "Application of B-spline basis functions as harmonic
 * functions for the concurrent shape and mesh morphing of airfoils".)
 *
 * THE SHORTEST USE, in C99. `mesh` is an hm_mesh whose faces at the airfoil have the marker `wall`.
 * The curve gets 20 control points, or hm_fit_options.n_control; move [2*20] has the movement dx,dy
 * of each of them.
 *
 *     hm_memory a = {NULL, 0}, b = {NULL, 0}, c = {NULL, 0};
 *     hm_fit_marker(&curves, &a, &mesh, 1, &wall, NULL, NULL, &error), a.block = malloc(a.bytes);
 *     hm_fit_marker(&curves, &a, &mesh, 1, &wall, NULL, NULL, &error);
 *     hm_condition on_curve = {.struct_size = sizeof on_curve, .marker = wall,
 *                              .kind = HM_ON_CURVE, .n_curves = curves->n_curves};
 *     hm_problem problem = {.struct_size = sizeof problem, .mesh = &mesh, .curves = curves,
 *                           .n_conditions = 1, .conditions = &on_curve};
 *     hm_setup setup = {.struct_size = sizeof setup};
 *     hm_setup_init(&setup, &b, &problem, NULL, &error), b.block = malloc(b.bytes);
 *     hm_setup_init(&setup, &b, &problem, NULL, &error);
 *     hm_setup_solve(&setup, &c, NULL, &error), c.block = malloc(c.bytes);
 *     hm_setup_solve(&setup, &c, NULL, &error);
 *     hm_morph(setup.basis, move, &mesh.points, &to, NULL, &error);
 *
 * `to` is an hm_points_out, which may be the arrays of the mesh. A call that needs memory is made
 * twice: first with an empty hm_memory, into which the call writes how many bytes it needs. Each
 * call returns a status, which is negative if the call was refused; error.text then says why.
 *
 * BEFORE THE MESH MOVES, ask how far it can follow; dx and dy [n_points] receive displacements. For
 * an optimiser, dj (an hm_points) has the derivatives of an objective with respect to the points of
 * the moved mesh, and gradient [2*20] receives those with respect to the control points.
 *
 *     hm_points_out displacement = {dx, dy, 1};
 *     hm_points along = {dx, dy, 1};
 *     hm_step_report step = {.struct_size = sizeof step};
 *     hm_quality_report quality = {.struct_size = sizeof quality};
 *     hm_morph(setup.basis, move, NULL, &displacement, NULL, &error);
 *     hm_assess(setup.basis, &mesh, NULL, &along, NULL, NULL, &step, &quality, &error);
 *     if (step.admissible > 1 && step.boundary > 1)
 *         hm_morph(setup.basis, move, &mesh.points, &to, NULL, &error);
 *     hm_adjoint(setup.basis, &dj, gradient, NULL, &error);
 *
 * The library needs no other one: cc -Iinclude program.c libharmorph.a. In the source distribution,
 * c_api/examples/morph.c is a complete program of 60 lines. The library reads no files; read_su2.c,
 * which is installed in share/harmorph, reads those of SU2. Triangles and quadrilaterals in any
 * order are HM_CELLS_ROWS, or HM_CELLS_QUADS whose triangles repeat their last point.
 *
 * ORDER OF CALLS.
 *
 *     hm_fit_marker, or hm_fit          a curve through the wall, unless there is one
 *     hm_setup_init > hm_setup_solve    all of the next four lines, in two blocks
 *         hm_analysis_init              checks, ordering, symbolic factorisation
 *         hm_plan_init, hm_basis_init   memory for the factor, memory for the functions F_i
 *         hm_plan_factor                matrix and factor
 *         hm_plan_solve                 the functions
 *     hm_morph, hm_adjoint, hm_assess   any number of times
 *
 * hm_morph and hm_adjoint need only the basis, hm_assess also the mesh. Keep the plan if you call
 * hm_displace, hm_move_safe or hm_improve later, and the analysis if you call hm_slip later.
 *
 * HEADERS. This header suffices for a solver on one process. The other headers, by topic:
 *
 *     harmorph_design.h    evaluation, refinement, measures of curves; variables; slipping points
 *     harmorph_bases.h     bases made from another one: single precision, combined, finer, by table
 *     harmorph_quality.h   smooth bounds of the quality of a mesh, with derivatives, for optimisers
 *     harmorph_fields.h    swept areas, wall distances, fields of one mesh on another
 *     harmorph_space.h     meshes one cell thick, blocks in arrays of their own, meshes as edges
 *     harmorph_study.h     diagnostics, and the schemes and engines of the paper
 *     harmorph_mpi.h, harmorph_petsc.h   several processes: functions, or the mesh, distributed
 *     harmorph_openmp.h, harmorph_pthreads.h, harmorph_pages.h   ready-made threads, huge pages
 *
 * CONVENTIONS hold for every function of these headers.
 *
 * Languages        C89 (with stdint.h), C99, C11, C++11 to C++20; no C++ run-time library. The
 *                  ready-made threads and huge pages are inline functions and need C99.
 * Memory           The library allocates no memory: see hm_memory. An object lives inside the
 *                  caller's block: nothing has to be freed, and the block must not move while the
 *                  object is in use (a basis may be copied or written to a file: hm_basis_attach).
 * Ownership        Arrays in structs remain the caller's; input arrays are never changed. Arrays of
 *                  a mesh must exist as long as the analysis and the plan that were made from the
 *                  mesh, arrays of curves as long as the analysis. A basis needs no other memory.
 * Structs          A struct whose first field is struct_size begins with HM_INIT(name), which sets
 *                  struct_size and all other fields to 0; an initialiser with struct_size does the
 *                  same. A field that is 0 has its default value; `reserved` must be 0. New
 *                  versions add fields at the end of these structs only. Fields that are set and
 *                  that this library does not know are refused with HM_UNSUPPORTED. Structs without
 *                  struct_size, and hm_curve, will always have the members that they have now.
 * Units            Coordinates have any length unit, the same one everywhere; reported angles are
 *                  in degrees. Array lengths stand in [brackets].
 * Range            Coordinates are at most 1e100 in size. Every corner of a cell has a height,
 *                  twice its area divided by the longer of its two edges, of at least 1e-100, and
 *                  of at least 2^-46 (1.4e-14) of the largest coordinate of the cell. Otherwise
 *                  hm_analysis_init refuses the mesh; moving the origin to the body may help.
 * Numbering        Points and cells are counted from mesh.index_base (also in reports, unless
 *                  stated otherwise), control points from curves.index_base. Arguments and fields
 *                  that name a curve, a condition or a function are counted from 0. Function i
 *                  belongs to control point i + curves.index_base.
 * Orientation      Cells may be numbered clockwise, counter-clockwise or mixed. Neighbours of equal
 *                  orientation traverse their common edge in opposite directions; the orientation
 *                  with the larger total area is taken as positive.
 * Inverted         A cell is inverted if the area of one of its corners, half the cross product of
 *                  the two edges there, is <= 0 in the positive orientation, infinite or NaN. So a
 *                  quadrilateral that is not convex is inverted. A corner with a sine below 5e-16
 *                  may count as either.
 * Markers          A marker without a condition is fixed: the points on it do not move.
 * Arrays           Arrays that a call writes must have no number in common with other arrays of
 *                  the call, except where the same arrays are allowed. Most calls refuse others
 *                  with HM_BAD_ARGUMENT; what the rest would write is undefined.
 * NULL             NULL is allowed only where stated. hm_error may always be NULL.
 * Status           0: success. Positive: success with a warning, the result can be used. Negative:
 *                  the call was refused; outputs and blocks are as before the call, unless the
 *                  text of the call says otherwise; a block given for a new object may have been
 *                  written.
 * Threads          There is no hidden state. Only one thread at a time may write an object (plan,
 *                  basis) or make other objects from one (analysis); any number may read (morph,
 *                  adjoint, assess). The library uses the threads of an hm_executor; executor NULL
 *                  is allowed in every call, and means one thread.
 * Stack            hm_morph: 17 KiB; hm_adjoint: 40 KiB; other calls: 56 KiB.
 * Exceptions       A call that succeeds on finite numbers raises only inexact and underflow.
 * Repeatability    The same input and the same kernel give bitwise identical results: from run to
 *                  run, for any number of threads and of processes (harmorph_mpi.h).
 */
/* clang-format on */
#ifndef HARMORPH_H
#define HARMORPH_H

#include <stddef.h>
#include <stdint.h>

/* Semantic version: every 1.x runs programs that were compiled with 1.0.0. */
#define HM_VERSION "1.0.0"
#define HM_VERSION_MAJOR 1
#define HM_VERSION_MINOR 0
#define HM_VERSION_PATCH 0
/* hm_abi_version() returns this value if header and library belong together. The name of the
 * shared library contains this number: libharmorph.so.HM_ABI. */
#define HM_ABI 5

#ifdef __cplusplus
extern "C" {
#endif
#if defined(__GNUC__)
#define HM_API __attribute__((visibility("default")))
#else
#define HM_API
#endif

/* Sets struct_size, the first field of a struct, to `size` and all other bytes to 0:
 *     hm_options options;
 *     HM_INIT(options); */
HM_API void hm_init(void* any_struct, uint64_t size);
#define HM_INIT(object) hm_init(&(object), sizeof(object))

/* ---- Status and error ---- */

typedef int32_t hm_status;
enum {
    HM_OK = 0,
    /* Solved, but a residual is above options.tolerance, or refinement ended before the values were
     * that accurate. error.value: the estimated error of the values. */
    HM_NOT_CONVERGED = 1,
    HM_MOVED = 2, /* attached to a mesh with other coordinates than the basis was solved on */
    /* The mesh is valid, but only a part of the movement was possible. error.item: the cell that
     * limits the movement, or the end of a wall that leaves the straight boundary beside it. */
    HM_SHORT = 3,
    HM_BACKTRACKS = 4, /* hm_fit: the curve runs backwards after the point error.item */
    /* hm_analysis_init: a point (error.item) is far from the curve of its marker, or beyond the end
     * of the curve, see hm_problem.max_curve_distance. error.value: the distance. */
    HM_FAR_FROM_CURVE = 5,
    /* The mesh is valid and at the target, but cells are poorer, or heights of the first layer
     * changed more, than the options ask for. error.item: the cell, or the wall point. */
    HM_POOR = 6,
    /* hm_analysis_init: a point (error.item) belongs to two moving conditions that do not move it
     * alike, see hm_basis_info.shared_point. error.other: the second one. hm_boundary_error: the
     * movement tears the two apart. error.value: the distance. */
    HM_TORN = 7,
    /* hm_fit, hm_fit_marker: the curve is farther from a point (error.item) than
     * hm_fit_details.tolerance. error.value: the largest distance. */
    HM_FAR_FROM_POINTS = 8,
    HM_CANCELLED = -1,     /* the progress callback asked to stop; repeat the call to continue */
    HM_BAD_ARGUMENT = -2,  /* NULL, a size or number out of range, an unknown struct_size */
    HM_BAD_MESH = -3,      /* index, repeated point, non-manifold edge, inverted cell, coordinate */
    HM_BAD_CURVE = -4,     /* degree, knots, indices, weights, control points, undetermined fit */
    HM_BAD_CONDITION = -5, /* no such marker or curve, field of another kind, nothing to solve */
    HM_BAD_BASIS = -6,     /* no basis, truncated, damaged, of another mesh, or not solved yet */
    HM_BLOCK_TOO_SMALL = -7, /* error.value: missing bytes */
    HM_NOT_POSITIVE = -8,    /* the matrix is not positive definite; error.item: the mesh point */
    HM_UNSUPPORTED = -9,     /* a combination of options that is not available */
    /* No mesh has the moved boundary: faces cross, a body leaves the domain, lies inside another
     * body or is turned inside out, points on the boundary alone invert a cell, or a movement tears
     * two conditions apart (HM_TORN). error.item: a point of the boundary, or the cell. */
    HM_CROSSING = -10
};

/* hm_error.item_kind, hm_error.other_kind: what the number counts. */
enum {
    HM_ITEM_NONE = 0,
    HM_ITEM_POINT = 1, /* a point of the mesh, or one of the points of hm_fit */
    HM_ITEM_CELL = 2,  /* a cell of the mesh, or a face of an hm_space_mesh */
    HM_ITEM_SIDE = 3, /* a face of the boundary, an edge of hm_edge_mesh, a side of hm_space_mesh */
    HM_ITEM_MARKER = 4, /* the caller's own number; item_base is 0 */
    HM_ITEM_CURVE = 5,
    HM_ITEM_CONTROL_POINT = 6,
    HM_ITEM_CONDITION = 7,
    HM_ITEM_FUNCTION = 8,
    HM_ITEM_BODY = 9,   /* hm_condition.body */
    HM_ITEM_LIST = 10,  /* an entry of mesh.list_start */
    HM_ITEM_BLOCK = 11, /* a block of mesh.block_sizes */
    HM_ITEM_KNOT = 12,  /* a knot of the curve that is the other item, or a knot to be inserted */
    HM_ITEM_VARIABLE = 13, /* a design variable: a column of a matrix */
    HM_ITEM_QUANTITY = 14, /* a quantity of hm_measure */
    HM_ITEM_FIELD = 15,    /* a field of hm_displace, or a mode of hm_tabulate */
    HM_ITEM_ENTRY = 16,    /* an entry of the array that the text names, a level, a part, a piece */
    HM_ITEM_GLOBAL_POINT = 17 /* the caller's own number (hm_part_mesh.numbers); item_base is 0 */
};

/* The items of an error, and all numbers in its text, are counted from the index_base of the mesh
 * (also of the mesh that an analysis, a plan, a basis or a plane was made from); in calls with
 * curves and no mesh, from the index_base of the curves; in other calls, from 0. In calls with a
 * mesh and curves, numbers of curves, control points and knots use the index_base of the curves. */
typedef struct hm_error {
    hm_status code;
    int32_t item_kind; /* HM_ITEM_...: what the error is about */
    int32_t item;      /* the first offending one; -1 if item_kind is HM_ITEM_NONE */
    int32_t item_base; /* what item is counted from; item - item_base is the index of a C array */
    /* A second item that the error is about: the second of two points, the curve of a knot. */
    int32_t other_kind, other, other_base;
    int32_t reserved; /* 0 */
    double value;     /* the value found: area [length^2], residual [-], missing [bytes]; or 0 */
    double x, y;      /* the place that the text names [length], never NaN; 0, 0 if there is none */
    char text[200];   /* one sentence, NUL-terminated */
} hm_error;

HM_API int32_t hm_abi_version(void);
HM_API const char* hm_version(void);                 /* "major.minor.patch" of the library */
HM_API const char* hm_status_name(hm_status status); /* "HM_OK", ...; "unknown status" otherwise */

/* ---- Memory of the caller ---- */

/* Memory for an object that a call makes, or for the work of a call until it returns.
 *
 * A call that takes an hm_memory is made twice. The first time block is NULL and bytes is 0: the
 * call only writes to `bytes` the exact number of bytes that it needs. This size query reads those
 * arguments that the text of the call names after "Bytes:"; all others may be NULL or 0, and no
 * output changes. The query checks only what it reads; the second call checks all input. The second
 * time block has that many bytes or more, at any alignment:
 *
 *     hm_memory memory = {NULL, 0};
 *     hm_plan_init(&plan, &memory, analysis, &error);
 *     memory.block = malloc(memory.bytes);
 *     hm_plan_init(&plan, &memory, analysis, &error);
 *
 * The second call does not change the struct, so that working memory serves any number of calls. A
 * block that is too small is refused (HM_BLOCK_TOO_SMALL, error.value: the missing bytes), as is a
 * block that is NULL with bytes > 0 (HM_BAD_ARGUMENT), as after malloc has failed. The struct will
 * always have these two members. */
typedef struct hm_memory {
    void* block;
    size_t bytes; /* of the block */
} hm_memory;

/* ---- Vector instructions and threads of the caller ---- */

/* Kernels for vector instructions. The library contains those of its architecture. */
enum {
    HM_KERNEL_AUTO = 0, /* the best kernel of the processor, which the library finds out */
    HM_KERNEL_BASELINE = 1,
    HM_KERNEL_AVX2 = 2,
    HM_KERNEL_AVX512 = 3,
    HM_KERNEL_NEON = 4 /* 64-bit ARM; the AVX kernels are those of x86-64 */
};
/* The best kernel that this processor has; never HM_KERNEL_AUTO. On a virtual machine the question
 * may take 15 us, more than a morph of 5000 points: ask once, and fill in hm_executor.kernel. */
HM_API int32_t hm_best_kernel(void);

/* Calls task(context, i) once for each i in 0 .. n_tasks-1, in any order, on any threads, and
 * returns when all tasks are done. No task waits for another task. harmorph_openmp.h and
 * _pthreads.h contain ready-made functions. */
typedef void (*hm_run)(void* user, int32_t n_tasks, void (*task)(void* context, int32_t index),
                       void* context);

typedef struct hm_executor {
    uint64_t struct_size;
    hm_run run; /* NULL: everything runs on the calling thread */
    void* user; /* passed to run */
    /* About how many tasks run at once, 1 .. 256; 0 means 1. The memory of a plan grows with it. */
    int32_t n_threads;
    /* The result of hm_best_kernel(); or one kernel for all processors, so that solved functions
     * have the same bits on each. Calls without hm_options (morph, adjoint, assess) have the same
     * bits with every kernel. Calls with hm_options refuse a kernel that the processor lacks
     * (HM_UNSUPPORTED); the other calls do not check. With HM_KERNEL_AUTO each large call asks the
     * processor, and small calls use the baseline. */
    int32_t kernel;
} hm_executor;

/* ---- Points: two numbers for each point of a mesh, in the caller's arrays ---- */

/* Coordinates, displacements, velocities, or derivatives with respect to the coordinates. The
 * numbers of point k, k from 0, are x[k*stride] and y[k*stride]. Fortran's x(n), y(n): {x, y, 1}.
 * Pairs xy(2,n): {xy, xy+1, 2}. xy(n,2): {xy, xy+n, 1}. An array of structs s: {&s[0].x, &s[0].y,
 * sizeof s[0] / sizeof(double)}. Nothing is read after the last point. */
typedef struct hm_points {
    const double *x, *y;
    int64_t stride; /* [doubles] from one point to the next, >= 1; 0 means 1 */
} hm_points;

/* Points that a call writes. The same arrays for one call that writes and one that reads them:
 *     hm_points_out out = {x, y, 1};
 *     hm_points in = {x, y, 1}; */
typedef struct hm_points_out {
    double *x, *y;
    int64_t stride;
} hm_points_out;

/* ---- Mesh: a view of the caller's arrays ---- */

/* hm_mesh.cell_layout */
enum {
    HM_CELLS_ROWS = 0,      /* cell_start, cell_points: compressed rows of 3 or 4 points */
    HM_CELLS_TRIANGLES = 1, /* cell_points [3*n_cells] */
    HM_CELLS_QUADS = 2,     /* cell_points [4*n_cells]; a triangle repeats its last point */
    /* No list: point (i,j) is i + ni*j, cell (i,j) is i + (ni-1)*j, i and j from 0. */
    HM_CELLS_STRUCTURED = 3,
    /* Triangles in cell_points [3*(n_cells-n_quads)], then quadrilaterals in quad_points
     * [4*n_quads] */
    HM_CELLS_MIXED = 4,
    /* No list: structured blocks one after the other, points and cells of each as in
     * HM_CELLS_STRUCTURED. Interfaces of blocks are cuts (see below): their points exist once in
     * each block, with equal coordinates. For blocks in separate arrays see harmorph_space.h. */
    HM_CELLS_BLOCKS = 5,
    /* cell_start, cell_points: compressed rows of 3 to 1024 points, see harmorph_space.h. */
    HM_CELLS_POLYGONS = 6
};
/* In hm_mesh.block_markers: the side is an interface or a cut, or has faces or lists of its own. */
enum { HM_NO_MARKER = INT32_MIN };

/* Every boundary edge must be on a marker. The exception is a cut, such as the seam of an O-mesh or
 * the wake line of a C-mesh: two points of unmarked boundary edges with equal coordinates are one
 * point for the library and move together. If edges without a marker remain, their points are
 * joined, too, where they differ by rounding, such as the two sides of a trailing edge that a
 * formula leaves open by 1e-16: each coordinate by at most 1e-12 of the diagonal of the box round
 * all unmarked edges, or 1e-15 of their largest coordinate. Both sides receive the same
 * displacements, bit by bit, and so keep their gap. A wider gap is refused with its width. Faces of
 * one marker may belong to several bodies, and one body may have several markers. */
typedef struct hm_mesh {
    uint64_t struct_size;
    int32_t index_base;  /* 0 or 1: the first number of points and cells, in arrays and reports */
    int32_t n_points;    /* 3 .. 2^30; points that no cell uses are allowed and never move */
    hm_points points;    /* [n_points] coordinates */
    int32_t cell_layout; /* HM_CELLS_... */
    int32_t n_cells;     /* 1 .. 2^29; structured and blocks: their cells, or 0 */
    /* [n_cells+1] rows and polygons: where the points of a cell begin, counted from index_base.
     * Size queries read the cell_start of polygons. */
    const int32_t* cell_start;
    const int32_t* cell_points; /* the points of each cell in order around the cell */
    int32_t ni, nj; /* structured only: points along i (fastest) and j; ni*nj = n_points */
    /* The boundary is given as faces, as lists, or both. A face is one edge; a list is a run of
     * points in order; a closed list repeats its first point. */
    int32_t n_faces;
    const int32_t* face_points;  /* [2*n_faces] */
    const int32_t* face_markers; /* [n_faces] any integers */
    int32_t n_lists;
    const int32_t* list_start; /* [n_lists+1] counted from index_base */
    const int32_t* list_points;
    const int32_t* list_markers; /* [n_lists] */
    int32_t n_quads;             /* mixed only, otherwise 0: 0 .. n_cells */
    const int32_t* quad_points;  /* [4*n_quads] mixed only; a triangle repeats its last point */
    /* Blocks only, otherwise 0: 1 .. 65536; thousands of blocks are faster as HM_CELLS_QUADS. */
    int32_t n_blocks;
    int32_t reserved;           /* 0 */
    const int32_t* block_sizes; /* [2*n_blocks] ni, nj >= 2 of each block */
    /* [4*n_blocks] markers of the sides i=0, i=ni-1, j=0, j=nj-1 of each block, or HM_NO_MARKER.
     * NULL: the boundary is given as faces or lists. */
    const int32_t* block_markers;
} hm_mesh;

/* ---- Curves ---- */

/* C(u) = sum_k N_k(u) P[indices[k]], u in [knots[degree], knots[n_indices]] */
typedef struct hm_curve {
    uint64_t struct_size; /* the same in all curves of one hm_curves */
    int32_t degree;       /* 1..5 */
    int32_t n_indices;    /* control points, repeated ones counted again; > degree */
    /* [n_indices] NULL: the points in order. Repeated points close a curve: with periodic knots the
     * first `degree` points are repeated at the end, with clamped knots the first point is. The
     * curve of a closed wall is refused (HM_BAD_CURVE) if its ends are at one place but belong to
     * different control points there: moving one of them would tear the wall. */
    const int32_t* indices;
    /* [n_indices + degree + 1] non-decreasing, up to 1e100; inner knots are at most degree-fold. */
    const double* knots;
} hm_curve;

/* Curves with common control points: a point used by two curves belongs to both. */
typedef struct hm_curves {
    uint64_t struct_size;
    int32_t index_base;    /* 0 or 1 */
    int32_t n_control;     /* control points, 2 .. 2^24 = number of functions */
    const double* control; /* [2*n_control] x,y pairs, finite */
    const double* weights; /* [n_control] 1e-10 .. 1e10, or NULL: not rational */
    int32_t n_curves;      /* 1 .. 2^24 */
    const hm_curve* curve; /* [n_curves] */
} hm_curves;

/* ---- Fit: B-splines through the points of a boundary ---- */

/* hm_fit_options.closed */
enum {
    /* An airfoil with a sharp trailing edge: tied there, as any loop with corners and no blunt base
     * is at its sharpest corner. Points that are no loop: open. A loop without a corner: periodic.
     * A loop with a blunt base: open, plus a straight curve of degree 1 along the base that shares
     * both end points. A base is straight, lies between two corners at the end farthest from the
     * leading edge, is at most 0.6 of the extent long, and is no tip of a horn of ice. */
    HM_CLOSED_AUTO = 0,
    HM_OPEN = 1,    /* clamped at the first and the last point */
    HM_TIED = 2,    /* clamped, both ends are one control point: a sharp trailing edge */
    HM_PERIODIC = 3 /* smooth everywhere */
};
typedef struct hm_fit_options {
    uint64_t struct_size;
    int32_t degree;     /* 1..5; 0 means 3 */
    int32_t n_control;  /* distinct control points > degree; at most the points; 0 means 20 */
    int32_t closed;     /* HM_CLOSED_AUTO, ... */
    int32_t index_base; /* 0 or 1: what errors and the report of hm_fit count points from */
    const struct hm_fit_details* details; /* weights, end tangents, ...: harmorph_design.h; NULL */
} hm_fit_options;

typedef struct hm_fit_report {
    uint64_t struct_size;
    double max_error, rms_error; /* [length] distances of the points from the curves */
    /* Points are positions in the list, counted from options.index_base (hm_fit), or points of the
     * mesh (hm_fit_marker). */
    int32_t max_error_point;
    int32_t closed;      /* the closure used: HM_OPEN (1), HM_TIED (2) or HM_PERIODIC (3) */
    int32_t first_point; /* where the curve begins: the corner of a loop */
    int32_t base_points; /* points on a blunt base including both ends; 0: no base */
    int32_t corners; /* points where the direction of the outline jumps, ends of curves included */
    int32_t backtrack_point; /* the curve runs backwards from here to the next point; -1: nowhere */
    int32_t pieces;          /* pieces of the boundary that were fitted */
    int32_t departure_point; /* max_departure is between this point and the next one; -1: none */
    /* [length] The largest distance of the curve from the polygon that connects the points. Points
     * that are far apart at a round nose explain some of this distance, and a curve that bulges
     * between points the rest; above .002 chords, look at the curve. */
    double max_departure;
    /* Bytes at the beginning of the block that the curves need; the rest of the block is free. */
    uint64_t bytes;
} hm_fit_report;

/* Fits curves to n points in order, by least squares; knots are placed by arc length and curvature.
 * is_loop: the last point is connected to the first one, which is not repeated (else HM_BAD_CURVE).
 * *curves and its arrays are inside the block (index_base 0), and working memory behind them: only
 * the first hm_fit_report.bytes of the block are needed afterwards. options and report may be NULL.
 * HM_BACKTRACKS: the curve runs against the order of the points; use fewer control points. Bytes:
 * n, options. */
HM_API hm_status hm_fit(const hm_curves** curves, hm_memory* memory, const hm_points* points,
                        int32_t n, int32_t is_loop, const hm_fit_options* options,
                        hm_fit_report* report, hm_error* err);

/* Fits curves to the walls of a mesh: finds the points of the given markers in order along the
 * boundary, joins the two sides of cuts (the trailing edge of a C-mesh), and fits each connected
 * piece, in the order of first faces, by curves of its own with n_control control points. The
 * report is that of the piece with the largest max_error. A marker that no face has is refused
 * (HM_BAD_CONDITION). Bytes: mesh, n_markers, markers, options; enough for any number of pieces,
 * with the working memory, as for hm_fit. */
HM_API hm_status hm_fit_marker(const hm_curves** curves, hm_memory* memory, const hm_mesh* mesh,
                               int32_t n_markers, const int32_t* markers,
                               const hm_fit_options* options, hm_fit_report* report, hm_error* err);

/* ---- Problem: what is to be solved ---- */

/* hm_condition.kind. A point on several markers has the kind that comes first in this list: on
 * curve, rigid, given, fixed, slip, free. */
enum {
    HM_ON_CURVE = 0, /* F_i = N_i(u) */
    HM_RIGID = 1,    /* a body that only translates, rotates and scales, see hm_morph */
    HM_FIXED = 2,    /* F_i = 0; also every marker without a condition */
    /* Points move along the boundary: along straight lines, along the smooth curve through the
     * points of the marker, or along given B-splines (hm_condition.along). Points at corners are
     * fixed; hm_slip of harmorph_design.h says what a corner is. */
    HM_SLIP = 3,
    /* Zero normal derivative, or a given one (hm_problem.fluxes): points may also leave the
     * boundary line. */
    HM_FREE = 4,
    /* This marker and its partner are translates of each other: their points move by bitwise
     * identical displacements. A wall that moves must not end on them; give the part of the wall
     * beside them a marker of its own, fixed or with slip. */
    HM_PERIODIC_PAIR = 5,
    /* The points move by displacements that are given from call to call (hm_displace). The
     * functions of curves and rigid bodies are 0 there. */
    HM_GIVEN = 6,
    /* One passage of a cascade in an annulus: the partner is this marker, rotated about the centre
     * (x, y) by an angle that the library finds, and so are its displacements. All pairs have one
     * centre and one angle. A point on the centre does not move. Not with HM_PERIODIC_PAIR. */
    HM_ROTATION_PAIR = 7,
    /* A sliding interface: the faces of this marker and its partner, the coincident boundaries of a
     * rotor and a stator, may touch and cross. Other conditions move the points of both markers. */
    HM_INTERFACE = 8
};

/* Fields that belong to another kind must be 0 (else HM_BAD_CONDITION). A marker has at most one
 * condition without a piece, interfaces apart; pieces without any condition are fixed. */
typedef struct hm_condition {
    uint64_t struct_size; /* the same in all conditions of one problem */
    int32_t marker;
    int32_t kind; /* HM_ON_CURVE, ... */
    /* On curve: each point lies on one of the curves first_curve .. first_curve+n_curves-1, from 0;
     * a section with a blunt base has two. A point that is far from its curve:
     * hm_problem.max_curve_distance. Refused: a point on a curve that is not among these. Slip:
     * n_curves is the number of curves in `along`. */
    int32_t first_curve;
    int32_t n_curves;
    int32_t body; /* rigid: number of the body, from 0 without gaps; below 2^20 */
    /* Pairs: the other marker of the pair, which has no condition of its own. Interface: the
     * marker on the other side. */
    int32_t partner;
    double x, y; /* rigid, rotation: the centre of rotation [length] */
    /* 0: all faces of the marker that no other condition chooses as a piece. 1: one piece of the
     * marker, the one nearest to (near_x, near_y). A piece is a run of adjacent faces of one marker
     * along the boundary: one of several bodies, or one side of a channel. Not for pairs. */
    int32_t piece;
    int32_t reserved;      /* 0 */
    double near_x, near_y; /* piece: a point near it, at the start coordinates [length] */
    /* Slip: the curves along which the points move (see hm_slip); NULL (n_curves 0): the polyline
     * of the marker, made smooth. Read by hm_analysis_init and hm_setup_init only; a basis
     * keeps copies, see hm_basis_along of harmorph_study.h. */
    const hm_curves* along;
} hm_condition;

typedef struct hm_problem {
    uint64_t struct_size;
    const hm_mesh* mesh;
    /* NULL, no rigid body and no marker with HM_GIVEN: the analysis covers the mesh only
     * (hm_analysis_boundary of harmorph_design.h, hm_analysis_report of harmorph_study.h). */
    const hm_curves* curves;
    int32_t n_conditions;           /* at least one condition is on a curve, rigid or given */
    const hm_condition* conditions; /* [n_conditions] */
    /* Curve points with a known parameter; the parameters of the others are found by projection. */
    int32_t n_known;
    const int32_t* known_points; /* [n_known] */
    const int32_t* known_curves; /* [n_known] */
    const double* known_u;       /* [n_known] */
    /* [-] 0 .. 1e100. HM_FAR_FROM_CURVE: the distance of a point from its curve is at least 0.001
     * of the diagonal of the box around the curve, or the point is more than a quarter of a face
     * beyond the end of the curve. Refused (HM_BAD_CONDITION): a distance of at least this part of
     * the diagonal (0: no limit; the command-line program has 0.01), or of more than the width or
     * height of the control polygon or of all points on curves. The wall keeps its distance from
     * the curve in every movement: a wall with the curve of another airfoil does not become that
     * airfoil. */
    double max_curve_distance;
    /* Neumann values. On face k of a free marker, between the points flux_points[2*k] and
     * flux_points[2*k+1], the function of control point i has the outward normal derivative
     * fluxes[k*n_control + i] [1/length], multiplied by the weight of the operator (1 for
     * HM_LAPLACE). So a movement dP gives the displacements the normal derivative
     * sum_i fluxes[k*n_control + i] dP_i there. Other free faces, and the functions of rigid
     * bodies, have 0. The part of a flux normal to a slip line at its end is taken up by the line.
     * Where hm_plan_factor receives other coordinates, the derivatives stay, and are multiplied by
     * the new lengths of the faces.
     * Refused: a face that is not free, or is named twice (HM_BAD_CONDITION); HM_ROTATION_PAIR, and
     * solving functions again that are combined or have modes beside them (HM_UNSUPPORTED). The
     * arrays must exist as long as the analysis; the plan has copies. */
    int32_t n_fluxes;
    const int32_t* flux_points; /* [2*n_fluxes] in any order, counted from mesh.index_base */
    const double* fluxes;       /* [n_fluxes*n_control] finite, up to 1e100 */
} hm_problem;

/* Available combinations with the compact scheme (all others: HM_UNSUPPORTED; other schemes:
 * harmorph_study.h). The value of a function at a point is a linear map of the plane: 1, 2 or 4
 * numbers (hm_basis_info.numbers_per_value). With slip, values are 2 x 2 matrices; with rigid
 * bodies "real" becomes "complex"; with HM_ROTATION_PAIR all values are complex, the engine is
 * HM_DIRECT, and slip and meshes in parts are excluded. HM_MULTIGRID excludes slip if conformal.
 *
 *   operator                  engine                       conditions      values
 *   HM_CONFORMAL              HM_DIRECT, HM_MULTIGRID      all but free    complex
 *   HM_LAPLACE, HM_WEIGHTED   HM_DIRECT, HM_MULTIGRID      all             real
 *
 * The weight of an operator is k = 1 / d^q. d is the distance from the mean of the corners of a
 * cell to the nearest face that moves, that is on a curve, a rigid body or a marker with HM_GIVEN
 * (or on a periodic or rotated image), divided by the extent of these faces. Cells near the moving
 * boundary are stiff and keep their shape; others deform. */

/* hm_options.operator_kind */
enum {
    /* Minimises the integral of k |f_x + i f_y|^2 over complex functions f: the maps closest to
     * angle-preserving ones. Heights of the first layer scale with the stretch of the wall. Every
     * boundary point must be prescribed: with a free boundary the problem is ill-posed. */
    HM_CONFORMAL = 0,
    /* Minimises the integral of |grad F|^2: the harmonic functions of the paper. */
    HM_LAPLACE = 1,
    /* Minimises the integral of k |grad F|^2. */
    HM_WEIGHTED = 2
};
/* hm_options.engine */
enum {
    /* Nested dissection and multifrontal Cholesky factorisation; the fastest engine. Plan and
     * analysis take 840 bytes per point for 10 000 points, 1090 for a million; with HM_CONFORMAL
     * about 1.6 times as many. */
    HM_DIRECT = 0,
    /* Conjugate gradients, preconditioned by algebraic multigrid. The iterations hardly depend on
     * the number of points nor on the thickness of cells along the wall; with triangles that are
     * stretched otherwise there are more (c_api/README.md of the sources). Plan: 455 to 500 bytes
     * per point. */
    HM_MULTIGRID = 1
};
/* hm_basis_info.storage: the precision of the stored functions */
enum { HM_DOUBLE = 0, HM_SINGLE = 1 };
/* Called at the start of each phase (HM_PHASE_... of harmorph_study.h; fraction 0), sometimes in
 * between, and at the end (1). A return value other than 0 stops the call: HM_CANCELLED. */
typedef int32_t (*hm_progress)(void* user, int32_t phase, double fraction);

struct hm_study_options; /* harmorph_study.h */

typedef struct hm_options {
    uint64_t struct_size;
    int32_t operator_kind; /* default HM_CONFORMAL */
    int32_t engine;        /* default HM_DIRECT */
    /* 0 or 1; conformal only. 1: boundary functions N_i + e N_i' / C', e the offset of the mesh
     * point from the curve, so that the offset rotates with the curve: rigid motions of all control
     * points then move every wall point rigidly; other motions add e dC' / C'. The correction is
     * left out at corners and where |e| sum_i |N_i'| >= |C'|. */
    int32_t offset_correction;
    /* [-] Relative residual above which hm_plan_solve warns; 0 means 1e-10. Iterative engines also
     * continue until the estimated error of the values is about tolerance times the largest value.
     * HM_DIRECT does not warn if the residual of every row is rounding of its fluxes (very thin
     * cells) and the estimated error is below the tolerance. */
    double tolerance;
    hm_progress progress; /* NULL: none; always called on the thread that made the call */
    void* progress_user;
    /* NULL: one thread. The struct is copied, but the object that executor.user points to must
     * exist as long as analysis and plan. */
    const hm_executor* executor;
    /* [-] q of the weight: a multiple of 1/4 up to 4; 0: 1.5 for HM_CONFORMAL, 1 for HM_WEIGHTED.
     * Negative: k = 1; the functions are then those of HM_LAPLACE. */
    double exponent;
    const struct hm_study_options* study; /* copied; NULL: defaults */
} hm_options;

/* ---- Analysis: everything that does not depend on numerical values ---- */

typedef struct hm_analysis hm_analysis;

/* Checks all input, numbers the unknowns and finds the parameters of the curve points. Ordering and
 * symbolic factorisation use the threads of options.executor. A mesh with inverted cells is refused
 * unless the analysis covers the mesh only, for hm_analysis_report. options NULL: defaults. Bytes:
 * problem, options, of which the query reads the counts alone (points, cells, faces, control
 * points). */
HM_API hm_status hm_analysis_init(hm_analysis** analysis, hm_memory* memory,
                                  const hm_problem* problem, const hm_options* options,
                                  hm_error* err);

/* ---- Plan and basis ---- */

typedef struct hm_plan hm_plan;
typedef struct hm_basis hm_basis;

/* The analysis must have curves, rigid bodies or markers with HM_GIVEN; with the latter alone, the
 * basis has no functions, and serves hm_assess. Plan and basis copy what they need of it. Bytes:
 * analysis. */
HM_API hm_status hm_plan_init(hm_plan** plan, hm_memory* memory, const hm_analysis* analysis,
                              hm_error* err);
HM_API hm_status hm_basis_init(hm_basis** basis, hm_memory* memory, const hm_analysis* analysis,
                               hm_error* err);

/* Assembles and factors the matrix with the coordinates `at` of the mesh points (NULL: the mesh's
 * own coordinates); the ordering and the symbolic factorisation are reused. A failed or cancelled
 * call leaves the plan without a factor. Refused (HM_BAD_MESH): a coordinate that is not finite or
 * larger than 1e100, a cell that is inverted at `at`. */
HM_API hm_status hm_plan_factor(hm_plan* plan, const hm_points* at, hm_error* err);

typedef struct hm_solve_report {
    uint64_t struct_size;
    int32_t unknowns, functions;
    /* [-] largest |b - A F| / |b| of all functions, 2-norms; see options.tolerance */
    double residual;
    int32_t residual_function;     /* the function with that residual */
    int32_t boundary_error_point;  /* the point with the boundary error below */
    double boundary_error;         /* [-] largest |F_i - N_i(u)| on the curves */
    double partition_defect;       /* [-] largest |sum_i F_i - 1| on the curves */
    double min_value, max_value;   /* [-] of all F_i of control points */
    double max_distance;           /* [length] largest distance of a curve point from its curve */
    int32_t max_distance_point;    /* the point with that distance */
    int32_t curve_points;          /* mesh points on curves */
    int32_t refinements, reserved; /* steps of iterative refinement; 0 */
    int64_t factor_entries;        /* numbers in the factor; 0: there is no factor */
    int32_t iterations, levels;    /* of engines that iterate, see harmorph_study.h */
    double work;                   /* of engines that iterate, see harmorph_study.h */
} hm_solve_report;

/* Solves for all functions of the basis with the factor of the plan. Both must come from the same
 * analysis. report may be NULL. If cancelled, the basis is not solved; the factor stays valid.
 * HM_MULTIGRID starts from the functions of a solved basis: few iterations after a small step. */
HM_API hm_status hm_plan_solve(hm_plan* plan, hm_basis* basis, hm_solve_report* report,
                               hm_error* err);

/* ---- Setup: analysis, plan and basis in two blocks, for programs that keep them together ---- */

typedef struct hm_setup {
    uint64_t struct_size;
    hm_analysis* analysis;
    hm_plan* plan;   /* with a factor at the mesh's own coordinates; NULL before hm_setup_solve */
    hm_basis* basis; /* solved; NULL before hm_setup_solve */
} hm_setup;

/* Does what hm_analysis_init does, with the same warnings and the same bytes. A problem without
 * conditions is refused (HM_BAD_ARGUMENT). Bytes: problem, options. */
HM_API hm_status hm_setup_init(hm_setup* setup, hm_memory* memory, const hm_problem* problem,
                               const hm_options* options, hm_error* err);
/* Makes plan and basis in the second block, factors and solves, as hm_plan_init, hm_basis_init,
 * hm_plan_factor and hm_plan_solve do with the same bits. report may be NULL. After a refused call
 * setup is as before. The handles serve all other calls: to solve again on a moved mesh, call
 * hm_plan_factor and hm_plan_solve with them. The basis lies at the beginning of the block, in
 * front of the plan: where morphs follow alone, keep hm_basis_info.bytes bytes from setup.basis on.
 * Bytes: setup, after hm_setup_init. */
HM_API hm_status hm_setup_solve(hm_setup* setup, hm_memory* memory, hm_solve_report* report,
                                hm_error* err);

/* A basis is one block without pointers: write the block to a file unchanged (hm_basis_info.bytes),
 * read or map the file at a multiple of 8 bytes, and attach. Refused with the reason: no basis,
 * another format version or byte order, truncated, damaged (checksum), of a mesh with other cells
 * or with other points on the markers. mesh NULL: not compared. HM_MOVED: other coordinates. */
HM_API hm_status hm_basis_attach(const hm_basis** basis, const void* block, size_t bytes,
                                 const hm_mesh* mesh, hm_error* err);

typedef struct hm_basis_info {
    uint64_t struct_size;
    uint64_t bytes; /* of the block, from the address of the basis */
    int32_t solved; /* 0 or 1 */
    int32_t points, cells, functions, curves, curve_points; /* the last: also rigid and given */
    int32_t numbers_per_value; /* 1: real f; 2: complex a + i b; 4: matrix xx, xy, yx, yy */
    int32_t operator_kind, scheme, engine;
    int32_t index_base;         /* of the mesh: the first number of points and cells in reports */
    const int32_t* curve_point; /* [curve_points] mesh points on curves, counted from 0 */
    /* [curve_points] their curves; curves + b: rigid body b; curves + bodies: HM_GIVEN */
    const int32_t* point_curve;
    const double* point_u;     /* [curve_points] the parameter of each of them */
    double exponent;           /* q of the weight; 0: no weight */
    int32_t bodies;            /* rigid bodies */
    int32_t offset_correction; /* 0 or 1 */
    int32_t storage;           /* HM_DOUBLE, or HM_SINGLE: see hm_single_init */
    int32_t combined; /* functions of design variables (hm_combine); 0: those of control points */
    /* functions = (combined, or control_points where that is 0) + 2 * bodies + modes */
    int32_t control_points;
    int32_t modes; /* functions by table (hm_tabulate) */
    /* Points that belong to two moving conditions which do not move them alike: the end of a curve
     * beside another curve without a common control point or beside a rigid body, bodies that
     * touch. The first condition moves the point; a movement by which the second one would take it
     * elsewhere tears the two apart (hm_boundary_error; refused by safe morphs). Markers that one
     * condition puts on one set of curves, or one body, and curves with a common end control point
     * move together exactly. */
    int32_t shared_points, reserved;
    const int32_t* shared_point; /* [shared_points] mesh points, counted from 0; some repeatedly */
    /* [2*shared_points] the two conditions of each point, from 0; the same one if a point is at
     * both ends of its curve */
    const int32_t* shared_condition;
} hm_basis_info;
HM_API hm_status hm_basis_info_get(const hm_basis* basis, hm_basis_info* info, hm_error* err);

/* ---- Morph ---- */

/* to = from + sum_i F_i (dx, dy)_i at each point. move [2*functions] contains the dx,dy pairs of
 * the control points [length], then for each rigid body two pairs: the translation dx,dy [length],
 * and s - 1, where s = scale * (cos a, sin a) and a is the counter-clockwise angle of rotation. The
 * points z of the body move exactly to c + s (z - c) + (dx, dy), c the centre of rotation. Without
 * rigid bodies and modes (hm_tabulate), functions is curves->n_control. `to` may be the arrays of
 * `from` with the same stride; otherwise `to` and `from` must have no number in common (refused
 * where the strides are equal). Points with a displacement of 0 keep their coordinates bit by bit.
 * from NULL: taken as 0 (not the coordinates of the mesh, as in hm_assess), so that `to` receives
 * displacements, or velocities if `move` contains velocities of the control points. Coordinates are
 * not checked: one that is not finite stays so, and hm_assess counts its cells as inverted.
 *
 * The functions do not change when the mesh moves: but for rounding, a sum of movements gives the
 * same mesh in one morph or in many. The basis serves as long as hm_assess finds the next movement
 * good. Where its admissible step is no longer well above 1, or the smallest quality is too low,
 * solve again on the last good mesh (hm_plan_factor with `at`, hm_plan_solve). Control points and
 * the places z of bodies remain those of hm_analysis_init: a body that has got s, by one or many
 * movements, gets s_new by the movement s_new - s; by s_new - 1 the body would change its size.
 */
HM_API hm_status hm_morph(const hm_basis* basis, const double* move, const hm_points* from,
                          const hm_points_out* to, const hm_executor* executor, hm_error* err);
/* The transpose of hm_morph. dj: derivatives of an objective J with respect to the mesh points
 * after the morph (x: dJ/dx_k, y: dJ/dy_k); gradient [2*functions], which is overwritten:
 * derivatives with respect to `move`. The result does not depend on the numbering of the mesh
 * points: products are rounded once and added as integers, in units of 2^-63 of a power of two up
 * to 2 max|F| max|dj|. The error is at most 2^-51 sum|F dj| + N 2^-63 max|F| max|dj| for N points.
 * If a number is not finite or a product could overflow, the whole gradient is NaN. The morph F is
 * linear, so the product of the Hessian F^T H F of J and a vector v of movements is hm_adjoint of H
 * times hm_morph of v; H has the second derivatives of J with respect to the mesh points. */
HM_API hm_status hm_adjoint(const hm_basis* basis, const hm_points* dj, double* gradient,
                            const hm_executor* executor, hm_error* err);

/* ---- Validity and quality ---- */

typedef struct hm_step_report {
    uint64_t struct_size;
    /* [-] Largest s for which no cell of from + t displacement is inverted for all t < s; infinite:
     * no limit; 0: a cell is inverted at `from`. Exact, for areas are quadratic functions of s. */
    double admissible;
    int32_t cell, point; /* the limiting cell and the point of the limiting corner; -1: none */
    /* [-] s at which the boundary first touches itself or another body, exactly, if this is smaller
     * than `admissible`; else infinite. No cell need be inverted there. The two sides of an
     * HM_INTERFACE may touch. */
    double boundary;
    /* The point that touches first, and the two points of the face that it touches; or -1. */
    int32_t boundary_points[3];
    int32_t reserved; /* 0 */
} hm_step_report;

typedef struct hm_quality_report {
    uint64_t struct_size;
    int32_t inverted, first_inverted; /* number of inverted cells; the first one, or -1 */
    /* [length^2] smallest signed corner area; minus infinity where an area is infinite or NaN */
    double min_area;
    double min_quality, mean_quality; /* [0..1] size-skew quality; 0 for inverted cells */
    int32_t min_quality_cell;
    /* 1: the boundary crosses itself or another body, or faces coincide. Two walls that have come
     * into contact count, the two sides of a wall without thickness do not, nor do the two sides
     * of an HM_INTERFACE. With a displacement, two faces that cross each other before the
     * displacement do not count. */
    int32_t self_crossing;
    int32_t crossing_points[4]; /* first and last point of one face, then of the other; -1: none */
    /* [n_cells] Set by the caller: the array receives the quality of each cell, in the order of the
     * mesh, of which min_quality is the smallest and mean_quality the mean; 0 for inverted cells.
     * Structured meshes and blocks have one number for each of their cells. NULL: not wanted. */
    double* cell_quality;
} hm_quality_report;

/* Judges a movement before anything moves, in one pass over the cells.
 *   step     how far the points can move from `from` along `displacement` (from hm_morph with from
 *            = NULL), up to the smaller one of both limits; NULL: not wanted
 *   quality  of the mesh at from + displacement; NULL: not wanted
 * from NULL: the mesh's own coordinates. displacement NULL: zero, so that `quality` is that of a
 * mesh as it is; `step` must then be NULL. The size-skew quality of a cell is sqrt(f_size) f_skew:
 * f_size = min(t, 1/t), t the area of the cell divided by the area at the coordinates `reference`
 * (NULL: `from`); f_skew: Knupp, Finite Elem. Anal. Des. 39 (2003) 217, the shape metric for
 * triangles; combined as in de Boer, van der Schoot, Bijl, Comput. Struct. 85 (2007) 784.
 * The mesh must be that of the basis: the same cells with their points in the same order, in any
 * layout, but HM_CELLS_POLYGONS only if the basis is of polygons. Refused (HM_BAD_BASIS): other
 * counts, or other points in one of 64 cells that are compared; hm_basis_attach compares all.
 * A number that is not finite in `from` or `displacement` makes the cells there inverted and the
 * step 0; one in `reference` is not noticed. A refused call leaves both reports and
 * quality->cell_quality as they were.
 *
 * Whether the wall is where the curves are: hm_basis_curves gives the curves after `move`, and
 * hm_curve_point their points at hm_basis_info.point_u (harmorph_design.h). A wall point keeps its
 * offset from the curve; hm_boundary_error compares the displacements. */
HM_API hm_status hm_assess(const hm_basis* basis, const hm_mesh* mesh, const hm_points* from,
                           const hm_points* displacement, const hm_points* reference,
                           const hm_executor* executor, hm_step_report* step,
                           hm_quality_report* quality, hm_error* err);

/* The largest difference [length] between the displacement of the points on curves and rigid
 * bodies, to - from, and that which `move` (see hm_morph) gives them by each of their conditions.
 * *point: the point with this difference; point may be NULL. HM_TORN: the movement takes two
 * conditions of a point (error.item) apart by error.value, more than 1e-6 of the diagonal of the
 * box around the wall at `from`; do not use the moved mesh. error.other: the condition that does
 * not move the point. The remedy is one curve through both markers, or a common control point.
 * Displacements of points with HM_GIVEN are not compared. */
HM_API hm_status hm_boundary_error(const hm_basis* basis, const double* move, const hm_points* from,
                                   const hm_points* to, double* error, int32_t* point,
                                   hm_error* err);

/* ---- Given displacements of wall points: from a structural code, a CAD system, a table ---- */

/* Points of markers with HM_GIVEN move as each call says; no functions are needed. The displacement
 * of the mesh is one substitution with the factor of the plan: factor once, displace as often as
 * wished. hm_assess, with a basis of the same analysis that need not be solved, judges the result;
 * factor again at the last good position under the same conditions as for hm_morph, and give
 * displacements from that position on. Displacements are linear: velocities of wall points give
 * velocities of mesh points. Where curves and bodies move in the same step, move them first, by
 * hm_morph, and give the result as `from`.
 *
 * The wall points of a call are listed in `points` [n] in any order, counted from mesh.index_base;
 * NULL: in the order of hm_given_points. The list must contain all points of markers with HM_GIVEN
 * that are on no curve and no rigid body. A point, or both sides of a cut, may be in it twice. */

/* Lists the wall points with given displacements in order along the boundary, the mesh on the left.
 * points [capacity]; *n: number of points, also if the capacity is too small (HM_BAD_ARGUMENT). */
HM_API hm_status hm_given_points(const hm_plan* plan, int32_t* points, int32_t capacity, int32_t* n,
                                 hm_error* err);
/* Carries n_fields displacement fields, 1 .. 2^20, to the mesh at once, for instance structural
 * modes; up to 12 fields are one substitution. wall [n_fields]: each of n wall points [length]; to
 * [n_fields]: each of n_points mesh points; to = from + displacement; from NULL: taken as 0, as in
 * hm_morph. Wall points move by the given bits. Arrays `to` of different fields must have no number
 * in common; `to` of a single field may be the arrays of `from`. With `from`, a
 * boundary that crosses itself at `to` is refused (HM_CROSSING); cells may be inverted (hm_assess).
 * All fields are computed before any is written.
 * report counts fields as functions; NULL: HM_DIRECT computes residuals only where the factor lost
 * digits. Bytes: plan, n_fields; the same for hm_displace_adjoint. */
HM_API hm_status hm_displace(hm_plan* plan, int32_t n, const int32_t* points, int32_t n_fields,
                             const hm_points* wall, const hm_points* from, const hm_points_out* to,
                             hm_memory* memory, hm_solve_report* report, hm_error* err);
/* The transpose of hm_displace. dj [n_fields]: derivatives of objectives with respect to the mesh
 * points; gradient [n_fields]: derivatives with respect to the displacements of the n wall points;
 * where a point is repeated in the list, the first entry receives the whole derivative and the
 * others 0. Forces on mesh points become forces on the wall that do the same work. */
HM_API hm_status hm_displace_adjoint(hm_plan* plan, int32_t n, const int32_t* points,
                                     int32_t n_fields, const hm_points* dj,
                                     const hm_points_out* gradient, hm_memory* memory,
                                     hm_solve_report* report, hm_error* err);

/* ---- Large movements that stay valid ---- */

/* Strategies of hm_move_safe. They are tried in this order until the mesh is at the target and as
 * good as the options ask for. The result is a mesh at the target; if there is none, the mesh
 * nearest to the target of those that have options.min_quality, or of all meshes if none has; of
 * several meshes at one place the one of better quality. */
enum {
    HM_STRATEGY_LINEAR = 0, /* x + sum_i F_i dP_i, if the admissible step is larger than 1 */
    /* One linear step with each of options.others, in their order, or with the functions of the
     * other operator, which the call solves. */
    HM_STRATEGY_OTHER = 1,
    /* Several steps, each at most half of the admissible step; the functions are solved again after
     * each. Where the steps become too short, another operator takes over. Each body, that is each
     * loop of the boundary that moves all round, rotates and scales about the centre of its control
     * points, by the best-fitting similarity; the rest of the movement grows linearly, but where a
     * part of the body rotates against the rest, as a flap does, that part is on its arc in the
     * middle of the way. Walls that end on another boundary, and functions with real values, move
     * on straight lines. */
    HM_STRATEGY_SUBSTEPS = 2,
    /* The rest of the movement at once; then inner points are placed such that no cell is inverted
     * (foldover-free energy of Garanzha et al., ACM Trans. Graph. 40 (2021)). Tried where substeps
     * need more than 5 solutions or become too short; with a derivative, after all substeps. */
    HM_STRATEGY_UNTANGLED = 3,
    HM_STRATEGY_IMPROVED = 4 /* inner points of a mesh at the target are moved, see hm_improve */
};

typedef struct hm_safe_options {
    uint64_t struct_size;
    /* How many times the functions may be solved again. 0 means 10; then, if the target is not
     * reached, the steps go on from the best mesh, and parts of the movement are tried by
     * bisection, with up to 60 more solutions.
     * Negative: never. */
    int32_t max_resolves;
    /* sum of 1 << HM_STRATEGY_... of the strategies to skip; one of the first four must be left */
    int32_t skipped_strategies;
    int32_t n_others; /* 0 .. 64 */
    /* 1: the mesh at the target is improved in any case, as by hm_improve; with `heights`, the mesh
     * without these heights is improved too, and the better one is returned. 0: only where poor */
    int32_t improve;
    /* [n_others] solved bases of the same mesh, curves, conditions and offset correction. With a
     * derivative, which must not be one of them, those with another numbers_per_value than the
     * basis are skipped. */
    const hm_basis* const* others;
    /* [0..1] 0: off. The part of the initial distances between moving walls and the points near
     * them that is restored at the end, along the wall normals; angle-preserving functions scale
     * these distances with the stretch of the wall. A smaller part is restored (report.heights) if
     * this one would invert a cell, halve the smallest quality, or lower it below min_quality. The
     * derivative ignores it. */
    double heights;
    /* [2*functions] receives the movement that `to` has; NULL: not wanted. Where this is not the
     * whole movement, it differs from step_fraction * move, because bodies rotate on the way. */
    double* reached;
    /* [0..1] The quality that is asked for, of a mesh at the target or after a part of the
     * movement: the ratio of its smallest size-skew quality, relative to the start, to the smallest
     * quality of the start. 0 means 0.05; negative: any valid mesh, and the first one at the target
     * is taken. Otherwise other operators are tried where this ratio is below 0.8, and an
     * improvement (hm_improve) where this ratio, or the ratio of the mean qualities, is below 0.98;
     * the improvement is kept if the smallest quality does not fall and the product of smallest and
     * mean quality rises by 2 % or more. Between substeps cells are improved where the ratio is
     * below 0.5. With a derivative all these are left out; improvement is tried only where
     * min_quality is missed. */
    double min_quality;
    /* [-] > 1: the largest factor by which heights of the first layer may grow or shrink; where
     * they exceed it, they are restored as far as that helps. 0: any */
    double max_height_change;
    /* NULL, or another basis of the same analysis (hm_basis_init), which receives the sum of the
     * functions of all steps, weighted by their parts of the movement, so that hm_morph with this
     * basis is the derivative of `to` with respect to `move`, and hm_adjoint the transpose. This is
     * exact for wall points on their curve; where a body rotates or scales by r and has reached the
     * part t < 1, they move by t r^(t-1) sum_i N_i dP_i. Neglected are changes of (r - 1) e, the
     * influence of `move` and earlier steps on later functions, steps and rotations, how inner
     * points follow those that slip, and what untangling, improvement and heights moved. Refused
     * (HM_UNSUPPORTED) with given displacements. */
    hm_basis* derivative;
    int32_t improve_work; /* as hm_improve_options.max_solutions, for each improvement */
    int32_t reserved;     /* 0 */
} hm_safe_options;

/* What is to move. */
typedef struct hm_safe_target {
    uint64_t struct_size;
    /* [2*functions] the movement of control points, rigid bodies and amplitudes, see hm_morph;
     * NULL, with `wall` only: none */
    const double* move;
    /* Displacements of the points of markers with HM_GIVEN, see hm_displace. wall NULL, n 0: these
     * points stay. */
    int32_t n, reserved;
    const int32_t* points; /* [n] NULL: in the order of hm_given_points */
    const hm_points* wall; /* of the n points [length] */
} hm_safe_target;

typedef struct hm_worst_cell {
    int32_t cell, reserved;
    double quality, start_quality; /* [0..1] size-skew quality; skew quality of the start */
    double x, y;                   /* mean of the corners, in `to` */
} hm_worst_cell;

typedef struct hm_safe_report {
    uint64_t struct_size;
    int32_t strategy; /* the last HM_STRATEGY_... that moved the mesh */
    /* The place in `others`, or the operator_kind of functions that the call has solved itself,
     * as it does without others and without a derivative; -1: none. */
    int32_t other;
    int32_t steps, resolves;    /* steps to the mesh that is given; solutions of all strategies */
    double step_fraction;       /* [0..1] part of the movement that was reached; 1: all of it */
    double admissible;          /* [-] admissible step of the last step that was tried */
    int32_t cell, point;        /* what limits that step; -1: nothing */
    int32_t untangled;          /* number of inverted cells before untangling */
    int32_t iterations;         /* of untangling */
    int32_t crossing_points[4]; /* see hm_quality_report */
    int32_t inverted;           /* inverted cells of `to`: always 0 */
    int32_t min_quality_cell;
    double min_quality, mean_quality; /* [0..1] of `to`, the start as reference, see hm_assess */
    double mean_angle_change, max_angle_change; /* [degrees] between wall and first-layer edges */
    /* [-] first-layer height after / before; 1 where nothing moved, or without such edges */
    double mean_height_ratio, min_height_ratio, max_height_ratio;
    double heights;      /* [0..1] the part of the distances that was restored */
    int32_t angle_point; /* where the angle changed most; -1: there are no first-layer edges */
    int32_t min_height_point, max_height_point;
    int32_t n_worst;        /* 0 .. 5, at most the number of cells */
    double rotated_offset;  /* [length] largest |(r - 1) e|, see hm_move_safe */
    double start_quality;   /* [0..1] smallest skew quality of the start */
    hm_worst_cell worst[5]; /* [n_worst] the cells of lowest quality of `to`, the worst first */
    int32_t end_point; /* the end of a wall that leaves the boundary beside it farthest; -1: none */
    /* What was spent: solutions of the functions and of improvements, and the time of untangling in
     * solutions; about 200 at most. */
    int32_t solutions;
    double end_distance; /* [length] of that end from this boundary at the target */
    /* 1: the last improvement ended at its limit of solutions, so a larger options.improve_work may
     * give better cells; 0: more work would bring little */
    int32_t may_improve;
    /* 1: the plan has the factor that it had before the call; 0: functions were solved again, so
     * that hm_plan_factor must come before the next hm_plan_solve or hm_displace */
    int32_t has_factor;
} hm_safe_report;

/* Moves the mesh that the plan was made from to the target, starting at the mesh's own coordinates,
 * which must be those that the basis was solved on (else HM_BAD_MESH: after hm_morph in place,
 * solve again, or restore the coordinates). Combined functions and functions by table move on
 * straight lines; `others` must then have the same functions. `to` [n_points] may be the arrays of
 * the mesh. HM_OK: the whole movement; HM_NOT_CONVERGED: the same, but a solution on the way missed
 * the tolerance; HM_POOR: the whole movement, but options.min_quality or max_height_change is
 * missed; HM_SHORT: report.step_fraction of the movement, the largest part that was found whose
 * mesh has options.min_quality; with a derivative, or where that is negative, whose mesh is valid.
 * Targets that no mesh can have are refused immediately, with the place (HM_CROSSING); boundaries
 * with slip, periodic and free ones are judged only as far as their ends are known. If the call is
 * refused or cancelled, `to` is unchanged; HM_CROSSING fills the report, too, which has the points
 * of the crossing. A call that is cancelled may have replaced the factor of the plan, and leaves
 * options.derivative unsolved. `to` never contains an inverted cell, and the boundary of `to` does
 * not cross itself unless the boundary of the mesh does. options NULL: defaults. report may be
 * NULL.
 *
 * Wall points lie beside their curve by offsets e: x = C(u) + e. hm_morph moves them by
 * sum_i N_i dP_i. Where a body rotates or scales by r, hm_move_safe with complex functions adds
 * (r - 1) e, so that the offsets rotate and scale too; the mesh near the wall follows.
 *
 * Given displacements (target.wall): n_others must be 0; functions of other operators are solved
 * when they are needed (report.other is then their operator_kind). The basis is solved if it has
 * functions, and has no functions by table. A loop of the boundary all of whose points are given
 * rotates as a body; points of other loops move on straight lines. Where the whole movement is
 * possible, wall points are displaced by the given bits.
 *
 * Bytes: plan, basis, target. The query takes basis NULL as one that hm_basis_init has made, and
 * target NULL as one without given displacements. */
HM_API hm_status hm_move_safe(hm_plan* plan, const hm_basis* basis, const hm_safe_target* target,
                              const hm_points_out* to, hm_memory* memory,
                              const hm_safe_options* options, hm_safe_report* report,
                              hm_error* err);

/* ---- Better cells in a mesh that is valid ---- */

typedef struct hm_improve_options {
    uint64_t struct_size;
    /* The largest number of solutions, 0 .. 10000; 0 means 20. A solution is a factorisation of a
     * matrix with two unknowns at each point, with its substitution. */
    int32_t max_solutions;
    int32_t reserved; /* 0 */
    /* [n_points] a valid mesh before the movement; NULL: the mesh's arrays, if not moved since. */
    const hm_points* reference;
} hm_improve_options;

typedef struct hm_improve_report {
    uint64_t struct_size;
    int32_t solutions;   /* see max_solutions; each is one step */
    int32_t movable;     /* points that could move */
    int32_t may_improve; /* 1: more solutions may give better cells; 0: they would bring little */
    int32_t reserved;    /* 0 */
    double min_quality_before, mean_quality_before; /* [0..1] of `from`, see hm_assess */
    double min_quality, mean_quality;               /* [0..1] of `to` */
    int32_t min_quality_cell_before, min_quality_cell;
} hm_improve_report;

/* Moves the inner points of a mesh after a movement so that ln(smallest quality) + ln(mean quality)
 * becomes as large as possible, with the quality of hm_assess relative to the reference: Newton's
 * method with a smooth minimum that becomes sharper. With the engine HM_DIRECT each step factors a
 * matrix in the plan's order of elimination (the working memory is about twice that of a factor for
 * complex functions); other engines use conjugate gradients. The plan needs no factor. `from`:
 * coordinates of a valid mesh; `to` may be the arrays of `from`. No cell is inverted, and the
 * smallest quality does not fall, but for rounding. A mesh that is its own reference is not
 * changed. Points on walls and on fixed and free boundaries keep their bits. Where the wall faces
 * beside a wall point are longer than 4 heights of the first-layer edge there, the outer end of
 * this edge gets the height and angle of the reference, unless the cells there would then have less
 * than half of their quality, or this lowers the smallest quality of the mesh. Cells of other walls
 * are free. Points with slip stay on their lines and curves (call hm_slip before). Points of a cut
 * or pair move together. options and report may be NULL. Refused (HM_BAD_MESH), `to` unchanged: an
 * inverted cell or a coordinate out of range. Bytes: plan. */
HM_API hm_status hm_improve(hm_plan* plan, const hm_points* from, const hm_points_out* to,
                            hm_memory* memory, const hm_improve_options* options,
                            hm_improve_report* report, hm_error* err);

#ifdef __cplusplus
}
#endif
#endif
