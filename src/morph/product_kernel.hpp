// The products of morphing with the registers of one instruction set; product.cpp compiles this
// file for each set. Loops over the vectors of a block are unrolled at each optimisation level, so
// that sums stay in registers. tests/morph/test_product.cpp covers this file.
#include "morph/product_sums.hpp"

namespace harmorph::products::HARMORPH_SET {
namespace {

constexpr Index vectors = block_points / lanes;  // The number of vectors of a number in a block.
// Two sums of so many vectors each fill half of the registers.
constexpr Index at_once = min(vectors, Index{Registers::count / 4});
// Instructions of AVX-512 can load one number from memory into all lanes.
constexpr bool spreads_operands = lanes == 8;

// The numbers of some points of a block: at_once vectors along x and along y.
struct Pair {
    Vector x[at_once], y[at_once];

    HARMORPH_INLINE void load(PerPoint<const Real> from, Offset point) noexcept {
#pragma GCC unroll 8
        for (Index v = 0; v < at_once; ++v) {
            x[v] = Registers::load(from.x + point + v * lanes);
            y[v] = Registers::load(from.y + point + v * lanes);
        }
    }
    HARMORPH_INLINE void store(PerPoint<Real> to, Offset point) const noexcept {
#pragma GCC unroll 8
        for (Index v = 0; v < at_once; ++v) {
            Registers::store(to.x + point + v * lanes, x[v]);
            Registers::store(to.y + point + v * lanes, y[v]);
        }
    }
    template <class Number>
    HARMORPH_INLINE void add_products(const Number* values, Index n, Movements const& by) noexcept {
        for (Index k = 0; k < n; ++k) {
            Vector f[at_once];
#pragma GCC unroll 8
            for (Index v = 0; v < at_once; ++v)
                f[v] = Registers::load(values + k * block_points + v * lanes);
#pragma GCC unroll 8
            for (Index v = 0; v < at_once; ++v) {
                // Values are read once. Factors are read again if that takes no time.
                if (v == 0 || spreads_operands) asm volatile("" ::: "memory");
                x[v] += f[v] * by.x[k];
                y[v] += f[v] * by.y[k];
            }
        }
    }
};

// Calls body(values of the first number, point) for every at_once vectors of points.
template <class Number, class Body>
HARMORPH_INLINE void for_each_pair(ValueBlocks<Number> const& blocks, Body const& body) noexcept {
    for (Index block = 0; block < blocks.n_blocks; ++block) {
        for (Index point = 0; point < block_points; point += at_once * lanes) {
            body(blocks.values + block * blocks.stride + point,
                 Offset{block} * block_points + point);
        }
    }
}

template <class Number>
void multiply(ValueBlocks<Number> const& blocks, Movements const& by,
              PerPoint<Real> sums) noexcept {
    for_each_pair(
        blocks, [&](const Number* values, Offset point) __attribute__((always_inline)) {
            Pair sum;
            sum.load({sums.x, sums.y}, point);
            sum.add_products(values, blocks.n_numbers, by);
            sum.store(sums, point);
        });
}

template <class Number>
void move(ValueBlocks<Number> const& blocks, Movements const& by, PerPoint<const Real> from,
          PerPoint<Real> to) noexcept {
    for_each_pair(
        blocks, [&](const Number* values, Offset point) __attribute__((always_inline)) {
            Pair sum = {}, at = {};
            sum.add_products(values, blocks.n_numbers, by);
            if (from.x != nullptr) at.load(from, point);
#pragma GCC unroll 8
            for (Index v = 0; v < at_once; ++v) {
                at.x[v] = sum.x[v] == 0 ? at.x[v] : at.x[v] + sum.x[v];
                at.y[v] = sum.y[v] == 0 ? at.y[v] : at.y[v] + sum.y[v];
            }
            at.store(to, point);
        });
}

// So many operations are done with each number that processors do not read far enough ahead. The
// numbers are therefore prefetched, into the second cache only, as requests of the first cache hide
// the stream from the processor's own prefetch.
template <class Number>
HARMORPH_INLINE void prefetch_numbers(const Number* numbers) noexcept {
    constexpr Index line = 64 / sizeof(Number);
    for (Index i = 0; i < block_points; i += line) __builtin_prefetch(numbers + i, 0, 2);
}

// Adds the products of `width` blocks, beginning with block `first`. Each sum stays in registers
// for all of them. `ahead` is the distance of the numbers that are prefetched.
template <Index width, class Number>
HARMORPH_INLINE void add_blocks(ValueBlocks<Number> const& blocks, Index first,
                                PerPoint<const Real> by, BinaryScale::Factor unit, Offset ahead,
                                Sums* sums) noexcept {
    Gradient gradient[width * vectors];
#pragma GCC unroll 4
    for (Index v = 0; v < width * vectors; ++v) {
        Index const point = first * block_points + v * lanes;
        gradient[v].set(Registers::load(by.x + point) * unit.first * unit.second,
                        Registers::load(by.y + point) * unit.first * unit.second);
    }
    // The number of blocks whose code is unrolled; the short loops of AVX-512 gain by that.
    constexpr Index unrolled = lanes == 8 ? width : 1;
    const Number* const values = blocks.values + first * blocks.stride;
    for (Index k = 0; k < blocks.n_numbers; ++k) {
        Sums sum = sums[k];
        for (Index from = 0; from < width; from += unrolled) {
#pragma GCC unroll 8
            for (Index block = from; block < from + unrolled; ++block) {
                const Number* const numbers = values + block * blocks.stride + k * block_points;
                prefetch_numbers(numbers + ahead);
#pragma GCC unroll 4
                for (Index v = 0; v < vectors; ++v) {
                    sum.add(Registers::load(numbers + v * lanes), gradient[block * vectors + v]);
                }
            }
        }
        sums[k] = sum;
    }
}

// The function is not inlined, as it serves both precisions of the values.
__attribute__((noinline)) void add_settled(const Sums* sums, Index n, Index n_products,
                                           FixedSums& total) noexcept {
    for (Index k = 0; k < n; ++k) {
        SettledSums const settled = sums[k].settled(n_products);
        total.x[k] += settled.x;
        total.y[k] += settled.y;
    }
}

template <class Number>
void multiply_transposed(ValueBlocks<Number> const& blocks, PerPoint<const Real> by,
                         BinaryScale::Factor unit, FixedSums& total) noexcept {
    // Sums of so many numbers leave room in the first cache; more sums are loaded and stored each
    // time.
    constexpr Index max_cached = 64;
    constexpr Index window = 8;  // So many blocks share each load and store of the sums.
    constexpr Offset near = 512 / sizeof(Number);
    Index const n = blocks.n_numbers;
    alignas(64) Sums sums[Movements::max_count];  // No vector lies in two cache lines.
    for (Index k = 0; k < n; ++k) sums[k] = Sums{};
    Index block = 0;
    if (n > max_cached) {
        for (; block + window <= blocks.n_blocks; block += window) {
            add_blocks<window>(blocks, block, by, unit, window * blocks.stride, sums);
        }
    }
    for (; block < blocks.n_blocks; ++block) add_blocks<1>(blocks, block, by, unit, near, sums);
    add_settled(sums, n, blocks.n_blocks * block_points, total);
}

std::uint64_t largest_bits(const Real* numbers, Index n) noexcept {
    constexpr std::uint64_t without_sign = ~(std::uint64_t{1} << 63);
    constexpr Index chains = 4;  // The chains are independent of each other.
    Words largest_of[chains] = {};
    Index i = 0;
    for (; i + chains * lanes <= n; i += chains * lanes) {
#pragma GCC unroll 8
        for (Index c = 0; c < chains; ++c) {
            Words const bits =
                reinterpret_cast<Words>(Registers::load(numbers + i + c * lanes)) & without_sign;
            largest_of[c] = bits > largest_of[c] ? bits : largest_of[c];
        }
    }
    std::uint64_t largest = 0;
    for (; i < n; ++i) largest = max(largest, bits_of(numbers[i]) & without_sign);
    for (Words const& chain : largest_of) {
        for (Index lane = 0; lane < lanes; ++lane)
            largest = max<std::uint64_t>(largest, chain[lane]);
    }
    return largest;
}

constexpr ProductKernels kernels{{multiply<Real>, move<Real>, multiply_transposed<Real>},
                                 {multiply<float>, move<float>, multiply_transposed<float>},
                                 largest_bits};

}  // namespace
}  // namespace harmorph::products::HARMORPH_SET

namespace harmorph::simd {
template <>
inline constexpr const ProductKernels* table<ProductKernels, Kernel::HARMORPH_SET> =
    &harmorph::products::HARMORPH_SET::kernels;
}  // namespace harmorph::simd
