#include "harmorph/safe/newton_system.hpp"

namespace harmorph {
namespace {

// Entries have the size of 1 / length^2: their products are formed of parts of the size of 1. Blocks are positive
// definite; of one that rounding made singular, all directions count alike.
Block inverse_of(Block const& block) noexcept {
    Real const unit = 1 / power_of_two_at(block.a + block.d);
    Real const a = unit * block.a, b = unit * block.b, c = unit * block.c, d = unit * block.d;
    Real const determinant = a * d - b * c;
    if (determinant <= 0) return {unit, 0, 0, unit};
    Real const scale = unit / determinant;
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

void NewtonSystem::clear_row(Region const& region, Index u) const noexcept {
    fill(hessian.from(region.start[u], region.of(u).size()), Block{});
    gradient[u] = {};
}

// To the row of the corner's point `own`.
void NewtonSystem::add_to_row(Region const& region, Index own, CornerPoints const& point, const Vec2 (&by)[3],
                              const CornerMode (&mode)[4]) const noexcept {
    Index const u = region.unknown[point[own]];
    Span<const Index> const neighbours = region.of(u);
    Span<Block> const row = hessian.from(region.start[u], neighbours.size());
    gradient[u] = gradient[u] + by[own];
    for (Index other = 0; other < 3; ++other) {
        Index const v = region.unknown[point[other]];
        if (v == none) continue;
        Size entry = 0;
        while (neighbours[entry] != v) ++entry;
        for (CornerMode const& its : mode) row[entry].add(its.curvature, its.at[own], its.at[other]);
    }
}

// Of what moves the points of the row and its neighbours, only the parts along their lines are left. The diagonal block
// stays regular; across the line nothing is ever put into it.
void NewtonSystem::constrain_row(Tangle const& tangle, Region const& region, Index u) const noexcept {
    Span<const Index> const neighbours = region.of(u);
    Span<Block> const row = hessian.from(region.start[u], neighbours.size());
    auto const line_of = [&](Index v) { return tangle.line[region.point[v]]; };
    for (Index entry = 0; !tangle.line.empty() && entry < neighbours.count(); ++entry) {
        Index const v = neighbours[entry];
        Block& block = row[entry];
        if (tangle.slides(region.point[v])) {
            Vec2 const line = line_of(v), moved = block * line;
            block = {};
            block.add(1, moved, line);
        }
        if (tangle.slides(region.point[u])) {
            Vec2 const line = line_of(u);
            Vec2 const moved = {block.a * line.x + block.c * line.y, block.b * line.x + block.d * line.y};
            block = {};
            block.add(1, line, moved);
        }
    }
    Block own = row[0];
    if (tangle.slides(region.point[u])) {
        Vec2 const line = line_of(u), across = {-line.y, line.x};
        own.add(dot(line, own * line), across, across);
        gradient[u] = dot(line, gradient[u]) * line;
    }
    inverse[u] = inverse_of(own);
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
