#include "harmorph/nodal_gradient.hpp"

namespace harmorph {
namespace {

// visit(cell, its corners as points that stand for others, counter-clockwise)
template <class Visit>
void for_each_cell(NodalGradient const& scheme, Visit visit) noexcept {
    for (Index i = 0; i < scheme.mesh.n_cells; ++i) {
        Cell cell = scheme.mesh.cell(i);
        if (scheme.reversed[i] != 0) cell.reverse();
        for (Index k = 0; k < cell.n; ++k) cell.point[k] = scheme.representative[cell.point[k]];
        visit(cell);
    }
}

}  // namespace

void NodalGradient::lay_out(Arena& arena, Mesh const& its_mesh, Index n_edges) noexcept {
    arena.take(reversed, its_mesh.n_cells);
    arena.take(representative, its_mesh.n_points);
    arena.take(inverse_area, its_mesh.n_points);
    dual.lay_out(arena, n_edges, its_mesh.n_points);
}

void NodalGradient::build(Mesh const& its_mesh, Points its_points, Edges const& edges,
                          Span<const Index> its_representative, Span<const std::uint8_t> its_reversed,
                          bool with_correction) noexcept {
    mesh = its_mesh;
    points = its_points;
    corrected = with_correction;
    copy(representative, its_representative);
    copy(reversed, its_reversed);
    dual.build(mesh, points, edges, representative, reversed);
    fill(inverse_area, 0.0);
    for_each_cell(*this, [&](Cell const& cell) {
        Real const area = cell_area(cell, points);
        for (Index k = 0; k < cell.n; ++k) inverse_area[cell.point[k]] += area;
    });
    for (Real& area : inverse_area) area = area > 0 ? 1 / area : 0;
}

// The integral of the gradient over a cell, sides by the trapezoidal rule, goes to all its corners. What two cells
// round a corner say of their common side cancels: the sum is the integral along the line round all of them.
void NodalGradient::add_cells(Span<const Real> value, Index n, Span<Real> gradient) const noexcept {
    for_each_cell(*this, [&](Cell const& cell) {
        Real weight_x[4], weight_y[4];  // half the sum of the normals of a corner's sides
        const Real* row[4];
        for (Index k = 0; k < cell.n; ++k) {
            Vec2 const across = points[cell.next(k)] - points[cell.previous(k)];
            weight_x[k] = 0.5 * across.y;
            weight_y[k] = -0.5 * across.x;
            row[k] = value.data() + Offset{cell.point[k]} * n;
        }
        for (Index f = 0; f < n; ++f) {
            Real x = 0, y = 0;
            for (Index k = 1; k < cell.n; ++k) {
                Real const difference = row[k][f] - row[0][f];
                x += weight_x[k] * difference;
                y += weight_y[k] * difference;
            }
            for (Index k = 0; k < cell.n; ++k) {
                Real* const its = gradient.data() + Offset{cell.point[k]} * (2 * n);
                its[f] += x;
                its[n + f] += y;
            }
        }
    });
}

void NodalGradient::apply(Span<const Real> value, Index n, Span<Real> gradient, Span<Real> balance) const noexcept {
    fill(gradient, 0.0);
    add_cells(value, n, gradient);
    fill(balance, 0.0);
    auto const row = [n](auto rows, Index point) { return rows.data() + Offset{point} * n; };
    for (MedianDual::Face const& face : dual.faces) {
        Vec2 const along = points[face.end] - points[face.begin];
        const Real* const from = row(value, face.begin);
        const Real* const to = row(value, face.end);
        const Real* const from_gradient = gradient.data() + Offset{face.begin} * (2 * n);
        const Real* const to_gradient = gradient.data() + Offset{face.end} * (2 * n);
        Real const from_weight = 0.5 * inverse_area[face.begin], to_weight = 0.5 * inverse_area[face.end];
        Real* const into = row(balance, face.begin);
        Real* const out_of = row(balance, face.end);
        // g . n, where the component of g along the edge is (F_Q - F_P) / |e|: the rest of g sees the rest of n.
        Real const share = corrected ? dot(along, face.normal) / square(along) : 0;
        Vec2 const direction = face.normal - share * along;
        for (Index f = 0; f < n; ++f) {
            Real const x = from_weight * from_gradient[f] + to_weight * to_gradient[f];
            Real const y = from_weight * from_gradient[n + f] + to_weight * to_gradient[n + f];
            Real const flux = x * direction.x + y * direction.y + share * (to[f] - from[f]);
            into[f] += flux;
            out_of[f] -= flux;
        }
    }
}

}  // namespace harmorph
