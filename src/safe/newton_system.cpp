#include "safe/newton_system.hpp"

namespace harmorph {
namespace {

// Inverts a positive definite block. The entries have the size of 1 / length^2; they are scaled to
// the size of 1 before they are multiplied. In a block that rounding has made singular, all
// directions have equal weight. If rounding has cancelled the whole block, the point stays.
Block inverse_of(Block const& block) noexcept {
    Real const size = abs(block.a) + abs(block.d);
    if (size == 0) return {};
    Real const unit = 1 / power_of_two_at(size);
    Real const a = unit * block.a, b = unit * block.b, c = unit * block.c, d = unit * block.d;
    Real const determinant = a * d - b * c;
    if (determinant <= 0) return {unit, 0, 0, unit};
    Real const scale = unit / determinant;
    return {scale * d, -scale * b, -scale * c, scale * a};
}

}  // namespace

void NewtonSystem::lay_out(Arena& arena, RegionCounts const& counts) noexcept {
    Offset const n = counts.points;
    arena.take(hessian, 2 * counts.pairs + n);
    arena.take(inverse, n);
    arena.take(gradient, n);
    arena.take(border, n);
    arena.take(step, n);
    arena.take(rest, n);
    arena.take(search, n);
    arena.take(image, n);
}

void NewtonSystem::clear_row(Region const& region, Index u) const noexcept {
    fill(hessian.from(region.start[u], region.of(u).size()), Block{});
    gradient[u] = border[u] = {};
}

// Keeps only those parts of the movements of the row's point and its neighbours that are along
// their lines. The diagonal block stays regular, and the right-hand side is zero across the line.
void NewtonSystem::constrain_row(Tangle const& tangle, Region const& region,
                                 Index u) const noexcept {
    Span<const Index> const neighbours = region.of(u);
    Span<Block> const row = hessian.from(region.start[u], neighbours.size());
    auto const line_of = [&](Index v) { return tangle.line[region.point[v]]; };
    for (Index entry = 0; !tangle.line.empty() && entry < neighbours.count(); ++entry) {
        Index const v = neighbours[entry];
        Block& block = row[entry];
        if (tangle.slips(region.point[v])) {
            Vec2 const line = line_of(v), moved = block * line;
            block = {};
            block.add(1, moved, line);
        }
        if (tangle.slips(region.point[u])) {
            Vec2 const line = line_of(u);
            Vec2 const moved = {block.a * line.x + block.c * line.y,
                                block.b * line.x + block.d * line.y};
            block = {};
            block.add(1, line, moved);
        }
    }
    Block own = row[0];
    if (tangle.slips(region.point[u])) {
        Vec2 const line = line_of(u), across = {-line.y, line.x};
        own.add(dot(line, own * line), across, across);
        gradient[u] = dot(line, gradient[u]) * line;
        border[u] = dot(line, border[u]) * line;
    }
    inverse[u] = inverse_of(own);
}

void NewtonSystem::add(Region const& region, Index u, Vec2 slope,
                       Block const& curvature) const noexcept {
    Block& own = hessian[region.start[u]];
    own = own + curvature;
    gradient[u] = gradient[u] + slope;
    inverse[u] = inverse_of(own);
}

// Each pass over the rows is one pass over the memory: the sums of computed values are formed in
// the same pass.
Index NewtonSystem::solve(Region const& region, Span<const Vec2> right, Span<Vec2> to,
                          Index max_products, Real relative_residual,
                          Executor const& executor) const noexcept {
    Index const n = region.n;
    auto const sum_over_rows = [&](auto const& body) {
        return reduce_cells<Sum>(n, executor, [&](Index u, Sum& sum) { sum.value += body(u); })
            .value;
    };
    Real size = sum_over_rows([&](Index u) {
        rest[u] = right[u];
        to[u] = {};
        search[u] = inverse[u] * rest[u];
        return dot(rest[u], search[u]);
    });
    Real const min_size = relative_residual * relative_residual * size;
    Index products = 0;
    while (products < max_products && size > min_size) {
        Real const curvature =
            reduce_ranges<Sum>(n, executor, [&](Index begin, Index end, Sum& sum) {
                sum.value = multiply(region, begin, end, search, image);
            }).value;
        ++products;
        if (!(curvature > 0)) break;
        Real const length = size / curvature, before = size;
        size = sum_over_rows([&](Index u) {
            to[u] = to[u] + length * search[u];
            rest[u] = rest[u] - length * image[u];
            image[u] = inverse[u] * rest[u];
            return dot(rest[u], image[u]);
        });
        executor.for_ranges(n, min_rows, [&](Index begin, Index end) {
            for (Index u = begin; u < end; ++u) search[u] = image[u] + size / before * search[u];
        });
    }
    return products;
}

Index NewtonSystem::solve(Region const& region, Index max_products,
                          Executor const& executor) const noexcept {
    for (Index u = 0; u < region.n; ++u) step[u] = -1 * gradient[u];
    return solve(region, step, step, max_products, enough, executor);
}

Real NewtonSystem::multiply(Region const& region, Index begin, Index end, Span<const Vec2> v,
                            Span<Vec2> to) const noexcept {
    for (Index u = begin; u < end; ++u) to[u] = {};
    for (Index u = begin; u < end; ++u) {
        Vec2 const own = v[u];
        Offset entry = region.start[u];
        Vec2 sum = hessian[entry] * own;
        for (++entry; entry < region.outer_start[u]; ++entry) {
            Block const& block = hessian[entry];
            Index const other = region.neighbour[entry];
            sum = sum + block * v[other];
            to[other] = to[other] + transpose(block) * own;
        }
        for (; entry < region.start[u + 1]; ++entry)
            sum = sum + hessian[entry] * v[region.neighbour[entry]];
        to[u] = to[u] + sum;
    }
    Real product = 0;
    for (Index u = begin; u < end; ++u) product += dot(v[u], to[u]);
    return product;
}

Real NewtonSystem::slope(Region const& region, Executor const& executor) const noexcept {
    return reduce_cells<Sum>(region.n, executor,
                             [&](Index u, Sum& sum) { sum.value += dot(gradient[u], step[u]); })
        .value;
}

}  // namespace harmorph
