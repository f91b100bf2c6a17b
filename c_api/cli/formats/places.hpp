// Points that are at one place, within a tolerance, are one point.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>

namespace cli {

class Places {
public:
    using Place = std::array<double, 3>;

    // Places are one whose coordinates differ by no more than `tolerance`, which may be 0.
    explicit Places(double tolerance) : tolerance_(tolerance) {}

    // The number of the first point that is at this place. If there was none, that is `number` from
    // now on.
    std::int32_t find_or_add(const Place& place, std::int32_t number);

private:
    using Cube = std::array<std::int64_t, 3>;  // of a grid so coarse that a place has neighbours in
                                               // eight cubes at most
    struct CubeHash {
        std::size_t operator()(const Cube& cube) const;
    };
    struct Point {
        Place place;
        std::int32_t number;
    };

    bool is_same(const Place& a, const Place& b) const;
    Cube cube_of(const Place& place, double offset) const;

    double tolerance_;
    std::unordered_multimap<Cube, Point, CubeHash> points_;
};

}  // namespace cli
