// The equations of a part: entries, right-hand sides and residuals whose sums over all parts are
// those of the mesh, by the operators of the whole mesh. A part is to them a mesh of its own, of
// which only the boundary knows more: what the shared boundary says about points that several parts
// have.
#pragma once

#include "basis/basis_source.hpp"
#include "boundary/distance.hpp"
#include "operators/residual.hpp"
#include "ordering/graph.hpp"
#include "parts/shared_boundary.hpp"

namespace harmorph {

// Points, unknowns and slots of the wall are those of the part. A point of the boundary that is not
// in the part is on no wall here. Points that are joined (cuts, periodic pairs) have one unknown,
// named after one of them in all parts.
struct PartEquations {
    Part part;  // a copy of the views: the caller keeps the part
    PartProblem problem;
    SharedBoundary shared;
    Topology topology;      // the part's, with points joined
    Boundary no_loops;      // what the basis of a part knows of the boundary: nothing
    Span<PointKind> kinds;  // [n_points]
    Span<Vec2> tangent;     // [n_points] where there are slip lines
    Wall wall;
    Span<Index> slot;   // [n_points]
    Span<Index> local;  // [points of the shared boundary] the first point of the part
                        // that each stands for, or none
    FaceDistance faces;
    Span<Real> conductivity;  // [own cells] of weighted operators
    Span<Offset> name;        // [unknowns]
    Span<Index> is_own;       // [unknowns] 1: of an own cell
    Span<Index> dof_of;       // [unknowns]
    Matrix matrix;
    Residual residual;
    Span<Real> rows_in_work;
    Span<Index> order;  // [unknowns] as they are: while the matrix is built
    MeshFingerprint mesh_fingerprint;
    std::uint64_t coordinates = 0, conditions_fingerprint = 0;

    // From the counts of part and edges alone: enough for every shared boundary of so many edges.
    void lay_out(Arena& arena, Part const& of, PartProblem const& asked, Index n_edges,
                 Index n_curves, Index n_conditions, Index n_control) noexcept;
    // shared.curves and shared.conditions have been set.
    Status run(Span<const OpenEdge> edges, Fault& fault) noexcept;

    BasisSource basis_source() const noexcept;
    // Were the rows made from these equations, or from equal ones?
    bool made(Basis const& rows) const noexcept;
    DofValues dofs(Basis const& basis) const noexcept {
        return {basis, dof_of, matrix.components()};
    }
    Index columns(Basis const& basis) const noexcept { return dofs(basis).columns(matrix); }
    // Numbers of an unknown in the real system, 1 or 2.
    Index numbers() const noexcept { return matrix.planes(); }

    // Entries of rows first .. first+n-1, visit(row, column, re, im), row <= column.
    template <class Visit>
    void for_each_entry(Index first, Index n, Visit visit) const noexcept;

    // One column of the unknowns, and back.
    void get(DofValues const& values, Index column, Real* numbers) const noexcept;
    void set(DofValues const& values, Index column, const Real* numbers) const noexcept;
    void find_residual(DofValues const& values, Index column, Real* numbers) const noexcept;
    // Values of joined points, and of points that slide, from those of the unknowns.
    void finish(DofValues const& values) const noexcept;
    void finish(Basis const& basis, Real largest) const noexcept;

private:
    Graph graph;  // shares its memory with `residual` and `rows_in_work`: gone after run()

    void join_points() noexcept;
    void find_wall() noexcept;
    void find_unknowns() noexcept;
    void assemble() noexcept;
};

template <class Visit>
void PartEquations::for_each_entry(Index first, Index n, Visit visit) const noexcept {
    bool const complex = matrix.is_complex();
    for (Index row = first; row < first + n; ++row) {
        if (is_own[row] != 0) visit(row, row, matrix.diagonal[row], 0.0);
        for (Offset e = matrix.start[row]; e < matrix.start[row + 1]; ++e) {
            visit(row, matrix.column[e], matrix.value[e], complex ? matrix.imaginary[e] : 0.0);
        }
    }
}

}  // namespace harmorph
