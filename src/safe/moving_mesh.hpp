// A mesh during a large movement: its present position, and the position after one more step.
#pragma once

#include "morph/admissible_step.hpp"
#include "morph/crossing.hpp"
#include "plan/plan.hpp"
#include "safe/carried_offsets.hpp"

namespace harmorph {

struct MovingMesh {
    MovementPath path;
    CarriedOffsets carried;
    Real time = 0;                // the present time on the path, between 0 and 1
    Span<Real> x, y;              // [n_points] the present coordinates
    Span<Real> ahead_x, ahead_y;  // [n_points] the coordinates after the last trial step
    // [2 * functions] Movements since the start: at present, after the trial step, and their
    // difference.
    Span<Real> reached, aimed, difference;
    Real aimed_time = 0;
    Span<KnownEnd> ends;  // [n_points] what is known about the final positions
    // [n_points] The representative of points that a cut joins.
    Span<Index> representative;
    Span<std::uint8_t> held;  // [n_points] 1: on the boundary, where the step moves the point
    // [slots of slip curves] The positions of slipping points after the trial step.
    Span<SlipCurves::Place> slip_place;
    // [given points] The whole displacements of these points, which are reached exactly. Empty: the
    // modes alone move the points.
    Span<const Vec2> given;

    void lay_out(Arena& arena, Plan const& plan, BasisCounts const& counts) noexcept;
    // Must be called before init(). Sets the displacements of given points, and the ways of the
    // modes that carry them.
    void take_given(Span<const Vec2> displacements,
                    Span<const MovementPath::ModeWay> ways) noexcept {
        given = displacements;
        path.mode_ways = ways;
    }
    // The start is the plan's mesh.
    void init(Plan const& plan, Basis const& basis, const Real* move) noexcept;
    // Returns to the start.
    void begin(Plan const& plan) noexcept;

    Points now() const noexcept { return {x.data(), y.data(), 1}; }
    Points ahead() const noexcept { return {ahead_x.data(), ahead_y.data(), 1}; }
    MutablePoints to_ahead() const noexcept { return {ahead_x.data(), ahead_y.data(), 1}; }

    // Makes a trial step to a time with functions that were solved on the present mesh. Returns
    // which part of that displacement is admissible. Points of walls are placed from the start by
    // the B-spline, the rigid body or the modes together with the carried offsets, and not from
    // step to step, so that rounding does not accumulate. Points that slip along curves are on
    // their curves.
    AdmissibleStep look_ahead(Plan& plan, Basis const& basis, Basis const& by, Real to) noexcept;
    // Makes the trial step the present mesh.
    void advance() noexcept;

private:
    void put_on_slip_curves(Plan const& plan) noexcept;
    Vec2 wall_move(Plan const& plan, Basis const& basis, Index slot, TurnAt& turn) const noexcept;
    // Calls visit(point, start, displacement) with the displacement from the start to the time of
    // the trial step.
    template <class Visit>
    void for_wall(Plan const& plan, Basis const& basis, Visit const& visit) const noexcept;
};

}  // namespace harmorph
