// Computes control points with which the curve of an airfoil, without a change of the knots,
// becomes another airfoil, which is given by points in order.
#pragma once

#include "bspline/airfoil_samples.hpp"
#include "bspline/least_squares.hpp"

namespace harmorph {

struct RefitOptions {
    bool is_loop = true;
    // If true, the points are rotated, scaled and shifted so that both chord lines coincide.
    bool on_chord = false;
};

struct RefitReport {
    Real max_error = 0, rms_error = 0;  // [length] distances of the points from the moved curves
    Index max_error_point = none;
    Real chord = 0;  // [length] the chord of the placed points, in the units of the curve
    // [length] The width of a blunt base that was tapered to one point, or 0.
    Real closed_width = 0;
    // A point p of the caller was placed at rotation * p + shift, as complex numbers.
    Vec2 rotation{1, 0}, shift;
};

class Refit {
public:
    void lay_out(Arena& arena, Curve const& curve, Index n_points) noexcept;
    // `curve` must have been checked; it is an open, tied or periodic outline from the trailing
    // edge round to the trailing edge. `base` is the curve of a blunt base, which has both ends in
    // common with `curve`, or null. After Status::ok, control [2 * curve.n_control] contains all
    // control points; the ones of `curve` and `base` are at the new places.
    Status run(Curve const& curve, Curve const* base, Points points, Index n_points,
               RefitOptions const& options, RefitReport& report, Fault& fault) noexcept;

    Closure closure() const noexcept { return samples_.course.closure; }  // of the points

    Span<Real> control;

private:
    Status take_curve(Curve const& curve, Fault& fault) noexcept;
    void sample_curve() noexcept;
    Status place_samples(RefitOptions const& options, RefitReport& report, Fault& fault) noexcept;
    void taper() noexcept;
    void start_parameters() noexcept;
    Real largest_slide() const noexcept;
    void solve() noexcept;
    void publish(Curve const& curve, Curve const* base) noexcept;
    void measure_errors(Curve const& curve, Curve const* base, Index n,
                        RefitReport& report) const noexcept;

    Vec2 to_unit(Vec2 p) const noexcept { return (1 / extent_) * (p - centre_); }
    Vec2 placed(Vec2 unit) const noexcept { return product(rotation_, unit) + shift_; }

    // All lengths are in units of the extent of the curve's control points about their centre.
    Vec2 centre_;
    Real extent_ = 1;
    Closure closure_ = Closure::open;
    Curve own_;               // a copy of the curve that numbers only its own control points
    Span<Index> local_;       // [n_control] the number of each control point in own_, or none
    Span<Index> indices_;     // of own_
    Span<Real> weights_;      // of own_
    Span<Real> unit_, best_;  // [2 * own_.n_control] control points before and after the fit
    AirfoilLine source_;
    Span<Real> source_u_;  // parameters of the points of source_
    Span<Real> start_u_;   // parameters of the samples before any correction
    AirfoilSamples samples_;
    Vec2 rotation_{1, 0}, shift_;  // from unit points to units of the curve, as complex numbers
    LeastSquares squares_;
};

}  // namespace harmorph
