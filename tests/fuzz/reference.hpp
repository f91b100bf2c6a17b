// Evaluates the definitions that results have to satisfy independently of the library, slowly and
// in more digits.
#pragma once

#include "polygons.hpp"

namespace fuzz {

using Wide = long double;

// Cells with a corner whose area, divided by the lengths of its two sides, is not above `sine`; 0:
// as the header defines inverted cells, without rounding. Of divided cells the triangles and the
// turned corners count likewise.
std::int32_t inverted_cells(Judged const& judged, std::vector<Point> const& at, double sine = 0);

// Faces that have inner points in common with another face, transversally; and whether faces
// without a common end touch. The two sides of an interface do not count.
struct Crossings {
    bool crosses = false, touches = false;
};
Crossings find_crossings(Domain const& domain, std::vector<Point> const& at);

// The smallest sine of a corner at the points at + step * by: twice its area divided by the lengths
// of its edges there, or by their lengths at the beginning, if these are larger: cells may shrink
// to a point.
double smallest_sine(Judged const& judged, std::vector<Point> const& at,
                     std::vector<Point> const& by, double step);

// All basis functions of one curve at u by the recursion of Cox and de Boor, summed for each
// control point.
std::vector<double> basis_functions(hm_curves const& curves, std::int32_t curve, double u);

// The largest residual of Laplace's compact scheme for values at the points, over `inside`:
// cotangent weights, in quadrilaterals the mean of the two ways to split, in polygons the triangles
// of their division. Relative to the sum of the magnitudes of its terms, where each value counts at
// least as a thousandth of the largest one.
double laplace_residual(Domain const& domain, Judged const& judged,
                        std::vector<double> const& values, std::vector<bool> const& inside);

}  // namespace fuzz
