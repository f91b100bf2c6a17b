// Files of movements: lines "index dx dy", the control point counted from 1, "rigid MARKER dx dy
// degrees [scale]", and "mode K amplitude [amplitude-y]" for functions by table; points and bodies
// that are not named do not move.
#pragma once

#include "mesh/basis_file.hpp"

#include <cstdint>
#include <iosfwd>
#include <string>
#include <vector>

namespace cli {

// Lists what a file may move: control points, the bodies of these conditions, and modes.
struct Movable {
    std::int32_t n_control = 0, n_bodies = 0, n_modes = 0;
    std::vector<hm_condition> conditions;

    std::int32_t functions() const { return n_control + 2 * n_bodies + n_modes; }
};

// Returns pairs [2 * functions].
std::vector<double> read_moves(const std::string& path, const Movable& movable, const Mesh& mesh);
std::vector<double> read_moves(const std::string& path, const Basis& basis, const Mesh& mesh);
void write_moves(std::ostream& out, const std::vector<double>& moves, const Basis& basis,
                 const Mesh& mesh);

}  // namespace cli
