// Sorts points so that points that follow each other are neighbours in the plane.
// tests/fields/test_interpolation.cpp covers this file.
#pragma once

#include "base/arena.hpp"
#include "base/vec2.hpp"

namespace harmorph {

// The order is that of Morton's curve on a grid of 2^32 squares in each direction over the bounding
// box of the points; points in one square keep their order.
struct SortedOrder {
    struct Entry {
        std::uint64_t key;
        Index point;
    };
    Span<Entry> entry, spare;  // [n]

    void lay_out(Arena& arena, Index n) noexcept {
        arena.take(entry, n);
        arena.take(spare, n);
    }
    void sort(Points points) noexcept;
    Index operator[](Index k) const noexcept { return entry[k].point; }
};

}  // namespace harmorph
