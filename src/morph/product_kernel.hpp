// The products of morphing with the registers of one instruction set; product.cpp compiles this file for each of them.
// Loops over the vectors of a block are unrolled whatever the compiler's level, so that sums stay in registers.

namespace harmorph::products::HARMORPH_SET {
namespace {

using Registers = simd::HARMORPH_SET::Registers<Real>;
using Vector = Registers::Vector;
using Words = Registers::Words;

constexpr Index lanes = Registers::lanes;
constexpr Index vectors = block_points / lanes;                        // of a number in a block
constexpr Index at_once = smaller(vectors, Index{Registers::count / 4});  // with two sums each, these fill half the registers

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
#pragma GCC unroll 8
            for (Index v = 0; v < at_once; ++v) {
                Vector const f = Registers::load(values + k * block_points + v * lanes);
                x[v] += f * by.x[k];
                y[v] += f * by.y[k];
            }
        }
    }
};

// body(values of the first number, point) for every at_once vectors of points.
template <class Number, class Body>
HARMORPH_INLINE void for_each_pair(ValueBlocks<Number> const& blocks, Body const& body) noexcept {
    for (Index block = 0; block < blocks.n_blocks; ++block) {
        for (Index point = 0; point < block_points; point += at_once * lanes) {
            body(blocks.values + block * blocks.stride + point, Offset{block} * block_points + point);
        }
    }
}

template <class Number>
void multiply(ValueBlocks<Number> const& blocks, Movements const& by, PerPoint<Real> sums) noexcept {
    for_each_pair(blocks, [&](const Number* values, Offset point) __attribute__((always_inline)) {
        Pair sum;
        sum.load({sums.x, sums.y}, point);
        sum.add_products(values, blocks.n_numbers, by);
        sum.store(sums, point);
    });
}

template <class Number>
void move(ValueBlocks<Number> const& blocks, Movements const& by, PerPoint<const Real> from,
          PerPoint<Real> to) noexcept {
    for_each_pair(blocks, [&](const Number* values, Offset point) __attribute__((always_inline)) {
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

// Two sums of products in fixed point in each lane, see FixedSum; settled(): of all lanes, n_products together.
template <class Of, bool rounds = Of::rounds>
struct SumIn;

template <class Of>
struct SumIn<Of, true> {
    Words first, second;

    // The sum modulo 2^64, and in floating point: the error of the latter is far below 2^63, so the multiple of 2^64
    // that is missing in the former is known.
    HARMORPH_INLINE void add(Vector t) noexcept {
        first += Of::round(t);
        second = reinterpret_cast<Words>(reinterpret_cast<Vector>(second) + t);
    }
    HARMORPH_INLINE FixedSum settled(Index) const noexcept {
        std::uint64_t sum = 0;
        Real rough = 0;
        for (Index lane = 0; lane < lanes; ++lane) {
            sum += first[lane];
            rough += reinterpret_cast<Vector>(second)[lane];
        }
        Real const missing = (rough - static_cast<Real>(sum)) * 0x1p-64;
        std::int64_t const times = static_cast<std::int64_t>(missing + (missing < 0 ? -0.5 : 0.5));
        constexpr std::int64_t coarse_in_word = std::int64_t{1} << (64 - FixedSum::fine_bits);
        return {times * coarse_in_word + static_cast<std::int64_t>(sum >> FixedSum::fine_bits),
                static_cast<std::int64_t>(sum & FixedSum::fine_mask)};
    }
};

template <class Of>
struct SumIn<Of, false> {
    Words first, second;

    // Sums the bits of numbers rounded to the grids of FixedSum: multiples of its units, plus the bits of the grid
    // itself.
    HARMORPH_INLINE void add(Vector t) noexcept {
        Vector const on_grid = t + FixedSum::coarse_grid;
        first += reinterpret_cast<Words>(on_grid);
        second += reinterpret_cast<Words>((t - (on_grid - FixedSum::coarse_grid)) + FixedSum::fine_grid);
    }
    HARMORPH_INLINE FixedSum settled(Index n_products) const noexcept {
        std::uint64_t const times = static_cast<std::uint64_t>(n_products);
        std::uint64_t coarse = 0, fine = 0;
        for (Index lane = 0; lane < lanes; ++lane) {
            coarse += first[lane];
            fine += second[lane];
        }
        return {static_cast<std::int64_t>(coarse - times * FixedSum::bits_of_coarse_grid),
                static_cast<std::int64_t>(fine - times * FixedSum::bits_of_fine_grid)};
    }
};

using Sum = SumIn<Registers>;

// The sums of one number along x and along y.
struct SumPair {
    Sum x, y;
};

template <class Number>
void multiply_transposed(ValueBlocks<Number> const& blocks, PerPoint<const Real> by, BinaryScale::Factor unit,
                         FixedSums& total) noexcept {
    Index const n = blocks.n_numbers;
    SumPair sums[Movements::most];
    for (Index k = 0; k < n; ++k) sums[k] = SumPair{};
    for (Index block = 0; block < blocks.n_blocks; ++block) {
        const Number* const values = blocks.values + block * blocks.stride;
        Vector by_x[vectors], by_y[vectors];
#pragma GCC unroll 4
        for (Index v = 0; v < vectors; ++v) {
            by_x[v] = Registers::load(by.x + block * block_points + v * lanes) * unit.first * unit.second;
            by_y[v] = Registers::load(by.y + block * block_points + v * lanes) * unit.first * unit.second;
        }
        for (Index k = 0; k < n; ++k) {
            SumPair sum = sums[k];
#pragma GCC unroll 4
            for (Index v = 0; v < vectors; ++v) {
                Vector const f = Registers::load(values + k * block_points + v * lanes);
                sum.x.add(f * by_x[v]);
                sum.y.add(f * by_y[v]);
            }
            sums[k] = sum;
        }
    }
    for (Index k = 0; k < n; ++k) {
        total.x[k] += sums[k].x.settled(blocks.n_blocks * block_points);
        total.y[k] += sums[k].y.settled(blocks.n_blocks * block_points);
    }
}

std::uint64_t largest_bits(const Real* numbers, Index n) noexcept {
    constexpr std::uint64_t without_sign = ~(std::uint64_t{1} << 63);
    constexpr Index chains = 4;  // no number waits for the one before
    Words most[chains] = {};
    Index i = 0;
    for (; i + chains * lanes <= n; i += chains * lanes) {
#pragma GCC unroll 8
        for (Index c = 0; c < chains; ++c) {
            Words const bits = reinterpret_cast<Words>(Registers::load(numbers + i + c * lanes)) & without_sign;
            most[c] = bits > most[c] ? bits : most[c];
        }
    }
    std::uint64_t largest = 0;
    for (; i < n; ++i) largest = larger(largest, bits_of(numbers[i]) & without_sign);
    for (Words const& chain : most) {
        for (Index lane = 0; lane < lanes; ++lane) largest = larger<std::uint64_t>(largest, chain[lane]);
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
inline constexpr const ProductKernels* table<ProductKernels, Kernel::HARMORPH_SET> = &harmorph::products::HARMORPH_SET::kernels;
}  // namespace harmorph::simd
