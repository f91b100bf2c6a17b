// A basis with more functions: modes given at points of the wall, solved as displacement fields.
#pragma once

#include "morph/displacement.hpp"

namespace harmorph {

struct Modes {
    Index n = 0, numbers = 1;     // numbers of a value: real, or complex
    const Real* value = nullptr;  // [n * list.count() * numbers] mode by mode

    Vec2 at(Index mode, Index k, Index n_points) const noexcept {
        const Real* const entry = value + (Offset{mode} * n_points + k) * numbers;
        return {entry[0], numbers == 2 ? entry[1] : 0};
    }
    // Are all finite, and none 0?
    Status check(Index n_points, Fault& fault) const noexcept;
};

// With n more functions, of modes with these numbers.
BasisCounts tabulated_counts(Basis const& from, Index n, Index numbers) noexcept;
// Displacement fields that are solved for: a matrix takes two, one for amplitudes along x and one
// along y.
inline Index fields_of(Basis const& from, Index n) noexcept {
    return from.kind() == ValueKind::matrix ? 2 * n : n;
}

// Memory of the solution.
struct ModeWork {
    Displacement displacement;
    Span<Vec2> wall;  // [points of the list] one mode

    void lay_out(Arena& arena, Plan const& plan, Index n_points, Index n_fields) noexcept {
        displacement.lay_out(arena, plan, n_fields);
        arena.take(wall, n_points);
    }
};

// `to` has been laid out for tabulated_counts, the work for the fields; the displacement's places
// have been found in the list.
Status tabulate(Plan& plan, Basis const& from, PointList const& list, Modes const& modes,
                ModeWork const& work, Basis const& to, SolveReport& report, Fault& fault) noexcept;

}  // namespace harmorph
