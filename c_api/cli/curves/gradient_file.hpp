// Gradients by what a basis moves, with the lines of a file of moves, as CSV or as JSON.
#pragma once

#include "basics/json.hpp"
#include "curves/variables_file.hpp"
#include "mesh/basis_file.hpp"

#include <iosfwd>
#include <string>
#include <vector>

namespace cli {

struct Gradient {
    std::string objective;  // the file of its sensitivities
    std::size_t points = 0;
    std::vector<double> by_functions;  // [2 * functions] of hm_adjoint
    double admissible_descent = 0;     // see hm_assess
};

// The format follows the ending of the path. map NULL: by control points, bodies and modes.
void write_gradients(std::ostream& out, const std::string& path,
                     const std::vector<Gradient>& gradients, const Basis& basis, const Mesh& mesh,
                     const VariableMap* map);
JsonObject gradients_json(const std::vector<Gradient>& gradients, const Basis& basis,
                          const Mesh& mesh, const VariableMap* map);

}  // namespace cli
