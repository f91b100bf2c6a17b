// A Newton step for an energy of a region's corners: the gradient, the convex Hessian in 2 x 2
// blocks, and conjugate gradients.
#pragma once

#include "base/parallel_reduce.hpp"
#include "safe/cell_form.hpp"
#include "safe/corner_triangle.hpp"
#include "safe/region.hpp"

namespace harmorph {

struct Sum {
    Real value = 0;
    void merge(Sum const& later) noexcept { value += later.value; }
};

// The unknowns are the movements of points; sliding points move along their lines.
struct NewtonSystem {
    // A direction with this relative residual is good enough, because the energy changes in the
    // next step anyway.
    static constexpr Real enough = 0.2;

    // The rows are those of region.neighbour; blocks below the diagonal are not stored, because
    // those above represent them. Blocks are 0 across lines of sliding points.
    Span<Block> hessian;
    Span<Block> inverse;             // [n] the inverses of the diagonal blocks
    Span<Vec2> gradient;             // [n]
    Span<Vec2> step;                 // [n]
    Span<Vec2> rest, search, image;  // [n] vectors of the conjugate gradients

    void lay_out(Arena& arena, RegionCounts const& counts) noexcept;
    // The function visit(cell, points, form) adds the derivatives of the energy of a corner to
    // `form`: `cell` is the cell of the corner, and `points` are the numbers of its three points.
    template <class Visit>
    void assemble(Tangle const& tangle, Region const& region, Executor const& executor,
                  Visit const& visit) const noexcept;
    // Solves approximately for step = -hessian^-1 gradient, which is a direction of descent.
    // Returns the number of products.
    Index solve(Region const& region, Index most_products, Executor const& executor) const noexcept;
    // Computes to = hessian v in the rows begin .. end-1 of one range (see region.neighbour) and
    // returns v . to.
    Real multiply(Region const& region, Index begin, Index end, Span<const Vec2> v,
                  Span<Vec2> to) const noexcept;
    // Returns gradient . step.
    Real slope(Region const& region, Executor const& executor) const noexcept;

private:
    static constexpr Index least_rows = 512;  // a task has at least so many rows

    template <class Visit>
    void assemble_cells(Tangle const& tangle, Region const& region,
                        Visit const& visit) const noexcept;
    template <class Visit>
    void assemble_row(Tangle const& tangle, Region const& region, Index u,
                      Visit const& visit) const noexcept;
    template <class IsWanted, class Visit>
    void add_cell(Tangle const& tangle, Region const& region, Index i, IsWanted const& is_wanted,
                  Visit const& visit) const noexcept {
        if (tangle.mesh.cell(i).n == 3) add_cell_of<3>(tangle, region, i, is_wanted, visit);
        else add_cell_of<4>(tangle, region, i, is_wanted, visit);
    }
    template <Index n, class IsWanted, class Visit>
    void add_cell_of(Tangle const& tangle, Region const& region, Index i, IsWanted const& is_wanted,
                     Visit const& visit) const noexcept;
    void clear_row(Region const& region, Index u) const noexcept;
    void constrain_row(Tangle const& tangle, Region const& region, Index u) const noexcept;
};

// On one thread, the sum goes cell by cell. On several threads it goes row by row, so that threads
// never write to the same row; then each corner is computed once for each of its three points.
// Cells are in the same order in both cases, so that each row is the same sum, bit by bit.
template <class Visit>
void NewtonSystem::assemble(Tangle const& tangle, Region const& region, Executor const& executor,
                            Visit const& visit) const noexcept {
    if (executor.is_serial()) return assemble_cells(tangle, region, visit);
    executor.for_ranges(region.n, least_rows, [&](Index begin, Index end) {
        for (Index u = begin; u < end; ++u) assemble_row(tangle, region, u, visit);
    });
}

template <class Visit>
void NewtonSystem::assemble_cells(Tangle const& tangle, Region const& region,
                                  Visit const& visit) const noexcept {
    auto const is_unknown = [](Index u) { return u != none; };
    for (Index u = 0; u < region.n; ++u) clear_row(region, u);
    for (Index const i : region.cell.first(region.n_cells))
        add_cell(tangle, region, i, is_unknown, visit);
    for (Index u = 0; u < region.n; ++u) constrain_row(tangle, region, u);
}

template <class Visit>
void NewtonSystem::assemble_row(Tangle const& tangle, Region const& region, Index u,
                                Visit const& visit) const noexcept {
    auto const is_row = [u](Index v) { return v == u; };
    clear_row(region, u);
    for (Index const i : region.cells_of(region.point[u]))
        add_cell(tangle, region, i, is_row, visit);
    constrain_row(tangle, region, u);
}

// Adds to those rows for which is_wanted(row) holds. A corner contributes to the rows of its three
// points only.
template <Index n, class IsWanted, class Visit>
void NewtonSystem::add_cell_of(Tangle const& tangle, Region const& region, Index i,
                               IsWanted const& is_wanted, Visit const& visit) const noexcept {
    Cell const cell = tangle.cell(i);
    Vec2 const turn = turn_of(tangle.mesh, i);
    Index unknown[n];
    bool wanted[n];
    for (Index k = 0; k < n; ++k) {
        unknown[k] = region.unknown[cell.point[k]];
        wanted[k] = is_wanted(unknown[k]);
    }
    CellForm<n> sum;
    for (Index k = n == 3 ? 1 : 0; k < (n == 3 ? 2 : 4); ++k) {
        Index const before = k == 0 ? n - 1 : k - 1, after = k + 1 == n ? 0 : k + 1;
        if (!wanted[before] && !wanted[k] && !wanted[after]) continue;
        CornerForm corner;
        CornerPoints const point{{cell.point[before], cell.point[k], cell.point[after]}, turn};
        visit(i, point, corner);
        corner.turn_back_side(turn);
        sum.add(before, k, after, corner);
    }
    if (!tangle.turn.empty()) sum.turn_back(tangle.turn, cell);
    for (Index own = 0; own < n; ++own) {
        Index const u = unknown[own];
        if (!wanted[own]) continue;
        Span<const Index> const neighbours = region.of(u);
        Span<Block> const row = hessian.from(region.start[u], neighbours.size());
        gradient[u] = gradient[u] + sum.by[own];
        for (Index other = 0; other < n; ++other) {
            Index const v = unknown[other];
            if (v == none) continue;
            Size entry = 0;
            while (entry < neighbours.size() && neighbours[entry] != v)
                ++entry;  // blocks below the diagonal are not stored
            if (entry < neighbours.size()) row[entry] = row[entry] + sum.hessian[own][other];
        }
    }
}

// Returns pairs of numbers as points.
inline Points as_points(Span<const Vec2> at) noexcept { return {&at.data()->x, &at.data()->y, 2}; }

}  // namespace harmorph
