// Gauss' rule with 10 points: exact for polynomials up to degree 19, which moments of curves of
// degree 5 have; other functions by halving intervals until the sum does not change but for
// rounding.
#pragma once

#include "base/scalar.hpp"

namespace harmorph {

struct Gauss10 {
    static constexpr Index n = 10;
    static constexpr Real place[5] = {0.1488743389816312, 0.4333953941292472, 0.6794095682990244,
                                      0.8650633666889845, 0.9739065285171717};
    static constexpr Real weight[5] = {0.2955242247147529, 0.2692667193099964, 0.2190863625159820,
                                       0.1494513491505806, 0.0666713443086881};

    // body(u, weight) for the points of an interval; the weights' sum is high - low.
    template <class Body>
    static void for_each(Real low, Real high, Body const& body) noexcept {
        Real const half = 0.5 * (high - low), middle = low + half;
        for (Index k = 0; k < n; ++k) {
            Real const at = k % 2 == 0 ? -place[k / 2] : place[k / 2];
            body(middle + half * at, half * weight[k / 2]);
        }
    }
};

template <Index n>
struct Sums {
    Real value[n] = {};
};

// leaf(a, b) for pieces of the interval, in order, on which Gauss' rule has converged for
// integrand(u), the first n / 2 sums, each but for rounding of itself or of the sum n / 2 places
// behind it, whose integrand is not negative.
template <Index n, class Integrand, class Leaf>
void for_converged(Real low, Real high, Integrand const& integrand, Leaf const& leaf) noexcept {
    constexpr Index deepest = 12;
    auto const integral = [&](Real a, Real b) {
        Sums<n> sum;
        Gauss10::for_each(a, b, [&](Real u, Real weight) {
            Sums<n> const at = integrand(u);
            for (Index i = 0; i < n; ++i) sum.value[i] += weight * at.value[i];
        });
        return sum;
    };
    // Pieces still to do, the next one last: its length is (high - low) / 2^level.
    Index level[deepest + 2], n_open = 1;
    level[0] = 0;
    Real from = low;
    while (n_open > 0) {
        Index const its = level[--n_open];
        Real width = high - low;
        for (Index k = 0; k < its; ++k) width *= 0.5;
        Real const to = n_open == 0 ? high : from + width, middle = from + 0.5 * (to - from);
        Sums<n> const whole = integral(from, to), left = integral(from, middle),
                      right = integral(middle, to);
        bool converged = its == deepest;
        if (!converged) {
            converged = true;
            for (Index i = 0; i < n / 2; ++i) {
                Real const halves = left.value[i] + right.value[i];
                Real const about =
                    abs(left.value[i]) + abs(right.value[i]) + whole.value[n / 2 + i];
                converged = converged && abs(whole.value[i] - halves) <= 64 * epsilon * about;
            }
        }
        if (converged) {
            leaf(from, middle);
            leaf(middle, to);
            from = to;
        } else {
            level[n_open++] = its + 1;
            level[n_open++] = its + 1;
        }
    }
}

}  // namespace harmorph
