// Evaluates the definitions that results have to satisfy independently of the library, slowly and
// in more digits.
#pragma once

#include "polygons.hpp"

#include <algorithm>
#include <cmath>

namespace fuzz {

using Wide = long double;

// The place of a face that is nearest to a point.
struct Foot {
    Wide distance, t, x, y;  // x, y: from the foot to the point
    Wide length;             // of the face
};
inline Foot foot_on(Point a, Point b, Point p) {
    Wide const dx = Wide(b.x) - a.x, dy = Wide(b.y) - a.y, px = Wide(p.x) - a.x,
               py = Wide(p.y) - a.y, length = std::hypot(dx, dy);
    Wide const ux = length > 0 ? dx / length : 0, uy = length > 0 ? dy / length : 0;
    Wide const along = std::max(Wide(0), std::min(length, ux * px + uy * py));
    Wide const x = px - along * ux, y = py - along * uy;
    return {std::hypot(x, y), length > 0 ? along / length : 0, x, y, length};
}

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
