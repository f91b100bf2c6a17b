#include "ordering/vertex_cover.hpp"

namespace harmorph {

void BorderCover::lay_out(Arena& arena, Index max_unknowns) noexcept {
    arena.take(side, max_unknowns);
    arena.take(mate, max_unknowns);
    arena.take(from, max_unknowns);
}

// Matches one more left unknown by exchanging the partners along a path to a free right unknown. If
// there is no such path, later searches need not visit the unknowns that this search visited.
// Returns how many unknowns the search visited.
Offset BorderCover::search(Graph const& graph, Index root, Span<Index> queue) const noexcept {
    Index filled = 0;
    queue[filled++] = root;
    for (Index read = 0; read < filled; ++read) {
        Index const u = queue[read];
        for (Index const v : graph.neighbours(u)) {
            if (side[v] != Side::right) continue;
            side[v] = Side::reached;
            from[v] = u;
            if (mate[v] != none) {
                queue[filled++] = mate[v];
                continue;
            }
            for (Index end = v; end != none;) {
                Index const left = from[end], before = mate[left];
                mate[end] = left;
                mate[left] = end;
                end = left != root ? before : none;
            }
            for (Index const left : queue.first(filled)) side[mate[left]] = Side::right;
            return filled;
        }
    }
    for (Index const left : queue.first(filled)) side[left] = Side::kept;
    return filled;
}

void BorderCover::find(Graph const& graph, Span<const Index> near,
                       Span<Index> queue) const noexcept {
    // Searches may visit so many unknowns on average for each near unknown; nearly all visit one.
    constexpr Offset visits_each = 16;
    for (Index const u : near) mate[u] = none;
    Offset visits_left = visits_each * near.count();
    for (Index const u : near) {
        if (side[u] != Side::left) continue;
        if (visits_left > 0) {
            visits_left -= search(graph, u, queue);
            continue;
        }
        for (Index const v : graph.neighbours(u)) {
            if (side[v] == Side::right) mate[u] = v;
        }
    }
    for (Index const u : near) {
        bool const uncovered = side[u] == Side::left && mate[u] != none;
        if (uncovered || side[u] == Side::reached) side[u] = Side::separator;
        if (side[u] == Side::kept) side[u] = Side::left;
    }
}

}  // namespace harmorph
