/* harmorph for meshes in other arrangements: meshes one cell thick, structured blocks in arrays of
 * their own, meshes given as edges without cells, polygons. The conventions of harmorph.h hold. */
#ifndef HARMORPH_SPACE_H
#define HARMORPH_SPACE_H

#include "harmorph.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Three-dimensional codes with two-dimensional meshes ---- */

/* For solvers that have three dimensions only, and meshes one cell thick. The library finds the
 * mesh of one symmetry plane, and which point of that plane each point follows; analysis, plan and
 * basis are those of the mesh of the plane. Points may form any number of layers: a plane mesh that
 * was extruded by several cells is treated in the same way.
 *
 * HM_PLANES: the layers are parallel planes of any direction; each is the mesh of the plane,
 * translated along the normal.
 *
 * HM_WEDGE: the layers are the mesh of the plane, rotated about an axis that lies in the plane and
 * does not cross the mesh; points on the axis belong to all layers.
 *
 * Coordinates of the plane: x-y if the normal is z, x-z if the normal is y, y-z if the normal is x,
 * with the bits of the given coordinates; in an inclined plane, right-angled coordinates whose
 * origin is the point nearest to the origin; in a wedge, x along the axis and y the distance from
 * the axis. hm_plane_info has the directions. */
/* hm_space_mesh.kind */
enum {
    /* HM_WEDGE if the points that no face has lie in one plane inclined to the faces: the axis is a
     * coordinate axis if one lies in both planes, otherwise the line where the planes meet.
     * HM_PLANES otherwise. */
    HM_SPACE_AUTO = 0,
    HM_PLANES = 1,
    HM_WEDGE = 2
};

/* The same as hm_points with three coordinates. The struct will always have 32 bytes. */
typedef struct hm_space_points {
    const double *x, *y, *z;
    int64_t stride; /* [doubles] from one point to the next, >= 1; 0 means 1 */
} hm_space_points;

typedef struct hm_space_points_out {
    double *x, *y, *z;
    int64_t stride;
} hm_space_points_out;

typedef struct hm_space_mesh {
    uint64_t struct_size;
    /* 0 or 1: the first number of points, faces and sides in all arrays and reports, and of the
     * points and cells of the mesh of the plane */
    int32_t index_base;
    int32_t n_points;       /* 3 .. 2^30: all points of the mesh of three dimensions */
    hm_space_points points; /* [n_points] coordinates */
    int32_t kind;           /* HM_SPACE_AUTO, HM_PLANES, HM_WEDGE */
    /* 1 .. 2^29: the faces in one symmetry plane, of 3 to 1024 points; they are the cells of the
     * mesh of the plane, in this order */
    int32_t n_faces;
    /* [n_faces+1] counted from index_base; NULL: each face has four entries */
    const int32_t* face_start;
    /* the points of each face in order; where each face has four entries, a triangle repeats its
     * last point */
    const int32_t* face_points;
    /* faces of the boundary from one layer to the next; 0: none, then the caller adds the boundary
     * to the mesh of the plane */
    int32_t n_sides;
    /* [4*n_sides] in order; a triangle, at the axis of a wedge, repeats a point */
    const int32_t* side_points;
    const int32_t* side_markers; /* [n_sides] any integers: markers of the mesh of the plane */
    double axis_point[3];        /* wedge only: a point of the axis [length] */
    /* wedge only: the direction of the axis, of any length; 0,0,0: the library finds the axis (two
     * layers only) */
    double axis[3];
    /* [length] how far a point may be from the place of its plane point, and a point of a face from
     * the plane; 0 means 1e-5 of the extent of all points. A point that is farther away than a
     * quarter of the shortest edge at the plane point is always refused. */
    double tolerance;
} hm_space_mesh;

typedef struct hm_plane hm_plane;

/* Finds the mesh of the plane; `space` and its arrays are not needed afterwards. Where several
 * points of the plane lie at one place to 1e-4 of the tolerance (the two sides of a cut, of a
 * sliding interface, or of a plate without thickness), a point of another layer follows the one to
 * which an edge of a side joins it; points without such an edge follow in the order of their
 * numbers. Refused (HM_BAD_MESH, error.item: the point or side, error.value: the distance): a
 * point of a face outside the plane of the others; a point that is opposite to no point of the
 * plane, as in a mesh that is not one cell thick; a point of the plane that no point of another
 * layer follows; a side that does not have exactly two different points of the plane. Bytes: space,
 * of which the query reads the counts alone (points, faces, corners of faces, sides) and kind. */
