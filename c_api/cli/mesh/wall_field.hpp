// Reads files of wall displacements: lines "point dx dy". Points are counted from 0 in the order of
// the mesh file.
#pragma once

#include "mesh/mesh_file.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace cli {

struct WallField {
    std::vector<std::int32_t> points;
    std::vector<double> x, y;

    hm_points read() const { return {x.data(), y.data(), 1}; }  // a view for the library
    std::int32_t count() const { return static_cast<std::int32_t>(points.size()); }
};

WallField read_wall_field(const std::string& path, const Mesh& mesh);

}  // namespace cli
