#include "formats/places.hpp"

#include <cmath>

namespace cli {

std::int32_t Places::find_or_add(const Place& place, std::int32_t number) {
    const Cube first = cube_of(place, -tolerance_), last = cube_of(place, tolerance_);
    for (Cube cube = first; cube[0] <= last[0]; ++cube[0]) {
        for (cube[1] = first[1]; cube[1] <= last[1]; ++cube[1]) {
            for (cube[2] = first[2]; cube[2] <= last[2]; ++cube[2]) {
                const auto range = points_.equal_range(cube);
                for (auto point = range.first; point != range.second; ++point) {
                    if (is_same(point->second.place, place)) return point->second.number;
                }
            }
        }
    }
    points_.emplace(cube_of(place, 0), Point{place, number});
    return number;
}

std::size_t Places::CubeHash::operator()(const Cube& cube) const {
    const auto mixed = [](std::int64_t value) {
        return static_cast<std::size_t>(value) * 0x9E3779B97F4A7C15u;
    };
    return mixed(cube[0]) ^ mixed(cube[1]) >> 7 ^ mixed(cube[2]) >> 13;
}

bool Places::is_same(const Place& a, const Place& b) const {
    for (std::size_t d = 0; d < 3; ++d) {
        if (!(std::fabs(a[d] - b[d]) <= tolerance_)) return false;
    }
    return true;
}

Places::Cube Places::cube_of(const Place& place, double offset) const {
    Cube cube = {0, 0, 0};
    for (std::size_t d = 0; d < 3 && tolerance_ > 0; ++d) {
        cube[d] = static_cast<std::int64_t>(std::floor((place[d] + offset) / (4 * tolerance_)));
    }
    return cube;
}

}  // namespace cli
