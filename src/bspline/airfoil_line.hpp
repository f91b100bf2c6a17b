// The outline of an airfoil as points from the trailing edge round to the trailing edge, and how
// far along its side each point is. Two airfoils are compared point by point by these shares.
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

// Turns the order of a closed list, whose last element repeats the first one: the list begins and
// ends with the element at this position.
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
    // Share of the arc: 0 at the beginning, 1 at the leading edge, 2 at the end.
    Span<Real> share;
    Index n = 0;  // points in use
    // The trailing edge is the middle between both ends; the leading edge is the point farthest
    // from the trailing edge.
    Vec2 leading, trailing;

    void lay_out(Arena& arena, Index max_points) noexcept;
    void add(Vec2 point) noexcept { at[n++] = point; }
    // Leading edge, trailing edge and shares of the points at hand. False: all points coincide.
    bool measure() noexcept;

    bool runs_clockwise() const noexcept;
    void reverse() noexcept { harmorph::reverse(at.first(n)); }
    // A closed line, whose last point is its first one, begins and ends at this point.
    void begin_at(Index point) noexcept { begin_loop_at(at.first(n), point); }
    // The interval, and the position in it from 0 to 1, that has this share.
    Index interval_of(Real wanted, Real& position) const noexcept;
};

}  // namespace harmorph
