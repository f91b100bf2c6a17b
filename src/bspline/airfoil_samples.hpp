// Samples the smooth outline through the points of an airfoil: computes many points in order.
#pragma once

#include "bspline/airfoil_line.hpp"
#include "bspline/curve_ends.hpp"
#include "bspline/point_spline.hpp"
#include "bspline/unit_points.hpp"

namespace harmorph {

struct AirfoilSamples {
    AirfoilLine line;     // in units of the points, without the straight base of a blunt section
    UnitPoints points;    // the given points
    Course course;        // says how the outline closes, and which points are on the base
    Index n_corners = 0;  // the number of corners inside the line

    // Takes arrays for at least min_samples samples, unless there would be more than 64 between two
    // given points. Every given point is a sample.
    void lay_out(Arena& arena, Index n_points, Index min_samples) noexcept;
    Index max_samples() const noexcept { return max_samples_; }
    Status take(Points given, Index n, bool is_loop, Fault& fault) noexcept;
    // Lets a closed outline begin at the trailing edge: the corner that lies farthest in this
    // direction, or the sample if there are no corners.
    void begin_at_farthest(Vec2 direction) noexcept;

private:
    void gather(Index n) noexcept;
    void sample() noexcept;

    Outline outline_;
    Span<Index> corner_;  // points at first, then positions along the line
    Span<Vec2> along_;    // the points in the order of the line
    PointSpline spline_;
    Index per_interval_ = 1, max_samples_ = 0;
};

}  // namespace harmorph
