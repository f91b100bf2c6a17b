// Refines one of several curves without changing its shape: knots are inserted, or the degree is
// raised by one.
//
// A new control point is the polar form (blossom) f of the old curve at consecutive knots of the
// new curve. If the degree p does not change, the point is f(t[j+1], .., t[j+p]); with degree p + 1
// it is the mean of f over all choices of p of the p + 1 knots. L. Ramshaw, Comput. Aided Geom.
// Des. 6 (1989) 323. For rational curves the formulas hold for w P and w.
#pragma once

#include "base/arena.hpp"
#include "bspline/bspline.hpp"

namespace harmorph {

// Describes and checks the refinement of one of several curves: knots to be inserted, or a degree
// to be raised by one.

// Returns whether the first control points are repeated at the end, and the knots have the period
// end() - begin().
bool has_periodic_points(Curve const& curve) noexcept;

struct CurveRefinement {
    Index curve = 0;        // the curve to be changed
    bool elevates = false;  // whether the degree is raised; otherwise the knots are inserted
    Span<const Real> knots;

    Status check(Curve const& old, Fault& fault) const noexcept;
    // Returns an upper bound of the number of knots of the changed curve.
    Index max_knots(Curve const& old) const noexcept;
};

// Computes the polar form at `degree` arguments, as coefficients of the control points of one span
// that is not empty: value [degree + 1]. If all arguments are equal, the coefficients are the basis
// functions without weights. Returns the largest intermediate number, which bounds rounding errors.
Real polar_form(Curve const& curve, Index span, const Real* argument, Real* value) noexcept;

struct FinerCounts {
    Index n_control = 0, n_curves = 0, max_knots = 0;
    Offset other_indices = 0, other_knots = 0;
    bool rational = false;

    void include(Curve const& old, bool changes, CurveRefinement const& refinement) noexcept;
    Offset max_control() const noexcept { return Offset{n_control} + max_knots; }
};

struct FinerCurves {
    Index n_control = 0, old_control = 0;
    Span<Curve> curve;  // [n_curves] the old curves; run() replaces them by views of these arrays
    Span<Real> control, weights;  // of the new control points; weights are empty if not rational
    Span<Real> matrix;            // [n_control * old_control] one row for each new control point

    void lay_out(Arena& arena, FinerCounts const& counts) noexcept;
    // The refinement must have been checked.
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

    Span<Real> all_;  // knots of the changed curve, and further knots beyond its ends
    Index n_all_ = 0;
    Span<Real> knots_, other_knots_;
    Span<Index> indices_, other_indices_;
    Span<Index> number_;  // [old_control] the new number of an unchanged control point, or none
    // [old_control] Whether the changed curve and the other curves use each control point.
    Span<std::uint8_t> of_changed_, of_others_;
    Index degree_ = 0, n_positions_ = 0;
    Index period_ = 0;  // the number of positions after which control points repeat, or 0
};

}  // namespace harmorph
