// The mesh of one symmetry plane of a mesh of three dimensions, and which of its points each point
// of space follows.
#pragma once

#include "base/arena.hpp"
#include "base/executor.hpp"
#include "mesh/mesh.hpp"
#include "space/frame.hpp"

namespace harmorph {

struct Plane {
    Frame frame;
    Index index_base = 0;
    Index n_points = 0;  // of the plane
    Index n_space_points = 0;
    Index n_faces = 0, n_sides = 0;
    bool has_polygons = false;  // faces of more than four points
    Index layers = 0;           // most points that follow one point of the plane, itself included
    Real max_distance = 0;      // of a point from the place of its plane point
    Index max_distance_point = none;

    // Numbers that the caller sees count from index_base: follows, space_point, cells and faces.
    Span<Index> follows;         // [n_space_points] point of the plane
    Span<Index> space_point;     // [n_points] the point of the faces that it is
    Span<Index> follower_start;  // [n_points + 1] from 0
    Span<Index> follower;  // [n_space_points] points of space from 0, increasing for each point of
                           // the plane
    Span<Real> x, y;       // [n_points]
    Span<Real> work_x, work_y;  // [n_points] a displacement, or derivatives summed over the layers
    Span<Index> cell_start, cell_points;
    Span<Index> side_points, side_markers;
    Span<Vec2>
        turn;  // [n_space_points] of a wedge: cosine and sine of each point's angle; else empty

    // Arrays for as many points as there could be.
    void lay_out(Arena& arena, SpaceMesh const& mesh) noexcept;

    Mesh mesh() const noexcept;
    Vec2 turn_of(Index k) const noexcept {
        return turn.empty() ? Vec2{1, 0} : turn[k];
    }  // of point k of space

    // to = from + displacement of the plane point; `from` not given: 0. Components that are 0 keep
    // the bits.
    void spread(Points displacement, SpacePoints from, MutableSpacePoints to,
                Executor const& executor) const noexcept;
    // The transpose.
    void gather(SpacePoints by_space_points, MutablePoints by_points,
                Executor const& executor) const noexcept;
};

}  // namespace harmorph
