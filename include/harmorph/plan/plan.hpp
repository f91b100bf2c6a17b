// The plan: boundary functions in, harmonic functions out. Chooses operator and engine, fills and seals the basis.
#pragma once

#include "harmorph/plan/analysis.hpp"
#include "harmorph/direct/bicgstab.hpp"
#include "harmorph/boundary/distance.hpp"
#include "harmorph/multigrid/full_approximation.hpp"
#include "harmorph/direct/multifrontal.hpp"
#include "harmorph/multigrid/multigrid.hpp"
#include "harmorph/operators/nodal_equations.hpp"
#include "harmorph/mesh/region_counts.hpp"
#include "harmorph/operators/right_hand_sides.hpp"

namespace harmorph {

struct SolveReport {
    Index unknowns = 0, functions = 0;
    Real residual = 0;
    Index residual_function = none;
    Real missed = 0;              // largest residual of those that are more than rounding of values that are right
    Index missed_function = none;
    Index refinements = 0;
    Real error = 0;               // of the direct engine, beside the largest value, as far as it can be told
    Index error_function = none;
    IterationReport iteration;
    Offset factor_entries = 0;
};

struct Plan {
    Mesh mesh;
    Method method;
    Progress progress;
    BasisCounts basis_counts;
    Topology topology;             // fingerprints of mesh and problem
    std::uint64_t conditions = 0;
    Offset factor_entries = 0;
    RegionCounts region_counts;     // for untangling
    std::uint64_t coordinates = 0;  // fingerprint of those the factor belongs to
    bool factored = false;
    bool factor_trusted = false;    // nothing cancelled in it: solutions need no refinement
    Span<Index> line_of;          // [n] line of values of each position
    Span<std::uint8_t> reversed;  // [n_cells]
    FaceDistance wall;            // faces that move
    Span<DelaunayEdge> delaunay_edges;       // bounded scheme only
    std::uint64_t analysed_coordinates = 0;  // fingerprint of those the edges belong to
    Span<Real> conductivity;      // of weighted operators: [n_cells], or of Delaunay edges
    Matrix matrix;
    Multifrontal engine;          // of the engines, this one,
    Span<std::uint8_t> faces;     // [entries] which of them are mesh edges, for
    Multigrid multigrid;          // this one
    FullApproximation fas;        // or this one
    NodalEquations nodal;         // schemes of nodal gradients only; the matrix is the compact scheme's
    Residual residual;            // in the place of the engine's stack or vectors, as is
    BiconjugateGradients biconjugate;  // this one: nodal gradients with the direct engine

    void lay_out(Arena& arena, Analysis const& analysis) noexcept;
    void init(Analysis const& analysis) noexcept;

    // On Status::bad_mesh (an inverted cell of moved coordinates), not_positive or cancelled there is no factor.
    Status factor(Points points, Fault& fault) noexcept;
    Status solve(Basis const& basis, SolveReport& report, Fault& fault) noexcept;
    // cell_of [n_points]: merged cell of each point on a level of agglomeration, or none where it has no unknown.
    Status level_cells(Index level, Span<Index> cell_of, Index& n_cells, Fault& fault) const noexcept;
    // Is the basis of the same analysis, or of one that is equal?
    Status check_fit(Basis const& basis, Fault& fault) const noexcept;
    Index point_of(Index position) const noexcept { return line_of[position] / matrix.components(); }

private:
    Status assemble(Points points, Fault& fault) noexcept;
    Status assemble_cells(Points points, Fault& fault) noexcept;
    Status assemble_edges(Points points, Fault& fault) noexcept;
    void lay_out_engine(Arena& arena, Analysis const& analysis, Index columns) noexcept;
    void build_matrix(Analysis const& analysis) noexcept;
    void init_engine(Analysis const& analysis) noexcept;
    Status factor_engine(Points points, Fault& fault) noexcept;
    Status solve_engine(Rows const& values, IterationReport& report, Fault& fault) noexcept;
    Lines lines(Basis const& basis) const noexcept { return {basis, line_of, matrix.components()}; }
    void turn_slipping_lines(Basis const& basis) const noexcept;
    void copy_joined_points(Basis const& basis) const noexcept;
    // Sets factor_trusted.
    Status test_factor(Fault& fault) noexcept;
    // The largest value where negative conductances are sources; real matrices and the direct engine only.
    Status raise_by_negative(Real& rise, Fault& fault) noexcept;
    Residual::Norms measure(Lines const& all, Index first, Index n) const noexcept;
    Status solve_rest(Index n, Index& iterations, Fault& fault) noexcept;
    Status refine(Basis const& basis, SolveReport& report, Fault& fault) noexcept;
    struct Refined {
        Residual::Norms norms;
        Real error[Residual::widest] = {};  // what values are thought to be off, beside the largest
        Index steps = 0, iterations = 0;
    };
    // Are these columns' residuals rounding, and their factor one that leaves no more?
    bool need_nothing(Lines const& all, Index first, Index n, Refined& its) const noexcept;
    Status refine_columns(Lines const& all, Index first, Index n, Refined& its, Fault& fault) noexcept;
    bool is_only_rounding(Lines const& all, Index column, Real error) const noexcept;
    Status judge(SolveReport const& report, Fault& fault) const noexcept;
};

// Makes an unsolved basis in a block that has been laid out for the analysis's counts.
void init_basis(Basis const& basis, BasisCounts const& counts, Analysis const& analysis) noexcept;

}  // namespace harmorph
