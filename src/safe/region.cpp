#include "safe/region.hpp"

#include "base/executor.hpp"
#include "base/sort.hpp"

namespace harmorph {
namespace {

// Calls visit(representative) once for each representative in a cell. In a periodic mesh that is
// one cell wide, two corners have the same representative.
template <class Visit>
void for_each_point(Tangle const& tangle, Cell const& cell, Visit visit) noexcept {
    for (Index k = 0; k < cell.n; ++k) {
        Index const own = tangle.representative[cell.point[k]];
        bool is_first = true;
        for (Index earlier = 0; earlier < k; ++earlier) {
            is_first = is_first && tangle.representative[cell.point[earlier]] != own;
        }
        if (is_first) visit(own);
    }
}

}  // namespace

void Region::lay_out(Arena& arena, RegionCounts const& counts) noexcept {
    Offset const n_points = counts.points;
    arena.take(unknown, n_points);
    arena.take(point, n_points);
    arena.take(cell, counts.cells);
    arena.take(start, n_points + 1);
    arena.take(outer_start, n_points);
    arena.take(neighbour, 2 * counts.pairs + n_points);
    arena.take(cell_start, n_points + 1);
    arena.take(cell_of, counts.cell_corners);
    arena.take(reached, n_points);
    arena.take(queue, n_points);
}

void Region::link(Tangle const& tangle) noexcept {
    fill(cell_start, Offset{0});
    for (Index i = 0; i < cell.count(); ++i) {
        for_each_point(tangle, tangle.cell(i), [&](Index corner) { ++cell_start[corner]; });
    }
    counts_to_starts(cell_start);
    for (Index i = 0; i < cell.count(); ++i) {
        for_each_point(tangle, tangle.cell(i),
                       [&](Index corner) { cell_of[cell_start[corner]++] = i; });
    }
    rewind_starts(cell_start);
}

void Region::grow(Tangle const& tangle, Index layers) noexcept {
    Index const n_reached = reach_points(tangle, layers);
    fill(unknown, none);
    n = 0;
    for (Index const mesh_point : queue.first(n_reached)) {
        if (tangle.held[mesh_point] != 0) continue;
        unknown[mesh_point] = n;
        point[n++] = mesh_point;
    }
    for (Index k = 0; k < unknown.count(); ++k) unknown[k] = unknown[tangle.representative[k]];
    list_cells(tangle);
    list_neighbours(tangle);
}

// Fills the queue with points layer by layer and returns the number of points.
Index Region::reach_points(Tangle const& tangle, Index layers) noexcept {
    Index filled = 0;
    if (layers >= whole) {
        for (Index k = 0; k < queue.count(); ++k) {
            if (!cells_of(k).empty()) queue[filled++] = k;
        }
        return filled;
    }
    fill(reached, std::uint8_t{0});
    auto const reach = [&](Index i) {
        for_each_point(tangle, tangle.cell(i), [&](Index corner) {
            if (reached[corner] != 0) return;
            reached[corner] = 1;
            queue[filled++] = corner;
        });
    };
    for (Index const i : cell.first(n_cells)) reach(i);
    Index read = 0;
    for (Index layer = 0; layer < layers; ++layer) {
        for (Index const end = filled; read < end; ++read) {
            for (Index const i : cells_of(queue[read])) reach(i);
        }
    }
    return filled;
}

// Lists the cells in the order of cells_of().
void Region::list_cells(Tangle const& tangle) noexcept {
    n_cells = 0;
    for (Index i = 0; i < cell.count(); ++i) {
        Cell const shape = tangle.cell(i);
        bool has_unknown = false;
        for (Index k = 0; k < shape.n; ++k)
            has_unknown = has_unknown || unknown[shape.point[k]] != none;
        if (has_unknown) cell[n_cells++] = i;
    }
}

void Region::list_neighbours(Tangle const& tangle) noexcept {
    Span<Index> const seen_by = queue.first(n);
    fill(seen_by, none);
    Offset filled = 0;
    for (Index range = 0; range < reduced_ranges; ++range) {
        Index const begin = range_start(n, range), end = range_start(n, range + 1);
        for (Index u = begin; u < end; ++u) {
            start[u] = filled;
            neighbour[filled++] = u;
            outer_start[u] = filled;
            seen_by[u] = u;
            for (Index const i : cells_of(point[u])) {
                Cell const shape = tangle.cell(i);
                for (Index k = 0; k < shape.n; ++k) {
                    Index const v = unknown[shape.point[k]];
                    if (v == none || seen_by[v] == u) continue;
                    seen_by[v] = u;
                    bool const is_inner = v >= begin && v < end;
                    if (is_inner && v < u) continue;
                    neighbour[filled] = v;
                    if (is_inner) {
                        neighbour[filled] = neighbour[outer_start[u]];
                        neighbour[outer_start[u]++] = v;
                    }
                    ++filled;
                }
            }
        }
    }
    start[n] = filled;
}

}  // namespace harmorph
