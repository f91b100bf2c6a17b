// Writers of curve files for CAD programs and for Fortran. The curves are written as B-splines with
// all knots.
#pragma once

#include "curves/curves.hpp"

#include <iosfwd>

namespace cli {

// IGES 5.3: an entity 126 (rational B-spline curve) for each curve, in the plane z = 0.
void write_iges(std::ostream& out, const Curves& curves);

// STEP (ISO 10303-21, AP 203): a wireframe of B_SPLINE_CURVE_WITH_KNOTS, which are also
// RATIONAL_B_SPLINE_CURVE if the control points have weights.
void write_step(std::ostream& out, const Curves& curves);

// Fortran namelists: &control_points (n, xy(2, n), and weights(n) if the curves are rational), then
// for each curve &curve (degree, closed, n_indices, indices, knots); indices are counted from 1.
void write_namelist(std::ostream& out, const Curves& curves);

}  // namespace cli
