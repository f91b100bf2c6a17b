#include "harmorph/stiffness.hpp"

#include "harmorph/cell_shape.hpp"

namespace harmorph {
namespace {

// add(a, b, conductance, along_side): corners a and b of the cell; along_side where b follows a counter-clockwise.
template <class Add>
void add_triangle(CellShape const& shape, CellCorners const& corners, Real k, Add add) noexcept {
    Real const half = 0.5 * k / corners.twice_area[0];
    for (Index apex = 0; apex < 3; ++apex) {  // the side opposite to it: half the cotangent there
        Index const a = (apex + 1) % 3, b = (apex + 2) % 3;
        add(a, b, half * dot(shape.at[a] - shape.at[apex], shape.at[b] - shape.at[apex]), true);
    }
}

// The two splits have four triangles: the one round corner k is made of k and its neighbours, and is the corner's area.
template <class Add>
void add_quad(CellShape const& shape, CellCorners const& corners, Real conductivity, Add add) noexcept {
    Real quarter[4];
    for (Index k = 0; k < 4; ++k) quarter[k] = 0.25 * conductivity / corners.twice_area[k];
    // A quarter of the cotangent that `apex` sees a and b under, in the triangle round corner `round`.
    auto const quarter_cotangent = [&](Index apex, Index a, Index b, Index round) {
        return quarter[round] * dot(shape.at[a] - shape.at[apex], shape.at[b] - shape.at[apex]);
    };
    for (Index a = 0; a < 4; ++a) {  // a side sees its two opposite corners, one in each split
        Index const b = (a + 1) & 3, c = (a + 2) & 3, d = (a + 3) & 3;
        add(a, b, quarter_cotangent(c, a, b, b) + quarter_cotangent(d, a, b, a), true);
    }
    for (Index a = 0; a < 2; ++a) {  // a diagonal belongs to one split only, and sees the other two corners
        Index const b = a + 1, c = a + 2, d = (a + 3) & 3;
        add(a, c, quarter_cotangent(b, a, c, b) + quarter_cotangent(d, a, c, d), false);
    }
}

// add(point, point, conductance, k along a side or 0 across the cell) for all cells.
template <class Add>
Index for_each_conductance(Mesh const& mesh, Points points, Span<const std::uint8_t> reversed,
                           Span<const Real> conductivity, Add add) noexcept {
    return mesh.find_cell([&](Index i, Cell cell) {
        if (reversed[i] != 0) cell.reverse();
        CellShape const shape(cell, points, false);
        CellCorners const corners(shape);
        if (!(corners.smallest() > 0)) return true;
        Real const k = conductivity.empty() ? 1 : conductivity[i];
        auto const add_here = [&](Index a, Index b, Real conductance, bool along_side) {
            add(cell.point[a], cell.point[b], conductance, along_side ? k : 0);
        };
        if (cell.n == 3) {
            add_triangle(shape, corners, k, add_here);
        } else {
            add_quad(shape, corners, k, add_here);
        }
        return false;
    });
}

}  // namespace

Index assemble_stiffness(Mesh const& mesh, Points points, Span<const std::uint8_t> reversed, Span<const Real> conductivity,
                         bool conformal, Matrix const& matrix) noexcept {
    matrix.clear();
    if (matrix.kind == MatrixKind::real) {
        return for_each_conductance(mesh, points, reversed, conductivity,
                                    [&](Index a, Index b, Real conductance, Real) { matrix.add(a, b, conductance); });
    }
    Real const half = conformal ? 0.5 : 0;
    return for_each_conductance(mesh, points, reversed, conductivity, [&](Index a, Index b, Real conductance, Real k) {
        matrix.add(a, b, conductance, half * k);
    });
}

}  // namespace harmorph
