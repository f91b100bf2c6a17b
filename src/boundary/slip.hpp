// Finds the lines of slip boundaries: points stay on a straight line or on a smooth curve, and
// slip along the line or curve.
#pragma once

#include "boundary/conditions.hpp"
#include "boundary/moving_boundary.hpp"

namespace harmorph {

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
// A given curve (SlipAlong) divides each of its segments into `divisions` cubics, and defines
// the places and tangents between them.
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

// Finds slip boundaries whose points slip along a given B-spline C, instead of a curve through the
// points themselves.
//
// The points slip along C(u) + e, where e is the offset of the points from C and varies linearly
// in u between two points. The points therefore lie on this curve at the start. A point at which an
// open B-spline ends, or a closed one has a corner, is a corner of the boundary.
struct SlipAlong {
    Span<const Curve> curves;  // the curves for slip of all conditions; may be empty
    WallWork work;             // work.slot is not used

    static bool is_along(const Condition* condition) noexcept {
        return condition != nullptr && condition->kind == ConditionKind::slip &&
               condition->n_curves > 0;
    }
    // Finds the faces that begin at a corner.
    void find_corners(Points points, Boundary const& boundary,
                      Span<const Condition> conditions) const noexcept;
    bool is_corner(Index face) const noexcept { return work.is_break[face] != 0; }

    // Adds the curve through the positions work.position [n + 1], or [n] for a closed line, along
    // the nearest of the condition's curves. Refuses (Status::bad_condition) positions that are
    // farther from this curve than a twentieth of the length of the line. Also refuses a curve that
    // has a corner between two positions, or bends by more than 30 degrees in an eighth of a face.
    template <class PointOf>
    Status add(Condition const& condition, Index n, bool closed, PointOf const& point_of,
               SlipCurves& to, Fault& fault) const noexcept {
        Span<const Vec2> const position = work.position;
        to.add(
            n, closed, [&](Index k) { return position[closed && k == n ? 0 : k]; }, point_of);
        return give(condition, n, closed, to, fault);
    }

private:
    Status give(Condition const& condition, Index n, bool closed, SlipCurves& to,
                Fault& fault) const noexcept;
};

// Writes the unit vector along the line of each slipping point to tangent [n_points], and (1, 0)
// for other points. Neighbouring faces that are parallel are one straight line, and all its points
// have the tangent from the first point of the line to the last. Faces that bend without a corner,
// or for which curves are given, are one curve, which is added to `curves`. A point where two lines
// meet at a corner cannot slip and becomes fixed. Refuses the same lines as SlipAlong::add().
Status find_slip_lines(Points points, Boundary const& boundary, Span<const Condition> conditions,
                       SlipAlong const& along, Span<PointKind> kinds, Span<Vec2> tangent,
                       SlipCurves& curves, Fault& fault) noexcept;

}  // namespace harmorph
