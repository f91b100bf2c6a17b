// Files of movements: lines "index dx dy", the control point counted from 1, "rigid MARKER dx dy degrees [scale]", and
// "mode K amplitude [amplitude-y]" for functions by table; points
// and bodies that are not named stay.
#pragma once

#include "basis_file.hpp"

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

namespace cli {

std::vector<double> read_moves(const std::string& path, const Basis& basis, const Mesh& mesh); // pairs [2*functions]
void write_moves(std::ostream& out, const std::vector<double>& moves, const Basis& basis, const Mesh& mesh);

} // namespace cli
