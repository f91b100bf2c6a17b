#include "harmorph/graph.hpp"

#include "harmorph/sort.hpp"

namespace harmorph {

void Graph::lay_out(Arena& arena, Mesh const& mesh) noexcept {
    Size const n_points = static_cast<Size>(mesh.n_points);
    Size const diagonals = 2 * static_cast<Size>(mesh.n_cells);
    Size const pairs = mesh.max_sides() + diagonals;
    arena.take(point, n_points);
    arena.take(unknown, n_points);
    arena.take(start, n_points + 1);
    arena.take(neighbour, 2 * pairs);
    arena.take(beside_curve, n_points);
}

void Graph::build(Mesh const& mesh, Edges const& edges, Span<const Index> representative,
                  Span<const PointKind> kinds) noexcept {
    n = 0;
    for (Index k = 0; k < mesh.n_points; ++k) {
        bool const is = is_unknown(kinds[k]);
        unknown[k] = is ? n : none;
        if (is) point[n++] = k;
    }
    Span<Offset> const starts = start.first(n + 1);
    fill(starts, Offset{0});
    fill(beside_curve, std::uint8_t{0});
    couplings = 0;
    auto const couple = [&](Index u, Index other) {
        if (kinds[other] != PointKind::on_curve) return;
        beside_curve[u] = 1;
        ++couplings;
    };
    for_each_pair(mesh, edges, representative, [&](Index a, Index b) {
        Index const i = unknown[a], j = unknown[b];
        if (i != none && j != none) {
            ++starts[i];
            ++starts[j];
        } else if (i != none) {
            couple(i, b);
        } else if (j != none) {
            couple(j, a);
        }
    });
    counts_to_starts(starts);
    for_each_pair(mesh, edges, representative, [&](Index a, Index b) {
        Index const i = unknown[a], j = unknown[b];
        if (i == none || j == none) return;
        neighbour[starts[i]++] = j;
        neighbour[starts[j]++] = i;
    });
    rewind_starts(starts);
}

Index Graph::first_floating(Mesh const& mesh, Edges const& edges, Span<const Index> representative,
                            Span<const PointKind> kinds, Span<Index> queue, Span<std::uint8_t> reached) const noexcept {
    fill(reached.first(n), std::uint8_t{0});
    Index filled = 0;
    auto const reach = [&](Index u) {
        if (u == none || reached[u] != 0) return;
        reached[u] = 1;
        queue[filled++] = u;
    };
    for_each_pair(mesh, edges, representative, [&](Index a, Index b) {
        if (!is_unknown(kinds[a])) reach(unknown[b]);
        if (!is_unknown(kinds[b])) reach(unknown[a]);
    });
    for (Index read = 0; read < filled; ++read) {
        for (Index const v : of(queue[read])) reach(v);
    }
    for (Index u = 0; u < n; ++u) {
        if (reached[u] == 0) return point[u];
    }
    return none;
}

}  // namespace harmorph
