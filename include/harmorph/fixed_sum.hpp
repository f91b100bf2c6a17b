// Sums of products that do not depend on order or grouping, so that any partition of the points and any number of
// threads give the same bits: numbers are rounded to multiples of fixed powers of two, one by one, and then added as
// integers. (Rounding to a common grid before adding: J. Demmel, H. D. Nguyen, IEEE Trans. Comput. 64 (2015) 2060.)
//
// A number t with |t| <= 1 becomes two integers: coarse, the multiple of 2^-32 nearest to it, and fine, the multiple of
// 2^-64 nearest to what is left. Adding 1.5 * 2^52 units to t does the rounding: the lowest bits of that sum are the
// multiple. Ties go to an even multiple by t alone, whatever was added before. A sum of up to 2^30 numbers cannot
// overflow; its error is at most 2^-65 for each of them.
#pragma once

#include "harmorph/scalar.hpp"

namespace harmorph {

struct FixedSum {
    static constexpr Real coarse_grid = 0x1.8p+20;  // 1.5 * 2^52 units of 2^-32
    static constexpr Real fine_grid = 0x1.8p-12;    // and of 2^-64

    std::int64_t coarse = 0, fine = 0;

    FixedSum& operator+=(FixedSum other) noexcept {
        coarse += other.coarse;
        fine += other.fine;
        return *this;
    }
    // Of the sum itself all but the last bits are kept: they are below its own spacing.
    Real value() const noexcept {
        constexpr std::int64_t low_word = 0xffffffff;
        constexpr Real word = 4294967296.0;
        std::int64_t const carried = coarse + (fine >> 32);
        Real const whole = static_cast<Real>(carried >> 32) + static_cast<Real>(carried & low_word) / word;
        return whole + static_cast<Real>(fine & low_word) / (word * word);
    }
};

// The largest magnitude of some numbers; infinities, and above them NaN, are larger than all others.
class LargestMagnitude {
public:
    void include(Real x) noexcept { bits_ = larger(bits_, bits_of(x) & ~sign); }
    Real value() const noexcept {
        Real out;
        std::memcpy(&out, &bits_, sizeof out);
        return out;
    }

private:
    static constexpr std::uint64_t sign = std::uint64_t{1} << 63;
    std::uint64_t bits_ = 0;
};

// A power of two that brings numbers below 1.
struct BinaryScale {
    static constexpr Index least = -1000, most = 1023;  // of one number; smaller ones are far below the sums' grids
    static constexpr Index not_finite = 2147483647;
    Index exponent = least;

    // An e such that |x| < 2^e, the smallest one but for tiny numbers; not_finite of infinities and NaN.
    static Index exponent_above(Real x) noexcept {
        if (!is_finite(x)) return not_finite;
        Index const field = static_cast<Index>(bits_of(x) >> 52 & 0x7ff);
        return larger(least, field - 1022);
    }
    // Of products of numbers below 2^a and 2^b.
    static BinaryScale of_products(Index a, Index b) noexcept {
        bool const finite = a != not_finite && b != not_finite && a + b <= most;
        return {finite ? a + b : not_finite};
    }
    bool finite() const noexcept { return exponent != not_finite; }
    bool valid() const noexcept { return !finite() || (exponent >= 2 * least && exponent <= most); }

    // x / 2^exponent, and back; in two steps, as one power of two might not be a number.
    Real down(Real x) const noexcept { return x * power(-exponent / 2) * power(exponent / 2 - exponent); }
    Real up(Real x) const noexcept { return x * power(exponent / 2) * power(exponent - exponent / 2); }

private:
    static Real power(Index e) noexcept {
        std::uint64_t const bits = static_cast<std::uint64_t>(e + 1023) << 52;
        Real out;
        std::memcpy(&out, &bits, sizeof out);
        return out;
    }
};

}  // namespace harmorph
