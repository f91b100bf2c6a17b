// Measures the first layer of the mesh at the walls: finds the edge that leaves each wall point,
// and how a deformation changes the angle and the height of this edge.
#pragma once

#include "boundary/conditions.hpp"
#include "boundary/distance.hpp"

namespace harmorph {

// Lists the points of the walls, which are given as faces; the mesh is on the left of each face.
struct WallPoints {
    Index count = 0;
    Span<Index> point;  // [max_count], of which `count` are used: mesh points
    // [max_count] The neighbours of each point on the wall as mesh points, or none at an end.
    Span<Index> previous, next;
    Span<Index> slot;  // [n_points] the number of a mesh point in these lists, or none

    static Size max_count(Index n_points, Size max_faces) noexcept {
        return min(2 * max_faces, static_cast<Size>(n_points));
    }
    void lay_out(Arena& arena, Index n_points, Size max_faces) noexcept;
    void find(Index n_points, Span<const FaceDistance::Face> walls) noexcept;

    // Returns the tangent, not normalised, of the parabola through the point of a slot and both
    // neighbours.
    Vec2 tangent(Index at_slot, Points points) const noexcept;
    Vec2 normal(Index at_slot, Points points) const noexcept {
        return left_of(direction(tangent(at_slot, points)));
    }
    // Returns the rotation of the wall between two states of the mesh, as cosine and sine:
    // the mean over the adjacent faces, not the rotation of the tangent, so that it is correct at
    // sharp edges as well as on smooth walls.
    Vec2 rotation(Index at_slot, Points before, Points after) const noexcept;
};

struct FirstLayer {
    WallPoints wall;
    // [wall.max_count] The other end of the mesh edge that is nearest to the normal, or none.
    Span<Index> above;

    void lay_out(Arena& arena, Mesh const& mesh, Size max_faces) noexcept;
    // representative [n_points] is the point that stands for each point.
    void find(Mesh const& mesh, Points points, Span<const Index> representative,
              Span<const FaceDistance::Face> walls) noexcept;
    // `slot` must have an edge.
    Real height(Index slot, Points points) const noexcept;
};

// An angle is the rotation of an edge relative to the wall. A height is that of the outer end of an
// edge above the wall, along the normal that rotates with the wall; a ratio is the height after the
// movement divided by the height before.
struct LayerChange {
    Real angle = 0;  // [degrees], without sign
    Real ratio = 1;
};
// `slot` must have an edge, with a height `before` that is not 0.
LayerChange change_of(FirstLayer const& layer, Index slot, Points before, Points after) noexcept;
struct FirstLayerChange {
    Index points = 0;                        // the number of wall points that have such an edge
    Real mean_angle = 0, largest_angle = 0;  // [degrees], without sign
    Real mean_ratio = 0, min_ratio = infinity, max_ratio = -infinity;
    Index largest_angle_point = none, min_ratio_point = none, max_ratio_point = none;
};
FirstLayerChange compare(FirstLayer const& layer, Points before, Points after) noexcept;

// Restores the distances from the walls that the mesh had before a deformation: completely near the
// walls, and less farther away.

// Every point near a wall has a foot, the nearest point of the wall. A deformation that preserves
// angles (the conformal basis) still scales the height above the moved foot with the stretch of the
// wall. Therefore the point moves along the normal n, which rotates with the wall, by
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
// the extent of all walls. At the end of a wall the reach is 0. The reach excludes points that are
// equally near to another wall (in a gap or a concave corner). Along the wall the reach grows by at
// most half of the distance.
struct WallHeights {
    WallPoints wall;
    // [n_points] The foot of each point; its face is none if the point is far from all walls or
    // must not move.
    Span<FaceDistance::Foot> foot;
    Span<Real> reach;     // [wall.max_count]
    Span<Vec2> rotation;  // [wall.max_count] the rotation of the wall in the current deformation

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
