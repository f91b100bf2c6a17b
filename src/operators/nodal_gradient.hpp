// Laplace's operator from averaged nodal gradients: the scheme of the paper's text.
#pragma once

#include "mesh/median_dual.hpp"

namespace harmorph {

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
        // Half of each diagonal, turned by 90 degrees: the weight of the difference along the other
        // diagonal.
        Vec2 across[2];
    };

    OrientedMesh mesh;  // The array `reversed` belongs to the caller.
    bool corrected = false;
    Span<Index> row_of;  // [n_points]
    Edges edges;  // This is a copy, as init() runs once, and measure() runs for many coordinates.
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

}  // namespace harmorph
