/* harmorph for flow solvers on moving meshes: swept areas, wall distances and heights of the first
 * layer, coarse levels of control volumes, interpolation of fields from one mesh to another. The
 * conventions of harmorph.h hold. */
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
 * Entry k, from 0, of a cell belongs to side k, which runs from point k of the cell to the next one
 * (the last side runs to point 0); point k is that of the cell's list, and in structured meshes and
 * blocks (i,j), (i+1,j), (i+1,j+1), (i,j+1) for cell (i,j). Where a triangle repeats its last
 * point, the side between the repetitions has the area 0. sides   [n] the side duals   [n] the face
 * of the median dual in this cell, which runs from the middle of side k to the mean of the points
 * of the cell, between the control volumes of the side's points halves  [2*n] entries 2k and 2k+1:
 * the halves of side k at its first and at its second point, which bound the control volumes of
 * boundary points An array that is NULL is not computed; not all may be NULL. Unit: length^2. An
 * area is positive where the line moves to its right, seen along its direction. So, for the cell
 * with its points counter-clockwise, a side that moves outwards has a positive area, and new area -
 * old area of the cell           = sum of its sides k new area - old area of a control volume   =
 * sum over the cells around its point, where the point is point k: duals[k] - duals[k-1] +
 * halves[2k] + halves[2(k-1)+1] The halves of a side inside the mesh cancel between its two cells
 * and may be left out there. For a clockwise cell, both sums change sign. Each sum holds to 4 *
 * 2^-52 times the sum of the absolute areas in it: each number is computed with twice the precision
 * of doubles and rounded once. A side has exactly opposite areas in its two cells. Lines that do
 * not move have exactly 0. executor NULL: one thread. A refused call leaves the arrays as they
 * were. */
HM_API hm_status hm_swept_areas(const hm_mesh* mesh, const hm_points* from, const hm_points* to,
                                double* sides, double* duals, double* halves,
                                const hm_executor* executor, hm_error* err);

#ifdef __cplusplus
}
#endif
#endif
