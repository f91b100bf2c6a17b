#include "morph/adjoint.hpp"

#include "base/executor.hpp"
#include "morph/morph.hpp"

namespace harmorph {
namespace {

constexpr Index max_blocks = BlockProducts<Real>::max_blocks;
// The sums of the ranges are on the stack.
constexpr Index max_ranges = 16;
// A range has at least so many blocks.
constexpr Index min_blocks_to_gather = 128;
constexpr Real not_a_number = __builtin_nan("");

// Calls body(first block, end, i) for ranges of the points' blocks; returns the
// number of ranges. The sums do not depend on that number.
template <class Body>
Index for_block_ranges(Index n_points, Executor const& executor, Body const& body) noexcept {
    Index const blocks = blocks_of(n_points);
    Index const ranges = executor.is_serial()
                             ? 1
                             : sharing(clamp(blocks / min_blocks_to_gather, Index{1}, max_ranges));
    auto const bound = [&](Index i) { return static_cast<Index>(Offset{blocks} * i / ranges); };
    executor.for_each(ranges, [&](Index i) { body(bound(i), bound(i + 1), i); });
    return ranges;
}

// Some of the numbers of a row of values: first .. first+width-1.
struct RowSlice {
    Index first, width;
};

// The gradients by the points of a block; they are 0 after the last point.
struct BlockGradient {
    Real x[block_points] = {}, y[block_points] = {};

    void set(Index i, Vec2 gradient) noexcept {
        x[i] = gradient.x;
        y[i] = gradient.y;
    }
};

// Adds up products with a slice of the rows of a basis in fixed point.
struct Adder {
    ProductKernels const& kernels;
    Basis const& basis;
    Points by_points;
    BinaryScale::Factor unit;
    RowSlice slice;

    template <class Number>
    void add(Span<Number> values, Index first_block, Index n_blocks, PerPoint<const Real> by,
             FixedSums& total) const noexcept {
        Offset const stride = Offset{basis.row_length()} * block_points;
        Number* const first =
            values.data() + first_block * stride + Offset{slice.first} * block_points;
        ValueBlocks<Number> const blocks{first, stride, n_blocks, slice.width};
        kernels.of(blocks).multiply_transposed(blocks, by, unit, total);
    }
    template <class Number>
    void add_block(Span<Number> values, Index block, BlockGradient const& by,
                   FixedSums& total) const noexcept {
        add(values, block, 1, {by.x, by.y}, total);
    }

    // Adds the points of blocks begin .. end-1. Numbers that lie side by side are read by the
    // kernels.
    template <class Number>
    void add_points(Span<Number> values, Index begin, Index end, FixedSums& total) const noexcept {
        Index const whole =
            by_points.stride == 1 ? min(end, basis.n_points() / block_points) : begin;
        for (Index block = begin; block < whole; block += max_blocks) {
            Index const point = block * block_points;
            add(values, block, min(max_blocks, whole - block),
                {by_points.x + point, by_points.y + point}, total);
        }
        for (Index block = whole; block < end; ++block) {
            BlockGradient by;
            Index const point = block * block_points,
                        n = min(block_points, basis.n_points() - point);
            for (Index i = 0; i < n; ++i) by.set(i, by_points[point + i]);
            add_block(values, block, by, total);
        }
    }

    void add_points_of_basis(Index begin, Index end, FixedSums& total) const noexcept {
        if (basis.in_single()) add_points(basis.single, begin, end, total);
        else add_points(basis.value, begin, end, total);
    }

