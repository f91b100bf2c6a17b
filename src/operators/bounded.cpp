#include "operators/bounded.hpp"

namespace harmorph {
namespace {

// The area is computed from the smallest point number on, so that the three edges of a triangle get
// the same bits. Linear fields are then reproduced even if the area is a small difference of large
// products.
Real twice_area(Index a, Index b, Index c, Points points) noexcept {
    Index const first = min(a, min(b, c));
    if (first == b) return cross(points[c] - points[b], points[a] - points[b]);
    if (first == c) return cross(points[a] - points[c], points[b] - points[c]);
    return cross(points[b] - points[a], points[c] - points[a]);
}

}  // namespace

Index assemble_bounded(Span<const DelaunayEdge> edges, Points points, Span<const Real> conductivity,
                       Matrix const& matrix) noexcept {
    matrix.clear();
    for (Index i = 0; i < edges.count(); ++i) {
        DelaunayEdge const edge = edges[i];
        Vec2 const begin = points[edge.begin], end = points[edge.end];
        auto const dot_at = [&](Index apex) {
            return dot(begin - points[apex], end - points[apex]);
        };
        Real const left = twice_area(edge.begin, edge.end, edge.left, points);
        if (!(left > 0)) return i;
        Real conductance = 0.5 * (dot_at(edge.left) / left);
        if (edge.right != none) {
            Real const right = twice_area(edge.end, edge.begin, edge.right, points);
            if (!(right > 0)) return i;
            conductance = max(conductance + 0.5 * (dot_at(edge.right) / right), 0.0);
        }
        matrix.add(edge.begin, edge.end,
                   conductivity.empty() ? conductance : conductivity[i] * conductance);
    }
    return none;
}

}  // namespace harmorph
