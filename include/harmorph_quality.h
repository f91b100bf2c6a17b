/* harmorph for optimisers: the quality of a mesh as a smooth constraint with exact derivatives, and
 * the derivative of the admissible step. The conventions of harmorph.h hold.
 *
 * An optimiser moves control points, and the cells of the mesh must remain good. hm_assess returns
 * the smallest quality, which has no derivative where two cells compete. hm_quality_bounds returns
 * a smooth bound of the smallest quality and the derivatives of this bound with respect to all mesh
 * points. These calls change the derivatives into those with respect to other unknowns:
 *   hm_adjoint            control points, rigid bodies, variables of a combined basis (hm_combine)
 *   hm_displace_adjoint   displacements of wall points
 *   hm_slip_adjoint       points before hm_slip, to which the two above then apply */
#ifndef HARMORPH_QUALITY_H
#define HARMORPH_QUALITY_H

#include "harmorph.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- The mesh to compare with ---- */

/* Remembers the start mesh, with which all values of hm_quality_bounds are compared: the start
 * coordinates, and the edges of the first layer at the walls. */
typedef struct hm_quality hm_quality;

/* basis: a basis of the mesh, solved or not; mesh: as in hm_assess. start [n_points]: the
 * coordinates to compare with; NULL: the mesh's own coordinates. The coordinates are copied, so the
 * mesh may move in place. The basis, and the arrays of the mesh that list cells, must exist as long
 * as the object.
 *
 * The walls are the faces both ends of which are on curves, on rigid bodies, or given (HM_GIVEN).
 * The first layer has one edge for each wall point: the edge of a cell that leaves the wall and is
 * nearest to the normal of the wall at the start. For a polygon that is divided into triangles, the
 * edge may be a side of such a triangle. Refused with HM_BAD_MESH: a cell that is inverted at the
 * start, a coordinate beyond the range; with HM_BAD_BASIS: see hm_assess. Bytes: basis, mesh. */
HM_API hm_status hm_quality_init(hm_quality** quality, hm_memory* memory, const hm_basis* basis,
                                 const hm_mesh* mesh, const hm_points* start, hm_error* err);

/* ---- Smooth bounds ---- */

/* hm_bound.kind selects the values v_1 .. v_N from which the bound is computed. All are pure
 * numbers. None depends on the unit of length, the orientation of cells, or the numbering of
 * points. */
enum {
    /* A lower bound of the smallest quality. There is one value for each cell, Q = f s(t).
     * f is the skew quality of hm_assess: 4 sqrt(3) a / (sum of the squares of the sides) for a
     * triangle of the area a, 4 / (sum of 1 / sin) over the corners of a quadrilateral,
     * m / (sin(2 pi / m) sum of 1 / sin) over the m convex corners of a polygon (1 if m < 3),
     * without the upper limit 1 that hm_assess sets for polygons.
     * s is a smooth size term: s(t) = sqrt(2 t / (1 + t^2)), t the area of the cell divided by the
     * area at the start. s(1) = 1, s'(1) = 0, s''(1) = -1/2, s(t) = s(1/t), and s(t) behaves as
     * sqrt(2 t) for small t. The size term sqrt(min(t, 1/t)) of hm_assess has a kink at t = 1,
     * which is every cell of the start mesh. It is smaller than s(t) by the factor
     * sqrt((1 + min(t, 1/t)^2) / 2), which lies between 0.707 and 1: 0.707 times a bound of this
     * kind is a lower bound of the smallest quality of hm_assess, and where no area changes by more
     * than 20 %, 0.905 times the bound is.
     * A cell of which a corner area is <= 0 has the value Q <= 0: for a triangle f itself, which
     * is then negative; for others 4 times the sum of the sines that are negative. Q is continuous
     * where the area of a corner passes through 0, and the derivative jumps there by a factor. The
     * triangles into which a polygon is divided can invert while its corners remain convex; Q jumps
     * to 0 there, so constrain HM_BOUND_AREA too. */
    HM_BOUND_QUALITY = 0,
    /* A lower bound of the smallest Q / (f at the start): 1 where nothing moves. This kind suits
     * meshes with thin triangles, of which the smallest quality is small from the start. */
    HM_BOUND_KEPT_QUALITY = 1,
    /* A lower bound of the smallest corner area divided by the same area at the start: 1 where
     * nothing moves, <= 0 where a cell is inverted. There is one value for each triangle, four for
     * each quadrilateral, and for other polygons one for each triangle into which the polygon is
     * divided, and one for each corner (harmorph_space.h says what keeps a corner from inverting).
     * Values are polynomials of the coordinates, smooth also where cells are inverted. */
    HM_BOUND_AREA = 2,
    /* A lower bound of the smallest ratio of heights, after / before, of the edges of the first
     * layer. The height of an edge is the distance of its outer end from the wall, along the
     * normal of the start, which rotates with the two faces beside the wall point (mean rotation of
     * both, the shorter face counts more). */
    HM_BOUND_HEIGHT = 3,
    /* An upper bound of the largest ratio of the same heights. */
    HM_BOUND_STRETCH = 4,
    /* A lower bound of the smallest cosine of the change of the angle between the wall and an edge
     * of the first layer: 1 where the angle stays, and smooth there; 0.966 is a change of 15
     * degrees to either side. */
    HM_BOUND_ANGLE = 5
};

