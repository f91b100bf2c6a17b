#include "morph/morph.hpp"

#define HARMORPH_KERNELS "morph/product_kernel.hpp"
#include "simd/for_each_set.hpp"

namespace harmorph {

ProductKernels const& product_kernels(Kernel kernel) noexcept {
    return simd::table_of<ProductKernels>(kernel);
}

ProductKernels const& product_kernels_for(Kernel known, Offset values,
                                          Offset detection_threshold) noexcept {
    return product_kernels(
        resolved(known, values < detection_threshold ? Kernel::baseline : Kernel::automatic));
}

namespace {

// The sums of the points of these blocks stay in the first-level cache and need little stack.
constexpr Index chunk_blocks = 24;
constexpr Index chunk_points = chunk_blocks * block_points;
// A task moves at least so many blocks.
constexpr Index min_blocks_to_morph = 512;
constexpr Offset morph_detection_threshold = Offset{1} << 17;
// Computes the same as BlockProducts::move.
constexpr Real moved(Real from, Real by) noexcept { return by == 0 ? from : from + by; }

// The factors of the numbers of a row of values, in slices of Movements::max_count numbers. The
// first few slices, which are all slices of most bases, are computed once for a morph; further ones
// do not fit on the stack and are computed for each use.
class RowMovements {
public:
    RowMovements(Basis const& basis, const Real* move) noexcept : basis_(basis), move_(move) {
        for (Index slice = 0; slice < n_stored && slice * Movements::max_count < basis.row_length();
             ++slice) {
            stored_[slice] = make(slice * Movements::max_count);
        }
    }

    // Calls body(first number, how many, movements) for each slice of a row.
    template <class Body>
    void for_each_slice(Body const& body) const noexcept {
        Index const row_length = basis_.row_length();
        for (Index first = 0; first < row_length; first += Movements::max_count) {
            Index const width = min(Movements::max_count, row_length - first),
                        slice = first / Movements::max_count;
            if (slice < n_stored) body(first, width, stored_[slice]);
            else body(first, width, make(first));
        }
    }

private:
    static constexpr Index n_stored = 2;

    Movements make(Index first) const noexcept {
        Movements by = {};
        Index const n = basis_.n_functions(),
                    width = min(Movements::max_count, basis_.row_length() - first);
        Index plane = first / n, function = first % n;
        for (Index k = 0; k < width; ++k) {
            Vec2 const moved =
                moved_by(basis_.kind(), plane, {move_[2 * function], move_[2 * function + 1]});
            by.x[k] = moved.x;
            by.y[k] = moved.y;
            if (++function < n) continue;
            function = 0;
            ++plane;
        }
        return by;
    }

    Basis const& basis_;
    const Real* move_;
    Movements stored_[n_stored];
};

// The sums for the points of at most chunk_blocks blocks, or for slots of the wall.
struct Chunk {
    Real x[chunk_points], y[chunk_points];

    explicit Chunk(Index n_blocks) noexcept {
        for (Index k = 0; k < n_blocks * block_points; ++k) x[k] = y[k] = 0;
    }

