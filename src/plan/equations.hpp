// What a plan solves: the unknowns' equations by the chosen operator and scheme, for the
// coordinates at hand.
#pragma once

#include "boundary/distance.hpp"
#include "operators/nodal_equations.hpp"
#include "plan/analysis.hpp"

namespace harmorph {

// A plan has one. After init() all but the coordinates is fixed: who solves only reads, but for
// assemble(), walls_at() and change_operator().
class Equations {
public:
    // Without the working space of nodal gradients: see lay_out_nodal_work().
    void lay_out(Arena& arena, Analysis const& analysis) noexcept;
    void lay_out_nodal_work(Arena& arena, Index n_points, Index width) noexcept {
        nodal_.lay_out_work(arena, n_points, width);
    }
    // init() takes over everything but the matrix and the nodal equations. These take longest and
    // are made by build(), which may run in parallel with other users of the analysis.
    void init(Analysis const& analysis) noexcept;
    void build(Analysis const& analysis) noexcept;
    // Computes the entries for these coordinates. On Status::bad_mesh (an inverted cell) the matrix
    // must not be used.
    Status assemble(Points points, Executor const& executor, Fault& fault) noexcept;
    // From now on another operator, for which the matrix and the memory of these equations suffice:
    // false, and no change, if they do not.
    bool change_operator(Operator operator_kind, Index quarters) noexcept;

    OrientedMesh const& cells() const noexcept { return cells_; }
    Method const& method() const noexcept { return method_; }  // its kernel is never automatic
    Matrix const& matrix() const noexcept { return matrix_; }
    NodalEquations const& nodal() const noexcept { return nodal_; }
    // Of joined points that of the representative.
    PointKind kind(Index point) const noexcept { return kinds_[point]; }
    SlipCurves const& slip_curves() const noexcept { return slip_curves_; }
    SlipFollowers const& slip_followers() const noexcept { return slip_followers_; }
    // The faces that move, where assemble() or walls_at() have last seen them.
    FaceDistance const& walls() const noexcept { return walls_; }
    FaceDistance& walls() noexcept { return walls_; }
    FaceDistance& walls_at(Points points) noexcept {
        walls_.build(points);
        return walls_;
    }
    // Of the coordinates at the analysis.
    std::uint64_t analysed_coordinates() const noexcept { return analysed_coordinates_; }

    Span<const Index> dof_of() const noexcept { return dof_of_; }  // [n] dof of each position
    DofValues dofs(Basis const& basis) const noexcept {
        return {basis, dof_of_, matrix_.components()};
    }
    Index point_of(Index position) const noexcept {
        return dof_of_[position] / matrix_.components();
    }

private:
    void turn_tangents(Points points) const noexcept;
    Status assemble_cells(Points points, Executor const& executor, Fault& fault) noexcept;
    Status assemble_edges(Points points, Executor const& executor, Fault& fault) noexcept;

    // Copies, as the analysis may be gone when they are read.
    OrientedMesh cells_;
    Pieces pieces_;  // of polygons
    Method method_;
    Span<PointKind> kinds_;  // [n_points]
    Span<Index> dof_of_;
    FaceDistance walls_;
    Span<DelaunayEdge> delaunay_edges_;  // bounded scheme only
    std::uint64_t analysed_coordinates_ = 0;
    SlipCurves slip_curves_;
    SlipFollowers slip_followers_;
    Span<Real> conductivity_;  // of weighted operators: [n_cells], or of Delaunay edges
    Matrix matrix_;  // of the compact or the bounded scheme; beside nodal gradients the compact
                     // scheme's
    NodalEquations nodal_;  // schemes of nodal gradients only
};

}  // namespace harmorph