    // Adds the rows of the wall, which are in double precision apart from the points' rows in
    // single precision storage, where they are 0.
    void add_wall(FixedSums& total) const noexcept {
        Index const slots = basis.wall_point.count();
        for (Index begin = 0; begin < slots; begin += block_points) {
            BlockGradient by;
            Index const n = min(block_points, slots - begin);
            for (Index i = 0; i < n; ++i) by.set(i, by_points[basis.wall_point[begin + i]]);
            add_block(basis.value, begin / block_points, by, total);
        }
        for (Index k = 0; k < basis.joined_point.count(); ++k) {
            Index const slot = basis.joined_slot[k];
            BlockGradient by;
            by.set(slot % block_points, by_points[basis.joined_point[k]]);
            add_block(basis.value, slot / block_points, by, total);
        }
    }
};

// Adds the sums of a slice of the rows over all points. Several threads have sums of their own. Not
// inlined, as one thread needs no stack for these.
__attribute__((noinline)) void add_in_ranges(Adder const& adder, Executor const& executor,
                                             FixedSums& total) noexcept {
    Lock lock;
    for_block_ranges(adder.basis.n_points(), executor, [&](Index begin, Index end, Index) {
        FixedSums sums{};
        adder.add_points_of_basis(begin, end, sums);
        lock.run([&] {
            for (Index k = 0; k < adder.slice.width; ++k) {
                total.x[k] += sums.x[k];
                total.y[k] += sums.y[k];
            }
        });
    });
}

// The sums for a slice of the rows.
struct SliceSums : FixedSums {
    SliceSums(ProductKernels const& kernels, Basis const& basis, Points by_points,
              BinaryScale scale, RowSlice numbers, Executor const& executor) noexcept
        : FixedSums{} {
        Adder const adder{kernels, basis, by_points, scale.units().downwards(), numbers};
        if (executor.is_serial()) adder.add_points_of_basis(0, blocks_of(basis.n_points()), *this);
        else add_in_ranges(adder, executor, *this);
        if (basis.in_single()) adder.add_wall(*this);
    }
};

// Adds the contribution of one number of a row, summed over all points, to the gradient by the
// movement of its function.
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

ProductKernels const& kernels_for(Basis const& basis, Executor const& executor) noexcept {
    constexpr Offset detection_threshold = Offset{1} << 15;
    return product_kernels_for(executor.kernel, Offset{basis.n_points()} * basis.row_length(),
                               detection_threshold);
}

template <class Body>
void for_each_slice(Index row_length, Body const& body) noexcept {
    for (Index first = 0; first < row_length; first += Movements::max_count) {
        body(RowSlice{first, min(Movements::max_count, row_length - first)});
    }
}

}  // namespace

BinaryScale adjoint_scale(Basis const& basis, Points gradient_by_points,
                          Executor const& executor) noexcept {
    LargestMagnitude largest[max_ranges];
    ProductKernels const& kernels = kernels_for(basis, executor);
    for_block_ranges(basis.n_points(), executor, [&](Index first, Index end_block, Index i) {
        Index const begin = first * block_points,
                    end = min(end_block * block_points, basis.n_points());
        if (gradient_by_points.stride == 1) {
            largest[i].include_bits(
                kernels.largest_bits(gradient_by_points.x + begin, end - begin));
            largest[i].include_bits(
                kernels.largest_bits(gradient_by_points.y + begin, end - begin));
            return;
        }
        for (Index point = begin; point < end; ++point) {
            largest[i].include(gradient_by_points[point].x);
            largest[i].include(gradient_by_points[point].y);
        }
    });
    LargestMagnitude gradient;
    for (LargestMagnitude const one : largest) gradient.include(one.value());
    return BinaryScale::of_products(basis.header->largest, gradient.value());
}

void adjoint_sums(Basis const& basis, Points gradient_by_points, BinaryScale scale,
                  std::int64_t* sums, Executor const& executor) noexcept {
    Offset const n = basis.row_length();
    for (Offset k = 0; k < adjoint_sums_count(basis.row_length()); ++k) sums[k] = 0;
    if (!scale.finite()) return;
    ProductKernels const& kernels = kernels_for(basis, executor);
    for_each_slice(basis.row_length(), [&](RowSlice slice) {
        SliceSums const found(kernels, basis, gradient_by_points, scale, slice, executor);
        for (Index k = 0; k < slice.width; ++k) {
            std::int64_t* const to = sums + slice.first + k;
            to[0] = found.x[k].coarse;
            to[n] = found.x[k].fine;
            to[2 * n] = found.y[k].coarse;
            to[3 * n] = found.y[k].fine;
        }
    });
}

void adjoint_finish(Basis const& basis, BinaryScale scale, const std::int64_t* sums,
                    Real* gradient) noexcept {
    if (!scale.finite()) return set_gradient(basis, not_a_number, gradient);
    Offset const n = basis.row_length();
    set_gradient(basis, 0, gradient);
    for (Index k = 0; k < basis.row_length(); ++k) {
        const std::int64_t* const sum = sums + k;
        add_to_gradient(basis, k, scale, {sum[0], sum[n]}, {sum[2 * n], sum[3 * n]}, gradient);
    }
}

void adjoint_morph(Basis const& basis, Points gradient_by_points, Real* gradient,
                   Executor const& executor) noexcept {
    BinaryScale const scale = adjoint_scale(basis, gradient_by_points, executor);
    if (!scale.finite()) return set_gradient(basis, not_a_number, gradient);
    set_gradient(basis, 0, gradient);
    ProductKernels const& kernels = kernels_for(basis, executor);
    for_each_slice(basis.row_length(), [&](RowSlice slice) {
        SliceSums const found(kernels, basis, gradient_by_points, scale, slice, executor);
        for (Index k = 0; k < slice.width; ++k) {
            add_to_gradient(basis, slice.first + k, scale, found.x[k], found.y[k], gradient);
        }
    });
}

}  // namespace harmorph
