#include "operators/assembly.hpp"

namespace harmorph {

Index assemble_operator(Method const& method, OrientedMesh const& cells, Points points,
                        FaceDistance& walls, Points wall_points, Span<Real> conductivity,
                        Matrix const& matrix, Executor const& executor) noexcept {
    if (!conductivity.empty()) {
        walls.build(wall_points);
        weigh_cells(walls, cells.mesh, points, method.exponent_quarters, conductivity, executor);
    }
    return assemble_stiffness(cells, points, conductivity, method.conformal(), matrix, executor);
}

}  // namespace harmorph
