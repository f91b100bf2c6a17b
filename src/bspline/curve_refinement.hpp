// Describes and checks the refinement of one of several curves: knots to be inserted, or a degree
// to be raised by one. tests/bspline/test_finer_curves.cpp covers this file.
#pragma once

#include "bspline/bspline.hpp"

namespace harmorph {

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

}  // namespace harmorph
