// The unknowns' equations by the scheme of nodal gradients, matrix-free, for the values of a basis.
#pragma once

#include "harmorph/operators/nodal_gradient.hpp"
#include "harmorph/operators/residual.hpp"

namespace harmorph {

// Rows of the scheme are the unknowns by position, then the points of the wall by their slots, then those whose value is 0.
// The equation of an unknown is that nothing is left in its volume; known values go to the right-hand side. Real values.
struct NodalEquations {
    NodalGradient scheme;
    Index n = 0, n_wall = 0;
    Index width = 0;      // columns at a time
    Span<Real> gradient;  // [n_points * 2 * width] working space

    void lay_out(Arena& arena, Mesh const& mesh, Index n_edges) noexcept { scheme.lay_out(arena, mesh, n_edges); }
    void lay_out_work(Arena& arena, Index n_points, Index its_width) noexcept {
        width = its_width;
        arena.take(gradient, Offset{n_points} * 2 * width);
    }
    // matrix: once its pattern is built. `reversed` of the topology is kept as a view, the rest is copied.
    void init(Topology const& topology, Matrix const& matrix, bool corrected) noexcept;

    // In the unknowns' lines; those of the wall hold its values.
    void set_right_hand_sides(Lines const& lines, Index columns) const noexcept;
    // What Residual::compute does for the compact scheme.
    Residual::Norms compute(Residual const& residual, Lines const& lines, Index first, Index columns) const noexcept;
    // to = A from, rows of `width` by position.
    void apply(const Real* from, Real* to) const noexcept;
};

}  // namespace harmorph
