#include "mesh/boundary.hpp"

#include "base/sort.hpp"

namespace harmorph {
namespace {

constexpr Index face_of_edge(Index second) noexcept { return -2 - second; }
constexpr Index marked_with(Index face) noexcept { return -2 - face; }

Real distance(Points points, Index a, Index b) noexcept { return length(points[a] - points[b]); }

// Two points of edges without a marker that may be meant as one point of a cut.
struct Gap {
    Index point = none, other = none;
    Real width = infinity;

    // Takes the ends that are farther apart, of edges that are closer together than any before.
    void include(Points points, const Index (&ends)[2], Index low, Index high) noexcept {
        Index const directions[2][2] = {{low, high}, {high, low}};
        for (Index const(&to)[2] : directions) {
            Real const apart[2] = {distance(points, ends[0], to[0]),
                                   distance(points, ends[1], to[1])};
            Index const wider = apart[0] >= apart[1] ? 0 : 1;
            if (apart[wider] < width) *this = {ends[wider], to[wider], apart[wider]};
        }
    }
};

// Refuses the first edge without a marker. If another one is beside it, both may be sides of a cut.
Status refuse_unmarked(Topology const& topology, Fault& fault) noexcept {
    constexpr Real much_narrower = 0.1;  // than the edge is long
    Edges const& edges = topology.edges;
    Points const points = topology.mesh.points;
    Index first = none, ends[2] = {};
    Gap gap;
    edges.for_each([&](Index edge, Index low, Index high) {
        if (edges.second[edge] != Edges::unmarked) return;
        if (first != none) return gap.include(points, ends, low, high);
        first = edge;
        ends[0] = low;
        ends[1] = high;
    });
    if (gap.width <= much_narrower * distance(points, ends[0], ends[1])) {
        return fault.refuse(Status::bad_mesh,
                            "points # and @ of edges without a marker are ~ apart: if both are one "
                            "point of a cut, give them equal coordinates; otherwise a marker or a "
                            "cell is missing",
                            point_item(gap.point), point_item(gap.other), gap.width);
    }
    return fault.refuse(Status::bad_mesh,
                        "the edge between points # and @ has a cell on one side only and no "
                        "marker: a marker or a cell is missing",
                        point_item(ends[0]), point_item(ends[1]));
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
    if (count < edges.n_boundary) return refuse_unmarked(topology, fault);
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

namespace {

// Returns the ends of unmarked edges in ascending order, at the beginning of `points`.
Span<Index> ends_of_unmarked(Topology const& topology, Span<Index> points) noexcept {
    Edges const& edges = topology.edges;
    // At first, points[k] is k if point k is an end of an unmarked edge, and none otherwise.
    fill(points, none);
    edges.for_each([&](Index edge, Index low, Index high) {
        if (edges.second[edge] == Edges::unmarked) {
            points[low] = low;
            points[high] = high;
        }
    });
    Size n = 0;
    for (Index k = 0; k < topology.mesh.n_points; ++k) {
        if (points[k] != none) points[n++] = k;
    }
    return points.first(n);
}

// Gives both points the smaller one of their representatives. Returns whether these differed.
bool join(Span<Index> representative, Index a, Index b) noexcept {
    while (representative[a] != a) a = representative[a];
    while (representative[b] != b) b = representative[b];
    representative[max(a, b)] = min(a, b);
    return a != b;
}

// The order of points along a direction to which hardly any cut is normal, so that few points have
// nearly equal numbers.
Real along(Vec2 point) noexcept { return point.x + 0.7548776662466927 * point.y; }

}  // namespace

Index join_cuts(Topology& topology, Span<Index> points, Real tolerance) noexcept {
    Points const at = topology.mesh.points;
    Span<Index> const same = topology.representative;
    Span<Index> const ends = ends_of_unmarked(topology, points);
    sort(ends, [&](Index a, Index b) {
        Real const p = along(at[a]), q = along(at[b]);
        return p != q ? p < q : a < b;
    });
    Index joined = 0;
    for (Size k = 1; k < ends.size(); ++k) {
        Vec2 const here = at[ends[k]];
        for (Size before = k; before-- > 0;) {
            Vec2 const other = at[ends[before]];
            if (along(here) - along(other) > 4 * tolerance) break;
            if (!(largest_of(here - other) <= tolerance)) continue;
            if (join(same, ends[k], ends[before])) ++joined;
        }
    }
    // A representative is never larger than the point, so it has its own one already.
    for (Index& representative : same) representative = same[representative];
    return joined;
}

Real rounding_of_cuts(Topology const& topology) noexcept {
    constexpr Real of_extent = 1e-12, of_coordinates = 1e-15;
    Edges const& edges = topology.edges;
    Vec2 low{infinity, infinity}, high{-infinity, -infinity};
    Real largest = 0;
    edges.for_each([&](Index edge, Index first, Index last) {
        if (edges.second[edge] != Edges::unmarked) return;
        Vec2 const ends[2] = {topology.mesh.points[first], topology.mesh.points[last]};
        for (Vec2 const p : ends) {
            low = {min(low.x, p.x), min(low.y, p.y)};
            high = {max(high.x, p.x), max(high.y, p.y)};
            largest = max(largest, largest_of(p));
        }
    });
    if (!(high.x >= low.x)) return 0;
    return max(of_extent * length(high - low), of_coordinates * largest);
}

}  // namespace harmorph
