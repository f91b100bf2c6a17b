// The equations of the unknowns by the scheme of nodal gradients, without a matrix, for the values
// of a basis.
#pragma once

#include "mesh/median_dual.hpp"
#include "operators/residual.hpp"

namespace harmorph {

// Laplace's operator from averaged nodal gradients: the scheme of the paper's text.

// The gradient at a point is the Green-Gauss gradient over all cells round the point; at the
// boundary these cells lie on one side. The flux through a dual face is that of the mean of the
// gradients at both end points: f = (g_P + g_Q) / 2 . n. With the edge-directional correction (J.
// Blazek, Computational Fluid Dynamics: Principles and Applications, on viscous fluxes) the
// difference (F_Q - F_P) / |e| replaces the component of that mean along the edge e. The balance of
// a linear field is 0 on any mesh, fluxes are conserved, and no flux passes the boundary. The last
// property is the condition of free boundaries; the balance at known points is not used. The
// matrices of both schemes are unsymmetric, and neither scheme has a maximum principle.
//
// The scheme without correction serves to reproduce the paper. On squares, checkerboards are in the
// kernel of the operator. Errors are 20 times those of the compact scheme on uniform squares (128 x
// 128: 2.3e-4 against 1.1e-5, both of second order), and on perturbed squares they hardly decrease
// (2.3e-2, 1.5e-2, 2.0e-2 on 32 x 32, 64 x 64, 128 x 128 against 5.2e-4, 1.5e-4, 3.7e-5). On
// viscous meshes functions leave [0, 1] by 0.03 to 0.14, and eigenvalues may have the wrong sign,
// so that explicit steps slowly diverge. On the paper's second case these are five modes that
// alternate from point to point; `make paper` shows them (tests/measure/paper/schemes.py).
//
// The scheme with correction is about as accurate as the compact one: 3.0e-5 on those 128 x 128
// squares, 3.8e-5 against 4.5e-5 on perturbed triangles, but 4.1e-5 against 1.1e-5 on uniform
// triangles. The functions of four airfoil meshes differ by 1.1e-3 to 6.5e-3 at the leading or the
// trailing edge, and by 5e-5 to 2e-4 in the mean. The scheme with correction is the better one of
// the two.
//
// Values, gradients and balances are in rows, one for each point, in any order; points that are
// joined have one row.
struct NodalGradient {
    struct CellRows {
        // The rows of the corners, counter-clockwise; the last one is `none` in a triangle.
        Index row[4];
        // Half of each diagonal, rotated by 90 degrees: the weight of the difference along the
        // other diagonal.
        Vec2 across[2];
    };

    OrientedMesh mesh;  // The array `reversed` belongs to the caller.
    bool corrected = false;
    Span<Index> row_of;    // [n_points]
    Edges edges;           // A copy, as init() runs once, and measure() runs for many coordinates.
    Span<CellRows> cells;  // [n_cells]
    // [rows] 1 / area of all cells round a point; 0 if there is no cell.
    Span<Real> inverse_area;
    MedianDual dual;  // The ends of faces are rows.

    void lay_out(Arena& arena, Mesh const& given_mesh, Index n_edges) noexcept;
    // row_of must have been filled with rows that count from 0 and are less than n_points.
    void init(OrientedMesh const& given_mesh, Edges const& mesh_edges,
              bool with_correction) noexcept;
    void measure(Points points) noexcept;

