// The movement that the options of `harmorph morph` ask for: a file of moves or of variables, or
// another airfoil.
#pragma once

#include "basics/arguments.hpp"
#include "mesh/basis_file.hpp"
#include "curves/to_airfoil.hpp"

#include <optional>
#include <vector>

namespace cli {

// Returns pairs [2*functions] for hm_morph. `airfoil` gets the distances between the curve and the
// airfoil of --to-airfoil; it stays empty without that option.
std::vector<double> asked_moves(const Arguments& arguments, const Mesh& mesh, const Basis& basis,
                                std::optional<ToAirfoil>& airfoil);

}  // namespace cli
