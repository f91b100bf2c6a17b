// From points to parameters: the nearest point of a curve, and monotone parameters for points in
// order along it.
#pragma once

#include "base/arena.hpp"
#include "bspline/bspline.hpp"

namespace harmorph {

struct Projection {
    Real u = 0;
    Real distance = 0;
};

// Nearest point of the part low <= u <= high: nearest sample (samples per knot span), then Newton
// inside a bracket. Where two parts are equally near, low or else the first found from low on wins.
// A point that coincides with the curve's beginning or end within rounding gets exactly begin() or
// end(); on a closed curve begin(), if it is within the part.
Projection project(Curve const& curve, Vec2 point, Real low, Real high) noexcept;
inline Projection project(Curve const& curve, Vec2 point) noexcept {
    return project(curve, point, curve.begin(), curve.end());
}

// Points of a part of one span, at equal distances of the parameter.
struct SpanSamples {
    static constexpr Index most = 4 * max_degree + 1;

    Index span = none;
    Real low, high;
    Vec2 point[most];

    SpanSamples() noexcept : low(0), high(0) {}
    Real parameter(Index j, Index n) const noexcept {
        return j == n ? high : low + (high - low) * static_cast<Real>(j) / n;
    }
    void take(Curve const& curve, Index new_span, Real new_low, Real new_high) noexcept;
};

// The same for many points of one curve: keeps the samples of the spans searched last.
class Projector {
public:
    explicit Projector(Curve const& curve) noexcept;
    // Faster when `hint` is a parameter near the answer's.
    Projection nearest(Vec2 point, Real low, Real high, Real hint) noexcept;

private:
    static constexpr Index n_recent = 8;
    Curve const& curve_;
    Vec2 begin_, end_;
    SpanSamples recent_[n_recent];
};

// Is C(begin) = C(end), and is the curve smooth there (periodic) or has it a corner (tied)?
bool is_closed(Curve const& curve) noexcept;
bool is_periodic(Curve const& curve) noexcept;

// Working arrays of project_chain, for up to n points.
struct ChainWork {
    Span<Index> previous, run;
    Span<Real> trial, ordered;
    void lay_out(Arena& arena, Index n) noexcept;
};

// Parameters u [n] of points that follow each other along the curve, in either direction, made
// monotone: every point is projected for itself, the longest monotone run is trusted, and the
// others are projected again between their trusted neighbours (thin trailing edges: the nearest
// point may lie on the other side). A loop of points on a closed curve may begin anywhere: monotone
// but for one step from end() to begin(), where the points pass the curve's seam. On a tied curve
// the point of a loop that is nearest to the tied ends gets exactly begin(). Points of one open
// piece of a closed curve may pass the seam once, too. Returns the sum of the squared distances.
Real project_chain(Curve const& curve, Span<const Vec2> points, bool is_loop, ChainWork const& work,
                   Span<Real> u) noexcept;

}  // namespace harmorph
