// The outline of an airfoil as samples of its B-spline, from the trailing edge round to it again.
#pragma once

#include "basics/geometry.hpp"
#include "harmorph.h"

#include <cstdint>
#include <vector>

namespace cli {

struct AirfoilLoop {
    std::vector<Point> at;
    std::vector<double>
        u;  // rises; of a periodic curve beyond the last knot, where the first span comes again
    std::vector<double>
        part;  // of the arc: 0 at the beginning, 1 at the leading edge, 2 at the end
    Point leading = {0, 0}, trailing = {0, 0};
    bool is_periodic = false;  // else its ends are one control point, or two
    bool is_blunt = false;     // two ends

    AirfoilLoop(const hm_curves& curves, std::int32_t curve);
    bool runs_clockwise() const;
    void reverse();  // the parameter no longer belongs to the points
    double u_at(double part) const;

    double within(double u) const;  // the same parameter between the first and the last knot

private:
    void measure();
    double begin_ = 0, end_ = 0;  // of the parameter
};

}  // namespace cli
