#include "ordering/graph.hpp"

#include "base/sort.hpp"

namespace harmorph {

namespace {

// Calls visit(unknown or none, line, unknown or none, line) for every two lines of two points that
// share a cell.
template <Index components, class Visit>
void for_each_two_lines(Topology const& topology, Span<const Index> unknown, Visit visit) noexcept {
    auto const visit_lines = [&](Index a, Index b) {
        // The two are one point, or both are known.
        if (unknown[components * a] == unknown[components * b]) return;
        for (Index p = components * a; p < components * (a + 1); ++p) {
            for (Index q = components * b; q < components * (b + 1); ++q)
                visit(unknown[p], p, unknown[q], q);
        }
    };
    topology.edges.for_each([&](Index, Index low, Index high) { visit_lines(low, high); });
    topology.mesh.for_each_cell([&](Index, Cell const& cell) {
        if (cell.n != 4) return;
        visit_lines(cell.point[0], cell.point[2]);
        visit_lines(cell.point[1], cell.point[3]);
    });
}

}  // namespace

void Graph::lay_out(Arena& arena, Mesh const& mesh, Index n_components) noexcept {
    components = n_components;
    Size const lines = static_cast<Size>(components) * static_cast<Size>(mesh.n_points);
    Size const diagonals = 2 * static_cast<Size>(mesh.n_cells);
    Size const pairs = static_cast<Size>(components * components) * (mesh.max_sides() + diagonals);
    arena.take(line, lines);
    arena.take(unknown, lines);
    arena.take(start, lines + 1);
    arena.take(neighbour, 2 * pairs);
    arena.take(beside_curve, lines);
}

void Graph::build(Topology const& topology, Span<const PointKind> kinds) noexcept {
    if (components == 1) {
        connect<1>(topology, kinds);
    } else {
        connect<2>(topology, kinds);
    }
}

template <Index n_components>
void Graph::connect(Topology const& topology, Span<const PointKind> kinds) noexcept {
    Mesh const& mesh = topology.mesh;
    Span<const Index> const representative = topology.representative;
    n = 0;
    for (Index k = 0; k < mesh.n_points; ++k) {
        for (Index c = 0; c < n_components; ++c) {
            bool const has_unknown =
                is_unknown(kinds[k]) && (c == 0 || kinds[k] != PointKind::slip);
            unknown[n_components * k + c] = has_unknown ? n : none;
            if (has_unknown) line[n++] = n_components * k + c;
        }
    }
    for (Index k = 0; k < mesh.n_points; ++k) {
        for (Index c = 0; c < n_components; ++c) {
            unknown[n_components * k + c] = unknown[n_components * representative[k] + c];
        }
    }
    Span<Offset> const starts = start.first(n + 1);
    fill(starts, Offset{0});
    fill(beside_curve, std::uint8_t{0});
    couplings = fixed = 0;
    Size known_begin = neighbour.size();  // Every pair has two places.
    auto const couple = [&](Index u, Index wall_line) {
        Index const point = representative[wall_line / n_components];
        Index const other = n_components * point + wall_line % n_components;
        bool const on_wall = kinds[point] == PointKind::on_wall;
        if (on_wall) beside_curve[u] = 1;
        ++(on_wall ? couplings : fixed);
        neighbour[--known_begin] = other;
        neighbour[--known_begin] = u;
    };
    for_each_two_lines<n_components>(topology, unknown, [&](Index i, Index p, Index j, Index q) {
        if (i != none && j != none) {
            ++starts[i];
            ++starts[j];
        } else if (i != none) {
            couple(i, q);
        } else if (j != none) {
            couple(j, p);
        }
    });
    counts_to_starts(starts);
    for_each_two_lines<n_components>(topology, unknown, [&](Index i, Index, Index j, Index) {
        if (i == none || j == none) return;
        neighbour[starts[i]++] = j;
        neighbour[starts[j]++] = i;
    });
    rewind_starts(starts);
}

Index Graph::first_floating(Topology const& topology, Span<const PointKind> kinds,
                            Span<Index> queue, Span<std::uint8_t> reached) const noexcept {
    fill(reached.first(n), std::uint8_t{0});
    Index filled = 0;
    auto const reach = [&](Index u) {
        if (u == none || reached[u] != 0) return;
        reached[u] = 1;
        queue[filled++] = u;
    };
    auto const reach_lines = [&](Index known, Index other) {
        if (is_unknown(kinds[known])) return;
        for (Index c = 0; c < components; ++c) reach(unknown[components * other + c]);
    };
    for_each_pair(topology, [&](Index a, Index b) {
        reach_lines(a, b);
        reach_lines(b, a);
    });
    for (Index read = 0; read < filled; ++read) {
        for (Index const v : neighbours(queue[read])) reach(v);
    }
    for (Index u = 0; u < n; ++u) {
        if (reached[u] == 0) return point(u);
    }
    return none;
}

void LayerWork::lay_out(Arena& arena, Index max_unknowns) noexcept {
    arena.take(in_quad, max_unknowns);
    arena.take(reached, max_unknowns);
}

void order_by_layers(Topology const& topology, Span<const PointKind> kinds, Graph const& graph,
                     LayerWork const& work, Span<Index> order) noexcept {
    Mesh const& mesh = topology.mesh;
    auto const for_unknowns = [&](Index point, auto const& body) {
        for (Index c = 0; c < graph.components; ++c) {
            Index const u = graph.unknown[graph.components * point + c];
            if (u != none) body(u);
        }
    };
    fill(work.in_quad.first(graph.n), std::uint8_t{0});
    fill(work.reached.first(graph.n), std::uint8_t{0});
    for (Index i = 0; i < mesh.n_cells; ++i) {
        Cell const cell = mesh.cell(i);
        for (Index k = 0; k < (cell.n == 4 ? 4 : 0); ++k) {
            Index const point = topology.representative[cell.point[k]];
            for_unknowns(point, [&](Index u) { work.in_quad[u] = 1; });
        }
    }
    Index filled = 0;
    for (Index pass = 0; pass < 2; ++pass) {
        bool const quads_only = pass == 0;
        auto const reach = [&](Index u) {
            if (work.reached[u] != 0 || (quads_only && work.in_quad[u] == 0)) return;
            work.reached[u] = 1;
            order[filled++] = u;
        };
        for_each_pair(topology, [&](Index a, Index b) {
            if (!is_unknown(kinds[a])) for_unknowns(b, reach);
            if (!is_unknown(kinds[b])) for_unknowns(a, reach);
        });
        for (Index u = 0; u < graph.n; ++u) {
            if (kinds[graph.point(u)] == PointKind::free) reach(u);
        }
        for (Index read = 0; read < filled; ++read) {
            for (Index const v : graph.neighbours(order[read])) reach(v);
        }
    }
    for (Index u = 0; u < graph.n; ++u) {
        // An unknown that is not reached lies in a region without boundary; check_regions() refuses
        // such meshes.
        if (work.reached[u] == 0) order[filled++] = u;
    }
}

}  // namespace harmorph
