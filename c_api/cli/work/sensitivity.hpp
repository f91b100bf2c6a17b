// Derivatives of an objective by the coordinates of the mesh points, from the files of flow
// solvers.
#pragma once

#include "basics/geometry.hpp"
#include "basics/json.hpp"
#include "formats/table_points.hpp"
#include "work/basis_file.hpp"

#include <iosfwd>
#include <string>
#include <vector>

namespace cli {

// Gradients with respect to all that a basis moves, written in the form of a file of moves, as CSV
// or as JSON.

struct Gradient {
    std::string objective;  // the file of its sensitivities
    std::size_t points = 0;
    std::vector<double> by_functions;  // [2 * functions] of hm_adjoint
    // Pairs by the design variables. If not empty, they are written in place of the derivatives by
    // control points.
    std::vector<double> by_variables;
    bool variables_are_movements = false;  // of which each has one value
    double admissible_descent = 0;         // see hm_assess
};

// The extension of the path selects the format: .json, .csv, or else text.
void write_gradients(std::ostream& out, const std::string& path,
                     const std::vector<Gradient>& gradients, const Basis& basis, const Mesh& mesh);
JsonObject gradients_json(const std::vector<Gradient>& gradients, const Basis& basis,
                          const Mesh& mesh);

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
