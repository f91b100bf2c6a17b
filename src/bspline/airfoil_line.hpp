// Describes the outline of an airfoil by points from the trailing edge round to the trailing edge.
// Each point has a share of the arc, by which the points of two airfoils are compared.
// tests/bspline/test_airfoil_samples.cpp covers this file.
#pragma once

#include "base/arena.hpp"
#include "base/vec2.hpp"

namespace harmorph {

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
    // The trailing edge is the middle between both ends; the leading edge is the point farthest
    // from the trailing edge.
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
};

}  // namespace harmorph
