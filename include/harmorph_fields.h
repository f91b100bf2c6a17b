/* harmorph for flow solvers on moving meshes: swept areas, wall distances and heights of the first
 * layer, coarse levels of control volumes, interpolation and conservative transfer of fields from
 * one mesh to another. The conventions of harmorph.h hold. */
#ifndef HARMORPH_FIELDS_H
#define HARMORPH_FIELDS_H

#include "harmorph_study.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Swept areas: the discrete geometric conservation law ---- */

/* Number of entries of the arrays of hm_swept_areas: one for each entry of the lists of cell
 * points. The entries of a cell follow each other, and the cells follow in their order: 3 entries
 * for a triangle of HM_CELLS_TRIANGLES and of the triangles of HM_CELLS_MIXED, 4 for a cell of
 * HM_CELLS_QUADS, HM_CELLS_STRUCTURED, HM_CELLS_BLOCKS and the quadrilaterals of HM_CELLS_MIXED,
 * as many as the cell has points in HM_CELLS_ROWS and HM_CELLS_POLYGONS (the first entry of cell i
 * is cell_start[i] - index_base). */
HM_API hm_status hm_swept_count(const hm_mesh* mesh, int64_t* n, hm_error* err);
/* Computes the areas that lines of the mesh sweep while each point moves linearly in time from its
 * place in `from` to its place in `to`. Points [n_points]; from NULL: the mesh's own coordinates.
 * Entry k, from 0, of a cell belongs to side k, which runs from point k of the cell to the next
 * point (the last side runs to point 0). Point k is that of the list of the cell; in structured
 * meshes and blocks the points of cell (i,j) are (i,j), (i+1,j), (i+1,j+1), (i,j+1). Where a
 * triangle repeats its last point, the side between the repetitions has the area 0.
 *   sides   [n] side k
 *   duals   [n] the face of the median dual in this cell that runs from the middle of side k to the
 *           mean of the points of the cell, between the control volumes of the points of the side
 *   halves  [2*n] entries 2k and 2k+1: the halves of side k at its first and at its second point,
 *           which bound the control volumes of boundary points
 * An array that is NULL is not computed; not all may be NULL. Unit: length^2. An area is positive
 * where the line moves to its right, seen along its direction. For a cell whose points are
 * counter-clockwise, a side that moves outwards therefore has a positive area, and
 *   new area - old area of the cell = sum over its sides k of sides[k]
 *   new area - old area of a control volume = sum over the cells around its point, where the point
 *           is point k, of duals[k] - duals[k-1] + halves[2k] + halves[2(k-1)+1]
 * (k-1 is the last side for k = 0). The halves of a side inside the mesh cancel between its two
 * cells and may be left out there. For a clockwise cell, both sums change sign. Each sum holds to
 * 4 * 2^-52 times the sum of the absolute areas in it, as each number is computed with twice the
 * precision of doubles and rounded to a double. A side has exactly opposite areas in its two cells.
 * Lines that do not move have exactly 0. executor NULL: one thread. A refused call leaves the
 * arrays as they were. */
HM_API hm_status hm_swept_areas(const hm_mesh* mesh, const hm_points* from, const hm_points* to,
                                double* sides, double* duals, double* halves,
                                const hm_executor* executor, hm_error* err);

/* ---- Distances to the walls ---- */

/* The faces of chosen markers in one position of the mesh. */
typedef struct hm_walls hm_walls;

/* analysis: that of the mesh, with conditions or without (hm_problem). markers [n_markers],
 * n_markers >= 1: the markers of the walls; a marker that no face has is refused
 * (HM_BAD_CONDITION). at [n_points]: the coordinates of the mesh points; NULL: those of the mesh.
 * The walls keep all that they need in their block: analysis, mesh and `at` are not needed
 * afterwards. */
HM_API hm_status hm_walls_size(const hm_analysis* analysis, int32_t n_markers,
                               const int32_t* markers, size_t* bytes, hm_error* err);
