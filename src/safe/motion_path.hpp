// The path of the control points from the start to the target, for morphs in several steps.
#pragma once

#include "basis/basis.hpp"
#include "base/vec2.hpp"

namespace harmorph {

// Finds the similarity z -> c + d + r (z - c) that fits movements of points best.

struct Similarity {
    // A body that collapses or turns inside out has a smaller ratio than this; the path of such a
    // body goes straight.
    static constexpr Real min_ratio = 0.05;

    Vec2 centre, shift, ratio{1, 0};  // c, d, r
    Index members = 0;
    bool exists = false;  // false: the path goes straight
};

// The function for_each(visit) calls visit(point, movement) for each member. Least squares give c =
// mean of the points p, d = mean of the movements w, and r - 1 = sum conj(p - c) (w - d) / sum |p -
// c|^2. If |r| is too small, r is set to 1.
template <class ForEach>
Similarity fit_similarity(ForEach const& for_each) noexcept {
    Similarity fit;
    for_each([&](Vec2, Vec2) { ++fit.members; });
    if (fit.members == 0) return fit;
    Real const share = 1 / static_cast<Real>(fit.members);
    for_each([&](Vec2 point, Vec2 movement) {
        fit.centre = fit.centre + share * point;
        fit.shift = fit.shift + share * movement;
    });
    Vec2 rotated;
    Real squares = 0;
    for_each([&](Vec2 point, Vec2 movement) {
        rotated = rotated + product(conjugate(point - fit.centre), movement - fit.shift);
        squares += square(point - fit.centre);
    });
    Vec2 const ratio = squares > 0 ? Vec2{1, 0} + (1 / squares) * rotated : Vec2{};
    fit.exists = length(ratio) > Similarity::min_ratio;
    if (fit.exists) fit.ratio = ratio;
    return fit;
}

// Finds how far the middle of the way from the closed polygon `from` to the closed polygon `to`
// bends away from the straight line, for each point. In the middle, each side has rotated by half
// of its angle, and has the mean of both lengths, so that a part that rotates neither shrinks nor
// passes through other parts. Angles are continuous round the polygon, but for one side where they
// would not return to the first one; if that does not help, the way is straight. The sides that
// rotate close the polygon in the middle.
void find_bulge(Span<const Vec2> from, Span<const Vec2> to, Span<Vec2> bulge) noexcept;

// Returns r^t for 0 <= t <= 1, with the argument of r between -pi and pi, by square roots alone.
Vec2 complex_power(Vec2 r, Real t) noexcept;

// Control points that curves connect rotate and scale together. The similarity z -> c + d + r (z -
// c) that fits their movement best proceeds along r^t, and the remainder of the movement grows
// linearly in the rotating frame:
//   P_i(t) = c + t d + r^t (P_i - c + t D_i + 4 t (1 - t) B_i),
//   D_i = (P_i + dP_i - c - d) / r - (P_i - c).
// B_i is the bulge of a polygon of control points, if one closed curve connects them.
// So a rotation is a rotation at each time, whereas a straight line would shrink the body. Rigid
// bodies move in the same way. Three kinds of groups go straight, with r = 1: groups with functions
// of real values, which cannot rotate; walls that end on another boundary, because only on a
// straight path do their ends stay on that boundary, or where they are held; and combined functions
// and modes, for which no rotation is defined unless a mode has a ModeWay. All curves of one body
// rotate together.
struct MovementPath {
    // The amplitude of a mode is r^t (start + t drift) - start, where the drift leads to the target
    // of the mode, and 4 t (1 - t) bulge is added to it.
    struct ModeWay {
        Vec2 start, ratio;
        Real bulge = 0;
    };

    struct Group {
        Vec2 centre, shift, ratio;  // c, d, r
        Index members = 0;
        bool anchored = false;  // a wall of the group ends on another boundary
        bool bends = false;     // the way of a curve may be bent

        bool is_straight() const noexcept { return ratio.x == 1 && ratio.y == 0; }
    };

    Span<Index> group_of;  // [functions]
    Span<Group> groups;    // [functions] at most
    // [functions] P_i - c and D_i of a group; 1 and 0 for the rotation of a rigid body; P_i and
    // dP_i if the group goes straight.
    Span<Vec2> start, drift;
    Span<Vec2> bulge;                            // [functions]
    Span<Vec2> polygon, target_polygon, middle;  // [functions] working space
    Span<Real> target;                           // [2 * functions] dP
    Span<const ModeWay> mode_ways;               // [modes], or empty: all modes go straight

    // [points] The number of a point on a wall that functions move, or none.
    Span<Index> slot_of;

    void lay_out(Arena& arena, BasisCounts const& counts) noexcept;
    void init(Basis const& basis, const Real* move) noexcept;
    // Makes all groups and modes go straight, or again on the ways that init() finds.
    void bend(Basis const& basis) noexcept;
    void straighten(Basis const& basis) noexcept;
    // Returns whether any group rotates or scales, or any function has a bulge.
    bool is_bent() const noexcept;

    // Finds the movement [2 * functions] from the start to the time t, 0 <= t <= 1; at 1 it is
    // exactly the target.
    void at(Real t, Span<Real> movement) const noexcept;
    // Returns the derivative of that movement by the target with the similarities held, a complex
    // number: dP_i(t) = weight (dP_i), which is t r^(t-1).
    Vec2 weight(Index function, Real t) const noexcept;
    // Returns the group whose similarity a point of the wall follows.
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
    // Sets one function that is a group by itself, from `from` with the similarity z -> ratio z.
    void set_alone(Index function, Vec2 from, Vec2 ratio, bool anchored) noexcept;
    void fit_group(Basis const& basis, Index group, bool straight) noexcept;
    void bend_curve(Basis const& basis, Index number) noexcept;
};

// Returns the factor r^t by which each group of a path has rotated and scaled at one time. The last
// group is remembered, because neighbouring points mostly follow the same group.
class RotationAt {
public:
    RotationAt(MovementPath const& path, Real t) noexcept : groups_(path.groups), t_(t) {}
    Vec2 of(Index group) noexcept {
        if (group != last_) rotation_ = complex_power(groups_[group].ratio, t_);
        last_ = group;
        return rotation_;
    }

private:
    Span<const MovementPath::Group> groups_;
    Real t_;
    Index last_ = none;
    Vec2 rotation_;
};

}  // namespace harmorph
