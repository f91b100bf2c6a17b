// A mesh on the way of a large movement: where it is, and where one more step leads.
#pragma once

#include "morph/admissible_step.hpp"
#include "morph/crossing.hpp"
#include "plan/plan.hpp"
#include "safe/carried_offsets.hpp"

namespace harmorph {

struct MovingMesh {
    MovementPath path;
    CarriedOffsets carried;
    Real time = 0;                // 0..1 on the path
    Span<Real> x, y;              // [n_points] now
    Span<Real> ahead_x, ahead_y;  // [n_points] after the step that was looked at last
    Span<Real> reached, aimed,
        difference;  // [2 * functions] movements since the start: now, ahead, and ahead - now
    Real aimed_time = 0;
    Span<KnownEnd> ends;  // [n_points] what is known of where points end
    Span<Index>
        representative;       // [n_points] of points that a cut joins: the one that stands for all
    Span<std::uint8_t> held;  // [n_points] 1: on the boundary, wherever the step takes it
    Span<SlipCurves::Place>
        slid;                // [slots of slip curves] where sliding points are after that step
    Span<const Vec2> given;  // [given points] their whole displacement, bit by bit; empty: by modes

    void lay_out(Arena& arena, Plan const& plan, BasisCounts const& counts) noexcept;
    // Before init(): displacements of given points, and the ways of the modes that carry them.
    void take_given(Span<const Vec2> displacements,
                    Span<const MovementPath::ModeWay> ways) noexcept {
        given = displacements;
        path.mode_ways = ways;
    }
    // The plan's mesh is the start.
    void init(Plan const& plan, Basis const& basis, const Real* move) noexcept;
    // Back to the start.
    void begin(Plan const& plan) noexcept;

    Points now() const noexcept { return {x.data(), y.data(), 1}; }
    Points ahead() const noexcept { return {ahead_x.data(), ahead_y.data(), 1}; }
    MutablePoints to_ahead() const noexcept { return {ahead_x.data(), ahead_y.data(), 1}; }

    // Looks ahead to a time, by functions that were solved on the mesh as it is now. Returns how
    // much of that displacement is admissible. Points of walls are where the B-spline, the rigid
    // body, or the modes, and what is carried put them from the start, not from step to step:
    // rounding does not add up. Points that slide along curves are on their curves.
    AdmissibleStep look_ahead(Plan& plan, Basis const& basis, Basis const& by, Real to) noexcept;
    // Goes where it looked.
    void advance() noexcept;

private:
    void put_on_slip_curves(Plan const& plan) noexcept;
    Vec2 wall_move(Plan const& plan, Basis const& basis, Index slot, TurnAt& turn) const noexcept;
    // visit(point, start, displacement from there at the time it looks to)
    template <class Visit>
    void for_wall(Plan const& plan, Basis const& basis, Visit const& visit) const noexcept;
};

}  // namespace harmorph
