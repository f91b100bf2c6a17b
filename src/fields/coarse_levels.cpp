#include "fields/coarse_levels.hpp"

#include "base/double_double.hpp"
#include "base/sort.hpp"

namespace harmorph {
namespace {

// Returns twice the area of the part of a cell that belongs to the control volume of corner k: the
// quadrilateral of the corner, the middles of the two sides beside it, and the mean of all corners.
DoubleDouble twice_corner_share(Cell const& cell, Index k, Points at) noexcept {
    Vec2 const here = at[cell.point[k]], next = at[cell.next(k)], previous = at[cell.previous(k)];
    DoubleDouble mean_x, mean_y;
    for (Index j = 0; j < cell.n; ++j) {
        Vec2 const corner = at[cell.point[j]];
        mean_x = mean_x + DoubleDouble::difference(corner.x, here.x);
        mean_y = mean_y + DoubleDouble::difference(corner.y, here.y);
    }
    DoubleDouble const across_x = DoubleDouble::difference(previous.x, next.x),
                       across_y = DoubleDouble::difference(previous.y, next.y);
    return (mean_x * across_y - mean_y * across_x) / static_cast<Real>(2 * cell.n);
}

}  // namespace

void CoarseLevels::lay_out(Arena& arena, Analysis const& of_analysis) noexcept {
    Index const n = of_analysis.problem().mesh.n_points;
    Index const edges = of_analysis.topology().edges.count();
    arena.take(volume, n);
    finest_.lay_out(arena, n, edges);
    agglomeration.lay_out(arena, n);
    Size const shared = arena.mark();
    agglomeration.lay_out_work(arena, n, edges);
    arena.release(shared);
    arena.take(work_.first, Offset{n} + 1);
    arena.take(work_.neighbour, 2 * Offset{edges});
    arena.take(work_.order, n);
    arena.take(work_.in_quad, n);
    arena.release(shared);
}

void CoarseLevels::build(Analysis const& of_analysis, Points at,
                         MergingRules const& rules) noexcept {
    analysis = &of_analysis;
    order_points();
    fill_rows(at);
    agglomeration.build(finest_, rules);
}

// Sets volume to the position of each point in the order of the front.
void CoarseLevels::order_points() noexcept {
    Topology const& topology = analysis->topology();
    Mesh const& mesh = topology.mesh;
    Span<const Index> const joined = topology.representative;
    fill(work_.first, Index{0});
    topology.edges.for_each([&](Index, Index a, Index b) {
        ++work_.first[joined[a]];
        ++work_.first[joined[b]];
    });
    counts_to_starts(work_.first);
    topology.edges.for_each([&](Index, Index a, Index b) {
        work_.neighbour[work_.first[joined[a]]++] = joined[b];
        work_.neighbour[work_.first[joined[b]]++] = joined[a];
    });
    rewind_starts(work_.first);
    fill(work_.in_quad, std::uint8_t{0});
    mesh.for_each_cell([&](Index, Cell const& cell) {
        for (Index k = 0; k < (cell.n == 4 ? 4 : 0); ++k) work_.in_quad[joined[cell.point[k]]] = 1;
    });
    fill(volume, none);
    Index filled = 0;
    for (Index pass = 0; pass < 3; ++pass) {
        auto const reach = [&](Index point) {
            if (volume[point] != none || (pass == 0 && work_.in_quad[point] == 0)) return;
            volume[point] = filled;
            work_.order[filled++] = point;
        };
        for (Index const point : analysis->boundary().point.first(analysis->boundary().count))
            reach(joined[point]);
        for (Index read = 0; read < filled; ++read) {
            Index const point = work_.order[read];
            for (Index k = work_.first[point]; k < work_.first[point + 1]; ++k)
                reach(work_.neighbour[k]);
        }
        if (pass < 2) continue;
        for (Index point = 0; point < mesh.n_points; ++point) {
            bool const is_used = work_.first[point] != work_.first[point + 1];
            if (is_used) reach(point);
        }
    }
    for (Index point = 0; point < mesh.n_points; ++point) volume[point] = volume[joined[point]];
    finest_.n = filled;
}

void CoarseLevels::fill_rows(Points at) noexcept {
    Topology const& topology = analysis->topology();
    Edges const& edges = topology.edges;
    SymmetricRows& rows = finest_;
    auto const barycentre = [&](Index code) {
        Cell const cell = topology.mesh.cell(cell_of_side(code));
        Vec2 sum;
        for (Index k = 0; k < cell.n; ++k) sum = sum + at[cell.point[k]];
        return (1.0 / cell.n) * sum;
    };
    fill(rows.start.first(rows.n + 1), Offset{0});
    edges.for_each([&](Index, Index a, Index b) { ++rows.start[min(volume[a], volume[b])]; });
    counts_to_starts(rows.start.first(rows.n + 1));
    fill(rows.row_sum, 0.0);
    fill(rows.diagonal, 0.0);
    edges.for_each([&](Index edge, Index a, Index b) {
        Vec2 const middle = 0.5 * (at[a] + at[b]);
        Real face = length(barycentre(edges.first[edge].code) - middle);
        if (!edges.is_boundary(edge)) face += length(barycentre(edges.second[edge]) - middle);
        Real const coupling = face / length(at[b] - at[a]);
        Index const i = min(volume[a], volume[b]), j = max(volume[a], volume[b]);
        Offset const entry = rows.start[i]++;
        rows.column[entry] = j;
        rows.value[entry] = -coupling;
        rows.faces[entry] = 1;
        rows.diagonal[i] += coupling;
        rows.diagonal[j] += coupling;
    });
    rewind_starts(rows.start.first(rows.n + 1));
}

Index CoarseLevels::volume_of(Index level, Index point) const noexcept {
    Index cell = volume[point];
    for (Index l = 0; l < level && cell != none; ++l) cell = agglomeration.cell_of[l][cell];
    return cell;
}

void CoarseLevels::cells(Index level, Span<Index> cell) const noexcept {
    for (Index point = 0; point < cell.count(); ++point) cell[point] = volume_of(level, point);
}

void CoarseLevels::areas(Index level, Points from, Points to, Span<Real> area) const noexcept {
    Topology const& topology = analysis->topology();
    fill(area, 0.0);
    for (Index i = 0; i < topology.mesh.n_cells; ++i) {
        Cell const cell = topology.cell(i);
        for (Index k = 0; k < cell.n; ++k) {
            DoubleDouble share = twice_corner_share(cell, k, to);
            if (from.given()) share = share - twice_corner_share(cell, k, from);
            area[volume_of(level, cell.point[k])] += 0.5 * share.rounded();
        }
    }
}

}  // namespace harmorph
