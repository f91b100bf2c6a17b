// The first layer of the mesh at the walls: which edge leaves each wall point, and how a
// deformation changes the angle and the height of this edge.
#pragma once

#include "boundary/distance.hpp"

namespace harmorph {

// Walls are the faces of a FaceDistance, in its order; the mesh is on their left.
struct WallPoints {
    Index count = 0;
    Span<Index> point;           // [most], of which `count` are used: mesh points
    Span<Index> previous, next;  // [most] the neighbours of each on the wall as mesh points;
                                 // none where the wall ends
    Span<Index> slot;            // [n_points] number of a mesh point in these lists, or none

    static Size most(Index n_points, Size max_faces) noexcept {
        return min(2 * max_faces, static_cast<Size>(n_points));
    }
    void lay_out(Arena& arena, Index n_points, Size max_faces) noexcept;
    void find(Index n_points, FaceDistance const& walls) noexcept;

    // Tangent at the point of a slot, not normalised: of the parabola through the point and both
    // neighbours.
    Vec2 tangent(Index at_slot, Points points) const noexcept;
    // The rotation of the wall between two states of the mesh, as cosine and sine: the mean over
    // the adjacent faces, not the rotation of the tangent, so that sharp edges are treated as well
    // as smooth walls.
    Vec2 turn(Index at_slot, Points before, Points after) const noexcept;
};

struct FirstLayer {
    WallPoints wall;
    Span<Index>
        above;  // [wall.most] the other end of the mesh edge that is nearest to the normal, or none

    void lay_out(Arena& arena, Mesh const& mesh, Size max_faces) noexcept;
    // representative [n_points]: the point that stands for each.
    void find(Mesh const& mesh, Points points, Span<const Index> representative,
              FaceDistance const& walls) noexcept;
};

// Angles: the rotation of an edge relative to the wall. Heights: of the outer end of an edge above
// the wall, along the normal that turns with the wall; the ratio of after to before.
struct FirstLayerChange {
    Index points = 0;                        // wall points that have such an edge
    Real mean_angle = 0, largest_angle = 0;  // [degrees], without sign
    Real mean_ratio = 0, min_ratio = infinity, max_ratio = -infinity;
    Index largest_angle_point = none, min_ratio_point = none, max_ratio_point = none;
};
FirstLayerChange compare(FirstLayer const& layer, Points before, Points after) noexcept;

}  // namespace harmorph
