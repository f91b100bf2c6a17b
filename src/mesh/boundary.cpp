#include "mesh/boundary.hpp"

#include "base/sort.hpp"

namespace harmorph {
namespace {

constexpr Index face_of_edge(Index second) noexcept { return -2 - second; }
constexpr Index marked_with(Index face) noexcept { return -2 - face; }

Status refuse_unmarked(Edges const& edges, Fault& fault) noexcept {
    edges.for_each([&](Index edge, Index low, Index high) {
        if (edges.second[edge] != Edges::unmarked || failed(fault.status)) return;
        fault.refuse(Status::bad_mesh,
                     "the edge between points # and @ has a cell on one side only and no marker: a "
                     "marker or a cell is missing",
                     point_item(low), point_item(high));
    });
    return fault.status;
}

// Refuses a face of the caller that is not a boundary edge of the cells.
Status check_face(BoundaryFace face, Edges const& edges, Index edge, Fault& fault) noexcept {
    const char* wrong = nullptr;
    if (face.begin == face.end) {
        wrong = "a boundary face has the end points # and @, which are the same point";
    } else if (edge == none) {
        wrong =
            "the boundary face between points # and @ is not an edge of any cell; check whether "
            "cells are missing";
    } else if (!edges.is_boundary(edge)) {
        wrong = "the boundary face between points # and @ has cells on both sides";
    }
    return wrong == nullptr ? Status::ok
                            : fault.refuse(Status::bad_mesh, wrong, point_item(face.begin),
                                           point_item(face.end));
}

}  // namespace

Size Boundary::max_faces(Mesh const& mesh) noexcept {
    Offset const in_lists = mesh.n_lists > 0 && mesh.list_start != nullptr
                                ? Offset{mesh.list_start[mesh.n_lists]} - mesh.index_base
                                : 0;
    Size in_blocks = 0;
    if (mesh.block_markers != nullptr) {
        for (Index k = 0; k < 2 * mesh.n_blocks; ++k) {
            in_blocks += 2 * static_cast<Size>(max(mesh.block_sizes[k], Index{1}) - 1);
        }
    }
    return static_cast<Size>(mesh.n_faces) + static_cast<Size>(in_lists < 0 ? 0 : in_lists) +
           in_blocks;
}

void Boundary::lay_out(Arena& arena, Mesh const& mesh) noexcept {
    Size const n = max_faces(mesh);
    arena.take(point, n);
    arena.take(marker, n);
    arena.take(condition, n);
    arena.take(loop_start, n + 1);
    arena.take(given_begin, n);
    arena.take(given_end, n);
    arena.take(given_marker, n);
    arena.take(head, mesh.n_points);
    arena.take(next, n);
}

Status Boundary::mark(Topology& topology, Fault& fault) noexcept {
    Edges& edges = topology.edges;
    Span<const Index> const representative = topology.representative;
    count = 0;
    topology.mesh.for_each_face([&](BoundaryFace face, Index, Index) {
        Index const edge = edges.find(representative[face.begin], representative[face.end]);
        if (failed(check_face(face, edges, edge, fault))) return false;
        if (edges.second[edge] == Edges::unmarked) {
            given_marker[count] = face.marker;
            given_begin[count] = edge;  // order() replaces the edge by its first point
            given_end[count] = min(representative[face.begin], representative[face.end]);
            edges.second[edge] = marked_with(count++);
        } else if (given_marker[face_of_edge(edges.second[edge])] != face.marker) {
            fault.refuse(Status::bad_mesh,
                         "the boundary face between points # and @ belongs to two markers",
                         point_item(face.begin), point_item(face.end));
            return false;
        }
        return true;
    });
    return fault.status;
}

Status Boundary::order(Topology const& topology, Fault& fault) noexcept {
    Edges const& edges = topology.edges;
    if (count < edges.n_boundary) return refuse_unmarked(edges, fault);
    for (Index face = 0; face < count; ++face) {
        Index const edge = given_begin[face], low = given_end[face], high = edges.first[edge].end;
        Index const code = edges.first[edge].code;
        bool const downwards = runs_backwards(code) != (topology.reversed[cell_of_side(code)] != 0);
        given_begin[face] = downwards ? high : low;
        given_end[face] = downwards ? low : high;
    }
    fill(head.first(topology.mesh.n_points), none);
    // Faces that begin at the same point form a list in the given order.
    for (Index face = count; face-- > 0;) {
        next[face] = head[given_begin[face]];
        head[given_begin[face]] = face;
    }
    n_loops = 0;
    Index placed = 0;
    for (Index first = 0; first < count; ++first) {
        if (head[given_begin[first]] == none) continue;
        loop_start[n_loops++] = placed;
        // At every point, as many faces begin as end, so the loop closes at its first point.
        for (Index at = given_begin[first]; head[at] != none;) {
            Index const face = head[at];
            head[at] = next[face];
            point[placed] = at;
            marker[placed++] = given_marker[face];
            at = given_end[face];
        }
    }
    loop_start[n_loops] = placed;
    return Status::ok;
}

Index join_cuts(Topology& topology, Span<Index> points) noexcept {
    Mesh const& mesh = topology.mesh;
    Edges const& edges = topology.edges;
    Size n = 0;
    // At first, points[k] is k if point k is an end of an unmarked edge, and none otherwise.
    fill(points, none);
    edges.for_each([&](Index edge, Index low, Index high) {
        if (edges.second[edge] == Edges::unmarked) {
            points[low] = low;
            points[high] = high;
        }
    });
    for (Index k = 0; k < mesh.n_points; ++k) {
        if (points[k] != none) points[n++] = k;
    }
    auto const order_of = [&](Index a, Index b) -> int {
        Vec2 const p = mesh.points[a], q = mesh.points[b];
        if (p.x != q.x) return p.x < q.x ? -1 : 1;
        if (p.y != q.y) return p.y < q.y ? -1 : 1;
        return 0;
    };
    Span<Index> const ends = points.first(n);
    sort(ends, [&](Index a, Index b) {
        int const order = order_of(a, b);
        return order != 0 ? order < 0 : a < b;
    });
    Index joined = 0;
    for (Size k = 1; k < n; ++k) {
        if (order_of(ends[k - 1], ends[k]) != 0) continue;
        topology.representative[ends[k]] = topology.representative[ends[k - 1]];
        ++joined;
    }
    return joined;
}

}  // namespace harmorph
