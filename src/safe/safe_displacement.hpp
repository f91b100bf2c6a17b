// Moves points of the wall by given displacements with the strategies of a safe morph.
//
// A loop of the boundary on which all points are given is a body, which moves as a body with curves
// does (MovementPath):
//   p(t) = c + t d + r^t (p - c + t D) + 4 t (1 - t) B,   D = (p + w - c - d) / r - (p - c).
// Here w is the displacement of p, r (z - c) + d is the similarity that fits all displacements
// best, and B is the bulge of the way in the middle (see find_bulge()), so that a flap rotates.
// This path is a combination of four modes of the wall, which are solved as functions by table: 1,
// p - c and D, with the amplitudes t d, r^t - 1 and t r^t, and one for the bulges of all bodies.
// Points of other loops, on which only some points are given, go straight, with one mode for all of
// them. At t = 1 the points have exactly the given displacements.
#pragma once

#include "morph/displacement.hpp"
#include "safe/safe_morph.hpp"

namespace harmorph {

struct SafeDisplacement {
    SafeMorph safe;
    Span<Vec2> given;                  // [given points] their displacements
    Span<Index> body;                  // [given points] the loop that is a body, from 0, or none
    Span<MovementPath::ModeWay> ways;  // [modes]
    Span<Vec2> modes;                  // [modes x given points]
    // [given points] One body before and after the movement, beside its similarity, and its bulge.
    Span<Vec2> loop_from, loop_to, loop_bulge;
    Span<Real> move;            // [2 * functions]
    Span<unsigned char> block;  // the block of the basis with these modes
    ModeWork work;              // uses the same memory as `safe`
    BasisCounts counts;
    Index n_bodies = 0;

    // The basis is one of the plan's analysis, or combined from such a basis, and has no modes.
    void lay_out(Arena& arena, Plan const& plan, Basis const& basis) noexcept;
    // Takes displacements of the points of the list, and a movement [2 * functions] of the basis; a
    // null pointer means that the control points do not move. The basis must be solved if it has
    // functions. The plan need not have a factor, and may be left without one.
    Status run(Plan& plan, Basis const& basis, const Real* movement, PointList const& list,
               Points wall, SafeOptions const& options, SafeReport& report, Fault& fault) noexcept;

private:
    Status read(Plan const& plan, PointList const& list, Points wall, Fault& fault) noexcept;
    void find_bodies(Plan const& plan) noexcept;
    void make_modes(Plan const& plan, Index first_mode) noexcept;
    Real find_bulges(Plan const& plan, Span<Vec2> mode) noexcept;
};

}  // namespace harmorph
