// The products of morphing with the registers of one instruction set; morph.cpp compiles this
// file for each set. Loops over the vectors of a block are unrolled at each optimisation level, so
// that sums stay in registers. tests/morph/test_product.cpp covers this file.

namespace harmorph::products::HARMORPH_SET {

// Sums of products in fixed point with the registers of one instruction set.

namespace {

using Registers = simd::HARMORPH_SET::Registers<Real>;
using Vector = Registers::Vector;
using Words = Registers::Words;

constexpr Index lanes = Registers::lanes;

// The gradients of the points of some lanes along x and along y, for sums in fixed point.
template <class Set, bool rounds = Set::rounds>
struct GradientIn;
// Sums of products with one number of the values, along x and along y, in fixed point in each lane;
// see FixedSum.
template <class Set, bool rounds = Set::rounds>
struct SumsIn;
// The sums of all lanes together, for n_products in each lane.
struct SettledSums {
    FixedSum x, y;
};

// If one instruction rounds, integers are summed modulo 2^64. The missing multiple of 2^64 follows
// from a sum in floating point, which serves both x and y: the part of y is multiplied by y_factor.
// For the 2^16 products below 2^63 of a call, that part, divided by 2^64, stays below 2^-5, and the
// error of the sum below 2^-25.
template <class Set>
struct GradientIn<Set, true> {
    static constexpr Real y_factor = 0x1p-20;
    Vector x, y, combined;

    HARMORPH_INLINE void set(Vector along_x, Vector along_y) noexcept {
        x = along_x;
        y = along_y;
        combined = along_x + y_factor * along_y;
    }
};
template <class Set>
struct SumsIn<Set, true> {
    Words x, y;
    Vector combined;

    HARMORPH_INLINE void add(Vector f, GradientIn<Set> const& by) noexcept {
        asm volatile("" ::: "memory");  // f is read once for both products.
        x += Set::round(f * by.x);
        y += Set::round(f * by.y);
        combined = Set::multiply_add(f, by.combined, combined);
    }
    HARMORPH_INLINE SettledSums settled(Index) const noexcept {
        std::uint64_t sum_x = 0, sum_y = 0;
        Real rough = 0;
        for (Index lane = 0; lane < lanes; ++lane) {
            sum_x += x[lane];
            sum_y += y[lane];
            rough += combined[lane];
        }
        constexpr Real y_factor = GradientIn<Set>::y_factor;
        Real const missing_x = (rough - static_cast<Real>(sum_x)) * 0x1p-64;
        std::int64_t const times_x = nearest(missing_x);
        Real const missing_y = (missing_x - static_cast<Real>(times_x)) / y_factor -
                               static_cast<Real>(sum_y) * 0x1p-64;
        return {with_multiple(sum_x, times_x), with_multiple(sum_y, nearest(missing_y))};
    }

private:
    static std::int64_t nearest(Real x) noexcept {
        return static_cast<std::int64_t>(x + (x < 0 ? -0.5 : 0.5));
    }
    // Returns sum + times * 2^64.
    static FixedSum with_multiple(std::uint64_t sum, std::int64_t times) noexcept {
        constexpr std::int64_t coarse_in_word = std::int64_t{1} << (64 - FixedSum::fine_bits);
        return {times * coarse_in_word + static_cast<std::int64_t>(sum >> FixedSum::fine_bits),
                static_cast<std::int64_t>(sum & FixedSum::fine_mask)};
    }
};

// For other instruction sets the bits of numbers that are rounded to the grids of FixedSum are
// summed: multiples of the units of FixedSum, plus the bits of the grid itself.
template <class Set>
struct GradientIn<Set, false> {
    Vector x, y;

    HARMORPH_INLINE void set(Vector along_x, Vector along_y) noexcept {
        x = along_x;
        y = along_y;
    }
};
template <class Set>
struct SumsIn<Set, false> {
    struct Sum {
        Words coarse, fine;

        HARMORPH_INLINE void add(Vector t) noexcept {
            Vector const on_grid = t + FixedSum::coarse_grid;
            coarse += reinterpret_cast<Words>(on_grid);
            fine += reinterpret_cast<Words>((t - (on_grid - FixedSum::coarse_grid)) +
                                            FixedSum::fine_grid);
        }
        HARMORPH_INLINE FixedSum settled(Index n_products) const noexcept {
            std::uint64_t const times = static_cast<std::uint64_t>(n_products);
            std::uint64_t all_coarse = 0, all_fine = 0;
            for (Index lane = 0; lane < lanes; ++lane) {
                all_coarse += coarse[lane];
                all_fine += fine[lane];
            }
            return {static_cast<std::int64_t>(all_coarse - times * FixedSum::bits_of_coarse_grid),
                    static_cast<std::int64_t>(all_fine - times * FixedSum::bits_of_fine_grid)};
        }
    } x, y;

    HARMORPH_INLINE void add(Vector f, GradientIn<Set> const& by) noexcept {
        x.add(f * by.x);
        y.add(f * by.y);
    }
    HARMORPH_INLINE SettledSums settled(Index n_products) const noexcept {
        return {x.settled(n_products), y.settled(n_products)};
    }
};

using Gradient = GradientIn<Registers>;
using Sums = SumsIn<Registers>;

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
