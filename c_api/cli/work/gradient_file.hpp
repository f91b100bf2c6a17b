// Gradients with respect to all that a basis moves, written in the form of a file of moves, as CSV
// or as JSON.
#pragma once

#include "basics/json.hpp"
#include "work/basis_file.hpp"

#include <iosfwd>
#include <string>
#include <vector>

namespace cli {

struct Gradient {
    std::string objective;  // the file of its sensitivities
    std::size_t points = 0;
    std::vector<double> by_functions;  // [2 * functions] of hm_adjoint
    // Pairs by the design variables. If not empty, they are written in place of the derivatives by
    // control points.
    std::vector<double> by_variables;
    double admissible_descent = 0;  // see hm_assess
};

// The extension of the path selects the format: .json, .csv, or else text.
void write_gradients(std::ostream& out, const std::string& path,
                     const std::vector<Gradient>& gradients, const Basis& basis, const Mesh& mesh);
JsonObject gradients_json(const std::vector<Gradient>& gradients, const Basis& basis,
                          const Mesh& mesh);

}  // namespace cli
