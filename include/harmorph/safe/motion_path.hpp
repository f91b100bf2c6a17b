// The way from where control points are to where they shall be, for morphs in several steps.
#pragma once

#include "harmorph/basis/basis.hpp"

namespace harmorph {

// Control points that curves connect turn and scale together: the similarity z -> c + d + r (z - c) that fits their movement
// best is gone through along r^t, and what is left of the movement grows linearly in the turning frame:
//     P_i(t) = c + t d + r^t (P_i - c + t D_i),   D_i = (P_i + dP_i - c - d) / r - (P_i - c).
// A rotation is then a rotation all the way, where a straight line would shrink the body. Rigid bodies likewise. Functions
// with real values cannot turn anything: for them r = 1 and the way is straight.
struct MovementPath {
    struct Group {
        Vec2 centre, shift, ratio;  // c, d, r
        Index members = 0;
    };

    Span<Index> group_of;     // [functions]
    Span<Group> groups;       // [functions] at most
    Span<Vec2> start, drift;  // [functions] P_i - c and D_i; of a rigid body's turn 1 and 0
    Span<Real> target;        // [2 * functions] dP

    void lay_out(Arena& arena, Index n_functions) noexcept;
    void init(Basis const& basis, const Real* move) noexcept;

    // movement [2 * functions] from the start to t in 0..1; at 1 the target itself.
    void at(Real t, Span<Real> movement) const noexcept;
    // The derivative of that by the target, with the similarities held: dP_i(t) = weight (dP_i), a complex number; t r^(t-1).
    Vec2 weight(Index function, Real t) const noexcept;

private:
    void find_groups(Basis const& basis) noexcept;
    void fit_similarity(Basis const& basis, Index group) noexcept;
};

// r^t for t in 0..1, along the shorter way round 0. By square roots alone.
Vec2 complex_power(Vec2 r, Real t) noexcept;

}  // namespace harmorph
