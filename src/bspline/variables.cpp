#include "bspline/variables.hpp"

#include "base/elementary.hpp"

namespace harmorph {
namespace {

// The formula is that of I. Abbott, A. von Doenhoff, Theory of Wing Sections, 6.4; the last
// coefficient is changed so that the trailing edge is closed.
Real naca_half_thickness(Real t) noexcept {
    return 5 * (0.2969 * sqrt(t) + t * (-0.1260 + t * (-0.3516 + t * (0.2843 - 0.1036 * t))));
}

Real naca_camber(Real peak, Real t) noexcept {
    if (t < peak) return t * (2 * peak - t) / (peak * peak);
    return (1 - 2 * peak + t * (2 * peak - t)) / ((1 - peak) * (1 - peak));
}

}  // namespace

void bernstein(Index n, Real t, Real* value) noexcept {
    for (Index k = 0; k < n; ++k) value[k] = 0;
    if (n == 0) return;
    value[0] = 1;
    for (Index degree = 1; degree < n; ++degree) {
        for (Index k = degree; k > 0; --k) value[k] = (1 - t) * value[k] + t * value[k - 1];
        value[0] *= 1 - t;
    }
}

Real Variables::peak(Index k) const noexcept {
    if (peaks != nullptr) return peaks[k];
    if (kind == VariableKind::naca4) return 0.4;
    bool const upper = k < n_upper;
    Index const n = upper ? n_upper : n_lower, place = upper ? k : k - n_upper;
    return (2 * static_cast<Real>(place) + 1) / (2 * static_cast<Real>(n));
}

void Variables::shapes(Real station, bool upper, Real* value) const noexcept {
    Index const n = count();
    for (Index j = 0; j < n; ++j) value[j] = 0;
    Index const first = upper || kind == VariableKind::naca4 ? 0 : n_upper;
    Index const end = upper || kind == VariableKind::naca4 ? n_upper : n;
    switch (kind) {
        case VariableKind::ffd: break;
        case VariableKind::cst: {
            Real const shape_class =
                power(station, leading_exponent) * power(1 - station, trailing_exponent);
            bernstein(end - first, station, value + first);
            for (Index j = first; j < end; ++j) value[j] *= shape_class;
            break;
        }
        case VariableKind::hicks_henne:
            for (Index j = first; j < end; ++j) {
                Real const at = min(power(station, logarithm(0.5) / logarithm(peak(j))), 1.0);
                value[j] = power(sine_of_pi(at), width);
            }
            break;
        case VariableKind::naca4:
            for (Index j = 0; j < n_upper; ++j) value[j] = naca_camber(peak(j), station);
            value[n_upper] = (upper ? 1 : -1) * naca_half_thickness(station);
            break;
    }
}

void Variables::node_weights(Vec2 point, Real* value) const noexcept {
    Index const n_x = degree_x + 1, n_y = degree_y + 1;
    bool const inside =
        point.x >= low.x && point.x <= high.x && point.y >= low.y && point.y <= high.y;
    Real in_x[max_count], in_y[max_count];
    bernstein(n_x, inside ? (point.x - low.x) / (high.x - low.x) : 0, in_x);
    bernstein(n_y, inside ? (point.y - low.y) / (high.y - low.y) : 0, in_y);
    for (Index j = 0; j < n_y; ++j) {
        for (Index i = 0; i < n_x; ++i) value[i + n_x * j] = inside ? in_x[i] * in_y[j] : 0;
    }
}

}  // namespace harmorph
