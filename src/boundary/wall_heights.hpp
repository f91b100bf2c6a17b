// Restores the distances from the walls that the mesh had before a deformation: completely near the
// walls, and less farther away.
#pragma once

#include "boundary/conditions.hpp"
#include "boundary/first_layer.hpp"

namespace harmorph {

// Every point near a wall has a foot, the nearest point of the wall. A deformation that preserves
// angles (the conformal basis) still scales the height above the moved foot with the stretch of the
// wall. Therefore the point moves along the normal n, which turns with the wall, by
//
//   n (d - h) fade(d / reach),
//
// where d and h are the heights before and after the deformation, and fade(x) is 1 - 3 x + 2 x
// sqrt(x) up to x = 1 and 0 beyond. fade and its derivative are 0 at the reach. The corrected
// heights above one foot keep their order if the wall is stretched by more than 0.22, because d/dx
// (x fade) >= -0.28. A rigid motion is changed by rounding only; a mesh that has not moved is not
// changed at all.
//
// The reach is a function along the wall: the smaller of the radius of curvature and a quarter of
// the extent of all walls. At the end of a wall the reach is 0. It does not include points that are
// equally near to another wall (in a gap or a concave corner). Along the wall the reach grows by at
// most half of the distance.
struct WallHeights {
    WallPoints wall;
    // [n_points] The foot of each point; its face is none if the point is far from all walls or
    // must not move.
    Span<FaceDistance::Foot> foot;
    Span<Real> reach;  // [wall.max_count]
    Span<Vec2> turn;   // [wall.max_count] the rotation of the wall in the current deformation

    void lay_out(Arena& arena, Mesh const& mesh, Size max_faces) noexcept;
    // kinds and representative [n_points]: only inner points move; points that are joined to others
    // move with their representatives.
    void find(Mesh const& mesh, Points before, Span<const PointKind> kinds,
              Span<const Index> representative, FaceDistance const& walls,
              Executor const& executor) noexcept;
    // Restores the heights in the deformed mesh `points`; points on boundaries do not move. amount
    // is from 0 (no change) to 1 (complete). Afterwards the caller must check the cells: some may
    // be inverted, if they nearly were before or if the stretch of the wall varies strongly.
    void restore(FaceDistance const& walls, Points before, MutablePoints points,
                 Span<const Index> representative, Real amount,
                 Executor const& executor) const noexcept;

private:
    void bound_by_curvature(FaceDistance const& walls, Points before) noexcept;
    void bound_by_jumps(Mesh const& mesh, Points before, Span<const Index> representative,
                        FaceDistance const& walls) noexcept;
    void grade(FaceDistance const& walls, Points before) noexcept;
    Real height(FaceDistance const& walls, Index point, Points before) const noexcept;
    Real reach_at(FaceDistance const& walls, FaceDistance::Foot const& at) const noexcept;
};

}  // namespace harmorph
