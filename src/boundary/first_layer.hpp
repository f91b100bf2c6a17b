// Measures the first layer of the mesh at the walls: finds the edge that leaves each wall point,
// and how a deformation changes the angle and the height of this edge.
#pragma once

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
    // Returns the rotation of the wall between two states of the mesh, as cosine and sine. It is
    // the mean over the adjacent faces, not the rotation of the tangent, so that it is correct at
    // sharp edges as well as on smooth walls.
    Vec2 turn(Index at_slot, Points before, Points after) const noexcept;
};

struct FirstLayer {
    WallPoints wall;
    // [wall.max_count] The other end of the mesh edge that is nearest to the normal, or none.
    Span<Index> above;

    void lay_out(Arena& arena, Mesh const& mesh, Size max_faces) noexcept;
    // representative [n_points] is the point that stands for each point.
    void find(Mesh const& mesh, Points points, Span<const Index> representative,
              Span<const FaceDistance::Face> walls) noexcept;
};

// An angle is the rotation of an edge relative to the wall. A height is that of the outer end of an
// edge above the wall, along the normal that turns with the wall; a ratio is the height after the
// movement divided by the height before.
struct FirstLayerChange {
    Index points = 0;                        // the number of wall points that have such an edge
    Real mean_angle = 0, largest_angle = 0;  // [degrees], without sign
    Real mean_ratio = 0, min_ratio = infinity, max_ratio = -infinity;
    Index largest_angle_point = none, min_ratio_point = none, max_ratio_point = none;
};
FirstLayerChange compare(FirstLayer const& layer, Points before, Points after) noexcept;

}  // namespace harmorph
