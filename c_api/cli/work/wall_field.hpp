// Reads files of wall displacements: lines "point dx dy", or a table of point_table.hpp with the
// columns dx and dy, or displacement_x and displacement_y. Points are counted from 0 in the order
// of the mesh file.
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

// From a table that has a row for each point of the mesh, this function takes only the points of
// the markers that have a condition HM_GIVEN. in_order: see points_of().
WallField read_wall_field(const std::string& path, const Mesh& mesh,
                          const std::vector<hm_condition>& conditions, bool in_order);

}  // namespace cli
