// A Newton step for an energy of a region's corners: the gradient, the convex Hessian in 2 x 2
// blocks, and conjugate gradients.
#pragma once

#include "base/executor.hpp"
#include "safe/cell_form.hpp"
#include "safe/corner_triangle.hpp"
#include "safe/region.hpp"

namespace harmorph {

struct Sum {
    Real value = 0;
    void merge(Sum const& later) noexcept { value += later.value; }
};

// The unknowns are the movements of points; slipping points move along their lines.
struct NewtonSystem {
    // A direction with this relative residual is good enough, because the energy changes in the
    // next step anyway.
    static constexpr Real enough = 0.2;

    // The rows are those of region.neighbour; blocks below the diagonal are not stored, because
    // those above represent them. Blocks are 0 across lines of slipping points.
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
                  Visit const& visit) const noexcept {
        assemble_lists(tangle, region, executor, [&] { return EachCorner<Visit>{visit}; });
    }
    // Does the same for corners that are computed in lists. The function make() returns an object
    // for one thread: after clear(), add(cell, points) adds corners of at most max_cells cells to
    // its list, differentiate() computes the derivatives of all, and next(cell, points, form) adds
    // those of the next corner to `form`, in the order of the list.
    template <class Make>
    void assemble_lists(Tangle const& tangle, Region const& region, Executor const& executor,
                        Make const& make) const noexcept;
    // Solves approximately for step = -hessian^-1 gradient, which is a direction of descent.
    // Returns the number of products.
    Index solve(Region const& region, Index max_products, Executor const& executor) const noexcept;
    // Computes to = hessian v in the rows begin .. end-1 of one range (see region.neighbour) and
    // returns v . to.
    Real multiply(Region const& region, Index begin, Index end, Span<const Vec2> v,
                  Span<Vec2> to) const noexcept;
    // Returns gradient . step.
    Real slope(Region const& region, Executor const& executor) const noexcept;

private:
    static constexpr Index min_rows = 512;  // a task has at least so many rows

    // Corners that are computed one by one.
    template <class Visit>
    struct EachCorner {
        static constexpr Index max_cells = 8;
        Visit const& visit;

        void clear() noexcept {}
        void add(Index, CornerPoints const&) noexcept {}
        void differentiate() noexcept {}
        void next(Index cell, CornerPoints const& points, CornerForm& form) noexcept {
            visit(cell, points, form);
        }
    };

    template <class IsWanted, class Corners>
    void add_cells(Tangle const& tangle, Region const& region, Span<const Index> cells,
                   IsWanted const& is_wanted, Corners& corners) const noexcept;
    template <Index n, class IsWanted, class Corners>
    void add_cell(Tangle const& tangle, Region const& region, Index i, IsWanted const& is_wanted,
                  Corners& corners) const noexcept;
    void clear_row(Region const& region, Index u) const noexcept;
    void constrain_row(Tangle const& tangle, Region const& region, Index u) const noexcept;
};

// Calls visit(before, own, after, points) for those corners of a cell, which has n points, for
// which is_wanted(unknown) holds at one of the three points.
template <Index n, class IsWanted, class Visit>
void for_wanted_corners(Tangle const& tangle, Region const& region, Index i,
                        IsWanted const& is_wanted, Visit const& visit) noexcept {
    Cell const cell = tangle.cell(i);
    Vec2 const turn = turn_of(tangle.mesh, i);
    bool wanted[n];
    for (Index k = 0; k < n; ++k) wanted[k] = is_wanted(region.unknown[cell.point[k]]);
    for (Index k = n == 3 ? 1 : 0; k < (n == 3 ? 2 : 4); ++k) {
        Index const before = k == 0 ? n - 1 : k - 1, after = k + 1 == n ? 0 : k + 1;
        if (!wanted[before] && !wanted[k] && !wanted[after]) continue;
        visit(before, k, after,
              CornerPoints{{cell.point[before], cell.point[k], cell.point[after]}, turn});
    }
}

// On one thread, the sum goes cell by cell. On several threads it goes row by row, so that threads
// never write to the same row; then each corner is computed once for each of its three points.
// Cells are in the same order in both cases, so that each row is the same sum, bit by bit.
template <class Make>
void NewtonSystem::assemble_lists(Tangle const& tangle, Region const& region,
                                  Executor const& executor, Make const& make) const noexcept {
    if (executor.is_serial()) {
        auto corners = make();
        for (Index u = 0; u < region.n; ++u) clear_row(region, u);
        add_cells(
            tangle, region, region.cell.first(region.n_cells), [](Index u) { return u != none; },
            corners);
        for (Index u = 0; u < region.n; ++u) constrain_row(tangle, region, u);
        return;
    }
    executor.for_ranges(region.n, min_rows, [&](Index begin, Index end) {
        auto corners = make();
        for (Index u = begin; u < end; ++u) {
            clear_row(region, u);
            add_cells(
                tangle, region, region.cells_of(region.point[u]), [u](Index v) { return v == u; },
                corners);
            constrain_row(tangle, region, u);
        }
    });
}

template <class IsWanted, class Corners>
void NewtonSystem::add_cells(Tangle const& tangle, Region const& region, Span<const Index> cells,
                             IsWanted const& is_wanted, Corners& corners) const noexcept {
    for (Index begin = 0; begin < cells.count(); begin += Corners::max_cells) {
        Span<const Index> const part =
            cells.from(begin, static_cast<Size>(min(Corners::max_cells, cells.count() - begin)));
        corners.clear();
        for (Index const i : part) {
            auto const list = [&](Index, Index, Index, CornerPoints const& point) {
                corners.add(i, point);
            };
            if (tangle.mesh.cell(i).n == 3)
                for_wanted_corners<3>(tangle, region, i, is_wanted, list);
            else for_wanted_corners<4>(tangle, region, i, is_wanted, list);
        }
        corners.differentiate();
        for (Index const i : part) {
            if (tangle.mesh.cell(i).n == 3) add_cell<3>(tangle, region, i, is_wanted, corners);
            else add_cell<4>(tangle, region, i, is_wanted, corners);
        }
    }
}

// Adds to those rows for which is_wanted(row) holds. A corner contributes to the rows of its three
// points only.
template <Index n, class IsWanted, class Corners>
void NewtonSystem::add_cell(Tangle const& tangle, Region const& region, Index i,
                            IsWanted const& is_wanted, Corners& corners) const noexcept {
    Cell const cell = tangle.cell(i);
    CellForm<n> sum;
    for_wanted_corners<n>(tangle, region, i, is_wanted,
                          [&](Index before, Index own, Index after, CornerPoints const& point) {
                              CornerForm corner;
                              corners.next(i, point, corner);
                              corner.turn_back_side(point.turn);
                              sum.add(before, own, after, corner);
                          });
    if (!tangle.turn.empty()) sum.turn_back(tangle.turn, cell);
    for (Index own = 0; own < n; ++own) {
        Index const u = region.unknown[cell.point[own]];
        if (!is_wanted(u)) continue;
        Span<const Index> const neighbours = region.of(u);
        Span<Block> const row = hessian.from(region.start[u], neighbours.size());
        gradient[u] = gradient[u] + sum.by[own];
        for (Index other = 0; other < n; ++other) {
            Index const v = region.unknown[cell.point[other]];
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
