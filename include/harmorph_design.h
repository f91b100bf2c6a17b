/* harmorph for design: evaluation, refinement and measures of curves, design variables, and points
 * that slip along curves. The conventions of harmorph.h hold. */
#ifndef HARMORPH_DESIGN_H
#define HARMORPH_DESIGN_H

#include "harmorph.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Evaluation ---- */

/* Checks that the curves are well-formed. Two knots must differ by 0 or by at least 1e-18 of the
 * range of all knots. */
HM_API hm_status hm_curves_check(const hm_curves* curves, hm_error* err);
/* The degree+1 B-spline basis functions (rational ones if there are weights) that are not 0 at u.
 * control [degree+1] receives their control points, values [(n_derivatives+1)*(degree+1)] in row d
 * the d-th derivatives with respect to u; 0 <= n_derivatives <= 5. (Piegl & Tiller, The NURBS Book,
 * A2.3 and eq. 4.8.) */
HM_API hm_status hm_curve_basis(const hm_curves* curves, int32_t curve, double u,
                                int32_t n_derivatives, int32_t* control, double* values,
                                hm_error* err);
/* C(u) and its derivatives: xy [2*(n_derivatives+1)], x,y pairs. */
HM_API hm_status hm_curve_point(const hm_curves* curves, int32_t curve, double u,
                                int32_t n_derivatives, double* xy, hm_error* err);
/* The parameter u of the curve point nearest to (x, y), and the distance [length], by a global
 * search and Newton's method. */
HM_API hm_status hm_curve_project(const hm_curves* curves, int32_t curve, double x, double y,
                                  double* u, double* distance, hm_error* err);

/* ---- Points of a boundary, curves of a basis ---- */

/* The points of the given markers in order along the boundary, with the mesh on the left (around a
 * body: clockwise). If the markers form several pieces, `piece` (from 0) selects one. points
 * [capacity]; *n: number of points, also if the capacity is too small (HM_BAD_ARGUMENT); *is_loop:
 * 1 if the piece is closed; the first point is not repeated. A refused call leaves points and
 * *is_loop as they were. */
HM_API hm_status hm_analysis_boundary(const hm_analysis* analysis, int32_t n_markers,
                                      const int32_t* markers, int32_t piece, int32_t* points,
                                      int32_t capacity, int32_t* n, int32_t* is_loop,
                                      hm_error* err);
/* The curves of a basis (index_base 0): those that the basis was solved with (move NULL; control is
 * not used), or those after one movement. In the latter case control [2*n_control] receives the
 * control points of the basis plus `move` (see hm_morph; rigid bodies have no curve), and
 * out->control points there. After several morphs in place, `move` is the sum of their movements,
 * which hm_recover_movement finds from the mesh. curve [capacity >= info.curves] receives the
 * curves, to which out->curve points; all other arrays are inside the basis. */
HM_API hm_status hm_basis_curves(const hm_basis* basis, const double* move, double* control,
                                 hm_curves* out, hm_curve* curve, int32_t capacity, hm_error* err);

/* Further options of a fit: hm_fit_options.details. A field that is 0 has no effect. */
typedef struct hm_fit_details {
    uint64_t struct_size;
    /* [n_weights] 0 .. 1e30, not all 0: factors of the points in the sum of squares, besides the
     * share of the arc length; NULL: all are 1. hm_fit: one for each point; hm_fit_marker: one for
     * each point of the mesh. A point with weight 0 only tells where the curve runs, and does not
     * count in the report. The curves pass through the points at their ends and at corners with any
     * weight. */
    const double* weights;
    int32_t n_weights; /* with weights: n of hm_fit, n_points of the mesh; otherwise 0 */
    /* [length] >= 0: adds smoothing^4 times the integral of |C''|^2 by the arc length to the sum of
     * squares. Waves much shorter than this length are damped; corners stay. Degree >= 2. */
    double smoothing;
    /* [length] > 0: control points (and with them knots, where the errors are) are inserted, from
     * degree + 1 up to options.n_control, until report.max_error is at most this; each step adds
     * one control point, or an eighth of their number if that is more. HM_FAR_FROM_POINTS:
     * n_control points do not suffice; the curve is that of the last step. A size query counts
     * n_control. 0: the curve has n_control control points. */
    double tolerance;
    /* Directions of the curve (not the other way round) where it begins and where it ends, of any
     * length; 0,0: free. Degree >= 2, n_control >= 4; not for periodic curves. HM_BAD_CURVE: the
     * points run in the opposite direction there. */
    double begin_x, begin_y, end_x, end_y;
} hm_fit_details;

