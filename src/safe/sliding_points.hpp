// Points that slide along curves while an optimisation moves mesh points: a step leads along their
// tangents, and they are put back onto their curves.
#pragma once

#include "base/range.hpp"
#include "boundary/slip_curves.hpp"

namespace harmorph {

struct SlidingPoints {
    // A point that is farther beside its curve, in parts of a face there, does not slide.
    static constexpr Real most_beside = 1e-6;

    const SlipCurves* curves = nullptr;
    Span<Index>
        slot;  // [n_points] of the curves; none: does not slide along a curve. Empty: no point does
    Span<Vec2> line;  // [n_points] see Tangle

    Vec2 placed(Index point, Vec2 p) const noexcept {
        return slides(point) ? curves->nearest(slot[point], p).at : p;
    }
    bool slides(Index point) const noexcept { return !slot.empty() && slot[point] != none; }

    // Those that are on their curves in `now`; the others are held. Points that others are joined
    // to are held, too.
    void find(SlipCurves const& slip_curves, Points now, Span<const Index> representative,
              Span<std::uint8_t> held) noexcept;
    // The tangents where points are now.
    void turn_lines(Points now) const noexcept;
};

}  // namespace harmorph
