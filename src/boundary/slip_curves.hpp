// Smooth curves along which points slide: cubic segments through the points of a curved piece of
// the boundary.
//
// The tangent at a point is that of the circle through the point and its neighbours on both sides;
// at an end of the piece, the mirror image of the tangent beside it. A segment from p to q with the
// unit tangents s and t is the cubic with the end points p and q and the derivatives m s and m t, m
// = 2 |q - p| / (1 + (s + t).e / 2), e the direction of q - p. So straight parts are straight, and
// an arc between points of a circle is off the circle by 4.6e-6 of the radius at 45 degrees, by a
// part in 64 of that at half the angle. Behind an open end the curve goes on straight.
//
// A curve that is given (slip_along.hpp) divides each of its segments into `parts`, at places and
// with tangents of its own.
#pragma once

#include "boundary/conditions.hpp"

namespace harmorph {

struct SlipCurves {
    // Where a curve is nearest to a point p. The derivative of `at` by p is stretch * tangent
    // tangent^T.
    struct Place {
        Vec2 at, tangent;
        Real stretch = 1;
    };

    Index count = 0;
    Span<Index> start;  // [count + 1] first slot of each curve
    Span<Index> point;  // [slots] mesh points in order along the boundary
    Span<Index> own;  // [slots] the slot itself where its point slides, the first one at the end of
                      // a closed curve; none where the point is held
    Span<Vec2> at;    // [slots] where the points of the boundary are at the start; a closed curve
                      // repeats the first
    Span<Vec2> tangent;           // [slots] of length 1
    Span<std::uint8_t> is_given;  // [count]
    Span<Vec2> between_at,
        between_tangent;  // [(parts - 1) * slots] of given curves; empty if there are none
    static constexpr Index parts = 8;

    Index n_slots() const noexcept { return count == 0 ? 0 : start[count]; }
    bool is_last(Index slot) const noexcept {
        return slot + 1 == start[curve_of(slot) + 1];
    }  // of its curve

    // Counted generously, from the faces; exactly as many as another one has.
    void lay_out(Arena& arena, Size max_faces, bool any_given) noexcept;
    void lay_out_copy(Arena& arena, SlipCurves const& other) noexcept;
    void copy_from(SlipCurves const& other) noexcept;

    // A curve through positions at(0), ..., at(n) and mesh points point(k); closed: the last one is
    // the first one.
    template <class At, class PointOf>
    void add(Index n, bool closed, At const& position, PointOf const& point_of) noexcept;
    // The one that was added last is given: its tangents and what is between its points, along(j,
    // tangent) -> place for j = 0 .. n * parts. False if it does not run smoothly from each of
    // these places to the next.
    template <class Along>
    bool give(Along const& along) noexcept;
    // Points of other kinds do not slide.
    void keep_sliding(Span<const PointKind> kinds) const noexcept;
    // That of the other conditions, with the curves that are given; the same one if there are none.
    std::uint64_t fingerprint_with(std::uint64_t others) const noexcept;

    // visit(slot, point) for the points that slide.
    template <class Visit>
    void for_each(Visit const& visit) const noexcept {
        for (Index slot = 0; slot < n_slots(); ++slot) {
            if (own[slot] == slot) visit(slot, point[slot]);
        }
    }
    // Sought along the curve from the slot on, to the first place where p is straight beside the
    // curve.
    Place nearest(Index slot, Vec2 p) const noexcept;

private:
    Index curve_of(Index slot) const noexcept;
    void find_tangents(Index curve, bool closed) const noexcept;
    Place on_segment(Index curve, Index slot, Vec2 p) const noexcept;
    static Place on_cubic(const Vec2 (&at)[2], const Vec2 (&tangent)[2], Vec2 p) noexcept;
    static bool is_smooth(const Vec2 (&at)[2], const Vec2 (&tangent)[2]) noexcept;
};

template <class At, class PointOf>
void SlipCurves::add(Index n, bool closed, At const& position, PointOf const& point_of) noexcept {
    if (count == 0) start[0] = 0;
    Index const begin = start[count];
    for (Index k = 0; k <= n; ++k) {
        at[begin + k] = position(k);
        point[begin + k] = point_of(closed && k == n ? 0 : k);
        own[begin + k] = begin + (closed && k == n ? 0 : k);
    }
    is_given[count] = 0;
    start[++count] = begin + n + 1;
    find_tangents(count - 1, closed);
}

template <class Along>
bool SlipCurves::give(Along const& along) noexcept {
    Index const begin = start[count - 1], n = start[count] - begin - 1;
    is_given[count - 1] = 1;
    Vec2 place[2], direction[2];
    bool smooth = true;
    for (Index j = 0; j <= parts * n; ++j) {
        place[1] = along(j, direction[1]);
        smooth = smooth && (j == 0 || is_smooth(place, direction));
        Index const slot = begin + j / parts, part = j % parts;
        if (part == 0) tangent[slot] = direction[1];
        else between_at[(parts - 1) * slot + part - 1] = place[1];
        if (part != 0) between_tangent[(parts - 1) * slot + part - 1] = direction[1];
        place[0] = place[1];
        direction[0] = direction[1];
    }
    return smooth;
}

}  // namespace harmorph
