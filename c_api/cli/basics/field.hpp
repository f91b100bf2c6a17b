// A field of two numbers for each point of a mesh.
#pragma once

#include <harmorph.h>

#include <cstddef>
#include <vector>

namespace cli {

// Places or displacements of the points of a mesh.
struct Field {
    std::vector<double> x, y;
    explicit Field(std::size_t points) : x(points), y(points) {}
    hm_points read() const { return {x.data(), y.data(), 1}; }  // for the library
    hm_points_out write() { return {x.data(), y.data(), 1}; }
};

}  // namespace cli
