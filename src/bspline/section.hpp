// The section of a body: the curves that are its outline, its chord, the points on normals to the
// chord.
#pragma once

#include "bspline/control_gradient.hpp"

namespace harmorph {

// What a value depends on besides points of the outline: the two ends of the chord line.
struct ChordDerivative {
    Vec2 nose, edge;
};

struct Section {
    static constexpr Index most_curves = 8;

    // To be set: curves that have been checked; the chord line, if it does not move.
    Index n_curves = 0;
    Index first_curve = 0;  // the number that curve[0] has in the caller's set
    Curve curve[most_curves];
    bool has_fixed_chord = false;
    Vec2 nose, edge;  // ends of the chord line

    // Made by connect():
    Index n_sides = 0;  // curves without a blunt base
    bool backwards[most_curves] = {};
    bool is_closed = false;  // the last end is the first
    Real sign = 1;           // of the enclosed area: -1 clockwise
    // Made by find_chord(), if the chord is that of the curves:
    bool nose_is_smooth = false;
    CurvePlace nose_place;  // where the outline is farthest from `edge`

    // Joins the curves to an outline; refuses curves whose ends do not meet. The sign is not known
    // yet.
    Status connect(Fault& fault) noexcept;
    // Needed by all that has to do with the chord; `nose_place` only if the chord is that of the
    // curves or wanted.
    Status find_chord(bool wants_nose, Fault& fault) noexcept;

    CurvePlace first_end() const noexcept { return end_of(0, false); }
    CurvePlace last_end() const noexcept { return end_of(n_sides - 1, true); }
    CurvePlace end_of(Index number,
                      bool at_end) const noexcept;  // of a curve, in the direction of the outline
    Vec2 chord() const noexcept { return edge - nose; }
    Real extent() const noexcept;  // of the control points' box

    // From derivatives by the ends of the chord line to the control points.
    void pull_chord(ChordDerivative const& by, ControlGradient const& gradient) const noexcept;
    // A value's derivatives by the point of the outline at the leading edge, and by its parameter.
    void pull_nose(Vec2 by_point, Real by_parameter,
                   ControlGradient const& gradient) const noexcept;

    // body(curve, span, low, high) for all spans of the curves from `first` to `end`, each from
    // knot to knot.
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
    Status find_nose(Fault& fault) noexcept;
};

// Two numbers without another one in between.
struct Neighbours {
    Real low, high;
};

// Where f, of different signs at low and high (or 0), changes its sign.
template <class Function>
Neighbours sign_change_between(Real low, Real high, Function const& f) noexcept {
    bool const rises = f(low) < 0;
    for (;;) {
        Real const middle = low + 0.5 * (high - low);
        if (!(middle > low && middle < high)) return {low, high};
        if ((f(middle) < 0) == rises) low = middle;
        else high = middle;
    }
}
template <class Function>
Real sign_change(Real low, Real high, Function const& f) noexcept {
    return sign_change_between(low, high, f).low;
}

}  // namespace harmorph
