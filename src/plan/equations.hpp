// The equations of the unknowns of a plan by the chosen operator and scheme, for given coordinates.
// tests/plan/test_laplace.cpp and tests/operators/test_bounded.cpp cover this file.
#pragma once

#include "boundary/distance.hpp"
#include "operators/nodal_equations.hpp"
#include "plan/analysis.hpp"

namespace harmorph {

// Each plan has one object of this class. After init() all is fixed except the coordinates: a
// solution only reads the object, and only assemble(), walls_at() and change_operator() change it.
class Equations {
public:
    // Lays out all except the working space of nodal gradients, see lay_out_nodal_work().
    void lay_out(Arena& arena, Analysis const& analysis) noexcept;
    void lay_out_nodal_work(Arena& arena, Index n_points, Index width) noexcept {
        nodal_.lay_out_work(arena, n_points, width);
    }
    // init() copies all data of the analysis except the matrix and the nodal equations, which take
    // longest and are made by build(), which may run in parallel with other users of the analysis.
    void init(Analysis const& analysis) noexcept;
    void build(Analysis const& analysis) noexcept;
    // Computes the entries for these coordinates. On Status::bad_mesh (an inverted cell) the matrix
    // must not be used.
    Status assemble(Points points, Executor const& executor, Fault& fault) noexcept;
    // Selects another operator, if the matrix and the memory of these equations suffice for it.
    // Otherwise returns false and changes nothing.
    bool change_operator(Operator operator_kind, Index exponent_quarters) noexcept;

    OrientedMesh const& cells() const noexcept { return cells_; }
    // The kernel of the method is never automatic.
    Method const& method() const noexcept { return method_; }
    Matrix const& matrix() const noexcept { return matrix_; }
    NodalEquations const& nodal() const noexcept { return nodal_; }
    // Returns the kind of the point, or of its representative if the point is joined.
    PointKind kind(Index point) const noexcept { return kinds_[point]; }
    SlipCurves const& slip_curves() const noexcept { return slip_curves_; }
    SlipFollowers const& slip_followers() const noexcept { return slip_followers_; }
    // Returns the faces that move, at the coordinates of the last call of assemble() or walls_at().
    FaceDistance const& walls() const noexcept { return walls_; }
    FaceDistance& walls() noexcept { return walls_; }
    FaceDistance& walls_at(Points points) noexcept {
        walls_.build(points);
        return walls_;
    }
    // Returns the fingerprint of the coordinates at the analysis.
    std::uint64_t analysed_coordinates() const noexcept { return analysed_coordinates_; }

    Span<const Index> dof_of() const noexcept { return dof_of_; }  // [n] The dof of each position.
    DofValues dofs(Basis const& basis) const noexcept {
        return {basis, dof_of_, matrix_.components()};
    }
    Index point_of(Index position) const noexcept {
        return dof_of_[position] / matrix_.components();
    }

private:
    void rotate_tangents(Points points) const noexcept;
    Status assemble_cells(Points points, Executor const& executor, Fault& fault) noexcept;
    Status assemble_edges(Points points, Executor const& executor, Fault& fault) noexcept;

    // The members below are copies, as the analysis may have been freed when they are read.
    OrientedMesh cells_;
    Pieces pieces_;  // The pieces of polygons.
    Method method_;
    Span<PointKind> kinds_;  // [n_points]
    Span<Index> dof_of_;
    FaceDistance walls_;
    Span<DelaunayEdge> delaunay_edges_;  // The edges exist for the bounded scheme only.
    std::uint64_t analysed_coordinates_ = 0;
    SlipCurves slip_curves_;
    SlipFollowers slip_followers_;
    // The conductivities of weighted operators: [n_cells], or of Delaunay edges.
    Span<Real> conductivity_;
    // The matrix of the compact or of the bounded scheme; nodal gradients have that of the compact
    // scheme.
    Matrix matrix_;
    NodalEquations nodal_;  // The equations exist for schemes of nodal gradients only.
};

}  // namespace harmorph
