// Stores the smooth curves along which points slip: cubic segments through the points of a curved
// line of the boundary.
//
// The tangent at a point is that of the circle through the point and its two neighbours; at an end
// of the line, it is the mirror image of the tangent beside it. A segment from p to q with the unit
// tangents s and t is the cubic with the end points p and q and the derivatives m s and m t, where
// m = 2 |q - p| / (1 + (s + t).e / 2) and e is the direction of q - p. The segments of a straight
// line are therefore straight. Between points of a circle, the error of a segment is 4.6e-6 of the
// radius for an arc of 45 degrees, and 64 times smaller for half the angle. Beyond an open end, the
// curve continues along a straight line.
//
// A given curve (slip_along.hpp) divides each of its segments into `divisions` cubics, and defines
// the places and tangents between them.
#pragma once

#include "boundary/conditions.hpp"

namespace harmorph {

struct SlipCurves {
    // The place of a curve that is nearest to a point p. The derivative of `at` by p is the matrix
    // stretch * tangent tangent^T.
    struct Place {
        Vec2 at, tangent;
        Real stretch = 1;
    };

    Index count = 0;
    Span<Index> start;  // [count + 1] the first slot of each curve
    Span<Index> point;  // [slots] mesh points in order along the boundary
    // [slots] The slot itself if its point slips, and none if the point is fixed. At the end of a
    // closed curve, the first slot stands for the last one.
    Span<Index> own;
    Span<Vec2> at;                // [slots] initial positions; a closed curve repeats the first one
    Span<Vec2> tangent;           // [slots] unit vectors
    Span<std::uint8_t> is_given;  // [count]
    // [(divisions - 1) * slots] Places and tangents between the points of given curves; empty if no
    // curve is given.
    Span<Vec2> between_at, between_tangent;
    static constexpr Index divisions = 8;

    Index n_slots() const noexcept { return count == 0 ? 0 : start[count]; }
    // Returns whether the slot is the last one of its curve.
    bool is_last(Index slot) const noexcept { return slot + 1 == start[curve_of(slot) + 1]; }

    // lay_out() takes arrays for the largest possible curves, lay_out_copy() for a copy of others.
    void lay_out(Arena& arena, Size max_faces, bool any_given) noexcept;
    void lay_out_copy(Arena& arena, SlipCurves const& other) noexcept;
    void copy_from(SlipCurves const& other) noexcept;

    // Adds a curve through position(0), ..., position(n) and the mesh points point_of(k). If the
    // curve is closed, the last point is the first one.
    template <class At, class PointOf>
    void add(Index n, bool closed, At const& position, PointOf const& point_of) noexcept;
    // Makes the curve that was added last a given curve: along(j, tangent) returns the places for j
    // = 0 .. n * divisions, and sets their tangents. Returns false if the curve does not run
    // smoothly from each of these places to the next.
    template <class Along>
    bool give(Along const& along) noexcept;
    // Marks the points that are not of the kind slip as fixed.
    void keep_slipping(Span<const PointKind> kinds) const noexcept;
    // Returns the fingerprint `others` of the other conditions, combined with the given curves; if
    // there are none, returns `others`.
    std::uint64_t fingerprint_with(std::uint64_t others) const noexcept;

    // Calls visit(slot, point) for the points that slip.
    template <class Visit>
    void for_each(Visit const& visit) const noexcept {
        for (Index slot = 0; slot < n_slots(); ++slot) {
            if (own[slot] == slot) visit(slot, point[slot]);
        }
    }
    // Searches the curve from the slot on, and returns the first place at which the vector to p is
    // normal to the curve.
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
    for (Index j = 0; j <= divisions * n; ++j) {
        place[1] = along(j, direction[1]);
        smooth = smooth && (j == 0 || is_smooth(place, direction));
        Index const slot = begin + j / divisions, division = j % divisions;
        if (division == 0) tangent[slot] = direction[1];
        else between_at[(divisions - 1) * slot + division - 1] = place[1];
        if (division != 0) between_tangent[(divisions - 1) * slot + division - 1] = direction[1];
        place[0] = place[1];
        direction[0] = direction[1];
    }
    return smooth;
}

}  // namespace harmorph
