#include "harmorph/laplace.hpp"

#include "harmorph/cell_shape.hpp"

namespace harmorph {
namespace {

void add_triangle(Cell const& cell, CellShape const& shape, CellCorners const& corners, Matrix const& matrix) noexcept {
    Real const half = 0.5 / corners.twice_area[0];
    for (Index k = 0; k < 3; ++k) {  // the side opposite to corner k: half the cotangent there
        Index const a = (k + 1) % 3, b = (k + 2) % 3;
        matrix.add(cell.point[a], cell.point[b], half * dot(shape.at[a] - shape.at[k], shape.at[b] - shape.at[k]));
    }
}

// The two splits have four triangles: the one round corner k is made of k and its neighbours, and is the corner's area.
void add_quad(Cell const& cell, CellShape const& shape, CellCorners const& corners, Matrix const& matrix) noexcept {
    Real quarter[4];
    for (Index k = 0; k < 4; ++k) quarter[k] = 0.25 / corners.twice_area[k];
    // A quarter of the cotangent that `apex` sees a and b under, in the triangle round corner `round`.
    auto const quarter_cotangent = [&](Index apex, Index a, Index b, Index round) {
        return quarter[round] * dot(shape.at[a] - shape.at[apex], shape.at[b] - shape.at[apex]);
    };
    for (Index a = 0; a < 4; ++a) {  // a side sees its two opposite corners, one in each split
        Index const b = (a + 1) & 3, c = (a + 2) & 3, d = (a + 3) & 3;
        matrix.add(cell.point[a], cell.point[b], quarter_cotangent(c, a, b, b) + quarter_cotangent(d, a, b, a));
    }
    for (Index a = 0; a < 2; ++a) {  // a diagonal belongs to one split only, and sees the other two corners
        Index const b = a + 1, c = a + 2, d = (a + 3) & 3;
        matrix.add(cell.point[a], cell.point[c], quarter_cotangent(b, a, c, b) + quarter_cotangent(d, a, c, d));
    }
}

}  // namespace

Index assemble_laplace(Mesh const& mesh, Points points, Span<const std::uint8_t> reversed, Matrix const& matrix) noexcept {
    matrix.clear();
    for (Index i = 0; i < mesh.n_cells; ++i) {
        Cell cell = mesh.cell(i);
        if (reversed[i] != 0) cell.reverse();
        CellShape const shape(cell, points, false);
        CellCorners const corners(shape);
        if (!(corners.smallest() > 0)) return i;
        if (cell.n == 3) {
            add_triangle(cell, shape, corners, matrix);
        } else {
            add_quad(cell, shape, corners, matrix);
        }
    }
    return none;
}

}  // namespace harmorph
