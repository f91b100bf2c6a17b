#include "harmorph/morph/adjoint.hpp"

#include "harmorph/morph/product.hpp"

namespace harmorph {
namespace {

constexpr Index block_points = 1024;
constexpr Index most_ranges = 16;    // their sums are on the stack
constexpr Index least_range = 2048;  // points that are worth a thread
constexpr Real not_a_number = __builtin_nan("");

// body(begin, end, i) for ranges of points; returns the number of ranges, on which the sums do not depend.
template <class Body>
Index for_point_ranges(Index n_points, Executor const& executor, Body const& body) noexcept {
    Index const ranges = executor.is_serial() ? 1 : clamp(n_points / least_range, Index{1}, most_ranges);
    auto const bound = [&](Index i) { return static_cast<Index>(Offset{n_points} * i / ranges); };
    executor.for_each(ranges, [&](Index i) { body(bound(i), bound(i + 1), i); });
    return ranges;
}

// Adds the products of numbers first .. first+width-1 of n consecutive rows with the gradients by their points,
// gradient(i).
template <class Number, class Gradient>
void add_rows(ProductKernels const& kernels, Basis const& basis, const Number* rows, Index n, BinaryScale scale,
              Index first, Index width, Gradient const& gradient, FixedSums& total) noexcept {
    Offset const length = basis.row_length();
    BinaryScale const units = scale.units();
    for (Index begin = 0; begin < n; begin += block_points) {
        Index const count = smaller(block_points, n - begin);
        Vec2 by[block_points];
        for (Index i = 0; i < count; ++i) {
            Vec2 const by_point = gradient(begin + i);
            by[i] = {units.down(by_point.x), units.down(by_point.y)};
        }
        ValueRows<Number> const block{rows + begin * length + first, length, count, width};
        kernels.of(block).multiply_transposed(block, by, total);
    }
}

// The sums of as many numbers of the rows as fit in one block.
struct SumsBlock {
    FixedSum x[Movements::most], y[Movements::most];

    SumsBlock(ProductKernels const& kernels, Basis const& basis, Points by_points, BinaryScale scale, Index first,
              Index width, Executor const& executor) noexcept {
        auto const add = [&](auto* rows, Index n, auto const& gradient, FixedSums& total) {
            add_rows(kernels, basis, rows, n, scale, first, width, gradient, total);
        };
        FixedSums part[most_ranges];
        Index const ranges = for_point_ranges(basis.n_points(), executor, [&](Index begin, Index end, Index i) {
            auto const gradient = [&](Index k) { return by_points[begin + k]; };
            part[i] = {};
            if (basis.in_single()) add(basis.single_row(begin), end - begin, gradient, part[i]);
            else add(basis.row(begin), end - begin, gradient, part[i]);
        });
        if (basis.in_single()) {  // the rows of the wall are 0 there and stand in double precision apart
            auto const of_slot = [&](Index slot) { return by_points[basis.wall_point[slot]]; };
            add(basis.row(0), basis.wall_point.count(), of_slot, part[0]);
            for (Index k = 0; k < basis.joined_point.count(); ++k) {
                auto const of_joined = [&](Index) { return by_points[basis.joined_point[k]]; };
                add(basis.row(basis.joined_slot[k]), 1, of_joined, part[0]);
            }
        }
        for (Index k = 0; k < width; ++k) {
            for (Index i = 0; i < ranges; ++i) {
                x[k] += part[i].x[k];
                y[k] += part[i].y[k];
            }
        }
    }
};

// Adds the contribution of one number of a row, summed over all points, to the gradient by the movement of its
// function.
void add_to_gradient(Basis const& basis, Index number, BinaryScale scale, FixedSum x, FixedSum y,
                     Real* gradient) noexcept {
    Index const n = basis.n_functions(), plane = number / n;
    Real* const to = gradient + 2 * (number % n);
    Vec2 const total{scale.up(x.value()), scale.up(y.value())};
    to[0] += dot(total, moved_by(basis.kind(), plane, {1, 0}));
    to[1] += dot(total, moved_by(basis.kind(), plane, {0, 1}));
}

void set_gradient(Basis const& basis, Real value, Real* gradient) noexcept {
    for (Index i = 0; i < 2 * basis.n_functions(); ++i) gradient[i] = value;
}

ProductKernels const& kernels_for(Basis const& basis) noexcept {
    return product_kernels_for(Offset{basis.n_points()} * basis.row_length());
}

template <class Body>
void for_each_block(Index row_length, Body const& body) noexcept {
    for (Index first = 0; first < row_length; first += Movements::most) {
        body(first, smaller(Movements::most, row_length - first));
    }
}

}  // namespace

BinaryScale adjoint_scale(Basis const& basis, Points gradient_by_points, Executor const& executor) noexcept {
    LargestMagnitude largest[most_ranges];
    for_point_ranges(basis.n_points(), executor, [&](Index begin, Index end, Index i) {
        LargestMagnitude independent[4];  // four chains instead of one: no number waits for the one before it
        for (Index p = begin; p < end; p += 2) {
            Vec2 const one = gradient_by_points[p], next = gradient_by_points[smaller(p + 1, end - 1)];
            independent[0].include(one.x);
            independent[1].include(one.y);
            independent[2].include(next.x);
            independent[3].include(next.y);
        }
        for (LargestMagnitude const one : independent) largest[i].include(one.value());
    });
    LargestMagnitude gradient;
    for (LargestMagnitude const one : largest) gradient.include(one.value());
    return BinaryScale::of_products(basis.header->largest, gradient.value());
}

void adjoint_sums(Basis const& basis, Points gradient_by_points, BinaryScale scale, std::int64_t* sums,
                  Executor const& executor) noexcept {
    Offset const n = basis.row_length();
    for (Offset k = 0; k < adjoint_sums_count(basis.row_length()); ++k) sums[k] = 0;
    if (!scale.finite()) return;
    ProductKernels const& kernels = kernels_for(basis);
    for_each_block(basis.row_length(), [&](Index first, Index width) {
        SumsBlock const block(kernels, basis, gradient_by_points, scale, first, width, executor);
        for (Index k = 0; k < width; ++k) {
            std::int64_t* const to = sums + first + k;
            to[0] = block.x[k].coarse;
            to[n] = block.x[k].fine;
            to[2 * n] = block.y[k].coarse;
            to[3 * n] = block.y[k].fine;
        }
    });
}

void adjoint_finish(Basis const& basis, BinaryScale scale, const std::int64_t* sums, Real* gradient) noexcept {
    if (!scale.finite()) return set_gradient(basis, not_a_number, gradient);
    Offset const n = basis.row_length();
    set_gradient(basis, 0, gradient);
    for (Index k = 0; k < basis.row_length(); ++k) {
        const std::int64_t* const sum = sums + k;
        add_to_gradient(basis, k, scale, {sum[0], sum[n]}, {sum[2 * n], sum[3 * n]}, gradient);
    }
}

void adjoint_morph(Basis const& basis, Points gradient_by_points, Real* gradient, Executor const& executor) noexcept {
    BinaryScale const scale = adjoint_scale(basis, gradient_by_points, executor);
    if (!scale.finite()) return set_gradient(basis, not_a_number, gradient);
    set_gradient(basis, 0, gradient);
    ProductKernels const& kernels = kernels_for(basis);
    for_each_block(basis.row_length(), [&](Index first, Index width) {
        SumsBlock const block(kernels, basis, gradient_by_points, scale, first, width, executor);
        for (Index k = 0; k < width; ++k) add_to_gradient(basis, first + k, scale, block.x[k], block.y[k], gradient);
    });
}

}  // namespace harmorph
