// The series of the exponential function, for one number and for several at a time.
// tests/morph/test_cell_bounds.cpp covers this file.
#pragma once

namespace harmorph {

// The sum of both numbers is log 2 to more digits than one number holds.
inline constexpr double log_2_high = 0.693147180369123816490,
                        log_2_low = 1.90821492927058770002e-10;

// Returns e^r for |r| <= 0.35, with a relative error of a few units in the last place. Number is a
// Real, or a vector of them, so the result is a reference.
template <class Number>
__attribute__((always_inline)) inline void exponential_series(Number const& r,
                                                              Number& result) noexcept {
    Number const s = r * r;
    Number const even =
        1 + s * (1.0 / 2 + s * (1.0 / 24 +
                                s * (1.0 / 720 + s * (1.0 / 40320 + s * (1.0 / 3628800 +
                                                                         s * (1.0 / 479001600))))));
    Number const odd =
        1 + s * (1.0 / 6 +
                 s * (1.0 / 120 +
                      s * (1.0 / 5040 +
                           s * (1.0 / 362880 + s * (1.0 / 39916800 + s * (1.0 / 6227020800))))));
    result = even + r * odd;
}

}  // namespace harmorph
