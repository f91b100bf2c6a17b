// The products of morphing with the registers of one instruction set; product.cpp compiles this
// file for each of them. Loops over the vectors of a block are unrolled whatever the compiler's
// level, so that sums stay in registers.

namespace harmorph::products::HARMORPH_SET {
namespace {

using Registers = simd::HARMORPH_SET::Registers<Real>;
using Vector = Registers::Vector;
using Words = Registers::Words;

constexpr Index lanes = Registers::lanes;
constexpr Index vectors = block_points / lanes;  // of a number in a block
constexpr Index at_once =
    min(vectors, Index{Registers::count / 4});  // two sums each fill half the registers
// Instructions of AVX-512 take a number from memory for all lanes.
constexpr bool spreads_operands = lanes == 8;

// What some of a block's points have: at_once vectors along x and along y.
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
                // Values are read once. Factors are read again where that costs nothing.
                if (v == 0 || spreads_operands) asm volatile("" ::: "memory");
                x[v] += f[v] * by.x[k];
                y[v] += f[v] * by.y[k];
            }
        }
    }
};

// body(values of the first number, point) for every at_once vectors of points.
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

// What the points of some lanes have along x and along y, for sums in fixed point.
template <class Of, bool rounds = Of::rounds>
struct GradientIn;
// Sums of products with one number of the values, along x and along y, in fixed point in each lane;
// see FixedSum.
template <class Of, bool rounds = Of::rounds>
struct SumsIn;
// What these are of n_products in all lanes together.
struct SettledSums {
    FixedSum x, y;
};

// Where one instruction rounds, integers are summed modulo 2^64. The multiple of 2^64 that is
// missing is known from a sum in floating point, which serves x and y: the part of y is multiplied
// by `beside`. Of the 2^16 products below 2^63 of a call, that part, divided by 2^64, stays below
// 2^-5, and the error of the sum below 2^-25.
template <class Of>
struct GradientIn<Of, true> {
    static constexpr Real beside = 0x1p-20;
    Vector x, y, both;

    HARMORPH_INLINE void set(Vector along_x, Vector along_y) noexcept {
        x = along_x;
        y = along_y;
        both = along_x + beside * along_y;
    }
};
template <class Of>
struct SumsIn<Of, true> {
    Words x, y;
    Vector both;

    HARMORPH_INLINE void add(Vector f, GradientIn<Of> const& by) noexcept {
        asm volatile("" ::: "memory");  // f is read once, not for each product
        x += Of::round(f * by.x);
        y += Of::round(f * by.y);
        both = Of::multiply_add(f, by.both, both);
    }
    HARMORPH_INLINE SettledSums settled(Index) const noexcept {
        std::uint64_t sum_x = 0, sum_y = 0;
        Real rough = 0;
        for (Index lane = 0; lane < lanes; ++lane) {
            sum_x += x[lane];
            sum_y += y[lane];
            rough += both[lane];
        }
        constexpr Real beside = GradientIn<Of>::beside;
        Real const missing_x = (rough - static_cast<Real>(sum_x)) * 0x1p-64;
        std::int64_t const times_x = nearest(missing_x);
        Real const missing_y =
            (missing_x - static_cast<Real>(times_x)) / beside - static_cast<Real>(sum_y) * 0x1p-64;
        return {with_multiple(sum_x, times_x), with_multiple(sum_y, nearest(missing_y))};
    }

private:
    static std::int64_t nearest(Real x) noexcept {
        return static_cast<std::int64_t>(x + (x < 0 ? -0.5 : 0.5));
    }
    // sum + times * 2^64
    static FixedSum with_multiple(std::uint64_t sum, std::int64_t times) noexcept {
        constexpr std::int64_t coarse_in_word = std::int64_t{1} << (64 - FixedSum::fine_bits);
        return {times * coarse_in_word + static_cast<std::int64_t>(sum >> FixedSum::fine_bits),
                static_cast<std::int64_t>(sum & FixedSum::fine_mask)};
    }
};

