// Collects the derivatives of a value by the control points (reverse differentiation): the caller
// adds the derivative of the value by a point of a curve, or by a derivative of the curve at this
// point. tests/bspline/test_section_measures.cpp covers this file.
#pragma once

#include "bspline/bspline.hpp"

namespace harmorph {

// A parameter of a curve, and the span whose polynomials are evaluated there.
struct CurvePlace {
    const Curve* curve = nullptr;
    Index span = none;
    Real u = 0;

    void derivatives(Index n, Vec2* out) const noexcept { curve_point_in(*curve, span, u, n, out); }
    Vec2 point() const noexcept {
        Vec2 out;
        derivatives(0, &out);
        return out;
    }
};

class ControlGradient {
public:
    // Without an array, add() does nothing.
    ControlGradient() noexcept = default;
    explicit ControlGradient(Real* xy) noexcept : xy_(xy) {}  // [2 * n_control]

    bool wanted() const noexcept { return xy_ != nullptr; }
    // by [n + 1] are the derivatives of the value by C(u), C'(u), ..., up to the n-th derivative.
    void add(CurvePlace const& place, Index n, const Vec2* by) const noexcept {
        if (!wanted()) return;
        CurveBasis const basis = curve_basis_in(*place.curve, place.span, place.u, n);
        for (Index k = 0; k < basis.order; ++k) {
            Real* const to = xy_ + 2 * basis.control[k];
            for (Index d = 0; d <= n; ++d) {
                to[0] += basis.value[d][k] * by[d].x;
                to[1] += basis.value[d][k] * by[d].y;
            }
        }
    }
    void add(CurvePlace const& place, Vec2 by) const noexcept { add(place, 0, &by); }

private:
    Real* xy_ = nullptr;
};

}  // namespace harmorph