/* ---- More control points for the same shape ---- */

/* Gives one curve of a set more control points; all points C(u) stay the same but for rounding,
 * also of rational curves, and the other curves of the set are kept. With degree 0 the call inserts
 * n knots u [n] into the curve, in any order; a knot to be repeated stands in u as often as it is
 * inserted. With degree p + 1 the call raises the degree p of the curve by 1; n must be 0.
 *
 * *matrix [finer->n_control * curves->n_control] contains rows M: new control points = M * old ones
 * (of x and of y), and derivatives with respect to the old ones = transpose of M * those with
 * respect to the new ones. Rows sum to 1. Weights are constants here; the new ones are in
 * finer->weights. matrix may be NULL.
 *
 * Control points are numbered anew: first those of the changed curve in its order, then those that
 * only other curves use or no curve. A control point that the change does not touch stays one
 * point, however many curves or ends use it: ties and common ends persist. Periodic curves (the
 * first `degree` points again at the end, with periodic knots) remain periodic; the knot is
 * inserted in all its images.
 *
 * *finer and its arrays and *matrix are inside the block; finer->index_base is that of curves.
 * Refused with HM_BAD_ARGUMENT: a knot that is not finite or not between the ends of the curve (the
 * beginning of a periodic curve is allowed), another degree; with HM_BAD_CURVE: a multiplicity
 * above the degree, and a degree above 5. (Polar forms: Ramshaw, Comput. Aided Geom. Des. 6 (1989)
 * 323.) Bytes: curves, curve, degree, n, u. */
HM_API hm_status hm_refine(const hm_curves** finer, const double** matrix, hm_memory* memory,
                           const hm_curves* curves, int32_t curve, int32_t degree, int32_t n,
                           const double* u, hm_error* err);

/* ---- Another airfoil on the same knots ---- */

typedef struct hm_refit_report {
    uint64_t struct_size;
    double max_error, rms_error; /* [length] distances of the points from the moved curves */
    /* [length of the curve] of the points where they were placed, from leading to trailing edge */
    double chord;
    /* [length of the curve] width of the blunt base of the points where they were placed, if the
     * curve has no base: both sides were then tapered from the leading edge on, so that the base
     * became one point; 0: no base */
    double closed_width;
    int32_t max_error_point; /* position in the list, counted from curves->index_base */
    int32_t closed;          /* how the outline of the points closes: HM_OPEN, ... */
    /* The point (x, y) was placed at (rotation_x x - rotation_y y + shift_x, rotation_y x +
     * rotation_x y + shift_y); without on_chord the place is that of the point, to rounding. */
    double rotation_x, rotation_y; /* [-] */
    double shift_x, shift_y;       /* [length] of the curve */
} hm_refit_report;

