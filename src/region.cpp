#include "harmorph/region.hpp"

#include "harmorph/sort.hpp"

namespace harmorph {

RegionCounts RegionCounts::of(Mesh const& mesh, Edges const& edges) noexcept {
    RegionCounts counts;
    counts.points = mesh.n_points;
    counts.cells = mesh.n_cells;
    counts.pairs = edges.count();
    for (Index i = 0; i < mesh.n_cells; ++i) {
        Index const n = mesh.cell(i).n;
        counts.cell_corners += n;
        if (n == 4) counts.pairs += 2;  // the diagonals
    }
    return counts;
}

void Region::lay_out(Arena& arena, RegionCounts const& counts) noexcept {
    Offset const n_points = counts.points;
    arena.take(layer, n_points);
    arena.take(unknown, n_points);
    arena.take(point, n_points);
    arena.take(cell, counts.cells);
    arena.take(cell_start, n_points + 1);
    arena.take(cell_of, counts.cell_corners);
    arena.take(start, n_points + 1);
    arena.take(neighbour, 2 * counts.pairs + n_points);
    arena.take(seen, n_points);
}

void Region::grow(Tangle const& tangle, Points points, Index layers) noexcept {
    mark_layers(tangle, points, layers);
    list_unknowns(tangle);
    list_cells(tangle);
    list_neighbours(tangle);
}

void Region::mark_layers(Tangle const& tangle, Points points, Index layers) noexcept {
    bool const all = layers >= whole;
    fill(layer, std::uint8_t{0});
    Index const n_cells_of_mesh = tangle.mesh.n_cells;
    for (Index i = 0; i < n_cells_of_mesh; ++i) {
        Cell const its = tangle.cell(i);
        if (!all && CellCorners(CellShape(its, points, false)).smallest() > 0) continue;
        for (Index k = 0; k < its.n; ++k) layer[its.point[k]] = 1;
    }
    if (all) return;
    for (Index passed = 1; passed <= layers; ++passed) {
        for (Index i = 0; i < n_cells_of_mesh; ++i) {
            Cell const its = tangle.cell(i);
            bool reached = false;
            for (Index k = 0; k < its.n; ++k) {
                Index const its_layer = layer[its.point[k]];
                reached = reached || (its_layer != 0 && its_layer <= passed);
            }
            if (!reached) continue;
            for (Index k = 0; k < its.n; ++k) {
                if (layer[its.point[k]] == 0) layer[its.point[k]] = static_cast<std::uint8_t>(passed + 1);
            }
        }
    }
}

void Region::list_unknowns(Tangle const& tangle) noexcept {
    n = 0;
    for (Index k = 0; k < unknown.count(); ++k) {
        bool const is = layer[k] != 0 && tangle.held[k] == 0;
        unknown[k] = is ? n : none;
        if (is) point[n++] = k;
    }
}

void Region::list_cells(Tangle const& tangle) noexcept {
    n_cells = 0;
    Span<Offset> const starts = cell_start.first(n + 1);
    fill(starts, Offset{0});
    for (Index i = 0; i < tangle.mesh.n_cells; ++i) {
        Cell const its = tangle.cell(i);
        bool active = false;
        for (Index k = 0; k < its.n; ++k) {
            Index const u = unknown[its.point[k]];
            if (u == none) continue;
            ++starts[u];
            active = true;
        }
        if (active) cell[n_cells++] = i;
    }
    counts_to_starts(starts);
    for (Index const i : cell.first(n_cells)) {
        Cell const its = tangle.cell(i);
        for (Index k = 0; k < its.n; ++k) {
            Index const u = unknown[its.point[k]];
            if (u != none) cell_of[starts[u]++] = i;
        }
    }
    rewind_starts(starts);
}

void Region::list_neighbours(Tangle const& tangle) noexcept {
    fill(seen.first(n), none);
    Offset filled = 0;
    for (Index u = 0; u < n; ++u) {
        start[u] = filled;
        neighbour[filled++] = u;
        seen[u] = u;
        for (Index const i : cells_of(u)) {
            Cell const its = tangle.cell(i);
            for (Index k = 0; k < its.n; ++k) {
                Index const v = unknown[its.point[k]];
                if (v == none || seen[v] == u) continue;
                seen[v] = u;
                neighbour[filled++] = v;
            }
        }
    }
    start[n] = filled;
}

}  // namespace harmorph
