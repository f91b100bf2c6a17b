#include "operators/assembly.hpp"

#include "operators/matrix_cells.hpp"

namespace harmorph {
namespace {

// The area is computed from the smallest point number on, so that the three edges of a triangle get
// the same bits. Linear fields are then reproduced even if the area is a small difference of large
// products.
Real twice_area(Index a, Index b, Index c, Points points) noexcept {
    Index const first = min(a, min(b, c));
    if (first == b) return cross(points[c] - points[b], points[a] - points[b]);
    if (first == c) return cross(points[a] - points[c], points[b] - points[c]);
    return cross(points[b] - points[a], points[c] - points[a]);
}

}  // namespace

Index assemble_bounded(Span<const DelaunayEdge> edges, Points points, Span<const Real> conductivity,
                       Matrix const& matrix) noexcept {
    matrix.clear();
    for (Index i = 0; i < edges.count(); ++i) {
        DelaunayEdge const edge = edges[i];
        Vec2 const begin = points[edge.begin], end = points[edge.end];
        auto const dot_at = [&](Index apex) {
            return dot(begin - points[apex], end - points[apex]);
        };
        Real const left = twice_area(edge.begin, edge.end, edge.left, points);
        if (!(left > 0)) return i;
        Real conductance = 0.5 * (dot_at(edge.left) / left);
        if (edge.right != none) {
            Real const right = twice_area(edge.end, edge.begin, edge.right, points);
            if (!(right > 0)) return i;
            conductance = max(conductance + 0.5 * (dot_at(edge.right) / right), 0.0);
        }
        matrix.add(edge.begin, edge.end,
                   conductivity.empty() ? conductance : conductivity[i] * conductance);
    }
    return none;
}

namespace {

using TwoReals [[gnu::vector_size(16), gnu::aligned(8), gnu::may_alias]] = Real;
using TwoTruths [[gnu::vector_size(16)]] = std::int64_t;

// Vectors are passed by value, because clang assumes for references that they are aligned to 16
// bytes.
inline TwoReals two(const Real* numbers) noexcept {
    return *reinterpret_cast<const TwoReals*>(numbers);
}
inline void set_two(Real* numbers, TwoReals to) noexcept {
    *reinterpret_cast<TwoReals*>(numbers) = to;
}

// Vectors in the plane, for two cells at a time.
struct TwoVectors {
    TwoReals x, y;
    friend TwoVectors operator-(TwoVectors a, TwoVectors b) noexcept {
        return {a.x - b.x, a.y - b.y};
    }
    friend TwoReals dot(TwoVectors a, TwoVectors b) noexcept { return a.x * b.x + a.y * b.y; }
    friend TwoReals cross(TwoVectors a, TwoVectors b) noexcept { return a.x * b.y - a.y * b.x; }
};

// Returns `factor` divided by the area if the area is positive; otherwise clears `positive`.
inline TwoReals divided_by_area(TwoReals factor, TwoReals area, TwoTruths& positive) noexcept {
    TwoTruths const is_positive = area > 0;
    positive &= is_positive;
    return factor / (is_positive ? area : TwoReals{1, 1});
}

// Finds the conductances of two cells of a group from their corners; returns a mask of the cells in
// which all areas are positive. In a triangle, the conductance of the side opposite to a corner is
// half the cotangent of the angle at the corner.
inline TwoTruths find_conductances(CellGroup<3>& cells, Index first, TwoVectors const (&side)[3],
                                   TwoVectors const (&)[3]) noexcept {
    TwoTruths positive = {-1, -1};
    TwoReals const factor =
        divided_by_area(0.5 * two(cells.conductivity + first), cross(side[0], side[1]), positive);
    for (Index a = 0; a < 3; ++a) {
        Index const b = (a + 1) % 3, apex = (a + 2) % 3;
        set_two(cells.side[a] + first, -factor * dot(side[apex], side[b]));
    }
    return positive;
}

// The two splits of a quad have four triangles. The triangle round corner k consists of k and both
// neighbouring corners.
inline TwoTruths find_conductances(CellGroup<4>& cells, Index first, TwoVectors const (&side)[4],
                                   TwoVectors const (&at)[4]) noexcept {
    TwoTruths positive = {-1, -1};
    TwoReals const k = 0.25 * two(cells.conductivity + first);
    // This number times the scalar product of two sides of the triangle is a quarter of the
    // cotangent between them.
    TwoReals weight[4];
    for (Index a = 0; a < 4; ++a)
        weight[a] = divided_by_area(k, cross(side[(a + 3) & 3], side[a]), positive);
    // Each split has one angle opposite to a side, at one of the two corners that the side does not
    // contain.
    TwoVectors const across[2] = {at[2] - at[0], at[3] - at[1]};
    set_two(cells.side[0] + first,
            weight[1] * dot(across[0], side[1]) - weight[0] * dot(across[1], side[3]));
    set_two(cells.side[1] + first,
            weight[2] * dot(across[1], side[2]) + weight[1] * dot(across[0], side[0]));
    set_two(cells.side[2] + first,
            weight[2] * dot(across[1], side[1]) - weight[3] * dot(across[0], side[3]));
    set_two(cells.side[3] + first,
            -weight[3] * dot(across[0], side[2]) - weight[0] * dot(across[1], side[0]));
    // A diagonal belongs to one split only; the angles opposite to it are at b and d.
    for (Index a = 0; a < 2; ++a) {
        Index const b = a + 1, c = a + 2, d = (a + 3) & 3;
        set_two(cells.across[a] + first,
                -weight[b] * dot(side[a], side[b]) - weight[d] * dot(side[c], side[d]));
    }
    return positive;
}

// Returns the first cell of the group without positive area, or none. The function is not inlined
// for each kind of matrix.
template <Index corners>
__attribute__((noinline)) Index measure_cells(CellGroup<corners>& cells) noexcept {
    static_assert(CellGroup<corners>::max_count % 2 == 0,
                  "vectors have two cells, so the group has an even number");
    cells.fill_up();
    for (Index first = 0; first < cells.count; first += 2) {
        TwoVectors at[corners], side[corners];
        for (Index k = 0; k < corners; ++k)
            at[k] = {two(cells.x[k] + first), two(cells.y[k] + first)};
        for (Index k = 0; k < corners; ++k) side[k] = at[(k + 1) % corners] - at[k];
        TwoTruths const positive = find_conductances(cells, first, side, at);
        if (positive[0] == 0) return cells.number[first];
        if (positive[1] == 0) return cells.number[first + 1];
    }
    return none;
}

template <MatrixKind kind, Index corners>
void add_conductances(Matrix const& matrix, RowRange rows, CellGroup<corners> const& cells,
                      Real circulation_factor) noexcept {
    if constexpr (kind == MatrixKind::coupled_xy) {
        for (Index c = 0; c < cells.count; ++c) {
            Index const(&point)[corners] = cells.point[c];
            for (Index k = 0; k < corners; ++k) {
                matrix.add_coupled(rows, point[k], point[(k + 1) % corners], cells.side[k][c],
                                   circulation_factor * cells.conductivity[c]);
            }
            for (Index k = 0; k < cells.n_across; ++k) {
                matrix.add_coupled(rows, point[k], point[k + 2], cells.across[k][c], 0);
            }
        }
    } else {
        constexpr bool is_complex = kind == MatrixKind::complex;
        if (!matrix.has_rotated_sides())
            return matrix.add_corners<is_complex>(rows, cells, 0, cells.count, circulation_factor);
        for (Index c = 0; c < cells.count; ++c) {
            matrix.add_corners<is_complex>(rows, cells, c, c + 1, circulation_factor);
            Cell const cell = cells.cell(c);
            if (!matrix.is_rotated(cell)) continue;
            matrix.add_rotations(rows, cell, cells.conductances(c),
                                 circulation_factor * cells.conductivity[c]);
        }
    }
}

// Adds the cells of the group and empties it; returns the first of these cells without positive
// area, or none.
template <MatrixKind kind, Index corners>
Index add_group(Matrix const& matrix, RowRange rows, CellGroup<corners>& cells,
                Real circulation_factor) noexcept {
    if (cells.count == 0) return none;
    Index const bad = measure_cells(cells);
    if (bad != none) return bad;
    add_conductances<kind>(matrix, rows, cells, circulation_factor);
    cells.count = 0;
    return none;
}

// Adds all cells that concern these rows; returns the first of them without positive area, or none.
template <MatrixKind kind>
Index add_cells(OrientedMesh const& cells, Points points, Span<const Real> conductivity,
                Real circulation_factor, Matrix const& shared_matrix, RowRange rows) noexcept {
    // This is a copy, so that the compiler knows that writing entries does not change the matrix.
    Matrix const matrix = shared_matrix;
    Span<const std::uint8_t> const reversed = cells.reversed;
    constexpr Index components = kind == MatrixKind::coupled_xy ? 2 : 1;
    bool const all_rows = rows.begin == 0 && rows.end == matrix.n;
    CellGroup<3> triangles;
    CellGroup<4> quads;
    Index bad = none;
    // One of the groups is empty, so that cells are added in their order.
    auto const add_groups = [&] {
        bad = add_group<kind>(matrix, rows, triangles, circulation_factor);
        if (bad == none) bad = add_group<kind>(matrix, rows, quads, circulation_factor);
        return bad != none;
    };
    cells.mesh.find_cell([&](Index i, Cell cell) {
        if (!all_rows && !matrix.concerns<components>(rows, cell)) return false;
        if (reversed[i] != 0) cell.reverse();
        bool const is_triangle = cell.n == 3;
        bool const is_due = is_triangle ? triangles.is_full() || quads.count > 0
                                        : quads.is_full() || triangles.count > 0;
        if (is_due && add_groups()) return true;
        Real const k = conductivity.empty() ? 1 : conductivity[i];
        if (is_triangle) {
            triangles.add(i, cell, points, k);
        } else {
            quads.add(i, cell, points, k);
        }
        return false;
    });
    if (bad == none) add_groups();
    return bad;
}

}  // namespace

Index assemble_stiffness(OrientedMesh const& cells, Points points, Span<const Real> conductivity,
                         bool conformal, Matrix const& matrix, Executor const& executor) noexcept {
    matrix.clear_known();
    Real const circulation_factor = conformal ? 0.5 : 0;
    auto const add = matrix.kind() == MatrixKind::real      ? add_cells<MatrixKind::real>
                     : matrix.kind() == MatrixKind::complex ? add_cells<MatrixKind::complex>
                                                            : add_cells<MatrixKind::coupled_xy>;
    Index bad_cell[Executor::max_threads];
    Index const n_ranges = matrix.for_row_ranges(executor, [&](Index range, RowRange rows) {
        matrix.clear_rows(rows);
        bad_cell[range] = add(cells, points, conductivity, circulation_factor, matrix, rows);
    });
    Index first = bad_cell[0];
    for (Index range = 1; range < n_ranges; ++range) {
        if (first == none || (bad_cell[range] != none && bad_cell[range] < first))
            first = bad_cell[range];
    }
    return first;
}

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