/* Finds the movement of the control points with which the curve of an airfoil becomes another
 * airfoil, through n points in order along its outline: a least-squares fit on the knots of the
 * curve. movement [2*n_control]: x,y pairs, for hm_morph and hm_move_safe; 0 for control points
 * of other curves.
 *   curve     counted from 0; runs from the trailing edge around the airfoil to the trailing edge.
 *             If the following curve has both ends in common with it, that curve is its blunt base
 *             and moves along
 *   points    in either direction. is_loop: the last point is connected to the first one, which is
 *             not repeated; a loop may begin anywhere
 *   on_chord  1: the points are first rotated, scaled and translated so that the line from their
 *             leading to their trailing edge becomes that of the curve; 0: they stay in place
 * Between the points the outline is a cubic spline, with a corner where the points have one. The
 * leading edge is the place of the outline farthest from the trailing edge. An outline without a
 * corner, whose trailing edge is round, begins where the chord of the curve ends (on_chord: at the
 * largest x). report may be NULL. Refused with HM_BAD_CURVE: points that hm_fit refuses, a curve or
 * points that are no such outline, points with a sharp trailing edge for a curve with a blunt base.
 * A failed call leaves movement as it was. (W. Wang, H. Pottmann, Y. Liu, ACM Trans. Graph. 25
 * (2006) 214.)
 * Bytes: curves, curve, n. */
HM_API hm_status hm_refit(const hm_curves* curves, int32_t curve, const hm_points* points,
                          int32_t n, int32_t is_loop, int32_t on_chord, double* movement,
                          hm_refit_report* report, hm_memory* memory, hm_error* err);

/* ---- Smooth gradients ---- */

/* Smooths a gradient with respect to the control points along the curves, so that an optimiser can
 * take long steps and the shape gets no waves. The smoothed gradient s of the gradient g is the
 * solution of (I + L^2 D^-1/2 K D^-1/2) s = g, where D_i is the integral of the basis function N_i
 * over the arc length of the curves, and K_ij that of N_i' N_j'. Changes along less than L = length
 * are damped. The matrix is symmetric and positive definite: s . g > 0, so that -s is a direction
 * of descent; L = 0 returns g. gradient and smoothed [2*n_control]: x,y pairs in any unit; the
 * arrays may be the same. length [length]: 0 .. 1e6 times the extent of the control points. At
 * corners and tied ends both sides are coupled through the control point that they share, and only
 * there; ends that share no control point are independent. A control point that no curve uses keeps
 * its gradient. The shape of s does not depend on the unit of length of g. (A. Jameson, J. Sci.
 * Comput. 3 (1988) 233.) Bytes: curves. */
HM_API hm_status hm_smooth_gradient(const hm_curves* curves, double length, const double* gradient,
                                    double* smoothed, hm_memory* memory, hm_error* err);

/* ---- Measures of a section, with derivatives with respect to the control points ---- */

/* The curves that form the outline of a section, and its chord. */
typedef struct hm_section {
    uint64_t struct_size;
    /* The curves first_curve .. first_curve+n_curves-1 are the outline, each joined to the one
     * before; 1 .. 8 curves; both 0: all curves of the set. A last curve of degree 1 with two
     * control points, after another one, is a blunt base. An outline that is not closed is closed
     * by a straight line. */
    int32_t first_curve, n_curves;
    /* A chord line that does not move, from the leading to the trailing edge. All 0: the chord of
     * the curves, which moves with the control points: its trailing edge is the midpoint of the two
     * ends of the outline (without base), its leading edge the point of the outline farthest from
     * there. Periodic curves have no ends: their chord must be given. */
    double leading_x, leading_y, trailing_x, trailing_y;
} hm_section;

