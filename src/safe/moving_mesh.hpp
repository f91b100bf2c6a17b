// A mesh during a large movement: its present position, and the position after one more step.
#pragma once

#include "morph/admissible_step.hpp"
#include "boundary/distance.hpp"
#include "safe/motion_path.hpp"
#include "morph/crossing.hpp"
#include "plan/plan.hpp"

namespace harmorph {

// Where a body rotates, mesh points of the wall that are not exactly on their curve need a
// correction. A curve is fitted to the points of the wall and leaves a residual e = x - C(u), which
// is often far larger than the height of the first layer. The movement of control points is split
// into two parts: the similarity r (z - c) that fits the movement best, which every point of the
// wall follows with its own position, and the rest, which follows the curve:
//   dx = d + (r - 1) (x - c) + sum_i N_i dP_i^rest = sum_i N_i dP_i + (r - 1) e.
// So a body that rotates keeps the shape that the mesh gives it, and without rotation or scaling
// the wall moves as the B-spline does.
//
// Inside the mesh the similarity is carried exactly near the wall and fades with the distance to
// the movement that the functions give:
//   dz = sum_i F_i dP_i + (rho - 1) fade(h / reach) (z - sum_i F_i P_i).
// Here h is the distance to the wall at the start, P_i are the control points, and rho is the
// similarity of the step, as r is the similarity of the whole movement; on the wall, z - sum_i F_i
// P_i is e.

struct CarriedOffsets {
    // The reach in units of the largest residual. An offset that fades over this length bends the
    // mesh by a few parts in a hundred.
    static constexpr Real reach_per_residual = 50;

    Span<Vec2> wall;    // [wall points] the residual e
    Span<Real> x, y;    // [n_points] fade (z - sum F_i P_i) on the present mesh
    Span<Index> group;  // [n_points] the group that rotates the point, or none
    // [n_points] fade(h / reach) of points that have a group and are their own representatives.
    Span<Real> fade;
    Span<Real> control;       // [2 * functions]
    Real reach = 0;           // 0: there are no offsets to carry
    bool has_groups = false;  // whether `group` and `fade` have been found
    // The functions that x and y were found with; null as long as x and y are not known.
    const void* found_with = nullptr;

    void lay_out(Arena& arena, BasisCounts const& counts) noexcept;
    // Finds the residuals when the basis was made, which are zero on a wall whose offsets are in
    // the functions (Method::offset_correction). The mesh may have moved since then, while the
    // curves of the basis are those before.
    void init(Basis const& basis, MovementPath const& path) noexcept;
    // Must be called when the mesh or its functions have changed.
    void forget() noexcept { found_with = nullptr; }
    // Finds the group and the fade of all points at their start, unless they are known. Tangle
    // describes representative and held [n_points].
    void find_groups(Basis const& basis, MovementPath const& path, Points start,
                     FaceDistance& walls, Span<const Index> representative,
                     Span<const std::uint8_t> held, Executor const& executor) noexcept;
    // Finds x and y, unless they are known, for the present mesh, which the movement `reached`
    // [2 * functions] has led to.
    void find(Basis const& by, Span<const Real> reached, Points now,
              Span<const Index> representative, Executor const& executor) noexcept;
    // Adds to displacements of inner points what the carried offsets contribute when the step goes
    // from one time of the path to another.
    void add(MovementPath const& path, Real from, Real to, MutablePoints displacement,
             Executor const& executor) const noexcept;
    // Returns the contribution to the displacement of a point of the wall from the start.
    Vec2 of_wall(Basis const& basis, MovementPath const& path, Index slot,
                 RotationAt& rotation) const noexcept {
        if (wall[slot].x == 0 && wall[slot].y == 0) return {};
        return product(rotation.of(path.group_of_slot(basis, slot)) - Vec2{1, 0}, wall[slot]);
    }
    // Returns the largest length of these contributions.
    Real largest(Basis const& basis, MovementPath const& path, Real t) const noexcept;
};

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
    Vec2 wall_move(Plan const& plan, Basis const& basis, Index slot,
                   RotationAt& rotation) const noexcept;
    // Calls visit(point, start, displacement) with the displacement from the start to the time of
    // the trial step.
    template <class Visit>
    void for_wall(Plan const& plan, Basis const& basis, Visit const& visit) const noexcept;
};

}  // namespace harmorph
