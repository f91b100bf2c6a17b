#include "harmorph/matrix.hpp"

#include "harmorph/sort.hpp"

namespace harmorph {
namespace {

void sort_row(Span<Index> row) noexcept {
    if (row.size() > 24) return sort(row, [](Index a, Index b) { return a < b; });
    for (Size i = 1; i < row.size(); ++i) {
        Index const column = row[i];
        Size k = i;
        for (; k > 0 && row[k - 1] > column; --k) row[k] = row[k - 1];
        row[k] = column;
    }
}

// Rows are short: a handful of entries, but for hubs of fans.
template <class I>
I find_in_row(Span<const Index> columns, I begin, I end, Index column) noexcept {
    while (end - begin > 16) {
        I const middle = begin + (end - begin) / 2;
        (columns[middle] <= column ? begin : end) = middle;
    }
    while (columns[begin] != column) ++begin;
    return begin;
}

// visit(wall slot, unknown) for every pair of a wall point and an unknown that share a cell.
template <class Visit>
void for_each_coupling(Mesh const& mesh, Edges const& edges, Span<const Index> representative, Graph const& graph,
                       Span<const Index> slot, Visit visit) noexcept {
    for_each_pair(mesh, edges, representative, [&](Index a, Index b) {
        if (slot[a] != none && graph.unknown[b] != none) visit(slot[a], graph.unknown[b]);
        if (slot[b] != none && graph.unknown[a] != none) visit(slot[b], graph.unknown[a]);
    });
}

}  // namespace

void Matrix::lay_out(Arena& arena, Index n_points, Index unknowns, Index wall_points, Sizes const& sizes) noexcept {
    n = unknowns;
    arena.take(place, n_points);
    arena.take(diagonal, n);
    arena.take(start, Offset{n} + 1);
    arena.take(column, sizes.entries);
    arena.take(value, sizes.entries);
    arena.take(coupling_start, Offset{wall_points} + 1);
    arena.take(coupling_row, sizes.couplings);
    arena.take(coupling_value, sizes.couplings);
}

void Matrix::build(Mesh const& mesh, Edges const& edges, Span<const Index> representative, Graph const& graph,
                   Span<const Index> order, Span<const Index> position, Span<const Index> slot) noexcept {
    for (Index point = 0; point < mesh.n_points; ++point) {
        Index const its = representative[point];
        Index const unknown = graph.unknown[its];
        place[point] = unknown != none ? position[unknown] : slot[its] != none ? wall(slot[its]) : none;
    }
    Offset filled = 0;
    for (Index row = 0; row < n; ++row) {
        start[row] = filled;
        for (Index const neighbour : graph.of(order[row])) {
            if (position[neighbour] > row) column[filled++] = position[neighbour];
        }
        sort_row(column.from(start[row], filled - start[row]));
    }
    start[n] = filled;

    fill(coupling_start, Index{0});
    for_each_coupling(mesh, edges, representative, graph, slot, [&](Index s, Index) { ++coupling_start[s]; });
    counts_to_starts(coupling_start);
    for_each_coupling(mesh, edges, representative, graph, slot,
                      [&](Index s, Index unknown) { coupling_row[coupling_start[s]++] = position[unknown]; });
    rewind_starts(coupling_start);
    for (Index s = 0; s + 1 < coupling_start.count(); ++s) {
        sort_row(coupling_row.from(coupling_start[s], coupling_start[s + 1] - coupling_start[s]));
    }
}

void Matrix::clear() const noexcept {
    fill(diagonal, 0.0);
    fill(value, 0.0);
    fill(coupling_value, 0.0);
}

void Matrix::add(Index point, Index other, Real conductance) const noexcept {
    Index const i = place[point], j = place[other];
    if (i >= 0) diagonal[i] += conductance;
    if (j >= 0) diagonal[j] += conductance;
    if (i >= 0 && j >= 0) {
        Index const row = smaller(i, j);
        value[find_in_row<Offset>(column, start[row], start[row + 1], larger(i, j))] -= conductance;
    } else if (i >= 0 && is_wall(j)) {
        Index const s = wall(j);
        coupling_value[find_in_row<Index>(coupling_row, coupling_start[s], coupling_start[s + 1], i)] -= conductance;
    } else if (j >= 0 && is_wall(i)) {
        Index const s = wall(i);
        coupling_value[find_in_row<Index>(coupling_row, coupling_start[s], coupling_start[s + 1], j)] -= conductance;
    }
}

SymmetricRows Matrix::rows(Edges const& edges, Span<std::uint8_t> faces) const noexcept {
    fill(faces, std::uint8_t{0});
    edges.for_each([&](Index, Index low, Index high) {
        Index const i = place[low], j = place[high];
        if (i < 0 || j < 0) return;
        Index const row = smaller(i, j);
        faces[find_in_row<Offset>(column, start[row], start[row + 1], larger(i, j))] = 1;
    });
    return {n, diagonal, start, column, value, faces};
}

}  // namespace harmorph