/* hm_quantity.kind */
enum {
    HM_AREA = 0, /* [length^2] enclosed, > 0 for both orientations */
    HM_CENTROID_X = 1,
    HM_CENTROID_Y = 2, /* [length] of the enclosed area */
    /* [length^4] integrals of (y - yc)^2, (x - xc)^2, (x - xc)(y - yc) over the area, (xc, yc) its
     * centroid */
    HM_MOMENT_XX = 3,
    HM_MOMENT_YY = 4,
    HM_MOMENT_XY = 5,
    HM_CHORD = 6, /* [length] of the chord line */
    /* [length] at a station: distance from the lowest to the highest point of the outline on the
     * normal to the chord line through the station */
    HM_THICKNESS = 7,
    /* [length] mean height of these two points above the chord line; "above" is on the left of the
     * direction from the leading to the trailing edge */
    HM_CAMBER = 8,
    HM_MAX_THICKNESS = 9, /* [length] over all stations */
    HM_MAX_CAMBER = 10,   /* [length] the camber of the largest magnitude, with its sign */
    /* [length] radius of curvature at the leading edge: the point of the outline farthest from the
     * trailing edge of the chord; > 0 where the outline is convex */
    HM_LEADING_EDGE_RADIUS = 11,
    /* [degrees, -90 .. 270] interior angle between the two ends of the outline at the trailing
     * edge; 180: the outline is smooth there; negative: the ends have crossed */
    HM_TRAILING_EDGE_ANGLE = 12,
    /* [length] between the two ends, normal to the chord; negative: they have crossed */
    HM_TRAILING_EDGE_GAP = 13,
    /* [length] smallest radius of curvature, > 0; corners do not count */
    HM_MIN_RADIUS = 14,
    /* [1/length^3] integral of (d curvature / d arc length)^2 over the arc length; jumps at knots
     * and corners do not count; degree >= 2 */
    HM_CURVATURE_VARIATION = 15,
    /* [length] smallest signed distance of the outline from a polygon that should fit inside;
     * negative: a part of the polygon is outside. With a sharpness: of the points of the polygon
     * alone, a smooth lower bound. */
    HM_CLEARANCE = 16,
    /* [degrees, -180 .. 180] angle from the x axis to the chord line, counter-clockwise: minus the
     * twist of an airfoil whose leading edge rotates up */
    HM_TWIST = 17,
    /* [length] smallest thickness over the stations from `station` to `last_station`. With a
     * sharpness: a smooth lower bound of the thickness at 65 equidistant stations of this range. */
    HM_MIN_THICKNESS = 18,
    /* [length] smallest distance of the outline from the outline of another body; negative: the
     * bodies overlap, by the depth of the deepest place, which has no unique derivative where it is
     * in the middle of the other body. With a sharpness: a smooth lower bound of the distances of
     * fixed places on both outlines, 4 * degree in each interval of knots. Derivatives are by the
     * control points of both bodies. */
    HM_DISTANCE = 19
};

typedef struct hm_quantity {
    uint64_t struct_size; /* the same in all quantities of one call */
    int32_t kind;         /* HM_AREA, ... */
    /* clearance: points of the polygon, 1 .. 2^20; a polygon of 2 points is a line */
    int32_t n_polygon;
    double station; /* thickness, camber, min thickness: 0 < station < 1 along the chord line */
    /* [2*n_polygon] clearance: x,y pairs; the last point is connected to the first */
    const double* polygon;
    double last_station; /* min thickness: station <= last_station < 1 */
    /* [1/length] clearance, min thickness, distance. 0: the smallest value itself, with the
     * derivative at one place. 1e-100 .. 1e100: the smooth lower bound m - ln(sum_k exp(-sharpness
     * (v_k - m))) / sharpness of the values v_1 .. v_N, m the smallest one: at most ln(N) /
     * sharpness below m. */
    double sharpness;
    /* Distance: the curves other_curve .. other_curve+n_other-1 are the outline of the other body,
     * as in hm_section; none of them is a curve of the section. */
    int32_t other_curve, n_other;
} hm_quantity;

/* Measures n quantities. values [n]. at [2*n], or NULL: the place of each: the point of the chord
 * line for thickness, camber and chord, the centroid for integrals over the area, otherwise a point
 * of the outline. gradients [n * 2*n_control], or NULL: row k contains the derivatives of value k
 * with respect to x and y of each control point, at constant weights. section NULL: all curves,
 * with their own chord. Integrals are evaluated by Gauss rules that are exact for polynomial
 * curves; for rational curves, and for the curvature variation, intervals are halved until nothing
 * changes but rounding. Derivatives are exact. HM_MAX_THICKNESS and HM_MAX_CAMBER follow an extreme
 * at a corner of the outline. Where two places have the same value, the derivative is that of one
 * place; where both sides of the outline have a corner at the station of the extreme, the
 * derivative lies between the derivatives of the two directions. Refused with HM_BAD_CURVE
 * (error.item: the quantity, from 0), outputs unchanged: curves that are not joined or beyond 1e50,
 * no area, no chord, a station where the outline is parallel to the normal of the chord or that the
 * normal meets at less than two points, a leading edge or an outline without curvature, a trailing
 * edge without directions. */
