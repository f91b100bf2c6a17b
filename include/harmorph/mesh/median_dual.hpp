// Median-dual geometry: the control volume of each point, bounded by lines from edge midpoints to cell barycentres.
#pragma once

#include "harmorph/base/arena.hpp"
#include "harmorph/mesh/edges.hpp"

namespace harmorph {

// The barycentre is the mean of a cell's corners. What bounds the volume of a point on the boundary is closed by half
// of each of its two boundary edges.
struct MedianDual {
    struct Face {
        Index begin, end;  // the points of an edge, the smaller first
        Vec2 normal;       // of the face between their volumes, from begin to end, as long as the face
        Vec2 along;        // the edge itself
    };
    Span<Face> faces;      // [edges]
    Span<Real> area;       // [n_points] of the volumes; 0: used by no cell, or joined to another point

    void lay_out(Arena& arena, Index n_edges, Index n_points) noexcept;
    // For the cells as `reversed` says; representative [n_points] as for the edges.
    void build(Mesh const& mesh, Points points, Edges const& edges, Span<const Index> representative,
               Span<const std::uint8_t> reversed) const noexcept;
};

}  // namespace harmorph