HM_API hm_status hm_walls_init(hm_walls** walls, void* block, size_t bytes,
                               const hm_analysis* analysis, int32_t n_markers,
                               const int32_t* markers, const hm_points* at, hm_error* err);
/* Moves the walls to the mesh points `at` [n_points], after a morph for instance. The time is
 * proportional to the number of faces. Refused (HM_BAD_MESH), the walls unchanged: a coordinate of
 * a wall point that is not finite or larger than 1e100. */
HM_API hm_status hm_walls_move(hm_walls* walls, const hm_points* at, hm_error* err);

typedef struct hm_walls_info {
    uint64_t struct_size;
    int32_t n_faces, n_wall_points;
    /* The arrays are in the block of the walls. Points, and faces in the calls below, are counted
     * from the index_base of the mesh. Of points that a cut joins, the first one is named. */
    const int32_t* face_points;  /* [2*n_faces] in order along the boundary, the mesh on the left */
    const int32_t* face_markers; /* [n_faces] */
    const int32_t* wall_points;  /* [n_wall_points] the points of the faces */
    /* [n_wall_points] the other end of the mesh edge at the wall point that is nearest to the
     * normal: the first layer; -1: no edge leaves the wall there */
    const int32_t* layer_points;
} hm_walls_info;
HM_API hm_status hm_walls_info_get(const hm_walls* walls, hm_walls_info* info, hm_error* err);

/* Distances of n points to the nearest place on the walls: mesh points, centres of cells or any
 * others. Periodic images of walls and other boundaries are not considered.
 *   hint      [n] faces that are probably nearest, such as those before the last movement; NULL:
 *             none. The results are the same bits with any hints; good hints save time. Numbers
 *             that are no faces are no hints. May be the array `face`.
 *   distance  [n] [length] with an error of a few units in the last place of the distance and of
 *             the length of the face times 2^-53; exactly 0 at a wall point
 *   face      [n] the nearest face; of faces at equal distances, the first one; NULL: not wanted
 *   parameter [n] t in 0..1: the nearest place is (1-t) * first + t * second point of the face;
 *             NULL: not wanted
 * executor NULL: one thread. Refused (HM_BAD_MESH), the outputs unchanged: a point that is not
 * finite or larger than 1e100; error.item counts from index_base. */
HM_API hm_status hm_wall_distance(const hm_walls* walls, int32_t n, const hm_points* points,
                                  const int32_t* hint, double* distance, int32_t* face,
                                  double* parameter, const hm_executor* executor, hm_error* err);
/* Computes the derivative of the distances of the same points, each to the face [n] that
 * hm_wall_distance found nearest: change [n] = n . (point_change - (1-t) first_change - t
 * second_change), with the unit vector n from the nearest place to the point (at distance 0: the
 * normal of the face into the mesh). point_change [n]: changes of the points; NULL: 0. mesh_change
 * [n_points]: changes of the mesh points; NULL: 0. Where two faces are nearest, this is the
 * derivative on one side. */
HM_API hm_status hm_wall_distance_change(const hm_walls* walls, int32_t n, const hm_points* points,
                                         const int32_t* face, const hm_points* point_change,
                                         const hm_points* mesh_change, double* change,
                                         hm_error* err);
/* The transpose: from dj [n], the derivatives of an objective with respect to the distances, it
 * adds the derivatives with respect to the points to point_dj [n], and those with respect to the
 * mesh points to mesh_dj [n_points]. Where the points are the mesh points, both may be the same
 * arrays. NULL: not wanted. */
HM_API hm_status hm_wall_distance_adjoint(const hm_walls* walls, int32_t n, const hm_points* points,
                                          const int32_t* face, const double* dj,
                                          const hm_points_out* point_dj,
                                          const hm_points_out* mesh_dj, hm_error* err);
/* Computes the heights of the first layer at the mesh points `at` [n_points]: for each wall point,
 * the distance of the other end of the first-layer edge from the wall, in the direction of the
 * normal of the wall at the wall point [length]; 0 where there is no such edge. heights
 * [n_wall_points]. */
HM_API hm_status hm_first_layer(const hm_walls* walls, const hm_points* at, double* heights,
                                hm_error* err);