HM_API hm_status hm_measure(const hm_curves* curves, const hm_section* section, int32_t n,
                            const hm_quantity* quantities, double* values, double* at,
                            double* gradients, hm_error* err);

/* ---- Linear design variables of an outline ---- */

/* hm_variables.kind: how one unit of each variable moves the outline */
enum {
    /* Free-form deformation: variable i + (degree_x+1) j is the lattice point i, j of a box. A
     * movement (dx, dy) of a lattice point moves the points inside the box by B_i(x) B_j(y)
     * (dx, dy), Bernstein polynomials; points outside do not move. (Sederberg, Parry 1986) */
    HM_FFD = 0,
    /* Class and shape functions: chord * t^leading_exponent (1-t)^trailing_exponent B_k(t) normal
     * to the chord, n_upper Bernstein polynomials of degree n_upper-1 of the upper side, then
     * n_lower of the lower one; t: station, 0 .. 1. (Kulfan, J. Aircraft 45 (2008) 142) */
    HM_CST = 1,
    /* Bumps chord * sin(pi t^(log .5 / log peak))^width normal to the chord, n_upper on the upper
     * side, then n_lower on the lower side. (Hicks, Henne, J. Aircraft 15 (1978) 407) */
    HM_HICKS_HENNE = 2,
    /* NACA's four-digit sections: n_upper camber lines of 1 chord, each with its largest camber at
     * its peak, and as the last variable the thickness: half of it on either side, closed at t = 1;
     * 1 unit is a thickness of 1 chord. n_upper may be 0. */
    HM_NACA4 = 3
};

/* Fields that belong to another kind must be 0. */
typedef struct hm_variables {
    uint64_t struct_size;
    int32_t kind; /* HM_FFD, ... */
    /* 0 .. 64, together at least 1 (HM_NACA4: 0); upper: left of the chord */
    int32_t n_upper, n_lower;
    int32_t degree_x, degree_y; /* FFD: 0 .. 63 */
    /* FFD: the box; all 0: the box of the control points, 5 % larger */
    double x_min, y_min, x_max, y_max;
    /* [n_upper+n_lower] Hicks-Henne, NACA: stations between 0 and 1; NULL: (2 k + 1) / (2 n) for
     * bump k of the n bumps of a side (Hicks-Henne), .4 (NACA) */
    const double* peaks;
    /* CST: 0 .. 10; both 0: .5 and 1, a round leading edge and a sharp trailing edge */
    double leading_exponent, trailing_exponent;
    double width; /* Hicks-Henne: exponent of the sine, 1 .. 100; 0: 3 */
} hm_variables;

/* ---- Movements of a section by values: design variables, rotations, flaps, families ---- */

/* hm_movement.kind, with the values v of the movement. Every value is a change, and 0 moves
 * nothing. Angles are positive counter-clockwise. */
