/* Calls that the pages and the program have in common, mostly for pictures: the values of each cell
 * and of each wall point, of which the headers tell extremes and means. They are no part of the
 * interface: this file is not installed. The module of the pages contains them, and so does the
 * program. */
#ifndef HARMORPH_WEB_PAGE_H
#define HARMORPH_WEB_PAGE_H

#include <harmorph_design.h>
#include <harmorph_fields.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The area of each cell before anything moves: area [n_cells]. */
HM_API hm_status hm_web_areas(const hm_basis* basis, const hm_mesh* mesh, double* area,
                              hm_error* err);

/* The quality of each cell after the displacement, as hm_assess judges it: quality [n_cells]; 0 for
 * inverted cells. displacement NULL: zero. */
HM_API hm_status hm_web_cells(const hm_basis* basis, const hm_mesh* mesh,
                              const hm_points* displacement, double* quality, hm_error* err);

/* The triangles and quadrilaterals of which cells consist: start [n_cells + 1], and four points for
 * each piece, counted from 0; a triangle repeats its last point. points NULL: not wanted. */
HM_API hm_status hm_web_pieces(const hm_basis* basis, const hm_mesh* mesh, int32_t* start,
                               int32_t* points, hm_error* err);

/* How the first layer has changed between mesh points `before` and `at`, for each wall point in the
 * order of hm_walls_info: angle [n_wall_points] between the wall and the edge in degrees, and
 * height [n_wall_points], after over before; 0 and 1 without an edge. hm_safe_report has the
 * extremes of both. */
HM_API hm_status hm_web_layer(const hm_walls* walls, const hm_points* before, const hm_points* at,
                              double* angle, double* height, hm_error* err);

/* The curvature comb of a curve at n parameters u: points [2*n] of the curve, and teeth [2*n], the
 * other ends of lines at right angles to the curve, on its right where it turns left. Their length
 * is .02 chord sqrt(chord |curvature|), so that teeth at the leading edge and along the sides are
 * visible together. chord [length] > 0. */
HM_API hm_status hm_web_comb(const hm_curves* curves, int32_t curve, int32_t n, const double* u,
                             double chord, double* points, double* teeth, hm_error* err);

/* The sine and the cosine of an angle [radians], up to 1e5 in magnitude with an error of about half
 * a unit in the last place, from operations that are rounded alike everywhere. */
HM_API void hm_web_sine(double angle, double* sine, double* cosine);

/* NACA's four-digit sections at a station [chords, 0..1], see HM_NACA4: the camber line of 1 chord
 * with its largest camber at the station `peak`, its slope, and half of the thickness of 1 chord.
 */
HM_API void hm_web_naca(double peak, double station, double* camber, double* slope,
                        double* half_thickness);

#ifdef __cplusplus
}
#endif

#endif
