// The first layer of the mesh on its walls: which edge leaves each wall point, and what became of its angle and height.
#pragma once

#include "harmorph/boundary/distance.hpp"

namespace harmorph {

// Walls are the faces of a FaceDistance, in its order; the mesh is on their left.
struct WallPoints {
    Index count = 0;
    Span<Index> point;           // [most], of which `count` are used: mesh points
    Span<Index> previous, next;  // [most] its neighbours on the wall as mesh points, or none where the wall ends
    Span<Index> slot;            // [n_points] place of a mesh point in these lists, or none

    static Size most(Index n_points, Size max_faces) noexcept {
        return smaller(2 * max_faces, static_cast<Size>(n_points));
    }
    void lay_out(Arena& arena, Index n_points, Size max_faces) noexcept;
    void find(Index n_points, FaceDistance const& walls) noexcept;

    // Along the wall, of no particular length: of the parabola through the point and its neighbours.
    Vec2 tangent(Index its_slot, Points points) const noexcept;
    // By what the wall has turned between two states of the mesh: cosine and sine, of its faces and not of the tangent, so
    // that sharp edges are as good as smooth walls.
    Vec2 turn(Index its_slot, Points before, Points after) const noexcept;
};

struct FirstLayer {
    WallPoints wall;
    Span<Index> above;  // [wall.most] the other end of the mesh edge that is nearest to the normal, or none

    void lay_out(Arena& arena, Mesh const& mesh, Size max_faces) noexcept;
    // representative [n_points]: the point that stands for each.
    void find(Mesh const& mesh, Points points, Span<const Index> representative, FaceDistance const& walls) noexcept;
};

// Angles: what an edge turned more than its wall did. Heights: of an edge's end above the wall, along the normal that
// turns with the wall; after, as a fraction of before.
struct FirstLayerChange {
    Index points = 0;  // that have such an edge
    Real mean_angle = 0, largest_angle = 0;  // [degrees], without sign
    Real mean_ratio = 0, min_ratio = infinity, max_ratio = -infinity;
    Index largest_angle_point = none, min_ratio_point = none, max_ratio_point = none;
};
FirstLayerChange compare(FirstLayer const& layer, Points before, Points after) noexcept;

}  // namespace harmorph
