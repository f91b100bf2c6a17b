// Collects the derivatives of a value by the coordinates of mesh points, for a range of points.
// Several threads collect the derivatives of their own points, in the order of the cells, so that
// the sums have the same bits for any number of threads.
#pragma once

#include "base/vec2.hpp"

namespace harmorph {

class PointGradient {
public:
    // Without points, add() does nothing.
    PointGradient() noexcept = default;
    PointGradient(MutablePoints points, Index begin, Index end) noexcept
        : points_(points), begin_(begin), end_(end) {}

    bool wanted() const noexcept { return points_.given(); }
    void add(Index point, Vec2 by) const noexcept {
        if (point < begin_ || point >= end_) return;
        points_.x[point * points_.stride] += by.x;
        points_.y[point * points_.stride] += by.y;
    }

private:
    MutablePoints points_;
    Index begin_ = 0, end_ = 0;
};

}  // namespace harmorph
