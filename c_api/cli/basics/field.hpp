// Two numbers for each point of a mesh.
#pragma once

#include <harmorph.h>

#include <cstddef>
#include <vector>

namespace cli {

// Where the points are, or how far they go.
struct Field {
    std::vector<double> x, y;
    explicit Field(std::size_t points) : x(points), y(points) {}
    hm_points read() const { return {x.data(), y.data(), 1}; }  // for the library
    hm_points_out write() { return {x.data(), y.data(), 1}; }
};

}  // namespace cli
