// A Newton step for the energy of a region's corners: gradient, convex Hessian in 2 x 2 blocks, conjugate gradients.
#pragma once

#include "harmorph/base/parallel_reduce.hpp"
#include "harmorph/safe/untangling_energy.hpp"
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

// Every corner counts alike. The integral over the reference mesh would weigh with areas; then viscous layers, whose
// areas are ten orders smaller, would be as nothing beside the cells outside them, and would pay for them.
struct NewtonSystem {
    // Relative residual at which a direction is good enough: the softness changes in the next step anyway.
    static constexpr Real enough = 0.2;

    Span<Block> hessian;     // rows as in region.neighbour: the diagonal block first
    Span<Block> inverse;     // [n] of the diagonal blocks
    Span<Vec2> gradient;     // [n]
    Span<Vec2> step;         // [n]
    Span<Vec2> rest, search, image;  // [n] of the conjugate gradients

    void lay_out(Arena& arena, RegionCounts const& counts) noexcept;
    void assemble(Tangle const& tangle, Region const& region, Span<const Vec2> at, Real softness,
                  Executor const& executor) const noexcept;
    // step ~ -hessian^-1 gradient: a direction of descent. Returns the number of products.
    Index solve(Region const& region, Index most_products, Executor const& executor) const noexcept;
    // gradient . step
    Real slope(Region const& region, Executor const& executor) const noexcept;

private:
    void assemble_row(Tangle const& tangle, Region const& region, Points at, Real softness, Index u) const noexcept;
};

inline Triangle triangle_of(const Index (&point)[3], Points at) noexcept {
    return {{at[point[0]], at[point[1]], at[point[2]]}};
}
// Pairs of numbers as points.
inline Points as_points(Span<const Vec2> at) noexcept { return {&at.data()->x, &at.data()->y, 2}; }

}  // namespace harmorph