/* ---- Coarse levels of control volumes, for multigrid flow solvers ---- */

/* The control volumes of the median dual of a mesh, merged level by level. */
typedef struct hm_levels hm_levels;

/* analysis: that of the mesh, with conditions or without; the analysis must exist as long as the
 * levels. at [n_points]: the coordinates by which volumes are merged; NULL: those of the mesh.
 * agglomeration: HM_AGGLOMERATE_... of harmorph_study.h, here with the length of the common face of
 * two volumes, divided by the length of the mesh edge, as conductance: HM_AGGLOMERATE_DIRECTIONAL
 * merges across the layers of thin cells, HM_AGGLOMERATE_ISOTROPIC whatever the shapes of cells.
 * max_levels 0 .. 20, the finest level included; 0: as many as there are. Each level has at most a
 * third of the volumes of the next finer one; levels end where this fails, or at 48 volumes. All
 * volumes are connected. Points that a cut joins, and in an analysis with conditions those of
 * pairs, have one volume; polygons count as the triangles and quadrilaterals into which the library
 * divides them.
 */
HM_API hm_status hm_levels_size(const hm_analysis* analysis, size_t* bytes, hm_error* err);
HM_API hm_status hm_levels_init(hm_levels** levels, void* block, size_t bytes,
                                const hm_analysis* analysis, const hm_points* at,
                                int32_t agglomeration, int32_t max_levels, hm_error* err);
/* cells [n_points] receives for each point the number, from 0, of the volume of this level that
 * contains the volume of the point; -1 for points that no cell uses. Level 0 is the finest.
 * *n_cells: the volumes of the level; *n_levels: all levels. Each of the three may be NULL. The
 * volumes of one level are unions of those of finer levels. */
HM_API hm_status hm_level_cells(const hm_levels* levels, int32_t level, int32_t* cells,
                                int32_t* n_cells, int32_t* n_levels, hm_error* err);
/* areas [n_cells of the level] [length^2] receives the areas of the volumes at the mesh points `to`
 * [n_points], or, with `from` [n_points], the increase of these areas from `from` to `to`. The sum
 * over the corners of cells is rounded; each of its terms is computed with twice the precision of
 * doubles. The increase is the sum of the areas that the faces of the volume sweep (hm_swept_areas,
 * duals and halves), except for rounding. */
HM_API hm_status hm_level_areas(const hm_levels* levels, int32_t level, const hm_points* from,
                                const hm_points* to, double* areas, hm_error* err);

/* ---- Fields of one mesh on another ---- */

/* Where points are in a mesh, and the weights of the mesh points there. */
typedef struct hm_interpolation hm_interpolation;

typedef struct hm_interpolation_report {
    uint64_t struct_size;
    int32_t outside;            /* points outside the mesh */
    int32_t max_distance_point; /* the point farthest outside, counted from index_base; -1: none */
    double max_distance;        /* [length] its distance from the mesh */
} hm_interpolation_report;

/* analysis: that of the mesh that has the fields, with conditions or without; not needed
 * afterwards. n: number of points to which fields are interpolated, of another mesh for instance, 0
 * .. 2^29.
 */
HM_API hm_status hm_interpolation_size(const hm_analysis* analysis, int32_t n, size_t* bytes,
                                       hm_error* err);
/* Finds each of the n points `to` in the mesh of the analysis at the mesh points `at` [n_points];
 * NULL: the coordinates of the mesh. In a triangle, values are linear; in a quadrilateral they are
 * the mean over its two divisions into triangles, so that linear fields are exact but for rounding,
 * and the error of smooth fields falls with the square of the size of the cells. At a point outside
 * the mesh the value is that of the nearest place of the boundary, linear by arc length between the
 * two points of its face. distance [n] [length] receives 0 at points inside and the distance from
 * the mesh outside; NULL: not wanted. The time does not depend much on the order of the points.
 * Periodic images of the mesh are not considered. executor and report may be NULL. Refused
 * (HM_BAD_MESH): a cell that is inverted at `at`, a point that is not finite or larger than 1e100.
 */
