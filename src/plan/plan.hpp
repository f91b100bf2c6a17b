// The plan: boundary functions in, harmonic functions out.
#pragma once

#include "mesh/region_counts.hpp"
#include "operators/right_hand_sides.hpp"
#include "plan/given_wall.hpp"
#include "plan/refinement.hpp"

namespace harmorph {

// Whether solved functions get a largest value and a checksum. Without, the adjoint and files must
// not see them.
enum class Sealing { complete, skipped };

// Equations, their factor, and what solved values become. factor() comes before solve() and
// solve_fields().
class Plan {
public:
    // Numbers of modes at a point, beside those of the functions, that solve() has memory for.
    static constexpr Index most_mode_numbers = 1024;

    void lay_out(Arena& arena, Analysis const& analysis) noexcept;
    void init(Analysis const& analysis) noexcept;

    // On Status::bad_mesh (an inverted cell of moved coordinates), not_positive or cancelled there
    // is no factor.
    Status factor(Points points, Fault& fault) noexcept;
    bool is_factored() const noexcept { return factored_; }
    // Where the equations have been changed since, or belong to other coordinates.
    void forget_factor() noexcept { factored_ = false; }
    std::uint64_t coordinates() const noexcept { return coordinates_; }  // the factor's
    // From now on another operator, until the next change: false, and no change, if the plan cannot
    // solve for it. The factor has to be made again.
    bool change_operator(Operator operator_kind, Index quarters) noexcept {
        return equations_.change_operator(operator_kind, quarters);
    }

    // Of combined functions and modes, which are solved already, the values on the wall stay, and
    // those inside are solved for again.
    Status solve(Basis const& basis, SolveReport& report, Fault& fault,
                 Sealing sealing = Sealing::complete) noexcept;
    // Refuses a basis that was made of a different analysis; an equal one is accepted, and what was
    // derived from one.
    Status check_fit(Basis const& basis, Fault& fault) const noexcept;

    // Vector fields beside the functions; as numbers of dofs.
    DofValues fields(Span<Real> rows, Index first, Index n) const noexcept {
        return {rows, first, n, equations_.dof_of(), wall_point_, equations_.matrix().components()};
    }
    // In place: the right-hand sides of the unknowns become values. `report` is of these fields
    // alone; its residuals are filled in where fields are refined or measured.
    Status solve_fields(DofValues const& values, bool measured, SolveReport& report,
                        Fault& fault) noexcept;
    // The numbers of dofs, which joined points do not have yet, become displacements of points; and
    // the transpose but for joined points.
    void to_displacements(DofValues const& values) const noexcept;
    void to_displacements_transposed(DofValues const& values) const noexcept;

    // cell_of [n_points]: merged cell of each point on a level of agglomeration, or none where it
    // has no unknown.
    Status level_cells(Index level, Span<Index> cell_of, Index& n_cells,
                       Fault& fault) const noexcept;

    // Of a basis with all functions.
    BasisCounts const& basis_counts() const noexcept { return basis_counts_; }

    // The mesh, and what is known of its points.
    Mesh const& mesh() const noexcept { return mesh_; }
    OrientedMesh const& cells() const noexcept { return equations_.cells(); }
    RegionCounts const& region_counts() const noexcept { return region_counts_; }
    PointKind kind(Index point) const noexcept { return equations_.kind(point); }
    bool is_unknown(Index point) const noexcept { return unknowns().is_unknown(point); }
    // The point with the same unknown whose number the equations have; other points stand for
    // themselves.
    Index representative(Index point) const noexcept {
        Index const row = unknowns().first_row(point);
        return row < 0 ? point : equations_.point_of(row);
    }
    Index wall_slot(Index point) const noexcept { return unknowns().wall_slot(point); }
    bool couples_xy() const noexcept { return unknowns().couples_xy(); }
    bool slips(Index point) const noexcept { return unknowns().slips(point); }
    Vec2 tangent(Index point) const noexcept { return unknowns().direction(point); }  // if it slips
    bool turns_sides() const noexcept { return unknowns().turns_sides(); }
    Vec2 turn(Index point) const noexcept { return unknowns().turn(point); }
    // The factor from the displacement of `same_point(point)` to that of the point.
    Vec2 turn_of(Index point, Index same) const noexcept {
        return turns_sides() ? product(conjugate(turn(same)), turn(point)) : Vec2{1, 0};
    }
    // The point of the wall or of an unknown that has the values of this one, or none where they
    // are 0.
    Index same_point(Index point) const noexcept;
    Span<const Index> wall_points() const noexcept { return wall_point_; }  // of each slot
    GivenWall const& given() const noexcept { return given_; }
    // The place of a point among the given ones (GivenWall::point), or none.
    Index given_index(Index point) const noexcept;

    // The faces that move, and the curves along which points slide.
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
    Span<Index> wall_point_;  // [points of the wall] mesh point of each slot
    GivenWall given_;
    Executor executor_;
    Progress progress_;
    BasisCounts basis_counts_;
    MeshFingerprint topology_;
    std::uint64_t conditions_ = 0;   // fingerprint of the problem
    std::uint64_t coordinates_ = 0;  // fingerprint
    RegionCounts region_counts_;
    Span<Real> rows_in_work_;  // while solved rows become blocks
    Offset factor_entries_ = 0;
    bool factored_ = false;
};

}  // namespace harmorph
