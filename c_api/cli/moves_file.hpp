// Files of movements: lines "index dx dy", the control point counted from 1; points that are not named stay.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

namespace cli {

std::vector<double> read_moves(const std::string& path, std::int32_t n_control); // dx,dy pairs [2*n_control]
void write_moves(std::ostream& out, const std::vector<double>& moves);

} // namespace cli
