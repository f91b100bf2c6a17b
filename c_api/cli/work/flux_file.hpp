// Files of Neumann values, lines "point point control-point value": on the free face between two
// points of the mesh, counted from 0, the function of a control point, counted from 1, has this
// outward normal derivative. Functions without a line have 0.
#pragma once

#include "mesh/mesh_file.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace cli {

struct FluxList {
    std::vector<std::int32_t> points;  // [2 * faces]
    std::vector<double> values;        // [faces * control points]

    void give_to(hm_problem& problem) const;  // the list must exist as long as the problem
};

FluxList read_fluxes(const std::string& path, const Mesh& mesh, std::int32_t n_control);

}  // namespace cli
