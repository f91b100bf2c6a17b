// What a plan solves: the unknowns' equations by the chosen operator and scheme, for the
// coordinates at hand.
#pragma once

#include "boundary/distance.hpp"
#include "operators/nodal_equations.hpp"
#include "plan/analysis.hpp"

namespace harmorph {

struct Equations {
    OrientedMesh cells;  // with a copy of the orientations and the pieces: the analysis may be gone
    Pieces pieces;       // of polygons
    Method method;       // the kernel is never automatic here
    Span<PointKind> kinds;                   // [n_points] a copy, like the orientations;
                                             // of joined points that of the representative
    Span<Index> dof_of;                      // [n] dof of each position
    FaceDistance wall;                       // faces that move
    Span<DelaunayEdge> delaunay_edges;       // bounded scheme only
    std::uint64_t analysed_coordinates = 0;  // fingerprint of the coordinates at the analysis
    SlipCurves slip_curves;                  // copies
    SlipFollowers slip_followers;
    Span<Real> conductivity;  // of weighted operators: [n_cells], or of Delaunay edges
    Matrix matrix;  // of the compact or the bounded scheme; beside nodal gradients the compact
                    // scheme's
    NodalEquations nodal;  // schemes of nodal gradients only

    // Without the working space of nodal gradients: see NodalEquations::lay_out_work.
    void lay_out(Arena& arena, Analysis const& analysis) noexcept;
    // init() takes over everything but the matrix and the nodal equations. These take longest and
    // are made by build(), which may run in parallel with other users of the analysis.
    void init(Analysis const& analysis) noexcept;
    void build(Analysis const& analysis) noexcept;
    // Computes the entries for these coordinates. On Status::bad_mesh (an inverted cell) the matrix
    // must not be used.
    Status assemble(Points points, Executor const& executor, Fault& fault) noexcept;
    // From now on another operator, for which the matrix and the memory of these equations suffice:
    // false if they do not.
    bool change_operator(Operator operator_kind, Index quarters) noexcept;

    DofValues dofs(Basis const& basis) const noexcept {
        return {basis, dof_of, matrix.components()};
    }
    Index point_of(Index position) const noexcept { return dof_of[position] / matrix.components(); }

private:
    void turn_frames(Points points) const noexcept;
    Status assemble_cells(Points points, Executor const& executor, Fault& fault) noexcept;
    Status assemble_edges(Points points, Executor const& executor, Fault& fault) noexcept;
};

}  // namespace harmorph
