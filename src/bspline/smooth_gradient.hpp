// Smooths a gradient g by the control points along the curves. The smoothed gradient s (Sobolev
// gradient) is the solution of
//
//     (I + L^2 D^-1/2 K D^-1/2) s = g,   D_i = integral of N_i,   K_ij = integral of N_i' N_j',
//
// where integrals and derivatives are by the arc length of all curves. The matrix is symmetric and
// positive definite, so s . g > 0 and -s is a direction of descent. The smoothing is that of A.
// Jameson, J. Sci. Comput. 3 (1988) 233, with the lumped mass D in place of a norm that depends on
// the knots.
#pragma once

#include "base/arena.hpp"
#include "bspline/bspline.hpp"

namespace harmorph {

class SmoothGradient {
public:
    // n_spans is the number of spans between knots of all curves; empty spans count. degree is the
    // largest degree.
    void lay_out(Arena& arena, Index n_control, Index n_spans, Index degree) noexcept;
    void start() noexcept;
    // Adds a curve, which must have been checked. Each curve of the set is added once.
    void add(Curve const& curve) noexcept;
    // gradient and smoothed [2 * n_control] are pairs x, y, and may be the same array.
    void solve(Real length, Real const* gradient, Real* smoothed) noexcept;

private:
    void multiply(Real factor, Span<const Vec2> p, Span<Vec2> out) const noexcept;

    Index order_ = 1, n_elements_ = 0;
    Span<Index> control_;   // [elements * order] the control points of each span
    Span<Real> stiffness_;  // [elements * order^2]
    // [n_control] D at first, then D^-1/2, or 1 if no curve uses a control point.
    Span<Real> scale_;
    Span<Vec2> residual_, direction_, product_, found_;
};

}  // namespace harmorph
