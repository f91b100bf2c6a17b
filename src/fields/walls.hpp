// Computes the exact distances of points to the walls of a mesh in any position, with derivatives,
// and the heights of the first layer.
#pragma once

#include "boundary/first_layer.hpp"
#include "plan/analysis.hpp"

namespace harmorph {

// The point of the walls that is nearest to another point. Of several nearest faces the one with
// the smallest number counts, up to rounding of their distances.
struct WallFoot {
    Index face = none;
    Real t = 0;  // The foot is (1 - t) begin + t end of the face.
    Real distance = 0;
    Vec2 normal;  // The unit vector from the foot to the point; on the wall, into the mesh.
};

// The faces keep copies of the coordinates of their ends, so no array of the caller is needed after
// move_to().
struct Walls {
    struct Segment {
        Vec2 begin, end;
        Real inverse_length, inverse_square;  // of the face; 0 without length
    };
    FaceDistance tree;
    FirstLayer layer;
    Span<Segment> segments;               // [faces]
    Span<Index> face_point, face_marker;  // [2 * faces], [faces], in the caller's numbering
    Span<Index> wall_point, above;        // [wall points], in the caller's numbering
    Index n_points = 0, index_base = 0;   // of the mesh

    // Counts the faces that have one of the markers.
    static Index count_faces(Boundary const& boundary, Span<const Index> markers) noexcept;
    void lay_out(Arena& arena, Analysis const& analysis, Index n_faces) noexcept;
    void find(Analysis const& analysis, Span<const Index> markers, Points at) noexcept;
    // Reads the coordinates of the wall points from the mesh points `at`.
    void move_to(Points at) noexcept;

    Index n_faces() const noexcept { return segments.count(); }
    // Returns the nearest point of one face.
    WallFoot foot_on(Index face, Vec2 from) const noexcept;
    // Does the same, except that the normal is not computed.
    WallFoot place_on(Index face, Vec2 from) const noexcept;
    // Computes the height of the outer end of each first-layer edge above its wall point, in the
    // direction of the normal at `at`; 0 without such an edge.
    void heights(Points at, Span<Real> height) const noexcept;
};

}  // namespace harmorph
