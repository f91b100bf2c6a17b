// A box is a rectangle parallel to the axes. tests/mesh/test_box_tree.cpp covers this file.
#pragma once

#include "base/vec2.hpp"

namespace harmorph {

// The smallest box that contains some points; without points, `low` is infinite and `high` minus
// infinite.
struct Box {
    Vec2 low{infinity, infinity}, high{-infinity, -infinity};

    void include(Vec2 p) noexcept {
        low = {min(low.x, p.x), min(low.y, p.y)};
        high = {max(high.x, p.x), max(high.y, p.y)};
    }
    void include(Box const& other) noexcept {
        include(other.low);
        include(other.high);
    }
    Vec2 size() const noexcept { return high - low; }
    // Returns the larger side.
    Real extent() const noexcept { return max(size().x, size().y); }
    Vec2 centre() const noexcept { return 0.5 * low + 0.5 * high; }
    bool meets(Box const& other) const noexcept {
        return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y &&
               other.low.y <= high.y;
    }
    Real squared_distance(Vec2 p) const noexcept {
        Real const x = max(max(low.x - p.x, p.x - high.x), 0.0);
        Real const y = max(max(low.y - p.y, p.y - high.y), 0.0);
        return x * x + y * y;
    }
};

}  // namespace harmorph
