// Samples the smooth outline through the points of an airfoil: computes many points in order.
#pragma once

#include "base/arena.hpp"
#include "base/vec2.hpp"
#include "bspline/curve_ends.hpp"
#include "bspline/envelope_cholesky.hpp"
#include "bspline/unit_points.hpp"

namespace harmorph {

// Describes the outline of an airfoil by points from the trailing edge round to the trailing edge.
// Each point has a share of the arc, by which the points of two airfoils are compared.
template <class T>
void reverse(Span<T> list) noexcept {
    for (Index low = 0, high = list.count() - 1; low < high; ++low, --high) {
        T const kept = list[low];
        list[low] = list[high];
        list[high] = kept;
    }
}

// Rotates a closed list, whose last element repeats the first one, so that the list begins and ends
// with the element at this position.
template <class T>
void begin_loop_at(Span<T> list, Index first) noexcept {
    Index const n = list.count() - 1;
    reverse(list.first(first));
    reverse(list.from(first, n - first));
    reverse(list.first(n));
    list[n] = list[0];
}

struct AirfoilLine {
    Span<Vec2> at;
    // The share of the arc is 0 at the beginning, 1 at the leading edge, and 2 at the end.
    Span<Real> share;
    Index n = 0;  // the number of points
    // The trailing edge is the middle between both ends; the leading edge is the place of the line
    // farthest from the trailing edge.
    Vec2 leading, trailing;

    void lay_out(Arena& arena, Index max_points) noexcept;
    void add(Vec2 point) noexcept { at[n++] = point; }
    // Computes the leading edge, the trailing edge and the shares. Returns false if a side has no
    // length.
    bool measure() noexcept;

    bool runs_clockwise() const noexcept;
    void reverse() noexcept { harmorph::reverse(at.first(n)); }
    // Lets a closed line, whose last point is the first one, begin and end at this point.
    void begin_at(Index point) noexcept { begin_loop_at(at.first(n), point); }
    // Returns the interval that contains this share, and the position in the interval from 0 to 1.
    Index interval_of(Real wanted, Real& position) const noexcept;

private:
    // Finds the leading edge near the farthest sample. Returns the length of the arc before it;
    // share is the length of the arc before each sample.
    Real find_leading_edge(Index farthest) noexcept;
};

// Interpolates points in order by a cubic spline with continuous second derivatives; the parameter
// is the length of the polygon through the points. C. de Boor, A Practical Guide to Splines (1978),
// chapter IV.
class PointSpline {
public:
    void lay_out(Arena& arena, Index max_points) noexcept;
    // There must be at least two points, each different from the next one. If is_closed is true,
    // there must be at least four points, the last point must be the first one again, and the
    // spline is smooth there. Otherwise the second derivative is constant in the first and in the
    // last interval.
    void pass_through(Span<const Vec2> points, bool is_closed) noexcept;
    // Returns the point at a share, from 0 to 1, of the interval between two points.
    Vec2 at(Index interval, Real share) const noexcept;

private:
    Real step(Index k) const noexcept { return length(points_[k + 1] - points_[k]); }
    Vec2 second(Index k) const noexcept { return {second_[2 * k], second_[2 * k + 1]}; }

    Span<const Vec2> points_;
    Span<Real> second_;  // [2 * points] second derivatives, pairs x, y
    EnvelopeMatrix matrix_;
};

struct AirfoilSamples {
    AirfoilLine line;     // in units of the points, without the straight base of a blunt section
    UnitPoints points;    // the given points
    Course course;        // says how the outline closes, and which points are on the base
    Index n_corners = 0;  // the number of corners inside the line

    // Takes arrays for at least min_samples samples, unless there would be more than 64 between two
    // given points. Every given point is a sample.
    void lay_out(Arena& arena, Index n_points, Index min_samples) noexcept;
    Index max_samples() const noexcept { return max_samples_; }
    Status take(Points given, Index n, bool is_loop, Fault& fault) noexcept;
    // Lets a closed outline begin at the trailing edge: the corner that lies farthest in this
    // direction, or the sample if there are no corners.
    void begin_at_farthest(Vec2 direction) noexcept;

private:
    void gather(Index n) noexcept;
    void sample() noexcept;

    Outline outline_;
    Span<Index> corner_;  // points at first, then positions along the line
    Span<Vec2> along_;    // the points in the order of the line
    PointSpline spline_;
    Index per_interval_ = 1, max_samples_ = 0;
};

}  // namespace harmorph
