// Integrates by Gauss' rule with 10 points, which is exact for polynomials up to degree 19; moments
// of curves of degree 5 need this degree. For other functions, intervals are halved until the sum
// changes by rounding only. tests/bspline/test_section_measures.cpp covers this file.
#pragma once

#include "base/scalar.hpp"

namespace harmorph {

struct Gauss10 {
    static constexpr Index n = 10;
    static constexpr Real place[5] = {0.1488743389816312, 0.4333953941292472, 0.6794095682990244,
                                      0.8650633666889845, 0.9739065285171717};
    static constexpr Real weight[5] = {0.2955242247147529, 0.2692667193099964, 0.2190863625159820,
                                       0.1494513491505806, 0.0666713443086881};

    // Calls body(u, weight) for the points of an interval; the sum of the weights is high - low.
    template <class Body>
    static void for_each(Real low, Real high, Body const& body) noexcept {
        Real const half_width = 0.5 * (high - low), middle = low + half_width;
        for (Index k = 0; k < n; ++k) {
            Real const at = k % 2 == 0 ? -place[k / 2] : place[k / 2];
            body(middle + half_width * at, half_width * weight[k / 2]);
        }
    }
};

template <Index n>
struct Sums {
    Real value[n] = {};
};

// Divides the interval until Gauss' rule has converged, and calls leaf(a, b) for the subintervals
// in order. integrand(u) has n values; the first n / 2 integrals must converge. Integral i has
// converged if halving the subinterval changes it only by rounding of itself or of integral n / 2 +
// i, whose integrand must not be negative and states the size of the terms.
template <Index n, class Integrand, class Leaf>
void for_converged(Real low, Real high, Integrand const& integrand, Leaf const& leaf) noexcept {
    constexpr Index max_level = 12;
    auto const integral = [&](Real a, Real b) {
        Sums<n> sum;
        Gauss10::for_each(a, b, [&](Real u, Real weight) {
            Sums<n> const at = integrand(u);
            for (Index i = 0; i < n; ++i) sum.value[i] += weight * at.value[i];
        });
        return sum;
    };
    // Subintervals that remain, the next one last; each has the length (high - low) / 2^level.
    Index level[max_level + 2], n_open = 1;
    level[0] = 0;
    Real from = low;
    while (n_open > 0) {
        Index const now = level[--n_open];
        Real width = high - low;
        for (Index k = 0; k < now; ++k) width *= 0.5;
        Real const to = n_open == 0 ? high : from + width, middle = from + 0.5 * (to - from);
        Sums<n> const whole = integral(from, to), left = integral(from, middle),
                      right = integral(middle, to);
        bool converged = now == max_level;
        if (!converged) {
            converged = true;
            for (Index i = 0; i < n / 2; ++i) {
                Real const both = left.value[i] + right.value[i];
                Real const size = abs(left.value[i]) + abs(right.value[i]) + whole.value[n / 2 + i];
                converged = converged && abs(whole.value[i] - both) <= 64 * epsilon * size;
            }
        }
        if (converged) {
            leaf(from, middle);
            leaf(middle, to);
            from = to;
        } else {
            level[n_open++] = now + 1;
            level[n_open++] = now + 1;
        }
    }
}

}  // namespace harmorph
