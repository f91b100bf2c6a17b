// The smooth quality and the relative corner areas of one cell, for polygons and for cells that the
// kernels leave out: inverted ones, and those of which products of areas would overflow or
// underflow. tests/morph/test_cell_bounds.cpp covers this file.
#pragma once

#include "mesh/guard_shape.hpp"
#include "morph/point_gradient.hpp"
#include "base/smooth_minimum.hpp"

namespace harmorph {

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
    // Both add the derivatives, multiplied by `scale`.
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
