// The caller's mesh of three dimensions: all points, the faces of one symmetry plane, the boundary
// between the layers.
#pragma once

#include "base/vec3.hpp"

namespace harmorph {

enum class SpaceKind : std::int32_t { found = 0, planes = 1, wedge = 2 };

// The points of one face.
struct SpaceFace {
    Index n = 0;
    const Index* number = nullptr;  // as the caller has them
    Index index_base = 0;

    Index point(Index k) const noexcept {  // counted from 0
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
    const Index* face_start = nullptr;  // nullptr: four entries each, a triangle repeats its last
    const Index* face_points = nullptr;
    Index n_sides = 0;
    const Index* side_points = nullptr;
    const Index* side_markers = nullptr;
    Vec3 axis_point, axis;  // wedge; axis 0: to be found
    Real tolerance = 0;     // 0: from the extent

    static constexpr Index max_points = Index{1} << 30;
    static constexpr Index max_faces = Index{1} << 29;
    static constexpr Index most_corners = 1024;  // of a face

    Offset n_corners() const noexcept {
        return face_start == nullptr ? Offset{4} * n_faces
                                     : Offset{face_start[n_faces]} - index_base;
    }
    // Upper bound of the number of different points of the faces.
    Index max_plane_points() const noexcept {
        return static_cast<Index>(min(n_corners(), Offset{n_points}));
    }
    SpaceFace face(Index i) const noexcept;
};

// Ranges of the counts alone: all that a size query may look at.
Status check_counts(SpaceMesh const& mesh, Fault& fault) noexcept;
// Pointers, indices, coordinates, axis and tolerance.
Status check_space_mesh(SpaceMesh const& mesh, Fault& fault) noexcept;

}  // namespace harmorph
