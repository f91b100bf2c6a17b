#include "mesh/boundary_pieces.hpp"

#include "mesh/loops.hpp"

#include <algorithm>
#include <utility>

namespace cli {

namespace {

// A point as part of one marker: where two markers meet, their pieces end.
using PointOfMarker = std::pair<std::int32_t, std::int32_t>;

std::vector<PointOfMarker> points_of_markers(const Mesh& mesh,
                                             const std::vector<std::int32_t>& joined) {
    std::vector<PointOfMarker> all;
    for (std::size_t end = 0; end < joined.size(); ++end)
        all.emplace_back(mesh.face_markers[end / 2], joined[end]);
    return all;
}

}  // namespace

std::vector<BoundarySegment> marker_pieces(const Mesh& mesh) {
    const std::vector<std::int32_t> joined = joined_ends(mesh, mesh.face_points);
    const std::vector<PointOfMarker> ends = points_of_markers(mesh, joined);
    std::vector<PointOfMarker> sorted = ends;
    std::sort(sorted.begin(), sorted.end());
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    std::vector<std::int32_t> numbers, faces_at(sorted.size());
    for (const PointOfMarker& end : ends) {
        const auto at = std::lower_bound(sorted.begin(), sorted.end(), end);
        numbers.push_back(static_cast<std::int32_t>(at - sorted.begin()));
        ++faces_at[place(numbers.back())];
    }
    const BoundaryLoops pieces(numbers, static_cast<std::int32_t>(sorted.size())),
        loops(joined, mesh.points());
    const std::int32_t outer = outer_loop(boxes_of_loops(loops, mesh));
    std::vector<BoundarySegment> result(place(pieces.count));
    for (std::size_t end = 0; end < ends.size(); ++end) {
        const auto [marker, point] = ends[end];
        BoundarySegment& piece = result[place(pieces.of_edge[end / 2])];
        piece.marker = marker;
        piece.loop = loops.of_edge[end / 2];
        piece.is_of_body = piece.loop != outer;
        piece.faces += end % 2 == 0 ? 1 : 0;
        piece.point = point;
        piece.is_closed = piece.is_closed && faces_at[place(numbers[end])] == 2;
        piece.box.include(Point{mesh.x[place(point)], mesh.y[place(point)]});
    }
    return result;
}

}  // namespace cli