    // Adds blocks first .. first+n-1 of the values of a basis with rows of that length.
    template <class Number>
    void add(ProductKernels const& kernels, Span<Number> values, Index row_length,
             RowMovements const& move, Index first, Index n) noexcept {
        Offset const stride = Offset{row_length} * block_points;
        move.for_each_slice([&](Index number, Index width, Movements const& by) {
            Number* const first_value =
                values.data() + first * stride + Offset{number} * block_points;
            ValueBlocks<Number> const blocks{first_value, stride, n, width};
            kernels.of(blocks).multiply(blocks, by, {x, y});
        });
    }
    Vec2 move_point(Vec2 old, Index k) const noexcept {
        return {moved(old.x, x[k]), moved(old.y, y[k])};
    }
};

// Moves the points of blocks first .. first+n-1, n <= chunk_blocks, in arrays with any strides. Not
// inlined, or the sums of both precisions and of the wall would be on the stack together.
template <class Number>
__attribute__((noinline)) void morph_chunk(ProductKernels const& kernels, Span<Number> values,
                                           Basis const& basis, RowMovements const& move,
                                           Points from, MutablePoints to, Index first,
                                           Index n) noexcept {
    Chunk sums(n);
    sums.add(kernels, values, basis.row_length(), move, first, n);
    Index const begin = first * block_points,
                n_points = min(n * block_points, basis.n_points() - begin);
    for (Index k = 0; k < n_points; ++k) {
        to.set(begin + k, sums.move_point(from.given() ? from[begin + k] : Vec2{}, k));
    }
}

// Moves the points of blocks begin .. end-1. The kernels read and write coordinates that are side
// by side, except for a block that is not full.
template <class Number>
void morph_blocks(ProductKernels const& kernels, Span<Number> values, Basis const& basis,
                  RowMovements const& move, Points from, MutablePoints to, Index begin,
                  Index end) noexcept {
    bool const side_by_side = (!from.given() || from.stride == 1) && to.stride == 1;
    if (side_by_side && basis.row_length() <= Movements::max_count) {
        Index const whole = min(end, basis.n_points() / block_points), point = begin * block_points;
        move.for_each_slice([&](Index, Index width, Movements const& by) {
            Offset const stride = Offset{width} * block_points;
            ValueBlocks<Number> const blocks{values.data() + begin * stride, stride, whole - begin,
                                             width};
            bool const given = from.given();
            PerPoint<const Real> const before = {given ? from.x + point : nullptr,
                                                 given ? from.y + point : nullptr};
            kernels.of(blocks).move(blocks, by, before, {to.x + point, to.y + point});
        });
        begin = whole;
    }
    for (Index first = begin; first < end; first += chunk_blocks) {
        morph_chunk(kernels, values, basis, move, from, to, first, min(chunk_blocks, end - first));
    }
}

// Returns the sum of the products of one row in double precision, added up in the order of the
// kernels.
Vec2 sum_of_row(Basis const& basis, RowMovements const& move, Index slot) noexcept {
    Vec2 sum;
    RowInBlock<Real> const row = basis.row(slot);
    move.for_each_slice([&](Index first, Index width, Movements const& by) {
        for (Index k = 0; k < width; ++k) sum = sum + row[first + k] * Vec2{by.x[k], by.y[k]};
    });
    return sum;
}

// Moves the points of the wall. In single-precision storage their rows are 0, so these points have
// not moved yet.
__attribute__((noinline)) void morph_wall(ProductKernels const& kernels, Basis const& basis,
                                          RowMovements const& move, MutablePoints to) noexcept {
    Index const n_slots = basis.wall_point.count(), n_blocks = blocks_of(n_slots);
    for (Index first = 0; first < n_blocks; first += chunk_blocks) {
        Index const n = min(chunk_blocks, n_blocks - first), begin = first * block_points;
        Chunk sums(n);
        sums.add(kernels, basis.value, basis.row_length(), move, first, n);
        for (Index k = 0; k < n * block_points && begin + k < n_slots; ++k) {
            Index const point = basis.wall_point[begin + k];
            to.set(point, sums.move_point(to[point], k));
        }
    }
    for (Index k = 0; k < basis.joined_point.count(); ++k) {
        Index const point = basis.joined_point[k];
        Vec2 const old = to[point], by = sum_of_row(basis, move, basis.joined_slot[k]);
        to.set(point, {moved(old.x, by.x), moved(old.y, by.y)});
    }
}

}  // namespace

void morph(Basis const& basis, const Real* move, Points from, MutablePoints to,
           Executor const& executor) noexcept {
    ProductKernels const& kernels = product_kernels_for(
        executor.kernel, Offset{basis.n_points()} * basis.row_length(), morph_detection_threshold);
    RowMovements const movements(basis, move);
    executor.for_ranges(
        blocks_of(basis.n_points()), min_blocks_to_morph, [&](Index begin, Index end) {
            if (basis.in_single())
                morph_blocks(kernels, basis.single, basis, movements, from, to, begin, end);
            else morph_blocks(kernels, basis.value, basis, movements, from, to, begin, end);
        });
    if (basis.in_single()) morph_wall(kernels, basis, movements, to);
}

}  // namespace harmorph
