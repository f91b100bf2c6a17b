#include "pictures/raster.hpp"

#include <algorithm>
#include <cmath>

namespace cli {

namespace {

// Returns twice the area of a triangle, with a sign.
double cross(Point a, Point b, Point c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// The pixels, counted from `origin`, whose centres lie between two coordinates; `end` is not one of
// them.
struct Span {
    std::size_t first, end;
    Span(double low, double high, double origin, std::size_t n) {
        const double max = static_cast<double>(n);
        first = static_cast<std::size_t>(std::clamp(std::ceil(low - origin - .5), 0.0, max));
        end = static_cast<std::size_t>(std::clamp(std::floor(high - origin - .5) + 1, 0.0, max));
    }
};

}  // namespace

Raster::Raster(const Box& frame)
    : frame_(frame),
      columns_(static_cast<std::size_t>(std::ceil(frame.width()))),
      rows_(static_cast<std::size_t>(std::ceil(frame.height()))),
      value_(columns_ * rows_, nothing) {}

void Raster::fill(const std::array<Point, 3>& corners, const std::array<double, 3>& values) {
    const auto [a, b, c] = corners;
    const double area = cross(a, b, c);
    if (!(std::fabs(area) > 0)) return;
    Box box;
    for (const Point& corner : corners) box.include(corner);
    const Span across(box.low.x, box.high.x, frame_.low.x, columns_),
        down(box.low.y, box.high.y, frame_.low.y, rows_);
    for (std::size_t row = down.first; row < down.end; ++row) {
        for (std::size_t column = across.first; column < across.end; ++column) {
            const Point centre = {frame_.low.x + static_cast<double>(column) + .5,
                                  frame_.low.y + static_cast<double>(row) + .5};
            const double of_a = cross(centre, b, c) / area, of_b = cross(a, centre, c) / area,
                         of_c = 1 - of_a - of_b;
            constexpr double on_side = -1e-9;  // a centre on a side belongs to both neighbours
            if (of_a < on_side || of_b < on_side || of_c < on_side) continue;
            value_[row * columns_ + column] =
                values[0] + of_b * (values[1] - values[0]) +
                of_c * (values[2] - values[0]);  // exact if all three values are equal
        }
    }
}

}  // namespace cli
