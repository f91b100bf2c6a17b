// Derivatives of an objective by the coordinates of the mesh points, from the files of flow
// solvers.
#pragma once

#include "basics/geometry.hpp"
#include "formats/point_table.hpp"

#include <string>

namespace cli {

struct SensitivityColumns {
    std::string x = "Sensitivity_x", y = "Sensitivity_y";
    std::string normal;       // not empty: derivatives along the normals of the boundary instead
    bool into_fluid = true;   // the direction of these normals
    bool per_length = false;  // derivatives are per length of the wall: they are multiplied by half
                              // the length of both faces at the point
};

struct Sensitivity {
    Field by;              // points that the file does not name: 0
    std::size_t rows = 0;  // points that the file names
};

// in_order: see points_of().
Sensitivity read_sensitivity(const std::string& path, const SensitivityColumns& columns,
                             const Mesh& mesh, bool in_order);

}  // namespace cli
