#include "bspline/variables.hpp"

#include "base/dependent_column.hpp"
#include "base/elementary.hpp"
#include "base/vec2.hpp"
#include "bspline/projection.hpp"
#include "bspline/quadrature.hpp"

namespace harmorph {
namespace {

// NACA's four-digit sections at a station t: half of the thickness of 1 chord, and the camber line
// of 1 chord with its largest camber at the station `peak`. The formula is that of I. Abbott, A.
// von Doenhoff, Theory of Wing Sections, 6.4; the last coefficient is changed so that the trailing
// edge is closed.
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

void VariableMap::lay_out(Arena& arena, Index n_control, Index n) noexcept {
    n_control_ = n_control;
    n_ = n;
    mass.lay_out(arena, n_control, n_control - 1, false);
    arena.take(wanted, Offset{n_control} * 2 * n);
    arena.take(trial, Offset{n_control} * 2 * n);
    arena.take(at_point, 2 * Offset{n});
    arena.take(error, 2 * n);
    arena.take(pins, n_control);
}

// Returns whether a place of the outline is on the upper side of the section. If the outline runs
// counter-clockwise, the upper side leads from the trailing edge to the leading edge.
bool VariableMap::is_upper(Section const& section, CurvePlace const& place) const noexcept {
    // The position grows by 1 along each curve.
    auto const position = [&](CurvePlace const& at) {
        Index const c = static_cast<Index>(at.curve - section.curve);
        Real const t = (at.u - at.curve->begin()) / (at.curve->end() - at.curve->begin());
        return static_cast<Real>(c) + (section.backwards[c] ? 1 - t : t);
    };
    Real from_trailing_edge = position(place) - trailing_edge_position_,
         to_leading_edge = position(section.leading_edge_place) - trailing_edge_position_;
    // The place may lie after the seam of a periodic curve.
    if (from_trailing_edge < 0) from_trailing_edge += 1;
    if (to_leading_edge < 0) to_leading_edge += 1;
    return (from_trailing_edge < to_leading_edge) == (section.sign > 0);
}

// Calls body(place, weight) for the points of Gauss' rule on halves of spans, which are also
// divided at the leading and trailing edge. A blunt base has no samples.
template <class Body>
void VariableMap::for_each_sample(Section const& section, OutlineMovements const& movements,
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
        if (movements.needs_chord) {
            if (section.leading_edge_place.curve == &section.curve[c])
                split(section.leading_edge_place.u);
            if (trailing_edge_position_ > 0) split(trailing_edge_u_);
        }
        for (Index k = 0; k + 1 < n; ++k) {
            if (!(breaks[k] < breaks[k + 1])) continue;
            Gauss10::for_each(breaks[k], breaks[k + 1], [&](Real u, Real weight) {
                body(CurvePlace{&section.curve[c], span, u}, weight);
            });
        }
    });
}

OutlineMovements VariablesOfSection::movements() const noexcept {
    auto const write = [](const void* context, Vec2 point, bool upper, Real* pairs) {
        auto const& own = *static_cast<const VariablesOfSection*>(context);
        Index const n = own.variables.count();
        Real* const value = pairs + n;  // pair j is written after value j is read
        Vec2 unit{1, 0};
        if (own.variables.needs_chord()) {
            Vec2 const chord = own.section.chord();
            Real const station =
                clamp(dot(point - own.section.leading_edge, chord) / square(chord), 0.0, 1.0);
            own.variables.shapes(station, upper, value);
            unit = left_of(chord);
        } else {
            own.variables.node_weights(point, value);
        }
        for (Index j = 0; j < n; ++j) {
            Vec2 const movement = value[j] * unit;
            pairs[2 * j] = movement.x;
            pairs[2 * j + 1] = movement.y;
        }
    };
    return {variables.count(), variables.needs_chord(), this, write};
}

// Writes the movements at a place of the outline to `at_point`.
void VariableMap::evaluate(Section const& section, OutlineMovements const& movements,
                           CurvePlace const& place) const noexcept {
    movements.write(movements.context, place.point(),
                    movements.needs_chord && is_upper(section, place), at_point.data());
}

