// Median-dual geometry: the control volume of each point, bounded by lines from edge midpoints to
// cell barycentres.
#pragma once

#include "mesh/topology.hpp"

namespace harmorph {

// The barycentre is the mean of a cell's corners. What bounds the volume of a point on the boundary
// is closed by half of each of the two boundary edges there. Areas of volumes: see ControlVolumes.
struct MedianDual {
    struct Face {
        Index begin, end;  // the points of an edge, the smaller first
        Vec2 normal;  // of the face between their volumes, from begin to end, as long as the face
        Vec2 along;   // the edge itself
    };
    Span<Face> faces;  // [edges]

    void lay_out(Arena& arena, Index n_edges) noexcept { arena.take(faces, n_edges); }
    void build(OrientedMesh const& cells, Edges const& edges, Points points) const noexcept;
};

}  // namespace harmorph
