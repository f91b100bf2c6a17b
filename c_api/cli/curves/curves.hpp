// B-spline curves over common control points, in memory.
#pragma once

#include "harmorph.h"

#include <cstdint>
#include <string>
#include <vector>

namespace cli {

struct Curve {
    std::int32_t degree = 0;
    std::int32_t closed = HM_OPEN;      // HM_OPEN, HM_TIED or HM_PERIODIC
    std::vector<std::int32_t> indices;  // control points with their repeats, from 0
    std::vector<double> knots;          // as many, and degree + 1 more
};

struct Curves {
    std::vector<double> control;  // x,y pairs
    std::vector<double> weights;  // one per control point, or empty
    std::vector<Curve> curves;

    std::int32_t points() const { return static_cast<std::int32_t>(control.size() / 2); }
    void append(const Curves& others);  // their control points' numbers go on after these
};

// The order of n points in a curve that uses each in turn and closes as said: the first of them
// stand again at its end.
std::vector<std::int32_t> default_indices(std::int32_t n, std::int32_t degree, std::int32_t closed);

// Do repeated indices close the curve as said?
bool closes(const Curve& curve);

// Out of the library's arrays.
Curves copied(const hm_curves& from);

const char* closed_name(std::int32_t closed);  // "open", "tied", "periodic"

// The library's view of curves. It points into them: they must stay as they are.
class CurvesView {
public:
    explicit CurvesView(const Curves& curves);
    CurvesView(const CurvesView&) = delete;
    const hm_curves* get() const { return &view_; }

private:
    std::vector<hm_curve> curve_;
    hm_curves view_;
};

// Curves that conditions point to (hm_condition.along): they and their view stay where they are.
struct CurveSet {
    explicit CurveSet(const Curves& its) : curves(its), view(curves) {}
    const Curves curves;
    const CurvesView view;
};

}  // namespace cli
