#include "bspline/variables.hpp"

#include "base/angle.hpp"
#include "base/dependent_column.hpp"
#include "base/elementary.hpp"
#include "bspline/projection.hpp"
#include "bspline/quadrature.hpp"

namespace harmorph {
namespace {

// Bernstein polynomials of degree n - 1 at t: value [n], by the triangle of de Casteljau.
void bernstein(Index n, Real t, Real* value) noexcept {
    for (Index k = 0; k < n; ++k) value[k] = 0;
    if (n == 0) return;
    value[0] = 1;
    for (Index degree = 1; degree < n; ++degree) {
        for (Index k = degree; k > 0; --k) value[k] = (1 - t) * value[k] + t * value[k - 1];
        value[0] *= 1 - t;
    }
}

// I. Abbott, A. von Doenhoff, Theory of Wing Sections, 6.4; the last coefficient closes the
// trailing edge.
Real naca_half_thickness(Real t) noexcept {
    return 5 * (0.2969 * sqrt(t) + t * (-0.1260 + t * (-0.3516 + t * (0.2843 - 0.1036 * t))));
}

Real naca_camber(Real peak, Real t) noexcept {
    if (t < peak) return t * (2 * peak - t) / (peak * peak);
    return (1 - 2 * peak + t * (2 * peak - t)) / ((1 - peak) * (1 - peak));
}

}  // namespace

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
    Real in_x[most], in_y[most];
    bernstein(n_x, inside ? (point.x - low.x) / (high.x - low.x) : 0, in_x);
    bernstein(n_y, inside ? (point.y - low.y) / (high.y - low.y) : 0, in_y);
    for (Index j = 0; j < n_y; ++j) {
        for (Index i = 0; i < n_x; ++i) value[i + n_x * j] = inside ? in_x[i] * in_y[j] : 0;
    }
}

void VariableMap::lay_out(Arena& arena, Index n_control, Index n) noexcept {
    n_control_ = n_control;
    n_ = n;
    mass.lay_out(arena, n_control, n_control - 1, false);
    arena.take(wanted, Offset{n_control} * 2 * n);
    arena.take(trial, Offset{n_control} * 2 * n);
    arena.take(value, n);
    arena.take(error, 2 * n);
    arena.take(pins, n_control);
}

// Which side of the section a place of the outline is on: in the direction of the outline from the
// trailing edge to the leading edge the upper side, if the outline runs counter-clockwise.
bool VariableMap::is_upper(Section const& section, CurvePlace const& place) const noexcept {
    auto const position = [&](CurvePlace const& at) {  // curves count 1 each
        Index const c = static_cast<Index>(at.curve - section.curve);
        Real const t = (at.u - at.curve->begin()) / (at.curve->end() - at.curve->begin());
        return static_cast<Real>(c) + (section.backwards[c] ? 1 - t : t);
    };
    Real from_edge = position(place) - edge_position_,
         to_nose = position(section.nose_place) - edge_position_;
    if (from_edge < 0) from_edge += 1;  // behind the seam of a periodic curve
    if (to_nose < 0) to_nose += 1;
    return (from_edge < to_nose) == (section.sign > 0);
}

// body(place, weight): points of Gauss' rule on halves of spans, which end where the sides meet.
// Not on a blunt base.
template <class Body>
void VariableMap::for_each_sample(Section const& section, Variables const& variables,
                                  Body const& body) const noexcept {
    section.for_each_span(0, section.n_sides, [&](Index c, Index span, Real low, Real high) {
        Real breaks[5] = {low, low + 0.5 * (high - low), high};
        Index n = 3;
        auto const split = [&](Real u) {
            if (!(u > low && u < high)) return;
            Index k = n++;
            for (; breaks[k - 1] > u; --k) breaks[k] = breaks[k - 1];
            breaks[k] = u;
        };
        if (variables.needs_chord()) {
            if (section.nose_place.curve == &section.curve[c]) split(section.nose_place.u);
            if (edge_position_ > 0) split(edge_u_);
        }
        for (Index k = 0; k + 1 < n; ++k) {
            if (!(breaks[k] < breaks[k + 1])) continue;
            Gauss10::for_each(breaks[k], breaks[k + 1], [&](Real u, Real weight) {
                body(CurvePlace{&section.curve[c], span, u}, weight);
            });
        }
    });
}

// Fills `value`; by what a unit of it moves the place.
Vec2 VariableMap::evaluate(Section const& section, Variables const& variables, Vec2 point,
                           bool upper) const noexcept {
    if (!variables.needs_chord()) {
        variables.node_weights(point, value.data());
        return {1, 0};
    }
    Vec2 const chord = section.chord();
    Real const station = clamp(dot(point - section.nose, chord) / square(chord), 0.0, 1.0);
    variables.shapes(station, upper, value.data());
    return left_of(chord);
}

