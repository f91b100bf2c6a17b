// The equations of the unknowns by the scheme of nodal gradients, without a matrix, for the values
// of a basis.
#pragma once

#include "operators/nodal_gradient.hpp"
#include "operators/residual.hpp"

namespace harmorph {

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
