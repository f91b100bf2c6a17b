// A Plane is the mesh of one symmetry plane of a mesh one cell thick. Each point of space follows
// one point of the plane.
#pragma once

#include "base/arena.hpp"
#include "base/executor.hpp"
#include "mesh/locate.hpp"
#include "mesh/mesh.hpp"
#include "space/frame.hpp"

namespace harmorph {

struct Plane {
    Frame frame;
    Index index_base = 0;
    Index n_points = 0;  // in the plane
    Index n_space_points = 0;
    Index n_faces = 0, n_sides = 0;
    bool has_polygons = false;  // true if a face has more than four points
    // The largest number of points that follow one point of the plane; the point itself counts.
    Index layers = 0;
    Real max_distance = 0;  // the largest distance of a projected point from its point of the plane
    Index max_distance_point = none;

    // Numbers that the caller sees count from index_base: follows, space_point, cells and faces.
    Span<Index> follows;         // [n_space_points] the point of the plane
    Span<Index> space_point;     // [n_points] the number of the plane's point in space
    Span<Index> follower_start;  // [n_points + 1] from 0
    // [n_space_points] The points of space that follow each point of the plane, from 0, in
    // increasing order.
    Span<Index> follower;
    Span<Real> x, y;            // [n_points]
    Span<Real> work_x, work_y;  // [n_points] a displacement, or derivatives summed over the layers
    Span<Index> cell_start, cell_points;
    Span<Index> side_points, side_markers;
    // [n_space_points] In a wedge, cosine and sine of each point's angle; otherwise empty.
    Span<Vec2> rotation;

    // Takes arrays for the largest possible number of points.
    void lay_out(Arena& arena, SpaceMesh const& mesh) noexcept;

    Mesh mesh() const noexcept;
    // Returns the rotation of point k of space.
    Vec2 rotation_of(Index k) const noexcept { return rotation.empty() ? Vec2{1, 0} : rotation[k]; }

    // Computes to = from + the displacement of the plane's point; without `from`, only the
    // displacement. A component of the displacement that is 0 does not change the coordinate.
    void spread(Points displacement, SpacePoints from, MutableSpacePoints to,
                Executor const& executor) const noexcept;
    // Sums derivatives over the followers; this is the transpose of spread().
    void gather(SpacePoints by_space_points, MutablePoints by_points,
                Executor const& executor) const noexcept;
};

// Finds the mesh of a plane, and the point of the plane that each point of space follows.

// Holds the working space, which is needed during the search only.
struct PlaneSearch {
    // A point of space that is opposite to a place where the plane has several points.
    struct Ambiguous {
        Index place;  // the first point of the plane at this place
        Index point;  // the point of space
        Real across;
    };

    // [n_space_points] 1: the point is in a face, or a side joins it to the point that it follows.
    Span<std::uint8_t> known;
    Span<Real> reach;            // [n_points] the squared largest distance of a follower
    Span<Index> first_at_place;  // [n_points] the first point at the same place
    Span<Index> next_at_place;   // [n_points] the next point at the same place, or none
    Span<Ambiguous> ambiguous;   // [n_space_points]
    BoxTree tree;

    void lay_out(Arena& arena, SpaceMesh const& mesh) noexcept;
    Status run(SpaceMesh const& mesh, Plane& plane, Fault& fault) noexcept;

private:
    void number_points(SpaceMesh const& mesh, Plane& plane) noexcept;
    void copy_cells(SpaceMesh const& mesh, Plane& plane) noexcept;
    void find_reach(Plane const& plane) noexcept;
    void find_places(Plane const& plane) noexcept;
    Status follow(SpaceMesh const& mesh, Plane& plane, Fault& fault) noexcept;
    void follow_sides(SpaceMesh const& mesh, Plane& plane) noexcept;
    bool follow_edge(Index one, Index next, Plane& plane) noexcept;
    void resolve(Plane& plane, Size n_ambiguous) noexcept;
    void follow_remaining(Plane& plane, Index place, Span<Ambiguous> layer) noexcept;
    Status list_followers(Plane& plane, Fault& fault) noexcept;
    Status copy_sides(SpaceMesh const& mesh, Plane& plane, Fault& fault) noexcept;
};

}  // namespace harmorph
