// Displacement fields that are given at points of the wall and carried to all mesh points by the
// factor of a plan; and the transpose, from derivatives by the mesh points to derivatives by the
// given points.
//
// Let w be the values on the wall, C the couplings of unknowns to the wall and A the matrix of the
// unknowns. The field inside is u = -A^-1 C w. A is Hermitian, so the transpose is w' = j_wall -
// C^H A^-1 j_inside: one solution with the same factor.
#pragma once

#include "basis/point_subset.hpp"
#include "plan/plan.hpp"

namespace harmorph {

struct Displacement {
    Index n_fields = 0;
    Span<Index> place;  // [given points] The first place of each point in the caller's list.
    // Blocks of GivenWall::fields_at_once fields: rows of all points, with the x of all fields of
    // the block, then the y; first the given values, then the result.
    Span<Real> value;
    Span<Real> source;  // [rows of a block] The right-hand sides of the transpose.

    void lay_out(Arena& arena, Plan const& plan, Index fields) noexcept;

    // Finds the given points in a list of them. The list may contain a point twice, and also both
    // sides of a cut.
    Status find_places(Plan const& plan, PointList const& list, Fault& fault) noexcept;

    // Sets all fields to 0.
    void clear(Plan const& plan) const noexcept;
    // Sets one field at the points of the list. Refuses displacements that are not finite or exceed
    // the range of coordinates, and different displacements for the same point.
    Status set(Plan const& plan, PointList const& list, Index field, Points wall,
               Fault& fault) const noexcept;
    // Solves for the fields inside. If `measured` is true, the report has residuals; for a trusted
    // factor their computation is not worth the time.
    Status solve(Plan& plan, bool measured, SolveReport& report, Fault& fault) const noexcept;
    // Refuses a boundary that crosses itself, or coordinates that exceed the range, at from +
    // displacement.
    Status check_target(Plan const& plan, Index field, Points from, Fault& fault) const noexcept;
    // Writes from + displacement for the fields first .. first + number of arrays - 1 of one block;
    // without `from` it writes the displacement.
    void write(Plan const& plan, Index first, Points from,
               Span<const MutablePoints> to) const noexcept;

    // Returns the displacement of a point in one field, after solve().
    Vec2 at(Plan const& plan, Index field, Index point) const noexcept {
        return block_of(plan, field).field(field)[point];
    }

    // Sets the derivatives by all mesh points, for fields of one block. Refuses numbers that are
    // not finite.
    Status set_derivatives(Plan const& plan, Index first, Span<const Points> derivatives,
                           Fault& fault) const noexcept;
    Status solve_transposed(Plan& plan, bool measured, SolveReport& report,
                            Fault& fault) const noexcept;
    // Writes the derivatives by the points of the list: complete at the first place of a point, and
    // 0 where the point is repeated.
    void write_gradient(Plan const& plan, PointList const& list, Index field,
                        MutablePoints gradient) const noexcept;

private:
    struct Block {
        Index first, n;  // The first field and the number of fields.
        Span<Real> rows;

        Index length() const noexcept { return 2 * n; }
        Real* row(Index point) const noexcept { return rows.data() + Offset{point} * length(); }
        // Returns one field in the form of a caller's arrays.
        MutablePoints field(Index number) const noexcept {
            return {rows.data() + (number - first), rows.data() + (number - first + n), length()};
        }
    };
    Block block_of(Plan const& plan, Index field) const noexcept;
    template <class Body>
    Status for_each_block(Plan const& plan, Fault& fault, Body const& body) const noexcept;
    static DofValues dofs(Plan const& plan, Block const& block) noexcept;
};

// A basis with more functions: modes are given at points of the wall, and solved as displacement
// fields.
struct Modes {
    Index n = 0, numbers = 1;     // The numbers of a value: 1 (real) or 2 (complex).
    const Real* value = nullptr;  // [n * list.count() * numbers] Mode by mode.

    Vec2 at(Index mode, Index k, Index n_points) const noexcept {
        const Real* const entry = value + (Offset{mode} * n_points + k) * numbers;
        return {entry[0], numbers == 2 ? entry[1] : 0};
    }
    // Refuses modes that are not finite, or that are 0.
    Status check(Index n_points, Fault& fault) const noexcept;
};

// Returns the counts with n more functions, from modes with these numbers.
BasisCounts tabulated_counts(Basis const& from, Index n, Index numbers) noexcept;
// Returns the number of displacement fields to solve: a matrix takes two for each mode, one for
// amplitudes along x and one along y.
inline Index fields_of(Basis const& from, Index n) noexcept {
    return from.kind() == ValueKind::matrix ? 2 * n : n;
}

// The memory of the solution.
struct ModeWork {
    Displacement displacement;
    Span<Vec2> wall;  // [points of the list] One mode.

    void lay_out(Arena& arena, Plan const& plan, Index n_points, Index n_fields) noexcept {
        displacement.lay_out(arena, plan, n_fields);
        arena.take(wall, n_points);
    }
};

// Solves for the functions. `to` has been laid out for tabulated_counts(), `work` for the fields;
// find_places() must have been called with the list.
Status tabulate(Plan& plan, Basis const& from, PointList const& list, Modes const& modes,
                ModeWork const& work, Basis const& to, SolveReport& report, Fault& fault) noexcept;

}  // namespace harmorph