enum {
    HM_ROTATE = 0, /* v0 [degrees]: rotation about (x, y) */
    HM_SHIFT = 1,  /* v0, v1 [length]: translation by (v0, v1) */
    HM_SCALE = 2,  /* v0 [-]: the distances from (x, y) are multiplied by 1 + v0 > 0 */
    /* v0 [degrees]: deflection behind the hinge H = (x, y). Each control point P becomes
     * H + R(v0 S(d / length)) (P - H): R is the rotation, d the distance of P behind H in the
     * direction of the chord, and S(t) = t^3 (10 - 15 t + 6 t^2) between 0 and 1, 0 before, 1
     * behind. Control points ahead of H stay; those farther behind than `length` move as a rigid
     * body. The chord is that of the curves that are given, whatever movements come before. */
    HM_FLAP = 3,
    /* Camber line and thickness separately. v0 .. [chords]: n_camber heights c_k, which add
     * sum_k c_k s (1-s) B_k(s) to the camber line, B_k Bernstein polynomials of degree n_camber-1,
     * s the station; then n_thickness numbers t_k, which add sum_k t_k s^.5 (1-s) B_k(s) to half
     * the thickness, normal to the camber line. Points keep their station and their distance from
     * the camber line, so that a change of camber rotates the thickness. */
    HM_CAMBER_THICKNESS = 4,
    /* Eleven changes of the parameters of H. Sobieczky's PARSEC (Notes Numer. Fluid Mech. 68 (1998)
     * 71), lengths in chords: leading-edge radius; station, height and second derivative of the
     * upper crest; the same three of the lower crest; height of the trailing edge and its
     * thickness; direction of the trailing edge and angle between its sides [degrees]. The outline
     * moves normal to the chord by the difference of two PARSEC sections. */
    HM_PARSEC = 5,
    /* v0, v1, v2 [degrees]: changes of the metal angle at the leading edge and at the trailing
     * edge, and of the stagger. Metal angles are those of the camber line, stagger that of the
     * chord, all counted from the x axis. A cubic with these angles is added to the camber line,
     * the thickness rotates with the camber line, and the section rotates about (x, y) by v2. */
    HM_BLADE = 6,
    /* One value for each of the linear `variables`; HM_FFD: dx, dy of each lattice point [length].
     * The map to the control points makes the B-spline follow the wanted movement of the outline in
     * the least-squares sense over the parameters of the curves, with the free ends of curves
     * exact. */
    HM_LINEAR = 7,
    /* The modes of a family: movements of the control points, such as those that hm_refit finds for
     * several airfoils, as design variables. One value [length] for each member, in the order of
     * importance. The inner product of movements a and b is sum_i D_i a_i . b_i / sum_i D_i, D_i
     * the integral of N_i by the arc length of the curves. The modes are orthonormal: the root mean
     * square of each is 1 unit of length, to 1e-12. A combination of the first k modes is the
     * nearest one to all members, in the sum of squares. The largest component of each mode is
     * positive. Control points that no curve uses have weight 0 and stay. (One-sided Jacobi:
     * Hestenes, J. SIAM 6 (1958) 51.) */
    HM_FAMILY = 8
};

/* Fields that belong to another kind must be 0. */
typedef struct hm_movement {
    uint64_t struct_size;          /* the same in all movements of one call */
    int32_t kind;                  /* HM_ROTATE, ... */
    int32_t n_camber, n_thickness; /* HM_CAMBER_THICKNESS: 0 .. 64, together at least 1 */
    double x, y;                   /* rotate, scale, blade: the centre; flap: the hinge */
    double length;                 /* flap: > 0; 0 means a tenth of the chord */
    const hm_variables* variables; /* HM_LINEAR */
    int32_t n_members, reserved;   /* HM_FAMILY: 1 .. 1024 */
    const double* members;         /* [n_members * 2*n_control] HM_FAMILY: movements, one by one */
    /* [n_members] HM_FAMILY: receives the singular values [length], descending; the modes of values
     * below 1e-12 times the first one are 0. NULL: not wanted */
    double* singular;
} hm_movement;

/* What hm_move_section computes. The arrays are the caller's; those that are NULL are not wanted.
 * A call that is refused leaves the struct and its arrays as they were. */
