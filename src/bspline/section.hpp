// A section of a body consists of the curves of the outline and the chord.
// tests/bspline/test_section_measures.cpp covers this file.
#pragma once

#include "bspline/bspline.hpp"

namespace harmorph {

// Collects the derivatives of a value by the control points (reverse differentiation): the caller
// adds the derivative of the value by a point of a curve, or by a derivative of the curve at this
// point.

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

// The derivatives of a value by the two ends of the chord line.
struct ChordDerivative {
    Vec2 leading_edge, trailing_edge;
};

struct Section {
    static constexpr Index max_curves = 8;

    // The caller of connect() sets the curves, which must have been checked, and the ends of the
    // chord line, if the chord does not follow the curves.
    Index n_curves = 0;
    Index first_curve = 0;  // the number of curve[0] in the caller's set
    Curve curve[max_curves];
    bool has_fixed_chord = false;
    Vec2 leading_edge, trailing_edge;  // the ends of the chord line

    // connect() sets these:
    Index n_sides = 0;  // the number of curves without a blunt base
    bool backwards[max_curves] = {};
    bool is_closed = false;  // whether the last end is the first end

    // area_moments() sets this: 1 if the outline is counter-clockwise, -1 if clockwise.
    Real sign = 1;

    // find_chord() sets these if it finds the leading edge of the curves:
    bool leading_edge_is_smooth = false;
    CurvePlace leading_edge_place;  // the place farthest from trailing_edge

    // Whether find_chord() has found the chord and the leading edge.
    bool has_chord = false, has_leading_edge = false;

    // Joins the curves to an outline; refuses curves whose ends do not meet.
    Status connect(Fault& fault) noexcept;
    // Must be called before functions that use the chord. Finds leading_edge_place only if the
    // chord follows the curves, or if wants_leading_edge is true.
    Status find_chord(bool wants_leading_edge, Fault& fault) noexcept;

    CurvePlace first_end() const noexcept { return end_of(0, false); }
    CurvePlace last_end() const noexcept { return end_of(n_sides - 1, true); }
    // Returns an end of a curve, in the direction of the outline.
    CurvePlace end_of(Index number, bool at_end) const noexcept;
    Vec2 chord() const noexcept { return trailing_edge - leading_edge; }
    // Returns the larger side of the bounding box of the control points.
    Real extent() const noexcept;

    // Adds to the gradient, given the derivatives of a value by the ends of the chord line.
    void pull_chord(ChordDerivative const& by, ControlGradient const& gradient) const noexcept;
    // Adds to the gradient, given the derivatives of a value by the point of the outline at the
    // leading edge and by the parameter of this point.
    void pull_leading_edge(Vec2 by_point, Real by_parameter,
                           ControlGradient const& gradient) const noexcept;

    // Calls body(curve, span, low, high) for all spans of the curves first .. end - 1, where low
    // and high are the knots at the ends of the span.
    template <class Body>
    void for_each_span(Index first, Index end, Body const& body) const noexcept {
        for (Index c = first; c < end; ++c) {
            for (Index span = curve[c].degree; span < curve[c].n_indices; ++span) {
                Real const low = curve[c].knots[span], high = curve[c].knots[span + 1];
                if (low < high) body(c, span, low, high);
            }
        }
    }

private:
    Status find_leading_edge(Fault& fault) noexcept;
    bool refine_leading_edge(Real low, Real high) noexcept;
};

// Two neighbouring floating-point numbers.
struct Neighbours {
    Real low, high;
};

// Finds where f changes sign; f must have different signs, or be 0, at low and high. Each round
// looks on both sides of where the line through both ends has its zero, and bisects where f is far
// from that line, so that the number of rounds is at most that of bisection.
template <class Function>
Neighbours sign_change_between(Real low, Real high, Function const& f) noexcept {
    Real distance = 1e-3;  // of the two places from the zero, in parts of the interval
    Real at_low = f(low), at_high = f(high);
    bool const rises = at_low < 0;
    auto const look = [&](Real at) {
        if (!(at > low && at < high)) return;
        Real const value = f(at);
        bool const is_before = (value < 0) == rises;
        (is_before ? low : high) = at;
        (is_before ? at_low : at_high) = value;
    };
    for (;;) {
        Real const width = high - low, middle = low + 0.5 * width;
        if (!(middle > low && middle < high)) return {low, high};
        bool const differs = at_low != at_high;
        Real const zero = differs ? low + width * (at_low / (at_low - at_high)) : low;
        Real const step = max(distance * width, epsilon * max(abs(low), abs(high)));
        if (zero > low && zero < high) {
            look(zero - step);
            look(zero + step);
        }
        bool const is_near = high - low < 3 * step;
        distance = is_near ? max(distance * distance, epsilon) : 1e-3;
        if (!(high - low < 0.5 * width)) look(low + 0.5 * (high - low));
    }
}
template <class Function>
Real sign_change(Real low, Real high, Function const& f) noexcept {
    return sign_change_between(low, high, f).low;
}

}  // namespace harmorph
