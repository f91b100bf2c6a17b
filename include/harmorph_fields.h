/* harmorph for flow solvers on moving meshes: swept areas, wall distances, heights of the first
 * layer, and interpolation of fields from one mesh to another. The conventions of harmorph.h
 * hold. */
#ifndef HARMORPH_FIELDS_H
#define HARMORPH_FIELDS_H

#include "harmorph.h"

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
 * afterwards. Bytes: analysis, n_markers, markers. */
HM_API hm_status hm_walls_init(hm_walls** walls, hm_memory* memory, const hm_analysis* analysis,
                               int32_t n_markers, const int32_t* markers, const hm_points* at,
                               hm_error* err);
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
/* Measures the first layer at the mesh points `at` [n_points], and compares it with the mesh points
 * `before` [n_points]. Each array has one number for each wall point, [n_wall_points]; an array
 * that is NULL is not computed, and not all may be NULL.
 *   heights  [length] at `at`: the distance of the other end of the first-layer edge from the wall,
 *            in the direction of the normal of the wall at the wall point; 0 without such an edge
 *   ratios   [-] the height at `at` divided by the height at `before`, both in the direction of the
 *            normal at `before`, which rotates with the faces beside the wall point; 1 without edge
 *   angles   [degrees] >= 0: by how much the edge has rotated more than these faces; 0 without edge
 * before NULL: ratios and angles must be NULL. hm_safe_report has the extremes and means of ratios
 * and angles of all walls. Refused (HM_BAD_MESH): a point of the layer beyond the range, a height
 * of 0 at `before`. */
HM_API hm_status hm_first_layer(const hm_walls* walls, const hm_points* before, const hm_points* at,
                                double* heights, double* ratios, double* angles, hm_error* err);

/* ---- Fields of one mesh on another ---- */

/* Where points are in a mesh, and the weights of the mesh points there. */
typedef struct hm_interpolation hm_interpolation;

typedef struct hm_interpolation_report {
    uint64_t struct_size;
    int32_t outside;            /* points outside the mesh */
    int32_t max_distance_point; /* the point farthest outside, counted from index_base; -1: none */
    double max_distance;        /* [length] its distance from the mesh */
} hm_interpolation_report;

/* Finds each of the n points `to`, 0 .. 2^29, of another mesh for instance, in the mesh that has
 * the fields, at its points `at` [n_points]; NULL: the coordinates of the mesh. analysis: that of
 * the mesh, with conditions or without; not needed afterwards. In a triangle, values are linear; in
 * a quadrilateral they are the mean over its two divisions into triangles, so that linear fields
 * are exact but for rounding, and the error of smooth fields falls with the square of the size of
 * the cells. At a point outside the mesh the value is that of the nearest place of the boundary,
 * linear by arc length between the two points of its face. distance [n] [length] receives 0 at
 * points inside and the distance from the mesh outside; NULL: not wanted. The time does not depend
 * much on the order of the points. Periodic images of the mesh are not considered. executor and
 * report may be NULL. Refused (HM_BAD_MESH): a cell that is inverted at `at`, a point that is not
 * finite or larger than 1e100. Bytes: analysis, n. */
HM_API hm_status hm_interpolation_init(hm_interpolation** interpolation, hm_memory* memory,
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

#ifdef __cplusplus
}
#endif
#endif
