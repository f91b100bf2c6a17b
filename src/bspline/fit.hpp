// Fits a B-spline to points in order by least squares. The curve has the corners of the outline,
// its knots follow arc length and curvature, and its ends are tied or free.
#pragma once

#include "bspline/curve_ends.hpp"
#include "bspline/knots.hpp"
#include "bspline/least_squares.hpp"
#include "bspline/unit_points.hpp"

namespace harmorph {

struct FitOptions {
    Index degree = 3;
    Index n_control = 20;  // distinct control points
    Closure closure = Closure::automatic;
    const Real* weight = nullptr;  // [n_weights], one for each point, or null: all 1
    Index n_weights = 0;
    Real smoothing = 0;  // [length] waves much shorter than this are damped
    // [length] If not 0, the fit has the fewest control points, at most n_control, with which no
    // error exceeds the tolerance.
    Real tolerance = 0;
    // The directions of the curve at its first and last end; a zero vector is no condition.
    Vec2 tangent[2] = {{0, 0}, {0, 0}};
};

struct FitReport {
    Real max_error = 0, rms_error = 0;  // distances of the points from the curves
    Index max_error_point = none;
    Closure closure = Closure::open;  // never automatic
    Index corners = 0;      // the number of corners of the outline; corners at the ends count
    Index first_point = 0;  // the point at which the first curve begins
    Index base_points = 0;  // the number of points on a blunt base; both ends count
    // The first curve runs backwards between this point and the next one.
    Index backtrack_point = none;
    // The largest distance of the first curve from the polygon of the points, and the point after
    // which this place lies.
    Real max_departure = 0;
    Index departure_point = none;
};

// Checks degree, number of control points and number of points; must be called before lay_out().
Status check_fit(Index n_points, FitOptions const& options, Fault& fault) noexcept;

// Between two points that are far apart where the outline bends, a fit inserts this many points.
constexpr Index inserted_points = 3;

// Holds the fitted curves (with parameters from 0 to 1) and the working space. The result is
// rotated, translated, scaled and reversed with the points, to rounding. run() may be called again.
struct Fit {
    Index n_curves = 0;  // 2 with a blunt base
    Curve curve[2];
    Span<Real> control;  // [2 * n_control]

    void lay_out(Arena& arena, Index n_points, FitOptions const& options) noexcept;
    Status run(Points points, Index n_points, bool is_loop, FitOptions const& options,
               FitReport& report, Fault& fault) noexcept;

private:
    Status attempt(Points points, Index n_points, FitOptions const& options, FitReport& report,
                   Fault& fault) noexcept;
    void use_details(FitOptions const& options) noexcept;
    Status check_tangents(FitOptions const& options, Fault& fault) const noexcept;
    void shape_curve(FitOptions const& options) noexcept;
    void gather(Index n_corners, FitOptions const& options) noexcept;
    void use_corners(Index n) noexcept;
    void pin_ends_and_corners() noexcept;
    void start_parameters() noexcept;
    void solve_and_correct(Index times, Real acceleration) noexcept;
    void find_knots(Index rounds) noexcept;
    void approximate(Index n_corners, Index rounds) noexcept;
    Status check_growth(Fault& fault) const noexcept;
    void weigh_points(Index n, FitOptions const& options) noexcept;
    bool grows(Index n) const noexcept;
    // The curve with the best control points, in units of the extent.
    Curve unit_curve() const noexcept;
    void stay_near_polygon(Index n_corners, FitOptions const& options) noexcept;
    Vec2 vertex(Index position) const noexcept;
    Real turning_at(Index position) const noexcept;
    Real departure_after(Index position) const noexcept;
    Real error_at_points() const noexcept;
    Real mark_departures() noexcept;
    Index insert_points(Real farthest) noexcept;
    Index position_at(Index place) const noexcept;
    void remove_inserted(Index n_corners, FitOptions const& options) noexcept;
    void keep() noexcept;
    void restore() noexcept;
    void publish(Points points) noexcept;
    void report_errors(Points points, Index n, FitOptions const& options,
                       FitReport& report) const noexcept;
    Index find_backtrack() const noexcept;
    void report_departure(FitReport& report) const noexcept;
    // Returns the caller's point at a position along the curve.
    Index point_at(Index position) const noexcept {
        return static_cast<Index>((static_cast<Offset>(course_.first) + position) %
                                  outline_.count());
    }

    UnitPoints points_;
    Outline outline_;
    Course course_;
    KnotSites sites_;
    LeastSquares squares_;
    Span<Index> corner_;  // [n] points at first, then positions
    // Arrays along the curve have room for the points of the caller and for inserted points.
    Span<Vec2> along_;                    // the points along the curve
    Span<Real> arc_, curvature_, start_;  // start_ is arc_ / total length
    Span<Real> mass_, capped_;
    Span<Index> section_spans_, indices_, base_indices_, best_pinned_;
    Span<Real> knots_, best_knots_, base_knots_, span_error_, best_u_;
    Real best_error_ = infinity;
    // For the points that are inserted between the points of the caller, [n + 1] each: whether the
    // next interval gets points, and the place of each point among all.
    Span<Index> marked_, place_;
    // The fit before points are inserted.
    Span<Real> kept_control_, kept_knots_, kept_u_;
    Span<Index> kept_pinned_;
};

}  // namespace harmorph