// Elsewhere the bits of numbers rounded to the grids of FixedSum are summed: multiples of its
// units, plus the bits of the grid itself.
template <class Of>
struct GradientIn<Of, false> {
    Vector x, y;

    HARMORPH_INLINE void set(Vector along_x, Vector along_y) noexcept {
        x = along_x;
        y = along_y;
    }
};
template <class Of>
struct SumsIn<Of, false> {
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

    HARMORPH_INLINE void add(Vector f, GradientIn<Of> const& by) noexcept {
        x.add(f * by.x);
        y.add(f * by.y);
    }
    HARMORPH_INLINE SettledSums settled(Index n_products) const noexcept {
        return {x.settled(n_products), y.settled(n_products)};
    }
};

using Gradient = GradientIn<Registers>;
using Sums = SumsIn<Registers>;

// So much is done with each number that processors do not look far enough ahead for the numbers
// that come: they are prefetched. They go into the second cache only: requests of the first one
// hide the stream from the processor's own prefetch.
template <class Number>
HARMORPH_INLINE void prefetch_numbers(const Number* numbers) noexcept {
    constexpr Index line = 64 / sizeof(Number);
    for (Index i = 0; i < block_points; i += line) __builtin_prefetch(numbers + i, 0, 2);
}

// Adds the products of `width` blocks, from block `first` on. Each sum stays in registers for all
// of them. `ahead`: distance of the numbers that are prefetched.
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
    constexpr Index written_out =
        lanes == 8 ? width : 1;  // blocks; the short loops of AVX-512 gain by that
    const Number* const values = blocks.values + first * blocks.stride;
    for (Index k = 0; k < blocks.n_numbers; ++k) {
        Sums sum = sums[k];
        for (Index from = 0; from < width; from += written_out) {
#pragma GCC unroll 8
            for (Index block = from; block < from + written_out; ++block) {
                const Number* const its = values + block * blocks.stride + k * block_points;
                prefetch_numbers(its + ahead);
#pragma GCC unroll 4
                for (Index v = 0; v < vectors; ++v) {
                    sum.add(Registers::load(its + v * lanes), gradient[block * vectors + v]);
                }
            }
        }
        sums[k] = sum;
    }
}

// Not inlined: one for both precisions of the values.
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
    constexpr Index few =
        64;  // sums of so many numbers leave room in the first cache; of more, they come and go
    constexpr Index window = 8;  // blocks that share each coming and going
    constexpr Offset near = 512 / sizeof(Number);
    Index const n = blocks.n_numbers;
    alignas(64) Sums sums[Movements::most];  // no vector in two cache lines
    for (Index k = 0; k < n; ++k) sums[k] = Sums{};
    Index block = 0;
    if (n > few) {
        for (; block + window <= blocks.n_blocks; block += window) {
            add_blocks<window>(blocks, block, by, unit, window * blocks.stride, sums);
        }
    }
    for (; block < blocks.n_blocks; ++block) add_blocks<1>(blocks, block, by, unit, near, sums);
    add_settled(sums, n, blocks.n_blocks * block_points, total);
}

std::uint64_t largest_bits(const Real* numbers, Index n) noexcept {
    constexpr std::uint64_t without_sign = ~(std::uint64_t{1} << 63);
    constexpr Index chains = 4;  // no number waits for the one before
    Words most[chains] = {};
    Index i = 0;
    for (; i + chains * lanes <= n; i += chains * lanes) {
#pragma GCC unroll 8
        for (Index c = 0; c < chains; ++c) {
            Words const bits =
                reinterpret_cast<Words>(Registers::load(numbers + i + c * lanes)) & without_sign;
            most[c] = bits > most[c] ? bits : most[c];
        }
    }
    std::uint64_t largest = 0;
    for (; i < n; ++i) largest = max(largest, bits_of(numbers[i]) & without_sign);
    for (Words const& chain : most) {
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
