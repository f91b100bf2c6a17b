// Work in parts, compared with the solution of the whole problem.
#pragma once

#include "input.hpp"
#include "solution.hpp"

namespace fuzz {

// Functions in shares, whose parcels make rows for lists of points: the bits of the whole basis.
// Gradients summed over lists: the bits of hm_adjoint.
void check_shares(Solution& whole, Input& input);

// A mesh that no process has as a whole, cut anywhere: the equations of the parts, added up and
// solved by elimination, give the functions of the whole mesh.
void check_cut_mesh(Solution& whole, Input& input);

}  // namespace fuzz
