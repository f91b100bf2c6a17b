// The explicit four-stage Runge-Kutta scheme of the paper's iteration, dF/dt = R(F):
//   F(k) = F(0) + alpha_k dt R(F(k-1)), k = 1 .. 4, and F(4) is the new F.
// tests/multigrid/test_full_approximation.cpp covers this file.
#pragma once

#include "base/types.hpp"

namespace harmorph {

// These coefficients are usual in agglomeration multigrid of second order. They come from M.-H.
// Lallemand, Etude de schemas Runge-Kutta a 4 pas pour la resolution multigrille des equations
// d'Euler 2D, INRIA 1988, as quoted by others. alpha_4 = 1 and alpha_3 = 1/2 give the order; the
// others were chosen for damping.
inline constexpr Index stages = 4;
inline constexpr Real stage_coefficient[stages] = {0.11, 0.2766, 0.5, 1.0};

// For R = -lambda F one step multiplies F by g(lambda dt), g(x) = 1 - x + x^2 / 2 - 0.1383 x^3 +
// 0.01521 x^4. |g| < 1 for x below 5.2. Below damping_limit, which the library chooses, |g| is at
// most 1/2 from x = 0.7 on, so that the largest eigenvalues are damped, too.
inline constexpr Real damping_limit = 4.3;

}  // namespace harmorph
