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

struct Plan {
    // Numbers of modes at a point, beside those of the functions, that solve() has memory for.
    static constexpr Index most_mode_numbers = 1024;

    Mesh mesh;
    Equations equations;
    AnyEngine engine;
    Refinement refinement;
    Span<Index> wall_point;  // [points of the wall] mesh point of each slot
    GivenWall given;
    Executor executor;
    Progress progress;
    BasisCounts basis_counts;
    MeshFingerprint topology;
    std::uint64_t conditions = 0;   // fingerprint of the problem
    std::uint64_t coordinates = 0;  // fingerprint of the coordinates that the factor belongs to
    RegionCounts region_counts;     // for untangling
    Span<Real> rows_in_work;        // while solved rows become blocks
    Offset factor_entries = 0;
    bool factored = false;

    void lay_out(Arena& arena, Analysis const& analysis) noexcept;
    void init(Analysis const& analysis) noexcept;

    // On Status::bad_mesh (an inverted cell of moved coordinates), not_positive or cancelled there
    // is no factor.
    Status factor(Points points, Fault& fault) noexcept;
    // Of combined functions and modes, which are solved already, the values on the wall stay, and
    // those inside are solved for again.
    Status solve(Basis const& basis, SolveReport& report, Fault& fault,
                 Sealing sealing = Sealing::complete) noexcept;
    // cell_of [n_points]: merged cell of each point on a level of agglomeration, or none where it
    // has no unknown.
    Status level_cells(Index level, Span<Index> cell_of, Index& n_cells,
                       Fault& fault) const noexcept;
    // Refuses a basis that was made of a different analysis; an equal one is accepted, and what was
    // derived from one.
    Status check_fit(Basis const& basis, Fault& fault) const noexcept;

    // The dof of a slipping point is a movement along the tangent. turn_slipping_points() makes of
    // it movements along x and y; the other one is the transpose. Nothing to do where x and y are
    // not coupled.
    void turn_slipping_points(DofValues const& values) const noexcept;
    void turn_slipping_points_back(DofValues const& values) const noexcept;
    // The dof of a point on a side of a passage becomes the displacement of the point, once joined
    // points have the dofs of the points that they are joined to. Nothing to do where no side is
    // turned.
    void turn_sides(DofValues const& values) const noexcept;
    void turn_sides_back(DofValues const& values) const noexcept;  // the transpose, point by point
    // What turns the displacement of `same_point(point)` into that of the point.
    Vec2 turn_of(Index point, Index same) const noexcept;
    // The point of the wall or of an unknown that has the values of this one, or none where they
    // are 0.
    Index same_point(Index point) const noexcept;
    // The place of a point among the given ones (GivenWall::point), or none.
    Index given_index(Index point) const noexcept;

private:
    Status solve_rows(DofValues const& dofs, SolveReport& report, Fault& fault) noexcept;
    void clear_all_but_wall(DofValues const& dofs) const noexcept;
    template <class Turn>
    void for_each_turned(DofValues const& values, Turn const& turn) const noexcept;
    template <class Turn>
    void for_each_slipping(DofValues const& values, Turn const& turn) const noexcept;
};

}  // namespace harmorph