// Ends of curves that are one control point move as wanted, the mean of the ends they are.
void VariableMap::pin_ends(Section const& section, Variables const& variables) noexcept {
    for (Index c = 0; c < section.n_curves; ++c) {
        for (Index end = 0; end < 2; ++end) {
            bool const at_end = end == 1;
            CurvePlace const place = section.end_of(c, at_end);
            CurveBasis const basis = curve_basis_in(*place.curve, place.span, place.u, 0);
            bool const base = c >= section.n_sides;  // from the last end to the first one
            bool const upper = base ? at_end == (section.sign > 0)
                                    : variables.needs_chord() && is_upper(section, place);
            for (Index k = 0; k < basis.order; ++k) {
                if (basis.value[0][k] != 1) continue;
                Real* const row = wanted.data() + Offset{basis.control[k]} * 2 * n_;
                Real const n = pins[basis.control[k]]++;
                Vec2 const unit = evaluate(section, variables, place.point(), upper);
                for (Index j = 0; j < n_; ++j) {
                    row[2 * j] = (n * row[2 * j] + value[j] * unit.x) / (n + 1);
                    row[2 * j + 1] = (n * row[2 * j + 1] + value[j] * unit.y) / (n + 1);
                }
            }
        }
    }
}

void VariableMap::find_edge(Section const& section) noexcept {
    Curve const& curve = section.curve[0];
    edge_u_ = project(curve, section.edge).u;
    Real const t = (edge_u_ - curve.begin()) / (curve.end() - curve.begin());
    edge_position_ = section.backwards[0] ? 1 - t : t;
}

// The normal equations of the least squares.
void VariableMap::add_samples(Section const& section, Variables const& variables) noexcept {
    for_each_sample(section, variables, [&](CurvePlace const& place, Real weight) {
        CurveBasis const basis = curve_basis_in(*place.curve, place.span, place.u, 0);
        Vec2 const unit = evaluate(section, variables, place.point(),
                                   variables.needs_chord() && is_upper(section, place));
        for (Index k = 0; k < basis.order; ++k) {
            Index const i = basis.control[k];
            Real const part = weight * basis.value[0][k];
            for (Index l = 0; l < basis.order; ++l) {
                if (basis.control[l] <= i) mass.add(i, basis.control[l], part * basis.value[0][l]);
            }
            if (pins[i] > 0) continue;
            Real* const row = wanted.data() + Offset{i} * 2 * n_;
            for (Index j = 0; j < n_; ++j) {
                row[2 * j] += part * value[j] * unit.x;
                row[2 * j + 1] += part * value[j] * unit.y;
            }
        }
    });
}

// Known movements go to the right-hand sides; control points of other curves do not move.
void VariableMap::eliminate_pins() noexcept {
    auto const entry = [&](Index i, Index k) -> Real& {
        return i < k ? mass.at(k, i) : mass.at(i, k);
    };
    for (Index i = 0; i < n_control_; ++i) {
        bool const free = pins[i] == 0 && mass.at(i, i) > 0;
        for (Index k = 0; free && k < n_control_; ++k) {
            if (pins[k] == 0) continue;
            for (Index j = 0; j < 2 * n_; ++j) {
                wanted[Offset{i} * 2 * n_ + j] -= entry(i, k) * wanted[Offset{k} * 2 * n_ + j];
            }
        }
    }
    for (Index i = 0; i < n_control_; ++i) {
        for (Index k = 0; k < i; ++k) {
            if (pins[i] > 0 || pins[k] > 0) mass.at(i, k) = 0;
        }
        if (pins[i] > 0 || !(mass.at(i, i) > 0)) mass.at(i, i) = 1;
    }
}

Status VariableMap::check_independence(Fault& fault) noexcept {
    copy(trial, Span<const Real>(wanted));
    DependentColumn const dependent = find_dependent_column(trial, n_, 2);
    if (dependent.column == none) return Status::ok;
    const char* const text = dependent.is_zero ? "variable # moves no control point"
                                               : "variable # is a combination of those before";
    return fault.refuse(Status::bad_condition, text, variable_item(dependent.column));
}

void VariableMap::measure_errors(Section const& section, Variables const& variables) noexcept {
    Real total = 0;
    for_each_sample(section, variables, [&](CurvePlace const& place, Real weight) {
        CurveBasis const basis = curve_basis_in(*place.curve, place.span, place.u, 0);
        Vec2 const unit = evaluate(section, variables, place.point(),
                                   variables.needs_chord() && is_upper(section, place));
        total += weight;
        for (Index j = 0; j < n_; ++j) {
            Vec2 left = -value[j] * unit;
            for (Index k = 0; k < basis.order; ++k) {
                const Real* const pair = wanted.data() + (Offset{basis.control[k]} * n_ + j) * 2;
                left = left + basis.value[0][k] * Vec2{pair[0], pair[1]};
            }
            error[2 * j] += weight * square(left);
            error[2 * j + 1] = max(error[2 * j + 1], length(left));
        }
    });
    for (Index j = 0; j < n_; ++j) error[2 * j] = sqrt(error[2 * j] / total);
}

Status VariableMap::run(Section const& section, Variables const& variables, Fault& fault) noexcept {
    bool const has_edge_inside =
        variables.needs_chord() && section.n_sides == 1 && is_periodic(section.curve[0]);
    if (has_edge_inside) find_edge(section);
    mass.shape(n_control_, n_control_ - 1, false);
    fill(wanted, 0.0);
    fill(pins, 0.0);
    fill(error, 0.0);
    pin_ends(section, variables);
    add_samples(section, variables);
    eliminate_pins();
    Index const undetermined = mass.factor(1e-14);
    if (undetermined != none) {
        return fault.refuse(Status::bad_curve, "control point # is not determined by the outline",
                            control_point_item(undetermined));
    }
    mass.solve(wanted, 2 * n_);
    HARMORPH_TRY(check_independence(fault));
    measure_errors(section, variables);
    return Status::ok;
}

}  // namespace harmorph
