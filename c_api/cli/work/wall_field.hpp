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

// Files of Neumann values, lines "point point control-point value": on the free face between two
// points of the mesh, counted from 0, the function of a control point, counted from 1, has this
// outward normal derivative. Functions without a line have 0.

struct FluxList {
    std::vector<std::int32_t> points;  // [2 * faces]
    std::vector<double> values;        // [faces * control points]

    void give_to(hm_problem& problem) const;  // the list must exist as long as the problem
};

FluxList read_fluxes(const std::string& path, const Mesh& mesh, std::int32_t n_control);

}  // namespace cli
