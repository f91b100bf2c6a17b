#include "harmorph/operators/stiffness.hpp"

#include "harmorph/mesh/cell_shape.hpp"
#include "matrix_cells.hpp"

namespace harmorph {
namespace {

// The conductance of the side opposite to a corner is half the cotangent of the angle there.
inline CellConductances triangle_conductances(CellShape const& shape, CellCorners const& corners, Real k) noexcept {
    Real const half = 0.5 * k / corners.twice_area[0];
    CellConductances conductance;
    for (Index apex = 0; apex < 3; ++apex) {
        Index const a = (apex + 1) % 3, b = (apex + 2) % 3;
        conductance.side[a] = half * dot(shape.at[a] - shape.at[apex], shape.at[b] - shape.at[apex]);
    }
    return conductance;
}

// The two splits of a quad have four triangles: the one round corner k is made of k and both neighbouring corners.
inline CellConductances quad_conductances(CellShape const& shape, CellCorners const& corners,
                                          Real conductivity) noexcept {
    Real quarter[4];  // times the product of two sides of a triangle round a corner: a quarter of the angle's cotangent
    for (Index k = 0; k < 4; ++k) quarter[k] = 0.25 * conductivity / corners.twice_area[k];
    Vec2 const (&side)[4] = corners.side;
    Vec2 const across[4] = {shape.at[2] - shape.at[0], shape.at[3] - shape.at[1], shape.at[0] - shape.at[2],
                            shape.at[1] - shape.at[3]};
    CellConductances conductance;
    for (Index a = 0; a < 4; ++a) {  // each split has one angle opposite to a side: at c and at d
        Index const b = (a + 1) & 3, d = (a + 3) & 3;
        conductance.side[a] = quarter[b] * dot(across[a], side[b]) - quarter[a] * dot(across[b], side[d]);
    }
    for (Index a = 0; a < 2; ++a) {  // a diagonal belongs to one split only; the angles opposite to it are at b and d
        Index const b = a + 1, c = a + 2, d = (a + 3) & 3;
        conductance.across[a] = -(quarter[b] * dot(side[a], side[b]) + quarter[d] * dot(side[c], side[d]));
    }
    return conductance;
}

template <MatrixKind kind, Index corners>
void add_cell(Matrix const& matrix, RowRange rows, Cell const& cell, CellConductances const& conductance,
              Real circulation) noexcept {
    if constexpr (kind == MatrixKind::coupled_xy) {
        for (Index k = 0; k < corners; ++k) {
            matrix.add_coupled(rows, cell.point[k], cell.point[(k + 1) % corners], conductance.side[k], circulation);
        }
        for (Index k = 0; corners == 4 && k < 2; ++k) {
            matrix.add_coupled(rows, cell.point[k], cell.point[k + 2], conductance.across[k], 0);
        }
    } else {
        matrix.add_corners<kind == MatrixKind::complex, corners>(rows, cell, conductance, circulation);
        if constexpr (kind == MatrixKind::complex) {
            if (matrix.turns_sides() && matrix.is_turned(cell)) matrix.add_turns(rows, cell, conductance, circulation);
        }
    }
}

// Adds all cells that concern these rows; returns the first of them without positive area, or none.
template <MatrixKind kind>
Index add_cells(OrientedMesh const& cells, Points points, Span<const Real> conductivity, Real half,
                Matrix const& shared_matrix, RowRange rows) noexcept {
    Matrix const matrix = shared_matrix;  // a copy, so that the compiler knows that writing entries does not change it
    Span<const std::uint8_t> const reversed = cells.reversed;
    bool const all_rows = rows.begin == 0 && rows.end == matrix.n;
    return cells.mesh.find_cell([&](Index i, Cell cell) {
        if (!all_rows && !matrix.concerns(rows, cell)) return false;
        if (reversed[i] != 0) cell.reverse();
        CellShape const shape(cell, points, false);
        CellCorners const corners(shape);
        if (!(corners.smallest() > 0)) return true;
        Real const k = conductivity.empty() ? 1 : conductivity[i];
        if (cell.n == 3) {
            add_cell<kind, 3>(matrix, rows, cell, triangle_conductances(shape, corners, k), half * k);
        } else {
            add_cell<kind, 4>(matrix, rows, cell, quad_conductances(shape, corners, k), half * k);
        }
        return false;
    });
}

}  // namespace

Index assemble_stiffness(OrientedMesh const& cells, Points points, Span<const Real> conductivity, bool conformal,
                         Matrix const& matrix, Executor const& executor) noexcept {
    matrix.clear();
    Real const half = conformal ? 0.5 : 0;
    auto const add = matrix.kind == MatrixKind::real      ? add_cells<MatrixKind::real>
                     : matrix.kind == MatrixKind::complex ? add_cells<MatrixKind::complex>
                                                          : add_cells<MatrixKind::coupled_xy>;
    Index bad_cell[Executor::most_threads];
    Index const n_ranges = matrix.for_row_ranges(executor, [&](Index range, RowRange rows) {
        bad_cell[range] = add(cells, points, conductivity, half, matrix, rows);
    });
    Index first = bad_cell[0];
    for (Index range = 1; range < n_ranges; ++range) {
        if (first == none || (bad_cell[range] != none && bad_cell[range] < first)) first = bad_cell[range];
    }
    return first;
}

}  // namespace harmorph
