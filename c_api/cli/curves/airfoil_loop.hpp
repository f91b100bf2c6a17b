// The outline of an airfoil as points of its B-spline, from the trailing edge round the section and
// back.
#pragma once

#include "basics/geometry.hpp"
#include "harmorph.h"

#include <cstdint>
#include <vector>

namespace cli {

struct AirfoilLoop {
    std::vector<Point> at;
    std::vector<double> u;  // parameters, rising; in a periodic curve they exceed the last knot
    std::vector<double>
        part;  // arc length: 0 at the beginning, 1 at the leading edge, 2 at the end
    Point leading = {0, 0}, trailing = {0, 0};
    bool is_periodic = false;  // otherwise the ends are one control point, or two
    bool is_blunt = false;     // the ends are two points

    AirfoilLoop(const hm_curves& curves, std::int32_t curve);
    bool runs_clockwise() const;
    void reverse();  // afterwards u no longer belongs to the points
    double u_at(double part) const;

    double within(double u) const;  // returns the parameter between the first and the last knot

private:
    void measure();
    double begin_ = 0, end_ = 0;  // first and last parameter
};

}  // namespace cli
