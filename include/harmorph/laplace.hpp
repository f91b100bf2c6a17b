// Laplace's operator on triangles and quads: compact median-dual scheme.
#pragma once

#include "harmorph/matrix.hpp"

namespace harmorph {

// Flux through the median-dual face between two points with the gradient of the cell: in a triangle this is half the
// cotangent of the angle opposite to the edge (= linear finite elements); in a quad the mean of its two splits into
// triangles, which couples the diagonals too. Linear fields are reproduced exactly. Cells must have positive corner areas.
void assemble_laplace(Mesh const& mesh, Points points, Matrix const& matrix) noexcept;

}  // namespace harmorph
