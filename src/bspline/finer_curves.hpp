// The same curves with more control points: knots inserted into one of them, or its degree raised
// by one.
//
// A new control point is the polar form (blossom) of the old curve at consecutive knots of the new
// one: with the degree kept, f(t[j+1], .., t[j+p]); with degree p + 1, the mean of f over all
// choices of p of the p + 1 knots. L. Ramshaw, Comput. Aided Geom. Des. 6 (1989) 323. Rational
// curves: the same for w P and w.
#pragma once

#include "base/arena.hpp"
#include "bspline/bspline.hpp"

namespace harmorph {

// The coefficients, of the control points of one span that is not empty, of the polar form at
// `degree` arguments: value [degree + 1]. At equal arguments the basis functions without weights.
// Returns the largest number on the way.
Real polar_form(Curve const& curve, Index span, const Real* argument, Real* value) noexcept;

// Do the first control points come again at the end, with knots that repeat with the period end() -
// begin()?
bool has_periodic_points(Curve const& curve) noexcept;

struct CurveRefinement {
    Index curve = 0;        // which is changed
    bool elevates = false;  // the degree is raised; otherwise the knots are inserted
    Span<const Real> knots;

    Status check(Curve const& old, Fault& fault) const noexcept;
    Index most_knots(Curve const& old) const noexcept;  // of the changed curve
};

struct FinerCounts {
    Index n_control = 0, n_curves = 0, most_knots = 0;  // most_knots: of the changed curve
    Offset other_indices = 0, other_knots = 0;
    bool rational = false;

    void include(Curve const& old, bool changes, CurveRefinement const& refinement) noexcept;
    Offset most_control() const noexcept { return Offset{n_control} + most_knots; }
};

struct FinerCurves {
    Index n_control = 0, old_control = 0;
    Span<Curve> curve;  // [n_curves] in: the old ones, out: the new ones, views of these arrays
    Span<Real> control,
        weights;        // new ones, in the caller's index base; weights empty: not rational
    Span<Real> matrix;  // [n_control * old_control] rows of new control points

    void lay_out(Arena& arena, FinerCounts const& counts) noexcept;
    // The refinement has been checked.
    Status run(CurveRefinement const& refinement, Fault& fault) noexcept;

private:
    void insert(Curve const& old, Span<const Real> knots) noexcept;
    void repeat_each_knot(Curve const& old) noexcept;
    void choose_window(Curve const& old, Index degree) noexcept;
    Real coefficients(Curve const& old, Index span, const Real* argument, Real* sum) const noexcept;
    void put_row(Curve const& old, Index position) noexcept;
    void number_changed(Curve const& old) noexcept;
    void number_others(Index changed) noexcept;
    void publish(Index changed, Curve const& old) noexcept;

    Span<Real> all_;  // knots of the changed curve, and more beyond its ends
    Index n_all_ = 0;
    Span<Real> knots_, other_knots_;
    Span<Index> indices_, other_indices_;
    Span<Index> number_;  // [old_control] the new control point that is the old one, or none
    Span<std::uint8_t> of_changed_, of_others_;  // [old_control] which curves use it
    Index degree_ = 0, n_positions_ = 0,
          period_ = 0;  // period_: positions after which control points repeat, or 0
};

}  // namespace harmorph