typedef struct hm_section_move {
    uint64_t struct_size;
    int32_t n_values;    /* receives the number of values of all movements */
    int32_t n_variables; /* receives the number of columns of `matrix`; 0: not linear */
    double* move;        /* [2*n_control] the movement of the control points, for hm_morph */
    /* [n_values * 2*n_control] row j: the exact derivatives of x and y of each control point with
     * respect to value j at these values; their products with a gradient of hm_adjoint are the
     * derivatives with respect to the values. */
    double* derivatives;
    /* [n_values] the values that the given curves have: the parameters for HM_PARSEC, the angles
     * for HM_BLADE, otherwise 0 */
    double* start;
    /* [n_control * n_variables * 2] where HM_LINEAR or HM_FAMILY is the only movement: for each
     * control point the pairs (x, y) by which one unit of each variable moves this point, as
     * complex numbers, for hm_combine. A lattice point of HM_FFD is one variable. Other movements
     * are refused with HM_BAD_ARGUMENT if this is not NULL. */
    double* matrix;
    double* unit_errors; /* [2*n_variables] HM_LINEAR: as `error`, per unit of each variable */
    /* [length] root mean square and largest difference that remain on the outline at these values:
     * of a flap between the moved curve and the map of its points; of HM_LINEAR at most, the
     * sums of the unit errors; 0 for rotate, shift, scale and a family */
    double error[2];
} hm_section_move;

/* Converts values into a movement of a section and its derivatives: applies 1 .. 64 movements, in
 * their order, with values [n_values] one movement after the other; NULL: all 0. Only rotate,
 * shift, scale and flap may come after another movement. Control points that no curve of the
 * section uses do not move.
 *
 * Rotate, shift and scale map control points, and so move the curves exactly. A flap maps control
 * points, too: the curve moves as the map of its points except near the transition, where control
 * points that are dense compared with `length` make the difference small (hm_refine). All others
 * but a family move the outline in the least-squares sense of HM_LINEAR. The camber line is the
 * polynomial s (1-s) p(s), p of degree 5, that is nearest to the middles of the thickness normal to
 * this line, at 33 stations; behind a round nose the line from which a section was constructed may
 * be steeper by several degrees. section as in hm_measure; rotate, shift, scale, HM_FFD and
 * families do without a chord, and a family alone without a section.
 *
 * Refused, outputs unchanged: values that are not finite, degrees beyond 360, a factor that is not
 * > 0, a metal angle beyond 85 degrees from the chord, a PARSEC crest outside the chord or radius
 * below 0 (HM_BAD_ARGUMENT, error.item: the value, from 0); a section without a round leading edge,
 * without a crest on both sides, or without ends at the trailing edge for HM_PARSEC (HM_BAD_CURVE);
 * a variable that moves nothing, or that is a combination of those before (HM_BAD_CONDITION,
 * error.item: the variable, from 0); members that are not finite, or all 0 (HM_BAD_ARGUMENT).
 * Bytes: curves, section, n_movements, movements; the query, too, writes result->n_values and
 * n_variables, unless result is NULL. */
HM_API hm_status hm_move_section(const hm_curves* curves, const hm_section* section,
                                 int32_t n_movements, const hm_movement* movements,
                                 const double* values, hm_section_move* result, hm_memory* memory,
                                 hm_error* err);

/* ---- Points that slip along curves ---- */

/* On a straight line the functions keep points with HM_SLIP on the line. On a curve they move each
 * point along its tangent: all calls stay linear, and a movement by d leaves the point about
 * d^2 / (2 R) beside the curve, R the radius of curvature. hm_slip puts these points onto the
 * curve, at the nearest place, and moves inner points along; points on other boundaries keep their
 * bits. Call hm_slip after hm_morph or hm_displace; the safe morphs do so in each step. `to`
 * [n_points] may be the arrays of `from`. Refused (HM_BAD_MESH): a coordinate beyond the range.
 *
 * The curve goes through the points of the marker at their coordinates in hm_analysis_init: cubic
 * segments with the tangents of circles through three neighbouring points. Points at corners are
 * fixed; at a corner the direction of the boundary jumps by more than 30 degrees, or by more than
 * 1.1 degrees and 2.5 times as much as at a neighbouring point. With hm_condition.along the curve
 * is one of the given curves, whose control points do not move and have no functions. Each piece of
 * the boundary between two corners follows the curve that is nearest to all of its points; a point
 * keeps its offset from the curve. Points at ends of curves, and where a marker with another
 * `along` begins, are then fixed, too. Refused (HM_BAD_CONDITION): a point farther from the curve
 * than 5 % of the length of its piece, a corner in the middle of a curve. `along` is not available
 * for meshes in parts (HM_UNSUPPORTED). */
