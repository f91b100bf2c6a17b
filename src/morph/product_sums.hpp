// Sums of products in fixed point with the registers of one instruction set. product.cpp compiles
// this file for each set. tests/morph/test_product.cpp covers this file.

namespace harmorph::products::HARMORPH_SET {
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

}  // namespace
}  // namespace harmorph::products::HARMORPH_SET