HM_API hm_status hm_plane_init(hm_plane** plane, hm_memory* memory, const hm_space_mesh* space,
                               hm_error* err);

typedef struct hm_plane_info {
    uint64_t struct_size;
    int32_t kind;           /* HM_PLANES or HM_WEDGE */
    int32_t n_points;       /* of the mesh of the plane */
    int32_t n_space_points; /* of the mesh of three dimensions */
    /* the largest number of points that follow one point of the plane, including that point */
    int32_t layers;
    /* the point (x, y) of the plane is origin + x * x_direction + y * y_direction */
    double origin[3];
    /* unit vectors, right-handed; wedge: x_direction is the axis */
    double x_direction[3], y_direction[3], normal[3];
    /* [length] largest distance of a point from the place of its plane point */
    double max_distance;
    int32_t max_distance_point; /* the point with that distance; -1: all are exact */
    int32_t reserved;           /* 0 */
    /* [n_space_points] the plane point that each point follows, counted from index_base */
    const int32_t* follows;
    /* [n_points] the number of each plane point in the mesh of three dimensions, counted from
     * index_base, in increasing order */
    const int32_t* space_point;
} hm_plane_info;
HM_API hm_status hm_plane_info_get(const hm_plane* plane, hm_plane_info* info, hm_error* err);
/* The mesh of the plane, for hm_problem.mesh: coordinates, cells, faces with markers. The arrays
 * are inside the block of the plane and do not change. mesh->struct_size is set by the caller. */
HM_API hm_status hm_plane_mesh(const hm_plane* plane, hm_mesh* mesh, hm_error* err);

/* Does hm_morph for all points: to = from + the movement of the plane point that each point
 * follows, in the plane; in a wedge, along the axis and along the radius at the angle that the
 * point had in hm_plane_init. The basis must be one of the mesh of the plane. Rules for from, to
 * and NULL are those of hm_morph. A coordinate across the layers (of coordinate planes) and points
 * that do not move keep their bits. The call writes working arrays of the plane: one thread at a
 * time may call hm_plane_morph or hm_plane_adjoint. */
HM_API hm_status hm_plane_morph(hm_plane* plane, const hm_basis* basis, const double* move,
                                const hm_space_points* from, const hm_space_points_out* to,
                                const hm_executor* executor, hm_error* err);
/* The transpose: dj are derivatives with respect to the three coordinates of all points; gradient
 * [2*functions] is that of hm_adjoint. The layers are summed in the order of the numbers of the
 * points. */
HM_API hm_status hm_plane_adjoint(hm_plane* plane, const hm_basis* basis, const hm_space_points* dj,
                                  double* gradient, const hm_executor* executor, hm_error* err);
/* The steps between the plane and the mesh, for displacements from elsewhere (hm_displace, or
 * hm_move_safe minus the points of the mesh). hm_plane_spread: to = from + displacement [n_points]
 * of the plane point that each point follows. hm_plane_gather, the transpose: plane_dj [n_points]
 * receives dj, summed over the layers. */
HM_API hm_status hm_plane_spread(const hm_plane* plane, const hm_points* displacement,
                                 const hm_space_points* from, const hm_space_points_out* to,
                                 const hm_executor* executor, hm_error* err);
HM_API hm_status hm_plane_gather(const hm_plane* plane, const hm_space_points* dj,
                                 const hm_points_out* plane_dj, const hm_executor* executor,
                                 hm_error* err);

/* ---- Structured blocks in arrays of their own ---- */

/* Solvers with several blocks mostly have arrays for each of them, often with layers of ghost
 * points around. The mesh (HM_CELLS_BLOCKS) and all calls with points of it have the blocks one
 * after the other: keep one pair of arrays [n_points] for mesh.points, fill the pair by
 * hm_blocks_gather, and copy results back by hm_blocks_scatter. Results are coordinates after
 * hm_morph, displacements, or derivatives for hm_adjoint, for which all copies of a point on an
 * interface count.
 *
 * The numbers of the point i, j of one block, i and j from 0, are x[i*stride + j*row] and
 * y[i*stride + j*row]. Fortran's x(0:ni+1, 0:nj+1), with the block inside one layer of ghost
 * points: {&x(1,1), &y(1,1), 1, ni + 2}. A C array x[i][j], j the faster index: {x, y, nj, 1}. */
