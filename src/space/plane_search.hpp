// Finds the mesh of a plane, and the point of the plane that each point of space follows.
// tests/space/test_plane.cpp and tests/space/test_refused_planes.cpp cover this file.
#pragma once

#include "mesh/box_tree.hpp"
#include "space/plane.hpp"

namespace harmorph {

// Holds the working space, which is needed during the search only.
struct PlaneSearch {
    // A point of space that is opposite to a place where the plane has several points.
    struct Ambiguous {
        Index place;  // the first point of the plane at this place
        Index point;  // the point of space
        Real across;
    };

    Span<std::uint8_t> in_faces;  // [n_space_points]
    Span<Real> reach;             // [n_points] the squared largest distance of a follower
    Span<Index> first_at_place;   // [n_points] the first point at the same place
    Span<Index> next_at_place;    // [n_points] the next point at the same place, or none
    Span<Ambiguous> ambiguous;    // [n_space_points]
    BoxTree tree;

    void lay_out(Arena& arena, SpaceMesh const& mesh) noexcept;
    Status run(SpaceMesh const& mesh, Plane& plane, Fault& fault) noexcept;

private:
    void number_points(SpaceMesh const& mesh, Plane& plane) noexcept;
    void copy_cells(SpaceMesh const& mesh, Plane& plane) noexcept;
    void find_reach(Plane const& plane) noexcept;
    void find_places(Plane const& plane) noexcept;
    Status follow(SpaceMesh const& mesh, Plane& plane, Fault& fault) noexcept;
    void resolve(Plane& plane, Size n_ambiguous) noexcept;
    void follow_sides(SpaceMesh const& mesh, Plane& plane) noexcept;
    Status list_followers(Plane& plane, Fault& fault) noexcept;
    Status copy_sides(SpaceMesh const& mesh, Plane& plane, Fault& fault) noexcept;
};

}  // namespace harmorph
