// Laplace's operator on triangles and quads: compact median-dual scheme.
#pragma once

#include "harmorph/matrix.hpp"

namespace harmorph {

// Flux through the median-dual face between two points with the gradient of the cell: in a triangle this is half the
// cotangent of the angle opposite to the edge (= linear finite elements); in a quad the mean of its two splits into
// triangles, which couples the diagonals too. Linear fields are reproduced exactly.
// Returns the first cell with a corner that has no positive area, or none; the matrix is of use only then.
Index assemble_laplace(Mesh const& mesh, Points points, Span<const std::uint8_t> reversed, Matrix const& matrix) noexcept;

}  // namespace harmorph