// A control point that is the end of a curve moves exactly as the variables say; if it is the end
// of several curves, it gets the mean movement of these ends.
void VariableMap::pin_ends(Section const& section, OutlineMovements const& movements) noexcept {
    for (Index c = 0; c < section.n_curves; ++c) {
        for (Index end = 0; end < 2; ++end) {
            bool const at_end = end == 1;
            CurvePlace const place = section.end_of(c, at_end);
            CurveBasis const basis = curve_basis_in(*place.curve, place.span, place.u, 0);
            bool const base = c >= section.n_sides;
            bool const upper = base ? at_end == (section.sign > 0)
                                    : movements.needs_chord && is_upper(section, place);
            for (Index k = 0; k < basis.order; ++k) {
                if (basis.value[0][k] != 1) continue;
                Real* const row = wanted.data() + Offset{basis.control[k]} * 2 * n_;
                Real const n = pins[basis.control[k]]++;  // the number of ends so far
                movements.write(movements.context, place.point(), upper, at_point.data());
                for (Index j = 0; j < n_; ++j) {
                    row[2 * j] = (n * row[2 * j] + at_point[2 * j]) / (n + 1);
                    row[2 * j + 1] = (n * row[2 * j + 1] + at_point[2 * j + 1]) / (n + 1);
                }
            }
        }
    }
}

void VariableMap::find_trailing_edge(Section const& section) noexcept {
    Curve const& curve = section.curve[0];
    trailing_edge_u_ = project(curve, section.trailing_edge).u;
    Real const t = (trailing_edge_u_ - curve.begin()) / (curve.end() - curve.begin());
    trailing_edge_position_ = section.backwards[0] ? 1 - t : t;
}

// Adds up the normal equations of the least squares.
void VariableMap::add_samples(Section const& section, OutlineMovements const& movements) noexcept {
    for_each_sample(section, movements, [&](CurvePlace const& place, Real weight) {
        CurveBasis const basis = curve_basis_in(*place.curve, place.span, place.u, 0);
        evaluate(section, movements, place);
        for (Index k = 0; k < basis.order; ++k) {
            Index const i = basis.control[k];
            Real const weighted = weight * basis.value[0][k];
            for (Index l = 0; l < basis.order; ++l) {
                if (basis.control[l] <= i)
                    mass.add(i, basis.control[l], weighted * basis.value[0][l]);
            }
            if (pins[i] > 0) continue;
            Real* const row = wanted.data() + Offset{i} * 2 * n_;
            for (Index j = 0; j < n_; ++j) {
                row[2 * j] += weighted * at_point[2 * j];
                row[2 * j + 1] += weighted * at_point[2 * j + 1];
            }
        }
    });
}

// Moves the known movements to the right-hand sides. Control points of other curves do not move.
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
                                               : "variable # is a linear combination of the "
                                                 "variables before it: the curve has too few "
                                                 "control points in the region that they move";
    return fault.refuse(Status::bad_condition, text, variable_item(dependent.column));
}

void VariableMap::measure_errors(Section const& section,
                                 OutlineMovements const& movements) noexcept {
    Real total = 0;
    for_each_sample(section, movements, [&](CurvePlace const& place, Real weight) {
        CurveBasis const basis = curve_basis_in(*place.curve, place.span, place.u, 0);
        evaluate(section, movements, place);
        total += weight;
        for (Index j = 0; j < n_; ++j) {
            Vec2 difference{-at_point[2 * j], -at_point[2 * j + 1]};
            for (Index k = 0; k < basis.order; ++k) {
                const Real* const pair = wanted.data() + (Offset{basis.control[k]} * n_ + j) * 2;
                difference = difference + basis.value[0][k] * Vec2{pair[0], pair[1]};
            }
            error[2 * j] += weight * square(difference);
            error[2 * j + 1] = max(error[2 * j + 1], length(difference));
        }
    });
    for (Index j = 0; j < n_; ++j) error[2 * j] = sqrt(error[2 * j] / total);
}

Status VariableMap::run(Section const& section, OutlineMovements const& movements,
                        Fault& fault) noexcept {
    bool const has_trailing_edge_inside =
        movements.needs_chord && section.n_sides == 1 && is_periodic(section.curve[0]);
    if (has_trailing_edge_inside) find_trailing_edge(section);
    mass.shape(n_control_, n_control_ - 1, false);
    fill(wanted, 0.0);
    fill(pins, 0.0);
    fill(error, 0.0);
    pin_ends(section, movements);
    add_samples(section, movements);
    eliminate_pins();
    Index const undetermined = mass.factor(1e-14);
    if (undetermined != none) {
        return fault.refuse(Status::bad_curve, "control point # is not determined by the outline",
                            control_point_item(undetermined));
    }
    mass.solve(wanted, 2 * n_);
    measure_errors(section, movements);
    return Status::ok;
}

}  // namespace harmorph
