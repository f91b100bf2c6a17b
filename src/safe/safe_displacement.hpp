// Displacements given at points of the wall, by the strategies of a safe morph.
//
// A loop of the boundary whose points are all given is a body, and goes the way of a body with
// curves (MovementPath):
//     p(t) = c + t d + r^t (p - c + t D),   D = (p + w - c - d) / r - (p - c),
// w the displacement of p, r (z - c) + d the similarity that fits these best. That is a combination
// of three modes of the wall, which are solved as functions by table: 1, p - c and D, with the
// amplitudes t d, r^t - 1 and t r^t. Points of other loops, which are given in part, go straight:
// one mode for all of them. At t = 1 the points have the given displacements, bit by bit.
#pragma once

#include "morph/mode_functions.hpp"
#include "safe/safe_morph.hpp"

namespace harmorph {

struct SafeDisplacement {
    SafeMorph safe;
    Span<Vec2> given;                  // [given points] their displacements
    Span<Index> body;                  // [given points] the loop that is a body, from 0, or none
    Span<MovementPath::ModeWay> ways;  // [modes]
    Span<Vec2> modes;                  // [modes x given points]
    Span<Real> move;                   // [2 * functions]
    Span<unsigned char> block;         // of the basis with these modes
    ModeWork work;                     // in the same memory as `safe`
    BasisCounts counts;
    Index n_bodies = 0;

    // basis: of the plan's analysis, or combined of such a one; without modes.
    void lay_out(Arena& arena, Plan const& plan, Basis const& basis) noexcept;
    // Displacements of the points of the list, and a movement [2 * functions] of the basis, or
    // null: none. The basis is solved, if it has functions. The plan need not have a factor, and
    // may be left without one.
    Status run(Plan& plan, Basis const& basis, const Real* movement, PointList const& list,
               Points wall, SafeOptions const& options, SafeReport& report, Fault& fault) noexcept;

private:
    Status read(Plan const& plan, PointList const& list, Points wall, Fault& fault) noexcept;
    void find_bodies(Plan const& plan) noexcept;
    void make_modes(Plan const& plan, Index first_mode) noexcept;
};

}  // namespace harmorph
