// The smooth outline through the points of an airfoil, as many points in order.
#pragma once

#include "bspline/airfoil_line.hpp"
#include "bspline/curve_ends.hpp"
#include "bspline/point_spline.hpp"
#include "bspline/unit_points.hpp"

namespace harmorph {

struct AirfoilSamples {
    AirfoilLine line;     // in units of the points; without the straight base of a blunt section
    UnitPoints points;    // the given points
    Course course;        // how the outline closes, and which of the points are on the base
    Index n_corners = 0;  // inside the line

    // At least min_samples samples, and every given point is one of them.
    void lay_out(Arena& arena, Index n_points, Index min_samples) noexcept;
    Index max_samples() const noexcept { return max_samples_; }
    Status take(Points given, Index n, bool is_loop, Fault& fault) noexcept;
    // A closed outline begins at the corner, without corners at the sample, that lies farthest in
    // this direction: the trailing edge.
    void begin_at_farthest(Vec2 direction) noexcept;

private:
    void gather(Index n) noexcept;
    void sample() noexcept;

    Outline outline_;
    Span<Index> corner_;  // points, then positions along the line
    Span<Vec2> along_;    // the points in the order of the line
    PointSpline spline_;
    Index per_interval_ = 1, max_samples_ = 0;
};

}  // namespace harmorph
