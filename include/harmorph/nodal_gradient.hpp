// Laplace's operator from averaged nodal gradients: the scheme of the paper's text.
#pragma once

#include "harmorph/median_dual.hpp"

namespace harmorph {

// @@
struct NodalGradient {
    Mesh mesh;
    Span<std::uint8_t> reversed;    // [n_cells]
    Span<Index> representative;     // [n_points]
    MedianDual dual;
    Span<Real> inverse_area;        // [n_points] of all cells round a point; 0 where there is none
    Points points;                  // of build(): must stay as long as apply() is called
    bool corrected = false;

    void lay_out(Arena& arena, Mesh const& its_mesh, Index n_edges) noexcept;
    void build(Mesh const& its_mesh, Points its_points, Edges const& edges, Span<const Index> its_representative,
               Span<const std::uint8_t> its_reversed, bool with_correction) noexcept;

    // balance [n_points * n]: flux into the volume of each point, for n functions with values [n_points * n]: rows of n.
    // gradient [n_points * 2 n]: working space; holds all x and then all y components of a point. Joined points and those of no cell have balance 0.
    void apply(Span<const Real> value, Index n, Span<Real> gradient, Span<Real> balance) const noexcept;

private:
    void add_cells(Span<const Real> value, Index n, Span<Real> gradient) const noexcept;
};

}  // namespace harmorph
