// The data of the page of `harmorph explore`: the mesh, the curves and the conditions.
#pragma once

#include "work/basis_file.hpp"

#include <string>

namespace cli {

// Tells whether a page that solves the functions of a basis gets these functions, but for rounding.
bool can_be_solved_again(const Basis& basis, const Mesh& mesh);

// Returns one JSON object, which page/decode.js describes. moves: the text of the file of movements
// that the page begins with, or empty.
std::string explore_data(const Mesh& mesh, const Basis& basis, const std::string& moves);

}  // namespace cli
