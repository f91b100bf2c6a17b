// The control points with which the curve of an airfoil, on the knots that the curve has, becomes
// another airfoil, which is given by points in order.
#pragma once

#include "bspline/airfoil_samples.hpp"
#include "bspline/least_squares.hpp"

namespace harmorph {

struct RefitOptions {
    bool is_loop = true;
    bool on_chord = false;  // turn, scale and shift the points: chord line onto chord line
};

struct RefitReport {
    Real max_error = 0, rms_error = 0;  // [length] distances of the points from the moved curves
    Index max_error_point = none;
    Real chord = 0;  // [length] leading to trailing edge of the points, in units of the curve
    Real closed_width = 0;  // [length] of a blunt base that was tapered to one point; 0: none
};

class Refit {
public:
    // curve: checked, an outline from the trailing edge round to the trailing edge: open, tied or
    // periodic. base: the curve of a blunt base, which has both ends in common with the first
    // curve, or null.
    void lay_out(Arena& arena, Curve const& curve, Index n_points) noexcept;
    // control [2 * curve.n_control]: the control points of the set, those of curve and base at
    // their new places; valid only after Status::ok.
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
    Vec2 placed(Vec2 unit) const noexcept { return product(turn_, unit) + shift_; }

    // All lengths are in units of the extent of the curve's control points about their centre.
    Vec2 centre_;
    Real extent_ = 1;
    Closure closure_ = Closure::open;
    Curve own_;            // the curve with its control points in its own numbering
    Span<Index> local_;    // [n_control] of the set: number in the curve's own numbering, or none
    Span<Index> indices_;  // of own_
    Span<Real> weights_;   // of own_
    Span<Real> unit_, best_;  // [2 * own_.n_control] before; after
    AirfoilLine source_;
    Span<Real> source_u_;  // parameters of the points of source_
    Span<Real> start_u_;   // parameters of the samples before any correction
    AirfoilSamples samples_;
    Vec2 turn_{1, 0}, shift_;  // from unit points to units of the curve, as complex numbers
    LeastSquares squares_;
};

}  // namespace harmorph
