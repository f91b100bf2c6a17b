// Writes the results of a fit: control points in the caller's units, errors, and the point at which
// the curve runs backwards. tests/bspline/test_fit.cpp covers this file.
#include "bspline/fit.hpp"
#include "bspline/projection.hpp"

namespace harmorph {
namespace {

// The direction of a shorter step between points depends on the last digits of coordinates.
constexpr Real min_step = 1e-5;
// The curve runs backwards if the cosine of the angle between the curve and the step is below this.
constexpr Real cosine_of_backtrack = -0.25;
constexpr Index samples_per_step = 32;

}  // namespace

// Converts the control points to the caller's units. A control point that is pinned at a point gets
// exactly the coordinates of the point.
void Fit::publish(Points points) noexcept {
    Index const n_control = squares_.curve.n_control;
    for (Index i = 0; i < n_control; ++i) {
        Vec2 place = points_.from_unit({control[2 * i], control[2 * i + 1]});
        Index const position = best_pinned_[i];
        if (position != none) place = points[point_at(position)];
        control[2 * i] = place.x;
        control[2 * i + 1] = place.y;
    }
    n_curves = 1;
    curve[0] = squares_.curve;
    curve[0].control = control.data();
    if (course_.base_points == 0) return;
    base_indices_[0] = n_control - 1;
    base_indices_[1] = 0;
    for (Index k = 0; k < 4; ++k) base_knots_[k] = k < 2 ? 0 : 1;
    n_curves = 2;
    curve[1] = {1,      2, 0, n_control, base_indices_.data(), base_knots_.data(), control.data(),
                nullptr};
}

// Points with weight 0 have no errors.
void Fit::report_errors(Points points, Index n, FitOptions const& options,
                        FitReport& report) const noexcept {
    report.closure = course_.closure;
    report.first_point = course_.first;
    report.base_points = course_.base_points;
    Real sum = 0;
    Index counted = 0;
    for (Index k = 0; k < n; ++k) {
        if (options.weight != nullptr && options.weight[k] == 0) continue;
        ++counted;
        Real distance = infinity;
        for (Index c = 0; c < n_curves; ++c)
            distance = min(distance, project(curve[c], points[k]).distance);
        sum += distance * distance;
        if (counted > 1 && distance <= report.max_error) continue;
        report.max_error = distance;
        report.max_error_point = k;
    }
    report.rms_error = sqrt(sum / counted);
}

// Returns the point after which the curve runs against the step to the next point, or none.
Index Fit::find_backtrack() const noexcept {
    Curve const shape = unit_curve();
    for (Index k = 0; k + 1 < course_.n_positions; ++k) {
        Vec2 const step = along_[k + 1] - along_[k];
        if (!(length(step) > min_step)) continue;
        for (Index sample = 0; sample < samples_per_step; ++sample) {
            Real const share = (sample + 0.5) / samples_per_step;
            Vec2 c[2];
            curve_point(shape, (1 - share) * best_u_[k] + share * best_u_[k + 1], 1, c);
            if (dot(c[1], step) < cosine_of_backtrack * length(c[1]) * length(step))
                return point_at(k);
        }
    }
    return none;
}

}  // namespace harmorph
