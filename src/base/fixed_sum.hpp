// Fixed-point sums of products do not depend on the order or grouping of the terms, so that any
// partition of the points and any number of threads give the same bits. Each number is rounded to a
// multiple of a fixed power of two, and the multiples are added as integers. (Rounding to a common
// grid before adding: J. Demmel, H. D. Nguyen, IEEE Trans. Comput. 64 (2015) 2060.)
//
// A number t with |t| < 2^63 becomes the integer nearest to t, at a tie the even one; the result
// depends on t alone. If the processor has no instruction for that, t is split into two integers:
// coarse, the multiple of 2^31 nearest to t, and fine, the integer nearest to the remainder. Adding
// 1.5 * 2^52 units to t does the rounding: the lowest bits of that sum are the multiple. A sum of
// up to 2^30 numbers cannot overflow; the error is at most 1/2 for each of them.
#pragma once

#include "base/scalar.hpp"
#include "base/span.hpp"

namespace harmorph {

// The sum is coarse * 2^31 + fine; equal sums may be split differently.
struct FixedSum {
    static constexpr int fine_bits = 31;
    static constexpr std::uint64_t fine_mask = (std::uint64_t{1} << fine_bits) - 1;
    static constexpr Real coarse_grid = 0x1.8p+83, fine_grid = 0x1.8p+52;
    static constexpr std::uint64_t bits_of_coarse_grid = 0x4528000000000000,
                                   bits_of_fine_grid = 0x4338000000000000;

    std::int64_t coarse = 0, fine = 0;

    FixedSum& operator+=(FixedSum other) noexcept {
        coarse += other.coarse;
        fine += other.fine;
        return *this;
    }
    // Returns the sum in units of 2^63. Only bits below the spacing of numbers of that size are
    // lost.
    Real value() const noexcept {
        constexpr std::int64_t low_word = 0xffffffff;
        std::int64_t const carried = coarse + (fine >> fine_bits),
                           rest = fine & static_cast<std::int64_t>(fine_mask);
        Real const whole =
            static_cast<Real>(carried >> 32) + static_cast<Real>(carried & low_word) * 0x1p-32;
        return whole + static_cast<Real>(rest) * 0x1p-63;
    }
};

// Collects the largest magnitude of some numbers. Infinities are larger than all finite numbers,
// and NaN is larger than infinities.
class LargestMagnitude {
public:
    void include(Real x) noexcept { include_bits(bits_of(x) & ~sign); }
    void include(Span<const Real> numbers) noexcept {
        // Four independent maxima hide the latency of the comparisons.
        constexpr Size lanes = 4;
        std::uint64_t bits[lanes] = {};
        Size k = 0;
        for (; k + lanes <= numbers.size(); k += lanes) {
#pragma GCC unroll 8
            for (Size lane = 0; lane < lanes; ++lane) {
                bits[lane] = max(bits[lane], bits_of(numbers[k + lane]) & ~sign);
            }
        }
        for (std::uint64_t const lane_bits : bits) include_bits(lane_bits);
        for (; k < numbers.size(); ++k) include(numbers[k]);
    }
    void merge(LargestMagnitude const& others) noexcept { include_bits(others.bits_); }
    void include_bits(std::uint64_t without_sign) noexcept { bits_ = max(bits_, without_sign); }
    Real value() const noexcept {
        Real out;
        std::memcpy(&out, &bits_, sizeof out);
        return out;
    }

private:
    static constexpr std::uint64_t sign = std::uint64_t{1} << 63;
    std::uint64_t bits_ = 0;
};

// A power of two by which numbers are divided so that they are below 1.
struct BinaryScale {
    // Bounds of the exponent for one number: 2^63 divided by a smaller power would overflow.
    static constexpr Index min_exponent = -950, max_exponent = 1023;
    static constexpr Index not_finite = 2147483647;
    Index exponent = min_exponent;

    // Returns the smallest e >= min_exponent such that |x| < 2^e; for infinities and NaN, returns
    // not_finite.
    static Index exponent_above(Real x) noexcept {
        if (!is_finite(x)) return not_finite;
        Index const field = static_cast<Index>(bits_of(x) >> 52 & 0x7ff);
        return max(min_exponent, field - 1022);
    }
    // Returns the scale for products of numbers up to a with numbers up to b. The power of two is
    // at most 2 a b, unless a or b is tiny.
    static BinaryScale of_products(Real a, Real b) noexcept {
        BinaryScale const scale_a{exponent_above(a)}, scale_b{exponent_above(b)};
        if (!scale_a.finite() || !scale_b.finite() ||
            scale_a.exponent + scale_b.exponent > max_exponent)
            return {not_finite};
        return {scale_a.exponent + scale_b.exponent -
                (scale_a.down(a) * scale_b.down(b) < 0.5 ? 1 : 0)};
    }
    // Returns the scale with which down() converts these products into numbers below 2^63, as
    // FixedSum takes them.
    BinaryScale units() const noexcept { return {exponent - 63}; }
    bool finite() const noexcept { return exponent != not_finite; }
    bool valid() const noexcept {
        return !finite() || (exponent >= 2 * min_exponent - 1 && exponent <= max_exponent);
    }

    // down() divides by 2^exponent and up() multiplies by it, both in two steps, because one power
    // of two may exceed the range of numbers.
    struct Factor {
        Real first, second;
        Real times(Real x) const noexcept { return x * first * second; }
    };
    Factor downwards() const noexcept {
        return {power(-exponent / 2), power(exponent / 2 - exponent)};
    }
    Real down(Real x) const noexcept { return downwards().times(x); }
    Real up(Real x) const noexcept {
        return x * power(exponent / 2) * power(exponent - exponent / 2);
    }

private:
    static Real power(Index e) noexcept {
        std::uint64_t const bits = static_cast<std::uint64_t>(e + 1023) << 52;
        Real out;
        std::memcpy(&out, &bits, sizeof out);
        return out;
    }
};

}  // namespace harmorph
