// The smooth quality and the relative corner areas of one cell, for polygons and for cells that the
// kernels leave out: inverted cells, and cells whose products of areas would overflow or underflow.
// tests/morph/test_cell_bounds.cpp covers this file.
#pragma once

#include "base/elementary.hpp"
#include "base/executor.hpp"
#include "base/vec2.hpp"
#include "mesh/cell_shape.hpp"

namespace harmorph {

// Collects the derivatives of a value by the coordinates of mesh points, for a range of points.
// Several threads collect the derivatives of their own points, in the order of the cells, so that
// the sums have the same bits for any number of threads.
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

// One of the caller's cells, with all its pieces and guards. harmorph_quality.h states the values.
class OddCell {
public:
    OddCell(OrientedMesh const& cells, Index number, Points at, Points start) noexcept
        : cells_(cells), number_(number), at_(at), start_(start) {}

    // Both functions add the values to `minimum`, and to the gradient the derivatives of the
    // values, multiplied by their weights. With `kept`, the quality is divided by the skew quality
    // of the start.
    void add_quality(bool kept, SmoothMinimum& minimum,
                     PointGradient const& gradient) const noexcept;
    void add_areas(SmoothMinimum& minimum, PointGradient const& gradient) const noexcept;

private:
    struct Skew {
        Real value = 0;
        bool is_inverted = false;  // the value is then negative or 0
        // Unless inverted, the sum of 1 / sin over the corners, which has the value factor / sum.
        Real sum = 0, factor = 0;
    };
    Skew skew(Points points) const noexcept;
    Real area(Points points) const noexcept;
    // add_skew_slopes() and add_area_slopes() add derivatives, multiplied by `scale`.
    void add_skew_slopes(Skew const& skew, Real scale,
                         PointGradient const& gradient) const noexcept;
    void add_area_slopes(Real scale, PointGradient const& gradient) const noexcept;

    bool is_triangle() const noexcept;
    template <class Visit>
    void for_each_corner(Points points, Visit const& visit) const noexcept;
    template <class Visit>
    void for_each_piece(Points points, Visit const& visit) const noexcept;

    OrientedMesh const& cells_;
    Index number_;
    Points at_, start_;
};

}  // namespace harmorph
