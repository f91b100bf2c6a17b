// Keeps the curves along which boundary points slip in the block of a basis.
// tests/boundary/test_slip_along.cpp covers this file.
#pragma once

#include "base/arena.hpp"
#include "bspline/bspline.hpp"

namespace harmorph {

// The curves follow each other in the order of the analysis. Curves that follow each other and have
// common control points share the copies of these.
struct KeptCurves {
    struct Counts {
        Index curves = 0, indices = 0, knots = 0, control = 0, weights = 0;
        Index reserved = 0;  // The counts are written and compared as bytes.
    };
    struct Shape {
        Index degree, n_indices, first_index, first_knot;
        Index first_control, n_control, rational, reserved;
    };
    Span<Shape> shape;    // [curves]
    Span<Index> indices;  // Control points count from first_control.
    Span<Real> knots;
    Span<Real> control;  // [2 * control]
    Span<Real> weights;  // [control], or empty if no curve is rational

    static Counts count(Span<const Curve> curves) noexcept;
    void lay_out(Arena& arena, Counts const& counts) noexcept;
    void copy_from(Span<const Curve> curves) const noexcept;
    void copy_from(KeptCurves const& other) const noexcept;
    Curve curve(Index number) const noexcept;
    // Tells whether the curves n .. n + count - 1 exist and have common control points.
    bool is_set(Index n, Index count) const noexcept;
    // Tells whether the data agree with the counts and all curves are well-formed.
    bool fit() const noexcept;

private:
    // Calls visit(number, first_control, is_new) for each curve; is_new tells whether its control
    // points are others than those of the curve before. Returns the number of control points.
    template <class Visit>
    static Index for_each(Span<const Curve> curves, Visit const& visit) noexcept;
};

}  // namespace harmorph
