// A Newton step for an energy of a region's corners: the gradient, the convex Hessian in 2 x 2
// blocks, and conjugate gradients.
#pragma once

#include "base/executor.hpp"
#include "safe/corner_map.hpp"
#include "safe/region.hpp"

#include <type_traits>

namespace harmorph {

// Finds the positions of the three points of a corner.

inline Triangle triangle_of(CornerPoints const& point, Points at) noexcept {
    return {
        {rotated_start(at[point[0]], at[point[1]], point.rotation), at[point[1]], at[point[2]]}};
}

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
    Span<Vec2> border;               // [n] the sum of CellForm::curvature times the derivatives
    Span<Vec2> step;                 // [n]
    Span<Vec2> rest, search, image;  // [n] vectors of the conjugate gradients

    void lay_out(Arena& arena, RegionCounts const& counts) noexcept;
    // The function visit(cell, form) computes the derivatives of the energy of a cell or guard with
    // an unknown point: form is a CellForm<3> or a CellForm<4>. Cells are in the same order for any
    // number of threads, so that each row is the same sum, bit by bit.
    template <class Visit>
    void assemble_cells(Tangle const& tangle, Region const& region, Executor const& executor,
                        Visit const& visit) const noexcept;
    // The function visit(cell, points, form) adds the derivatives of the energy of a corner to
    // `form`: `cell` is the cell of the corner, and `points` are the numbers of its three points.
    template <class Visit>
    void assemble(Tangle const& tangle, Region const& region, Executor const& executor,
                  Visit const& visit) const noexcept;
    // Adds to the gradient and to the diagonal block of an unknown. For a point that slips, both
    // are those along its line.
    void add(Region const& region, Index u, Vec2 slope, Block const& curvature) const noexcept;
    // Solves approximately for to = hessian^-1 right by conjugate gradients. Returns the number of
    // products.
    Index solve(Region const& region, Span<const Vec2> right, Span<Vec2> to, Index max_products,
                Real relative_residual, Executor const& executor) const noexcept;
    // Solves approximately for step = -hessian^-1 gradient, which is a direction of descent.
    Index solve(Region const& region, Index max_products, Executor const& executor) const noexcept;
    // Computes to = hessian v in the rows begin .. end-1 of one range (see region.neighbour) and
    // returns v . to.
    Real multiply(Region const& region, Index begin, Index end, Span<const Vec2> v,
                  Span<Vec2> to) const noexcept;
    // Returns gradient . step.
    Real slope(Region const& region, Executor const& executor) const noexcept;

private:
    static constexpr Index min_rows = 512;  // a task has at least so many rows

    template <Index n, class Visit>
    void add_cell(Tangle const& tangle, Region const& region, Index i, Index begin, Index end,
                  Visit const& visit) const noexcept;
    void clear_row(Region const& region, Index u) const noexcept;
    void constrain_row(Tangle const& tangle, Region const& region, Index u) const noexcept;
};

// Each thread takes a range of rows, to which no other thread writes, and the cells with points of
// this range.
template <class Visit>
void NewtonSystem::assemble_cells(Tangle const& tangle, Region const& region,
                                  Executor const& executor, Visit const& visit) const noexcept {
    Index const n_ranges =
        executor.is_serial() ? 1 : clamp(region.n / min_rows, Index{1}, executor.n_threads);
    executor.for_each(n_ranges, [&](Index range) {
        Index const begin = static_cast<Index>(Offset{region.n} * range / n_ranges),
                    end = static_cast<Index>(Offset{region.n} * (range + 1) / n_ranges);
        for (Index u = begin; u < end; ++u) clear_row(region, u);
        for (Index const i : region.cell.first(region.n_cells)) {
            if (tangle.mesh.cell(i).n == 3) add_cell<3>(tangle, region, i, begin, end, visit);
            else add_cell<4>(tangle, region, i, begin, end, visit);
        }
        for (Index u = begin; u < end; ++u) constrain_row(tangle, region, u);
    });
}

template <class Visit>
void NewtonSystem::assemble(Tangle const& tangle, Region const& region, Executor const& executor,
                            Visit const& visit) const noexcept {
    assemble_cells(tangle, region, executor, [&](Index i, auto& form) {
        constexpr Index n = std::remove_reference_t<decltype(form)>::count;
        CellTriangles const corners(tangle, i);
        for (Index k = 0; k < corners.n; ++k) {
            CornerPoints const& point = corners.point[k];
            if (!region.can_move(point)) continue;
            Index const own = n == 3 ? 1 : k;
            CornerForm corner;
            visit(i, point, corner);
            corner.rotate_side_back(point.rotation);
            form.add(own == 0 ? n - 1 : own - 1, own, own + 1 == n ? 0 : own + 1, corner);
        }
    });
}

// Adds to the rows begin .. end-1.
template <Index n, class Visit>
void NewtonSystem::add_cell(Tangle const& tangle, Region const& region, Index i, Index begin,
                            Index end, Visit const& visit) const noexcept {
    Cell const cell = tangle.cell(i);
    Index row[n];
    bool any = false;
    for (Index k = 0; k < n; ++k) {
        row[k] = region.unknown[cell.point[k]];
        any = any || (row[k] != none && row[k] >= begin && row[k] < end);
    }
    if (!any) return;
    CellForm<n> sum;
    visit(i, sum);
    if (!tangle.rotation.empty()) sum.rotate_back(tangle.rotation, cell);
    for (Index own = 0; own < n; ++own) {
        Index const u = row[own];
        if (u == none || u < begin || u >= end) continue;
        Span<const Index> const neighbours = region.of(u);
        Span<Block> const entries = hessian.from(region.start[u], neighbours.size());
        gradient[u] = gradient[u] + sum.slope * sum.by[own];
        border[u] = border[u] + sum.curvature * sum.by[own];
        for (Index other = 0; other < n; ++other) {
            if (row[other] == none) continue;
            Size entry = 0;
            while (entry < neighbours.size() && neighbours[entry] != row[other])
                ++entry;  // blocks below the diagonal are not stored
            if (entry < neighbours.size())
                entries[entry] = entries[entry] + sum.hessian[own][other];
        }
    }
}

// Returns pairs of numbers as points.
inline Points as_points(Span<const Vec2> at) noexcept { return {&at.data()->x, &at.data()->y, 2}; }

}  // namespace harmorph
