// The way from where control points are to where they shall be, for morphs in several steps.
#pragma once

#include "basis/basis.hpp"

namespace harmorph {

// r^t for t in 0..1, along the shorter way round 0. By square roots alone.
Vec2 complex_power(Vec2 r, Real t) noexcept;

// Control points that curves connect turn and scale together: the similarity z -> c + d + r (z - c)
// that fits their movement best is gone through along r^t, and what is left of the movement grows
// linearly in the turning frame:
//     P_i(t) = c + t d + r^t (P_i - c + t D_i),   D_i = (P_i + dP_i - c - d) / r - (P_i - c).
// A rotation is then a rotation all the way, where a straight line would shrink the body. Rigid
// bodies likewise. Three things go straight, r = 1: whatever has functions with real values, which
// cannot turn anything; walls that end on another boundary, which stay on it, or where it holds
// them, only on a straight line; combined functions and modes, which do not know how to turn,
// unless a mode has a ModeWay. All curves round one body turn as one.
struct MovementPath {
    // The amplitude of a mode is r^t (start + t drift) - start, with the drift that leads to its
    // target.
    struct ModeWay {
        Vec2 start, ratio;
    };

    struct Group {
        Vec2 centre, shift, ratio;  // c, d, r
        Index members = 0;
        bool anchored = false;  // a wall of the group ends on another boundary

        bool is_straight() const noexcept { return ratio.x == 1 && ratio.y == 0; }
    };

    Span<Index> group_of;  // [functions]
    Span<Group> groups;    // [functions] at most
    Span<Vec2> start,
        drift;  // [functions] P_i - c and D_i; a rigid body's turn: 1 and 0; straight: P_i and dP_i
    Span<Real> target;              // [2 * functions] dP
    Span<const ModeWay> mode_ways;  // [modes], or empty: all modes go straight

    Span<Index> slot_of;  // [points] number of a point on a wall that functions move, or none

    void lay_out(Arena& arena, BasisCounts const& counts) noexcept;
    void init(Basis const& basis, const Real* move) noexcept;
    // From now on all go straight.
    void straighten(Basis const& basis) noexcept;
    // Does anything turn or scale?
    bool is_bent() const noexcept;

    // movement [2 * functions] from the start to t in 0..1; at 1 the target itself.
    void at(Real t, Span<Real> movement) const noexcept;
    // The derivative of that by the target, with the similarities held: dP_i(t) = weight (dP_i), a
    // complex number; t r^(t-1).
    Vec2 weight(Index function, Real t) const noexcept;
    // The group whose similarity a point of the wall follows.
    Index group_of_slot(Basis const& basis, Index slot) const noexcept {
        BasisCounts const& counts = basis.header->counts;
        Index const number = basis.wall_curve[slot];
        if (number >= counts.curves) return counts.shapes() + 2 * (number - counts.curves) + 1;
        return counts.combination != 0 ? 0 : group_of[basis.curve(number).control_point(0)];
    }

private:
    void find_groups(Basis const& basis) noexcept;
    void join(Index group, Index other) noexcept;
    void find_anchors(Basis const& basis) noexcept;
    void fit_all(Basis const& basis, bool straight) noexcept;
    void fit_curves(Basis const& basis, bool straight) noexcept;
    // One function by itself, from `from` with the similarity z -> ratio z.
    void set_alone(Index function, Vec2 from, Vec2 ratio, bool anchored) noexcept;
    void fit_group(Basis const& basis, Index group, bool straight) noexcept;
};

// What the groups of a path have turned and scaled by at one time, r^t. The last group is
// remembered: points beside each other mostly follow the same one.
class TurnAt {
public:
    TurnAt(MovementPath const& path, Real t) noexcept : groups_(path.groups), t_(t) {}
    Vec2 of(Index group) noexcept {
        if (group != last_) turn_ = complex_power(groups_[group].ratio, t_);
        last_ = group;
        return turn_;
    }

private:
    Span<const MovementPath::Group> groups_;
    Real t_;
    Index last_ = none;
    Vec2 turn_;
};

}  // namespace harmorph
