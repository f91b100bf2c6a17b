// A gradient by the control points, smoothed along the curves (Sobolev gradient):
//
//     (I + L^2 D^-1/2 K D^-1/2) s = g,   D_i = integral of N_i,   K_ij = integral of N_i' N_j',
//
// integrals and derivatives by the arc length of all curves. The matrix is symmetric and positive
// definite, so s . g > 0: -s is a direction of descent. A smoothed gradient after Jameson, with
// the lumped mass D in place of a norm that depends on the knots: A. Jameson, J. Sci. Comput. 3
// (1988) 233.
#pragma once

#include "base/arena.hpp"
#include "bspline/bspline.hpp"

namespace harmorph {

class SmoothGradient {
public:
    // n_spans: the spans between knots of all curves, empty ones counted.
    void lay_out(Arena& arena, Index n_control, Index n_spans, Index max_degree) noexcept;
    void start() noexcept;
    void add(Curve const& curve) noexcept;  // checked; each curve of the set once
    // smoothed [2 * n_control], gradient likewise, x,y pairs; the arrays may be the same.
    void solve(Real length, Real const* gradient, Real* smoothed) noexcept;

private:
    void multiply(Real factor, Span<const Vec2> p, Span<Vec2> out) const noexcept;

    Index order_ = 1, n_elements_ = 0;
    Span<Index> control_;   // [elements * order] control points of each span
    Span<Real> stiffness_;  // [elements * order^2]
    Span<Real> scale_;      // [n_control] D, then D^-1/2; 1 where no curve uses a control point
    Span<Vec2> residual_, direction_, product_, found_;
};

}  // namespace harmorph