typedef struct hm_bound {
    uint64_t struct_size; /* the same in all bounds of one call */
    int32_t kind;         /* HM_BOUND_... */
    int32_t reserved;     /* 0 */
    /* [-] rho of the formula below, 1 .. 1e6; 0 means 200. A larger number makes the bound
     * narrower and less smooth: second derivatives grow with rho. */
    double sharpness;
} hm_bound;

/* Kreisselmeier and Steinhauser's aggregate of the values v, with m the smallest of them:
 *     bound = m - ln(sum_k exp(-rho (v_k - m))) / rho
 * (G. Kreisselmeier, R. Steinhauser, IFAC Proc. 12(7) (1979) 113). It is infinitely differentiable
 * in the values, positive or negative, and never above m: m - ln(N) / rho <= bound <= m. The gap is
 * largest where all values are equal, as those of HM_BOUND_AREA at the start. HM_BOUND_STRETCH has
 * the same formula with the signs of the values and of the bound changed, so bound >= m, the
 * largest value. */
typedef struct hm_bound_value {
    uint64_t struct_size; /* that of the first value holds for all; the call sets the others */
    double bound;
    double extreme;    /* m: the smallest value (HM_BOUND_STRETCH: the largest) */
    int32_t item_kind; /* HM_ITEM_CELL, or HM_ITEM_POINT for the first layer: a wall point */
    int32_t item;      /* the cell, or the wall point, with that value; the first of equal ones */
    int64_t count;     /* N */
} hm_bound_value;

/* Computes n bounds, n >= 1, of the mesh at the coordinates `at` [n_points] (NULL: the mesh's own
 * coordinates now).
 *   values     [n] begin the first with HM_INIT
 *   gradients  [n] where gradients[k] receives the derivatives of bound k with respect to the mesh
 *              points: x: d/dx, y: d/dy [1/length], n_points each, 0 at points that no value uses.
 *              gradients[k].x NULL: not wanted; gradients NULL: none is wanted. The arrays must
 *              have no number in common with each other or with `at`.
 * Derivatives are exact. They are sums of positive weights times derivatives of the values, and the
 * weights add up to 1. One HM_BOUND_QUALITY (or HM_BOUND_KEPT_QUALITY) and one HM_BOUND_AREA are
 * computed in the same pass over the cells. The bits do not depend on the threads or on the kernel.
 * Refused, outputs unchanged: HM_BAD_MESH, a coordinate that is not finite or beyond the range;
 * HM_BAD_ARGUMENT, a kind, sharpness or struct_size out of range (error.item: the entry), and a
 * bound of the first layer of a mesh without edges of a first layer. */
HM_API hm_status hm_quality_bounds(const hm_quality* quality, const hm_points* at, int32_t n,
                                   const hm_bound* bounds, hm_bound_value* values,
                                   const hm_points_out* gradients, const hm_executor* executor,
                                   hm_error* err);

/* ---- The derivative of the admissible step ---- */

/* A corner whose area becomes 0 along a displacement. */
typedef struct hm_step_corner {
    double step; /* [-] where the area becomes 0: at the points from + step * displacement */
    int32_t cell;
    /* The point before the corner, the corner, the point after the corner, counter-clockwise around
     * the cell; counted from mesh.index_base. */
    int32_t points[3];
    /* [1/length] x,y pairs of these points: the derivatives of `step` with respect to `from`. Those
     * with respect to the displacement are `step` times as large. */
    double by_from[6];
} hm_step_corner;

/* Lists the corners that limit the admissible step of hm_assess: those whose step is at most (1 +
 * closeness) times the smallest one, the smallest first; of equal steps, in the order of the cells.
 * *n: their number, 0 if there is no limit. corners [capacity], at least 1: receives the first of
 * them, at most `capacity`; *n may be larger. closeness [-]: 0 .. 1.
 *
 * Let the points move by p and the displacement change by w; then corner c changes its step by g_c
 * = sum over its three points of by_from . (p + step w). Where one corner limits the step (*n = 1
 * with closeness 0), g_1 is the derivative of the admissible step. Where several compete, the
 * admissible step has one-sided derivatives only: the smallest g_c in this direction, and minus the
 * smallest g_c of the opposite direction, that is the largest g_c, from the other side. Rounding
 * makes the steps of corners that compete exactly differ by about 1e-13: use a closeness of 1e-10.
 * For a gradient by control points, add step * by_from to arrays dj that are 0 elsewhere, for
 * hm_adjoint. All other arguments are as in hm_assess, but displacement must not be NULL; the first
 * touch of the boundary is not considered. Refused with HM_BAD_MESH, outputs unchanged: an inverted
 * cell at `from`; a corner whose area only touches 0, so that the step has no derivative
 * (error.item: the cell). */
HM_API hm_status hm_step_gradient(const hm_basis* basis, const hm_mesh* mesh, const hm_points* from,
                                  const hm_points* displacement, double closeness, int32_t capacity,
                                  hm_step_corner* corners, int32_t* n, const hm_executor* executor,
                                  hm_error* err);

#ifdef __cplusplus
}
#endif
#endif
