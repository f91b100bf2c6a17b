// The plan turns boundary functions into harmonic functions.
#pragma once

#include "mesh/region_counts.hpp"
#include "operators/right_hand_sides.hpp"
#include "plan/flux_rows.hpp"
#include "plan/given_wall.hpp"
#include "plan/refinement.hpp"

namespace harmorph {

// This tells whether solved functions get a largest value and a checksum. Without them the
// functions must not be used by the adjoint or written to files.
enum class Sealing { complete, skipped };

// Equations, their factor, and the final form of solved values. factor() must be called before
// solve() and solve_fields().
class Plan {
public:
    // solve() has memory for this many numbers of modes at a point, beside those of the functions.
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
    // These are the coordinates of the factor.
    std::uint64_t coordinates() const noexcept { return coordinates_; }
    // Selects another operator until the next change; returns false and changes nothing if the plan
    // cannot solve for it. The factor has to be computed again.
    bool change_operator(Operator operator_kind, Index exponent_quarters) noexcept {
        return equations_.change_operator(operator_kind, exponent_quarters);
    }

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
    // Replaces the right-hand sides of the unknowns by values, in place. `report` is that of these
    // fields alone; its residuals are set if fields are refined or measured.
    Status solve_fields(DofValues const& values, bool measured, SolveReport& report,
                        Fault& fault) noexcept;
    // The first function turns the numbers of dofs, which joined points do not have yet, into
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
    OrientedMesh const& cells() const noexcept { return equations_.cells(); }
    RegionCounts const& region_counts() const noexcept { return region_counts_; }
    PointKind kind(Index point) const noexcept { return equations_.kind(point); }
    bool is_unknown(Index point) const noexcept { return unknowns().is_unknown(point); }
    // Returns the point that stands in the equations for all points with the same unknown; a point
    // without an unknown represents itself.
    Index representative(Index point) const noexcept {
        Index const row = unknowns().first_row(point);
        return row < 0 ? point : equations_.point_of(row);
    }
    Index wall_slot(Index point) const noexcept { return unknowns().wall_slot(point); }
    bool couples_xy() const noexcept { return unknowns().couples_xy(); }
    bool slips(Index point) const noexcept { return unknowns().slips(point); }
    // The point must slip.
    Vec2 tangent(Index point) const noexcept { return unknowns().direction(point); }
    bool turns_sides() const noexcept { return unknowns().turns_sides(); }
    Vec2 turn(Index point) const noexcept { return unknowns().turn(point); }
    // Returns the factor from the displacement of `same_point(point)` to that of the point.
    Vec2 turn_of(Index point, Index same) const noexcept {
        return turns_sides() ? product(conjugate(turn(same)), turn(point)) : Vec2{1, 0};
    }
    // Returns the point of the wall or of an unknown that has the values of this one, or none if
    // the values are 0.
    Index same_point(Index point) const noexcept;
    // The mesh point of each slot.
    Span<const Index> wall_points() const noexcept { return wall_point_; }
    GivenWall const& given() const noexcept { return given_; }
    // Returns the place of a point among the given ones (GivenWall::point), or none.
    Index given_index(Index point) const noexcept;

    // The faces that move, and the curves along which points slip.
    FaceDistance const& walls() const noexcept { return equations_.walls(); }
    FaceDistance& walls() noexcept { return equations_.walls(); }
    FaceDistance& walls_at(Points points) noexcept { return equations_.walls_at(points); }
    SlipCurves const& slip_curves() const noexcept { return equations_.slip_curves(); }
    SlipFollowers const& slip_followers() const noexcept { return equations_.slip_followers(); }

    Executor const& executor() const noexcept { return executor_; }
    Equations const& equations() const noexcept { return equations_; }
    AnyEngine const& engine() const noexcept { return engine_; }
    Refinement const& refinement() const noexcept { return refinement_; }

private:
    Unknowns const& unknowns() const noexcept { return equations_.matrix(); }
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
    Span<Real> rows_in_work_;  // This array is used while solved rows become blocks.
    Offset factor_entries_ = 0;
    bool factored_ = false;
};

}  // namespace harmorph
