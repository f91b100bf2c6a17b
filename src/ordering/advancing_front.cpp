#include "ordering/advancing_front.hpp"

namespace harmorph {

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
