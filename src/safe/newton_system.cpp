#include "harmorph/safe/newton_system.hpp"

namespace harmorph {
namespace {

constexpr Index least_rows = 512;  // for a task of its own
// Flat directions get this part of the curvature of |J|^2 / chi, so that steps stay bounded.
constexpr Real least_curvature = 0.1;

// Entries have the size of 1 / length^2: their products are formed of parts of the size of 1.
Block inverse_of(Block const& block) noexcept {
    Real const unit = 1 / power_of_two_at(block.a + block.d);
    Real const a = unit * block.a, b = unit * block.b, c = unit * block.c, d = unit * block.d;
    Real const scale = unit / (a * d - b * c);
    return {scale * d, -scale * b, -scale * c, scale * a};
}

Real inner_product(Index n, Span<const Vec2> a, Span<const Vec2> b, Executor const& executor) noexcept {
    return reduce_cells<Sum>(n, executor, [&](Index u, Sum& sum) { sum.value += dot(a[u], b[u]); }).value;
}

}  // namespace

void NewtonSystem::lay_out(Arena& arena, RegionCounts const& counts) noexcept {
    Offset const n = counts.points;
    arena.take(hessian, 2 * counts.pairs + n);
    arena.take(inverse, n);
    arena.take(gradient, n);
    arena.take(step, n);
    arena.take(rest, n);
    arena.take(search, n);
    arena.take(image, n);
}

// Each row by itself, so that threads never meet: a corner is looked at once for each of its three points.
void NewtonSystem::assemble_row(Tangle const& tangle, Region const& region, Points at, Real softness,
                                Index u) const noexcept {
    Span<const Index> const neighbours = region.of(u);
    Span<Block> const row = hessian.from(region.start[u], neighbours.size());
    fill(row, Block{});
    Vec2 sum;
    for (Index const i : region.cells_of(region.point[u])) {
        CellTriangles const corners(tangle.cell(i));
        for (Index k = 0; k < corners.n; ++k) {
            const Index(&point)[3] = corners.point[k];
            Index const own = region.unknown[point[0]] == u ? 0 : region.unknown[point[1]] == u ? 1 : 2;
            if (region.unknown[point[own]] != u) continue;
            Triangle const reference = triangle_of(point, tangle.reference);
            Vec2 gradients[3];
            Distortion::Mode mode[4];
            Distortion(reference).differentiate(triangle_of(point, at), softness, least_curvature, gradients, mode);
            sum = sum + gradients[own];
            for (Index other = 0; other < 3; ++other) {
                Index const v = region.unknown[point[other]];
                if (v == none) continue;
                Size entry = 0;
                while (neighbours[entry] != v) ++entry;
                for (Distortion::Mode const& term : mode) row[entry].add(term.curvature, term.at[own], term.at[other]);
            }
        }
    }
    gradient[u] = sum;
    inverse[u] = inverse_of(row[0]);
}

void NewtonSystem::assemble(Tangle const& tangle, Region const& region, Span<const Vec2> at, Real softness,
                            Executor const& executor) const noexcept {
    executor.for_ranges(region.n, least_rows, [&](Index begin, Index end) {
        for (Index u = begin; u < end; ++u) assemble_row(tangle, region, as_points(at), softness, u);
    });
}

Index NewtonSystem::solve(Region const& region, Index most_products, Executor const& executor) const noexcept {
    Index const n = region.n;
    auto const for_rows = [&](auto const& body) {
        executor.for_ranges(n, least_rows, [&](Index begin, Index end) {
            for (Index u = begin; u < end; ++u) body(u);
        });
    };
    for_rows([&](Index u) {
        step[u] = {};
        rest[u] = -1 * gradient[u];
        search[u] = inverse[u] * rest[u];
    });
    Real size = inner_product(n, rest, search, executor);
    Real const least = enough * enough * size;
    Index products = 0;
    while (products < most_products && size > least) {
        for_rows([&](Index u) {
            Vec2 sum;
            for (Offset entry = region.start[u]; entry < region.start[u + 1]; ++entry) {
                sum = sum + hessian[entry] * search[region.neighbour[entry]];
            }
            image[u] = sum;
        });
        ++products;
        Real const curvature = inner_product(n, search, image, executor);
        if (!(curvature > 0)) break;
        Real const length = size / curvature;
        for_rows([&](Index u) {
            step[u] = step[u] + length * search[u];
            rest[u] = rest[u] - length * image[u];
            image[u] = inverse[u] * rest[u];
        });
        Real const before = size;
        size = inner_product(n, rest, image, executor);
        for_rows([&](Index u) { search[u] = image[u] + size / before * search[u]; });
    }
    return products;
}

Real NewtonSystem::slope(Region const& region, Executor const& executor) const noexcept {
    return inner_product(region.n, gradient, step, executor);
}

}  // namespace harmorph
