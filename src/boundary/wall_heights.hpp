// Distances from the walls brought back to what they were before a deformation: near them entirely,
// farther away less.
#pragma once

#include "boundary/conditions.hpp"
#include "boundary/first_layer.hpp"

namespace harmorph {

// Every point near a wall has a foot: the nearest point of the wall. A deformation that preserves
// angles (the conformal basis) still scales the height above the moved foot with the stretch of the
// wall. So the point moves along the normal n, which turns with the wall, by
//
//   n (d - h) fade(d / reach),   d, h: heights before and after;   fade(x) = 1 - 3 x + 2 x sqrt(x)
//   up to x = 1, then 0.
//
// fade and its derivative vanish at the reach, and the corrected heights above one foot keep their
// order as long as the wall is stretched by more than 0.22 (d/dx (x fade) >= -0.28). Rigid motion
// is not changed beyond rounding; a mesh that has not moved is not changed at all.
//
// The reach is a function along the wall: the radius of curvature, or a quarter of the extent of
// all walls where that is less; 0 where a wall ends; never beyond points from which another part of
// the wall is as near (a gap, a concave corner). Along the wall the reach grows by at most half of
// the distance.
struct WallHeights {
    WallPoints wall;
    Span<FaceDistance::Foot> foot;  // [n_points] none: far from walls, or not to be moved
    Span<Real> reach;               // [wall.most]
    Span<Vec2> turn;  // [wall.most] of the wall at its points, in the deformation at hand

    void lay_out(Arena& arena, Mesh const& mesh, Size max_faces) noexcept;
    // kinds, representative [n_points]: only points inside move, points that are joined to others
    // with these.
    void find(Mesh const& mesh, Points before, Span<const PointKind> kinds,
              Span<const Index> representative, FaceDistance const& walls,
              Executor const& executor) noexcept;
    // points: in, the deformed mesh; out, with heights restored; points on boundaries stay. amount
    // 1: entirely, 0: not at all. Cells may be inverted afterwards, where they nearly were before
    // or where the stretch varies strongly: check them.
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
