// Finds points that are at one place, within a tolerance.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_map>

namespace cli {

class Places {
public:
    using Place = std::array<double, 3>;

    // Places are equal if no coordinate differs by more than `tolerance`, which may be 0.
    explicit Places(double tolerance) : tolerance_(tolerance) {}

    // Returns the number of the first point at this place. If there is none, adds a point with this
    // number.
    std::int32_t find_or_add(const Place& place, std::int32_t number);

private:
    using Cube = std::array<std::int64_t, 3>;  // of a grid that is so coarse that equal places lie
                                               // in eight cubes at most
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
