// Mesh points of a wall that are not exactly on its curve, where a body turns. A curve is fitted to
// the points of the wall and leaves a residual e = x - C(u), which is often far larger than the
// first layer is high. The movement of control points is split into the similarity r (z - c) that
// fits it best, which every point of the wall follows with its own position, and the rest, which
// follows the curve:
//     dx = d + (r - 1) (x - c) + sum_i N_i dP_i^rest = sum_i N_i dP_i + (r - 1) e.
// So a body that turns keeps the shape that the mesh gives it, and a movement that turns nothing
// moves as the B-spline does.
//
// Inside the mesh the similarity is carried exactly near the wall and fades to what the functions
// make of it:
//     dz = sum_i F_i dP_i + (rho - 1) fade(d / reach) (z - sum_i F_i P_i),
// d the distance to the wall at the start, P_i the control points, rho the part of r that the step
// makes; on the wall the bracket is e.
#pragma once

#include "boundary/distance.hpp"
#include "safe/motion_path.hpp"

namespace harmorph {

struct CarriedOffsets {
    // The reach in units of the largest residual: what fades over it bends the mesh by a few parts
    // in a hundred.
    static constexpr Real reach_per_residual = 50;

    Span<Vec2> wall;          // [wall points] e
    Span<Real> x, y;          // [n_points] fade (z - sum F_i P_i) on the mesh at hand
    Span<Index> group;        // [n_points] that turns the point, or none
    Span<Real> part;          // [n_points] fade, of points with a group that stand for themselves
    Span<Real> control;       // [2 * functions]
    Real reach = 0;           // 0: there is nothing to carry
    bool has_groups = false;  // whether `group` and `part` have been found
    const void* found_with = nullptr;  // the functions that x and y were found with; null: not yet

    void lay_out(Arena& arena, BasisCounts const& counts) noexcept;
    // For the start. A wall whose offsets the functions carry themselves
    // (Method::offset_correction) has none left.
    void init(Basis const& basis, MovementPath const& path, Points start) noexcept;
    // The mesh or its functions have changed.
    void forget() noexcept { found_with = nullptr; }
    // Unless they are known: group and part of all points, from where they start. representative,
    // held [n_points]: see Tangle.
    void find_groups(Basis const& basis, MovementPath const& path, Points start,
                     FaceDistance& walls, Span<const Index> representative,
                     Span<const std::uint8_t> held, Executor const& executor) noexcept;
    // Unless they are known: x and y for the mesh at hand, to which `reached` [2 * functions] has
    // led.
    void find(Basis const& by, Span<const Real> reached, Points now,
              Span<const Index> representative, Executor const& executor) noexcept;
    // Adds what the step from one time of the path to another makes of them to displacements of
    // inner points.
    void add(MovementPath const& path, Real from, Real to, MutablePoints displacement,
             Executor const& executor) const noexcept;
    // Of a point of the wall, from the start.
    Vec2 of_wall(Basis const& basis, MovementPath const& path, Index slot,
                 TurnAt& turn) const noexcept {
        if (wall[slot].x == 0 && wall[slot].y == 0) return {};
        return product(turn.of(path.group_of_slot(basis, slot)) - Vec2{1, 0}, wall[slot]);
    }
    // The largest of these lengths.
    Real largest(Basis const& basis, MovementPath const& path, Real t) const noexcept;
};

}  // namespace harmorph
