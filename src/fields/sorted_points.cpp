#include "fields/sorted_points.hpp"

#include "base/box.hpp"

namespace harmorph {
namespace {

// Puts the bits of a number at the even places of the result.
std::uint64_t spread_bits(std::uint32_t number) noexcept {
    std::uint64_t bits = number;
    bits = (bits | bits << 16) & 0x0000FFFF0000FFFF;
    bits = (bits | bits << 8) & 0x00FF00FF00FF00FF;
    bits = (bits | bits << 4) & 0x0F0F0F0F0F0F0F0F;
    bits = (bits | bits << 2) & 0x3333333333333333;
    return (bits | bits << 1) & 0x5555555555555555;
}

}  // namespace

void SortedOrder::sort(Points points) noexcept {
    Index const n = entry.count();
    Box box;
    for (Index k = 0; k < n; ++k) box.include(points[k]);
    Real const extent = box.extent();
    Real const scale = extent > smallest_height ? 0x1.fffffp+31 / extent : 0;
    for (Index k = 0; k < n; ++k) {
        Vec2 const p = scale * (points[k] - box.low);
        entry[k] = {spread_bits(static_cast<std::uint32_t>(p.x)) |
                        spread_bits(static_cast<std::uint32_t>(p.y)) << 1,
                    k};
    }
    // Sorts by one digit after the other, the lowest digit first.
    constexpr Index digits = 8, digit_bits = 8, values = 1 << digit_bits;
    for (Index digit = 0; digit < digits; ++digit) {
        Index start[values + 1] = {};
        auto const value = [&](Entry const& e) {
            return static_cast<Index>(e.key >> digit_bits * digit & (values - 1));
        };
        for (Entry const& e : entry) ++start[value(e) + 1];
        for (Index v = 0; v < values; ++v) start[v + 1] += start[v];
        for (Entry const& e : entry) spare[start[value(e)]++] = e;
        Span<Entry> const sorted = spare;
        spare = entry;
        entry = sorted;
    }
}

}  // namespace harmorph
