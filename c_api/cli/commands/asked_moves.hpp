// The movement that the options of `harmorph morph` ask for: a file of moves or of variables, or
// another airfoil.
#pragma once

#include "basics/arguments.hpp"
#include "mesh/basis_file.hpp"
#include "curves/to_airfoil.hpp"

#include <optional>
#include <vector>

namespace cli {

// Pairs [2*functions] for hm_morph. `airfoil`: how well the curve can be the airfoil of
// --to-airfoil; empty otherwise.
std::vector<double> asked_moves(const Arguments& arguments, const Mesh& mesh, const Basis& basis,
                                std::optional<ToAirfoil>& airfoil);

}  // namespace cli
