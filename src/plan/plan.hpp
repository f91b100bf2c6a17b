// The plan converts boundary functions into harmonic functions.
#pragma once

#include "mesh/topology.hpp"
#include "operators/right_hand_sides.hpp"
#include "plan/analysis.hpp"
#include "plan/flux_rows.hpp"
#include "plan/refinement.hpp"

namespace harmorph {

// The data of the boundary that a plan keeps for displacements that are given from call to call.

// The arrays are empty if no displacements are given.
struct GivenWall {
    // The number of fields that are solved as one block of right-hand sides.
    static constexpr Index fields_at_once = 12;

    Span<Index> point;     // [given points] The points in the order of their slots.
    Index first_slot = 0;  // The given slots begin here.
    // The points that are joined to another one: beyond a cut, or periodic images.
    Span<Index> joined;
    Span<Index> boundary_point, loop_start, interface_side;  // See BoundaryFaces.

    BoundaryFaces faces() const noexcept { return {boundary_point, loop_start, interface_side}; }

    void lay_out(Arena& arena, Analysis const& analysis) noexcept;
    void init(Analysis const& analysis) noexcept;

    // Returns the number of right-hand sides of a block of fields, or 0 without given
    // displacements.
    static Index columns(Analysis const& analysis) noexcept;
};

// Tells whether solved functions get a largest value and a checksum. Without both, the functions
// must not be used by the adjoint or written to files.
enum class Sealing { complete, skipped };

// Equations, their factor, and the final form of solved values. factor() must be called before
// solve() and solve_fields().
class Plan {
public:
    // solve() has memory for this many numbers of modes at a point, beside the numbers of the
    // functions.
    static constexpr Index max_mode_numbers = 1024;

    void lay_out(Arena& arena, Analysis const& analysis) noexcept;
    void init(Analysis const& analysis) noexcept;

    // After Status::bad_mesh (an inverted cell of moved coordinates), not_positive or cancelled
    // there is no factor.
    Status factor(Points points, Fault& fault) noexcept;
    bool is_factored() const noexcept { return factored_; }
    // Must be called when the equations have changed since factor(), or belong to other
    // coordinates.
    void forget_factor() noexcept { factored_ = false; }
    // Returns the fingerprint of the coordinates of the factor.
    std::uint64_t coordinates() const noexcept { return coordinates_; }

    // Solves for the functions. Combined functions and modes are solved already: their values on
    // the wall stay, and the values inside are solved for again.
    Status solve(Basis const& basis, SolveReport& report, Fault& fault,
                 Sealing sealing = Sealing::complete) noexcept;
    // Refuses a basis that was made from a different analysis. A basis from an equal analysis is
    // accepted, and so are bases that are derived from it.
    Status check_fit(Basis const& basis, Fault& fault) const noexcept;

    // Returns a view of n vector fields, from number `first` on, that `rows` stores in the layout
    // of the functions: a row of numbers for each dof.
    DofValues fields(Span<Real> rows, Index first, Index n) const noexcept {
        return {rows, first, n, equations_.dof_of(), wall_point_, equations_.matrix().components()};
    }
    // Replaces the right-hand sides of the unknowns by values, in place. `report` tells of these
    // fields alone; its residuals are set if fields are refined or measured.
    Status solve_fields(DofValues const& values, bool measured, SolveReport& report,
                        Fault& fault) noexcept;
    // The first function converts the numbers of dofs, which joined points do not have yet, into
    // displacements of points. The second one is the transpose, except for joined points.
    void to_displacements(DofValues const& values) const noexcept;
    void to_displacements_transposed(DofValues const& values) const noexcept;

    // Fills cell_of [n_points] with the merged cell of each point on a level of agglomeration, or
    // none for a point without unknown.
    Status level_cells(Index level, Span<Index> cell_of, Index& n_cells,
                       Fault& fault) const noexcept;

    // Returns the counts of a basis with all functions.
    BasisCounts const& basis_counts() const noexcept { return basis_counts_; }

    // The functions below tell about the mesh and its points.
    Mesh const& mesh() const noexcept { return mesh_; }
    RegionCounts const& region_counts() const noexcept { return region_counts_; }
    // Which points are unknown, where they slip, and how they are rotated.
    Unknowns const& unknowns() const noexcept { return equations_.matrix(); }
    // Returns the point that stands in the equations for all points with the same unknown; a point
    // without an unknown represents itself.
    Index representative(Index point) const noexcept {
        Index const row = unknowns().first_row(point);
        return row < 0 ? point : equations_.point_of(row);
    }
    // Returns the factor from the displacement of `same_point(point)` to that of the point.
    Vec2 rotation_of(Index point, Index same) const noexcept {
        if (!unknowns().has_rotated_sides()) return {1, 0};
        return product(conjugate(unknowns().rotation(same)), unknowns().rotation(point));
    }
    // Returns the point of the wall or of an unknown that has the values of this one, or none if
    // the values are 0.
    Index same_point(Index point) const noexcept;
    // The mesh point of each slot.
    Span<const Index> wall_points() const noexcept { return wall_point_; }
    GivenWall const& given() const noexcept { return given_; }
    // Returns the place of a point among the given ones (GivenWall::point), or none.
    Index given_index(Index point) const noexcept;

    Executor const& executor() const noexcept { return executor_; }
    // The factor has to be computed again after a change of the operator.
    Equations& equations() noexcept { return equations_; }
    Equations const& equations() const noexcept { return equations_; }
    AnyEngine const& engine() const noexcept { return engine_; }
    Refinement const& refinement() const noexcept { return refinement_; }

private:
    Status solve_rows(DofValues const& dofs, SolveReport& report, Fault& fault) noexcept;
    void clear_all_but_wall(DofValues const& dofs) const noexcept;

    Mesh mesh_;
    Equations equations_;
    AnyEngine engine_;
    Refinement refinement_;
    Span<Index> wall_point_;  // [points of the wall] The mesh point of each slot.
    GivenWall given_;
    FluxRows fluxes_;
    Executor executor_;
    Progress progress_;
    BasisCounts basis_counts_;
    MeshFingerprint topology_;
    std::uint64_t conditions_ = 0;   // The fingerprint of the conditions.
    std::uint64_t coordinates_ = 0;  // The fingerprint of the factor's coordinates.
    RegionCounts region_counts_;
    Span<Real> rows_in_work_;  // Working memory while solved rows become blocks.
    Offset factor_entries_ = 0;
    bool factored_ = false;
};

}  // namespace harmorph
