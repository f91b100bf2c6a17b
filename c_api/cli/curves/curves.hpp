// B-spline curves over common control points.
#pragma once

#include <harmorph.h>

#include <cstdint>
#include <deque>
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

// Curves as an argument of the library. Messages of the library then count curves, control points
// and knots from 1, as the program does. The view points into the curves, which must not change.
class CurvesView {
public:
    explicit CurvesView(const Curves& curves);
    CurvesView(const CurvesView&) = delete;
    const hm_curves* get() const { return &view_; }

private:
    std::deque<std::vector<std::int32_t>> indices_;  // of each curve, from 1
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

}  // namespace cli
