#include "bspline/bspline.hpp"

#include "base/vec2.hpp"

#include <limits>

namespace harmorph {
namespace {

Status check_knots(Curve const& curve, Index number, Fault& fault) noexcept {
    auto const refuse = [&](const char* sentence, Index knot) {
        return fault.refuse(Status::bad_curve, sentence, knot_item(knot), curve_item(number),
                            curve.knots[knot]);
    };
    Index const n_knots = curve.n_indices + curve.degree + 1;
    for (Index k = 0; k < n_knots; ++k) {
        if (!is_finite(curve.knots[k])) return refuse("knot # of curve @ is not finite", k);
        if (k > 0 && curve.knots[k] < curve.knots[k - 1])
            return refuse("knot # of curve @ is smaller than the knot before it", k);
    }
    // Within these limits no quotient of basis functions or of their derivatives overflows.
    constexpr Real longest = 1e100, shortest = 1e-100, min_fraction = 1e-18;
    if (!is_at_most(curve.knots[0], longest) || !is_at_most(curve.knots[n_knots - 1], longest) ||
        !(curve.end() - curve.begin() >= shortest))
        return refuse(
            "the range of curve @, which begins at knot #, has no length, or a knot is beyond "
            "1e100",
            curve.degree);
    Real const min_interval = min_fraction * (curve.knots[n_knots - 1] - curve.knots[0]);
    for (Index k = 1; k < n_knots; ++k) {
        Real const interval = curve.knots[k] - curve.knots[k - 1];
        if (interval > 0 && interval < min_interval)
            return refuse(
                "knot # of curve @ differs from the knot before it by less than 1e-18 of the range "
                "of all knots",
                k);
    }

    Index fold = 0;
    for (Index k = 0; k < n_knots; ++k) {
        fold = k > 0 && curve.knots[k] == curve.knots[k - 1] ? fold + 1 : 1;
        bool const at_end = curve.knots[k] == curve.begin() || curve.knots[k] == curve.end();
        if (fold > curve.degree + (at_end ? 1 : 0))
            return refuse("knot # of curve @ is repeated more often than the degree allows", k);
    }
    return Status::ok;
}

Status check_control(Curve const& curve, Index number, Fault& fault) noexcept {
    if (curve.indices == nullptr && curve.n_indices > curve.n_control)
        return fault.refuse(Status::bad_curve,
                            "curve # uses @ control points in order, but there are fewer",
                            curve_item(number), plain(curve.n_indices));
    for (Index k = 0; k < curve.n_indices; ++k) {
        // control_point() cannot be used, because the subtraction may overflow for a wrong index.
        Offset const c =
            curve.indices != nullptr ? static_cast<Offset>(curve.indices[k]) - curve.index_base : k;
        if (c < 0 || c >= curve.n_control)
            return fault.refuse(
                Status::bad_curve, "index # of curve @ is ~, but there is no such control point",
                entry_item(k), curve_item(number), static_cast<Real>(curve.indices[k]));
        Index const point = static_cast<Index>(c);
        Vec2 const place{curve.control[2 * point], curve.control[2 * point + 1]};
        if (!is_finite(place.x) || !is_finite(place.y))
            return fault.refuse(Status::bad_curve,
                                "control point # of curve @ has a coordinate that is not finite",
                                control_point_item(point), curve_item(number));
        if (!is_coordinate(place))
            return fault.refuse(Status::bad_curve,
                                "control point # of curve @ has the coordinate ~, which is larger "
                                "than the limit of 1e100",
                                control_point_item(point), curve_item(number),
                                abs(place.x) > abs(place.y) ? place.x : place.y);
        if (curve.weights != nullptr && !is_between(1e-10, curve.weights[point], 1e10))
            return fault.refuse(
                Status::bad_curve,
                "the weight of control point # of curve @ is ~, but must be between "
                "1e-10 and 1e10",
                control_point_item(point), curve_item(number), curve.weights[point]);
    }
    return Status::ok;
}

// Makes the basis functions rational (equation 4.8). For R_k = w_k N_k / W, Leibniz' rule gives
// R_k^(d) = (w_k N_k^(d) - sum_i binomial(d, i) W^(i) R_k^(d - i)) / W.
void make_rational(Curve const& curve, Index span, Index n_derivatives,
                   CurveBasis& basis) noexcept {
    Real sum[max_order] = {};  // W and its derivatives
    for (Index d = 0; d <= n_derivatives; ++d)
        for (Index k = 0; k < basis.order; ++k) {
            basis.value[d][k] *= curve.weight(span - curve.degree + k);
            sum[d] += basis.value[d][k];
        }
    for (Index d = 0; d <= n_derivatives; ++d)
        for (Index k = 0; k < basis.order; ++k) {
            Real numerator = basis.value[d][k];
            Real binomial = 1;
            for (Index i = 1; i <= d; ++i) {
                binomial *= static_cast<Real>(d - i + 1) / static_cast<Real>(i);
                numerator -= binomial * sum[i] * basis.value[d - i][k];
            }
            basis.value[d][k] = numerator / sum[0];
        }
}

// Computes values and derivatives of degree j from those of degree j - 1. The quotients (u - a) / h
// and (b - u) / h are exactly 1 and 0 at clamped ends, where algorithm A2.2 of Piegl & Tiller may
// have a rounding error.
void raise_degree(Curve const& curve, Index span, Real u, Index j, Index n_derivatives,
                  CurveBasis& basis) noexcept {
    // Function r of degree j - 1 is not 0 in [low[r], high[r]].
    Real const* const low = curve.knots + span + 1 - j;
    Real const* const high = curve.knots + span + 1;
    for (Index d = min(n_derivatives, j); d >= 1; --d) {  // equation 2.7
        Real carried = 0;
        for (Index r = 0; r < j; ++r) {
            Real const slope = static_cast<Real>(j) * basis.value[d - 1][r] / (high[r] - low[r]);
            basis.value[d][r] = carried - slope;
            carried = slope;
        }
        basis.value[d][j] = carried;
    }
    Real carried = 0;
    for (Index r = 0; r < j; ++r) {  // equation 2.5
        Real const value = basis.value[0][r];
        Real const width = high[r] - low[r];
        basis.value[0][r] = carried + (high[r] - u) / width * value;
        carried = (u - low[r]) / width * value;
    }
    basis.value[0][j] = carried;
}

}  // namespace

Status check_curve(Curve const& curve, Index number, Fault& fault) noexcept {
    if (curve.degree < 1 || curve.degree > max_degree)
        return fault.refuse(Status::bad_curve,
                            "curve # has degree @, but the degree must be 1 to 5",
                            curve_item(number), plain(curve.degree));
    if (curve.n_indices <= curve.degree ||
        curve.n_indices > std::numeric_limits<Index>::max() - max_order)
        return fault.refuse(Status::bad_curve,
                            "curve # has @ control points, but must have more than its degree",
                            curve_item(number), plain(curve.n_indices));
    HARMORPH_TRY(check_knots(curve, number, fault));
    return check_control(curve, number, fault);
}

Index knot_span(Curve const& curve, Real u) noexcept {
    Index low = curve.degree;
    Index high = curve.n_indices;
    if (!(u < curve.end())) {
        while (curve.knots[high - 1] == curve.end()) --high;
        return high - 1;
    }
    while (high - low > 1) {  // knots[low] <= u < knots[high]
        Index const middle = low + (high - low) / 2;
        if (u < curve.knots[middle]) high = middle;
        else low = middle;
    }
    return low;
}

CurveBasis curve_basis_in(Curve const& curve, Index span, Real u, Index n_derivatives) noexcept {
    CurveBasis basis;
    basis.order = curve.degree + 1;
    for (Index k = 0; k < basis.order; ++k)
        basis.control[k] = curve.control_point(span - curve.degree + k);
    basis.value[0][0] = 1;
    for (Index j = 1; j <= curve.degree; ++j) raise_degree(curve, span, u, j, n_derivatives, basis);
    if (curve.weights != nullptr) make_rational(curve, span, n_derivatives, basis);
    return basis;
}

CurveBasis curve_basis(Curve const& curve, Real u, Index n_derivatives) noexcept {
    u = clamp(u, curve.begin(), curve.end());
    return curve_basis_in(curve, knot_span(curve, u), u, n_derivatives);
}

void curve_point_in(Curve const& curve, Index span, Real u, Index n_derivatives,
                    Vec2* out) noexcept {
    CurveBasis const basis = curve_basis_in(curve, span, u, n_derivatives);
    for (Index d = 0; d <= n_derivatives; ++d) {
        out[d] = {};
        for (Index k = 0; k < basis.order; ++k)
            out[d] = out[d] + basis.value[d][k] * curve.point(span - curve.degree + k);
    }
}

void curve_point(Curve const& curve, Real u, Index n_derivatives, Vec2* out) noexcept {
    u = clamp(u, curve.begin(), curve.end());
    curve_point_in(curve, knot_span(curve, u), u, n_derivatives, out);
}

}  // namespace harmorph
