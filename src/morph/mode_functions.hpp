// A basis with more functions: modes are given at points of the wall, and solved as displacement
// fields.
#pragma once

#include "morph/displacement.hpp"

namespace harmorph {

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
