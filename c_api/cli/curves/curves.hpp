// B-spline curves over common control points, in memory and in files.
#pragma once

#include "files/output_file.hpp"
#include "files/text_file.hpp"

#include <harmorph.h>

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

namespace cli {

struct Curve {
    std::int32_t degree = 0;
    std::int32_t closed = HM_OPEN;      // HM_OPEN, HM_TIED or HM_PERIODIC
    std::vector<std::int32_t> indices;  // control points with their repeats, from 0
    std::vector<double> knots;          // as many as indices, and degree + 1 more
};

struct Curves {
    std::vector<double> control;  // x,y pairs
    std::vector<double> weights;  // one per control point, or empty
    std::vector<Curve> curves;

    std::int32_t points() const { return static_cast<std::int32_t>(control.size() / 2); }
    void append(const Curves& others);  // renumbers the control points of `others`
};

// Returns the indices of a curve that uses n points in order. If the curve is closed, the first
// points are repeated at the end.
std::vector<std::int32_t> default_indices(std::int32_t n, std::int32_t degree, std::int32_t closed);

// Tells whether the indices agree with curve.closed.
bool closes(const Curve& curve);

Curves copied(const hm_curves& from);

const char* closed_name(std::int32_t closed);  // "open", "tied", "periodic"

// Curves as an argument of the library. The view points into the curves, which must not change.
class CurvesView {
public:
    explicit CurvesView(const Curves& curves);
    CurvesView(const CurvesView&) = delete;
    const hm_curves* get() const { return &view_; }

private:
    std::vector<hm_curve> curve_;
    hm_curves view_;
};

// Curves that conditions point to (hm_condition.along). The addresses of the curves and of their
// view must not change.
struct CurveSet {
    explicit CurveSet(const Curves& given) : curves(given), view(curves) {}
    const Curves curves;
    const CurvesView view;
};

// An example of a curve file; `#` starts a comment, and control points are numbered from 1:
//
//     degree 3
//     closed tied       # open; tied: the first point is also the last one; periodic: the first 3
//                       # points (as many as the degree) are repeated at the end; they may also be
//                       # written again there, and then count as points
//     points 20         # 20 lines x y
//     knots 25          # as many values as control points with repeats, and degree + 1 more
//     indices 21        # if the points are not used in order: the numbers of the points
//     weights 20        # if the curve is rational
//     curve             # another curve over the same points: degree, closed, indices, knots

Curves read_curves(const std::string& path);
bool is_curve_file(const TextFile& file);                       // by the first word of the content
Curves read_curves(const std::string& path, std::string text);  // reads `text` instead of the file
void write_curves(std::ostream& out, const Curves& curves);

bool ends_with(const std::string& path, const std::string& ending);  // ignores the case
// The extension of the path selects the format.
void write_curve_file(OutputFiles& files, const std::string& path, const Curves& curves);

}  // namespace cli
