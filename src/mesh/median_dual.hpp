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

// Computes the areas and shortest edges of the unknowns' control volumes in the median dual, which
// local time steps and coarser levels need.
struct ControlVolumes {
    Span<Real> area;           // [n]
    Span<Real> shortest_edge;  // [n] the length of the shortest mesh edge at the point

    void lay_out(Arena& arena, Index n) noexcept;
    // unknown [n_points] is the position of the unknown of each point, or negative. A corner's
    // share of a cell is the quadrilateral of the corner, the midpoints of the two edges there, and
    // the mean of the cell's corners. All corners must have positive areas.
    void measure(OrientedMesh const& cells, Points points, Span<const Index> unknown) noexcept;
};

}  // namespace harmorph
