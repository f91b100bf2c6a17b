// Displacement fields that are given at points of the wall, carried to all mesh points by the
// factor of a plan; and the transpose, from derivatives by the mesh points to derivatives by the
// given points.
//
// With w the values on the wall, C the couplings of unknowns to the wall and A the matrix of the
// unknowns, the field inside is u = -A^-1 C w. A is Hermitian, so the transpose is w' = j_wall -
// C^H A^-1 j_inside: one solution with the same factor.
#pragma once

#include "basis/point_subset.hpp"
#include "plan/plan.hpp"

namespace harmorph {

struct Displacement {
    Index n_fields = 0;
    Span<Index> place;  // [given points] where in the caller's list a point stands first
    // Blocks of GivenWall::fields_at_once fields: rows of all points, the x of all fields of the
    // block, then the y. First what is given, then the result.
    Span<Real> value;
    Span<Real> source;  // [rows of a block] right-hand sides of the transpose

    void lay_out(Arena& arena, Plan const& plan, Index fields) noexcept;

    // Finds the given points in a list of them. A point may stand there twice, and so may the two
    // sides of a cut.
    Status find_places(Plan const& plan, PointList const& list, Fault& fault) noexcept;

    // All fields are 0.
    void clear(Plan const& plan) const noexcept;
    // One field at the points of the list. Refused: displacements that are not finite or beyond the
    // range of coordinates, and different ones for the same point.
    Status set(Plan const& plan, PointList const& list, Index field, Points wall,
               Fault& fault) const noexcept;
    // measured: the report has residuals. Where the engine's factor is trusted, they take longer
    // than they are worth.
    Status solve(Plan& plan, bool measured, SolveReport& report, Fault& fault) const noexcept;
    // Refused: a boundary that crosses itself, or coordinates beyond the range, at from +
    // displacement.
    Status check_target(Plan const& plan, Index field, Points from, Fault& fault) const noexcept;
    // from + displacement, of fields first .. first + number of arrays - 1 of one block; from not
    // given: the displacement.
    void write(Plan const& plan, Index first, Points from,
               Span<const MutablePoints> to) const noexcept;

    // Of one field, solved.
    Vec2 at(Plan const& plan, Index field, Index point) const noexcept {
        return block_of(plan, field).field(field)[point];
    }

    // Derivatives by all mesh points, of fields of one block. Refused where they are not finite.
    Status set_derivatives(Plan const& plan, Index first, Span<const Points> derivatives,
                           Fault& fault) const noexcept;
    Status solve_transposed(Plan& plan, bool measured, SolveReport& report,
                            Fault& fault) const noexcept;
    // Derivatives by the points of the list: complete where a point stands first, 0 where it is
    // repeated.
    void write_gradient(Plan const& plan, PointList const& list, Index field,
                        MutablePoints gradient) const noexcept;

private:
    struct Block {
        Index first, n;  // fields
        Span<Real> rows;

        Index length() const noexcept { return 2 * n; }
        Real* row(Index point) const noexcept { return rows.data() + Offset{point} * length(); }
        // One field as arrays of a caller.
        MutablePoints field(Index number) const noexcept {
            return {rows.data() + (number - first), rows.data() + (number - first + n), length()};
        }
    };
    Block block_of(Plan const& plan, Index field) const noexcept;
    template <class Body>
    Status for_each_block(Plan const& plan, Fault& fault, Body const& body) const noexcept;
    static DofValues dofs(Plan const& plan, Block const& block) noexcept;
};

}  // namespace harmorph
