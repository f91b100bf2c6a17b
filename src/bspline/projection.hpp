// Finds the parameters of points: the nearest point of a curve, and monotone parameters for points
// in order along a curve.
#pragma once

#include "base/arena.hpp"
#include "base/span.hpp"
#include "bspline/bspline.hpp"

namespace harmorph {

// Finds the longest non-decreasing subsequence of a sequence.

// Writes the positions of a longest non-decreasing subsequence of values [n] to run [n], in
// ascending order, and returns their number. previous [n] is working memory. The method is patience
// sorting in O(n log n) steps: Fredman, Discrete Math. 11 (1975) 29.
Index longest_run(Span<const Real> values, Span<Index> previous, Span<Index> run) noexcept;

struct Projection {
    Real u = 0;
    Real distance = 0;
};

// Returns the nearest point of the curve in the range low <= u <= high. Each knot span is sampled,
// and Newton's method starts inside a bracket at the nearest samples. Of several equally near
// points, the one at `low` is returned, or else the first one found from `low` on. A point that
// coincides with the beginning or end of the curve, to rounding, gets exactly begin() or end(); on
// a closed curve it gets begin(), if that is in the range.
Projection project(Curve const& curve, Vec2 point, Real low, Real high) noexcept;
inline Projection project(Curve const& curve, Vec2 point) noexcept {
    return project(curve, point, curve.begin(), curve.end());
}

// Samples a range of one span at equal distances of the parameter.
struct SpanSamples {
    static constexpr Index max_samples = 4 * max_degree + 1;

    Index span = none;
    Real low = 0, high = 0;
    Vec2 point[max_samples];

    Real parameter(Index j, Index n) const noexcept {
        return j == n ? high : low + (high - low) * static_cast<Real>(j) / n;
    }
    void take(Curve const& curve, Index new_span, Real new_low, Real new_high) noexcept;
};

// Projects many points to one curve: keeps the samples of the spans that were searched last.
class Projector {
public:
    explicit Projector(Curve const& curve) noexcept;
    // The search is faster if `hint` is near the parameter of the nearest point.
    Projection nearest(Vec2 point, Real low, Real high, Real hint) noexcept;

private:
    static constexpr Index n_recent = 8;
    Curve const& curve_;
    Vec2 begin_, end_;
    SpanSamples recent_[n_recent];
};

// A curve is closed if C(begin) = C(end). A closed curve is periodic if it is smooth there, and
// tied if it has a corner there.
bool is_closed(Curve const& curve) noexcept;
bool is_periodic(Curve const& curve) noexcept;

// Two control points at the same place, one of which moves the first end of a curve and the other
// one the last end, so that a closed curve may tear; none if there are none.
struct TornEnds {
    Index first = none, last = none;
};
TornEnds torn_ends(Curve const& curve) noexcept;

// The working space of project_chain() for up to n points.
struct ChainWork {
    Span<Index> previous, run;
    Span<Real> trial, ordered;
    void lay_out(Arena& arena, Index n) noexcept;
};

// Finds monotone parameters u [n] for a chain of points, which follow each other along the curve in
// either direction. Each point is projected alone, and the longest monotone subsequence is trusted.
// The other points are projected again between their trusted neighbours, because at a thin trailing
// edge the nearest point may lie on the other side.
//
// A loop of points on a closed curve may begin anywhere. Its parameters are monotone except for one
// step from end() to begin(), where the points pass the seam of the curve. On a tied curve, the
// point of the loop that is nearest to the tied ends gets exactly begin(). An open chain on a
// closed curve may pass the seam once, too. Returns the sum of the squared distances.
Real project_chain(Curve const& curve, Span<const Vec2> points, bool is_loop, ChainWork const& work,
                   Span<Real> u) noexcept;

}  // namespace harmorph
