// A SpaceMesh is a view of the caller's mesh in three dimensions: all points, the faces of one
// symmetry plane, and the boundary between the layers. tests/space/test_refused_planes.cpp covers
// this file.
#pragma once

#include "base/vec3.hpp"

namespace harmorph {

enum class SpaceKind : std::int32_t { found = 0, planes = 1, wedge = 2 };

// The points of one face.
struct SpaceFace {
    Index n = 0;
    const Index* number = nullptr;  // in the caller's numbering
    Index index_base = 0;

    // Returns point k of the face, counted from 0.
    Index point(Index k) const noexcept {
        return static_cast<Index>(static_cast<std::uint32_t>(number[k]) -
                                  static_cast<std::uint32_t>(index_base));
    }
};

struct SpaceMesh {
    Index index_base = 0;
    Index n_points = 0;
    SpacePoints points;
    SpaceKind kind = SpaceKind::found;
    Index n_faces = 0;
    // If face_start is null, each face has four entries, and a triangle repeats the last one.
    const Index* face_start = nullptr;
    const Index* face_points = nullptr;
    Index n_sides = 0;
    const Index* side_points = nullptr;
    const Index* side_markers = nullptr;
    Vec3 axis_point, axis;  // of a wedge; if axis is 0, the axis is found from the points
    Real tolerance = 0;     // if 0, the tolerance is a fraction of the extent

    static constexpr Index max_points = Index{1} << 30;
    static constexpr Index max_faces = Index{1} << 29;
    static constexpr Index max_corners = 1024;  // of a face

    Offset n_corners() const noexcept {
        return face_start == nullptr ? Offset{4} * n_faces
                                     : Offset{face_start[n_faces]} - index_base;
    }
    // Returns an upper bound of the number of different points of the faces.
    Index max_plane_points() const noexcept {
        return static_cast<Index>(min(n_corners(), Offset{n_points}));
    }
    SpaceFace face(Index i) const noexcept;
};

// Checks the ranges of the counts, which are all that a size query reads.
Status check_counts(SpaceMesh const& mesh, Fault& fault) noexcept;
// Checks everything: counts, pointers, indices, coordinates, axis and tolerance.
Status check_space_mesh(SpaceMesh const& mesh, Fault& fault) noexcept;

}  // namespace harmorph