HM_API hm_status hm_slip(const hm_analysis* analysis, const hm_points* from,
                         const hm_points_out* to, hm_error* err);
/* The derivative of hm_slip at `from`: d_from are velocities of the points before hm_slip, d_to
 * receives those of the points after. With d_from of hm_morph or hm_displace of a direction (from
 * NULL), this is the forward derivative of a morph with points that slip. d_to may be the arrays of
 * d_from. */
HM_API hm_status hm_slip_derivative(const hm_analysis* analysis, const hm_points* from,
                                    const hm_points* d_from, const hm_points_out* d_to,
                                    hm_error* err);
/* The transpose of the derivative of hm_slip at `from`. dj: derivatives with respect to the points
 * after hm_slip; dj_from: derivatives with respect to the points before. For the gradient of
 * hm_morph and hm_slip call hm_slip_adjoint, then hm_adjoint. dj_from may be the arrays of dj. */
HM_API hm_status hm_slip_adjoint(const hm_analysis* analysis, const hm_points* from,
                                 const hm_points* dj, const hm_points_out* dj_from, hm_error* err);

/* ---- The movement of a mesh that was morphed before ---- */

typedef struct hm_recover_report {
    uint64_t struct_size;
    /* [length] the largest distance of a point of the wall in `at` from where hm_morph leads it
     * from its place at hm_basis_init by `move` */
    double residual;
    /* [length] the largest distance by which rotated offsets contribute to the residual; 0: none
     * has rotated */
    double rotated_offset;
    int32_t point;    /* the point with that residual; -1: there are no points */
    int32_t reserved; /* 0 */
} hm_recover_report;

/* Finds the movement that a mesh has made since the basis was made: move [2*functions], with which
 * hm_morph moves the points on curves and rigid bodies from where they were at hm_basis_init to
 * where they are in `at` [n_points]. It is the solution of a least-squares problem for all
 * functions together, with the parameters that the points had: exact to rounding where the mesh was
 * moved by hm_morph or hm_move_safe, in any number of steps. If several movements lead the points
 * to the same places, the smallest one is found, in the sum of squares of all numbers; control
 * points on which no point of the wall depends receive 0. Points of markers with HM_GIVEN count
 * only if the basis has modes. Functions of real variables (hm_combine) may receive a second
 * component that is not 0.
 *
 * hm_move_safe rotates the offsets of points from their curve. If the functions alone do not lead
 * the points to `at`, and one rotation and scale for each curve makes the distances at least ten
 * times smaller, these rotations are found along with the movement; not with
 * hm_options.offset_correction 1, nor for a curve with too few points: there must be at least two
 * points on the wall more than control points on which they depend.
 *
 * report may be NULL. Refused with HM_BAD_MESH: the distance that remains beside the rotated
 * offsets is more than `tolerance` [length], because the wall is then on no curve of this basis
 * (error.item: the point, error.value: the distance); a coordinate of the wall is beyond the range.
 * tolerance 0 means 1e-4 of the width or height of the wall in `at`, the larger one; infinity: any.
 * The basis must be solved, and have all functions. After a refused call the outputs are unchanged.
 * Bytes: basis. */
HM_API hm_status hm_recover_movement(const hm_basis* basis, const hm_points* at, double tolerance,
                                     double* move, hm_recover_report* report, hm_memory* memory,
                                     hm_error* err);

#ifdef __cplusplus
}
#endif
#endif
