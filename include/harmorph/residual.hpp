// What the solved functions leave of their equations: the measure of every engine, and the food of refinement.
#pragma once

#include "harmorph/basis.hpp"
#include "harmorph/matrix.hpp"

namespace harmorph {

// Residuals of a few functions at a time, in whole rows.
struct Residual {
    static constexpr Index width = 6;

    Span<Real> value;  // [n x width] rows by position: b - A F

    void lay_out(Arena& arena, Index unknowns) noexcept { arena.take(value, Offset{unknowns} * width); }

    // Functions first .. first+n-1, n <= width; squared 2-norms of b and of b - A F.
    struct Norms {
        Real right_hand_side[width] = {}, rest[width] = {};
        // |b - A F| / |b|; the numerator alone where b is 0.
        Real relative(Index k) const noexcept;
    };
    Norms compute(Matrix const& matrix, Basis const& basis, Span<const Index> point_of, Index first, Index n) const noexcept;
    // F += value, as corrections.
    void add_to(Basis const& basis, Span<const Index> point_of, Index first, Index n) const noexcept;
};

}  // namespace harmorph
