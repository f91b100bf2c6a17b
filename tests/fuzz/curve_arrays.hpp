// Curves of a random problem: those of its walls, or those that points slide along.
#pragma once

#include "input.hpp"

#include <harmorph.h>

#include <vector>

namespace fuzz {

struct Point;

// The arrays of the caller, and the struct that points to them.
struct CurveArrays {
    std::vector<double> control, weights;
    std::vector<std::vector<double>> knots;
    std::vector<std::vector<std::int32_t>> indices;
    std::vector<hm_curve> curve;
    hm_curves view{};

    // Through or near these points: a fitted curve, or the polygon of the points. is_loop: the last
    // point is followed by the first one.
    void add(std::vector<Point> const& points, bool is_loop, Input& input);
    // Fills `view`, when all curves are there; sometimes with weights.
    void finish(Input& input);

private:
    bool add_fit(std::vector<Point> const& points, bool is_loop, Input& input);
    void add_polygon(std::vector<Point> const& points, bool is_loop);
    void add_curve(std::int32_t degree, std::vector<std::int32_t> const& curve_indices,
                   std::vector<double> const& curve_knots);
};

}  // namespace fuzz