    // Computes the balances of n functions; value and balance are [rows * n]. The balance is the
    // flux into the control volume of a point, so that dF/dt = balance / area is diffusion; the
    // balance is 0 for rows without cells. gradient [rows * 2 n] is working space: for each row the
    // sums over the cells round a point, n components along x, then n along y.
    void apply(Span<const Real> value, Index n, Span<Real> gradient,
               Span<Real> balance) const noexcept;
};

// Flux balances by nodal gradients for values that are stored in any arrangement, so that engines
// need no copies.

// Adds the integral of the gradient over a cell (Green-Gauss, trapezoidal rule on the sides) to all
// corners of the cell. Contributions of a side that two cells at a corner share cancel, so the sum
// is the integral along the outline of all cells round the corner.
template <class Width, class ValueOf>
void add_cell_gradients(NodalGradient const& scheme, Width width, ValueOf value_of,
                        Real* gradient) noexcept {
    Index const n = width;
    for (NodalGradient::CellRows const& cell : scheme.cells) {
        Index const corners = cell.row[3] == none ? 3 : 4;
        const Real* const first = value_of(cell.row[0]);
        const Real* const last = corners == 3 ? first : value_of(cell.row[3]);
        const Real* const second = value_of(cell.row[1]);
        const Real* const third = value_of(cell.row[2]);
        Real* to[4];
        for (Index k = 0; k < corners; ++k) to[k] = gradient + Offset{cell.row[k]} * (2 * n);
        for (Index f = 0; f < n; ++f) {
            Real const a = first[f] - third[f], b = second[f] - last[f];
            Real const x = a * cell.across[1].x + b * cell.across[0].x;
            Real const y = a * cell.across[1].y + b * cell.across[0].y;
            for (Index k = 0; k < corners; ++k) {
                to[k][f] += x;
                to[k][n + f] += y;
            }
        }
    }
}

// Adds the flux balances of `width` functions; Width is an integer or an integral_constant.
// value_of(row) returns the row's values; balance_of(row) returns the place to which the row's
// balance is added, or null; gradient [rows * 2 width] is working space.
template <class Width, class ValueOf, class BalanceOf>
void add_balances(NodalGradient const& scheme, Width width, ValueOf value_of, Span<Real> gradient,
                  BalanceOf balance_of) noexcept {
    Index const n = width;
    fill(gradient, 0.0);
    add_cell_gradients(scheme, width, value_of, gradient.data());
    for (MedianDual::Face const& face : scheme.dual.faces) {
        Real* const into = balance_of(face.begin);
        Real* const out_of = balance_of(face.end);
        if (into == nullptr && out_of == nullptr) continue;
        const Real* const from = value_of(face.begin);
        const Real* const to = value_of(face.end);
        const Real* const from_gradient = gradient.data() + Offset{face.begin} * (2 * n);
        const Real* const to_gradient = gradient.data() + Offset{face.end} * (2 * n);
        // The flux is g . n with (F_Q - F_P) / |e| in place of the component of g along the edge e.
        // With n = direct e + rest, rest normal to e, the flux is g . n = direct (F_Q - F_P) + g .
        // rest.
        Real const direct =
            scheme.corrected ? dot(face.along, face.normal) / square(face.along) : 0;
        Vec2 const rest = 0.5 * (face.normal - direct * face.along);
        Vec2 const from_weight = scheme.inverse_area[face.begin] * rest;
        Vec2 const to_weight = scheme.inverse_area[face.end] * rest;
        auto const flux = [&](Index f) {
            return from_weight.x * from_gradient[f] + from_weight.y * from_gradient[n + f] +
                   to_weight.x * to_gradient[f] + to_weight.y * to_gradient[n + f] +
                   direct * (to[f] - from[f]);
        };
        if (into != nullptr && out_of != nullptr) {
            for (Index f = 0; f < n; ++f) {
                Real const through_face = flux(f);
                into[f] += through_face;
                out_of[f] -= through_face;
            }
        } else if (into != nullptr) {
            for (Index f = 0; f < n; ++f) into[f] += flux(f);
        } else {
            for (Index f = 0; f < n; ++f) out_of[f] -= flux(f);
        }
    }
}

// The rows of the scheme are the unknowns by position, then the points of the wall by slot, then
// the points whose value is 0. The equation of an unknown states that the fluxes into its control
// volume sum to 0; known values contribute to the right-hand side. All values are real.
struct NodalEquations {
    NodalGradient scheme;
    Index n = 0, n_wall = 0;
    Index width = 0;      // The number of columns that are treated at a time.
    Span<Real> gradient;  // [n_points * 2 * width] This array is working space.

    void lay_out(Arena& arena, Mesh const& mesh, Index n_edges) noexcept {
        scheme.lay_out(arena, mesh, n_edges);
    }
    void lay_out_work(Arena& arena, Index n_points, Index n_columns) noexcept {
        width = n_columns;
        arena.take(gradient, Offset{n_points} * 2 * width);
    }
    // The pattern of `matrix` must have been built. The function keeps a view of topology.reversed
    // and copies all else.
    void init(Topology const& topology, Matrix const& matrix, bool corrected) noexcept;

    // Writes right-hand sides to the dofs of the unknowns; the dofs on the wall have their values
    // already.
    void set_right_hand_sides(DofValues const& dofs, Index columns) const noexcept;
    // Does what Residual::compute() does for the compact scheme.
    Residual::Norms compute(Residual const& residual, DofValues const& dofs, Index first,
                            Index columns) const noexcept;
    // Computes to = A from, with rows of `width` numbers by position.
    void apply(const Real* from, Real* to) const noexcept;
};

}  // namespace harmorph
