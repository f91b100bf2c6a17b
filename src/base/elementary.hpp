// Computes logarithms, exponentials, powers and sines from series, because <cmath> would need a
// mathematics library at link time. Relative errors are a few units in the last place.
#pragma once

#include "base/scalar.hpp"

namespace harmorph {

// Returns the natural logarithm of a normal number x > 0. With x = 2^e m and sqrt(1/2) <= m <
// sqrt(2), log m = 2 artanh((m - 1) / (m + 1)).
inline Real logarithm(Real x) noexcept {
    constexpr Real log_2 = 0.6931471805599453;
    Real power = power_of_two_at(x);
    Real m = x / power;
    if (m > 1.4142135623730951) {
        m *= 0.5;
        power *= 2;
    }
    Index const e = static_cast<Index>(bits_of(power) >> 52) - 1023;
    Real const t = (m - 1) / (m + 1), s = t * t;  // s < 0.0295
    Real sum = 0;
    for (Index k = 21; k >= 1; k -= 2) sum = sum * s + 1.0 / k;
    return static_cast<Real>(e) * log_2 + 2 * t * sum;
}

// Returns e^x for x <= 700; the result is 0 below x = -700.
inline Real exponential(Real x) noexcept {
    // The sum of both numbers is log 2 to more digits than one number holds.
    constexpr Real high = 0.693147180369123816490, low = 1.90821492927058770002e-10;
    if (x < -700) return 0;
    Real const n = static_cast<Real>(static_cast<Index>(x / (high + low) + (x < 0 ? -0.5 : 0.5)));
    Real const r = (x - n * high) - n * low;  // |r| <= 0.35
    Real sum = 1;
    for (Index k = 14; k >= 1; --k) sum = 1 + r / k * sum;
    std::uint64_t const bits = static_cast<std::uint64_t>(static_cast<Index>(n) + 1023) << 52;
    Real power;
    std::memcpy(&power, &bits, sizeof power);
    return sum * power;
}

// Returns x^y for x >= 0; 0^0 is 1.
inline Real power(Real x, Real y) noexcept {
    if (y == 0 || x == 1) return 1;
    if (!(x >= 1e-300)) return 0;
    return exponential(clamp(y * logarithm(x), -701.0, 700.0));
}

// Returns sin(pi x) for 0 <= x <= 1.
inline Real sine_of_pi(Real x) noexcept {
    Real const t = 3.141592653589793 * (x > 0.5 ? 1 - x : x), s = t * t;
    Real sum = 1;
    for (Index k = 20; k >= 2; k -= 2) sum = 1 - s / static_cast<Real>(k * (k + 1)) * sum;
    return t * sum;
}

}  // namespace harmorph
