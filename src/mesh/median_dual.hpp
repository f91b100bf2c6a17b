// Computes the faces of the median dual, which bound the control volume of each point: lines from
// edge midpoints to cell barycentres.
#pragma once

#include "mesh/topology.hpp"

namespace harmorph {

// The barycentre is the mean of a cell's corners. The volume of a point on the boundary is also
// bounded by the nearer halves of the two boundary edges at the point. ControlVolumes computes the
// areas of the volumes.
struct MedianDual {
    struct Face {
        Index begin, end;  // the points of an edge, the smaller number first
        // The normal of the face between the volumes of both points; it points from begin to end
        // and is as long as the face.
        Vec2 normal;
        Vec2 along;  // the edge from begin to end
    };
    Span<Face> faces;  // [edges]

    void lay_out(Arena& arena, Index n_edges) noexcept { arena.take(faces, n_edges); }
    void build(OrientedMesh const& cells, Edges const& edges, Points points) const noexcept;
};

}  // namespace harmorph
