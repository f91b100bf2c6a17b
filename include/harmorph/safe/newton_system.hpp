// A Newton step for an energy of a region's corners: gradient, convex Hessian in 2 x 2 blocks, conjugate gradients.
#pragma once

#include "harmorph/base/parallel_reduce.hpp"
#include "harmorph/safe/corner_map.hpp"
#include "harmorph/safe/region.hpp"

namespace harmorph {

struct Sum {
    Real value = 0;
    void merge(Sum const& later) noexcept { value += later.value; }
};

// Row by row, a b; c d.
struct Block {
    Real a = 0, b = 0, c = 0, d = 0;

    constexpr Vec2 operator*(Vec2 v) const noexcept { return {a * v.x + b * v.y, c * v.x + d * v.y}; }
    // + curvature u v^T
    constexpr void add(Real curvature, Vec2 u, Vec2 v) noexcept {
        a += curvature * u.x * v.x;
        b += curvature * u.x * v.y;
        c += curvature * u.y * v.x;
        d += curvature * u.y * v.y;
    }
};

// The unknowns are movements of points; of points that slide, along their lines.
struct NewtonSystem {
    // Relative residual at which a direction is good enough: the energy changes in the next step anyway.
    static constexpr Real enough = 0.2;

    Span<Block> hessian;     // rows as in region.neighbour, the diagonal block first; 0 across lines of sliding points
    Span<Block> inverse;     // [n] of the diagonal blocks
    Span<Vec2> gradient;     // [n]
    Span<Vec2> step;         // [n]
    Span<Vec2> rest, search, image;  // [n] of the conjugate gradients

    void lay_out(Arena& arena, RegionCounts const& counts) noexcept;
    // visit(cell, points, add) calls add(gradient, mode) for each term of the energy of a corner: its cell, the numbers
    // of its three points, and what CornerMap::differentiate gives; both are overwritten.
    template <class Visit>
    void assemble(Tangle const& tangle, Region const& region, Executor const& executor,
                  Visit const& visit) const noexcept;
    // step ~ -hessian^-1 gradient: a direction of descent. Returns the number of products.
    Index solve(Region const& region, Index most_products, Executor const& executor) const noexcept;
    // gradient . step
    Real slope(Region const& region, Executor const& executor) const noexcept;

private:
    static constexpr Index least_rows = 512;  // for a task of its own

    template <class Visit>
    void assemble_cells(Tangle const& tangle, Region const& region, Visit const& visit) const noexcept;
    template <class Visit>
    void assemble_row(Tangle const& tangle, Region const& region, Index u, Visit const& visit) const noexcept;
    void clear_row(Region const& region, Index u) const noexcept;
    void add_to_row(Region const& region, Index own, CornerPoints const& point, const Vec2 (&by)[3],
                    const CornerMode (&mode)[4]) const noexcept;
    void constrain_row(Tangle const& tangle, Region const& region, Index u) const noexcept;
};

// On one thread, cell after cell; on several, row by row, so that threads never meet: then a corner is looked at once
// for each of its three points. Cells are in order in both, so that each row is the same sum, bit by bit.
template <class Visit>
void NewtonSystem::assemble(Tangle const& tangle, Region const& region, Executor const& executor,
                            Visit const& visit) const noexcept {
    if (executor.is_serial()) return assemble_cells(tangle, region, visit);
    executor.for_ranges(region.n, least_rows, [&](Index begin, Index end) {
        for (Index u = begin; u < end; ++u) assemble_row(tangle, region, u, visit);
    });
}

// Derivatives by the points of a triangle with a turned side become those by its corner points.
inline void pull_back(Vec2 turn, Vec2 (&by)[3]) noexcept {
    if (turn.x == 1) return;
    Vec2 const by_start = product(turn, by[0]);
    by[1] = by[1] + by[0] - by_start;
    by[0] = by_start;
}

// Derivatives by three points of a corner become those by the unknowns that move these points.
inline void by_unknowns(Tangle const& tangle, CornerPoints const& point, Vec2 (&by)[3]) noexcept {
    pull_back(point.turn, by);
    for (Index k = 0; k < 3; ++k) by[k] = tangle.turned_to_unknown(point[k], by[k]);
}

template <class Visit>
void NewtonSystem::assemble_cells(Tangle const& tangle, Region const& region, Visit const& visit) const noexcept {
    for (Index u = 0; u < region.n; ++u) clear_row(region, u);
    for (Index const i : region.cell.first(region.n_cells)) {
        CellTriangles const corners(tangle, i);
        for (Index k = 0; k < corners.n; ++k) {
            CornerPoints const& point = corners.point[k];
            if (!region.can_move(point)) continue;
            visit(i, point, [&](Vec2(&by)[3], CornerMode(&mode)[4]) {
                by_unknowns(tangle, point, by);
                for (CornerMode& its : mode) by_unknowns(tangle, point, its.at);
                for (Index own = 0; own < 3; ++own) {
                    if (region.unknown[point[own]] != none) add_to_row(region, own, point, by, mode);
                }
            });
        }
    }
    for (Index u = 0; u < region.n; ++u) constrain_row(tangle, region, u);
}

template <class Visit>
void NewtonSystem::assemble_row(Tangle const& tangle, Region const& region, Index u,
                                Visit const& visit) const noexcept {
    clear_row(region, u);
    for (Index const i : region.cells_of(region.point[u])) {
        CellTriangles const corners(tangle, i);
        for (Index k = 0; k < corners.n; ++k) {
            CornerPoints const& point = corners.point[k];
            auto const is_row = [&](Index corner) { return region.unknown[point[corner]] == u; };
            if (!is_row(0) && !is_row(1) && !is_row(2)) continue;
            visit(i, point, [&](Vec2(&by)[3], CornerMode(&mode)[4]) {
                by_unknowns(tangle, point, by);
                for (CornerMode& its : mode) by_unknowns(tangle, point, its.at);
                for (Index own = 0; own < 3; ++own) {
                    if (is_row(own)) add_to_row(region, own, point, by, mode);
                }
            });
        }
    }
    constrain_row(tangle, region, u);
}

inline Triangle triangle_of(CornerPoints const& point, Points at) noexcept {
    return {{turned_start(at[point[0]], at[point[1]], point.turn), at[point[1]], at[point[2]]}};
}
// Pairs of numbers as points.
inline Points as_points(Span<const Vec2> at) noexcept { return {&at.data()->x, &at.data()->y, 2}; }

}  // namespace harmorph
