// The equations of a part: entries, right-hand sides and residuals whose sums over all parts are
// those of the mesh, computed by the operators of the whole mesh. To the operators a part is a mesh
// of its own. Only the boundary knows more: for points that several parts have, it contains the
// data of the shared boundary. tests/parts/test_parts.cpp covers this file.
#pragma once

#include "basis/basis_source.hpp"
#include "boundary/distance.hpp"
#include "operators/residual.hpp"
#include "ordering/graph.hpp"
#include "parts/shared_boundary.hpp"

namespace harmorph {

// Points, unknowns and slots of the wall are numbered in the part. A point of the boundary that is
// not in the part is on no wall here. Points that are joined (cuts, periodic pairs) have one
// unknown, with the same global number in all parts.
struct PartEquations {
    Part part;  // A copy of the views; the arrays belong to the caller's part.
    PartProblem problem;
    SharedBoundary shared;
    Topology topology;  // The topology of the part, with points joined.
    // The basis of a part contains no boundary loops, so this boundary is empty.
    Boundary no_loops;
    Span<PointKind> kinds;  // [n_points]
    Span<Vec2> tangent;     // [n_points] This array exists if there are slip lines.
    Wall wall;
    Span<Index> slot;  // [n_points]
    // [points of the shared boundary] The first point of the part that has the place of each, or
    // none.
    Span<Index> local;
    FaceDistance faces;
    Span<Real> conductivity;      // [own cells] This array exists for weighted operators.
    Span<Offset> unknown_number;  // [unknowns] The global number of each unknown.
    Span<Index> is_own;  // [unknowns] The value is 1 if the unknown belongs to an own cell.
    Span<Index> dof_of;  // [unknowns] The dof of each unknown.
    Matrix matrix;
    Residual residual;
    Span<Real> rows_in_work;
    Span<Index> order;  // [unknowns] The identity; used while the matrix is built.
    MeshFingerprint mesh_fingerprint;
    std::uint64_t coordinates = 0, conditions_fingerprint = 0;

    // Lays out by the counts of part and edges alone, which suffices for every shared boundary of
    // so many edges.
    void lay_out(Arena& arena, Part const& own_part, PartProblem const& asked, Index n_edges,
                 Index n_curves, Index n_conditions, Index n_control) noexcept;
    // shared.curves and shared.conditions must have been set.
    Status run(Span<const OpenEdge> edges, Fault& fault) noexcept;

    BasisSource basis_source() const noexcept;
    // Tells whether the rows were made from these equations, or from equal ones.
    bool matches(Basis const& rows) const noexcept;
    DofValues dofs(Basis const& basis) const noexcept {
        return {basis, dof_of, matrix.components()};
    }
    Index columns(Basis const& basis) const noexcept { return dofs(basis).columns(matrix); }
    // Returns how many numbers an unknown has in the real system, 1 or 2.
    Index numbers() const noexcept { return matrix.planes(); }

    // Calls visit(row, column, re, im) for the entries of rows first .. first+n-1, with row <=
    // column.
    template <class Visit>
    void for_each_entry(Index first, Index n, Visit visit) const noexcept;

    // get() copies one column of the unknowns to `numbers`; set() copies it back.
    void get(DofValues const& values, Index column, Real* numbers) const noexcept;
    void set(DofValues const& values, Index column, const Real* numbers) const noexcept;
    void find_residual(DofValues const& values, Index column, Real* numbers) const noexcept;
    // Sets the values of joined points, and of points that slip, from those of the unknowns.
    void finish(DofValues const& values) const noexcept;
    void finish(Basis const& basis, Real largest) const noexcept;

private:
    // The graph shares its memory with `residual` and `rows_in_work`, and is lost after run().
    Graph graph;

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
