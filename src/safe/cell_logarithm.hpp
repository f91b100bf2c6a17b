// Minus the logarithm of the quality of a cell, and its derivatives by the points of the cell.
#pragma once

#include "morph/quality.hpp"
#include "safe/corner_map.hpp"

namespace harmorph {

// The quality sqrt(f_size) f_skew has a kink where the area is that of the reference. `blur` rounds
// it off: |c| with c = ln(area / reference) becomes sqrt(c^2 + blur^2) - blur.
// Returns minus the logarithm, and infinity if the cell is inverted.
Real minus_log_quality(CellMeasure const& measure, Real reference_area, Real blur) noexcept;

// How the energy depends on the minus logarithm y of the quality of a cell, to the second order: it
// changes by slope dy + curvature / 2 dy^2.
struct LogarithmWeights {
    Real slope, curvature;
    // The second derivative of the energy gets at least this curvature for relative deformations
    // of the cell, and `damping` is added to it.
    Real least, damping;
    Real blur;
};

// The functions below set `form` to the gradient of y (not multiplied by the slope) and to a
// positive definite Hessian of the energy. Positive definite: in a frame in which the cell is an
// equilateral triangle or a square, negative curvatures change their signs. Neither a movement nor
// a Hessian of this kind depends on the shape of the cell, so thin cells move together with the
// thick ones beside them. The cell is valid.
void differentiate_cell(CellShape const& shape, Real reference_area,
                        LogarithmWeights const& weights, CellForm<3>& form) noexcept;
void differentiate_cell(CellShape const& shape, Real reference_area,
                        LogarithmWeights const& weights, CellForm<4>& form) noexcept;

// A polygon is the sum of its pieces and its convex corners. The Hessian of each part is such that
// the sum is not below that of the polygon.
struct PolygonMeasures {
    Real area, reference_area;
    Real inverse_sines;  // the sum over all convex corners
};
void differentiate_piece(CellShape const& shape, PolygonMeasures const& polygon,
                         LogarithmWeights const& weights, CellForm<3>& form) noexcept;
void differentiate_corner(CellShape const& shape, PolygonMeasures const& polygon,
                          LogarithmWeights const& weights, CellForm<3>& form) noexcept;

}  // namespace harmorph
