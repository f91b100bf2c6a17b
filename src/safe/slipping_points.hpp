// Points that slip along curves while an optimisation moves mesh points: a step moves them along
// their tangents, and then they are put back onto their curves.
#pragma once

#include "base/vec2.hpp"
#include "boundary/slip.hpp"

namespace harmorph {

struct SlippingPoints {
    // A point does not slip if its distance to its curve is larger than this part of the faces
    // there.
    static constexpr Real max_distance_to_face = 1e-6;

    const SlipCurves* curves = nullptr;
    // [n_points] The number of a point in the curves; none if it does not slip along a curve.
    // Empty: no point slips.
    Span<Index> slot;
    Span<Vec2> line;  // [n_points] see Tangle

    Vec2 placed(Index point, Vec2 p) const noexcept {
        return slips(point) ? curves->nearest(slot[point], p).at : p;
    }
    bool slips(Index point) const noexcept { return !slot.empty() && slot[point] != none; }

    // Finds the points that are on their curves in `now`; the others are held. Points that other
    // points are joined to are held, too.
    void find(SlipCurves const& slip_curves, Points now, Span<const Index> representative,
              Span<std::uint8_t> held) noexcept;
    // Sets the lines to the tangents at the present positions.
    void turn_lines(Points now) const noexcept;
};

}  // namespace harmorph