HM_API hm_status hm_interpolation_init(hm_interpolation** interpolation, void* block, size_t bytes,
                                       const hm_analysis* analysis, const hm_points* at, int32_t n,
                                       const hm_points* to, double* distance,
                                       const hm_executor* executor, hm_interpolation_report* report,
                                       hm_error* err);
/* to [n_fields * n] = the values of n_fields fields at the points; from [n_fields * n_points] has
 * the values at the mesh points, one field after the other. The arrays must have no number in
 * common. executor NULL: one thread. */
HM_API hm_status hm_interpolate(const hm_interpolation* interpolation, int32_t n_fields,
                                const double* from, double* to, const hm_executor* executor,
                                hm_error* err);
/* The transpose: from to_dj [n_fields * n], the derivatives of an objective with respect to the
 * interpolated values, it adds the derivatives with respect to the values at the mesh points to
 * from_dj [n_fields * n_points]. */
HM_API hm_status hm_interpolate_adjoint(const hm_interpolation* interpolation, int32_t n_fields,
                                        const double* to_dj, double* from_dj, hm_error* err);

/* ---- Conservative transfer of fields: means over control volumes ---- */

typedef struct hm_remap_report {
    uint64_t struct_size;
    int32_t uncovered; /* volumes of `to` that have no area in common with the mesh `from` */
    int32_t partial;   /* volumes of `to` that are covered, but by less than (1 - 1e-9) of them */
    double area;       /* [length^2] the area that both meshes have in common */
} hm_remap_report;

/* The control volume of a point is that of the median dual: in each cell, the quadrilateral of the
 * point, the middles of both sides at the point, and the mean of the points of the cell. Polygons
 * count as the triangles and quadrilaterals into which the library divides them. Points that a cut
 * joins have a volume each. Points that no cell uses have none. */

/* Bytes of working memory of hm_remap with these meshes, number of fields and order. */
HM_API hm_status hm_remap_size(const hm_analysis* from, const hm_analysis* to, int32_t n_fields,
                               int32_t order, size_t* bytes, hm_error* err);
/* Computes the means of n_fields fields over the control volumes of one mesh from the means over
 * those of another mesh. The common areas of volumes are computed by clipping convex polygons, so
 * that, but for rounding, the integral over the area that both meshes have in common does not
 * change:
 *   sum over j of covered[j] * to_values[j] = integral of the field of `from` over the common area,
 * which is the sum over i of (area of volume i) * from_values[i] if both meshes cover the same
 * domain. from, to: analyses of both meshes, with conditions or without; they may be the same.
 * from_at, to_at [n_points of the mesh]: the coordinates; NULL: those of the mesh.
 *   order        1: the field is constant in each volume of `from`; no new extremum arises.
 *                2: the field is linear in each volume, with its mean and a gradient by least
 *                squares from the means of the volumes around. The means of linear fields are exact
 *                but for rounding, and errors fall with the square of the size of the cells; new
 *                extrema may arise.
 *   from_values  [n_fields * n_points of from] one field after the other
 *   to_values    [n_fields * n_points of to] 0 where covered is 0; no number in common with
 *                from_values
 *   covered      [n_points of to] [length^2] the area that the volume has in common with the mesh
 *                `from`
 *   work         [bytes] free afterwards
 * executor NULL: one thread; report may be NULL. The results are the same bits for any number of
 * threads. Refused, the outputs unchanged: an inverted cell (HM_BAD_MESH), an order other than 1
 * and 2, n_fields < 1. The time is proportional to the number of pairs of cells whose bounding
 * boxes meet. */
HM_API hm_status hm_remap(const hm_analysis* from, const hm_points* from_at, const hm_analysis* to,
                          const hm_points* to_at, int32_t n_fields, int32_t order,
                          const double* from_values, double* to_values, double* covered, void* work,
                          size_t bytes, const hm_executor* executor, hm_remap_report* report,
                          hm_error* err);

#ifdef __cplusplus
}
#endif
#endif