/* Points that a call reads. The struct will always have 32 bytes. */
typedef struct hm_block_points {
    const double *x, *y;
    int64_t stride; /* [doubles] from i to i+1, >= 1; 0 means 1 */
    int64_t row;    /* [doubles] from j to j+1, >= 1; 0 means ni*stride. Both at most 2^40 */
} hm_block_points;

/* Points that a call writes, in the same layout. stride and row must keep the points apart. */
typedef struct hm_block_points_out {
    double *x, *y;
    int64_t stride, row;
} hm_block_points_out;

/* Copies the blocks first .. first+n-1, from 0, of a mesh with HM_CELLS_BLOCKS: from `blocks` [n]
 * to their places in `to` [n_points] (gather), or from `from` [n_points] to `blocks` [n] (scatter).
 * All other numbers stay as they are. Only the sizes of the blocks are read of the mesh;
 * mesh.points need not have values yet. Arrays read and arrays written must have no number in
 * common. */
HM_API hm_status hm_blocks_gather(const hm_mesh* mesh, int32_t first, int32_t n,
                                  const hm_block_points* blocks, const hm_points_out* to,
                                  hm_error* err);
HM_API hm_status hm_blocks_scatter(const hm_mesh* mesh, int32_t first, int32_t n,
                                   const hm_points* from, const hm_block_points_out* blocks,
                                   hm_error* err);

/* ---- Meshes given as edges ---- */

/* A mesh as edge-based codes store it: edges with the cells on both sides, and no list of cells. */
typedef struct hm_edge_mesh {
    uint64_t struct_size;
    int32_t index_base;         /* 0 or 1: the first number of points and cells */
    int32_t n_points;           /* 3 .. 2^30 */
    hm_points points;           /* [n_points] coordinates */
    int32_t n_cells;            /* 1 .. 2^29 */
    int32_t n_edges;            /* 3 .. 2^30 */
    const int32_t* edge_points; /* [2*n_edges] the two points of each edge */
    /* [2*n_edges] the cells on both sides of each edge, in either order; index_base - 1: none. */
    const int32_t* edge_cells;
    /* [n_edges] the marker of each edge that has one cell, or HM_NO_MARKER; not read for edges with
     * two cells. NULL: the caller adds faces or lists to the mesh. */
    const int32_t* edge_markers;
} hm_edge_mesh;

/* *mesh, for which the caller has called HM_INIT, receives views of the points of the caller and of
 * the cells and faces in the block; the arrays of edges are not needed afterwards. The layout is
 * HM_CELLS_ROWS if all cells have 3 or 4 sides, otherwise HM_CELLS_POLYGONS. Refused (HM_BAD_MESH,
 * error.item: the cell): edges of a cell that do not form one closed loop of 3 to 1024 sides.
 * Bytes: edges. */
HM_API hm_status hm_mesh_from_edges(hm_mesh* mesh, hm_memory* memory, const hm_edge_mesh* edges,
                                    hm_error* err);

/* ---- Polygons (HM_CELLS_POLYGONS) ---- */

/* A point that lies on a side of a cell (a hanging node) is a corner of that cell, so that any two
 * neighbours have the points of their common sides in common. At the coordinates of
 * hm_analysis_init, a corner is convex if the tangent of its exterior angle is above 1/8 (interior
 * angle below 172.8 degrees), flat within this tolerance, or reflex. Triangles, and quadrilaterals
 * with four convex corners, are treated as in the other layouts. Every other cell is divided into
 * triangles without new points, such that the worst triangle is as good as possible; the operators
 * act on these triangles, so linear fields are exact. The division belongs to the analysis and to
 * the bases made from the analysis, and does not change when the points move.
 * Such a cell is inverted if one of its triangles has an area <= 0, or a corner leaves its range of
 * interior angles: 0 to 180 degrees if it was convex, 45 to 225 if it was flat (a hanging node may
 * bend by 45 degrees towards the inside), 135 to 315 if it was reflex. So the area of a valid cell
 * is positive. Admissible steps are exact for this definition.
 * Quality of such a cell with m convex corners of areas A_k between sides a_k and b_k:
 * m / (sin(2 pi / m) sum_k |a_k| |b_k| / (2 A_k)), at most 1: 1 if all angles are equal, as for a
 * rectangle with hanging nodes; 1 if m is smaller than 3, because all other corners are nearly
 * flat; 0 if the cell is inverted. */

#ifdef __cplusplus
}
#endif
#endif
