// Collects the derivatives of a value by the coordinates of mesh points, for a range of points.
// Several threads collect the derivatives of their own points, in the order of the cells, so that
// the sums have the same bits for any number of threads.
#pragma once

#include "base/executor.hpp"
#include "base/vec2.hpp"

namespace harmorph {

class PointGradient {
public:
    // Without points, add() does nothing.
    PointGradient() noexcept = default;
    PointGradient(MutablePoints points, Index begin, Index end) noexcept
        : points_(points), begin_(begin), count_(static_cast<std::uint32_t>(end - begin)) {}

    bool wanted() const noexcept { return points_.given(); }
    bool has_unit_stride() const noexcept { return points_.stride == 1; }
    void add(Index point, Vec2 by) const noexcept { add<false>(point, by); }
    // unit: the stride is known to be 1.
    template <bool unit>
    void add(Index point, Vec2 by) const noexcept {
        if (static_cast<std::uint32_t>(point - begin_) >= count_) return;
        std::ptrdiff_t const at = unit ? point : point * points_.stride;
        points_.x[at] += by.x;
        points_.y[at] += by.y;
    }

private:
    MutablePoints points_;
    Index begin_ = 0;
    std::uint32_t count_ = 0;
};

// Both functions do nothing without points.
inline void clear_gradient(MutablePoints gradient, Index n) noexcept {
    if (!gradient.given()) return;
    if (gradient.stride == 1) {
        std::memset(gradient.x, 0, static_cast<Size>(n) * sizeof(Real));
        std::memset(gradient.y, 0, static_cast<Size>(n) * sizeof(Real));
        return;
    }
    for (Index k = 0; k < n; ++k) gradient.set(k, {});
}
inline void scale_gradient(MutablePoints gradient, Index n, Real factor,
                           Executor const& executor) noexcept {
    if (!gradient.given()) return;
    constexpr Index min_points = 16384;
    executor.for_ranges(n, min_points, [&](Index begin, Index end) {
        if (gradient.stride == 1) {
            for (Index k = begin; k < end; ++k) gradient.x[k] *= factor;
            for (Index k = begin; k < end; ++k) gradient.y[k] *= factor;
            return;
        }
        Points const now = gradient;
        for (Index k = begin; k < end; ++k) gradient.set(k, factor * now[k]);
    });
}

}  // namespace harmorph
