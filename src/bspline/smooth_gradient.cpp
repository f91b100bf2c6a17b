#include "bspline/smooth_gradient.hpp"

#include "bspline/quadrature.hpp"

namespace harmorph {
namespace {

constexpr Real tolerance = 1e-15;  // the residual relative to the gradient

Real total(Span<const Vec2> a, Span<const Vec2> b) noexcept {
    Real sum = 0;
    for (Index i = 0; i < a.count(); ++i) sum += dot(a[i], b[i]);
    return sum;
}

}  // namespace

void SmoothGradient::lay_out(Arena& arena, Index n_control, Index n_spans, Index degree) noexcept {
    order_ = degree + 1;
    Offset const entries = Offset{n_spans} * order_;
    arena.take(control_, entries);
    arena.take(stiffness_, entries * order_);
    arena.take(scale_, n_control);
    arena.take(residual_, n_control);
    arena.take(direction_, n_control);
    arena.take(product_, n_control);
    arena.take(found_, n_control);
}

void SmoothGradient::start() noexcept {
    n_elements_ = 0;
    fill(scale_, Real(0));
}

// A point at which the derivative of the curve is 0 is omitted, because there are no derivatives by
// the arc length there.
void SmoothGradient::add(Curve const& curve) noexcept {
    for (Index span = curve.degree; span < curve.n_indices; ++span) {
        Real const low = curve.knots[span], high = curve.knots[span + 1];
        if (!(low < high)) continue;
        Index* const control = control_.data() + Offset{n_elements_} * order_;
        Real* const matrix = stiffness_.data() + Offset{n_elements_} * order_ * order_;
        for (Index a = 0; a < order_ * order_; ++a) matrix[a] = 0;
        for (Index a = 0; a < order_; ++a) control[a] = none;
        ++n_elements_;
        Gauss10::for_each(low, high, [&](Real u, Real weight) {
            CurveBasis const basis = curve_basis_in(curve, span, u, 1);
            Vec2 c[2];
            curve_point_in(curve, span, u, 1, c);
            Real const speed = length(c[1]);
            if (!(speed > 0)) return;
            for (Index a = 0; a < basis.order; ++a) {
                control[a] = basis.control[a];
                scale_[basis.control[a]] += weight * speed * basis.value[0][a];
                for (Index b = 0; b < basis.order; ++b)
                    matrix[a * order_ + b] +=
                        weight / speed * basis.value[1][a] * basis.value[1][b];
            }
        });
    }
}

// Computes out = (I + factor D^-1/2 K D^-1/2) p.
void SmoothGradient::multiply(Real factor, Span<const Vec2> p, Span<Vec2> out) const noexcept {
    copy(out, p);
    for (Index e = 0; e < n_elements_; ++e) {
        const Index* const control = control_.data() + Offset{e} * order_;
        const Real* const matrix = stiffness_.data() + Offset{e} * order_ * order_;
        for (Index a = 0; a < order_; ++a) {
            if (control[a] == none) continue;
            Vec2 sum;
            for (Index b = 0; b < order_; ++b) {
                if (control[b] == none) continue;
                sum = sum + (matrix[a * order_ + b] * scale_[control[b]]) * p[control[b]];
            }
            out[control[a]] = out[control[a]] + (factor * scale_[control[a]]) * sum;
        }
    }
}

// Solves by conjugate gradients; x and y have the same matrix. The gradient is divided by its
// largest entry, so that squares neither overflow nor underflow.
void SmoothGradient::solve(Real length, Real const* gradient, Real* smoothed) noexcept {
    Index const n = scale_.count();
    Real largest = 0;
    for (Index i = 0; i < 2 * n; ++i) largest = max(largest, abs(gradient[i]));
    if (length == 0 || largest == 0) {
        for (Index i = 0; i < 2 * n; ++i) smoothed[i] = gradient[i];
        return;
    }
    for (Real& d : scale_) d = d > 0 ? 1 / sqrt(d) : 1;
    for (Index i = 0; i < n; ++i) {
        residual_[i] = direction_[i] = {gradient[2 * i] / largest, gradient[2 * i + 1] / largest};
        found_[i] = {};
    }
    Real const factor = length * length;
    Real square = total(residual_, residual_);
    Real const enough = tolerance * tolerance * square;
    for (Index times = 0; times < 20 * n + 100 && square > enough; ++times) {
        multiply(factor, direction_, product_);
        Real const step = square / total(direction_, product_);
        for (Index i = 0; i < n; ++i) {
            found_[i] = found_[i] + step * direction_[i];
            residual_[i] = residual_[i] - step * product_[i];
        }
        Real const before = square;
        square = total(residual_, residual_);
        for (Index i = 0; i < n; ++i)
            direction_[i] = residual_[i] + (square / before) * direction_[i];
    }
    for (Index i = 0; i < n; ++i) {
        smoothed[2 * i] = largest * found_[i].x;
        smoothed[2 * i + 1] = largest * found_[i].y;
    }
}

}  // namespace harmorph
