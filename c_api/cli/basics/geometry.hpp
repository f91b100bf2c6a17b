// Points and boxes of the plane, two numbers for each point of a mesh, and the positions of both in
// vectors.
#pragma once

#include "basics/elementary.hpp"

#include <harmorph.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace cli {

// Places or displacements of the points of a mesh.
struct Field {
    std::vector<double> x, y;
    explicit Field(std::size_t points) : x(points), y(points) {}
    hm_points read() const { return {x.data(), y.data(), 1}; }  // for the library
    hm_points_out write() { return {x.data(), y.data(), 1}; }
};

// The C header counts points and cells in 32 bits; vectors count in std::size_t.
constexpr std::size_t place(std::int32_t index) { return static_cast<std::size_t>(index); }

inline constexpr double pi = 3.14159265358979323846;

struct Point {
    double x, y;
};

inline double distance(Point a, Point b) { return length_of(b.x - a.x, b.y - a.y); }

struct Box {
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    Point low = {infinity, infinity}, high = {-infinity, -infinity};  // holds nothing yet

    void include(Point point) {
        low = {std::min(low.x, point.x), std::min(low.y, point.y)};
        high = {std::max(high.x, point.x), std::max(high.y, point.y)};
    }
    void include(const Box& other) {
        low = {std::min(low.x, other.low.x), std::min(low.y, other.low.y)};
        high = {std::max(high.x, other.high.x), std::max(high.y, other.high.y)};
    }
    bool overlaps(const Box& other) const {
        return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y &&
               other.low.y <= high.y;
    }
    Box common(const Box& other) const {  // the boxes must overlap
        return {{std::max(low.x, other.low.x), std::max(low.y, other.low.y)},
                {std::min(high.x, other.high.x), std::min(high.y, other.high.y)}};
    }
    Box widened(double margin) const {
        return {{low.x - margin, low.y - margin}, {high.x + margin, high.y + margin}};
    }
    double width() const { return high.x - low.x; }
    double height() const { return high.y - low.y; }
    double larger_side() const { return std::max(width(), height()); }
    Point centre() const { return {(low.x + high.x) / 2, (low.y + high.y) / 2}; }
};

}  // namespace cli
